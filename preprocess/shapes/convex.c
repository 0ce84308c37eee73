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

static brc_status check_range(brc_context *context, const brc_convex *convex, int64_t first, int64_t end,
                              double tolerance);

brc_status brc_convex_check_size(brc_context *context, int64_t n, int64_t n_corners, int64_t n_faces)
{
    if (n > INT32_MAX - 1 || n_corners > INT32_MAX - 1 || n_faces > INT32_MAX - 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "contact of %lld polyhedra with %lld corners: at most 2^31 - 2 of each; use fewer elements",
                        (long long)n, (long long)n_corners);
    return BRC_OK;
}

brc_status brc_convex_check_loops(brc_context *context, int64_t n_loops)
{
    if (n_loops > INT32_MAX - 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "contact: polyhedra with more than 2^31 - 2 corners of faces in all; use fewer elements");
    return BRC_OK;
}

brc_status brc_convex_allocate(brc_context *context, int64_t n, int64_t n_corners, int64_t n_faces, brc_convex *out)
{
    BRC_TRY(brc_convex_check_size(context, n, n_corners, n_faces));
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
        BRC_TRY(brc_convex_check_loops(context, sum));
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

/* Each cell of a range once; the first that fails, or -1. tracers: one a thread. */
static int64_t each_cell(const brc_domain *d, int64_t first, int64_t end, int n_threads, tracer *tracers,
                         brc_convex *out)
{
    int64_t bad = INT64_MAX;
#pragma omp parallel for schedule(static) num_threads(n_threads) reduction(min : bad)
    for (int64_t e = first; e < end; ++e)
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

int64_t brc_convex_face_start(const brc_domain *d, int64_t e)
{
    return d->row_start[e] + d->free_start[e];
}

/* All that needs no outlines. */
static brc_status lay_out(brc_context *context, const brc_domain *d, int64_t first, int64_t end, brc_convex *out)
{
    for (int64_t e = first; e < end; ++e) {
        const int64_t faces = brc_convex_face_start(d, e + 1) - brc_convex_face_start(d, e);
        if (faces > BRC_CONVEX_FACES)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "element %lld has %lld faces; contact takes at most %d: try another seed, or fewer small "
                            "elements beside large ones",
                            (long long)e, (long long)faces, (int)BRC_CONVEX_FACES);
        out->corner_start[e] = (int32_t)d->vertex_start[e];
        out->corner_start[e + 1] = (int32_t)d->vertex_start[e + 1];
        out->face_start[e] = (int32_t)brc_convex_face_start(d, e);
        out->face_start[e + 1] = (int32_t)brc_convex_face_start(d, e + 1);
        for (int64_t k = 3 * d->vertex_start[e]; k < 3 * d->vertex_start[e + 1]; ++k)
            out->corner[k] = d->vertex[k] - d->position[3 * e + k % 3];
        out->radius[e] = brc_convex_reach(out, (int32_t)e);
    }
    return BRC_OK;
}

/* A tracer a thread. */
typedef struct tracers {
    int n;
    tracer *one;
    brc_outline_corner *room;
    int32_t *corners;
} tracers;

static void free_tracers(tracers *t)
{
    brc_memory_free(t->corners);
    brc_memory_free(t->room);
    brc_memory_free(t->one);
}

static brc_status make_tracers(brc_context *context, const brc_domain *d, int64_t first, int64_t end, int n_threads,
                               tracers *out)
{
    int64_t most = 0;
    out->n = n_threads > 0 ? n_threads : omp_get_max_threads();
    for (int64_t e = first; e < end; ++e)
        most = d->vertex_start[e + 1] - d->vertex_start[e] > most ? d->vertex_start[e + 1] - d->vertex_start[e] : most;
    BRC_TRY(BRC_ALLOCATE(context, &out->one, out->n, "outlines"));
    BRC_TRY(BRC_ALLOCATE(context, &out->room, 2 * most * out->n, "corners of a cell"));
    BRC_TRY(BRC_ALLOCATE(context, &out->corners, most * out->n, "corners of a face"));
    for (int t = 0; t < out->n; ++t)
        out->one[t] = (tracer){out->room + 2 * most * t, out->corners + most * t};
    return BRC_OK;
}

brc_status brc_convex_measure_cells(brc_context *context, const brc_domain *d, int64_t first, int64_t end,
                                    int n_threads, brc_convex *out)
{
    BRC_ENDS_WITH(free_tracers) tracers t = {0};
    BRC_TRY(lay_out(context, d, first, end, out));
    BRC_TRY(make_tracers(context, d, first, end, n_threads, &t));
    const int64_t bad = each_cell(d, first, end, t.n, t.one, out);
    return bad < 0 ? BRC_OK : refuse_cell(context, d, bad);
}

brc_status brc_convex_outline_cells(brc_context *context, const brc_domain *d, int64_t first, int64_t end,
                                    int n_threads, brc_convex *out)
{
    BRC_ENDS_WITH(free_tracers) tracers t = {0};
    BRC_TRY(make_tracers(context, d, first, end, n_threads, &t));
    each_cell(d, first, end, t.n, t.one, out);
    return check_range(context, out, first, end, CELL_TOLERANCE);
}

brc_status brc_convex_of_domain(brc_context *context, const brc_domain *d, int n_threads, brc_convex *out)
{
    const int64_t n = d->n_elements;
    brc_convex made = {.n = 0};
    brc_status status = BRC_OK;
    if (d->element_kind != BRC_ELEMENT_CELL)
        return BRC_FAIL(context, BRC_BAD_INPUT, "spheres have no faces; polyhedra are made of cells");
    BRC_TRY_OR(cleanup, brc_convex_allocate(context, n, d->vertex_start[n], d->n_half_edges + d->n_free_faces, &made));
    BRC_TRY_OR(cleanup, brc_convex_measure_cells(context, d, 0, n, n_threads, &made));
    BRC_TRY_OR(cleanup, brc_convex_allocate_loops(context, &made));
    BRC_TRY_OR(cleanup, brc_convex_outline_cells(context, d, 0, n, n_threads, &made));
    *out = made;
    made = (brc_convex){.n = 0};
cleanup:
    brc_convex_free(&made);
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

static brc_status check_range(brc_context *context, const brc_convex *convex, int64_t first, int64_t end,
                              double tolerance)
{
    for (int64_t p = first; p < end; ++p) {
        const double found = flaw(convex, (int32_t)p);
        if (!(found <= tolerance))
            return BRC_FAIL(context, BRC_INTERNAL,
                            "polyhedron %lld is not convex and closed: off by %.3g of its size, expected at most %.3g",
                            (long long)p, found, tolerance);
    }
    return BRC_OK;
}

brc_status brc_convex_check(brc_context *context, const brc_convex *convex, double tolerance)
{
    return check_range(context, convex, 0, convex->n, tolerance);
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
