#include "closed_faces.h"
#include "brittle_interfaces.h"
#include "dlsm_internal.h"
#include "cell_softening.h"
#include "rims.h"
#include <limits.h>

/* Gap and slide over the length of the bond from which on the sides of a broken face stand clear of each other. */
static const double clear = 0.5;

enum { LOAD = 12 }; /* CLOSED_LOAD of closed_faces.cl */

struct brc_closed_faces {
    brc_pass *keep, *probe_pass, *follow, *press, *flux, *force, *energy, *again, *delta_pass;
    brc_buffer *closed, *spring, *overlap, *slide; /* [n_slots][C], slide [n_slots][3][C], NULL without friction */
    brc_buffer *place;                             /* [n_rows][3] */
    brc_buffer *next, *presses, *probe, *near;     /* [n_rows] */
    brc_buffer *load, *delta;                      /* [n_rows][LOAD] */
    brc_buffer *held, *rubbed;                     /* [n_rows] */
    bool any;                                      /* some bond has broken */
    bool all;                                      /* all faces are looked at */
};
typedef struct brc_closed_faces closed_faces;

static closed_faces *faces_of(const brc_simulation *s)
{
    return brc_dlsm_own_of(s)->closed;
}

/* In static stages and modes the sides know nothing of each other, as other surfaces (contact.c). */
static bool is_disabled(const brc_simulation *s)
{
    return brc_simulation_stage(s) < 0 || brc_current_stage(s)->solver != BRC_SOLVER_DYNAMIC;
}
bool brc_closed_faces_act(const brc_simulation *s, const brc_force_request *r)
{
    const closed_faces *f = faces_of(s);
    return f && f->any && !is_disabled(s) && !r->homogeneous && r->displacement == brc_displacement_of(s);
}

static double friction_of(const brc_simulation *s)
{
    return brc_scene_side_friction(s->scene);
}
static int32_t moment_of(const brc_simulation *s)
{
    return (int32_t)brc_fracture_moment(s);
}

/* ---- what is made once ---- */

static brc_status upload_places(brc_simulation *s, closed_faces *f)
{
    const int64_t n = s->layout->n_rows;
    BRC_LOCAL(s->context, 3 * n, double, place, "places of elements");
    for (int64_t r = 0; r < n; ++r)
        for (int c = 0; c < 3 && s->layout->element_of_row[r] >= 0; ++c)
            place[3 * r + c] = s->domain->position[3 * (int64_t)s->layout->element_of_row[r] + c];
    return brc_upload_state(s, f->place, place, 3 * n);
}

static brc_status upload_next(brc_simulation *s, closed_faces *f)
{
    const int64_t n = s->layout->n_rows;
    BRC_LOCAL(s->context, n, int32_t, next, "broken faces");
    for (int64_t r = 0; r < n; ++r)
        next[r] = INT_MAX; /* CLOSED_NEVER */
    return brc_upload_int(f->next, next, n);
}

BRC_WANTED(shuts, brc_scene_shuts(w->scene) && brc_wants_deforming(w) && !w->softens)
BRC_WANTED(rubs, brc_scene_side_friction(w->scene) > 0)

