/* Levels, made on the host one after the other and uploaded. */
#include "multigrid_internal.h"
#include "../../effects/fracture/breaking.h"
#include <math.h>
#include <omp.h>
#include <string.h>

/* Boxes of the first aggregates, in spacings; those of each further level are twice as wide. Measured on cantilevers
 * and cubes (docs/notebook/performance.md). */
static const double box_in_spacings = 3;
enum { MOST_SOLVED = 100 }; /* nodes of a coarsest level whose inverse is kept */

#define OF_LEVEL(member) BRC_FIELD_AT(brc_level, member)
#define OF_ALL(member) BRC_FIELD_AT(brc_multigrid, member)
#define OF_LAUNCH(member) BRC_FIELD_AT(brc_level_vectors, member)
static brc_status make_passes(brc_multigrid *m)
{
    static const brc_value_row of_launch[] = {{"move", BRC_VALUE_BUFFER, OF_LAUNCH(move)},
                                              {"turn", BRC_VALUE_BUFFER, OF_LAUNCH(turn)},
                                              {"swell", BRC_VALUE_BUFFER, OF_LAUNCH(swell)},
                                              {"force", BRC_VALUE_BUFFER, OF_LAUNCH(force)},
                                              {"torque", BRC_VALUE_BUFFER, OF_LAUNCH(torque)},
                                              {"virial", BRC_VALUE_BUFFER, OF_LAUNCH(virial)},
                                              {"swells", BRC_VALUE_BOOL, OF_LAUNCH(swells)},
                                              {"n_right", BRC_VALUE_INT, OF_LAUNCH(n_right)},
                                              {"right_force", BRC_VALUE_BUFFER, OF_LAUNCH(right_force)},
                                              {"right_torque", BRC_VALUE_BUFFER, OF_LAUNCH(right_torque)},
                                              {"right_virial", BRC_VALUE_BUFFER, OF_LAUNCH(right_virial)}};
    static const brc_value_row of_finest[] = {
        {"vector", BRC_VALUE_BUFFER, OF_ALL(vector)},       {"number", BRC_VALUE_BUFFER, OF_ALL(number)},
        {"by_branch", BRC_VALUE_BOOL, OF_ALL(by_branch)},   {"axial", BRC_VALUE_REAL, OF_ALL(moduli.axial)},
        {"shear", BRC_VALUE_REAL, OF_ALL(moduli.shear)},    {"frame", BRC_VALUE_REAL, OF_ALL(moduli.frame)},
        {"moduli_of", BRC_VALUE_BUFFER, OF_ALL(moduli_of)}, {"element", BRC_VALUE_BUFFER, OF_ALL(ground_element)},
        {"block", BRC_VALUE_BUFFER, OF_ALL(ground)},        {"inverse", BRC_VALUE_BUFFER, OF_ALL(inverse)}};
    static const brc_value_row of_matrix[] = {{"inverse", BRC_VALUE_BUFFER, OF_LEVEL(inverse)},
                                              {"start", BRC_VALUE_BUFFER, OF_LEVEL(start)},
                                              {"column", BRC_VALUE_BUFFER, OF_LEVEL(column)},
                                              {"block", BRC_VALUE_BUFFER, OF_LEVEL(block)}};
    static const brc_value_row of_transfer[] = {{"start", BRC_VALUE_BUFFER, OF_LEVEL(p_start)},
                                                {"column", BRC_VALUE_BUFFER, OF_LEVEL(p_column)},
                                                {"block", BRC_VALUE_BUFFER, OF_LEVEL(p_block)},
                                                {"column_start", BRC_VALUE_BUFFER, OF_LEVEL(p_column_start)},
                                                {"place", BRC_VALUE_BUFFER, OF_LEVEL(p_entry)}};
    static const brc_value_row of_aggregates[] = {{"start", BRC_VALUE_BUFFER, OF_LEVEL(member_start)},
                                                  {"member", BRC_VALUE_BUFFER, OF_LEVEL(member)},
                                                  {"aggregate", BRC_VALUE_BUFFER, OF_LEVEL(aggregate)},
                                                  {"arm", BRC_VALUE_BUFFER, OF_LEVEL(arm)},
                                                  {"free_bits", BRC_VALUE_BUFFER, OF_LEVEL(free_bits)}};
    brc_simulation *s = m->s;
    brc_level_passes *p = &m->pass;
    const brc_scope run = brc_scope_of_run(s);
    const brc_scope vectors = {.owner = "vectors", .kind = BRC_SCOPE_REQUEST, BRC_VALUES(of_launch), .outer = &run};
    const brc_scope finest = {.owner = "multigrid", .base = m, BRC_VALUES(of_finest), .outer = &vectors};
    const brc_scope matrix = {.owner = "level", .kind = BRC_SCOPE_ITEM, BRC_VALUES(of_matrix), .outer = &vectors};
    const brc_scope transfer = {
        .owner = "transfer", .kind = BRC_SCOPE_ITEM, BRC_VALUES(of_transfer), .outer = &vectors};
    const brc_scope aggregates = {
        .owner = "aggregates", .kind = BRC_SCOPE_ITEM, BRC_VALUES(of_aggregates), .outer = &vectors};
    const struct {
        brc_pass **slot;
        const brc_scope *scope;
        const char *kernel, *open;
    } wanted[] = {{&p->cells, &finest, "multigrid_cells", NULL},
                  {&p->ground, &finest, "multigrid_ground", NULL},
                  {&p->coarsest, &finest, "multigrid_coarsest", NULL},
                  {&p->matrix, &matrix, "multigrid_matrix", NULL},
                  {&p->finest_step, &matrix, "multigrid_finest_step", "weight add"},
                  {&p->step, &matrix, "multigrid_step", "weight add"},
                  {&p->collect, &aggregates, "multigrid_collect", "whole_force whole_torque whole_virial"},
                  {&p->spread, &aggregates, "multigrid_spread", "whole_move whole_turn whole_swell"},
                  {&p->prolong, &transfer, "multigrid_prolong", "coarse_move coarse_turn coarse_swell"},
                  {&p->restriction, &transfer, "multigrid_restrict", "coarse_force coarse_torque coarse_virial"}};
    m->by_branch = s->model->turns; /* which cells that turn store */
    m->vector = m->by_branch ? brc_offset_of(s) : brc_area_of(s);
    m->number = m->by_branch ? brc_area_of(s) : brc_ratio_of(s);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; ++i)
        BRC_TRY(brc_pass_make(s->context, s->device, wanted[i].scope, wanted[i].kernel, wanted[i].open, &p->all,
                              wanted[i].slot));
    return BRC_OK;
}

