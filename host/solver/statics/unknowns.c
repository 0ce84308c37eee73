/* Operations on vectors of unknowns of static solves. */
#include "statics_internal.h"

brc_status brc_unknowns_add(brc_simulation *s, double a, brc_unknowns x, brc_unknowns y)
{
    const int32_t n = 3 * s->layout->n_rows;
    BRC_TRY(brc_vector_axpy(s, n, a, x.move, y.move));
    return y.turn ? brc_vector_axpy(s, n, a, x.turn, y.turn) : BRC_OK;
}

brc_status brc_unknowns_scale_add(brc_simulation *s, brc_unknowns x, double a, brc_unknowns y)
{
    const int32_t n = 3 * s->layout->n_rows;
    BRC_TRY(brc_vector_xpay(s, n, x.move, a, y.move));
    return y.turn ? brc_vector_xpay(s, n, x.turn, a, y.turn) : BRC_OK;
}

brc_status brc_unknowns_dot(brc_simulation *s, brc_unknowns x, brc_unknowns y, double weight, double *out)
{
    double turn = 0;
    BRC_TRY(brc_vector_dot(s, x.move, y.move, 3 * (int64_t)s->layout->n_rows, out));
    if (x.turn) BRC_TRY(brc_vector_dot(s, x.turn, y.turn, 3 * (int64_t)s->layout->n_rows, &turn));
    *out += weight * turn;
    return BRC_OK;
}

brc_status brc_unknowns_copy(brc_unknowns from, brc_unknowns to)
{
    BRC_TRY(brc_buffer_copy(to.move, from.move, brc_buffer_bytes(from.move)));
    return to.turn ? brc_buffer_copy(to.turn, from.turn, brc_buffer_bytes(from.turn)) : BRC_OK;
}

brc_status brc_statics_square(brc_simulation *s, const brc_solve_vectors *v, brc_unknowns r, double *out)
{
    return brc_unknowns_dot(s, r, r, 1 / (v->arm * v->arm), out);
}
