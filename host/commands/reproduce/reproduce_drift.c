/* What must not change along an undamped free run: energy, momentum, angular momentum. */
#include "operators.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

typedef struct drift {
    brc_context *context;
    int64_t n_samples, capacity;
    double *total; /* [n_samples] total energy [J] */
    double closure_worst, closure_squares;
    double growth; /* largest energy over what initial fields and loads had put in by then [-] */
    double *mass, *displacement, *velocity; /* [n_elements], [n_elements][3] twice */
    double *inertia, *orientation,
        *spin;   /* elements with rotations: [n_elements], [n_elements][4], [n_elements][3]; else NULL */
    double lean; /* least cosine between a beam and a section's normal at its ends */
    double momentum[3], angular[3];       /* at the first sample */
    double momentum_scale, angular_scale; /* largest sums of magnitudes of the parts */
    double momentum_worst, angular_worst; /* largest deviations [kg m/s], [kg m^2/s] */
} drift;

static brc_status create(brc_context *context, void **out)
{
    drift *d = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &d, 1, "drift of a run"));
    d->context = context;
    d->lean = 1;
    *out = d;
    return BRC_OK;
}

static void release(void *self)
{
    drift *d = self;
    if (!d) return;
    brc_memory_free(d->total);
    brc_memory_free(d->mass);
    brc_memory_free(d->displacement);
    brc_memory_free(d->velocity);
    brc_memory_free(d->inertia);
    brc_memory_free(d->orientation);
    brc_memory_free(d->spin);
    brc_memory_free(d);
}

static brc_status prepare(drift *d, brc_simulation *simulation)
{
    const brc_domain *domain = brc_simulation_domain(simulation);
    const brc_scene *scene = brc_simulation_scene(simulation);
    BRC_TRY(BRC_ALLOCATE(d->context, &d->mass, domain->n_elements, "masses of the drift"));
    BRC_TRY(BRC_ALLOCATE(d->context, &d->displacement, 3 * domain->n_elements, "displacements of the drift"));
    BRC_TRY(BRC_ALLOCATE(d->context, &d->velocity, 3 * domain->n_elements, "velocities of the drift"));
    const bool turns = !brc_model_traits_of(scene->model.kind)->deforms;
    if (turns) BRC_TRY(BRC_ALLOCATE(d->context, &d->inertia, domain->n_elements, "inertia of the drift"));
    if (turns) BRC_TRY(BRC_ALLOCATE(d->context, &d->orientation, 4 * domain->n_elements, "orientations of the drift"));
    if (turns) BRC_TRY(BRC_ALLOCATE(d->context, &d->spin, 3 * domain->n_elements, "spins of the drift"));
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const brc_body *body = &scene->bodies[domain->body[e]];
        const int32_t material = brc_body_material(body, domain->region[e]);
        d->mass[e] = domain->volume[e] * scene->materials[material].density;
        const double *moment = domain->inertia + 6 * e;
        if (turns) d->inertia[e] = scene->materials[material].density * (moment[0] + moment[1] + moment[2]) / 3;
    }
    return BRC_OK;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; ++k)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double length(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* Momenta about the origin of coordinates, and the sums of the magnitudes of their parts. */
static void add_momenta(const drift *d, const brc_domain *domain, double momentum[3], double angular[3],
                        double scale[2])
{
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        double place[3], turn[3];
        const double *v = d->velocity + 3 * e;
        for (int k = 0; k < 3; ++k)
            place[k] = domain->position[3 * e + k] + d->displacement[3 * e + k];
        cross(place, v, turn);
        for (int k = 0; k < 3; ++k) {
            momentum[k] += d->mass[e] * v[k];
            angular[k] += d->mass[e] * turn[k];
        }
        scale[0] += d->mass[e] * length(v);
        scale[1] += d->mass[e] * length(turn);
        for (int k = 0; d->spin && k < 3; ++k)
            angular[k] += d->inertia[e] * d->spin[3 * e + k];
        if (d->spin) scale[1] += d->inertia[e] * length(d->spin + 3 * e);
    }
}

/* How far sections lean from their beams now: both ends of every beam. */
static void look_at_sections(drift *d, const brc_domain *domain)
{
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const double w = d->orientation[4 * e], *v = d->orientation + 4 * e + 1;
        for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h) {
            const int64_t j = domain->neighbour[h];
            double axis[3], now[3], once[3], twice[3], along = 0;
            for (int k = 0; k < 3; ++k) {
                axis[k] = domain->position[3 * j + k] - domain->position[3 * e + k];
                now[k] = axis[k] + d->displacement[3 * j + k] - d->displacement[3 * e + k];
            }
            cross(v, axis, once);
            cross(v, once, twice);
            for (int k = 0; k < 3; ++k)
                along += now[k] * (axis[k] + 2 * (w * once[k] + twice[k]));
            d->lean = fmin(d->lean, along / (length(axis) * length(now)));
        }
    }
}