/* Integers that the host has wider. */
static brc_status upload_narrowed(brc_simulation *s, brc_buffer *out, const int64_t *values, int64_t count)
{
    BRC_LOCAL(s->context, count, int32_t, narrow, "multigrid");
    for (int64_t i = 0; i < count; ++i)
        narrow[i] = (int32_t)values[i];
    return brc_upload_int(out, narrow, count);
}

/* Integers by element to rows; padding: fill. */
static brc_status upload_rows(brc_simulation *s, brc_buffer *out, const int32_t *of_element, const uint8_t *bits,
                              int32_t fill)
{
    const brc_layout *layout = s->layout;
    BRC_LOCAL(s->context, layout->n_rows, int32_t, rows, "multigrid");
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        rows[r] = e < 0 ? fill : of_element ? of_element[e] : bits[e];
    }
    return brc_upload_int(out, rows, layout->n_rows);
}

/* Moduli of several materials, and blocks of held faces, rows by columns. */
static brc_status upload_bonds(brc_multigrid *m, const brc_fine *f)
{
    brc_simulation *s = m->s;
    BRC_FREED double *moduli = NULL;
    BRC_FREED int32_t *rows = NULL;
    m->moduli = f->moduli[s->material_of_element[0]];
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_fields, 0, m));
    if (brc_solves_rotations(s->model)) return BRC_OK;
    if (brc_device_has_many_materials(s->device)) {
        BRC_TRY(BRC_ALLOCATE(s->context, &moduli, 3 * (int64_t)s->layout->n_rows, "multigrid"));
        for (int32_t r = 0; r < s->layout->n_rows; ++r) {
            const int32_t e = s->layout->element_of_row[r];
            const brc_bond_moduli *k = &f->moduli[s->material_of_element[e < 0 ? 0 : e]];
            moduli[3 * (int64_t)r] = k->axial, moduli[3 * (int64_t)r + 1] = k->shear,
                       moduli[3 * (int64_t)r + 2] = k->frame;
        }
        BRC_TRY(brc_upload_coeff(s, m->moduli_of, moduli, 3 * (int64_t)s->layout->n_rows));
    }
    m->n_ground = f->n_ground;
    if (f->n_ground > 0) {
        BRC_TRY(BRC_ALLOCATE(s->context, &rows, f->n_ground, "multigrid"));
        for (int32_t i = 0; i < f->n_ground; ++i)
            rows[i] = s->layout->row_of_element[f->ground_element[i]];
        BRC_TRY(brc_multigrid_list(m, &brc_multigrid_ground_fields, f->n_ground, m));
        BRC_TRY(brc_upload_int(m->ground_element, rows, f->n_ground));
        BRC_TRY(brc_upload_state(s, m->ground, f->ground[0], 36 * (int64_t)f->n_ground)); /* symmetric */
    }
    return BRC_OK;
}

