/* What a crack leaves to a beam (docs/fracture.md "Beams beside compression"): its pushes across the crack and along it.
 *
 * A crack with the axis a cuts a beam of initial axis e. Its two sides move apart by o = (l - l0) along the beam and o_m across it, along m, which is across e in the plane of e and a:
 * a = c e + s m, c = cos, s = sin of the angle between them; the other direction in this plane is along the crack, t = s e - c m. As springs in series with the beam's stiffness
 * k = E S / l0 along it and k_m = 12 E I / l0^3 across it the crack opens along a (w >= 0), and lets go of pulls along t (v >= 0):
 *     U = min over w, v >= 0 of k/2 (l - l0 - c w - s v)^2 + k_m/2 (o_m - s w + c v)^2,
 * a convex energy with a continuous force. No moment, no twist and no slide across e and a is left. It is not above the energy of the whole beam (of small strains), so a beam loses energy
 * by opening and gains none. m turns with both elements: o_m = l n.(m_i + m_j) / 2 = l (d1.m_i + d2.m_j) / 2, which no rotation of the body changes.
 *
 * k_m counts by `keeps`: 1 where the beam leans by 30 degrees or more against the axis, less where it lies along it, since a slide along the crack is no push; it fades as the crack opens,
 * and where it is 0 the axial push is left: U = k/2 min(l - l0, 0)^2. */
#ifndef BRC_KERNELS_BEAM_CARRIED_H
#define BRC_KERNELS_BEAM_CARRIED_H

#include "cbm_beam.h"

/* How a crack lies to a beam. side: m in the undeformed body, seen from the other end -m; along: c >= 0 [-]; keeps: share of k_m [-]. */
typedef struct {
    lane_vec3 side;
    lane along, keeps;
} beam_lean;

typedef struct {
    cbm_end end; /* on element i */
    lane energy; /* [J] */
} beam_carry;

/* 1 where x > 0, else 0. */
LAW lane beam_positive(lane x) { return LANE_DIFFERENT(lane_max(x, LANE_ZERO), LANE_ZERO); }

/* branch: x_j - x_i now [m]; turn_i: R_i - I, q_j: orientation of the other element. */
LAW beam_carry beam_carried(cbm_shape shape, lane inv_length0, cbm_stiffness stiffness, lane_vec3 branch, lane_mat3 turn_i, lane_quat q_j, beam_lean lean)
{
    const lane one = LANE_ZERO + REAL(1), c = lean.along, s = LANE_SQRT(lane_max(one - c * c, LANE_ZERO)), least = LANE_ZERO + REAL(1e-30);
    const lane k = stiffness.axial * inv_length0, k_m = lean.keeps * REAL(6) * stiffness.bend * inv_length0 * inv_length0 * inv_length0;
    const lane_vec3 own = lane_vec3_add(lean.side, lane_mat3_mul_vec(turn_i, lean.side)), theirs = lane_vec3_add(lean.side, quat_rotate_minus_identity(q_j, lean.side, 1));
    const lane e = shape.elongation, m = REAL(0.5) * (lane_vec3_dot(shape.bent1, own) + lane_vec3_dot(shape.bent2, theirs)) / shape.inv_length;
    const lane pull_a = c * k * e + s * k_m * m, pull_t = s * k * e - c * k_m * m;
    const lane opens = beam_positive(pull_a) * beam_positive(c * m - s * e), slips = beam_positive(pull_t) * beam_positive(-c * e - s * m);
    const lane shut = (one - beam_positive(pull_a)) * (one - beam_positive(pull_t)), holds = opens + slips + shut; /* one of them at most */
    const lane w = opens * pull_a / lane_max(c * c * k + s * s * k_m, least), v = slips * pull_t / lane_max(s * s * k + c * c * k_m, least);
    const lane along = e - c * w - s * v, across = m - s * w + c * v, f_along = holds * k * along, f_across = holds * k_m * across;
    const lane_vec3 both = lane_vec3_scale(REAL(0.5) * f_across, lane_vec3_add(own, theirs));
    return (beam_carry){{lane_vec3_add(lane_vec3_scale(f_along, shape.axis), both), lane_vec3_cross(branch, lane_vec3_scale(REAL(0.5) * f_across, own))},
                        REAL(0.5) * (f_along * along + f_across * across)};
}

/* The opening l n - l0 (X1 + X2) / 2 of a beam's ends, which no rotation of the body changes [m]. */
LAW lane_vec3 beam_opening(cbm_shape shape)
{
    const lane length0 = REAL(1) / shape.inv_length - shape.elongation;
    return lane_vec3_add(lane_vec3_scale(shape.elongation, shape.axis), lane_vec3_scale(REAL(0.5) * length0, lane_vec3_add(shape.bent1, shape.bent2)));
}

/* keeps of a crack that has come to this opening: none where its ends stand clear of each other, at `clear` of the beam's length (0: it does not fade). */
LAW lane beam_fades(lane keeps, lane along, lane_vec3 opening, lane inv_length0, coeff clear)
{
    const lane wide = clear > 0 ? LANE_SQRT(lane_vec3_dot(opening, opening)) * inv_length0 * (REAL(1) / clear) : LANE_ZERO;
    const lane leans = lane_min(REAL(4) * (REAL(1) - along * along), LANE_ZERO + REAL(1));
    return lane_min(keeps, leans * lane_max(REAL(1) - wide, LANE_ZERO));
}

#endif
