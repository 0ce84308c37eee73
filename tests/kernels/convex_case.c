#include "convex_case.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

convex_shape convex_case_shape(const convex_case *c)
{
    return (convex_shape){c->corner, c->plane, c->loop_start, c->loop, c->n_corners, c->n_faces, c->radius};
}

void convex_case_finish(convex_case *c)
{
    c->radius = 0;
    for (int k = 0; k < c->n_corners; ++k) {
        const convex_vec p = convex_corner(convex_case_shape(c), k);
        c->radius = fmax(c->radius, convex_length(p));
    }
    for (int f = 0; f < c->n_faces; ++f) {
        convex_vec n = {0, 0, 0}, mean = {0, 0, 0};
        const int begin = c->loop_start[f], end = c->loop_start[f + 1];
        for (int k = begin; k < end; ++k) {
            const convex_vec p = convex_corner(convex_case_shape(c), c->loop[k]);
            const convex_vec q = convex_corner(convex_case_shape(c), c->loop[k + 1 < end ? k + 1 : begin]);
            n = convex_add(n, convex_cross(p, q));
            mean = convex_add(mean, convex_scale(1.0 / (end - begin), p));
        }
        n = convex_scale(1.0 / convex_length(n), n);
        const state plane[4] = {n.x, n.y, n.z, convex_dot(n, mean)};
        memcpy(c->plane + 4 * f, plane, sizeof plane);
    }
}

void convex_case_box(convex_case *c, double x, double y, double z)
{
    static const int loop[24] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
    c->n_corners = 8;
    c->n_faces = 6;
    for (int k = 0; k < 8; ++k) {
        c->corner[3 * k] = (k & 1 ? 0.5 : -0.5) * x;
        c->corner[3 * k + 1] = (k & 2 ? 0.5 : -0.5) * y;
        c->corner[3 * k + 2] = (k & 4 ? 0.5 : -0.5) * z;
    }
    for (int f = 0; f <= 6; ++f)
        c->loop_start[f] = 4 * f;
    memcpy(c->loop, loop, sizeof loop);
    convex_case_finish(c);
}

double convex_case_number(uint64_t *random)
{
    uint64_t z = *random += 0x9e3779b97f4a7c15u; /* splitmix64 */
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return ldexp((double)((z ^ (z >> 31)) >> 11), -52) - 1.0;
}

convex_map convex_case_rotation(uint64_t *random)
{
    double q[4], square;
    do {
        square = 0;
        for (int k = 0; k < 4; ++k) {
            q[k] = convex_case_number(random);
            square += q[k] * q[k];
        }
    } while (square > 1 || square < 0.01);
    for (int k = 0; k < 4; ++k)
        q[k] /= sqrt(square);
    return (convex_map){
        1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]),     2 * (q[1] * q[3] + q[0] * q[2]),
        2 * (q[1] * q[2] + q[0] * q[3]),     1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] - q[0] * q[1]),
        2 * (q[1] * q[3] - q[0] * q[2]),     2 * (q[2] * q[3] + q[0] * q[1]),     1 - 2 * (q[1] * q[1] + q[2] * q[2])};
}

convex_map convex_case_map(double strain, uint64_t *random)
{
    double m[9];
    for (int k = 0; k < 9; ++k)
        m[k] = strain * convex_case_number(random) + (k % 4 == 0);
    const convex_map stretch = {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
    return convex_product(convex_case_rotation(random), stretch);
}

void convex_case_random(convex_case *c, convex_kind kind, int n, uint64_t *random)
{
    static const double size[CONVEX_KINDS][3] = {{1, 1, 1}, {8, 1, 1}, {1, 1, 0.1}, {1, 1, 0.01}};
    for (;;) {
        double plane[CONVEX_CASE_FACES][4];
        for (int f = 0; f < n; ++f) { /* behind a unit sphere, roughly, then stretched: a plane turns by the inverse */
            double length = 0;
            do {
                length = 0;
                for (int k = 0; k < 3; ++k) {
                    plane[f][k] = convex_case_number(random);
                    length += plane[f][k] * plane[f][k];
                }
            } while (length > 1 || length < 0.01);
            plane[f][3] = sqrt(length) * (0.8 + 0.2 * convex_case_number(random));
            length = 0;
            for (int k = 0; k < 3; ++k) {
                plane[f][k] /= size[kind][k];
                length += plane[f][k] * plane[f][k];
            }
            for (int k = 0; k < 4; ++k)
                plane[f][k] /= sqrt(length);
        }
        if (convex_case_cut(plane, n, c) > 0 && c->radius < 5 * size[kind][0]) return; /* closed, no long tips */
    }
}

static double height(const double plane[4], const double x[3])
{
    return plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] - plane[3];
}

/* The point on three planes; false: nearly parallel to a line. */
static int meet(const double *a, const double *b, const double *c, double x[3])
{
    const double bc[3] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
    const double ca[3] = {c[1] * a[2] - c[2] * a[1], c[2] * a[0] - c[0] * a[2], c[0] * a[1] - c[1] * a[0]};
    const double ab[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double determinant = a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2];
    if (fabs(determinant) < 1e-12) return 0;
    for (int k = 0; k < 3; ++k)
        x[k] = (a[3] * bc[k] + b[3] * ca[k] + c[3] * ab[k]) / determinant;
    return 1;
}

