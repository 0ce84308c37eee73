/* How near to failure a stress can be at most, for whole groups and without principal values.
 *
 * The ratio of failure.h, with the smallest limits of all elements, is bounded from above by a function that is
 * sublinear: bound(a + b) <= bound(a) + bound(b) and bound(k a) = k bound(a) for k >= 0, as the largest principal
 * value, minus the smallest, sqrt J2 and the trace are. So the mean of the bounds of several elements bounds the ratio
 * of their mean stress: one number a neighbour in place of its whole stress. Largest principal value: I1/3 + the
 * largest root of x^3 - J2 x - J3 of the deviator. The root cannot exceed 2 sqrt(J2/3), where the polynomial is convex,
 * so one step of Newton from there stays above it: exact in uniaxial tension, too large by 2.7 % where J3 = 0. */
#ifndef BRC_KERNELS_FAILURE_BOUND_H
#define BRC_KERNELS_FAILURE_BOUND_H

#include "../../core/vec.h"

/* 1 / the smallest limits of all elements, 0 where there is none. tension, compression, shear [1/Pa]; drucker_prager,
 * slope: as failure_shear. */
typedef struct {
    coeff tension, compression, shear;
    int drucker_prager;
    coeff slope;
} failure_scale;

/* start: 2 sqrt(J2/3), where the polynomial is start J2 / 3 - J3 and its slope 3 J2. */
LAW lane failure_root_bound(lane start, lane j3_over_j2)
{
    return REAL(0.88888888888888889) * start + REAL(0.33333333333333333) * j3_over_j2;
}

/* stress [Pa]; at least 0 [-]. */
LAW lane failure_bound(lane_sym3 stress, failure_scale scale)
{
    const coeff unit =
        scale.tension + scale.compression + scale.shear; /* numbers of the order of 1, in any precision */
    const lane mean = REAL(0.33333333333333333) * unit * lane_sym3_trace(stress);
    const lane xx = unit * stress.xx - mean, yy = unit * stress.yy - mean, zz = unit * stress.zz - mean;
    const lane yz = unit * stress.yz, xz = unit * stress.xz, xy = unit * stress.xy;
    const lane j2 = REAL(0.5) * (xx * xx + yy * yy + zz * zz) + (yz * yz + xz * xz + xy * xy);
    const lane j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    const lane start = LANE_SQRT(REAL(1.3333333333333333) * j2),
               third_over_second = j3 / (j2 + REAL(1e-30)); /* nothing over nothing is 0 */
    const lane first = mean + failure_root_bound(start, third_over_second);
    lane third = LANE_ZERO, bound = LANE_ZERO; /* minus the smallest */
    if (scale.compression > 0 || scale.shear > 0) third = failure_root_bound(start, -third_over_second) - mean;
    if (scale.tension > 0) bound = lane_max(bound, scale.tension * first);
    if (scale.compression > 0) bound = lane_max(bound, scale.compression * third);
    if (scale.shear > 0) {
        const lane shear = scale.drucker_prager ? LANE_SQRT(j2) + REAL(3) * scale.slope * mean
                                                : (REAL(1) + scale.slope) * first + (REAL(1) - scale.slope) * third;
        bound = lane_max(bound, scale.shear * shear);
    }
    return bound * (REAL(1) / unit);
}

/* The largest principal value, and minus the smallest, from above by at most 2e-5 of 2 sqrt(J2/3) (and what the padding
 * adds where two values are equal, its root times that). The largest root of the deviator is 2 sqrt(J2/3)
 * cos(acos(c)/3), c = J3 / (2 (J2/3)^(3/2)), a smooth function of y = sqrt((1 + c)/2): cos(2 acos(y)/3), by a
 * polynomial from above; the other outer value by -c. Not sublinear. Any unit. */
typedef struct {
    lane first, third;
} failure_outer;
LAW lane failure_root(lane y)
{
    return REAL(0.5000167) +
           y * (REAL(0.5768829) + y * (REAL(-0.1068391) + y * (REAL(0.03889836) - REAL(0.00895875) * y)));
}
LAW failure_outer failure_outer_of(lane_sym3 s)
{
    const lane middle = LANE_ZERO + REAL(0.5), zero = LANE_ZERO,
               pad = LANE_ZERO + (BRC_PRECISION == 0 ? REAL(1e-12) : REAL(1e-6));
    const lane mean = REAL(0.33333333333333333) * lane_sym3_trace(s);
    const lane xx = s.xx - mean, yy = s.yy - mean, zz = s.zz - mean;
    const lane j2 = middle * (xx * xx + yy * yy + zz * zz) + (s.yz * s.yz + s.xz * s.xz + s.xy * s.xy);
    const lane j3 = xx * (yy * zz - s.yz * s.yz) - s.xy * (s.xy * zz - s.yz * s.xz) + s.xz * (s.xy * s.yz - yy * s.xz);
    const lane start = LANE_SQRT(REAL(1.3333333333333333) * j2);
    const lane c = REAL(2) * j3 / (start * start * start + REAL(1e-30)); /* a half of it; nothing over nothing is 0 */
    return (failure_outer){mean + start * failure_root(LANE_SQRT(lane_max(middle + c, zero) + pad)),
                           start * failure_root(LANE_SQRT(lane_max(middle - c, zero) + pad)) - mean};
}
/* Of sigma_I - sigma_III + slope (sigma_I + sigma_III), Mohr and Coulomb's sum. */
LAW lane failure_slip_bound(failure_outer of, coeff slope)
{
    return (REAL(1) + slope) * of.first + (REAL(1) - slope) * of.third;
}

#endif
