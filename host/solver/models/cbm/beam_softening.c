#include "beam_softening.h"
#include "cbm_internal.h"
#include "../../effects/fracture/bond_area.h"
#include "../../effects/fracture/crack_range.h"
#include <math.h>

/* E G_c / sigma_f^2 below this many diameters: the crack is not resolved. */
static const double least_diameters = 4;

/* Components of `crack` and states of `open` (beam_softening.cl). */
enum { ENERGY = 2, EXPONENTIAL = 3, SPENT = 6, TILT = 10, CAPACITY = 11, PER_AREA = 12, LATERAL = 20, WIDTH = 21 };
enum { WHOLE = 0, BROKEN = 3 };
enum { LEADS = 1, JOINED = 2 };

struct brc_beam_softening {
    brc_pass *force, *energy, *virial, *move, *begin, *keep, *end;
    brc_buffer *crack;              /* [n_slots][WIDTH][C] */
    brc_buffer *open, *lead, *twin; /* [n_slots][C] */
    brc_buffer *active, *raised;    /* [n_groups] */
    brc_buffer *touched;            /* [n_rows] */
};
typedef struct brc_beam_softening beam_softening;

BRC_WANTED(softens, w->scene->has_fracture &&brc_wants_spheres(w) && w->softens)

#define AT(member) BRC_FIELD_AT(beam_softening, member)
static const brc_field_row rows[] = {
    BRC_KEPT_FIELD(crack, brc_each_entry, WIDTH, COEFF, NULL, "cohesion of beams", "-", "softening.crack"),
    BRC_KEPT_FIELD(open, brc_each_entry, 1, INT, NULL, "open beams", "-", "softening.open"),
    BRC_FIELD(lead, brc_each_entry, 1, INT, NULL, "cohesion of beams", "-"),
    BRC_FIELD(twin, brc_each_entry, 1, INT, NULL, "cohesion of beams", "-"),
    BRC_FIELD(active, brc_each_group, 1, INT, NULL, "open beams", "-"),
    BRC_FIELD(raised, brc_each_group, 1, INT, NULL, "open beams", "-"),
    BRC_FIELD(touched, brc_each_row, 1, INT, NULL, "open beams", "-"),
};
BRC_FIELD_TABLE(brc_beam_softening_fields, "cohesion of beams", BRC_LIFE_RUN, softens, rows);

static beam_softening *softening_of(const brc_simulation *s)
{
    return brc_cbm_own_of(s)->softening;
}
BRC_READ(bool, brc_beam_softening_is_on, softening_of(s) != NULL)

static brc_status make_passes(brc_simulation *s, beam_softening *f)
{
    const brc_scope run = brc_scope_of_run(s), breaks = brc_scope_of_breaks(s, &run),
                    criterion = brc_scope_of_criterion(s, &breaks);
    const brc_scope beams = {.owner = "cohesion of beams",
                             .base = f,
                             .tables = {&brc_beam_softening_fields},
                             .outer = &criterion},
                    request = brc_scope_of_request(&beams);
    const brc_pass_wanted wanted[] = {BRC_PASS(&f->energy, "beam_soft_energy", NULL),
                                      BRC_PASS(&f->virial, "beam_soft_virial", "virial"),
                                      BRC_PASS(&f->move, "beam_soft_move", "steepest clear"),
                                      BRC_PASS(&f->begin, "beam_soft_begin", "step level steepest"),
                                      BRC_PASS(&f->keep, "beam_soft_keep", "step"),
                                      BRC_PASS(&f->end, "beam_soft_end", "level step")};
    BRC_TRY(BRC_PASSES_MAKE(s, &beams, wanted));
    return BRC_PASSES(s, &request, BRC_PASS(&f->force, "beam_soft_force", NULL));
}

static brc_status warn_of_size(brc_simulation *s, const brc_strengths *strengths)
{
    brc_crack_lengths l;
    BRC_TRY(brc_crack_lengths_find(s, strengths, least_diameters, &l));
    if (2 * l.n_below[0] > l.n) /* strengths scatter: half of the bonds lie on either side */
        brc_log(s->context, BRC_LOG_WARNING,
                "fracture_energy: E G_c / sigma_f^2 is less than %g diameters at %lld of %lld bonds (%.2g at least): a "
                "crack costs about G_c per area only above; "
                "use spheres of %.3g mm in diameter (they are of %.3g mm) or a lower strength",
                least_diameters, (long long)l.n_below[0], (long long)l.n, l.ratio[0],
                1e3 * brc_crack_lengths_size(&l, least_diameters), 1e3 * l.size);
    brc_crack_lengths_tell(s, &l);
    brc_crack_lengths_free(&l);
    return brc_crack_range_tell(s, "spheres");
}

