/* HDF5 reports through a stack of messages; the innermost one holds the reason of the system ("No space left"). */
#include "hdf5_io.h"

#include "../../host/base/memory.h"

#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void brc_h5_quiet(brc_h5_voice *keep)
{
    /* every file is closed where it was opened; HDF5's own tidying when the program ends crashes over files that could
       not be closed. Has no effect once HDF5 is in use. */
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &keep->function, &keep->data);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

void brc_h5_loud(const brc_h5_voice *keep)
{
    H5Eset_auto2(H5E_DEFAULT, keep->function, keep->data);
}

static herr_t keep_innermost(unsigned n, const H5E_error2_t *error, void *data)
{
    if (n == 0 && error->desc) snprintf(data, 256, "%s", error->desc);
    return 0;
}

brc_status brc_h5_fail(brc_context *context, brc_status code, const char *path, const char *what)
{
    char reason[256] = "HDF5 gives no reason";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, reason);
    return BRC_FAIL(context, code, "%s: %s: %s", path, what, reason);
}

/* Close a property list without wiping the errors of the call it was for. */
static void close_list(hid_t list)
{
    const hid_t errors = H5Eget_current_stack();
    H5Pclose(list);
    H5Eset_current_stack(errors); /* takes and closes the copy */
}

hid_t brc_h5_create_file(const char *path)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    H5Pset_alignment(access, BRC_LEAST_FILE_RANGE, BRC_FILE_PAGE);
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_obj_track_times(creation, 0);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, creation, access);
    close_list(creation);
    close_list(access);
    return file;
}

hid_t brc_h5_create_group(hid_t file, const char *name)
{
    const hid_t creation = H5Pcreate(H5P_GROUP_CREATE);
    H5Pset_obj_track_times(creation, 0);
    const hid_t group = H5Gcreate2(file, name, H5P_DEFAULT, creation, H5P_DEFAULT);
    close_list(creation);
    return group;
}

int brc_h5_descriptor(hid_t file)
{
    void *handle = NULL;
    return H5Fget_vfd_handle(file, H5P_DEFAULT, &handle) >= 0 && handle ? *(const int *)handle : -1;
}

void brc_h5_close_broken(hid_t file)
{
    const int nowhere = memfd_create("discarded", 0), handle = brc_h5_descriptor(file);
    if (nowhere >= 0 && handle >= 0) dup2(nowhere, handle);
    if (nowhere >= 0) close(nowhere);
    H5Fclose(file);
}

static hid_t memory_type(brc_h5_kind kind)
{
    return kind == BRC_H5_DOUBLE ? H5T_NATIVE_DOUBLE : kind == BRC_H5_INT64 ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32;
}

/* Of attributes, and of arrays of older files. */
static hid_t long_type(brc_h5_kind kind)
{
    return kind == BRC_H5_DOUBLE ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}

static hid_t file_type(brc_h5_kind kind)
{
    return kind == BRC_H5_INT32 ? H5T_STD_I32LE : long_type(kind);
}

static size_t item_size(brc_h5_kind kind)
{
    return kind == BRC_H5_INT32 ? sizeof(int32_t) : sizeof(int64_t);
}

/* Checksum of n numbers as words of 64 bits: each is mixed in by a multiplication with an odd constant, so order
 * counts. */
static int64_t checksum(brc_h5_kind kind, const void *data, int64_t n)
{
    uint64_t sum = 0x9e3779b97f4a7c15u;
    for (int64_t k = 0; k < n; ++k) {
        uint64_t word;
        if (kind == BRC_H5_INT32)
            word = (uint64_t)(int64_t)((const int32_t *)data)[k];
        else
            memcpy(&word, (const char *)data + 8 * k, sizeof word);
        sum = (sum ^ word) * 0xff51afd7ed558ccdu;
        sum ^= sum >> 32;
    }
    return (int64_t)sum;
}

brc_status brc_h5_write_numbers(brc_context *context, hid_t place, const char *path, const char *what, brc_h5_kind kind,
                                int64_t n, const void *data)
{
    const hsize_t size = (hsize_t)n;
    const hid_t space = n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    const hid_t attribute = H5Acreate2(place, what, long_type(kind), space, H5P_DEFAULT, H5P_DEFAULT);
    brc_status status = BRC_OK;
    if (attribute < 0 || H5Awrite(attribute, memory_type(kind), data) < 0)
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, what);
    if (attribute >= 0 && H5Aclose(attribute) < 0 && status == BRC_OK)
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, what);
    H5Sclose(space);
    return status;
}

