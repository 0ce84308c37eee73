/* Soft spheres in a solid: two of them that overlap by o = R_i + R_j - d push each other apart with the force o
 * (stiffness 1), a wall counts as the sphere's mirror image: o = 2 (R - depth). */
#ifndef BRC_PREPROCESS_SOFT_SPHERES_H
#define BRC_PREPROCESS_SOFT_SPHERES_H

#include "../shapes/solid.h"

typedef struct brc_pack brc_pack;

/* What one pass over the forces finds; the sums of a block and of all. */
typedef struct brc_pack_sums {
    double energy;       /* sum of o^2 / 2 over contacts, of (R - depth)^2 over walls [m^2] */
    double power;        /* sum of force . velocity */
    double force_square; /* sum of |force|^2 [m^2] */
    double velocity_square;
    double contact_force; /* sum of o over contacts of two spheres, each counted from both sides [m] */
    double overlap;       /* sum of o / d, likewise [-] */
    double wall_force;    /* sum of 2 (R - depth) [m] */
    double wall_overlap;  /* sum of (R - depth) / R [-] */
    int64_t contact_ends; /* twice the number of contacts of two spheres */
    int64_t wall_contacts;
} brc_pack_sums;

/* n of them, not yet anywhere; solid: borrowed. A failure leaves nothing. */
brc_status brc_pack_create(brc_context *context, const brc_solid *solid, int64_t n, int n_threads, brc_pack **out);
void brc_pack_free(brc_pack **pack);
/* Sphere i at x, inside the solid; then what all radii are. */
void brc_pack_put(brc_pack *pack, int64_t i, const double x[3], double radius);
void brc_pack_set_radii(brc_pack *pack, double mean, double largest);
/* Multiply all radii. */
void brc_pack_scale(brc_pack *pack, double factor);
/* [n] x, y, z, radius [m]; what moves them makes the lists anew. */
double (*brc_pack_spheres(brc_pack *pack))[4];

/* Make the lists of neighbours (those nearer than R_i + R_j + skin) and walls at the present positions and radii. A
 * centre outside the solid goes back to where it was when the list was last made, or put. */
brc_status brc_pack_list(brc_pack *pack, double skin);
/* Those of sphere i, in (*out)[0], (*out)[*step], ...; returns how many. */
int64_t brc_pack_neighbours(const brc_pack *pack, int64_t i, const int32_t **out, int64_t *step);
/* Walls that sphere i touches. */
int brc_pack_wall_contacts(const brc_pack *pack, int64_t i);
/* One pass over the forces at the present positions; the lists must be good there. force: [n] those [m], or NULL. */
brc_pack_sums brc_pack_forces(brc_pack *pack, const double (**force)[3]);
/* Relax until the root mean square of the forces that remain is below `tolerance` of the mean contact force, or nothing
 * touches, or after `most` iterations. *converged tells which. */
brc_status brc_pack_relax(brc_pack *pack, double tolerance, int64_t most, brc_pack_sums *sums, bool *converged);
/* Share of spheres in ordered surroundings. */
brc_status brc_pack_crystal(brc_pack *pack, double *share);

#endif
