/* Fracture as effects: bonds that break, and what a crack costs. */
#include "../effect.h"
#include "../../core/live_arrays.h"
#include "ahead.h"
#include "cell_breaks_internal.h"
#include "fracture_internal.h"
#include "../../core/rings.h"
#include "strengths.h"

BRC_WANTED(breaks, w->scene->has_fracture)
BRC_WANTED(costs, w->softens)
BRC_CALLED(step, brc_fracture_step(s, now->half_kick))
BRC_CALLED(lost, brc_fracture_lost(s, &now->ledger->fracture))
static void ask(brc_wants *w, const int32_t *material)
{
    if (w->scene->has_fracture) brc_strengths_ask(w->scene, w->domain, material, &w->weighted, &w->softens);
}
static brc_status count(brc_simulation *s, const brc_occasion *now)
{
    int64_t broken;
    BRC_TRY(brc_simulation_broken(s, &broken));
    *now->count += broken;
    return BRC_OK;
}
static bool live(const brc_simulation *s, brc_live_array *out)
{
    *out = (brc_live_array){"broken", "-", s->fracture->broken, 1};
    return true;
}
static brc_status stretch(brc_simulation *s, const brc_occasion *now)
{
    const brc_model_cohesion *cohesion = s->model->cohesion;
    if (!s->fracture->cells) /* bonds of beams break on the device before anyone knows */
        BRC_TRY(brc_fracture_store_stretch(s, now->store));
    return cohesion && cohesion->store_ahead ? cohesion->store_ahead(s, now->store) : BRC_OK;
}
BRC_CALLED(store, brc_fracture_store_state(s, now->store))

static void release(brc_simulation *s)
{
    if (!s->fracture) return;
    if (s->model->cohesion) s->model->cohesion->free(s);
    brc_ahead_free(s);
    brc_cell_breaks_free(s);
    brc_fracture_free(s);
}

brc_status brc_simulation_failure_ratio(brc_simulation *s, double *out)
{
    *out = 0;
    if (!s->fracture)
        return BRC_FAIL(s->context, BRC_BAD_INPUT, "the scene has no `fracture`, so nothing limits its stress");
    return s->fracture->cells ? brc_cell_breaks_failure_ratio(s, out) : brc_fracture_ratio(s, out);
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_BEGIN, .plain = brc_fracture_begin_stage},
                                    {.hook = BRC_HOOK_BREAK, .phase = BRC_PHASE_FRACTURE, .call = step},
                                    {.hook = BRC_HOOK_LEDGER, .call = lost},
                                    {.hook = BRC_HOOK_BROKEN, .call = count},
                                    {.hook = BRC_HOOK_STORE, .call = store},
                                    {.hook = BRC_HOOK_STRETCH, .call = stretch}};
const brc_effect brc_fracture_effect = {
    .name = "fracture",
    .in = breaks,
    .ask = ask,
    .ahead = &brc_steps_ahead,
    .live = live,
    .fields = (const brc_field_table *const[]){&brc_break_fields, &brc_criterion_fields, &brc_cell_break_fields,
                                               &brc_ring_fields, &brc_ring_list_fields, NULL},
    .create = brc_fracture_create,
    .free = release,
    BRC_HOOKED(hooked)};
const brc_effect brc_fracture_energy_effect = {.name = "fracture energy", .in = costs};
