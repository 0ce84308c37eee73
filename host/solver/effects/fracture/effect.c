/* Fracture as effects: bonds that break, and what a crack costs. */
#include "../effect.h"
#include "cell_breaks.h"
#include "fracture_internal.h"
#include "rings.h"

static bool breaks(const brc_wants *w)
{
    return w->scene->has_fracture;
}
static bool costs(const brc_wants *w)
{
    return w->softens;
}
static brc_status step(brc_simulation *s, const brc_occasion *now)
{
    return brc_fracture_step(s, now->half_kick);
}
static brc_status lost(brc_simulation *s, const brc_occasion *now)
{
    return brc_fracture_lost(s, &now->ledger->fracture);
}
static brc_status store(brc_simulation *s, const brc_occasion *now)
{
    return brc_fracture_store_state(s, now->store);
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_BEGIN, .plain = brc_fracture_begin_stage},
                                    {.hook = BRC_HOOK_BREAK, .phase = BRC_PHASE_FRACTURE, .call = step},
                                    {.hook = BRC_HOOK_LEDGER, .call = lost},
                                    {.hook = BRC_HOOK_STORE, .call = store}};
const brc_effect brc_fracture_effect = {
    .name = "fracture",
    .in = breaks,
    .fields = (const brc_field_table *const[]){&brc_break_fields, &brc_criterion_fields, &brc_cell_break_fields,
                                               &brc_ring_fields, &brc_ring_list_fields, NULL},
    .create = brc_fracture_create,
    .free = brc_fracture_free,
    BRC_HOOKED(hooked)};
const brc_effect brc_fracture_energy_effect = {.name = "fracture energy", .in = costs};
