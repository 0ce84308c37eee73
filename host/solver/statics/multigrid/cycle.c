/* The cycle on the device. */
#include "multigrid_internal.h"
#include "../../../base/random.h"
#include <math.h>

/* Force and torque of the model's own linear law, added to the right side. */
static brc_status own_residual(brc_multigrid *m, brc_unknowns x, brc_unknowns right, brc_unknowns out)
{
    brc_simulation *s = m->s;
    const int32_t n = s->layout->n_rows;
    BRC_TRY(BRC_LAUNCH(s->kernel.small_rotation, n, BRC_INT(n), BRC_BUF(x.turn), BRC_BUF(m->orientation)));
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = x.move,
                                                       .force = out.move,
                                                       .orientation = m->orientation,
                                                       .torque = out.turn,
                                                       .homogeneous = true}));
    if (right.move)
        BRC_TRY(
            BRC_LAUNCH(s->kernel.axpy, 3 * n, BRC_INT(3 * n), BRC_STATE(1), BRC_BUF(right.move), BRC_BUF(out.move)));
    if (right.turn)
        BRC_TRY(
            BRC_LAUNCH(s->kernel.axpy, 3 * n, BRC_INT(3 * n), BRC_STATE(1), BRC_BUF(right.turn), BRC_BUF(out.turn)));
    return BRC_OK;
}

brc_status brc_level_residual(brc_multigrid *m, int level, brc_unknowns x, brc_unknowns right, brc_unknowns out)
{
    brc_simulation *s = m->s;
    const brc_level *l = &m->level[level];
    const int n_right = right.turn ? 2 : right.move ? 1 : 0;
    if (level > 0)
        return BRC_LAUNCH(m->kernel.matrix, l->n, BRC_INT(l->n), BRC_BUF(l->start), BRC_BUF(l->column),
                          BRC_BUF(l->block), BRC_BUF(x.move), BRC_BUF(x.turn), BRC_INT(n_right), BRC_BUF(right.move),
                          BRC_BUF(right.turn), BRC_BUF(out.move), BRC_BUF(out.turn));
    if (brc_solves_rotations(s->model)) return own_residual(m, x, right, out);
    const bool by_branch = s->model->turns; /* which cells that turn store */
    BRC_TRY(BRC_LAUNCH(m->kernel.cells, s->n_groups, BRC_INT(s->n_groups), BRC_BUF(s->row_start), BRC_BUF(s->neighbour),
                       BRC_BUF(by_branch ? s->offset : s->area), BRC_BUF(by_branch ? s->area : s->ratio),
                       BRC_INT(by_branch ? 1 : 0), BRC_COEFF(m->moduli.axial), BRC_COEFF(m->moduli.shear),
                       BRC_COEFF(m->moduli.frame), BRC_BUF(m->moduli_of), BRC_BUF(x.move), BRC_BUF(x.turn),
                       BRC_INT(n_right), BRC_BUF(right.move), BRC_BUF(right.turn), BRC_BUF(out.move),
                       BRC_BUF(out.turn)));
    if (m->n_ground == 0) return BRC_OK;
    return BRC_LAUNCH(m->kernel.ground, m->n_ground, BRC_INT(m->n_ground), BRC_BUF(m->ground_element),
                      BRC_BUF(m->ground), BRC_BUF(x.move), BRC_BUF(x.turn), BRC_BUF(out.move), BRC_BUF(out.turn));
}

brc_status brc_level_step(brc_multigrid *m, int level, double weight, bool add, brc_unknowns r, brc_unknowns x)
{
    const brc_level *l = &m->level[level];
    return BRC_LAUNCH(m->kernel.step, l->n, BRC_INT(l->n), BRC_STATE(weight), BRC_INT(add ? 1 : 0), BRC_BUF(l->inverse),
                      BRC_INT(r.turn ? 2 : 1), BRC_BUF(r.move), BRC_BUF(r.turn), BRC_BUF(x.move), BRC_BUF(x.turn));
}

static brc_status dot(brc_simulation *s, int64_t n, brc_unknowns a, brc_unknowns b, double *out)
{
    double turn;
    BRC_TRY(brc_vector_dot(s, a.move, b.move, 3 * n, out));
    BRC_TRY(brc_vector_dot(s, a.turn, b.turn, 3 * n, &turn));
    *out += turn;
    return BRC_OK;
}

/* Power iteration with quotients of energies, v.A D^-1 A v / v.A v, from noise. */
brc_status brc_level_stiffest(brc_multigrid *m, int level, double *out)
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
    BRC_TRY(brc_level_step(m, level, 1, false, l->step, l->left)); /* in its free components */
    const int32_t n = (int32_t)(3 * l->n);
    for (int i = 0; i < ITERATIONS && above > 0 && below > 0; ++i) {
        const double scale = 1 / sqrt(i == 0 ? 1 : above);
        BRC_TRY(brc_buffer_fill_zero(l->step.move));
        BRC_TRY(brc_buffer_fill_zero(l->step.turn));
        BRC_TRY(
            BRC_LAUNCH(s->kernel.axpy, n, BRC_INT(n), BRC_STATE(-scale), BRC_BUF(l->left.move), BRC_BUF(l->step.move)));
        BRC_TRY(
            BRC_LAUNCH(s->kernel.axpy, n, BRC_INT(n), BRC_STATE(-scale), BRC_BUF(l->left.turn), BRC_BUF(l->step.turn)));
        BRC_TRY(brc_level_residual(m, level, l->step, (brc_unknowns){NULL, NULL}, l->x)); /* -A v */
        BRC_TRY(dot(s, l->n, l->x, l->step, &below));
        BRC_TRY(brc_level_step(m, level, 1, false, l->x, l->left));
        BRC_TRY(dot(s, l->n, l->x, l->left, &above));
        below = -below;
    }
    *out = below > 0 && isfinite(above / below) ? above / below : 1;
    return BRC_OK;
}

