#include "guard.h"
#include "guard_cause.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 128 }; /* rows of a work-item of guard_probe (GUARD_BLOCK, kernels/effects/guard.cl) */
/* A probe reads six numbers an element, 2 % of what a step moves: every 16 steps it costs a thousandth. Waiting for the
 * device and reading a number a block is worth some microseconds, a ledger about a step: every 256 and every 1024 steps
 * both stay below a hundredth (docs/notebook/stability.md). */
static const int64_t probe_every = 16, read_every = 256, ledger_every = 1024;
/* An element faster than this many times the wave speed and the fastest element at the start of the stage is no physics
 * any more. */
static const double most_speeds = 30;
/* Beyond any length [m] and spin [rad/s], within what single precision can square. */
static const double endless = 1e18;
/* Energy may exceed what was put in by this factor before the run is stopped as running away. Verlet's own oscillation
 * is some percent near the limit (docs/notebook/stability.md), so 100 is reached only by growth. */
static const double runaway = 100;
/* Of the most that the body ever held: what loads that took back what they gave leave. */
static const double rounding = 1e-9;
/* What only takes energy may stand below zero by this part of what was put in or held: sides that slide against their
 * own force give it back, and the ledger closes by that. Sound runs stay within 0.02
 * (bench/results/2026-11-28-coasting.md). */
static const double most_given_back = 0.05;

struct brc_guard_state {
    brc_pass *probe;
    brc_buffer *first, *when; /* [n_blocks] */
    int32_t n_blocks;
    int32_t *found; /* [2][n_blocks] host */
    double most_v;
    int64_t probe_every;
    brc_guard_report report;
};

BRC_COUNTED(each_block, (w->layout->n_rows + BLOCK - 1) / BLOCK)

#define AT(member) BRC_FIELD_AT(struct brc_guard_state, member)
static const brc_field_row rows[] = {
    BRC_FIELD(first, each_block, 1, INT, NULL, "guard", "-"),
    BRC_FIELD(when, each_block, 1, INT, NULL, "guard", "-"),
};
BRC_FIELD_TABLE(brc_guard_fields, "guard", BRC_LIFE_DYNAMIC, NULL, rows);

brc_guard_report brc_simulation_guard_report(const brc_simulation *s)
{
    return s->guard ? s->guard->report : (brc_guard_report){0};
}

static void release(brc_simulation *s)
{
    if (!s->guard) return;
    brc_fields_free(&brc_guard_fields, s->guard);
    brc_memory_free(s->guard->found);
    brc_memory_free(s->guard);
    s->guard = NULL;
}

/* Wave speed of the stiffest material that elements are made of (strikers may have others), and the fastest element now
 * [m/s]. */
static brc_status speeds(brc_simulation *s, double *wave, double *fastest)
{
    const int64_t n = s->domain->n_elements;
    *wave = *fastest = 0;
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const brc_elastic *m = s->elastic + s->material_of_element[e];
        *wave = fmax(*wave, sqrt((m->lambda + 2 * m->mu) / m->density));
    }
    BRC_LOCAL(s->context, 3 * n, double, v, "velocities");
    const brc_status status = brc_state_from_rows(s, brc_velocity_of(s), v, 3);
    for (int64_t e = 0; e < n; ++e)
        *fastest =
            fmax(*fastest, sqrt(v[3 * e] * v[3 * e] + v[3 * e + 1] * v[3 * e + 1] + v[3 * e + 2] * v[3 * e + 2]));
    return status;
}

brc_status brc_guard_begin_stage(brc_simulation *s)
{
    double wave, fastest;
    if (!s->guard) {
        BRC_TRY(BRC_ALLOCATE(s->context, &s->guard, 1, "guard"));
        struct brc_guard_state *g = s->guard;
        g->n_blocks = (int32_t)each_block(&s->wants);
        BRC_TRY(BRC_ALLOCATE(s->context, &g->found, 2 * (int64_t)g->n_blocks, "guard"));
        memset(g->found, -1, 2 * (size_t)g->n_blocks * sizeof *g->found);
        BRC_TRY(brc_fields_create(s->device, &brc_guard_fields, &s->wants, g));
        static const brc_value_row values[] = {{"most_v", BRC_VALUE_REAL, AT(most_v)}};
        const brc_scope run = brc_scope_of_run(s), guard = {.owner = "guard",
                                                            .base = g,
                                                            .tables = {&brc_guard_fields},
                                                            BRC_VALUES(values),
                                                            .outer = &run};
        BRC_TRY(BRC_PASSES(s, &guard, BRC_PASS(&g->probe, "guard_probe", "n probe most_u")));
        BRC_TRY(brc_upload_int(g->first, g->found, g->n_blocks));
        BRC_TRY(brc_upload_int(g->when, g->found, g->n_blocks));
        const int64_t asked = s->scene->guard.every;
        g->report.every = asked > 0 ? asked : read_every;
        g->report.ledger_every = asked > 0 ? asked : ledger_every;
        g->probe_every = g->report.every < probe_every ? g->report.every : probe_every;
    }
    BRC_TRY(speeds(s, &wave, &fastest));
    s->guard->most_v = fmin(most_speeds * (wave + fastest), endless);
    return BRC_OK;
}

