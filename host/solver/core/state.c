/* Reading and writing the state from outside, in the order of element ids. */
#include "core_internal.h"
#include <math.h>
#include <string.h>

BRC_READ(const brc_scene *, brc_simulation_scene, s->scene)
BRC_READ(const brc_domain *, brc_simulation_domain, s->domain)
BRC_READ(const brc_device *, brc_simulation_device, s->device)
double brc_simulation_phase_seconds(const brc_simulation *s, brc_step_phase phase)
{
    return phase == BRC_PHASE_NONE ? 0 : s->core->watch.seconds[phase];
}
BRC_READ(const char *const *, brc_simulation_effects_in, s->core->effects_in)
BRC_READ(const char *const *, brc_simulation_effects_out, s->core->effects_out)

brc_status brc_simulation_displacement(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->core->displacement, out, 3);
}
brc_status brc_simulation_velocity(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->core->velocity, out, 3);
}
brc_status brc_simulation_force(brc_simulation *s, double *out)
{
    return brc_state_from_rows(s, s->core->force, out, 3);
}

brc_status brc_simulation_set_state(brc_simulation *s, const double *displacement, const double *velocity)
{
    if (displacement) BRC_TRY(brc_state_to_rows(s, s->core->displacement, displacement, 3, 0));
    if (velocity) BRC_TRY(brc_state_to_rows(s, s->core->velocity, velocity, 3, 0));
    BRC_TRY(brc_force_refresh(s));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_RESTART, NULL));
    return brc_force_of_state(s, BRC_BOOK_START);
}

brc_status brc_simulation_orientation(brc_simulation *s, double *orientation, double *spin)
{
    if (!s->model->turns)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "model dlsm has no orientations of its own; ask for strains instead");
    BRC_TRY(brc_state_from_rows(s, s->core->orientation, orientation, 4));
    return spin ? brc_state_from_rows(s, s->core->spin, spin, 3) : BRC_OK;
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
