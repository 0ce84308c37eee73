/* What the loads of the stage prescribe and book as it goes on. */
#include "loads_internal.h"

/* Lists of prescribed elements by twos, for launches over both; the last of an odd number is by itself. */
typedef struct pair {
    const brc_prescribed_load *first, *other; /* the same: one alone */
    int32_t n;                                /* of both */
} pair;

static pair pair_of(const brc_prescribed_load *all, int32_t i, int32_t n)
{
    const bool alone = i + 1 == n;
    return (pair){all + i, all + i + !alone, all[i].n + (alone ? 0 : all[i + 1].n)};
}

/* Velocities of prescribed elements at t, and where they are then. */
static brc_status move(brc_simulation *s, double t, bool displaced)
{
    const brc_stage *stage = brc_current_stage(s);
    const bool is_static = stage->solver == BRC_SOLVER_STATIC;
    for (int32_t i = 0; i < s->loads->n_prescribed; i += 2) {
        const pair p = pair_of(s->loads->prescribed, i, s->loads->n_prescribed);
        const brc_load *const load[2] = {brc_prescribed_of(stage, p.first), brc_prescribed_of(stage, p.other)};
        double factor[2], rate[2];
        for (int k = 0; k < 2; ++k) {
            factor[k] = displaced ? brc_load_factor(load[k], t, is_static) : 0;
            rate[k] = displaced && is_static ? 0 : brc_load_rate(load[k], t);
        }
        BRC_TRY(BRC_RUN_ON(s->loads->pass.impose_motion, p.n, NULL, p.first, {"n_first", BRC_INT(p.first->n)},
                           {"set_displacement", BRC_INT(displaced ? 1 : 0)}, {"factor", BRC_STATE(factor[0])},
                           {"rate", BRC_STATE(rate[0])}, {"other_factor", BRC_STATE(factor[1])},
                           {"other_rate", BRC_STATE(rate[1])}, {"other_element", BRC_BUF(p.other->element)},
                           {"other_component", BRC_BUF(p.other->component)}, {"other_base", BRC_BUF(p.other->base)},
                           {"other_direction", BRC_BUF(p.other->direction)}));
    }
    return BRC_OK;
}

brc_status brc_loads_prescribe(brc_simulation *s, double t)
{
    const brc_stage *stage = brc_current_stage(s);
    const bool is_static = stage->solver == BRC_SOLVER_STATIC;
    for (int32_t i = 0; i < s->loads->held.n_loads; ++i) {
        brc_held_load *e = s->loads->held.loads + i;
        const double factor = brc_load_factor(stage->loads + e->load, t, is_static);
        if (factor == e->factor) continue; /* they are there */
        BRC_TRY(BRC_RUN_ON(s->loads->pass.held_prescribe, e->n, NULL, e, {"factor", BRC_STATE(factor)}));
        e->factor = factor;
    }
    BRC_TRY(move(s, t, true));
    return brc_turns_prescribe(s, t);
}

brc_status brc_prescribed_book(brc_simulation *s, const brc_force_request *r)
{
    brc_prescribed_load *const all = s->loads->prescribed;
    const brc_stage *stage = brc_simulation_stage(s) >= 0 ? brc_current_stage(s) : NULL;
    const bool is_static = stage && stage->solver == BRC_SOLVER_STATIC;
    for (int32_t i = 0; i < s->loads->n_prescribed; i += 2) {
        const pair p = pair_of(all, i, s->loads->n_prescribed);
        const double rate = is_static ? 0 : brc_load_rate(brc_prescribed_of(stage, p.first), r->t),
                     other = is_static ? 0 : brc_load_rate(brc_prescribed_of(stage, p.other), r->t);
        BRC_TRY(BRC_RUN_ON(
            s->loads->pass.impose_book, p.n, r, p.first, {"n_first", BRC_INT(p.first->n)}, {"rate", BRC_STATE(rate)},
            {"other_rate", BRC_STATE(other)}, {"other_last_rate", BRC_STATE(p.other->last_rate)},
            {"other_element", BRC_BUF(p.other->element)}, {"other_component", BRC_BUF(p.other->component)},
            {"other_direction", BRC_BUF(p.other->direction)}, {"other_reaction", BRC_BUF(p.other->reaction)},
            {"other_last", BRC_BUF(p.other->last)}, {"other_last_reaction", BRC_BUF(p.other->last_reaction)},
            {"other_work", BRC_BUF(p.other->work)}));
        if (r->book != BRC_BOOK_NOTHING) all[i].last_rate = rate;
        if (r->book != BRC_BOOK_NOTHING && p.other != p.first) all[i + 1].last_rate = other;
    }
    return BRC_OK;
}

brc_status brc_loads_impose_velocity(brc_simulation *s, double t)
{
    BRC_TRY(move(s, t, false));
    return brc_turns_prescribe(s, t);
}

brc_status brc_loads_zero_prescribed(brc_simulation *s, brc_buffer *vector)
{
    for (int32_t i = 0; i < s->loads->n_prescribed; i += 2) {
        const pair p = pair_of(s->loads->prescribed, i, s->loads->n_prescribed);
        BRC_TRY(BRC_RUN_ON(s->loads->pass.zero_prescribed, p.n, NULL, p.first, {"n_first", BRC_INT(p.first->n)},
                           {"vector", BRC_BUF(vector)}, {"other_element", BRC_BUF(p.other->element)},
                           {"other_component", BRC_BUF(p.other->component)}));
    }
    return BRC_OK;
}

brc_status brc_loads_zero_turned(brc_simulation *s, brc_buffer *vector)
{
    for (int32_t i = 0; i < s->loads->n_turns; ++i) {
        brc_turn_load *m = s->loads->turns + i;
        BRC_TRY(BRC_RUN_ON(s->loads->pass.zero_turned, m->n, NULL, m, {"n_first", BRC_INT(m->n)},
                           {"vector", BRC_BUF(vector)}, {"other_element", BRC_BUF(m->element)},
                           {"other_component", BRC_BUF(m->component)}));
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
    return brc_vector_sum_later(s, h->energy, h->n_faces, out);
}
