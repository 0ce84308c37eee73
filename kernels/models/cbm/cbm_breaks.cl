/* Forces of beams with what fracture asks of them (fracture.cl). */

/* Forces on a group and its virial; only called with a constant `finite`. */
typedef struct {
    cbm_end end;
    lane_sym3 virial;
} cbm_end_virial;
LAW cbm_end_virial cbm_group_force_virial(int group, OWN(int) row_start, OWN(int) neighbour, OWN(coeff) branch,
                                          OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation,
                                          coeff axial, coeff bend, coeff twist, GATHER(coeff) beam_of, int finite)
{
    const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
    const cbm_own own = cbm_own_of(group, displacement, orientation, finite);
    const lane zero = LANE_ZERO;
    cbm_end_virial sum = {{{zero, zero, zero}, {zero, zero, zero}}, {zero, zero, zero, zero, zero, zero}};
    for (int slot = row_start[slice]; slot < last; ++slot) {
        const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement, orientation,
                                          axial, bend, twist, beam_of, finite);
        const cbm_end before = {lane_vec3_zero(), sum.end.torque};
        const cbm_end end = cbm_beam_add(before, bond.shape, bond.inv_length0, bond.stiffness, finite);
        sum.end = (cbm_end){lane_vec3_add(sum.end.force, end.force), end.torque};
        sum.virial = cbm_add_virial(sum.virial, finite ? bond.branch : bond.shape.branch, end.force);
    }
    sum.virial = cbm_virial_of(sum.virial);
    return sum;
}

/* As cbm_force_pass, and the records. shuts: broken beams whose ends bear on each other only push along their axes
 * (beam_closure.cl, no leans), and are added here, where their group is at hand. */
KERNEL void fracture_force(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) branch,
                           OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                           coeff bend, coeff twist, GATHER(coeff) beam_of, coeff inv_tension, coeff inv_compression,
                           coeff inv_shear, int drucker_prager, coeff slope, int finite, int shuts, OWN(int) rubs,
                           OWN(int) other, OWN(int) bears, PUT(state) force, PUT(state) torque, UPDATE(coeff) record,
                           PUT(coeff) stress_bound)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        cbm_ask_ahead(group, displacement, orientation, ahead);
        const int bits = shuts ? rubs[group] : 0;
        cbm_end_virial sum = finite ? cbm_group_force_virial(group, row_start, neighbour, branch, inv_length,
                                                             displacement, orientation, axial, bend, twist, beam_of, 1)
                                    : cbm_group_force_virial(group, row_start, neighbour, branch, inv_length,
                                                             displacement, orientation, axial, bend, twist, beam_of, 0);
        if (bits) {
            const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
            const closure_sum more = closure_sum_of(group, bits, own, row_start, other, bears, branch, displacement,
                                                    orientation, axial, bend, twist, beam_of, 0, branch, branch);
            const lane_sym3 v = cbm_virial_of(more.virial);
            sum.end.force = lane_vec3_add(sum.end.force, more.force);
            sum.virial = (lane_sym3){sum.virial.xx + v.xx, sum.virial.yy + v.yy, sum.virial.zz + v.zz,
                                     sum.virial.yz + v.yz, sum.virial.xz + v.xz, sum.virial.xy + v.xy};
        }
        state_store3(force, group * W, sum.end.force);
        state_store3(torque, group * W, sum.end.torque);
        const failure_scale scale = {inv_tension, inv_compression, inv_shear, drucker_prager, slope};
        fracture_put_record(group, sum.virial, scale, record, stress_bound);
    }
}
