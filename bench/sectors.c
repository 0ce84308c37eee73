#include "sectors.h"
#include "cube.h"
#include "../host/base/memory.h"
#include "../host/solver/core/layout.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WARP = 32, SECTOR = 32, MOST_NUMBERS = 9, GROUPS = 3 };
static const int group_sizes[GROUPS] = {128, 512, 1024};

/* What passes gather. */
static const struct {
    const char *name, *precision;
    int numbers, bytes;
} records[] = {{"displacement (gradient, force)", "double, mixed", 3, 8},
               {"H, P or flux (flux pass, force)", "double", 9, 8},
               {"H, P or flux (flux pass, force)", "mixed, single", 9, 4},
               {"orientation (published, cbm)", "double, mixed", 4, 8},
               {"strain (published_force)", "double", 6, 8},
               {"strain (published_force)", "mixed, single", 6, 4}};
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

static brc_status add_row(brc_context *context, const brc_sectors_request *r, const brc_domain *d, const brc_layout *l,
                          const int32_t *neighbour, int k, const storage *how, brc_rows *rows)
{
    int64_t single, grouped[GROUPS];
    BRC_TRY(count(context, l, neighbour, how, records[k].numbers, records[k].bytes, &single, grouped));
    const double gathers = (double)l->n_slots * WARP, wanted = records[k].numbers * records[k].bytes;
    brc_rows_begin(rows);
    brc_rows_text(rows, "case", "sectors");
    brc_rows_text(rows, "quantity", records[k].name);
    brc_rows_text(rows, "precision", records[k].precision);
    brc_rows_text(rows, "storage", how->name);
    brc_rows_integer(rows, "record_bytes", (int64_t)wanted);
    brc_rows_number(rows, "sectors_per_gather", (double)single / gathers);
    brc_rows_number(rows, "fetched_over_wanted", (double)single * SECTOR / gathers / wanted);
    for (int g = 0; g < GROUPS; ++g) {
        char key[32];
        snprintf(key, sizeof key, "group_%d_bytes", group_sizes[g]);
        brc_rows_number(rows, key, (double)grouped[g] * SECTOR / gathers);
    }
    brc_rows_number(rows, "ours", (double)single / gathers);
    brc_rows_integer(rows, "elements", d->n_elements);
    brc_rows_integer(rows, "bonds", d->n_bonds);
    brc_rows_stamp(rows);
    return rows->status != BRC_OK ? rows->status : r->row ? r->row(r->self, rows) : BRC_OK;
}

brc_status brc_sectors_measure(brc_context *context, const brc_sectors_request *request, brc_rows *rows)
{
    brc_status status = BRC_OK;
    brc_domain *domain = NULL;
    brc_layout *layout = NULL;
    int32_t *neighbour = NULL;
    BRC_TRY_OR(cleanup, brc_cube_build(context, request->size, false, &domain));
    BRC_TRY_OR(cleanup, brc_layout_create(context, domain, WARP, &layout));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &neighbour, layout->n_slots * WARP, "neighbours"));
    find_neighbours(layout, domain, neighbour);
    for (int k = 0; k < N_RECORDS; ++k) {
        const int64_t bytes = records[k].bytes, packed = records[k].numbers * bytes, padded = (packed + 15) / 16 * 16;
        const storage ways[] = {{"packed", packed, 0}, {"padded", padded, 0}, {"split", bytes, layout->n_rows * bytes}};
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; ++w)
            if (w != 1 || padded != packed)
                BRC_TRY_OR(cleanup, add_row(context, request, domain, layout, neighbour, k, &ways[w], rows));
    }
cleanup:
    brc_memory_free(neighbour);
    brc_layout_free(&layout);
    brc_domain_free(&domain);
    return status;
}
