/* Contact inside its own files. */
#ifndef BRC_SOLVER_CONTACT_INTERNAL_H
#define BRC_SOLVER_CONTACT_INTERNAL_H

#include "../../utilities/scans.h"
#include "contact.h"

enum { BRC_CONTACT_RESULT = 8, BRC_CONTACT_PAIRS = 256 }; /* as in contact_search.cl, contact.cl */
enum {
    BRC_CONTACT_BLOCK = 256,
    BRC_CONTACT_PART = 16,
    BRC_CONTACT_DRIFT = 14,
    BRC_CONTACT_MOVED = 6
}; /* as in contact_motion.cl */

/* Which pairs there are (contact_search.cl); kept twice, so that pairs find what they remember. */
typedef struct brc_contact_list {
    int32_t n_listed, n_pairs, n_with_pairs; /* n_with_pairs: listed elements that have pairs, of this rank's */
    int64_t entry_room, pair_room;
    brc_buffer *list, *slot_of, *start, *used, *entry, *pair, *with_pairs, *ends, *history;
} brc_contact_list;

struct brc_contact_state {
    struct {
        brc_pass *extent, *largest, *drift, *drift_mean, *moved, *expose, *list, *keys, *buckets, *again, *kept, *keep,
            *changed, *most, *spread, *count, *fill, *with_pairs, *own_pairs, *other_pairs, *pack, *carry;
        brc_pass *spheres, *gather_turning, *marked;
        brc_pass *cells, *gather_moments, *gather_forces, *striker_parts, *striker_load, *pieces, *pieces_moved;
        brc_pass *detach, *pose, *turn, *spin_energy;
    } pass;
    brc_scan_kernels scan;
    bool is_linear;   /* spheres: the law's normal force */
    bool affine;      /* dlsm: elements follow I + H; else they turn with quaternions of their own */
    int32_t width;    /* numbers of a moment: 9, else 3 */
    int pose;         /* how elements stand: 0 spheres, 1 by I + H, 2 by their rotation (contact_motion.cl) */
    double skin;      /* of the list there is [m] */
    double largest;   /* radius of any element at the last search of all [m] */
    double size;      /* mean size of an element [m] */
    double middle[3]; /* of the domain: places are relative to it [m] */
    int32_t n_pieces; /* of strikers */
    double span;      /* how far from the middle elements are expected [m] */
    /* of rows; id, material, mass, size and bears also of pieces, after them */
    brc_buffer *place, *bounding_radius, *id, *body, *material, *mass, *size_of, *bears, *original, *exposed, *built,
        *posed, *clear;
    /* polyhedra (convex_overlap.h) and pieces */
    brc_buffer *corner, *plane, *loop_start, *loop, *radius, *corner_start, *face_start;
    brc_buffer *piece_striker, *piece_kind, *piece_radius, *piece_own, *piece;
    brc_buffer *part; /* forces on strikers by blocks of pairs */
    int64_t part_room;
    /* rigid cells of dlsm (contact_rigid.c) */
    bool detaches;
    double n_rigid;
    brc_buffer
        *loaded; /* of rows: 1 where a load of any stage acts on a face of the element, which never becomes rigid */
    brc_buffer *rigid, *inertia, *turned, *momentum, *torque, *way;
    struct brc_ring_list
        *bonded; /* where most cells have none: those that still have bonds, and some that lost theirs since */
    brc_buffer *stored, *lost_friction, *lost_impact;
    brc_buffer *law; /* [n_materials][n_materials][BRC_CONTACT_LAW] */
    double *law_of;  /* the same on the host */
    /* search */
    brc_buffer *moved, *drift_part, *drift, *sums, *key[2], *row[2], *digits, *first, *last, *count, *owned,
        *pair_start;
    brc_buffer *seen,
        *fresh; /* [n_rows]: bonds that elements had lost when they were last listed, and who has lost one since */
    brc_buffer *again, *redo; /* of listed elements */
    brc_contact_list now, before;
    int64_t quiet;           /* steps for which nothing can have moved far enough */
    brc_buffer *most_moved;  /* the largest that the probes of a stretch found (../fracture/ahead.h) */
    int n_probes, n_trusted; /* probes of the stretch; how many may be put off */
    double most_pushed;      /* by these strikers [m/s^2] */
    int64_t searches, lists; /* searches of all; lists that were made, those of breaks too */
    bool due;                /* dlsm: look for pairs as soon as the gradients of this evaluation are there */
    /* pairs */
    brc_buffer *touch, *result; /* of pairs */
    int64_t result_room;
    brc_buffer *packed, *packed_at; /* in bodies that break: results of those pairs of the list before that touched, on
                                       their way to the one of now */
    int64_t packed_room, packed_at_room;
    brc_buffer *flag, *flag_start, *todo; /* of pairs; todo: those that the last breaks may have changed */
    int64_t todo_room, sums_room;
    int32_t n_todo;
    struct brc_rows_among *listed;   /* of several ranks: elements of the list (device/shares.h) */
    struct brc_contact_share *share; /* of several ranks: pairs (contact_share.c) */
    bool always_whole; /* for comparison: look for all pairs after breaks, and let openings follow by evaluations of
                          all */
    double energy_from_breaks; /* energy that surfaces held when their bond broke [J] */
};

/* ---- contact_fields.c ---- */
extern const brc_field_table brc_contact_fields, brc_contact_sum_fields, brc_contact_grid_fields,
    brc_contact_bucket_fields, brc_contact_slot_fields, brc_contact_listed_fields, brc_contact_entry_fields,
    brc_contact_pair_fields, brc_contact_result_fields, brc_contact_part_fields, brc_contact_packed_at_fields,
    brc_contact_packed_fields, brc_contact_changed_fields;
