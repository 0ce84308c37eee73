/* Elastic equilibrium. dlsm and cbm: preconditioned conjugate gradients on the linearised operator, matrix-free on the
 * device, inside a modified Newton iteration on the full law. dlsm-published has no symmetric operator: restarted GMRES
 * (gmres.c) on its linearisation, then the rotations that balance its torques. */
#include "../../base/random.h"
#include "statics_internal.h"
#include "../effects/fracture/breaking.h"
#include "../effects/loads/loads.h"
#include "multigrid/multigrid.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST_CORRECTIONS = 60 };

/* Elements that a load moves or turns; bodies of beams have no held faces. */
static void note_moved(void *self, const brc_prescribed *one)
{
    *(bool *)self |= one->by_load;
}

/* A body of beams that no load holds: what would move it as a whole cannot be balanced and leaves the residual. Dead
 * loads that balance do so to first order only, since they act where the elements went. More than `rigid_most` of the
 * residual is an error of the scene. */
static brc_status balance_free_body(brc_simulation *s, bool finite)
{
    static const double rigid_most = 1e-3;
    const int64_t n = s->domain->n_elements;
    double rigid, square = 0;
    bool moved = false;
    brc_loads_each_prescribed(s, note_moved, &moved);
    if (moved || !brc_solves_rotations(s->model)) return BRC_OK;
    BRC_LOCAL(s->context, 3 * n, double, place, "balance");
    BRC_LOCAL(s->context, 3 * n, double, torque, "balance");
    BRC_LOCAL(s->context, 3 * n, double, force, "balance");
    if (finite) BRC_TRY(brc_state_from_rows(s, brc_displacement_of(s), place, 3));
    BRC_TRY(brc_state_from_rows(s, brc_torque_of(s), torque, 3));
    BRC_TRY(brc_state_from_rows(s, brc_force_of(s), force, 3));
    for (int64_t k = 0; k < 3 * n; ++k) {
        place[k] += s->domain->position[k];
        square += force[k] * force[k];
    }
    brc_balance(n, place, torque, force, &rigid);
    if (s->statics->report.iterations == 0 && rigid > rigid_most * sqrt(square))
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "stage '%s': nothing holds the body and its loads do not balance: %.3g of them would move or "
                        "turn it as a whole; hold "
                        "some elements, or use a radial element_force",
                        brc_current_stage(s)->name, rigid / sqrt(square));
    return brc_state_to_rows(s, brc_force_of(s), force, 3, 0);
}

brc_status brc_statics_residual(brc_simulation *s, const brc_solve_vectors *v, bool finite, double *norm)
{
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = brc_displacement_of(s),
                                                       .force = brc_force_of(s),
                                                       .orientation = brc_orientation_of(s),
                                                       .torque = brc_torque_of(s),
                                                       .finite = finite,
                                                       .t = brc_loads_time(s)}));
    /* the residual of the free components; reactions of prescribed elements were read just before */
    BRC_TRY(brc_constrain(s, brc_force_of(s), NULL));
    BRC_TRY(balance_free_body(s, finite));
    double square;
    BRC_TRY(brc_statics_square(
        s, v, (brc_unknowns){brc_force_of(s), brc_solves_rotations(s->model) ? brc_torque_of(s) : NULL}, &square));
    *norm = sqrt(square);
    return isfinite(square) ? BRC_OK
                            : BRC_FAIL(s->context, BRC_PHYSICS_STOPPED,
                                       "stage '%s': the static residual is not finite; check that the loads balance or "
                                       "the supports hold the body, "
                                       "or apply the load in more increments",
                                       brc_current_stage(s)->name);
}

/* Small rotations that stand for the orientations of a linear stage: (1, theta/2), and those that its loads turn. */
static brc_status read_theta(brc_simulation *s, brc_solve_vectors *v)
{
    const int64_t n = s->domain->n_elements;
    BRC_LOCAL(s->context, 4 * n, double, q, "orientations");
    BRC_LOCAL(s->context, 3 * n, double, theta, "rotations");
    BRC_TRY(brc_state_from_rows(s, brc_orientation_of(s), q, 4));
    for (int64_t e = 0; e < n; ++e)
        for (int c = 0; c < 3; ++c)
            theta[3 * e + c] = 2 * q[4 * e + 1 + c] / q[4 * e];
    return brc_state_to_rows(s, v->theta, theta, 3, 0);
}

