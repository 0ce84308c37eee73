#include "cracks.h"
#include "../h5_pack.h"
#include "../../base/memory.h"
#include <math.h>

/* Breaks of all parts by step, those of a step part after part. list [n], count [n], next [n]: zeroed. */
static void merge(const brc_assembly *a, const brc_break *const *list, const int64_t *count, int64_t *next,
                  brc_break *out)
{
    for (;; ++out) {
        int32_t from = -1;
        for (int32_t k = 0; k < a->n; ++k)
            if (next[k] < count[k] && (from < 0 || list[k][next[k]].step < list[from][next[from]].step)) from = k;
        if (from < 0) return;
        const int32_t elements = (int32_t)brc_assembly_first_element(a, from),
                      bonds = (int32_t)brc_assembly_first_bond(a, from);
        *out = list[from][next[from]++];
        out->element_i += elements;
        out->element_j += elements;
        out->bond += bonds;
    }
}

static brc_status take_breaks(brc_context *context, const brc_assembly *a, brc_cracks *out)
{
    if (a->n == 1) return brc_simulation_breaks(a->part[0], &out->n_broken, &out->breaks);
    const brc_break **list = NULL;
    int64_t *count = NULL, *next = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &list, a->n, "broken bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &count, a->n, "broken bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &next, a->n, "broken bonds"));
    for (int32_t k = 0; k < a->n; ++k) {
        BRC_TRY_OR(cleanup, brc_simulation_breaks(a->part[k], &count[k], &list[k]));
        out->n_broken += count[k];
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->own, out->n_broken, "broken bonds"));
    merge(a, list, count, next, out->own);
    out->breaks = out->own;
cleanup:
    brc_memory_free(list);
    brc_memory_free(count);
    brc_memory_free(next);
    return status;
}

brc_status brc_cracks_take(brc_context *context, const brc_assembly *assembly, brc_cracks *out)
{
    int32_t *fragment = NULL;
    brc_cracks_free(out);
    BRC_TRY(BRC_ALLOCATE(context, &fragment, brc_assembly_first_element(assembly, assembly->n), "fragments"));
    const brc_status status = brc_cracks_fragments(assembly, fragment, &out->n_fragments);
    brc_memory_free(fragment);
    BRC_TRY(status);
    return take_breaks(context, assembly, out);
}

void brc_cracks_free(brc_cracks *cracks)
{
    brc_memory_free(cracks->own);
    *cracks = (brc_cracks){0};
}

/* Columns of the stream; those of several numbers are x, y, z. */
typedef struct column {
    const char *name;
    int width;
    double (*value)(const brc_break *b, int c);
} column;
static double time_of(const brc_break *b, int c)
{
    return (void)c, b->time;
}
static double position_of(const brc_break *b, int c)
{
    return b->position[c];
}
static double normal_of(const brc_break *b, int c)
{
    return b->normal[c];
}
static double stress_of(const brc_break *b, int c)
{
    return (void)c, b->stress;
}
static double energy_of(const brc_break *b, int c)
{
    return (void)c, b->energy;
}
static double area_of(const brc_break *b, int c)
{
    return (void)c, b->area;
}
static double load_of(const brc_break *b, int c)
{
    return (void)c, b->load;
}
static const column NUMBERS[] = {{"time", 1, time_of},     {"position", 3, position_of}, {"normal", 3, normal_of},
                                 {"stress", 1, stress_of}, {"energy", 1, energy_of},     {"area", 1, area_of},
                                 {"load", 1, load_of}};
static int64_t step_of(const brc_break *b)
{
    return b->step;
}
static int64_t stage_of(const brc_break *b)
{
    return b->stage;
}
static int64_t mode_of(const brc_break *b)
{
    return b->mode;
}
static int64_t bond_of(const brc_break *b)
{
    return b->bond;
}
static int64_t i_of(const brc_break *b)
{
    return b->element_i;
}
static int64_t j_of(const brc_break *b)
{
    return b->element_j;
}
static const struct {
    const char *name;
    int64_t (*value)(const brc_break *b);
} COUNTS[] = {{"step", step_of}, {"stage", stage_of}, {"mode", mode_of},
              {"bond", bond_of}, {"element_i", i_of}, {"element_j", j_of}};
enum { N_NUMBERS = sizeof NUMBERS / sizeof *NUMBERS, N_COUNTS = sizeof COUNTS / sizeof *COUNTS };

