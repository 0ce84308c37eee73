/* Contact as an effect. */
#include "../effect.h"
#include "../../core/rings.h"
#include "../fracture/ahead.h"
#include "contact_internal.h"

extern const brc_field_table brc_contact_old_slot_fields, brc_contact_old_listed_fields;

BRC_WANTED(in, w->scene->has_contact)
BRC_CALLED(started, brc_contact_enable(s, now->ledger))
BRC_CALLED(turn, brc_contact_turn(s, now->kick, now->drift, now->extra * now->drift))
BRC_CALLED(press, brc_contact_acts(s, now->request) ? brc_contact_forces(s, now->request) : BRC_OK)
BRC_CALLED(energies, brc_contact_ledger(s, now->ledger))
BRC_CALLED(store, brc_contact_store_state(s, now->store))
BRC_CALLED(stretch, brc_contact_store_stretch(s, now->store))
static brc_status kicked(brc_simulation *s, const brc_occasion *now)
{
    brc_contact_state *c = s->contact;
    brc_buffer *const all[] = {c->momentum, c->turned, c->way};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        BRC_TRY(now->store->field(now->store, all[k]));
    return BRC_OK;
}
static bool exposes(const brc_scene *scene) /* any element may come to be pushed */
{
    return scene->has_contact;
}
static const brc_effect_step_bound step_bound = {brc_contact_critical_step, brc_contact_check_step, "auto: contact",
                                                 "auto: power iteration and contact"};

static const brc_effect_probes probes = {brc_contact_next_probe, brc_contact_begin_stretch, brc_contact_end_stretch};
static void release(brc_simulation *s)
{
    brc_ahead_free(s);
    brc_contact_free(s);
}

static const brc_hooked hooked[] = {
    {.hook = BRC_HOOK_RESTART, .plain = brc_contact_restart},
    {.hook = BRC_HOOK_STARTED, .call = started},
    {.hook = BRC_HOOK_ADVANCE, .call = turn},
    {.hook = BRC_HOOK_MOVED, .order = BRC_MOVED_SURFACES, .phase = BRC_PHASE_SEARCH, .plain = brc_contact_follow},
    {.hook = BRC_HOOK_FORCE, .order = BRC_FORCE_OF_SURFACES, .phase = BRC_PHASE_PAIRS, .call = press},
    {.hook = BRC_HOOK_LEDGER, .call = energies},
    {.hook = BRC_HOOK_STORE, .call = store},
    {.hook = BRC_HOOK_STRETCH, .call = stretch},
    {.hook = BRC_HOOK_KICKED, .call = kicked}};
static const brc_field_table *const fields[] = {&brc_contact_fields,
                                                &brc_contact_sum_fields,
                                                &brc_contact_slot_fields,
                                                &brc_contact_old_slot_fields,
                                                &brc_contact_grid_fields,
                                                &brc_contact_bucket_fields,
                                                &brc_contact_listed_fields,
                                                &brc_contact_old_listed_fields,
                                                &brc_contact_entry_fields,
                                                &brc_contact_pair_fields,
                                                &brc_contact_result_fields,
                                                &brc_contact_part_fields,
                                                &brc_contact_packed_at_fields,
                                                &brc_contact_packed_fields,
                                                &brc_contact_changed_fields,
                                                &brc_bonded_list_fields,
                                                NULL};
const brc_effect brc_contact_effect = {.name = "contact",
                                       .in = in,
                                       .exposes = exposes,
                                       .follows_surfaces = true,
                                       .step_bound = &step_bound,
                                       .ahead = &brc_steps_ahead,
                                       .probes = &probes,
                                       .quiet_steps = brc_contact_quiet_steps,
                                       .fields = fields,
                                       .create = brc_contact_create,
                                       .free = release,
                                       BRC_HOOKED(hooked)};