double brc_statics_tolerance(const brc_simulation *s)
{
    static const double by_precision[] = {[BRC_DOUBLE] = 1e-10, [BRC_MIXED] = 1e-6, [BRC_SINGLE] = 1e-5};
    const double asked = brc_current_stage(s)->tolerance, own = by_precision[brc_device_get_precision(s->device)];
    if (asked > 0) return asked;
    return fmax(own, s->model->statics->least_tolerance);
}

int32_t brc_statics_most_iterations(const brc_simulation *s)
{
    const int32_t asked = brc_current_stage(s)->max_iterations;
    return asked > 0 ? asked : 20000 + (int32_t)(200 * cbrt((double)s->domain->n_elements));
}

/* The state takes the correction v->x. */
static brc_status correct(brc_simulation *s, brc_solve_vectors *v, bool finite)
{
    BRC_TRY(brc_unknowns_add(s, 1, v->x, (brc_unknowns){brc_displacement_of(s), v->theta}));
    if (!brc_solves_rotations(s->model)) return BRC_OK;
    if (finite) return brc_vector_turn(s, v->x.turn, brc_orientation_of(s));
    return brc_vector_small_rotation(s, v->theta, brc_orientation_of(s));
}

/* What the last two corrections of the full law left that the linear operator did not foresee, over the residuals they
 * were for [-]. */
typedef struct change_of_law {
    double last, before;
} change_of_law;

/* How much of the residual a correction is solved to: to a third of what the law's change may leave of it; the first
 * one to `at_first`. A correction of what the law itself left may be none of the motion that it changes with, so the
 * one before that counts too, up to `lasting`. (Blocks lose more by beginning anew than this saves.) */
static double worthwhile(int correction, const change_of_law *change)
{
    static const double at_first = 1e-2, lasting = 1e-2;
    if (correction == 0) return at_first;
    return fmin(0.3 * fmax(change->last, fmin(change->before, lasting)), 0.1);
}

/* After a correction for a residual `of` [N], which left v->r of it in the linear operator. */
static brc_status note_change(brc_simulation *s, brc_solve_vectors *v, double of, change_of_law *change)
{
    double square;
    BRC_TRY(brc_unknowns_copy((brc_unknowns){brc_force_of(s), brc_torque_of(s)}, v->kp));
    BRC_TRY(brc_unknowns_add(s, -1, v->r, v->kp));
    BRC_TRY(brc_statics_square(s, v, v->kp, &square));
    *change = (change_of_law){sqrt(square) / of, change->last};
    return BRC_OK;
}

/* What the rounding of the displacements alone may leave of a residual [N]: the force of as much noise as half their
 * last digits, a few times over, since corrections and forces are rounded too. */
static brc_status rounding_of(brc_simulation *s, brc_solve_vectors *v, double *out)
{
    static const double few = 8;
    const int64_t n = 3 * (int64_t)s->layout->n_rows;
    double square;
    BRC_LOCAL(s->context, n, double, u, "rounding");
    BRC_TRY(brc_download(s, brc_displacement_of(s), v->state_bytes, u, n));
    for (int64_t i = 0; i < n; ++i) {
        double draws[4];
        brc_random_uniform4(0, BRC_RANDOM_POWER_ITERATION, (uint64_t)i, 2, draws);
        u[i] *= (draws[0] - 0.5) * (v->state_bytes == 8 ? DBL_EPSILON : FLT_EPSILON);
    }
    BRC_TRY(brc_upload_state(s, v->p.move, u, n));
    if (v->p.turn) BRC_TRY(brc_buffer_fill_zero(v->p.turn));
    BRC_TRY(brc_constrain(s, v->p.move, NULL));
    BRC_TRY(brc_statics_apply(s, v));
    BRC_TRY(brc_statics_square(s, v, v->kp, &square));
    *out = few * sqrt(square);
    return BRC_OK;
}

