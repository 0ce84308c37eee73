/* dlsm: the cross term that makes the shear response compact (docs/notebook/theory.md T2).
 *   M = F_H S_c,  S_c = E_H + ell tr(E_H) I,  ell = lambda_c / (2 mu_c),  F_H = I + H
 * with mu_c = min(mu, 3 K), K_c = min(K, 2 mu / 3), lambda_c = K_c - 2 mu_c / 3: ell = 0 for nu >= 0. */
#ifndef BRC_KERNELS_DLSM_COMPACTION_H
#define BRC_KERNELS_DLSM_COMPACTION_H

#include "elastic_svk.h"

/* S_c [-] of a Green strain [-]. */
LAW lane_sym3 dlsm_compaction_strain(lane_sym3 strain, lane ell)
{
    const lane k = LANE_ZERO + REAL(1);
    return lane_sym3_scale_shift(k, strain, ell * lane_sym3_trace(strain));
}

/* M [-] of a least-squares gradient H [-]. */
LAW lane_mat3 dlsm_compaction(lane_mat3 gradient, lane ell, int finite)
{
    return push_forward(gradient, dlsm_compaction_strain(green_strain(gradient, finite), ell), finite);
}

/* E x [unit of x], from H x. */
LAW lane_vec3 dlsm_strain_along(lane_mat3 gradient, lane_vec3 along, lane_vec3 x, int finite)
{
    const lane_vec3 t = finite ? lane_vec3_add(x, along) : x;
    const lane_vec3 back = lane_mat3_mul_vec(lane_mat3_transpose(gradient), t);
    return (lane_vec3){REAL(0.5) * (along.x + back.x), REAL(0.5) * (along.y + back.y), REAL(0.5) * (along.z + back.z)};
}

/* M x [unit of x], from H x, without forming M: with t = x + H x (x when linearised), E x = (H x + H^T t)/2 and
 * M x = y + H y, y = S_c x. Half the work of dlsm_compaction for a gradient used once. */
LAW lane_vec3 dlsm_compaction_along(lane_mat3 gradient, lane_vec3 along, lane_vec3 x, lane ell, int finite)
{
    const lane_vec3 e_x = dlsm_strain_along(gradient, along, x, finite);
    lane trace = gradient.xx + gradient.yy + gradient.zz;
    if (finite)
        trace += REAL(0.5) * (gradient.xx * gradient.xx + gradient.xy * gradient.xy + gradient.xz * gradient.xz +
                              gradient.yx * gradient.yx + gradient.yy * gradient.yy + gradient.yz * gradient.yz +
                              gradient.zx * gradient.zx + gradient.zy * gradient.zy + gradient.zz * gradient.zz);
    const lane shift = ell * trace;
    const lane_vec3 y = {e_x.x + shift * x.x, e_x.y + shift * x.y, e_x.z + shift * x.z};
    return finite ? lane_vec3_add(y, lane_mat3_mul_vec(gradient, y)) : y;
}
/* The same where ell is 0, as of every nu >= 0. */
LAW lane_vec3 dlsm_compaction_along_plain(lane_mat3 gradient, lane_vec3 along, lane_vec3 x, int finite)
{
    const lane_vec3 y = dlsm_strain_along(gradient, along, x, finite);
    return finite ? lane_vec3_add(y, lane_mat3_mul_vec(gradient, y)) : y;
}

/* Derivative of T : M with respect to H: T S_c + F_H (Y + ell tr(Y) I), Y = sym(F_H^T T) [unit of T]. */
LAW lane_mat3 dlsm_compaction_adjoint(lane_mat3 gradient, lane_mat3 t, lane ell, int finite)
{
    const lane_mat3 pulled = finite ? lane_mat3_add(t, lane_mat3_tmul(gradient, t)) : t;
    const lane_sym3 y = dlsm_compaction_strain(lane_mat3_sym(pulled), ell);
    const lane_mat3 second = push_forward(gradient, y, finite);
    if (!finite) return second;
    const lane_sym3 s = dlsm_compaction_strain(green_strain(gradient, finite), ell);
    return lane_mat3_add(lane_mat3_mul_sym(t, s), second);
}

#endif
