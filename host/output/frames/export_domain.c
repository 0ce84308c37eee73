/* The arrays of a domain, turned into numbers of a VTU block by block. */
#include "export_domain.h"
#include "vtu_faces.h"
#include "../../base/memory.h"
#include <string.h>

enum { VERTEX = 1, POLYHEDRON = 42 }; /* VTK's cell types */

/* The points of cells, as a file has them. */
typedef struct cell_points {
    float *place;   /* [n_points][3] */
    int64_t *point; /* of each cell, one cell after another */
} cell_points;

enum { MOST_FIELDS = 7 };

static bool is_sphere(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_SPHERE;
}

static brc_status read_centres(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    const double *x = ((const brc_domain *)array->source)->position + 3 * first;
    for (int64_t k = 0; k < 3 * n; ++k)
        ((float *)block)[k] = (float)x[k];
    return BRC_OK;
}

/* 0, 1, 2, ... */
static brc_status read_count(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    (void)array;
    for (int64_t k = 0; k < n; ++k)
        ((int64_t *)block)[k] = first + k;
    return BRC_OK;
}

/* 1, 2, 3, ... */
static brc_status read_ends(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    (void)array;
    for (int64_t k = 0; k < n; ++k)
        ((int64_t *)block)[k] = first + k + 1;
    return BRC_OK;
}

static brc_status read_types(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    (void)first;
    memset(block, is_sphere(array->source) ? VERTEX : POLYHEDRON, (size_t)n);
    return BRC_OK;
}

static brc_status read_coordination(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    const int64_t *start = ((const brc_domain *)array->source)->row_start + first;
    for (int64_t k = 0; k < n; ++k)
        ((int64_t *)block)[k] = start[k + 1] - start[k];
    return BRC_OK;
}

/* source: the array of the domain itself. */
static brc_status read_doubles(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    memcpy(block, (const double *)array->source + array->columns * first,
           (size_t)(array->columns * n) * sizeof(double));
    return BRC_OK;
}

static brc_status read_ids(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    for (int64_t k = 0; k < n; ++k)
        ((int64_t *)block)[k] = ((const int32_t *)array->source)[first + k];
    return BRC_OK;
}

static brc_status take_points(brc_context *context, const brc_tessellation *cells, cell_points *out)
{
    const brc_domain *d = cells->domain;
    int64_t most_points, most_faces, most_corners, n = 0;
    int32_t *own = NULL;
    brc_tessellation_most(cells, &most_points, &most_faces, &most_corners);
    BRC_TRY(BRC_ALLOCATE(context, &out->place, 3 * cells->n_points, "points of cells"));
    BRC_TRY(BRC_ALLOCATE(context, &out->point, cells->point_start[d->n_elements], "points of cells"));
    BRC_TRY(BRC_ALLOCATE(context, &own, most_points, "points of a cell"));
    for (int64_t p = 0; p < cells->n_points; ++p)
        for (int c = 0; c < 3; ++c)
            out->place[3 * p + c] = (float)d->vertex[3 * (int64_t)cells->first[p] + c];
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const int64_t m = brc_tessellation_points(cells, e, own);
        for (int64_t k = 0; k < m; ++k)
            out->point[n++] = own[k];
    }
    brc_memory_free(own);
    return BRC_OK;
}

static brc_status write_spheres(brc_context *context, const brc_domain *d, int n_fields, const brc_vtu_array *fields,
                                const char *path)
{
    enum { OWN = 5 };
    const int64_t n = d->n_elements;
    brc_vtu_array arrays[OWN + MOST_FIELDS] = {
        {BRC_VTU_POINTS, "Points", BRC_VTU_FLOAT32, 3, n, read_centres, d, 0},
        {BRC_VTU_CELLS, "connectivity", BRC_VTU_INT64, 1, n, read_count, d, 0},
        {BRC_VTU_CELLS, "offsets", BRC_VTU_INT64, 1, n, read_ends, d, 0},
        {BRC_VTU_CELLS, "types", BRC_VTU_UINT8, 1, n, read_types, d, 0},
        {BRC_VTU_POINT_DATA, "radius", BRC_VTU_FLOAT64, 1, n, read_doubles, d->radius, 0}};
    memcpy(arrays + OWN, fields, (size_t)n_fields * sizeof *fields);
    return brc_vtu_write(context, path, n, n, OWN + n_fields, arrays);
}

