/* A domain keeps the corners of its cells and the polygons of free faces; those of shared faces are found again
 * (outline.h), once to count and once to write, so that threads can share the work. */
#include "convex_internal.h"

#include "../../host/base/memory.h"
#include "../cells/outline.h"
#include "../cells/polyhedron.h"

#include <math.h>
#include <omp.h>
#include <string.h>

/* Faces below a threshold are dropped when a domain is built, and outlines are matched to 1e-9 of a cell's size
 * squared. */
#define CELL_TOLERANCE 1e-6

brc_status brc_convex_allocate(brc_context *context, int64_t n, int64_t n_corners, int64_t n_faces, brc_convex *out)
{
    if (n > INT32_MAX - 1 || n_corners > INT32_MAX - 1 || n_faces > INT32_MAX - 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "contact of %lld polyhedra with %lld corners: at most 2^31 - 2 of each; use fewer elements",
                        (long long)n, (long long)n_corners);
    out->n = (int32_t)n;
    BRC_TRY(BRC_ALLOCATE(context, &out->corner_start, n + 1, "corner rows of polyhedra"));
    BRC_TRY(BRC_ALLOCATE(context, &out->corner, 3 * n_corners, "corners of polyhedra"));
    BRC_TRY(BRC_ALLOCATE(context, &out->face_start, n + 1, "face rows of polyhedra"));
    BRC_TRY(BRC_ALLOCATE(context, &out->plane, 4 * n_faces, "planes of polyhedra"));
    BRC_TRY(BRC_ALLOCATE(context, &out->loop_start, n_faces + 1, "loops of polyhedra"));
    return BRC_ALLOCATE(context, &out->radius, n, "radii of polyhedra");
}

brc_status brc_convex_allocate_loops(brc_context *context, brc_convex *convex)
{
    const int32_t n_faces = convex->face_start[convex->n];
    int64_t sum = 0;
    for (int32_t f = 0; f < n_faces; ++f) {
        sum += convex->loop_start[f + 1];
        if (sum > INT32_MAX - 1)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "contact: polyhedra with more than 2^31 - 2 corners of faces in all; use fewer elements");
        convex->loop_start[f + 1] = (int32_t)sum;
    }
    return BRC_ALLOCATE(context, &convex->loop, sum, "corners of faces of polyhedra");
}

