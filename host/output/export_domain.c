/* The arrays of a domain, turned into numbers of a VTU block by block. */
#include "export_domain.h"
#include "vtu.h"
#include <string.h>

enum { VERTEX = 1, CONVEX_POINT_SET = 41 }; /* VTK's cell types */

static bool is_sphere(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_SPHERE;
}

static brc_status read_points(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    const brc_domain *d = array->source;
    const double *x = (is_sphere(d) ? d->position : d->vertex) + 3 * first;
    for (int64_t k = 0; k < 3 * n; ++k) ((float *)block)[k] = (float)x[k];
    return BRC_OK;
}

/* 0, 1, 2, ...: corners are stored cell by cell, and elements by their ids. */
static brc_status read_count(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    (void)array;
    for (int64_t k = 0; k < n; ++k) ((int64_t *)block)[k] = first + k;
    return BRC_OK;
}

/* Where the corners of each cell end. */
static brc_status read_ends(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    const brc_domain *d = array->source;
    for (int64_t k = 0; k < n; ++k) ((int64_t *)block)[k] = is_sphere(d) ? first + k + 1 : d->vertex_start[first + k + 1];
    return BRC_OK;
}

static brc_status read_types(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    (void)first;
    memset(block, is_sphere(array->source) ? VERTEX : CONVEX_POINT_SET, (size_t)n);
    return BRC_OK;
}

static brc_status read_coordination(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    const int64_t *start = ((const brc_domain *)array->source)->row_start + first;
    for (int64_t k = 0; k < n; ++k) ((int64_t *)block)[k] = start[k + 1] - start[k];
    return BRC_OK;
}

/* source: the array of the domain itself. */
static brc_status read_doubles(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    memcpy(block, (const double *)array->source + array->columns * first, (size_t)(array->columns * n) * sizeof(double));
    return BRC_OK;
}

static brc_status read_ids(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    for (int64_t k = 0; k < n; ++k) ((int64_t *)block)[k] = ((const int32_t *)array->source)[first + k];
    return BRC_OK;
}

brc_status brc_export_domain_vtu(brc_context *context, const brc_domain *d, const char *path)
{
    const int64_t n = d->n_elements, n_points = is_sphere(d) ? n : d->vertex_start[n];
    const struct {
        brc_vtu_array array;
        bool wanted;
    } all[] = {
        {{BRC_VTU_POINTS, "Points", BRC_VTU_FLOAT32, 3, n_points, read_points, d, 0}, true},
        {{BRC_VTU_CELLS, "connectivity", BRC_VTU_INT64, 1, n_points, read_count, d, 0}, true},
        {{BRC_VTU_CELLS, "offsets", BRC_VTU_INT64, 1, n, read_ends, d, 0}, true},
        {{BRC_VTU_CELLS, "types", BRC_VTU_UINT8, 1, n, read_types, d, 0}, true},
        {{BRC_VTU_POINT_DATA, "radius", BRC_VTU_FLOAT64, 1, n, read_doubles, d->radius, 0}, is_sphere(d)},
        {{BRC_VTU_CELL_DATA, "element_id", BRC_VTU_INT64, 1, n, read_count, d, 0}, true},
        {{BRC_VTU_CELL_DATA, "position", BRC_VTU_FLOAT64, 3, n, read_doubles, d->position, 0}, true},
        {{BRC_VTU_CELL_DATA, "volume", BRC_VTU_FLOAT64, 1, n, read_doubles, d->volume, 0}, true},
        {{BRC_VTU_CELL_DATA, "region", BRC_VTU_INT64, 1, n, read_ids, d->region, 0}, true},
        {{BRC_VTU_CELL_DATA, "body", BRC_VTU_INT64, 1, n, read_ids, d->body, 0}, true},
        {{BRC_VTU_CELL_DATA, "coordination", BRC_VTU_INT64, 1, n, read_coordination, d, 0}, true},
        {{BRC_VTU_CELL_DATA, "grain", BRC_VTU_INT64, 1, n, read_ids, d->grain, 0}, d->grain != NULL},
    };
    enum { MOST = sizeof all / sizeof all[0] };
    brc_vtu_array arrays[MOST];
    int n_arrays = 0;
    for (int k = 0; k < MOST; ++k)
        if (all[k].wanted) arrays[n_arrays++] = all[k].array;
    return brc_vtu_write(context, path, n_points, n, n_arrays, arrays);
}
