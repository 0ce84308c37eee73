/* Vectors, matrices and quaternions of single numbers of the state, for kernels over short lists whose geometry wants
 * its precision (contact, rigid bodies): values in, values out. smat3 is row major: xy is row x, column y. */
#ifndef BRC_KERNELS_SVEC_H
#define BRC_KERNELS_SVEC_H

#include "portable.h"

typedef struct {
    state x, y, z;
} svec3;
typedef struct {
    state xx, xy, xz, yx, yy, yz, zx, zy, zz;
} smat3;
typedef struct {
    state xx, yy, zz, yz, xz, xy;
} ssym3;
typedef struct {
    state w, x, y, z;
} squat;

LAW svec3 svec3_add(svec3 a, svec3 b) { return (svec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
LAW svec3 svec3_sub(svec3 a, svec3 b) { return (svec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
LAW svec3 svec3_scale(state k, svec3 a) { return (svec3){k * a.x, k * a.y, k * a.z}; }
/* a + k b */
LAW svec3 svec3_add_scaled(svec3 a, state k, svec3 b) { return (svec3){a.x + k * b.x, a.y + k * b.y, a.z + k * b.z}; }
LAW state svec3_dot(svec3 a, svec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAW svec3 svec3_cross(svec3 a, svec3 b)
{
    return (svec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LAW state svec3_length(svec3 a) { return SQRT_STATE(svec3_dot(a, a)); }
LAW svec3 svec3_choose(int first, svec3 a, svec3 b)
{
    return (svec3){first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}
/* What of a is across the unit vector n. */
LAW svec3 svec3_across(svec3 a, svec3 n) { return svec3_add_scaled(a, -svec3_dot(a, n), n); }

LAW svec3 smat3_mul_vec(smat3 a, svec3 b)
{
    return (svec3){a.xx * b.x + a.xy * b.y + a.xz * b.z, a.yx * b.x + a.yy * b.y + a.yz * b.z,
                   a.zx * b.x + a.zy * b.y + a.zz * b.z};
}
/* a transposed times b */
LAW svec3 smat3_tmul_vec(smat3 a, svec3 b)
{
    return (svec3){a.xx * b.x + a.yx * b.y + a.zx * b.z, a.xy * b.x + a.yy * b.y + a.zy * b.z,
                   a.xz * b.x + a.yz * b.y + a.zz * b.z};
}
LAW smat3 smat3_mul(smat3 a, smat3 b)
{
    return (smat3){a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
                   a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
                   a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
                   a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
                   a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}
LAW smat3 smat3_transpose(smat3 a) { return (smat3){a.xx, a.yx, a.zx, a.xy, a.yy, a.zy, a.xz, a.yz, a.zz}; }
LAW smat3 smat3_add(smat3 a, smat3 b)
{
    return (smat3){a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
                   a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
LAW smat3 smat3_scale(state k, smat3 a)
{
    return (smat3){k * a.xx, k * a.xy, k * a.xz, k * a.yx, k * a.yy, k * a.yz, k * a.zx, k * a.zy, k * a.zz};
}
/* m + a (x) b */
LAW smat3 smat3_add_outer(smat3 m, svec3 a, svec3 b)
{
    return (smat3){m.xx + a.x * b.x, m.xy + a.x * b.y, m.xz + a.x * b.z, m.yx + a.y * b.x, m.yy + a.y * b.y,
                   m.yz + a.y * b.z, m.zx + a.z * b.x, m.zy + a.z * b.y, m.zz + a.z * b.z};
}
LAW state smat3_det(smat3 a)
{
    return a.xx * (a.yy * a.zz - a.yz * a.zy) - a.xy * (a.yx * a.zz - a.yz * a.zx) + a.xz * (a.yx * a.zy - a.yy * a.zx);
}
/* Transposed matrix of cofactors: the inverse times the determinant. */
LAW smat3 smat3_adjugate(smat3 a)
{
    return (smat3){a.yy * a.zz - a.yz * a.zy, a.xz * a.zy - a.xy * a.zz, a.xy * a.yz - a.xz * a.yy,
                   a.yz * a.zx - a.yx * a.zz, a.xx * a.zz - a.xz * a.zx, a.xz * a.yx - a.xx * a.yz,
                   a.yx * a.zy - a.yy * a.zx, a.xy * a.zx - a.xx * a.zy, a.xx * a.yy - a.xy * a.yx};
}
LAW smat3 smat3_inverse(smat3 a) { return smat3_scale(STATE(1) / smat3_det(a), smat3_adjugate(a)); }
/* The vector of the antisymmetric part of sum f (x) r: sum r x f. */
LAW svec3 smat3_moment(smat3 f_r) { return (svec3){f_r.zy - f_r.yz, f_r.xz - f_r.zx, f_r.yx - f_r.xy}; }

/* Rotation matrix of a unit quaternion minus identity, without cancellation. */
LAW smat3 squat_matrix_minus_identity(squat q)
{
    const state xx = STATE(2) * q.x * q.x, yy = STATE(2) * q.y * q.y, zz = STATE(2) * q.z * q.z,
                xy = STATE(2) * q.x * q.y, xz = STATE(2) * q.x * q.z;
    const state yz = STATE(2) * q.y * q.z, wx = STATE(2) * q.w * q.x, wy = STATE(2) * q.w * q.y,
                wz = STATE(2) * q.w * q.z;
    return (smat3){-yy - zz, xy - wz, xz + wy, xy + wz, -xx - zz, yz - wx, xz - wy, yz + wx, -xx - yy};
}
LAW smat3 smat3_shifted(smat3 a, state by)
{
    return (smat3){a.xx + by, a.xy, a.xz, a.yx, a.yy + by, a.yz, a.zx, a.zy, a.zz + by};
}
LAW smat3 squat_matrix(squat q) { return smat3_shifted(squat_matrix_minus_identity(q), STATE(1)); }
LAW squat squat_mul(squat a, squat b)
{
    return (squat){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                   a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
LAW squat squat_normalised(squat q)
{
    const state k = STATE(1) / SQRT_STATE(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (squat){k * q.w, k * q.x, k * q.y, k * q.z};
}
/* exp(h) for a half turn h whose length is far below 1: cos and sin(|h|)/|h| by their series. */
LAW squat squat_of_half_turn(svec3 h)
{
    const state hh = svec3_dot(h, h);
    const state c = STATE(1) - hh * (STATE(0.5) - hh * (STATE(1.0 / 24) - hh * STATE(1.0 / 720)));
    const state s = STATE(1) - hh * (STATE(1.0 / 6) - hh * (STATE(1.0 / 120) - hh * STATE(1.0 / 5040)));
    return (squat){c, s * h.x, s * h.y, s * h.z};
}

#endif
