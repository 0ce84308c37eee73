/* The overlap of a convex polyhedron and a half-space. Only the polyhedron's faces are clipped: the surface of what is
 * cut off is closed and its first moments, integral of n (x) x dS, are its volume times unity, which gives area and
 * moments of the cut itself. */
#ifndef BRC_KERNELS_CONVEX_WALL_H
#define BRC_KERNELS_CONVEX_WALL_H

#include "convex_overlap.h"

/* wall: the half-space behind it, in the frame of the origins, is B of convex_overlap; moment_b is about
 * wall_origin. */
ROUTINE convex_overlap convex_wall_overlap(convex_shape shape, convex_pose pose, convex_plane wall,
                                           convex_vec wall_origin)
{
    const state above = convex_dot(wall.normal, pose.origin) - wall.height;
    if (above > shape.radius * convex_stretch(pose.map)) return convex_no_overlap(0, 0);
    if (!(convex_determinant(pose.map) > 0)) return convex_no_overlap(1, 0);
    const convex_vec centre = convex_sub(pose.origin, convex_scale(above, wall.normal)), none = {0, 0, 0};
    const convex_map zero = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const convex_body a = convex_body_of(shape, pose, centre);
    const convex_plane cut = {wall.normal, 0},
                       seen = convex_seen(a, cut); /* relative to the centre, which lies on it */
    convex_sums s = {0, none, zero, none, 0, none, 0};
    convex_polygon p;
    p.failed = 0;
    for (int f = 0; f < shape.n_faces; ++f) {
        if (convex_face_outside(shape, f, seen, 0)) continue;
        convex_load_face(a, f, &p);
        convex_clip(&p, cut, 0);
        if (p.n > 2) convex_sum_face(&p, convex_placed(a, convex_own_plane(shape, f)), &s);
    }
    if (p.failed) return convex_no_overlap(p.failed, 0);
    const state area = -convex_dot(s.area, wall.normal);
    const state volume = (s.volume - area * convex_dot(wall.normal, s.centre)) / STATE(3);
    if (!(volume > 0) || !(s.surface > 0)) return convex_no_overlap(0, 0);
    const convex_vec push = convex_scale(area, wall.normal);
    const convex_map m = s.moment;
    const convex_map of_cut = {volume - m.xx, -m.xy, -m.xz, -m.yx, volume - m.yy, -m.yz, -m.zx, -m.zy, volume - m.zz};
    const convex_vec place = convex_add(s.place, convex_turn(convex_transpose(of_cut), wall.normal));
    const convex_vec point =
        convex_add(convex_add(centre, s.centre), convex_scale(STATE(1) / (s.surface + area), place));
    return (convex_overlap){volume,
                            push,
                            convex_add_outer(m, convex_scale(-STATE(1), push), convex_sub(s.centre, a.pose.origin)),
                            convex_add_outer(of_cut, push, convex_sub(convex_add(centre, s.centre), wall_origin)),
                            point,
                            0,
                            0};
}

#endif
