/* Vectors, maps, and convex polyhedra where they stand: what the laws of contact between polyhedra (convex_overlap.h,
 * convex_wall.h, convex_sphere.h) are made of. */
#ifndef BRC_KERNELS_CONVEX_BODY_H
#define BRC_KERNELS_CONVEX_BODY_H

#include "../../core/portable.h"

typedef struct {
    state x, y, z;
} convex_vec;
typedef struct {
    state xx, xy, xz, yx, yy, yz, zx, zy, zz;
} convex_map;
/* normal . x = height, normal outward [-], height [m] */
typedef struct {
    convex_vec normal;
    state height;
} convex_plane;

/* One polyhedron of the arrays of all (preprocess/shapes/convex.h makes them). */
typedef struct {
    GLOBAL const state *corner;   /* [n_corners][3] from the origin [m] */
    GLOBAL const state *plane;    /* [n_faces][4] outward unit normal [-], height over the origin [m] */
    GLOBAL const int *loop_start; /* [n_faces + 1] into loop */
    GLOBAL const int *loop; /* corners of the faces, counter-clockwise from outside, counted within the polyhedron */
    int n_corners, n_faces;
    state radius; /* of the sphere about the origin that holds all corners [m] */
} convex_shape;

/* Origins of a pair are relative to any place near it: in single precision a far one costs digits. */
typedef struct {
    convex_vec origin;
    convex_map map;
} convex_pose;

