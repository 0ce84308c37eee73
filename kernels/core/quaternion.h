/* Unit quaternions (w, x, y, z) on lanes. finite: 1 full rotations; 0 small ones, where the vector part is half a
 * rotation vector. */
#ifndef BRC_KERNELS_QUATERNION_H
#define BRC_KERNELS_QUATERNION_H

#include "vec.h"

LAW lane_vec3 quat_vector(lane_quat q) { return (lane_vec3){q.x, q.y, q.z}; }

/* R x - x for the rotation of a unit quaternion, without cancellation: 2 w (v x a) + 2 v x (v x a). */
LAW lane_vec3 quat_rotate_minus_identity(lane_quat q, lane_vec3 a, int finite)
{
    const lane_vec3 v = quat_vector(q);
    const lane_vec3 once = lane_vec3_cross(v, a);
    const lane two = LANE_ZERO + REAL(2);
    if (!finite) return lane_vec3_scale(two, once);
    return lane_vec3_scale(two, lane_vec3_add(lane_vec3_scale(q.w, once), lane_vec3_cross(v, once)));
}

/* Rotation matrix minus identity [-], columns R e - e. */
LAW lane_mat3 quat_matrix_minus_identity(lane_quat q, int finite)
{
    const lane one = LANE_ZERO + REAL(1), zero = LANE_ZERO;
    const lane_vec3 x = quat_rotate_minus_identity(q, (lane_vec3){one, zero, zero}, finite);
    const lane_vec3 y = quat_rotate_minus_identity(q, (lane_vec3){zero, one, zero}, finite);
    const lane_vec3 z = quat_rotate_minus_identity(q, (lane_vec3){zero, zero, one}, finite);
    return (lane_mat3){x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

LAW lane_quat quat_conjugate(lane_quat q) { return (lane_quat){q.w, -q.x, -q.y, -q.z}; }

/* a b */
LAW lane_quat quat_mul(lane_quat a, lane_quat b)
{
    return (lane_quat){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                       a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

#endif