static brc_status coarsest(brc_multigrid *m, int level)
{
    enum { STEPS = 8 };
    brc_level *l = &m->level[level];
    if (m->inverse)
        return BRC_LAUNCH(m->kernel.coarsest, l->n, BRC_INT(l->n), BRC_BUF(m->inverse), BRC_BUF(l->right.move),
                          BRC_BUF(l->right.turn), BRC_BUF(l->x.move), BRC_BUF(l->x.turn));
    BRC_TRY(brc_level_step(m, level, l->weight, false, l->right, l->x));
    for (int i = 1; i < STEPS; ++i) {
        BRC_TRY(brc_level_residual(m, level, l->x, l->right, l->left));
        BRC_TRY(brc_level_step(m, level, l->weight, true, l->left, l->x));
    }
    return BRC_OK;
}

/* A step, the coarser levels, a step; on levels of stored blocks. */
static brc_status cycle(brc_multigrid *m, int level)
{
    brc_level *l = &m->level[level], *c = l + 1;
    if (level == m->n_levels - 1) return coarsest(m, level);
    BRC_TRY(brc_level_step(m, level, l->weight, false, l->right, l->x));
    BRC_TRY(brc_level_residual(m, level, l->x, l->right, l->left));
    BRC_TRY(BRC_LAUNCH(m->kernel.restriction, c->n, BRC_INT(c->n), BRC_BUF(l->p_column_start), BRC_BUF(l->p_entry),
                       BRC_BUF(l->p_block), BRC_BUF(l->left.move), BRC_BUF(l->left.turn), BRC_BUF(c->right.move),
                       BRC_BUF(c->right.turn)));
    BRC_TRY(cycle(m, level + 1));
    BRC_TRY(BRC_LAUNCH(m->kernel.prolong, l->n, BRC_INT(l->n), BRC_BUF(l->p_start), BRC_BUF(l->p_column),
                       BRC_BUF(l->p_block), BRC_BUF(c->x.move), BRC_BUF(c->x.turn), BRC_BUF(l->x.move),
                       BRC_BUF(l->x.turn)));
    BRC_TRY(brc_level_residual(m, level, l->x, l->right, l->left));
    return brc_level_step(m, level, l->weight, true, l->left, l->x);
}

/* The same on the finest level, whose P = (1 - weight D^-1 A) T is applied as it is made. */
brc_status brc_multigrid_apply(brc_multigrid *m, brc_unknowns r, brc_unknowns z)
{
    brc_simulation *s = m->s;
    brc_level *l = &m->level[0], *c = l + 1;
    const int32_t n = (int32_t)l->n, n3 = 3 * n;
    const brc_unknowns x = {z.move, z.turn ? z.turn : l->x.turn}, none = {NULL, NULL};
    BRC_TRY(brc_level_step(m, 0, l->weight, false, r, x));
    if (m->n_levels > 1) {
        BRC_TRY(brc_level_residual(m, 0, x, r, l->left));
        BRC_TRY(brc_level_step(m, 0, l->weight, false, l->left, l->step));
        BRC_TRY(brc_level_residual(m, 0, l->step, l->left, l->right));
        BRC_TRY(BRC_LAUNCH(m->kernel.collect, c->n, BRC_INT(c->n), BRC_BUF(l->member_start), BRC_BUF(l->member),
                           BRC_BUF(l->arm), BRC_BUF(l->free_bits), BRC_BUF(l->right.move), BRC_BUF(l->right.turn),
                           BRC_BUF(c->right.move), BRC_BUF(c->right.turn)));
        BRC_TRY(cycle(m, 1));
        BRC_TRY(BRC_LAUNCH(m->kernel.spread, n, BRC_INT(n), BRC_BUF(l->aggregate), BRC_BUF(l->arm),
                           BRC_BUF(l->free_bits), BRC_BUF(c->x.move), BRC_BUF(c->x.turn), BRC_BUF(l->step.move),
                           BRC_BUF(l->step.turn)));
        BRC_TRY(BRC_LAUNCH(s->kernel.axpy, n3, BRC_INT(n3), BRC_STATE(1), BRC_BUF(l->step.move), BRC_BUF(x.move)));
        BRC_TRY(BRC_LAUNCH(s->kernel.axpy, n3, BRC_INT(n3), BRC_STATE(1), BRC_BUF(l->step.turn), BRC_BUF(x.turn)));
        BRC_TRY(brc_level_residual(m, 0, l->step, none, l->left));
        BRC_TRY(brc_level_step(m, 0, l->weight, true, l->left, x));
    }
    BRC_TRY(brc_level_residual(m, 0, x, r, l->left));
    return brc_level_step(m, 0, l->weight, true, l->left, x);
}
