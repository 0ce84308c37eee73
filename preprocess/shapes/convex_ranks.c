/* Corners of faces are counted first, by each rank for its cells; all see the counts of all, so each knows where its
 * loops begin. */
#include "convex_ranks.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"
#include "../cells/cells_ranks.h"
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

/* Cells [first, end). */
typedef struct range {
    int64_t first, end;
} range;

/* Loops of cells `own` are placed by this rank. *n_loops: of all cells. */
static brc_status place_loops(brc_context *context, const brc_domain *d, range own, brc_convex *c, int64_t *n_loops)
{
    const int64_t from = brc_convex_face_start(d, own.first), to = brc_convex_face_start(d, own.end),
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

/* ---- cells that ranks have between them (domain.h, here) ---- */

/* Among the first ranks of machines: what cells have in an array, in which those of cell e begin at start(e), comes
 * from those that have made it. */
static brc_status bring(brc_context *context, const brc_domain *d, int64_t (*start)(const brc_domain *, int64_t),
                        int64_t bytes, void *all)
{
    const int32_t count = brc_ranks_count();
    const int64_t mine = start(d, brc_elements_of_rank(d->n_elements, brc_ranks_mine(), count).first);
    BRC_LOCAL(context, count, int64_t, n_of, "polyhedra of ranks");
    for (int32_t k = 0; k < count; ++k) {
        const brc_run_range home = brc_elements_of_rank(d->n_elements, k, count);
        n_of[k] = start(d, home.end) - start(d, home.first);
    }
    return brc_ranks_gather_all(context, (char *)all + mine * bytes, bytes, n_of, all);
}

static int64_t start_of_corners(const brc_domain *d, int64_t e)
{
    return d->vertex_start[e];
}

static int64_t start_of_one(const brc_domain *d, int64_t e)
{
    (void)d;
    return e;
}

static brc_status bring_all_but_loops(brc_context *context, const brc_domain *d, brc_convex *c)
{
    for (int64_t e = 0; e <= d->n_elements; ++e) {
        c->corner_start[e] = (int32_t)d->vertex_start[e];
        c->face_start[e] = (int32_t)brc_convex_face_start(d, e);
    }
    BRC_TRY(bring(context, d, start_of_corners, 3 * sizeof *c->corner, c->corner));
    BRC_TRY(bring(context, d, brc_convex_face_start, 4 * sizeof *c->plane, c->plane));
    BRC_TRY(bring(context, d, brc_convex_face_start, sizeof *c->loop_start, c->loop_start + 1));
    return bring(context, d, start_of_one, sizeof *c->radius, c->radius);
}

static brc_status bring_loops(brc_context *context, const brc_domain *d, brc_convex *c)
{
    const int32_t count = brc_ranks_count();
    int64_t first = 0;
    BRC_LOCAL(context, count, int64_t, n_of, "polyhedra of ranks");
    for (int32_t k = 0; k < count; ++k) {
        const brc_run_range home = brc_elements_of_rank(d->n_elements, k, count);
        const int64_t from = c->loop_start[brc_convex_face_start(d, home.first)];
        n_of[k] = c->loop_start[brc_convex_face_start(d, home.end)] - from;
        if (k == brc_ranks_mine()) first = from;
    }
    return brc_ranks_gather_all(context, c->loop + first, sizeof *c->loop, n_of, c->loop);
}

/* By the first rank of each machine; the others wait in the next call of all. */
static brc_status among_firsts(brc_context *context, const brc_domain *d, brc_convex *c,
                               brc_status (*what)(brc_context *, const brc_domain *, brc_convex *))
{
    if (!d->here || brc_ranks_here().local > 0) return BRC_OK;
    brc_ranks_narrow();
    const brc_status status = what(context, d, c);
    brc_ranks_widen();
    return status;
}

/* Which cells this rank makes. */
static range cells_of(const brc_domain *d, const brc_common_memory *memory)
{
    const int64_t n = d->n_elements;
    if (d->here) return (range){d->home[brc_ranks_mine()], d->home[brc_ranks_mine() + 1]};
    return (range){n * memory->part / memory->parts, n * (memory->part + 1) / memory->parts};
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
    const range own = cells_of(domain, memory), all = {0, n}, none = {n, n};
    brc_status status =
        spheres ? BRC_OK : brc_convex_measure_cells(context, domain, own.first, own.end, n_threads, &made.all);
    BRC_TRY(brc_ranks_agree(context, status));
    BRC_TRY(brc_ranks_agree(context, among_firsts(context, domain, &made.all, bring_all_but_loops)));
    if (!spheres)
        BRC_TRY(place_loops(context, domain,
                            !domain->here                 ? own
                            : brc_ranks_here().local == 0 ? all
                                                          : none,
                            &made.all, &cells.loops));
    if (domain->here) BRC_TRY(brc_ranks_agree(context, BRC_OK)); /* all are placed */
    BRC_TRY(begin(context, cells.loops + behind.loops, sizeof *made.all.loop, &made.memory[BRC_CONVEX_LOOP],
                  &made.all.loop));
    if (!spheres) status = brc_convex_outline_cells(context, domain, own.first, own.end, n_threads, &made.all);
    if (domain->here) BRC_TRY(brc_ranks_agree(context, status));
    if (status == BRC_OK) status = among_firsts(context, domain, &made.all, bring_loops);
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
