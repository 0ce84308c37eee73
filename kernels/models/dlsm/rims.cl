/* dlsm: what broken bonds change at the rim of their rings. An element of ring 2 has a whole row of bonds to go through
 * for its flux B, yet only its neighbours of ring 1 have another stress P than before, and none another H; one of ring
 * 3 has its own B and those of most of its neighbours as before. What these gained is added to what it had, B and
 * force, in the order of its row. The rings within, 0 and 1, are evaluated as a whole (dlsm.cl). Only for rings without
 * surfaces that touch or soften.
 *
 * level [n]: ring and place of the elements of the list (rings.cl). delta [record][9]: P less that of before [Pa] of
 * the rings 0 and 1, record 1 + place; from record `fluxes` on B less that of before [Pa] of the rings 0 to 2, record
 * fluxes + 1 + place. The records 0 and fluxes are those of all others: 0. */

/* Stored as what the elements change, behind record `first`, which is that of all others. */
LAW void rim_changed(members who, int item, int first, GATHER(int) level, lane_mat3 change, SCATTER(coeff) delta)
{
#define OF(l) (first + RING_PLACE(level[LANE_ITEM(who.own, l)]))
    who.own = LANE_MAKE(lane_int, OF);
#undef OF
    members_store9(who, delta, change);
    for (int c = 0; item == 0 && c < 9; ++c) delta[(brc_size)first * 9 + (brc_size)c] = 0;
}

/* As dlsm_stress of the elements of a list, and their V psi [J] from the same strain: what they hold after bonds broke.
 * deltas: 1 where delta is wanted. */
KERNEL void rim_stress(int n_items, int n, OWN(int) list, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) area,
                       OWN(coeff) offset, GATHER(coeff) gradient, OWN(coeff) inv_volume, OWN(int) boundary,
                       OWN(coeff) held_gradient, int face_loads, coeff lambda_one, coeff mu_one, OWN(coeff) material,
                       int finite, UPDATE(coeff) stress, PUT(state) elastic, int deltas, GATHER(int) level,
                       SCATTER(coeff) delta)
{
    FOR_EACH_ITEM(item, n_items) {
        const members who = members_of_list(item, n, list, row_start);
        const lane_mat3 g = dlsm_deformation_of(who, neighbour, area, offset, gradient, inv_volume, boundary,
                                                held_gradient, face_loads);
        const lane lambda = MEMBERS_MATERIAL(0, lambda_one), mu = MEMBERS_MATERIAL(1, mu_one);
        const lane_mat3 p = finite ? dlsm_first_piola(g, lambda, mu, 1) : dlsm_first_piola(g, lambda, mu, 0);
        if (deltas) rim_changed(who, item, 0, level, lane_mat3_sub(p, lane_gather9(stress, who.own)), delta);
        members_store9(who, stress, p);
        members_store1(who, elastic, dlsm_elastic_energy(who, g, lambda, mu, finite, inv_volume));
    }
}

/* As dlsm_flux_listed of the rings 0 and 1, and what B gained. */
KERNEL void rim_inner_flux(int n_items, int n, OWN(int) list, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) area,
                           OWN(coeff) offset, OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) gradient,
                           GATHER(coeff) stress, OWN(coeff) inv_shape, OWN(coeff) inv_volume, OWN(int) boundary,
                           OWN(coeff) held_moment, int face_loads, coeff k_one, coeff ell_one, coeff beta,
                           coeff one_plus_tau, OWN(coeff) material, GATHER(coeff) modulus, GATHER(coeff) ell_of,
                           int finite, UPDATE(coeff) flux, PUT(coeff) bond_part, int fluxes, GATHER(int) level,
                           SCATTER(coeff) delta)
{
    ASIDE(room, ASIDE_FLUX);
    FOR_EACH_ITEM(item, n_items) {
        const members who = members_of_list(item, n, list, row_start);
        const lane_mat3 b = dlsm_flux_of(who, room, neighbour, area, offset, ratio, displacement, gradient, stress,
                                         inv_shape, inv_volume, boundary, held_moment, face_loads, k_one, ell_one, beta,
                                         one_plus_tau, material, modulus, ell_of, finite, bond_part);
        rim_changed(who, item, fluxes, level, lane_mat3_sub(b, lane_gather9(flux, who.own)), delta);
        members_store9(who, flux, b);
    }
}

