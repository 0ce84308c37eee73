/* Cohesion of one face that a crack opens: how its force falls with the opening, and where the opening comes to rest
 * beside the elastic cells (docs/notebook/fracture.md, "Fracture energy"). Extrinsic: a face opens at the force it
 * carries at that moment, so nothing jumps and a body that does not crack is not softer. With the force `start` at the
 * onset and the energy `energy` of the whole face:
 *     linear        F(w) = start (1 - w / end),                      end = 2 energy / start
 *     exponential   F(w) = start (exp(-w / l) - c) / (1 - c),        0 at end = l ln(1 / c), c = 1/100; l such that the
 *                   area is energy
 * Below the largest opening so far force and opening go to zero together (secant), so half their product is held, and
 * comes back. Faces of W bonds at once, in lanes; single numbers of one bond at the end of the file. */
#ifndef BRC_KERNELS_SOFTENING_H
#define BRC_KERNELS_SOFTENING_H

#include "failure.h"
#include "../../core/vec.h"

#define SOFT_CUT REAL(0.01)                  /* c */
#define SOFT_CUT_LOG REAL(4.605170185988092) /* ln(1 / c) */
/* 1 - c ln(1 / c) / (1 - c): the area of the exponential law over start * l. */
#define SOFT_CUT_AREA REAL(0.9534831294344638)

LAW lane soft_above(lane a, coeff least) { return lane_max(a, lane_number(least)); }
LAW lane soft_size(lane_vec3 a) { return LANE_SQRT(lane_vec3_dot(a, a)); }
/* 1 / |a| times a. */
LAW lane_vec3 soft_unit_of(lane_vec3 a) { return lane_vec3_scale(REAL(1) / soft_size(a), a); }

/* start [N], energy [J]; exponential: 1, else 0 */
typedef struct {
    lane start, energy, exponential;
} soft_face;

/* What a crack across `axis` leaves to a face: of the stress along the crack the pushes, as a force on the area vector
 * `area` of the face [N]. A crack releases the traction on its own plane and nothing else; the stress along it goes on
 * through the solid on both sides, which a zig-zag of faces cuts though the crack does not (docs/notebook/theory.md
 * T10). Pulls along the crack are let go with it: cracks across them would find the face open. axis: unit vector. */
LAW lane_vec3 soft_carried(lane_sym3 m, lane_vec3 axis, lane_vec3 area)
{
    const lane none = LANE_ZERO, one = lane_number(1);
    const lane_mask flat = LANE_LESS(lane_max(axis.x, -axis.x), lane_number(REAL(0.6)));
    const lane_vec3 side = {LANE_WHERE(flat, one, none), LANE_WHERE(flat, none, one), none};
    const lane_vec3 a = soft_unit_of(lane_vec3_more(side, -lane_vec3_dot(side, axis), axis)),
                    b = lane_vec3_cross(axis, a);
    const lane_vec3 ma = lane_sym3_mul_vec(m, a), mb = lane_sym3_mul_vec(m, b);
    const lane aa = lane_vec3_dot(a, ma), bb = lane_vec3_dot(b, mb), ab = lane_vec3_dot(a, mb);
    const lane mean = REAL(0.5) * (aa + bb), split = REAL(0.5) * (aa - bb), radius = LANE_SQRT(split * split + ab * ab);
    const lane upper = lane_min(mean + radius, none), lower = lane_min(mean - radius, none);
    const lane even = REAL(0.5) * (upper + lower),
               odd = LANE_WHERE(LANE_LESS(none, radius), REAL(0.5) * (upper - lower) / radius, none);
    const lane sa = lane_vec3_dot(area, a), sb = lane_vec3_dot(area, b);
    return lane_vec3_more(lane_vec3_scale((even + odd * split) * sa + odd * ab * sb, a),
                          odd * ab * sa + (even - odd * split) * sb, b);
}

/* The share of this that a crack opened by `widest` still carries [-]: nothing where its sides stand clear of each
 * other, at the opening `clear` (0: never) [m]. */
LAW lane soft_keeps(lane widest, lane clear)
{
    const lane left = LANE_WHERE(LANE_LESS(widest, clear), REAL(1) - widest / clear, LANE_ZERO);
    return LANE_WHERE(LANE_LESS(LANE_ZERO, clear), left, lane_number(1));
}

