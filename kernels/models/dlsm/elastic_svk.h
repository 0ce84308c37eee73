/* St. Venant-Kirchhoff elasticity from the displacement gradient G = F - I (docs/notebook/theory.md T1):
 *   E = (G + G^T + G^T G)/2,  psi = lambda/2 (tr E)^2 + mu E:E,  Sigma = lambda tr E I + 2 mu E,  P = F Sigma.
 * finite: 1 for the full law, 0 for its linearisation (E = sym G, P = Sigma); strain is never formed as F - I. */
#ifndef BRC_KERNELS_ELASTIC_SVK_H
#define BRC_KERNELS_ELASTIC_SVK_H

#include "../../core/vec.h"

/* Green strain [-] of a displacement gradient [-]. */
LAW lane_sym3 green_strain(lane_mat3 g, int finite)
{
    lane_sym3 e = lane_mat3_sym(g);
    if (finite) {
        e.xx += REAL(0.5) * (g.xx * g.xx + g.yx * g.yx + g.zx * g.zx);
        e.yy += REAL(0.5) * (g.xy * g.xy + g.yy * g.yy + g.zy * g.zy);
        e.zz += REAL(0.5) * (g.xz * g.xz + g.yz * g.yz + g.zz * g.zz);
        e.yz += REAL(0.5) * (g.xy * g.xz + g.yy * g.yz + g.zy * g.zz);
        e.xz += REAL(0.5) * (g.xx * g.xz + g.yx * g.yz + g.zx * g.zz);
        e.xy += REAL(0.5) * (g.xx * g.xy + g.yx * g.yy + g.zx * g.zy);
    }
    return e;
}

/* (I + g) s for a symmetric s: F times a tensor of the reference configuration; s alone when linearised. */
LAW lane_mat3 push_forward(lane_mat3 g, lane_sym3 s, int finite)
{
    const lane_mat3 whole = {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
    return finite ? lane_mat3_add(whole, lane_mat3_mul(g, whole)) : whole;
}

/* Second Piola-Kirchhoff stress [Pa]; lambda, mu: Lame parameters [Pa]. */
LAW lane_sym3 svk_stress(lane_sym3 strain, lane lambda, lane mu)
{
    return lane_sym3_scale_shift(REAL(2) * mu, strain, lambda * lane_sym3_trace(strain));
}

/* Energy density psi [J/m^3]. */
LAW lane svk_energy(lane_sym3 strain, lane lambda, lane mu)
{
    const lane trace = lane_sym3_trace(strain);
    return REAL(0.5) * lambda * trace * trace + mu * lane_sym3_dot(strain, strain);
}

#endif
