#include "reproduce_fracture.h"
#include "../../base/memory.h"
#include "../../output/cracks/crack_statistics.h"
#include <math.h>

static const double least_half = 0.25, least_piece = 0.05; /* of the mass */
static const double early = 0.01;                          /* of the area that breaks */

/* Middle of the domain's volume. */
static void centre_of(const brc_domain *d, double out[3])
{
    double volume = 0;
    out[0] = out[1] = out[2] = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        volume += d->volume[e];
        for (int c = 0; c < 3; ++c)
            out[c] += d->volume[e] * d->position[3 * e + c];
    }
    for (int c = 0; c < 3; ++c)
        out[c] /= volume;
}

/* The first step or event with breaks: the events come in their order. */
static void add_first(const brc_scene *scene, const brc_domain *domain, int64_t n, const brc_break *breaks,
                      brc_outcome *outcome)
{
    const brc_shape *shape = &scene->bodies[0].shape;
    const bool is_disc = scene->n_bodies == 1 && shape->kind == BRC_SHAPE_CYLINDER;
    double centre[3], place[3] = {0, 0, 0}, area = 0, square = 0, stress = 0;
    centre_of(domain, centre);
    for (int64_t k = 0; k < n && breaks[k].step == breaks[0].step; ++k) {
        area += breaks[k].area;
        stress = fmax(stress, breaks[k].stress);
        for (int c = 0; c < 3; ++c)
            place[c] += breaks[k].area * (breaks[k].position[c] - centre[c]);
    }
    for (int c = 0; c < 3; ++c)
        if (!(is_disc && c == shape->axis)) square += place[c] * place[c] / (area * area);
    brc_outcome_add(outcome, "first_break_stress", "Pa", stress, NAN);
    brc_outcome_add(outcome, "first_break_from_centre", "m", sqrt(square), NAN);
    if (is_disc) brc_outcome_add(outcome, "first_break_from_rim", "m", shape->radius - sqrt(square), NAN);
}

/* A cylinder: how far from its side the first hundredth of all broken area lies, mean by area; a sliver of a face under
 * a line of contact does not count for more than its area. */
static void add_early(const brc_scene *scene, const brc_domain *domain, int64_t n, const brc_break *breaks,
                      double total, brc_outcome *outcome)
{
    const brc_shape *shape = &scene->bodies[0].shape;
    if (scene->n_bodies != 1 || shape->kind != BRC_SHAPE_CYLINDER) return;
    double centre[3], area = 0, sum = 0;
    centre_of(domain, centre);
    for (int64_t k = 0; k < n && area < early * total; ++k) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            if (c != (int)shape->axis)
                square += (breaks[k].position[c] - centre[c]) * (breaks[k].position[c] - centre[c]);
        area += breaks[k].area;
        sum += breaks[k].area * (shape->radius - sqrt(square));
    }
    brc_outcome_add(outcome, "first_hundredth_from_rim", "m", sum / area, NAN);
}

/* Volumes of the fragments: the largest, those below least_piece together, both over all, and how many are halves. */
typedef struct sizes {
    int64_t n_fragments, n_halves;
    double largest, crumbs;
} sizes;

/* volume: [n_elements], overwritten. */
static sizes sizes_of(const brc_domain *d, int64_t n_fragments, const int32_t *fragment, double *volume)
{
    sizes out = {.n_fragments = n_fragments};
    double all = 0;
    for (int64_t f = 0; f < n_fragments; ++f)
        volume[f] = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        volume[fragment[e]] += d->volume[e];
        all += d->volume[e];
    }
    for (int64_t f = 0; f < n_fragments; ++f) {
        out.largest = fmax(out.largest, volume[f] / all);
        if (volume[f] < least_piece * all) out.crumbs += volume[f] / all;
        out.n_halves += volume[f] >= least_half * all;
    }
    return out;
}

/* As the body was when it parted: at the first step after which no fragment had more than what a half leaves of it.
 * Fragments only grow smaller, so the step is found by halving. fragment, volume: [n_elements], overwritten. */
static brc_status add_parted(brc_context *context, const brc_domain *d, int64_t n, const brc_break *breaks,
                             int32_t *fragment, double *volume, brc_outcome *outcome)
{
    int64_t n_steps = 0, low = 0, high;
    sizes parted = {0};
    BRC_LOCAL(context, d->n_half_edges, uint8_t, whole, "fragments");
    BRC_LOCAL(context, n, int64_t, end, "fragments"); /* breaks up to the end of each step that has some */
    for (int64_t k = 1; k <= n; ++k)
        if (k == n || breaks[k].step != breaks[k - 1].step) end[n_steps++] = k;
    for (high = n_steps; low < high;) {
        const int64_t middle = low + (high - low) / 2;
        for (int64_t h = 0; h < d->n_half_edges; ++h)
            whole[h] = 1;
        for (int64_t k = 0; k < end[middle]; ++k)
            whole[d->bond_half_edge[breaks[k].bond]] = 0;
        const sizes now = sizes_of(d, brc_fragments_over(d, whole, fragment), fragment, volume);
        if (now.largest > 1 - least_half)
            low = middle + 1;
        else
            high = middle, parted = now;
    }
    if (parted.n_fragments == 0) return BRC_OK;
    brc_outcome_add(outcome, "halves_parted", "-", (double)parted.n_halves, NAN);
    brc_outcome_add(outcome, "crumbs_parted", "-", parted.crumbs, NAN);
    return BRC_OK;
}

brc_status brc_fracture_values(brc_context *context, brc_simulation *simulation, brc_outcome *outcome)
{
    const brc_domain *domain = brc_simulation_domain(simulation);
    static const char *const names[3] = {"plane_x", "plane_y", "plane_z"};
    const brc_break *breaks;
    brc_crack_statistics cracks;
    int32_t *fragment = NULL;
    double *volume = NULL;
    int64_t n, n_fragments;
    brc_status status = BRC_OK;
    BRC_TRY(brc_simulation_breaks(simulation, &n, &breaks));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &fragment, domain->n_elements, "fragments"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &volume, domain->n_elements, "fragments"));
    BRC_TRY_OR(cleanup, brc_simulation_fragments(simulation, fragment, &n_fragments));
    brc_crack_statistics_of(n, breaks, fragment, &cracks);
    const sizes last = sizes_of(domain, n_fragments, fragment, volume);
    brc_outcome_add(outcome, "broken", "-", (double)n, NAN);
    brc_outcome_add(outcome, "crack_area", "m^2", cracks.total_area, NAN);
    brc_outcome_add(outcome, "fragments", "-", (double)n_fragments, NAN);
    brc_outcome_add(outcome, "largest_fragment", "-", last.largest, NAN);
    brc_outcome_add(outcome, "halves", "-", (double)last.n_halves, NAN);
    brc_outcome_add(outcome, "crumbs", "-", last.crumbs, NAN);
    if (n == 0) goto cleanup;
    BRC_TRY_OR(cleanup, add_parted(context, domain, n, breaks, fragment, volume, outcome));
    add_first(brc_simulation_scene(simulation), domain, n, breaks, outcome);
    add_early(brc_simulation_scene(simulation), domain, n, breaks, cracks.total_area, outcome);
    for (int c = 0; c < 3; ++c)
        brc_outcome_add(outcome, names[c], "deg", brc_crack_angle(cracks.all.normal, c), NAN);
    brc_outcome_add(outcome, "plane_rough", "m", cracks.all.rough, NAN);
cleanup:
    brc_memory_free(fragment);
    brc_memory_free(volume);
    return status;
}
