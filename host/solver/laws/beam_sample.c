/* The elastic test of a bonded packing. The scene is made here: one material, one static stage of the linearised
 * operator. */
#include "beam_sample.h"
#include "../../../preprocess/packing/beams.h"
#include "../../../preprocess/packing/packing.h"
#include "../../../preprocess/cells/seeds.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "beam_body.h"
#include "../simulation.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

struct brc_beam_sample {
    brc_solid *solid;
    brc_packing packing;
};

brc_status brc_beam_sample_pack(brc_context *context, const brc_shape *shape, const brc_fill *fill, int n_threads,
                                brc_beam_sample **out)
{
    BRC_ENDS_WITH(brc_beam_sample_free) brc_beam_sample *sample = NULL;
    *out = NULL;
    if (fill->kind != BRC_FILL_PACKING)
        return BRC_FAIL(context, BRC_BAD_INPUT, "a sample of beams is packed; expected a fill of kind packing");
    BRC_TRY(brc_fill_check(context, fill));
    BRC_TRY(BRC_ALLOCATE(context, &sample, 1, "sample of beams"));
    BRC_TRY(brc_solid_create(context, shape, n_threads, &sample->solid));
    BRC_TRY(brc_packing_make(context, sample->solid, fill, n_threads, &sample->packing));
    *out = sample;
    sample = NULL;
    return BRC_OK;
}

void brc_beam_sample_free(brc_beam_sample **sample)
{
    if (!sample || !*sample) return;
    brc_packing_free(&(*sample)->packing);
    brc_solid_free(&(*sample)->solid);
    brc_memory_free(*sample);
    *sample = NULL;
}

brc_status brc_beam_sample_bond(brc_context *context, const brc_beam_sample *sample, double coordination, bool balanced,
                                int n_threads, brc_domain **out)
{
    const int64_t n = sample->packing.n;
    BRC_ENDS_WITH(brc_domain_free) brc_domain *domain = NULL;
    *out = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &domain, 1, "domain"));
    BRC_LOCAL(context, 3 * n, double, position, "spheres of a sample");
    BRC_LOCAL(context, n, double, radius, "spheres of a sample");
    memcpy(position, sample->packing.position, (size_t)(3 * n) * sizeof *position);
    memcpy(radius, sample->packing.radius, (size_t)n * sizeof *radius);
    BRC_TRY(brc_beams_build(context, sample->solid, position, radius, n, coordination, balanced, n_threads, domain));
    position = radius = NULL; /* the domain's now */
    BRC_TRY(BRC_ALLOCATE(context, &domain->region, n, "material regions"));
    BRC_TRY(BRC_ALLOCATE(context, &domain->body, n, "bodies"));
    domain->quality.coordination_mean = 2.0 * (double)domain->n_bonds / (double)n;
    domain->quality.volume_fraction = sample->packing.volume_fraction;
    brc_beams_fill(domain, sample->packing.volume_fraction);
    *out = domain;
    domain = NULL;
    return BRC_OK;
}

static const char *const walls[3][2] = {{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}};

/* Mean of one component of [n_elements][3] over the bonded members of a set. */
static double mean_of(const brc_domain *d, const brc_set *set, const double *values, int component)
{
    double sum = 0;
    int64_t n = 0;
    for (int64_t k = 0; k < set->n_members; ++k) {
        const int64_t e = set->members[k];
        if (d->row_start[e + 1] == d->row_start[e]) continue;
        sum += values[3 * e + component];
        ++n;
    }
    return sum / (double)n;
}

static bool has_bonded(const brc_domain *d, const brc_set *set)
{
    for (int64_t k = 0; k < set->n_members; ++k)
        if (d->row_start[set->members[k] + 1] > d->row_start[set->members[k]]) return true;
    return false;
}

