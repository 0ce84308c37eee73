/* dlsm: passes over all elements where faces are held, which do the faces of their own elements too (dlsm_faces.cl),
 * each of a group whose slice has a boundary block: no launch for a short list. held_of [block][C]: the held element h
 * at that place, -1: none. */

/* Each lane of a group with a boundary block and, in it, h. */
#define FOR_HELD_LANES(l, h)                                                                                           \
    for (int l = 0, h; boundary[who.slice] >= 0 && l < W; ++l)                                                         \
        if (h = held_of[boundary[who.slice] * C + who.lane0 + l], h >= 0)

/* H, and what held faces add to V G. */
KERNEL void dlsm_gradient_held(int n_items, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                               GATHER(state) displacement, OWN(coeff) inv_shape, OWN(int) boundary, OWN(int) held_of,
                               OWN(int) face_start, OWN(coeff) face_area, OWN(coeff) arm, OWN(coeff) held,
                               OWN(state) value, UPDATE(coeff) gradient, PUT(coeff) held_gradient)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = members_of_group(item, row_start);
        dlsm_gradient_of(who, neighbour, ahead, area, displacement, inv_shape, gradient);
        FOR_HELD_LANES(l, h)
        mat3_put_in_block(held_gradient, boundary[who.slice], who.lane0 + l,
                          held_gradient_of(who.first + l, face_start[h], face_start[h + 1], face_area, arm, held, value,
                                           displacement, mat3_load(gradient, who.first + l)));
    }
}

/* P, the reactions of held faces, booked, and their part of Q, which is 0 at all other places of the block. */
KERNEL void dlsm_stress_held(int n_items, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                             OWN(coeff) offset, GATHER(coeff) gradient, OWN(coeff) inv_volume, OWN(int) boundary,
                             OWN(coeff) held_gradient, int face_loads, coeff lambda_one, coeff mu_one,
                             OWN(coeff) material, int finite, OWN(int) held_of, OWN(int) face_start,
                             OWN(coeff) face_area, OWN(coeff) arm, OWN(coeff) held, OWN(coeff) spring, OWN(state) value,
                             OWN(state) displacement, int book, UPDATE(coeff) stress, PUT(coeff) held_moment,
                             UPDATE(state) reaction, UPDATE(state) last, UPDATE(state) last_reaction,
                             UPDATE(state) work)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = members_of_group(item, row_start);
        dlsm_stress_of(who, neighbour, ahead, area, offset, gradient, inv_volume, boundary, held_gradient, face_loads,
                       lambda_one, mu_one, material, finite, stress);
        for (int l = 0; boundary[who.slice] >= 0 && l < W; ++l) {
            const int e = who.first + l, h = held_of[boundary[who.slice] * C + who.lane0 + l];
            mat3 sum = {0, 0, 0, 0, 0, 0, 0, 0, 0};
            if (h >= 0) {
                for (int f = face_start[h]; f < face_start[h + 1]; ++f) /* as few numbers at a time as can be */
                    held_book(f,
                              held_pull(e, f, face_area, vec3_load(arm, f), held, spring, value, displacement,
                                        mat3_load(gradient, e), mat3_load(stress, e)),
                              value, book, reaction, last, last_reaction, work);
                for (int f = face_start[h]; f < face_start[h + 1]; ++f)
                    sum = held_add_moment(sum,
                                          (vec3){(coeff)reaction[(brc_size)f * 3], (coeff)reaction[(brc_size)f * 3 + 1],
                                                 (coeff)reaction[(brc_size)f * 3 + 2]},
                                          vec3_load(arm, f));
            }
            mat3_put_in_block(held_moment, boundary[who.slice], who.lane0 + l, sum);
        }
    }
}

/* f, with the reactions of held faces. */
KERNEL void dlsm_force_held(int n_items, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                            OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) flux, GATHER(coeff) bond_part,
                            coeff k_one, coeff one_plus_tau, GATHER(coeff) modulus, OWN(int) boundary, OWN(int) held_of,
                            OWN(int) face_start, OWN(state) reaction, UPDATE(state) force)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = members_of_group(item, row_start);
        dlsm_force_of(who, neighbour, ahead, area, ratio, displacement, flux, bond_part, k_one, one_plus_tau, modulus,
                      force);
        FOR_HELD_LANES(l, h) held_add_forces(who.first + l, face_start[h], face_start[h + 1], reaction, force);
    }
}

/* The same as cells_force. */
KERNEL void cells_force_held(int n_items, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area,
                             OWN(coeff) ratio, GATHER(state) displacement, GATHER(coeff) flux, GATHER(coeff) bond_part,
                             coeff k_one, coeff one_plus_tau, GATHER(coeff) modulus, OWN(coeff) gradient,
                             OWN(coeff) stress, OWN(coeff) plane, OWN(coeff) limit, int finite, OWN(int) boundary,
                             OWN(int) held_of, OWN(int) face_start, OWN(state) reaction, UPDATE(state) force,
                             PUT(int) look)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = members_of_group(item, row_start);
        cells_force_of(who, neighbour, ahead, area, ratio, displacement, flux, bond_part, k_one, one_plus_tau, modulus,
                       gradient, stress, plane, limit, finite, force, look);
        FOR_HELD_LANES(l, h) held_add_forces(who.first + l, face_start[h], face_start[h + 1], reaction, force);
    }
}
