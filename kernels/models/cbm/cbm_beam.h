/* The law of one beam in potential form (docs/notebook/beams.md; NAH19 eq. 1-4 corrected there).
 *
 * e is the initial axis from i to j, X1 = R_i e and X2 = R_j e its images in the two elements' frames, n the current
 * axis, l its length, l0 the initial one; ka = E S / l0, A = 2 E I / l0, kt = G J / l0:
 *     U = ka/2 (l - l0)^2 + A [5 - 3 n.(X1 + X2) + X1.X2] + kt/2 tau^2,   tau: twist.
 * Everything is formed from the small vectors d1 = n - X1 and d2 = n - X2, so that rotations of 1e-10 keep their
 * digits: 5 - 3 n.(X1 + X2) + X1.X2 = 3/2 (d1^2 + d2^2) - 1/2 (d1 - d2)^2 for unit vectors. Seen from the other end (i
 * and j exchanged, e reversed) the law is the same, so each element computes its own side. finite: 1 as above; 0 the
 * linearisation. */
#ifndef BRC_KERNELS_CBM_BEAM_H
#define BRC_KERNELS_CBM_BEAM_H

#include "../../core/quaternion.h"

/* Stiffness of a beam times its length. */
typedef struct {
    lane axial; /* E S [N] */
    lane bend;  /* 2 E I [N m^2] */
    lane twist; /* G J [N m^2] */
} cbm_stiffness;

/* Two half beams in series. */
LAW lane cbm_in_series(lane a, lane b) { return REAL(2) * a * b / (a + b); }

/* What the law is made of. Vectors are times l0, so that no axis need be made of length one; twist and its axis are
 * parted by sqrt(2), so that V is never doubled. */
typedef struct {
    lane_vec3 branch;       /* l n, where not finite l0 e [m] */
    lane_vec3 own;          /* l0 X1 [m] */
    lane_vec3 bent1, bent2; /* l0 d1, l0 d2 [m] */
    lane stretched;         /* (l / l0)^2 - 1 [-] */
    lane shortened;         /* 1 - l0 / l [-] */
    lane length0;           /* l0, 0 for a missing neighbour [m] */
    lane twist;             /* l0 tau / sqrt(2) [m] */
    lane_vec3 twist_axis;   /* sqrt(2) l0 g [m] */
} cbm_shape;

/* Of the finite law: l / l0 - 1 = (1 + stretched) (1 - shortened) - 1 [-]. */
LAW lane cbm_strain(cbm_shape s)
{
    const lane part = s.shortened - s.shortened * s.shortened;
    return part + s.stretched * part;
}
LAW lane cbm_elongation(cbm_shape s) { return cbm_strain(s) * s.length0; } /* l - l0 [m] */
/* Of the finite law: l0 n [m]. */
LAW lane_vec3 cbm_axis(cbm_shape s) { return lane_vec3_less(s.branch, s.shortened, s.branch); }

/* 1 - l0 / l of a beam whose (l / l0)^2 is 1 + x. A root and a quotient take as long as an eighth of the law, so where
 * |x| < 2^-7 (strains below 0.39 %) it is x times the Chebyshev fit of (1 - (1 + x)^-1/2) / x, which is 2^-56 of it
 * off; single precision takes half of it, 2^-29 off. */
LAW lane cbm_shortened(lane x)
{
    const lane xx = x * x;
    const lane low = (REAL(0.5) - REAL(0.37500000000000488426) * x) +
                     xx * (REAL(0.31250000000000461291) - REAL(0.27343749935981508153) * x),
               high = (REAL(0.24609374939538033488) - REAL(0.22560691464861752284) * x) +
                      xx * REAL(0.20949246801597707261);
    const lane fitted = x * (BRC_PRECISION == 0 ? low + xx * xx * high : low), square = REAL(1) + x;
    const lane_mask far = LANE_LESS(LANE_ZERO + REAL(0x1p-14), xx);
    if (!LANE_SOME(far)) return fitted;
    return LANE_WHERE(far, x / (LANE_SQRT(square) + square), fitted);
}

/* sqrt(2) times the conjugate of q_i [-]. */
LAW lane_quat cbm_back(lane_quat q_i)
{
    const lane root = LANE_ZERO + REAL(1.41421356237309504880);
    return (lane_quat){root * q_i.w, -(root * q_i.x), -(root * q_i.y), -(root * q_i.z)};
}

/* branch: X_j - X_i, jump: u_j - u_i [m]; inv_length0: 1/|branch|, 0 for a missing neighbour, which then feels nothing
 * [1/m]. back: cbm_back of q_i, turn_i: R_i - I, the same for all beams of an element. */
