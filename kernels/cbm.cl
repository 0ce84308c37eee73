/* cbm: spheres joined by beams (NAH19; design-cbm.md). One pass over elements and their bonds, each element computing its own side of
 * every beam. branch X_j - X_i [slot][3][C] (missing neighbours: any branch home), inv_length 1/|branch| [slot][C] (missing: 0).
 * beam_of [n][3]: E S, 2 E I, G J of each element's beams for several materials (a bond is two half beams in series); else the three scalars.
 * alive [slot][C]: 1, or 0 where the bond is broken; only read in scenes with fracture. */

LAW cbm_stiffness cbm_stiffness_of(GLOBAL const coeff *restrict beam_of, lane_int own, lane_int j, coeff axial, coeff bend, coeff twist)
{
#if BRC_MANY_MATERIALS
    const lane_int at = own * 3, to = j * 3;
    return (cbm_stiffness){cbm_in_series(gather_component(beam_of, at), gather_component(beam_of, to)),
                           cbm_in_series(gather_component(beam_of + 1, at), gather_component(beam_of + 1, to)),
                           cbm_in_series(gather_component(beam_of + 2, at), gather_component(beam_of + 2, to))};
#else
    return (cbm_stiffness){LANE_ZERO + axial, LANE_ZERO + bend, LANE_ZERO + twist};
#endif
}

/* Sums over the beams of a group; only called with a constant `finite`. */
LAW cbm_end cbm_group_force(int group, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                            GLOBAL const coeff *restrict branch, GLOBAL const coeff *restrict inv_length,
                            GLOBAL const coeff *restrict alive, int fracture, GLOBAL const state *restrict displacement,
                            GLOBAL const state *restrict orientation, coeff axial, coeff bend, coeff twist,
                            GLOBAL const coeff *restrict beam_of, int finite)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
    const lane_int own = lane_own(group * W);
    const state_vec3 u = state_gather3(displacement, own);
    const lane_quat q = lane_gather4(orientation, own);
    const lane_mat3 turn = quat_matrix_minus_identity(q, finite);
    cbm_end sum = {{LANE_ZERO, LANE_ZERO, LANE_ZERO}, {LANE_ZERO, LANE_ZERO, LANE_ZERO}};
    for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
        const lane_int j = int_block(neighbour, slot, lane0);
        rows_ahead3(branch, slot);
        rows_ahead1(inv_length, slot);
        gathers_ahead(displacement, 3, neighbour, slot, row_start[slice + 1], lane0);
        gathers_ahead(orientation, 4, neighbour, slot, row_start[slice + 1], lane0);
        const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
        const lane inverse = lane_load(inv_length, (brc_size)slot * C + (brc_size)lane0);
        cbm_stiffness k = cbm_stiffness_of(beam_of, own, j, axial, bend, twist);
        if (fracture) {
            const lane whole = lane_load(alive, (brc_size)slot * C + (brc_size)lane0);
            k = (cbm_stiffness){whole * k.axial, whole * k.bend, whole * k.twist};
        }
        const cbm_shape shape = cbm_beam_shape_turned(lane_block3(branch, slot, lane0), inverse, jump, q, turn, lane_gather4(orientation, j), finite);
        const cbm_end end = cbm_beam_law(shape, inverse, k, finite);
        sum.force = lane_vec3_add(sum.force, end.force);
        sum.torque = lane_vec3_add(sum.torque, end.torque);
    }
    return sum;
}

/* Force [N] and torque about its own centre [N m] on every element [n][3]. orientation: unit quaternions (w x y z) [n][4]. */
KERNEL void cbm_force_pass(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                           GLOBAL const coeff *restrict branch, GLOBAL const coeff *restrict inv_length,
                           GLOBAL const coeff *restrict alive, int fracture, GLOBAL const state *restrict displacement,
                           GLOBAL const state *restrict orientation, coeff axial, coeff bend, coeff twist,
                           GLOBAL const coeff *restrict beam_of, int finite, GLOBAL state *restrict force, GLOBAL state *restrict torque)
{
    FOR_EACH_ITEM(group, n_groups) {
        const cbm_end sum = finite ? cbm_group_force(group, row_start, neighbour, branch, inv_length, alive, fracture, displacement,
                                                     orientation, axial, bend, twist, beam_of, 1)
                                   : cbm_group_force(group, row_start, neighbour, branch, inv_length, alive, fracture, displacement,
                                                     orientation, axial, bend, twist, beam_of, 0);
        state_store3(force, group * W, sum.force);
        state_store3(torque, group * W, sum.torque);
    }
}

