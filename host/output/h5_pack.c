/* Shuffle and deflate, as HDF5's filters of these names undo them. */
#include "h5_pack.h"
#include "../base/memory.h"
#include <libdeflate.h>
#include <omp.h>
#include <string.h>

enum { AT_ONCE = 64, SAMPLES = 256 }; /* blocks packed before they are written; numbers of a block that are looked at */
/* Blocks of 8 bytes a number are packed where this part of their bytes or more equals the byte of the number before:
 * doubles that differ have a sixth (signs and exponents), which is not worth the time, counts and zeros most. Others
 * always are: floats shrink by a twelfth to a seventh. A last block that is not full is packed for what fills it up. */
#define WORTH_PACKING 0.2
/* Of deflate: the quickest that looks for what occurs again. */
#define LEVEL 1

/* What is packed: rows of `width` bytes in all, numbers of `bytes` bytes. */
typedef struct packing {
    const char *data;
    int64_t rows, block, width, bytes;
    bool either; /* whichever is smaller, bytes together by their place or as they are */
} packing;

enum { AS_THEY_ARE = 1, NOT_PACKED = 3 }; /* filters left out: shuffle is the first, deflate the second */

/* Block k with bytes of equal place together; behind the last row zeros. */
static void shuffle(const packing *p, int64_t k, unsigned char *out)
{
    const int64_t rows = p->rows - k * p->block < p->block ? p->rows - k * p->block : p->block,
                  numbers = p->block * p->width / p->bytes;
    const unsigned char *in = (const unsigned char *)p->data + k * p->block * p->width;
    memset(out, 0, (size_t)(p->block * p->width));
    for (int64_t m = 0; m < rows * p->width / p->bytes; ++m)
        for (int64_t b = 0; b < p->bytes; ++b)
            out[b * numbers + m] = in[m * p->bytes + b];
}

static bool is_worth_packing(const packing *p, int64_t k)
{
    const int64_t rows = p->rows - k * p->block < p->block ? p->rows - k * p->block : p->block,
                  n = rows * p->width / p->bytes;
    const char *in = p->data + k * p->block * p->width;
    int64_t equal = 0, seen = 0;
    if (rows < p->block || p->bytes < 8) return true;
    for (int64_t m = 1; m < n; m += 1 + n / SAMPLES, ++seen)
        for (int64_t b = 0; b < p->bytes; ++b)
            equal += in[m * p->bytes + b] == in[(m - 1) * p->bytes + b];
    return (double)equal >= WORTH_PACKING * (double)(seen * p->bytes);
}

/* Bytes of a block deflated into out, which has room for `room`. */
static int64_t deflated(const packing *p, struct libdeflate_compressor *by, const unsigned char *block,
                        unsigned char *out, int64_t room)
{
    return (int64_t)libdeflate_zlib_compress(by, block, (size_t)(p->block * p->width), out, (size_t)room);
}

/* Bytes of block k packed into out; 0: memory is exhausted. scratch: room for a block, and for a packed one behind it.
 * *skipped: filters that were left out. */
static int64_t pack(const packing *p, int64_t k, unsigned char *scratch, unsigned char *out, int64_t room,
                    uint32_t *skipped)
{
    const int64_t raw = p->block * p->width, rest = (p->rows - k * p->block) * p->width;
    struct libdeflate_compressor *by = libdeflate_alloc_compressor(LEVEL);
    *skipped = 0;
    if (!by) return 0;
    shuffle(p, k, scratch);
    int64_t bytes = deflated(p, by, scratch, out, room);
    if (p->either) {
        memset(scratch, 0, (size_t)raw);
        memcpy(scratch, p->data + k * raw, (size_t)(rest < raw ? rest : raw));
        const int64_t plain = deflated(p, by, scratch, scratch + raw, room);
        if (plain < bytes) {
            memcpy(out, scratch + raw, (size_t)plain);
            *skipped = AS_THEY_ARE;
            bytes = plain;
        }
    }
    libdeflate_free_compressor(by);
    return bytes;
}

static void write_blocks(brc_h5 *h5, const char *name, int64_t first, const packing *p, int n_threads)
{
    const int64_t n = (p->rows + p->block - 1) / p->block, raw = p->block * p->width,
                  room = (int64_t)libdeflate_zlib_compress_bound(NULL, (size_t)raw);
    const int64_t at_once = n < AT_ONCE ? n : AT_ONCE;
    const int threads = n_threads > 0 ? n_threads : omp_get_max_threads();
    unsigned char *scratch = NULL, *out = NULL;
    int64_t bytes[AT_ONCE];
    uint32_t skipped[AT_ONCE];
    brc_status status = BRC_OK;
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(h5->context, &scratch, threads * (raw + room), "blocks of a file"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(h5->context, &out, at_once * room, "blocks of a file"));
    for (int64_t begin = 0; begin < n; begin += at_once) {
        const int64_t some = n - begin < at_once ? n - begin : at_once;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
        for (int64_t k = 0; k < some; ++k) {
            skipped[k] = NOT_PACKED;
            bytes[k] = raw;
            if (is_worth_packing(p, begin + k))
                bytes[k] = pack(p, begin + k, scratch + (raw + room) * omp_get_thread_num(), out + room * k, room,
                                &skipped[k]);
        }
        for (int64_t k = 0; k < some; ++k) {
            const hsize_t at[2] = {(hsize_t)(first + (begin + k) * p->block), 0};
            const void *block = skipped[k] == NOT_PACKED ? (const void *)(p->data + (begin + k) * raw) : out + room * k;
            brc_h5_check(h5,
                         dataset >= 0 && bytes[k] > 0 &&
                             H5Dwrite_chunk(dataset, H5P_DEFAULT, skipped[k], at, (size_t)bytes[k], block) >= 0,
                         name);
        }
    }
cleanup:
    if (h5->status == BRC_OK) h5->status = status;
    if (dataset >= 0) brc_h5_check(h5, H5Dclose(dataset) >= 0, name);
    brc_memory_free(scratch);
    brc_memory_free(out);
}

static void pack_rows(brc_h5 *h5, const char *name, hid_t type, int64_t first, int64_t n, const void *data, bool either,
                      int n_threads)
{
    if (h5->silent || h5->status != BRC_OK || n == 0) return;
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
    hsize_t size[2] = {0, 1};
    H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    H5Dclose(dataset);
    const int64_t rows = (int64_t)size[0], block = rows < BRC_H5_BLOCK ? rows : BRC_H5_BLOCK,
                  bytes = (int64_t)H5Tget_size(type);
    const packing p = {
        .data = data, .rows = n, .block = block, .width = bytes * (int64_t)size[1], .bytes = bytes, .either = either};
    if (first % block == 0 && (n % block == 0 || first + n == rows))
        write_blocks(h5, name, first, &p, n_threads);
    else
        brc_h5_rows(h5, name, type, first, n, data);
}

void brc_h5_pack_rows(brc_h5 *h5, const char *name, hid_t type, int64_t first, int64_t n, const void *data,
                      int n_threads)
{
    pack_rows(h5, name, type, first, n, data, false, n_threads);
}

void brc_h5_pack_rows_either(brc_h5 *h5, const char *name, hid_t type, int64_t first, int64_t n, const void *data,
                             int n_threads)
{
    pack_rows(h5, name, type, first, n, data, true, n_threads);
}