static brc_status find_walls(brc_context *context, const brc_domain *d, int32_t set[3][2])
{
    for (int c = 0; c < 3; ++c)
        for (int side = 0; side < 2; ++side) {
            set[c][side] = brc_domain_find_set(d, walls[c][side]);
            if (set[c][side] < 0 || d->sets[set[c][side]].kind != BRC_SET_ELEMENTS)
                return BRC_FAIL(
                    context, BRC_BAD_INPUT,
                    "elastic sample test: the sample has no wall '%s'; expected spheres packed into one box",
                    walls[c][side]);
            if (!has_bonded(d, &d->sets[set[c][side]]))
                return BRC_FAIL(context, BRC_BAD_INPUT,
                                "elastic sample test: no bonded element touches the wall '%s'; use more elements or a "
                                "larger coordination number",
                                walls[c][side]);
        }
    return BRC_OK;
}

/* What the displacements and the force say. */
static void evaluate(const brc_domain *d, const int32_t set[3][2], int axis, const double *displacement, double force,
                     brc_beam_answer *out)
{
    double diameter = 0, edge[3], strain[3];
    for (int64_t e = 0; e < d->n_elements; ++e)
        diameter += 2 * d->radius[e] / (double)d->n_elements;
    for (int c = 0; c < 3; ++c) {
        const brc_set *low = &d->sets[set[c][0]], *high = &d->sets[set[c][1]];
        edge[c] = mean_of(d, high, d->position, c) - mean_of(d, low, d->position, c) + diameter;
        strain[c] = (mean_of(d, high, displacement, c) - mean_of(d, low, displacement, c)) / edge[c];
    }
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    out->young = force / (edge[y] * edge[z]) / strain[axis];
    out->lateral[0] = -strain[y] / strain[axis];
    out->lateral[1] = -strain[z] / strain[axis];
    out->poisson = (out->lateral[0] + out->lateral[1]) / 2;
}

/* Multigrid pays where solves take long: diagonal blocks want some 1.5 iterations a digit and element along an edge,
 * and its levels cost as much as 350 of those to make (bench/results/2026-11-26-2cores-calibrate.csv). Rigid parts
 * leave a third of them, for what ten cost (bench/results/2026-11-27-campaign.md). */
static brc_preconditioner_kind preconditioner_of(const brc_domain *domain, double tolerance)
{
    const double iterations = -1.5 * cbrt((double)domain->n_elements) * log10(tolerance);
    return iterations < 350 ? BRC_PRECONDITIONER_PARTS : BRC_PRECONDITIONER_AUTO;
}

/* The scene of a pull, and its simulation, which points into it. */
typedef struct brc_beam_test {
    brc_material material;
    brc_body body;
    brc_load loads[2];
    brc_stage stage;
    brc_scene scene;
    int32_t set[3][2]; /* of the walls */
    brc_simulation *simulation;
} brc_beam_test;

static void free_test(brc_beam_test **test)
{
    if (!*test) return;
    brc_simulation_free(&(*test)->simulation);
    brc_memory_free(*test);
    *test = NULL;
}

static void take_pull(brc_beam_test *t, const brc_domain *domain, const brc_beam_pull *pull)
{
    t->material.beam_radius = pull->radius;
    t->material.beam_young = pull->beam_young > 0 ? pull->beam_young : 1;
    t->scene.model.beam_poisson = pull->beam_poisson;
    t->stage.tolerance = pull->tolerance > 0 ? pull->tolerance : 1e-5;
    t->stage.preconditioner = preconditioner_of(domain, t->stage.tolerance);
}

