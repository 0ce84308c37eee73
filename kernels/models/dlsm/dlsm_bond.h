/* dlsm: force and energy of one bond (docs/notebook/theory.md T2, fourth pass). */
#ifndef BRC_KERNELS_DLSM_BOND_H
#define BRC_KERNELS_DLSM_BOND_H

#include "../../core/vec.h"

/* Force on element i [N]: (B_i + B_j) s + (k (1 + tau) / q) (u_j - u_i); spring: k (1 + tau) [Pa]; ratio q = L/S
 * [1/m]. */
LAW lane_vec3 dlsm_bond_force(lane_mat3 flux_sum, lane_vec3 area, lane spring, lane ratio, lane_vec3 jump)
{
    return lane_vec3_add(lane_mat3_mul_vec(flux_sum, area), lane_vec3_scale(spring / ratio, jump));
}

/* Energy [J] of a bond: (k/q) [ (1 + tau)/2 |r|^2 + beta r.m ]; residual r, compact m [m]. */
LAW lane dlsm_residual_energy(lane_vec3 residual, lane_vec3 compact, lane ratio, lane k, coeff beta, coeff one_plus_tau)
{
    return (k / ratio) *
           (REAL(0.5) * one_plus_tau * lane_vec3_dot(residual, residual) + beta * lane_vec3_dot(residual, compact));
}

/* The same; gradient_mean (H_i + H_j)/2, compaction_mean (M_i + M_j)/2. */
LAW lane dlsm_bond_energy(lane_vec3 jump, lane_mat3 gradient_mean, lane_mat3 compaction_mean, lane_vec3 area,
                          lane ratio, lane k, coeff beta, coeff one_plus_tau)
{
    const lane_vec3 branch = lane_vec3_scale(ratio, area);
    const lane_vec3 residual = lane_vec3_sub(jump, lane_mat3_mul_vec(gradient_mean, branch));
    return dlsm_residual_energy(residual, lane_mat3_mul_vec(compaction_mean, branch), ratio, k, beta, one_plus_tau);
}

#endif
