/* The volumes of cells under the motions of aggregates. A cell's surface is closed, so that its volume changes by
 * sum s.(u_j - u_i) / 2 over the bonds it has, less s.u_i over its held faces. Rigid aggregates move as they are: bonds
 * within one add nothing. Those that swell move by P, nearly as in P^T A P: what a negative modulus takes off must not
 * be more than there is. */
#include "fine.h"
#include <math.h>
#include <string.h>

/* Whose volumes: the finest level, its aggregates and the way to them. */
typedef struct motions {
    const brc_fine *f;
    const int32_t *aggregate;
    const brc_nodes *coarse;
    const brc_prolongation *p;
} motions;

/* The change of a cell's volume as a row of its aggregates' motions. */
typedef struct volume_row {
    int32_t n, *aggregate;
    double (*motion)[BRC_MOST_UNKNOWNS];
} volume_row;

/* Place of an aggregate in the row, `n` of it where it has none. */
static int32_t find_aggregate(const volume_row *row, int32_t aggregate)
{
    int32_t at = 0;
    while (at < row->n && row->aggregate[at] != aggregate)
        ++at;
    return at;
}

/* The same, with a new one where it has none. */
static int32_t meet(volume_row *row, int32_t aggregate)
{
    const int32_t at = find_aggregate(row, aggregate);
    if (at < row->n) return at;
    row->aggregate[row->n++] = aggregate;
    memset(row->motion[at], 0, sizeof *row->motion);
    return at;
}

/* u of a node, times s; its aggregate is rigid. */
static void add_rigid(const motions *v, int64_t node, const double s[3], volume_row *row)
{
    const int32_t of = v->aggregate[node];
    double arm[3], free[3];
    if (of < 0) return;
    const int32_t at = meet(row, of);
    for (int c = 0; c < 3; ++c) {
        arm[c] = v->f->nodes.place[node][c] - v->coarse->place[of][c];
        free[c] = v->f->nodes.free_bits[node] >> c & 1 ? s[c] : 0;
    }
    for (int c = 0; c < 3; ++c) {
        const int next = (c + 1) % 3, last = (c + 2) % 3;
        row->motion[at][c] += free[c];
        row->motion[at][3 + c] += arm[next] * free[last] - arm[last] * free[next];
    }
}

/* The same by P. An aggregate that the row has not, farther off than P^T A P couples, moves on as the node's own. */
static void add_swelling(const motions *v, int64_t node, const double s[3], volume_row *row)
{
    const brc_prolongation *p = v->p;
    const int32_t own = v->aggregate[node];
    for (int64_t k = p->start[node]; k < p->start[node + 1]; ++k) {
        const float *block = p->block + (int64_t)(p->unknowns * p->coarse_unknowns) * k;
        double motion[BRC_MOST_UNKNOWNS] = {0}, d[3];
        int32_t at = find_aggregate(row, p->column[k]);
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 7; ++c)
                motion[c] += s[r] * block[7 * r + c];
        if (at == row->n) {
            at = find_aggregate(row, own);
            for (int c = 0; c < 3; ++c)
                d[c] = v->coarse->place[p->column[k]][c] - v->coarse->place[own][c];
            for (int c = 0; c < 3; ++c) {
                const int next = (c + 1) % 3, last = (c + 2) % 3;
                motion[3 + c] += d[next] * motion[last] - d[last] * motion[next];
                motion[6] += d[c] * motion[c];
            }
        }
        for (int c = 0; c < 7; ++c)
            row->motion[at][c] += motion[c];
    }
}

static bool is_whole(const brc_fine *f, int64_t h)
{
    return !f->whole || f->whole[h];
}

/* Half the area of a bond, along its branch from e. */
static void find_half_area(const brc_fine *f, int64_t e, int64_t h, double half[3])
{
    const int64_t j = f->s->domain->neighbour[h];
    double square = 0;
    for (int c = 0; c < 3; ++c) {
        half[c] = f->nodes.place[j][c] - f->nodes.place[e][c];
        square += half[c] * half[c];
    }
    for (int c = 0; c < 3; ++c)
        half[c] *= 0.5 * brc_fine_area(f, h) / sqrt(square);
}

static void find_rigid_row(const motions *v, int64_t e, volume_row *row)
{
    const brc_fine *f = v->f;
    const brc_domain *d = f->s->domain;
    row->n = 0;
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        const int64_t j = d->neighbour[h];
        double half[3];
        if (!is_whole(f, h) || v->aggregate[j] == v->aggregate[e]) continue;
        find_half_area(f, e, h, half);
        const double back[3] = {-half[0], -half[1], -half[2]};
        add_rigid(v, j, half, row);
        add_rigid(v, e, back, row);
    }
    const int32_t held = brc_fine_ground(f, e);
    if (held < 0) return;
    const double *s = f->ground_area[held], less[3] = {-s[0], -s[1], -s[2]};
    add_rigid(v, e, less, row);
}

static void find_swelling_row(const motions *v, int64_t e, volume_row *row)
{
    const brc_fine *f = v->f;
    const brc_domain *d = f->s->domain;
    const int32_t held = brc_fine_ground(f, e);
    double own[3] = {0};
    row->n = 0;
    meet(row, v->aggregate[e]);
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
        if (is_whole(f, h)) meet(row, v->aggregate[d->neighbour[h]]);
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        double half[3];
        if (!is_whole(f, h)) continue;
        find_half_area(f, e, h, half);
        add_swelling(v, d->neighbour[h], half, row);
        for (int c = 0; c < 3; ++c)
            own[c] -= half[c];
    }
    for (int c = 0; c < 3 && held >= 0; ++c)
        own[c] -= f->ground_area[held][c];
    add_swelling(v, e, own, row);
}

/* rows += factor times the square of the row. */
static void add_square(const volume_row *row, double factor, brc_stored_rows *rows)
{
    const int n = rows->unknowns;
    for (int32_t a = 0; a < row->n; ++a)
        for (int32_t b = 0; b < row->n; ++b) {
            int64_t at = rows->start[row->aggregate[a]];
            while (rows->column[at] != row->aggregate[b])
                ++at;
            for (int r = 0; r < n; ++r)
                for (int c = 0; c < n; ++c)
                    rows->block[n * (n * at + r) + c] += factor * row->motion[a][r] * row->motion[b][c];
        }
}

brc_status brc_fine_add_volumes(const brc_fine *f, const int32_t *aggregate, const brc_nodes *coarse,
                                const brc_prolongation *p, brc_stored_rows *rows)
{
    const brc_simulation *s = f->s;
    BRC_LOCAL(s->context, f->rows.most, int32_t, column, "volumes");
    BRC_LOCAL(s->context, BRC_MOST_UNKNOWNS * (int64_t)f->rows.most, double, motion, "volumes");
    const motions v = {f, aggregate, coarse, p};
    volume_row row = {.aggregate = column, .motion = (double(*)[BRC_MOST_UNKNOWNS])motion};
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const double modulus = f->volume_modulus[s->material_of_element[e]];
        if (modulus == 0 || aggregate[e] < 0) continue;
        if (coarse->unknowns == 7)
            find_swelling_row(&v, e, &row);
        else
            find_rigid_row(&v, e, &row);
        add_square(&row, modulus / s->domain->volume[e], rows);
    }
    return BRC_OK;
}
