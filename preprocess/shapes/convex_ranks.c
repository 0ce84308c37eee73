/* Corners of faces are counted first, by each rank for its cells; all see the counts of all, so each knows where its
 * loops begin. */
#include "convex_ranks.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"
#include "convex_internal.h"

#include <string.h>

/* Sizes of the cells and of what follows them. */
typedef struct sizes {
    int64_t n, corners, faces, loops;
} sizes;

static sizes sizes_of(const brc_convex *c)
{
    const int32_t n = c ? c->n : 0, faces = n ? c->face_start[n] : 0;
    return (sizes){n, n ? c->corner_start[n] : 0, faces, n ? c->loop_start[faces] : 0};
}

static brc_status begin(brc_context *context, int64_t count, int64_t size, brc_common_memory *memory, void *out)
{
    BRC_TRY(brc_common_memory_begin(context, count * size, memory));
    memcpy(out, &memory->data, sizeof memory->data);
    return BRC_OK;
}

static brc_status begin_all(brc_context *context, const sizes *cells, const sizes *more, brc_convex_common *out)
{
    const int64_t n = cells->n + more->n, corners = cells->corners + more->corners, faces = cells->faces + more->faces;
    brc_convex *c = &out->all;
    BRC_TRY(brc_convex_check_size(context, n, corners, faces));
    c->n = (int32_t)n;
    BRC_TRY(begin(context, n + 1, sizeof *c->corner_start, &out->memory[BRC_CONVEX_CORNER_START], &c->corner_start));
    BRC_TRY(begin(context, 3 * corners, sizeof *c->corner, &out->memory[BRC_CONVEX_CORNER], &c->corner));
    BRC_TRY(begin(context, n + 1, sizeof *c->face_start, &out->memory[BRC_CONVEX_FACE_START], &c->face_start));
    BRC_TRY(begin(context, 4 * faces, sizeof *c->plane, &out->memory[BRC_CONVEX_PLANE], &c->plane));
    BRC_TRY(begin(context, faces + 1, sizeof *c->loop_start, &out->memory[BRC_CONVEX_LOOP_START], &c->loop_start));
    return begin(context, n, sizeof *c->radius, &out->memory[BRC_CONVEX_RADIUS], &c->radius);
}

/* The corners of faces of `more` follow those of the cells, which have cells->loops. */
static void append(const sizes *cells, const sizes *more, const brc_convex *from, brc_convex *to)
{
    memcpy(to->corner + 3 * cells->corners, from->corner, 3 * (size_t)more->corners * sizeof *to->corner);
    memcpy(to->plane + 4 * cells->faces, from->plane, 4 * (size_t)more->faces * sizeof *to->plane);
    memcpy(to->radius + cells->n, from->radius, (size_t)more->n * sizeof *to->radius);
    memcpy(to->loop + cells->loops, from->loop, (size_t)more->loops * sizeof *to->loop);
    for (int64_t p = 1; p <= more->n; ++p) {
        to->corner_start[cells->n + p] = (int32_t)(cells->corners + from->corner_start[p]);
        to->face_start[cells->n + p] = (int32_t)(cells->faces + from->face_start[p]);
    }
    for (int64_t f = 1; f <= more->faces; ++f)
        to->loop_start[cells->faces + f] = (int32_t)(cells->loops + from->loop_start[f]);
}

/* Cells [first, end) are this rank's. *n_loops: of all cells. */
static brc_status place_loops(brc_context *context, const brc_domain *d, int64_t first, int64_t end, brc_convex *c,
                              int64_t *n_loops)
{
    const int64_t from = brc_convex_face_start(d, first), to = brc_convex_face_start(d, end),
                  n = brc_convex_face_start(d, d->n_elements);
    int64_t sum = 0;
    *n_loops = 0;
    for (int64_t f = 0; f < n; ++f) {
        if (f == from) sum = *n_loops;
        *n_loops += c->loop_start[f + 1];
    }
    BRC_TRY(brc_ranks_agree(context, brc_convex_check_loops(context, *n_loops))); /* all have counted */
    for (int64_t f = from; f < to; ++f)
        c->loop_start[f + 1] = (int32_t)(sum += c->loop_start[f + 1]);
    return BRC_OK;
}

brc_status brc_convex_share(brc_context *context, const brc_domain *domain, const brc_convex *more, int n_threads,
                            brc_convex_common *out)
{
    const bool spheres = domain->element_kind != BRC_ELEMENT_CELL;
    const int64_t n = domain->n_elements;
    const sizes behind = sizes_of(more);
    sizes cells = {n, spheres ? 0 : domain->vertex_start[n], spheres ? 0 : brc_convex_face_start(domain, n), 0};
    BRC_ENDS_WITH(brc_convex_common_free) brc_convex_common made = {.all = {.n = 0}};
    *out = made;
    BRC_TRY(begin_all(context, &cells, &behind, &made));
    const brc_common_memory *const memory = made.memory;
    const int64_t first = n * memory->part / memory->parts, end = n * (memory->part + 1) / memory->parts;
    brc_status status = spheres ? BRC_OK : brc_convex_measure_cells(context, domain, first, end, n_threads, &made.all);
    BRC_TRY(brc_ranks_agree(context, status));
    if (!spheres) BRC_TRY(place_loops(context, domain, first, end, &made.all, &cells.loops));
    BRC_TRY(begin(context, cells.loops + behind.loops, sizeof *made.all.loop, &made.memory[BRC_CONVEX_LOOP],
                  &made.all.loop));
    if (!spheres) status = brc_convex_outline_cells(context, domain, first, end, n_threads, &made.all);
    if (behind.n && memory->part == memory->parts - 1) append(&cells, &behind, more, &made.all);
    BRC_TRY(brc_ranks_agree(context, status));
    *out = made;
    made = (brc_convex_common){.all = {.n = 0}};
    return BRC_OK;
}

void brc_convex_common_free(brc_convex_common *convex)
{
    for (int k = 0; k < BRC_CONVEX_ARRAYS; ++k)
        brc_common_memory_free(&convex->memory[k]);
    convex->all = (brc_convex){.n = 0};
}
