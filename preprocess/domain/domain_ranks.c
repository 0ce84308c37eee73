/* The file that ranks map holds the struct, then each block behind its head; pointers are places in it, and NULL is 0,
 * where the struct is. */
#include "domain_ranks.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"

#include <string.h>

typedef struct writer {
    brc_context *context;
    int file;
    int64_t at;
} writer;

static brc_status append(writer *w, const void *data, int64_t bytes)
{
    w->at += bytes;
    return brc_machine_file_write(w->context, w->file, data, bytes);
}

enum { PIECE = 16 << 20 };

/* Into the file, piece by piece, which are then in memory once; the pointer becomes the block's place. */
static brc_status write_block(void *self, void **block)
{
    writer *w = self;
    char head[BRC_MEMORY_HEAD];
    if (!*block) return BRC_OK;
    const int64_t bytes = brc_memory_block_bytes(*block);
    brc_memory_head(head, bytes);
    BRC_TRY(append(w, head, sizeof head));
    const int64_t place = w->at;
    for (int64_t at = 0; at < bytes; at += PIECE) {
        const int64_t piece = bytes - at < PIECE ? bytes - at : PIECE;
        char *const data = (char *)*block + at;
        BRC_TRY(append(w, data, piece));
        brc_memory_forget(data, piece);
    }
    *block = (void *)(intptr_t)place;
    return BRC_OK;
}

/* Names and members are found through arrays that are theirs: a copy of these takes the places. */
typedef struct copy {
    brc_domain domain;
    char **wall_name;
    brc_set *sets;
} copy;

static brc_status copy_array(brc_context *context, const void *from, void **out)
{
    *out = NULL;
    if (!from) return BRC_OK;
    const int64_t bytes = brc_memory_block_bytes(from);
    BRC_TRY(brc_memory_allocate(context, out, bytes, 1, "domain of ranks"));
    memcpy(*out, from, (size_t)bytes);
    return BRC_OK;
}

static brc_status write_domain(brc_context *context, const brc_domain *domain, int *file)
{
    static const char room[(sizeof(brc_domain) + BRC_MEMORY_HEAD - 1) / BRC_MEMORY_HEAD * BRC_MEMORY_HEAD];
    copy c = {.domain = *domain};
    brc_status status = BRC_OK;
    BRC_TRY(brc_machine_file(context, file));
    writer w = {.context = context, .file = *file};
    BRC_TRY_OR(cleanup, copy_array(context, domain->wall_name, (void **)&c.wall_name));
    BRC_TRY_OR(cleanup, copy_array(context, domain->sets, (void **)&c.sets));
    c.domain.wall_name = c.wall_name;
    c.domain.sets = c.sets;
    BRC_TRY_OR(cleanup, append(&w, room, sizeof room));
    BRC_TRY_OR(cleanup, brc_domain_each_block(&c.domain, false, write_block, &w));
    status = brc_machine_file_place(context, *file, &c.domain, sizeof c.domain);
cleanup:
    brc_memory_free(c.wall_name);
    brc_memory_free(c.sets);
    return status;
}

/* From a place to a pointer. */
static brc_status find_block(void *self, void **block)
{
    char *const data = self;
    if (*block) *block = data + (intptr_t)*block;
    return BRC_OK;
}

brc_status brc_domain_share(brc_context *context, brc_domain **domain, bool *done)
{
    int file = -1;
    brc_domain *own = NULL;
    brc_machine_memory memory;
    brc_status status = *domain ? write_domain(context, *domain, &file) : BRC_OK;
    BRC_TRY(brc_ranks_agree(context, status));
    *done = brc_machine_memory_map(context, file, &memory) == BRC_OK;
    if (!*done)
        brc_log(context, BRC_LOG_WARNING,
                "ranks of a machine cannot see one another's memory: each builds the domain and keeps it");
    if (!memory.data && *domain)
        return BRC_FAIL(context, BRC_NO_MEMORY, "the domain is in a file in memory, which cannot be mapped");
    if (!memory.data) return BRC_OK;
    status = BRC_ALLOCATE(context, &own, 1, "domain");
    if (status != BRC_OK) {
        brc_machine_memory_free(&memory);
        return status;
    }
    memcpy(own, memory.data, sizeof *own);
    (void)brc_domain_each_block(own, true, find_block, memory.data);
    own->shared = memory;
    brc_domain_free(domain);
    *domain = own;
    return BRC_OK;
}