/* Whether a residual that stands is that. */
static brc_status is_rounding(brc_simulation *s, brc_solve_vectors *v, double norm, double reference, bool *out)
{
    double rounding;
    BRC_TRY(rounding_of(s, v, &rounding));
    *out = norm <= rounding;
    brc_log(s->context, *out ? BRC_LOG_INFO : BRC_LOG_DEBUG,
            "stage '%s': the residual stands at %.3g of the load; rounding of the displacements leaves %.3g",
            brc_current_stage(s)->name, norm / reference, rounding / reference);
    return BRC_OK;
}

/* At least this is the load of a stage [N], whatever its first residual: of a body that has moved before, and may be in
 * equilibrium already, what rounding leaves is within the tolerance. */
static brc_status least_reference(brc_simulation *s, brc_solve_vectors *v, double *out)
{
    double rounding;
    BRC_TRY(rounding_of(s, v, &rounding));
    *out = rounding / brc_statics_tolerance(s);
    return BRC_OK;
}

/* The rotations that balance the torques of the displacements just found, into the orientations. */
static brc_status settle(brc_simulation *s, brc_solve_vectors *v, brc_progress *progress)
{
    const brc_settle_room room = {v->zero, v->orientation, v->z.move, v->r.move};
    double square, left;
    BRC_TRY(s->model->statics->torques(s, &room));
    BRC_TRY(brc_statics_square(s, v, v->r, &square));
    BRC_TRY(brc_conjugate_gradients(s, v, true, 1e-6 * sqrt(square), brc_statics_most_iterations(s), progress, &left));
    return brc_vector_small_rotation(s, v->x.move, brc_orientation_of(s));
}

/* Corrections by the stiffness of the undeformed body come nearer by a constant factor, which is near 1 where slender
 * parts are pressed or turned far (of a column under the share p of Euler's load it is p), and above 1 further on. Then
 * the tangent of the law at the present state takes its place, for the rest of the stage: it costs an evaluation of the
 * full law an iteration. Not near the tolerance, where rounding may be what is left; nor of bodies that supports leave
 * free, whose motions as a whole are those of the undeformed one. */
static bool wants_tangent(const brc_simulation *s, const brc_solve_vectors *v, int correction, double norm, double last)
{
    static const double slow = 0.3;
    return s->model->statics->symmetric && !v->pieces.any && correction > 0 &&
           norm > (correction == 1 ? 1 : slow) * last;
}

static const char *cure_of(const brc_solve_vectors *v)
{
    return v->gives_way ? "the body gives way there (it buckles, or snaps through): use smaller loads, or a dynamic "
                          "stage with `mass_damping`"
                        : "check that the loads balance or the supports hold every motion of the body, use more "
                          "increments, or relax `tolerance`";
}

/* The tangent may lead to a state that balances with cells turned inside out, which no solid is. */
static brc_status refuse_inverted(brc_simulation *s, brc_solve_vectors *v)
{
    const int64_t n = s->domain->n_elements;
    int64_t n_inverted = 0;
    if (!v->tangent || !brc_gradient_of(s)) return BRC_OK;
    BRC_LOCAL(s->context, 9 * n, double, h, "gradients");
    BRC_TRY(brc_coeff_from_rows(s, brc_gradient_of(s), h, 9));
    for (int64_t e = 0; e < n; ++e) {
        double *f = h + 9 * e;
        f[0] += 1, f[4] += 1, f[8] += 1;
        const double volume = f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
                              f[2] * (f[3] * f[7] - f[4] * f[6]);
        n_inverted += !(volume > 0);
    }
    if (n_inverted == 0) return BRC_OK;
    v->gives_way = true;
    return BRC_FAIL(s->context, BRC_PHYSICS_STOPPED,
                    "stage '%s': at load factor %.4g %lld cells are turned inside out; %s", brc_current_stage(s)->name,
                    brc_loads_time(s), (long long)n_inverted, cure_of(v));
}