/* Bonds of one element that count, in their order, of RIM_SLOTS slots from first on, and the records of what their
 * neighbours gained (0: nothing): all, or those of neighbours that gained; from_stress: of the rings 0 and 1, else of
 * ring 2 too. Without a branch, as what a neighbour is waits for memory and a guess at it would often be wrong. */
#define RIM_SLOTS 32
typedef struct {
    int n, slot[RIM_SLOTS], record[RIM_SLOTS];
} rim_bonds;
LAW void rim_select(rim_bonds *out, int e, int first, int end, int all, int from_stress, OWN(int) neighbour,
                    GATHER(int) level)
{
    const int stop = first + RIM_SLOTS < end ? first + RIM_SLOTS : end;
    int n = 0;
    for (int slot = first; slot < stop; ++slot) {
        const int known = level[neighbour[(brc_size)slot * C + e % C]],
                  record = from_stress ? RING_PLACE(known) & (RING_IS_OUTER(known) - 1) : RING_PLACE(known);
        out->slot[n] = slot;
        out->record[n] = record;
        n += all | (record > 0);
    }
    out->n = n;
}
/* Their faces are asked for. */
LAW void rim_ask(const rim_bonds *bonds, int e, OWN(coeff) p)
{
    for (int m = 0; m < bonds->n; ++m) {
        const brc_size at = (brc_size)bonds->slot[m] * 3 * C + e % C;
        PREFETCH(p, at);
        PREFETCH(p, at + C);
        PREFETCH(p, at + 2 * C);
    }
}

/* As dlsm_flux_stress_at: what the stress of j counts for in the flux of e. */
LAW coeff rim_share(int e, int j, GATHER(coeff) modulus)
{
#if BRC_MANY_MATERIALS
    return modulus[e] / modulus[j];
#else
    (void)e, (void)j, (void)modulus;
    return REAL(1);
#endif
}

/* B of ring 2, list: that of the rings 0 to 2. To it comes -(1/2) sum (P_j s) (x) d A^-1 of what its neighbours' P
 * gained (dlsm_flux.h). A work-item looks for the bonds of W elements before it sums them up, so that their faces are
 * under way together. */
