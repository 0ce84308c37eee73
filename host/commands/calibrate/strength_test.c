#include "strength_test.h"
#include "../../base/log.h"
#include "../../output/sensors/sphere_box.h"
#include "../../solver/laws/beam_law.h"
#include "../../solver/effects/fracture/fracture.h"
#include "../../solver/laws/strength_law.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double START = 0.8;    /* of the first failure, which comes at 0.75 to 0.9 of the peak */
static const double END = 0.8;      /* of the peak: the crack has found its place; below it nothing rises again */
static const double LONGEST = 3;    /* times the expected strain */
static const double DENSITY = 2500; /* sets the unit of time, nothing else */
static const int EVERY = 5;         /* steps between two looks at the load: a passage of a wave takes 40 to 90 */

static const char *const walls[3][2] = {{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}};

/* A test at work. */
typedef struct test {
    const brc_strength_pull *pull;
    int32_t wall;         /* set of the wall "<axis>+" */
    double section, rate; /* [m^2], strain rate [1/s] */
    double length;        /* of the shape along the axis [m] */
    double expected;      /* strain [-] */
    double strain;        /* that the loads of the static stage give before they are scaled [-] */
    double start;         /* strain at the end of the static stage [-] */
    bool over;            /* the peak was passed */
    brc_strength_answer *out;
} test;

static brc_status load_over_limit(const test *t, brc_simulation *simulation, double *out)
{
    double force[3];
    BRC_TRY(brc_simulation_reaction(simulation, t->wall, force));
    *out = force[t->pull->axis] / t->section / t->pull->limit;
    return BRC_OK;
}

/* The static stage is linear: what it carries, and by how much that may grow until the first failure. */
static brc_status after_static(test *t, brc_simulation *simulation)
{
    double ratio, load;
    BRC_TRY(brc_simulation_failure_ratio(simulation, &ratio));
    BRC_TRY(load_over_limit(t, simulation, &load));
    t->out->first = load / ratio;
    t->start = brc_simulation_time(simulation) * t->strain; /* the time of a static stage is the factor on its load */
    return BRC_OK;
}

/* The dynamic stage, step by step instead of to its end. */
static brc_status pull_apart(test *t, brc_simulation *simulation)
{
    const double dt = brc_simulation_time_step(simulation).value;
    const int64_t most = (int64_t)(LONGEST * t->expected / (t->rate * dt));
    while (brc_simulation_step(simulation) < most) {
        double load;
        BRC_TRY(brc_simulation_advance(simulation, EVERY));
        BRC_TRY(load_over_limit(t, simulation, &load));
        if (load > t->out->ratio) {
            t->out->ratio = load;
            t->out->strain = t->start + t->rate * brc_simulation_time(simulation);
        }
        t->over = load < END * t->out->ratio;
        if (t->over || !isfinite(load)) break;
    }
    t->out->n_steps = brc_simulation_step(simulation);
    return brc_simulation_broken(simulation, &t->out->n_broken);
}

static brc_status stage_begin(void *self, brc_simulation *simulation, int32_t stage)
{
    if (stage == 0) return BRC_OK;
    BRC_TRY(pull_apart(self, simulation));
    return BRC_INTERRUPTED; /* the stage is over; brc_strength_test tells this end from a true one by `over` */
}

static brc_status stage_end(void *self, brc_simulation *simulation, int32_t stage)
{
    return stage == 0 ? after_static(self, simulation) : BRC_OK;
}

/* The scene of a sample that is pulled, and what its parts point to. */
typedef struct pulled {
    brc_material material;
    brc_body body;
    brc_load strains[2], speeds[2];
    brc_initial initial;
    brc_stage stages[2];
    brc_scene scene;
} pulled;

static void pull_walls(const test *t, const brc_domain *domain, double nu, pulled *p)
{
    const int axis = t->pull->axis;
    for (int side = 0; side < 2; ++side) {
        p->strains[side].kind = BRC_LOAD_ELEMENT_DISPLACEMENT;
        p->speeds[side].kind = BRC_LOAD_ELEMENT_VELOCITY;
        snprintf(p->strains[side].set, sizeof p->strains[side].set, "%s", walls[axis][side]);
        snprintf(p->speeds[side].set, sizeof p->speeds[side].set, "%s", walls[axis][side]);
        p->strains[side].component[axis] = p->speeds[side].component[axis] = true;
        p->strains[side].value[axis] = (side ? 0.5 : -0.5) * t->strain * t->length;
        p->speeds[side].value[axis] = (side ? 0.5 : -0.5) * t->rate * t->length;
    }
    p->initial.kind = BRC_INITIAL_VELOCITY;
    for (int c = 0; c < 3; ++c) {
        p->initial.gradient[c][c] = c == axis ? t->rate : -nu * t->rate;
        p->initial.origin[c] = (domain->bounds[0][c] + domain->bounds[1][c]) / 2;
    }
}

