/* The overlap of two convex polyhedra: volume, area vector and first moments, which are its exact gradient; no cases
 * for vertex, edge or face.
 *
 * A polyhedron is given by corners and faces relative to its origin, in its own frame, and stands in the world by x =
 * origin + map X; planes stay planes and convex stays convex under any map with det > 0: I + H of a bonded cell, the
 * rotation of a rigid piece. The surface of A n B is made of the faces of A clipped by the planes of B and the faces of
 * B clipped by those of A (Sutherland and Hodgman, one polygon at a time). By the divergence theorem, with n outward of
 * the face's own polyhedron, heights from any point c,
 *     V = 1/3 sum height area,     dV/d origin_B = area = integral of n dS over the surface of B inside A = -dV/d
 *                                  origin_A,
 *     dV/d map_A = moment_A map_A^-T,     moment_A = integral of n (x) (x - origin_A) dS over the surface of A inside
 *                                         B, likewise B.
 *
 * Ties. Face i of A and face j of B may lie in one plane, to rounding or exactly (cells that shared a face, blocks side
 * by side). Which part of the plane belongs to i and which to j must be the same answer in both clippings, or a whole
 * face counts twice or never. On plane i, the height over plane j is also that height minus (normals alike) or plus
 * (normals opposed) the height over plane i, which is zero there. Cut by this difference or sum, both faces are cut by
 * one and the same plane, whatever the rounding, and share what they cover (alike) or keep the same part (opposed). On
 * the cut itself face i counts and face j does not (alike), or neither (opposed: touching is no overlap). */
#ifndef BRC_KERNELS_CONVEX_OVERLAP_H
#define BRC_KERNELS_CONVEX_OVERLAP_H

#include "convex_body.h"

/* Corners of one face and cuts through it: a face of c corners meets a polyhedron of f faces safely while c + f is at
 * most this. A round body of f faces cuts a face larger than itself 2.5 sqrt(f) times. */
#define CONVEX_POLYGON 256
/* Planes that are kept at hand; further ones (large strikers) are mapped again for every face they may cut. */
#define CONVEX_PLANES 64
/* A body with more corners is large against the other: they are not asked one by one where they stand. */
#define CONVEX_MANY 128

typedef struct {
    state volume;                  /* [m^3]; 0: apart, or touching */
    convex_vec area;               /* [m^2]; A is pushed along it, B against it */
    convex_map moment_a, moment_b; /* [m^3] rows: normal, columns: place */
    convex_vec point; /* the centroid of the overlap's surface: where friction acts, in the frame of the origins [m] */
    int failed;       /* 1: a map turns a polyhedron inside out; 2: a polygon outgrew CONVEX_POLYGON */
    int apart;        /* 1 + a face of A that stands between the two, or minus that of B; 0: none was found */
} convex_overlap;

/* Planes of one body that may cut the other, as many of them as are asked at once in blocks of W; those of faces from
 * `rest` on are not kept. apart: 1 + the face that separates the two, or 0. */
typedef struct {
    state x[CONVEX_PLANES], y[CONVEX_PLANES], z[CONVEX_PLANES], height[CONVEX_PLANES];
    int n, rest, apart;
} convex_cutters;
LAW convex_plane convex_cutter(const convex_cutters *c, int k)
{
    return (convex_plane){(convex_vec){c->x[k], c->y[k], c->z[k]}, c->height[k]};
}
LAW void convex_put_cutter(convex_cutters *c, int k, convex_plane p)
{
    c->x[k] = p.normal.x, c->y[k] = p.normal.y, c->z[k] = p.normal.z, c->height[k] = p.height;
}

/* Where the middle of one body lies in the other's frame, and how far from it anything of that body can be there
 * [m]. */
typedef struct {
    convex_vec centre;
    state reach;
} convex_ball;
LAW convex_ball convex_ball_of(convex_body body, convex_body in, state margin)
{
    return (convex_ball){convex_turn(in.inverse, convex_sub(body.pose.origin, in.pose.origin)),
                         body.radius * in.inverse_stretch * STATE(1.0001) + margin};
}