/* Where only that of the virial stress is given: the limit of the weaker of its elements [Pa]. */
static double beam_strength(const brc_simulation *s, int64_t h)
{
    const double i = brc_simulation_element_strength(s, s->domain->neighbour[s->domain->twin[h]]),
                 j = brc_simulation_element_strength(s, s->domain->neighbour[h]);
    return i > 0 && j > 0 ? fmin(i, j) : fmax(i, j);
}

/* nu / E of the weaker effect of its elements [1/Pa]. */
static double lateral_of(const brc_simulation *s, int64_t h)
{
    const brc_material *i = &s->scene->materials[s->material_of_element[s->domain->neighbour[s->domain->twin[h]]]],
                       *j = &s->scene->materials[s->material_of_element[s->domain->neighbour[h]]];
    return fmax(0, fmin(i->poisson / i->young, j->poisson / j->young));
}

/* Groups and elements with beams that opened follow from the entries; groups with beams of interfaces are active. */
static brc_status find_touched(brc_simulation *s, const beam_softening *f)
{
    const int64_t slice = s->layout->slice, n_rows = s->layout->n_rows, n_entries = s->layout->n_slots * slice,
                  width = n_rows / s->n_groups;
    BRC_LOCAL(s->context, n_entries, int32_t, open, "open beams");
    BRC_LOCAL(s->context, n_entries, int32_t, lead, "open beams");
    BRC_LOCAL(s->context, s->n_groups, int32_t, active, "open beams");
    BRC_LOCAL(s->context, n_rows, int32_t, touched, "open beams");
    BRC_TRY(brc_buffer_read(f->open, 0, open, 4 * n_entries));
    BRC_TRY(brc_buffer_read(f->lead, 0, lead, 4 * n_entries));
    for (int32_t block = 0; block < s->layout->n_slices; ++block)
        for (int64_t k = (int64_t)s->layout->slot_start[block] * slice;
             k < (int64_t)s->layout->slot_start[block + 1] * slice; ++k) {
            const int64_t row = block * slice + k % slice;
            if (open[k] != WHOLE) touched[row] = 1;
            if (open[k] != WHOLE || lead[k] & JOINED) active[row / width] = 1;
        }
    BRC_TRY(brc_buffer_write(f->touched, 0, touched, 4 * n_rows));
    return brc_buffer_write(f->active, 0, active, 4 * (int64_t)s->n_groups);
}

static brc_status upload_bonds(brc_simulation *s, beam_softening *f, const brc_strengths *strengths)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t n_entries = layout->n_slots * layout->slice;
    BRC_LOCAL(s->context, WIDTH * n_entries, double, crack, "cohesion of beams");
    BRC_LOCAL(s->context, n_entries, int32_t, lead, "cohesion of beams");
    BRC_LOCAL(s->context, n_entries, int32_t, twin, "cohesion of beams");
    BRC_LOCAL(s->context, d->n_bonds, double, area, "areas of beams");
    BRC_TRY(brc_bond_areas_closed(s->context, d, area));
    BRC_TRY(brc_layout_twins(s->context, layout, d, twin));
    for (int64_t k = 0; k < n_entries; ++k) {
        const int32_t h = layout->half_edge[k];
        if (h < 0) continue;
        double *own = crack + (k / layout->slice) * WIDTH * layout->slice + k % layout->slice;
        const double strength = strengths->tension[d->bond[h]] > 0
                                    ? strengths->tension[d->bond[h]]
                                    : beam_strength(s, h) * strengths->factor[d->bond[h]];
        own[ENERGY * layout->slice] = strengths->energy[d->bond[h]] * area[d->bond[h]];
        own[CAPACITY * layout->slice] = strength * area[d->bond[h]];
        own[PER_AREA * layout->slice] = 1 / area[d->bond[h]];
        own[LATERAL * layout->slice] = lateral_of(s, h);
        own[EXPONENTIAL * layout->slice] = strengths->exponential[d->bond[h]];
        lead[k] = (d->neighbour[d->twin[h]] < d->neighbour[h] ? LEADS : 0) +
                  (strengths->joint[d->bond[h]] && strengths->energy[d->bond[h]] > 0 ? JOINED : 0);
    }
    BRC_TRY(brc_upload_coeff(s, f->crack, crack, WIDTH * n_entries));
    BRC_TRY(brc_upload_int(f->lead, lead, n_entries));
    BRC_TRY(brc_upload_int(f->twin, twin, n_entries));
    return find_touched(s, f);
}

brc_status brc_beam_softening_create(brc_simulation *s, const brc_strengths *strengths)
{
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_cbm_own_of(s)->softening, 1, "cohesion of beams"));
    BRC_TRY(make_passes(s, brc_cbm_own_of(s)->softening));
    BRC_TRY(warn_of_size(s, strengths));
    BRC_TRY(brc_fields_create(s->device, &brc_beam_softening_fields, &s->wants, brc_cbm_own_of(s)->softening));
    return upload_bonds(s, brc_cbm_own_of(s)->softening, strengths);
}

