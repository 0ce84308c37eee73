/* Between whole arrays of the host and those of a device that ranks share: on the cpu a rank has pages of its own rows
 * and of those that its bonds reach, and of no others until they are asked for. */
#include "shares_internal.h"
#include "../base/machine_memory.h"
#include "../base/memory.h"
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

typedef struct brc_shares shares;

enum {
    SPARE = 64,
    LAUNCHES_BETWEEN = 512
}; /* giving back pages of one array: those of some come and go in every step */

/* Bytes of the rank's own. */
typedef struct range {
    int64_t first, end;
} range;

static range own_of(const brc_buffer *buffer)
{
    const shares *h = buffer->device->shares;
    return (range){brc_share_before(h, buffer->of, h->first_slice[h->mine]) * buffer->each,
                   brc_share_before(h, buffer->of, h->first_slice[h->mine + 1]) * buffer->each};
}

static int64_t bytes_of(const brc_buffer *buffer)
{
    const shares *h = buffer->device->shares;
    return brc_share_before(h, buffer->of, h->rows.n_slices) * buffer->each;
}

static bool is_of_rows(const brc_buffer *buffer)
{
    return buffer->of != BRC_OF_NOTHING && buffer->of != BRC_OF_BLOCKS && buffer->of != BRC_OF_LOOSE;
}

/* Whether a rank can do with its own part. */
static bool is_in_parts(const brc_buffer *buffer)
{
    const shares *h = buffer->device->shares;
    return h && buffer->device->info.kind == BRC_DEVICE_CPU && is_of_rows(buffer) && bytes_of(buffer) <= buffer->bytes;
}

const uint8_t *brc_buffer_slices_here(const brc_buffer *buffer)
{
    return is_in_parts(buffer) ? buffer->device->shares->slice_here : NULL;
}

void brc_device_bytes_in_parts(const brc_device *device, int64_t *of_rows, int64_t *once)
{
    *of_rows = *once = 0;
    if (device->info.kind != BRC_DEVICE_CPU) return;
    for (const brc_buffer *buffer = device->buffers; buffer; buffer = buffer->older)
        if (is_of_rows(buffer))
            *of_rows += buffer->bytes;
        else if (buffer->of == BRC_OF_NOTHING && buffer->bytes >= BRC_LARGE_ARRAY)
            *once += buffer->bytes;
}

/* ---- pages ---- */

static void advise(const brc_buffer *buffer, int64_t first, int64_t end, int64_t page, int advice)
{
    first = (first + page - 1) / page * page;
    end = end / page * page;
    if (first < end) (void)madvise((char *)buffer->memory + first, (size_t)(end - first), advice); /* a wish */
}

void brc_share_pages(const brc_buffer *buffer)
{
    if (!is_in_parts(buffer) || buffer->bytes < BRC_LARGE_ARRAY) return;
    const range own = own_of(buffer);
    const int64_t page = sysconf(_SC_PAGESIZE);
    advise(buffer, 0, buffer->bytes, page, MADV_NOHUGEPAGE);
    advise(buffer, own.first, own.end, BRC_LARGE_ARRAY, MADV_HUGEPAGE);
}

void brc_buffer_is_of(brc_buffer *buffer, brc_array_of what, int64_t bytes, int64_t number)
{
    buffer->of = what;
    buffer->each = bytes;
    buffer->number = number;
    brc_share_pages(buffer);
}

void brc_share_give_back(brc_buffer *buffer)
{
    const int64_t now = buffer->device->shares->n_launches;
    if (!is_in_parts(buffer) || buffer->bytes < BRC_LARGE_ARRAY || now - buffer->given_back < LAUNCHES_BETWEEN) return;
    const range own = own_of(buffer);
    const int64_t page = sysconf(_SC_PAGESIZE);
    advise(buffer, 0, own.first, page, MADV_DONTNEED);
    advise(buffer, own.end, bytes_of(buffer), page, MADV_DONTNEED);
    buffer->given_back = now;
    buffer->filled = false;
}

/* ---- copies ---- */

/* A piece of what the host has; data NULL: of zeros. */
static void put(const brc_buffer *buffer, const char *data, int64_t at, int64_t bytes)
{
    char *const to = (char *)buffer->memory + at;
    if (data)
        memcpy(to, data + at, (size_t)bytes);
    else
        memset(to, 0, (size_t)bytes);
}

