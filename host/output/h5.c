/* Writing HDF5 aside or in memory. */
#include "h5.h"
#include "meaning.h"
#include "seal.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <errno.h>
#include <string.h>

static void fail(brc_h5 *h5, const char *what)
{
    if (h5->status != BRC_OK) return;
    const int reason = h5->disk ? h5->disk->error : 0;
    const bool full = reason == ENOSPC || reason == EFBIG || reason == EDQUOT;
    h5->status = BRC_FAIL(h5->context, BRC_FILE_FAILED, "%s: cannot write %s: %s%s", h5->path, what,
                          reason ? strerror(reason) : "the HDF5 library refused it",
                          full ? "; free some space or name another folder" : "");
}

void brc_h5_check(brc_h5 *h5, bool ok, const char *what)
{
    if (!ok || (h5->disk && h5->disk->error != 0)) fail(h5, what);
}

static brc_status open_file(brc_context *context, const char *path, bool in_memory, brc_h5 *out)
{
    *out = (brc_h5){.context = context, .file = H5I_INVALID_HID, .silent = !brc_file_writes()};
    H5Eget_auto2(H5E_DEFAULT, &out->print, &out->print_data);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const int64_t length = (int64_t)strlen(path) + 1;
    out->status = brc_memory_allocate(context, (void **)&out->path, length, 1, "path");
    if (out->status != BRC_OK) goto cleanup;
    memcpy(out->path, path, (size_t)length);
    if (out->silent) return BRC_OK;
    if (!in_memory) {
        out->status = brc_file_aside(context, path, &out->aside);
        if (out->status == BRC_OK) out->status = BRC_ALLOCATE(context, &out->disk, 1, "file driver");
        if (out->status != BRC_OK) goto cleanup;
    }
    const hid_t access = in_memory ? H5Pcreate(H5P_FILE_ACCESS) : brc_h5_disk_begin(out->disk);
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_obj_track_times(creation, false);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    if (!in_memory)
        H5Pset_libver_bounds(access, H5F_LIBVER_V110,
                             H5F_LIBVER_V110); /* a packed dataset of one block needs no index: 2 kB less; an image says
                                                  it is open for writing */
    if (in_memory) H5Pset_fapl_core(access, (size_t)1 << 20, false);
    out->file = H5Fcreate(in_memory ? path : out->aside, H5F_ACC_TRUNC, creation, access);
    if (out->file < 0) fail(out, "the file");
    H5Pclose(access);
    H5Pclose(creation);
cleanup:
    if (out->status != BRC_OK) {
        const brc_status status = out->status;
        brc_h5_discard(out);
        return status;
    }
    return BRC_OK;
}

brc_status brc_h5_create(brc_context *context, const char *path, brc_h5 *out)
{
    return open_file(context, path, false, out);
}

brc_status brc_h5_create_in_memory(brc_context *context, const char *path, brc_h5 *out)
{
    return open_file(context, path, true, out);
}

static void close_all(brc_h5 *h5)
{
    if (h5->file >= 0 && H5Fclose(h5->file) < 0) fail(h5, "the file");
    h5->file = H5I_INVALID_HID;
    if (h5->disk) {
        brc_h5_check(h5, true, "the file"); /* what the last flush met */
        brc_h5_disk_end(h5->disk);
    }
    H5Eclear2(H5E_DEFAULT);
    H5Eset_auto2(H5E_DEFAULT, h5->print, h5->print_data);
}

static void release(brc_h5 *h5)
{
    brc_memory_free(h5->disk);
    brc_memory_free(h5->path);
    brc_memory_free(h5->aside);
    h5->disk = NULL;
    h5->path = h5->aside = NULL;
}

void brc_h5_discard(brc_h5 *h5)
{
    if (h5->status == BRC_OK) h5->status = BRC_FILE_FAILED; /* nothing more is said about a file nobody wants */
    close_all(h5);
    brc_file_discard(h5->aside);
    release(h5);
}

