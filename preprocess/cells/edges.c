/* With the interior angle theta, k seeds stand at the angles (i + 1/2) theta / k. Their images across the two walls
 * stand at -theta / 2k and theta + theta / 2k; both must find room in the gap of 2 pi - theta, so k >= theta / (2 pi -
 * theta). */
#include "edges.h"

#include "../../host/base/memory.h"
#include "../../host/base/random.h"
#include "../point_grid.h"

#include <math.h>
#include <string.h>

/* More seeds in a ring than this make slivers; sharper notches stay as random seeds make them. */
enum { MOST_IN_RING = 8 };
/* Rings keep so far from seeds of other rings [of the spacing]. */
#define RING_CLEARANCE 0.5
/* and other seeds so far from rings. */
#define SEED_CLEARANCE 0.4

/* Marks along the edges for the search of what is near them [of the spacing]. */
#define MARK_STEP 0.5
#define PI 3.14159265358979323846

typedef struct ring_plan {
    int32_t edge;
    double along[3], first[3],
        second[3]; /* unit: edge; into the first wall from the edge; at right angles to both, into the solid */
    double length, theta, radius, swept; /* swept: radius within which other seeds go [m] */
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
    for (int d = 0; d < 3; ++d)
        plan->along[d] = edge->end[1][d] - edge->end[0][d];
    plan->length = sqrt(dot(plan->along, plan->along));
    if (plan->length < 2.0 * spacing) return false;
    for (int d = 0; d < 3; ++d)
        plan->along[d] /= plan->length;
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
    const double angle = (i + 0.5) * plan->theta / plan->k, c = plan->radius * cos(angle),
                 s = plan->radius * sin(angle);
    for (int d = 0; d < 3; ++d)
        x[d] = edge->end[0][d] + t * plan->along[d] + c * plan->first[d] + s * plan->second[d];
}

static bool near_edge(const brc_edge *edge, const ring_plan *plan, const double x[3])
{
    const double from[3] = {x[0] - edge->end[0][0], x[1] - edge->end[0][1], x[2] - edge->end[0][2]};
    const double t = dot(from, plan->along);
    return t > 0.0 && t < plan->length && dot(from, from) - t * t < plan->swept * plan->swept;
}

/* All edges that get rings, and the seeds of those. */
typedef struct placing {
    const brc_walls *walls;
    double spacing;
    ring_plan *plan; /* [n_plans] */
    int64_t n_plans, n_rings, room, n_marks;
    double *ring;         /* [n_rings][3] [m] */
    brc_point_grid *done; /* rings of earlier edges */
    brc_point_grid *mark; /* along the edges that have rings */
    double swept;         /* the widest [m] */
} placing;

/* Is the ring free of the rings of other edges, and inside? */
static bool ring_fits(const placing *p, const ring_plan *plan, double t)
{
    for (int i = 0; i < plan->k; ++i) {
        double x[3];
        ring_seed(brc_solid_edge(p->walls->solid, plan->edge), plan, t, i, x);
        if (!brc_walls_inside(p->walls, x, 0.2 * p->spacing) ||
            brc_point_grid_crowded(p->done, x, RING_CLEARANCE * p->spacing))
            return false;
    }
    return true;
}

/* Returns whether there is room for any ring. */
static bool place_on_edge(placing *p, const ring_plan *plan, double spread, uint64_t seed)
{
    const brc_edge *edge = brc_solid_edge(p->walls->solid, plan->edge);
    const int64_t first = p->n_rings;
    for (int64_t m = 0; m < plan->n_rings; ++m) {
        double noise[4];
        brc_random_uniform4(seed, BRC_RANDOM_EDGE_RING, (uint64_t)plan->edge, (uint64_t)m, noise);
        const double t = ((double)m + 0.5 + 0.5 * spread * (noise[0] - 0.5)) * plan->length / (double)plan->n_rings;
        if (!ring_fits(p, plan, t)) continue;
        for (int i = 0; i < plan->k; ++i)
            ring_seed(edge, plan, t, i, p->ring + 3 * p->n_rings++);
    }
    for (int64_t r = first; r < p->n_rings; ++r)
        brc_point_grid_add(p->done, p->ring + 3 * r);
    return p->n_rings > first;
}

