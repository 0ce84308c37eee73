#include "cell_softening.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../core/sym3.h"
#include "../../effects/contact/contact.h"
#include "../../effects/fracture/crack_range.h"
#include "../../effects/fracture/interfaces.h"
#include "../../utilities/scans.h"
#include "dlsm_internal.h"
#include <math.h>

/* Faces whose normal stands further from a principal axis than 60 degrees carry little across it and do not open by it
 * (docs/notebook/fracture.md). */
static const double steepest = 0.5;
/* Faces look at their own traction where a pull on a cell is above this share of the limit (softening_screen.cl,
 * soft_looking): the two agree within a few percent where nothing is open. */
static const double screen = 0.7;
/* Sweeps over the open faces a step, each with the forces at its openings; and the part of the stiffness, estimated
 * from above, that they take. Of openings whose stiffness is x times the estimate they leave (1 - x / stiffen)^n: n is
 * even, as below 0 the openings outrun their cells, which are pushed on; above 2 stiffen more is left than there was.
 * Most bodies have x below 1.2, one of forty thin rings 1.47. What is left costs energy in quick cracks
 * (bench/results/2026-11-29-sweeps.md). */
enum { N_SWEEPS = 4 };
static const double stiffen = 0.7;
/* Openings over the length of the bond from which on the sides of a broken face stand clear of each other. */
static const double clear = 0.05;
/* Shear that the sides of a crack bear, over the push along it that a face carries (docs/notebook/theory.md T10). */
static const double retention = 0.3;
/* E G_c / sigma_f^2 below this many cells: the crack is not resolved; below twice as many uneven cells bear more at
 * notches (docs/notebook/fracture.md, "Notched specimens"). */
static const double least_cells = 4;
/* A face of an interface has at least this share of its area in the interface's plane: some look back. */
static const double least_projected = 0.02;

/* Components of `crack` (softening_record.cl). */
enum { SHIFT = 0, START = 9, ENERGY = 10, EXPONENTIAL = 11, COSINE = 13, TILT = 14, SPENT = 23, WIDTH = 26 };
enum { APART = 2 }; /* SOFT_APART, of `open` */

struct brc_softening_faces {
    brc_pass *gradient, *gradient_listed, *flux, *flux_listed;
    brc_pass *take_force, *coast, *move, *measure, *book, *check, *follow, *begin, *count, *list, *energy, *settle;
    brc_buffer *crack, *open, *lead;    /* [n_slots][C][WIDTH], [n_slots][C] */
    brc_buffer *opening, *edge_opening; /* [n_slots][3][C] */
    brc_buffer *n_open, *reach, *shear; /* [n_rows] */
    brc_buffer *n_lead, *first, *sums;  /* [n_rows], [n_rows + 1], [blocks + 1] open faces of the leading sides */
    brc_buffer *face_row, *face_entry;  /* [n_faces] these faces; room for all there are */
    int32_t n_faces;
    brc_scan_kernels scan;
    brc_buffer *shear_limit;  /* [n_slots][C] scenes whose faces slide: 2 c cos phi of the bond [Pa] */
    brc_buffer *shear_energy; /* [n_slots][C] and G_II S [J] */
    double shear_least;       /* the smallest limit of shear [Pa] */
    brc_buffer *rubbed;       /* [n_rows] energy lost to friction between the sides of broken faces [J] */
    brc_ring_list around;     /* cells with open faces, for the sweeps */
    bool any;                 /* some face has opened */
    bool is_counted;          /* n_open, n_lead and what goes with them */
    bool has_faces;           /* face_row, face_entry are of the faces that are open now */
    bool is_listed;           /* around is of the faces that are open now, and, with contact, of the pairs there are */
    int64_t lists;            /* brc_contact_lists of these */
};
typedef struct brc_softening_faces softening_faces;

BRC_WANTED(softens, w->scene->has_fracture &&brc_wants_cells(w) && w->softens)
BRC_WANTED(slides, brc_scene_slides(w->scene, w->scene->model.kind))

