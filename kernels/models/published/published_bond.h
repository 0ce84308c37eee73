/* dlsm-published: the law of AGH19 as printed, with the corrections listed in docs/notebook/theory.md T3.
 * Frames: an element's strain is found in its own frame (rotation R_i from its quaternion) and turned to the global
 * frame; bonds work in the global frame. finite: 1 as published; 0 the linearisation, in which a quaternion's vector
 * part is half a small rotation vector. */
#ifndef BRC_KERNELS_PUBLISHED_BOND_H
#define BRC_KERNELS_PUBLISHED_BOND_H

#include "../../core/quaternion.h"

/* Strain in the global frame [-] (AGH19 eq. 5-15): least squares of d_j = R_i^T (branch + jump) - branch over the
 * directions that the branches span, with the projector P on these, gives H = R^T a A^-1 + (R^T - I) P with a = sum
 * jump (x) w branch. fitted: a A^-1 [-]; turn: R^T - I; seen: (R^T - I) P. */
LAW lane_sym3 published_strain_seen(lane_mat3 fitted, lane_mat3 turn, lane_mat3 seen, int finite)
{
    if (!finite) return lane_mat3_sym(lane_mat3_add(fitted, seen));
    const lane_mat3 turned = lane_mat3_add(lane_mat3_add(fitted, lane_mat3_mul(turn, fitted)), seen);
    const lane_sym3 e = lane_mat3_sym(turned);
    /* R e R^T */
    const lane_mat3 er = lane_mat3_mul((lane_mat3){e.xx, e.xy, e.xz, e.xy, e.yy, e.yz, e.xz, e.yz, e.zz}, turn);
    const lane_mat3 right = lane_mat3_add((lane_mat3){e.xx, e.xy, e.xz, e.xy, e.yy, e.yz, e.xz, e.yz, e.zz}, er);
    return lane_mat3_sym(lane_mat3_add(right, lane_mat3_tmul(turn, right)));
}

/* The same of branches that span space. */
LAW lane_sym3 published_strain(lane_mat3 fitted, lane_quat q, int finite)
{
    const lane_mat3 turn = quat_matrix_minus_identity(quat_conjugate(q), finite);
    return published_strain_seen(fitted, turn, turn, finite);
}

/* Rotation vector [rad] of a unit quaternion with w > 0: with t = tan(angle/4) = |v|/(1 + w), angle = 4 atan t. Up to
 * 90 degrees t <= 0.414, where seventeen terms of the series leave 3e-15; no square root, one division. */
LAW lane_vec3 quat_rotation_vector(lane_quat q, int finite)
{
    const lane_vec3 v = quat_vector(q);
    const lane two = LANE_ZERO + REAL(2);
    if (!finite) return lane_vec3_scale(two, v);
    const lane factor = REAL(1) / (REAL(1) + q.w);
    const lane t = -factor * factor * lane_vec3_dot(v, v);
    lane series = LANE_ZERO + REAL(1.0 / 33);
    series = series * t + REAL(1.0 / 31);
    series = series * t + REAL(1.0 / 29);
    series = series * t + REAL(1.0 / 27);
    series = series * t + REAL(1.0 / 25);
    series = series * t + REAL(1.0 / 23);
    series = series * t + REAL(1.0 / 21);
    series = series * t + REAL(1.0 / 19);
    series = series * t + REAL(1.0 / 17);
    series = series * t + REAL(1.0 / 15);
    series = series * t + REAL(1.0 / 13);
    series = series * t + REAL(1.0 / 11);
    series = series * t + REAL(1.0 / 9);
    series = series * t + REAL(1.0 / 7);
    series = series * t + REAL(1.0 / 5);
    series = series * t + REAL(1.0 / 3);
    series = series * t + REAL(1);
    return lane_vec3_scale(REAL(4) * factor * series, v);
}

/* What a bond does to element i. */
typedef struct {
    lane_vec3 force;  /* [N] */
    lane_vec3 torque; /* about its own centre [N m] */
    lane stress;      /* normal to the bond, n . sigma n, with which it may break (AGH19 eq. 35) [Pa] */
} published_bond;

/* branch, jump: reference branch and u_j - u_i [m]; area: S [m^2]; strain: mean of the two ends, global frame [-];
 * turn: rotation vector of j relative to i [rad]; young [Pa], rotation_factor: on K = E S^2 / (4 pi L0) (the
 * printed K = E L0 is N/m). AGH19 eq. 16-34. */