/* Elastic energy of every element, half of each of its beams [J] [n]. */
KERNEL void cbm_energy(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                       GLOBAL const coeff *restrict branch, GLOBAL const coeff *restrict inv_length, GLOBAL const coeff *restrict alive,
                       int fracture, GLOBAL const state *restrict displacement, GLOBAL const state *restrict orientation, coeff axial,
                       coeff bend, coeff twist, GLOBAL const coeff *restrict beam_of, GLOBAL state *restrict elastic)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
        const lane_int own = lane_own(group * W);
        const state_vec3 u = state_gather3(displacement, own);
        const lane_quat q = lane_gather4(orientation, own);
        const lane_mat3 turn = quat_matrix_minus_identity(q, 1);
        lane sum = LANE_ZERO;
        for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
            const lane_int j = int_block(neighbour, slot, lane0);
            const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u);
            const lane inverse = lane_load(inv_length, (brc_size)slot * C + (brc_size)lane0);
            const cbm_shape shape = cbm_beam_shape_turned(lane_block3(branch, slot, lane0), inverse, jump, q, turn, lane_gather4(orientation, j), 1);
            const lane whole = fracture ? lane_load(alive, (brc_size)slot * C + (brc_size)lane0) : LANE_ZERO + REAL(1);
            sum += whole * cbm_beam_energy(shape, inverse, cbm_stiffness_of(beam_of, own, j, axial, bend, twist));
        }
        state_store1(elastic, group * W, REAL(0.5) * sum);
    }
}

/* Sum over the beams of x_ij (x) f_ij of every element [J] [n][9]: branch now times the force of the beam on the element. A stress is its
 * symmetric part over twice a volume (NAH19 eq. 5). */
KERNEL void cbm_virial(int n_groups, GLOBAL const int *restrict row_start, GLOBAL const int *restrict neighbour,
                       GLOBAL const coeff *restrict branch, GLOBAL const coeff *restrict inv_length, GLOBAL const coeff *restrict alive,
                       int fracture, GLOBAL const state *restrict displacement, GLOBAL const state *restrict orientation, coeff axial,
                       coeff bend, coeff twist, GLOBAL const coeff *restrict beam_of, GLOBAL coeff *restrict virial)
{
    FOR_EACH_ITEM(group, n_groups) {
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group);
        const lane_int own = lane_own(group * W);
        const state_vec3 u = state_gather3(displacement, own);
        const lane_quat q = lane_gather4(orientation, own);
        const lane_mat3 turn = quat_matrix_minus_identity(q, 1);
        lane_mat3 sum = lane_mat3_zero();
        for (int slot = row_start[slice]; slot < row_start[slice + 1]; ++slot) {
            const lane_int j = int_block(neighbour, slot, lane0);
            const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), u), r = lane_block3(branch, slot, lane0);
            const lane inverse = lane_load(inv_length, (brc_size)slot * C + (brc_size)lane0);
            const cbm_shape shape = cbm_beam_shape_turned(r, inverse, jump, q, turn, lane_gather4(orientation, j), 1);
            const cbm_end end = cbm_beam_law(shape, inverse, cbm_stiffness_of(beam_of, own, j, axial, bend, twist), 1);
            const lane whole = fracture ? lane_load(alive, (brc_size)slot * C + (brc_size)lane0) : LANE_ZERO + REAL(1);
            sum = lane_add_outer(sum, lane_vec3_add(r, jump), lane_vec3_scale(whole, end.force));
        }
        lane_store9(virial, group * W, sum);
    }
}