/* [n_elements][21] to [n_slices][21][C]. */
static brc_status upload_inverse(brc_simulation *s, brc_buffer *out, const double *inverse)
{
    const brc_layout *layout = s->layout;
    BRC_LOCAL(s->context, 21 * (int64_t)layout->n_rows, double, sliced, "multigrid");
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int32_t e = layout->element_of_row[r];
        double *to = sliced + 21 * (int64_t)(r / layout->slice * layout->slice) + r % layout->slice;
        for (int k = 0; e >= 0 && k < 21; ++k)
            to[k * layout->slice] = inverse[21 * (int64_t)e + k];
    }
    return brc_upload_state(s, out, sliced, 21 * (int64_t)layout->n_rows);
}

/* The finest level: inverse [n_elements][21]. */
static brc_status upload_finest(brc_multigrid *m, const brc_fine *f, const double *inverse)
{
    brc_simulation *s = m->s;
    brc_level *l = &m->level[0];
    l->n = s->layout->n_rows;
    BRC_TRY(upload_bonds(m, f));
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_finest_fields, 0, l));
    BRC_TRY(upload_inverse(s, l->inverse, inverse));
    return upload_rows(s, l->free_bits, NULL, f->nodes.free_bits, 0);
}

static brc_status upload_aggregates(brc_multigrid *m, const brc_nodes *nodes, const int32_t *aggregate,
                                    const brc_nodes *coarse)
{
    brc_simulation *s = m->s;
    brc_level *l = &m->level[0];
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_aggregate_fields, coarse->n, l));
    BRC_TRY(upload_rows(s, l->aggregate, aggregate, NULL, -1));
    BRC_LOCAL(s->context, coarse->n + 2, int32_t, start, "multigrid");
    BRC_LOCAL(s->context, nodes->n, int32_t, member, "multigrid");
    BRC_LOCAL(s->context, 3 * (int64_t)s->layout->n_rows, double, arm, "multigrid");
    for (int64_t e = 0; e < nodes->n; ++e)
        if (aggregate[e] >= 0) start[aggregate[e] + 2] += 1;
    for (int64_t i = 1; i <= coarse->n; ++i)
        start[i + 1] += start[i];
    for (int64_t e = 0; e < nodes->n; ++e) {
        if (aggregate[e] < 0) continue;
        member[start[aggregate[e] + 1]++] = s->layout->row_of_element[e];
        for (int c = 0; c < 3; ++c)
            arm[3 * (int64_t)s->layout->row_of_element[e] + c] = nodes->place[e][c] - coarse->place[aggregate[e]][c];
    }
    BRC_TRY(brc_upload_int(l->member_start, start, coarse->n + 1));
    BRC_TRY(brc_upload_int(l->member, member, nodes->n));
    return brc_upload_coeff(s, l->arm, arm, 3 * (int64_t)s->layout->n_rows);
}

