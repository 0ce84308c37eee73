/* Held faces and tractions in the passes of a model. */
#include "loads_internal.h"

BRC_READ(bool, brc_loads_on_faces, s->loads->on_faces)
BRC_READ(int32_t, brc_loads_n_held_faces, s->loads->held.n_faces)

brc_status brc_held_faces_run(brc_simulation *s, const brc_pass *pass, const brc_force_request *r, bool reactions)
{
    const brc_held_faces *h = &s->loads->held;
    if (!h->n_faces) return BRC_OK;
    brc_buffer *value = r->homogeneous ? h->zero_value : h->value;
    if (!reactions) return BRC_RUN_ON(pass, h->n_elements, r, NULL, {"value", BRC_BUF(value)});
    /* the linear operator must not disturb reactions and work: the former go to scratch */
    return BRC_RUN_ON(pass, h->n_elements, r, NULL, {"value", BRC_BUF(value)},
                      {"reaction", BRC_BUF(r->homogeneous ? h->scratch : h->reaction)});
}

static double factor_of(const brc_simulation *s, const brc_traction_load *t, const brc_force_request *r)
{
    const brc_stage *stage = brc_current_stage(s);
    return brc_load_factor(stage->loads + t->load, r->t, stage->solver == BRC_SOLVER_STATIC);
}

brc_status brc_traction_moments_run(brc_simulation *s, const brc_pass *pass, const brc_force_request *r)
{
    for (int32_t i = 0; i < s->loads->n_tractions; ++i) {
        const brc_traction_load *t = s->loads->tractions + i;
        BRC_TRY(BRC_RUN_ON(pass, t->n, NULL, t, {"factor", BRC_COEFF(factor_of(s, t, r))}));
    }
    return BRC_OK;
}

brc_status brc_traction_forces_run(brc_simulation *s, const brc_pass *pass, const brc_force_request *r)
{
    for (int32_t i = 0; i < s->loads->n_tractions; ++i) {
        brc_traction_load *t = s->loads->tractions + i;
        const double factor = factor_of(s, t, r);
        BRC_TRY(BRC_RUN_ON(pass, t->n, r, t, {"factor", BRC_STATE(factor)}));
        if (r->book != BRC_BOOK_NOTHING) t->last_factor = factor;
    }
    return BRC_OK;
}

brc_status brc_held_faces_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    const brc_held_faces *h = &s->loads->held;
    const int bytes = brc_state_bytes(s);
    double *held = NULL;
    if (!h->n_faces || !h->value) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &held, 3 * (int64_t)h->n_faces, "held faces"));
    const brc_status status = brc_download(s, h->value, bytes, held, 3 * (int64_t)h->n_faces);
    for (int64_t i = 0; status == BRC_OK && i < n; ++i) {
        const int64_t at = h->index_of_free_face[faces[i]];
        for (int c = 0; at >= 0 && c < 3; ++c)
            if (h->component_of_face[at] >> c & 1) out[3 * i + c] = held[3 * at + c];
    }
    brc_memory_free(held);
    return status;
}

void brc_loads_each_prescribed(const brc_simulation *s, brc_prescribed_call call, void *self)
{
    const brc_loads *loads = s->loads;
    const brc_held_faces *h = &loads->held;
    for (int32_t i = 0; i < loads->n_prescribed; ++i)
        for (int32_t k = 0; k < loads->prescribed[i].n; ++k)
            call(self, &(brc_prescribed){.element = loads->prescribed[i].element_id[k],
                                         .face = -1,
                                         .motion = loads->prescribed[i].component_bits,
                                         .by_load = loads->prescribed[i].load >= 0});
    for (int64_t f = 0; h->n_faces > 0 && f < s->domain->n_free_faces; ++f)
        if (h->index_of_free_face[f] >= 0)
            call(self, &(brc_prescribed){.element = s->domain->free_element[f],
                                         .face = (int32_t)f,
                                         .motion = h->component_of_face[h->index_of_free_face[f]],
                                         .by_load = true});
    for (int32_t i = 0; i < loads->n_turns; ++i)
        for (int32_t k = 0; k < loads->turns[i].n; ++k)
            call(self,
                 &(brc_prescribed){.element = loads->turns[i].element_id[k],
                                   .face = -1,
                                   .rotation = brc_load_components(brc_current_stage(s)->loads + loads->turns[i].load),
                                   .by_load = true});
}
