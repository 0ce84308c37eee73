/* Equilibrium of dlsm-published: its rotations. */
#include "../../statics/statics.h"
#include "published.h"
#include <math.h>

/* Take the mean torque off: turning every element alike costs nothing, so only the rest can be balanced. */
static brc_status remove_mean(brc_simulation *s, brc_buffer *torque)
{
    const int64_t n = s->domain->n_elements;
    double *t = NULL, mean[3] = {0, 0, 0};
    BRC_TRY(BRC_ALLOCATE(s->context, &t, 3 * n, "torques"));
    brc_status status = brc_state_from_rows(s, torque, t, 3);
    for (int64_t i = 0; i < 3 * n; ++i)
        mean[i % 3] += t[i] / (double)n;
    for (int64_t i = 0; i < 3 * n; ++i)
        t[i] -= mean[i % 3];
    if (status == BRC_OK) status = brc_state_to_rows(s, torque, t, 3, 0);
    brc_memory_free(t);
    return status;
}

brc_status brc_published_settle(brc_simulation *s, brc_solve_vectors *v, brc_progress *progress)
{
    double square, left;
    BRC_TRY(brc_vector_small_rotation(s, v->zero, v->orientation));
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = s->displacement,
                                                       .force = v->z.move,
                                                       .orientation = v->orientation,
                                                       .torque = v->r.move,
                                                       .homogeneous = true}));
    BRC_TRY(brc_published_tractions(s, &(brc_force_request){.displacement = s->displacement,
                                                            .force = v->z.move,
                                                            .orientation = v->orientation,
                                                            .torque = v->r.move,
                                                            .t = s->load_factor}));
    BRC_TRY(remove_mean(s, v->r.move));
    BRC_TRY(brc_statics_square(s, v, v->r, &square));
    BRC_TRY(brc_conjugate_gradients(s, v, true, 1e-6 * sqrt(square), brc_statics_most_iterations(s), progress, &left));
    return brc_vector_small_rotation(s, v->x.move, s->orientation);
}