/* Where a block has the number of a row and a column on the device (multigrid.cl). */
static int place_in_block(int r, int c)
{
    if (r < 6 && c < 6) return 6 * c + r;
    return r < 6 ? 36 + r : 42 + c;
}

/* Blocks of coarser levels, by rows, to those of a device buffer. */
static brc_status upload_blocks(const brc_multigrid *m, brc_buffer *out, int64_t count, const double *wide,
                                const float *narrow)
{
    enum { CHUNK = 4096 };
    const int bytes = brc_state_bytes(m->s), each = m->coarse_unknowns, size = each * each;
    BRC_LOCAL(m->s->context, size * CHUNK, double, part, "multigrid");
    BRC_LOCAL(m->s->context, size * CHUNK, float, single, "multigrid");
    for (int64_t first = 0; first < count; first += CHUNK) {
        const int64_t n = count - first < CHUNK ? count - first : CHUNK;
        for (int64_t k = 0; k < n; ++k)
            for (int r = 0; r < each; ++r)
                for (int c = 0; c < each; ++c) {
                    const int64_t from = size * (first + k) + each * r + c, to = size * k + place_in_block(r, c);
                    part[to] = wide ? wide[from] : (double)narrow[from];
                    single[to] = (float)part[to];
                }
        BRC_TRY(brc_buffer_write(out, size * first * bytes, bytes == 8 ? (const void *)part : (const void *)single,
                                 size * n * bytes));
    }
    return BRC_OK;
}

static brc_status upload_prolongation(const brc_multigrid *m, brc_level *l, const brc_prolongation *p)
{
    brc_simulation *s = m->s;
    const int64_t n = p->start[p->n];
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_start_fields, p->n, l));
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_coarse_fields, p->n_coarse, l));
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_transfer_fields, n, l));
    BRC_TRY(upload_narrowed(s, l->p_start, p->start, p->n + 1));
    BRC_TRY(brc_upload_int(l->p_column, p->column, n));
    BRC_TRY(upload_blocks(m, l->p_block, n, NULL, p->block));
    BRC_TRY(upload_narrowed(s, l->p_column_start, p->column_start, p->n_coarse + 1));
    return brc_upload_int(l->p_entry, p->entry[0], 2 * n);
}

static brc_status upload_matrix(const brc_multigrid *m, brc_level *l, const brc_stored_rows *rows,
                                const double *inverse)
{
    brc_simulation *s = m->s;
    l->n = rows->n;
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_level_fields, rows->n, l));
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_matrix_fields, rows->start[rows->n], l));
    BRC_TRY(upload_narrowed(s, l->start, rows->start, rows->n + 1));
    BRC_TRY(brc_upload_int(l->column, rows->column, rows->start[rows->n]));
    BRC_TRY(upload_blocks(m, l->block, rows->start[rows->n], rows->block, NULL));
    return brc_upload_state(s, l->inverse, inverse, brc_triangle(rows->unknowns) * rows->n);
}

/* Two thirds of the way of a step that the stiffest direction bears just so. given: 0, or the weight. */
static brc_status weigh(brc_multigrid *m, int level, double given)
{
    static const double above = 1.05; /* what a power iteration misses */
    double stiffest;
    m->level[level].weight = given;
    if (given > 0) return BRC_OK;
    BRC_TRY(brc_level_stiffest(m, level, false, &stiffest));
    m->level[level].weight = 4 / (3 * above * stiffest);
    return BRC_OK;
}

