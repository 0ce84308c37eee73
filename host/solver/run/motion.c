/* Kicks and drifts of elements, and of bodies that effects move. */
#include "motion.h"
#include "../core/awake.h"
#include "run_internal.h"
#include <math.h>

/* The least that sets in motion what is at rest: so small a share of an element's size, or of a radian, in a step. Of a
 * strain of 1e-8 it is a rounding (docs/notebook/theory.md T5). */
static const double least_way = 0x1p-80;

double brc_motion_least_spin(const brc_simulation *s)
{
    const double dt = s->run->time_step.value;
    return dt > 0 ? least_way / dt : 0;
}

/* In the box of the domain, so that every rank knows it. */
double brc_motion_least_velocity(const brc_simulation *s)
{
    double volume = 1;
    for (int c = 0; c < 3; ++c)
        volume *= s->domain->bounds[1][c] - s->domain->bounds[0][c];
    return brc_motion_least_spin(s) * cbrt(volume / (double)s->domain->n_elements);
}

static brc_status advance(brc_simulation *s, double kick, double drift)
{
    return brc_pass_run_awake(s, s->run->pass.advance, s->layout->n_rows, NULL,
                              BRC_GIVEN({"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(drift)},
                                        {"still", BRC_STATE(brc_motion_least_velocity(s))}));
}

static brc_status advance_rotation(brc_simulation *s, double kick, double drift, double extra)
{
    return brc_pass_run_awake(s, s->run->pass.advance_rotation, s->layout->n_rows, NULL,
                              BRC_GIVEN({"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(drift)},
                                        {"extra", BRC_STATE(extra)}, {"still", BRC_STATE(brc_motion_least_spin(s))}));
}

brc_status brc_motion_turn(brc_simulation *s, const brc_occasion *now)
{
    BRC_TRY(brc_hook_run(s, BRC_HOOK_ADVANCE, now));
    if (!s->model->turns) return BRC_OK;
    return advance_rotation(s, now->kick, now->drift, now->extra * now->drift);
}

brc_status brc_motion(brc_simulation *s, double kick, double drift)
{
    const bool outer = brc_awake_only(s, true);
    BRC_TRY(advance(s, kick, drift));
    const brc_status status = brc_motion_turn(s, &(brc_occasion){.kick = kick, .drift = drift});
    brc_awake_only(s, outer);
    return status;
}

brc_status brc_motion_tchamwa(brc_simulation *s, double phi, double dt)
{
    const bool outer = brc_awake_only(s, true);
    BRC_TRY(brc_pass_run_awake(s, s->run->pass.advance_tchamwa, s->layout->n_rows, NULL,
                               BRC_GIVEN({"dt", BRC_STATE(dt)}, {"phi", BRC_STATE(phi)},
                                         {"still", BRC_STATE(brc_motion_least_velocity(s))},
                                         {"lost", BRC_BUF(brc_lost_numerical_of(s))})));
    /* turn = dt w_old + phi dt^2 a = dt w_new + (phi - 1) dt^2 a */
    const brc_status status =
        brc_motion_turn(s, &(brc_occasion){.kick = dt, .drift = dt, .extra = (phi - 1) * dt, .numerical = true});
    brc_awake_only(s, outer);
    return status;
}

brc_status brc_dynamics_close(brc_simulation *s)
{
    if (!s->run->open) return BRC_OK;
    BRC_TRY(brc_motion(s, 0.5 * s->run->time_step.value, 0));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_CLOSE, &(brc_occasion){.t = s->run->time}));
    s->run->open = false;
    return BRC_OK;
}

brc_status brc_elements_kick(brc_simulation *s, double kick)
{
    if (kick == 0) return BRC_OK;
    BRC_TRY(advance(s, kick, 0));
    return s->model->turns ? advance_rotation(s, kick, 0, 0) : BRC_OK;
}

brc_status brc_run_passes_make(brc_simulation *s)
{
    brc_run_passes *p = &s->run->pass;
    const bool turns = s->model->turns;
    const brc_scope run = brc_scope_of_run(s), sums = brc_scope_of_sums(s, &run);
    const brc_pass_wanted of_state[] = {
        {&p->advance, "advance", "kick drift still", false},
        {&p->advance_rotation, "advance_rotation", "kick drift extra still", !turns},
        {&p->divide_by_mass, "divide_by_mass", "mass vector", false},
        {&p->advance_tchamwa, "advance_tchamwa", "dt phi still lost", false},
        {&p->numerical_close, "numerical_close", "lost", false},
    };
    BRC_TRY(BRC_PASSES_MAKE(s, &run, of_state));
    const brc_pass_wanted of_sums[] = {{&p->kinetic_energy, "kinetic_energy", "velocity", false},
                                       {&p->add_spin_energy, "add_spin_energy", "spin", !turns}};
    return BRC_PASSES_MAKE(s, &sums, of_sums);
}
