/* Mass damping: a drag in proportion to momentum. */
#include "../core/solver.h"
#include "effect.h"
#include <math.h>

extern const brc_effect brc_mass_damping_effect;

static bool in(const brc_wants *w)
{
    for (int32_t i = 0; i < w->scene->n_stages; ++i)
        if (w->scene->stages[i].solver == BRC_SOLVER_DYNAMIC && w->scene->stages[i].mass_damping > 0) return true;
    return false;
}

static void ask(brc_wants *w, const int32_t *material)
{
    (void)material;
    w->damping |= in(w);
}

static brc_status create(brc_simulation *s)
{
    const brc_scope run = brc_scope_of_run(s), books = brc_scope_of_damping(s, &run);
    return BRC_PASSES(s, &books,
                      {(brc_pass **)brc_effect_own(s, &brc_mass_damping_effect), "damp_mass", "factor", false});
}

static bool due(const brc_simulation *s)
{
    return brc_current_stage(s)->mass_damping > 0;
}

/* Of what is free to move: prescribed velocities are set anew at the end of the step, and what drags on them is no part
 * of the work of their load. */
static brc_status drag(brc_simulation *s, const brc_occasion *now)
{
    const double factor = exp(-brc_current_stage(s)->mass_damping * now->dt);
    BRC_TRY(brc_constrain(s, brc_velocity_of(s), NULL));
    return BRC_RUN(*brc_effect_own(s, &brc_mass_damping_effect), s->layout->n_rows, {"factor", BRC_STATE(factor)});
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_DRAG, .call = drag, .due = due}};
const brc_effect brc_mass_damping_effect = {
    .name = "mass damping", .in = in, .ask = ask, .create = create, BRC_HOOKED(hooked)};