double brc_convex_reach(const brc_convex *convex, int32_t p)
{
    double square = 0.0;
    for (int32_t k = convex->corner_start[p]; k < convex->corner_start[p + 1]; ++k) {
        const double *x = convex->corner + 3 * (int64_t)k;
        square = fmax(square, x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    }
    return sqrt(square) * (1.0 + 1e-15);
}

/* What a thread needs for the outlines of a cell. */
typedef struct tracer {
    brc_outline_corner *room;
    int32_t *out;
} tracer;

/* Corners of face k of element e into t->out, as indices into the domain's vertex; the plane too. 0: not found. */
static int64_t trace(const brc_domain *d, int64_t e, int64_t k, tracer *t, double plane[4])
{
    const int64_t n_shared = d->row_start[e + 1] - d->row_start[e];
    const double *s, *c, *x = d->position + 3 * e;
    int64_t n;
    if (k < n_shared) {
        const int64_t h = d->row_start[e] + k;
        s = d->area_vector + 3 * h;
        c = d->face_centroid + 3 * h;
        n = brc_outline(d, e, h, t->room, t->out);
    } else {
        const int64_t f = d->free_start[e] + k - n_shared;
        s = d->free_area_vector + 3 * f;
        c = d->free_centroid + 3 * f;
        n = d->free_polygon_start[f + 1] - d->free_polygon_start[f];
        memcpy(t->out, d->free_polygon + d->free_polygon_start[f], (size_t)n * sizeof *t->out);
    }
    const double area = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    plane[3] = 0.0;
    for (int m = 0; m < 3; ++m) {
        plane[m] = s[m] / area;
        plane[3] += plane[m] * (c[m] - x[m]);
    }
    return n;
}

static int64_t faces_of(const brc_domain *d, int64_t e)
{
    return d->row_start[e + 1] - d->row_start[e] + d->free_start[e + 1] - d->free_start[e];
}

/* Write the faces of element e, or, while there are no loops yet, only how many corners each has; false: a face has no
 * outline, or more corners than the limit. */
static bool cell_faces(const brc_domain *d, int64_t e, tracer *t, brc_convex *out)
{
    for (int64_t f = out->face_start[e]; f < out->face_start[e + 1]; ++f) {
        const int64_t corners = trace(d, e, f - out->face_start[e], t, out->plane + 4 * f);
        if (corners < 3 || corners > BRC_CONVEX_CORNERS) return false;
        if (!out->loop)
            out->loop_start[f + 1] = (int32_t)corners;
        else
            for (int64_t m = 0; m < corners; ++m)
                out->loop[out->loop_start[f] + m] = (int32_t)(t->out[m] - d->vertex_start[e]);
    }
    return true;
}

/* Every cell once; the first that fails, or -1. tracers: one a thread. */
static int64_t each_cell(const brc_domain *d, int n_threads, tracer *tracers, brc_convex *out)
{
    int64_t bad = INT64_MAX;
#pragma omp parallel for schedule(static) num_threads(n_threads) reduction(min : bad)
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (!cell_faces(d, e, tracers + omp_get_thread_num(), out) && e < bad) bad = e;
    return bad == INT64_MAX ? -1 : bad;
}

static brc_status refuse_cell(brc_context *context, const brc_domain *d, int64_t e)
{
    const double *x = d->position + 3 * e;
    return BRC_FAIL(context, BRC_INTERNAL,
                    "the corners of element %lld at (%g %g %g) do not outline its faces with at most %d corners each; "
                    "contact needs them: try another seed",
                    (long long)e, x[0], x[1], x[2], (int)BRC_CONVEX_CORNERS);
}

/* All that needs no outlines; *most: the most corners of a cell. */
static brc_status lay_out(brc_context *context, const brc_domain *d, brc_convex *out, int64_t *most)
{
    BRC_TRY(brc_convex_allocate(context, d->n_elements, d->vertex_start[d->n_elements],
                                d->n_half_edges + d->n_free_faces, out));
    *most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t corners = d->vertex_start[e + 1] - d->vertex_start[e], faces = faces_of(d, e);
        *most = corners > *most ? corners : *most;
        if (faces > BRC_CONVEX_FACES)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "element %lld has %lld faces; contact takes at most %d: try another seed, or fewer small "
                            "elements beside large ones",
                            (long long)e, (long long)faces, (int)BRC_CONVEX_FACES);
        out->corner_start[e + 1] = (int32_t)d->vertex_start[e + 1];
        out->face_start[e + 1] = (int32_t)(out->face_start[e] + faces);
        for (int64_t k = 3 * d->vertex_start[e]; k < 3 * d->vertex_start[e + 1]; ++k)
            out->corner[k] = d->vertex[k] - d->position[3 * e + k % 3];
        out->radius[e] = brc_convex_reach(out, (int32_t)e);
    }
    return BRC_OK;
}

brc_status brc_convex_of_domain(brc_context *context, const brc_domain *domain, int n_threads, brc_convex *out)
{
    if (domain->element_kind != BRC_ELEMENT_CELL)
        return BRC_FAIL(context, BRC_BAD_INPUT, "spheres have no faces; polyhedra are made of cells");
    const int threads = n_threads > 0 ? n_threads : omp_get_max_threads();
    int64_t most = 0;
    int32_t *corners = NULL;
    brc_outline_corner *room = NULL;
    tracer *tracers = NULL;
    brc_convex made = {.n = 0};
    brc_status status = lay_out(context, domain, &made, &most);
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &tracers, threads, "outlines"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &room, 2 * most * threads, "corners of a cell"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &corners, most * threads, "corners of a face"));
    for (int t = 0; t < threads; ++t)
        tracers[t] = (tracer){room + 2 * most * t, corners + most * t};
    const int64_t bad = each_cell(domain, threads, tracers, &made);
    if (bad >= 0) BRC_TRY_OR(cleanup, refuse_cell(context, domain, bad));
    BRC_TRY_OR(cleanup, brc_convex_allocate_loops(context, &made));
    each_cell(domain, threads, tracers, &made);
    BRC_TRY_OR(cleanup, brc_convex_check(context, &made, CELL_TOLERANCE));
    *out = made;
    made = (brc_convex){.n = 0};
