/* What criteria of elements ask of dlsm (cell_criteria.cl). */

/* Records of dlsm, of H and P as they stand. */
KERNEL void cells_record(int n_groups, OWN(coeff) gradient, OWN(coeff) stress, coeff inv_tension, coeff inv_compression,
                         coeff inv_shear, int drucker_prager, coeff slope, UPDATE(coeff) record,
                         PUT(coeff) stress_bound)
{
    FOR_EACH_ITEM(group, n_groups) {
        const failure_scale scale = {inv_tension, inv_compression, inv_shear, drucker_prager, slope};
        const lane_int own = lane_own(group * W);
        const lane_sym3 cauchy = cells_cauchy(lane_gather9(gradient, own), lane_gather9(stress, own));
        cells_put_record(group, cauchy, scale, record, stress_bound);
    }
}
