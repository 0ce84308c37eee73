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
    int64_t calm;       /* steps since the last break */
    int64_t first;      /* step before the stretch */
    double broken;      /* half-edges of beams that were broken as it began, counted ... */
    int64_t counted_at; /* ... after these steps of the run */
    int32_t counted_in; /* ... in this stage */
    bool broke;         /* some beam is broken */
    bool on, open;      /* a stretch is being taken; the simulation's `open` at its start */
};

/* ---- what is kept: the store of checkpoints (state_store.h), in memory ---- */

static bool is_of_beams(const brc_simulation *s)
{
    return s->fracture && !s->fracture->cells;
}

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
    struct brc_ahead *a = s->ahead;
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

/* Where surfaces are followed, broken beams change what they meet. */
static bool touches(const brc_simulation *s)
{
    return brc_effects_follow_surfaces(s);
}

/* Softening asks in every step. Without contact beams ask nobody, but broken ones that bear cost
 * passes of their own, which a stretch before the first break leaves out. */
static bool may(const brc_simulation *s)
{
    const bool lost = is_of_beams(s) && brc_wants_lost_beams(&s->wants) && !(s->ahead && s->ahead->broke);
    const bool worth = touches(s) || (s->fracture && !is_of_beams(s)) || lost;
    return worth && !(s->model->cohesion && s->model->cohesion->is_on(s)) &&
           brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC && works_beside(s);
}

/* Steps, of at most n, that may now be taken ahead; 0: each is to be known. */
static int64_t ahead_steps(const brc_simulation *s, int64_t n)
{
    const struct brc_ahead *a = s->ahead;
    const bool asks = s->fracture && (s->fracture->cells || touches(s));
    const int64_t calm = !asks ? BRC_AHEAD_MOST : a ? a->calm : 0, quiet = brc_effects_quiet_steps(s);
    int64_t most = calm < BRC_AHEAD_MOST ? calm : BRC_AHEAD_MOST;
    if (quiet < most) most = quiet;
    if (most < BRC_AHEAD_FEWEST || n < 2 || !may(s)) return 0;
    if (n < most) most = n;
    return !s->fracture && brc_effects_next_probe(s) >= most ? 0 : most; /* without a probe nobody asks */
}

BRC_READ(bool, brc_ahead_is_on, s->ahead && s->ahead->on)
BRC_READ(bool, brc_ahead_is_whole, brc_ahead_is_on(s) && is_of_beams(s) && !s->ahead->broke)

static brc_status ahead_made(brc_simulation *s, struct brc_ahead **out)
{
    if (!s->ahead) {
        BRC_TRY(BRC_ALLOCATE(s->context, &s->ahead, 1, "steps ahead"));
        s->ahead->simulation = s;
        s->ahead->counted_at = -1;
    }
    *out = s->ahead;
    return BRC_OK;
}

/* A stretch begins: what its steps change is copied on the device. */
static brc_status ahead_begin(brc_simulation *s)
{
    struct brc_ahead *a;
    BRC_TRY(ahead_made(s, &a));
    if (is_of_beams(s)) {
        if (a->counted_at != brc_simulation_total_steps(s) || a->counted_in != brc_simulation_stage(s))
            BRC_TRY(brc_vector_sum(s, s->fracture->broken, s->layout->n_rows, &a->broken));
        a->broke = a->broken > 0;
    } else if (s->fracture) {
        if (!a->found) BRC_TRY(brc_new_state(s, &a->found, s->layout->n_rows, "marks of steps ahead"));
        BRC_TRY(brc_buffer_fill_zero(a->found));
    }
    BRC_TRY(walk(s, false));
    brc_effects_begin_probes(s);
    a->first = brc_simulation_step(s);
    a->open = brc_half_kick_is_missing(s);
    a->on = true;
    return BRC_OK;
}

/* Bonds that broke, or were to break, in the stretch. */
static brc_status count_stretch(brc_simulation *s, double *n)
{
    const struct brc_ahead *a = s->ahead;
    *n = 0;
    if (!s->fracture) return BRC_OK;
    if (!is_of_beams(s)) return brc_vector_sum(s, a->found, s->layout->n_rows, n);
    BRC_TRY(brc_vector_sum(s, s->fracture->broken, s->layout->n_rows, n));
    *n -= a->broken;
    return BRC_OK;
}

/* It has ended. *stands: nothing was to break; else the simulation is where it was at the beginning. */
static brc_status ahead_end(brc_simulation *s, bool *stands)
{
    struct brc_ahead *a = s->ahead;
    const brc_cell_breaks *c = s->fracture ? s->fracture->cells : NULL;
    const int64_t last = brc_simulation_step(s);
    double n;
    bool seen = true;
    a->on = false;
    BRC_TRY(count_stretch(s, &n));
    BRC_TRY(brc_effects_end_probes(s, &seen));
    *stands = !(n > 0) && seen;
    if (*stands) {
        if (!c) a->calm += last - a->first;
        a->counted_at = brc_simulation_total_steps(s);
        a->counted_in = brc_simulation_stage(s);
        return BRC_OK;
    }
    BRC_TRY(walk(s, true));
    brc_half_kick_missing(s, a->open);
    a->counted_at = -1;
    if (n > 0) {
        a->calm = 0;
        a->broke = true;
    }
    if (c) BRC_TRY(brc_buffer_fill_zero(c->mark));
    if (c) BRC_TRY(brc_buffer_fill_zero(brc_rings_touched(c->rings)));
    brc_log(s->context, BRC_LOG_DEBUG, "steps %lld to %lld are taken again: %s in them",
            (long long)brc_simulation_step(s) + 1, (long long)last, n > 0 ? "bonds break" : "surfaces come near");
    return BRC_OK;
}

const brc_effect_ahead brc_steps_ahead = {ahead_steps, ahead_begin, ahead_end};

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

BRC_READ(bool, brc_ahead_expects, s->ahead && !s->ahead->on && s->ahead->calm == 0 && works_beside(s))

void brc_ahead_known(brc_simulation *s, bool some)
{
    s->ahead->calm = some ? 0 : s->ahead->calm + 1;
}

void brc_ahead_free(brc_simulation *s)
{
    struct brc_ahead *a = s->ahead;
    if (!a) return;
    for (int k = 0; k < a->n_copies; ++k)
        brc_buffer_free(&a->copy[k]);
    brc_buffer_free(&a->found);
    brc_memory_free(a->numbers);
    brc_memory_free(a);
    s->ahead = NULL;
}