typedef struct turned {
    double angle;
    int corner;
} turned;
static int by_angle(const void *a, const void *b)
{
    const double x = ((const turned *)a)->angle, y = ((const turned *)b)->angle;
    return (x > y) - (x < y);
}

double convex_case_cut(const double (*plane)[4], int n, convex_case *c)
{
    static double corner[4096][3];
    static int on[4096][3];
    int n_corners = 0;
    for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j)
            for (int k = j + 1; k < n; ++k) {
                double x[3];
                int inside = meet(plane[i], plane[j], plane[k], x);
                for (int f = 0; f < n && inside; ++f)
                    inside = f == i || f == j || f == k || height(plane[f], x) < 0;
                if (!inside || n_corners == 4096) continue;
                memcpy(corner[n_corners], x, sizeof x);
                const int three[3] = {i, j, k};
                memcpy(on[n_corners++], three, sizeof three);
            }
    convex_case local;
    convex_case *to = c ? c : &local;
    to->n_faces = 0;
    to->n_corners = 0;
    to->loop_start[0] = 0;
    int place[4096];
    for (int k = 0; k < n_corners; ++k)
        place[k] = -1;
    double volume = 0, closed[3] = {0, 0, 0}, surface = 0;
    for (int f = 0; f < n; ++f) {
        turned ring[CONVEX_CASE_CORNERS];
        int m = 0;
        double mean[3] = {0, 0, 0};
        for (int k = 0; k < n_corners && m < CONVEX_CASE_CORNERS; ++k)
            if (on[k][0] == f || on[k][1] == f || on[k][2] == f) ring[m++].corner = k;
        if (m < 3) continue;
        for (int k = 0; k < m; ++k)
            for (int d = 0; d < 3; ++d)
                mean[d] += corner[ring[k].corner][d] / m;
        const double *u = plane[f], *o = corner[ring[0].corner];
        const double e[3] = {o[0] - mean[0], o[1] - mean[1], o[2] - mean[2]};
        const double v[3] = {u[1] * e[2] - u[2] * e[1], u[2] * e[0] - u[0] * e[2], u[0] * e[1] - u[1] * e[0]};
        for (int k = 0; k < m; ++k) {
            const double *x = corner[ring[k].corner];
            double along = 0, across = 0;
            for (int d = 0; d < 3; ++d) {
                along += (x[d] - mean[d]) * e[d];
                across += (x[d] - mean[d]) * v[d];
            }
            ring[k].angle = atan2(across, along);
        }
        qsort(ring, (size_t)m, sizeof *ring, by_angle);
        double area = 0;
        for (int k = 0; k < m; ++k) {
            const double *p = corner[ring[k].corner], *q = corner[ring[(k + 1) % m].corner];
            for (int d = 0; d < 3; ++d)
                area += 0.5 * u[d] *
                        ((p[(d + 1) % 3] - mean[(d + 1) % 3]) * (q[(d + 2) % 3] - mean[(d + 2) % 3]) -
                         (p[(d + 2) % 3] - mean[(d + 2) % 3]) * (q[(d + 1) % 3] - mean[(d + 1) % 3]));
        }
        volume += area * u[3] / 3;
        surface += area;
        for (int d = 0; d < 3; ++d)
            closed[d] += area * u[d];
        if (!c) continue;
        for (int k = 0; k < m; ++k) {
            int *at = place + ring[k].corner;
            if (*at < 0) {
                *at = c->n_corners++;
                memcpy(c->corner + 3 * *at, corner[ring[k].corner], sizeof corner[0]);
            }
            c->loop[c->loop_start[c->n_faces] + k] = *at;
        }
        c->loop_start[c->n_faces + 1] = c->loop_start[c->n_faces] + m;
        ++c->n_faces;
    }
    if (sqrt(closed[0] * closed[0] + closed[1] * closed[1] + closed[2] * closed[2]) > 1e-9 * surface)
        return 0; /* open to one side */
    if (c && n_corners > 0) convex_case_finish(c);
    return volume;
}

double convex_case_shared(const convex_case *a, convex_pose pose_a, const convex_case *b, convex_pose pose_b)
{
    double plane[2 * CONVEX_CASE_FACES][4];
    int n = 0;
    for (int side = 0; side < 2; ++side) {
        const convex_case *c = side ? b : a;
        const convex_pose pose = side ? pose_b : pose_a;
        const convex_map turn = convex_transpose(convex_inverse(pose.map));
        for (int f = 0; f < c->n_faces; ++f) {
            const convex_vec own = {c->plane[4 * f], c->plane[4 * f + 1], c->plane[4 * f + 2]};
            const convex_vec normal = convex_turn(turn, own);
            const double k = 1 / convex_length(normal);
            plane[n][0] = k * normal.x;
            plane[n][1] = k * normal.y;
            plane[n][2] = k * normal.z;
            plane[n++][3] = k * (c->plane[4 * f + 3] + convex_dot(normal, pose.origin));
        }
    }
    return convex_case_cut((const double(*)[4])plane, n, NULL);
}
