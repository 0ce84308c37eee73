/* Smoothed prolongation and the matrices of coarser levels. Every row is made by one thread, its sums in the order of
 * the rows, so that equal input gives equal bytes. */
#include "rows.h"
#include <stdlib.h>
#include <string.h>

/* a += factor b c, or factor b^T c, of so many rows, inner numbers and columns: element (r, k) of b is at
 * `down` r + `along` k. A function for each size, that the compiler writes its loops out. */
#define PRODUCT(name, rows, inner, columns, down, along)                                                               \
    static void name(double *restrict a, double factor, const double *restrict b, const double *restrict c)            \
    {                                                                                                                  \
        for (int r = 0; r < (rows); ++r) {                                                                             \
            double sum[columns] = {0};                                                                                 \
            for (int k = 0; k < (inner); ++k)                                                                          \
                for (int j = 0; j < (columns); ++j)                                                                    \
                    sum[j] += b[(down)*r + (along)*k] * c[(columns)*k + j];                                            \
            for (int j = 0; j < (columns); ++j)                                                                        \
                a[(columns)*r + j] += factor * sum[j];                                                                 \
        }                                                                                                              \
    }
PRODUCT(product_666, 6, 6, 6, 6, 1)
PRODUCT(product_667, 6, 6, 7, 6, 1)
PRODUCT(product_767, 7, 6, 7, 6, 1)
PRODUCT(product_777, 7, 7, 7, 7, 1)
PRODUCT(transposed_666, 6, 6, 6, 1, 6)
PRODUCT(transposed_766, 7, 6, 6, 1, 7)
PRODUCT(transposed_777, 7, 7, 7, 1, 7)

/* The products between a level and a coarser one: A T and D^-1 (A T); P^T A; (P^T A) P. */
typedef void product(double *restrict a, double factor, const double *restrict b, const double *restrict c);
typedef struct products {
    product *smooth, *gather, *coarse;
} products;

static products products_of(int unknowns, int coarse_unknowns)
{
    if (unknowns == 7) return (products){product_777, transposed_777, product_777};
    if (coarse_unknowns == 7) return (products){product_667, transposed_766, product_767};
    return (products){product_666, transposed_666, product_666};
}

/* Motion of an aggregate at one of its nodes, [unknowns of a node][those of an aggregate]: displacement
 * t + theta x arm + swelling arm. */
static void motion_block(const brc_nodes *nodes, const brc_nodes *coarse, int64_t i, int32_t aggregate, double *t)
{
    const int n = coarse->unknowns;
    double arm[3];
    memset(t, 0, (size_t)(nodes->unknowns * n) * sizeof *t);
    for (int c = 0; c < 3; ++c)
        arm[c] = nodes->place[i][c] - coarse->place[aggregate][c];
    for (int c = 0; c < nodes->unknowns; ++c)
        t[(n + 1) * c] = 1;
    for (int c = 0; c < 3; ++c) {
        const int next = (c + 1) % 3, last = (c + 2) % 3;
        t[n * c + 3 + next] = arm[last];
        t[n * c + 3 + last] = -arm[next];
        if (n == 7) t[n * c + 6] = arm[c];
    }
    for (int c = 0; nodes->free_bits && c < 6; ++c)
        if (!(nodes->free_bits[i] >> c & 1)) memset(t + n * c, 0, (size_t)n * sizeof *t);
}

static void whole_block(int n, const double *upper, double *out)
{
    for (int r = 0; r < n; ++r)
        for (int c = r; c < n; ++c)
            out[n * r + c] = out[n * c + r] = upper[brc_in_triangle(r, c)];
}

static int compare(const void *left, const void *right)
{
    const int32_t a = *(const int32_t *)left, b = *(const int32_t *)right;
    return (a > b) - (a < b);
}

/* Aggregates of the nodes in `column`, ascending, each once. Returns how many. */
static int32_t aggregates_of(const int32_t *aggregate, int32_t count, const int32_t *column, int32_t *found)
{
    int32_t n = 0;
    for (int32_t k = 0; k < count; ++k) {
        const int32_t one = aggregate[column[k]];
        int32_t at = 0;
        while (at < n && found[at] != one)
            ++at;
        if (one >= 0 && at == n) found[n++] = one;
    }
    qsort(found, (size_t)n, sizeof *found, compare);
    return n;
}