/* Opening at which nothing is left [m]. */
LAW lane soft_end(soft_face f)
{
    return f.energy / f.start *
           LANE_WHERE(LANE_LESS(LANE_ZERO, f.exponential), lane_number(SOFT_CUT_LOG / SOFT_CUT_AREA), lane_number(2));
}

/* exp(-x), 0 <= x <= 5, from sums and products alone, which all devices round alike: the 32nd power of a Taylor sum. */
LAW lane soft_decay(lane x)
{
    const lane y = x * REAL(0.03125);
    lane sum = lane_number(1);
    for (int k = 9; k > 0; --k) sum = REAL(1) - y * sum / (coeff)k;
    sum *= sum, sum *= sum, sum *= sum, sum *= sum;
    return sum * sum;
}

/* F [N] and its slope [N/m] on the first opening at w [m]. */
LAW lane soft_force(soft_face f, lane w)
{
    const lane end = soft_end(f);
    const lane_mask bent = LANE_LESS(LANE_ZERO, f.exponential);
    lane force = f.start * (REAL(1) - w / end);
    if (LANE_SOME(bent))
        force =
            LANE_WHERE(bent, f.start * (soft_decay(SOFT_CUT_LOG * w / end) - SOFT_CUT) / (REAL(1) - SOFT_CUT), force);
    return LANE_WHERE(LANE_LESS(w, end), force, LANE_ZERO);
}
LAW lane soft_slope(soft_face f, lane w)
{
    const lane end = soft_end(f);
    const lane_mask bent = LANE_LESS(LANE_ZERO, f.exponential);
    lane slope = -f.start / end;
    if (LANE_SOME(bent))
        slope = LANE_WHERE(
            bent, -f.start * SOFT_CUT_LOG / end * soft_decay(SOFT_CUT_LOG * w / end) / (REAL(1) - SOFT_CUT), slope);
    return LANE_WHERE(LANE_LESS(w, end), slope, LANE_ZERO);
}
/* F / w, 0 where w is not above 0. */
LAW lane soft_secant(soft_face f, lane w)
{
    return LANE_WHERE(LANE_LESS(LANE_ZERO, w), soft_force(f, w) / w, LANE_ZERO);
}

/* What is left of the energy of a face whose normal has the cosine c_onset to the principal axis at its onset and c_now
 * to the opening: an area of crack is that of its projection along the opening, which only shows once it opens (at the
 * onset the stress near a crack leans towards the normal). Not less than steepest, so that a face that only slides
 * keeps a cost, and not more than at the onset. c_onset below 0, in an interface: all of it. */
LAW lane soft_tilt(lane c_onset, lane c_now, coeff steepest)
{
    const lane c = soft_above(c_now, steepest);
    return LANE_WHERE(LANE_LESS(c, c_onset), c / c_onset, lane_number(1));
}

/* Energy [J] that comes back when a face at opening w closes, widest: the largest so far. */
LAW lane soft_held(soft_face f, lane widest, lane w)
{
    return LANE_WHERE(LANE_LESS(LANE_ZERO, widest), REAL(0.5) * soft_force(f, widest) / widest * w * w, LANE_ZERO);
}
/* And what never does: the area below F up to widest but for what is held there. */
LAW lane soft_spent(soft_face f, lane widest)
{
    const lane end = soft_end(f), x = SOFT_CUT_LOG / end; /* 1 / l */
    const lane bent = f.start * ((REAL(1) - soft_decay(x * widest)) / x - SOFT_CUT * widest) / (REAL(1) - SOFT_CUT);
    const lane below =
        LANE_WHERE(LANE_LESS(LANE_ZERO, f.exponential), bent, f.start * widest * (REAL(1) - REAL(0.5) * widest / end));
    return LANE_WHERE(LANE_LESS(widest, end), below - REAL(0.5) * soft_force(f, widest) * widest, f.energy);
}

/* Opening [m] at which the cohesion balances cells that pull with drive - stiffness * opening. drive [N]; stiffness
 * [N/m]. Where the cells give way less than the cohesion falls there is no balance short of the end. asked: the lanes
 * that count. */
