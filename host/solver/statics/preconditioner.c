/* What stands for K^-1 in the iterations of static stages. */
#include "multigrid/multigrid.h"
#include "statics_internal.h"
#include <math.h>
#include <stdio.h>

brc_status brc_preconditioner_create(brc_simulation *s, brc_solve_vectors *v)
{
    const int64_t n = s->layout->n_rows, width = brc_solves_rotations(s->model) ? 21 : 6;
    BRC_LOCAL(s->context, width * n, double, blocks, "preconditioner");
    BRC_TRY(s->model->statics->blocks(s, blocks));
    return brc_upload_state(s, v->preconditioner.blocks, blocks, width * n);
}

brc_status brc_preconditioner_apply(brc_simulation *s, brc_solve_vectors *v, bool rotations)
{
    if (v->preconditioner.multigrid && !rotations) return brc_multigrid_apply(v->preconditioner.multigrid, v->r, v->z);
    if (v->r.turn)
        BRC_TRY(brc_vector_blocks6(s, v->preconditioner.blocks, v->r.move, v->r.turn, v->z.move, v->z.turn));
    else
        BRC_TRY(brc_vector_blocks(s, v->preconditioner.blocks, v->r.move, v->z.move));
    if (v->preconditioner.parts && !rotations) BRC_TRY(brc_rigid_parts_add(v->preconditioner.parts, v->r, v->z));
    if (v->z.turn) BRC_TRY(brc_constrain(s, NULL, v->z.turn));
    return rotations ? BRC_OK : brc_constrain(s, v->z.move, NULL);
}

static void tell(brc_simulation *s, const brc_multigrid *multigrid, const char *again)
{
    const brc_multigrid_report m = brc_multigrid_get_report(multigrid);
    s->statics->report.multigrid_levels = m.n_levels;
    s->statics->report.multigrid_seconds += m.seconds;
    s->statics->report.multigrid_bytes = m.device_bytes;
    char nodes[200] = "";
    for (int i = 0, at = 0; i < m.n_levels && at < (int)sizeof nodes; ++i)
        at += snprintf(nodes + at, sizeof nodes - (size_t)at, "%s%lld", i > 0 ? ", " : "", (long long)m.nodes[i]);
    brc_log(s->context, again[0] ? BRC_LOG_DEBUG : BRC_LOG_INFO,
            "stage '%s': multigrid%s of %d levels (%s nodes) in %.2f s, %.2f kB an element, %.2f while it was made",
            brc_current_stage(s)->name, again, m.n_levels, nodes, m.seconds,
            1e-3 * (double)m.device_bytes / (double)s->domain->n_elements,
            1e-3 * (double)m.host_bytes / (double)s->domain->n_elements);
}

brc_status brc_preconditioner_prepare(brc_simulation *s, brc_solve_vectors *v)
{
    brc_preconditioner *p = &v->preconditioner;
    const brc_preconditioner_kind kind = brc_current_stage(s)->preconditioner;
    if (p->multigrid || p->parts || p->blocks_alone || kind == BRC_PRECONDITIONER_BLOCKS) return BRC_OK;
    if (kind == BRC_PRECONDITIONER_PARTS)
        return brc_rigid_parts_suit(s) ? brc_rigid_parts_create(s, &p->parts) : BRC_OK;
    if (kind == BRC_PRECONDITIONER_AUTO && s->domain->n_elements < BRC_MULTIGRID_LEAST) return BRC_OK;
    const bool resumed = p->origin.weight > 0;
    BRC_TRY(brc_multigrid_create(s, &p->origin, &p->multigrid));
    tell(s, p->multigrid, p->bonds_broke && !resumed ? ", again," : "");
    if (!resumed) p->bonds_broke = false, p->pace = 0;
    return BRC_OK;
}

/* What a resumed stage needs to make the same levels. */
brc_status brc_preconditioner_store(const brc_simulation *s, brc_preconditioner *p, brc_state_store *store)
{
    BRC_TRY(brc_store_integer(store, "static.levels_moment", &p->origin.moment));
    BRC_TRY(brc_store_double(store, "static.levels_weight", &p->origin.weight));
    if (brc_multigrid_has_law_steps(s)) BRC_TRY(brc_store_double(store, "static.law_weight", &p->origin.law_weight));
    BRC_TRY(brc_store_double(store, "static.pace", &p->pace));
    BRC_TRY(brc_store_flag(store, "static.bonds_broke", &p->bonds_broke));
    return brc_store_flag(store, "static.blocks_alone", &p->blocks_alone);
}

static void drop(brc_preconditioner *p)
{
    brc_multigrid_free(&p->multigrid);
    p->origin = (brc_multigrid_origin){0};
}

/* Bonds that break make the body softer than its multigrid, which stays positive and only gets worse. */
void brc_preconditioner_took(brc_solve_vectors *v, int64_t iterations, double from, double to)
{
    static const double worse = 1.5, least_digits = 1;
    brc_preconditioner *p = &v->preconditioner;
    const double digits = log10(from / to);
    if (!p->multigrid || !(digits > least_digits)) return;
    const double pace = (double)iterations / digits;
    if (p->pace == 0) p->pace = pace;
    if (p->bonds_broke && pace > worse * p->pace) drop(p);
}

void brc_preconditioner_give_up(brc_simulation *s, brc_solve_vectors *v)
{
    brc_log(s->context, BRC_LOG_WARNING,
            "stage '%s': multigrid does not serve this stiffness; the iterations go on with diagonal blocks",
            brc_current_stage(s)->name);
    v->preconditioner.blocks_alone = true;
    drop(&v->preconditioner);
}
