/* Cells that fail by criteria of elements (NAH19 section 2.2 and the limits on shear that it proposes), with a cell's
 * own stress in place of the virial of beams: passes of cell_criteria.cl before and after those of
 * fracture.cl. */
#include "cell_breaks_internal.h"

brc_status brc_cell_criteria_create(brc_simulation *s)
{
    brc_cell_breaks *c = s->fracture->cells;
    brc_buffer *branch = NULL;
    BRC_TRY(s->model->breaking->branches(s, &branch));
    BRC_TRY(brc_fracture_create_elements(s, branch));
    const brc_scope run = brc_scope_of_run(s), criterion = brc_scope_of_criterion(s, &run);
    const brc_scope state = brc_scope_of_stresses(s, &criterion); /* not those of the criterion */
    brc_cell_scopes scopes;
    const brc_scope *cells = brc_cell_scopes_make(s, &criterion, &scopes);
    BRC_TRY(BRC_PASSES(s, &state, BRC_PASS(&c->record, s->model->breaking->record, NULL),
                       BRC_PASS(&c->weigh, "cells_weigh", NULL)));
    return BRC_PASSES(s, cells, BRC_PASS(&c->mark_chosen, "cells_mark_chosen", "stress"));
}

/* Records of the state as the last forces left it. */
static brc_status record(brc_simulation *s)
{
    const brc_breaking *f = s->fracture;
    return brc_pass_run(f->cells->record, s->n_groups);
}

brc_status brc_cell_criteria_mark(brc_simulation *s)
{
    const brc_breaking *f = s->fracture;
    const brc_cell_breaks *c = f->cells;
    const int32_t rows = s->layout->n_rows;
    BRC_TRY(record(s));
    BRC_TRY(brc_fracture_choose(s, (int32_t)brc_fracture_moment(s)));
    BRC_TRY(BRC_RUN(c->mark_chosen, rows, {"stress", BRC_BUF(f->measure)}));
    return s->model->breaking->mark_beside ? s->model->breaking->mark_beside(s) : BRC_OK;
}

brc_status brc_cell_criteria_settle(brc_simulation *s)
{
    const brc_breaking *f = s->fracture;
    if (s->scene->fracture.level != 1) return BRC_OK;
    return brc_pass_run(f->cells->weigh, s->layout->n_rows);
}

brc_status brc_cell_criteria_ratio(brc_simulation *s, double *out)
{
    BRC_TRY(record(s));
    return brc_fracture_ratio(s, out);
}