brc_status brc_h5_read_numbers(brc_context *context, hid_t place, const char *path, const char *what, brc_h5_kind kind,
                               int64_t n, void *data)
{
    const hid_t attribute = H5Aopen(place, what, H5P_DEFAULT);
    if (attribute < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s: the attribute '%s' is missing, this is no domain file of this version", path, what);
    const hid_t space = H5Aget_space(attribute), type = H5Aget_type(attribute);
    const hssize_t found = H5Sget_simple_extent_npoints(space);
    const bool right = H5Tequal(type, long_type(kind)) > 0 && found == n;
    brc_status status = BRC_OK;
    if (!right)
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: the attribute '%s' has %lld items or another type, expected %lld %s", path, what,
                          (long long)found, (long long)n, kind == BRC_H5_DOUBLE ? "64-bit numbers" : "64-bit integers");
    else if (H5Aread(attribute, memory_type(kind), data) < 0)
        status = brc_h5_fail(context, BRC_BAD_INPUT, path, what);
    H5Tclose(type);
    H5Sclose(space);
    H5Aclose(attribute);
    return status;
}

brc_status brc_h5_write_text(brc_context *context, hid_t place, const char *path, const char *what, const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text) + 1);
    const hid_t attribute = H5Acreate2(place, what, type, space, H5P_DEFAULT, H5P_DEFAULT);
    brc_status status = BRC_OK;
    if (attribute < 0 || H5Awrite(attribute, type, text) < 0)
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, what);
    if (attribute >= 0 && H5Aclose(attribute) < 0 && status == BRC_OK)
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, what);
    H5Sclose(space);
    H5Tclose(type);
    return status;
}

brc_status brc_h5_read_text(brc_context *context, hid_t place, const char *path, const char *what, char **out)
{
    *out = NULL;
    const hid_t attribute = H5Aopen(place, what, H5P_DEFAULT);
    if (attribute < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s: the attribute '%s' is missing, this is no domain file of this version", path, what);
    const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    const size_t size = H5Tget_size(type);
    brc_status status = BRC_OK;
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || H5Sget_simple_extent_npoints(space) != 1 ||
        size > 1 << 20)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: the attribute '%s' is not a text of fixed length", path, what);
    else if ((status = BRC_ALLOCATE(context, out, (int64_t)size + 1, "text")) == BRC_OK &&
             H5Aread(attribute, type, *out) < 0)
        status = brc_h5_fail(context, BRC_BAD_INPUT, path, what);
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(attribute);
    if (status != BRC_OK) {
        brc_memory_free(*out);
        *out = NULL;
    }
    return status;
}

brc_status brc_h5_write_array(brc_context *context, hid_t place, const char *path, const char *name, brc_h5_kind kind,
                              int64_t rows, int64_t width, const void *data)
{
    const hsize_t size[2] = {(hsize_t)rows, (hsize_t)width};
    const hid_t space = H5Screate_simple(width == 1 ? 1 : 2, size, NULL), creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(creation, 0);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    const hid_t set = H5Dcreate2(place, name, file_type(kind), space, H5P_DEFAULT, creation, H5P_DEFAULT);
    brc_status status = BRC_OK;
    if (set < 0 || (rows > 0 && H5Dwrite(set, memory_type(kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)) {
        status = brc_h5_fail(context, BRC_FILE_FAILED, path, name);
    } else {
        const int64_t sum = checksum(kind, data, rows * width);
        status = brc_h5_write_numbers(context, set, path, "checksum", BRC_H5_INT64, 1, &sum);
    }
    if (set >= 0 && H5Dclose(set) < 0 && status == BRC_OK) status = brc_h5_fail(context, BRC_FILE_FAILED, path, name);
    H5Pclose(creation);
    H5Sclose(space);
    return status;
}

/* Is the array of the expected type and shape, and wholly in the file? *rows: expected, or found when below 0. */
static brc_status check_array(brc_context *context, hid_t set, const char *path, const char *name, brc_h5_kind kind,
                              int64_t *rows, int64_t width)
{
    const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
    hsize_t size[2] = {0, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    const hsize_t item = H5Tget_size(type);
    brc_status status = BRC_OK;
    if (H5Tequal(type, file_type(kind)) <= 0 && H5Tequal(type, long_type(kind)) <= 0) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: '%s' has another type, expected %s", path, name,
                          kind == BRC_H5_DOUBLE  ? "64-bit floating point"
                          : kind == BRC_H5_INT64 ? "64-bit integers"
                                                 : "32-bit or 64-bit integers");
    } else if (rank != (width == 1 ? 1 : 2) || H5Sget_simple_extent_dims(space, size, NULL) < 0 ||
               size[1] != (hsize_t)width || (*rows >= 0 && size[0] != (hsize_t)*rows)) {
        status =
            BRC_FAIL(context, BRC_BAD_INPUT, "%s: '%s' has the shape [%llu][%llu], expected [%lld][%lld]", path, name,
                     (unsigned long long)size[0], (unsigned long long)size[1], (long long)*rows, (long long)width);
    } else if (H5Dget_storage_size(set) != size[0] * size[1] * item) {
        status =
            BRC_FAIL(context, BRC_BAD_INPUT, "%s: '%s' is cut off: %llu bytes are stored, expected %llu", path, name,
                     (unsigned long long)H5Dget_storage_size(set), (unsigned long long)(size[0] * size[1] * item));
    }
    hsize_t file_size = 0;
    const hid_t file = H5Iget_file_id(set);
    if (status == BRC_OK &&
        (H5Fget_filesize(file, &file_size) < 0 || size[0] > file_size || size[0] * size[1] * item > file_size))
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: '%s' claims %llu rows, more than the file holds", path, name,
                          (unsigned long long)size[0]);
    if (file >= 0) H5Fclose(file);
    H5Sclose(space);
    H5Tclose(type);
    *rows = (int64_t)size[0];
    return status;
}

