/* Elements that nothing has reached yet: left out of steps (docs/notebook/performance.md). An element has moved once
 * its velocity was not 0, and may be set in motion only by forces: those of bonds reach so many rings around elements
 * that moved, those of surfaces the pairs that are listed. What is left out has no force and no velocity, so that the
 * numbers are the same, bit for bit, as where it is gone over. */
#include "rest.h"
#include "contact/contact.h"
#include "effect.h"
#include "loads/loads.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where more than this share of the groups is awake, looking is not worth while any more. */
static const double most_awake = 0.95;

typedef struct rest {
    bool given_up;               /* in this stage: nothing is, or stays, at rest */
    int steps;                   /* of the stage, up to FOLLOWED */
    int rings;                   /* that forces reach; farther rows are at rings + 1 */
    int64_t lists;               /* of pairs, seen so far */
    uint8_t *moved;              /* [n_rows] */
    uint8_t *distance;           /* [n_rows] rings from rows that moved, or are pushed by surfaces; rings + 1: more */
    uint8_t *in;                 /* [n_groups] awake */
    int32_t n, *groups;          /* they, ascending */
    int32_t n_watched, *watched; /* those of them with a row that has not moved yet */
    int32_t *front, *far;        /* [n_rows] scratch: rows of one ring, and of the next */
    bool longer;                 /* `in` has more than groups */
} rest;
enum { FOLLOWED = 2 }; /* the first evaluation of a stage is of all */

extern const brc_effect brc_rest_effect;
static rest *rest_of(const brc_simulation *s)
{
    return *brc_effect_own((brc_simulation *)(uintptr_t)s, &brc_rest_effect);
}

static bool in(const brc_wants *w)
{
    if (!brc_wants_solver(w, BRC_SOLVER_DYNAMIC) || w->noise) return false;
    for (int c = 0; c < 3; ++c)
        if (w->scene->gravity[c] != 0) return false;
    return true;
}

static void forget(rest *r)
{
    brc_memory_free(r->moved);
    brc_memory_free(r->distance);
    brc_memory_free(r->in);
    brc_memory_free(r->groups);
    brc_memory_free(r->watched);
    brc_memory_free(r->front);
    brc_memory_free(r->far);
    *r = (rest){0};
}

static void release(brc_simulation *s)
{
    void **own = brc_effect_own(s, &brc_rest_effect);
    if (*own) forget(*own);
    brc_memory_free(*own);
    *own = NULL;
}

void brc_rest_compute_all(brc_simulation *s)
{
    if (!brc_effect_is_in(s, &brc_rest_effect)) return;
    release(s);
    brc_awake_choose(s, 0, NULL);
}

/* BRECCIA_AT_REST=compute: everything is gone over, for comparison. */
static brc_status create(brc_simulation *s)
{
    void **own = brc_effect_own(s, &brc_rest_effect);
    const char *const asked = getenv("BRECCIA_AT_REST");
    if (asked && strcmp(asked, "compute") != 0 && strcmp(asked, "skip") != 0)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "BRECCIA_AT_REST is '%.64s'; expected skip (as without it), or compute: elements that nothing "
                        "has reached yet are gone over too",
                        asked);
    if (!brc_device_chooses_groups(s->device) || (asked && strcmp(asked, "compute") == 0)) return BRC_OK;
    return brc_memory_allocate(s->context, own, 1, sizeof(rest), "elements at rest");
}

static bool due(const brc_simulation *s)
{
    return rest_of(s) != NULL;
}

/* ---- who moved ---- */

/* Whether one of `width` numbers of a row is not 0. */
static bool is_some(const void *numbers, int bytes, int64_t row, int first, int width)
{
    const int64_t end = row * width + width;
    for (int64_t k = row * width + first; k < end; ++k)
        if (bytes == 8 ? ((const double *)numbers)[k] != 0 : ((const float *)numbers)[k] != 0) return true;
    return false;
}

static bool moves(const brc_simulation *s, int64_t row)
{
    const int bytes = brc_state_bytes(s);
    return is_some(brc_buffer_host(brc_velocity_of(s)), bytes, row, 0, 3) ||
           (s->model->turns && is_some(brc_buffer_host(brc_spin_of(s)), bytes, row, 0, 3));
}

