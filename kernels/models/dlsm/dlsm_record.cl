/* What criteria of elements ask of dlsm (cell_criteria.cl). */

/* Records of dlsm, of H and P as they stand; of the linearised law P is the Cauchy stress. */
KERNEL void cells_record(int n_groups, OWN(coeff) gradient, OWN(coeff) stress, coeff inv_tension, coeff inv_compression,
                         coeff inv_shear, int drucker_prager, coeff slope, int finite, UPDATE(coeff) record,
                         PUT(coeff) stress_bound)
{
    FOR_EACH_ITEM(group, n_groups) {
        const failure_scale scale = {inv_tension, inv_compression, inv_shear, drucker_prager, slope};
        const lane_int own = lane_own(group * W);
        const lane_mat3 p = lane_gather9(stress, own);
        const lane_sym3 cauchy = finite ? cells_cauchy(lane_gather9(gradient, own), p) : lane_mat3_sym(p);
        cells_put_record(group, cauchy, scale, record, stress_bound);
    }
}
