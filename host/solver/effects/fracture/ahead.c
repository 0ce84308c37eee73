/* Steps ahead of what is known. */
#include "ahead.h"
#include "cell_breaks_internal.h"
#include "fracture_internal.h"
#include <string.h>

enum { MOST_KEPT = 64 };

struct brc_ahead {
    brc_state_store store;
    brc_simulation *simulation; /* borrowed */
    brc_buffer *found;          /* [n_rows] marks of the stretch so far */
    int n, n_copies;            /* arrays of the stretch; copies, some of which may wait for larger arrays */
    brc_buffer *copy[MOST_KEPT];
    char *numbers; /* of the host, one after another, each list behind its number of rows */
    int64_t used, at;
    int64_t calm;  /* steps since the last break */
    int64_t first; /* step before the stretch */
    double broken; /* half-edges of beams that were broken as it began */
    bool broke;    /* some beam is broken */
    bool on, open; /* a stretch is being taken; the simulation's `open` at its start */
};

/* ---- what is kept: the store of checkpoints (state_store.h), in memory ---- */

static struct brc_ahead *ahead_of(brc_state_store *store)
{
    return store->self;
}

static brc_status keep_numbers(brc_state_store *store, const char *name, brc_stored_type type, int64_t rows,
                               int32_t columns, void *data)
{
    struct brc_ahead *a = ahead_of(store);
    const int64_t bytes = rows * columns * brc_stored_type_bytes(type), whole = bytes + (int64_t)sizeof rows;
    if (store->loading) {
        if (bytes > 0) memcpy(data, a->numbers + a->at + sizeof rows, (size_t)bytes);
        a->at += whole;
        return BRC_OK;
    }
    BRC_TRY(brc_memory_resize(a->simulation->context, (void **)&a->numbers, a->used + whole, 1, name));
    memcpy(a->numbers + a->used, &rows, sizeof rows);
    if (bytes > 0) memcpy(a->numbers + a->used + sizeof rows, data, (size_t)bytes);
    a->used += whole;
    return BRC_OK;
}

static brc_status count_rows(brc_state_store *store, const char *name, int64_t *rows)
{
    (void)name;
    memcpy(rows, ahead_of(store)->numbers + ahead_of(store)->at, sizeof *rows);
    return BRC_OK;
}

/* The k-th array of a walk goes to the k-th copy: arrays of lists are made anew as they grow. */
static brc_status keep_field(brc_state_store *store, brc_buffer *buffer)
{
    struct brc_ahead *a = ahead_of(store);
    const int64_t bytes = brc_buffer_bytes(buffer);
    const int k = a->n++;
    if (k == MOST_KEPT)
        return BRC_FAIL(a->simulation->context, BRC_INTERNAL, "more than %d arrays are kept for steps ahead",
                        (int)MOST_KEPT);
    if (store->loading) return brc_buffer_copy(buffer, a->copy[k], bytes);
    if (k == a->n_copies) a->copy[a->n_copies++] = NULL;
    if (!a->copy[k] || brc_buffer_bytes(a->copy[k]) < bytes) {
        brc_buffer_free(&a->copy[k]);
        BRC_TRY(brc_buffer_create(a->simulation->device, &a->copy[k], bytes, "copies for steps ahead"));
    }
    return brc_buffer_copy(a->copy[k], buffer, bytes);
}

static brc_status walk(brc_simulation *s, bool loading)
{
    struct brc_ahead *a = s->fracture->ahead;
    a->store = (brc_state_store){
        .self = a, .loading = loading, .numbers = keep_numbers, .count = count_rows, .field = keep_field};
    if (!loading) a->used = 0;
    a->at = 0;
    a->n = 0;
    return brc_simulation_walk_motion(s, &a->store);
}

/* ---- stretches ---- */

/* The cpu and OpenMP target do what they are told at once: there is nobody to wait for. */
static bool works_beside(const brc_simulation *s)
{
    return brc_device_get_info(s->device)->kind == BRC_DEVICE_OPENCL;
}

static bool is_of_beams(const brc_simulation *s)
{
    return !s->fracture->cells;
}

/* Where surfaces are followed, broken beams change what they meet. */
static bool touches(const brc_simulation *s)
{
    return brc_effects_follow_surfaces(s);
}

/* Softening asks in every step. Without contact beams ask nobody, but broken ones that bear cost
 * passes of their own, which a stretch before the first break leaves out. */