/* The same of a step of the law. */
static brc_status weigh_law(brc_multigrid *m, double given)
{
    static const double part = 1.5, above = 1.05;
    double stiffest;
    BRC_LOCAL(m->s->context, 6 * (int64_t)m->s->layout->n_rows, double, blocks, "multigrid");
    BRC_TRY(brc_multigrid_list(m, &brc_multigrid_law_fields, 0, m));
    BRC_TRY(m->s->model->statics->blocks(m->s, blocks));
    BRC_TRY(brc_upload_state(m->s, m->law_inverse, blocks, 6 * (int64_t)m->s->layout->n_rows));
    m->law_weight = given > 0 ? given : 1;
    if (given > 0) return BRC_OK;
    BRC_TRY(brc_level_stiffest(m, 0, true, &stiffest));
    m->law_weight = part / (above * stiffest);
    return BRC_OK;
}

/* The inverse of the coarsest level, where it is small. */
static brc_status solve_coarsest(brc_multigrid *m, const brc_stored_rows *rows)
{
    brc_simulation *s = m->s;
    bool done = false;
    const int64_t n = rows->unknowns * rows->n;
    if (rows->n > MOST_SOLVED) return BRC_OK;
    BRC_LOCAL(s->context, n * n, double, inverse, "coarsest level");
    brc_status status = brc_invert_rows(s->context, rows, inverse, &done);
    if (status == BRC_OK && done) status = brc_multigrid_list(m, &brc_multigrid_coarsest_fields, rows->n * rows->n, m);
    if (status == BRC_OK && done) status = brc_upload_state(s, m->inverse, inverse, n * n);
    return status;
}

/* What the host has of the level that was made last. */
typedef struct made_level {
    brc_rows rows;
    brc_stored_rows stored;
    brc_nodes nodes;
    double *inverse;
} made_level;

/* The nodes of the finest level are those of `fine`. */
static void free_made(made_level *made, const brc_fine *f)
{
    brc_stored_rows_free(&made->stored);
    brc_memory_free(made->inverse);
    if (made->nodes.place != f->nodes.place) brc_nodes_free(&made->nodes);
}

/* The next level in place of the one before. *more: false, and nothing done, where aggregates would not be fewer. */
static brc_status make_next(brc_multigrid *m, const brc_fine *f, made_level *made, const double *size, bool *more)
{
    brc_simulation *s = m->s;
    const int level = m->n_levels - 1;
    made_level next = {0};
    brc_prolongation p = {0};
    int32_t *aggregate = NULL;
    brc_status status = BRC_OK;
    *more = false;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &aggregate, made->rows.n, "aggregates"));
    BRC_TRY_OR(cleanup, brc_aggregate(s->context, &made->rows, &made->nodes, size, f->spacing, m->coarse_unknowns,
                                      aggregate, &next.nodes));
    if (next.nodes.n == 0 || (double)next.nodes.n > 0.7 * (double)made->rows.n || m->n_levels == BRC_MOST_LEVELS)
        goto cleanup;
    BRC_TRY_OR(cleanup, brc_prolongation_create(s->context, &made->rows, &made->nodes, aggregate, &next.nodes,
                                                m->level[level].weight, made->inverse, &p));
    BRC_TRY_OR(cleanup, brc_coarse_rows(s->context, &made->rows, &p, &next.stored));
    if (level == 0 && f->volumes)
        BRC_TRY_OR(cleanup, brc_fine_add_volumes(f, aggregate, &next.nodes, &p, &next.stored));
    if (brc_memory_held() > m->most_held) m->most_held = brc_memory_held();
    BRC_TRY_OR(cleanup, level == 0 ? upload_aggregates(m, &made->nodes, aggregate, &next.nodes)
                                   : upload_prolongation(m, &m->level[level], &p));
    next.rows = brc_rows_of(&next.stored);
    BRC_TRY_OR(cleanup,
               BRC_ALLOCATE(s->context, &next.inverse, brc_triangle(m->coarse_unknowns) * next.nodes.n, "levels"));
    BRC_TRY_OR(cleanup, brc_invert_blocks(s->context, &next.rows, NULL, next.inverse));
    BRC_TRY_OR(cleanup, upload_matrix(m, &m->level[m->n_levels++], &next.stored, next.inverse));
    BRC_TRY_OR(cleanup, weigh(m, m->n_levels - 1, 0));
    *more = true;
    const made_level before = *made;
    *made = next;
    made->rows.of = &made->stored;
    next = before;
