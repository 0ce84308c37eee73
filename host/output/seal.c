#include "seal.h"
#include "../base/memory.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

enum { BLOCK = 1 << 20, SEAL_BYTES = 64 };
static const char FORM[] = "\nbreccia seal: %016" PRIx64 " bytes, CRC-32 %08" PRIx32;

uint32_t brc_seal_sum(uint32_t sum, const void *data, int64_t bytes)
{
    return (uint32_t)crc32_z(sum, data, (z_size_t)bytes);
}

uint32_t brc_seal_join(uint32_t sum, uint32_t next, int64_t bytes)
{
    return (uint32_t)crc32_combine(sum, next, (z_off_t)bytes);
}

/* Sum over the first `bytes` bytes; *read: how many there were. */
static bool sum_file(FILE *file, char *block, int64_t bytes, int64_t *read, uint32_t *sum)
{
    *read = 0;
    *sum = 0;
    while (*read < bytes) {
        const size_t want = bytes - *read < BLOCK ? (size_t)(bytes - *read) : BLOCK, got = fread(block, 1, want, file);
        *sum = brc_seal_sum(*sum, block, (int64_t)got);
        *read += (int64_t)got;
        if (got < want) break;
    }
    return !ferror(file);
}

static void make_seal(char seal[SEAL_BYTES + 1], int64_t bytes, uint32_t sum)
{
    memset(seal, 0, SEAL_BYTES + 1);
    const int n = snprintf(seal, SEAL_BYTES, FORM, (uint64_t)bytes, sum);
    memset(seal + n, ' ', (size_t)(SEAL_BYTES - 1 - n));
    seal[SEAL_BYTES - 1] = '\n';
}

brc_status brc_seal_add(brc_context *context, const char *path)
{
    char *block = NULL, seal[SEAL_BYTES + 1];
    int64_t bytes;
    uint32_t sum;
    FILE *file = fopen(path, "r+b");
    brc_status status = BRC_OK;
    if (!file) return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot open: %s", path, strerror(errno));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &block, BLOCK, "block of a file"));
    const bool ok = sum_file(file, block, INT64_MAX, &bytes, &sum);
    make_seal(seal, bytes, sum);
    if (!ok || fseeko(file, 0, SEEK_END) != 0 || fwrite(seal, 1, SEAL_BYTES, file) != SEAL_BYTES)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write its seal: %s", path, strerror(errno));
cleanup:
    if (fclose(file) != 0 && status == BRC_OK)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot write its seal: %s", path, strerror(errno));
    brc_memory_free(block);
    return status;
}

brc_status brc_seal_check(brc_context *context, const char *path, bool *whole, char *why, size_t room)
{
    char *block = NULL, seal[SEAL_BYTES + 1], expected[SEAL_BYTES + 1];
    int64_t bytes, read;
    uint32_t sum;
    FILE *file = fopen(path, "rb");
    brc_status status = BRC_OK;
    *whole = false;
    why[0] = '\0';
    if (!file) return BRC_FAIL(context, BRC_BAD_INPUT, "%s: cannot open: %s", path, strerror(errno));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &block, BLOCK, "block of a file"));
    seal[SEAL_BYTES] = '\0';
    bytes = fseeko(file, -SEAL_BYTES, SEEK_END) == 0 ? (int64_t)ftello(file) : -1;
    if (bytes < 0 || fread(seal, 1, SEAL_BYTES, file) != SEAL_BYTES ||
        memcmp(seal, FORM, sizeof "\nbreccia seal: " - 1) != 0) {
        snprintf(why, room, "it has no seal: it was cut short, or is no checkpoint");
        goto cleanup;
    }
    rewind(file);
    if (!sum_file(file, block, bytes, &read, &sum) || read != bytes) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: cannot read: %s", path, strerror(errno));
        goto cleanup;
    }
    make_seal(expected, bytes, sum);
    *whole = memcmp(seal, expected, SEAL_BYTES) == 0;
    if (!*whole)
        snprintf(why, room,
                 "it was changed after it was written: its length and checksum are %lld, %08" PRIx32
                 ", its seal says '%.*s'",
                 (long long)bytes, sum, (int)strcspn(seal + 1, "\n"), seal + 1);
cleanup:
    fclose(file);
    brc_memory_free(block);
    return status;
}
