/* What statics keep of a simulation: reports, modes, how far events have come. */
#include "statics_internal.h"

brc_status brc_statics_create(brc_simulation *s)
{
    return BRC_ALLOCATE(s->context, &s->statics, 1, "simulation");
}
void brc_statics_free(brc_simulation *s)
{
    if (s->statics) brc_memory_free(s->statics->modes);
    brc_memory_free(s->statics);
    s->statics = NULL;
}

BRC_READ(brc_static_report, brc_simulation_static_report, s->statics->report)

brc_status brc_simulation_static_state(brc_simulation *s, double *out)
{
    const int64_t n = s->domain->n_elements;
    BRC_LOCAL(s->context, 3 * n, double, move, "states");
    BRC_LOCAL(s->context, 4 * n, double, q, "states");
    BRC_TRY(brc_simulation_displacement(s, move));
    BRC_TRY(brc_simulation_orientation(s, q, NULL));
    for (int64_t e = 0; e < n; ++e)
        for (int c = 0; c < 3; ++c) {
            out[6 * e + c] = move[3 * e + c];
            out[6 * e + 3 + c] = 2 * q[4 * e + 1 + c] / q[4 * e];
        }
    return BRC_OK;
}

void brc_simulation_know_states(brc_simulation *s, int32_t n, const double *const *state)
{
    s->statics->n_known = n;
    s->statics->known = state;
}

const double *brc_simulation_modes(const brc_simulation *s, int32_t *n)
{
    *n = s->statics->n_modes;
    return s->statics->modes;
}

BRC_READ(double, brc_statics_released, s->statics->released)
BRC_READ(double, brc_statics_changing, s->statics->changing)

bool brc_statics_go_on(const brc_simulation *s)
{
    const brc_stage *stage = brc_current_stage(s);
    if (stage->solver == BRC_SOLVER_DYNAMIC) return false;
    do
        if (stage == s->scene->stages) return false;
    while ((--stage)->solver == BRC_SOLVER_MODES);
    return stage->solver == BRC_SOLVER_STATIC;
}

void brc_statics_change(brc_simulation *s, double work)
{
    s->statics->changing += work;
}

brc_status brc_statics_store(brc_simulation *s, brc_state_store *store)
{
    struct brc_statics *own = s->statics;
    int64_t n_modes = own->n_modes;
    BRC_TRY(brc_store_double(store, "released", &own->released));
    BRC_TRY(brc_store_double(store, "changing", &own->changing));
    BRC_TRY(brc_store_double(store, "static.residual", &own->report.residual));
    BRC_TRY(brc_store_integer(store, "static.iterations", &own->report.iterations));
    BRC_TRY(brc_store_integer(store, "static.corrections", &own->report.corrections));
    BRC_TRY(brc_store_double(store, "events.margin", &own->margin));
    BRC_TRY(brc_store_double(store, "events.largest_load", &own->largest_load));
    BRC_TRY(brc_store_array(s->context, store, "modes", BRC_STORED_DOUBLE, 1, &n_modes, (void **)&own->modes));
    own->n_modes = (int32_t)n_modes;
    return BRC_OK;
}
