/* When a stress is too much: principal values and directions of a symmetric tensor, and limits on it. Tension is
 * positive.
 *
 * Every limit is a ratio of degree one in the stress, so 1 / ratio is the factor on the load at which it is reached:
 *     tension      sigma_I / tension                                      NAH19 eq. 7
 *     compression  -sigma_III / compression                               NAH19 section 4.5
 *     shear        ((sigma_I - sigma_III) + sin phi (sigma_I + sigma_III)) / (2 c cos phi)     Mohr-Coulomb
 *                  (sqrt J2 + a I1) / k                                   Drucker-Prager
 * The largest one counts. A limit of 0 is none. */
#ifndef BRC_KERNELS_FAILURE_H
#define BRC_KERNELS_FAILURE_H

#include "../../core/portable.h"

#define FAILURE_TENSION 1
#define FAILURE_COMPRESSION 2
#define FAILURE_SHEAR 3

typedef struct {
    coeff xx, yy, zz, yz, xz, xy;
} failure_stress; /* [Pa] */

typedef struct {
    coeff x, y, z;
} failure_axis;

/* first >= second >= third [Pa], and their unit vectors, signs open. */
typedef struct {
    coeff first, second, third;
    failure_axis first_axis, second_axis, third_axis;
} failure_principal;

/* Limits of one element; tension, compression [Pa]; shear: 2 c cos phi, or k [Pa]. */
typedef struct {
    coeff tension, compression, shear;
} failure_limits;

/* How shear counts, one for a scene. slope: sin phi, or a; friction: sin phi, for the plane it slides on. */
typedef struct {
    int drucker_prager;
    coeff slope, friction;
} failure_shear;

typedef struct {
    coeff ratio;                /* >= 1: failed [-] */
    coeff stress;               /* the principal value that counts; shear: half the difference of the outer two [Pa] */
    failure_axis normal, other; /* normals of the planes it fails on, both equal unless it shears */
    int mode;                   /* FAILURE_..., 0: no limit */
} failure_state;

LAW coeff failure_absolute(coeff x) { return x < 0 ? -x : x; }
LAW coeff failure_larger(coeff a, coeff b) { return a > b ? a : b; }
/* k a + m b */
LAW failure_axis failure_mix(coeff k, failure_axis a, coeff m, failure_axis b)
{
    return (failure_axis){k * a.x + m * b.x, k * a.y + m * b.y, k * a.z + m * b.z};
}

/* What one rotation of axes p and q touches: their block, the two entries with the third axis r, and the axes. */
typedef struct {
    coeff pp, qq, pq, rp, rq;
    failure_axis p, q;
} failure_pair;

/* Turn so that pq becomes 0. */
LAW failure_pair failure_turn(failure_pair a)
{
    if (!(failure_absolute(a.pq) > REAL(1e-18))) return a;
    const coeff theta = (a.qq - a.pp) / (REAL(2) * a.pq);
    const coeff t = (theta < 0 ? REAL(-1) : REAL(1)) / (failure_absolute(theta) + SQRT(theta * theta + REAL(1)));
    const coeff c = REAL(1) / SQRT(t * t + REAL(1)), n = t * c;
    return (failure_pair){a.pp - t * a.pq,
                          a.qq + t * a.pq,
                          0,
                          c * a.rp - n * a.rq,
                          n * a.rp + c * a.rq,
                          failure_mix(c, a.p, -n, a.q),
                          failure_mix(n, a.p, c, a.q)};
}

/* Larger value first. */
LAW failure_pair failure_order(failure_pair a)
{
    return a.pp >= a.qq ? a : (failure_pair){a.qq, a.pp, a.pq, a.rq, a.rp, a.q, a.p};
}

/* Cyclic Jacobi rotations: only sums, products, quotients and roots, so all devices agree; exact for multiple values
 * too. Values to rounding of the largest, whatever their size. */
