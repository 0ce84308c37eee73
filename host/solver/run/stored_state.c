/* The state of a simulation, number by number, for a store (state_store.h): the clock, the arrays of the elements, what
 * the loads of the stage remember. Effects hook in behind them. */
#include "../effects/loads/element_loads.h"
#include "../effects/loads/load_fields.h"
#include "state_store.h"
#include <stdio.h>
#include <string.h>

/* ---- the clock, and what is counted over the whole run ---- */

static brc_status walk_clock(brc_simulation *s, brc_state_store *store)
{
    brc_time_step *dt = &s->time_step;
    const struct {
        const char *name;
        double *value;
    } numbers[] = {{"time", &s->time},
                   {"total_time_before", &s->total_time_before},
                   {"load_factor", &s->load_factor},
                   {"time_step.value", &dt->value},
                   {"time_step.critical", &dt->critical},
                   {"time_step.published", &dt->published},
                   {"time_step.safety", &dt->safety},
                   {"work_before", &s->work_before},
                   {"damping_before", &s->damping_before},
                   {"numerical_before", &s->numerical_before},
                   {"initial_energy", &s->initial_energy},
                   {"peak_elastic", &s->peak_elastic},
                   {"peak_kinetic", &s->peak_kinetic},
                   {"total_before_stage", &s->total_before_stage},
                   {"released", &s->released},
                   {"static.residual", &s->static_report.residual},
                   {"events.margin", &s->progress.margin},
                   {"events.largest_load", &s->progress.largest_load},
                   {"regime.peak_elastic", &s->regime.peak_elastic}},
      ratios[] = {{"regime.at_first_break", &s->regime.at_first_break},
                  {"regime.at_peak", &s->regime.at_peak},
                  {"regime.until_peak", &s->regime.until_peak},
                  {"regime.last", &s->regime.last},
                  {"regime.most", &s->regime.most}}; /* none before something is strained */
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
        BRC_TRY(brc_store_double(store, numbers[k].name, numbers[k].value));
    for (size_t k = 0; k < sizeof ratios / sizeof *ratios; ++k)
        BRC_TRY(brc_store_sample(store, ratios[k].name, ratios[k].value));
    const struct {
        const char *name;
        int64_t *value;
    } counts[] = {{"step", &s->step},
                  {"total_steps", &s->total_steps},
                  {"calm_steps", &s->progress.calm_steps},
                  {"judged_step", &s->progress.judged_step},
                  {"static.iterations", &s->static_report.iterations},
                  {"static.corrections", &s->static_report.corrections}};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k)
        BRC_TRY(brc_store_integer(store, counts[k].name, counts[k].value));
    return brc_store_flag(store, "regime.broke", &s->regime.broke);
}

/* Words, and lists whose length is part of the state. */
static brc_status walk_notes(brc_simulation *s, brc_state_store *store)
{
    brc_time_step *dt = &s->time_step;
    int64_t n_modes = s->n_modes;
    char name[64];
    if (!store->loading && dt->governed_by != s->governed_by)
        snprintf(s->governed_by, sizeof s->governed_by, "%s", dt->governed_by ? dt->governed_by : "");
    BRC_TRY(brc_store_text(store, "time_step.governed_by", s->governed_by, sizeof s->governed_by));
    if (store->loading) dt->governed_by = s->governed_by[0] ? s->governed_by : NULL;
    for (int32_t i = 0; i < s->scene->n_stages; ++i) {
        snprintf(name, sizeof name, "stage.%d.ended", (int)i);
        BRC_TRY(brc_store_flag(store, name, &s->note[i].ended));
        snprintf(name, sizeof name, "stage.%d.reason", (int)i);
        BRC_TRY(brc_store_text(store, name, s->note[i].reason, sizeof s->note[i].reason));
    }
    BRC_TRY(brc_store_array(s->context, store, "modes", BRC_STORED_DOUBLE, 1, &n_modes, (void **)&s->modes));
    s->n_modes = (int32_t)n_modes;
    return BRC_OK;
}

/* ---- elements ---- */

/* Displacement gradients and stresses of dlsm follow from the displacements; the strains of dlsm-published do so only
 * to rounding, since the half kick that closes a batch normalises its orientations once more. */
static brc_status walk_elements(brc_simulation *s, brc_state_store *store)
{
    return brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_state_fields, .owner = s});
}

/* ---- loads ---- */

/* What a list of a load keeps, as "loads.<kind>.<i>.<what>". */
static brc_status walk_list(brc_simulation *s, brc_state_store *store, const char *kind, int32_t i,
                            const brc_field_table *table, const void *list, int64_t n, const int32_t *id)
{
    char prefix[64];
    snprintf(prefix, sizeof prefix, "loads.%s.%d.", kind, (int)i);
    return brc_store_fields(s, store,
                            &(brc_kept_fields){.table = table, .owner = list, .prefix = prefix, .n = n, .id = id});
}

static brc_status walk_number(brc_state_store *store, const char *kind, int32_t i, const char *what, double *value)
{
    char name[64];
    snprintf(name, sizeof name, "loads.%s.%d.%s", kind, (int)i, what);
    return brc_store_double(store, name, value);
}

