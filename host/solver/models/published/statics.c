/* Equilibrium of dlsm-published: its rotations. */
#include "published_internal.h"

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

brc_status brc_published_torques(brc_simulation *s, const brc_settle_room *room)
{
    brc_force_request request = {.displacement = brc_displacement_of(s),
                                 .force = room->force,
                                 .orientation = room->orientation,
                                 .torque = room->torque,
                                 .homogeneous = true};
    BRC_TRY(brc_vector_small_rotation(s, room->zero, room->orientation));
    BRC_TRY(brc_force_evaluate(s, &request));
    request.homogeneous = false;
    request.t = brc_loads_time(s);
    BRC_TRY(brc_published_tractions(s, &request));
    return remove_mean(s, room->torque);
}
