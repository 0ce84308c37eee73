/* Shapes as convex pieces, made face by face in the shape's coordinates and then moved to their mass centre. */
#include "convex_internal.h"

#include "../../host/base/memory.h"
#include "../domain/icosphere.h"
#include "../mesh/mesh.h"
#include "../mesh/vector3.h"
#include "solid.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* What a shape that is not convex is filled with by default. */
enum { PIECES = 300 };
/* Directions around a full turn that an icosahedron has: 2 pi over the angle of its edges. */
#define AROUND 5.67

static const int32_t ROW[6] = {0, 1, 2, 1, 0, 0}, COLUMN[6] = {0, 1, 2, 2, 2, 1};

/* n polyhedra, each with so many corners and room for so many faces, after they are cut, and entries of loops. */
static brc_status begin(brc_context *context, int64_t n, int64_t n_corners, int64_t n_faces, int64_t n_loop,
                        brc_convex *out)
{
    BRC_TRY(brc_convex_allocate(context, n, n * n_corners, n * n_faces, out));
    for (int64_t p = 0; p < n; ++p)
        out->corner_start[p + 1] = (int32_t)((p + 1) * n_corners);
    return BRC_ALLOCATE(context, &out->loop, n * n_loop, "corners of faces of polyhedra");
}

/* At most so many parts a face of n corners is cut into; each part has two corners of its neighbours. */
static int64_t most_parts(int64_t n)
{
    return 1 + n / (BRC_CONVEX_PART - 2);
}

/* Append the face with these corners, counter-clockwise from outside, as a fan of parts around the first, to polyhedron
 * p, the last that has any; its face_start[p + 1] counts them. */
static void add_face(brc_convex *c, int32_t p, const int32_t *corner, int32_t n)
{
    for (int32_t from = 1; from < n - 1; from += BRC_CONVEX_PART - 2) {
        const int32_t f = c->face_start[p + 1]++,
                      last = from + BRC_CONVEX_PART - 2 < n - 1 ? from + BRC_CONVEX_PART - 2 : n - 1;
        int32_t *loop = c->loop + c->loop_start[f];
        *loop++ = corner[0];
        for (int32_t k = from; k <= last; ++k)
            *loop++ = corner[k];
        c->loop_start[f + 1] = (int32_t)(loop - c->loop);
    }
}

/* Planes through the loops of polyhedron p by their area vectors, and the radius. */
static void finish_one(brc_convex *c, int32_t p)
{
    const double *corner = c->corner + 3 * (int64_t)c->corner_start[p];
    for (int32_t f = c->face_start[p]; f < c->face_start[p + 1]; ++f) {
        const int32_t *loop = c->loop + c->loop_start[f], m = c->loop_start[f + 1] - c->loop_start[f];
        double area[3] = {0.0, 0.0, 0.0}, *plane = c->plane + 4 * (int64_t)f;
        for (int32_t k = 1; k + 1 < m; ++k) {
            const double *base = corner + 3 * (int64_t)loop[0];
            double x[3], y[3], part[3];
            mesh_minus(corner + 3 * (int64_t)loop[k], base, x);
            mesh_minus(corner + 3 * (int64_t)loop[k + 1], base, y);
            mesh_cross(x, y, part);
            for (int a = 0; a < 3; ++a)
                area[a] += part[a];
        }
        const double length = sqrt(mesh_dot(area, area));
        for (int a = 0; a < 3; ++a)
            plane[a] = area[a] / length;
        plane[3] = 0.0;
        for (int32_t k = 0; k < m; ++k)
            plane[3] += mesh_dot(plane, corner + 3 * (int64_t)loop[k]) / m;
    }
    c->radius[p] = brc_convex_reach(c, p);
}
static void finish(brc_convex *c)
{
    for (int32_t p = 0; p < c->n; ++p)
        finish_one(c, p);
}

/* Move the origins of all polyhedra to `to`. */
static void move_origin(brc_convex *c, const double to[3])
{
    for (int64_t k = 0; k < 3 * (int64_t)c->corner_start[c->n]; ++k)
        c->corner[k] -= to[k % 3];
    for (int64_t f = 0; f < c->face_start[c->n]; ++f)
        c->plane[4 * f + 3] -= mesh_dot(c->plane + 4 * f, to);
    for (int32_t p = 0; p < c->n; ++p)
        c->radius[p] = brc_convex_reach(c, p);
}

