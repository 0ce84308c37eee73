/* Strikers, as contact and breaks ask of them. Their polyhedra are s->wants.pieces. */
#ifndef BRC_SOLVER_STRIKER_CONTACT_H
#define BRC_SOLVER_STRIKER_CONTACT_H

#include "../../../../preprocess/shapes/convex.h"
#include "../../core/solver.h"
#include "strikers.h"

/* What a piece of a striker is for contact. */
typedef enum brc_piece_kind {
    BRC_PIECE_CONVEX, /* a polyhedron */
    BRC_PIECE_SPHERE, /* a sphere about the mass centre; what meets cells is its polyhedron, of equal volume */
    BRC_PIECE_PLANE   /* endless: one face, whose plane goes through the origin, without corners */
} brc_piece_kind;
typedef struct brc_striker_piece {
    int32_t striker;
    brc_piece_kind kind;
    double radius; /* of a sphere, else 0 [m] */
} brc_striker_piece;
brc_striker_piece brc_striker_piece_of(const brc_simulation *s, int32_t piece);

/* What passes of contact find by name: poses, motions and loads, NULL where there are no strikers. */
brc_scope brc_scope_of_strikers(const brc_simulation *s, const brc_scope *outer);
/* Forces and torques about the mass centres, which contact writes [n][6] [N], [N m]; NULL: zeros. */
brc_status brc_strikers_set_load(brc_simulation *s, const double *load);
/* Warns of bodies that are thrown at each other faster than sound. */
void brc_contact_check_speed(const brc_simulation *s);
/* Whether a warning said that a striker stands in a body a little as the scene starts. */
bool brc_strikers_overlap(const brc_simulation *s);
/* Depth beyond which an overlap is warned of [m]. */
double brc_striker_warned_depth(const brc_simulation *s);
/* The same check where no corner tells: an edge of either goes through the other (striker_through.c). `cells`: those of
 * the domain. Bodies of spheres, which have no edges, and planes need none. */
brc_status brc_strikers_check_edges(brc_simulation *s, const brc_convex *cells);
/* Free ones: kick and drift [s] of velocity and spin; extra: (phi - 1) dt of Tchamwa-Wielgosz, else 0. numerical: book
 * the loss of that scheme. */
brc_status brc_strikers_advance(brc_simulation *s, double kick, double drift, double extra, bool numerical);
/* The largest acceleration that a prescribed force gives a striker now [m/s^2]. */
double brc_strikers_pushed(const brc_simulation *s);
/* After the forces on strikers are known: work of driven ones, of prescribed forces, and losses, as
 * brc_force_request.book says. */
brc_status brc_strikers_book(brc_simulation *s, brc_booking book);

#endif
