/* Fields: every array of a simulation on the device is a row of a table, in the file of the module that owns it. Making
 * room, freeing, the bytes that are planned and listings read the tables; nobody adds up bytes by hand (field_tables.c
 * knows all tables). */
#ifndef BRC_SOLVER_FIELDS_H
#define BRC_SOLVER_FIELDS_H

#include "../../../preprocess/shapes/convex.h"
#include "../../device/device.h"
#include "layout.h"
#include "../../scene/scene.h"
#include "../models/model.h"

/* What the tables ask: scene and domain, and how the device stores them. Never what is drawn, nor which device it
 * is. */
typedef struct brc_wants {
    const brc_scene *scene;
    const brc_bond_model *model;
    const brc_domain *domain;
    const brc_layout *layout;
    const brc_convex *pieces; /* of rigid bodies; NULL: not made yet, or none */
    int32_t n_groups;         /* work-items of an element pass */
    int32_t state_bytes, coeff_bytes;
    bool many_materials;
    bool tchamwa, damping, noise, face_loads; /* some stage has them */
    bool by_element;                          /* criteria of elements */
    bool weighted, softens; /* some bond: its strength differs from that of its material, it has a fracture energy */
    bool loose;             /* some element has no bonds, or may lose them */
    int64_t exposed_room,
        bucket_room;     /* contact: exposed elements that there is room for, cells of the grid they are sorted into */
    int64_t n_listed;    /* of the list that is made: loads, pairs ... */
    int listed_unknowns; /* of each, where it is a node of multigrid */
} brc_wants;

/* Numbers of a field are of the precision's states or coefficients, or ints. */
typedef enum brc_field_number { BRC_FIELD_STATE, BRC_FIELD_COEFF, BRC_FIELD_INT } brc_field_number;

/* How long a field is there. */
typedef enum brc_field_life {
    BRC_LIFE_RUN,     /* as long as the simulation */
    BRC_LIFE_DYNAMIC, /* from the first dynamic stage on */
    BRC_LIFE_SEARCH,  /* from the first search for contact on; made anew where it does not hold what is exposed */
    BRC_LIFE_STAGE,   /* a stage's lists */
    BRC_LIFE_SOLVE,   /* a solve, a search for the time step */
    BRC_LIFE_GROWS    /* made where needed, anew where too small: its length is not known before */
} brc_field_life;

/* Which of its numbers a checkpoint has: what a new simulation has right is left out. */
typedef enum brc_field_keep {
    BRC_KEEP_ALL,
    BRC_KEEP_BROKEN, /* those of broken bonds */
    BRC_KEEP_OWNERS  /* those of elements that lost bonds */
} brc_field_keep;

typedef struct brc_field_row {
    const char *name;                    /* as kernels call it */
    int64_t (*count)(const brc_wants *); /* things that have `width` numbers each */
    int32_t width;
    brc_field_number number;
    bool (*wanted)(const brc_wants *); /* NULL: wherever its table is */
    size_t at;                         /* of its brc_buffer * in the owner */
    const char *what;                  /* in words: sentences about room, listings */
    const char *unit;                  /* "-": a count, an index, a factor */
    const char *kept; /* its name in a checkpoint, which is file format; NULL: it is not there (brc_store_fields) */
    brc_field_keep keep;
} brc_field_row;
#define BRC_NOT_KEPT NULL, BRC_KEEP_ALL
#define BRC_KEPT(name, which) name, which
#define BRC_FIELD_AT(owner, member) offsetof(owner, member)
/* A row of a field that its owner calls as kernels do: of which a checkpoint has a part, all, nothing. Where in the
 * owner: AT of the file. */
#define BRC_PART_KEPT(id, each, numbers, kind, when, words, in, as, which)                                             \
    {                                                                                                                  \
        .name = #id, .count = each, .width = numbers, .number = BRC_FIELD_##kind, .wanted = when, .at = AT(id),        \
        .what = words, .unit = in, .kept = as, .keep = which                                                           \
    }
#define BRC_KEPT_FIELD(id, each, numbers, kind, when, words, in, as)                                                   \
    BRC_PART_KEPT(id, each, numbers, kind, when, words, in, as, BRC_KEEP_ALL)
