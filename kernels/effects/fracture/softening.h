/* Cohesion of one face that a crack opens: how its force falls with the opening, and where the opening comes to rest
 * beside the elastic cells (docs/notebook/fracture.md, "Fracture energy"). Extrinsic: a face opens at the force it
 * carries at that moment, so nothing jumps and a body that does not crack is not softer. With the force `start` at the
 * onset and the energy `energy` of the whole face:
 *     linear        F(w) = start (1 - w / end),                      end = 2 energy / start
 *     exponential   F(w) = start (exp(-w / l) - c) / (1 - c),        0 at end = l ln(1 / c), c = 1/100; l such that the
 *                   area is energy
 * Below the largest opening so far force and opening go to zero together (secant), so half their product is held, and
 * comes back. */
#ifndef BRC_KERNELS_SOFTENING_H
#define BRC_KERNELS_SOFTENING_H

#include "failure.h"
#include "../../core/portable.h"

#define SOFT_CUT REAL(0.01)                  /* c */
#define SOFT_CUT_LOG REAL(4.605170185988092) /* ln(1 / c) */
/* 1 - c ln(1 / c) / (1 - c): the area of the exponential law over start * l. */
#define SOFT_CUT_AREA REAL(0.9534831294344638)

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

/* start [N], energy [J] */
typedef struct {
    coeff start, energy;
    int exponential;
} soft_face;

/* What a crack across `axis` leaves to a face: of the stress along the crack the pushes, as a force on the area vector
 * `area` of the face [N]. A crack releases the traction on its own plane and nothing else; the stress along it goes on
 * through the solid on both sides, which a zig-zag of faces cuts though the crack does not (docs/notebook/theory.md
 * T10). Pulls along the crack are let go with it: cracks across them would find the face open. axis: unit vector. */
LAW soft_vector soft_carried(failure_stress m, soft_vector axis, soft_vector area)
{
    const soft_vector side = SOFT_ABS(axis.x) < REAL(0.6) ? (soft_vector){1, 0, 0} : (soft_vector){0, 1, 0};
    soft_vector a = soft_add(side, -soft_dot(side, axis), axis);
    a = soft_scale(REAL(1) / SQRT(soft_dot(a, a)), a);
    const soft_vector b = {axis.y * a.z - axis.z * a.y, axis.z * a.x - axis.x * a.z, axis.x * a.y - axis.y * a.x};
    const soft_vector ma = {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
                            m.xz * a.x + m.yz * a.y + m.zz * a.z};
    const soft_vector mb = {m.xx * b.x + m.xy * b.y + m.xz * b.z, m.xy * b.x + m.yy * b.y + m.yz * b.z,
                            m.xz * b.x + m.yz * b.y + m.zz * b.z};
    const coeff aa = soft_dot(a, ma), bb = soft_dot(b, mb), ab = soft_dot(a, mb);
    const coeff mean = REAL(0.5) * (aa + bb), split = REAL(0.5) * (aa - bb), radius = SQRT(split * split + ab * ab);
    const coeff upper = mean + radius < 0 ? mean + radius : 0, lower = mean - radius < 0 ? mean - radius : 0;
    const coeff even = REAL(0.5) * (upper + lower), odd = radius > 0 ? REAL(0.5) * (upper - lower) / radius : 0;
    const coeff sa = soft_dot(area, a), sb = soft_dot(area, b);
    return soft_add(soft_scale((even + odd * split) * sa + odd * ab * sb, a), odd * ab * sa + (even - odd * split) * sb,
                    b);
}

/* The share of this that a crack opened by `widest` still carries [-]: nothing where its sides stand clear of each
 * other, at the opening `clear` (0: never) [m]. */
LAW coeff soft_keeps(coeff widest, coeff clear)
{
    return !(clear > 0) ? REAL(1) : widest < clear ? REAL(1) - widest / clear : 0;
}

/* Opening at which nothing is left [m]. */
LAW coeff soft_end(soft_face f)
{
    return f.energy / f.start * (f.exponential ? SOFT_CUT_LOG / SOFT_CUT_AREA : REAL(2));
}

/* exp(-x), 0 <= x <= 5, from sums and products alone, which all devices round alike: the 32nd power of a Taylor sum. */
LAW coeff soft_decay(coeff x)
{
    const coeff y = x * REAL(0.03125);
    coeff sum = REAL(1);
    for (int k = 9; k > 0; --k) sum = REAL(1) - y * sum / (coeff)k;
    sum *= sum, sum *= sum, sum *= sum, sum *= sum;
    return sum * sum;
}

