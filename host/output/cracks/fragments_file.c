#include "fragments_file.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <string.h>

brc_status brc_fragment_table_take(brc_context *context, const brc_assembly *assembly, brc_fragment_table *out)
{
    brc_status status = BRC_OK;
    brc_fragment *list = NULL;
    brc_fragment_table_free(out);
    out->time = brc_simulation_total_time(assembly->part[0]);
    out->stage = brc_simulation_stage(assembly->part[0]);
    for (int32_t k = 0; k < assembly->n; ++k) {
        int64_t n;
        BRC_TRY_OR(cleanup, brc_simulation_fragment_list(assembly->part[k], &n, &list));
        BRC_TRY_OR(cleanup, brc_memory_resize(context, (void **)&out->row, out->n + n, sizeof *out->row, "fragments"));
        memcpy(out->row + out->n, list, (size_t)n * sizeof *list);
        for (int64_t i = out->n; i < out->n + n; ++i)
            out->row[i].first_element += (int32_t)brc_assembly_first_element(assembly, k);
        out->n += n;
        brc_memory_free(list);
        list = NULL;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->below, out->n, "fragments"));
    status = brc_fragment_sizes_of(context, out->n, out->row, &out->sizes, out->below);
cleanup:
    brc_memory_free(list);
    if (status != BRC_OK) brc_fragment_table_free(out);
    return status;
}

void brc_fragment_table_free(brc_fragment_table *table)
{
    brc_memory_free(table->row);
    brc_memory_free(table->below);
    *table = (brc_fragment_table){0};
}

/* Columns of numbers; those of several are x, y, z, or xx, yy, zz, yz, xz, xy. */
typedef struct column {
    const char *name;
    int width;
    size_t offset;
} column;
#define COLUMN(name, width)                                                                                            \
    {                                                                                                                  \
#name, width, offsetof(brc_fragment, name)                                                                     \
    }
static const column COLUMNS[] = {COLUMN(mass, 1),    COLUMN(centre, 3),      COLUMN(velocity, 3), COLUMN(spin, 3),
                                 COLUMN(inertia, 6), COLUMN(translation, 1), COLUMN(rotation, 1), COLUMN(internal, 1)};
enum { N_COLUMNS = sizeof COLUMNS / sizeof *COLUMNS };

static const double *numbers(const brc_fragment *f, const column *c)
{
    return (const double *)(const void *)((const char *)f + c->offset);
}

const char *brc_fragment_table_csv_head(void)
{
    return "frame,time [s],stage,fragment,first_element,elements,mass [kg],centre_x [m],centre_y [m],centre_z "
           "[m],velocity_x [m/s],velocity_y [m/s],"
           "velocity_z [m/s],spin_x [rad/s],spin_y [rad/s],spin_z [rad/s],inertia_xx [kg m^2],inertia_yy [kg "
           "m^2],inertia_zz [kg m^2],"
           "inertia_yz [kg m^2],inertia_xz [kg m^2],inertia_xy [kg m^2],translation [J],rotation [J],internal "
           "[J],share_below\n";
}

brc_status brc_fragment_table_csv_add(brc_context *context, brc_append *file, int64_t frame,
                                      const brc_fragment_table *table)
{
    brc_text text = {.context = context};
    brc_status status = BRC_OK;
    const int64_t bytes = brc_append_bytes(file);
    for (int64_t i = 0; i < table->n && status == BRC_OK; ++i) {
        const brc_fragment *f = &table->row[i];
        brc_text_add(&text, "%lld,%.17g,%d,%lld,%d,%lld", (long long)frame, table->time, (int)table->stage,
                     (long long)i, (int)f->first_element, (long long)f->n_elements);
        for (int k = 0; k < N_COLUMNS; ++k)
            for (int c = 0; c < COLUMNS[k].width; ++c)
                brc_text_add(&text, ",%.9g", numbers(f, &COLUMNS[k])[c]);
        brc_text_add(&text, ",%.9g\n", table->below[i]);
        status = brc_append_piece(context, file, &text);
    }
    if (status == BRC_OK) status = brc_append_add(context, file, &text);
    if (status != BRC_OK) brc_append_cut(file, bytes); /* all rows of a moment or none */
    brc_text_free(&text);
    return status;
}

brc_status brc_fragment_table_write_h5(brc_context *context, brc_h5 *h5, const brc_fragment_table *table)
{
    const int64_t n = table->n;
    double *number = NULL;
    int64_t *count = NULL;
    char path[64];
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &number, 6 * n, "fragments"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &count, n, "fragments"));
    brc_h5_group(h5, "fragments");
    brc_h5_attribute_number(h5, "fragments", "time", table->time);
    for (int64_t i = 0; i < n; ++i)
        count[i] = table->row[i].first_element;
    brc_h5_dataset(h5, "fragments/first_element", H5T_NATIVE_INT64, n, 0, count);
    for (int64_t i = 0; i < n; ++i)
        count[i] = table->row[i].n_elements;
    brc_h5_dataset(h5, "fragments/elements", H5T_NATIVE_INT64, n, 0, count);
    brc_h5_dataset(h5, "fragments/share_below", H5T_NATIVE_DOUBLE, n, 0, table->below);
    for (int k = 0; k < N_COLUMNS; ++k) {
        const column *c = &COLUMNS[k];
        for (int64_t i = 0; i < n; ++i)
            memcpy(number + c->width * i, numbers(&table->row[i], c), (size_t)c->width * sizeof *number);
        snprintf(path, sizeof path, "fragments/%s", c->name);
        brc_h5_dataset(h5, path, H5T_NATIVE_DOUBLE, n, c->width == 1 ? 0 : c->width, number);
    }
cleanup:
    brc_memory_free(number);
    brc_memory_free(count);
    return status;
}
