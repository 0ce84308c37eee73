/* dlsm: what one bond adds to the sums behind the two displacement gradients of an element
 * (docs/notebook/theory.md T2: least squares H, divergence theorem G; the first two passes). */
#ifndef BRC_KERNELS_DLSM_GRADIENT_H
#define BRC_KERNELS_DLSM_GRADIENT_H

#include "../../core/vec.h"

/* a = sum_j (u_j - u_i) (x) s [m^3]; jump: u_j - u_i [m]; area: area vector s of the face, from i to j [m^2]. */
LAW lane_mat3 dlsm_add_jump(lane_mat3 a, lane_vec3 jump, lane_vec3 area) { return lane_add_outer(a, jump, area); }

/* sum_j ((H_j - H_i) d) (x) s [m^3]; offset: d = C - (X_i + X_j)/2, from the middle of the branch to the face's
 * centroid [m], with several materials times the neighbour's part in it (dlsm_flux.h). */
LAW lane_mat3 dlsm_add_offset(lane_mat3 sum, lane_mat3 gradient_difference, lane_vec3 offset, lane_vec3 area)
{
    return lane_add_outer(sum, lane_mat3_mul_vec(gradient_difference, offset), area);
}

/* G = H_i + offset_sum / (2 V_i) [-]. The divergence theorem over the cell's closed surface, sum S (C - X) (x) N = V I,
 * takes the place of face moments Z and A: docs/notebook/theory.md T2. */
LAW lane_mat3 dlsm_divergence_gradient(lane_mat3 gradient, lane_mat3 offset_sum, lane inv_volume)
{
    return lane_mat3_add(gradient, lane_mat3_scale(REAL(0.5) * inv_volume, offset_sum));
}

#endif