static brc_status solve_increment(brc_simulation *s, brc_solve_vectors *v, double *reference, brc_progress *progress)
{
    const brc_stage *stage = brc_current_stage(s);
    static const double of_tangent = 1e-3;       /* what a correction by the tangent leaves of a residual */
    static const double most_of_rounding = 1e-6; /* of the load; what is worse is no equilibrium, whatever the reason */
    const double tolerance = brc_statics_tolerance(s);
    const brc_model_statics *by = s->model->statics;
    const bool finite = stage->finite_strain && !by->linear;
    const bool coarse = brc_device_get_precision(s->device) != BRC_DOUBLE;
    change_of_law change = {0};
    int since = 0; /* the correction that was the first by the present operator */
    double norm, left,
        last = INFINITY,
        earlier = INFINITY; /* slender beams: stretch and bending settle in turn, so two corrections count */
    v->gives_way = false;
    BRC_TRY(brc_statics_residual(s, v, finite, &norm));
    if (*reference == 0 && norm > 0) BRC_TRY(least_reference(s, v, reference));
    if (norm > *reference) *reference = norm;
    if (s->statics->n_known > 0 && !finite && brc_solves_rotations(s->model)) {
        BRC_TRY(brc_statics_mix_known(s, v));
        BRC_TRY(correct(s, v, false));
        BRC_TRY(brc_statics_residual(s, v, false, &norm));
    }
    for (int correction = 0; norm > tolerance * *reference; ++correction) {
        const bool near = norm < 100 * tolerance * *reference;
        if (finite && !near && !v->tangent && wants_tangent(s, v, correction, norm, last)) {
            brc_log(s->context, BRC_LOG_DEBUG, "stage '%s': from correction %d on by the tangent of the law",
                    stage->name, correction + 1);
            v->tangent = true;
            since = correction;
        }
        if (correction == MOST_CORRECTIONS ||
            (correction > (v->tangent ? 8 : 2) + since && norm > 0.9 * last && norm > 0.9 * earlier)) {
            bool done = coarse && near; /* the precision's own floor */
            if (!done && norm < most_of_rounding * *reference) BRC_TRY(is_rounding(s, v, norm, *reference, &done));
            if (done) break;
            if (near && !v->preconditioner.multigrid) { /* balance all the same, and the report says how good */
                brc_log(s->context, BRC_LOG_WARNING,
                        "stage '%s': the residual stands at %.3g of the load, asked %.3g: relax `tolerance`, or hold "
                        "what moves freely",
                        stage->name, norm / *reference, tolerance);
                break;
            }
            s->statics->report.residual = norm / *reference;
            if (!near)
                return BRC_FAIL(s->context, BRC_PHYSICS_STOPPED,
                                "stage '%s': no equilibrium at load factor %.4g: residual %.3g of the load after %d "
                                "corrections, asked %.3g; %s",
                                stage->name, brc_loads_time(s), norm / *reference, correction, tolerance, cure_of(v));
            brc_preconditioner_give_up(s, v);
            last = norm = INFINITY;
        }
        earlier = last;
        last = norm;
        BRC_TRY(brc_unknowns_copy((brc_unknowns){brc_force_of(s), brc_torque_of(s)}, v->r));
        /* the right side without what the supports leave free: a stiffness about the reference cannot take it, and of a
         * residual about the moved sample a part as large as its strain is left in it, on which conjugate gradients
         * would break down */
        if (by->symmetric) BRC_TRY(brc_statics_project_free_motions(s, v, v->r));
        const int32_t most = brc_statics_most_iterations(s);
        BRC_TRY(brc_preconditioner_prepare(s, v));
        const double worth = v->tangent                              ? of_tangent
                             : finite && v->preconditioner.multigrid ? worthwhile(correction, &change)
                                                                     : 0,
                     target = fmax(0.3 * tolerance * *reference, worth * norm);
        BRC_TRY(by->symmetric ? brc_conjugate_gradients(s, v, false, target, most, progress, &left)
                              : brc_gmres(s, v, target, most, progress, &left));
        BRC_TRY(correct(s, v, finite));
        BRC_TRY(brc_statics_residual(s, v, finite, &norm));
        if (finite && v->preconditioner.multigrid && !v->tangent) BRC_TRY(note_change(s, v, last, &change));
        s->statics->report.corrections += 1;
        if (brc_simulation_stopped_early(s)) break;
    }
    s->statics->report.residual = *reference > 0 ? norm / *reference : 0;
    BRC_TRY(refuse_inverted(s, v));
    return by->torques ? settle(s, v, progress) : BRC_OK;
}