/* F [N] and its slope [N/m] on the first opening at w [m]. */
LAW coeff soft_force(soft_face f, coeff w)
{
    const coeff end = soft_end(f);
    if (!(w < end)) return 0;
    if (!f.exponential) return f.start * (REAL(1) - w / end);
    return f.start * (soft_decay(SOFT_CUT_LOG * w / end) - SOFT_CUT) / (REAL(1) - SOFT_CUT);
}
LAW coeff soft_slope(soft_face f, coeff w)
{
    const coeff end = soft_end(f);
    if (!(w < end)) return 0;
    if (!f.exponential) return -f.start / end;
    return -f.start * SOFT_CUT_LOG / end * soft_decay(SOFT_CUT_LOG * w / end) / (REAL(1) - SOFT_CUT);
}

/* What is left of the energy of a face whose normal has the cosine c_onset to the principal axis at its onset and c_now
 * to the opening: an area of crack is that of its projection along the opening, which only shows once it opens (at the
 * onset the stress near a crack leans towards the normal). Not less than steepest, so that a face that only slides
 * keeps a cost, and not more than at the onset. */
LAW coeff soft_tilt(coeff c_onset, coeff c_now, coeff steepest)
{
    const coeff c = c_now > steepest ? c_now : steepest;
    return c < c_onset ? c / c_onset : REAL(1);
}

/* Energy [J] that comes back when a face at opening w closes, widest: the largest so far. */
LAW coeff soft_held(soft_face f, coeff widest, coeff w)
{
    return widest > 0 ? REAL(0.5) * soft_force(f, widest) / widest * w * w : 0;
}
/* And what never does: the area below F up to widest but for what is held there. */
LAW coeff soft_spent(soft_face f, coeff widest)
{
    const coeff end = soft_end(f);
    if (!(widest < end)) return f.energy;
    const coeff x = SOFT_CUT_LOG / end; /* 1 / l */
    const coeff below =
        f.exponential ? f.start * ((REAL(1) - soft_decay(x * widest)) / x - SOFT_CUT * widest) / (REAL(1) - SOFT_CUT)
                      : f.start * widest * (REAL(1) - REAL(0.5) * widest / end);
    return below - REAL(0.5) * soft_force(f, widest) * widest;
}

/* Opening [m] at which the cohesion balances cells that pull with drive - stiffness * opening. drive [N]; stiffness
 * [N/m]. Where the cells give way less than the cohesion falls there is no balance short of the end. */
LAW coeff soft_opening(soft_face f, coeff widest, coeff drive, coeff stiffness)
{
    if (widest > 0) {
        const coeff w = drive / (stiffness + soft_force(f, widest) / widest);
        if (w <= widest) return w;
    } else if (!(drive > f.start)) {
        return 0;
    }
    coeff w = drive / stiffness; /* Newton from the side where the sum of both is convex and rises: it comes down and
                                    stops at the root */
    for (int k = 0; k < 20; ++k) {
        const coeff rise = stiffness + soft_slope(f, w);
        if (!(rise > 0)) return drive / stiffness;
        const coeff next = w - (stiffness * w + soft_force(f, w) - drive) / rise;
        if (!(next < w)) return w;
        w = next < widest ? widest : next;
    }
    return w;
}

/* No further into each other than the faces themselves allow: across the normal of the face (of any length) the opening
 * is not below 0 either, so a face that slides along the crack rides up on the other or closes the gap that its opening
 * has left. */
LAW soft_vector soft_outside(soft_vector w, soft_vector normal)
{
    const coeff into = soft_dot(w, normal);
    return into < 0 ? soft_add(w, -into / soft_dot(normal, normal), normal) : w;
}

/* Sides that nothing holds together are clear of each other: their gap along the axis, or ten times as much in any
 * direction, for what slid so far that it no longer lies against the same face. */
LAW int soft_is_clear(soft_vector w, soft_vector axis, coeff clear)
{
    return !(soft_dot(w, axis) < clear) || !(soft_dot(w, w) < REAL(100) * clear * clear);
}