void brc_contact_fields_free(brc_contact_state *contact);
/* For n things, and a little more, since cracks grow; for n exposed elements, at most all rows; and cells of the grid
 * for them. */
int64_t brc_contact_room(int64_t n);
int64_t brc_contact_exposed_room(const brc_wants *wants, int64_t n);
int64_t brc_contact_buckets(int64_t n);

/* Contact, the list of now and the one before, strikers, numbers of the scene; the state of the elements outermost, or,
 * before all, in *state. They must stay where they are. */
typedef struct brc_contact_scopes {
    brc_scope run, scene, strikers, contact, now, before, state;
} brc_contact_scopes;
void brc_contact_scopes_make(const brc_simulation *s, brc_contact_scopes *out);

/* ---- contact_setup.c ---- */
/* Arrays of rows, laws of materials, who is exposed at the start. */
brc_status brc_contact_setup(brc_simulation *s);

/* ---- contact_share.c ---- */
/* What passes over pairs go over: numbers of pairs, or all. */
typedef struct brc_contact_items {
    int32_t n;
    brc_buffer *todo; /* [n] */
    bool whole;       /* all, whatever todo says */
    struct brc_rows_among *among;
} brc_contact_items;
/* All pairs, or those of c->todo. */
brc_contact_items brc_contact_items_of(const brc_simulation *s, bool whole);
/* The listed elements, c->listed: what the search for pairs keeps to. */
brc_status brc_contact_share_list(brc_simulation *s);
/* Of n ascending slots in a list those of this rank's elements; *n: how many. */
brc_status brc_contact_keep_slots(brc_simulation *s, brc_buffer *list, int64_t *n);
/* What each rank found for its slots: how many are near; entries, how many, in how many the id is the lower one. */
brc_status brc_contact_bring_counts(brc_simulation *s);
brc_status brc_contact_bring_entries(brc_simulation *s);
/* A pass over c->now.with_pairs. request: or NULL. */
brc_status brc_contact_run_gather(const brc_simulation *s, const brc_pass *pass, const brc_force_request *request,
                                  const brc_given *given);
/* After the list of pairs is made; after c->todo is. */
brc_status brc_contact_share_pairs(brc_simulation *s);
brc_status brc_contact_share_todo(brc_simulation *s);
/* Before the host reads touch, result or history of all pairs. */
brc_status brc_contact_bring_pairs(brc_simulation *s);
/* Results of touching pairs that other ranks ask for, after pairs are evaluated. */
brc_status brc_contact_bring_sent(brc_simulation *s);
void brc_contact_share_free(brc_contact_state *contact);

/* ---- contact_shapes.c ---- */
brc_status brc_contact_shapes(brc_simulation *s);

/* ---- contact_rigid.c ---- */
brc_status brc_contact_rigid_create(brc_simulation *s);
/* Cells without bonds become rigid. */
brc_status brc_contact_detach(brc_simulation *s);

/* ---- contact_step.c ---- */
/* Stiffest normal spring of element e against material `other` [N/m]. */
double brc_contact_stiffest_normal(const brc_simulation *s, int64_t e, int32_t other);

/* ---- contact_bearing.c ---- */
/* What surfaces of elements bear in the time step, c->bears [n_rows + pieces][4]: the most energy of an overlap over
 * V^2 / 2 [N/m^5], and the stiffest tangential spring [N/m], between elements and the same on strikers. Cells whose
 * neighbours span little to one side, or whose faces are wide beside their volume, would want a smaller step for
 * springs as stiff as the solid. All ranks. */
brc_status brc_contact_set_bearing(brc_simulation *s);

/* ---- contact.c ---- */
/* Elements that lost bonds are exposed; who lost one since the last time is c->fresh. */
brc_status brc_contact_expose(brc_simulation *s);

/* ---- contact_moves.c ---- */
enum { BRC_CONTACT_QUIET = 64 }; /* steps between probes at most */
/* How far and how fast elements and pieces of strikers moved since the list was made: columns of contact_moved and
 * contact_pieces_moved. */
typedef struct brc_contact_survey {
    double element[BRC_CONTACT_MOVED], piece[BRC_CONTACT_MOVED];
} brc_contact_survey;
/* Now; or of what a pass left in `moved`, of n_pieces pieces too. */
brc_status brc_contact_take_survey(brc_simulation *s, brc_contact_survey *out);
brc_status brc_contact_read_survey(brc_simulation *s, brc_buffer *moved, int32_t n_pieces, brc_contact_survey *out);

/* ---- contact_search.c ---- */
brc_status brc_contact_search_create(brc_simulation *s);
/* The list after breaks, for the same places: what belongs to elements that lost bonds (c->fresh) and to who is near
 * them is looked for again, the rest goes over, results of pairs too. c->todo: pairs of those elements and of `touched`
 * [n_rows] ones (rings.h). */
brc_status brc_contact_list_more(brc_simulation *s, brc_buffer *touched);
/* The same by a search of all. */
brc_status brc_contact_search_more(brc_simulation *s, brc_buffer *touched);
/* Steps until the next probe, from how far and how fast things moved since the list was made; *due: the list is too
 * old, or soon; *past: it no longer holds. */
brc_status brc_contact_probe(brc_simulation *s, bool *due, bool *past);
/* The same within a stretch, which asks at its end. */
brc_status brc_contact_put_off_probe(brc_simulation *s);
/* Evaluate pairs into c->result, all or those of c->todo; dt: of the step that ended, 0: again. broke: for the breaks
 * of this step. */
brc_status brc_contact_pairs(brc_simulation *s, double dt, bool whole, bool broke);

#endif