static brc_status box(brc_context *context, const brc_shape *shape, brc_convex *out, brc_rigid *rigid)
{
    static const int32_t loop[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    const double *s = shape->size;
    BRC_TRY(begin(context, 1, 8, 6, 24, out));
    for (int k = 0; k < 8; ++k)
        for (int a = 0; a < 3; ++a)
            out->corner[3 * k + a] = shape->origin[a] + (k >> a & 1 ? s[a] : 0.0);
    for (int f = 0; f < 6; ++f)
        add_face(out, 0, loop[f], 4);
    *rigid = (brc_rigid){.volume = s[0] * s[1] * s[2]};
    for (int a = 0; a < 3; ++a) {
        const double b = s[(a + 1) % 3], c = s[(a + 2) % 3];
        rigid->centre[a] = shape->origin[a] + 0.5 * s[a];
        rigid->inertia[a] = rigid->volume * (b * b + c * c) / 12.0;
    }
    finish(out);
    return BRC_OK;
}

/* Regular polygon of n corners with the area of a circle: its radius over the circle's. */
static double swell_of(int32_t n)
{
    return sqrt(2.0 * PI / (n * sin(2.0 * PI / n)));
}

/* A cone's end without radius is one corner. */
static brc_status frustum(brc_context *context, const brc_shape *shape, int32_t n, brc_convex *out, brc_rigid *rigid)
{
    const int a = shape->axis, b = (a + 1) % 3, c = (a + 2) % 3;
    const double radius[2] = {shape->radius, shape->kind == BRC_SHAPE_CYLINDER ? shape->radius : shape->radius2};
    const double swell = swell_of(n);
    const int32_t count[2] = {radius[0] > 0 ? n : 1, radius[1] > 0 ? n : 1};
    int32_t *cap = NULL;
    brc_status status = begin(context, 1, count[0] + count[1], n + 2 * most_parts(n),
                              4 * (int64_t)n + 2 * (n + 2 * most_parts(n)), out);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &cap, n, "corners of a cap"));
    for (int end = 0; end < 2; ++end)
        for (int32_t k = 0; k < count[end]; ++k) {
            double *x = out->corner + 3 * (int64_t)(end * count[0] + k);
            x[a] = shape->origin[a] + end * shape->length;
            x[b] = shape->origin[b] + swell * radius[end] * cos(2.0 * PI * k / n);
            x[c] = shape->origin[c] + swell * radius[end] * sin(2.0 * PI * k / n);
        }
    for (int32_t k = 0; k < n; ++k) {
        const int32_t low = k % count[0], low_next = (k + 1) % n % count[0], high = count[0] + k % count[1],
                      high_next = count[0] + (k + 1) % n % count[1];
        int32_t m = 0, loop[4];
        loop[m++] = low;
        if (low_next != low) loop[m++] = low_next;
        loop[m++] = high_next;
        if (high_next != high) loop[m++] = high;
        add_face(out, 0, loop, m);
    }
    for (int end = 0; end < 2; ++end) {
        if (count[end] == 1) continue;
        for (int32_t k = 0; k < n; ++k)
            cap[k] = end * count[0] + (end ? k : n - 1 - k);
        add_face(out, 0, cap, n);
    }
    finish(out);
    /* r from p to q along the axis, s = 0 .. 1: integrals of r^2, r^2 s, r^2 s^2 and r^4 */
    const double p = radius[0], q = radius[1], length = shape->length;
    const double square = (p * p + p * q + q * q) / 3.0, first = (p * p + 2.0 * p * q + 3.0 * q * q) / 12.0;
    const double second = p * p / 30.0 + p * q / 10.0 + q * q / 5.0;
    const double fourth = (p * p * p * p + p * p * p * q + p * p * q * q + p * q * q * q + q * q * q * q) / 5.0;
    *rigid = (brc_rigid){.volume = PI * length * square};
    memcpy(rigid->centre, shape->origin, sizeof rigid->centre);
    rigid->centre[a] += length * first / square;
    rigid->inertia[a] = 0.5 * PI * length * fourth;
    rigid->inertia[b] = rigid->inertia[c] =
        0.5 * rigid->inertia[a] + PI * length * length * length * (second - first * first / square);