LAW lane soft_opening(soft_face f, lane widest, lane drive, lane stiffness, lane_mask asked)
{
    const lane_mask opened = LANE_LESS(LANE_ZERO, widest);
    const lane back = drive / (stiffness + soft_secant(f, widest));
    const lane_mask rests = (opened & ~LANE_LESS(widest, back)) | (~opened & ~LANE_LESS(f.start, drive));
    const lane whole = drive / stiffness;
    lane_mask moves = asked & ~rests;
    lane w = whole; /* Newton from the side where the sum of both is convex and rises: it comes down and stops at the
                       root */
    for (int k = 0; k < 20 && LANE_SOME(moves); ++k) {
        const lane rise = stiffness + soft_slope(f, w);
        const lane next = w - (stiffness * w + soft_force(f, w) - drive) / rise;
        const lane_mask rises = LANE_LESS(LANE_ZERO, rise);
        w = LANE_WHERE(moves & ~rises, whole, w);
        moves &= rises & LANE_LESS(next, w);
        w = LANE_WHERE(moves, lane_max(next, widest), w);
    }
    return LANE_WHERE(rests, LANE_WHERE(opened, back, LANE_ZERO), w);
}

/* No further into each other than the faces themselves allow: across the normal of the face (of any length) the opening
 * is not below 0 either, so a face that slides along the crack rides up on the other or closes the gap that its opening
 * has left. */
LAW lane_vec3 soft_outside(lane_vec3 w, lane_vec3 normal)
{
    const lane into = lane_vec3_dot(w, normal);
    return lane_vec3_where(LANE_LESS(into, LANE_ZERO), lane_vec3_more(w, -into / lane_vec3_dot(normal, normal), normal),
                           w);
}

/* Sides that nothing holds together are clear of each other: their gap along the axis, or ten times as much in any
 * direction, for what slid so far that it no longer lies against the same face. */
LAW lane_mask soft_is_clear(lane_vec3 w, lane_vec3 axis, lane clear)
{
    return ~LANE_LESS(lane_vec3_dot(w, axis), clear) | ~LANE_LESS(lane_vec3_dot(w, w), REAL(100) * clear * clear);
}

/* How strongly a face is drawn back when it opens [N/m], in every direction, is a symmetric matrix. */
/* a / |a|, 0 of 0. */
LAW lane_vec3 soft_direction(lane_vec3 a)
{
    const lane most = lane_max(a.x, -a.x) + lane_max(a.y, -a.y) + lane_max(a.z, -a.z);
    const lane_vec3 b = {a.x / most, a.y / most, a.z / most}; /* squares of forces may not fit single precision */
    return lane_vec3_where(LANE_LESS(LANE_ZERO, most), soft_unit_of(b), lane_vec3_zero());
}
/* The direction of x in (k + more I) x = a, a unit vector; 0 of 0. k + more I is positive definite. */
LAW lane_vec3 soft_tensor_way(lane_sym3 k, lane more, lane_vec3 a)
{
    const lane part = REAL(1) / (k.xx + k.yy + k.zz + REAL(3) * more), extra = part * more;
    const lane xx = part * k.xx + extra, yy = part * k.yy + extra, zz = part * k.zz + extra;
    const lane yz = part * k.yz, xz = part * k.xz, xy = part * k.xy;
    const lane_sym3 adjugate = {yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                                xy * xz - yz * xx, xy * yz - xz * yy, yz * xz - xy * zz};
    return soft_direction(lane_sym3_mul_vec(adjugate, soft_direction(a)));
}

/* Centroids of faces lie beside their branches (by a third of the size of a cell in noisy grids), so an opening along
 * its face strains the cells next to it too, through the gradients that place their faces: this share of lambda counts
 * in every direction. Without it the sweeps run away at nu 0.45, where lambda is nine times mu
 * (docs/notebook/fracture.md). */
#define SOFT_BESIDE REAL(0.3)

/* What a cell draws back with: of its V psi, with H = ... - opening (x) pull, pull = A^-1 s [1/m]; reach: sum of
 * |pull| over all open faces of the cell: that sum over faces is not below the cell's own energy whatever the openings
 * (Cauchy and Schwarz); more where its faces' centroids lie far beside their branches (softening_onset.cl,
 * soft_together). modulus: lambda + 2 mu, shear: mu [Pa]. */