static brc_status make_test(brc_context *context, brc_device *device, const brc_domain *domain,
                            const brc_beam_pull *pull, brc_beam_test **out)
{
    const double strain = 1e-6; /* the operator is linear: any strain gives the same ratios */
    const int axis = pull->axis;
    BRC_ENDS_WITH(free_test) brc_beam_test *t = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &t, 1, "elastic sample test"));
    BRC_TRY(find_walls(context, domain, t->set));
    t->material = (brc_material){.name = "unit", .young = 1, .poisson = 0.2, .density = 1};
    t->body = (brc_body){.name = "sample"};
    for (int side = 0; side < 2; ++side) {
        t->loads[side] = (brc_load){.kind = BRC_LOAD_ELEMENT_DISPLACEMENT};
        snprintf(t->loads[side].set, sizeof t->loads[side].set, "%s", walls[axis][side]);
        t->loads[side].component[axis] = true;
        t->loads[side].value[axis] = (side ? 0.5 : -0.5) * strain * (domain->bounds[1][axis] - domain->bounds[0][axis]);
    }
    t->stage =
        (brc_stage){.name = "pull", .solver = BRC_SOLVER_STATIC, .n_loads = 2, .loads = t->loads, .increments = 1};
    t->scene = (brc_scene){.version = 1,
                           .folder = ".",
                           .n_materials = 1,
                           .materials = &t->material,
                           .model = {.kind = brc_model_of_beams(), .keep_isolated = true},
                           .n_bodies = 1,
                           .bodies = &t->body,
                           .n_stages = 1,
                           .stages = &t->stage,
                           .output = {.n_frames = -1}};
    take_pull(t, domain, pull);
    BRC_TRY(brc_simulation_create(context, &t->scene, domain, device, &t->simulation));
    *out = t;
    t = NULL;
    return BRC_OK;
}

void brc_beam_states_free(brc_beam_states *states)
{
    for (int32_t k = 0; k < states->n; ++k)
        brc_memory_free(states->state[k]);
    free_test(&states->test);
    *states = (brc_beam_states){0};
}

static brc_status keep_state(brc_context *context, brc_simulation *simulation, brc_beam_states *states)
{
    double *newest = states->n == BRC_BEAM_STATES ? states->state[--states->n] : NULL;
    if (!newest)
        BRC_TRY(
            BRC_ALLOCATE(context, &newest, 6 * brc_simulation_domain(simulation)->n_elements, "states of a sample"));
    memmove(states->state + 1, states->state, (size_t)states->n++ * sizeof *states->state);
    states->state[0] = newest;
    return brc_simulation_static_state(simulation, newest);
}

brc_status brc_beam_sample_pull(brc_context *context, brc_device *device, const brc_domain *domain,
                                const brc_beam_pull *pull, brc_beam_answer *out)
{
    const double start = brc_clock_s();
    double reaction[3];
    BRC_ENDS_WITH(brc_beam_states_free) brc_beam_states own = {0};
    brc_beam_states *states = pull->states ? pull->states : &own;
    memset(out, 0, sizeof *out);
    if (domain->element_kind != BRC_ELEMENT_SPHERE)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "elastic sample test: the sample is made of cells; expected spheres joined by beams");
    BRC_LOCAL(context, 3 * domain->n_elements, double, displacement, "displacements");
    if (!states->test) {
        BRC_TRY(make_test(context, device, domain, pull, &states->test));
    } else {
        take_pull(states->test, domain, pull);
        BRC_TRY(brc_simulation_renew(states->test->simulation));
    }
    const brc_beam_test *t = states->test;
    brc_simulation_know_states(t->simulation, states->n, (const double *const *)states->state);
    BRC_TRY(brc_simulation_run(t->simulation));
    BRC_TRY(brc_simulation_displacement(t->simulation, displacement));
    BRC_TRY(brc_simulation_reaction(t->simulation, t->set[pull->axis][1], reaction));
    evaluate(domain, t->set, pull->axis, displacement, reaction[pull->axis] / t->material.beam_young, out);
    brc_beam_body bonds;
    BRC_TRY(brc_beam_body_of(context, domain, -1, &bonds));
    out->inner = bonds.inner;
    out->n_bonds = domain->n_bonds;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        out->n_loose += domain->row_start[e + 1] == domain->row_start[e];
    out->iterations = brc_simulation_static_report(t->simulation).iterations;
    if (pull->states) BRC_TRY(keep_state(context, t->simulation, states));
    out->seconds = brc_clock_s() - start;
    return BRC_OK;
}