/* How strongly a face is drawn back when it opens [N/m], in every direction: symmetric. */
typedef struct {
    coeff xx, yy, zz, yz, xz, xy;
} soft_tensor;
LAW soft_vector soft_tensor_times(soft_tensor k, soft_vector a)
{
    return (soft_vector){k.xx * a.x + k.xy * a.y + k.xz * a.z, k.xy * a.x + k.yy * a.y + k.yz * a.z,
                         k.xz * a.x + k.yz * a.y + k.zz * a.z};
}
LAW soft_tensor soft_tensor_add(soft_tensor a, coeff k, soft_tensor b)
{
    return (soft_tensor){a.xx + k * b.xx, a.yy + k * b.yy, a.zz + k * b.zz,
                         a.yz + k * b.yz, a.xz + k * b.xz, a.xy + k * b.xy};
}
/* a / |a|, 0 of 0. */
LAW soft_vector soft_direction(soft_vector a)
{
    const coeff most = SOFT_ABS(a.x) + SOFT_ABS(a.y) + SOFT_ABS(a.z);
    if (!(most > 0)) return (soft_vector){0, 0, 0};
    const soft_vector b = {a.x / most, a.y / most, a.z / most}; /* squares of forces may not fit single precision */
    return soft_scale(REAL(1) / SQRT(soft_dot(b, b)), b);
}
/* The direction of x in (k + more I) x = a, a unit vector; 0 of 0. k + more I is positive definite. */
LAW soft_vector soft_tensor_way(soft_tensor k, coeff more, soft_vector a)
{
    const coeff part = REAL(1) / (k.xx + k.yy + k.zz + REAL(3) * more), extra = part * more;
    const coeff xx = part * k.xx + extra, yy = part * k.yy + extra, zz = part * k.zz + extra;
    const coeff yz = part * k.yz, xz = part * k.xz, xy = part * k.xy;
    const soft_tensor adjugate = {yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                                  xy * xz - yz * xx, xy * yz - xz * yy, yz * xz - xy * zz};
    return soft_direction(soft_tensor_times(adjugate, soft_direction(a)));
}

/* Centroids of faces lie beside their branches (by a third of the size of a cell in noisy grids), so an opening along
 * its face strains the cells next to it too, through the gradients that place their faces: this share of lambda counts
 * in every direction. Without it the sweeps run away at nu 0.45, where lambda is nine times mu
 * (docs/notebook/fracture.md). */
#define SOFT_BESIDE REAL(0.3)

/* Adds what a cell draws back with: of its V psi, with H = ... - opening (x) pull, pull = A^-1 s [1/m]; reach: sum of
 * |pull| over all open faces of the cell: that sum over faces is not below the cell's own energy whatever the openings
 * (Cauchy and Schwarz). modulus: lambda + 2 mu, shear: mu [Pa]. */
LAW soft_tensor soft_add_cell(soft_tensor k, soft_vector pull, coeff reach, coeff volume, coeff modulus, coeff shear)
{
    const coeff size = SQRT(soft_dot(pull, pull));
    if (!(size > 0)) return k;
    const coeff lambda = modulus - REAL(2) * shear, beside = lambda > 0 ? SOFT_BESIDE * lambda : 0;
    const coeff both = volume * reach * (shear + beside) * size, along = volume * reach * (modulus - shear) / size;
    return (soft_tensor){k.xx + both + along * pull.x * pull.x, k.yy + both + along * pull.y * pull.y,
                         k.zz + both + along * pull.z * pull.z, k.yz + along * pull.y * pull.z,
                         k.xz + along * pull.x * pull.z,        k.xy + along * pull.x * pull.y};
}
/* And of the bond's own term; share: ((A_i^-1 + A_j^-1) s).s q / 2, how much of the opening the two gradients take up
 * [-]; ratio q [1/m]. */
LAW coeff soft_bond_stiffness(coeff k, coeff ratio, coeff share, coeff beta, coeff one_plus_tau)
{
    const coeff rest = REAL(1) - share;
    return k / ratio * (one_plus_tau * (rest * rest + REAL(0.5) * share) + REAL(2) * beta * rest * share);
}

/* The opening [m] at which the cohesion, along the opening, balances cells that pull with drive - k opening: (k + F /
 * |w|) w = drive, by turns of |w| along a direction and of the direction, begun with `pulled` = F / |w| of the opening
 * so far [N/m] (0 of a face that is shut: it goes along drive). A crack does not close further than shut: along its
 * axis w is not below 0. What is shut bears on itself. */
LAW soft_vector soft_free_balance(soft_face f, coeff widest, soft_vector drive, soft_tensor k, coeff pulled,
                                  soft_vector axis)
{
    const soft_vector none = {0, 0, 0};
    soft_vector way = pulled > 0 ? soft_tensor_way(k, pulled, drive) : soft_direction(drive);
    coeff w = 0;
    for (int turn = 0; turn < 3; ++turn) {
        const coeff across = soft_dot(way, axis);
        if (across < 0) way = soft_direction(soft_add(way, -across, axis));
        const coeff along = soft_dot(way, drive);
        if (!(along > 0)) return none;
        w = soft_opening(f, widest, along, soft_dot(way, soft_tensor_times(k, way)));
        if (!(w > 0)) return none;
        if (turn < 2) {
            const coeff at = w > widest ? w : widest;
            way = soft_tensor_way(k, soft_force(f, at) / at, drive);
        }
    }
    return soft_scale(w, way);
}