/* The image of a file in memory goes out whole. */
static brc_status write_image(brc_h5 *h5)
{
    char *image = NULL;
    if (H5Fflush(h5->file, H5F_SCOPE_GLOBAL) < 0) fail(h5, "the file");
    const ssize_t bytes = h5->status == BRC_OK ? H5Fget_file_image(h5->file, NULL, 0) : 0;
    if (h5->status == BRC_OK && bytes <= 0) fail(h5, "the file");
    BRC_TRY(h5->status);
    BRC_TRY(brc_memory_allocate(h5->context, (void **)&image, bytes, 1, "image of a result file"));
    brc_status status = BRC_OK;
    if (H5Fget_file_image(h5->file, image, (size_t)bytes) != bytes) {
        fail(h5, "the file");
        status = h5->status;
    } else {
        status = brc_file_write_whole(h5->context, h5->path, image, (size_t)bytes);
    }
    brc_memory_free(image);
    return status;
}

static brc_status commit(brc_h5 *h5, bool seal)
{
    if (h5->status == BRC_OK && !h5->aside && !h5->silent) h5->status = write_image(h5);
    close_all(h5);
    if (h5->status == BRC_OK && seal) h5->status = brc_seal_add(h5->context, h5->aside);
    if (h5->status == BRC_OK && h5->aside) h5->status = brc_file_commit(h5->context, h5->aside, h5->path);
    if (h5->status != BRC_OK) brc_file_discard(h5->aside);
    release(h5);
    return h5->status;
}

brc_status brc_h5_commit(brc_h5 *h5)
{
    return commit(h5, false);
}
brc_status brc_h5_commit_sealed(brc_h5 *h5)
{
    return commit(h5, h5->aside != NULL);
}

void brc_h5_group(brc_h5 *h5, const char *name)
{
    if (h5->silent || h5->status != BRC_OK) return;
    const hid_t creation = H5Pcreate(H5P_GROUP_CREATE);
    H5Pset_obj_track_times(creation, false);
    const hid_t group = H5Gcreate2(h5->file, name, H5P_DEFAULT, creation, H5P_DEFAULT);
    brc_h5_check(h5, group >= 0 && H5Gclose(group) >= 0, name);
    H5Pclose(creation);
}

/* block: rows and columns of what is packed together; NULL: nothing is. */
static void create_dataset(brc_h5 *h5, const char *name, hid_t type, hid_t space, const hsize_t *block,
                           const void *data)
{
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    if (block) {
        H5Pset_chunk(creation, H5Sget_simple_extent_ndims(space), block);
        H5Pset_shuffle(creation);
        H5Pset_deflate(creation, 1);
    }
    H5Pset_obj_track_times(creation, false);
    H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
    const hid_t dataset = H5Dcreate2(h5->file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    brc_h5_check(h5, dataset >= 0 && (!data || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0),
                 name);
    if (dataset >= 0) brc_h5_check(h5, H5Dclose(dataset) >= 0, name);
    H5Pclose(creation);
    const brc_meaning *meaning = brc_meaning_of(name);
    if (meaning) brc_h5_describe(h5, name, meaning->unit, meaning->meaning);
}

void brc_h5_dataset(brc_h5 *h5, const char *name, hid_t type, int64_t rows, int64_t columns, const void *data)
{
    if (h5->silent || h5->status != BRC_OK) return;
    const hsize_t size[2] = {(hsize_t)rows, (hsize_t)columns};
    const hid_t space = H5Screate_simple(columns > 0 ? 2 : 1, size, NULL);
    create_dataset(h5, name, type, space, NULL, rows > 0 ? data : NULL);
    H5Sclose(space);
}

void brc_h5_packed(brc_h5 *h5, const char *name, hid_t type, int64_t rows, int64_t columns)
{
    if (h5->silent || h5->status != BRC_OK) return;
    const hsize_t size[2] = {(hsize_t)rows, (hsize_t)columns},
                  block[2] = {(hsize_t)(rows < BRC_H5_BLOCK ? rows : BRC_H5_BLOCK), (hsize_t)columns};
    const hid_t space = H5Screate_simple(columns > 0 ? 2 : 1, size, NULL);
    create_dataset(h5, name, type, space, rows > 0 ? block : NULL, NULL);
    H5Sclose(space);
}

void brc_h5_rows(brc_h5 *h5, const char *name, hid_t type, int64_t first, int64_t n, const void *data)
{
    if (h5->silent || h5->status != BRC_OK || n == 0) return;
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    hsize_t size[2] = {0, 0};
    const int rank = H5Sget_simple_extent_dims(space, size, NULL);
    const hsize_t start[2] = {(hsize_t)first, 0}, count[2] = {(hsize_t)n, size[1]};
    const hid_t memory = H5Screate_simple(rank, count, NULL);
    brc_h5_check(h5,
                 rank >= 1 && H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, count, NULL) >= 0 &&
                     H5Dwrite(dataset, type, memory, space, H5P_DEFAULT, data) >= 0,
                 name);
    H5Sclose(memory);
    H5Sclose(space);
    brc_h5_check(h5, H5Dclose(dataset) >= 0, name);
}

