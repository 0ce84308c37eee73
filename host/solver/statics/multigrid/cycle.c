/* The cycle on the device. */
#include "multigrid_internal.h"
#include "../../../base/random.h"
#include <math.h>

/* Force of the linear law of cells, added to the right side. */
static brc_status law_residual(brc_multigrid *m, brc_buffer *x, brc_buffer *right, brc_buffer *out)
{
    brc_simulation *s = m->s;
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = x, .force = out, .homogeneous = true}));
    return right ? brc_vector_axpy(s, 3 * (int64_t)s->layout->n_rows, 1, right, out) : BRC_OK;
}

/* x = [x +] weight D^-1 r with the blocks of the law, in components that no load prescribes; way: scratch. */
static brc_status law_step(brc_multigrid *m, bool add, brc_buffer *r, brc_buffer *way, brc_buffer *x)
{
    brc_simulation *s = m->s;
    if (!add) BRC_TRY(brc_buffer_fill_zero(x));
    BRC_TRY(brc_vector_blocks(s, m->law_inverse, r, way));
    BRC_TRY(brc_vector_axpy(s, 3 * (int64_t)s->layout->n_rows, m->law_weight, way, x));
    return brc_constrain(s, x, NULL);
}

/* Force and torque of beams, added to the right side. */
static brc_status own_residual(brc_multigrid *m, brc_level_vector x, brc_level_vector right, brc_level_vector out)
{
    brc_simulation *s = m->s;
    const int32_t n = s->layout->n_rows;
    BRC_TRY(brc_vector_small_rotation(s, x.turn, m->orientation));
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = x.move,
                                                       .force = out.move,
                                                       .orientation = m->orientation,
                                                       .torque = out.turn,
                                                       .homogeneous = true}));
    if (right.move) BRC_TRY(brc_vector_axpy(s, 3 * n, 1, right.move, out.move));
    if (right.turn) BRC_TRY(brc_vector_axpy(s, 3 * n, 1, right.turn, out.turn));
    return BRC_OK;
}

/* out = right - A x of a level, 0 the finest; right.move NULL: none; right.turn NULL: no torques. */
static brc_status level_residual(brc_multigrid *m, int level, brc_level_vector x, brc_level_vector right,
                                 brc_level_vector out)
{
    brc_simulation *s = m->s;
    const brc_level *l = &m->level[level];
    const brc_level_vectors v = {.move = x.move,
                                 .turn = x.turn,
                                 .swell = x.swell,
                                 .force = out.move,
                                 .torque = out.turn,
                                 .virial = out.swell,
                                 .swells = x.swell != NULL,
                                 .n_right = right.turn   ? 2
                                            : right.move ? 1
                                                         : 0,
                                 .right_force = right.move,
                                 .right_torque = right.turn,
                                 .right_virial = right.swell};
    if (level > 0) return brc_pass_run_on(m->pass.matrix, l->n, &v, l, NULL);
    if (brc_solves_rotations(s->model)) return own_residual(m, x, right, out);
    BRC_TRY(brc_pass_run_on(m->pass.cells, s->n_groups, &v, NULL, NULL));
    return m->n_ground > 0 ? brc_pass_run_on(m->pass.ground, m->n_ground, &v, NULL, NULL) : BRC_OK;
}

static brc_level_vector of_solve(brc_unknowns v)
{
    return (brc_level_vector){.move = v.move, .turn = v.turn};
}

brc_status brc_multigrid_residual(brc_multigrid *m, brc_unknowns x, brc_unknowns right, brc_unknowns out)
{
    return level_residual(m, 0, of_solve(x), of_solve(right), of_solve(out));
}

/* x = [x +] weight D^-1 r. */
static brc_status level_step(brc_multigrid *m, int level, double weight, bool add, brc_level_vector r,
                             brc_level_vector x)
{
    const brc_level *l = &m->level[level];
    const brc_level_vectors v = {.move = x.move,
                                 .turn = x.turn,
                                 .swell = x.swell,
                                 .force = r.move,
                                 .torque = r.turn,
                                 .virial = r.swell,
                                 .swells = x.swell != NULL,
                                 .n_right = r.turn ? 2 : 1};
    if (level == 0)
        return BRC_RUN_ON(m->pass.finest_step, m->s->n_groups, &v, l, {"weight", BRC_STATE(weight)},
                          {"add", BRC_INT(add ? 1 : 0)});
    return BRC_RUN_ON(m->pass.step, l->n, &v, l, {"weight", BRC_STATE(weight)}, {"add", BRC_INT(add ? 1 : 0)});
}