static int32_t place_in(const int32_t *ascending, int32_t wanted)
{
    int32_t at = 0;
    while (ascending[at] != wanted)
        ++at;
    return at;
}

/* Room of one thread for a row and what is made of it. */
typedef struct row_room {
    int32_t *column, *found;
    double *block, *sum;
} row_room;

/* unknowns: of a node of the sums; no fewer than those of a row. */
static brc_status get_room(brc_context *context, const brc_rows *rows, int unknowns, row_room *room)
{
    const int64_t most = rows->most, each = rows->unknowns;
    BRC_TRY(BRC_ALLOCATE(context, &room->column, most, "rows"));
    BRC_TRY(BRC_ALLOCATE(context, &room->found, most, "rows"));
    BRC_TRY(BRC_ALLOCATE(context, &room->block, each * each * most, "rows"));
    return BRC_ALLOCATE(context, &room->sum, each * unknowns * most, "rows");
}

static void free_room(row_room *room)
{
    brc_memory_free(room->column);
    brc_memory_free(room->found);
    brc_memory_free(room->block);
    brc_memory_free(room->sum);
}

typedef struct smoothing {
    const brc_rows *rows;
    const brc_nodes *nodes, *coarse;
    const int32_t *aggregate;
    double weight;
    const double *inverse;
} smoothing;

static void smooth_row(const smoothing *s, row_room *room, int64_t i, brc_prolongation *p)
{
    const int32_t count = s->rows->row(s->rows->of, i, room->column, room->block),
                  n = (int32_t)(p->start[i + 1] - p->start[i]);
    const int32_t *found = p->column + p->start[i];
    const int own = p->unknowns, size = own * p->coarse_unknowns;
    product *const add = products_of(own, p->coarse_unknowns).smooth;
    double motion[BRC_MOST_BLOCK], inverse[BRC_MOST_BLOCK];
    memset(room->sum, 0, (size_t)(size * n) * sizeof *room->sum);
    for (int32_t k = 0; k < count; ++k) {
        const int32_t of = s->aggregate[room->column[k]];
        if (of < 0) continue;
        motion_block(s->nodes, s->coarse, room->column[k], of, motion);
        add(room->sum + size * place_in(found, of), 1, room->block + own * own * k, motion);
    }
    whole_block(own, s->inverse + brc_triangle(own) * i, inverse);
    for (int32_t k = 0; k < n; ++k) {
        double out[BRC_MOST_BLOCK] = {0};
        if (found[k] == s->aggregate[i]) motion_block(s->nodes, s->coarse, i, found[k], out);
        add(out, -s->weight, inverse, room->sum + size * k);
        for (int c = 0; c < size; ++c)
            p->block[size * (p->start[i] + k) + c] = (float)out[c];
    }
}

/* Blocks by columns. */
static brc_status list_columns(brc_context *context, brc_prolongation *p)
{
    BRC_TRY(BRC_ALLOCATE(context, &p->column_start, p->n_coarse + 1, "prolongation"));
    BRC_TRY(BRC_ALLOCATE(context, &p->entry, p->start[p->n], "prolongation"));
    for (int64_t k = 0; k < p->start[p->n]; ++k)
        p->column_start[p->column[k] + 1] += 1;
    for (int64_t i = 0; i < p->n_coarse; ++i)
        p->column_start[i + 1] += p->column_start[i];
    for (int64_t i = 0; i < p->n; ++i)
        for (int64_t k = p->start[i]; k < p->start[i + 1]; ++k) {
            const int64_t at = p->column_start[p->column[k]]++;
            p->entry[at][0] = (int32_t)k;
            p->entry[at][1] = (int32_t)i;
        }
    for (int64_t i = p->n_coarse; i > 0; --i)
        p->column_start[i] = p->column_start[i - 1];
    p->column_start[0] = 0;
    return BRC_OK;
}

/* What a pass over the rows finds: how many aggregates each meets, which, and their blocks. */
typedef enum { COUNTS, COLUMNS, BLOCKS } filling;