static int64_t marks_on(const placing *p, const ring_plan *plan)
{
    return (int64_t)ceil(plan->length / (MARK_STEP * p->spacing)) + 1;
}

static brc_status plan_all(brc_context *context, placing *p)
{
    const int32_t n_edges = brc_solid_n_edges(p->walls->solid);
    double bounds[2][3];
    BRC_TRY(BRC_ALLOCATE(context, &p->plan, n_edges, "concave edges"));
    for (int32_t e = 0; e < n_edges; ++e) {
        ring_plan *plan = &p->plan[p->n_plans];
        if (!plan_rings(brc_solid_edge(p->walls->solid, e), p->spacing, plan)) continue;
        plan->edge = e;
        p->room += plan->n_rings * plan->k;
        p->n_marks += marks_on(p, plan);
        ++p->n_plans;
    }
    brc_solid_bounds(p->walls->solid, bounds);
    BRC_TRY(BRC_ALLOCATE(context, &p->ring, 3 * p->room, "seeds at concave edges"));
    BRC_TRY(brc_point_grid_create(context, (const double(*)[3])bounds, p->spacing, p->room, &p->done));
    return brc_point_grid_create(context, (const double(*)[3])bounds, p->spacing, p->n_marks, &p->mark);
}

/* Rings on all edges; edges without room for any are left as they are. */
static void place_all(placing *p, double spread, uint64_t seed)
{
    int64_t to = 0;
    for (int64_t k = 0; k < p->n_plans; ++k) {
        const ring_plan *plan = &p->plan[k];
        if (!place_on_edge(p, plan, spread, seed)) continue;
        const brc_edge *edge = brc_solid_edge(p->walls->solid, plan->edge);
        const int64_t n_marks = marks_on(p, plan);
        for (int64_t m = 0; m < n_marks; ++m) {
            double x[3];
            for (int d = 0; d < 3; ++d)
                x[d] = edge->end[0][d] + plan->along[d] * plan->length * (double)m / (double)(n_marks - 1);
            brc_point_grid_add(p->mark, x);
        }
        p->swept = fmax(p->swept, plan->swept);
        p->plan[to++] = *plan;
    }
    p->n_plans = to;
}

static bool near_any_edge(const placing *p, const double x[3])
{
    if (!brc_point_grid_crowded(p->mark, x, p->swept + MARK_STEP * p->spacing)) return false;
    for (int64_t k = 0; k < p->n_plans; ++k)
        if (near_edge(brc_solid_edge(p->walls->solid, p->plan[k].edge), &p->plan[k], x)) return true;
    return false;
}

brc_status brc_edges_place(brc_context *context, const brc_walls *walls, double spacing, double spread, uint64_t seed,
                           int n_threads, double **position, int64_t *n)
{
    placing p = {.walls = walls, .spacing = spacing};
    bool *dropped = NULL;
    int64_t to = 0;
    brc_status status = BRC_OK;
    if (!walls->mirrored || brc_solid_n_edges(walls->solid) == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, plan_all(context, &p));
    if (p.n_plans == 0) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &dropped, *n, "seeds at concave edges"));
    place_all(&p, spread, seed);
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t s = 0; s < *n; ++s)
        dropped[s] = near_any_edge(&p, *position + 3 * s);
    for (int64_t s = 0; s < *n; ++s)
        if (!dropped[s]) memmove(*position + 3 * to++, *position + 3 * s, 3 * sizeof(double));
    BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)position, 3 * (to + p.n_rings), sizeof(double),
                                          "seeds at concave edges"));
    if (p.n_rings > 0) memcpy(*position + 3 * to, p.ring, 3 * (size_t)p.n_rings * sizeof(double));
    *n = to + p.n_rings;
cleanup:
    brc_point_grid_free(&p.done);
    brc_point_grid_free(&p.mark);
    brc_memory_free(p.plan);
    brc_memory_free(p.ring);
    brc_memory_free(dropped);
    return status;
}
