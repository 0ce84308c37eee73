/* Kicks and drifts of elements, and of bodies that effects move. */
#include "motion.h"
#include "run_internal.h"

brc_status brc_motion_turn(brc_simulation *s, const brc_occasion *now)
{
    BRC_TRY(brc_hook_run(s, BRC_HOOK_ADVANCE, now));
    if (!s->model->turns) return BRC_OK;
    return BRC_RUN(s->run->pass.advance_rotation, s->layout->n_rows, {"kick", BRC_STATE(now->kick)},
                   {"drift", BRC_STATE(now->drift)}, {"extra", BRC_STATE(now->extra * now->drift)});
}

brc_status brc_motion(brc_simulation *s, double kick, double drift)
{
    BRC_TRY(BRC_RUN(s->run->pass.advance, s->layout->n_rows, {"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(drift)}));
    return brc_motion_turn(s, &(brc_occasion){.kick = kick, .drift = drift});
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
    const int32_t n = s->layout->n_rows;
    if (kick == 0) return BRC_OK;
    BRC_TRY(BRC_RUN(s->run->pass.advance, n, {"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(0)}));
    if (!s->model->turns) return BRC_OK;
    return BRC_RUN(s->run->pass.advance_rotation, n, {"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(0)},
                   {"extra", BRC_STATE(0)});
}

brc_status brc_run_passes_make(brc_simulation *s)
{
    brc_run_passes *p = &s->run->pass;
    const bool turns = s->model->turns;
    const brc_scope run = brc_scope_of_run(s), sums = brc_scope_of_sums(s, &run);
    const brc_pass_wanted of_state[] = {
        {&p->advance, "advance", "kick drift", false},
        {&p->advance_rotation, "advance_rotation", "kick drift extra", !turns},
        {&p->divide_by_mass, "divide_by_mass", "mass vector", false},
        {&p->advance_tchamwa, "advance_tchamwa", "dt phi lost", false},
        {&p->numerical_close, "numerical_close", "lost", false},
    };
    BRC_TRY(BRC_PASSES_MAKE(s, &run, of_state));
    const brc_pass_wanted of_sums[] = {{&p->kinetic_energy, "kinetic_energy", "velocity", false},
                                       {&p->add_spin_energy, "add_spin_energy", "spin", !turns}};
    return BRC_PASSES_MAKE(s, &sums, of_sums);
}