#define BRC_FIELD(id, each, numbers, kind, when, words, in)                                                            \
    BRC_KEPT_FIELD(id, each, numbers, kind, when, words, in, NULL)
/* A function of w, what a run wants; whether a field or table is wanted; how many things have one. */
#define BRC_OF_WANTS(type, name, value)                                                                                \
    type name(const brc_wants *w)                                                                                      \
    {                                                                                                                  \
        return value;                                                                                                  \
    }
#define BRC_WANTED(name, condition) static BRC_OF_WANTS(bool, name, condition)
#define BRC_COUNTED(name, number) static BRC_OF_WANTS(int64_t, name, number)

typedef struct brc_field_table {
    const char *owner; /* for listings */
    brc_field_life life;
    bool (*wanted)(const brc_wants *); /* NULL: in every simulation */
    int n;
    const brc_field_row *fields;
} brc_field_table;
#define BRC_FIELD_TABLE(name, owner_words, when, asked, rows)                                                          \
    const brc_field_table name = {owner_words, when, asked, (int)(sizeof rows / sizeof *rows), rows}

/* ---- counts ---- */
int64_t brc_each_row(const brc_wants *wants);     /* storage row [n_rows] */
int64_t brc_each_block(const brc_wants *wants);   /* the same, stored slice by slice: [n_slices][width][C] */
int64_t brc_each_row_end(const brc_wants *wants); /* and one more */
int64_t brc_each_entry(const brc_wants *wants);   /* stored half-edge [n_slots][width][C] */
int64_t brc_each_record(const brc_wants *wants);  /* the same, of few of which much is asked: [n_slots][C][width] */
int64_t brc_each_slice(const brc_wants *wants);
int64_t brc_each_slice_end(const brc_wants *wants);
int64_t brc_each_boundary(const brc_wants *wants); /* row of a slice with free faces */
int64_t brc_each_group(const brc_wants *wants);    /* work-item of an element pass */
int64_t brc_each_striker(const brc_wants *wants);
int64_t brc_each_listed(const brc_wants *wants); /* n_listed */
int64_t brc_each_listed_end(const brc_wants *wants);
int64_t brc_each_once(const brc_wants *wants);

/* ---- what a field is wanted for ---- */
bool brc_wants_cells(const brc_wants *wants); /* elements are cells; spheres */
bool brc_wants_spheres(const brc_wants *wants);
bool brc_wants_turning(const brc_wants *wants);                        /* elements have rotations */
bool brc_wants_deforming(const brc_wants *wants);                      /* elements have displacement gradients */
bool brc_wants_rigid_cells(const brc_wants *wants);                    /* cells that have none */
bool brc_wants_many(const brc_wants *wants);                           /* several materials */
bool brc_wants_solver(const brc_wants *wants, brc_solver_kind solver); /* some stage has it */

/* What scene and domain want of a device; layout, pieces and material [n_elements] are borrowed. *out asks for no
 * list. */
void brc_wants_make(const brc_scene *scene, const brc_domain *domain, const brc_layout *layout,
                    const brc_device *device, const int32_t *material, brc_wants *out);
/* The same where a list of n things is made. */
brc_wants brc_wants_listed(const brc_wants *wants, int64_t n);

/* ---- a table ---- */
/* Bytes of one field; 0: not wanted. */
int64_t brc_field_bytes(const brc_field_row *field, const brc_wants *wants);
int64_t brc_fields_bytes(const brc_field_table *table, const brc_wants *wants);
/* Room for every field that is wanted, zeroed; those that are there are freed first. A failure leaves what was made,
 * for brc_fields_free. */
brc_status brc_fields_create(brc_device *device, const brc_field_table *table, const brc_wants *wants, void *owner);
void brc_fields_free(const brc_field_table *table, void *owner);
/* The array of a field; of that with this name; NULL: not there. */
brc_buffer *brc_field_buffer(const brc_field_row *field, const void *owner);
brc_buffer *brc_field_named(const brc_field_table *table, const void *owner, const char *name);

/* ---- all tables (field_tables.c) ---- */
/* Bytes of all fields of a life. */
int64_t brc_fields_planned(const brc_wants *wants, brc_field_life life);
/* The k-th of all tables; NULL: there are no more. */
const brc_field_table *brc_field_table_at(int k);

#endif
