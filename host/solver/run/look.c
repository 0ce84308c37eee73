/* Looks: who wants one, and what is put back after it. */
#include "look.h"
#include "run_internal.h"

enum { MOST_KEPT = 12 };

/* What the half kick of a batch's end touches: also where it only turns by nothing, which rounds. */
struct brc_look {
    int n;
    brc_buffer *of[MOST_KEPT], *copy[MOST_KEPT];
};

static brc_status list_one(brc_state_store *store, brc_buffer *buffer)
{
    struct brc_look *look = store->self;
    if (buffer) look->of[look->n++] = buffer;
    return BRC_OK;
}

static brc_status create(brc_simulation *s)
{
    if (s->run->look) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &s->run->look, 1, "looks"));
    brc_state_store list = {.self = s->run->look, .field = list_one};
    brc_buffer *const own[] = {brc_velocity_of(s), brc_spin_of(s), brc_orientation_of(s)};
    for (size_t k = 0; k < sizeof own / sizeof *own; ++k)
        BRC_TRY(list_one(&list, own[k]));
    BRC_TRY(brc_hook_run(s, BRC_HOOK_KICKED, &(brc_occasion){.store = &list}));
    for (int k = 0; k < s->run->look->n; ++k)
        BRC_TRY(brc_buffer_create(s->device, &s->run->look->copy[k], brc_buffer_bytes(s->run->look->of[k]),
                                  "copies for looks"));
    return BRC_OK;
}

void brc_look_free(brc_simulation *s)
{
    for (int k = 0; s->run && s->run->look && k < s->run->look->n; ++k)
        brc_buffer_free(&s->run->look->copy[k]);
    if (!s->run) return;
    brc_memory_free(s->run->look);
    s->run->look = NULL;
}

static brc_status keep(brc_simulation *s)
{
    BRC_TRY(create(s));
    for (int k = 0; k < s->run->look->n; ++k)
        BRC_TRY(brc_buffer_copy(s->run->look->copy[k], s->run->look->of[k], brc_buffer_bytes(s->run->look->of[k])));
    return brc_dynamics_close(s);
}

static brc_status put_back(brc_simulation *s)
{
    for (int k = 0; k < s->run->look->n; ++k)
        BRC_TRY(brc_buffer_copy(s->run->look->of[k], s->run->look->copy[k], brc_buffer_bytes(s->run->look->of[k])));
    s->run->open = true;
    return BRC_OK;
}

int64_t brc_look_next(const brc_simulation *s)
{
    int64_t next = INT64_MAX;
    for (int k = 0; k < s->run->n_observers; ++k) {
        const brc_observer *o = &s->run->observers[k];
        const int64_t wanted = o->next_look ? o->next_look(o->self, s, s->run->step) : INT64_MAX;
        if (wanted < next) next = wanted;
    }
    return next;
}

static brc_simulation *part_of(brc_simulation *s, int32_t k)
{
    return k == 0 ? s : s->run->others[k - 1];
}

/* What an observer reads may be the ledger, whose peaks are those of the run's own samples. */
static void carry_peaks(brc_simulation *s, double *peaks, bool back)
{
    for (int32_t k = 0; k <= s->run->n_others; ++k) {
        brc_simulation *p = part_of(s, k);
        double *const own[2] = {&p->run->peak_elastic, &p->run->peak_kinetic};
        for (int i = 0; i < 2; ++i)
            *(back ? own[i] : &peaks[2 * k + i]) = *(back ? &peaks[2 * k + i] : own[i]);
    }
}

static bool is_wanted(const brc_simulation *s, const brc_observer *o, int64_t previous)
{
    return o->next_look && o->next_look(o->self, s, previous) <= s->run->step;
}

static brc_status tell(brc_simulation *s, int64_t previous)
{
    const brc_step_phase before = brc_phase_enter(s, BRC_PHASE_OUTPUT);
    double *peaks = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &peaks, 2 * (s->run->n_others + 1), "peaks of energy"));
    carry_peaks(s, peaks, false);
    for (int k = 0; k < s->run->n_observers && status == BRC_OK; ++k)
        if (is_wanted(s, &s->run->observers[k], previous))
            status = s->run->observers[k].look(s->run->observers[k].self, s);
    carry_peaks(s, peaks, true);
    brc_memory_free(peaks);
    brc_phase_enter(s, before);
    return status;
}

brc_status brc_look_here(brc_simulation *s, int64_t previous)
{
    return tell(s, previous);
}

brc_status brc_look_within(int32_t n, brc_simulation *const *part, int64_t previous)
{
    brc_simulation *s = part[0];
    const bool open = s->run->open;
    for (int32_t k = 0; open && k < n; ++k)
        BRC_TRY(keep(part[k]));
    for (int32_t k = 0; k < n; ++k)
        BRC_TRY(brc_device_wait(part[k]->device));
    BRC_TRY(tell(s, previous));
    for (int32_t k = 0; open && !s->run->note[s->run->stage].ended && k < n; ++k)
        BRC_TRY(put_back(part[k]));
    return BRC_OK;
}