/* Probe number n is that at step n probe_every, or after the one before it. */
static brc_status probe_elements(brc_simulation *s)
{
    struct brc_guard_state *g = s->guard;
    const int64_t probe = (brc_simulation_step(s) + g->probe_every - 1) / g->probe_every;
    return BRC_RUN(g->probe, g->n_blocks, {"n", BRC_INT(s->layout->n_rows)},
                   {"probe", BRC_INT(probe < INT32_MAX ? probe : INT32_MAX)}, {"most_u", BRC_STATE(endless)});
}

brc_status brc_guard_step(brc_simulation *s)
{
    return s->guard && brc_simulation_step(s) % s->guard->probe_every == 0 ? probe_elements(s) : BRC_OK;
}

static int64_t next_reading(const brc_simulation *s, int64_t step)
{
    const int64_t every = s->guard->report.every;
    return (step / every + 1) * every;
}

/* The probes so far that were not read yet. */
static brc_status stretch(brc_simulation *s, const brc_occasion *now)
{
    if (!s->guard) return BRC_OK;
    BRC_TRY(now->store->field(now->store, s->guard->first));
    return now->store->field(now->store, s->guard->when);
}

/* The element found first, of equals the lowest; -1: none. *probe: when. */
static brc_status find_element(brc_simulation *s, int64_t *element, int64_t *probe)
{
    struct brc_guard_state *g = s->guard;
    const int32_t *when = g->found + g->n_blocks;
    *element = -1;
    *probe = 0;
    BRC_TRY(brc_buffer_read(g->first, 0, g->found, g->n_blocks * (int64_t)sizeof *g->found));
    int any = 0;
    for (int32_t b = 0; b < g->n_blocks; ++b)
        any |= g->found[b] >= 0;
    if (!any) return BRC_OK;
    BRC_TRY(brc_buffer_read(g->when, 0, g->found + g->n_blocks, g->n_blocks * (int64_t)sizeof *g->found));
    for (int32_t b = 0; b < g->n_blocks; ++b) {
        if (g->found[b] < 0) continue;
        const int64_t e = s->layout->element_of_row[g->found[b]];
        if (*element >= 0 && (when[b] > *probe || (when[b] == *probe && e > *element))) continue;
        *element = e;
        *probe = when[b];
    }
    return BRC_OK;
}

/* Where the ledger alone tells: the fastest element. */
static brc_status fastest_element(brc_simulation *s, int64_t *element)
{
    const int64_t n = s->domain->n_elements;
    double most = -1;
    BRC_LOCAL(s->context, 3 * n, double, v, "velocities");
    const brc_status status = brc_state_from_rows(s, brc_velocity_of(s), v, 3);
    for (int64_t e = 0; e < n; ++e) {
        const double square = v[3 * e] * v[3 * e] + v[3 * e + 1] * v[3 * e + 1] + v[3 * e + 2] * v[3 * e + 2];
        if (!(square > most)) continue;
        most = square;
        *element = e;
    }
    return status;
}

/* probe: when the device saw it, -1 where the ledger tells; off: the ledger's closure where that is what is wrong, else
 * 0; known: the cause where the caller knows it, else NULL. */
static brc_status stop(brc_simulation *s, bool several, const char *what, int64_t element, int64_t probe, double off,
                       const char *known)
{
    char where[900] = "", cause[700] = "", seen[120] = "";
    if (element >= 0) brc_guard_tell_element(s, element, where, sizeof where);
    if (probe < 0)
        snprintf(seen, sizeof seen, " The fastest:");
    else
        snprintf(seen, sizeof seen, " First seen between steps %lld and %lld:",
                 (long long)(probe > 0 ? (probe - 1) * s->guard->probe_every : 0),
                 (long long)(probe * s->guard->probe_every));
    if (!known) brc_guard_tell_cause(s, element, off, cause, sizeof cause);
    return BRC_FAIL(s->context, BRC_PHYSICS_STOPPED,
                    "stage '%s' stopped at step %lld, t = %.6g s: %s%s%s.%s%s%s Likely cause: %s",
                    brc_current_stage(s)->name, (long long)brc_simulation_step(s), brc_simulation_time(s), what,
                    several ? " in the bodies of model " : "", several ? brc_model_name(s->scene->model.kind) : "",
                    element >= 0 ? seen : "", element >= 0 ? " " : "", where, known ? known : cause);
}