static bool may(const brc_simulation *s)
{
    const struct brc_ahead *a = s->fracture->ahead;
    const bool worth = !is_of_beams(s) || touches(s) || (brc_wants_lost_beams(&s->wants) && !(a && a->broke));
    return worth && !(s->model->cohesion && s->model->cohesion->is_on(s)) &&
           brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC && works_beside(s);
}

int64_t brc_ahead_steps(const brc_simulation *s, int64_t n)
{
    const struct brc_ahead *a = s->fracture->ahead;
    const bool asks = s->fracture->cells || touches(s);
    const int64_t calm = !asks ? BRC_AHEAD_MOST : a ? a->calm : 0, quiet = brc_effects_quiet_steps(s);
    int64_t most = calm < BRC_AHEAD_MOST ? calm : BRC_AHEAD_MOST;
    if (quiet < most) most = quiet; /* the host looks for pairs */
    if (most < BRC_AHEAD_FEWEST || n < 2 || !may(s)) return 0;
    return n < most ? n : most;
}

bool brc_ahead_is_on(const brc_simulation *s)
{
    return s->fracture && s->fracture->ahead && s->fracture->ahead->on;
}
bool brc_ahead_is_whole(const brc_simulation *s)
{
    return brc_ahead_is_on(s) && is_of_beams(s) && !s->fracture->ahead->broke;
}

static brc_status ahead_made(brc_simulation *s, struct brc_ahead **out)
{
    if (!s->fracture->ahead) {
        BRC_TRY(BRC_ALLOCATE(s->context, &s->fracture->ahead, 1, "steps ahead"));
        s->fracture->ahead->simulation = s;
    }
    *out = s->fracture->ahead;
    return BRC_OK;
}

brc_status brc_ahead_begin(brc_simulation *s)
{
    struct brc_ahead *a;
    BRC_TRY(ahead_made(s, &a));
    if (is_of_beams(s)) {
        BRC_TRY(brc_vector_sum(s, s->fracture->broken, s->layout->n_rows, &a->broken));
        a->broke = a->broken > 0;
    } else {
        if (!a->found) BRC_TRY(brc_new_state(s, &a->found, s->layout->n_rows, "marks of steps ahead"));
        BRC_TRY(brc_buffer_fill_zero(a->found));
    }
    BRC_TRY(walk(s, false));
    a->first = s->step;
    a->open = s->open;
    a->on = true;
    return BRC_OK;
}

/* Bonds that broke, or were to break, in the stretch. */
static brc_status count_stretch(brc_simulation *s, double *n)
{
    const struct brc_ahead *a = s->fracture->ahead;
    if (!is_of_beams(s)) return brc_vector_sum(s, a->found, s->layout->n_rows, n);
    BRC_TRY(brc_vector_sum(s, s->fracture->broken, s->layout->n_rows, n));
    *n -= a->broken;
    return BRC_OK;
}

brc_status brc_ahead_end(brc_simulation *s, bool *stands)
{
    struct brc_ahead *a = s->fracture->ahead;
    const brc_cell_breaks *c = s->fracture->cells;
    const int64_t last = s->step;
    double n;
    a->on = false;
    BRC_TRY(count_stretch(s, &n));
    *stands = !(n > 0);
    if (*stands && !c) a->calm += last - a->first;
    if (*stands) return BRC_OK;
    BRC_TRY(walk(s, true));
    s->open = a->open;
    a->calm = 0;
    a->broke = true;
    if (c) BRC_TRY(brc_buffer_fill_zero(c->mark));
    if (c) BRC_TRY(brc_buffer_fill_zero(c->rings->touched));
    brc_log(s->context, BRC_LOG_DEBUG, "steps %lld to %lld are taken again: bonds break in them",
            (long long)s->step + 1, (long long)last);
    return BRC_OK;
}

brc_status brc_ahead_count(brc_simulation *s, brc_buffer *found, int64_t count, double *n)
{
    struct brc_ahead *a;
    BRC_TRY(ahead_made(s, &a));
    a->calm += 1;
    *n = 0;
    if (a->on) return brc_vector_axpy(s, count, 1, found, a->found);
    BRC_TRY(brc_vector_sum(s, found, count, n));
    if (*n > 0) a->calm = 0;
    return BRC_OK;
}

void brc_ahead_free(brc_simulation *s)
{
    struct brc_ahead *a = s->fracture->ahead;
    if (!a) return;
    for (int k = 0; k < a->n_copies; ++k)
        brc_buffer_free(&a->copy[k]);
    brc_buffer_free(&a->found);
    brc_memory_free(a->numbers);
    brc_memory_free(a);
    s->fracture->ahead = NULL;
}