KERNEL void rim_flux(int n_items, int n, OWN(int) list, int fluxes, OWN(int) row_start, OWN(int) neighbour,
                     OWN(coeff) area, OWN(coeff) offset, OWN(coeff) inv_shape, GATHER(coeff) modulus, GATHER(int) level,
                     SCATTER(coeff) delta, UPDATE(coeff) flux)
{
    FOR_EACH_ITEM(item, n_items) {
        rim_bonds bonds[W];
        const int begin = item * W, stop = begin + W < n ? begin + W : n;
        for (int k = begin; k < stop; ++k) {
            const int e = list[k];
            if (!RING_IS_OUTER(level[e])) continue;
            rim_select(&bonds[k - begin], e, row_start[e / C], row_start[e / C + 1], 0, 1, neighbour, level);
            rim_ask(&bonds[k - begin], e, area);
            rim_ask(&bonds[k - begin], e, offset);
        }
        for (int k = begin; k < stop; ++k) {
            const int e = list[k], end = row_start[e / C + 1];
            if (!RING_IS_OUTER(level[e])) continue;
            rim_bonds *own = &bonds[k - begin];
            coeff q[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            for (int first = row_start[e / C]; first < end; first += RIM_SLOTS) {
                if (first > row_start[e / C]) rim_select(own, e, first, end, 0, 1, neighbour, level);
                for (int m = 0; m < own->n; ++m) {
                    const brc_size at = (brc_size)own->slot[m] * 3 * C + e % C;
                    GLOBAL const coeff *p = delta + (brc_size)own->record[m] * 9;
                    const coeff share = rim_share(e, neighbour[(brc_size)own->slot[m] * C + e % C], modulus);
                    const coeff x = share * area[at], y = share * area[at + C], z = share * area[at + 2 * C];
                    for (int c = 0; c < 3; ++c) {
                        const coeff pull = p[3 * c] * x + p[3 * c + 1] * y + p[3 * c + 2] * z;
                        q[3 * c] += pull * offset[at], q[3 * c + 1] += pull * offset[at + C],
                            q[3 * c + 2] += pull * offset[at + 2 * C];
                    }
                }
            }
            GLOBAL const coeff *a = inv_shape + (brc_size)(e / C) * 6 * C + e % C; /* xx, yy, zz, yz, xz, xy */
            GLOBAL coeff *change = delta + ((brc_size)fluxes + (brc_size)RING_PLACE(level[e])) * 9;
            const coeff inverse[9] = {a[0], a[5 * C], a[4 * C], a[5 * C], a[C], a[3 * C], a[4 * C], a[3 * C], a[2 * C]};
            for (int c = 0; c < 9; ++c) {
                const coeff *row = q + c / 3 * 3;
                change[c] =
                    REAL(-0.5) * (row[0] * inverse[c % 3] + row[1] * inverse[3 + c % 3] + row[2] * inverse[6 + c % 3]);
                flux[(brc_size)e * 9 + (brc_size)c] += change[c];
            }
        }
    }
}

/* Force of the rings 2 and 3, list: that of the rings 0 to 3. That of before and sum (B_i + B_j) s of what both gained
 * (dlsm_bond.h), taken over as ring_replace does. */
KERNEL void rim_force(int n_items, int n, OWN(int) list, int fluxes, OWN(int) row_start, OWN(int) neighbour,
                      OWN(coeff) area, GATHER(int) level, GATHER(coeff) delta, state half_kick, OWN(state) mass,
                      UPDATE(state) force, UPDATE(state) velocity, PUT(state) fresh)
{
    FOR_EACH_ITEM(item, n_items) {
        rim_bonds bonds[W];
        const int begin = item * W, stop = begin + W < n ? begin + W : n;
        for (int k = begin; k < stop; ++k) {
            const int e = list[k], known = level[e];
            if (!RING_IS_OUTER(known)) continue;
            rim_select(&bonds[k - begin], e, row_start[e / C], row_start[e / C + 1], RING_PLACE(known) > 0, 0,
                       neighbour, level);
            rim_ask(&bonds[k - begin], e, area);
        }
        for (int k = begin; k < stop; ++k) {
            const int e = list[k], known = level[e], end = row_start[e / C + 1];
            if (!RING_IS_OUTER(known)) continue;
            rim_bonds *own = &bonds[k - begin];
            coeff f[3] = {0, 0, 0}, total[3] = {0, 0, 0}; /* total: of the faces */
            for (int first = row_start[e / C]; first < end; first += RIM_SLOTS) {
                if (first > row_start[e / C])
                    rim_select(own, e, first, end, RING_PLACE(known) > 0, 0, neighbour, level);
                for (int m = 0; m < own->n; ++m) {
                    const brc_size at = (brc_size)own->slot[m] * 3 * C + e % C;
                    GLOBAL const coeff *b = delta + ((brc_size)fluxes + (brc_size)own->record[m]) * 9;
                    const coeff x = area[at], y = area[at + C], z = area[at + 2 * C];
                    for (int c = 0; c < 3; ++c) f[c] += b[3 * c] * x + b[3 * c + 1] * y + b[3 * c + 2] * z;
                    total[0] += x, total[1] += y, total[2] += z;
                }
            }
            GLOBAL const coeff *b = delta + ((brc_size)fluxes + (brc_size)RING_PLACE(known)) * 9;
            const state per_mass = STATE(1) / mass[e];
            for (int c = 0; c < 3; ++c) {
                const brc_size at = (brc_size)e * 3 + (brc_size)c;
                ring_take(at, half_kick, per_mass,
                          force[at] +
                              (state)(f[c] + b[3 * c] * total[0] + b[3 * c + 1] * total[1] + b[3 * c + 2] * total[2]),
                          force, velocity, fresh);
            }
        }
    }
}
