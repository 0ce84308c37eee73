/* Frames as VTU. The head of the file needs the place of every array, so sizes are asked first and data copied after. */
#include "export_vtu.h"
#include "h5_read.h"
#include "text.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

#define BLOCK_BYTES ((int64_t)1 << 22)

typedef enum number { FLOAT32, FLOAT64, INT64, UINT8 } number;
static const char *const NUMBER_NAME[] = {"Float32", "Float64", "Int64", "UInt8"};
static const int NUMBER_BYTES[] = {4, 8, 8, 1};

/* Element of the XML tree that an array stands in. */
typedef enum place { FIELD_DATA, POINTS, CELLS, POINT_DATA, CELL_DATA, N_PLACES } place;
static const char *const PLACE_NAME[N_PLACES] = {"FieldData", "Points", "Cells", "PointData", "CellData"};

typedef struct array {
    place place;
    const char *source; /* in the frame */
    const char *name;   /* in the VTU */
    number number;
    int columns;
    int skip; /* leading rows left out: VTU's offsets are ends, without the first 0 */
} array;

static const array ARRAYS[] = {
    {FIELD_DATA, "VTKHDF/FieldData/time", "TimeValue", FLOAT64, 1, 0},
    {POINTS, "VTKHDF/Points", "Points", FLOAT32, 3, 0},
    {CELLS, "VTKHDF/Connectivity", "connectivity", INT64, 1, 0},
    {CELLS, "VTKHDF/Offsets", "offsets", INT64, 1, 1},
    {CELLS, "VTKHDF/Types", "types", UINT8, 1, 0},
    {POINT_DATA, "VTKHDF/PointData/displacement", "displacement", FLOAT32, 3, 0},
    {CELL_DATA, "VTKHDF/CellData/element_id", "element_id", INT64, 1, 0},
    {CELL_DATA, "VTKHDF/CellData/position", "position", FLOAT64, 3, 0},
    {CELL_DATA, "VTKHDF/CellData/displacement", "displacement", FLOAT64, 3, 0},
    {CELL_DATA, "VTKHDF/CellData/velocity", "velocity", FLOAT64, 3, 0},
    {CELL_DATA, "VTKHDF/CellData/stress", "stress", FLOAT64, 6, 0},
    {CELL_DATA, "VTKHDF/CellData/strain", "strain", FLOAT64, 6, 0},
    {CELL_DATA, "VTKHDF/CellData/von_mises", "von_mises", FLOAT64, 1, 0},
};
enum { N_ARRAYS = sizeof ARRAYS / sizeof ARRAYS[0] };

static hid_t memory_type(number n)
{
    switch (n) {
    case FLOAT32: return H5T_NATIVE_FLOAT;
    case FLOAT64: return H5T_NATIVE_DOUBLE;
    case INT64: return H5T_NATIVE_INT64;
    case UINT8: break;
    }
    return H5T_NATIVE_UINT8;
}

static brc_status ask_sizes(const brc_h5_read *h5, int64_t rows[N_ARRAYS])
{
    for (int k = 0; k < N_ARRAYS; ++k) {
        int64_t columns;
        BRC_TRY(brc_h5_read_size(h5, ARRAYS[k].source, &rows[k], &columns));
        rows[k] -= ARRAYS[k].skip;
        if (columns != ARRAYS[k].columns || rows[k] < 0)
            return BRC_FAIL(h5->context, BRC_BAD_INPUT, "%s: %s has %lld columns, %d are expected; the file is damaged",
                            h5->path, ARRAYS[k].source, (long long)columns, ARRAYS[k].columns);
    }
    return BRC_OK;
}

static void add_head(brc_text *text, const int64_t rows[N_ARRAYS])
{
    const uint16_t probe = 1;
    const bool little = *(const unsigned char *)&probe == 1;
    int64_t offset = 0;
    brc_text_add(text,
                 "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"%s\" "
                 "header_type=\"UInt64\">\n<UnstructuredGrid>\n",
                 little ? "LittleEndian" : "BigEndian");
    for (int p = 0; p < N_PLACES; ++p) {
        if (p == POINTS)
            brc_text_add(text, "<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n", (long long)rows[1],
                         (long long)rows[4]);
        brc_text_add(text, "<%s>\n", PLACE_NAME[p]);
        for (int k = 0; k < N_ARRAYS; ++k) {
            const array *a = &ARRAYS[k];
            if (a->place != (place)p) continue;
            brc_text_add(text, "<DataArray type=\"%s\" Name=\"%s\" %s=\"%d\" format=\"appended\" offset=\"%lld\"/>\n",
                         NUMBER_NAME[a->number], a->name, p == FIELD_DATA ? "NumberOfTuples" : "NumberOfComponents",
                         a->columns, (long long)offset);
            offset += 8 + rows[k] * a->columns * NUMBER_BYTES[a->number];
        }
        brc_text_add(text, "</%s>\n", PLACE_NAME[p]);
    }
    brc_text_add(text, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
}

static brc_status copy_array(const brc_h5_read *h5, const array *a, int64_t rows, void *block, FILE *file)
{
    const int64_t row_bytes = (int64_t)a->columns * NUMBER_BYTES[a->number];
    const uint64_t bytes = (uint64_t)(rows * row_bytes);
    fwrite(&bytes, sizeof bytes, 1, file);
    for (int64_t first = 0; first < rows;) {
        int64_t n = BLOCK_BYTES / row_bytes;
        if (n > rows - first) n = rows - first;
        BRC_TRY(brc_h5_read_rows(h5, a->source, memory_type(a->number), first + a->skip, n, block));
        fwrite(block, (size_t)row_bytes, (size_t)n, file);
        first += n;
    }
    return BRC_OK;
}

static brc_status write_vtu(brc_context *context, const brc_h5_read *h5, const char *aside)
{
    static const char tail[] = "\n</AppendedData>\n</VTKFile>\n";
    int64_t rows[N_ARRAYS];
    brc_text head = {.context = context};
    void *block = NULL;
    FILE *file = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, ask_sizes(h5, rows));
    BRC_TRY_OR(cleanup, brc_memory_allocate(context, &block, BLOCK_BYTES, 1, "block of a frame"));
    add_head(&head, rows);
    BRC_TRY_OR(cleanup, head.status);
    errno = 0;
    file = fopen(aside, "wb");
    if (file) {
        fwrite(head.data, 1, head.length, file);
        for (int k = 0; k < N_ARRAYS; ++k)
            BRC_TRY_OR(cleanup, copy_array(h5, &ARRAYS[k], rows[k], block, file));
        fwrite(tail, 1, sizeof tail - 1, file);
    }
cleanup:
    if (status == BRC_OK) { /* a refused write shows here at the latest; errno is that of the last one */
        const bool bad = !file || ferror(file) != 0;
        const bool closed = !file || fclose(file) == 0;
        if (bad || !closed) status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write: %s", aside, strerror(errno));
    } else if (file) {
        fclose(file);
    }
    brc_text_free(&head);
    brc_memory_free(block);
    return status;
}

brc_status brc_export_vtu_frame(brc_context *context, const char *frame, const char *path)
{
    brc_h5_read h5;
    char *aside = NULL;
    BRC_TRY(brc_h5_read_open(context, frame, &h5));
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_file_aside(context, path, &aside));
    BRC_TRY_OR(cleanup, write_vtu(context, &h5, aside));
    status = brc_file_commit(context, aside, path);
cleanup:
    if (status != BRC_OK) brc_file_discard(aside);
    brc_memory_free(aside);
    brc_h5_read_close(&h5);
    return status;
}