LAW failure_principal failure_principal_of(failure_stress s)
{
    const coeff size = failure_larger(failure_larger(failure_larger(failure_absolute(s.xx), failure_absolute(s.yy)),
                                                     failure_larger(failure_absolute(s.zz), failure_absolute(s.yz))),
                                      failure_larger(failure_absolute(s.xz), failure_absolute(s.xy)));
    failure_axis x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    if (!(size > 0)) return (failure_principal){0, 0, 0, x, y, z};
    coeff xx = s.xx / size, yy = s.yy / size, zz = s.zz / size, yz = s.yz / size, xz = s.xz / size, xy = s.xy / size;
    for (int sweep = 0; sweep < 12; ++sweep) {
        if (!(yz * yz + xz * xz + xy * xy > REAL(1e-34))) break;
        failure_pair a = failure_turn((failure_pair){xx, yy, xy, xz, yz, x, y});
        xx = a.pp, yy = a.qq, xy = a.pq, xz = a.rp, yz = a.rq, x = a.p, y = a.q;
        a = failure_turn((failure_pair){xx, zz, xz, xy, yz, x, z});
        xx = a.pp, zz = a.qq, xz = a.pq, xy = a.rp, yz = a.rq, x = a.p, z = a.q;
        a = failure_turn((failure_pair){yy, zz, yz, xy, xz, y, z});
        yy = a.pp, zz = a.qq, yz = a.pq, xy = a.rp, xz = a.rq, y = a.p, z = a.q;
    }
    const failure_pair one = failure_order((failure_pair){xx, yy, 0, 0, 0, x, y});
    const failure_pair two = failure_order((failure_pair){one.qq, zz, 0, 0, 0, one.q, z});
    const failure_pair top = failure_order((failure_pair){one.pp, two.pp, 0, 0, 0, one.p, two.p});
    return (failure_principal){size * top.pp, size * top.qq, size * two.qq, top.p, top.q, two.q};
}

/* limit - sign sigma is positive definite: every principal value of sign sigma is below the limit. */
LAW int failure_all_below(failure_stress s, coeff sign, coeff limit)
{
    const coeff a = limit - sign * s.xx, b = limit - sign * s.yy, c = limit - sign * s.zz;
    const coeff minor = a * b - s.xy * s.xy;
    const coeff det =
        c * minor - sign * s.yz * (sign * a * s.yz + s.xy * s.xz) - sign * s.xz * (s.xy * s.yz + sign * s.xz * b);
    return a > 0 && minor > 0 && det > 0;
}

/* 0: no limit is within reach, without the principal values. Leaves a little room for its own rounding. */
LAW int failure_possible(failure_stress s, failure_limits limits, failure_shear shear)
{
    const coeff near = REAL(0.999);
    if (limits.tension > 0 && !failure_all_below(s, REAL(1), near * limits.tension)) return 1;
    if (limits.compression > 0 && !failure_all_below(s, REAL(-1), near * limits.compression)) return 1;
    if (limits.shear > 0) {
        const coeff mean = REAL(0.33333333333333333) * (s.xx + s.yy + s.zz), xx = s.xx - mean, yy = s.yy - mean,
                    zz = s.zz - mean; /* of the deviator, sigma_I - sigma_III + a (sigma_I + sigma_III) is at most */
        const coeff square =          /* sqrt(2 + 2 a^2 / 3) times the size, and sqrt J2 is sqrt(1/2) of it */
            xx * xx + yy * yy + zz * zz + REAL(2) * (s.yz * s.yz + s.xz * s.xz + s.xy * s.xy);
        const coeff times = shear.drucker_prager ? REAL(0.5) : REAL(2) + REAL(0.6667) * shear.slope * shear.slope,
                    along = shear.drucker_prager ? REAL(3) * shear.slope * mean : REAL(2) * shear.slope * mean;
        if (SQRT(times * square) + along >= near * limits.shear) return 1;
    }
    return 0;
}

/* The largest principal value from above, and what tells how near a direction is to its axis, without principal values:
 * A = adj(sigma - lambda 1) of sigma over its size, whose principal values are a1 = (lambda - s2) (lambda - s3) along
 * that axis and, across it, 0 to `slack`, nothing where lambda is s1. So for a unit vector x
 *     a1 cos^2 <= x.A x <= a1 cos^2 + slack,
 * and quotients of x.A x of several directions need no a1. known: 0 where the largest two are so close that A says
 * nothing. */
typedef struct {
    coeff first;             /* lambda >= s1 [Pa] */
    failure_stress adjugate; /* A [-] */
    coeff slack;             /* [-] */
    int known;
} failure_leading;

/* Two steps of Newton from the start of failure_bound.h, all from above: off by 2e-6 of the deviator where the three
 * values are apart. The second invariant of A is 3 mu q, of which slack a1 is a part, and a1 at least a third of the
 * trace of A, which is the slope of q. Slopes of some size alone: rounding moves mu by itself over the slope. */
