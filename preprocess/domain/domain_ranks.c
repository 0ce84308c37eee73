/* The file that ranks map holds the struct, then each block behind its head; pointers are places in it, and NULL is 0,
 * where the struct is. Pages of a domain file have places there, but nothing is in them: they are laid over. */
#include "domain_ranks.h"
#include "domain_rows.h"
#include "../cells/cells_ranks.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"

#include <string.h>

/* Names and members are found through arrays that are theirs: a copy of these takes the places, as does one of ranges
 * of a domain file. */
typedef struct copy {
    brc_domain domain;
    char **wall_name;
    brc_set *sets;
    brc_file_range *range;
} copy;

typedef struct writer {
    brc_context *context;
    const brc_domain *from;
    copy *copy;
    int file;
    int64_t at;
} writer;

static brc_status append(writer *w, const void *data, int64_t bytes)
{
    w->at += bytes;
    return brc_machine_file_write(w->context, w->file, data, bytes);
}

static brc_status skip(writer *w, int64_t to)
{
    const int64_t bytes = to - w->at;
    w->at = to;
    return brc_machine_file_skip(w->context, w->file, bytes);
}

/* Room for range k, at whole pages as in the file. */
static brc_status leave_room(writer *w, int64_t k, const char head[BRC_MEMORY_HEAD], int64_t *place)
{
    brc_file_range *range = &w->copy->range[k];
    const int64_t page = BRC_FILE_PAGE, pages = (range->bytes + page - 1) / page;
    range->place = *place = (w->at + BRC_MEMORY_HEAD + page - 1) / page * page;
    BRC_TRY(skip(w, *place - BRC_MEMORY_HEAD));
    BRC_TRY(append(w, head, BRC_MEMORY_HEAD));
    return skip(w, *place + pages * page);
}

enum { PIECE = 16 << 20 };

/* Into the file, piece by piece, which are then in memory once; the pointer becomes the block's place. */
static brc_status write_block(void *self, void **block)
{
    writer *w = self;
    char head[BRC_MEMORY_HEAD];
    if (!*block) return BRC_OK;
    const int64_t bytes = brc_memory_block_bytes(*block),
                  range = brc_file_pages_find(&w->from->pages, &w->from->elsewhere, *block);
    int64_t place = 0;
    brc_memory_head(head, bytes);
    if (range >= 0) {
        BRC_TRY(leave_room(w, range, head, &place));
        *block = (void *)(intptr_t)place;
        return BRC_OK;
    }
    BRC_TRY(append(w, head, sizeof head));
    place = w->at;
    for (int64_t at = 0; at < bytes; at += PIECE) {
        const int64_t piece = bytes - at < PIECE ? bytes - at : PIECE;
        char *const data = (char *)*block + at;
        BRC_TRY(append(w, data, piece));
        brc_memory_forget(data, piece);
    }
    *block = (void *)(intptr_t)place;
    return BRC_OK;
}

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
    writer w = {.context = context, .from = domain, .copy = &c, .file = *file};
    BRC_TRY_OR(cleanup, copy_array(context, domain->wall_name, (void **)&c.wall_name));
    BRC_TRY_OR(cleanup, copy_array(context, domain->sets, (void **)&c.sets));
    BRC_TRY_OR(cleanup, copy_array(context, domain->pages.range, (void **)&c.range));
    c.domain.wall_name = c.wall_name;
    c.domain.sets = c.sets;
    c.domain.pages.range = c.range;
    BRC_TRY_OR(cleanup, append(&w, room, sizeof room));
    BRC_TRY_OR(cleanup, brc_domain_each_block(&c.domain, false, write_block, &w));
    status = brc_machine_file_place(context, *file, &c.domain, sizeof c.domain);
cleanup:
    brc_memory_free(c.wall_name);
    brc_memory_free(c.sets);
    brc_memory_free(c.range);
    return status;
}

/* From a place to a pointer. */
static brc_status find_block(void *self, void **block)
{
    char *const data = self;
    if (*block) *block = data + (intptr_t)*block;
    return BRC_OK;
}

/* The domain whose struct and blocks begin the memory, which becomes its own. Nothing is left of it after a failure. */
static brc_status find_domain(brc_context *context, brc_machine_memory *memory, brc_domain **out)
{
    const brc_status status = BRC_ALLOCATE(context, out, 1, "domain");
    if (status != BRC_OK) {
        brc_machine_memory_free(memory);
        return status;
    }
    memcpy(*out, memory->data, sizeof **out);
    (void)brc_domain_each_block(*out, true, find_block, memory->data);
    (*out)->elsewhere = *memory;
    return BRC_OK;
}