LAW convex_vec convex_add(convex_vec a, convex_vec b) { return (convex_vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
LAW convex_vec convex_sub(convex_vec a, convex_vec b) { return (convex_vec){a.x - b.x, a.y - b.y, a.z - b.z}; }
LAW convex_vec convex_scale(state k, convex_vec a) { return (convex_vec){k * a.x, k * a.y, k * a.z}; }
LAW state convex_dot(convex_vec a, convex_vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LAW convex_vec convex_cross(convex_vec a, convex_vec b)
{
    return (convex_vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LAW state convex_length(convex_vec a) { return SQRT_STATE(convex_dot(a, a)); }
LAW convex_vec convex_turn(convex_map m, convex_vec a)
{
    return (convex_vec){m.xx * a.x + m.xy * a.y + m.xz * a.z, m.yx * a.x + m.yy * a.y + m.yz * a.z,
                        m.zx * a.x + m.zy * a.y + m.zz * a.z};
}
LAW convex_map convex_transpose(convex_map m)
{
    return (convex_map){m.xx, m.yx, m.zx, m.xy, m.yy, m.zy, m.xz, m.yz, m.zz};
}
/* m + a (x) b */
LAW convex_map convex_add_outer(convex_map m, convex_vec a, convex_vec b)
{
    return (convex_map){m.xx + a.x * b.x, m.xy + a.x * b.y, m.xz + a.x * b.z, m.yx + a.y * b.x, m.yy + a.y * b.y,
                        m.yz + a.y * b.z, m.zx + a.z * b.x, m.zy + a.z * b.y, m.zz + a.z * b.z};
}
LAW state convex_determinant(convex_map m)
{
    return m.xx * (m.yy * m.zz - m.yz * m.zy) + m.xy * (m.yz * m.zx - m.yx * m.zz) + m.xz * (m.yx * m.zy - m.yy * m.zx);
}
/* The inverse; the determinant is not 0. */
LAW convex_map convex_inverse(convex_map m)
{
    const state k = STATE(1) / convex_determinant(m);
    return (convex_map){
        k * (m.yy * m.zz - m.yz * m.zy), k * (m.xz * m.zy - m.xy * m.zz), k * (m.xy * m.yz - m.xz * m.yy),
        k * (m.yz * m.zx - m.yx * m.zz), k * (m.xx * m.zz - m.xz * m.zx), k * (m.xz * m.yx - m.xx * m.yz),
        k * (m.yx * m.zy - m.yy * m.zx), k * (m.xy * m.zx - m.xx * m.zy), k * (m.xx * m.yy - m.xy * m.yx)};
}
/* a b */
LAW convex_map convex_product(convex_map a, convex_map b)
{
    return (convex_map){a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
                        a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
                        a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
                        a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
                        a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

/* dV/d map [m^3] from the moment about the origin: what a first moment does to the deformation of its own
 * polyhedron. */
LAW convex_map convex_reference_moment(convex_map moment, convex_map map)
{
    return convex_product(moment, convex_transpose(convex_inverse(map)));
}
/* Torque of forces -p n dS with the moment's n and place, at p = 1: -integral of (x - origin) x n dS [m^3]. */
LAW convex_vec convex_torque(convex_map moment)
{
    return (convex_vec){moment.yz - moment.zy, moment.zx - moment.xz, moment.xy - moment.yx};
}

/* At least the largest factor by which m stretches a length; exact for rotations: |m|^2 <= 1 + |m^T m - 1|. */
LAW state convex_stretch(convex_map m)
{
    const convex_map c = convex_product(convex_transpose(m), m);
    const state xx = c.xx - STATE(1), yy = c.yy - STATE(1), zz = c.zz - STATE(1);
    return SQRT_STATE(STATE(1) +
                      SQRT_STATE(xx * xx + yy * yy + zz * zz + STATE(2) * (c.xy * c.xy + c.yz * c.yz + c.xz * c.xz)));
}

/* Shape s of the arrays of all shapes. */
LAW convex_shape convex_shape_of(GATHER(state) corner, GATHER(state) plane, GATHER(int) loop_start, GATHER(int) loop,
                                 GATHER(state) radius, GATHER(int) corner_start, GATHER(int) face_start, int s)
{
    const int c = corner_start[s], f = face_start[s];
    return (convex_shape){corner + (brc_size)c * 3, plane + (brc_size)f * 4, loop_start + f, loop,
                          corner_start[s + 1] - c,  face_start[s + 1] - f,   radius[s]};
}

LAW convex_vec convex_corner(convex_shape s, int k)
{
    GLOBAL const state *q = s.corner + (brc_size)k * 3;
    return (convex_vec){q[0], q[1], q[2]};
}
LAW convex_plane convex_own_plane(convex_shape s, int f)
{
    GLOBAL const state *q = s.plane + (brc_size)f * 4;
    return (convex_plane){(convex_vec){q[0], q[1], q[2]}, q[3]};
}

/* A shape where it stands, with what its map's inverse is needed for. */
typedef struct {
    convex_shape shape;
    convex_pose pose;
    convex_map inverse;
    state radius, inverse_stretch; /* of the mapped bounding sphere [m]; of the inverse [-] */
} convex_body;

LAW convex_body convex_body_of(convex_shape shape, convex_pose pose, convex_vec centre)
{
    const convex_map inverse = convex_inverse(pose.map);
    return (convex_body){shape, (convex_pose){convex_sub(pose.origin, centre), pose.map}, inverse,
                         shape.radius * convex_stretch(pose.map), convex_stretch(inverse)};
}
LAW convex_vec convex_place(convex_body b, int k)
{
    return convex_add(b.pose.origin, convex_turn(b.pose.map, convex_corner(b.shape, k)));
}
LAW convex_plane convex_placed(convex_body b, convex_plane own)
{
    const convex_vec n = convex_turn(convex_transpose(b.inverse), own.normal);
    const state k = STATE(1) / convex_length(n);
    const convex_vec normal = convex_scale(k, n);
    return (convex_plane){normal, k * own.height + convex_dot(normal, b.pose.origin)};
}
/* The plane as the body sees it in its own frame; heights stay what they are. */
LAW convex_plane convex_seen(convex_body b, convex_plane p)
{
    return (convex_plane){convex_turn(convex_transpose(b.pose.map), p.normal),
                          p.height - convex_dot(p.normal, b.pose.origin)};
}

#endif
