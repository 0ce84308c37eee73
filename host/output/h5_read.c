/* Reading HDF5 files of results. */
#include "h5_read.h"
#include "../base/memory.h"

brc_status brc_h5_read_open(brc_context *context, const char *path, brc_h5_read *out)
{
    *out = (brc_h5_read){.context = context, .path = path};
    H5Eget_auto2(H5E_DEFAULT, &out->print, &out->print_data);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    out->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (out->file >= 0) return BRC_OK;
    brc_h5_read_close(out);
    return BRC_FAIL(context, BRC_BAD_INPUT, "%s: cannot be opened as an HDF5 file; is it a result of `breccia run`?",
                    path);
}

void brc_h5_read_close(brc_h5_read *h5)
{
    if (h5->file >= 0) H5Fclose(h5->file);
    h5->file = H5I_INVALID_HID;
    H5Eset_auto2(H5E_DEFAULT, h5->print, h5->print_data);
}

bool brc_h5_read_has(const brc_h5_read *h5, const char *name)
{
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT);
    if (dataset >= 0) H5Dclose(dataset);
    return dataset >= 0;
}

brc_status brc_h5_read_size(const brc_h5_read *h5, const char *name, int64_t *rows, int64_t *columns)
{
    hsize_t size[2] = {0, 1};
    int rank = -1;
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT);
    if (dataset >= 0) {
        const hid_t space = H5Dget_space(dataset);
        rank = H5Sget_simple_extent_ndims(space);
        if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space, size, NULL);
        H5Sclose(space);
        H5Dclose(dataset);
    }
    *rows = (int64_t)size[0];
    *columns = (int64_t)size[1];
    if (rank == 1 || rank == 2) return BRC_OK;
    return BRC_FAIL(h5->context, BRC_BAD_INPUT, "%s: %s is %s; the file is damaged or of another kind", h5->path, name,
                    rank < 0 ? "missing" : "no table");
}

brc_status brc_h5_read_rows(const brc_h5_read *h5, const char *name, hid_t type, int64_t first, int64_t n, void *data)
{
    int64_t rows, columns;
    BRC_TRY(brc_h5_read_size(h5, name, &rows, &columns));
    if (n == 0) return BRC_OK;
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
    const hsize_t start[2] = {(hsize_t)first, 0}, count[2] = {(hsize_t)n, (hsize_t)columns};
    const hid_t memory = H5Screate_simple(H5Sget_simple_extent_ndims(space), count, NULL);
    const bool ok = first >= 0 && first + n <= rows &&
                    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, count, NULL) >= 0 &&
                    H5Dread(dataset, type, memory, space, H5P_DEFAULT, data) >= 0;
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(dataset);
    if (ok) return BRC_OK;
    return BRC_FAIL(h5->context, BRC_BAD_INPUT, "%s: rows %lld to %lld of %s cannot be read; the file is damaged",
                    h5->path, (long long)first, (long long)(first + n - 1), name);
}

brc_status brc_h5_read_string(const brc_h5_read *h5, const char *name, char **out)
{
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT),
                type = dataset >= 0 ? H5Dget_type(dataset) : H5I_INVALID_HID;
    const bool is_text = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    brc_status status = BRC_OK;
    *out = NULL;
    if (is_text) status = brc_memory_allocate(h5->context, (void **)out, (int64_t)H5Tget_size(type) + 1, 1, "text");
    if (status == BRC_OK && (!is_text || H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *out) < 0)) {
        brc_memory_free(*out);
        *out = NULL;
        status = BRC_FAIL(h5->context, BRC_BAD_INPUT, "%s: %s is %s; the file is damaged or of another kind", h5->path,
                          name, dataset < 0 ? "missing" : "no text");
    }
    if (type >= 0) H5Tclose(type);
    if (dataset >= 0) H5Dclose(dataset);
    return status;
}