static brc_status sample(void *self, brc_simulation *simulation)
{
    drift *d = self;
    const brc_domain *domain = brc_simulation_domain(simulation);
    const brc_stage *stage = brc_simulation_scene(simulation)->stages + brc_simulation_stage(simulation);
    if (stage->solver != BRC_SOLVER_DYNAMIC)
        return BRC_OK; /* static stages put energy in; what may not drift is the motion after */
    if (!d->mass) BRC_TRY(prepare(d, simulation));
    if (d->n_samples == d->capacity) {
        d->capacity = d->capacity ? 2 * d->capacity : 1024;
        BRC_TRY(
            brc_memory_resize(d->context, (void **)&d->total, d->capacity, sizeof *d->total, "energies of the drift"));
    }
    brc_ledger ledger;
    BRC_TRY(brc_simulation_ledger(simulation, &ledger));
    d->total[d->n_samples] = ledger.total;
    d->closure_worst = fmax(d->closure_worst, fabs(ledger.closure));
    const double put_in = fabs(ledger.initial) + fabs(ledger.work);
    if (put_in > 0) d->growth = fmax(d->growth, ledger.total / put_in);
    d->closure_squares += ledger.closure * ledger.closure;
    BRC_TRY(brc_simulation_displacement(simulation, d->displacement));
    BRC_TRY(brc_simulation_velocity(simulation, d->velocity));
    if (d->spin) BRC_TRY(brc_simulation_orientation(simulation, d->orientation, d->spin));
    if (d->spin && domain->radius) look_at_sections(d, domain);
    double momentum[3] = {0}, angular[3] = {0}, scale[2] = {0}, off[3], turn_off[3];
    add_momenta(d, domain, momentum, angular, scale);
    if (d->n_samples++ == 0) {
        memcpy(d->momentum, momentum, sizeof momentum);
        memcpy(d->angular, angular, sizeof angular);
    }
    d->momentum_scale = fmax(d->momentum_scale, scale[0]);
    d->angular_scale = fmax(d->angular_scale, scale[1]);
    for (int k = 0; k < 3; ++k) {
        off[k] = momentum[k] - d->momentum[k];
        turn_off[k] = angular[k] - d->angular[k];
    }
    d->momentum_worst = fmax(d->momentum_worst, length(off));
    d->angular_worst = fmax(d->angular_worst, length(turn_off));
    return BRC_OK;
}

static brc_observer observer(void *self)
{
    return (brc_observer){.self = self, .sample = sample};
}

static double mean(const double *values, int64_t from, int64_t to)
{
    double sum = 0;
    for (int64_t k = from; k < to; ++k)
        sum += values[k];
    return sum / (double)(to - from);
}

/* What a deviation is relative to: the conserved vector itself where the run starts with one; a run without (released
 * from rest, or shaken alone) has only the sum of the magnitudes of its parts. */
static double relative(double deviation, const double initial[3], double parts)
{
    const double whole = length(initial);
    return deviation / (whole > 1e-3 * parts ? whole : parts);
}

static brc_status values(const brc_campaign *campaign, const void *self, brc_outcome *outcome)
{
    const drift *d = self;
    (void)campaign;
    brc_outcome_add(outcome, "energy_growth", "-", d->growth, NAN);
    if (d->n_samples < 20) return BRC_OK; /* no tenth to speak of */
    const int64_t tenth = d->n_samples / 10;
    const double first = mean(d->total, 0, tenth), last = mean(d->total, d->n_samples - tenth, d->n_samples);
    double squares = 0;
    for (int64_t k = 0; k < d->n_samples; ++k)
        squares += (d->total[k] - first) * (d->total[k] - first);
    brc_outcome_add(outcome, "energy_drift", "-", fabs(last - first) / fabs(first), 0);
    brc_outcome_add(outcome, "energy_spread", "-", sqrt(squares / (double)d->n_samples) / fabs(first), 0);
    brc_outcome_add(outcome, "momentum_drift", "-", relative(d->momentum_worst, d->momentum, d->momentum_scale), 0);
    brc_outcome_add(outcome, "angular_momentum_drift", "-", relative(d->angular_worst, d->angular, d->angular_scale),
                    0);
    if (d->spin) brc_outcome_add(outcome, "largest_section_angle", "deg", acos(d->lean) * 180 / M_PI, 0);
    brc_outcome_add(outcome, "closure_worst", "-", d->closure_worst, 0);
    brc_outcome_add(outcome, "closure_rms", "-", sqrt(d->closure_squares / (double)d->n_samples), 0);
    return BRC_OK;
}

/* energy_drift, momentum_drift, angular_momentum_drift, closure_worst, closure_rms, energy_spread; energy_growth: the
 * largest energy over what initial fields and loads had put in by then. */
const brc_operator brc_operator_drift = {.name = "drift",
                                         .one_run = true,
                                         .create = create,
                                         .observer = observer,
                                         .stopped_too = true,
                                         .values = values,
                                         .release = release};
