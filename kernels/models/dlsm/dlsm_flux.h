/* dlsm: the tensor B of an element whose sum over the two ends, times the area vector, is the bond force
 * (docs/notebook/theory.md T2, third pass): B = Q A^-1 [Pa], with one material plus k (1 + tau) times the bond part.
 * The stress term of Q is that of G = H + sum (H_j - H_i) d (x) s / (2 V): no face moments are stored or read
 * (docs/notebook/theory.md T2). Several materials: a bond takes the softer of its two stabilisation moduli, k_ij =
 * min(k_i, k_j), for both terms of its energy, and the centroid of its face follows the stiffer of its two cells: the
 * offset of a half-edge is 2 k_j / (k_i + k_j) d, that of its twin k_i / k_j times as long. */
#ifndef BRC_KERNELS_DLSM_FLUX_H
#define BRC_KERNELS_DLSM_FLUX_H

#include "dlsm_compaction.h"

/* Sums over the bonds of an element. */
typedef struct {
    lane_mat3 rs; /* sum c r (x) s [m^3]; c = k_ij / k_i, 1 with one material */
    lane_mat3 ms; /* sum c m (x) s [m^3] */
    lane_mat3 q;  /* sum (P_i + (k_i / k_j) P_j) s (x) offset / 2 [N m] */
} dlsm_flux_sums;

/* With one material, what stands for r = (u_j - u_i) - (H_i + H_j)/2 R in sum r (x) s [m] is (H_i - H_j) R / 2: the sum
 * of (u_j - u_i) (x) s is H_i A_i = sum (H_i R) (x) s. */

LAW dlsm_flux_sums dlsm_flux_add_bond(dlsm_flux_sums sums, lane_vec3 residual, lane_vec3 compact, lane_vec3 area)
{
    sums.rs = lane_add_outer(sums.rs, residual, area);
    sums.ms = lane_add_outer(sums.ms, compact, area);
    return sums;
}

LAW dlsm_flux_sums dlsm_flux_add_stress(dlsm_flux_sums sums, lane_mat3 stress_sum, lane_vec3 area, lane_vec3 offset)
{
    const lane_vec3 half_offset = {REAL(0.5) * offset.x, REAL(0.5) * offset.y, REAL(0.5) * offset.z};
    sums.q = lane_add_outer(sums.q, lane_mat3_mul_vec(stress_sum, area), half_offset);
    return sums;
}

/* What the stabilisation adds to Q = V P - q - direct + adjoint [N m]: (k/2) [ (1 + tau) rs + beta ms ], and the
 * adjoint of M on T = (beta k / 2) rs. What face loads add is up to the loop. k: stabilisation modulus [Pa]. */
typedef struct {
    lane_mat3 direct, adjoint;
} dlsm_flux_couples;
LAW dlsm_flux_couples dlsm_flux_couple(lane_mat3 gradient, dlsm_flux_sums sums, lane k, coeff beta, coeff one_plus_tau,
                                       lane ell, int finite)
{
    const lane half_k = REAL(0.5) * k;
    const lane_mat3 t = lane_mat3_scale(half_k * beta, sums.rs);
    const lane_mat3 direct =
        lane_mat3_add(lane_mat3_scale(half_k * one_plus_tau, sums.rs), lane_mat3_scale(half_k * beta, sums.ms));
    return (dlsm_flux_couples){direct, dlsm_compaction_adjoint(gradient, t, ell, finite)};
}
LAW lane_mat3 dlsm_flux_own(lane_mat3 stress, lane volume, lane_mat3 q) /* V P - q */
{
    return lane_mat3_sub(lane_mat3_scale(volume, stress), q);
}
LAW lane_mat3 dlsm_flux_moment(lane_mat3 own, dlsm_flux_couples couples)
{
    return lane_mat3_add(lane_mat3_sub(own, couples.direct), couples.adjoint);
}

/* [beta/(1 + tau) M - H] / 2 [-]: the bond terms of B over the spring k (1 + tau). The factor of H is exact and the
 * spring is the product that multiplies u_j - u_i too, so that the two cancel in a turned body to the rounding of each
 * bond, not by the rounding of a constant, which all bonds would share: that would turn a spinning body
 * (docs/notebook/theory.md T8). */
LAW lane_mat3 dlsm_flux_bond_part(lane_mat3 gradient, lane_mat3 compaction, coeff beta, coeff one_plus_tau)
{
    const lane for_compaction = LANE_ZERO + REAL(0.5) * (beta / one_plus_tau), for_gradient = LANE_ZERO + REAL(0.5);
    return lane_mat3_sub(lane_mat3_scale(for_compaction, compaction), lane_mat3_scale(for_gradient, gradient));
}

#endif
