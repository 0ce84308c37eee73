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

#endif