BRC_COUNTED(each_face, w->layout->n_slots * w->layout->slice / 2 + 1)
BRC_COUNTED(each_block_of_rows, brc_scan_blocks(w->layout->n_rows) + BRC_SCAN_TOTALS)

#define AT(member) BRC_FIELD_AT(softening_faces, member)
static const brc_field_row rows[] = {
    BRC_KEPT_FIELD(crack, brc_each_record, WIDTH, COEFF, NULL, "cohesion of faces", "-", "softening.crack"),
    BRC_KEPT_FIELD(opening, brc_each_entry, 3, COEFF, NULL, "cohesion of faces", "m", "softening.opening"),
    BRC_KEPT_FIELD(edge_opening, brc_each_entry, 3, COEFF, NULL, "cohesion of faces", "m", "softening.edge"),
    BRC_KEPT_FIELD(open, brc_each_entry, 1, INT, NULL, "open faces", "-", "softening.open"),
    BRC_FIELD(lead, brc_each_entry, 1, INT, NULL, "cohesion of faces", "-"),
    BRC_KEPT_FIELD(n_open, brc_each_row, 1, INT, NULL, "open faces", "-", "softening.n_open"),
    BRC_FIELD(n_lead, brc_each_row, 1, INT, NULL, "list of open faces", "-"),
    BRC_FIELD(first, brc_each_row_end, 1, INT, NULL, "list of open faces", "-"),
    BRC_FIELD(sums, each_block_of_rows, 1, INT, NULL, "list of open faces", "-"),
    BRC_FIELD(face_row, each_face, 1, INT, NULL, "list of open faces", "-"),
    BRC_FIELD(face_entry, each_face, 1, INT, NULL, "list of open faces", "-"),
    BRC_KEPT_FIELD(reach, brc_each_row, 1, COEFF, NULL, "reach of open faces", "-", "softening.reach"),
    BRC_FIELD(shear_limit, brc_each_entry, 1, COEFF, slides, "limits of shear", "Pa"),
    BRC_FIELD(shear_energy, brc_each_entry, 1, COEFF, slides, "fracture energies in shear", "J"),
    BRC_FIELD(shear, brc_each_row, 1, COEFF, NULL, "shear moduli", "Pa"),
    BRC_KEPT_FIELD(rubbed, brc_each_row, 1, STATE, NULL, "friction of broken faces", "J", "softening.rubbed"),
};
BRC_FIELD_TABLE(brc_softening_fields, "cohesion of faces", BRC_LIFE_RUN, softens, rows);

static softening_faces *faces_of(const brc_simulation *s)
{
    return brc_dlsm_own_of(s)->softening;
}
BRC_READ(bool, brc_softening_is_on, faces_of(s) != NULL)
BRC_READ(bool, brc_softening_acts, faces_of(s) && faces_of(s)->any)

static brc_status make_passes(brc_simulation *s, softening_faces *f)
{
    const brc_scope run = brc_scope_of_run(s);
    brc_cell_scopes scopes;
    const brc_scope faces = {.owner = "cohesion of faces",
                             .base = f,
                             .tables = {&brc_softening_fields},
                             .outer = brc_cell_scopes_make(s, &run, &scopes)};
    const brc_pass_wanted wanted[] = {
        BRC_PASS(&f->gradient, "soft_gradient", NULL),
        BRC_PASS(&f->gradient_listed, "soft_gradient_listed", BRC_LISTED),
        BRC_PASS(&f->flux, "soft_flux", NULL),
        BRC_PASS(&f->flux_listed, "soft_flux_listed", BRC_LISTED),
        BRC_PASS(&f->take_force, "soft_take_force", "force"),
        BRC_PASS(&f->coast, "soft_coast", "n_faces"),
        BRC_PASS(&f->move, "soft_move", "n_faces is_last stiffen steepest friction retention release"),
        BRC_PASS(&f->measure, "soft_measure", "n_faces book release"),
        BRC_PASS(&f->book, "soft_book", "step"),
        BRC_PASS(&f->check, "soft_check", "share steepest screen shears slope shear_least"),
        BRC_PASS(&f->follow, "soft_follow", "share"),
        BRC_PASS(&f->begin, "soft_begin", "friction"),
        BRC_PASS(&f->count, "soft_count", NULL),
        BRC_PASS(&f->list, "soft_list", NULL),
        BRC_PASS(&f->energy, "soft_energy", NULL),
        BRC_PASS(&f->settle, "soft_settle", "step list")};
    return BRC_PASSES_MAKE(s, &faces, wanted);
}

