#include "core_internal.h"
#include "../../device/shares.h"
#include <string.h>

enum { BLOCK = 1024 }; /* SCAN_BLOCK of portable.h */

static int32_t blocks_of(const brc_simulation *s)
{
    return (s->layout->n_rows + BLOCK - 1) / BLOCK;
}

BRC_WANTED(of_cells, w->scene->has_fracture &&brc_wants_cells(w))
BRC_WANTED(softening_cells, of_cells(w) && w->softens)
enum { LISTS = BRC_RING_KINDS + 1 }; /* and who is touched by marks of bonds that hold */
BRC_COUNTED(each_count, LISTS *(int64_t)((w->layout->n_rows + BLOCK - 1) / BLOCK + 1))

#define AT(member) BRC_FIELD_AT(brc_rings, member)
static const brc_field_row rows[] = {
    BRC_FIELD(touched, brc_each_row, 1, INT, NULL, "rings around broken bonds", "-"),
    BRC_FIELD(level, brc_each_row, 1, INT, NULL, "rings around broken bonds", "-"),
    BRC_FIELD(count, each_count, 1, INT, NULL, "rings around broken bonds", "-"),
    {"fresh", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(force), "forces around broken bonds", "N", BRC_NOT_KEPT},
    {"fresh_torque", brc_each_row, 3, BRC_FIELD_STATE, brc_wants_turning, AT(torque), "torques around broken bonds",
     "N m", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_ring_fields, "rings", BRC_LIFE_RUN, of_cells, rows);
#define LIST(k) BRC_FIELD_AT(brc_ring_list, upto) + (k) * sizeof(brc_buffer *)
static const brc_field_row list_rows[BRC_RING_KINDS] = {
    {"upto_0", brc_each_row, 1, BRC_FIELD_INT, NULL, LIST(0), "rings of elements", "-", BRC_NOT_KEPT},
    {"upto_1", brc_each_row, 1, BRC_FIELD_INT, NULL, LIST(1), "rings of elements", "-", BRC_NOT_KEPT},
    {"upto_2", brc_each_row, 1, BRC_FIELD_INT, NULL, LIST(2), "rings of elements", "-", BRC_NOT_KEPT},
    {"upto_3", brc_each_row, 1, BRC_FIELD_INT, NULL, LIST(3), "rings of elements", "-", BRC_NOT_KEPT},
};
BRC_FIELD_TABLE(brc_ring_list_fields, "rings around breaks", BRC_LIFE_RUN, of_cells, list_rows);
BRC_FIELD_TABLE(brc_open_list_fields, "rings around open faces", BRC_LIFE_RUN, softening_cells, list_rows);
BRC_FIELD_TABLE(brc_bonded_list_fields, "cells with bonds", BRC_LIFE_GROWS, of_cells, list_rows);

const brc_ring_list *brc_rings_around(const brc_rings *r)
{
    return &r->around;
}
const brc_ring_list *brc_request_list(const brc_force_request *request)
{
    return request->rings && !request->rings->whole_force ? &request->rings->around : NULL;
}
bool brc_rings_are_whole(const brc_rings *r)
{
    return r->whole_force;
}
void brc_rings_make_whole(brc_rings *r)
{
    r->whole_force = true;
}
bool brc_rings_are_placed(const brc_rings *r)
{
    return r->placed;
}
brc_buffer *brc_rings_touched(const brc_rings *r)
{
    return r->touched;
}
brc_buffer *brc_rings_level(const brc_rings *r)
{
    return r->level;
}

brc_scope brc_scope_of_rings(const brc_rings *rings, const brc_scope *outer)
{
    static const brc_value_row values[] = {{"half_kick", BRC_VALUE_REAL, AT(half_kick)}};
    return (brc_scope){
        .owner = "rings", .base = rings, .tables = {&brc_ring_fields}, BRC_VALUES(values), .outer = outer};
}

static brc_status make_passes(brc_simulation *s, brc_rings *r)
{
    const brc_scope run = brc_scope_of_run(s), rings = brc_scope_of_rings(r, &run);
    const brc_pass_wanted of_rings[] = {
        BRC_PASS(&r->spread, "ring_spread", "from to by_level"),
        BRC_PASS(&r->seed, "ring_seed", "above number"),
        BRC_PASS(&r->count_pass, "ring_count", "n which"),
        BRC_PASS(&r->tops, "ring_tops", "n_blocks"),
        BRC_PASS(&r->list_pass, "ring_list", "n which next upto_0 upto_1 upto_2 upto_3"),
        BRC_PASS(&r->take_back, "ring_take_back", NULL),
        BRC_PASS(&r->forget, "ring_forget", "list"),
        BRC_PASS(&r->replace, "ring_replace", "list")};
    BRC_TRY(BRC_PASSES_MAKE(s, &rings, of_rings));
    /* forces around breaks less those before */
    static const brc_value_row differences[] = {{"delta", BRC_VALUE_BUFFER, AT(force)},
                                                {"was", BRC_VALUE_BUFFER, AT(force)}};
    const brc_scope deltas = {.owner = "differences of forces", .base = r, BRC_VALUES(differences), .outer = &run};
    BRC_TRY(BRC_PASSES(s, &deltas, BRC_PASS(&r->delta, "ring_delta", NULL),
                       BRC_PASS(&r->book, "ring_book", "listed per list lost")));
    static const brc_value_row turning[] = {{"mass", BRC_VALUE_BUFFER, BRC_FIELD_AT(struct brc_core, inertia)},
                                            {"force", BRC_VALUE_BUFFER, BRC_FIELD_AT(struct brc_core, torque)},
                                            {"velocity", BRC_VALUE_BUFFER, BRC_FIELD_AT(struct brc_core, spin)}};
    static const brc_value_row torques[] = {{"fresh", BRC_VALUE_BUFFER, AT(torque)}};
    const brc_scope spins = {.owner = "turning", .base = s->core, BRC_VALUES(turning), .outer = &rings},
                    turns = {.owner = "torques", .base = r, BRC_VALUES(torques), .outer = &spins};
    return BRC_PASSES(s, &turns, {&r->replace_turns, "ring_replace", "list", !s->model->turns});
}

brc_status brc_rings_create(brc_simulation *s, brc_rings **out)
{
    BRC_TRY(BRC_ALLOCATE(s->context, out, 1, "rings around broken bonds"));
    brc_rings *r = *out;
    BRC_TRY(make_passes(s, r));
    BRC_TRY(brc_fields_create(s->device, &brc_ring_fields, &s->wants, r));
    return brc_fields_create(s->device, &brc_ring_list_fields, &s->wants, &r->around);
}

void brc_rings_free(brc_rings **rings)
{
    brc_rings *r = *rings;
    if (!r) return;
    brc_fields_free(&brc_ring_fields, r);
    brc_fields_free(&brc_ring_list_fields, &r->around);
    brc_rows_among_free(&r->around.among);
    brc_memory_free(r);
    *rings = NULL;
}

/* ---- lists ---- */

static brc_status spread(brc_simulation *s, brc_rings *r, bool by_level, int from, int to)
{
    return BRC_RUN(r->spread, s->n_groups, {"from", BRC_INT(from)}, {"to", BRC_INT(to)},
                   {"by_level", BRC_INT(by_level ? 1 : 0)});
}

/* Several ranks bring what passes over the list read. */
static brc_status share_list(brc_simulation *s, brc_rings *r, brc_ring_list *list)
{
    const int32_t n = list->n[BRC_RING_KINDS - 1];
    if (list != &r->around || !brc_device_is_shared(s->device)) return BRC_OK;
    BRC_LOCAL(s->context, n, int32_t, own, "rings around broken bonds");
    BRC_TRY(brc_buffer_read(list->upto[BRC_RING_KINDS - 1], 0, own, n * (int64_t)sizeof *own));
    return brc_rows_among_make(s->device, n, own, &list->among);
}

enum { FOUND, ALL, TOUCHED, KEPT, PLACED }; /* as in rings.cl */

static brc_status count_list(brc_simulation *s, brc_rings *r, int which, brc_ring_list *out, bool *marked)
{
    const int32_t n = s->layout->n_rows, n_blocks = blocks_of(s);
    int32_t held[LISTS];
    BRC_TRY(BRC_RUN(r->count_pass, n_blocks, {"n", BRC_INT(n)}, {"which", BRC_INT(which)}));
    BRC_TRY(BRC_RUN(r->tops, LISTS, {"n_blocks", BRC_INT(n_blocks)}));
    BRC_TRY(brc_buffer_read(r->count, (int64_t)sizeof *held * LISTS * n_blocks, held, sizeof held));
    memcpy(out->n, held, sizeof out->n);
    *marked = held[BRC_RING_KINDS] > 0;
    return BRC_OK;
}

/* As it was counted. */
static brc_status fill_list(brc_simulation *s, brc_rings *r, int which, brc_ring_list *out)
{
    const int32_t n = s->layout->n_rows, n_blocks = blocks_of(s);
    BRC_TRY(BRC_RUN(r->list_pass, n_blocks, {"n", BRC_INT(n)}, {"which", BRC_INT(which)}, {"next", BRC_BUF(r->count)},
                    {"upto_0", BRC_BUF(out->upto[0])}, {"upto_1", BRC_BUF(out->upto[1])},
                    {"upto_2", BRC_BUF(out->upto[2])}, {"upto_3", BRC_BUF(out->upto[3])}));
    return share_list(s, r, out);
}

static brc_status make_list(brc_simulation *s, brc_rings *r, int which, brc_ring_list *out)
{
    bool marked;
    BRC_TRY(count_list(s, r, which, out, &marked));
    return fill_list(s, r, which, out);
}

brc_status brc_rings_find(brc_simulation *s, brc_rings *r, bool *marked)
{
    BRC_TRY(spread(s, r, false, 1, 1));
    return count_list(s, r, FOUND, &r->around, marked);
}

brc_status brc_rings_list_found(brc_simulation *s, brc_rings *r)
{
    return fill_list(s, r, FOUND, &r->around);
}

brc_status brc_rings_spread(brc_simulation *s, brc_rings *r, int first, int last)
{
    for (int ring = first; ring <= last; ++ring)
        BRC_TRY(spread(s, r, ring > 1, ring, ring + 1));
    return BRC_OK;
}

static int closing(brc_rings *r, brc_rings_closing how)
{
    r->placed = how == BRC_RINGS_PLACE;
    return r->placed ? PLACED : how == BRC_RINGS_KEEP ? KEPT : ALL;
}

brc_status brc_rings_close(brc_simulation *s, brc_rings *r, brc_rings_closing how, brc_ring_list *out)
{
    return make_list(s, r, closing(r, how), out ? out : &r->around);
}

brc_status brc_rings_count(brc_simulation *s, brc_rings *r, bool *marked)
{
    BRC_TRY(count_list(s, r, ALL, &r->around, marked));
    return *marked ? brc_pass_run(r->take_back, s->layout->n_rows) : BRC_OK;
}

brc_status brc_rings_list(brc_simulation *s, brc_rings *r, brc_rings_closing how)
{
    return fill_list(s, r, closing(r, how), &r->around);
}

brc_status brc_rings_forget(brc_rings *r)
{
    if (!r->placed) return BRC_OK;
    r->placed = false;
    return BRC_RUN(r->forget, r->around.n[3], {"list", BRC_BUF(r->around.upto[3])});
}

brc_status brc_rings_list_touched(brc_simulation *s, brc_rings *r)
{
    return make_list(s, r, TOUCHED, &r->around);
}

brc_status brc_rings_seed(brc_simulation *s, brc_rings *r, brc_buffer *number)
{
    return BRC_RUN(r->seed, s->layout->n_rows, {"above", BRC_INT(1)}, {"number", BRC_BUF(number)});
}

brc_status brc_rings_without(brc_simulation *s, brc_rings *r, brc_buffer *number, brc_ring_list *out)
{
    BRC_TRY(BRC_RUN(r->seed, s->layout->n_rows, {"above", BRC_INT(0)}, {"number", BRC_BUF(number)}));
    return brc_rings_close(s, r, BRC_RINGS_DROP, out);
}

/* ---- what is done with them ---- */

bool brc_pass_is_whole(const brc_simulation *s, const brc_ring_list *list, int ring)
{
    return !list || 2 * (int64_t)list->n[ring] > s->domain->n_elements;
}

enum { MOST_GIVEN = 6 };
brc_status brc_pass_over(brc_simulation *s, const brc_pass *whole, const brc_pass *listed, const brc_ring_list *list,
                         int ring, const brc_force_request *request, const brc_given *given)
{
    if (whole && brc_pass_is_whole(s, list, ring)) return brc_pass_run_awake(s, whole, s->n_groups, request, given);
    const int32_t n = list->n[ring], lanes = brc_device_lanes(s->device);
    brc_given all[MOST_GIVEN + 3] = {{"n", BRC_INT(n)}, {"list", BRC_BUF(list->upto[ring])}};
    for (int k = 0; given && given[k].name && k < MOST_GIVEN; ++k)
        all[2 + k] = given[k];
    brc_rows_among *const outer = brc_device_keep_among(s->device, list->among);
    const brc_status status = brc_pass_run_on(listed, (n + lanes - 1) / lanes, request, NULL, all);
    brc_device_keep_among(s->device, outer);
    return status;
}

/* Of laws that have an energy, and steps of velocity Verlet. */
static bool books_jumps(const brc_simulation *s, const brc_rings *r)
{
    return s->model->conserves && s->core->lost_numerical && r->half_kick > 0;
}

/* r->force holds the change: prescribed elements swing about nothing. */
static brc_status book_jumps(brc_simulation *s, const brc_rings *r, int32_t n, int k, int listed)
{
    BRC_TRY(brc_constrain(s, r->force, NULL));
    return BRC_RUN(r->book, n, {"listed", BRC_INT(listed)}, {"per", BRC_STATE(0.25 * r->half_kick * r->half_kick)},
                   {"list", BRC_BUF(r->around.upto[k])}, {"lost", BRC_BUF(s->core->lost_numerical)});
}

brc_status brc_rings_replace(brc_simulation *s, const brc_rings *r, int inner, int k)
{
    const int32_t n = r->around.n[inner];
    BRC_TRY(BRC_RUN(r->replace, n, {"list", BRC_BUF(r->around.upto[inner])}));
    if (books_jumps(s, r)) BRC_TRY(book_jumps(s, r, r->around.n[k], k, 1));
    if (!r->torque) return BRC_OK;
    return BRC_RUN(r->replace_turns, n, {"list", BRC_BUF(r->around.upto[inner])});
}

brc_status brc_rings_begin(brc_simulation *s, brc_rings *r, double half_kick)
{
    r->half_kick = half_kick;
    if (!r->whole_force) return BRC_OK;
    BRC_TRY(brc_elements_kick(s, half_kick));
    return books_jumps(s, r) ? brc_buffer_copy(r->force, s->core->force, brc_buffer_bytes(s->core->force)) : BRC_OK;
}

brc_status brc_rings_end(brc_simulation *s, const brc_rings *r)
{
    const int32_t n = s->layout->n_rows;
    if (!r->whole_force) return BRC_OK;
    if (books_jumps(s, r)) {
        BRC_TRY(brc_pass_run(r->delta, n));
        BRC_TRY(book_jumps(s, r, n, 0, 0));
    }
    return brc_elements_kick(s, -r->half_kick);
}

brc_status brc_rings_sum(brc_simulation *s, const brc_ring_list *list, int k, brc_buffer *x, double *out)
{
    const int32_t n = list->n[k];
    *out = 0;
    if (n == 0) return BRC_OK;
    brc_rows_among *const outer = brc_device_keep_among(s->device, list->among);
    const brc_status status = brc_vector_sum_listed_later(s, list->upto[k], n, x, out);
    brc_device_keep_among(s->device, outer);
    return status;
}
