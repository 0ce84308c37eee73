/* What broke, read from the device: events, damage, fragments. */
#include "bond_area.h"
#include "fracture_internal.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../core/sym3.h"
#include <math.h>
#include <stdlib.h>

BRC_READ(bool, brc_simulation_has_fracture, s->fracture != NULL)

static brc_status refuse(const brc_simulation *s)
{
    return s->fracture ? BRC_OK : BRC_FAIL(s->context, BRC_BAD_INPUT, "the scene has no `fracture`, so nothing breaks");
}

brc_status brc_simulation_broken(brc_simulation *s, int64_t *out)
{
    double sum = 0;
    if (s->fracture) BRC_TRY(brc_vector_sum(s, s->fracture->broken, s->layout->n_rows, &sum));
    *out = llround(sum / 2);
    return BRC_OK;
}

static int by_step_and_bond(const void *a, const void *b)
{
    const brc_break *x = a, *y = b;
    if (x->step != y->step) return x->step < y->step ? -1 : 1;
    return (x->bond > y->bond) - (x->bond < y->bond);
}

/* Arrays of the entries, on the host. */
typedef struct entries {
    int32_t *step, *mode;
    double *stress, *energy;
} entries;

static brc_status read_entries(brc_simulation *s, entries *e)
{
    const brc_breaking *f = s->fracture;
    const int64_t n = s->layout->n_slots * s->layout->slice;
    const int coeff = brc_coeff_bytes(s);
    BRC_TRY(BRC_ALLOCATE(s->context, &e->step, n, "broken bonds"));
    BRC_TRY(BRC_ALLOCATE(s->context, &e->mode, n, "broken bonds"));
    BRC_TRY(BRC_ALLOCATE(s->context, &e->stress, n, "broken bonds"));
    BRC_TRY(BRC_ALLOCATE(s->context, &e->energy, n, "broken bonds"));
    BRC_TRY(brc_buffer_read(f->break_step, 0, e->step, 4 * n));
    BRC_TRY(brc_buffer_read(f->break_mode, 0, e->mode, 4 * n));
    BRC_TRY(brc_download(s, f->break_stress, coeff, e->stress, n));
    return brc_download(s, f->break_energy, coeff, e->energy, n);
}

/* ---- moments ---- */

BRC_READ(int64_t, brc_fracture_moment, brc_simulation_total_steps(s) + s->fracture->n_loads)

brc_status brc_simulation_softening(brc_simulation *s, brc_softening_report *out)
{
    *out = (brc_softening_report){0};
    return s->model->cohesion && s->fracture ? s->model->cohesion->report(s, out) : BRC_OK;
}

/* Static stages refuse bonds that stand open: their openings would not follow. */
static brc_status refuse_open(brc_simulation *s)
{
    const brc_stage *stage = brc_current_stage(s);
    brc_softening_report report = {0};
    if (!s->model->cohesion || !s->model->cohesion->is_on(s) || stage->solver == BRC_SOLVER_DYNAMIC) return BRC_OK;
    BRC_TRY(brc_simulation_softening(s, &report));
    if (report.n_opened > 0)
        return BRC_FAIL(
            s->context, BRC_BAD_INPUT,
            "stage '%s': bonds have opened against their cohesion in an earlier stage, and openings follow in dynamic "
            "stages only; use a dynamic stage with mass damping",
            stage->name);
    return BRC_OK;
}

brc_status brc_fracture_begin_stage(brc_simulation *s)
{
    brc_breaking *f = s->fracture;
    const bool dynamic = brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC;
    BRC_TRY(refuse_open(s));
    BRC_TRY(
        brc_memory_resize(s->context, (void **)&f->spans, f->n_spans + 1, sizeof *f->spans, "stages with fracture"));
    f->spans[f->n_spans++] = (brc_break_span){brc_fracture_moment(s), f->n_loads, brc_simulation_total_time(s),
                                              dynamic ? brc_simulation_time_step(s).value : 0, brc_simulation_stage(s)};
    return BRC_OK;
}