static void put_near(const brc_buffer *buffer, const char *data)
{
    const shares *h = buffer->device->shares;
    const int64_t slice = h->rows.slice,
                  parts = buffer->of == BRC_OF_SLOTS ? buffer->each / (buffer->number * slice) : 1;
    for (int64_t k = 0; k < h->take.start[h->n_beside]; ++k) {
        const int64_t row = h->take.row[k];
        if (buffer->of == BRC_OF_ROWS) put(buffer, data, row * buffer->each, buffer->each);
        for (int64_t slot = h->slot_start[row / slice];
             buffer->of == BRC_OF_SLOTS && slot < h->slot_start[row / slice + 1]; ++slot)
            for (int64_t part = 0; part < parts; ++part)
                put(buffer, data, ((slot * parts + part) * slice + row % slice) * buffer->number, buffer->number);
    }
}

/* The parts of this rank, of what all have. */
static void put_parts(brc_buffer *buffer, const char *data)
{
    buffer->set = 0;
    const range own = own_of(buffer);
    const bool near = buffer->of == BRC_OF_ROWS || (buffer->of == BRC_OF_SLOTS && buffer->number > 0);
    if (own.first < own.end) put(buffer, data, own.first, own.end - own.first);
    if (near) put_near(buffer, data);
    buffer->where = near ? BRC_NEAR : BRC_MINE;
    buffer->marked = false;
}

bool brc_share_write(brc_buffer *buffer, int64_t offset, const void *data, int64_t bytes)
{
    if (!is_in_parts(buffer) || offset != 0 || bytes != bytes_of(buffer)) return false;
    put_parts(buffer, data);
    return true;
}

static brc_status write_once(brc_context *context, const brc_buffer *buffer, const void *data, int64_t bytes)
{
    int file = -1;
    brc_status status = BRC_OK;
    if (brc_ranks_here().local == 0) {
        status = brc_machine_file(context, &file);
        if (status == BRC_OK) status = brc_machine_file_write(context, file, data, bytes);
    }
    BRC_TRY(brc_ranks_agree(context, status));
    return brc_machine_memory_lay(context, file, buffer->memory);
}

bool brc_share_once(brc_buffer *buffer, int64_t offset, const void *data, int64_t bytes)
{
    shares *h = buffer->device->shares;
    if (!h || !h->ranks_meet || buffer->device->info.kind != BRC_DEVICE_CPU || buffer->of != BRC_OF_NOTHING ||
        buffer->is_scratch)
        return false;
    /* what follows in the last page becomes 0: no more than the spare numbers of an array (solver/core/fields.c) */
    if (offset != 0 || bytes < BRC_LARGE_ARRAY || buffer->bytes - bytes > SPARE) return false;
    h->ranks_meet = write_once(buffer->device->context, buffer, data, bytes) == BRC_OK;
    return h->ranks_meet;
}

bool brc_share_zero(brc_buffer *buffer)
{
    if (!is_in_parts(buffer)) return false;
    put_parts(buffer, NULL);
    return true;
}

brc_status brc_share_read(brc_buffer *buffer, int64_t offset, void *data, int64_t bytes, bool for_file, bool *done)
{
    const shares *h = buffer->device->shares;
    int64_t *n_of = NULL;
    *done = false;
    if (!is_in_parts(buffer) || offset != 0 || bytes != bytes_of(buffer)) return BRC_OK;
    BRC_TRY(brc_share_settle(buffer));
    if (buffer->where == BRC_EVERYWHERE) return BRC_OK;
    *done = true;
    BRC_TRY(BRC_ALLOCATE(buffer->device->context, &n_of, h->n_ranks, "shares of ranks"));
    for (int32_t rank = 0; rank < h->n_ranks; ++rank)
        n_of[rank] = (brc_share_before(h, buffer->of, h->first_slice[rank + 1]) -
                      brc_share_before(h, buffer->of, h->first_slice[rank])) *
                     (for_file ? buffer->each : 1);
    const char *const own = (const char *)buffer->memory + own_of(buffer).first;
    const brc_status status = for_file ? brc_ranks_gather_first(buffer->device->context, own, n_of, data)
                                       : brc_ranks_gather_all(buffer->device->context, own, buffer->each, n_of, data);
    brc_memory_free(n_of);
    return status;
}
