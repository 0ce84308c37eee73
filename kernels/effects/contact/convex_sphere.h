/* The point of a rigid surface that is nearest to the centre of a sphere: a sphere of radius R overlaps by R - distance
 * there. One point and one normal, whether it lies on a face, an edge or a corner. */
#ifndef BRC_KERNELS_CONVEX_SPHERE_H
#define BRC_KERNELS_CONVEX_SPHERE_H

#include "convex_overlap.h"

/* distance: of the centre from the surface, negative within [m]; normal: unit, out of the surface; point: on it [m] */
typedef struct {
    state distance;
    convex_vec normal, point;
} convex_foot;

LAW convex_foot convex_foot_on_plane(convex_vec centre, convex_plane wall)
{
    const state h = convex_dot(wall.normal, centre) - wall.height;
    return (convex_foot){h, wall.normal, convex_sub(centre, convex_scale(h, wall.normal))};
}

/* Of one sphere on another, of centre `other`; at its very middle the normal is x. */
LAW convex_foot convex_foot_on_sphere(convex_vec centre, convex_vec other, state radius)
{
    const convex_vec branch = convex_sub(centre, other);
    const state length = convex_length(branch);
    const convex_vec normal = length > 0 ? convex_scale(STATE(1) / length, branch) : (convex_vec){1, 0, 0};
    return (convex_foot){length - radius, normal, convex_add(other, convex_scale(radius, normal))};
}

/* The point of face f nearest to x, given its height over the face's plane; in the frame of the shape. */
LAW convex_vec convex_nearest_on_face(convex_shape s, int f, convex_plane own, convex_vec x, state height)
{
    const int begin = s.loop_start[f], end = s.loop_start[f + 1];
    const convex_vec foot = convex_sub(x, convex_scale(height, own.normal));
    convex_vec a = convex_corner(s, s.loop[end - 1]), best = foot;
    state least = -STATE(1);
    int within = 1;
    for (int k = begin; k < end; ++k) {
        const convex_vec b = convex_corner(s, s.loop[k]), edge = convex_sub(b, a), arm = convex_sub(foot, a);
        if (convex_dot(convex_cross(edge, arm), own.normal) <
            0) { /* beyond this edge: the nearest point lies on one such */
            const state square = convex_dot(edge, edge), along = convex_dot(edge, arm);
            const state t = along <= 0 || !(square > 0) ? STATE(0) : along >= square ? STATE(1) : along / square;
            const convex_vec place = convex_add(a, convex_scale(t, edge)), off = convex_sub(x, place);
            const state distance = convex_dot(off, off);
            if (within || distance < least) {
                least = distance;
                best = place;
            }
            within = 0;
        }
        a = b;
    }
    return best;
}

/* The map of the pose is a rotation. Farther than `reach` [m] >= 0 the distance is only some number above it. */
ROUTINE convex_foot convex_foot_on_polyhedron(convex_shape s, convex_pose pose, convex_vec centre, state reach)
{
    const convex_vec x = convex_turn(convex_transpose(pose.map), convex_sub(centre, pose.origin));
    convex_vec normal = {1, 0, 0}, point = {0, 0, 0};
    state highest = 0, least = -STATE(1);
    for (int f = 0; f < s.n_faces; ++f) {
        const convex_plane own = convex_own_plane(s, f);
        const state h = convex_dot(own.normal, x) - own.height;
        if (f == 0 || h > highest) {
            highest = h;
            normal = own.normal;
        }
        if (h > reach) return (convex_foot){h, normal, centre};
    }
    if (highest <= 0) /* within: the nearest plane */
        return (convex_foot){
            highest, convex_turn(pose.map, normal),
            convex_add(pose.origin, convex_turn(pose.map, convex_sub(x, convex_scale(highest, normal))))};
    for (int f = 0; f < s.n_faces; ++f) {
        const convex_plane own = convex_own_plane(s, f);
        const state h = convex_dot(own.normal, x) - own.height;
        if (!(h > 0) || (least >= 0 && h * h >= least)) continue;
        const convex_vec place = convex_nearest_on_face(s, f, own, x, h), off = convex_sub(x, place);
        const state distance = convex_dot(off, off);
        if (least < 0 || distance < least) {
            least = distance;
            point = place;
        }
    }
    const convex_vec off = convex_sub(x, point);
    const state distance = SQRT_STATE(least);
    if (distance > STATE(16) * STATE_ROUNDING * s.radius)
        normal = convex_scale(STATE(1) / distance, off); /* nearer, the plane knows it better */
    return (convex_foot){distance, convex_turn(pose.map, normal),
                         convex_add(pose.origin, convex_turn(pose.map, point))};
}

#endif