/* Warns where E G_c / sigma_f^2 is too few cells, and of bonds whose cells give way less than the cohesion falls: those
 * snap open; tells where loads at notches want more cells. */
static brc_status warn_of_size(brc_simulation *s, const brc_strengths *strengths)
{
    brc_crack_lengths l;
    BRC_TRY(brc_crack_lengths_find(s, strengths, least_cells, &l));
    if (2 * l.n_below[0] > l.n ||
        100 * l.n_below[2] > l.n) /* strengths scatter: half of the bonds lie on either side */
        brc_log(s->context, BRC_LOG_WARNING,
                "fracture_energy: E G_c / sigma_f^2 is less than %g cells at %lld of %lld bonds (%.2g at least), below "
                "1 at %lld, which open at once: a crack "
                "costs about G_c per area only above; use cells of %.3g mm (they are of %.3g mm; notched parts: %.3g "
                "mm) or a lower strength",
                least_cells, (long long)l.n_below[0], (long long)l.n, l.ratio[0], (long long)l.n_below[2],
                1e3 * brc_crack_lengths_size(&l, least_cells), 1e3 * l.size,
                1e3 * brc_crack_lengths_size(&l, 2 * least_cells));
    else if (2 * l.n_below[1] > l.n)
        brc_log(s->context, BRC_LOG_INFO,
                "fracture_energy: E G_c / sigma_f^2 is less than %g cells at %lld of %lld bonds: a crack costs G_c per "
                "area, but a part with a notch, of cells that are not regular, "
                "bears some 5 to 11 %% too much; use cells of %.3g mm where that matters (they are of %.3g mm)",
                2 * least_cells, (long long)l.n_below[1], (long long)l.n,
                1e3 * brc_crack_lengths_size(&l, 2 * least_cells), 1e3 * l.size);
    brc_crack_lengths_tell(s, &l);
    brc_crack_lengths_free(&l);
    return brc_crack_range_tell(s, "cells");
}

/* Of a face in an interface; normal: its interface's, as long as their cosine (0: in none), out of this side or not. */
static void put_plane(double *record, const double normal[3], bool is_outward)
{
    const double cosine = brc_norm3(normal);
    if (!(cosine > 0)) return;
    record[COSINE] = -cosine; /* softening_record.cl */
    for (int c = 0; c < 3; ++c)
        record[SHIFT + c] = (is_outward ? 1 : -1) * normal[c] / cosine;
}

static brc_status upload_faces(brc_simulation *s, softening_faces *f, const brc_strengths *strengths)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t n_entries = layout->n_slots * layout->slice;
    BRC_LOCAL(s->context, WIDTH * n_entries, double, crack, "cohesion of faces");
    BRC_LOCAL(s->context, n_entries, int32_t, lead, "cohesion of faces");
    BRC_LOCAL(s->context, layout->n_rows, double, shear, "shear moduli");
    BRC_FREED double *normal = NULL;
    BRC_TRY(brc_interface_normals(s->context, s->scene, d, s->material_of_element, least_projected, &normal));
    for (int64_t k = 0; k < n_entries; ++k) {
        const int32_t h = layout->half_edge[k];
        if (h < 0 || !brc_domain_has(d, d->neighbour[d->twin[h]])) continue;
        crack[WIDTH * k + ENERGY] = strengths->energy[d->bond[h]] * brc_norm3(d->area_vector + 3 * (int64_t)h);
        crack[WIDTH * k + EXPONENTIAL] = strengths->exponential[d->bond[h]];
        if (normal) put_plane(crack + WIDTH * k, normal + 3 * (int64_t)d->bond[h], h == d->bond_half_edge[d->bond[h]]);
        lead[k] = d->neighbour[d->twin[h]] < d->neighbour[h];
    }
    for (int32_t r = 0; r < layout->n_rows; ++r)
        if (layout->element_of_row[r] >= 0) shear[r] = s->elastic[s->material_of_element[layout->element_of_row[r]]].mu;
    BRC_TRY(brc_upload_coeff(s, f->crack, crack, WIDTH * n_entries));
    BRC_TRY(brc_upload_int(f->lead, lead, n_entries));
    return brc_upload_coeff(s, f->shear, shear, layout->n_rows);
}

