/* cbm: spheres joined by beams (NAH19; docs/notebook/beams.md). One pass over elements and their bonds, each element
 * computing its own side of every beam. branch X_j - X_i [slot][3][C] (missing neighbours: any branch home), inv_length
 * 1/|branch| [slot][C] (missing: 0). beam_of [n][3]: E S, 2 E I, G J of each element's beams for several materials (a
 * bond is two half beams in series); else the three scalars. Broken bonds are as missing neighbours (fracture.cl). */

LAW cbm_stiffness cbm_stiffness_of(GATHER(coeff) beam_of, lane_int own, lane_int j, coeff axial, coeff bend,
                                   coeff twist)
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

/* What the elements of a group bring to each of their beams. */
typedef struct {
    lane_int row;
    state_vec3 displacement; /* u [m] */
    lane_quat orientation;
    lane_quat back; /* cbm_back */
    lane_mat3 turn; /* its rotation minus identity [-] */
} cbm_own;

LAW cbm_own cbm_own_of(int group, OWN(state) displacement, OWN(state) orientation, int finite)
{
    const lane_int row = lane_own(group * W);
    const lane_quat q = lane_gather4(orientation, row);
    return (cbm_own){row, state_gather3(displacement, row), q, cbm_back(q), quat_matrix_minus_identity(q, finite)};
}

/* What a group asks for ahead. */
LAW void cbm_ask_ahead(int group, GATHER(state) displacement, GATHER(state) orientation, OWN(int) ahead)
{
    states_later(displacement, 3, ahead, group * W);
    states_later(orientation, 4, ahead, group * W);
}

/* One beam as the group sees it. */
typedef struct {
    cbm_shape shape;
    lane inv_length0; /* [1/m] */
    cbm_stiffness stiffness;
    lane_vec3 branch; /* x_j - x_i now [m] */
} cbm_bond;

/* What the rows of a slot say of the beams in it: neighbour, branch [m], one over its length [1/m]. */
typedef struct {
    lane_int j;
    lane_vec3 branch;
    lane inverse;
} cbm_row;
LAW cbm_row cbm_row_at(int slot, int lane0, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) inv_length)
{
    rows_ahead3(branch, slot);
    rows_ahead1(inv_length, slot);
    return (cbm_row){int_block(neighbour, slot, lane0), lane_block3(branch, slot, lane0),
                     lane_load(inv_length, (brc_size)slot * C + (brc_size)lane0)};
}

/* The beams of a slot. Only called with a constant `finite`. */
LAW cbm_bond cbm_bond_of(cbm_row row, cbm_own own, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                         coeff bend, coeff twist, GATHER(coeff) beam_of, int finite)
{
    const lane_int j = row.j;
    const lane_vec3 jump = state_vec3_difference(state_gather3(displacement, j), own.displacement);
    const cbm_stiffness k = cbm_stiffness_of(beam_of, own.row, j, axial, bend, twist);
    const cbm_shape shape =
        cbm_beam_shape_turned(row.branch, row.inverse, jump, own.back, own.turn, lane_gather4(orientation, j), finite);
    return (cbm_bond){shape, row.inverse, k, lane_vec3_add(row.branch, jump)};
}

LAW cbm_bond cbm_bond_at(int slot, int lane0, cbm_own own, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) inv_length,
                         GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                         GATHER(coeff) beam_of, int finite)
{
    return cbm_bond_of(cbm_row_at(slot, lane0, neighbour, branch, inv_length), own, displacement, orientation, axial,
                       bend, twist, beam_of, finite);
}

/* Sums over the beams of a group; only called with a constant `finite`. */
LAW cbm_end cbm_group_force(int group, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) inv_length,
                            GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                            GATHER(coeff) beam_of, int finite)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
    const cbm_own own = cbm_own_of(group, displacement, orientation, finite);
    cbm_end sum = {{LANE_ZERO, LANE_ZERO, LANE_ZERO}, {LANE_ZERO, LANE_ZERO, LANE_ZERO}};
    cbm_row next = {own.row, {LANE_ZERO, LANE_ZERO, LANE_ZERO}, LANE_ZERO}; /* as dlsm_next_row */
    if (SPLIT_LOOPS && row_start[slice] < last)
        next = cbm_row_at(row_start[slice], lane0, neighbour, branch, inv_length);
    for (int slot = row_start[slice]; slot < last; ++slot) {
        const cbm_row row = SPLIT_LOOPS ? next : cbm_row_at(slot, lane0, neighbour, branch, inv_length);
        if (SPLIT_LOOPS) next = cbm_row_at(slot + 1 < last ? slot + 1 : slot, lane0, neighbour, branch, inv_length);
        const cbm_bond bond = cbm_bond_of(row, own, displacement, orientation, axial, bend, twist, beam_of, finite);
        sum = cbm_beam_add(sum, bond.shape, bond.inv_length0, bond.stiffness, finite);
    }
    return sum;
}

