/* The time step: 2 / omega_max by power iteration of M^-1 K with the scene's own force kernels (docs/notebook/theory.md
 * T5), or as given, or the papers' rule. */
#include "../../base/random.h"
#include "../../base/ranks.h"
#include "run_internal.h"
#include <math.h>

enum { MOST_ITERATIONS = 2000, WATCH = 20 };
/* The Rayleigh quotient of the power iteration approaches omega_max^2 from below. It is stopped when WATCH iterations
 * change it by less than `settled`; what is then still missing was at most 1.5 % of omega on grids of spread 0 to 100 %
 * (tests/solver/test_time_step.c holds it against a long iteration), so omega is multiplied by `margin`. */
static const double settled = 2e-3, margin = 1.02;

/* AGH19 eq. 39 and 40: min over bonds of 1/3 sqrt(m L0 / (E S)). */
static brc_status published_rule(const brc_simulation *s, double *out)
{
    const brc_domain *d = s->domain;
    double smallest = INFINITY;
    *out = 0;
    if (brc_has_spheres(s)) return BRC_OK;
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int64_t h = d->bond_half_edge[b];
        const int64_t j = d->neighbour[h], i = d->neighbour[d->twin[h]];
        double length = 0, area = 0;
        if (!brc_domain_has(d, i)) continue;
        for (int c = 0; c < 3; ++c) {
            const double r = d->position[3 * j + c] - d->position[3 * i + c];
            length += r * r;
            area += d->area_vector[3 * h + c] * d->area_vector[3 * h + c];
        }
        const brc_elastic *mi = s->elastic + s->material_of_element[i], *mj = s->elastic + s->material_of_element[j];
        const double a = d->volume[i] * mi->density, b_mass = d->volume[j] * mj->density;
        const double young = fmax(mi->young, mj->young);
        const double step = sqrt(a * b_mass / (a + b_mass) * sqrt(length) / (young * sqrt(area))) / 3;
        if (step < smallest) smallest = step;
    }
    if (d->here) BRC_TRY(brc_ranks_least(s->context, 1, &smallest));
    if (isfinite(smallest)) *out = smallest;
    return BRC_OK;
}

/* Scratch of the iteration: displacement-like and rotation-like vectors. */
typedef struct work_vectors {
    brc_buffer *x, *y, *theta, *orientation, *torque;
} work_vectors;

BRC_WANTED(dynamics, brc_wants_solver(w, BRC_SOLVER_DYNAMIC))

#define AT(member) BRC_FIELD_AT(work_vectors, member)
static const brc_field_row rows[] = {
    {"displacement", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(x), "power iteration", "-", BRC_NOT_KEPT},
    {"force", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(y), "power iteration", "-", BRC_NOT_KEPT},
    BRC_FIELD(theta, brc_each_row, 3, STATE, brc_wants_turning, "power iteration", "-"),
    BRC_FIELD(orientation, brc_each_row, 4, STATE, brc_wants_turning, "power iteration", "-"),
    BRC_FIELD(torque, brc_each_row, 3, STATE, brc_wants_turning, "power iteration", "-"),
};
BRC_FIELD_TABLE(brc_power_fields, "search for the time step", BRC_LIFE_SOLVE, dynamics, rows);

static brc_status random_vector(brc_simulation *s, brc_buffer *out, uint64_t which, double scale)
{
    const int64_t n = s->domain->n_elements;
    BRC_LOCAL(s->context, 3 * n, double, values, "power iteration");
    for (int64_t e = 0; e < n; ++e) {
        double draws[4];
        brc_random_uniform4(1, BRC_RANDOM_POWER_ITERATION, (uint64_t)e, which, draws);
        for (int c = 0; c < 3; ++c)
            values[3 * e + c] = scale * (2 * draws[c] - 1);
    }
    return brc_state_to_rows(s, out, values, 3, 0);
}

/* One application: y = M^-1 K x (rotations likewise); *square: x.Mx, *rayleigh: x.Kx / x.Mx. x is scaled to y after. */
static brc_status apply(brc_simulation *s, work_vectors *w, double *rayleigh)
{
    const int32_t n = s->layout->n_rows;
    const bool turns = s->model->turns;
    double mass_norm = 0, part, energy = 0;
    if (turns) BRC_TRY(brc_vector_small_rotation(s, w->theta, w->orientation));
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = w->x,
                                                       .force = w->y,
                                                       .orientation = w->orientation,
                                                       .torque = w->torque,
                                                       .homogeneous = true}));
    BRC_TRY(brc_vector_dot(s, w->x, w->y, 3 * (int64_t)n, &part));
    energy -= part;
    BRC_TRY(BRC_RUN(s->run->pass.kinetic_energy, n, {"velocity", BRC_BUF(w->x)}));
    if (turns) {
        BRC_TRY(brc_vector_dot(s, w->theta, w->torque, 3 * (int64_t)n, &part));
        energy -= part;
        BRC_TRY(BRC_RUN(s->run->pass.add_spin_energy, n, {"spin", BRC_BUF(w->theta)}));
    }
    BRC_TRY(brc_vector_sum(s, brc_kinetic_of(s), n, &mass_norm));
    mass_norm *= 2;
    if (!(mass_norm > 0) || !isfinite(energy))
        return BRC_FAIL(s->context, BRC_PHYSICS_STOPPED,
                        "the power iteration for the time step met x.Mx = %g, x.Kx = %g; %s", mass_norm, energy,
                        "check densities and the geometry (breccia build prints its quality)");
    *rayleigh = energy / mass_norm;
    BRC_TRY(BRC_RUN(s->run->pass.divide_by_mass, n, {"mass", BRC_BUF(brc_mass_of(s))}, {"vector", BRC_BUF(w->y)}));
    /* x = y / |y| in size: scale by 1 / (rayleigh * sqrt(mass_norm)), which keeps x.Mx near 1 */
    const double scale = *rayleigh != 0 ? 1 / (fabs(*rayleigh) * sqrt(mass_norm)) : 1;
    BRC_TRY(brc_buffer_fill_zero(w->x));
    BRC_TRY(brc_vector_axpy(s, 3 * (int64_t)n, -scale, w->y, w->x));
    if (turns) {
        BRC_TRY(BRC_RUN(s->run->pass.divide_by_mass, n, {"mass", BRC_BUF(brc_inertia_of(s))},
                        {"vector", BRC_BUF(w->torque)}));
        BRC_TRY(brc_buffer_fill_zero(w->theta));
        BRC_TRY(brc_vector_axpy(s, 3 * (int64_t)n, -scale, w->torque, w->theta));
    }
    return BRC_OK;
}

