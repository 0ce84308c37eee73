/* Forces of beams with what fracture asks of them (fracture.cl). */

/* As cbm_force_pass with the full law, and the records. */
KERNEL void fracture_force(int n_groups, OWN(int) row_start, OWN(int) neighbour, OWN(int) ahead, OWN(coeff) branch,
                           OWN(coeff) inv_length, GATHER(state) displacement, GATHER(state) orientation, coeff axial,
                           coeff bend, coeff twist, GATHER(coeff) beam_of, coeff inv_tension, coeff inv_compression,
                           coeff inv_shear, int drucker_prager, coeff slope, PUT(state) force, PUT(state) torque,
                           UPDATE(coeff) record, PUT(coeff) stress_bound)
{
    FOR_EACH_GROUP(group, n_groups)
    {
        cbm_ask_ahead(group, displacement, orientation, ahead);
        const int slice = SLICE_OF(group), lane0 = FIRST_LANE_OF(group), last = row_start[slice + 1];
        const cbm_own own = cbm_own_of(group, displacement, orientation, 1);
        const lane zero = LANE_ZERO;
        cbm_end sum = {{zero, zero, zero}, {zero, zero, zero}};
        lane_sym3 virial = {zero, zero, zero, zero, zero, zero};
        for (int slot = row_start[slice]; slot < last; ++slot) {
            const cbm_bond bond = cbm_bond_at(slot, lane0, own, neighbour, branch, inv_length, displacement,
                                              orientation, axial, bend, twist, beam_of, 1);
            const cbm_end before = {lane_vec3_zero(), sum.torque};
            const cbm_end end = cbm_beam_add(before, bond.shape, bond.inv_length0, bond.stiffness, 1);
            sum = (cbm_end){lane_vec3_add(sum.force, end.force), end.torque};
            virial = cbm_add_virial(virial, bond.branch, end.force);
        }
        virial = cbm_virial_of(virial);
        state_store3(force, group * W, sum.force);
        state_store3(torque, group * W, sum.torque);
        const failure_scale scale = {inv_tension, inv_compression, inv_shear, drucker_prager, slope};
        fracture_put_record(group, virial, scale, record, stress_bound);
    }
}
