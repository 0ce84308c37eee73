/* dlsm: what broken bonds change at the rims of their rings. An element of ring 2 has whole rows of bonds to go through for its flux B, yet of its neighbours only those of ring 1 have another
 * stress P than before, and of those of an element of ring 3 only those of ring 2 another B: so what its neighbours gained is added to what it had, in the order of its row. The rings within are
 * evaluated as a whole (dlsm.cl). Everything here is for rings without surfaces that touch or soften.
 *
 * level [n]: RING_KNOWN of the elements of the rings 0 to 2, else 0 (rings.cl). gain [2][n_known][9]: P, and B, less those of before [Pa] by the place of the element, P of the rings 0 and 1,
 * B of ring 2; n_known: elements of the rings 0 to 2. */

/* As dlsm_stress of the elements of a list, and their V psi [J] from the same strain: what they hold after bonds broke. gains: 1 where gain is wanted. */
KERNEL void rim_stress(int n_items, int n, GLOBAL const int *restrict list, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                       GLOBAL const coeff *restrict area, GLOBAL const coeff *restrict offset, GLOBAL const coeff *restrict gradient,
                       GLOBAL const coeff *restrict inv_volume, GLOBAL const int *restrict boundary, GLOBAL const coeff *restrict held_gradient, int face_loads,
                       coeff lambda_one, coeff mu_one, GLOBAL const coeff *restrict material, int finite, GLOBAL coeff *restrict stress, GLOBAL state *restrict elastic,
                       int gains, GLOBAL const int *restrict level, GLOBAL coeff *restrict gain)
{
    FOR_EACH_ITEM(item, n_items) {
        const members who = members_of_list(item, n, list, row_start);
        const lane_mat3 g = dlsm_deformation_of(who, neighbour, area, offset, gradient, inv_volume, boundary, held_gradient, face_loads);
        const lane lambda = MEMBERS_MATERIAL(0, lambda_one), mu = MEMBERS_MATERIAL(1, mu_one);
        const lane_mat3 p = finite ? dlsm_first_piola(g, lambda, mu, 1) : dlsm_first_piola(g, lambda, mu, 0);
        if (gains) {
            members at = who;
#define PLACE(l) RING_PLACE(level[LANE_ITEM(who.own, l)])
            at.own = LANE_MAKE(lane_int, PLACE);
#undef PLACE
            members_store9(at, gain, lane_mat3_sub(p, lane_gather9(stress, who.own)));
        }
        members_store9(who, stress, p);
        members_store1(who, elastic, dlsm_elastic_energy(who, g, lambda, mu, finite, inv_volume));
    }
}

/* B of ring 2, list: that of the rings 0 to 2. It gains -(1/2) sum (P_j s) (x) d A^-1 of what its neighbours' P gained (dlsm_flux.h). */
KERNEL void rim_flux(int n, GLOBAL const int *restrict list, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour, GLOBAL const coeff *restrict area,
                     GLOBAL const coeff *restrict offset, GLOBAL const coeff *restrict inv_shape, GLOBAL const int *restrict level, int n_known, GLOBAL coeff *restrict gain,
                     GLOBAL coeff *restrict flux)
{
    FOR_EACH_ITEM(k, n) {
        const int e = list[k];
        if (RING_OF(level[e]) == 2) {
            coeff q[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const int known = level[neighbour[(brc_size)slot * C + e % C]];
                if (known == 0 || RING_OF(known) == 2) continue;
                const brc_size at = (brc_size)slot * 3 * C + e % C;
                GLOBAL const coeff *p = gain + (brc_size)RING_PLACE(known) * 9;
                const coeff x = area[at], y = area[at + C], z = area[at + 2 * C];
                for (int c = 0; c < 3; ++c) {
                    const coeff pull = p[3 * c] * x + p[3 * c + 1] * y + p[3 * c + 2] * z;
                    q[3 * c] += pull * offset[at], q[3 * c + 1] += pull * offset[at + C], q[3 * c + 2] += pull * offset[at + 2 * C];
                }
            }
            GLOBAL const coeff *a = inv_shape + (brc_size)(e / C) * 6 * C + e % C; /* xx, yy, zz, yz, xz, xy */
            const coeff inverse[9] = {a[0], a[5 * C], a[4 * C], a[5 * C], a[C], a[3 * C], a[4 * C], a[3 * C], a[2 * C]};
            GLOBAL coeff *own = gain + ((brc_size)n_known + (brc_size)RING_PLACE(level[e])) * 9;
            for (int c = 0; c < 9; ++c) {
                const coeff *row = q + c / 3 * 3;
                own[c] = -REAL(0.5) * (row[0] * inverse[c % 3] + row[1] * inverse[3 + c % 3] + row[2] * inverse[6 + c % 3]);
                flux[(brc_size)e * 9 + (brc_size)c] += own[c];
            }
        }
    }
}

/* Forces of ring 3, list: that of the rings 0 to 3: fresh is force and the sum of what its neighbours' B gained, times s. */
KERNEL void rim_force(int n, GLOBAL const int *restrict list, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour, GLOBAL const coeff *restrict area,
                      GLOBAL const int *restrict level, int n_known, GLOBAL const coeff *restrict gain, GLOBAL const state *restrict force, GLOBAL state *restrict fresh)
{
    FOR_EACH_ITEM(k, n) {
        const int e = list[k];
        if (level[e] == 0) {
            coeff f[3] = {0, 0, 0};
            for (int slot = row_start[e / C]; slot < row_start[e / C + 1]; ++slot) {
                const int known = level[neighbour[(brc_size)slot * C + e % C]];
                if (known == 0) continue;
                const brc_size at = (brc_size)slot * 3 * C + e % C;
                GLOBAL const coeff *b = gain + ((brc_size)n_known + (brc_size)RING_PLACE(known)) * 9;
                const coeff x = area[at], y = area[at + C], z = area[at + 2 * C];
                for (int c = 0; c < 3; ++c) f[c] += b[3 * c] * x + b[3 * c + 1] * y + b[3 * c + 2] * z;
            }
            for (int c = 0; c < 3; ++c) fresh[(brc_size)e * 3 + c] = force[(brc_size)e * 3 + c] + (state)f[c];
        }
    }
}