cleanup:
    brc_memory_free(cap);
    return status;
}

/* n pieces of a regular polygon's ring, each the straight way between tubes of as many flat faces in planes through the
 * axis, which two pieces share. A tube lies on flat faces along the axis and across it. */
static brc_status ring(brc_context *context, const brc_shape *shape, int32_t n, brc_convex *out, brc_rigid *rigid)
{
    const int a = shape->axis, b = (a + 1) % 3, c = (a + 2) % 3;
    /* Pappus: a piece has the tube's area in the middle between its planes, cos(pi / n) of that in them, times its way
     * there, 2 tan(pi / n) cos(pi / n) of the radius in them */
    const double radius = shape->radius * 2.0 * PI / (n * sin(2.0 * PI / n)), tube = shape->radius2 * swell_of(n);
    const int64_t caps = 2 * most_parts(n);
    int32_t *cap = NULL;
    brc_status status = begin(context, n, 2 * (int64_t)n, n + caps, 4 * (int64_t)n + 2 * (n + caps), out);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &cap, n, "corners of a cap"));
    for (int32_t p = 0; p < n; ++p) {
        out->face_start[p + 1] = out->face_start[p];
        for (int32_t k = 0; k < 2 * n; ++k) {
            const double turn = 2.0 * PI * ((p + k / n) % n) / n, around = 2.0 * PI * (k % n + 0.5) / n,
                         from_axis = radius + tube * cos(around);
            double *x = out->corner + 3 * (2 * (int64_t)n * p + k);
            x[a] = shape->origin[a] + tube * sin(around);
            x[b] = shape->origin[b] + from_axis * cos(turn);
            x[c] = shape->origin[c] + from_axis * sin(turn);
        }
        for (int32_t k = 0; k < n; ++k) {
            const int32_t next = (k + 1) % n, side[4] = {k, n + k, n + next, next};
            add_face(out, p, side, 4);
        }
        for (int end = 0; end < 2; ++end) {
            for (int32_t k = 0; k < n; ++k)
                cap[k] = end ? n + (n - 1 - k) : k;
            add_face(out, p, cap, n);
        }
    }
    finish(out);
    const double big = shape->radius * shape->radius, small = shape->radius2 * shape->radius2;
    *rigid = (brc_rigid){.volume = 2.0 * PI * PI * shape->radius * small};
    memcpy(rigid->centre, shape->origin, sizeof rigid->centre);
    rigid->inertia[a] = rigid->volume * (big + 0.75 * small);
    rigid->inertia[b] = rigid->inertia[c] = rigid->volume * (0.5 * big + 0.625 * small);
cleanup:
    brc_memory_free(cap);
    return status;
}

/* The polyhedron behind the planes n . x = 1 of the vertices n of an icosphere: a face a vertex, a corner a
 * triangle. */