static brc_status write_cells(brc_context *context, const brc_domain *d, int n_fields, const brc_vtu_array *fields,
                              const char *path)
{
    enum { OWN = 4 };
    const int64_t n = d->n_elements;
    brc_tessellation cells;
    brc_vtu_faces faces = {.n = 0};
    cell_points points = {NULL, NULL};
    brc_status status = BRC_OK;
    BRC_TRY(brc_tessellation_create(context, d, 0, &cells));
    BRC_TRY_OR(cleanup, brc_tessellation_join(context, NULL, 0, &cells));
    BRC_TRY_OR(cleanup, brc_vtu_faces_of_cells(context, &cells, &faces));
    BRC_TRY_OR(cleanup, take_points(context, &cells, &points));
    brc_vtu_array arrays[OWN + BRC_VTU_FACE_ARRAYS + MOST_FIELDS] = {
        {BRC_VTU_POINTS, "Points", BRC_VTU_FLOAT32, 3, cells.n_points, brc_vtu_from_memory, points.place, 0},
        {BRC_VTU_CELLS, "connectivity", BRC_VTU_INT64, 1, cells.point_start[n], brc_vtu_from_memory, points.point, 0},
        {BRC_VTU_CELLS, "offsets", BRC_VTU_INT64, 1, n, brc_vtu_from_memory, cells.point_start + 1, 0},
        {BRC_VTU_CELLS, "types", BRC_VTU_UINT8, 1, n, read_types, d, 0}};
    brc_vtu_faces_arrays(&faces, arrays + OWN);
    memcpy(arrays + OWN + BRC_VTU_FACE_ARRAYS, fields, (size_t)n_fields * sizeof *fields);
    status = brc_vtu_write(context, path, cells.n_points, n, OWN + BRC_VTU_FACE_ARRAYS + n_fields, arrays);
cleanup:
    brc_tessellation_free(&cells);
    brc_vtu_faces_free(&faces);
    brc_memory_free(points.place);
    brc_memory_free(points.point);
    return status;
}

brc_status brc_export_domain_vtu(brc_context *context, const brc_domain *d, const char *path)
{
    const int64_t n = d->n_elements;
    const brc_vtu_array fields[MOST_FIELDS] = {
        {BRC_VTU_CELL_DATA, "element_id", BRC_VTU_INT64, 1, n, read_count, d, 0},
        {BRC_VTU_CELL_DATA, "position", BRC_VTU_FLOAT64, 3, n, read_doubles, d->position, 0},
        {BRC_VTU_CELL_DATA, "volume", BRC_VTU_FLOAT64, 1, n, read_doubles, d->volume, 0},
        {BRC_VTU_CELL_DATA, "region", BRC_VTU_INT64, 1, n, read_ids, d->region, 0},
        {BRC_VTU_CELL_DATA, "body", BRC_VTU_INT64, 1, n, read_ids, d->body, 0},
        {BRC_VTU_CELL_DATA, "coordination", BRC_VTU_INT64, 1, n, read_coordination, d, 0},
        {BRC_VTU_CELL_DATA, "grain", BRC_VTU_INT64, 1, n, read_ids, d->grain, 0},
    };
    const int n_fields = d->grain ? MOST_FIELDS : MOST_FIELDS - 1;
    return is_sphere(d) ? write_spheres(context, d, n_fields, fields, path)
                        : write_cells(context, d, n_fields, fields, path);
}