/* The same where something holds the two sides against sliding: the carried force, in its own direction, up to what it
 * is; friction times the push on faces that are shut, and `held` [N], in any. What stays within that (a force nearer
 * than held to the stretch from 0 to carried) opens along the axis of the crack alone, from where it was (before);
 * beyond it slides straight away from there, so that sliding never gives energy. axis: unit vector of the crack;
 * carried: across it [N]; friction [-]. */
LAW soft_vector soft_balance(soft_face f, coeff widest, soft_vector drive, soft_tensor k, coeff pulled,
                             soft_vector axis, soft_vector before, coeff friction, soft_vector carried, coeff held)
{
    const soft_vector slid = soft_add(before, -soft_dot(before, axis), axis);
    const soft_vector rest = soft_add(drive, REAL(-1), soft_tensor_times(k, slid)), stiff = soft_tensor_times(k, axis);
    const coeff pull = soft_dot(rest, axis), w = pull > 0 ? soft_opening(f, widest, pull, soft_dot(stiff, axis)) : 0;
    const coeff hold = held + (pull < 0 ? -friction * pull : 0), square = soft_dot(carried, carried);
    if (!(hold > 0) && !(square > 0)) return soft_free_balance(f, widest, drive, k, pulled, axis);
    const soft_vector stuck = soft_add(slid, w, axis), left = soft_add(rest, -w, stiff);
    const coeff size = SQRT(soft_dot(stuck, stuck)), at = size > widest ? size : widest;
    const soft_vector along = soft_add(left, at > 0 ? -soft_force(f, at) / at : 0, slid),
                      shear = soft_add(along, -soft_dot(along, axis), axis);
    const coeff part = square > 0 ? soft_dot(shear, carried) / square : 0, share = part > REAL(1) ? REAL(1)
                                                                                   : part > 0     ? part
                                                                                                  : 0;
    const soft_vector beyond = soft_add(shear, -share, carried);
    const coeff excess = SQRT(soft_dot(beyond, beyond));
    if (!(excess > hold)) return stuck;
    return soft_free_balance(f, widest, soft_add(soft_add(drive, -share, carried), -hold / excess, beyond), k, pulled,
                             axis);
}

/* Pushes on a face and along it times this hold its two sides against pulling unevenly: beside lines of contact the
 * stress changes by several times itself from cell to cell, which turns nothing (discs between platens crumbled at 1,
 * quick cracks rubbed off a quarter of the elastic energy at 3; docs/notebook/fracture.md). Of a face that is still
 * whole, SOFT_EDGE_HELD. */
#define SOFT_UNEVEN_HELD REAL(10)
#define SOFT_EDGE_HELD REAL(3)
/* Sides of a broken face that did not turn, |v|^2 below this times |w|^2, no longer do: they fly apart. */
#define SOFT_UNEVEN_RESTS REAL(0.02)

/* a without its part along n, a vector of any length. */
LAW soft_vector soft_beside(soft_vector a, soft_vector n) { return soft_add(a, -soft_dot(a, n) / soft_dot(n, n), n); }

/* What the openings of the two sides change against each other [m], along the face: uneven: by how much more one side
 * pulls than the other, were they to stay [N]; sides: stiffness of both; before: what they are against each other now;
 * widest: opening of the face; even: what of the unevenness friction bears [N]. The cohesion draws this back as it
 * draws back the opening. A face that only turns opens by this alone. */
LAW soft_vector soft_side(soft_face f, coeff widest, soft_vector uneven, soft_tensor sides, soft_vector before,
                          coeff even, soft_vector normal)
{
    const coeff drawn = widest > 0 ? soft_force(f, widest) / widest : 0;
    const soft_vector drive = soft_beside(soft_add(uneven, -drawn, before), normal);
    const coeff size = SQRT(soft_dot(drive, drive));
    if (!(size > even)) return (soft_vector){0, 0, 0};
    const soft_vector way =
        soft_direction(widest > 0 ? soft_beside(soft_tensor_way(sides, drawn, drive), normal) : drive);
    const coeff along = (REAL(1) - even / size) * soft_dot(way, drive),
                stiff = soft_dot(way, soft_tensor_times(sides, way));
    return soft_scale(widest > 0 ? along / (stiff + drawn) : soft_opening(f, widest, along, stiff), way);
}

#endif
