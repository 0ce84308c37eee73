/* dlsm: the normal stress of a bond between two cells (AGH19 eq. 35: the mean stress of its elements with the bond's
 * own elongation in the place of theirs), in a form that no rotation changes:
 *     sigma = (tau_i + tau_j) / 2,   tau_i = n.(P_i N) + (lambda_i + 2 mu_i) (e - N.E_i N)
 * e = (l^2 - L^2) / (2 L^2): the bond's own strain; E_i: Green strain of H_i; N = R / L; n: direction of F_H R. In a
 * uniform state e - N.E N vanishes and sigma is the nominal stress, force over undeformed area. Both halves are even in
 * R, so the two sides of a bond agree. finite: 1 as above; 0 the linearisation, which no small turn changes. */
#ifndef BRC_KERNELS_CELL_NORMAL_H
#define BRC_KERNELS_CELL_NORMAL_H

#include "elastic_svk.h"

LAW lane cell_larger(lane a, lane b) { return -lane_min(-a, -b); }

/* 1 / |R|^2 [1/m^2]; of a missing bond (R = 0) some number that keeps what is multiplied with R finite. */
LAW lane cell_inverse_square(lane_vec3 branch) { return REAL(1) / (lane_vec3_dot(branch, branch) + REAL(1e-30)); }

/* e [-] of a bond. jump: u_j - u_i [m]. */
LAW lane cell_bond_strain(lane_vec3 branch, lane_vec3 jump, lane inverse_square, int finite)
{
    const lane along = lane_vec3_dot(branch, jump);
    return inverse_square * (finite ? along + REAL(0.5) * lane_vec3_dot(jump, jump) : along);
}

/* N.E N [-], E the Green strain of the gradient: that of a bond whose jump is H R. */
LAW lane cell_strain_along(lane_mat3 gradient, lane_vec3 branch, lane inverse_square, int finite)
{
    return cell_bond_strain(branch, lane_mat3_mul_vec(gradient, branch), inverse_square, finite);
}

/* tau [Pa] of one side; modulus: lambda + 2 mu [Pa]. */
LAW lane cell_half_stress(lane_mat3 gradient, lane_mat3 stress, lane modulus, lane_vec3 branch, lane strain,
                          lane inverse_square, int finite)
{
    const lane own = cell_strain_along(gradient, branch, inverse_square, finite);
    if (!finite)
        return inverse_square * lane_vec3_dot(branch, lane_mat3_mul_vec(stress, branch)) + modulus * (strain - own);
    const lane_vec3 now = lane_vec3_add(branch, lane_mat3_mul_vec(gradient, branch));
    const lane stretch = LANE_SQRT(REAL(1) + REAL(2) * own); /* |F_H N| */
    return inverse_square * lane_vec3_dot(now, lane_mat3_mul_vec(stress, branch)) / stretch + modulus * (strain - own);
}

/* At most the stretch (1 + 2 N.E N)^(1/2) of any direction [-], E a Green strain. */
LAW lane cell_least_stretch(lane_sym3 strain)
{
    const lane none = LANE_ZERO;
    return LANE_SQRT(cell_larger(REAL(1) - REAL(2) * LANE_SQRT(lane_sym3_dot(strain, strain)), none));
}

/* What an element brings to the room of its bonds, over the share of a limit that rounding may take: the quadratic form
 * (lambda + 2 mu) E - sym(F_H^T P) - loss 1 of a branch [Pa], entries off the diagonal twice, so that a bond takes six
 * products of its branch, and lambda + 2 mu [Pa]. */
typedef struct {
    lane_sym3 form;
    lane modulus;
} cell_side;

/* The pull R.sym(F_H^T P) R of a half over the stretch differs from the pull by loss |R|^2 at most, loss = |sym(F_H^T
 * P)| (1/stretch - 1) with the least stretch; elements pressed to nothing have some stretch left. */
LAW cell_side cell_side_of(lane_mat3 gradient, lane_mat3 stress, lane modulus)
{
    const lane_sym3 e = green_strain(gradient, 1),
                    p = lane_mat3_sym(lane_mat3_add(stress, lane_mat3_tmul(gradient, stress)));
    const lane loss = LANE_SQRT(lane_sym3_dot(p, p)) *
                      (REAL(1) / cell_larger(cell_least_stretch(e), LANE_ZERO + REAL(1e-6)) - REAL(1));
    const lane per = LANE_ZERO + REAL(1 / 0.999), m = per * modulus, off = REAL(2) * per, twice = REAL(2) * m;
    return (cell_side){{m * e.xx - per * (p.xx + loss), m * e.yy - per * (p.yy + loss), m * e.zz - per * (p.zz + loss),
                        twice * e.yz - off * p.yz, twice * e.xz - off * p.xz, twice * e.xy - off * p.xy},
                       m};
}

/* >= 0 [N]: the own half of the bond's stress, tau, is below its limit [Pa]; times |R|^2, so that there is neither
 * quotient nor root, and a little less, for the rounding of both. Missing bonds (R = 0) have no room to lose: 0. */
LAW lane cell_room(cell_side own, lane_vec3 branch, lane_vec3 jump, lane limit)
{
    const lane xx = branch.x * branch.x, yy = branch.y * branch.y, zz = branch.z * branch.z;
    const lane yz = branch.y * branch.z, xz = branch.x * branch.z, xy = branch.x * branch.y;
    const lane_sym3 k = own.form;
    const lane_vec3 mean = {branch.x + REAL(0.5) * jump.x, branch.y + REAL(0.5) * jump.y,
                            branch.z + REAL(0.5) * jump.z}; /* of the branch before and now */
    return limit * (xx + yy + zz) + (xx * k.xx + yy * k.yy + zz * k.zz + yz * k.yz + xz * k.xz + xy * k.xy) -
           own.modulus * lane_vec3_dot(mean, jump);
}

#endif
