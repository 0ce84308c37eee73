/* A rigid body's turning. The angular momentum l about the mass centre is kept in the frame of space, where only
 * torques change it, so a body left alone keeps it bit for bit. Over a step h the body turns about one axis w of its
 * own frame, found from the mean of its momentum at both ends,
 *     w = I^-1 (p + p') / 2,   p' = exp(-h w) p,   q' = q exp(h w / 2),
 * p = R^T l (the mid-point rule for Euler's equations, whose quadratic invariants it keeps: p' - p = c (p + p') / 2 x w
 * for some number c, so the energy p.I^-1 p / 2 changes by c w.(((p + p') / 2) x w) = 0, whatever c is). It is second
 * order and reversible; a body with three equal moments turns exactly. */
#ifndef BRC_KERNELS_RIGID_H
#define BRC_KERNELS_RIGID_H

#include "svec.h"

/* Scaled by the trace: moments of small bodies have no square in single precision. */
LAW ssym3 rigid_inverse(ssym3 a)
{
    const state s = STATE(1) / (a.xx + a.yy + a.zz);
    const svec3 r = {s * a.xx, s * a.xy, s * a.xz}, t = {s * a.xy, s * a.yy, s * a.yz},
                u = {s * a.xz, s * a.yz, s * a.zz};
    const svec3 p = svec3_cross(t, u), q = svec3_cross(u, r), v = svec3_cross(r, t);
    const state k = s / svec3_dot(r, p);
    return (ssym3){k * p.x, k * q.y, k * v.z, k * v.y, k * p.z, k * p.y};
}
LAW svec3 rigid_mul(ssym3 a, svec3 b)
{
    return (svec3){a.xx * b.x + a.xy * b.y + a.xz * b.z, a.xy * b.x + a.yy * b.y + a.yz * b.z,
                   a.xz * b.x + a.yz * b.y + a.zz * b.z};
}
/* x with A x = b. */
LAW svec3 rigid_solve(ssym3 a, svec3 b) { return rigid_mul(rigid_inverse(a), b); }

LAW squat rigid_back(squat q) { return (squat){q.w, -q.x, -q.y, -q.z}; }
/* R a: a + 2 w (v x a) + 2 v x (v x a) */
LAW svec3 rigid_rotate(squat q, svec3 a)
{
    const svec3 v = {q.x, q.y, q.z}, once = svec3_cross(v, a);
    return svec3_add(a, svec3_scale(STATE(2), svec3_add(svec3_scale(q.w, once), svec3_cross(v, once))));
}
/* Angular velocity in space [rad/s] of a body that is free to turn. */
LAW svec3 rigid_spin(squat q, ssym3 inertia, svec3 momentum)
{
    return rigid_rotate(q, rigid_solve(inertia, rigid_rotate(rigid_back(q), momentum)));
}

/* exp(v) p - p, v x p sin |v| / |v| and v x (v x p) (1 - cos |v|) / |v|^2 by their series: a root and a division less,
 * and none of its digits, up to |v| = 0.5. */
LAW svec3 rigid_swing(svec3 v, svec3 p)
{
    const state vv = svec3_dot(v, v);
    const state s =
        STATE(1) - vv * (STATE(1.0 / 6) -
                         vv * (STATE(1.0 / 120) -
                               vv * (STATE(1.0 / 5040) - vv * (STATE(1.0 / 362880) - vv * STATE(1.0 / 39916800)))));
    const state c = STATE(0.5) -
                    vv * (STATE(1.0 / 24) -
                          vv * (STATE(1.0 / 720) -
                                vv * (STATE(1.0 / 40320) - vv * (STATE(1.0 / 3628800) - vv * STATE(1.0 / 479001600)))));
    const svec3 once = svec3_cross(v, p);
    return svec3_add_scaled(svec3_scale(s, once), c, svec3_cross(v, once));
}
/* One round of the mid-point rule: w from p and the w before. */
LAW svec3 rigid_round(ssym3 inverse, svec3 p, svec3 w, state h)
{
    return rigid_mul(inverse, svec3_add_scaled(p, STATE(0.5), rigid_swing(svec3_scale(-h, w), p)));
}
/* What w differs by from the w before, squared (change; last: a round earlier, at first w itself), falls by the same
 * factor in every round. Do rounds go on? Until the next would change nothing beside the rounding of w, or the rounding
 * stops them. */
LAW int rigid_goes_on(state change, state last, svec3 w)
{
    const state least = STATE(0.125) * STATE_ROUNDING, factor = change / last;
    return (change < last) & (factor * change > least * least * svec3_dot(w, w));
}
#define RIGID_ROUNDS 40
LAW squat rigid_turned(squat q, svec3 w, state h)
{
    return squat_normalised(squat_mul(q, squat_of_half_turn(svec3_scale(STATE(0.5) * h, w))));
}

/* The orientation after time h of a body that is free to turn. */
LAW squat rigid_drift(squat q, ssym3 inertia, svec3 momentum, state h)
{
    const svec3 p = rigid_rotate(rigid_back(q), momentum);
    const ssym3 inverse = rigid_inverse(inertia);
    svec3 w = rigid_mul(inverse, p);
    state last = svec3_dot(w, w);
    for (int round = 0, goes = h != 0; round < RIGID_ROUNDS && goes; ++round) {
        const svec3 next = rigid_round(inverse, p, w, h), off = svec3_sub(next, w);
        const state change = svec3_dot(off, off);
        w = next;
        goes = rigid_goes_on(change, last, w);
        last = change;
    }
    return rigid_turned(q, w, h);
}

#endif
