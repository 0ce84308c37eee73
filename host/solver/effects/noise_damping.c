#include "noise_damping.h"
#include "effect.h"
#include <math.h>

/* Velocity Verlet keeps v.M v + u.(K - dt^2 K M^-1 K / 4) u at whole steps, so a contraction of v there can only take
 * from it. I - c M^-1 S contracts while c w^2 < 2 for all frequencies w of S, which are below the critical frequency of
 * the body (0.15 to 0.78 of it: test_noise_damping): so c may be up to this share of 1 / w_c^2. */
static const double LARGEST_SHARE = 1;
enum { MOST_STEPS = 32, MOST_PASSES = 4 };

/* One simulation has at most one. */
struct brc_noise {
    brc_pass *of_model[MOST_PASSES], *damp;
    brc_buffer *gradient, *no_stress, *flux, *bond_part,
        *force;     /* of velocities: [n][9] 1/s, zeros, [n][9], [n][9], [n][3] */
    int64_t every;  /* 0: not in this stage */
    double factor;  /* [s^2]: v -= factor / m S v */
    double nothing; /* 0: no compaction */
    bool never;     /* false: no loads on faces, and the linear law */
};

static bool asks(const brc_stage *stage)
{
    return stage->solver == BRC_SOLVER_DYNAMIC && stage->noise_damping > 0;
}

BRC_WANTED(noise, w->noise)

static void ask(brc_wants *w, const int32_t *material)
{
    (void)material;
    for (int32_t i = 0; i < w->scene->n_stages; ++i)
        w->noise |= asks(&w->scene->stages[i]);
    w->damping |= w->noise;
}

/* It asks in every step. */
static int64_t quiet_steps(const brc_simulation *s)
{
    (void)s;
    return 0;
}

#define AT(member) BRC_FIELD_AT(struct brc_noise, member)
static const brc_field_row rows[] = {
    BRC_FIELD(gradient, brc_each_row, 9, COEFF, NULL, "gradients of velocities", "1/s"),
    {"stress", brc_each_row, 9, BRC_FIELD_COEFF, NULL, AT(no_stress), "no stresses", "-", BRC_NOT_KEPT},
    BRC_FIELD(flux, brc_each_row, 9, COEFF, NULL, "fluxes of velocities", "Pa/s"),
    BRC_FIELD(bond_part, brc_each_row, 9, COEFF, brc_wants_many, "bond parts of velocities", "Pa/s"),
    BRC_FIELD(force, brc_each_row, 3, STATE, NULL, "forces of noise damping", "N/s"),
};
BRC_FIELD_TABLE(brc_noise_fields, "noise damping", BRC_LIFE_RUN, noise, rows);

/* The stabilisation's part of the linear law, of velocities. */
static brc_status make_passes(brc_simulation *s, struct brc_noise *d)
{
    static const brc_value_row values[] = {{"ell_one", BRC_VALUE_REAL, AT(nothing)},
                                           {"beta", BRC_VALUE_REAL, AT(nothing)},
                                           {"face_loads", BRC_VALUE_BOOL, AT(never)},
                                           {"factor", BRC_VALUE_REAL, AT(factor)},
                                           {"drag", BRC_VALUE_BUFFER, AT(force)}};
    const brc_scope run = brc_scope_of_run(s), damping = brc_scope_of_damping(s, &run),
                    velocities = brc_scope_of_velocities(s, &damping);
    const brc_scope noise = {
        .owner = "noise damping", .base = d, .tables = {&brc_noise_fields}, BRC_VALUES(values), .outer = &velocities};
    for (int k = 0; s->model->smoothing[k]; ++k)
        BRC_TRY(BRC_PASSES(s, &noise, BRC_PASS(&d->of_model[k], s->model->smoothing[k], NULL)));
    return BRC_PASSES(s, &noise, BRC_PASS(&d->damp, "damp_noise", NULL));
}

static brc_status create(brc_simulation *s)
{
    BRC_TRY(BRC_ALLOCATE(s->context, &s->noise, 1, "noise damping"));
    BRC_TRY(make_passes(s, s->noise));
    return brc_fields_create(s->device, &brc_noise_fields, &s->wants, s->noise);
}

static void release(brc_simulation *s)
{
    if (!s->noise) return;
    brc_fields_free(&brc_noise_fields, s->noise);
    brc_memory_free(s->noise);
    s->noise = NULL;
}

/* Once the stage has its time step: how often, and how much. */
static brc_status enter(brc_simulation *s)
{
    const brc_stage *stage = brc_current_stage(s);
    const double dt = brc_simulation_time_step(s).value,
                 critical = brc_simulation_time_step(s).critical > 0 ? brc_simulation_time_step(s).critical : dt,
                 z = stage->noise_damping;
    s->noise->every = 0;
    if (!asks(stage) || !(dt > 0)) return BRC_OK;
    const double share = 4 * z * dt / critical; /* z t_c dt w_c^2, w_c = 2 / t_c */
    s->noise->every = (int64_t)fmin(MOST_STEPS, fmax(1, floor(LARGEST_SHARE / share)));
    s->noise->factor = z * critical * dt * (double)s->noise->every;
    return BRC_OK;
}

/* At the end of the step just done: depends on the step alone. */
static bool due(const brc_simulation *s)
{
    return s->noise->every > 0 && brc_simulation_step(s) % s->noise->every == 0;
}

brc_status brc_noise_damp(brc_simulation *s)
{
    struct brc_noise *d = s->noise;
    for (int k = 0; d->of_model[k]; ++k)
        BRC_TRY(brc_pass_run(d->of_model[k], s->n_groups));
    BRC_TRY(brc_constrain(s, d->force, NULL));
    return brc_pass_run(d->damp, s->layout->n_rows);
}

BRC_READ(brc_buffer *, brc_noise_drag, s->noise->force)
BRC_READ(double, brc_noise_factor, s->noise->factor)

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_ENTERED, .plain = enter},
                                    {.hook = BRC_HOOK_WHOLE, .plain = brc_noise_damp, .due = due}};
const brc_effect brc_noise_damping_effect = {.name = "noise damping",
                                             .in = noise,
                                             .ask = ask,
                                             .quiet_steps = quiet_steps,
                                             .fields = (const brc_field_table *const[]){&brc_noise_fields, NULL},
                                             .create = create,
                                             .free = release,
                                             BRC_HOOKED(hooked)};
