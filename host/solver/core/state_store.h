/* What a simulation must know to go on later as if it had never stopped. Each module walks over its own state with a
 * store, which either keeps what it is shown or fills it with what was kept: one function a module does both. Names and
 * order of numbers depend neither on the device nor on storage order: elements, half-edges and faces are in the order
 * of their ids. What follows from scene and domain alone is not kept, nor is what the next evaluation of the forces
 * makes anew. */
#ifndef BRC_SOLVER_STATE_STORE_H
#define BRC_SOLVER_STATE_STORE_H

#include "fields.h"
#include "../simulation.h"

typedef enum brc_stored_type {
    BRC_STORED_DOUBLE,
    BRC_STORED_FLOAT,
    BRC_STORED_INT32,
    BRC_STORED_INT64,
    BRC_STORED_BYTE,
    BRC_STORED_SAMPLE /* a double of a report, NAN where there is none; doubles and floats of all other types are
                         finite */
} brc_stored_type;
int brc_stored_type_bytes(brc_stored_type type);

typedef struct brc_state_store brc_state_store;
struct brc_state_store {
    void *self;
    bool loading;
    bool for_file; /* what is shown is kept by the rank that writes files alone; others may show anything */
    int32_t part;  /* of the scene's models; -1: the run as a whole. Names of different parts are different */
    /* data [rows][columns] called `name` is kept, or filled. Loading: BRC_BAD_INPUT where there is none of this size,
     * or a double or float that is not finite. */
    brc_status (*numbers)(brc_state_store *store, const char *name, brc_stored_type type, int64_t rows, int32_t columns,
                          void *data);
    /* Loading only: rows that were kept. BRC_BAD_INPUT where there is none. */
    brc_status (*count)(brc_state_store *store, const char *name, int64_t *rows);
    /* Not NULL: arrays of fields are shown to it as they are on the device, in place of `numbers`, all of what a table
     * keeps some of. */
    brc_status (*field)(brc_state_store *store, brc_buffer *buffer);
};

/* ---- numbers of the host ---- */

brc_status brc_store_double(brc_state_store *store, const char *name, double *value);
/* A number of a report, which may be NAN. */
brc_status brc_store_sample(brc_state_store *store, const char *name, double *value);
brc_status brc_store_integer(brc_state_store *store, const char *name, int64_t *value);
brc_status brc_store_index(brc_state_store *store, const char *name, int32_t *value);
brc_status brc_store_flag(brc_state_store *store, const char *name, bool *value);
/* A text in an array of `room` bytes, all of which are kept: zeros behind its end. */
brc_status brc_store_text(brc_state_store *store, const char *name, char *text, int64_t room);
/* An array [*n][columns] of memory.h, whose length is kept with it: loading resizes it. */
brc_status brc_store_array(brc_context *context, brc_state_store *store, const char *name, brc_stored_type type,
                           int32_t columns, int64_t *n, void **data);

/* ---- arrays on the device ---- */

typedef enum brc_number_kind { BRC_OF_STATE, BRC_OF_COEFF, BRC_OF_INT } brc_number_kind;
typedef enum brc_arrangement {
    BRC_ROWS,    /* of elements [n_rows][width] */
    BRC_BLOCKS,  /* of elements [n_slices][width][C] */
    BRC_ENTRIES, /* of half-edges [n_slots][width][C] */
    BRC_RECORDS  /* of half-edges [n_slots][C][width] */
} brc_arrangement;

/* Ids of elements or half-edges, ascending. */
typedef struct brc_chosen {
    int64_t n;
    int32_t *id; /* [n] */
} brc_chosen;

/* One array. Padding, and what is not chosen, stays as brc_simulation_create left it. */
typedef struct brc_state_entry {
    const char *name;
    brc_buffer *buffer; /* NULL: the run does not have it, nothing is kept */
    brc_arrangement arrangement;
    brc_number_kind kind;
    int32_t width;
    const brc_chosen *chosen; /* NULL: all */
} brc_state_entry;
brc_status brc_store_entry(brc_simulation *simulation, brc_state_store *store, const brc_state_entry *entry);
brc_status brc_store_entries(brc_simulation *simulation, brc_state_store *store, int n, const brc_state_entry *entries);
/* A list [n][width] of things of its own; id [n]: what brings it into an order that does not depend on the device, all
 * different; NULL: it is in one. */
brc_status brc_store_list(brc_simulation *simulation, brc_state_store *store, const char *name, brc_buffer *buffer,
                          brc_number_kind kind, int64_t n, int32_t width, const int32_t *id);

/* What a table of fields keeps, under `prefix` and the fields' kept names. n things with the ids `id` (as of
 * brc_store_list) are those of lists. */
typedef struct brc_kept_fields {
    const brc_field_table *table;
    const void *owner;
    const char *prefix;                 /* NULL: none */
    const brc_chosen *bonds, *elements; /* of BRC_KEEP_BROKEN (half-edges) and BRC_KEEP_OWNERS */
    int64_t n;
    const int32_t *id; /* [n] or NULL */
} brc_kept_fields;
brc_status brc_store_fields(brc_simulation *simulation, brc_state_store *store, const brc_kept_fields *kept);

/* ---- the whole of a simulation ---- */

/* Keep the state of a simulation that is in a stage, at a moment where observers hear of a pause (simulation.h). */
brc_status brc_simulation_save_state(brc_simulation *simulation, brc_state_store *store);
/* Bring a new simulation of the same scene, domain and precision to it; brc_lockstep_continue (lockstep.h) then goes
 * on. BRC_BAD_INPUT: the store is of another simulation. After a failure the simulation may only be freed. */
brc_status brc_simulation_load_state(brc_simulation *simulation, brc_state_store *store);
/* What a step changes in which nothing breaks and nobody touches: clock, elements, loads. */
brc_status brc_simulation_walk_motion(brc_simulation *simulation, brc_state_store *store);

/* The clock and what is counted over the whole run; the arrays of the elements. */
brc_status brc_store_clock(brc_simulation *s, brc_state_store *store);
brc_status brc_store_elements(brc_simulation *s, brc_state_store *store);

#endif
