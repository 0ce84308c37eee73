/* What every program is given by `breccia bench peers`: a packing with its beams and velocities, as the files that YADE
 * and LAMMPS read. */
#ifndef BRC_BENCH_PEER_WORK_H
#define BRC_BENCH_PEER_WORK_H

#include "../preprocess/domain/domain.h"

/* All of it borrowed. The beams are those of model cbm (docs/notebook/beams.md); seen from the middle of its branch,
 * one of length l is a spring E S / l along it, one of 12 E I / l^3 across, and its ends bend and twist against each
 * other with E I / l and G J / l: the numbers that the laws of both programs take. */
typedef struct brc_peer_work {
    const brc_domain *domain;  /* spheres */
    const double *velocity;    /* [n_elements][3] at the start [m/s] */
    double density;            /* of the spheres [kg/m^3] */
    double axial, bend, twist; /* E S [N], E I [N m^2], G J [N m^2] */
    double time_step;          /* [s] */
} brc_peer_work;

/* Write elements.csv (x, y, z, radius, mass, inertia, vx, vy, vz) and bonds.csv (i, j, kn, ks, kr, ktw, length) into a
 * folder that is there, for YADE. */
brc_status brc_peer_work_write_tables(brc_context *context, const brc_peer_work *work, const char *folder);
/* Write packing.data and bonds.in for LAMMPS. turning: for bpm/rotational; false: for springs along the bonds between
 * spheres that do not turn. Coefficients belong to types of bonds there: n_types classes of equal width in length, each
 * with the beam of its middle; 0: a type for each bond. */
brc_status brc_peer_work_write_lammps(brc_context *context, const brc_peer_work *work, bool turning, int n_types,
                                      const char *folder);
/* The longest branch [m]. */
double brc_peer_work_longest(const brc_peer_work *work);

#endif
