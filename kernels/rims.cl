/* dlsm: what broken bonds change at the rim of their rings. An element of ring 2 has a whole row of bonds to go through for its flux B, yet only its neighbours of ring 1 have another stress P
 * than before, and none another H: what they gained is added to what it had, in the order of its row. The rings within are evaluated as a whole (dlsm.cl). Only for rings without surfaces that
 * touch or soften.
 *
 * level [n]: 1 + place in the list of the rings 0 and 1 of their elements, else 0 (rings.cl). gain [place][9]: P less that of before [Pa]. */

/* As dlsm_stress of the elements of a list, and their V psi [J] from the same strain: what they hold after bonds broke. gains: 1 where gain is wanted. */
KERNEL void rim_stress(int n_items, int n, GLOBAL const int *restrict list, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                       GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict offset, GLOBAL const coeff *restrict gradient,
                       GLOBAL const coeff *restrict inv_volume, GLOBAL const int *restrict boundary, GLOBAL const coeff *restrict held_gradient, int face_loads,
                       coeff lambda_one, coeff mu_one, GLOBAL const coeff *restrict material, int finite, GLOBAL coeff *restrict stress, GLOBAL state *restrict elastic,
                       int gains, GLOBAL coeff *restrict gain)
{
    FOR_EACH_ITEM(item, n_items) {
        const members who = members_of_list(item, n, list, row_start);
        const lane_mat3 g = dlsm_deformation_of(who, neighbour, area, offset, gradient, inv_volume, boundary, held_gradient, face_loads);
        const lane lambda = MEMBERS_MATERIAL(0, lambda_one), mu = MEMBERS_MATERIAL(1, mu_one);
        const lane_mat3 p = finite ? dlsm_first_piola(g, lambda, mu, 1) : dlsm_first_piola(g, lambda, mu, 0);
        if (gains) {
            members at = who;
#define PLACE(l) (item * W + 0x##l < n ? item * W + 0x##l : n - 1) /* as in members_of_list */
            at.own = LANE_MAKE(lane_int, PLACE);
#undef PLACE
            members_store9(at, gain, lane_mat3_sub(p, lane_gather9(stress, who.own)));
        }
        members_store9(who, stress, p);
        members_store1(who, elastic, dlsm_elastic_energy(who, g, lambda, mu, finite, inv_volume));
    }
}

/* Bonds of one element to neighbours that gained, in their order: of RIM_SLOTS slots from first on. Without a branch, as what a neighbour is waits for memory and a guess at it would be wrong
 * for every third; the faces of those that are wanted are asked for. */
#define RIM_SLOTS 32
typedef struct {
    int n, slot[RIM_SLOTS], known[RIM_SLOTS];
} rim_bonds;
LAW void rim_select(rim_bonds *out, int e, int first, int end, GLOBAL const int *restrict neighbour, GLOBAL const int *restrict level, GLOBAL const coeff *restrict area,
                    GLOBAL const coeff *restrict offset)
{
    const int stop = first + RIM_SLOTS < end ? first + RIM_SLOTS : end;
    int n = 0;
    for (int slot = first; slot < stop; ++slot) {
        const int known = level[neighbour[(brc_size)slot * C + e % C]], wanted = known > 0;
        const brc_size at = (brc_size)(wanted ? slot : first) * 3 * C + e % C;
        PREFETCH(area, at);
        PREFETCH(area, at + C);
        PREFETCH(area, at + 2 * C);
        PREFETCH(offset, at);
        PREFETCH(offset, at + C);
        PREFETCH(offset, at + 2 * C);
        out->slot[n] = slot;
        out->known[n] = known;
        n += wanted;
    }
    out->n = n;
}

/* B of ring 2, list: that of the rings 0 to 2. It gains -(1/2) sum (P_j s) (x) d A^-1 of what its neighbours' P gained (dlsm_flux.h). A work-item looks for the bonds of W elements before it
 * sums them up, so that their faces are under way together. */
KERNEL void rim_flux(int n_items, int n, GLOBAL const int *restrict list, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour, GLOBAL const coeff *restrict area,
                     GLOBAL const coeff *restrict offset, GLOBAL const coeff *restrict inv_shape, GLOBAL const int *restrict level, GLOBAL const coeff *restrict gain,
                     GLOBAL coeff *restrict flux)
{
    FOR_EACH_ITEM(item, n_items) {
        rim_bonds bonds[W];
        const int begin = item * W, stop = begin + W < n ? begin + W : n;
        for (int k = begin; k < stop; ++k) {
            const int e = list[k];
            if (level[e] == 0) rim_select(&bonds[k - begin], e, row_start[e / C], row_start[e / C + 1], neighbour, level, area, offset);
        }
        for (int k = begin; k < stop; ++k) {
            const int e = list[k], end = row_start[e / C + 1];
            if (level[e] != 0) continue;
            rim_bonds *own = &bonds[k - begin];
            coeff q[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            for (int first = row_start[e / C]; first < end; first += RIM_SLOTS) {
                if (first > row_start[e / C]) rim_select(own, e, first, end, neighbour, level, area, offset);
                for (int m = 0; m < own->n; ++m) {
                    const brc_size at = (brc_size)own->slot[m] * 3 * C + e % C;
                    GLOBAL const coeff *p = gain + ((brc_size)own->known[m] - 1) * 9;
                    const coeff x = area[at], y = area[at + C], z = area[at + 2 * C];
                    for (int c = 0; c < 3; ++c) {
                        const coeff pull = p[3 * c] * x + p[3 * c + 1] * y + p[3 * c + 2] * z;
                        q[3 * c] += pull * offset[at], q[3 * c + 1] += pull * offset[at + C], q[3 * c + 2] += pull * offset[at + 2 * C];
                    }
                }
            }
            GLOBAL const coeff *a = inv_shape + (brc_size)(e / C) * 6 * C + e % C; /* xx, yy, zz, yz, xz, xy */
            const coeff inverse[9] = {a[0], a[5 * C], a[4 * C], a[5 * C], a[C], a[3 * C], a[4 * C], a[3 * C], a[2 * C]};
            for (int c = 0; c < 9; ++c) {
                const coeff *row = q + c / 3 * 3;
                flux[(brc_size)e * 9 + (brc_size)c] -= REAL(0.5) * (row[0] * inverse[c % 3] + row[1] * inverse[3 + c % 3] + row[2] * inverse[6 + c % 3]);
            }
        }
    }
}
