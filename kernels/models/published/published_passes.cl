/* dlsm-published: passes over all elements or over a list (PASS, kernels.h); laws in published.cl. */

/* As published_strain_pass where bonds may be missing. spanned: projector on the directions that an element's bonds
 * span [slice][6][C]. */
KERNEL void PASS(published_breaking_strain)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead,
                                            OWN(coeff) branch, OWN(coeff) area, int area_weights,
                                            GATHER(state) displacement, OWN(state) orientation, OWN(coeff) inv_shape,
                                            OWN(coeff) spanned, int finite, PUT(coeff) strain)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = PASS_MEMBERS(item, row_start);
        members_states_later(who, displacement, 3, ahead);
        const lane_mat3 fitted = published_fit(who, neighbour, branch, area, area_weights, displacement, inv_shape);
        const lane_quat q = quat_conjugate(lane_gather4(orientation, who.own));
        const lane_mat3 turn = finite ? quat_matrix_minus_identity(q, 1) : quat_matrix_minus_identity(q, 0);
        const lane_mat3 seen = lane_mat3_mul_sym(turn, members_block6(who, spanned));
        members_store6(who, strain,
                       finite ? published_strain_seen(fitted, turn, seen, 1)
                              : published_strain_seen(fitted, turn, seen, 0));
    }
}

/* Force [N] and torque about its own centre [N m] on every element [n][3]. */
KERNEL void PASS(published_force_pass)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead,
                                       OWN(coeff) branch, OWN(coeff) area, GATHER(state) displacement,
                                       GATHER(state) orientation, GATHER(coeff) strain, coeff lambda_one, coeff mu_one,
                                       coeff young_one, coeff rotation_factor, coeff couple, GATHER(coeff) lame_of,
                                       int finite, PUT(state) force, PUT(state) torque)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = PASS_MEMBERS(item, row_start);
        members_states_later(who, displacement, 3, ahead), members_states_later(who, orientation, 4, ahead);
        members_later(who, strain, 6, ahead);
        const published_own own = published_own_of(who.own, displacement, orientation, strain);
        lane_vec3 f = {LANE_ZERO, LANE_ZERO, LANE_ZERO}, t = {LANE_ZERO, LANE_ZERO, LANE_ZERO};
        for (int slot = who.begin; slot < who.end; ++slot) {
            const lane_int j = members_neighbour(who, neighbour, slot);
            const published_bond b =
                published_bond_at(who, slot, j, own, branch, area, displacement, orientation, strain, lambda_one,
                                  mu_one, young_one, rotation_factor, couple, lame_of, finite);
            f = lane_vec3_add(f, b.force);
            t = lane_vec3_add(t, b.torque);
        }
        members_store3(who, force, f);
        members_store3(who, torque, t);
    }
}

/* As published_force_pass; bond_ratio [n]: the largest normal stress over limit of each element's bonds [-]. */
KERNEL void PASS(published_breaking_force)(PASS_ITEMS, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead,
                                           OWN(coeff) branch, OWN(coeff) area, GATHER(state) displacement,
                                           GATHER(state) orientation, GATHER(coeff) strain, coeff lambda_one,
                                           coeff mu_one, coeff young_one, coeff rotation_factor, coeff couple,
                                           GATHER(coeff) lame_of, int finite, OWN(coeff) limit, PUT(state) force,
                                           PUT(state) torque, PUT(coeff) bond_ratio)
{
    FOR_EACH_GROUP(item, n_items)
    {
        const members who = PASS_MEMBERS(item, row_start);
        members_states_later(who, displacement, 3, ahead), members_states_later(who, orientation, 4, ahead);
        members_later(who, strain, 6, ahead);
        const published_sums sums =
            finite ? published_sums_of(who, neighbour, branch, area, displacement, orientation, strain, lambda_one,
                                       mu_one, young_one, rotation_factor, couple, lame_of, limit, 1)
                   : published_sums_of(who, neighbour, branch, area, displacement, orientation, strain, lambda_one,
                                       mu_one, young_one, rotation_factor, couple, lame_of, limit, 0);
        members_store3(who, force, sums.force);
        members_store3(who, torque, sums.torque);
        members_put1(who, bond_ratio, sums.largest);
    }
}

/* Ledger: strain energy of every element [J] [n]. */
KERNEL void PASS(published_energy)(PASS_ITEMS, OWN(coeff) strain, OWN(state) volume, coeff lambda_one, coeff mu_one,
                                   OWN(coeff) lame_of, PUT(state) elastic)
{
    FOR_EACH_GROUP(item, n_items)
    {
        for (int l = 0; l < W; ++l) {
            const int e = PASS_ELEMENT(item, l);
            elastic[e] = published_energy_of(e, strain, volume, lambda_one, mu_one, lame_of);
        }
    }
}
