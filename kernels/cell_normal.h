/* dlsm: the normal stress of a bond between two cells (AGH19 eq. 35: the mean stress of its elements with the bond's own elongation in the
 * place of theirs), in a form that no rotation changes:
 *     sigma = (tau_i + tau_j) / 2,   tau_i = n.(P_i N) + (lambda_i + 2 mu_i) (e - N.E_i N)
 * e = (l^2 - L^2) / (2 L^2): the bond's own strain; E_i: Green strain of H_i; N = R / L; n: direction of F_H R. In a uniform state e - N.E N
 * vanishes and sigma is the nominal stress, force over undeformed area. Both halves are even in R, so the two sides of a bond agree. */
#ifndef BRC_KERNELS_CELL_NORMAL_H
#define BRC_KERNELS_CELL_NORMAL_H

#include "elastic_svk.h"

LAW lane cell_larger(lane a, lane b) { return -lane_min(-a, -b); }

/* 1 / |R|^2 [1/m^2]; of a missing bond (R = 0) some number that keeps what is multiplied with R finite. */
LAW lane cell_inverse_square(lane_vec3 branch) { return REAL(1) / (lane_vec3_dot(branch, branch) + REAL(1e-30)); }

/* e [-] of a bond. jump: u_j - u_i [m]. */
LAW lane cell_bond_strain(lane_vec3 branch, lane_vec3 jump, lane inverse_square)
{
    return inverse_square * (lane_vec3_dot(branch, jump) + REAL(0.5) * lane_vec3_dot(jump, jump));
}

/* e - N.E N [-]: what the gradient of one side does not explain. */
LAW lane cell_misfit(lane_mat3 gradient, lane_vec3 branch, lane strain, lane inverse_square)
{
    const lane_vec3 along = lane_mat3_mul_vec(gradient, branch);
    return strain - inverse_square * (lane_vec3_dot(branch, along) + REAL(0.5) * lane_vec3_dot(along, along));
}

/* tau [Pa] of one side; modulus: lambda + 2 mu [Pa]. */
LAW lane cell_half_stress(lane_mat3 gradient, lane_mat3 stress, lane modulus, lane_vec3 branch, lane strain, lane inverse_square)
{
    const lane misfit = cell_misfit(gradient, branch, strain, inverse_square);
    const lane_vec3 now = lane_vec3_add(branch, lane_mat3_mul_vec(gradient, branch));
    const lane stretch = LANE_SQRT(REAL(1) + REAL(2) * (strain - misfit)); /* |F_H N| */
    return inverse_square * lane_vec3_dot(now, lane_mat3_mul_vec(stress, branch)) / stretch + modulus * misfit;
}

/* > 0: no direction of branch has a tau of `limit` [Pa] or more; misfit: the largest of the element's bonds, in size. n.(P N) is
 * N.(F_H^T P N) over the stretch, which is at least sqrt(1 - 2 |E|). Leaves a little room for its own rounding. */
LAW lane cell_spare(lane_mat3 gradient, lane_mat3 stress, lane modulus, lane misfit, lane limit)
{
    const lane_sym3 pulled = lane_mat3_sym(lane_mat3_add(stress, lane_mat3_tmul(gradient, stress)));
    const lane_sym3 strain = green_strain(gradient, 1);
    const lane none = LANE_ZERO;
    const lane square = cell_larger(REAL(1) - REAL(2) * LANE_SQRT(lane_sym3_dot(strain, strain)), none);
    const lane room = (REAL(0.999) * limit - modulus * misfit) * LANE_SQRT(square);
    const lane a = room - pulled.xx, b = room - pulled.yy, c = room - pulled.zz;
    const lane minor = a * b - pulled.xy * pulled.xy;
    const lane det = c * minor - pulled.yz * (a * pulled.yz + pulled.xy * pulled.xz) - pulled.xz * (pulled.xy * pulled.yz + pulled.xz * b);
    return lane_min(lane_min(room, a), lane_min(minor, det));
}

#endif
