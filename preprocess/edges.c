/* With the interior angle theta, k seeds stand at the angles (i + 1/2) theta / k. Their images across the two walls stand at -theta / 2k and
 * theta + theta / 2k; both must find room in the gap of 2 pi - theta, so k >= theta / (2 pi - theta). */
#include "edges.h"

#include "../host/base/memory.h"
#include "../host/base/random.h"

#include <math.h>
#include <string.h>

/* More seeds in a ring than this make slivers; sharper notches stay as random seeds make them. */
enum { MOST_IN_RING = 8 };
/* Rings keep so far from seeds of other rings [of the spacing]. */
#define RING_CLEARANCE 0.5
/* and other seeds so far from rings. */
#define SEED_CLEARANCE 0.4
#define PI 3.14159265358979323846

typedef struct ring_plan {
    double along[3], first[3], second[3]; /* unit: edge; into the first wall from the edge; at right angles to both, into the solid */
    double length, theta, radius, swept;  /* swept: radius within which other seeds go [m] */
    int k;
    int64_t n_rings;
} ring_plan;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* false: too short or too sharp. */
static bool plan_rings(const brc_edge *edge, double spacing, ring_plan *plan)
{
    for (int d = 0; d < 3; ++d) plan->along[d] = edge->end[1][d] - edge->end[0][d];
    plan->length = sqrt(dot(plan->along, plan->along));
    if (plan->length < 2.0 * spacing) return false;
    for (int d = 0; d < 3; ++d) plan->along[d] /= plan->length;
    /* the first wall runs away from the edge on the side the second wall faces */
    const double cosine = dot(edge->normal[0], edge->normal[1]), sine = sqrt(fmax(0.0, 1.0 - cosine * cosine));
    if (sine < 1e-3) return false;
    for (int d = 0; d < 3; ++d) {
        plan->first[d] = (edge->normal[1][d] - cosine * edge->normal[0][d]) / sine;
        plan->second[d] = -edge->normal[0][d];
    }
    plan->theta = PI + acos(fmax(-1.0, fmin(1.0, cosine)));
    const double least = plan->theta / (2.0 * PI - plan->theta);
    plan->k = (int)ceil(least - 1e-9);
    if (plan->k < 2) plan->k = 2;
    if (plan->k > MOST_IN_RING) return false;
    plan->radius = spacing / (2.0 * sin(0.5 * plan->theta / plan->k));
    plan->swept = fmax(plan->radius + SEED_CLEARANCE * spacing, spacing * sqrt(2.0 * plan->k / plan->theta));
    plan->n_rings = llround(plan->length / spacing);
    return true;
}

static void ring_seed(const brc_edge *edge, const ring_plan *plan, double t, int i, double x[3])
{
    const double angle = (i + 0.5) * plan->theta / plan->k, c = plan->radius * cos(angle), s = plan->radius * sin(angle);
    for (int d = 0; d < 3; ++d) x[d] = edge->end[0][d] + t * plan->along[d] + c * plan->first[d] + s * plan->second[d];
}

static bool near_edge(const brc_edge *edge, const ring_plan *plan, double past, const double x[3])
{
    const double from[3] = {x[0] - edge->end[0][0], x[1] - edge->end[0][1], x[2] - edge->end[0][2]};
    const double t = dot(from, plan->along);
    return t > -past && t < plan->length + past && dot(from, from) - t * t < plan->swept * plan->swept;
}

/* Is the ring free of the rings of other edges, and inside? */
static bool ring_fits(const brc_walls *walls, const brc_edge *edge, const ring_plan *plan, double t, double spacing, const double *rings, int64_t n_others)
{
    for (int i = 0; i < plan->k; ++i) {
        double x[3];
        ring_seed(edge, plan, t, i, x);
        if (!brc_walls_inside(walls, x, 0.2 * spacing)) return false;
        for (int64_t o = 0; o < n_others; ++o) {
            const double r[3] = {x[0] - rings[3 * o], x[1] - rings[3 * o + 1], x[2] - rings[3 * o + 2]};
            if (dot(r, r) < RING_CLEARANCE * RING_CLEARANCE * spacing * spacing) return false;
        }
    }
    return true;
}

static brc_status place_on_edge(brc_context *context, const brc_walls *walls, int32_t e, const ring_plan *plan, double spacing, double spread, uint64_t seed,
                                double **rings, int64_t *n_rings)
{
    const brc_edge *edge = brc_solid_edge(walls->solid, e);
    const int64_t n_others = *n_rings;
    BRC_TRY(brc_memory_resize(context, (void **)rings, 3 * (*n_rings + plan->n_rings * plan->k), sizeof(double), "seeds at concave edges"));
    for (int64_t m = 0; m < plan->n_rings; ++m) {
        double noise[4];
        brc_random_uniform4(seed, BRC_RANDOM_EDGE_RING, (uint64_t)e, (uint64_t)m, noise);
        const double t = ((double)m + 0.5 + 0.5 * spread * (noise[0] - 0.5)) * plan->length / (double)plan->n_rings;
        if (!ring_fits(walls, edge, plan, t, spacing, *rings, n_others)) continue;
        for (int i = 0; i < plan->k; ++i) ring_seed(edge, plan, t, i, *rings + 3 * (*n_rings)++);
    }
    return BRC_OK;
}

brc_status brc_edges_place(brc_context *context, const brc_walls *walls, double spacing, double spread, uint64_t seed, int n_threads, double **position, int64_t *n)
{
    const int32_t n_edges = walls->mirrored ? brc_solid_n_edges(walls->solid) : 0;
    ring_plan *plan = NULL;
    double *rings = NULL;
    bool *dropped = NULL;
    int64_t n_rings = 0, to = 0;
    brc_status status = BRC_OK;
    if (n_edges == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &plan, n_edges, "concave edges"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &dropped, *n, "seeds at concave edges"));
    for (int32_t e = 0; e < n_edges; ++e) {
        const int64_t before = n_rings;
        if (plan_rings(brc_solid_edge(walls->solid, e), spacing, &plan[e]))
            BRC_TRY_OR(cleanup, place_on_edge(context, walls, e, &plan[e], spacing, spread, seed, &rings, &n_rings));
        if (n_rings == before) plan[e].k = 0; /* none */
    }
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t s = 0; s < *n; ++s)
        for (int32_t e = 0; e < n_edges && !dropped[s]; ++e)
            dropped[s] = plan[e].k > 0 && near_edge(brc_solid_edge(walls->solid, e), &plan[e], 0.0, *position + 3 * s);
    for (int64_t s = 0; s < *n; ++s)
        if (!dropped[s]) memmove(*position + 3 * to++, *position + 3 * s, 3 * sizeof(double));
    BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)position, 3 * (to + n_rings), sizeof(double), "seeds at concave edges"));
    if (n_rings > 0) memcpy(*position + 3 * to, rings, 3 * (size_t)n_rings * sizeof(double));
    *n = to + n_rings;
cleanup:
    brc_memory_free(plan);
    brc_memory_free(rings);
    brc_memory_free(dropped);
    return status;
}