static brc_status critical_step(brc_simulation *s, double *out)
{
    work_vectors w = {0};
    brc_status status = BRC_OK;
    double rayleigh = 0, seen = 0, before = 0;
    BRC_TRY_OR(cleanup, brc_fields_create(s->device, &brc_power_fields, &s->wants, &w));
    const double size = cbrt(s->domain->volume[0]);
    BRC_TRY_OR(cleanup, random_vector(s, w.x, 0, size));
    BRC_TRY_OR(cleanup, brc_constrain(s, w.x, NULL));
    if (s->model->turns) {
        BRC_TRY_OR(cleanup, random_vector(s, w.theta, 1, 1));
        BRC_TRY_OR(cleanup, brc_constrain(s, NULL, w.theta));
    }
    for (int i = 1; i <= MOST_ITERATIONS; ++i) {
        BRC_TRY_OR(cleanup, apply(s, &w, &rayleigh));
        if (fabs(rayleigh) > seen) seen = fabs(rayleigh);
        if (!(seen > 0)) break; /* no bond holds anything: contact alone limits the step */
        if (i % WATCH) continue;
        if (fabs(seen - before) < settled * seen) break;
        before = seen;
    }
    *out = seen > 0 ? 2 / (margin * sqrt(seen)) : INFINITY;
cleanup:
    brc_fields_free(&brc_power_fields, &w);
    return status;
}

brc_status brc_time_step_find(brc_simulation *s, const brc_stage *stage, brc_time_step *out)
{
    *out = (brc_time_step){.value = 0};
    BRC_TRY(published_rule(s, &out->published));
    switch (stage->time_step_rule) {
    case BRC_TIME_STEP_FIXED:
        out->value = stage->time_step;
        out->governed_by = "fixed";
        break;
    case BRC_TIME_STEP_PUBLISHED:
        if (brc_has_spheres(s))
            return BRC_FAIL(s->context, BRC_BAD_INPUT,
                            "stage '%s': the published rule for the time step is one for cells, model %s has none; use "
                            "time_step: auto",
                            stage->name, brc_model_name(s->scene->model.kind));
        out->value = out->published;
        out->governed_by = "published: AGH19 eq. 39";
        break;
    default: out->governed_by = "auto: power iteration";
    }
    const brc_model_step_bound *bound = s->model->step_bound;
    if (bound && stage->time_step_rule == BRC_TIME_STEP_AUTO) { /* rigorous, so no margin of its own is needed */
        BRC_TRY(bound->find(s, &out->critical));
        out->governed_by = bound->name;
    } else {
        BRC_TRY(critical_step(s, &out->critical));
    }
    double beside[BRC_MOST_EFFECTS];
    for (int k = 0; brc_effect_at(s, k); ++k) {
        const brc_effect_step_bound *other = brc_effect_at(s, k)->step_bound;
        beside[k] = INFINITY;
        if (other) BRC_TRY(other->find(s, &beside[k]));
        if (!isfinite(beside[k])) continue; /* squares of frequencies of two springs on one mass add at most */
        if (stage->time_step_rule == BRC_TIME_STEP_AUTO)
            out->governed_by = beside[k] < out->critical ? other->alone
                               : bound                   ? bound->with_contact
                                                         : other->with_power;
        out->critical = 1 / sqrt(1 / (out->critical * out->critical) + 1 / (beside[k] * beside[k]));
    }
    /* Tchamwa-Wielgosz is stable for w dt <= 2 / sqrt(2 phi - 1) */
    if (stage->integrator == BRC_TCHAMWA_WIELGOSZ && stage->phi > 0.5) out->critical /= sqrt(2 * stage->phi - 1);
    if (stage->time_step_rule == BRC_TIME_STEP_AUTO) {
        if (!isfinite(out->critical))
            return BRC_FAIL(s->context, BRC_BAD_INPUT,
                            "stage '%s': nothing moves (every element is imposed); give a time step", stage->name);
        out->value = stage->safety * out->critical;
    }
    out->safety = out->value / out->critical;
    for (int k = 0; brc_effect_at(s, k); ++k)
        if (brc_effect_at(s, k)->step_bound) brc_effect_at(s, k)->step_bound->check(s, stage->name, beside[k], out);
    if (out->safety > 1)
        brc_log(s->context, BRC_LOG_WARNING,
                "stage '%s': the time step %.4g s is %.3g times the critical one; expect it to diverge", stage->name,
                out->value, out->safety);
    return BRC_OK;
}