/* Limits and energies of faces that slide. */
static brc_status upload_shear(brc_simulation *s, softening_faces *f, const brc_strengths *strengths)
{
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t n_entries = layout->n_slots * layout->slice;
    const double whole = 2 * s->scene->fracture.cohesion * cos(s->scene->fracture.friction);
    if (!f->shear_limit) return BRC_OK;
    f->shear_least = INFINITY;
    BRC_LOCAL(s->context, n_entries, double, limit, "limits of shear");
    BRC_LOCAL(s->context, n_entries, double, energy, "fracture energies in shear");
    for (int64_t k = 0; k < n_entries; ++k) {
        const int32_t h = layout->half_edge[k];
        if (h < 0) continue;
        f->shear_least = fmin(f->shear_least, whole * strengths->factor[d->bond[h]]);
        if (!brc_domain_has(d, d->neighbour[d->twin[h]])) continue;
        limit[k] = (strengths->joint[d->bond[h]] ? -whole : whole) * strengths->factor[d->bond[h]];
        energy[k] = strengths->shear_energy[d->bond[h]] * brc_norm3(d->area_vector + 3 * (int64_t)h);
    }
    BRC_TRY(brc_upload_coeff(s, f->shear_limit, limit, n_entries));
    return brc_upload_coeff(s, f->shear_energy, energy, n_entries);
}

brc_status brc_softening_create(brc_simulation *s, const brc_strengths *strengths)
{
    if (!strengths->softens) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_dlsm_own_of(s)->softening, 1, "cohesion of faces"));
    BRC_TRY(make_passes(s, brc_dlsm_own_of(s)->softening));
    BRC_TRY(brc_scan_kernels_find(s->device, &brc_dlsm_own_of(s)->softening->scan));
    BRC_TRY(warn_of_size(s, strengths));
    BRC_TRY(brc_fields_create(s->device, &brc_softening_fields, &s->wants, brc_dlsm_own_of(s)->softening));
    BRC_TRY(brc_fields_create(s->device, &brc_open_list_fields, &s->wants, &brc_dlsm_own_of(s)->softening->around));
    BRC_TRY(upload_shear(s, brc_dlsm_own_of(s)->softening, strengths));
    return upload_faces(s, brc_dlsm_own_of(s)->softening, strengths);
}

void brc_softening_free(brc_simulation *s)
{
    softening_faces *f = faces_of(s);
    if (!f) return;
    brc_fields_free(&brc_softening_fields, f);
    brc_fields_free(&brc_open_list_fields, &f->around);
    brc_memory_free(f);
    brc_dlsm_own_of(s)->softening = NULL;
}

/* ---- an evaluation ---- */

/* Cells with open faces, which are ring 0 of a list that is there, where the pass before went over all or that list. */
static brc_status over_open(brc_simulation *s, const brc_pass *whole, const brc_pass *listed, const brc_ring_list *list,
                            int ring)
{
    const softening_faces *f = faces_of(s);
    const bool is_there = f->is_listed && f->lists == brc_contact_lists(s);
    if (is_there && (list == &f->around || brc_pass_is_whole(s, list, ring))) list = &f->around, ring = 0;
    return brc_pass_over(s, whole, listed, list, ring, NULL, NULL);
}