static brc_status walk_held(brc_simulation *s, brc_state_store *store)
{
    const brc_held_faces *h = &s->loads.held;
    int32_t *face = NULL;
    brc_status status = BRC_OK;
    if (h->n_faces == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &face, h->n_faces, "held faces"));
    for (int64_t f = 0; f < s->domain->n_free_faces; ++f)
        if (h->index_of_free_face[f] >= 0) face[h->index_of_free_face[f]] = (int32_t)f;
    BRC_TRY_OR(cleanup, walk_list(s, store, "held", 0, &brc_held_face_fields, h, h->n_faces, face));
    for (int32_t i = 0; i < h->n_loads; ++i) /* in the order of the set's members */
        BRC_TRY_OR(cleanup, walk_list(s, store, "held", i, &brc_held_load_fields, h->loads + i, h->loads[i].n, NULL));
cleanup:
    brc_memory_free(face);
    return status;
}

static brc_status walk_traction(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_traction_load *t = s->loads.tractions + i;
    int32_t *element = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(walk_number(store, "traction", i, "last_factor", &t->last_factor));
    if (t->n == 0) return BRC_OK;
    if (store->field) return walk_list(s, store, "traction", i, &brc_traction_fields, t, t->n, NULL);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &element, t->n, "elements under traction"));
    BRC_TRY_OR(cleanup, brc_buffer_read(t->element, 0, element, 4 * (int64_t)t->n));
    for (int32_t k = 0; k < t->n; ++k)
        element[k] = s->layout->element_of_row[element[k]];
    status = walk_list(s, store, "traction", i, &brc_traction_fields, t, t->n, element);
cleanup:
    brc_memory_free(element);
    return status;
}

static brc_status walk_imposed(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_imposed_load *m = s->loads.imposed + i;
    BRC_TRY(walk_list(s, store, "imposed", i, &brc_imposed_fields, m, m->n, m->element_id));
    return walk_number(store, "imposed", i, "last_rate", &m->last_rate);
}

static brc_status walk_push(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_push_load *p = s->loads.pushes + i;
    BRC_TRY(walk_number(store, "push", i, "factor", &p->factor));
    BRC_TRY(walk_number(store, "push", i, "last_factor", &p->last_factor));
    return walk_list(s, store, "push", i, &brc_push_fields, p, p->n, p->element_id);
}

static brc_status walk_turn(brc_simulation *s, brc_state_store *store, int32_t i)
{
    brc_turn_load *m = s->loads.turns + i;
    BRC_TRY(walk_number(store, "turn", i, "turned", &m->turned));
    BRC_TRY(walk_number(store, "turn", i, "last_factor", &m->last_factor));
    BRC_TRY(walk_number(store, "turn", i, "last_rate", &m->last_rate));
    return walk_list(s, store, "turn", i, &brc_turn_fields, m, m->n, m->element_id);
}

static brc_status walk_loads(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(walk_held(s, store));
    for (int32_t i = 0; i < s->loads.n_tractions; ++i)
        BRC_TRY(walk_traction(s, store, i));
    for (int32_t i = 0; i < s->loads.n_imposed; ++i)
        BRC_TRY(walk_imposed(s, store, i));
    for (int32_t i = 0; i < s->loads.n_pushes; ++i)
        BRC_TRY(walk_push(s, store, i));
    for (int32_t i = 0; i < s->loads.n_turns; ++i)
        BRC_TRY(walk_turn(s, store, i));
    return BRC_OK;
}

/* ---- the whole ---- */

brc_status brc_simulation_walk_motion(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(walk_clock(s, store));
    BRC_TRY(walk_elements(s, store));
    return walk_loads(s, store);
}

/* All but the stage itself, whose loads are there. */
static brc_status walk(brc_simulation *s, brc_state_store *store)
{
    BRC_TRY(walk_clock(s, store));
    BRC_TRY(walk_notes(s, store));
    BRC_TRY(walk_elements(s, store));
    BRC_TRY(walk_loads(s, store));
    return brc_hook_run(s, BRC_HOOK_STORE, &(brc_occasion){.store = store});
}

brc_status brc_simulation_save_state(brc_simulation *s, brc_state_store *store)
{
    if (s->stage < 0) return BRC_FAIL(s->context, BRC_INTERNAL, "the state of a simulation that is in no stage");
    BRC_TRY(brc_store_index(store, "stage", &s->stage));
    BRC_TRY(walk(s, store));
    return s->static_run ? brc_statics_store_run(s, s->static_run, store) : BRC_OK;
}

brc_status brc_simulation_load_state(brc_simulation *s, brc_state_store *store)
{
    const double start = brc_clock_s();
    int32_t stage;
    BRC_TRY(brc_store_index(store, "stage", &stage));
    if (stage < 0 || stage >= s->scene->n_stages || s->stage >= 0)
        return BRC_FAIL(s->context, BRC_BAD_INPUT, "a state of stage %d cannot be taken up by a scene of %d stages",
                        (int)stage, (int)s->scene->n_stages);
    BRC_TRY(brc_loads_create(s, &s->scene->stages[stage], &s->loads));
    s->stage = stage;
    BRC_TRY(walk(s, store));
    BRC_TRY(brc_force_of_state(
        s, BRC_BOOK_NOTHING)); /* what only it makes; what it makes otherwise than the last step did is filled again */
    BRC_TRY(walk(s, store));
    s->setup_seconds += brc_clock_s() - start;
    return BRC_OK;
}
