/* Faces of cells that a crack in shear opens (docs/notebook/theory.md T11): when, along which plane, and what they
 * carry beside the cohesion of softening.h. */
#ifndef BRC_KERNELS_SLIDING_H
#define BRC_KERNELS_SLIDING_H

#include "../../effects/fracture/softening.h"

/* What of the stress m goes on through a face beside what acts on the plane across `axis`: m (area - (area.axis) axis)
 * [N]. Over the faces of a zig-zag along that plane it sums to nothing (docs/notebook/theory.md T11). */
LAW lane_vec3 soft_passed(lane_sym3 m, lane_vec3 axis, lane_vec3 area)
{
    return lane_sym3_mul_vec(m, lane_vec3_more(area, -lane_vec3_dot(area, axis), axis));
}

/* The force [N] that the cohesion of a face which slides falls from: what it carries across `axis`, less the friction
 * of the push on it, which stays; a hundredth of the shear at least, as C(0) is divided by. */
LAW coeff soft_slide_start(soft_vector released, soft_vector axis, coeff friction)
{
    const coeff across = soft_dot(released, axis);
    const soft_vector along = soft_add(released, -across, axis);
    const coeff shear = SQRT(soft_dot(along, along)), least = REAL(0.01) * shear;
    if (across > 0) return SQRT(shear * shear + across * across);
    return shear + friction * across > least ? shear + friction * across : least;
}

/* How near a face is to sliding, and the normals of the planes it may slide on: by all of the stress or, along an
 * interface (limit < 0), by what acts on the face itself. slope: sin phi. */
LAW failure_state soft_slip(failure_principal p, soft_vector traction, soft_vector n, coeff limit, coeff slope)
{
    if (!(limit < 0)) return failure_of(p, (failure_limits){0, 0, limit}, (failure_shear){0, slope, slope});
    const coeff across = soft_dot(traction, n);
    const soft_vector along = soft_add(traction, -across, n);
    const coeff shear = SQRT(soft_dot(along, along)), cosine = SQRT(REAL(1) - slope * slope);
    const failure_axis own = {n.x, n.y, n.z};
    return (failure_state){REAL(-2) * (cosine * shear + slope * across) / limit, shear, own, own, FAILURE_SHEAR};
}

/* The slip plane that a face stands for: the one of the two whose normal is nearer to that of the face, turned along
 * it. */
LAW soft_vector soft_slip_plane(failure_state slip, soft_vector normal)
{
    const soft_vector a = {slip.normal.x, slip.normal.y, slip.normal.z}, b = {slip.other.x, slip.other.y, slip.other.z};
    const coeff c_a = soft_dot(a, normal), c_b = soft_dot(b, normal);
    const soft_vector nearer = SOFT_ABS(c_a) >= SOFT_ABS(c_b) ? a : b;
    return soft_dot(nearer, normal) < 0 ? soft_scale(REAL(-1), nearer) : nearer;
}

#endif