brc_status brc_softening_gradient(brc_simulation *s, const brc_ring_list *list, int ring)
{
    const softening_faces *f = faces_of(s);
    return f && f->any ? over_open(s, f->gradient, f->gradient_listed, list, ring) : BRC_OK;
}

brc_status brc_softening_flux(brc_simulation *s, const brc_ring_list *list, int ring)
{
    const softening_faces *f = faces_of(s);
    return f && f->any ? over_open(s, f->flux, f->flux_listed, list, ring) : BRC_OK;
}

brc_status brc_softening_force(brc_simulation *s, brc_buffer *force)
{
    softening_faces *f = faces_of(s);
    if (!f || !f->any) return BRC_OK;
    return BRC_RUN(f->take_force, s->n_groups, {"force", BRC_BUF(force)});
}

brc_status brc_softening_energy(brc_simulation *s)
{
    softening_faces *f = faces_of(s);
    if (!f || !f->any) return BRC_OK;
    return brc_pass_run(f->energy, s->n_groups);
}

/* ---- a step ---- */

/* The open faces as they are now. */
static brc_status list_faces(brc_simulation *s)
{
    softening_faces *f = faces_of(s);
    const int32_t n = s->layout->n_rows;
    int64_t total = 0;
    if (f->has_faces) return BRC_OK;
    if (!f->is_counted) BRC_TRY(brc_pass_run(f->count, n));
    BRC_TRY(brc_scan(&f->scan, f->n_lead, n, f->sums, f->first, &total));
    BRC_TRY(brc_pass_run(f->list, n));
    f->n_faces = (int32_t)total;
    f->is_counted = f->has_faces = true;
    return BRC_OK;
}
/* Work-items of a pass over the open faces. */
static int32_t face_items(const brc_simulation *s)
{
    return brc_blocks(faces_of(s)->n_faces, brc_device_lanes(s->device));
}

static double release_of(const brc_simulation *s)
{
    return s->scene->fracture.closure ? clear : 0;
}
/* Faces that slide rub in scenes without contact too. */
static double friction_of(const brc_simulation *s)
{
    if (s->contact) return s->scene->contact.law.friction;
    return faces_of(s)->shear_limit ? brc_scene_side_friction(s->scene) : 0;
}

static brc_status sweep(brc_simulation *s, int k)
{
    softening_faces *f = faces_of(s);
    return BRC_RUN(f->move, face_items(s), {"n_faces", BRC_INT(f->n_faces)}, {"is_last", BRC_INT(k == N_SWEEPS - 1)},
                   {"stiffen", BRC_COEFF(stiffen)}, {"steepest", BRC_COEFF(steepest)},
                   {"friction", BRC_COEFF(friction_of(s))}, {"retention", BRC_COEFF(retention)},
                   {"release", BRC_COEFF(release_of(s))});
}

/* Cells with open faces, whose fluxes are wanted, and around them those whose stresses, and those whose gradients go
 * into them; what touches one of them presses on it as its own gradient says. */
static brc_status list_around(brc_simulation *s)
{
    softening_faces *f = faces_of(s);
    brc_rings *rings = brc_cell_breaks_rings(s);
    if (f->is_listed && f->lists == brc_contact_lists(s)) return BRC_OK;
    BRC_TRY(brc_rings_seed(s, rings, f->n_open));
    BRC_TRY(brc_contact_list_around(s, brc_rings_touched(rings)));
    BRC_TRY(brc_rings_spread(s, rings, 1, 2));
    BRC_TRY(brc_contact_spread(s, brc_rings_level(rings), 1 + 2));
    f->is_listed = true;
    f->lists = brc_contact_lists(s);
    return brc_rings_close(s, rings, BRC_RINGS_DROP, &f->around);
}

