/* Gravity: the weight of every element, and its potential. */
#include "../core/solver.h"
#include "effect.h"

typedef struct brc_weights {
    brc_pass *add;
    brc_buffer *weight; /* mass; 0 in padding, which has a mass to be divided by and, falling, would have an energy */
} brc_weights;

BRC_WANTED(in, w->scene->has_gravity)

static const brc_field_row rows[] = {{"weight", brc_each_row, 1, BRC_FIELD_STATE, NULL,
                                      BRC_FIELD_AT(brc_weights, weight), "masses in gravity", "kg", BRC_NOT_KEPT}};
static BRC_FIELD_TABLE(fields, "gravity", BRC_LIFE_RUN, in, rows);
extern const brc_effect brc_gravity_effect;

static brc_status create(brc_simulation *s)
{
    void **own = brc_effect_own(s, &brc_gravity_effect);
    double *mass = NULL;
    BRC_TRY(brc_memory_allocate(s->context, own, 1, sizeof(brc_weights), "gravity"));
    brc_weights *g = *own;
    static const brc_value_row weighs[] = {{"mass", BRC_VALUE_BUFFER, BRC_FIELD_AT(brc_weights, weight)}};
    const brc_scope run = brc_scope_of_run(s), request = brc_scope_of_request(&run),
                    weights = {.owner = "gravity", .base = g, BRC_VALUES(weighs), .outer = &request};
    BRC_TRY(BRC_PASSES(s, &weights, {&g->add, "gravity", NULL, false}));
    BRC_TRY(brc_fields_create(s->device, &fields, &s->wants, g));
    BRC_TRY(BRC_ALLOCATE(s->context, &mass, s->domain->n_elements, "masses"));
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        mass[e] = brc_mass_of_element(s, e);
    const brc_status status = brc_state_to_rows(s, g->weight, mass, 1, 0);
    brc_memory_free(mass);
    return status;
}

static void release(brc_simulation *s)
{
    void **own = brc_effect_own(s, &brc_gravity_effect);
    if (*own) brc_fields_free(&fields, *own);
    brc_memory_free(*own);
}

static brc_status add(brc_simulation *s, const brc_occasion *now)
{
    const brc_weights *g = *brc_effect_own(s, &brc_gravity_effect);
    return brc_pass_run_on(g->add, s->layout->n_rows, now->request, NULL, NULL);
}

/* -sum m g.u */
static brc_status potential(brc_simulation *s, const brc_occasion *now)
{
    const brc_domain *d = s->domain;
    BRC_LOCAL(s->context, 3 * d->n_elements, double, u, "displacements");
    const brc_status status = brc_state_from_rows(s, brc_displacement_of(s), u, 3);
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int c = 0; c < 3; ++c)
            now->ledger->potential -= brc_mass_of_element(s, e) * s->scene->gravity[c] * u[3 * e + c];
    return status;
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_FORCE, .order = BRC_FORCE_OF_WEIGHT, .call = add},
                                    {.hook = BRC_HOOK_LEDGER, .call = potential}};
const brc_effect brc_gravity_effect = {.name = "gravity",
                                       .in = in,
                                       .fields = (const brc_field_table *const[]){&fields, NULL},
                                       .create = create,
                                       .free = release,
                                       BRC_HOOKED(hooked)};
