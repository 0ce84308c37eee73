/* Simulations of beams between points that a test names, through a file of points, for the tests of model cbm. */
#ifndef BRC_TESTS_SOLVER_BEAMS_CASE_H
#define BRC_TESTS_SOLVER_BEAMS_CASE_H

#include "../../support.h"

typedef bench_case beams_case;

/* Zero means the default. Material stone: density 1 kg/m^3, beams of E 1 Pa and 0.2 of the spheres' radius. */
typedef struct beams_options {
    int64_t n;
    const double *position; /* [n][3] [m], all within 0 .. 20 */
    double radius;          /* of every sphere [m] */
    double coordination;
    const char *materials, *regions;
    const char *stages; /* keys `sets` and `stages` */
    const char *model;  /* default "cbm" */
    bool refused;       /* brc_simulation_create is expected to fail with BRC_BAD_INPUT */
    const char *device;
    brc_precision precision;
    int n_threads;
    bool exact;
} beams_options;

/* Open everything but the stage; fails the test with the context's sentence. */
void open_beams(beams_case *c, beams_options options);
/* A cube of n x n x n points, about 1 m apart and shaken by a tenth, the first near (0.5, 0.5, 0.5) m; spheres of 0.5
 * m. */
void open_lattice(beams_case *c, int n, beams_options options);
void close_beams(beams_case *c);
void beams_done(beams_case *c, brc_status status);

#endif
