#include "machine_memory.h"
#include "memory.h"
#include "ranks.h"
#include "spill.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

brc_status brc_machine_file(brc_context *context, int *file)
{
    *file = brc_spill_folder() ? brc_spill_file() : memfd_create("breccia", MFD_CLOEXEC);
    if (*file < 0)
        return BRC_FAIL(context, BRC_NO_MEMORY, "no file in %s for ranks: %s",
                        brc_spill_folder() ? brc_spill_folder() : "memory", strerror(errno));
    return BRC_OK;
}

brc_status brc_machine_file_write(brc_context *context, int file, const void *data, int64_t bytes)
{
    const char *at = data;
    while (bytes > 0) {
        const ssize_t n = write(file, at, (size_t)(bytes < 1 << 30 ? bytes : 1 << 30));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0)
            return BRC_FAIL(context, BRC_NO_MEMORY, "%lld bytes more in memory for ranks: %s", (long long)bytes,
                            strerror(errno));
        at += n;
        bytes -= n;
    }
    return BRC_OK;
}

brc_status brc_machine_file_skip(brc_context *context, int file, int64_t bytes)
{
    const off_t end = lseek(file, (off_t)bytes, SEEK_CUR);
    if (end >= 0 && ftruncate(file, end) == 0) return BRC_OK;
    return BRC_FAIL(context, BRC_NO_MEMORY, "a file in memory for ranks cannot grow: %s", strerror(errno));
}

brc_status brc_machine_file_place(brc_context *context, int file, const void *data, int64_t bytes)
{
    if (pwrite(file, data, (size_t)bytes, 0) == bytes) return BRC_OK;
    return BRC_FAIL(context, BRC_NO_MEMORY, "memory for ranks cannot be written: %s", strerror(errno));
}

/* Where the first rank of this machine has its file. */
typedef struct address {
    char node[256];
    int32_t local, file;
    int64_t process, bytes;
} address;

static brc_status find_first(brc_context *context, int file, address *out)
{
    const brc_ranks_place here = brc_ranks_here();
    struct stat about = {0};
    address own = {.local = here.local, .file = file, .process = getpid()}, *all = NULL;
    int64_t *ones = NULL;
    brc_status status = BRC_OK;
    snprintf(own.node, sizeof own.node, "%s", here.node);
    if (here.local == 0 && fstat(file, &about) == 0) own.bytes = about.st_size;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &all, here.count, "ranks"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &ones, here.count, "ranks"));
    for (int32_t k = 0; k < here.count; ++k)
        ones[k] = 1;
    BRC_TRY_OR(cleanup, brc_ranks_gather_all(context, &own, sizeof own, ones, all));
    for (int32_t k = 0; k < here.count; ++k)
        if (all[k].local == 0 && strcmp(all[k].node, own.node) == 0) *out = all[k];
cleanup:
    brc_memory_free(all);
    brc_memory_free(ones);
    return status;
}

static int open_first(const address *first, int file, int access)
{
    char path[64];
    snprintf(path, sizeof path, "/proc/%lld/fd/%d", (long long)first->process, (int)first->file);
    return first->process == getpid() ? dup(file) : open(path, access | O_CLOEXEC);
}

/* The file of the machine's first rank, opened by each of its ranks; `file`, of the first, is closed. */
static brc_status meet(brc_context *context, int file, int access, address *first, int *there)
{
    *first = (address){.file = -1};
    *there = -1;
    brc_status status = find_first(context, file, first);
    if (status == BRC_OK) *there = open_first(first, file, access);
    int64_t lacks = *there < 0;
    if (status == BRC_OK) status = brc_ranks_reduce(context, BRC_SUM, 1, &lacks); /* nobody closes before all opened */
    if (file >= 0) close(file);
    if (status == BRC_OK && lacks)
        status = BRC_FAIL(context, BRC_INTERNAL, "%lld ranks cannot open the memory of their machine's first",
                          (long long)lacks);
    if (status == BRC_OK || *there < 0) return status;
    close(*there);
    *there = -1;
    return status;
}

/* Pages that are written become the rank's own. at: where, or NULL. */
static bool map_file(int file, int64_t bytes, void *at, brc_machine_memory *out)
{
    void *const data =
        mmap(at, (size_t)bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE | (at ? MAP_FIXED : 0), file, 0);
    if (data != MAP_FAILED) *out = (brc_machine_memory){data, bytes};
    return data != MAP_FAILED;
}