void brc_beam_softening_free(brc_simulation *s)
{
    beam_softening *f = softening_of(s);
    if (!f) return;
    brc_fields_free(&brc_beam_softening_fields, f);
    brc_memory_free(f);
    brc_cbm_own_of(s)->softening = NULL;
}

/* ---- an evaluation ---- */

brc_status brc_beam_softening_force(brc_simulation *s, const brc_force_request *r)
{
    const beam_softening *f = softening_of(s);
    if (!f) return BRC_OK;
    return brc_pass_run_on(f->force, s->n_groups, r, NULL, NULL);
}

brc_status brc_beam_softening_energy(brc_simulation *s)
{
    return brc_beam_softening_is_on(s) ? brc_pass_run(softening_of(s)->energy, s->n_groups) : BRC_OK;
}

brc_status brc_beam_softening_virial(brc_simulation *s, brc_buffer *virial)
{
    return brc_beam_softening_is_on(s) ? BRC_RUN(softening_of(s)->virial, s->n_groups, {"virial", BRC_BUF(virial)})
                                       : BRC_OK;
}

/* ---- a step ---- */

brc_status brc_beam_softening_move(brc_simulation *s)
{
    const beam_softening *f = softening_of(s);
    if (!f) return BRC_OK;
    return BRC_RUN(f->move, s->n_groups, {"steepest", BRC_COEFF(BRC_BEAM_LEAST_COSINE)},
                   {"clear", BRC_COEFF(s->scene->fracture.closure ? BRC_BEAM_CLEAR : 0)});
}

brc_status brc_beam_softening_begin(brc_simulation *s, int32_t moment)
{
    const beam_softening *f = softening_of(s);
    if (!f) return BRC_OK;
    BRC_TRY(BRC_RUN(f->begin, s->n_groups, {"step", BRC_INT(moment)}, {"level", BRC_INT(s->scene->fracture.level > 0)},
                    {"steepest", BRC_COEFF(BRC_BEAM_LEAST_COSINE)}));
    return BRC_RUN(f->keep, s->n_groups, {"step", BRC_INT(moment)});
}

brc_status brc_beam_softening_end(brc_simulation *s, int32_t moment)
{
    const beam_softening *f = softening_of(s);
    if (!f) return BRC_OK;
    return BRC_RUN(f->end, s->n_groups, {"level", BRC_INT(s->scene->fracture.level)}, {"step", BRC_INT(moment)});
}

void brc_beam_softening_cracks(const brc_simulation *s, brc_buffer **open, brc_buffer **crack)
{
    const beam_softening *f = softening_of(s);
    *open = f ? f->open : NULL;
    *crack = f ? f->crack : NULL;
}

/* ---- what stays ---- */

brc_status brc_beam_softening_store_state(brc_simulation *s, brc_state_store *store)
{
    const beam_softening *f = softening_of(s);
    if (!f) return BRC_OK;
    BRC_TRY(brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_beam_softening_fields, .owner = f}));
    BRC_TRY(brc_store_entry(
        s, store, &(brc_state_entry){"softening.factor", brc_fracture_factors(s), BRC_ENTRIES, BRC_OF_COEFF, 1, NULL}));
    return store->loading ? find_touched(s, f) : BRC_OK;
}

brc_status brc_beam_softening_report(brc_simulation *s, brc_softening_report *out)
{
    const beam_softening *f = softening_of(s);
    const brc_layout *layout = s->layout;
    const int64_t n_entries = layout->n_slots * layout->slice;
    *out = (brc_softening_report){0};
    if (!f) return BRC_OK;
    BRC_LOCAL(s->context, WIDTH * n_entries, double, crack, "cohesion of beams");
    BRC_LOCAL(s->context, n_entries, int32_t, open, "cohesion of beams");
    BRC_TRY(brc_download(s, f->crack, brc_coeff_bytes(s), crack, WIDTH * n_entries));
    BRC_TRY(brc_buffer_read(f->open, 0, open, 4 * n_entries));
    for (int64_t k = 0; k < n_entries; ++k) {
        const int32_t h = layout->half_edge[k];
        const double *own = crack + (k / layout->slice) * WIDTH * layout->slice + k % layout->slice;
        if (h < 0 || open[k] == WHOLE || s->domain->bond_half_edge[s->domain->bond[h]] != h)
            continue; /* each bond once */
        out->n_opened += 1;
        out->spent += own[SPENT * layout->slice];
        if (open[k] != BROKEN) {
            out->unfinished += own[SPENT * layout->slice];
            continue;
        }
        out->n_ended += 1;
        out->area += own[TILT * layout->slice] / own[PER_AREA * layout->slice];
    }
    return BRC_OK;
}
