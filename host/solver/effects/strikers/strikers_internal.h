/* Strikers inside the solver. */
#ifndef BRC_SOLVER_STRIKERS_INTERNAL_H
#define BRC_SOLVER_STRIKERS_INTERNAL_H

#include "../../../../preprocess/shapes/convex.h"
#include "../../core/simulation_internal.h"
#include "../../core/state_store.h"
#include "strikers.h"

/* What a piece of a striker is for contact. */
typedef enum brc_piece_kind {
    BRC_PIECE_CONVEX, /* a polyhedron */
    BRC_PIECE_SPHERE, /* a sphere about the mass centre; what meets cells is its polyhedron, of equal volume */
    BRC_PIECE_PLANE   /* endless: one face, whose plane goes through the origin, without corners */
} brc_piece_kind;

/* Everything that exists only in scenes with strikers. What the buffers of numbers hold is told in
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
    bool *told;                 /* [n] that it stands in a body a little as the scene starts; host */
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

/* Energies of all strikers [J]. */
typedef struct brc_striker_energies {
    double kinetic;   /* of free ones */
    double potential; /* of free ones in gravity, 0 where they started */
    double work;      /* that driven ones have done on what they touched, and prescribed forces on free ones */
    double numerical; /* lost to the integrator */
} brc_striker_energies;

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
/* Warns of bodies that are thrown at each other faster than sound. */
void brc_contact_check_speed(const brc_simulation *s);
/* The deepest place found so far of a striker in a body: depth [m], the element there, the place in space. */
typedef struct brc_overlap {
    double depth;
    int64_t element;
    double place[3];
    bool first; /* the search ended here: other places may be deeper */
} brc_overlap;
void brc_deepen(brc_overlap *deepest, double depth, int64_t element, const double x[3]);
/* Depths beyond which an overlap is refused, and told of [m]. */
double brc_striker_refused_depth(const brc_simulation *s);
double brc_striker_told_depth(const brc_simulation *s);
/* Refuses what was found of striker i, or tells of it, once. */
brc_status brc_striker_stands_in(brc_simulation *s, int32_t i, const brc_overlap *found);
/* Distance of r, from the origin of polyhedron p, from its face f (of all faces), on either side [m]. */
double brc_convex_face_distance(const brc_convex *convex, int32_t p, int32_t f, const double r[3]);
/* The same check where no corner tells: an edge of either goes through the other (striker_through.c). `cells`: those of
 * the domain. Bodies of spheres, which have no edges, and planes need none. */
brc_status brc_strikers_check_edges(brc_simulation *s, const brc_convex *cells);
/* Free ones: kick and drift [s] of velocity and spin; extra: (phi - 1) dt of Tchamwa-Wielgosz, else 0. numerical: book
 * the loss of that scheme. */
brc_status brc_strikers_advance(brc_simulation *s, double kick, double drift, double extra, bool numerical);
/* Driven ones are put where they are at the present time of the run, and prescribed forces are what they are then. */
brc_status brc_strikers_prescribe(brc_simulation *s);
/* The largest acceleration that a prescribed force gives a striker now [m/s^2]. */
double brc_strikers_pushed(const brc_simulation *s);
/* After the forces on strikers are known: work of driven ones, of prescribed forces, and losses, as
 * brc_force_request.book says. */
brc_status brc_strikers_book(brc_simulation *s, brc_booking book);
/* Keep or take up their state (state_store.h). */
brc_status brc_strikers_store_state(brc_simulation *s, brc_state_store *store);
brc_status brc_strikers_energies(brc_simulation *s, brc_striker_energies *out);

#endif