static brc_status vertex_planes(brc_context *context, const brc_icosphere *s, brc_convex *out)
{
    int32_t *of_vertex = NULL, *start = NULL; /* triangles round each vertex */
    BRC_TRY(begin(context, 1, s->n_triangles, s->n_vertices, 3 * (int64_t)s->n_triangles, out));
    brc_status status = BRC_ALLOCATE(context, &of_vertex, 3 * (int64_t)s->n_triangles, "triangles of an icosphere");
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &start, s->n_vertices + 2, "triangles of an icosphere"));
    for (int32_t t = 0; t < s->n_triangles; ++t) {
        const int32_t *v = s->triangle + 3 * (int64_t)t;
        const double *p = s->vertex + 3 * (int64_t)v[0], *q = s->vertex + 3 * (int64_t)v[1],
                     *r = s->vertex + 3 * (int64_t)v[2];
        double pq[3], qr[3], rp[3]; /* x with p . x = q . x = r . x = 1 is (p x q + q x r + r x p) / (p . q x r) */
        mesh_cross(p, q, pq);
        mesh_cross(q, r, qr);
        mesh_cross(r, p, rp);
        for (int a = 0; a < 3; ++a)
            out->corner[3 * (int64_t)t + a] = (pq[a] + qr[a] + rp[a]) / mesh_dot(p, qr);
        for (int k = 0; k < 3; ++k)
            ++start[v[k] + 2];
    }
    for (int32_t v = 0; v < s->n_vertices; ++v)
        start[v + 2] += start[v + 1];
    for (int32_t t = 0; t < s->n_triangles; ++t)
        for (int k = 0; k < 3; ++k)
            of_vertex[start[s->triangle[3 * (int64_t)t + k] + 1]++] = t;
    for (int32_t v = 0; v < s->n_vertices;
         ++v) { /* from triangle to triangle around v: the next one shares the last corner */
        int32_t loop[8], m = 0, want = -1;
        while (m < start[v + 1] - start[v] && m < 8)
            for (int32_t k = start[v]; k < start[v + 1]; ++k) {
                const int32_t *corner = s->triangle + 3 * (int64_t)of_vertex[k];
                const int at = corner[0] == v ? 0 : corner[1] == v ? 1 : 2;
                if (want >= 0 && corner[(at + 1) % 3] != want) continue;
                loop[m++] = of_vertex[k];
                want = corner[(at + 2) % 3];
                break;
            }
        add_face(out, 0, loop, m);
    }
    finish(out);
cleanup:
    brc_memory_free(of_vertex);
    brc_memory_free(start);
    return status;
}

static brc_status sphere(brc_context *context, const brc_shape *shape, int32_t facets, brc_convex *out,
                         brc_rigid *rigid)
{
    brc_icosphere directions = {.level = 0};
    int level = 0;
    while (level < BRC_ICOSPHERE_LEVEL_MOST && AROUND * (1 << level) < 0.9 * facets)
        ++level;
    BRC_TRY(brc_icosphere_make(context, level, &directions));
    brc_status status = vertex_planes(context, &directions, out);
    brc_icosphere_free(&directions);
    if (status != BRC_OK) return status;
    *rigid = (brc_rigid){.volume = 4.0 / 3.0 * PI * shape->radius * shape->radius * shape->radius};
    brc_rigid unit;
    brc_convex_mass(out, 0, &unit);
    const double scale = cbrt(rigid->volume / unit.volume);
    for (int64_t k = 0; k < 3 * (int64_t)out->corner_start[1]; ++k)
        out->corner[k] = shape->origin[k % 3] + scale * out->corner[k];
    finish(out);
    for (int a = 0; a < 3; ++a) {
        rigid->centre[a] = shape->origin[a];
        rigid->inertia[a] = 0.4 * rigid->volume * shape->radius * shape->radius;
    }
    return BRC_OK;
}

static brc_status convex_mesh(brc_context *context, const brc_mesh *mesh, brc_convex *out, brc_rigid *rigid)
{
    const int64_t n = brc_mesh_n_triangles(mesh);
    const int32_t *corners;
    int32_t n_vertices;
    const double(*vertex)[3] = brc_mesh_vertices(mesh, &n_vertices);
    BRC_TRY(begin(context, 1, n_vertices, (int32_t)n, 3 * n, out));
    memcpy(out->corner, vertex, (size_t)n_vertices * sizeof *vertex);
    for (int64_t t = 0; t < n; ++t)
        if (brc_mesh_triangle(mesh, t, &corners)) add_face(out, 0, corners, 3);
    finish(out);
    brc_convex_mass(out, 0, rigid);
    return BRC_OK;
}

