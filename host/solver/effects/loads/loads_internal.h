/* Loads of a stage, for the files of this folder. */
#ifndef BRC_SOLVER_LOADS_INTERNAL_H
#define BRC_SOLVER_LOADS_INTERNAL_H

#include "loads.h"

/* Held faces grouped by element, one entry list per load (held_faces.c). */
typedef struct brc_held_load {
    int32_t load; /* index into the stage's loads */
    int32_t n;
    double factor; /* that the faces are at; NAN: not known */
    double jump;   /* displacements: the farthest a face stands from where the stage puts it at its start [m] */
    brc_buffer *face, *component, *base, *direction; /* [n], [n][3] ... */
} brc_held_load;
typedef struct brc_held_faces {
    int32_t n_elements, n_faces;
    int32_t *index_of_free_face; /* [domain n_free_faces] -1: not held; host */
    int32_t *component_of_face;  /* [n_faces] bits 1 2 4: held components; host */
    brc_buffer *element, *place, *face_start, *held_of, *face_area, *arm, *held, *spring;
    brc_buffer *value, *zero_value, *reaction, *last, *last_reaction, *work, *scratch, *energy;
    int32_t n_loads;
    brc_held_load *loads;
    double *left; /* [domain n_free_faces][3] where the stage before left the faces it held, NAN elsewhere [m]; host;
                     NULL: none. Only while a stage is entered. */
} brc_held_faces;
typedef struct brc_traction_load {
    int32_t load;
    int32_t n;
    double last_factor;
    brc_buffer *element, *place, *total, *moment, *last_path, *work;
} brc_traction_load;
typedef struct brc_prescribed_load {
    int32_t load; /* -1: elements without bonds, held still (model.keep_isolated) */
    int32_t n;
    double last_rate;
    int32_t *element_id; /* [n] host */
    int32_t component_bits;
    double jump; /* as of held faces */
    brc_buffer *element, *component, *base, *direction, *reaction, *last, *last_reaction, *work;
} brc_prescribed_load;
typedef struct brc_push_load { /* dead forces on elements (element_loads.c) */
    int32_t load;
    int32_t n;
    double factor, last_factor; /* now, and at the last booking */
    int32_t *element_id;        /* [n] host */
    double *total_of;           /* [n][3] forces at factor 1 [N]; host */
    brc_buffer *element, *total, *last_path, *work;
} brc_push_load;
typedef struct brc_turn_load { /* prescribed rotations of elements (element_loads.c) */
    int32_t load;
    int32_t n;
    double turned;                 /* factor that the orientations are at */
    double last_factor, last_rate; /* at the last booking */
    int32_t *element_id;           /* [n] host */
    brc_buffer *element, *component, *direction, *reaction, *last_reaction, *work;
} brc_turn_load;
/* Passes over the lists of all loads; those of held faces are of models that have some. */
typedef struct brc_load_passes {
    brc_pass *held_prescribe, *held_energy;
    brc_pass *impose_motion, *impose_book, *zero_prescribed, *zero_turned, *push_elements, *impose_turn, *turn_book;
} brc_load_passes;
/* The stage's, but for the passes. */
struct brc_loads {
    brc_load_passes pass;
    brc_held_faces held;
    int32_t n_tractions, n_prescribed, n_pushes, n_turns;
    brc_push_load *pushes;
    brc_turn_load *turns;
    brc_traction_load *tractions;
    brc_prescribed_load *prescribed;
    bool on_faces;      /* some face is held or bears a traction */
    double work_before; /* of earlier stages [J] */
};

/* ---- loads.c: one stage's loads ---- */
brc_status brc_loads_create(brc_simulation *s, const brc_stage *stage, brc_loads *out);
void brc_loads_free(brc_loads *loads);
/* The refusal of a load that prescribes what an earlier one of the stage does, for n elements: BRC_BAD_INPUT. */
brc_status brc_loads_refuse_twice(brc_simulation *s, const brc_stage *stage, const brc_load *load, int64_t n);
/* Load of an prescribed list. */
const brc_load *brc_prescribed_of(const brc_stage *stage, const brc_prescribed_load *prescribed);