/* Strained to half the expected strength at rest, then pulled. */
static void describe(const test *t, const brc_domain *domain, double young, double nu, pulled *p)
{
    const brc_strength_pull *pull = t->pull;
    *p = (pulled){
        .material = {.name = "unit",
                     .young = young,
                     .poisson = nu,
                     .density = DENSITY,
                     .beam_radius = pull->radius,
                     .beam_young = pull->beam_young,
                     .beam_strength = pull->limit},
        .body = {.name = "sample"},
        .stages = {{.name = "load",
                    .solver = BRC_SOLVER_STATIC,
                    .n_loads = 2,
                    .loads = p->strains,
                    .tolerance = 1e-6,
                    .increments = 1,
                    .to_failure = START},
                   {.name = "pull",
                    .solver = BRC_SOLVER_DYNAMIC,
                    .n_loads = 2,
                    .loads = p->speeds,
                    .n_initials = 1,
                    .initials = &p->initial,
                    .phi = 1,
                    .safety = 0.8,
                    .duration = LONGEST * t->expected / t->rate}},
        .scene = {.version = 1,
                  .folder = ".",
                  .n_materials = 1,
                  .materials = &p->material,
                  .model = {.kind = brc_model_of_beams(), .beam_poisson = pull->beam_poisson, .keep_isolated = true},
                  .has_fracture = true,
                  .fracture = {.kind = BRC_CRITERION_PRINCIPAL, .level = 1},
                  .n_bodies = 1,
                  .bodies = &p->body,
                  .n_stages = 2,
                  .stages = p->stages,
                  .output = {.n_frames = -1}}};
    pull_walls(t, domain, nu, p);
}

brc_status brc_strength_test(brc_context *context, brc_device *device, const brc_domain *domain,
                             const brc_strength_pull *pull, brc_strength_answer *out)
{
    const double begun = brc_clock_s();
    const int axis = pull->axis;
    const double coordination = domain->quality.coordination_mean;
    const brc_beam_law *elastic = brc_beam_law_for(pull->radius_spread);
    const double young = pull->beam_young * brc_beam_law_young(elastic, coordination, pull->radius);
    const double nu = brc_beam_law_poisson(elastic, coordination, pull->radius);
    test t = {.pull = pull,
              .out = out,
              .wall = brc_domain_find_set(domain, walls[axis][1]),
              .length = domain->bounds[1][axis] - domain->bounds[0][axis]};
    brc_simulation *simulation = NULL;
    brc_status status = BRC_OK;
    pulled p;
    memset(out, 0, sizeof *out);
    t.section = brc_sphere_box_section(domain, t.wall);
    if (!(t.section > 0))
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "fracture test: the sample has no wall '%s' or no walls beside it; expected spheres packed into one box",
            walls[axis][1]);
    t.expected = brc_strength_law_ratio(brc_strength_law_published(), coordination, pull->radius) * pull->limit / young;
    t.rate = t.expected * sqrt(young / DENSITY) / (pull->passages * t.length);
    t.strain = 0.5 * t.expected; /* the solver scales it */
    describe(&t, domain, young, nu, &p);
    BRC_TRY_OR(cleanup, brc_simulation_create(context, &p.scene, domain, device, &simulation));
    BRC_TRY_OR(cleanup,
               brc_simulation_observe(simulation,
                                      &(brc_observer){.self = &t, .stage_begin = stage_begin, .stage_end = stage_end}));
    status = brc_simulation_run(simulation);
    if (status == BRC_INTERRUPTED && t.over)
        status = BRC_OK;
    else if (status == BRC_INTERRUPTED)
        status = BRC_FAIL(context, BRC_PHYSICS_STOPPED,
                          "fracture test: the load did not fall from its peak within %g times the expected strain %.4g "
                          "(cn %.4g, r_m %.4g)",
                          LONGEST, t.expected, coordination, pull->radius);
    out->n_bonds = domain->n_bonds;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        out->n_loose += domain->row_start[e + 1] == domain->row_start[e];
    out->seconds = brc_clock_s() - begun;
cleanup:
    brc_simulation_free(&simulation);
    return status;
}