cleanup:
    brc_convex_free(&made);
    brc_memory_free(corners);
    brc_memory_free(room);
    brc_memory_free(tracers);
    return status;
}

/* By how much polyhedron p fails to be convex and closed, over its size (squared). */
static double flaw(const brc_convex *c, int32_t p)
{
    const double size = c->radius[p], *corner = c->corner + 3 * (int64_t)c->corner_start[p];
    const int32_t n = c->corner_start[p + 1] - c->corner_start[p];
    double worst = c->face_start[p + 1] - c->face_start[p] < 4 ? HUGE_VAL : 0.0, sum[3] = {0.0, 0.0, 0.0};
    for (int32_t f = c->face_start[p]; f < c->face_start[p + 1]; ++f) {
        const double *plane = c->plane + 4 * (int64_t)f;
        const int32_t *loop = c->loop + c->loop_start[f], m = c->loop_start[f + 1] - c->loop_start[f];
        for (int32_t k = 0; k < n; ++k) {
            const double *x = corner + 3 * (int64_t)k;
            worst = fmax(worst, (plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] - plane[3]) / size);
        }
        double area[3] = {0.0, 0.0, 0.0}, along = 0.0;
        for (int32_t k = 0; k < m; ++k) {
            const double *x = corner + 3 * (int64_t)loop[k], *y = corner + 3 * (int64_t)loop[k + 1 < m ? k + 1 : 0];
            worst = fmax(worst, fabs(plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] - plane[3]) / size);
            for (int a = 0; a < 3; ++a)
                area[a] += 0.5 * (x[(a + 1) % 3] * y[(a + 2) % 3] - x[(a + 2) % 3] * y[(a + 1) % 3]);
        }
        for (int a = 0; a < 3; ++a) {
            sum[a] += area[a];
            along += area[a] * plane[a];
        }
        worst = fmax(worst, -along / (size * size)); /* a loop that turns inward */
    }
    for (int a = 0; a < 3; ++a)
        worst = fmax(worst, fabs(sum[a]) / (size * size));
    return worst;
}

brc_status brc_convex_check(brc_context *context, const brc_convex *convex, double tolerance)
{
    for (int32_t p = 0; p < convex->n; ++p) {
        const double found = flaw(convex, p);
        if (!(found <= tolerance))
            return BRC_FAIL(context, BRC_INTERNAL,
                            "polyhedron %d is not convex and closed: off by %.3g of its size, expected at most %.3g",
                            (int)p, found, tolerance);
    }
    return BRC_OK;
}

void brc_convex_mass(const brc_convex *convex, int32_t p, brc_rigid *out)
{
    const int32_t f = convex->face_start[p];
    const brc_polyhedron cell = {.n_vertices = convex->corner_start[p + 1] - convex->corner_start[p],
                                 .n_faces = convex->face_start[p + 1] - f,
                                 .vertex = convex->corner + 3 * (int64_t)convex->corner_start[p],
                                 .face_start = convex->loop_start + f,
                                 .face_vertex = convex->loop};
    brc_polyhedron_mass(&cell, &out->volume, out->centre, out->inertia);
}

void brc_convex_free(brc_convex *convex)
{
    void *const block[] = {convex->corner_start, convex->corner, convex->face_start, convex->plane,
                           convex->loop_start,   convex->loop,   convex->radius};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);
    *convex = (brc_convex){.n = 0};
}