/* Where the array lies in the file as it does in memory, in one piece; NULL: nowhere, or not worth it. */
static void *find_pages(hid_t set, brc_h5_kind kind, int64_t n, const brc_h5_pages *pages)
{
    const hid_t type = H5Dget_type(set);
    const haddr_t offset = H5Dget_offset(set); /* none of what is in pieces, packed or in another file */
    const bool same = H5Tequal(type, memory_type(kind)) > 0 && offset != HADDR_UNDEF && offset <= INT64_MAX;
    H5Tclose(type);
    return same ? brc_file_pages_add(pages->file, (int64_t)offset, n * (int64_t)item_size(kind), pages->memory,
                                     pages->pages)
                : NULL;
}

/* pages: may be NULL. */
static brc_status take_array(brc_context *context, hid_t place, const char *path, const char *name, brc_h5_kind kind,
                             int64_t *rows, int64_t width, const brc_h5_pages *pages, void **data)
{
    *data = NULL;
    const hid_t set = H5Dopen2(place, name, H5P_DEFAULT);
    if (set < 0) return BRC_FAIL(context, BRC_BAD_INPUT, "%s: '%s' is missing or unreadable", path, name);
    int64_t sum = 0;
    brc_status status = check_array(context, set, path, name, kind, rows, width);
    if (status != BRC_OK) goto cleanup;
    if (pages) *data = find_pages(set, kind, *rows * width, pages);
    const bool mapped = *data != NULL;
    if (!mapped) BRC_TRY_OR(cleanup, brc_memory_allocate(context, data, *rows * width, item_size(kind), name));
    if (!mapped && *rows > 0 && H5Dread(set, memory_type(kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, *data) < 0) {
        status = brc_h5_fail(context, BRC_BAD_INPUT, path, name);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_h5_read_numbers(context, set, path, "checksum", BRC_H5_INT64, 1, &sum));
    if (sum != checksum(kind, *data, *rows * width))
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "%s: '%s' was damaged (its checksum is wrong); build the domain again", path, name);
    if (mapped) brc_memory_forget(*data, *rows * width * (int64_t)item_size(kind));
cleanup:
    H5Dclose(set);
    if (status != BRC_OK) {
        brc_memory_free(*data);
        *data = NULL;
    }
    return status;
}

brc_status brc_h5_read_array(brc_context *context, hid_t place, const char *path, const char *name, brc_h5_kind kind,
                             int64_t rows, int64_t width, void **data, int64_t *found)
{
    BRC_TRY(take_array(context, place, path, name, kind, &rows, width, NULL, data));
    if (found) *found = rows;
    return BRC_OK;
}

brc_status brc_h5_map_array(brc_context *context, hid_t place, const char *path, const char *name, brc_h5_kind kind,
                            int64_t rows, int64_t width, const brc_h5_pages *pages, void **data)
{
    return take_array(context, place, path, name, kind, &rows, width, pages, data);
}
