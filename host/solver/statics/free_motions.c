/* Motions that the supports leave to a body or a piece of one. */
#include "statics_internal.h"

brc_status brc_statics_project_free_motions(brc_simulation *s, const brc_solve_vectors *v, brc_unknowns r)
{
    const int64_t n = s->domain->n_elements;
    BRC_FREED double *torque = NULL;
    if (!v->pieces.any) return BRC_OK;
    BRC_LOCAL(s->context, 3 * n, double, force, "free motions");
    BRC_TRY(brc_state_from_rows(s, r.move, force, 3));
    if (r.turn) {
        BRC_TRY(BRC_ALLOCATE(s->context, &torque, 3 * n, "free motions"));
        BRC_TRY(brc_state_from_rows(s, r.turn, torque, 3));
    }
    BRC_TRY(brc_pieces_project(s->context, &v->pieces, force, torque));
    BRC_TRY(brc_state_to_rows(s, r.move, force, 3, 0));
    if (torque) BRC_TRY(brc_state_to_rows(s, r.turn, torque, 3, 0));
    return BRC_OK;
}

brc_status brc_statics_find_pieces(brc_simulation *s, brc_solve_vectors *v)
{
    BRC_TRY(brc_pieces_find(s, &v->pieces));
    if (!v->pieces.any) brc_pieces_free(&v->pieces);
    return BRC_OK;
}