/* Force [N] and torque about its own centre [N m] on every element [n][3]. orientation: unit quaternions (w x y z)
 * [n][4]. */
KERNEL void cbm_force_pass(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) branch,
                           OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                           coeff bend, coeff twist, GATHER(coeff) beam_of, int finite, PUT(state) force,
                           PUT(state) torque)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        cbm_ask_ahead(group, displacement, orientation, ahead);
        const cbm_end sum = finite ? cbm_group_force(group, row_start, neighbour, branch, inv_length, displacement,
                                                     orientation, axial, bend, twist, beam_of, 1)
                                   : cbm_group_force(group, row_start, neighbour, branch, inv_length, displacement,
                                                     orientation, axial, bend, twist, beam_of, 0);
        state_store3(force, group * W, sum.force);
        state_store3(torque, group * W, sum.torque);
    }
}

/* Energies of the beams of a group [J], and their virials (cbm_add_virial); only called with a constant `finite`. */
LAW lane cbm_group_energy(int group, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch, OWN(coeff) inv_length,
                          GATHER(state) displacement, GATHER(state) orientation, coeff axial, coeff bend, coeff twist,
                          GATHER(coeff) beam_of, int finite)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
    const cbm_own own = cbm_own_of(group, displacement, orientation, finite);
    lane sum = LANE_ZERO;
    for (int slot = row_start[slice]; slot < last; ++slot) {
        const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement, orientation,
                                          axial, bend, twist, beam_of, finite);
        sum += cbm_beam_energy(bond.shape, bond.inv_length0, bond.stiffness, finite);
    }
    return sum;
}
LAW lane_sym3 cbm_group_virial(int group, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                               OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation,
                               coeff axial, coeff bend, coeff twist, GATHER(coeff) beam_of, int finite)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
    const cbm_own own = cbm_own_of(group, displacement, orientation, finite);
    lane_sym3 sum = {LANE_ZERO, LANE_ZERO, LANE_ZERO, LANE_ZERO, LANE_ZERO, LANE_ZERO};
    for (int slot = row_start[slice]; slot < last; ++slot) {
        const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement, orientation,
                                          axial, bend, twist, beam_of, finite);
        const cbm_end end = cbm_beam_law(bond.shape, bond.inv_length0, bond.stiffness, finite);
        sum = cbm_add_virial(sum, finite ? bond.branch : bond.shape.branch, end.force);
    }
    return cbm_virial_of(sum);
}

/* Elastic energy of every element, half of each of its beams [J] [n]. */
KERNEL void cbm_energy(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) branch,
                       OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                       coeff bend, coeff twist, GATHER(coeff) beam_of, int finite, PUT(state) elastic)
{
    FOR_EACH_ITEM(group, n_groups) {
        cbm_ask_ahead(group, displacement, orientation, ahead);
        const lane sum = finite ? cbm_group_energy(group, row_start, neighbour, branch, inv_length, displacement,
                                                   orientation, axial, bend, twist, beam_of, 1)
                                : cbm_group_energy(group, row_start, neighbour, branch, inv_length, displacement,
                                                   orientation, axial, bend, twist, beam_of, 0);
        state_store1(elastic, group * W, REAL(0.5) * sum);
    }
}

/* Virial of every element [J] [n][6] xx yy zz yz xz xy (cbm_add_virial, summed over its beams). A stress is that over
 * twice a volume (NAH19 eq. 5). */
KERNEL void cbm_virial(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) branch,
                       OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                       coeff bend, coeff twist, GATHER(coeff) beam_of, int finite, PUT(coeff) virial)
{
    FOR_EACH_ITEM(group, n_groups) {
        cbm_ask_ahead(group, displacement, orientation, ahead);
        const lane_sym3 whole = finite ? cbm_group_virial(group, row_start, neighbour, branch, inv_length, displacement,
                                                          orientation, axial, bend, twist, beam_of, 1)
                                       : cbm_group_virial(group, row_start, neighbour, branch, inv_length, displacement,
                                                          orientation, axial, bend, twist, beam_of, 0);
        lane_store6(virial, group * W, whole);
    }
}