brc_status brc_softening_move(brc_simulation *s)
{
    softening_faces *f = faces_of(s);
    if (!f || !f->any) return BRC_OK;
    const bool whole = brc_contact_is_due(s);
    if (!whole) BRC_TRY(list_around(s));
    BRC_TRY(list_faces(s));
    BRC_TRY(BRC_RUN(f->coast, face_items(s), {"n_faces", BRC_INT(f->n_faces)}));
    for (int k = 0; k < N_SWEEPS; ++k) { /* between sweeps only the openings change */
        BRC_TRY(s->model->fluxes_of_state(s, whole ? NULL : &f->around, k == 0));
        BRC_TRY(sweep(s, k));
    }
    return BRC_OK;
}

static brc_status measure(brc_simulation *s, int book)
{
    softening_faces *f = faces_of(s);
    BRC_TRY(list_faces(s));
    return BRC_RUN(f->measure, face_items(s), {"n_faces", BRC_INT(f->n_faces)}, {"book", BRC_INT(book)},
                   {"release", BRC_COEFF(release_of(s))});
}

brc_status brc_softening_recount(brc_simulation *s)
{
    softening_faces *f = faces_of(s);
    if (!f) return BRC_OK;
    f->is_listed = f->has_faces = false;
    f->is_counted = true;
    return brc_pass_run(f->count, s->layout->n_rows);
}

brc_status brc_softening_refresh(brc_simulation *s)
{
    return brc_softening_is_on(s) ? measure(s, 0) : BRC_OK;
}

brc_status brc_softening_step(brc_simulation *s, double share, double *n_ended)
{
    softening_faces *f = faces_of(s);
    brc_buffer *found = brc_cell_breaks_array(s, "found");
    const int32_t n = s->layout->n_rows;
    double candidates, brittle = 0;
    *n_ended = 0;
    if (f->any) { /* what opened before this step */
        BRC_TRY(measure(s, 1));
        BRC_TRY(BRC_RUN(f->book, n, {"step", BRC_INT((int32_t)brc_fracture_moment(s))}));
        BRC_TRY(brc_vector_sum(s, found, n, n_ended));
    }
    BRC_TRY(BRC_RUN(f->check, s->n_groups, {"share", BRC_COEFF(share)}, {"steepest", BRC_COEFF(steepest)},
                    {"screen", BRC_COEFF(screen)}, {"shears", BRC_INT(f->shear_limit != NULL)},
                    {"slope", BRC_COEFF(sin(s->scene->fracture.friction))},
                    {"shear_least", BRC_COEFF(f->shear_least)}));
    if (s->scene->n_interfaces > 0 && f->any) BRC_TRY(BRC_RUN(f->follow, n, {"share", BRC_COEFF(share)}));
    BRC_TRY(brc_vector_sum(s, found, n, &candidates));
    if (candidates > 0) {
        f->any = true;
        BRC_TRY(BRC_RUN(f->begin, n, {"friction", BRC_COEFF(friction_of(s))}));
        BRC_TRY(brc_vector_sum(s, found, n, &brittle));
        BRC_TRY(brc_softening_recount(s));
    }
    *n_ended += brittle;
    return BRC_OK;
}

brc_status brc_softening_settle(brc_simulation *s, const brc_ring_list *around)
{
    softening_faces *f = faces_of(s);
    const int32_t n = around->n[0];
    if (!f) return BRC_OK;
    return BRC_RUN(f->settle, n, {"step", BRC_INT(brc_fracture_moment(s))}, {"list", BRC_BUF(around->upto[0])});
}

/* Broken faces whose sides still bear on each other are broken bonds that have a neighbour (stored_breaks.c points all
 * broken ones home). */
static brc_status rejoin(brc_simulation *s, softening_faces *f)
{
    const brc_layout *layout = s->layout;
    const int64_t n = layout->n_slots * layout->slice;
    BRC_LOCAL(s->context, n, int32_t, neighbour, "neighbours");
    BRC_LOCAL(s->context, n, int32_t, open, "open faces");
    BRC_LOCAL(s->context, n, double, alive, "unbroken bonds");
    BRC_TRY(brc_buffer_read(brc_neighbour_of(s), 0, neighbour, 4 * n));
    BRC_TRY(brc_buffer_read(f->open, 0, open, 4 * n));
    BRC_TRY(brc_download(s, brc_cell_breaks_array(s, "alive"), brc_coeff_bytes(s), alive, n));
    for (int64_t k = 0; k < n; ++k)
        if (layout->half_edge[k] >= 0 && open[k] == APART && alive[k] > 0)
            neighbour[k] = layout->row_of_element[s->domain->neighbour[layout->half_edge[k]]];
    return brc_buffer_write(brc_neighbour_of(s), 0, neighbour, 4 * n);
}

