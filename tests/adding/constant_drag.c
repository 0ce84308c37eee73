/* Constant drag: every element that moves loses the same speed in the same time, whatever its mass, until it rests. */
#include "../core/solver.h"
#include "../core/state_store.h"

typedef struct drag {
    brc_pass *slow;
    brc_buffer *lost;
} drag;

extern const brc_effect brc_constant_drag_effect;

static bool in(const brc_wants *w)
{
    for (int32_t i = 0; i < w->scene->n_stages; ++i)
        if (w->scene->stages[i].constant_drag > 0) return true;
    return false;
}

static const brc_field_row rows[] = {{"lost", brc_each_row, 1, BRC_FIELD_STATE, NULL, BRC_FIELD_AT(drag, lost),
                                      "lost by constant drag", "J", BRC_KEPT("constant_drag.lost", BRC_KEEP_ALL)}};
static BRC_FIELD_TABLE(fields, "constant drag", BRC_LIFE_RUN, in, rows);

static drag *own_of(brc_simulation *s)
{
    return *brc_effect_own(s, &brc_constant_drag_effect);
}

static brc_status create(brc_simulation *s)
{
    BRC_TRY(brc_memory_allocate(s->context, brc_effect_own(s, &brc_constant_drag_effect), 1, sizeof(drag), "drag"));
    drag *own = own_of(s);
    const brc_scope run = brc_scope_of_run(s),
                    scope = {.owner = "constant drag", .base = own, .tables = {&fields}, .outer = &run};
    BRC_TRY(BRC_PASSES(s, &scope, {&own->slow, "constant_drag", "slower", false}));
    return brc_fields_create(s->device, &fields, &s->wants, own);
}

static void release(brc_simulation *s)
{
    if (own_of(s)) brc_fields_free(&fields, own_of(s));
    brc_memory_free(own_of(s));
}

static bool due(const brc_simulation *s)
{
    return brc_current_stage(s)->constant_drag > 0;
}

static brc_status slow(brc_simulation *s, const brc_occasion *now)
{
    const double slower = brc_current_stage(s)->constant_drag * now->dt;
    BRC_TRY(brc_constrain(s, brc_velocity_of(s), NULL));
    return BRC_RUN(own_of(s)->slow, s->layout->n_rows, {"slower", BRC_STATE(slower)});
}

static brc_status book(brc_simulation *s, const brc_occasion *now)
{
    double lost;
    BRC_TRY(brc_vector_sum(s, own_of(s)->lost, s->layout->n_rows, &lost));
    now->ledger->damping += lost;
    return BRC_OK;
}

static brc_status store(brc_simulation *s, const brc_occasion *now)
{
    return brc_store_fields(s, now->store, &(brc_kept_fields){.table = &fields, .owner = own_of(s)});
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_DRAG, .call = slow, .due = due},
                                    {.hook = BRC_HOOK_LEDGER, .call = book},
                                    {.hook = BRC_HOOK_STORE, .call = store}};
const brc_effect brc_constant_drag_effect = {.name = "constant drag",
                                             .in = in,
                                             .fields = (const brc_field_table *const[]){&fields, NULL},
                                             .create = create,
                                             .free = release,
                                             BRC_HOOKED(hooked)};
