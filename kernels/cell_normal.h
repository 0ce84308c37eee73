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

/* N.E N [-], E the Green strain of the gradient. */
LAW lane cell_strain_along(lane_mat3 gradient, lane_vec3 branch, lane inverse_square)
{
    const lane_vec3 along = lane_mat3_mul_vec(gradient, branch);
    return inverse_square * (lane_vec3_dot(branch, along) + REAL(0.5) * lane_vec3_dot(along, along));
}

/* tau [Pa] of one side; modulus: lambda + 2 mu [Pa]. */
LAW lane cell_half_stress(lane_mat3 gradient, lane_mat3 stress, lane modulus, lane_vec3 branch, lane strain, lane inverse_square)
{
    const lane own = cell_strain_along(gradient, branch, inverse_square);
    const lane_vec3 now = lane_vec3_add(branch, lane_mat3_mul_vec(gradient, branch));
    const lane stretch = LANE_SQRT(REAL(1) + REAL(2) * own); /* |F_H N| */
    return inverse_square * lane_vec3_dot(now, lane_mat3_mul_vec(stress, branch)) / stretch + modulus * (strain - own);
}

/* At most the stretch (1 + 2 N.E N)^(1/2) of any direction [-]. */
LAW lane cell_least_stretch(lane_mat3 gradient)
{
    const lane_sym3 strain = green_strain(gradient, 1);
    const lane none = LANE_ZERO;
    return LANE_SQRT(cell_larger(REAL(1) - REAL(2) * LANE_SQRT(lane_sym3_dot(strain, strain)), none));
}

/* What an element brings to the room of its bonds: E, and the symmetric part of F_H^T P [Pa], entries off the diagonal twice, so that a bond takes six products of its branch. */
typedef struct {
    lane_sym3 strain, pull;
    lane modulus, least_stretch; /* lambda + 2 mu [Pa], cell_least_stretch */
} cell_side;

LAW cell_side cell_side_of(lane_mat3 gradient, lane_mat3 stress, lane modulus)
{
    const lane_sym3 e = green_strain(gradient, 1), p = lane_mat3_sym(lane_mat3_add(stress, lane_mat3_tmul(gradient, stress)));
    return (cell_side){{e.xx, e.yy, e.zz, REAL(2) * e.yz, REAL(2) * e.xz, REAL(2) * e.xy},
                       {p.xx, p.yy, p.zz, REAL(2) * p.yz, REAL(2) * p.xz, REAL(2) * p.xy}, modulus, cell_least_stretch(gradient)};
}

/* > 0 [N]: the own half of the bond's stress, tau, is below its limit [Pa]; times |R|^2 and the stretch, so that there is neither quotient nor root. A little less, for
 * the rounding of both. Where the bond's own strain alone passes the limit nothing is left, whatever the sign of the rest: the second term, large enough not to count
 * where something is left. Missing bonds (R = 0) have room: 1e-30 m^2, nothing beside any |R|^2, of a limit that is never reached. */
LAW lane cell_room(cell_side own, lane_vec3 branch, lane_vec3 jump, lane limit)
{
    const lane xx = branch.x * branch.x, yy = branch.y * branch.y, zz = branch.z * branch.z;
    const lane yz = branch.y * branch.z, xz = branch.x * branch.z, xy = branch.x * branch.y;
    const lane_sym3 e = own.strain, p = own.pull;
    const lane along = xx * e.xx + yy * e.yy + zz * e.zz + yz * e.yz + xz * e.xz + xy * e.xy;
    const lane pulled = xx * p.xx + yy * p.yy + zz * p.zz + yz * p.yz + xz * p.xz + xy * p.xy;
    const lane strain = lane_vec3_dot(branch, jump) + REAL(0.5) * lane_vec3_dot(jump, jump);
    const lane left = REAL(0.999) * limit * (xx + yy + zz + REAL(1e-30)) - own.modulus * (strain - along);
    return lane_min(own.least_stretch * left - pulled, REAL(1e6) * left);
}

#endif
