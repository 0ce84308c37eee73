/* Strikers inside the solver. */
#ifndef BRC_SOLVER_STRIKERS_INTERNAL_H
#define BRC_SOLVER_STRIKERS_INTERNAL_H

#include "../../../../preprocess/shapes/convex.h"
#include "striker_contact.h"

typedef struct brc_strikers brc_strikers;

/* Everything that exists only in scenes with strikers. What the buffers of numbers hold is said in
 * strikers.cl. */
struct brc_strikers {
    int32_t n;
    brc_pass *advance, *place, *push_on, *book;
    brc_striker_body *body; /* [n] host */
    brc_convex convex; /* pieces of all strikers, in the strikers' frames: origins at the mass centres, axes of space as
                          the scene starts; host */
    int32_t *piece_striker;     /* [convex.n] whose each is; host */
    brc_piece_kind *piece_kind; /* [convex.n] host */
    double *piece_radius;       /* [convex.n] of spheres, else 0 [m]; host */
    bool *warned;               /* [n] that it stands in a body a little as the scene starts; host */
    double *placed;             /* [n] driven: integral of the table up to where they are placed now [s]; host */
    /* for contact */
    brc_buffer *pose;   /* [n][12] place of the mass centre, rotation matrix by rows: now */
    brc_buffer *motion; /* [n][6] velocity, angular velocity: now */
    brc_buffer *load; /* [n][6] force and torque about the mass centre: written by contact with every evaluation of the
                         forces */
    /* the rest of the state, and what does not change */
    brc_buffer *displacement, *orientation, *momentum;
    brc_buffer *freedom, *mass, *inertia, *centre;
    brc_buffer *moved, *last, *work, *lost;
    brc_buffer *push, *pushed; /* where some are pushed by prescribed forces; else NULL */
    double
        *push_now; /* [n][4] that force of each as the device has it [N]; its work by changing within steps [J]; host */
};

extern const brc_field_table brc_striker_fields;

/* Mass properties, pieces and faces of one (striker_body.c), added to s->strikers, in the scene's order. */
brc_status brc_striker_body_make(brc_simulation *s, int32_t striker);
void brc_striker_body_free(brc_striker_body *body);
/* Make them, where the scene has some; velocities are those of the start of the run. BRC_BAD_INPUT: a free one without
 * mass ... */
brc_status brc_strikers_create(brc_simulation *s);
void brc_strikers_free(brc_simulation *s);
/* Refuses strikers that stand in a body; warns of such as stand in one a little, meet bodies faster than sound, are
 * held against their velocity, or cannot come near any (striker_check.c). */
brc_status brc_strikers_check(brc_simulation *s);
/* The deepest place found so far of a striker in a body: depth [m], the element there, the place in space. */
typedef struct brc_overlap {
    double depth;
    int64_t element;
    double place[3];
    bool first; /* the search ended here: other places may be deeper */
} brc_overlap;
void brc_deepen(brc_overlap *deepest, double depth, int64_t element, const double x[3]);
/* Depth beyond which an overlap is refused [m]. */
double brc_striker_refused_depth(const brc_simulation *s);
/* Refuses what was found of striker i, or tells of it, once. */
brc_status brc_striker_stands_in(brc_simulation *s, int32_t i, const brc_overlap *found);
/* Distance of r, from the origin of polyhedron p, from its face f (of all faces), on either side [m]. */
double brc_convex_face_distance(const brc_convex *convex, int32_t p, int32_t f, const double r[3]);
/* Driven ones are put where they are at the present time of the run, and prescribed forces are what they are then. */
brc_status brc_strikers_prescribe(brc_simulation *s);
/* Keep or take up their state (state_store.h). */
brc_status brc_strikers_store_state(brc_simulation *s, brc_state_store *store);

#endif
