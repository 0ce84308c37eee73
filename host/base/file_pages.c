/* Each range has a page of the process's own in front of it, whose end is the head of the block. */
#include "file_pages.h"

#include "memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static int64_t whole_pages(int64_t bytes)
{
    return (bytes + BRC_FILE_PAGE - 1) / BRC_FILE_PAGE * BRC_FILE_PAGE;
}

brc_status brc_file_pages_begin(brc_context *context, int file, const char *path, int64_t most,
                                brc_machine_memory *memory, brc_file_pages *pages)
{
    struct stat about;
    char *absolute = realpath(path, NULL);
    void *data = MAP_FAILED;
    brc_status status = BRC_OK;
    *memory = (brc_machine_memory){0};
    *pages = (brc_file_pages){0};
    if (!absolute || fstat(file, &about) != 0)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: %s", path, strerror(errno));
    if (status != BRC_OK) goto cleanup;
    const int64_t bytes = about.st_size + (2 * most + 1) * BRC_FILE_PAGE;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &pages->path, (int64_t)strlen(absolute) + 1, "path of a file"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &pages->range, most, "ranges of a file"));
    strcpy(pages->path, absolute);
    pages->device = (int64_t)about.st_dev;
    pages->inode = (int64_t)about.st_ino;
    data = mmap(NULL, (size_t)bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (data == MAP_FAILED)
        status = BRC_FAIL(context, BRC_NO_MEMORY, "%s: no addresses for %lld bytes: %s", path, (long long)bytes,
                          strerror(errno));
    else
        *memory = (brc_machine_memory){data, bytes};
cleanup:
    free(absolute);
    if (status == BRC_OK) return BRC_OK;
    brc_memory_free(pages->path);
    brc_memory_free(pages->range);
    *pages = (brc_file_pages){0};
    return status;
}

static bool lay(int file, const brc_file_range *range, const brc_machine_memory *memory)
{
    return mmap(memory->data + range->place, (size_t)range->bytes, PROT_READ | PROT_WRITE,
                MAP_PRIVATE | MAP_NORESERVE | MAP_FIXED, file, range->offset) != MAP_FAILED;
}

void *brc_file_pages_add(int file, int64_t offset, int64_t bytes, const brc_machine_memory *memory,
                         brc_file_pages *pages)
{
    struct stat about;
    const brc_file_range *last = pages->n > 0 ? &pages->range[pages->n - 1] : NULL;
    const int64_t place = (last ? last->place + whole_pages(last->bytes) : 0) + BRC_FILE_PAGE;
    if (bytes < BRC_LEAST_FILE_RANGE || offset % BRC_FILE_PAGE != 0 || sysconf(_SC_PAGESIZE) > BRC_FILE_PAGE ||
        fstat(file, &about) != 0 || offset > about.st_size - bytes || place + whole_pages(bytes) > memory->bytes)
        return NULL;
    const brc_file_range range = {.place = place, .offset = offset, .bytes = bytes};
    if (!lay(file, &range, memory)) return NULL;
    pages->range[pages->n++] = range;
    char *const block = memory->data + place;
    brc_memory_head(block - BRC_MEMORY_HEAD, (bytes + BRC_MEMORY_HEAD - 1) / BRC_MEMORY_HEAD * BRC_MEMORY_HEAD);
    return block;
}

bool brc_file_pages_lay(const brc_file_pages *pages, const brc_machine_memory *memory)
{
    struct stat about;
    if (pages->n == 0) return true;
    const int file = open(pages->path, O_RDONLY | O_CLOEXEC);
    bool done = file >= 0 && fstat(file, &about) == 0 && (int64_t)about.st_dev == pages->device &&
                (int64_t)about.st_ino == pages->inode;
    for (int64_t k = 0; done && k < pages->n; ++k)
        done = lay(file, &pages->range[k], memory);
    if (file >= 0) close(file);
    return done;
}

int64_t brc_file_pages_find(const brc_file_pages *pages, const brc_machine_memory *memory, const void *block)
{
    for (int64_t k = 0; k < pages->n; ++k)
        if (memory->data + pages->range[k].place == (const char *)block) return k;
    return -1;
}

void brc_file_pages_forget(const brc_file_pages *pages, const brc_machine_memory *memory)
{
    for (int64_t k = 0; k < pages->n; ++k)
        brc_memory_forget(memory->data + pages->range[k].place, pages->range[k].bytes);
}
