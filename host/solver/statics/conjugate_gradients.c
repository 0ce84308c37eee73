/* Preconditioned conjugate gradients on the linearised operator, or on the tangent of the full law where the state is,
 * matrix-free on the device. */
#include "statics_internal.h"
#include <float.h>
#include <math.h>

/* kp = -K p. Displacements: the force of the linearised law. Rotations (dlsm-published, whose forces do not depend on
 * them to first order): the torque of rotation vectors p at zero displacement. */
static brc_status apply(brc_simulation *s, brc_solve_vectors *v, bool rotations)
{
    brc_force_request r = {.displacement = v->p.move,
                           .force = v->kp.move,
                           .orientation = v->orientation,
                           .torque = v->kp.turn ? v->kp.turn : v->z.move,
                           .homogeneous = true};
    if (!s->model->turns) return brc_force_evaluate(s, &r);
    brc_buffer *theta = v->p.turn ? v->p.turn : rotations ? v->p.move : v->zero;
    BRC_TRY(brc_vector_small_rotation(s, theta, v->orientation));
    if (rotations) r.displacement = v->zero, r.force = v->z.move, r.torque = v->kp.move;
    return brc_force_evaluate(s, &r);
}

brc_status brc_statics_apply(brc_simulation *s, brc_solve_vectors *v)
{
    return apply(s, v, false);
}

/* kp = (f(u + h p) - f(u)) = -h K p of the full law about the present state u, whose force is in the simulation's own
 * array: *per is 1/h. h p is a small share of u: the force is rounded to eps of what u pulls with, and the law bends by
 * about the share. */
static brc_status apply_tangent(brc_simulation *s, brc_solve_vectors *v, double *per)
{
    const double share = brc_device_get_precision(s->device) == BRC_DOUBLE ? 1e-6 : 1e-3;
    const brc_unknowns state = {brc_displacement_of(s), NULL}, kept = {v->z.move, NULL}, way = {v->p.move, NULL};
    double uu, pp;
    BRC_TRY(brc_unknowns_dot(s, state, state, 1, &uu));
    BRC_TRY(brc_unknowns_dot(s, way, way, 1, &pp));
    const double h = pp > 0 && uu > 0 ? share * sqrt(uu / pp) : share;
    if (v->p.turn) {
        BRC_TRY(brc_buffer_fill_zero(v->z.turn));
        BRC_TRY(brc_vector_axpy(s, 3 * s->layout->n_rows, h, v->p.turn, v->z.turn));
        BRC_TRY(brc_buffer_copy(v->orientation, brc_orientation_of(s), brc_buffer_bytes(v->orientation)));
        BRC_TRY(brc_vector_turn(s, v->z.turn, v->orientation));
    }
    BRC_TRY(brc_unknowns_copy(state, kept));
    BRC_TRY(brc_unknowns_add(s, h, way, state));
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = state.move,
                                                       .force = v->kp.move,
                                                       .orientation = v->orientation,
                                                       .torque = v->kp.turn,
                                                       .finite = true,
                                                       .t = brc_loads_time(s)}));
    BRC_TRY(brc_unknowns_copy(kept, state));
    BRC_TRY(brc_constrain(s, v->kp.move, v->kp.turn));
    *per = 1 / h;
    return brc_unknowns_add(s, -1, (brc_unknowns){brc_force_of(s), brc_torque_of(s)}, v->kp);
}

/* The direction of steepest descent, to begin or begin again. */
static brc_status begin(brc_simulation *s, brc_solve_vectors *v, bool rotations, double *rz)
{
    BRC_TRY(brc_preconditioner_apply(s, v, rotations));
    BRC_TRY(brc_unknowns_copy(v->z, v->p));
    return brc_unknowns_dot(s, v->r, v->z, 1, rz);
}

/* A preconditioner puts rigid motions that the supports leave free into x, which K does not see, and by which dead
 * loads would no longer balance: they are taken off. */
static brc_status remove_free_motions(brc_simulation *s, brc_solve_vectors *v)
{
    if (!v->pieces.any) return BRC_OK;
    return brc_statics_project_free_motions(s, v, v->x);
}

/* Rigid motions that the supports leave free are in the null space of K; when the loads do not balance, the residual
 * stalls and the sentence says so. */
brc_status brc_conjugate_gradients(brc_simulation *s, brc_solve_vectors *v, bool rotations, double target, int32_t most,
                                   brc_progress *progress, double *left)
{
    const int64_t before = s->statics->report.iterations;
    double rz, rr, pkp, first, best = INFINITY;
    int64_t since_best = 0;
    BRC_TRY(brc_buffer_fill_zero(v->x.move));
    if (v->x.turn) BRC_TRY(brc_buffer_fill_zero(v->x.turn));
    BRC_TRY(begin(s, v, rotations, &rz));
    BRC_TRY(brc_statics_square(s, v, v->r, &rr));
    first = sqrt(rr);
    for (int32_t i = 0; i < most && sqrt(rr) > target; ++i) {
        if (!(rz > 0) && v->preconditioner.multigrid && !rotations) { /* it must be positive */
            brc_preconditioner_give_up(s, v);
            BRC_TRY(begin(s, v, rotations, &rz));
        }
        double per = 1;
        BRC_TRY(v->tangent && !rotations ? apply_tangent(s, v, &per) : apply(s, v, rotations));
        BRC_TRY(brc_unknowns_dot(s, v->p, v->kp, 1, &pkp));
        pkp *= -per;      /* the force is minus K p */
        if (!(pkp > 0)) { /* only rounding and rigid motions are left, or the body gives way */
            v->gives_way |= v->tangent;
            break;
        }
        const double alpha = rz / pkp;
        BRC_TRY(brc_unknowns_add(s, alpha, v->p, v->x));
        BRC_TRY(brc_unknowns_add(s, alpha * per, v->kp, v->r));
        BRC_TRY(brc_preconditioner_apply(s, v, rotations));
        double next;
        BRC_TRY(brc_unknowns_dot(s, v->r, v->z, 1, &next));
        BRC_TRY(brc_statics_square(s, v, v->r, &rr));
        BRC_TRY(brc_unknowns_scale_add(s, v->z, next / rz, v->p));
        rz = next;
        s->statics->report.iterations += 1;
        brc_progress_update(progress, s->statics->report.iterations);
        if (brc_simulation_is_to_stop(s))
            return BRC_FAIL(s->context, BRC_INTERRUPTED, "interrupted in the static solver");
        if (brc_trial_is_over(s)) break;
        if (rr < 0.99 * best)
            best = rr, since_best = 0;
        else if (++since_best > 2000)
            break; /* rounding floor: no more to gain */
    }
    *left = sqrt(rr);
    if (rotations) return BRC_OK;
    brc_preconditioner_took(v, s->statics->report.iterations - before, first, *left);
    return remove_free_motions(s, v);
}
