/* What the loads of the stage prescribe and book as it goes on. */
#include "loads_internal.h"

brc_status brc_loads_prescribe(brc_simulation *s, double t)
{
    const brc_stage *stage = brc_current_stage(s);
    const bool is_static = stage->solver == BRC_SOLVER_STATIC;
    for (int32_t i = 0; i < s->loads->held.n_loads; ++i) {
        brc_held_load *e = s->loads->held.loads + i;
        BRC_TRY(BRC_RUN_ON(s->loads->pass.held_prescribe, e->n, NULL, e,
                           {"factor", BRC_STATE(brc_load_factor(stage->loads + e->load, t, is_static))}));
    }
    for (int32_t i = 0; i < s->loads->n_prescribed; ++i) {
        brc_prescribed_load *m = s->loads->prescribed + i;
        const brc_load *load = brc_prescribed_of(stage, m);
        BRC_TRY(BRC_RUN_ON(
            s->loads->pass.impose_motion, m->n, NULL, m, {"factor", BRC_STATE(brc_load_factor(load, t, is_static))},
            {"rate", BRC_STATE(is_static ? 0 : brc_load_rate(load, t))}, {"set_displacement", BRC_INT(1)}));
    }
    return brc_turns_prescribe(s, t);
}

brc_status brc_prescribed_book(brc_simulation *s, const brc_force_request *r)
{
    const brc_stage *stage = brc_simulation_stage(s) >= 0 ? brc_current_stage(s) : NULL;
    for (int32_t i = 0; i < s->loads->n_prescribed; ++i) {
        brc_prescribed_load *m = s->loads->prescribed + i;
        const double rate = stage->solver == BRC_SOLVER_STATIC ? 0 : brc_load_rate(brc_prescribed_of(stage, m), r->t);
        BRC_TRY(BRC_RUN_ON(s->loads->pass.impose_book, m->n, r, m, {"rate", BRC_STATE(rate)}));
        if (r->book != BRC_BOOK_NOTHING) m->last_rate = rate;
    }
    return BRC_OK;
}

brc_status brc_loads_impose_velocity(brc_simulation *s, double t)
{
    const brc_stage *stage = brc_current_stage(s);
    for (int32_t i = 0; i < s->loads->n_prescribed; ++i) {
        brc_prescribed_load *m = s->loads->prescribed + i;
        BRC_TRY(BRC_RUN_ON(s->loads->pass.impose_motion, m->n, NULL, m, {"factor", BRC_STATE(0)},
                           {"rate", BRC_STATE(brc_load_rate(brc_prescribed_of(stage, m), t))},
                           {"set_displacement", BRC_INT(0)}));
    }
    return brc_turns_prescribe(s, t);
}

brc_status brc_loads_zero_prescribed(brc_simulation *s, brc_buffer *vector)
{
    for (int32_t i = 0; i < s->loads->n_prescribed; ++i) {
        brc_prescribed_load *m = s->loads->prescribed + i;
        BRC_TRY(BRC_RUN_ON(s->loads->pass.zero_prescribed, m->n, NULL, m, {"vector", BRC_BUF(vector)}));
    }
    return BRC_OK;
}

brc_status brc_loads_zero_turned(brc_simulation *s, brc_buffer *vector)
{
    for (int32_t i = 0; i < s->loads->n_turns; ++i) {
        brc_turn_load *m = s->loads->turns + i;
        BRC_TRY(BRC_RUN_ON(s->loads->pass.zero_turned, m->n, NULL, m, {"vector", BRC_BUF(vector)}));
    }
    return BRC_OK;
}

brc_status brc_loads_work(brc_simulation *s, double *out)
{
    double sum = 0, part = 0;
    if (s->loads->held.n_faces) {
        BRC_TRY(brc_vector_sum(s, s->loads->held.work, s->loads->held.n_faces, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads->n_tractions; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads->tractions[i].work, s->loads->tractions[i].n, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads->n_prescribed; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads->prescribed[i].work, s->loads->prescribed[i].n, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads->n_pushes; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads->pushes[i].work, s->loads->pushes[i].n, &part));
        sum += part;
    }
    for (int32_t i = 0; i < s->loads->n_turns; ++i) {
        BRC_TRY(brc_vector_sum(s, s->loads->turns[i].work, s->loads->turns[i].n, &part));
        sum += part;
    }
    *out = sum;
    return BRC_OK;
}

brc_status brc_force_held_energy(brc_simulation *s, double *out)
{
    brc_held_faces *h = &s->loads->held;
    *out = 0;
    if (!h->n_faces) return BRC_OK;
    BRC_TRY(brc_pass_run(s->loads->pass.held_energy, h->n_elements));
    return brc_vector_sum(s, h->energy, h->n_faces, out);
}
