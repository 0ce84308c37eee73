/* Walls and strikers as an effect. */
#include "../effect.h"
#include "strikers_internal.h"

BRC_WANTED(in, w->scene->n_strikers > 0)
BRC_CALLED(advance, brc_strikers_advance(s, now->kick, now->drift, now->extra, now->numerical))
BRC_CALLED(book, brc_strikers_book(s, now->request->book))
static brc_status energies(brc_simulation *s, const brc_occasion *now)
{
    brc_striker_energies e;
    BRC_TRY(brc_strikers_energies(s, &e));
    now->ledger->kinetic += e.kinetic;
    now->ledger->potential += e.potential;
    now->ledger->work += e.work;
    now->ledger->numerical += e.numerical;
    return BRC_OK;
}
BRC_CALLED(store, brc_strikers_store_state(s, now->store))

static brc_status kicked(brc_simulation *s, const brc_occasion *now)
{
    const brc_strikers *t = s->strikers;
    brc_buffer *const all[] = {t->displacement, t->orientation, t->momentum, t->motion, t->pose, t->moved};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        BRC_TRY(now->store->field(now->store, all[k]));
    return BRC_OK;
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_PLACE, .plain = brc_strikers_prescribe},
                                    {.hook = BRC_HOOK_ADVANCE, .call = advance},
                                    {.hook = BRC_HOOK_BOOK, .call = book},
                                    {.hook = BRC_HOOK_LEDGER, .call = energies},
                                    {.hook = BRC_HOOK_STORE, .call = store},
                                    {.hook = BRC_HOOK_STRETCH, .call = store},
                                    {.hook = BRC_HOOK_KICKED, .call = kicked}};
const brc_effect brc_strikers_effect = {.name = "walls and strikers",
                                        .in = in,
                                        .fields = (const brc_field_table *const[]){&brc_striker_fields, NULL},
                                        .create = brc_strikers_create,
                                        .free = brc_strikers_free,
                                        BRC_HOOKED(hooked)};