/* The planes of `tool` that some corner of `work` is outside of, or nearer than `margin` [m] to: those, and only those,
 * cut its faces. The plane that work is the least deep behind comes first: most faces lie outside of it. Of a body of
 * many corners every plane within its ball counts. */
ROUTINE void convex_find_cutters(convex_body tool, convex_body work, state margin, convex_cutters *c)
{
    const convex_ball ball = convex_ball_of(work, tool, margin);
    const int many = work.shape.n_corners > CONVEX_MANY, n_corners = many ? 0 : work.shape.n_corners;
    state first = 0;
    c->n = 0;
    c->rest = tool.shape.n_faces;
    c->apart = 0;
    for (int begin = 0; begin < tool.shape.n_faces; begin += W) {
        convex_cutters own, placed;
        state near[W], low[W], high[W], x[W], y[W], z[W], height[W]; /* planes as work sees them */
        int any = 0;
        for (int l = 0; l < W; ++l) {
            const convex_plane face =
                convex_own_plane(tool.shape, begin + l < tool.shape.n_faces ? begin + l : tool.shape.n_faces - 1);
            near[l] = convex_dot(face.normal, ball.centre) - face.height;
            any |= near[l] >= -ball.reach;
            convex_put_cutter(&own, l, face);
        }
        if (!any) continue;
        FOR_LANES(l) {
            const convex_plane there = convex_placed(tool, convex_cutter(&own, l)), seen = convex_seen(work, there);
            convex_put_cutter(&placed, l, there);
            x[l] = seen.normal.x, y[l] = seen.normal.y, z[l] = seen.normal.z, height[l] = seen.height;
            low[l] = many ? near[l] : STATE(1e30), high[l] = many ? STATE(0) : STATE(-1e30);
        }
        for (int k = 0; k < n_corners; ++k) {
            const convex_vec corner = convex_corner(work.shape, k);
            FOR_LANES(l) {
                const state h = x[l] * corner.x + y[l] * corner.y + z[l] * corner.z - height[l];
                low[l] = h < low[l] ? h : low[l];
                high[l] = h > high[l] ? h : high[l];
            }
        }
        for (int l = 0; l < W && begin + l < tool.shape.n_faces; ++l) {
            if (near[l] > ball.reach || (near[l] >= -ball.reach && low[l] >= 0 && !many)) {
                c->apart = begin + l + 1;
                return;
            }
            if (near[l] < -ball.reach || high[l] <= -margin) continue;
            if (c->n == CONVEX_PLANES) {
                c->rest = c->rest < begin + l ? c->rest : begin + l;
                continue;
            }
            convex_put_cutter(c, c->n, convex_cutter(&placed, l));
            if (c->n == 0 || low[l] > first) {
                first = low[l];
                convex_put_cutter(c, c->n, convex_cutter(c, 0));
                convex_put_cutter(c, 0, convex_cutter(&placed, l));
            }
            ++c->n;
        }
    }
    for (int k = c->n; k % W != 0; ++k)
        convex_put_cutter(c, k, (convex_plane){(convex_vec){0, 0, 0}, STATE(1e30)}); /* which nothing is outside of */
}

/* The plane that cuts a face in plane `own` as plane `other` does (the head of this file says why not `other` itself);
 * alike: normals alike. */
LAW convex_plane convex_cut(convex_plane own, convex_plane other, int alike)
{
    return alike ? (convex_plane){convex_sub(other.normal, own.normal), other.height - own.height}
                 : (convex_plane){convex_add(other.normal, own.normal), other.height + own.height};
}

typedef struct {
    convex_vec corner[CONVEX_POLYGON];
    int n, failed;
} convex_polygon;

/* Keep the part with height < 0, closed: <= 0. Removes a corner or more and adds two: the kept ones are taken as one
 * chain around the lowest, so that rounding on a line of corners cannot add more. */