brc_status brc_statics_scale(brc_simulation *s, brc_solve_vectors *v, double factor)
{
    const int64_t n = s->domain->n_elements;
    const bool finite = brc_current_stage(s)->finite_strain;
    if (factor == 0) { /* also of a state that is not finite */
        BRC_TRY(brc_buffer_fill_zero(brc_displacement_of(s)));
        return s->model->turns ? brc_vector_small_rotation(s, brc_displacement_of(s), brc_orientation_of(s)) : BRC_OK;
    }
    BRC_TRY(brc_buffer_copy(v->z.move, brc_displacement_of(s), 3 * (int64_t)s->layout->n_rows * v->state_bytes));
    BRC_TRY(
        brc_unknowns_add(s, factor - 1, (brc_unknowns){v->z.move, NULL}, (brc_unknowns){brc_displacement_of(s), NULL}));
    if (!s->model->turns) return BRC_OK;
    BRC_LOCAL(s->context, 4 * n, double, q, "orientations");
    BRC_TRY(brc_state_from_rows(s, brc_orientation_of(s), q, 4));
    for (int64_t e = 0; e < n; ++e) {
        double square = 1;
        for (int c = 1; c < 4; ++c) {
            q[4 * e + c] *= factor / q[4 * e];
            square += q[4 * e + c] * q[4 * e + c];
        }
        q[4 * e] = 1;
        for (int c = 0; finite && c < 4; ++c)
            q[4 * e + c] /= sqrt(square);
    }
    BRC_TRY(brc_state_to_rows(s, brc_orientation_of(s), q, 4,
                              0.5)); /* rows of padding: some unit quaternion, none of length 0 */
    return BRC_OK;
}

/* No table, or the one that stands for none: the fraction of the load itself. */
static bool is_proportional(const brc_table *t)
{
    return t->n == 0 || (t->n == 2 && t->time[0] == 0 && t->value[0] == 0 && t->time[1] == 1 && t->value[1] == 1);
}

brc_status brc_statics_solve_at(brc_simulation *s, brc_static_run *run, brc_progress *progress)
{
    BRC_TRY(brc_loads_prescribe(s, brc_loads_time(s)));
    if (brc_solves_rotations(s->model)) BRC_TRY(read_theta(s, &run->vectors));
    BRC_TRY(solve_increment(s, &run->vectors, &run->reference, progress));
    return brc_force_of_state(s, BRC_BOOK_WORK);
}

brc_status brc_statics_failure(int32_t n, brc_simulation *const *part, double *ratio)
{
    *ratio = 0;
    for (int32_t k = 0; k < n; ++k) {
        double one;
        BRC_TRY(brc_simulation_failure_ratio(part[k], &one));
        *ratio = isfinite(*ratio) && isfinite(one) ? fmax(*ratio, one) : NAN;
    }
    return BRC_OK;
}

brc_status brc_statics_refuse_unscalable(int32_t n, brc_simulation *const *part, const char *key)
{
    brc_context *context = part[0]->context;
    const brc_stage *stage = brc_current_stage(part[0]);
    if (!part[0]->fracture)
        return BRC_FAIL(context, BRC_BAD_INPUT, "stage '%s': %s needs `fracture` and strengths in the scene",
                        stage->name, key);
    for (int32_t k = 0; k < n; ++k)
        for (int32_t l = 0; l < brc_current_stage(part[k])->n_loads; ++l)
            if (!is_proportional(&brc_current_stage(part[k])->loads[l].table))
                return BRC_FAIL(context, BRC_BAD_INPUT,
                                "stage '%s': %s scales its loads, so they cannot follow a table; remove the table",
                                stage->name, key);
    return BRC_OK;
}
