/* The volumes of cells under the motions of aggregates. A cell's surface is closed, so that its volume changes by
 * sum s.(u_j - u_i) / 2 over the bonds it has, less s.u_i over its held faces; bonds within an aggregate that does not
 * swell add nothing. */
#include "fine.h"
#include <math.h>
#include <string.h>

/* The change of a cell's volume as a row of its aggregates' motions. */
typedef struct volume_row {
    int32_t n, *aggregate;
    double (*motion)[BRC_MOST_UNKNOWNS];
} volume_row;

/* u of a node, times s. */
static void add_node(const brc_fine *f, const int32_t *aggregate, const brc_nodes *coarse, int64_t node,
                     const double s[3], volume_row *row)
{
    const int32_t of = aggregate[node];
    int32_t at = 0;
    double arm[3], free[3];
    if (of < 0) return;
    while (at < row->n && row->aggregate[at] != of)
        ++at;
    if (at == row->n) {
        row->aggregate[row->n++] = of;
        memset(row->motion[at], 0, sizeof *row->motion);
    }
    for (int c = 0; c < 3; ++c) {
        arm[c] = f->nodes.place[node][c] - coarse->place[of][c];
        free[c] = f->nodes.free_bits[node] >> c & 1 ? s[c] : 0;
    }
    for (int c = 0; c < 3; ++c) {
        const int next = (c + 1) % 3, last = (c + 2) % 3;
        row->motion[at][c] += free[c];
        row->motion[at][3 + c] += arm[next] * free[last] - arm[last] * free[next];
        row->motion[at][6] += arm[c] * free[c];
    }
}

static void find_row(const brc_fine *f, const int32_t *aggregate, const brc_nodes *coarse, int64_t e, volume_row *row)
{
    const brc_domain *d = f->s->domain;
    row->n = 0;
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        const int64_t j = d->neighbour[h];
        double half[3], back[3], square = 0;
        if ((f->whole && !f->whole[h]) || (aggregate[j] == aggregate[e] && coarse->unknowns == 6)) continue;
        for (int c = 0; c < 3; ++c) {
            half[c] = f->nodes.place[j][c] - f->nodes.place[e][c];
            square += half[c] * half[c];
        }
        for (int c = 0; c < 3; ++c) {
            half[c] *= 0.5 * brc_fine_area(f, h) / sqrt(square);
            back[c] = -half[c];
        }
        add_node(f, aggregate, coarse, j, half, row);
        add_node(f, aggregate, coarse, e, back, row);
    }
    const int32_t held = brc_fine_ground(f, e);
    if (held < 0) return;
    const double *s = f->ground_area[held], less[3] = {-s[0], -s[1], -s[2]};
    add_node(f, aggregate, coarse, e, less, row);
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
                                brc_stored_rows *rows)
{
    const brc_simulation *s = f->s;
    BRC_LOCAL(s->context, f->rows.most, int32_t, column, "volumes");
    BRC_LOCAL(s->context, BRC_MOST_UNKNOWNS * (int64_t)f->rows.most, double, motion, "volumes");
    volume_row row = {.aggregate = column, .motion = (double(*)[BRC_MOST_UNKNOWNS])motion};
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const double modulus = f->volume_modulus[s->material_of_element[e]];
        if (modulus == 0 || aggregate[e] < 0) continue;
        find_row(f, aggregate, coarse, e, &row);
        add_square(&row, modulus / s->domain->volume[e], rows);
    }
    return BRC_OK;
}