LAW lane_sym3 soft_cell_stiffness(lane_vec3 pull, lane reach, lane volume, lane modulus, lane shear)
{
    const lane size = soft_size(pull), lambda = modulus - REAL(2) * shear;
    const lane_mask pulls = LANE_LESS(LANE_ZERO, size);
    const lane beside = SOFT_BESIDE * soft_above(lambda, 0);
    const lane both = volume * reach * (shear + beside) * size;
    const lane along = LANE_WHERE(pulls, volume * reach * (modulus - shear) / size, LANE_ZERO);
    return (lane_sym3){both + along * pull.x * pull.x, both + along * pull.y * pull.y, both + along * pull.z * pull.z,
                       along * pull.y * pull.z,        along * pull.x * pull.z,        along * pull.x * pull.y};
}
/* And of the bond's own term; share: ((A_i^-1 + A_j^-1) s).s q / 2, how much of the opening the two gradients take up
 * [-]; ratio q [1/m]. */
LAW lane soft_bond_stiffness(lane k, lane ratio, lane share, coeff beta, coeff one_plus_tau)
{
    const lane rest = REAL(1) - share;
    return k / ratio * (one_plus_tau * (rest * rest + REAL(0.5) * share) + REAL(2) * beta * rest * share);
}

/* The opening [m] at which the cohesion, along the opening, balances cells that pull with drive - k opening: (k + F /
 * |w|) w = drive, by turns of |w| along a direction and of the direction, begun with `pulled` = F / |w| of the opening
 * so far [N/m] (0 of a face that is shut: it goes along drive). A crack does not close further than shut: along its
 * axis w is not below 0. What is shut bears on itself. */
LAW lane_vec3 soft_free_balance(soft_face f, lane widest, lane_vec3 drive, lane_sym3 k, lane pulled, lane_vec3 axis,
                                lane_mask asked)
{
    lane_vec3 way =
        lane_vec3_where(LANE_LESS(LANE_ZERO, pulled), soft_tensor_way(k, pulled, drive), soft_direction(drive));
    lane w = LANE_ZERO;
    lane_mask opens = asked;
    for (int turn = 0; turn < 3 && LANE_SOME(opens); ++turn) {
        const lane across = lane_vec3_dot(way, axis);
        const lane_mask shut = LANE_LESS(across, LANE_ZERO);
        if (LANE_SOME(shut)) way = lane_vec3_where(shut, soft_direction(lane_vec3_more(way, -across, axis)), way);
        const lane along = lane_vec3_dot(way, drive);
        opens &= LANE_LESS(LANE_ZERO, along);
        w = soft_opening(f, widest, along, lane_vec3_dot(way, lane_sym3_mul_vec(k, way)), opens);
        opens &= LANE_LESS(LANE_ZERO, w);
        if (turn < 2) way = soft_tensor_way(k, soft_secant(f, lane_max(w, widest)), drive);
    }
    return lane_vec3_where(opens, lane_vec3_scale(w, way), lane_vec3_zero());
}

/* The same where something holds the two sides against sliding: the carried force, in its own direction, up to what it
 * is; friction times the push on faces that are shut, and `held` [N], in any. What stays within that (a force nearer
 * than held to the stretch from 0 to carried) opens along the axis of the crack alone, from where it was (before);
 * beyond it slides straight away from there, so that sliding never gives energy. axis: unit vector of the crack;
 * carried: across it [N]; friction [-]. */
