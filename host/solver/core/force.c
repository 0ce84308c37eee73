/* One evaluation of all forces: those of the model's bonds, then what effects add, in the order of
 * their hook. */
#include "core_internal.h"

brc_status brc_force_evaluate(brc_simulation *s, const brc_force_request *r)
{
    BRC_TRY(s->model->evaluate(s, r));
    if (r->homogeneous) return brc_constrain(s, r->force, r->torque);
    BRC_TRY(brc_hook_run(s, BRC_HOOK_FORCE, &(brc_occasion){.request = r}));
    if (s->model->late_tractions) BRC_TRY(s->model->late_tractions(s, r));
    brc_force_request all = *r;
    if (r->rings && !r->rings->whole_force) { /* from here on forces are those of the whole body */
        BRC_TRY(s->model->breaking->replace_around(s, r->rings));
        all.force = brc_force_of(s), all.torque = brc_torque_of(s);
        r = &all;
    }
    return brc_hook_run(s, BRC_HOOK_BOOK, &(brc_occasion){.request = r});
}

void brc_force_take_law(brc_simulation *s, const brc_stage *stage)
{
    const bool linear = stage->solver == BRC_SOLVER_STATIC && !stage->finite_strain;
    s->core->constant.finite = !s->scene->model.small_rotations && !linear;
}

bool brc_force_is_finite(const brc_simulation *s)
{
    return s->core->constant.finite;
}

brc_force_request brc_force_request_of_state(brc_simulation *s, brc_booking book)
{
    return (brc_force_request){.displacement = brc_displacement_of(s),
                               .force = brc_force_of(s),
                               .orientation = brc_orientation_of(s),
                               .torque = brc_torque_of(s),
                               .finite = s->core->constant.finite,
                               .book = book,
                               .t = brc_loads_time(s)};
}

brc_status brc_force_of_state(brc_simulation *s, brc_booking book)
{
    const brc_force_request request = brc_force_request_of_state(s, book);
    return brc_force_evaluate(s, &request);
}

brc_status brc_force_around_breaks(brc_simulation *s, const brc_rings *rings)
{
    brc_force_request request = brc_force_request_of_state(s, BRC_BOOK_START);
    request.rings = rings;
    if (!rings->whole_force) request.force = rings->force, request.torque = rings->torque;
    return brc_force_evaluate(s, &request);
}

brc_status brc_force_energies(brc_simulation *s, double *elastic, double *stabilisation)
{
    *stabilisation = 0;
    return s->model->energies(s, elastic, stabilisation);
}

brc_status brc_force_refresh(brc_simulation *s)
{
    return brc_effects_follow_surfaces(s) && s->model->refresh ? s->model->refresh(s) : BRC_OK;
}
