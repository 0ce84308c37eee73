#include "support_mesh.h"
#include "support.h"

#include "../../host/base/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void test_mesh_free(test_mesh *mesh)
{
    free(mesh->corner);
    *mesh = (test_mesh){0};
}

void test_mesh_add(test_mesh *mesh, const double a[3], const double b[3], const double c[3])
{
    if (mesh->n == mesh->capacity) {
        mesh->capacity = mesh->capacity ? 2 * mesh->capacity : 64;
        mesh->corner = realloc(mesh->corner, (size_t)(3 * mesh->capacity) * sizeof *mesh->corner);
        assert_non_null(mesh->corner);
    }
    memcpy(mesh->corner[3 * mesh->n], a, 3 * sizeof *a);
    memcpy(mesh->corner[3 * mesh->n + 1], b, 3 * sizeof *b);
    memcpy(mesh->corner[3 * mesh->n + 2], c, 3 * sizeof *c);
    ++mesh->n;
}

static void add_quad(test_mesh *mesh, const double a[3], const double b[3], const double c[3], const double d[3])
{
    test_mesh_add(mesh, a, b, c);
    test_mesh_add(mesh, a, c, d);
}

void test_mesh_box(test_mesh *mesh, const double low[3], const double high[3], int n)
{
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    double p[4][3];
                    for (int k = 0; k < 4; ++k) {
                        const int s = i + (k == 1 || k == 2), t = j + (k >= 2), u = (axis + 1) % 3, v = (axis + 2) % 3;
                        p[k][axis] = side ? high[axis] : low[axis];
                        p[k][u] = s == n ? high[u] : low[u] + (high[u] - low[u]) * s / n;
                        p[k][v] = t == n ? high[v] : low[v] + (high[v] - low[v]) * t / n;
                    }
                    if (side)
                        add_quad(mesh, p[0], p[1], p[2], p[3]);
                    else
                        add_quad(mesh, p[0], p[3], p[2], p[1]);
                }
}