LAW failure_leading failure_leading_of(failure_stress s)
{
    const coeff rounding = BRC_PRECISION == 0 ? REAL(1e-12) : REAL(1e-4);
    failure_leading out = {0, {0, 0, 0, 0, 0, 0}, 0, 0};
    const coeff size = failure_larger(failure_larger(failure_larger(failure_absolute(s.xx), failure_absolute(s.yy)),
                                                     failure_larger(failure_absolute(s.zz), failure_absolute(s.yz))),
                                      failure_larger(failure_absolute(s.xz), failure_absolute(s.xy)));
    if (!(size > 0)) return out;
    const coeff unit = REAL(1) / size, mean = REAL(0.33333333333333333) * unit * (s.xx + s.yy + s.zz);
    const coeff xx = unit * s.xx - mean, yy = unit * s.yy - mean, zz = unit * s.zz - mean, yz = unit * s.yz,
                xz = unit * s.xz, xy = unit * s.xy;
    const coeff j2 = REAL(0.5) * (xx * xx + yy * yy + zz * zz) + (yz * yz + xz * xz + xy * xy);
    const coeff j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    if (!(j2 > rounding)) return out;
    coeff mu = REAL(0.88888888888888889) * SQRT(REAL(1.3333333333333333) * j2) + REAL(0.33333333333333333) * j3 / j2;
    coeff slope = REAL(3) * mu * mu - j2;
    for (int step = 0; step < 2 && slope > REAL(0.01) * j2; ++step) {
        mu -= (mu * (mu * mu - j2) - j3) / slope;
        slope = REAL(3) * mu * mu - j2;
    }
    if (!(slope > REAL(0.01) * j2)) return out;
    const coeff a = xx - mu, b = yy - mu, c = zz - mu;
    out.first = size * (mean + mu);
    out.adjugate = (failure_stress){b * c - yz * yz,  a * c - xz * xz,  a * b - xy * xy,
                                    xy * xz - a * yz, xy * yz - b * xz, xz * yz - c * xy};
    out.slack = REAL(9) * mu * failure_absolute(mu * (mu * mu - j2) - j3) / slope + rounding;
    out.known = 1;
    return out;
}

/* x.A x for x of any length; inv_square: 1 / |x|^2. */
LAW coeff failure_leading_share(failure_leading f, failure_axis x, coeff inv_square)
{
    const failure_stress a = f.adjugate;
    return inv_square * (x.x * (a.xx * x.x + REAL(2) * (a.xy * x.y + a.xz * x.z)) +
                         x.y * (a.yy * x.y + REAL(2) * a.yz * x.z) + a.zz * x.z * x.z);
}

LAW failure_state failure_worse(failure_state a, failure_state b) { return b.ratio > a.ratio ? b : a; }

LAW failure_state failure_of(failure_principal p, failure_limits limits, failure_shear shear)
{
    failure_state out = {0, 0, {0, 0, 0}, {0, 0, 0}, 0};
    if (limits.tension > 0)
        out = failure_worse(
            out, (failure_state){p.first / limits.tension, p.first, p.first_axis, p.first_axis, FAILURE_TENSION});
    if (limits.compression > 0)
        out = failure_worse(out, (failure_state){-p.third / limits.compression, p.third, p.third_axis, p.third_axis,
                                                 FAILURE_COMPRESSION});
    if (limits.shear > 0) { /* planes at 45 deg + phi / 2 between the outer axes */
        const coeff along = SQRT(REAL(0.5) * (REAL(1) + shear.friction)),
                    across = SQRT(REAL(0.5) * (REAL(1) - shear.friction));
        const coeff a = p.first - p.second, b = p.second - p.third, c = p.first - p.third;
        const coeff measure = shear.drucker_prager ? SQRT((a * a + b * b + c * c) / REAL(6)) +
                                                         shear.slope * (p.first + p.second + p.third)
                                                   : c + shear.slope * (p.first + p.third);
        out =
            failure_worse(out, (failure_state){measure / limits.shear, REAL(0.5) * c,
                                               failure_mix(along, p.first_axis, across, p.third_axis),
                                               failure_mix(along, p.first_axis, -across, p.third_axis), FAILURE_SHEAR});
    }
    return out;
}

/* |cos| of the angle between a direction and the nearer plane's normal; inv_length: 1 / length of x. */
LAW coeff failure_alignment(failure_state f, failure_axis x, coeff inv_length)
{
    const coeff a = failure_absolute(f.normal.x * x.x + f.normal.y * x.y + f.normal.z * x.z);
    const coeff b = failure_absolute(f.other.x * x.x + f.other.y * x.y + f.other.z * x.z);
    return failure_larger(a, b) * inv_length;
}

#endif
