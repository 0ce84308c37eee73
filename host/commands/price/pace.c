/* What a step of dynamics costs. */
#include "pace.h"
#include "../../base/log.h"
#include <math.h>
#include <string.h>

#define SAMPLE_S 0.1

bool brc_pace_is_processor(const brc_device_request *device)
{
    return device->n_threads == 1 && strcmp(device->selector, "cpu") == 0;
}

double brc_pace_clock_s(const brc_device_request *device)
{
    return brc_pace_is_processor(device) ? brc_processor_s() : brc_clock_s();
}

double brc_pace_start_s(const brc_device_request *device)
{
    return brc_pace_is_processor(device) ? 0 : brc_clock_s() - brc_processor_s();
}

const char *brc_pace_clock_name(const brc_device_request *device)
{
    return brc_pace_is_processor(device) ? "processor" : "wall";
}

/* Time of a step, from steps that together take long enough to be timed. */
static brc_status time_steps(brc_simulation *simulation, const brc_device_request *device, double *seconds)
{
    double elapsed = 0;
    BRC_TRY(brc_simulation_begin_stage(simulation, 0));
    BRC_TRY(brc_simulation_advance(simulation, 2)); /* kernels are built, pages touched */
    BRC_TRY(brc_simulation_wait(simulation));
    for (int64_t n = 1; elapsed < SAMPLE_S; n *= 2) {
        const double start = brc_pace_clock_s(device);
        BRC_TRY(brc_simulation_advance(simulation, n));
        BRC_TRY(brc_simulation_wait(simulation));
        elapsed = brc_pace_clock_s(device) - start;
        *seconds = elapsed / (double)n;
    }
    return BRC_OK;
}

brc_status brc_pace_values(brc_context *context, brc_simulation *simulation, const brc_device_request *device,
                           brc_outcome *outcome)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_domain *domain = brc_simulation_domain(simulation);
    const brc_stage *last = &scene->stages[scene->n_stages - 1];
    const brc_material *material = &scene->materials[0];
    const double speed = sqrt(material->young * (1 - material->poisson) /
                              ((1 + material->poisson) * (1 - 2 * material->poisson) * material->density));
    double longest = 0, seconds = 0;
    for (int d = 0; d < 3; ++d)
        longest = fmax(longest, domain->bounds[1][d] - domain->bounds[0][d]);
    /* Shaken a little, so that no number is zero. */
    brc_initial shaken = {.kind = BRC_INITIAL_RANDOM, .value = {1e-9 * speed, 1e-9 * speed, 1e-9 * speed}, .seed = 1};
    brc_stage stage = {.name = "price",
                       .solver = BRC_SOLVER_DYNAMIC,
                       .n_initials = 1,
                       .initials = &shaken,
                       .steps = INT64_C(1) << 40,
                       .safety = 0.8};
    if (last->solver == BRC_SOLVER_DYNAMIC) {
        stage.integrator = last->integrator;
        stage.phi = last->phi;
        stage.time_step_rule = last->time_step_rule;
        stage.time_step = last->time_step;
        stage.safety = last->safety;
    }
    brc_scene priced = *scene;
    priced.n_stages = 1;
    priced.stages = &stage;
    priced.n_sensors = priced.n_measures = 0;
    brc_simulation *steps = NULL;
    brc_device *own = NULL;
    brc_device_request request = *device;
    request.many_materials = brc_simulation_needs_many_materials(scene, domain);
    brc_status status = brc_device_open(context, &request, &own);
    if (status != BRC_OK) return status;
    BRC_TRY_OR(cleanup, brc_simulation_create(context, &priced, domain, own, &steps));
    BRC_TRY_OR(cleanup, time_steps(steps, device, &seconds));
    brc_outcome_add(outcome, "pace_bond_update", "s", seconds / (double)domain->n_bonds, NAN);
    brc_outcome_add(outcome, "pace_step", "s", brc_simulation_time_step(steps).value, NAN);
    brc_outcome_add(outcome, "pace_crossing", "s", longest / speed, NAN);
    brc_outcome_add(outcome, "pace_spacing", "-", domain->quality.mean_spacing / longest, NAN);
cleanup:
    brc_simulation_free(&steps);
    brc_device_close(&own);
    return status;
}
