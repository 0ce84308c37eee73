/* Frames as VTU: what stands where in both formats. */
#include "export_vtu.h"
#include "../h5_read.h"
#include "vtu_faces.h"

typedef struct frame_array {
    brc_vtu_place place;
    const char *source; /* in the frame */
    const char *name;   /* in the VTU */
    brc_vtu_number number;
    int columns;
    int skip;      /* leading rows left out: VTU's offsets are ends, without the first 0 */
    bool optional; /* may be missing in the frame */
} frame_array;

static const frame_array ARRAYS[] = {
    {BRC_VTU_FIELD_DATA, "VTKHDF/FieldData/time", "TimeValue", BRC_VTU_FLOAT64, 1, 0, false},
    {BRC_VTU_POINTS, "VTKHDF/Points", "Points", BRC_VTU_FLOAT32, 3, 0, false},
    {BRC_VTU_CELLS, "VTKHDF/Connectivity", "connectivity", BRC_VTU_INT64, 1, 0, false},
    {BRC_VTU_CELLS, "VTKHDF/Offsets", "offsets", BRC_VTU_INT64, 1, 1, false},
    {BRC_VTU_CELLS, "VTKHDF/Types", "types", BRC_VTU_UINT8, 1, 0, false},
    {BRC_VTU_POINT_DATA, "VTKHDF/PointData/displacement", "displacement", BRC_VTU_FLOAT32, 3, 0, false},
    {BRC_VTU_POINT_DATA, "VTKHDF/PointData/radius", "radius", BRC_VTU_FLOAT64, 1, 0, true},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/element_id", "element_id", BRC_VTU_INT64, 1, 0, false},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/position", "position", BRC_VTU_FLOAT64, 3, 0, false},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/displacement", "displacement", BRC_VTU_FLOAT64, 3, 0, false},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/velocity", "velocity", BRC_VTU_FLOAT64, 3, 0, false},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/stress", "stress", BRC_VTU_FLOAT64, 6, 0, false},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/strain", "strain", BRC_VTU_FLOAT64, 6, 0, false},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/von_mises", "von_mises", BRC_VTU_FLOAT64, 1, 0, false},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/orientation", "orientation", BRC_VTU_FLOAT64, 4, 0, true},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/body", "body", BRC_VTU_INT64, 1, 0, true},
    {BRC_VTU_CELL_DATA, "VTKHDF/CellData/model", "model", BRC_VTU_INT64, 1, 0, true},
};
enum { N_ARRAYS = sizeof ARRAYS / sizeof ARRAYS[0] };

/* Where an array is read from. */
typedef struct place_in_frame {
    const brc_h5_read *h5;
    const char *name;
} place_in_frame;

static hid_t memory_type(brc_vtu_number n)
{
    switch (n) {
    case BRC_VTU_FLOAT32: return H5T_NATIVE_FLOAT;
    case BRC_VTU_FLOAT64: return H5T_NATIVE_DOUBLE;
    case BRC_VTU_INT64: return H5T_NATIVE_INT64;
    case BRC_VTU_UINT8: break;
    }
    return H5T_NATIVE_UINT8;
}

static brc_status read_rows(const brc_vtu_array *array, int64_t first, int64_t n, void *block)
{
    const place_in_frame *place = array->source;
    return brc_h5_read_rows(place->h5, place->name, memory_type(array->number), first + array->skip, n, block);
}

enum {
    POINTS = 1,
    TYPES = 4,
    MOST_ARRAYS = N_ARRAYS + BRC_VTU_FACE_ARRAYS
}; /* the first two: places in ARRAYS, before the optional ones */

static brc_status ask_sizes(const brc_h5_read *h5, const brc_vtu_faces *faces, place_in_frame places[N_ARRAYS],
                            brc_vtu_array arrays[MOST_ARRAYS], int *n_arrays)
{
    *n_arrays = 0;
    for (int k = 0; k < N_ARRAYS; ++k) {
        const frame_array *a = &ARRAYS[k];
        int64_t columns;
        if (a->optional && !brc_h5_read_has(h5, a->source)) continue;
        brc_vtu_array *array = &arrays[(*n_arrays)++];
        places[k] = (place_in_frame){h5, a->source};
        *array = (brc_vtu_array){a->place, a->name, a->number, a->columns, 0, read_rows, &places[k], a->skip};
        BRC_TRY(brc_h5_read_size(h5, a->source, &array->rows, &columns));
        array->rows -= a->skip;
        if (columns != a->columns || array->rows < 0)
            return BRC_FAIL(h5->context, BRC_BAD_INPUT, "%s: %s has %lld columns, %d are expected; the file is damaged",
                            h5->path, a->source, (long long)columns, a->columns);
        if (k != TYPES || faces->n_cells == 0) continue;
        if (faces->n_cells != array->rows)
            return BRC_FAIL(h5->context, BRC_BAD_INPUT, "%s: %lld cells, but faces of %lld; the file is damaged",
                            h5->path, (long long)array->rows, (long long)faces->n_cells);
        brc_vtu_faces_arrays(faces, arrays + *n_arrays);
        *n_arrays += BRC_VTU_FACE_ARRAYS;
    }
    return BRC_OK;
}

brc_status brc_export_vtu_frame(brc_context *context, const char *frame, const char *path)
{
    brc_h5_read h5;
    place_in_frame places[N_ARRAYS];
    brc_vtu_array arrays[MOST_ARRAYS];
    brc_vtu_faces faces;
    int n_arrays;
    BRC_TRY(brc_h5_read_open(context, frame, &h5));
    brc_status status = brc_vtu_faces_of_frame(&h5, &faces);
    if (status == BRC_OK) status = ask_sizes(&h5, &faces, places, arrays, &n_arrays);
    if (status == BRC_OK)
        status = brc_vtu_write(context, path, arrays[POINTS].rows, arrays[TYPES].rows, n_arrays, arrays);
    brc_vtu_faces_free(&faces);
    brc_h5_read_close(&h5);
    return status;
}