/* At the start of a stage: what stands elsewhere than at first counts as moved too. */
static bool has_moved(const brc_simulation *s, int64_t row)
{
    const int bytes = brc_state_bytes(s);
    return moves(s, row) || is_some(brc_buffer_host(brc_displacement_of(s)), bytes, row, 0, 3) ||
           (s->model->turns && is_some(brc_buffer_host(brc_orientation_of(s)), bytes, row, 1, 4));
}

/* ---- how far it reaches ---- */

static void wake(const brc_simulation *s, rest *r, int32_t row)
{
    const int32_t group = row / (s->layout->n_rows / s->n_groups);
    if (r->in[group]) return;
    r->in[group] = r->longer = true;
    r->watched[r->n_watched++] = group;
}

/* Rows front[n], whose distance is 0 now: those around them are nearer than they were. */
static void spread(const brc_simulation *s, rest *r, int32_t n)
{
    const brc_domain *d = s->domain;
    for (int32_t k = 0; k < n; ++k)
        wake(s, r, r->front[k]);
    for (int ring = 1; ring <= r->rings && n > 0; ++ring) {
        int32_t n_far = 0;
        for (int32_t k = 0; k < n; ++k) {
            const int32_t e = s->layout->element_of_row[r->front[k]];
            for (int64_t h = e < 0 ? 0 : d->row_start[e]; h < (e < 0 ? 0 : d->row_start[e + 1]); ++h) {
                const int32_t next = s->layout->row_of_element[d->neighbour[h]];
                if (r->distance[next] <= ring) continue;
                r->distance[next] = (uint8_t)ring;
                r->far[n_far++] = next;
                wake(s, r, next);
            }
        }
        int32_t *const was = r->front;
        r->front = r->far;
        r->far = was;
        n = n_far;
    }
}

static void add(rest *r, int32_t row, int32_t *n)
{
    if (r->distance[row] == 0) return;
    r->distance[row] = 0;
    r->front[(*n)++] = row;
}

/* Elements that are listed with one that moved, or with a striker, and those that touch already. */
static void add_pairs(const brc_simulation *s, rest *r)
{
    const int32_t *ends, *touch, n_rows = s->layout->n_rows;
    const int32_t n_pairs = brc_contact_pairs_here(s, &ends, &touch);
    int32_t n = 0;
    for (int32_t p = 0; p < n_pairs; ++p) {
        const int32_t i = ends[2 * (int64_t)p], j = ends[2 * (int64_t)p + 1];
        const bool outside = j >= n_rows;
        if (touch[p] || outside || r->moved[j]) add(r, i, &n);
        if (!outside && (touch[p] || r->moved[i])) add(r, j, &n);
    }
    r->lists = brc_contact_lists(s);
    spread(s, r, n);
}

/* The list of groups; given up where it is nearly all. */
static void list_groups(brc_simulation *s, rest *r)
{
    if (!r->longer) return;
    r->longer = false;
    r->n = 0;
    for (int32_t g = 0; g < s->n_groups; ++g)
        if (r->in[g]) r->groups[r->n++] = g;
    if (r->n <= most_awake * s->n_groups) return;
    forget(r);
    r->given_up = true;
}

static void choose(brc_simulation *s, const rest *r)
{
    if (r->given_up || r->steps < FOLLOWED)
        brc_awake_choose(s, 0, NULL);
    else
        brc_awake_choose(s, r->n, r->groups);
}

/* ---- in the course of a stage ---- */

static brc_status begin(brc_simulation *s, rest *r)
{
    const int32_t n_rows = s->layout->n_rows;
    BRC_TRY(BRC_ALLOCATE(s->context, &r->moved, n_rows, "elements at rest"));
    BRC_TRY(BRC_ALLOCATE(s->context, &r->distance, n_rows, "elements at rest"));
    BRC_TRY(BRC_ALLOCATE(s->context, &r->in, s->n_groups, "elements at rest"));
    BRC_TRY(BRC_ALLOCATE(s->context, &r->groups, s->n_groups, "elements at rest"));
    BRC_TRY(BRC_ALLOCATE(s->context, &r->watched, s->n_groups, "elements at rest"));
    BRC_TRY(BRC_ALLOCATE(s->context, &r->front, n_rows, "elements at rest"));
    BRC_TRY(BRC_ALLOCATE(s->context, &r->far, n_rows, "elements at rest"));
    r->rings = brc_awake_rings(s) + (s->fracture ? 1 : 0); /* criteria read stresses of neighbours */
    memset(r->distance, r->rings + 1, (size_t)n_rows);
    BRC_TRY(brc_loads_driven(s, r->moved));
    int32_t n = 0;
    for (int32_t row = 0; row < n_rows; ++row) {
        r->moved[row] |= has_moved(s, row);
        if (r->moved[row]) add(r, row, &n);
    }
    r->longer = true;
    if (n > most_awake * n_rows)
        memset(r->in, 1, (size_t)s->n_groups);
    else
        spread(s, r, n), add_pairs(s, r);
    return BRC_OK;
}

