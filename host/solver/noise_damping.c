#include "noise_damping.h"
#include <math.h>

/* Velocity Verlet keeps v.M v + u.(K - dt^2 K M^-1 K / 4) u at whole steps, so a contraction of v there can only take from it. I - c M^-1 S contracts while c w^2 < 2 for all
 * frequencies w of S, which are below the critical frequency of the body (0.15 to 0.78 of it: test_noise_damping): so c may be up to this share of 1 / w_c^2. */
static const double LARGEST_SHARE = 1;
enum { MOST_STEPS = 32 };

static bool asks(const brc_stage *stage) { return stage->solver == BRC_SOLVER_DYNAMIC && stage->noise_damping > 0; }

bool brc_has_noise_damping(const brc_scene *scene)
{
    for (int32_t i = 0; i < scene->n_stages; ++i)
        if (asks(scene->stages + i)) return true;
    return false;
}

brc_status brc_noise_create(brc_simulation *s)
{
    if (!brc_has_noise_damping(s->scene)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &s->noise, 1, "noise damping"));
    const int64_t n = s->layout->n_rows;
    BRC_TRY(brc_kernel_find(s->device, "damp_noise", &s->noise->damp));
    BRC_TRY(brc_new_coeff(s, &s->noise->gradient, 9 * n, "gradients of velocities"));
    BRC_TRY(brc_new_coeff(s, &s->noise->no_stress, 9 * n, "no stresses"));
    BRC_TRY(brc_new_coeff(s, &s->noise->flux, 9 * n, "fluxes of velocities"));
    if (brc_device_has_many_materials(s->device)) BRC_TRY(brc_new_coeff(s, &s->noise->bond_part, 9 * n, "bond parts of velocities"));
    return brc_new_state(s, &s->noise->force, 3 * n, "forces of noise damping");
}

void brc_noise_free(brc_simulation *s)
{
    if (!s->noise) return;
    brc_buffer **const all[] = {&s->noise->gradient, &s->noise->no_stress, &s->noise->flux, &s->noise->bond_part, &s->noise->force};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) brc_buffer_free(all[k]);
    brc_memory_free(s->noise);
    s->noise = NULL;
}

int64_t brc_noise_bytes(const brc_scene *scene, int64_t n, int64_t state, int64_t coeff)
{
    return brc_has_noise_damping(scene) ? n * (27 * coeff + 3 * state) : 0;
}

void brc_noise_begin_stage(brc_simulation *s)
{
    if (!s->noise) return;
    const brc_stage *stage = brc_current_stage(s);
    const double dt = s->time_step.value, critical = s->time_step.critical > 0 ? s->time_step.critical : dt, z = stage->noise_damping;
    s->noise->every = 0;
    if (!asks(stage) || !(dt > 0)) return;
    const double share = 4 * z * dt / critical; /* z t_c dt w_c^2, w_c = 2 / t_c */
    s->noise->every = (int64_t)fmin(MOST_STEPS, fmax(1, floor(LARGEST_SHARE / share)));
    s->noise->factor = z * critical * dt * (double)s->noise->every;
}

bool brc_noise_is_due(const brc_simulation *s)
{
    return s->noise && s->noise->every > 0 && s->step % s->noise->every == 0;
}

brc_status brc_noise_damp(brc_simulation *s)
{
    struct brc_noise *d = s->noise;
    const brc_elastic *m = s->elastic + s->material_of_element[0];
    const double one_plus_tau = 1 + s->scene->model.tau;
    const int32_t n = s->layout->n_rows;
    BRC_TRY(BRC_LAUNCH(s->kernel.gradient, s->n_groups, BRC_INT(s->n_groups), BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area),
                       BRC_BUF(s->velocity), BRC_BUF(s->inv_shape), BRC_BUF(d->gradient)));
    BRC_TRY(BRC_LAUNCH(s->kernel.flux, s->n_groups, BRC_INT(s->n_groups), BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area), BRC_BUF(s->offset),
                       BRC_BUF(s->ratio), BRC_BUF(s->velocity), BRC_BUF(d->gradient), BRC_BUF(d->no_stress), BRC_BUF(s->inv_shape), BRC_BUF(s->inv_volume),
                       BRC_BUF(s->boundary), BRC_BUF(s->held_moment), BRC_INT(0), BRC_COEFF(m->k), BRC_COEFF(0), BRC_COEFF(0), BRC_COEFF(one_plus_tau),
                       BRC_BUF(s->material), BRC_BUF(s->modulus), BRC_BUF(s->ell_of), BRC_INT(0), BRC_BUF(d->flux), BRC_BUF(d->bond_part)));
    BRC_TRY(BRC_LAUNCH(s->kernel.force, s->n_groups, BRC_INT(s->n_groups), BRC_BUF(s->row_start), BRC_BUF(s->neighbour), BRC_BUF(s->area), BRC_BUF(s->ratio),
                       BRC_BUF(s->velocity), BRC_BUF(d->flux), BRC_BUF(d->bond_part), BRC_COEFF(m->k), BRC_COEFF(one_plus_tau), BRC_BUF(s->modulus),
                       BRC_BUF(d->force)));
    BRC_TRY(brc_loads_zero_imposed(s, d->force));
    return BRC_LAUNCH(d->damp, n, BRC_INT(n), BRC_STATE(d->factor), BRC_BUF(s->mass), BRC_BUF(d->force), BRC_BUF(s->velocity), BRC_BUF(s->lost_damping));
}