void test_mesh_sphere(test_mesh *mesh, const double centre[3], double radius, int f)
{
    for (int octant = 0; octant < 8; ++octant) {
        const double sign[3] = {octant & 1 ? -1.0 : 1.0, octant & 2 ? -1.0 : 1.0, octant & 4 ? -1.0 : 1.0};
        const bool mirrored = sign[0] * sign[1] * sign[2] < 0.0;
        for (int i = 0; i < f; ++i)
            for (int j = 0; i + j < f; ++j)
                for (int half = 0; half < 2; ++half) {
                    if (half && i + j + 2 > f) continue;
                    const int at[2][3][2] = {{{i, j}, {i + 1, j}, {i, j + 1}},
                                             {{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
                    double p[3][3];
                    for (int k = 0; k < 3; ++k) {
                        const double a = at[half][k][0], b = at[half][k][1], c = f - a - b,
                                     length = sqrt(a * a + b * b + c * c);
                        p[k][0] = centre[0] + radius * sign[0] * a / length;
                        p[k][1] = centre[1] + radius * sign[1] * b / length;
                        p[k][2] = centre[2] + radius * sign[2] * c / length;
                    }
                    if (mirrored)
                        test_mesh_add(mesh, p[0], p[2], p[1]);
                    else
                        test_mesh_add(mesh, p[0], p[1], p[2]);
                }
    }
}

void test_mesh_torus(test_mesh *mesh, double radius, double tube, int n, int m)
{
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            double p[4][3];
            for (int k = 0; k < 4; ++k) {
                const double a = 2.0 * acos(-1.0) * ((i + (k == 1 || k == 2)) % n) / n,
                             b = 2.0 * acos(-1.0) * ((j + (k >= 2)) % m) / m;
                p[k][0] = (radius + tube * cos(b)) * cos(a);
                p[k][1] = (radius + tube * cos(b)) * sin(a);
                p[k][2] = tube * sin(b);
            }
            add_quad(mesh, p[0], p[1], p[2], p[3]);
        }
}

void test_mesh_l_profile(test_mesh *mesh, double height)
{
    static const double L[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    static const int FAN[4][3] = {{3, 4, 5}, {3, 5, 0}, {3, 0, 1}, {3, 1, 2}}; /* from the concave corner */
    double p[2][6][3];
    for (int k = 0; k < 12; ++k) {
        p[k / 6][k % 6][0] = L[k % 6][0];
        p[k / 6][k % 6][1] = L[k % 6][1];
        p[k / 6][k % 6][2] = k < 6 ? 0.0 : height;
    }
    for (int k = 0; k < 4; ++k) {
        test_mesh_add(mesh, p[1][FAN[k][0]], p[1][FAN[k][1]], p[1][FAN[k][2]]);
        test_mesh_add(mesh, p[0][FAN[k][0]], p[0][FAN[k][2]], p[0][FAN[k][1]]);
    }
    for (int k = 0; k < 6; ++k)
        add_quad(mesh, p[0][k], p[0][(k + 1) % 6], p[1][(k + 1) % 6], p[1][k]);
}

/* -1 to 1, the same for all triangles at a vertex. */
static double roughness(const double x[3], double wavelength)
{
    double u[4], sum = 0.0;
    if (wavelength > 0.0) {
        for (int d = 0; d < 3; ++d)
            sum += sin(2.0 * acos(-1.0) / wavelength * (x[d] + 0.31 * x[(d + 1) % 3])) / 3.0;
        return sum;
    }
    uint64_t word[3];
    for (int d = 0; d < 3; ++d)
        word[d] = (uint64_t)llround(1e9 * x[d]);
    brc_random_uniform4(word[0], BRC_RANDOM_TEST, word[1], word[2], u);
    return 2.0 * u[0] - 1.0;
}

void test_mesh_roughen(test_mesh *mesh, const double centre[3], double amplitude, double wavelength)
{
    for (int64_t k = 0; k < 3 * mesh->n; ++k) {
        double *x = mesh->corner[k], arm[3];
        for (int d = 0; d < 3; ++d)
            arm[d] = x[d] - centre[d];
        const double stretch =
            1.0 + amplitude * roughness(x, wavelength) / sqrt(arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2]);
        for (int d = 0; d < 3; ++d)
            x[d] = centre[d] + stretch * arm[d];
    }
}

void test_mesh_reverse(test_mesh *mesh, int64_t first, int64_t step)
{
    for (int64_t t = first; t < mesh->n; t += step)
        for (int d = 0; d < 3; ++d) {
            const double x = mesh->corner[3 * t + 1][d];
            mesh->corner[3 * t + 1][d] = mesh->corner[3 * t + 2][d];
            mesh->corner[3 * t + 2][d] = x;
        }
}

void test_mesh_turn(test_mesh *mesh, double angle, const double shift[3])
{
    const double u[3] = {1.0 / sqrt(14.0), 2.0 / sqrt(14.0), 3.0 / sqrt(14.0)};
    for (int64_t k = 0; k < 3 * mesh->n; ++k) {
        double *x = mesh->corner[k];
        const double along = (u[0] * x[0] + u[1] * x[1] + u[2] * x[2]) * (1.0 - cos(angle));
        const double turned[3] = {
            x[0] * cos(angle) + (u[1] * x[2] - u[2] * x[1]) * sin(angle) + u[0] * along + shift[0],
            x[1] * cos(angle) + (u[2] * x[0] - u[0] * x[2]) * sin(angle) + u[1] * along + shift[1],
            x[2] * cos(angle) + (u[0] * x[1] - u[1] * x[0]) * sin(angle) + u[2] * along + shift[2]};
        memcpy(x, turned, sizeof turned);
    }
}

void test_mesh_write_binary(const test_mesh *mesh, const char *path)
{
    FILE *file = fopen(path, "wb");
    const uint32_t n = (uint32_t)mesh->n;
    char header[80] = "solid but binary"; /* as some programs write */
    assert_non_null(file);
    assert_int_equal(fwrite(header, 1, sizeof header, file), sizeof header);
    assert_int_equal(fwrite(&n, sizeof n, 1, file), 1); /* tests run on little-endian machines */
    for (int64_t t = 0; t < mesh->n; ++t) {
        char record[50] = {0};
        for (int k = 0; k < 9; ++k) {
            const float x = (float)mesh->corner[3 * t + k / 3][k % 3];
            memcpy(record + 12 + 4 * k, &x, sizeof x);
        }
        assert_int_equal(fwrite(record, 1, sizeof record, file), sizeof record);
    }
    assert_int_equal(fclose(file), 0);
}

void test_mesh_write_ascii(const test_mesh *mesh, const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "solid a facet of life\n");
    for (int64_t t = 0; t < mesh->n; ++t) {
        fprintf(file, "  facet normal 0 0 0\n    outer loop\n");
        for (int k = 0; k < 3; ++k) {
            const double *x = mesh->corner[3 * t + k];
            fprintf(file, "      vertex %.17g %.17g %.17g\n", x[0], x[1], x[2]);
        }
        fprintf(file, "    endloop\n  endfacet\n");
    }
    fprintf(file, "endsolid\n");
    assert_int_equal(fclose(file), 0);
}

brc_mesh *test_mesh_read(brc_context *context, const test_mesh *mesh, int n_threads, brc_status *status)
{
    static const double ORIGIN[3] = {0.0, 0.0, 0.0};
    char path[64];
    brc_mesh *out = NULL;
    snprintf(path, sizeof path, "test_mesh_%ld.stl", (long)getpid());
    test_mesh_write_ascii(mesh, path);
    brc_context_clear(context);
    *status = brc_mesh_read_stl(context, path, 1.0, ORIGIN, n_threads, &out);
    remove(path);
    return out;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double test_mesh_winding(const test_mesh *mesh, const double x[3])
{
    double sum = 0.0;
    for (int64_t t = 0; t < mesh->n; ++t) {
        double p[3][3], r[3];
        for (int k = 0; k < 3; ++k) {
            for (int d = 0; d < 3; ++d)
                p[k][d] = mesh->corner[3 * t + k][d] - x[d];
            r[k] = sqrt(dot(p[k], p[k]));
        }
        const double volume = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                              p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                              p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
        sum += 2.0 * atan2(volume, r[0] * r[1] * r[2] + dot(p[0], p[1]) * r[2] + dot(p[1], p[2]) * r[0] +
                                       dot(p[2], p[0]) * r[1]);
    }
    return sum / (4.0 * acos(-1.0));
}

/* Least of the distances to the three edges and, where the foot in the plane lies inside, to the plane. */
static double distance2_of(const double a[3], const double b[3], const double c[3], const double x[3])
{
    double best = HUGE_VAL;
    const double *const corner[3] = {a, b, c};
    for (int k = 0; k < 3; ++k) { /* edges with their ends */
        const double *p = corner[k], *q = corner[(k + 1) % 3];
        const double along[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]},
                     arm[3] = {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
        const double share = fmax(0.0, fmin(1.0, dot(along, arm) / dot(along, along)));
        const double gap[3] = {arm[0] - share * along[0], arm[1] - share * along[1], arm[2] - share * along[2]};
        best = fmin(best, dot(gap, gap));
    }
    double ab[3], ac[3], ax[3];
    for (int d = 0; d < 3; ++d) {
        ab[d] = b[d] - a[d];
        ac[d] = c[d] - a[d];
        ax[d] = x[d] - a[d];
    }
    const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), bx = dot(ab, ax), cx = dot(ac, ax),
                 det = bb * cc - bc * bc;
    const double s = (bx * cc - cx * bc) / det, t = (cx * bb - bx * bc) / det; /* foot in the plane: a + s ab + t ac */
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) {
        const double gap[3] = {ax[0] - s * ab[0] - t * ac[0], ax[1] - s * ab[1] - t * ac[1],
                               ax[2] - s * ab[2] - t * ac[2]};
        best = fmin(best, dot(gap, gap));
    }
    return best;
}

double test_mesh_distance(const test_mesh *mesh, const double x[3])
{
    double best = HUGE_VAL;
    for (int64_t t = 0; t < mesh->n; ++t)
        best = fmin(best, distance2_of(mesh->corner[3 * t], mesh->corner[3 * t + 1], mesh->corner[3 * t + 2], x));
    return sqrt(best);
}