ROUTINE void convex_clip(convex_polygon *p, convex_plane cut, int closed)
{
    const int n = p->n;
    state low = 0, high = 0;
    int start = 0;
    for (int k = 0; k < n; ++k) {
        const state h = convex_dot(cut.normal, p->corner[k]) - cut.height;
        if (k == 0 || h < low) {
            low = h;
            start = k;
        }
        if (k == 0 || h > high) high = h;
    }
    if (high < 0 || (closed && high <= 0)) return;
    if (low > 0 || (!closed && low >= 0)) {
        p->n = 0;
        return;
    }
    if (n >= CONVEX_POLYGON || !(low <= high)) { /* places that are no numbers are on no side of any plane */
        p->failed = 2;
        return;
    }
    convex_vec entry = {0, 0, 0}, exit = {0, 0, 0};
    int last = start, first = start;
    state inside = low;
    for (;;) { /* forward, until outside */
        const int next = last + 1 < n ? last + 1 : 0;
        const state outside = convex_dot(cut.normal, p->corner[next]) - cut.height;
        if (outside > 0 || (!closed && outside >= 0)) {
            exit = convex_add(p->corner[last],
                              convex_scale(inside / (inside - outside), convex_sub(p->corner[next], p->corner[last])));
            break;
        }
        inside = outside;
        last = next;
    }
    inside = low;
    for (;;) { /* backward */
        const int next = first > 0 ? first - 1 : n - 1;
        const state outside = convex_dot(cut.normal, p->corner[next]) - cut.height;
        if (outside > 0 || (!closed && outside >= 0)) {
            entry = convex_add(p->corner[first], convex_scale(inside / (inside - outside),
                                                              convex_sub(p->corner[next], p->corner[first])));
            break;
        }
        inside = outside;
        first = next;
    }
    int kept = last + 1; /* corners before the exit */
    if (first <= last) {
        kept -= first;
        for (int k = 0; k < kept; ++k) p->corner[k] = p->corner[first + k];
        p->n = kept + 2;
    } else { /* the chain goes through the end of the array: its second part moves to behind the entry */
        const int move = last + 3 - first;
        if (move > 0) p->corner[n] = p->corner[n - 1];
        for (int k = n - 2; k >= first && move > 0; --k) p->corner[k + 1] = p->corner[k];
        for (int k = first; k < n && move < 0; ++k) p->corner[k + move] = p->corner[k];
        p->n = n + move;
    }
    p->corner[kept] = exit;
    p->corner[kept + 1] = entry;
}

/* Sums over clipped faces; places are relative to `centre`, a corner of the first of them: the overlap may be thin and
 * far from both origins. */
typedef struct {
    state volume;    /* 3 V */
    convex_vec area; /* of the side that is being summed */
    convex_map moment;
    convex_vec centre;
    state surface;    /* of both sides [m^2] */
    convex_vec place; /* its first moment [m^3] */
    int begun;
} convex_sums;

ROUTINE void convex_sum_face(const convex_polygon *p, convex_plane own, convex_sums *s)
{
    const convex_vec base = p->corner[0];
    state area = 0;
    convex_vec first = {0, 0, 0}, side = convex_sub(p->corner[1], base);
    for (int k = 2; k < p->n; ++k) {
        const convex_vec next = convex_sub(p->corner[k], base);
        const state part = STATE(0.5) * convex_dot(own.normal, convex_cross(side, next));
        area += part;
        first = convex_add(first, convex_scale(part, convex_add(side, next)));
        side = next;
    }
    if (!s->begun) {
        s->begun = 1;
        s->centre = base;
    }
    const convex_vec place =
        convex_add(convex_scale(area, convex_sub(base, s->centre)), convex_scale(STATE(1) / STATE(3), first));
    s->volume += area * (own.height - convex_dot(own.normal, s->centre));
    s->area = convex_add(s->area, convex_scale(area, own.normal));
    s->moment = convex_add_outer(s->moment, own.normal, place);
    s->surface += area;
    s->place = convex_add(s->place, place);
}

