/* Effects of a run: which there are, what they hooked in where, and calling it. */
#include "../effects/effect.h"
#include "core_internal.h"

static void hook_in(brc_simulation *s, int n, const brc_hooked *hooked)
{
    for (int k = 0; k < n; ++k) {
        brc_hook_list *list = &s->core->hook[hooked[k].hook];
        int at = list->n++;
        for (; at > 0 && list->at[at - 1]->order > hooked[k].order; --at)
            list->at[at] = list->at[at - 1];
        list->at[at] = &hooked[k];
    }
}

static void list(brc_simulation *s, const char *name, bool in)
{
    const char **next = in ? s->core->effects_in : s->core->effects_out;
    while (*next)
        ++next;
    *next = name;
}

static void list_models(brc_simulation *s)
{
    int n;
    const brc_bond_model *const *models = brc_bond_models(&n);
    for (int m = 0; m < n; ++m)
        for (int k = 0; k < 2 && models[m]->effect[k].name; ++k) {
            const brc_model_effect *e = &models[m]->effect[k];
            list(s, e->name, models[m] == s->model && (!e->in || e->in(s->scene)));
        }
}

brc_status brc_effects_create(brc_simulation *s)
{
    int n;
    const brc_effect *const *effects = brc_effects(&n);
    list_models(s);
    for (int k = 0; k < n; ++k) {
        const bool in = !effects[k]->in || effects[k]->in(&s->wants);
        if (effects[k]->name) list(s, effects[k]->name, in);
        if (!in) continue;
        s->core->effect[s->core->n_effects++] = effects[k];
        if (effects[k]->create) BRC_TRY(effects[k]->create(s));
        hook_in(s, effects[k]->n_hooked, effects[k]->hooked);
    }
    hook_in(s, s->model->n_hooked, s->model->hooked);
    return BRC_OK;
}

void brc_effects_free(brc_simulation *s)
{
    for (int k = s->core ? s->core->n_effects - 1 : -1; k >= 0; --k)
        if (s->core->effect[k]->free) s->core->effect[k]->free(s);
}

void **brc_effect_own(brc_simulation *s, const brc_effect *effect)
{
    int k = 0;
    while (s->core->effect[k] != effect)
        ++k;
    return &s->core->own[k];
}

bool brc_effect_is_in(const brc_simulation *s, const brc_effect *effect)
{
    for (int k = 0; k < s->core->n_effects; ++k)
        if (s->core->effect[k] == effect) return true;
    return false;
}

const brc_effect *brc_effect_at(const brc_simulation *s, int k)
{
    return k < s->core->n_effects ? s->core->effect[k] : NULL;
}

bool brc_hook_is_due(const brc_simulation *s, brc_hook hook)
{
    const brc_hook_list *list = &s->core->hook[hook];
    for (int k = 0; k < list->n; ++k)
        if (!list->at[k]->due || list->at[k]->due(s)) return true;
    return false;
}

brc_status brc_hook_run(brc_simulation *s, brc_hook hook, const brc_occasion *now)
{
    const brc_hook_list *list = &s->core->hook[hook];
    for (int k = 0; k < list->n; ++k) {
        const brc_hooked *h = list->at[k];
        if (h->due && !h->due(s)) continue;
        const brc_step_phase before = h->phase ? brc_phase_within(s, (brc_step_phase)h->phase) : BRC_PHASE_NONE;
        BRC_TRY(h->plain ? h->plain(s) : h->call(s, now));
        if (h->phase) brc_phase_within(s, before);
    }
    return BRC_OK;
}

brc_status brc_constrain(brc_simulation *s, brc_buffer *vector, brc_buffer *rotations)
{
    return brc_hook_run(s, BRC_HOOK_CONSTRAIN, &(brc_occasion){.vector = vector, .rotations = rotations});
}

int64_t brc_effects_quiet_steps(const brc_simulation *s)
{
    int64_t fewest = INT64_MAX;
    for (int k = 0; k < s->core->n_effects; ++k) {
        const int64_t n = s->core->effect[k]->quiet_steps ? s->core->effect[k]->quiet_steps(s) : INT64_MAX;
        if (n < fewest) fewest = n;
    }
    return fewest;
}

int64_t brc_effects_next_reading(const brc_simulation *s, int64_t step)
{
    int64_t next = INT64_MAX;
    for (int k = 0; k < s->core->n_effects; ++k) {
        const int64_t n = s->core->effect[k]->next_reading ? s->core->effect[k]->next_reading(s, step) : INT64_MAX;
        if (n < next) next = n;
    }
    return next;
}

bool brc_effects_follow_surfaces(const brc_simulation *s)
{
    for (int k = 0; k < s->core->n_effects; ++k)
        if (s->core->effect[k]->follows_surfaces) return true;
    return false;
}

int64_t brc_effects_next_probe(const brc_simulation *s)
{
    int64_t next = INT64_MAX;
    for (int k = 0; k < s->core->n_effects; ++k) {
        const int64_t n = s->core->effect[k]->probes ? s->core->effect[k]->probes->next(s) : INT64_MAX;
        if (n < next) next = n;
    }
    return next;
}

void brc_effects_begin_probes(brc_simulation *s)
{
    for (int k = 0; k < s->core->n_effects; ++k)
        if (s->core->effect[k]->probes) s->core->effect[k]->probes->begin(s);
}

brc_status brc_effects_end_probes(brc_simulation *s, bool *stands)
{
    *stands = true;
    for (int k = 0; k < s->core->n_effects; ++k) {
        bool found_nothing = true;
        if (s->core->effect[k]->probes) BRC_TRY(s->core->effect[k]->probes->end(s, &found_nothing));
        *stands = *stands && found_nothing;
    }
    return BRC_OK;
}

const brc_effect_ahead *brc_effects_ahead(const brc_simulation *s)
{
    for (int k = 0; k < s->core->n_effects; ++k)
        if (s->core->effect[k]->ahead) return s->core->effect[k]->ahead;
    return NULL;
}