brc_status brc_softening_store_state(brc_simulation *s, brc_state_store *store)
{
    softening_faces *f = faces_of(s);
    if (!f) return BRC_OK;
    f->is_listed = f->is_counted = f->has_faces = false;
    const brc_state_entry changed[] = {
        {"softening.limit", brc_cell_breaks_array(s, "limit"), BRC_ENTRIES, BRC_OF_COEFF, 1, NULL},
        {"softening.least", brc_cell_breaks_array(s, "least"), BRC_ROWS, BRC_OF_COEFF, 1, NULL},
    };
    BRC_TRY(brc_store_flag(store, "softening.any", &f->any));
    BRC_TRY(brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_softening_fields, .owner = f}));
    BRC_TRY(brc_store_entries(s, store, sizeof changed / sizeof *changed, changed));
    return store->loading ? rejoin(s, f) : BRC_OK;
}

brc_status brc_softening_friction(brc_simulation *s, double *out)
{
    const softening_faces *f = faces_of(s);
    *out = 0;
    return f && f->any ? brc_vector_sum(s, f->rubbed, s->layout->n_rows, out) : BRC_OK;
}

/* ---- what came of it ---- */

brc_status brc_softening_find_report(brc_simulation *s, brc_softening_report *out)
{
    softening_faces *f = faces_of(s);
    const brc_layout *layout = s->layout;
    const brc_domain *d = s->domain;
    const int64_t n_entries = layout->n_slots * layout->slice;
    *out = (brc_softening_report){0};
    if (!f || !f->any) return BRC_OK;
    const int bytes = brc_coeff_bytes(s);
    BRC_LOCAL(s->context, WIDTH * n_entries, double, crack, "cohesion of faces");
    BRC_LOCAL(s->context, n_entries, double, alive, "unbroken bonds");
    BRC_LOCAL(s->context, n_entries, int32_t, open, "open faces");
    BRC_TRY(brc_buffer_read(f->open, 0, open, 4 * n_entries));
    BRC_TRY(brc_download(s, f->crack, bytes, crack, WIDTH * n_entries));
    BRC_TRY(brc_download(s, brc_cell_breaks_array(s, "alive"), bytes, alive, n_entries));
    BRC_LOCAL(s->context, n_entries, int32_t, ended, "ended faces");
    for (int64_t k = 0; k < n_entries; ++k) {
        const int32_t h = layout->half_edge[k];
        const double *own = crack + WIDTH * k;
        if (h < 0 || !(own[START] > 0) || d->neighbour[d->twin[h]] > d->neighbour[h]) continue;
        out->n_opened += 1;
        out->spent += own[SPENT];
        if (alive[k] > 0 && open[k] != APART)
            out->unfinished += own[SPENT];
        else
            ended[out->n_ended++] = (int32_t)k;
    }
    BRC_LOCAL(s->context, 6 * out->n_ended, double, face, "ended faces");
    BRC_LOCAL(s->context, out->n_ended, int32_t, half_edge, "ended faces");
    for (int64_t i = 0; i < out->n_ended; ++i)
        half_edge[i] = layout->half_edge[ended[i]];
    BRC_TRY(brc_domain_faces(s->context, d, out->n_ended, half_edge, face));
    for (int64_t i = 0; i < out->n_ended; ++i) {
        const double *own = crack + WIDTH * (int64_t)ended[i];
        out->area += own[TILT] * fabs(own[COSINE]) * brc_norm3(face + 6 * i);
    }
    return BRC_OK;
}