static brc_status map(brc_context *context, int file, void *at, brc_machine_memory *out)
{
    address first;
    int there;
    *out = (brc_machine_memory){0};
    brc_status status = meet(context, file, O_RDONLY, &first, &there);
    if (status == BRC_OK && !map_file(there, first.bytes, at, out))
        status = BRC_FAIL(context, BRC_NO_MEMORY, "%lld bytes of the machine's first rank: %s", (long long)first.bytes,
                          strerror(errno));
    if (there >= 0) close(there);
    return brc_ranks_agree(context, status); /* a rank alone without it would go on another way */
}

brc_status brc_machine_memory_map(brc_context *context, int file, brc_machine_memory *out)
{
    const int kept = file >= 0 ? dup(file) : -1;
    struct stat about;
    const brc_status status = map(context, file, NULL, out);
    if (status != BRC_OK) {
        brc_machine_memory_free(out);
        if (kept >= 0 && fstat(kept, &about) == 0) (void)map_file(kept, about.st_size, NULL, out);
    }
    if (kept >= 0) close(kept);
    return status;
}

brc_status brc_machine_memory_lay(brc_context *context, int file, void *at)
{
    brc_machine_memory unused;
    return map(context, file, at, &unused);
}

void brc_machine_memory_free(brc_machine_memory *memory)
{
    if (memory->data) (void)munmap(memory->data, (size_t)memory->bytes);
    *memory = (brc_machine_memory){0};
}

/* ---- memory that the ranks of a machine write together ---- */

static brc_status have_own(brc_context *context, int64_t bytes, brc_common_memory *out)
{
    *out = (brc_common_memory){.bytes = bytes, .file = -1, .parts = 1};
    return brc_memory_allocate(context, &out->data, bytes, 1, "memory of ranks");
}

static size_t at_least_one(int64_t bytes)
{
    return bytes > 0 ? (size_t)bytes : 1;
}

/* Room is set aside: what cannot be written later would end the process with a signal. */
static brc_status make_room(brc_context *context, int64_t bytes, int *file)
{
    BRC_TRY(brc_machine_file(context, file));
    const int error = posix_fallocate(*file, 0, (off_t)at_least_one(bytes));
    if (error == 0) return BRC_OK;
    return BRC_FAIL(context, BRC_NO_MEMORY, "%lld bytes in memory for ranks: %s", (long long)bytes, strerror(error));
}

/* The first's file as memory that all write. */
static brc_status have_common(brc_context *context, int64_t bytes, int there, brc_common_memory *out)
{
    const brc_ranks_place here = brc_ranks_here();
    void *const data = mmap(NULL, at_least_one(bytes), PROT_READ | PROT_WRITE, MAP_SHARED, there, 0);
    if (data == MAP_FAILED)
        return BRC_FAIL(context, BRC_NO_MEMORY, "%lld bytes of the machine's first rank: %s", (long long)bytes,
                        strerror(errno));
    *out = (brc_common_memory){data, bytes, there, here.local, here.local_count};
    return BRC_OK;
}

brc_status brc_common_memory_begin(brc_context *context, int64_t bytes, brc_common_memory *out)
{
    address first;
    int file = -1, there = -1;
    *out = (brc_common_memory){.file = -1};
    if (brc_ranks_count() == 1) return have_own(context, bytes, out);
    brc_status status = brc_ranks_here().local == 0 ? make_room(context, bytes, &file) : BRC_OK;
    status = brc_ranks_agree(context, status);
    if (status == BRC_OK) {
        status = meet(context, file, O_RDWR, &first, &there);
        const bool apart = status == BRC_INTERNAL; /* they see no memory of each other, or one of them has failed */
        if (apart && brc_ranks_agree(context, BRC_OK) == BRC_OK) {
            brc_context_clear(context);
            status = have_own(context, bytes, out);
        }
        if (status == BRC_OK && !apart) status = have_common(context, bytes, there, out);
        if (there >= 0 && !out->data) close(there);
    } else if (file >= 0) {
        close(file);
    }
    status = brc_ranks_agree(context, status);
    if (status != BRC_OK) brc_common_memory_free(out);
    return status;
}

bool brc_common_memory_lay(const brc_common_memory *memory, void *at)
{
    brc_machine_memory unused;
    return memory->file >= 0 && map_file(memory->file, memory->bytes, at, &unused);
}

void brc_common_memory_free(brc_common_memory *memory)
{
    if (memory->data && memory->file >= 0) {
        (void)munmap(memory->data, at_least_one(memory->bytes));
        close(memory->file);
    } else {
        brc_memory_free(memory->data);
    }
    *memory = (brc_common_memory){.file = -1};
}
