/* Reading and writing the state from outside, in the order of element ids. */
#include "simulation_internal.h"
#include <math.h>
#include <string.h>

const brc_scene *brc_simulation_scene(const brc_simulation *s)
{
    return s->scene;
}
const brc_domain *brc_simulation_domain(const brc_simulation *s)
{
    return s->domain;
}
const brc_device *brc_simulation_device(const brc_simulation *s)
{
    return s->device;
}
int32_t brc_simulation_stage(const brc_simulation *s)
{
    return s->stage;
}
int64_t brc_simulation_step(const brc_simulation *s)
{
    return s->step;
}
int64_t brc_simulation_total_steps(const brc_simulation *s)
{
    return s->total_steps;
}
double brc_simulation_setup_seconds(const brc_simulation *s)
{
    return s->setup_seconds;
}
double brc_simulation_step_seconds(const brc_simulation *s)
{
    return s->step_seconds;
}
double brc_simulation_phase_seconds(const brc_simulation *s, brc_step_phase phase)
{
    return phase == BRC_PHASE_NONE ? 0 : s->watch.seconds[phase];
}
brc_time_step brc_simulation_time_step(const brc_simulation *s)
{
    return s->time_step;
}
brc_static_report brc_simulation_static_report(const brc_simulation *s)
{
    return s->static_report;
}
const char *const *brc_simulation_effects_in(const brc_simulation *s)
{
    return s->effects_in;
}
const char *const *brc_simulation_effects_out(const brc_simulation *s)
{
    return s->effects_out;
}

double brc_simulation_time(const brc_simulation *s)
{
    return s->stage >= 0 && brc_current_stage(s)->solver != BRC_SOLVER_DYNAMIC ? s->load_factor : s->time;
}

double brc_simulation_total_time(const brc_simulation *s)
{
    return s->total_time_before + s->time;
}

const double *brc_simulation_modes(const brc_simulation *s, int32_t *n)
{
    *n = s->n_modes;
    return s->modes;
}

brc_status brc_simulation_displacement(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->displacement, out, 3);
}
brc_status brc_simulation_velocity(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->velocity, out, 3);
}
brc_status brc_simulation_force(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->force, out, 3);
}

brc_status brc_simulation_set_state(brc_simulation *s, const double *displacement, const double *velocity)
{
    if (displacement) BRC_TRY(brc_state_to_rows(s, s->displacement, displacement, 3, 0));
    if (velocity) BRC_TRY(brc_state_to_rows(s, s->velocity, velocity, 3, 0));
    BRC_TRY(brc_force_refresh(s));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_RESTART, NULL));
    return brc_force_of_state(s, BRC_BOOK_START);
}

brc_status brc_simulation_orientation(brc_simulation *s, double *orientation, double *spin)
{
    if (!s->model->turns)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "model dlsm has no orientations of its own; ask for strains instead");
    BRC_TRY(brc_state_from_rows(s, s->orientation, orientation, 4));
    return spin ? brc_state_from_rows(s, s->spin, spin, 3) : BRC_OK;
}

brc_status brc_simulation_virial_stress(brc_simulation *s, int level, double *stress)
{
    if (!s->model->virial_stress || level < 0 || level > 2)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "virial stress of level %d in model %s: expected level 0, 1 or 2 and model cbm", level,
                        brc_model_name(s->scene->model.kind));
    return s->model->virial_stress(s, level, stress);
}

brc_status brc_simulation_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    return s->model->strain_stress(s, strain, stress, cauchy);
}

brc_status brc_simulation_face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    return n == 0 ? BRC_OK : s->model->face_displacement(s, n, faces, out);
}
