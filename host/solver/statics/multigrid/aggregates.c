/* Aggregates by boxes. */
#include "rows.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct boxed {
    int64_t box;
    int32_t node;
} boxed;

static int compare(const void *left, const void *right)
{
    const boxed *a = left, *b = right;
    return a->box != b->box ? (a->box < b->box ? -1 : 1) : (a->node > b->node) - (a->node < b->node);
}

/* Bounds of a body's nodes and its boxes along each axis. */
typedef struct body_boxes {
    double low[3], high[3], width[3];
    int64_t count[3], first;
} body_boxes;

static brc_status find_boxes(brc_context *context, const brc_nodes *nodes, const double *size, const double *spacing,
                             int32_t n_bodies, body_boxes **out)
{
    int64_t first = 0;
    body_boxes *b = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &b, n_bodies, "aggregates"));
    for (int32_t k = 0; k < n_bodies; ++k)
        for (int c = 0; c < 3; ++c)
            b[k].low[c] = INFINITY, b[k].high[c] = -INFINITY;
    for (int64_t i = 0; i < nodes->n; ++i)
        for (int c = 0; c < 3; ++c) {
            body_boxes *own = &b[nodes->body[i]];
            own->low[c] = fmin(own->low[c], nodes->place[i][c]);
            own->high[c] = fmax(own->high[c], nodes->place[i][c]);
        }
    for (int32_t k = 0; k < n_bodies; ++k) {
        b[k].first = first;
        for (int c = 0; c < 3; ++c) {
            const double extent = b[k].high[c] - b[k].low[c] + spacing[k];
            b[k].low[c] -= 0.5 * spacing[k];
            b[k].count[c] = extent > 1.5 * size[k] ? lround(extent / size[k]) : 1;
            b[k].width[c] = extent / (double)b[k].count[c];
        }
        first += b[k].count[0] * b[k].count[1] * b[k].count[2];
    }
    *out = b;
    return BRC_OK;
}

static int64_t box_of(const body_boxes *b, const double place[3])
{
    int64_t box = 0;
    for (int c = 0; c < 3; ++c) {
        const int64_t at = (int64_t)((place[c] - b->low[c]) / b->width[c]);
        box = box * b->count[c] + (at < 0 ? 0 : at >= b->count[c] ? b->count[c] - 1 : at);
    }
    return b->first + box;
}

/* Number the joined parts of each box. */
static brc_status number_parts(brc_context *context, const brc_rows *rows, const boxed *sorted, const int64_t *box,
                               int32_t *aggregate, int64_t *n)
{
    BRC_LOCAL(context, rows->n, int32_t, stack, "aggregates");
    BRC_LOCAL(context, rows->most, int32_t, column, "aggregates");
    *n = 0;
    for (int64_t i = 0; i < rows->n; ++i)
        aggregate[i] = -1;
    for (int64_t k = 0; k < rows->n; ++k) {
        int64_t top = 0;
        const int32_t seed = sorted[k].node;
        if (aggregate[seed] >= 0 || rows->row(rows->of, seed, column, NULL) == 1) continue;
        aggregate[seed] = (int32_t)*n;
        stack[top++] = seed;
        while (top > 0) {
            const int32_t now = stack[--top], count = rows->row(rows->of, now, column, NULL);
            for (int32_t c = 1; c < count; ++c) {
                if (aggregate[column[c]] >= 0 || box[column[c]] != box[now]) continue;
                aggregate[column[c]] = (int32_t)*n;
                stack[top++] = column[c];
            }
        }
        ++*n;
    }
    return BRC_OK;
}

static brc_status place_aggregates(brc_context *context, const brc_nodes *nodes, const int32_t *aggregate, int64_t n,
                                   int unknowns, brc_nodes *coarse)
{
    *coarse = (brc_nodes){.n = n, .unknowns = unknowns};
    BRC_TRY(BRC_ALLOCATE(context, &coarse->place, n, "aggregates"));
    BRC_TRY(BRC_ALLOCATE(context, &coarse->body, n, "aggregates"));
    BRC_LOCAL(context, n, int64_t, count, "aggregates");
    for (int64_t i = 0; i < nodes->n; ++i) {
        if (aggregate[i] < 0) continue;
        count[aggregate[i]] += 1;
        coarse->body[aggregate[i]] = nodes->body[i];
        for (int c = 0; c < 3; ++c)
            coarse->place[aggregate[i]][c] += nodes->place[i][c];
    }
    for (int64_t i = 0; i < n; ++i)
        for (int c = 0; c < 3; ++c)
            coarse->place[i][c] /= (double)count[i];
    return BRC_OK;
}

brc_status brc_aggregate(brc_context *context, const brc_rows *rows, const brc_nodes *nodes, const double *size,
                         const double *spacing, int unknowns, int32_t *aggregate, brc_nodes *coarse)
{
    BRC_FREED body_boxes *boxes = NULL;
    int64_t n;
    int32_t n_bodies = 0;
    for (int64_t i = 0; i < nodes->n; ++i)
        if (nodes->body[i] >= n_bodies) n_bodies = nodes->body[i] + 1;
    BRC_TRY(find_boxes(context, nodes, size, spacing, n_bodies, &boxes));
    BRC_LOCAL(context, nodes->n, boxed, sorted, "aggregates");
    BRC_LOCAL(context, nodes->n, int64_t, box, "aggregates");
    for (int64_t i = 0; i < nodes->n; ++i) {
        box[i] = box_of(&boxes[nodes->body[i]], nodes->place[i]);
        sorted[i] = (boxed){box[i], (int32_t)i};
    }
    qsort(sorted, (size_t)nodes->n, sizeof *sorted, compare);
    BRC_TRY(number_parts(context, rows, sorted, box, aggregate, &n));
    return place_aggregates(context, nodes, aggregate, n, unknowns, coarse);
}

void brc_nodes_free(brc_nodes *nodes)
{
    brc_memory_free(nodes->place);
    brc_memory_free(nodes->body);
    brc_memory_free(nodes->free_bits);
    *nodes = (brc_nodes){0};
}
