/* dlsm: what its passes (dlsm_passes.cl, dlsm_held.cl) do for their elements. */

LAW void dlsm_gradient_of(members who, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area, GATHER(state) displacement,
                          OWN(coeff) inv_shape, PUT(coeff) gradient)
{
    members_states_later(who, displacement, 3, ahead);
    const state_vec3 u = state_gather3(displacement, who.own);
    lane_mat3 a = lane_mat3_zero();
    lane_int next[TURNS];
    EACH_TURN(k) next[k] = members_first_neighbour(who, neighbour, k);
    for (int slot = who.begin; slot < who.end; slot += TURNS) {
        dlsm_row row[TURNS];
        state_vec3 u_j[TURNS];
        EACH_TURN(k) row[k] = dlsm_turn_row(who, slot + k, &next[k], neighbour, area, area, 0);
        EACH_TURN(k) u_j[k] = state_gather3(displacement, row[k].j);
        EACH_TURN(k)
        if (!k || slot + k < who.end) a = dlsm_add_jump(a, state_vec3_difference(u_j[k], u), row[k].area);
    }
    members_store9(who, gradient, lane_mat3_mul_sym(a, members_block6(who, inv_shape)));
}

LAW void dlsm_stress_of(members who, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area, OWN(coeff) offset,
                        GATHER(coeff) gradient, OWN(coeff) inv_volume, OWN(int) boundary, OWN(coeff) held_gradient,
                        int face_loads, coeff lambda_one, coeff mu_one, OWN(coeff) material, int finite,
                        PUT(coeff) stress)
{
    members_later(who, gradient, 9, ahead);
    const lane_mat3 g =
        dlsm_deformation_of(who, neighbour, area, offset, gradient, inv_volume, boundary, held_gradient, face_loads);
    const lane lambda = MEMBERS_MATERIAL(0, lambda_one), mu = MEMBERS_MATERIAL(1, mu_one);
    members_store9(who, stress, finite ? dlsm_first_piola(g, lambda, mu, 1) : dlsm_first_piola(g, lambda, mu, 0));
}

LAW void dlsm_force_of(members who, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area, OWN(coeff) ratio,
                       GATHER(state) displacement, GATHER(coeff) flux, GATHER(coeff) bond_part, coeff k_one,
                       coeff one_plus_tau, GATHER(coeff) modulus, PUT(state) force)
{
    members_states_later(who, displacement, 3, ahead), members_later(who, flux, 9, ahead);
    const dlsm_end own = dlsm_end_of(who, displacement, flux, bond_part, k_one, one_plus_tau, modulus);
    lane_vec3 f = {LANE_ZERO, LANE_ZERO, LANE_ZERO};
    dlsm_row next = dlsm_first_row(who, neighbour, area, ratio, DLSM_RATIO);
    for (int slot = who.begin; slot < who.end; ++slot) {
        const dlsm_row row = dlsm_next_row(who, slot, &next, neighbour, area, ratio, DLSM_RATIO);
        const dlsm_pull b = dlsm_pull_at(row, own, displacement, flux, bond_part, one_plus_tau, modulus);
        f = lane_vec3_add(f, b.force);
    }
    members_store3(who, force, f);
}

LAW void cells_force_of(members who, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) area, OWN(coeff) ratio,
                        GATHER(state) displacement, GATHER(coeff) flux, GATHER(coeff) bond_part, coeff k_one,
                        coeff one_plus_tau, GATHER(coeff) modulus, OWN(coeff) gradient, OWN(coeff) stress,
                        OWN(coeff) plane, OWN(coeff) limit, int finite, PUT(state) force, PUT(int) look)
{
    members_states_later(who, displacement, 3, ahead), members_later(who, flux, 9, ahead);
    const dlsm_end own = dlsm_end_of(who, displacement, flux, bond_part, k_one, one_plus_tau, modulus);
    const cell_side side =
        cell_side_of(lane_gather9(gradient, who.own), lane_gather9(stress, who.own), members_number(who, plane));
    members_records_ahead9(who, gradient);
    members_records_ahead9(who, stress);
    lane_vec3 f = {LANE_ZERO, LANE_ZERO, LANE_ZERO};
    lane least = LANE_ZERO + CELLS_NEVER;
    dlsm_row next = dlsm_first_row(who, neighbour, area, ratio, DLSM_RATIO);
    for (int slot = who.begin; slot < who.end; ++slot) {
        const dlsm_row row = dlsm_next_row(who, slot, &next, neighbour, area, ratio, DLSM_RATIO);
        const dlsm_pull b = dlsm_pull_at(row, own, displacement, flux, bond_part, one_plus_tau, modulus);
        members_ahead1(who, limit, slot);
        f = lane_vec3_add(f, b.force);
        least =
            lane_min(least, cell_room(side, lane_vec3_scale(b.ratio, b.area), b.jump, members_row1(who, limit, slot)));
    }
    members_store3(who, force, f);
    if (!finite) least = LANE_ZERO - REAL(1); /* the room is that of the full law */
    if (LANE_ANY_SHORT(least, LANE_ZERO)) {
#define LOOK(l)                                                                                                        \
    if (!(LANE_ITEM(least, l) >= 0)) STORE_SAME(look + LANE_ITEM(who.own, l) / W, 1);
        LANE_EACH(LOOK)
#undef LOOK
    }
}