static brc_status fill_rows(brc_context *context, const smoothing *s, filling what, brc_prolongation *p)
{
    const brc_rows *rows = s->rows;
    int failed = 0;
#pragma omp parallel reduction(+ : failed)
    {
        row_room room = {0};
        failed += get_room(context, rows, p->coarse_unknowns, &room) != BRC_OK;
#pragma omp for schedule(static)
        for (int64_t i = 0; i < rows->n; ++i) {
            if (failed) continue;
            if (what == BLOCKS) {
                smooth_row(s, &room, i, p);
                continue;
            }
            const int32_t n =
                aggregates_of(s->aggregate, rows->row(rows->of, i, room.column, NULL), room.column, room.found);
            if (what == COUNTS)
                p->start[i + 1] = n;
            else
                memcpy(p->column + p->start[i], room.found, (size_t)n * sizeof *room.found);
        }
        free_room(&room);
    }
    return failed ? BRC_NO_MEMORY : BRC_OK;
}

brc_status brc_prolongation_create(brc_context *context, const brc_rows *rows, const brc_nodes *nodes,
                                   const int32_t *aggregate, const brc_nodes *coarse, double weight,
                                   const double *inverse, brc_prolongation *out)
{
    const smoothing s = {rows, nodes, coarse, aggregate, weight, inverse};
    *out = (brc_prolongation){
        .n = rows->n, .n_coarse = coarse->n, .unknowns = nodes->unknowns, .coarse_unknowns = coarse->unknowns};
    BRC_TRY(BRC_ALLOCATE(context, &out->start, rows->n + 1, "prolongation"));
    BRC_TRY(fill_rows(context, &s, COUNTS, out));
    for (int64_t i = 0; i < rows->n; ++i)
        out->start[i + 1] += out->start[i];
    BRC_TRY(BRC_ALLOCATE(context, &out->column, out->start[rows->n], "prolongation"));
    BRC_TRY(
        BRC_ALLOCATE(context, &out->block, out->start[rows->n] * out->unknowns * out->coarse_unknowns, "prolongation"));
    BRC_TRY(fill_rows(context, &s, COLUMNS, out));
    BRC_TRY(fill_rows(context, &s, BLOCKS, out));
    return list_columns(context, out);
}

void brc_prolongation_free(brc_prolongation *p)
{
    brc_memory_free(p->start);
    brc_memory_free(p->column);
    brc_memory_free(p->block);
    brc_memory_free(p->column_start);
    brc_memory_free(p->entry);
    *p = (brc_prolongation){0};
}

/* Room of one thread for a row of P^T A and of P^T A P: blocks by the order in which their columns were met; mark[j] is
 * that place, -1: not met. */
typedef struct product_room {
    row_room row;
    int32_t *fine_mark, *coarse_mark, *fine, *coarse;
    double *fine_sum, *coarse_sum;
    int64_t fine_room, coarse_room;
} product_room;

static brc_status get_product_room(brc_context *context, const brc_rows *rows, const brc_prolongation *p,
                                   product_room *room)
{
    BRC_TRY(get_room(context, rows, p->coarse_unknowns, &room->row));
    BRC_TRY(BRC_ALLOCATE(context, &room->fine_mark, p->n, "products"));
    BRC_TRY(BRC_ALLOCATE(context, &room->coarse_mark, p->n_coarse, "products"));
    memset(room->fine_mark, -1, (size_t)p->n * sizeof *room->fine_mark);
    memset(room->coarse_mark, -1, (size_t)p->n_coarse * sizeof *room->coarse_mark);
    return BRC_OK;
}

static void free_product_room(product_room *room)
{
    void *all[] = {room->fine_mark, room->coarse_mark, room->fine, room->coarse, room->fine_sum, room->coarse_sum};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
        brc_memory_free(all[i]);
    free_room(&room->row);
}

/* The place of column j among those met, with a zero block of `size` numbers where it is new. */
static brc_status meet(brc_context *context, int32_t j, int size, int32_t *mark, int32_t *n, int32_t **list,
                       double **sum, int64_t *room)
{
    if (mark[j] >= 0) return BRC_OK;
    if (*n == *room) {
        *room = 2 * *room + 256;
        BRC_TRY(brc_memory_resize(context, (void **)list, *room, sizeof **list, "products"));
        BRC_TRY(brc_memory_resize(context, (void **)sum, size * *room, sizeof **sum, "products"));
    }
    memset(*sum + size * *n, 0, (size_t)size * sizeof **sum);
    (*list)[*n] = j;
    mark[j] = (*n)++;
    return BRC_OK;
}

static void widen(int size, const float *from, double *to)
{
    for (int c = 0; c < size; ++c)
        to[c] = from[c];
}

