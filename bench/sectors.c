#include "sectors.h"
#include "card.h"
#include "cube.h"
#include "../host/base/memory.h"
#include "../host/device/gpu_layout.h"
#include "../host/solver/core/layout.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WARP = BRC_GPU_SLICE, SECTOR = 32, GROUPS = 4 };
static const int group_sizes[GROUPS] = {128, 256, 512, 1024};

/* What passes gather. */
static const struct {
    const char *name, *precision;
    brc_card_record record;
    int numbers, bytes;
} records[] = {{"displacement (gradient, force)", "double, mixed", BRC_CARD_PLACE, 3, 8},
               {"H, P or flux (flux pass, force)", "double", BRC_CARD_MATRIX, 9, 8},
               {"H, P or flux (flux pass, force)", "mixed, single", BRC_CARD_MATRIX, 9, 4},
               {"orientation (published, cbm)", "double, mixed", BRC_CARD_ORIENTATION, 4, 8},
               {"strain (published_force)", "double", BRC_CARD_STRAIN, 6, 8},
               {"strain (published_force)", "mixed, single", BRC_CARD_STRAIN, 6, 4}};
enum { N_RECORDS = sizeof records / sizeof records[0] };

/* Where number c of the record of a row lies [byte]: row x stride + c x bytes, or c arrays of n_rows. */
typedef struct storage {
    const char *name;
    int64_t stride, column; /* column: between numbers; 0: they follow one another */
} storage;

/* Neighbour of every stored half-edge [n_slots][WARP], home where there is none. */
static void find_neighbours(const brc_layout *l, const brc_domain *d, int32_t *out)
{
    for (int32_t s = 0; s < l->n_slices; ++s)
        for (int64_t k = (int64_t)l->slot_start[s] * WARP; k < (int64_t)l->slot_start[s + 1] * WARP; ++k)
            out[k] =
                l->half_edge[k] < 0 ? s * WARP + (int32_t)(k % WARP) : l->row_of_element[d->neighbour[l->half_edge[k]]];
}

/* Sectors that the things [n] of one fetch touch, each once: stamp [of every sector] is the last fetch that had it. */
static int64_t touch(const storage *how, int numbers, int bytes, int64_t n, const int32_t *rows, int64_t fetch,
                     int64_t *stamp)
{
    int64_t count = 0;
    for (int64_t i = 0; i < n; ++i)
        for (int c = 0; c < numbers; ++c) {
            const int64_t first = rows[i] * how->stride + c * (how->column ? how->column : bytes);
            for (int64_t sector = first / SECTOR; sector <= (first + bytes - 1) / SECTOR; ++sector) {
                count += stamp[sector] != fetch;
                stamp[sector] = fetch;
            }
        }
    return count;
}

/* *single: sectors where each slot of a warp is fetched for itself; grouped [GROUPS]: where groups fetch each once. */
static brc_status count(brc_context *context, const brc_layout *l, const int32_t *neighbour, const storage *how,
                        int numbers, int bytes, int64_t *single, int64_t grouped[GROUPS])
{
    const int64_t n_sectors = (l->n_rows * how->stride + (numbers - 1) * how->column) / SECTOR + 2;
    int64_t *stamp = NULL, fetch = 1;
    BRC_TRY(BRC_ALLOCATE(context, &stamp, n_sectors, "sectors"));
    *single = 0;
    for (int64_t slot = 0; slot < l->n_slots; ++slot)
        *single += touch(how, numbers, bytes, WARP, neighbour + slot * WARP, fetch++, stamp);
    for (int g = 0; g < GROUPS; ++g) {
        const int32_t slices = group_sizes[g] / WARP;
        grouped[g] = 0;
        for (int32_t s = 0; s < l->n_slices; s += slices) {
            const int32_t end = s + slices < l->n_slices ? s + slices : l->n_slices;
            const int64_t first = (int64_t)l->slot_start[s] * WARP;
            grouped[g] += touch(how, numbers, bytes, (int64_t)l->slot_start[end] * WARP - first, neighbour + first,
                                fetch++, stamp);
        }
    }
    brc_memory_free(stamp);
    return BRC_OK;
}

/* A sample in the layout of a GPU, and the sectors of packed records that were counted on it. */
typedef struct {
    const brc_domain *domain;
    const brc_layout *layout;
    const int32_t *neighbour;
    double single[N_RECORDS], grouped[N_RECORDS][GROUPS]; /* bytes a stored half-edge */
} sample;

static double stored_half_edges(const sample *c)
{
    return (double)c->layout->n_slots * WARP;
}

static brc_status finish_row(const brc_sectors_request *r, const sample *c, brc_rows *rows)
{
    brc_rows_integer(rows, "bonds", c->domain->n_bonds);
    brc_rows_stamp(rows);
    return rows->status != BRC_OK ? rows->status : r->row ? r->row(r->self, rows) : BRC_OK;
}