static brc_status dot(brc_simulation *s, int64_t n, brc_level_vector a, brc_level_vector b, double *out)
{
    double turn = 0, swell = 0;
    BRC_TRY(brc_vector_dot(s, a.move, b.move, 3 * n, out));
    if (a.turn) BRC_TRY(brc_vector_dot(s, a.turn, b.turn, 3 * n, &turn));
    if (a.swell) BRC_TRY(brc_vector_dot(s, a.swell, b.swell, n, &swell));
    *out += turn + swell;
    return BRC_OK;
}

/* to = factor from. */
static brc_status scale(brc_simulation *s, int64_t n, double factor, brc_level_vector from, brc_level_vector to)
{
    BRC_TRY(brc_buffer_fill_zero(to.move));
    BRC_TRY(brc_buffer_fill_zero(to.turn));
    BRC_TRY(brc_vector_axpy(s, 3 * n, factor, from.move, to.move));
    BRC_TRY(brc_vector_axpy(s, 3 * n, factor, from.turn, to.turn));
    if (!to.swell) return BRC_OK;
    BRC_TRY(brc_buffer_fill_zero(to.swell));
    return brc_vector_axpy(s, n, factor, from.swell, to.swell);
}

/* Power iteration with quotients of energies, v.A D^-1 A v / v.A v, from noise. */
brc_status brc_level_stiffest(brc_multigrid *m, int level, bool of_law, double *out)
{
    enum { ITERATIONS = 12 };
    brc_simulation *s = m->s;
    brc_level *l = &m->level[level];
    double *noise = NULL, above = 1, below = 1;
    BRC_TRY(BRC_ALLOCATE(s->context, &noise, 3 * l->n, "noise"));
    for (int64_t i = 0; i < 3 * l->n; ++i) {
        double draws[4];
        brc_random_uniform4((uint64_t)level, BRC_RANDOM_POWER_ITERATION, (uint64_t)i, 1, draws);
        noise[i] = draws[0] - 0.5;
    }
    brc_status status = brc_upload_state(s, l->step.move, noise, 3 * l->n);
    brc_memory_free(noise);
    BRC_TRY(status);
    BRC_TRY(brc_buffer_fill_zero(l->step.turn));
    if (l->step.swell) BRC_TRY(brc_buffer_fill_zero(l->step.swell));
    BRC_TRY(level_step(m, level, 1, false, l->step, l->left)); /* in its free components */
    const brc_level_vector force = {l->x.move, of_law ? NULL : l->x.turn, l->x.swell};
    for (int i = 0; i < ITERATIONS && above > 0 && below > 0; ++i) {
        BRC_TRY(scale(s, l->n, -1 / sqrt(i == 0 ? 1 : above), l->left, l->step));
        BRC_TRY(of_law ? law_residual(m, l->step.move, NULL, force.move) /* -A v */
                       : level_residual(m, level, l->step, (brc_level_vector){NULL, NULL, NULL}, force));
        BRC_TRY(dot(s, l->n, force, l->step, &below));
        BRC_TRY(of_law ? law_step(m, false, force.move, l->right.move, l->left.move)
                       : level_step(m, level, 1, false, force, l->left));
        BRC_TRY(dot(s, l->n, force, l->left, &above));
        below = -below;
    }
    *out = below > 0 && isfinite(above / below) ? above / below : 1;
    return BRC_OK;
}

static brc_status step_again(brc_multigrid *m, int level)
{
    brc_level *l = &m->level[level];
    BRC_TRY(level_residual(m, level, l->x, l->right, l->left));
    return level_step(m, level, l->weight, true, l->left, l->x);
}

static brc_status coarsest(brc_multigrid *m, int level)
{
    enum { STEPS = 8 };
    brc_level *l = &m->level[level];
    const brc_level_vectors v = {.move = l->x.move,
                                 .turn = l->x.turn,
                                 .swell = l->x.swell,
                                 .force = l->right.move,
                                 .torque = l->right.turn,
                                 .virial = l->right.swell,
                                 .swells = l->x.swell != NULL};
    if (m->inverse) return brc_pass_run_on(m->pass.coarsest, l->n, &v, NULL, NULL);
    BRC_TRY(level_step(m, level, l->weight, false, l->right, l->x));
    for (int i = 1; i < STEPS; ++i)
        BRC_TRY(step_again(m, level));
    return BRC_OK;
}