/* The polygon of face f, where it stands. */
LAW void convex_load_face(convex_body b, int f, convex_polygon *p)
{
    const int begin = b.shape.loop_start[f];
    p->n = b.shape.loop_start[f + 1] - begin;
    for (int k = 0; k < p->n; ++k) p->corner[k] = convex_place(b, b.shape.loop[begin + k]);
}
/* Is face f wholly outside a plane, as its body sees it, by more than `margin`? */
LAW int convex_face_outside(convex_shape s, int f, convex_plane seen, state margin)
{
    for (int k = s.loop_start[f]; k < s.loop_start[f + 1]; ++k)
        if (convex_dot(seen.normal, convex_corner(s, s.loop[k])) - seen.height <= margin) return 0;
    return 1;
}
LAW void convex_clip_by(convex_polygon *p, convex_plane own, convex_plane other, int first)
{
    const int alike = convex_dot(own.normal, other.normal) >= 0;
    convex_clip(p, convex_cut(own, other, alike), first && alike);
}

/* ... by the kept planes but the first. What the first leaves of a face is small where the overlap is: most planes have
 * all of it inside, some all of it outside, and W of them at a time are told apart from those that cut it. */
ROUTINE void convex_clip_by_kept(convex_polygon *p, convex_plane own, const convex_cutters *c, state margin, int first)
{
    for (int begin = 0; begin < c->n; begin += W) {
        state low[W], high[W];
        int out = 0;
        FOR_LANES(l) low[l] = STATE(1e30), high[l] = STATE(-1e30);
        for (int k = 0; k < p->n; ++k) {
            const convex_vec corner = p->corner[k];
            FOR_LANES(l) {
                const state h = c->x[begin + l] * corner.x + c->y[begin + l] * corner.y + c->z[begin + l] * corner.z -
                                c->height[begin + l];
                low[l] = h < low[l] ? h : low[l];
                high[l] = h > high[l] ? h : high[l];
            }
        }
        FOR_LANES_ANY(l, out) out |= low[l] > margin;
        if (out) p->n = 0;
        for (int l = begin == 0; l < W && p->n > 0; ++l)
            if (high[l] > -margin) convex_clip_by(p, own, convex_cutter(c, begin + l), first);
    }
}

/* Clip the faces of `work` by the planes of `tool` and add what is left. first: work is A, to which ties of like planes
 * go. */
ROUTINE int convex_clip_faces(convex_body work, convex_body tool, const convex_cutters *c, state margin, int first,
                              convex_sums *s)
{
    const convex_ball ball = convex_ball_of(tool, work, margin), back = convex_ball_of(work, tool, margin);
    const convex_plane deepest = c->n > 0 ? convex_cutter(c, 0) : (convex_plane){(convex_vec){0, 0, 0}, 0},
                       seen = convex_seen(work, deepest);
    convex_polygon p;
    p.failed = 0;
    for (int f = 0; f < work.shape.n_faces; ++f) {
        const convex_plane reference = convex_own_plane(work.shape, f);
        const state near = convex_dot(reference.normal, ball.centre) - reference.height;
        if (near > ball.reach || near < -ball.reach) continue; /* its plane is nowhere near */
        if (c->n > 0 && convex_face_outside(work.shape, f, seen, margin)) continue;
        const convex_plane own = convex_placed(work, reference);
        convex_load_face(work, f, &p);
        if (c->n > 0) convex_clip_by(&p, own, deepest, first);
        if (p.n > 0) convex_clip_by_kept(&p, own, c, margin, first);
        for (int k = c->rest; k < tool.shape.n_faces && p.n > 0; ++k) {
            const convex_plane other = convex_own_plane(tool.shape, k);
            if (convex_dot(other.normal, back.centre) - other.height >= -back.reach)
                convex_clip_by(&p, own, convex_placed(tool, other), first);
        }
        if (p.n > 2) convex_sum_face(&p, own, s);
    }
    return p.failed;
}