/* ---- load_motion.c ---- */
/* Velocities of prescribed elements at t. */
brc_status brc_loads_impose_velocity(brc_simulation *s, double t);
/* Reactions of prescribed elements, and their work; their forces are zero then. */
brc_status brc_prescribed_book(brc_simulation *s, const brc_force_request *r);
/* Zero the prescribed components of a vector; of one of rotations or torques. */
brc_status brc_loads_zero_prescribed(brc_simulation *s, brc_buffer *vector);
brc_status brc_loads_zero_turned(brc_simulation *s, brc_buffer *vector);
/* Work of all loads of this stage so far [J]. */
brc_status brc_loads_work(brc_simulation *s, double *out);

/* ---- jumps.c ---- */
/* How far a displacement at the start of its stage is from `now`, in the components of the load [m]. */
double brc_load_jump(const brc_load *load, const double direction[3], const double now[3]);
/* A dynamic stage begins: warns of displacements that move what they hold at once. */
brc_status brc_loads_tell_jumps(brc_simulation *s);

/* ---- load_values.c: what loads say ---- */
/* value + gradient (x - origin), in the components of the load; its components as bits 1 2 4. */
void brc_load_direction(const brc_load *load, const double *x, double out[3]);
int brc_load_components(const brc_load *load);
/* The set of a load; NULL with a sentence in *status when it is not there, empty, or of elements where faces are
 * needed. */
const brc_set *brc_load_find_set(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_set_kind kind,
                                 brc_status *status);
/* The same, and sets that are empty too. */
const brc_set *brc_load_find_named(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_set_kind kind,
                                   brc_status *status);
brc_status brc_load_refuse_empty(brc_simulation *s, const brc_stage *stage, const brc_load *load);

/* ---- element_loads.c, held_faces.c ---- */
/* An element of a load's set, with its storage row. */
typedef struct brc_load_member {
    int32_t row, id;
} brc_load_member;
/* By row, then by id; for qsort. */
int brc_load_compare_members(const void *left, const void *right);
/* Components as bits 1 2 4 into [n][3] of 0 and 1. */
brc_status brc_load_upload_components(brc_simulation *s, brc_buffer *out, const int32_t *bits, int32_t n);
/* Where the held faces stand, as brc_held_faces.left; *out: NULL where none is held, else the caller's. */
brc_status brc_held_faces_places(brc_simulation *s, double **out);
/* The faces that the stage holds. BRC_BAD_INPUT: models whose elements have no faces that move. */
brc_status brc_held_faces_create(brc_simulation *s, const brc_stage *stage, brc_held_faces *held);
/* Elements of a load's set (of a face set: the owners of its faces), by storage row, each once; owned by the caller. */
brc_status brc_load_members(brc_simulation *s, const brc_stage *stage, const brc_load *load, brc_load_member **out,
                            int32_t *n);

/* Make one load of the stage. taken [n_elements]: bits 1 2 4 of rotation components that earlier loads prescribe. */
brc_status brc_push_create(brc_simulation *s, const brc_stage *stage, int32_t l, brc_push_load *out);
brc_status brc_turn_create(brc_simulation *s, const brc_stage *stage, int32_t l, int32_t *taken, brc_turn_load *out);
void brc_element_loads_free(brc_loads *loads);

/* Add the forces of all pushes at time t to `force`, and book their work. */
brc_status brc_pushes_apply(brc_simulation *s, const brc_force_request *r);
/* All that loads remember. */
brc_status brc_loads_store(brc_simulation *s, brc_state_store *store);
/* Moments of all turns, which then balance the torques they meet, and their work. */
brc_status brc_turns_book(brc_simulation *s, const brc_force_request *r);
/* Bring orientations (statics, and the jump at the start of a stage) and spins to time t. */
brc_status brc_turns_prescribe(brc_simulation *s, double t);
/* Dynamics: spins that turn their elements from t0 to t1 as prescribed. */
brc_status brc_turns_begin_step(brc_simulation *s, double t0, double t1);

/* ---- load_fields.c, load_passes.c ---- */
/* Of brc_held_faces (its elements, its faces), brc_held_load, brc_traction_load, brc_prescribed_load, brc_push_load,
 * brc_turn_load. */
extern const brc_field_table brc_held_element_fields, brc_held_face_fields, brc_held_load_fields, brc_traction_fields,
    brc_prescribed_fields, brc_push_fields, brc_turn_fields;
/* Over the lists of s->loads, which is there. */
brc_status brc_load_passes_make(brc_simulation *s);
/* Room for a list of n things. */
brc_status brc_load_fields_create(brc_simulation *s, const brc_field_table *table, int64_t n, void *list);

#endif