static hid_t text_type(const char *text, H5T_cset_t set)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, text[0] ? strlen(text) : 1);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, set);
    return type;
}

void brc_h5_text(brc_h5 *h5, const char *name, const char *text)
{
    if (h5->silent || h5->status != BRC_OK) return;
    const hid_t type = text_type(text, H5T_CSET_UTF8), space = H5Screate(H5S_SCALAR);
    create_dataset(h5, name, type, space, NULL, text);
    H5Sclose(space);
    H5Tclose(type);
}

static void add_attribute(brc_h5 *h5, const char *object, const char *name, hid_t type, hid_t space, const void *value)
{
    if (h5->silent || h5->status != BRC_OK) return;
    const hid_t attribute =
        H5Acreate_by_name(h5->file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    brc_h5_check(h5, attribute >= 0 && H5Awrite(attribute, type, value) >= 0 && H5Aclose(attribute) >= 0, name);
}

void brc_h5_attribute_text(brc_h5 *h5, const char *object, const char *name, const char *text)
{
    const hid_t type = text_type(text, H5T_CSET_ASCII), space = H5Screate(H5S_SCALAR);
    add_attribute(h5, object, name, type, space, text);
    H5Sclose(space);
    H5Tclose(type);
}

void brc_h5_describe(brc_h5 *h5, const char *object, const char *unit, const char *meaning)
{
    brc_h5_attribute_text(h5, object, "unit", unit);
    brc_h5_attribute_text(h5, object, "meaning", meaning);
}

void brc_h5_attribute_integers(brc_h5 *h5, const char *object, const char *name, int64_t n, const int64_t *values)
{
    const hsize_t size = (hsize_t)n;
    const hid_t space = H5Screate_simple(1, &size, NULL);
    add_attribute(h5, object, name, H5T_NATIVE_INT64, space, values);
    H5Sclose(space);
}

void brc_h5_attribute_number(brc_h5 *h5, const char *object, const char *name, double value)
{
    const hid_t space = H5Screate(H5S_SCALAR);
    add_attribute(h5, object, name, H5T_NATIVE_DOUBLE, space, &value);
    H5Sclose(space);
}

void brc_h5_link(brc_h5 *h5, const char *name, const char *object)
{
    if (h5->silent || h5->status != BRC_OK) return;
    brc_h5_check(h5, H5Lcreate_hard(h5->file, object, h5->file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0, name);
}

void brc_h5_external_link(brc_h5 *h5, const char *name, const char *file, const char *object)
{
    if (h5->silent || h5->status != BRC_OK) return;
    brc_h5_check(h5, H5Lcreate_external(file, object, h5->file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0, name);
}