LAW convex_overlap convex_no_overlap(int failed, int apart)
{
    const convex_vec none = {0, 0, 0};
    const convex_map zero = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    return (convex_overlap){0, none, zero, zero, none, failed, apart};
}

/* Does face f of `tool` still stand between the two? As convex_find_cutters asks it. */
ROUTINE int convex_stands_between(convex_body tool, int f, convex_body work)
{
    const convex_plane seen = convex_seen(work, convex_placed(tool, convex_own_plane(tool.shape, f)));
    for (int k = 0; k < work.shape.n_corners; ++k)
        if (convex_dot(seen.normal, convex_corner(work.shape, k)) - seen.height < 0) return 0;
    return 1;
}

/* Both in the frame of the given origins. apart: what the last call found, which is looked at first; it changes nothing
 * of the result. */
ROUTINE convex_overlap convex_overlap_after(convex_shape shape_a, convex_pose pose_a, convex_shape shape_b,
                                            convex_pose pose_b, int apart)
{
    const convex_vec branch = convex_sub(pose_b.origin, pose_a.origin);
    const state radius_a = shape_a.radius * convex_stretch(pose_a.map),
                radius_b = shape_b.radius * convex_stretch(pose_b.map);
    if (convex_length(branch) > radius_a + radius_b) return convex_no_overlap(0, 0);
    if (!(convex_determinant(pose_a.map) > 0) || !(convex_determinant(pose_b.map) > 0)) return convex_no_overlap(1, 0);
    /* between the bounding spheres: near the place of contact also where one body is much larger */
    const convex_vec centre = convex_add(pose_a.origin, convex_scale(radius_a / (radius_a + radius_b), branch));
    const convex_body a = convex_body_of(shape_a, pose_a, centre), b = convex_body_of(shape_b, pose_b, centre);
    if (apart > 0 && convex_stands_between(a, apart - 1, b)) return convex_no_overlap(0, apart);
    if (apart < 0 && convex_stands_between(b, -apart - 1, a)) return convex_no_overlap(0, apart);
    const state margin = STATE(64) * STATE_ROUNDING * (radius_a + radius_b); /* skipped cuts are far from a tie */
    convex_cutters by_b, by_a;
    convex_find_cutters(b, a, margin, &by_b);
    if (by_b.apart) return convex_no_overlap(0, -by_b.apart);
    convex_find_cutters(a, b, margin, &by_a);
    if (by_a.apart) return convex_no_overlap(0, by_a.apart);
    const convex_vec none = {0, 0, 0};
    const convex_map zero = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    convex_sums s = {0, none, zero, none, 0, none, 0};
    const int failed_a = convex_clip_faces(a, b, &by_b, margin, 1, &s);
    const convex_vec area_a = s.area;
    const convex_map moment_a = s.moment;
    s.area = none;
    s.moment = zero;
    const int failed_b = convex_clip_faces(b, a, &by_a, margin, 0, &s);
    if (failed_a || failed_b) return convex_no_overlap(failed_a ? failed_a : failed_b, 0);
    if (!(s.volume > 0) || !(s.surface > 0)) return convex_no_overlap(0, 0);
    const convex_vec area = convex_scale(STATE(0.5), convex_sub(s.area, area_a));
    const convex_vec arm_a = convex_sub(s.centre, a.pose.origin), arm_b = convex_sub(s.centre, b.pose.origin);
    const convex_vec point = convex_add(centre, convex_add(s.centre, convex_scale(STATE(1) / s.surface, s.place)));
    return (convex_overlap){s.volume / STATE(3),
                            area,
                            convex_add_outer(moment_a, convex_scale(-STATE(1), area), arm_a),
                            convex_add_outer(s.moment, area, arm_b),
                            point,
                            0,
                            0};
}

ROUTINE convex_overlap convex_overlap_of(convex_shape shape_a, convex_pose pose_a, convex_shape shape_b,
                                         convex_pose pose_b)
{
    return convex_overlap_after(shape_a, pose_a, shape_b, pose_b, 0);
}

#endif
