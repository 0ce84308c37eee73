/* A rigid body's turning. The angular momentum l about the mass centre is kept in the frame of space, where only torques change it, so a body left alone keeps it bit
 * for bit. Over a step h the body turns about one axis w of its own frame, found from the mean of its momentum at both ends,
 *     w = I^-1 (p + p') / 2,   p' = exp(-h w) p,   q' = q exp(h w / 2),
 * p = R^T l (the mid-point rule for Euler's equations, whose quadratic invariants it keeps: p' - p = c (p + p') / 2 x w for some number c, so the energy p.I^-1 p / 2
 * changes by c w.(((p + p') / 2) x w) = 0, whatever c is). It is second order and reversible; a body with three equal moments turns exactly. */
#ifndef BRC_KERNELS_RIGID_H
#define BRC_KERNELS_RIGID_H

#include "svec.h"

/* x with A x = b. Scaled by the trace: moments of small bodies have no square in single precision. */
LAW svec3 rigid_solve(ssym3 a, svec3 b)
{
    const state s = STATE(1) / (a.xx + a.yy + a.zz);
    const svec3 r = {s * a.xx, s * a.xy, s * a.xz}, t = {s * a.xy, s * a.yy, s * a.yz}, u = {s * a.xz, s * a.yz, s * a.zz};
    const svec3 p = svec3_cross(t, u), q = svec3_cross(u, r), v = svec3_cross(r, t);
    return svec3_scale(s / svec3_dot(r, p), svec3_add(svec3_add(svec3_scale(b.x, p), svec3_scale(b.y, q)), svec3_scale(b.z, v)));
}

/* exp of half a turn h [rad], far below 1. */
LAW squat rigid_turn(svec3 h) { return squat_normalised(squat_of_half_turn(h)); }
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

/* One round of the mid-point rule: w from p and the w before. */
LAW svec3 rigid_round(ssym3 inertia, svec3 p, svec3 w, state h)
{
    return rigid_solve(inertia, svec3_scale(STATE(0.5), svec3_add(p, rigid_rotate(rigid_turn(svec3_scale(STATE(-0.5) * h, w)), p))));
}

/* The orientation after time h of a body that is free to turn. Rounds go on until the rounding stops them. */
LAW squat rigid_drift(squat q, ssym3 inertia, svec3 momentum, state h)
{
    const svec3 p = rigid_rotate(rigid_back(q), momentum);
    svec3 w = rigid_solve(inertia, p);
    state last = svec3_dot(w, w);
    for (int round = 0; round < 40 && h != 0; ++round) {
        const svec3 next = rigid_round(inertia, p, w, h), off = svec3_sub(next, w);
        const state change = svec3_dot(off, off);
        w = next;
        if (!(change < last)) break;
        last = change;
    }
    return squat_normalised(squat_mul(q, rigid_turn(svec3_scale(STATE(0.5) * h, w))));
}

#endif
