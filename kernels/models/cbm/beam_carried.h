/* What a crack leaves to a beam (docs/notebook/fracture.md "Beams beside compression"): its pushes across the crack and
 * along it.
 *
 * a, p, q: axes of a crack, that across it and two along it, each turned so that the beam's initial axis e has
 * components c_a, c_p, c_q >= 0. The ends of the beam move apart by o. As springs in series with the stiffness K = k e
 * (x) e + k_m (1 - e (x) e) of a beam, k = E S / l0 along it and k_m = 12 E I / l0^3 across it, the crack opens along a
 * and lets go of pulls along p and q, each by w >= 0:
 *     U = min over w >= 0 of 1/2 (o - w) . K (o - w).
 * It is convex, its force F = K (o - w) is continuous, and along each axis F pushes or is 0. Moments, twist and what
 * pulls are gone. U is not above the energy of the whole beam (of small strains), so a beam loses energy by opening and
 * gains none.
 *
 * With y = e.(o - w) <= 0 it is F_i = k_m o_i + (k - k_m) c_i y along axes that hold, those with F_i < 0; along the
 * others w_i makes it 0, so that y = (sum over held of c_i o_i) / (1 + (k / k_m - 1) sum over the others of c_i^2),
 * which turns of y and of who holds, from y = 0 on, find within four: a Newton's method on a convex function of three
 * pieces.
 *
 * o = (l - l0) n + o_m across, which turns with both elements: o_m = l (R_i^T d1 + R_j^T d2) / 2 in the undeformed
 * body, so no rotation of the body changes U. k_m counts by `keeps`: 1 where the beam leans by 30 degrees or more
 * against the axis and what pressed along the crack as it opened was as much as what pulled, less where the beam lies
 * along the axis, since a slide along the crack is no push, and with the square of push over pull; it fades as the
 * crack opens, and where it is 0 the axial push is left: U = k/2 min(l - l0, 0)^2.
 *
 * Sides of an interface that slide along its plane (cosine < 0): w is free along p and q, so that a slide is no push
 * whichever way the beam leans, and k_m stays whole. */
#ifndef BRC_KERNELS_BEAM_CARRIED_H
#define BRC_KERNELS_BEAM_CARRIED_H

#include "cbm_beam.h"

/* How a crack lies to a beam. side: unit vector m1 across e in the plane of e and a, in the undeformed body, a = c_a e
 * + s m1; from the other end -m1. m2 = e x m1. along: c_a; cosine, sine: of p in p = cosine (s e - c_a m1) + sine m2,
 * cosine >= 0, from the other end -sine; -1 and 0: the crack slides. keeps: share of k_m. [-, all] */
typedef struct {
    lane_vec3 side;
    lane along, cosine, sine, keeps;
} beam_lean;

typedef struct {
    cbm_end end; /* on element i */
    lane energy; /* [J] */
} beam_carry;

/* 1 where x > 0, else 0. */
LAW lane beam_positive(lane x) { return LANE_DIFFERENT(lane_max(x, LANE_ZERO), LANE_ZERO); }
/* 1 where the crack slides along an interface, else 0. */
LAW lane beam_slides(beam_lean lean) { return beam_positive(-lean.cosine); }

/* Axes a, p, q by their parts along e, m1 and m2, and the parts of o across the beam. */
typedef struct {
    lane_vec3 c, m1, m2;     /* of a, p, q */
    lane_vec3 first, second; /* m1, m2 */
    lane o1, o2;             /* [m] */
} beam_axes;
LAW beam_axes beam_axes_of(cbm_shape shape, lane_vec3 axis0, lane_quat q_i, lane_quat q_j, beam_lean lean)
{
    const lane one = LANE_ZERO + REAL(1), c = lean.along, s = LANE_SQRT(lane_max(one - c * c, LANE_ZERO));
    const lane flip = one - REAL(2) * beam_positive(lean.sine),
               sine = -flip * lean.sine; /* |sine|: q is turned towards e */
    const lane_vec3 back_i =
        lane_vec3_add(shape.bent1, quat_rotate_minus_identity(quat_conjugate(q_i), shape.bent1, 1));
    const lane_vec3 back_j =
        lane_vec3_add(shape.bent2, quat_rotate_minus_identity(quat_conjugate(q_j), shape.bent2, 1));
    const lane_vec3 across = lane_vec3_scale(REAL(0.5) + REAL(0.5) * cbm_strain(shape), lane_vec3_add(back_i, back_j)),
                    second = lane_vec3_cross(axis0, lean.side);
    return (beam_axes){{c, s * lean.cosine, s * lane_max(sine, -sine)},
                       {s, -c * lean.cosine, -c * lane_max(sine, -sine)},
                       {LANE_ZERO, lean.sine, flip * lean.cosine},
                       lean.side,
                       second,
                       lane_vec3_dot(across, lean.side),
                       lane_vec3_dot(across, second)};
}

/* A part of o along one of the axes. */
LAW lane beam_along(lane c, lane m1, lane m2, lane elongation, lane o1, lane o2)
{
    return c * elongation + m1 * o1 + m2 * o2;
}

