/* A rigid body's turning. The angular momentum l about the mass centre is kept in the frame of space, where only torques change it, so a body left alone keeps it bit
 * for bit. Over a step h the body turns about one axis w of its own frame, found from the mean of its momentum at both ends,
 *     w = I^-1 (p + p') / 2,   p' = exp(-h w) p,   q' = q exp(h w / 2),
 * p = R^T l (the mid-point rule for Euler's equations, whose quadratic invariants it keeps: p' - p = c (p + p') / 2 x w for some number c, so the energy p.I^-1 p / 2
 * changes by c w.(((p + p') / 2) x w) = 0, whatever c is). It is second order and reversible; a body with three equal moments turns exactly. */
#ifndef BRC_KERNELS_RIGID_H
#define BRC_KERNELS_RIGID_H

#include "portable.h"

typedef struct { state x, y, z; } rigid_vec;
typedef struct { state xx, yy, zz, yz, xz, xy; } rigid_sym;
typedef struct { state w, x, y, z; } rigid_quat;

LAW rigid_vec rigid_add(rigid_vec a, rigid_vec b) { return (rigid_vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
LAW rigid_vec rigid_scale(state k, rigid_vec a) { return (rigid_vec){k * a.x, k * a.y, k * a.z}; }
LAW state rigid_dot(rigid_vec a, rigid_vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAW rigid_vec rigid_cross(rigid_vec a, rigid_vec b)
{
    return (rigid_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/* x with A x = b. Scaled by the trace: moments of small bodies have no square in single precision. */
LAW rigid_vec rigid_solve(rigid_sym a, rigid_vec b)
{
    const state s = STATE(1) / (a.xx + a.yy + a.zz);
    const rigid_vec r = {s * a.xx, s * a.xy, s * a.xz}, t = {s * a.xy, s * a.yy, s * a.yz}, u = {s * a.xz, s * a.yz, s * a.zz};
    const rigid_vec p = rigid_cross(t, u), q = rigid_cross(u, r), v = rigid_cross(r, t);
    return rigid_scale(s / rigid_dot(r, p), rigid_add(rigid_add(rigid_scale(b.x, p), rigid_scale(b.y, q)), rigid_scale(b.z, v)));
}

LAW rigid_quat rigid_conjugate(rigid_quat q) { return (rigid_quat){q.w, -q.x, -q.y, -q.z}; }
/* a b, normalised */
LAW rigid_quat rigid_after(rigid_quat a, rigid_quat b)
{
    const rigid_quat c = {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
    const state scale = STATE(1) / SQRT_STATE(c.w * c.w + c.x * c.x + c.y * c.y + c.z * c.z);
    return (rigid_quat){scale * c.w, scale * c.x, scale * c.y, scale * c.z};
}
/* exp of half a turn h [rad], |h| below a half: by the series of cos and sin. */
LAW rigid_quat rigid_exp(rigid_vec h)
{
    const state hh = rigid_dot(h, h);
    const state c = STATE(1) - hh * (STATE(0.5) - hh * (STATE(1.0 / 24) - hh * (STATE(1.0 / 720) - hh * STATE(1.0 / 40320))));
    const state s = STATE(1) - hh * (STATE(1.0 / 6) - hh * (STATE(1.0 / 120) - hh * (STATE(1.0 / 5040) - hh * STATE(1.0 / 362880))));
    return (rigid_quat){c, s * h.x, s * h.y, s * h.z};
}
/* R a: a + 2 w (v x a) + 2 v x (v x a) */
LAW rigid_vec rigid_rotate(rigid_quat q, rigid_vec a)
{
    const rigid_vec v = {q.x, q.y, q.z}, once = rigid_cross(v, a);
    return rigid_add(a, rigid_scale(STATE(2), rigid_add(rigid_scale(q.w, once), rigid_cross(v, once))));
}
/* Angular velocity in space [rad/s] of a body that is free to turn. */
LAW rigid_vec rigid_spin(rigid_quat q, rigid_sym inertia, rigid_vec momentum)
{
    return rigid_rotate(q, rigid_solve(inertia, rigid_rotate(rigid_conjugate(q), momentum)));
}

/* One round of the mid-point rule: w from p and the w before. */
LAW rigid_vec rigid_round(rigid_sym inertia, rigid_vec p, rigid_vec w, state h)
{
    rigid_quat back = rigid_exp(rigid_scale(STATE(-0.5) * h, w));
    const state scale = STATE(1) / SQRT_STATE(back.w * back.w + back.x * back.x + back.y * back.y + back.z * back.z);
    back = (rigid_quat){scale * back.w, scale * back.x, scale * back.y, scale * back.z};
    return rigid_solve(inertia, rigid_scale(STATE(0.5), rigid_add(p, rigid_rotate(back, p))));
}

/* The orientation after time h of a body that is free to turn. Rounds go on until the rounding stops them. */
LAW rigid_quat rigid_drift(rigid_quat q, rigid_sym inertia, rigid_vec momentum, state h)
{
    const rigid_vec p = rigid_rotate(rigid_conjugate(q), momentum);
    rigid_vec w = rigid_solve(inertia, p);
    state last = rigid_dot(w, w);
    for (int round = 0; round < 40 && h != 0; ++round) {
        const rigid_vec next = rigid_round(inertia, p, w, h), off = rigid_add(next, rigid_scale(STATE(-1), w));
        const state change = rigid_dot(off, off);
        w = next;
        if (!(change < last)) break;
        last = change;
    }
    return rigid_after(q, rigid_exp(rigid_scale(STATE(0.5) * h, w)));
}

#endif
