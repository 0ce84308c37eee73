/* The state of a simulation, number by number, for a store (state_store.h): the clock and the arrays of the elements.
 * Effects hook in behind them. */
#include "run_internal.h"
#include "../core/state_store.h"
#include <stdio.h>
#include <string.h>

/* Words, and lists whose length is part of the state. */
static brc_status walk_notes(brc_simulation *s, brc_state_store *store)
{
    brc_time_step *dt = &s->run->time_step;
    char name[64];
    if (!store->loading && dt->governed_by != s->run->governed_by)
        snprintf(s->run->governed_by, sizeof s->run->governed_by, "%s", dt->governed_by ? dt->governed_by : "");
    BRC_TRY(brc_store_text(store, "time_step.governed_by", s->run->governed_by, sizeof s->run->governed_by));
    if (store->loading) dt->governed_by = s->run->governed_by[0] ? s->run->governed_by : NULL;
    for (int32_t i = 0; i < s->scene->n_stages; ++i) {
        snprintf(name, sizeof name, "stage.%d.ended", (int)i);
        BRC_TRY(brc_store_flag(store, name, &s->run->note[i].ended));
        snprintf(name, sizeof name, "stage.%d.reason", (int)i);
        BRC_TRY(brc_store_text(store, name, s->run->note[i].reason, sizeof s->run->note[i].reason));
    }
    return brc_statics_store(s, store);
}

/* ---- the whole ---- */

/* All but the stage itself, whose loads are there. */
static brc_status walk(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(brc_store_clock(s, store));
    BRC_TRY(walk_notes(s, store));
    BRC_TRY(brc_store_elements(s, store));
    return brc_hook_run(s, BRC_HOOK_STORE, &(brc_occasion){.store = store});
}

brc_status brc_simulation_save_state(brc_simulation *s, brc_state_store *store)
{
    if (s->run->stage < 0) return BRC_FAIL(s->context, BRC_INTERNAL, "the state of a simulation that is in no stage");
    BRC_TRY(brc_store_index(store, "stage", &s->run->stage));
    BRC_TRY(walk(s, store));
    return brc_statics_store_stage(s, store);
}

brc_status brc_simulation_load_state(brc_simulation *s, brc_state_store *store)
{
    const double start = brc_clock_s();
    int32_t stage;
    BRC_TRY(brc_store_index(store, "stage", &stage));
    if (stage < 0 || stage >= s->scene->n_stages || s->run->stage >= 0)
        return BRC_FAIL(s->context, BRC_BAD_INPUT, "a state of stage %d cannot be taken up by a scene of %d stages",
                        (int)stage, (int)s->scene->n_stages);
    BRC_TRY(brc_hook_run(s, BRC_HOOK_ENTER, &(brc_occasion){.stage = &s->scene->stages[stage]}));
    s->run->stage = stage;
    brc_force_take_law(s, &s->scene->stages[stage]);
    BRC_TRY(walk(s, store));
    BRC_TRY(brc_force_of_state(
        s, BRC_BOOK_NOTHING)); /* what only it makes; what it makes otherwise than the last step did is filled again */
    BRC_TRY(walk(s, store));
    s->run->setup_seconds += brc_clock_s() - start;
    return BRC_OK;
}
