#include "settling.h"

static brc_status read_state(brc_simulation *s, double *place, double *orientation)
{
    BRC_TRY(brc_state_from_rows(s, brc_displacement_of(s), place, 3));
    return s->model->turns ? brc_state_from_rows(s, brc_orientation_of(s), orientation, 4) : BRC_OK;
}

brc_status brc_settling_begin(brc_simulation *s, const brc_solve_vectors *v, brc_settling *out)
{
    const int64_t n = s->domain->n_elements;
    double norm;
    BRC_TRY(BRC_ALLOCATE(s->context, &out->force, 3 * n, "unbalanced forces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->torque, 3 * n, "unbalanced forces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->place, 3 * n, "unbalanced forces"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->orientation, 4 * n, "unbalanced forces"));
    BRC_TRY(brc_statics_residual(s, v, brc_current_stage(s)->finite_strain && !s->model->statics->linear, &norm));
    BRC_TRY(brc_state_from_rows(s, brc_force_of(s), out->force, 3));
    if (brc_solves_rotations(s->model)) BRC_TRY(brc_state_from_rows(s, brc_torque_of(s), out->torque, 3));
    return read_state(s, out->place, out->orientation);
}

/* Rotation from q to p, small: twice the vector of p q*. */
static double turned(const double *q, const double *p, int c)
{
    const int d = (c + 1) % 3, e = (c + 2) % 3;
    return 2 * (q[0] * p[1 + c] - p[0] * q[1 + c] - p[1 + d] * q[1 + e] + p[1 + e] * q[1 + d]);
}

brc_status brc_settling_end(brc_simulation *s, const brc_settling *from)
{
    const int64_t n = s->domain->n_elements;
    double sum = 0;
    BRC_LOCAL(s->context, 3 * n, double, place, "unbalanced forces");
    BRC_LOCAL(s->context, 4 * n, double, orientation, "unbalanced forces");
    BRC_TRY(read_state(s, place, orientation));
    for (int64_t e = 0; e < n; ++e)
        for (int c = 0; c < 3; ++c)
            sum += from->force[3 * e + c] * (place[3 * e + c] - from->place[3 * e + c]) +
                   from->torque[3 * e + c] * turned(from->orientation + 4 * e, orientation + 4 * e, c);
    if (sum > 0 && !brc_statics_go_on(s))
        s->statics->released += 0.5 * sum;
    else
        brc_statics_change(s, -0.5 * sum);
    return BRC_OK;
}

void brc_settling_free(brc_settling *settling)
{
    brc_memory_free(settling->force);
    brc_memory_free(settling->torque);
    brc_memory_free(settling->place);
    brc_memory_free(settling->orientation);
}
