/* Kicks and drifts of elements, and of bodies that effects move. */
#include "motion.h"

brc_status brc_motion_turn(brc_simulation *s, const brc_occasion *now)
{
    BRC_TRY(brc_hook_run(s, BRC_HOOK_ADVANCE, now));
    if (!s->model->turns) return BRC_OK;
    return BRC_RUN(s->pass.advance_rotation, s->layout->n_rows, {"kick", BRC_STATE(now->kick)},
                   {"drift", BRC_STATE(now->drift)}, {"extra", BRC_STATE(now->extra * now->drift)});
}

brc_status brc_motion(brc_simulation *s, double kick, double drift)
{
    BRC_TRY(BRC_RUN(s->pass.advance, s->layout->n_rows, {"kick", BRC_STATE(kick)}, {"drift", BRC_STATE(drift)}));
    return brc_motion_turn(s, &(brc_occasion){.kick = kick, .drift = drift});
}

brc_status brc_dynamics_close(brc_simulation *s)
{
    if (!s->open) return BRC_OK;
    BRC_TRY(brc_motion(s, 0.5 * s->time_step.value, 0));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_CLOSE, &(brc_occasion){.t = s->time}));
    s->open = false;
    return BRC_OK;
}