brc_status brc_fracture_begin_event(brc_simulation *s)
{
    brc_breaking *f = s->fracture;
    BRC_TRY(brc_memory_resize(s->context, (void **)&f->load, f->n_loads + 1, sizeof *f->load, "events"));
    f->load[f->n_loads++] = brc_loads_time(s);
    return BRC_OK;
}

/* Stage, time and load of the end of a step. */
static void place_in_time(const brc_breaking *f, brc_break *event)
{
    int at = f->n_spans - 1;
    while (at > 0 && f->spans[at].first_step >= event->step)
        --at;
    const brc_break_span *span = &f->spans[at];
    const int64_t steps = event->step - span->first_step;
    event->stage = span->stage;
    event->time = span->first_time + (double)steps * span->time_step;
    event->load = span->time_step > 0 ? 0 : f->load[span->first_load + steps - 1];
}

/* ---- events ---- */

/* face: area vector and centroid of cells. */
static void describe(const brc_simulation *s, int64_t h, const double face[6], brc_break *event)
{
    const brc_domain *d = s->domain;
    const int64_t j = d->neighbour[h], i = d->neighbour[d->twin[h]];
    double length = 0;
    event->element_i = (int32_t)i;
    event->element_j = (int32_t)j;
    for (int c = 0; c < 3; ++c) {
        event->position[c] =
            d->element_kind == BRC_ELEMENT_CELL ? face[3 + c] : 0.5 * (d->position[3 * i + c] + d->position[3 * j + c]);
        event->normal[c] = d->position[3 * j + c] - d->position[3 * i + c];
        length += event->normal[c] * event->normal[c];
    }
    for (int c = 0; c < 3; ++c)
        event->normal[c] /= sqrt(length);
    event->area = d->element_kind == BRC_ELEMENT_CELL ? brc_norm3(face) : brc_bond_area(d, event->bond);
    place_in_time(s->fracture, event);
}

static brc_status describe_all(brc_simulation *s, int64_t n)
{
    const brc_domain *d = s->domain;
    brc_break *events = s->fracture->events;
    const bool cells = d->element_kind == BRC_ELEMENT_CELL;
    BRC_LOCAL(s->context, n, int32_t, half_edge, "broken bonds");
    BRC_LOCAL(s->context, 6 * n, double, face, "broken bonds");
    for (int64_t k = 0; k < n; ++k)
        half_edge[k] = d->bond_half_edge[events[k].bond];
    if (cells) BRC_TRY(brc_domain_faces(s->context, d, n, half_edge, face));
    for (int64_t k = 0; k < n; ++k)
        describe(s, half_edge[k], face + 6 * k, &events[k]);
    return BRC_OK;
}

static brc_status collect(brc_simulation *s, int64_t n)
{
    brc_breaking *f = s->fracture;
    const brc_domain *d = s->domain;
    const int64_t n_entries = s->layout->n_slots * s->layout->slice;
    entries e = {0};
    brc_status status = BRC_OK;
    int64_t at = 0;
    brc_memory_free(f->events);
    f->events = NULL;
    f->n_events = 0;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &f->events, n, "broken bonds"));
    BRC_TRY_OR(cleanup, read_entries(s, &e));
    for (int64_t k = 0; k < n_entries && at < n; ++k) {
        const int32_t h = s->layout->half_edge[k];
        if (h < 0 || e.step[k] == 0 || d->bond_half_edge[d->bond[h]] != h) continue; /* each bond once */
        brc_break *event = &f->events[at++];
        *event = (brc_break){
            .step = e.step[k], .mode = e.mode[k], .bond = d->bond[h], .stress = e.stress[k], .energy = e.energy[k]};
    }
    BRC_TRY_OR(cleanup, describe_all(s, at));
    f->n_events = at;
    if (at > 0) qsort(f->events, (size_t)at, sizeof *f->events, by_step_and_bond);
