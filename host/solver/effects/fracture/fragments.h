/* Fragments as bodies: what mass each has, where it is, how it moves and turns. Of scenes with `fracture`; sets of
 * elements of any scene. */
#ifndef BRC_SOLVER_FRAGMENTS_H
#define BRC_SOLVER_FRAGMENTS_H

#include "fracture.h"

/* Elements that hang together over unbroken bonds. Sums run over the elements in the order of their ids; positions are
 * those now. Elements are bodies with a mass at a point and, in models with rotations, an inertia of their own: cells
 * of dlsm are points. */
typedef struct brc_fragment {
    int32_t first_element; /* lowest id of its elements: its name for as long as it keeps it */
    int64_t n_elements;
    double mass;        /* [kg] */
    double centre[3];   /* of mass [m] */
    double velocity[3]; /* [m/s] */
    double spin[3];    /* angular velocity: the inverse of the inertia times the angular momentum about the centre; none
                          about axes without inertia [rad/s] */
    double inertia[6]; /* about the centre, xx yy zz yz xz xy [kg m^2] */
    double translation; /* kinetic energy of the centre [J] */
    double rotation;    /* kinetic energy of the spin [J] */
    double internal;    /* the rest of its kinetic energy: elements that move against each other [J] */
} brc_fragment;

/* All fragments, numbered as by brc_simulation_fragments: *out [*n] is the caller's (brc_memory_free). */
brc_status brc_simulation_fragment_list(brc_simulation *simulation, int64_t *n, brc_fragment **out);

/* The same of a set of elements of the domain (index; -1: all), as if they hung together. */
brc_status brc_simulation_set_motion(brc_simulation *simulation, int32_t set, brc_fragment *out);

/* Their sizes. */
typedef struct brc_fragment_sizes {
    double mass;          /* of all [kg] */
    double largest_share; /* mass of the heaviest over that of all [-] */
    double mean_mass;     /* sum m^2 / sum m: of the fragment that a random grain of the solid is in [kg] */
} brc_fragment_sizes;
/* below: [n] share of the mass in fragments that are not heavier than each [-]; may be NULL. BRC_NO_MEMORY. */
brc_status brc_fragment_sizes_of(brc_context *context, int64_t n, const brc_fragment *fragment, brc_fragment_sizes *out,
                                 double *below);

#endif