static void add_bytes(brc_rows *rows, double wanted, double single, const double grouped[GROUPS])
{
    brc_rows_number(rows, "record_bytes", wanted);
    brc_rows_number(rows, "sectors_per_gather", single / SECTOR);
    brc_rows_number(rows, "fetched_over_wanted", wanted > 0 ? single / wanted : NAN);
    for (int g = 0; g < GROUPS; ++g) {
        char key[32];
        snprintf(key, sizeof key, "group_%d_bytes", group_sizes[g]);
        brc_rows_number(rows, key, grouped[g]);
    }
}

static brc_status add_record(brc_context *context, const brc_sectors_request *r, sample *c, int k, const storage *how,
                             brc_rows *rows)
{
    int64_t single, grouped[GROUPS];
    double bytes[GROUPS];
    BRC_TRY(count(context, c->layout, c->neighbour, how, records[k].numbers, records[k].bytes, &single, grouped));
    const double per = SECTOR / stored_half_edges(c);
    for (int g = 0; g < GROUPS; ++g)
        bytes[g] = (double)grouped[g] * per;
    if (strcmp(how->name, "packed") == 0) {
        c->single[k] = (double)single * per;
        memcpy(c->grouped[k], bytes, sizeof bytes);
    }
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "sectors");
    brc_rows_text(rows, "quantity", records[k].name);
    brc_rows_text(rows, "precision", records[k].precision);
    brc_rows_text(rows, "storage", how->name);
    add_bytes(rows, records[k].numbers * records[k].bytes, (double)single * per, bytes);
    brc_rows_number(rows, "ours", (double)single * per / SECTOR);
    brc_rows_integer(rows, "elements", c->domain->n_elements);
    return finish_row(r, c, rows);
}

static int record_of(brc_card_record record, int coeff)
{
    for (int k = 0; k < N_RECORDS; ++k)
        if (records[k].record == record && (record < BRC_CARD_MATRIX || records[k].bytes == coeff)) return k;
    return 0;
}

/* Of a half-edge, those of the padding of rows included in each. */
static brc_card_traffic traffic_of(const sample *c, const brc_card_pass *p, int coeff, double *wanted, double *single,
                                   double grouped[GROUPS])
{
    const double half_edges = (double)c->domain->n_half_edges, padding = stored_half_edges(c) / half_edges;
    const double row = 4 * p->row_ints + coeff * p->row_coeffs, element = 8 * p->states + coeff * p->coeffs,
                 least = row + element * (double)c->domain->n_elements / half_edges, rows = padding * row,
                 again = padding * (4 * p->again_ints + coeff * p->again_coeffs),
                 own = (double)c->layout->n_rows / half_edges * element;
    *wanted = *single = 0;
    memset(grouped, 0, GROUPS * sizeof *grouped);
    for (int kind = 0; kind < BRC_CARD_RECORDS; ++kind) {
        const int k = record_of((brc_card_record)kind, coeff);
        const double times = padding * p->gathers[kind];
        *wanted += times * records[k].numbers * records[k].bytes;
        *single += times * c->single[k];
        for (int g = 0; g < GROUPS; ++g)
            grouped[g] += times * c->grouped[k][g];
    }
    double fetched = 0;
    for (int g = 0; g < GROUPS; ++g)
        if (group_sizes[g] == (coeff == 8 ? BRC_GPU_GROUP_DOUBLE : BRC_GPU_GROUP)) fetched = grouped[g];
    return (brc_card_traffic){least, rows + own, rows + again + own + fetched, padding * p->operations};
}

/* A pass of a model, and what it is to reach on a card. */
static brc_status add_pass(const brc_sectors_request *r, const sample *c, const brc_card_pass *p,
                           brc_precision precision, brc_rows *rows)
{
    double wanted, single, grouped[GROUPS];
    const brc_card_traffic t = traffic_of(c, p, precision == BRC_DOUBLE ? 8 : 4, &wanted, &single, grouped);
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "passes");
    brc_rows_text(rows, "quantity", p->name);
    brc_rows_text(rows, "model", p->model);
    brc_rows_text(rows, "precision", brc_precision_name(precision));
    add_bytes(rows, wanted, single, grouped);
    brc_rows_number(rows, "floor_bytes_per_bond", 2 * t.least);
    brc_rows_number(rows, "memory_bytes_per_bond", 2 * t.memory);
    brc_rows_number(rows, "cache_bytes_per_bond", 2 * t.cache);
    brc_rows_number(rows, "operations_per_bond", 2 * t.operations);
    brc_rows_number(rows, "ours", 2 * t.cache);
    brc_rows_integer(rows, "elements", c->domain->n_elements);
    return finish_row(r, c, rows);
}