/* Volume, centre and inertia of all pieces together, relative to `origin` of piece p at origin + 3 p. */
static void sum_pieces(const brc_convex *c, const double *origin, brc_rigid *sum)
{
    double first[3] = {0.0, 0.0, 0.0}, second[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}; /* about the origin of all */
    *sum = (brc_rigid){.volume = 0.0};
    for (int32_t p = 0; p < c->n; ++p) {
        brc_rigid part;
        brc_convex_mass(c, p, &part);
        const double half = 0.5 * (part.inertia[0] + part.inertia[1] + part.inertia[2]);
        double x[3];
        for (int a = 0; a < 3; ++a)
            x[a] = origin[3 * (int64_t)p + a] + part.centre[a];
        sum->volume += part.volume;
        for (int a = 0; a < 3; ++a)
            first[a] += part.volume * x[a];
        for (int m = 0; m < 6; ++m)
            second[m] += part.volume * x[ROW[m]] * x[COLUMN[m]] + (m < 3 ? half : 0.0) - part.inertia[m];
    }
    for (int a = 0; a < 3; ++a)
        sum->centre[a] = first[a] / sum->volume;
    for (int m = 0; m < 6; ++m)
        second[m] -= sum->volume * sum->centre[ROW[m]] * sum->centre[COLUMN[m]];
    for (int m = 0; m < 6; ++m)
        sum->inertia[m] = (m < 3 ? second[0] + second[1] + second[2] : 0.0) - second[m];
}

static brc_status cells(brc_context *context, const brc_shape *shape, int32_t pieces, int n_threads, brc_convex *out,
                        brc_rigid *rigid)
{
    brc_build_request request = {.shape = *shape, .n_threads = n_threads};
    request.fill.kind = BRC_FILL_NOISY_GRID;
    request.fill.n_elements = pieces > 0 ? pieces : PIECES;
    brc_domain *domain = NULL;
    brc_status status = brc_domain_build(context, &request, &domain);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, brc_convex_of_domain(context, domain, n_threads, out));
    sum_pieces(out, domain->position, rigid);
    for (int32_t p = 0; p < out->n; ++p) { /* from the origin of each piece to that of the shape */
        const double *x = domain->position + 3 * (int64_t)p;
        for (int64_t k = 3 * (int64_t)out->corner_start[p]; k < 3 * (int64_t)out->corner_start[p + 1]; ++k)
            out->corner[k] += x[k % 3];
        for (int64_t f = out->face_start[p]; f < out->face_start[p + 1]; ++f)
            out->plane[4 * f + 3] += mesh_dot(out->plane + 4 * f, x);
    }
cleanup:
    brc_domain_free(&domain);
    return status;
}

brc_status brc_convex_of_shape(brc_context *context, const brc_shape *shape, int32_t facets, int32_t pieces,
                               int n_threads, brc_convex *out, brc_rigid *rigid)
{
    brc_convex made = {.n = 0};
    brc_mesh *mesh = NULL;
    brc_solid *solid = NULL;
    brc_status status = BRC_OK;
    if (facets < 8)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%d flat faces around a curved shape: at least 8", (int)facets);
    if (shape->kind == BRC_SHAPE_MESH)
        BRC_TRY_OR(cleanup, brc_mesh_read_stl(context, shape->file, shape->scale, shape->origin, n_threads, &mesh));
    else
        BRC_TRY_OR(cleanup, brc_solid_create(context, shape, n_threads, &solid)); /* for its checks */
    if (shape->kind == BRC_SHAPE_BOX)
        status = box(context, shape, &made, rigid);
    else if (shape->kind == BRC_SHAPE_CYLINDER || shape->kind == BRC_SHAPE_CONE)
        status = frustum(context, shape, facets, &made, rigid);
    else if (shape->kind == BRC_SHAPE_TORUS)
        status = ring(context, shape, facets, &made, rigid);
    else if (shape->kind == BRC_SHAPE_SPHERE)
        status = sphere(context, shape, facets, &made, rigid);
    else if (mesh && brc_mesh_is_convex(mesh))
        status = convex_mesh(context, mesh, &made, rigid);
    else
        status = cells(context, shape, pieces, n_threads, &made, rigid);
    if (status != BRC_OK) goto cleanup;
    move_origin(&made, rigid->centre);
    /* every corner against every plane: cells and small bodies; large ones are spheres, convex as they are made, and
     * meshes found to be convex */
    if ((double)made.corner_start[made.n] / made.n * made.face_start[made.n] < 1e7)
        BRC_TRY_OR(cleanup, brc_convex_check(context, &made, 1e-6));
    *out = made;
    made = (brc_convex){.n = 0};
cleanup:
    brc_solid_free(&solid);
    brc_mesh_free(&mesh);
    brc_convex_free(&made);
    return status;
}