/* Row i of P^T A P into room->coarse_sum, its columns into room->coarse; n: how many. sums: else the columns alone. */
static brc_status product_row(brc_context *context, const brc_rows *rows, const brc_prolongation *p, int64_t i,
                              bool sums, product_room *room, int32_t *n)
{
    const int fine = p->unknowns, coarse = p->coarse_unknowns, across = fine * coarse, whole = coarse * coarse;
    const products add = products_of(fine, coarse);
    int32_t n_fine = 0;
    double block[BRC_MOST_BLOCK];
    *n = 0;
    for (int64_t k = p->column_start[i]; k < p->column_start[i + 1]; ++k) {
        const int32_t count = rows->row(rows->of, p->entry[k][1], room->row.column, sums ? room->row.block : NULL);
        if (sums) widen(across, p->block + (int64_t)across * p->entry[k][0], block);
        for (int32_t c = 0; c < count; ++c) {
            const int32_t j = room->row.column[c];
            BRC_TRY(meet(context, j, across, room->fine_mark, &n_fine, &room->fine, &room->fine_sum, &room->fine_room));
            if (sums)
                add.gather(room->fine_sum + across * room->fine_mark[j], 1, block, room->row.block + fine * fine * c);
        }
    }
    BRC_TRY(meet(context, (int32_t)i, whole, room->coarse_mark, n, &room->coarse, &room->coarse_sum,
                 &room->coarse_room)); /* the diagonal first */
    for (int32_t f = 0; f < n_fine; ++f) {
        const int32_t j = room->fine[f];
        room->fine_mark[j] = -1;
        for (int64_t k = p->start[j]; k < p->start[j + 1]; ++k) {
            BRC_TRY(meet(context, p->column[k], whole, room->coarse_mark, n, &room->coarse, &room->coarse_sum,
                         &room->coarse_room));
            if (!sums) continue;
            widen(across, p->block + across * k, block);
            add.coarse(room->coarse_sum + whole * room->coarse_mark[p->column[k]], 1, room->fine_sum + across * f,
                       block);
        }
    }
    for (int32_t c = 0; c < *n; ++c)
        room->coarse_mark[room->coarse[c]] = c;
    return BRC_OK;
}

static void store_row(const product_room *room, int64_t i, int32_t n, brc_stored_rows *out)
{
    const int64_t size = (int64_t)out->unknowns * out->unknowns;
    int32_t *to = out->column + out->start[i];
    memcpy(to, room->coarse, (size_t)n * sizeof *to);
    qsort(to + 1, (size_t)n - 1, sizeof *to, compare);
    for (int32_t c = 0; c < n; ++c)
        memcpy(out->block + size * (out->start[i] + c), room->coarse_sum + size * room->coarse_mark[to[c]],
               (size_t)size * sizeof *out->block);
}

brc_status brc_coarse_rows(brc_context *context, const brc_rows *rows, const brc_prolongation *p, brc_stored_rows *out)
{
    int failed = 0;
    *out = (brc_stored_rows){.n = p->n_coarse, .unknowns = p->coarse_unknowns};
    BRC_TRY(BRC_ALLOCATE(context, &out->start, p->n_coarse + 1, "coarse level"));
    for (int pass = 0; pass < 2; ++pass) {
#pragma omp parallel reduction(+ : failed)
        {
            product_room room = {0};
            failed += get_product_room(context, rows, p, &room) != BRC_OK;
#pragma omp for schedule(dynamic, 16)
            for (int64_t i = 0; i < p->n_coarse; ++i) {
                int32_t n = 0;
                if (failed) continue;
                failed += product_row(context, rows, p, i, pass == 1, &room, &n) != BRC_OK;
                if (pass == 0)
                    out->start[i + 1] = n;
                else if (!failed)
                    store_row(&room, i, n, out);
                for (int32_t c = 0; c < n; ++c)
                    room.coarse_mark[room.coarse[c]] = -1;
            }
            free_product_room(&room);
        }
        if (failed) return BRC_NO_MEMORY;
        if (pass == 1) break;
        for (int64_t i = 0; i < p->n_coarse; ++i) {
            if (out->start[i + 1] > out->most) out->most = (int32_t)out->start[i + 1];
            out->start[i + 1] += out->start[i];
        }
        BRC_TRY(BRC_ALLOCATE(context, &out->column, out->start[p->n_coarse], "coarse level"));
        BRC_TRY(BRC_ALLOCATE(context, &out->block, out->start[p->n_coarse] * out->unknowns * out->unknowns,
                             "coarse level"));
    }
    return BRC_OK;
}