/* One of the axes at a trial y: sum: c o where it holds; free: c^2 where it does not; force: F along it [N], where it
 * holds; rest: o - w along it but for y [m]. slides: 1: it holds nothing, else 0. */
typedef struct {
    lane sum, free, force, rest;
} beam_axis;
LAW beam_axis beam_axis_of(lane c, lane o, lane k_m, lane more, lane y, lane per, lane slides)
{
    const lane f = k_m * o + more * c * y, lets = lane_max(beam_positive(f), slides), held = REAL(1) - lets;
    return (beam_axis){held * c * o, lets * c * c, held * f, held * o - lets * per * c * y};
}

/* Where keeps is 0. */
LAW beam_carry beam_pressed(cbm_shape shape, lane inv_length0, cbm_stiffness stiffness)
{
    const lane zero = LANE_ZERO, k = stiffness.axial * inv_length0, y = lane_min(cbm_elongation(shape), zero);
    return (beam_carry){{lane_vec3_scale(k * y * inv_length0, cbm_axis(shape)), {zero, zero, zero}},
                        REAL(0.5) * (k * y * y)};
}

/* k_m that counts, and k above it [N/m]. */
typedef struct {
    lane across, more;
} beam_springs;
LAW beam_springs beam_springs_of(lane inv_length0, cbm_stiffness stiffness, lane keeps)
{
    const lane k_m = keeps * REAL(6) * stiffness.bend * inv_length0 * inv_length0 * inv_length0;
    return (beam_springs){k_m, stiffness.axial * inv_length0 - k_m};
}

/* o by its parts along a, p and q [m]. */
LAW lane_vec3 beam_parts(beam_axes x, cbm_shape shape)
{
    return (lane_vec3){beam_along(x.c.x, x.m1.x, x.m2.x, cbm_elongation(shape), x.o1, x.o2),
                       beam_along(x.c.y, x.m1.y, x.m2.y, cbm_elongation(shape), x.o1, x.o2),
                       beam_along(x.c.z, x.m1.z, x.m2.z, cbm_elongation(shape), x.o1, x.o2)};
}

/* The end of a beam under a force of `along` on its axis now and f.x, f.y, f.z along a, p, q across it [N]. */
LAW cbm_end beam_end(cbm_shape shape, lane inv_length0, lane_vec3 branch, lane_quat q_i, lane_quat q_j, beam_axes x,
                     lane along, lane_vec3 f)
{
    const lane f1 = f.x * x.m1.x + f.y * x.m1.y + f.z * x.m1.z, f2 = f.x * x.m2.x + f.y * x.m2.y + f.z * x.m2.z;
    const lane_vec3 across =
        lane_vec3_add(lane_vec3_scale(REAL(0.5) * f1, x.first), lane_vec3_scale(REAL(0.5) * f2, x.second));
    const lane_vec3 own = lane_vec3_add(across, quat_rotate_minus_identity(q_i, across, 1)),
                    theirs = lane_vec3_add(across, quat_rotate_minus_identity(q_j, across, 1));
    return (cbm_end){lane_vec3_add(lane_vec3_scale(along * inv_length0, cbm_axis(shape)), lane_vec3_add(own, theirs)),
                     lane_vec3_cross(branch, own)};
}

/* branch: x_j - x_i now [m], axis0: e; q_i, q_j: orientations of the elements. */
LAW beam_carry beam_carried(cbm_shape shape, lane inv_length0, cbm_stiffness stiffness, lane_vec3 branch,
                            lane_vec3 axis0, lane_quat q_i, lane_quat q_j, beam_lean lean)
{
    const beam_axes x = beam_axes_of(shape, axis0, q_i, q_j, lean);
    const beam_springs spring = beam_springs_of(inv_length0, stiffness, lean.keeps);
    const lane zero = LANE_ZERO, slides = beam_slides(lean), k = stiffness.axial * inv_length0, k_m = spring.across,
               more = spring.more;
    const lane per = more / lane_max(k_m, REAL(1e-15) * k + REAL(1e-30));
    const lane_vec3 o = beam_parts(x, shape);
    beam_axis a, p, q;
    lane y = zero;
    for (int turn = 0; turn < 5; ++turn) {
        a = beam_axis_of(x.c.x, o.x, k_m, more, y, per, zero);
        p = beam_axis_of(x.c.y, o.y, k_m, more, y, per, slides);
        q = beam_axis_of(x.c.z, o.z, k_m, more, y, per, slides);
        if (turn < 4) y = lane_min((a.sum + p.sum + q.sum) / (REAL(1) + (a.free + p.free + q.free) * per), zero);
    }
    const lane energy = more * y * y + k_m * (a.rest * a.rest + p.rest * p.rest + q.rest * q.rest);
    return (beam_carry){
        beam_end(shape, inv_length0, branch, q_i, q_j, x, k * y, (lane_vec3){a.force, p.force, q.force}),
        REAL(0.5) * energy};
}

/* Sides of an interface that slide with friction. p, q: where they stick along its axes; held_p, held_q: how far they
 * stood from there after the last step [m]. */
