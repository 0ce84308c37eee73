/* The head of the file needs the place of every array, so sizes come first and data after. */
#include "vtu.h"
#include "../text.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

#define BLOCK_BYTES ((int64_t)1 << 18)

static const char *const NUMBER_NAME[] = {"Float32", "Float64", "Int64", "UInt8"};
static const int NUMBER_BYTES[] = {4, 8, 8, 1};
static const char *const PLACE_NAME[BRC_VTU_N_PLACES] = {"FieldData", "Points", "Cells", "PointData", "CellData"};

static void add_head(brc_text *text, int64_t n_points, int64_t n_cells, int n_arrays, const brc_vtu_array *arrays)
{
    const uint16_t probe = 1;
    const bool little = *(const unsigned char *)&probe == 1;
    int64_t offset = 0;
    brc_text_add(text,
                 "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"%s\" "
                 "header_type=\"UInt64\">\n<UnstructuredGrid>\n",
                 little ? "LittleEndian" : "BigEndian");
    for (int p = 0; p < BRC_VTU_N_PLACES; ++p) {
        if (p == BRC_VTU_POINTS)
            brc_text_add(text, "<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n", (long long)n_points,
                         (long long)n_cells);
        brc_text_add(text, "<%s>\n", PLACE_NAME[p]);
        for (int k = 0; k < n_arrays; ++k) {
            const brc_vtu_array *a = &arrays[k];
            if (a->place != (brc_vtu_place)p) continue;
            brc_text_add(text, "<DataArray type=\"%s\" Name=\"%s\" %s=\"%d\" format=\"appended\" offset=\"%lld\"/>\n",
                         NUMBER_NAME[a->number], a->name,
                         p == BRC_VTU_FIELD_DATA ? "NumberOfTuples" : "NumberOfComponents", a->columns,
                         (long long)offset);
            offset += 8 + a->rows * a->columns * NUMBER_BYTES[a->number];
        }
        brc_text_add(text, "</%s>\n", PLACE_NAME[p]);
    }
    brc_text_add(text, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
}

static brc_status copy_array(const brc_vtu_array *a, void *block, FILE *file)
{
    const int64_t row_bytes = (int64_t)a->columns * NUMBER_BYTES[a->number];
    const uint64_t bytes = (uint64_t)(a->rows * row_bytes);
    fwrite(&bytes, sizeof bytes, 1, file);
    for (int64_t first = 0; first < a->rows;) {
        int64_t n = BLOCK_BYTES / row_bytes;
        if (n > a->rows - first) n = a->rows - first;
        BRC_TRY(a->read(a, first, n, block));
        fwrite(block, (size_t)row_bytes, (size_t)n, file);
        first += n;
    }
    return BRC_OK;
}

static brc_status write_aside(brc_context *context, const char *aside, const brc_text *head, int n_arrays,
                              const brc_vtu_array *arrays)
{
    static const char tail[] = "\n</AppendedData>\n</VTKFile>\n";
    void *block = NULL;
    FILE *file = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_memory_allocate(context, &block, BLOCK_BYTES, 1, "block of a VTU file"));
    errno = 0;
    file = fopen(aside, "wb");
    if (file) {
        fwrite(head->data, 1, head->length, file);
        for (int k = 0; k < n_arrays; ++k)
            BRC_TRY_OR(cleanup, copy_array(&arrays[k], block, file));
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
    brc_memory_free(block);
    return status;
}

brc_status brc_vtu_from_memory(const brc_vtu_array *a, int64_t first, int64_t n, void *block)
{
    const size_t row = (size_t)a->columns * (size_t)NUMBER_BYTES[a->number];
    memcpy(block, (const char *)a->source + (size_t)first * row, (size_t)n * row);
    return BRC_OK;
}

brc_status brc_vtu_write(brc_context *context, const char *path, int64_t n_points, int64_t n_cells, int n_arrays,
                         const brc_vtu_array *arrays)
{
    brc_text head = {.context = context};
    char *aside = NULL;
    brc_status status = BRC_OK;
    if (!brc_file_writes()) return BRC_OK;
    add_head(&head, n_points, n_cells, n_arrays, arrays);
    BRC_TRY_OR(cleanup, head.status);
    BRC_TRY_OR(cleanup, brc_file_aside(context, path, &aside));
    status = write_aside(context, aside, &head, n_arrays, arrays);
    if (status == BRC_OK) status = brc_file_commit(context, aside, path);
    if (status != BRC_OK) brc_file_discard(aside);
cleanup:
    brc_text_free(&head);
    brc_memory_free(aside);
    return status;
}