static brc_status read_probes(brc_simulation *s, bool several)
{
    int64_t element, probe;
    char what[200];
    BRC_TRY(find_element(s, &element, &probe));
    if (element < 0) return BRC_OK;
    snprintf(what, sizeof what,
             "element %lld is faster than %.3g m/s (%.0f times the wave speed and the fastest element at the start of "
             "the stage) or not finite",
             (long long)element, s->guard->most_v, most_speeds);
    return stop(s, several, what, element, probe, 0, NULL);
}

brc_status brc_guard_vouch(brc_simulation *s, bool several)
{
    if (!s->guard || brc_current_stage(s)->solver != BRC_SOLVER_DYNAMIC) return BRC_OK;
    BRC_TRY(probe_elements(s));
    return read_probes(s, several);
}

static double put_in(const brc_ledger *ledger)
{
    return fabs(ledger->initial) + fabs(ledger->work) + fabs(ledger->potential);
}

/* A loss that gives energy back: friction, damping of contact or damping well below zero; NULL: none. */
static const char *gaining_loss(const brc_ledger *ledger, double *loss)
{
    const double held = fmax(put_in(ledger), ledger->peak_elastic + ledger->peak_kinetic);
    const struct {
        const char *name;
        double value;
    } losses[] = {{"friction", ledger->friction}, {"impact", ledger->impact}, {"damping", ledger->damping}};
    for (size_t k = 0; k < sizeof losses / sizeof *losses; ++k) {
        *loss = losses[k].value;
        if (*loss < -most_given_back * held) return losses[k].name;
    }
    return NULL;
}

/* What is wrong with a ledger, into `what`, and why where that is known, into *cause (else NULL); false: nothing. */
static bool is_wrong(const brc_simulation *s, const brc_ledger *ledger, char *what, size_t size, const char **cause)
{
    const double in = put_in(ledger), most = s->scene->guard.closure;
    double loss;
    const char *gaining = gaining_loss(ledger, &loss);
    *cause = NULL;
    if (!isfinite(ledger->total))
        snprintf(what, size, "a value is not finite (energy %.4g J, put in %.4g J)", ledger->total, in);
    else if (ledger->total > runaway * in && in > 0 &&
             ledger->total > rounding * (ledger->peak_elastic + ledger->peak_kinetic))
        snprintf(what, size, "the energy runs away (energy %.4g J, put in %.4g J)", ledger->total, in);
    else if (most > 0 && fabs(ledger->closure) > most)
        snprintf(what, size,
                 "the energy ledger is off by %.3g %%, guard.closure is %.3g %% (energy %.4g J, put in %.4g J)",
                 100 * ledger->closure, 100 * most, ledger->total, in);
    else if (gaining) {
        snprintf(what, size, "%s can only take energy and gave some back (%.4g J in all, put in %.4g J)", gaining, loss,
                 in);
        *cause = "sides in contact, or of broken faces, that slide against the force between them, which a step too "
                 "large for their stiffness brings about: use a smaller safety, or relaxed cells (lloyd)";
    } else
        return false;
    return true;
}

brc_status brc_guard_read(brc_simulation *s, bool several, const brc_ledger *ledger)
{
    struct brc_guard_state *g = s->guard;
    int64_t element = -1;
    char what[200];
    const char *known;
    brc_ledger own;
    g->report.probes += 1;
    BRC_TRY(read_probes(s, several));
    if (!ledger && brc_simulation_step(s) % g->report.ledger_every) return BRC_OK;
    g->report.ledgers += 1;
    if (!ledger) BRC_TRY(brc_simulation_ledger(s, &own));
    if (!ledger) ledger = &own;
    if (!is_wrong(s, ledger, what, sizeof what, &known)) return BRC_OK;
    BRC_TRY(fastest_element(s, &element));
    const bool bounded = isfinite(ledger->total) && ledger->total <= runaway * put_in(ledger);
    return stop(s, several, what, element, -1, bounded ? ledger->closure : 0, known);
}

BRC_CALLED(read_hooked, brc_guard_read(s, now->several, now->ledger))

static const brc_hooked hooked[] = {{.hook = BRC_HOOK_STEPS, .plain = brc_guard_begin_stage},
                                    {.hook = BRC_HOOK_MOVED, .order = BRC_MOVED_CHECKS, .plain = brc_guard_step},
                                    {.hook = BRC_HOOK_READ, .call = read_hooked},
                                    {.hook = BRC_HOOK_STRETCH, .call = stretch}};
const brc_effect brc_guard_effect = {.fields = (const brc_field_table *const[]){&brc_guard_fields, NULL},
                                     .free = release,
                                     .next_reading = next_reading,
                                     BRC_HOOKED(hooked)};