LAW lane_vec3 soft_balance(soft_face f, lane widest, lane_vec3 drive, lane_sym3 k, lane pulled, lane_vec3 axis,
                           lane_vec3 before, coeff friction, lane_vec3 carried, lane held)
{
    const lane none = LANE_ZERO;
    const lane_vec3 slid = lane_vec3_more(before, -lane_vec3_dot(before, axis), axis);
    const lane_vec3 rest = lane_vec3_sub(drive, lane_sym3_mul_vec(k, slid)), stiff = lane_sym3_mul_vec(k, axis);
    const lane pull = lane_vec3_dot(rest, axis), square = lane_vec3_dot(carried, carried);
    const lane_mask pulls = LANE_LESS(none, pull);
    const lane hold = held + LANE_WHERE(LANE_LESS(pull, none), -friction * pull, none);
    const lane_mask holds = LANE_LESS(none, hold) | LANE_LESS(none, square);
    lane_vec3 stuck = lane_vec3_zero(), freely = drive;
    lane_mask slides = LANE_ALL;
    if (LANE_SOME(holds)) {
        const lane w =
            LANE_WHERE(pulls, soft_opening(f, widest, pull, lane_vec3_dot(stiff, axis), pulls & holds), none);
        stuck = lane_vec3_more(slid, w, axis);
        const lane_vec3 left = lane_vec3_more(rest, -w, stiff);
        const lane_vec3 along = lane_vec3_more(left, -soft_secant(f, lane_max(soft_size(stuck), widest)), slid),
                        shear = lane_vec3_more(along, -lane_vec3_dot(along, axis), axis);
        const lane part = LANE_WHERE(LANE_LESS(none, square), lane_vec3_dot(shear, carried) / square, none);
        const lane share = lane_min(soft_above(part, 0), lane_number(1));
        const lane_vec3 beyond = lane_vec3_more(shear, -share, carried);
        const lane excess = soft_size(beyond);
        slides = ~holds | LANE_LESS(hold, excess);
        freely = lane_vec3_where(holds, lane_vec3_more(lane_vec3_more(drive, -share, carried), -hold / excess, beyond),
                                 drive);
    }
    return lane_vec3_where(slides, soft_free_balance(f, widest, freely, k, pulled, axis, slides), stuck);
}

/* Sides of a broken face with |v|^2 below this times |w|^2, which nothing pushes along the crack, fly apart: they no
 * longer turn. */
#define SOFT_SIDES_EVEN REAL(0.02)

/* a without its part along n, a vector of any length. */
LAW lane_vec3 soft_beside(lane_vec3 a, lane_vec3 n)
{
    return lane_vec3_more(a, -lane_vec3_dot(a, n) / lane_vec3_dot(n, n), n);
}

/* What the openings of the two sides change against each other [m], along the face: uneven: by how much more one side
 * pulls than the other, were they to stay [N]; sides: stiffness of both; before: what they are against each other now;
 * widest: opening of the face; even: what of the unevenness friction bears [N]. The cohesion draws this back as it
 * draws back the opening. A face that only turns opens by this alone. asked: the lanes that count, 0 in the others. */
LAW lane_vec3 soft_side(soft_face f, lane widest, lane_vec3 uneven, lane_sym3 sides, lane_vec3 before, lane_vec3 lacks,
                        lane even, lane_vec3 normal, lane_mask asked)
{
    const lane_mask opened = LANE_LESS(LANE_ZERO, widest);
    const lane drawn = soft_secant(f, widest);
    const lane_vec3 drive = soft_beside(lane_vec3_more(uneven, -drawn, before), normal);
    const lane size = soft_size(drive);
    const lane_mask turns = asked & LANE_LESS(even, size);
    if (!LANE_SOME(turns)) return lane_vec3_zero();
    const lane_vec3 way =
        soft_direction(lane_vec3_where(opened, soft_beside(soft_tensor_way(sides, drawn, drive), normal), drive));
    const lane along = (REAL(1) - even / size) * lane_vec3_dot(way, drive),
               stiff = lane_vec3_dot(way, lane_sym3_mul_vec(sides, way));
    const lane first = soft_opening(f, widest, along, stiff, turns & ~opened);
    const lane most = soft_above(lane_max(lane_vec3_dot(way, lacks), -lane_vec3_dot(way, before)), 0);
    return lane_vec3_where(turns,
                           lane_vec3_scale(lane_min(LANE_WHERE(opened, along / (stiff + drawn), first), most), way),
                           lane_vec3_zero());
}

/* ---- single numbers, of one bond ---- */
#define SOFT_ABS(a) ((a) < 0 ? -(a) : (a))
typedef struct {
    coeff x, y, z;
} soft_vector;
LAW soft_vector soft_add(soft_vector a, coeff k, soft_vector b)
{
    return (soft_vector){a.x + k * b.x, a.y + k * b.y, a.z + k * b.z};
}
LAW coeff soft_dot(soft_vector a, soft_vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAW soft_vector soft_scale(coeff k, soft_vector a) { return (soft_vector){k * a.x, k * a.y, k * a.z}; }

#endif