#define AT(member) BRC_FIELD_AT(closed_faces, member)
static const brc_field_row rows[] = {
    BRC_PART_KEPT(closed, brc_each_entry, 1, INT, NULL, "broken faces", "-", "closed.faces", BRC_KEEP_BROKEN),
    BRC_PART_KEPT(spring, brc_each_entry, 1, COEFF, NULL, "springs of broken faces", "N/m", "closed.spring",
                  BRC_KEEP_BROKEN),
    BRC_PART_KEPT(overlap, brc_each_entry, 1, COEFF, NULL, "broken faces", "m", "closed.overlap", BRC_KEEP_BROKEN),
    BRC_PART_KEPT(slide, brc_each_entry, 3, COEFF, rubs, "friction of broken faces", "m", "closed.slide",
                  BRC_KEEP_BROKEN),
    BRC_FIELD(place, brc_each_row, 3, STATE, NULL, "places of elements", "m"),
    BRC_KEPT_FIELD(next, brc_each_row, 1, INT, NULL, "broken faces", "-", "closed.next"),
    BRC_FIELD(presses, brc_each_row, 1, INT, NULL, "broken faces", "-"),
    BRC_FIELD(probe, brc_each_row, 1, INT, NULL, "broken faces", "-"),
    BRC_FIELD(near, brc_each_row, 1, INT, NULL, "broken faces", "-"),
    BRC_FIELD(load, brc_each_row, LOAD, COEFF, NULL, "forces of broken faces", "N"),
    BRC_FIELD(delta, brc_each_row, LOAD, COEFF, NULL, "forces of broken faces", "N"),
    BRC_FIELD(held, brc_each_row, 1, STATE, NULL, "energy of broken faces", "J"),
    BRC_KEPT_FIELD(rubbed, brc_each_row, 1, STATE, NULL, "friction of broken faces", "J", "closed.rubbed"),
};
BRC_FIELD_TABLE(brc_closed_face_fields, "broken faces that bear", BRC_LIFE_RUN, shuts, rows);

static brc_status make_passes(brc_simulation *s, closed_faces *f)
{
    const brc_scope run = brc_scope_of_run(s);
    brc_cell_scopes scopes;
    const brc_scope interfaces = brc_scope_of_brittle_interfaces(s, brc_cell_scopes_make(s, &run, &scopes));
    const brc_scope faces = {
        .owner = "broken faces", .base = f, .tables = {&brc_closed_face_fields}, .outer = &interfaces};
    const brc_pass_wanted wanted[] = {BRC_PASS(&f->keep, "closed_keep", NULL),
                                      BRC_PASS(&f->probe_pass, "closed_probe", "moment"),
                                      BRC_PASS(&f->follow, "closed_follow", "moment all moves clear friction"),
                                      BRC_PASS(&f->press, "closed_press", "friction"),
                                      BRC_PASS(&f->again, "closed_again", "moment friction"),
                                      BRC_PASS(&f->delta_pass, "closed_delta", "moment half_kick")};
    BRC_TRY(BRC_PASSES_MAKE(s, &faces, wanted));
    const brc_scope sums = brc_scope_of_sums(s, &faces), deltas = brc_scope_of_deltas(s, &faces),
                    request = brc_scope_of_request(&faces);
    BRC_TRY(BRC_PASSES(s, &sums, BRC_PASS(&f->energy, "closed_energy", NULL)));
    BRC_TRY(BRC_PASSES(s, &deltas, BRC_PASS(&f->flux, "closed_flux", "listed list fluxes")));
    return BRC_PASSES(s, &request, BRC_PASS(&f->force, "closed_force", "listed list"));
}

brc_status brc_closed_faces_create(brc_simulation *s)
{
    if (!shuts(&s->wants)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &brc_dlsm_own_of(s)->closed, 1, "broken faces"));
    closed_faces *f = brc_dlsm_own_of(s)->closed;
    BRC_TRY(make_passes(s, f));
    BRC_TRY(brc_fields_create(s->device, &brc_closed_face_fields, &s->wants, f));
    BRC_TRY(upload_next(s, f));
    return upload_places(s, f);
}

void brc_closed_faces_free(brc_simulation *s)
{
    closed_faces *f = faces_of(s);
    if (!f) return;
    brc_fields_free(&brc_closed_face_fields, f);
    brc_memory_free(f);
    brc_dlsm_own_of(s)->closed = NULL;
}

/* ---- an evaluation ---- */

brc_status brc_closed_faces_press(brc_simulation *s, const brc_force_request *r)
{
    closed_faces *f = faces_of(s);
    if (!brc_closed_faces_act(s, r) || r->rings) return BRC_OK;
    const bool moves = r->book == BRC_BOOK_WORK;
    BRC_TRY(brc_buffer_fill_zero(f->presses));
    BRC_TRY(BRC_RUN(f->follow, s->n_groups, {"moment", BRC_INT(moment_of(s))}, {"all", BRC_INT(f->all ? 1 : 0)},
                    {"moves", BRC_INT(moves ? 1 : 0)}, {"clear", BRC_COEFF(clear)},
                    {"friction", BRC_COEFF(friction_of(s))}));
    if (moves) f->all = false;
    return BRC_RUN(f->press, s->n_groups, {"friction", BRC_COEFF(friction_of(s))});
}