/* Rows that moved in this step, among those that could. */
static void follow(brc_simulation *s, rest *r)
{
    const int32_t width = s->layout->n_rows / s->n_groups;
    int32_t n = 0, left = 0;
    bool some = false;
    for (int32_t k = 0; k < r->n_watched; ++k) {
        const int32_t group = r->watched[k];
        bool whole = true;
        for (int32_t row = group * width; row < (group + 1) * width; ++row) {
            if (r->moved[row]) continue;
            if (!moves(s, row)) {
                whole = false;
                continue;
            }
            r->moved[row] = some = true;
            add(r, row, &n);
        }
        if (!whole) r->watched[left++] = group;
    }
    r->n_watched = left;
    spread(s, r, n);
    if (some || r->lists != brc_contact_lists(s)) add_pairs(s, r);
}

/* Elements are at the end of a step, and its forces are next. */
static brc_status moved(brc_simulation *s)
{
    rest *r = rest_of(s);
    if (!r->given_up) {
        if (r->steps < FOLLOWED) r->steps += 1;
        if (!r->moved)
            BRC_TRY(begin(s, r));
        else
            follow(s, r);
        list_groups(s, r);
    }
    choose(s, r);
    brc_awake_count(s);
    return BRC_OK;
}

/* A list of pairs was made in the middle of an evaluation. */
static brc_status listed(brc_simulation *s)
{
    rest *r = rest_of(s);
    if (!r->moved) return BRC_OK;
    add_pairs(s, r);
    list_groups(s, r);
    choose(s, r);
    return BRC_OK;
}

static brc_status restart(brc_simulation *s)
{
    forget(rest_of(s));
    brc_awake_choose(s, 0, NULL);
    return BRC_OK;
}

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_MOVED, .order = BRC_MOVED_CHECKS + 1, .plain = moved, .due = due},
                                    {.hook = BRC_HOOK_PAIRS, .plain = listed, .due = due},
                                    {.hook = BRC_HOOK_RESTART, .plain = restart, .due = due},
                                    {.hook = BRC_HOOK_STEPS, .plain = restart, .due = due},
                                    {.hook = BRC_HOOK_ENTER, .plain = restart, .due = due}};
const brc_effect brc_rest_effect = {.in = in, .create = create, .free = release, BRC_HOOKED(hooked)};

/* ---- foretold ---- */

double brc_rest_spared(const brc_simulation *s, double steps)
{
    const rest *r = brc_effect_is_in(s, &brc_rest_effect) ? rest_of(s) : NULL;
    const double dt = brc_simulation_time_step(s).value;
    double speed = 0, edge = 0;
    if (!r || !r->moved || !(dt > 0)) return 0;
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const brc_elastic *m = s->elastic + s->material_of_element[e];
        speed = fmax(speed, (m->lambda + 2 * m->mu) / m->density);
    }
    for (int c = 0; c < 3; ++c)
        edge = fmax(edge, s->domain->bounds[1][c] - s->domain->bounds[0][c]);
    const double asleep = 1 - (double)r->n / (double)s->n_groups, waking = asleep * edge / (sqrt(speed) * dt);
    return steps < waking ? asleep * steps * (1 - 0.5 * steps / waking) : 0.5 * asleep * waking;
}

double brc_rest_whole_pace(double pace, brc_rest_account from, brc_rest_account to)
{
    const double all = to.all - from.all, left_out = to.left_out - from.left_out;
    return all > left_out ? pace * all / (all - left_out) : pace;
}