static brc_status share(brc_context *context, brc_domain **domain, bool *done)
{
    const bool first = *domain != NULL;
    int file = -1;
    brc_domain *own = NULL;
    brc_machine_memory memory;
    brc_status status = first ? write_domain(context, *domain, &file) : BRC_OK;
    BRC_TRY(brc_ranks_agree(context, status));
    *done = brc_machine_memory_map(context, file, &memory) == BRC_OK;
    if (memory.data) status = find_domain(context, &memory, &own);
    if (status == BRC_OK && first && !own)
        status = BRC_FAIL(context, BRC_NO_MEMORY, "the domain is in a file in memory, which cannot be mapped");
    if (status == BRC_OK && own && !brc_file_pages_lay(&own->pages, &own->elsewhere)) {
        brc_domain_free(&own);
        if (first) status = BRC_FAIL(context, BRC_FILE_FAILED, "%s is gone, or another one", (*domain)->pages.path);
    }
    int64_t lacks = !own;
    if (*done) {
        BRC_TRY_OR(cleanup, brc_ranks_agree(context, status));
        BRC_TRY_OR(cleanup, brc_ranks_reduce(context, BRC_SUM, 1, &lacks));
        *done = lacks == 0;
    }
    if (status != BRC_OK) goto cleanup;
    if (!*done)
        brc_log(context, BRC_LOG_WARNING,
                "ranks of a machine cannot see one another's memory or files: each "
                "builds the domain and keeps it");
    if (*done || first) {
        brc_domain_free(domain);
        *domain = own;
        own = NULL;
    }
cleanup:
    brc_domain_free(&own);
    return status;
}

/* ---- what each rank keeps for itself ---- */

/* Its own cells, where ranks have the domain between them. */
typedef struct kept {
    uint8_t *here;
    int64_t *home;
    void *part[BRC_DOMAIN_PARTS];
} kept;

static kept take_off(brc_domain *d)
{
    kept k = {d->here, d->home, {NULL}};
    void **part[BRC_DOMAIN_PARTS];
    brc_domain_parts(d, part);
    for (int p = 0; p < BRC_DOMAIN_PARTS; ++p) {
        k.part[p] = *part[p];
        *part[p] = NULL;
    }
    d->here = NULL;
    d->home = NULL;
    return k;
}

static void put_on(kept k, brc_domain *d)
{
    void **part[BRC_DOMAIN_PARTS];
    brc_domain_parts(d, part);
    for (int p = 0; p < BRC_DOMAIN_PARTS; ++p)
        *part[p] = k.part[p];
    d->here = k.here;
    d->home = k.home;
}

/* All ranks: which of them are the first of their machine [count]. */
static brc_status find_firsts(brc_context *context, int32_t *is_first)
{
    const brc_ranks_place here = brc_ranks_here();
    const int32_t first = here.local == 0;
    BRC_LOCAL(context, here.count, int64_t, ones, "ranks");
    for (int32_t k = 0; k < here.count; ++k)
        ones[k] = 1;
    return brc_ranks_gather_all(context, &first, sizeof first, ones, is_first);
}

/* Homes, which the first ranks of machines know by their number among them, by their number among all. */
static brc_status name_homes(brc_context *context, const int32_t *is_first, brc_domain *d)
{
    const int32_t count = brc_ranks_count();
    int32_t n = 0;
    int64_t *home;
    for (int32_t k = 0; k < count; ++k)
        n += is_first[k];
    BRC_TRY(BRC_ALLOCATE(context, &home, count + 1, "ranks"));
    for (int32_t k = 0, at = 0; k < count; ++k)
        home[k + 1] = is_first[k] ? brc_elements_of_rank(d->n_elements, at++, n).end : home[k];
    brc_memory_free(d->home);
    d->home = home;
    return BRC_OK;
}

brc_status brc_domain_share(brc_context *context, brc_domain **domain, bool *done)
{
    kept own = {NULL};
    const bool apart = *domain && (*domain)->here;
    BRC_LOCAL(context, brc_ranks_count(), int32_t, is_first, "ranks");
    BRC_TRY(find_firsts(context, is_first));
    if (apart) own = take_off(*domain);
    brc_status status = share(context, domain, done);
    if (apart && *domain) put_on(own, *domain);
    BRC_TRY(status);
    int64_t any = apart;
    BRC_TRY(brc_ranks_reduce(context, BRC_SUM, 1, &any));
    if (any == 0) return BRC_OK;
    if (*done) {
        if (!apart) BRC_TRY(brc_domain_make_room(context, *domain));
        return name_homes(context, is_first, *domain);
    }
    if (!apart) return BRC_OK; /* builds it whole */
    brc_ranks_narrow();
    status = brc_domain_bring_whole(context, *domain);
    brc_ranks_widen();
    return status;
}