brc_status brc_cracks_write_h5(brc_context *context, brc_h5 *h5, const brc_cracks *cracks)
{
    const int64_t n = cracks->n_broken;
    double *number = NULL;
    int64_t *count = NULL;
    brc_status status = BRC_OK;
    char path[64];
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &number, 3 * n, "broken bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &count, n, "broken bonds"));
    brc_h5_group(h5, "cracks");
    brc_h5_attribute_integers(h5, "cracks", "fragments", 1, &cracks->n_fragments);
    for (int k = 0; k < N_NUMBERS; ++k) {
        const column *c = &NUMBERS[k];
        for (int64_t b = 0; b < n; ++b)
            for (int i = 0; i < c->width; ++i)
                number[c->width * b + i] = c->value(&cracks->breaks[b], i);
        snprintf(path, sizeof path, "cracks/%s", c->name);
        brc_h5_dataset(h5, path, H5T_NATIVE_DOUBLE, n, c->width == 1 ? 0 : c->width, number);
    }
    for (int k = 0; k < N_COUNTS; ++k) {
        for (int64_t b = 0; b < n; ++b)
            count[b] = COUNTS[k].value(&cracks->breaks[b]);
        snprintf(path, sizeof path, "cracks/%s", COUNTS[k].name);
        brc_h5_dataset(h5, path, H5T_NATIVE_INT64, n, 0, count);
    }
cleanup:
    brc_memory_free(number);
    brc_memory_free(count);
    return status;
}

const char *brc_cracks_csv_head(void)
{
    return "time [s],step,stage,mode,bond,element_i,element_j,x [m],y [m],z [m],nx,ny,nz,stress [Pa],energy [J],area "
           "[m^2],load\n";
}

brc_status brc_cracks_csv_add(brc_context *context, brc_append *file, const brc_cracks *cracks, int64_t *n_written)
{
    brc_text text = {.context = context};
    brc_status status = BRC_OK;
    const int64_t bytes = brc_append_bytes(file);
    for (int64_t k = *n_written; k < cracks->n_broken && status == BRC_OK; ++k) {
        const brc_break *b = &cracks->breaks[k];
        brc_text_add(&text, "%.17g,%lld,%d,%s,%d,%d,%d", b->time, (long long)b->step, (int)b->stage,
                     brc_break_mode_name(b->mode), (int)b->bond, (int)b->element_i, (int)b->element_j);
        for (int c = 0; c < 3; ++c)
            brc_text_add(&text, ",%.17g", b->position[c]);
        for (int c = 0; c < 3; ++c)
            brc_text_add(&text, ",%.17g", b->normal[c]);
        brc_text_add(&text, ",%.17g,%.17g,%.17g,%.17g\n", b->stress, b->energy, b->area, b->load);
        status = brc_append_piece(context, file, &text);
    }
    if (status == BRC_OK) status = brc_append_add(context, file, &text);
    if (status == BRC_OK)
        *n_written = cracks->n_broken;
    else
        brc_append_cut(file, bytes);
    brc_text_free(&text);
    return status;
}

brc_status brc_cracks_fragments(const brc_assembly *assembly, int32_t *fragment, int64_t *n_fragments)
{
    *n_fragments = 0;
    for (int32_t k = 0; k < assembly->n; ++k) {
        const int64_t first = brc_assembly_first_element(assembly, k),
                      end = brc_assembly_first_element(assembly, k + 1);
        int64_t n;
        BRC_TRY(brc_simulation_fragments(assembly->part[k], fragment + first, &n));
        for (int64_t e = first; e < end; ++e)
            fragment[e] += (int32_t)*n_fragments;
        *n_fragments += n;
    }
    return BRC_OK;
}

brc_status brc_cracks_write_frame(brc_context *context, brc_h5 *h5, const brc_assembly *assembly, int n_threads)
{
    const int64_t n = brc_assembly_first_element(assembly, assembly->n);
    int64_t n_fragments, n_broken = 0;
    double *damage = NULL;
    int32_t *fragment = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &damage, n, "damage of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &fragment, n, "fragments of a frame"));
    BRC_TRY_OR(cleanup, brc_cracks_fragments(assembly, fragment, &n_fragments));
    for (int32_t k = 0; k < assembly->n; ++k) {
        int64_t broken;
        BRC_TRY_OR(cleanup, brc_simulation_damage(assembly->part[k], damage + brc_assembly_first_element(assembly, k)));
        BRC_TRY_OR(cleanup, brc_simulation_broken(assembly->part[k], &broken));
        n_broken += broken;
    }
    brc_h5_packed(h5, "VTKHDF/CellData/damage", H5T_NATIVE_DOUBLE, n, 0);
    brc_h5_pack_rows_either(h5, "VTKHDF/CellData/damage", H5T_NATIVE_DOUBLE, 0, n, damage, n_threads);
    brc_h5_packed(h5, "VTKHDF/CellData/fragment", H5T_NATIVE_INT32, n, 0);
    brc_h5_pack_rows(h5, "VTKHDF/CellData/fragment", H5T_NATIVE_INT32, 0, n, fragment, n_threads);
    brc_h5_dataset(h5, "VTKHDF/FieldData/n_fragments", H5T_NATIVE_INT64, 1, 0, &n_fragments);
    brc_h5_dataset(h5, "VTKHDF/FieldData/n_broken", H5T_NATIVE_INT64, 1, 0, &n_broken);
cleanup:
    brc_memory_free(damage);
    brc_memory_free(fragment);
    return status;
}