/* A step, the coarser levels, a step; on levels of stored blocks. */
static brc_status cycle(brc_multigrid *m, int level)
{
    brc_level *l = &m->level[level], *c = l + 1;
    if (level == m->n_levels - 1) return coarsest(m, level);
    BRC_TRY(level_step(m, level, l->weight, false, l->right, l->x));
    for (int i = 1; i < m->coarse_steps; ++i)
        BRC_TRY(step_again(m, level));
    BRC_TRY(level_residual(m, level, l->x, l->right, l->left));
    const bool swells = c->x.swell != NULL;
    const brc_level_vectors down = {.force = l->left.move,
                                    .torque = l->left.turn,
                                    .virial = l->left.swell,
                                    .swells = swells},
                            up = {.move = l->x.move, .turn = l->x.turn, .swell = l->x.swell, .swells = swells};
    BRC_TRY(BRC_RUN_ON(m->pass.restriction, c->n, &down, l, {"coarse_force", BRC_BUF(c->right.move)},
                       {"coarse_torque", BRC_BUF(c->right.turn)}, {"coarse_virial", BRC_BUF(c->right.swell)}));
    BRC_TRY(cycle(m, level + 1));
    BRC_TRY(BRC_RUN_ON(m->pass.prolong, l->n, &up, l, {"coarse_move", BRC_BUF(c->x.move)},
                       {"coarse_turn", BRC_BUF(c->x.turn)}, {"coarse_swell", BRC_BUF(c->x.swell)}));
    for (int i = 1; i < m->coarse_steps; ++i)
        BRC_TRY(step_again(m, level));
    return step_again(m, level);
}

/* The same on the finest level, whose P is not stored. With S = 1 - weight D^-1 A, P = S T: what P^T gives of a
 * residual is T^T of the one that another step of that weight leaves, and P likewise. So that step is kept before and
 * after the coarser levels, for no evaluation of A more, and a longer one goes with it. */
static brc_status finest_cycle(brc_multigrid *m, brc_level_vector r, brc_level_vector z)
{
    static const double longer = 1.3; /* over the kept step (docs/notebook/theory.md T6); 1.5 would be 2 / lambda_max */
    brc_level *l = &m->level[0], *c = l + 1;
    const brc_level_vector x = {z.move, z.turn ? z.turn : l->x.turn, NULL};
    if (!m->short_cycle) {
        BRC_TRY(level_step(m, 0, longer * l->weight, false, r, x));
        BRC_TRY(level_residual(m, 0, x, r, l->left));
    }
    BRC_TRY(level_step(m, 0, l->weight, !m->short_cycle, m->short_cycle ? r : l->left, x));
    BRC_TRY(level_residual(m, 0, x, r, l->left));
    if (m->n_levels > 1) {
        const bool swells = c->x.swell != NULL;
        const brc_level_vectors down = {.force = l->left.move, .torque = l->left.turn, .swells = swells},
                                up = {.move = x.move, .turn = x.turn, .swells = swells};
        BRC_TRY(BRC_RUN_ON(m->pass.collect, c->n, &down, l, {"whole_force", BRC_BUF(c->right.move)},
                           {"whole_torque", BRC_BUF(c->right.turn)}, {"whole_virial", BRC_BUF(c->right.swell)}));
        BRC_TRY(cycle(m, 1));
        BRC_TRY(BRC_RUN_ON(m->pass.spread, l->n, &up, l, {"whole_move", BRC_BUF(c->x.move)},
                           {"whole_turn", BRC_BUF(c->x.turn)}, {"whole_swell", BRC_BUF(c->x.swell)}));
        BRC_TRY(level_residual(m, 0, x, r, l->left));
    }
    BRC_TRY(level_step(m, 0, l->weight, true, l->left, x));
    if (m->short_cycle) return BRC_OK;
    BRC_TRY(level_residual(m, 0, x, r, l->left));
    return level_step(m, 0, longer * l->weight, true, l->left, x);
}

/* Where the law is far from the stand-in, a step of the law itself before and after. Where its volume is stiff they
 * take the place of the longer steps. */
brc_status brc_multigrid_apply(brc_multigrid *m, brc_unknowns r, brc_unknowns z)
{
    const brc_level *l = &m->level[0];
    const brc_level_vector left = {.move = l->right.move}, way = {.move = l->step.move};
    if (!(m->law_weight > 0)) return finest_cycle(m, of_solve(r), of_solve(z));
    BRC_TRY(law_step(m, false, r.move, way.move, z.move));
    BRC_TRY(law_residual(m, z.move, r.move, left.move));
    BRC_TRY(finest_cycle(m, left, way));
    BRC_TRY(brc_vector_axpy(m->s, 3 * l->n, 1, way.move, z.move));
    BRC_TRY(law_residual(m, z.move, r.move, left.move));
    return law_step(m, true, left.move, way.move, z.move);
}