cleanup:
    brc_memory_free(e.step);
    brc_memory_free(e.mode);
    brc_memory_free(e.stress);
    brc_memory_free(e.energy);
    return status;
}

brc_status brc_simulation_breaks(brc_simulation *s, int64_t *n, const brc_break **out)
{
    int64_t broken;
    BRC_TRY(refuse(s));
    BRC_TRY(brc_simulation_broken(s, &broken));
    if (broken != s->fracture->n_events) BRC_TRY(collect(s, broken)); /* bonds never heal: as many are the same ones */
    *n = s->fracture->n_events;
    *out = s->fracture->events;
    return BRC_OK;
}

brc_status brc_simulation_damage(brc_simulation *s, double *out)
{
    BRC_TRY(refuse(s));
    BRC_TRY(brc_state_from_rows(s, s->fracture->broken, out, 1));
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const int64_t degree = s->domain->row_start[e + 1] - s->domain->row_start[e];
        out[e] = degree > 0 ? out[e] / (double)degree : 0;
    }
    return BRC_OK;
}

brc_status brc_fracture_whole(brc_simulation *s, uint8_t **out)
{
    return brc_fracture_whole_at(s, INT32_MAX, out);
}

brc_status brc_fracture_whole_at(brc_simulation *s, int64_t moment, uint8_t **out)
{
    const int64_t n_entries = s->layout->n_slots * s->layout->slice;
    *out = NULL;
    BRC_LOCAL(s->context, n_entries, int32_t, step, "unbroken bonds");
    BRC_LOCAL(s->context, s->domain->n_half_edges, uint8_t, whole, "unbroken bonds");
    BRC_TRY(brc_buffer_read(s->fracture->break_step, 0, step, 4 * n_entries));
    for (int64_t k = 0; k < n_entries; ++k)
        if (s->layout->half_edge[k] >= 0) whole[s->layout->half_edge[k]] = step[k] == 0 || step[k] > moment;
    *out = whole;
    whole = NULL;
    return BRC_OK;
}

brc_status brc_simulation_whole(brc_simulation *s, uint8_t **out)
{
    *out = NULL;
    return s->fracture ? brc_fracture_whole(s, out) : BRC_OK;
}

double brc_simulation_beam_radius(const brc_simulation *s, int64_t e)
{
    return s->model->bond_radius ? s->model->bond_radius(s, e) : 0;
}

/* Lowest element id of the fragment of e, with halved paths. */
static int32_t root_of(int32_t *parent, int32_t e)
{
    while (parent[e] != e)
        e = parent[e] = parent[parent[e]];
    return e;
}

int64_t brc_fragments_over(const brc_domain *d, const uint8_t *whole, int32_t *fragment)
{
    int64_t n = 0;
    for (int32_t e = 0; e < d->n_elements; ++e)
        fragment[e] = e;
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int64_t h = d->bond_half_edge[b];
        if (!whole[h]) continue;
        const int32_t i = root_of(fragment, d->neighbour[h]), j = root_of(fragment, d->neighbour[d->twin[h]]);
        if (i < j)
            fragment[j] = i;
        else
            fragment[i] = j;
    }
    for (int32_t e = 0; e < d->n_elements; ++e)
        fragment[e] = root_of(fragment, e);
    for (int32_t e = 0; e < d->n_elements; ++e) /* roots come before their members */
        fragment[e] = fragment[e] == e ? (int32_t)n++ : fragment[fragment[e]];
    return n;
}

brc_status brc_simulation_fragments(brc_simulation *s, int32_t *fragment, int64_t *n_fragments)
{
    uint8_t *whole = NULL;
    BRC_TRY(refuse(s));
    BRC_TRY(brc_fracture_whole(s, &whole));
    *n_fragments = brc_fragments_over(s->domain, whole, fragment);
    brc_memory_free(whole);
    return BRC_OK;
}