typedef struct {
    lane p, q, held_p, held_q;
} beam_slip;
/* After a step: friction lets them hold no more than `most` times the push on them. spent: what that took, the mean of
 * the forces at both ends of the step times the slide, as velocity Verlet's own work [J]. */
typedef struct {
    beam_slip slip;
    lane spent;
} beam_slide;
LAW beam_slide beam_slipped(cbm_shape shape, lane inv_length0, cbm_stiffness stiffness, lane_vec3 axis0, lane_quat q_i,
                            lane_quat q_j, beam_lean lean, beam_slip slip, coeff most)
{
    const beam_axes x = beam_axes_of(shape, axis0, q_i, q_j, lean);
    const beam_springs spring = beam_springs_of(inv_length0, stiffness, lean.keeps);
    const lane_vec3 o = beam_parts(x, shape);
    /* The push -F_a: springs in series, that across and, as the axis is pushed, the rest of k on it. */
    const lane c = lean.along, per = spring.more / lane_max(spring.across, LANE_ZERO + REAL(1e-30)),
               stiff = spring.across + spring.more * c * c / (REAL(1) + (REAL(1) - c * c) * per),
               push = lane_max(-stiff * o.x, LANE_ZERO);
    const lane p = o.y - slip.p, q = o.z - slip.q, size = LANE_SQRT(p * p + q * q),
               share =
                   lane_min(most * push / lane_max(spring.across * size, LANE_ZERO + REAL(1e-30)), LANE_ZERO + REAL(1)),
               held_p = share * p, held_q = share * q;
    return (beam_slide){{o.y - held_p, o.z - held_q, held_p, held_q},
                        REAL(0.5) * spring.across *
                            ((held_p + slip.held_p) * (p - held_p) + (held_q + slip.held_q) * (q - held_q))};
}
/* What that friction holds: k_m times how far they stand from there, as far as `rubs`, 1 or 0. */
LAW beam_carry beam_rubbed(cbm_shape shape, lane inv_length0, cbm_stiffness stiffness, lane_vec3 branch,
                           lane_vec3 axis0, lane_quat q_i, lane_quat q_j, beam_lean lean, beam_slip slip, lane rubs)
{
    const beam_axes x = beam_axes_of(shape, axis0, q_i, q_j, lean);
    const lane k_m = rubs * beam_springs_of(inv_length0, stiffness, lean.keeps).across;
    const lane_vec3 o = beam_parts(x, shape);
    const lane p = o.y - slip.p, q = o.z - slip.q;
    return (beam_carry){beam_end(shape, inv_length0, branch, q_i, q_j, x, k_m * (x.c.y * p + x.c.z * q),
                                 (lane_vec3){LANE_ZERO, k_m * p, k_m * q}),
                        REAL(0.5) * k_m * (p * p + q * q)};
}

/* The pull of a whole beam along the axis of a crack, as that of a beam along the axis with as much energy to release
 * [N], where its element has stretched by `lateral` [-] across what presses on it along the crack: all its beams are
 * stretched so, whether there is a crack or not. */
LAW lane beam_pull(cbm_shape shape, lane inv_length0, cbm_stiffness stiffness, lane_vec3 axis0, lane_quat q_i,
                   lane_quat q_j, beam_lean lean, lane lateral)
{
    const beam_axes x = beam_axes_of(shape, axis0, q_i, q_j, lean);
    const lane k = stiffness.axial * inv_length0,
               k_m = REAL(6) * stiffness.bend * inv_length0 * inv_length0 * inv_length0, c = lean.along;
    const lane own = lateral * c / (inv_length0 + REAL(1e-30)), stiff = k_m + (k - k_m) * c * c;
    const lane pull =
        k_m * (x.c.x * cbm_elongation(shape) + x.m1.x * x.o1) + (k - k_m) * c * cbm_elongation(shape) - stiff * own;
    return pull * LANE_SQRT(k / lane_max(stiff, LANE_ZERO + REAL(1e-30)));
}

/* The opening l n - l0 (X1 + X2) / 2 of a beam's ends, which no rotation of the body changes [m]. */
LAW lane_vec3 beam_opening(cbm_shape shape)
{
    return lane_vec3_add(lane_vec3_scale(shape.shortened, shape.branch),
                         lane_vec3_scale(LANE_ZERO + REAL(0.5), lane_vec3_add(shape.bent1, shape.bent2)));
}

/* keeps of a crack that has come to this opening: none where its ends stand clear of each other, at `clear` of the
 * beam's length (0: it does not fade); of one that slides as it is. */
LAW lane beam_fades(beam_lean lean, lane_vec3 opening, lane inv_length0, coeff clear)
{
    const lane wide =
        clear > 0 ? LANE_SQRT(lane_vec3_dot(opening, opening)) * inv_length0 * (REAL(1) / clear) : LANE_ZERO;
    const lane leans = lane_min(REAL(4) * (REAL(1) - lean.along * lean.along), LANE_ZERO + REAL(1));
    const lane keeps = lane_min(lean.keeps, leans * lane_max(REAL(1) - wide, LANE_ZERO));
    return keeps + beam_slides(lean) * (lean.keeps - keeps);
}

#endif