cleanup:
    brc_memory_free(aggregate);
    brc_prolongation_free(&p);
    free_made(&next, f);
    return status;
}

static brc_status make_levels(brc_multigrid *m, const brc_fine *f, double weight)
{
    brc_simulation *s = m->s;
    made_level made = {.rows = f->rows, .nodes = f->nodes};
    double *size = NULL;
    int32_t n_bodies = 1;
    bool more = true;
    brc_status status = BRC_OK;
    for (int64_t e = 0; e < f->nodes.n; ++e)
        if (f->nodes.body[e] >= n_bodies) n_bodies = f->nodes.body[e] + 1;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &size, n_bodies, "levels"));
    for (int32_t b = 0; b < n_bodies; ++b)
        size[b] = box_in_spacings * f->spacing[b];
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &made.inverse, brc_triangle(f->rows.unknowns) * f->nodes.n, "levels"));
    BRC_TRY_OR(cleanup, brc_invert_blocks(s->context, &made.rows, f->nodes.free_bits, made.inverse));
    BRC_TRY_OR(cleanup, upload_finest(m, f, made.inverse));
    m->n_levels = 1;
    BRC_TRY_OR(cleanup, weigh(m, 0, weight));
    while (more && made.rows.n > MOST_SOLVED) {
        BRC_TRY_OR(cleanup, make_next(m, f, &made, size, &more));
        for (int32_t b = 0; b < n_bodies; ++b)
            size[b] *= 2;
    }
    if (m->n_levels > 1) BRC_TRY_OR(cleanup, solve_coarsest(m, &made.stored));
cleanup:
    free_made(&made, f);
    brc_memory_free(size);
    return status;
}

brc_status brc_multigrid_create(brc_simulation *s, brc_multigrid_origin *origin, brc_multigrid **out)
{
    const int64_t held = brc_memory_held(), on_device = brc_device_bytes(s->device);
    const double since = omp_get_wtime();
    BRC_ENDS_WITH(brc_multigrid_free) brc_multigrid *m = NULL;
    BRC_ENDS_WITH(brc_fine_free) brc_fine fine = {0};
    *out = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &m, 1, "multigrid"));
    m->s = s;
    BRC_TRY(make_passes(m));
    if (!(origin->weight > 0) && s->fracture) origin->moment = brc_fracture_moment(s);
    BRC_TRY(brc_fine_create(s, origin->moment, &fine));
    m->coarse_unknowns = fine.coarse_unknowns;
    BRC_TRY(make_levels(m, &fine, origin->weight));
    m->coarse_steps = fine.volumes ? 3 : 1;
    m->short_cycle = fine.stiff_volume;
    if (brc_multigrid_has_law_steps(s)) BRC_TRY(weigh_law(m, origin->law_weight));
    origin->weight = m->level[0].weight;
    origin->law_weight = m->law_weight;
    m->report = (brc_multigrid_report){.n_levels = m->n_levels,
                                       .device_bytes = brc_device_bytes(s->device) - on_device,
                                       .host_bytes = m->most_held - held,
                                       .seconds = omp_get_wtime() - since};
    for (int i = 0; i < m->n_levels; ++i)
        m->report.nodes[i] = i == 0 ? s->domain->n_elements : m->level[i].n;
    *out = m;
    m = NULL;
    return BRC_OK;
}

void brc_multigrid_free(brc_multigrid **multigrid)
{
    brc_multigrid *m = *multigrid;
    if (!m) return;
    brc_multigrid_fields_free(m);
    brc_passes_free(&m->pass.all);
    brc_memory_free(m);
    *multigrid = NULL;
}

brc_multigrid_report brc_multigrid_get_report(const brc_multigrid *multigrid)
{
    return multigrid->report;
}