brc_status brc_closed_faces_flux(brc_simulation *s, const brc_force_request *r, const brc_ring_list *list, int ring)
{
    const closed_faces *f = faces_of(s);
    if (!brc_closed_faces_act(s, r)) return BRC_OK;
    const brc_rings *rings = brc_cell_breaks_rings(s);
    const bool whole = brc_pass_is_whole(s, list, ring), deltas = r->rings && brc_rims_add(s, r->rings);
    const int32_t n = whole ? s->n_groups : list->n[ring];
    return BRC_RUN(f->flux, n, {"listed", BRC_INT(!whole)}, {"list", BRC_BUF(whole ? NULL : list->upto[ring])},
                   {"fluxes", BRC_INT(deltas ? brc_rims_records(rings) : 0)});
}

brc_status brc_closed_faces_force(brc_simulation *s, const brc_force_request *r, const brc_ring_list *list, int ring)
{
    const closed_faces *f = faces_of(s);
    if (!brc_closed_faces_act(s, r)) return BRC_OK;
    const bool whole = brc_pass_is_whole(s, list, ring);
    const int32_t n = whole ? s->n_groups : list->n[ring];
    return BRC_RUN_ON(f->force, n, r, NULL, {"listed", BRC_INT(!whole)},
                      {"list", BRC_BUF(whole ? NULL : list->upto[ring])});
}

/* ---- a step with breaks ---- */

brc_status brc_closed_faces_keep(brc_simulation *s)
{
    closed_faces *f = faces_of(s);
    if (!f || is_disabled(s)) return BRC_OK;
    f->any = true;
    return brc_pass_run(f->keep, s->n_groups);
}

brc_status brc_closed_faces_probe(brc_simulation *s)
{
    const closed_faces *f = faces_of(s);
    if (!f || is_disabled(s)) return BRC_OK;
    return BRC_RUN(f->probe_pass, s->n_groups, {"moment", BRC_INT(moment_of(s))});
}

brc_status brc_closed_faces_change(brc_simulation *s, double half_kick)
{
    const closed_faces *f = faces_of(s);
    if (!f || is_disabled(s)) return BRC_OK;
    BRC_TRY(BRC_RUN(f->again, s->n_groups, {"moment", BRC_INT(moment_of(s))}, {"friction", BRC_COEFF(friction_of(s))}));
    return BRC_RUN(f->delta_pass, s->n_groups, {"moment", BRC_INT(moment_of(s))}, {"half_kick", BRC_STATE(half_kick)});
}

/* ---- what it knows ---- */

brc_status brc_closed_faces_restart(brc_simulation *s)
{
    if (faces_of(s)) faces_of(s)->all = true;
    return BRC_OK;
}

brc_status brc_closed_faces_stored(brc_simulation *s, double *out)
{
    const closed_faces *f = faces_of(s);
    const int32_t n = s->layout->n_rows;
    *out = 0;
    if (!f || !f->any || is_disabled(s)) return BRC_OK;
    BRC_TRY(brc_pass_run(f->energy, n));
    return brc_vector_sum_later(s, brc_kinetic_of(s), n, out);
}

brc_status brc_closed_faces_friction(brc_simulation *s, double *out)
{
    const closed_faces *f = faces_of(s);
    *out = 0;
    return f && f->any ? brc_vector_sum(s, f->rubbed, s->layout->n_rows, out) : BRC_OK;
}

brc_status brc_closed_faces_store_state(brc_simulation *s, brc_state_store *store, const brc_chosen *bonds)
{
    closed_faces *f = faces_of(s);
    if (!f) return BRC_OK;
    BRC_TRY(brc_store_flag(store, "closed.any", &f->any));
    BRC_TRY(brc_store_flag(store, "closed.all", &f->all));
    return brc_store_fields(s, store, &(brc_kept_fields){.table = &brc_closed_face_fields, .owner = f, .bonds = bonds});
}
