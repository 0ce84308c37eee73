#include "cracks.h"
#include "../base/memory.h"
#include <math.h>

brc_status brc_cracks_take(brc_context *context, brc_simulation *simulation, brc_cracks *out)
{
    int32_t *fragment = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &fragment, brc_simulation_domain(simulation)->n_elements, "fragments"));
    brc_status status = brc_simulation_breaks(simulation, &out->n_broken, &out->breaks);
    if (status == BRC_OK) status = brc_simulation_fragments(simulation, fragment, &out->n_fragments);
    brc_memory_free(fragment);
    return status;
}

/* Columns of the stream; those of several numbers are x, y, z. */
typedef struct column {
    const char *name, *unit;
    int width;
    double (*value)(const brc_break *b, int c);
} column;
static double time_of(const brc_break *b, int c) { return (void)c, b->time; }
static double position_of(const brc_break *b, int c) { return b->position[c]; }
static double normal_of(const brc_break *b, int c) { return b->normal[c]; }
static double stress_of(const brc_break *b, int c) { return (void)c, b->stress; }
static double energy_of(const brc_break *b, int c) { return (void)c, b->energy; }
static const column NUMBERS[] = {{"time", "s", 1, time_of},     {"position", "m", 3, position_of}, {"normal", "-", 3, normal_of},
                                 {"stress", "Pa", 1, stress_of}, {"energy", "J", 1, energy_of}};
static int64_t step_of(const brc_break *b) { return b->step; }
static int64_t stage_of(const brc_break *b) { return b->stage; }
static int64_t mode_of(const brc_break *b) { return b->mode; }
static int64_t bond_of(const brc_break *b) { return b->bond; }
static int64_t i_of(const brc_break *b) { return b->element_i; }
static int64_t j_of(const brc_break *b) { return b->element_j; }
static const struct {
    const char *name;
    int64_t (*value)(const brc_break *b);
} COUNTS[] = {{"step", step_of}, {"stage", stage_of}, {"mode", mode_of}, {"bond", bond_of}, {"element_i", i_of}, {"element_j", j_of}};
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
            for (int i = 0; i < c->width; ++i) number[c->width * b + i] = c->value(&cracks->breaks[b], i);
        snprintf(path, sizeof path, "cracks/%s", c->name);
        brc_h5_dataset(h5, path, H5T_NATIVE_DOUBLE, n, c->width == 1 ? 0 : c->width, number);
        brc_h5_attribute_text(h5, path, "unit", c->unit);
    }
    for (int k = 0; k < N_COUNTS; ++k) {
        for (int64_t b = 0; b < n; ++b) count[b] = COUNTS[k].value(&cracks->breaks[b]);
        snprintf(path, sizeof path, "cracks/%s", COUNTS[k].name);
        brc_h5_dataset(h5, path, H5T_NATIVE_INT64, n, 0, count);
    }
cleanup:
    brc_memory_free(number);
    brc_memory_free(count);
    return status;
}

brc_status brc_cracks_write_csv(brc_context *context, const brc_cracks *cracks, const char *path)
{
    brc_text text = {.context = context};
    brc_text_add(&text, "time [s],step,stage,mode,bond,element_i,element_j,x [m],y [m],z [m],nx,ny,nz,stress [Pa],energy [J]\n");
    for (int64_t k = 0; k < cracks->n_broken; ++k) {
        const brc_break *b = &cracks->breaks[k];
        brc_text_add(&text, "%.17g,%lld,%d,%s,%d,%d,%d", b->time, (long long)b->step, (int)b->stage, brc_break_mode_name(b->mode), (int)b->bond,
                     (int)b->element_i, (int)b->element_j);
        for (int c = 0; c < 3; ++c) brc_text_add(&text, ",%.17g", b->position[c]);
        for (int c = 0; c < 3; ++c) brc_text_add(&text, ",%.17g", b->normal[c]);
        brc_text_add(&text, ",%.17g,%.17g\n", b->stress, b->energy);
    }
    return brc_text_write(&text, path);
}

brc_status brc_cracks_write_frame(brc_context *context, brc_h5 *h5, brc_simulation *simulation)
{
    const int64_t n = brc_simulation_domain(simulation)->n_elements;
    int64_t n_fragments, n_broken;
    double *damage = NULL;
    int32_t *fragment = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &damage, n, "damage of a frame"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &fragment, n, "fragments of a frame"));
    BRC_TRY_OR(cleanup, brc_simulation_damage(simulation, damage));
    BRC_TRY_OR(cleanup, brc_simulation_fragments(simulation, fragment, &n_fragments));
    BRC_TRY_OR(cleanup, brc_simulation_broken(simulation, &n_broken));
    brc_h5_dataset(h5, "VTKHDF/CellData/damage", H5T_NATIVE_DOUBLE, n, 0, damage);
    brc_h5_attribute_text(h5, "VTKHDF/CellData/damage", "unit", "-");
    brc_h5_dataset(h5, "VTKHDF/CellData/fragment", H5T_NATIVE_INT32, n, 0, fragment);
    brc_h5_dataset(h5, "VTKHDF/FieldData/n_fragments", H5T_NATIVE_INT64, 1, 0, &n_fragments);
    brc_h5_dataset(h5, "VTKHDF/FieldData/n_broken", H5T_NATIVE_INT64, 1, 0, &n_broken);
cleanup:
    brc_memory_free(damage);
    brc_memory_free(fragment);
    return status;
}

void brc_cracks_add(brc_json *json, const brc_cracks *cracks)
{
    const int64_t n = cracks->n_broken;
    int64_t by_mode[4] = {0};
    for (int64_t k = 0; k < n; ++k) by_mode[cracks->breaks[k].mode & 3] += 1;
    brc_json_begin_object(json, "fracture");
    brc_json_integer(json, "fragments", cracks->n_fragments);
    brc_json_number(json, "first_break_s", n > 0 ? cracks->breaks[0].time : NAN);
    brc_json_number(json, "last_break_s", n > 0 ? cracks->breaks[n - 1].time : NAN);
    for (int mode = BRC_BREAK_TENSION; mode <= BRC_BREAK_SHEAR; ++mode) brc_json_integer(json, brc_break_mode_name(mode), by_mode[mode]);
    brc_json_end(json);
}