/* The step of so many elements on a card. */
static brc_status add_step(const brc_sectors_request *r, const sample *c, brc_model_kind model, brc_precision precision,
                           double elements, brc_rows *rows)
{
    const brc_card *card = &brc_card_h200;
    const double half_edges = elements * (double)c->domain->n_half_edges / (double)c->domain->n_elements;
    brc_card_traffic sum = {0};
    double seconds = 0, launches = 0;
    for (int k = 0; k < brc_card_n_passes; ++k) {
        double wanted, single, grouped[GROUPS];
        if (strcmp(brc_card_passes[k].model, brc_model_name(model)) != 0) continue;
        const brc_card_traffic t =
            traffic_of(c, &brc_card_passes[k], precision == BRC_DOUBLE ? 8 : 4, &wanted, &single, grouped);
        seconds += brc_card_seconds(card, &t, precision, half_edges);
        sum.least += t.least, sum.memory += t.memory, sum.cache += t.cache, sum.operations += t.operations;
        launches += 1;
    }
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "card");
    brc_rows_text(rows, "quantity", card->name);
    brc_rows_text(rows, "model", brc_model_name(model));
    brc_rows_text(rows, "precision", brc_precision_name(precision));
    brc_rows_number(rows, "elements", elements);
    brc_rows_number(rows, "launches_per_step", launches);
    brc_rows_number(rows, "launch_s", card->launch_s);
    brc_rows_number(rows, "floor_bytes_per_bond", 2 * sum.least);
    brc_rows_number(rows, "memory_bytes_per_bond", 2 * sum.memory);
    brc_rows_number(rows, "cache_bytes_per_bond", 2 * sum.cache);
    brc_rows_number(rows, "operations_per_bond", 2 * sum.operations);
    brc_rows_number(rows, "seconds_by_model", seconds);
    brc_rows_number(rows, "bond_updates_per_s", 0.5 * half_edges / seconds);
    brc_rows_number(rows, "of_copy_bandwidth", half_edges * sum.least / seconds / card->copy);
    brc_rows_number(rows, "ours", 0.5 * half_edges / seconds);
    return finish_row(r, c, rows);
}

static brc_status add_model(const brc_sectors_request *r, const sample *c, brc_model_kind model, brc_rows *rows)
{
    static const brc_precision precisions[] = {BRC_DOUBLE, BRC_MIXED};
    static const double sizes[] = {1e5, 1e6, 4e6, 3e7};
    for (size_t p = 0; p < sizeof precisions / sizeof *precisions; ++p) {
        for (int k = 0; k < brc_card_n_passes; ++k)
            if (strcmp(brc_card_passes[k].model, brc_model_name(model)) == 0)
                BRC_TRY(add_pass(r, c, &brc_card_passes[k], precisions[p], rows));
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s)
            BRC_TRY(add_step(r, c, model, precisions[p], sizes[s], rows));
    }
    return BRC_OK;
}

static brc_status add_records(brc_context *context, const brc_sectors_request *r, sample *c, brc_rows *rows)
{
    for (int k = 0; k < N_RECORDS; ++k) {
        const int64_t bytes = records[k].bytes, packed = records[k].numbers * bytes, padded = (packed + 15) / 16 * 16;
        const storage ways[] = {
            {"packed", packed, 0}, {"padded", padded, 0}, {"split", bytes, c->layout->n_rows * bytes}};
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; ++w)
            if (w != 1 || padded != packed) BRC_TRY(add_record(context, r, c, k, &ways[w], rows));
    }
    return BRC_OK;
}

/* Records of a cube of cells or of spheres, and the models that are made of such. */
static brc_status measure_sample(brc_context *context, const brc_sectors_request *request, bool spheres, brc_rows *rows)
{
    brc_status status = BRC_OK;
    brc_domain *domain = NULL;
    brc_layout *layout = NULL;
    int32_t *neighbour = NULL;
    BRC_TRY_OR(cleanup, brc_cube_build(context, request->size, spheres, &domain));
    BRC_TRY_OR(cleanup, brc_layout_create(context, domain, WARP, &layout));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &neighbour, layout->n_slots * WARP, "neighbours"));
    find_neighbours(layout, domain, neighbour);
    sample c = {.domain = domain, .layout = layout, .neighbour = neighbour};
    BRC_TRY_OR(cleanup, add_records(context, request, &c, rows));
    for (int model = 0; model < BRC_N_MODELS; ++model)
        if (brc_cube_is_of_spheres((brc_model_kind)model) == spheres)
            BRC_TRY_OR(cleanup, add_model(request, &c, (brc_model_kind)model, rows));
cleanup:
    brc_memory_free(neighbour);
    brc_layout_free(&layout);
    brc_domain_free(&domain);
    return status;
}

brc_status brc_sectors_measure(brc_context *context, const brc_sectors_request *request, brc_rows *rows)
{
    BRC_TRY(measure_sample(context, request, false, rows));
    return measure_sample(context, request, true, rows);
}
