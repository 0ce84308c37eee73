/* Moments of a convex polyhedron as sums over its faces, each cut into triangles from its first corner. */
#include "polyhedron.h"

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void brc_polyhedron_face(const brc_polyhedron *cell, int32_t f, const double normal[3], double height, double *area,
                         double centroid[3])
{
    const int32_t *corner = cell->face_vertex + cell->face_start[f];
    const int32_t n = cell->face_start[f + 1] - cell->face_start[f];
    const double *o = cell->vertex + 3 * (int64_t)corner[0];
    double sum = 0.0, moment[3] = {0.0, 0.0, 0.0}, mean[3] = {0.0, 0.0, 0.0};
    for (int32_t k = 1; k < n; ++k) {
        const double *p = cell->vertex + 3 * (int64_t)corner[k];
        const double a[3] = {p[0] - o[0], p[1] - o[1], p[2] - o[2]};
        for (int d = 0; d < 3; ++d)
            mean[d] += a[d] / n;
        if (k + 1 == n) break;
        const double *q = cell->vertex + 3 * (int64_t)corner[k + 1];
        const double b[3] = {q[0] - o[0], q[1] - o[1], q[2] - o[2]};
        double twice[3];
        cross(a, b, twice);
        const double weight = 0.5 * dot(twice, normal);
        sum += weight;
        for (int d = 0; d < 3; ++d)
            moment[d] += weight * (a[d] + b[d]) / 3.0;
    }
    *area = sum > 0.0 ? sum : 0.0;
    double above = -height;
    for (int d = 0; d < 3; ++d) {
        centroid[d] = o[d] + (sum > 0.0 ? moment[d] / sum : mean[d]);
        above += centroid[d] * normal[d];
    }
    for (int d = 0; d < 3; ++d)
        centroid[d] -= above * normal[d];
}

void brc_polyhedron_mass(const brc_polyhedron *cell, double *volume, double centroid[3], double inertia[6])
{
    /* sums over the tetrahedra of the seed and a triangle a b c, with D = a . (b x c):
       V = D/6, first moment D/24 (a+b+c), second moment D/120 [(a+b+c)(a+b+c) + aa + bb + cc] */
    double v = 0.0, first[3] = {0.0, 0.0, 0.0}, second[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    for (int32_t f = 0; f < cell->n_faces; ++f) {
        const int32_t *corner = cell->face_vertex + cell->face_start[f];
        const int32_t n = cell->face_start[f + 1] - cell->face_start[f];
        const double *a = cell->vertex + 3 * (int64_t)corner[0];
        for (int32_t k = 1; k + 1 < n; ++k) {
            const double *b = cell->vertex + 3 * (int64_t)corner[k];
            const double *c = cell->vertex + 3 * (int64_t)corner[k + 1];
            double area[3], s[3];
            cross(b, c, area);
            const double det = dot(a, area);
            for (int d = 0; d < 3; ++d)
                s[d] = a[d] + b[d] + c[d];
            v += det;
            for (int d = 0; d < 3; ++d)
                first[d] += det * s[d];
            for (int m = 0; m < 6; ++m) {
                const int i = row[m], j = column[m];
                second[m] += det * (s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
            }
        }
    }
    v /= 6.0;
    for (int d = 0; d < 3; ++d)
        centroid[d] = first[d] / (24.0 * v);
    double covariance[6];
    for (int m = 0; m < 6; ++m)
        covariance[m] = second[m] / 120.0 - v * centroid[row[m]] * centroid[column[m]];
    *volume = v;
    inertia[0] = covariance[1] + covariance[2];
    inertia[1] = covariance[0] + covariance[2];
    inertia[2] = covariance[0] + covariance[1];
    for (int m = 3; m < 6; ++m)
        inertia[m] = -covariance[m];
}
