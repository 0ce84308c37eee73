/* Cohesion of one face that a crack opens: how its force falls with the opening, and where the opening comes to rest beside the elastic cells
 * (docs/fracture.md, "Fracture energy"). Extrinsic: a face opens at the force it carries at that moment, so nothing jumps and a body that does not
 * crack is not softer. With the force `start` at the onset and the energy `energy` of the whole face:
 *     linear        F(w) = start (1 - w / end),                      end = 2 energy / start
 *     exponential   F(w) = start (exp(-w / l) - c) / (1 - c),        0 at end = l ln(1 / c), c = 1/100; l such that the area is energy
 * Below the largest opening so far force and opening go to zero together (secant), so half their product is held, and comes back. */
#ifndef BRC_KERNELS_SOFTENING_H
#define BRC_KERNELS_SOFTENING_H

#include "portable.h"

#define SOFT_CUT REAL(0.01)                 /* c */
#define SOFT_CUT_LOG REAL(4.605170185988092) /* ln(1 / c) */
/* 1 - c ln(1 / c) / (1 - c): the area of the exponential law over start * l. */
#define SOFT_CUT_AREA REAL(0.9534831294344638)

typedef struct { coeff x, y, z; } soft_vector;
LAW soft_vector soft_add(soft_vector a, coeff k, soft_vector b) { return (soft_vector){a.x + k * b.x, a.y + k * b.y, a.z + k * b.z}; }
LAW coeff soft_dot(soft_vector a, soft_vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAW soft_vector soft_scale(coeff k, soft_vector a) { return (soft_vector){k * a.x, k * a.y, k * a.z}; }

/* start [N], energy [J] */
typedef struct { coeff start, energy; int exponential; } soft_face;

/* Opening at which nothing is left [m]. */
LAW coeff soft_end(soft_face f) { return f.energy / f.start * (f.exponential ? SOFT_CUT_LOG / SOFT_CUT_AREA : REAL(2)); }

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

/* What is left of the energy of a face whose normal has the cosine c_onset to the principal axis at its onset and c_now to the opening: an area of crack is
 * that of its projection along the opening, which only shows once it opens (at the onset the stress near a crack leans towards the normal). Not less than
 * steepest, so that a face that only slides keeps a cost, and not more than at the onset. */
LAW coeff soft_tilt(coeff c_onset, coeff c_now, coeff steepest)
{
    const coeff c = c_now > steepest ? c_now : steepest;
    return c < c_onset ? c / c_onset : REAL(1);
}

/* Energy [J] that comes back when a face at opening w closes, widest: the largest so far. */
LAW coeff soft_held(soft_face f, coeff widest, coeff w) { return widest > 0 ? REAL(0.5) * soft_force(f, widest) / widest * w * w : 0; }

/* Opening [m] at which the cohesion balances cells that pull with drive - stiffness * opening. drive [N]; stiffness [N/m]. Where the cells give way
 * less than the cohesion falls there is no balance short of the end. */
LAW coeff soft_opening(soft_face f, coeff widest, coeff drive, coeff stiffness)
{
    if (widest > 0) {
        const coeff w = drive / (stiffness + soft_force(f, widest) / widest);
        if (w <= widest) return w;
    } else if (!(drive > f.start)) {
        return 0;
    }
    coeff w = drive / stiffness; /* Newton from the side where the sum of both is convex and rises: it comes down and stops at the root */
    for (int k = 0; k < 20; ++k) {
        const coeff rise = stiffness + soft_slope(f, w);
        if (!(rise > 0)) return drive / stiffness;
        const coeff next = w - (stiffness * w + soft_force(f, w) - drive) / rise;
        if (!(next < w)) return w;
        w = next < widest ? widest : next;
    }
    return w;
}

/* How strongly a cell draws back a face that opens along `direction` (unit) [N/m]: of its V psi, with H = ... - opening (x) pull, pull = A^-1 s [1/m];
 * reach: sum of |pull| over all open faces of the cell, which mostly open together. modulus: lambda + 2 mu, shear: mu [Pa]. */
LAW coeff soft_cell_stiffness(soft_vector pull, coeff reach, soft_vector direction, coeff volume, coeff modulus, coeff shear)
{
    const coeff size = SQRT(soft_dot(pull, pull)), along = soft_dot(pull, direction);
    if (!(size > 0)) return 0;
    return volume * reach * ((modulus - shear) * along * along / size + shear * size);
}
/* And of the bond's own term; share: ((A_i^-1 + A_j^-1) s).s q / 2, how much of the opening the two gradients take up [-]; ratio q [1/m]. */
LAW coeff soft_bond_stiffness(coeff k, coeff ratio, coeff share, coeff beta, coeff one_plus_tau)
{
    const coeff rest = REAL(1) - share;
    return k / ratio * (one_plus_tau * (rest * rest + REAL(0.5) * share) + REAL(2) * beta * rest * share);
}

#endif