LAW cbm_shape cbm_beam_shape_turned(lane_vec3 branch, lane inv_length0, lane_vec3 jump, lane_quat back,
                                    lane_mat3 turn_i, lane_quat q_j, int finite)
{
    cbm_shape s;
    const lane_vec3 now = lane_vec3_add(branch, jump),
                    rest = lane_vec3_sub(jump, lane_mat3_mul_vec(turn_i, branch)); /* l n - l0 X1 */
    const lane square = inv_length0 * inv_length0;
    if (finite) {
        s.stretched = square * lane_vec3_dot(jump, lane_vec3_add(branch, now));
        s.shortened = cbm_shortened(s.stretched);
    } else {
        s.stretched = s.shortened = square * lane_vec3_dot(branch, jump);
    }
    s.length0 = inv_length0 * lane_vec3_dot(branch, branch);
    s.branch = finite ? now : branch;
    s.own = finite ? lane_vec3_sub(now, rest) : branch;
    s.bent1 = lane_vec3_less(rest, s.shortened, s.branch);
    /* the relative rotation w, V in the global frame, times sqrt(2): tau = 2 V.X1, g = w X1 + V x X1, X2 - X1 = 2 (w V
     * x X1 + V x (V x X1)) = 2 V x g */
    const lane_quat turn = quat_mul(q_j, back);
    const lane root = LANE_ZERO + REAL(1.41421356237309504880);
    const lane_vec3 v =
        finite ? quat_vector(turn) : lane_vec3_add(lane_vec3_scale(root, quat_vector(q_j)), quat_vector(back));
    s.twist = lane_vec3_dot(v, s.own);
    s.twist_axis = lane_vec3_scale(finite ? turn.w : root, s.own);
    if (finite) s.twist_axis = lane_vec3_add(s.twist_axis, lane_vec3_cross(v, s.own));
    s.bent2 = lane_vec3_less_cross(s.bent1, v, s.twist_axis);
    return s;
}

LAW cbm_shape cbm_beam_shape(lane_vec3 branch, lane inv_length0, lane_vec3 jump, lane_quat q_i, lane_quat q_j,
                             int finite)
{
    return cbm_beam_shape_turned(branch, inv_length0, jump, cbm_back(q_i), quat_matrix_minus_identity(q_i, finite), q_j,
                                 finite);
}

/* What the beam does to element i. */
typedef struct {
    lane_vec3 force;  /* [N] */
    lane_vec3 torque; /* about its own centre [N m] */
} cbm_end;

/* sum and what one more beam does. Its axial force along l n is ka (1 - l0 / l): strain over l. */
LAW cbm_end cbm_beam_add(cbm_end sum, cbm_shape s, lane inv_length0, cbm_stiffness k, int finite)
{
    const lane square = inv_length0 * inv_length0, cube = square * inv_length0;
    const lane inv_length = finite ? inv_length0 - inv_length0 * s.shortened : inv_length0;
    const lane bend = k.bend * cube, shear = REAL(3) * k.bend * square * inv_length, twist = k.twist * cube * s.twist;
    const lane_vec3 across = lane_vec3_add(s.bent1, s.bent2), lean = lane_vec3_add(s.bent1, across);
    lane along = k.axial * inv_length0 * s.shortened;
    if (finite) along -= shear * inv_length * inv_length * lane_vec3_dot(s.branch, across);
    return (cbm_end){
        lane_vec3_more(lane_vec3_more(sum.force, shear, across), along, s.branch),
        lane_vec3_less_cross(lane_vec3_more(sum.torque, twist, s.twist_axis), lane_vec3_scale(bend, lean), s.own)};
}

LAW cbm_end cbm_beam_law(cbm_shape s, lane inv_length0, cbm_stiffness k, int finite)
{
    return cbm_beam_add((cbm_end){lane_vec3_zero(), lane_vec3_zero()}, s, inv_length0, k, finite);
}

/* Sum over beams of x (x) f [J], x the branch now and f the force of the beam on the element (NAH19 eq. 5), with one
 * more; its parts off the diagonal twice. */
LAW lane_sym3 cbm_add_virial(lane_sym3 sum, lane_vec3 x, lane_vec3 f)
{
    return (lane_sym3){sum.xx + x.x * f.x,
                       sum.yy + x.y * f.y,
                       sum.zz + x.z * f.z,
                       sum.yz + x.y * f.z + x.z * f.y,
                       sum.xz + x.x * f.z + x.z * f.x,
                       sum.xy + x.x * f.y + x.y * f.x};
}

/* The symmetric part of such a sum. */
LAW lane_sym3 cbm_virial_of(lane_sym3 sum)
{
    return (lane_sym3){sum.xx, sum.yy, sum.zz, REAL(0.5) * sum.yz, REAL(0.5) * sum.xz, REAL(0.5) * sum.xy};
}

/* U [J]. */
LAW lane cbm_beam_energy(cbm_shape s, lane inv_length0, cbm_stiffness k, int finite)
{
    const lane_vec3 apart = lane_vec3_sub(s.bent1, s.bent2);
    const lane bent = REAL(1.5) * (lane_vec3_dot(s.bent1, s.bent1) + lane_vec3_dot(s.bent2, s.bent2)) -
                      REAL(0.5) * lane_vec3_dot(apart, apart);
    const lane elongation = finite ? cbm_elongation(s) : s.stretched * s.length0;
    return inv_length0 * (REAL(0.5) * k.axial * elongation * elongation +
                          inv_length0 * inv_length0 * (k.twist * s.twist * s.twist + k.bend * bent));
}

#endif