LAW published_bond published_bond_law(lane_vec3 branch, lane_vec3 jump, lane area, lane_sym3 strain, lane_vec3 turn,
                                      lane lambda, lane mu, lane young, coeff rotation_factor, int finite)
{
    const lane length0 = LANE_SQRT(lane_vec3_dot(branch, branch));
    const lane_vec3 now = finite ? lane_vec3_add(branch, jump) : branch;
    const lane length = finite ? LANE_SQRT(lane_vec3_dot(now, now)) : length0;
    const lane_vec3 n = lane_vec3_scale(REAL(1) / length, now);
    /* (L - L0)/L0 = (L^2 - L0^2) / (L0 (L + L0)), without cancellation */
    const lane stretch =
        finite ? (REAL(2) * lane_vec3_dot(branch, jump) + lane_vec3_dot(jump, jump)) / (length0 * (length + length0))
               : lane_vec3_dot(n, jump) / length0;
    const lane_vec3 en = lane_sym3_mul_vec(strain, n);
    const lane along = lane_vec3_dot(en, n), correction = stretch - along;
    const lane normal = REAL(2) * mu * correction + lambda * (lane_sym3_trace(strain) + correction);
    const lane_vec3 f =
        lane_vec3_scale(area, lane_vec3_add(lane_vec3_scale(REAL(2) * mu, en), lane_vec3_scale(normal, n)));
    const lane stiffness =
        REAL(0.0795774715459476678844) * rotation_factor * young * area * area / length0; /* 1/(4 pi) */
    const lane one_half = LANE_ZERO + REAL(0.5);
    return (published_bond){
        f, lane_vec3_add(lane_vec3_cross(lane_vec3_scale(one_half, now), f), lane_vec3_scale(stiffness, turn)),
        REAL(2) * mu * along + normal};
}

/* Shear of a bond against the frames of its two elements, beyond that of their mean strain [-]: (R + u_j - u_i) / L0 -
 * (I + e) m across the bond, with m the mean of R_i N and R_j N. Zero where displacements are linear and frames turn
 * with them. AGH19 has no such term (docs/notebook/theory.md T3): its bonds do not see how far frames lag behind the
 * solid. */
LAW lane_vec3 published_lag(lane_vec3 branch, lane_vec3 jump, lane_sym3 strain, lane_quat q_i, lane_quat q_j,
                            int finite)
{
    const lane inverse = REAL(1) / LANE_SQRT(lane_vec3_dot(branch, branch));
    const lane_vec3 normal = lane_vec3_scale(inverse, branch), now = finite ? lane_vec3_add(branch, jump) : branch;
    const lane_vec3 both =
        lane_vec3_add(quat_rotate_minus_identity(q_i, normal, finite), quat_rotate_minus_identity(q_j, normal, finite));
    const lane_vec3 turned = lane_vec3_scale(LANE_ZERO + REAL(0.5), both),
                    frame = finite ? lane_vec3_add(normal, turned) : normal;
    const lane_vec3 lag =
        lane_vec3_sub(lane_vec3_scale(inverse, jump), lane_vec3_add(turned, lane_sym3_mul_vec(strain, frame)));
    return lane_vec3_sub(lag, lane_vec3_scale(lane_vec3_dot(lag, now) / lane_vec3_dot(now, now), now));
}

/* b and what a couple modulus adds, as in micropolar solids: 2 stiffness times the lag, in the middle of the bond.
 * stiffness: couple modulus times area [N]. */
LAW published_bond published_coupled(published_bond b, lane_vec3 branch, lane_vec3 jump, lane stiffness,
                                     lane_sym3 strain, lane_quat q_i, lane_quat q_j, int finite)
{
    const lane_vec3 f = lane_vec3_scale(REAL(2) * stiffness, published_lag(branch, jump, strain, q_i, q_j, finite));
    const lane_vec3 arm = lane_vec3_scale(LANE_ZERO + REAL(0.5), finite ? lane_vec3_add(branch, jump) : branch);
    return (published_bond){lane_vec3_add(b.force, f), lane_vec3_add(b.torque, lane_vec3_cross(arm, f)), b.stress};
}

#endif
