/* A packing of beams that may break, for the tests of fracture. */
#ifndef BRC_TESTS_SOLVER_FRACTURE_CASE_H
#define BRC_TESTS_SOLVER_FRACTURE_CASE_H

#include "../../../../host/solver/effects/fracture/breaking.h"
#include "../../support.h"

/* Zero means the default. A cube of 1 m, glass of E 1 Pa, density 1 kg/m^3, beams of cn 8 with r_m 0.4. */
typedef struct fracture_options {
    const char *fracture; /* value of `fracture`; NULL: none */
    const char *strength; /* keys of the material, e.g. "strength: {tension: 1e-4 Pa}"; NULL: none */
    const char *beam;     /* value of `beam`; NULL: {radius: 0.4, E: 8 Pa} */
    const char *grains;   /* value of the body's `grains`; NULL: none */
    const char *more;     /* another material, "name: {...}"; NULL: none */
    const char *regions;  /* value of the body's `regions`; NULL: none */
    const char *stages;   /* keys `interactions`, `sets`, `stages` */
    const char *device;
    brc_precision precision;
    int n_threads, lanes, elements, seed;
    bool exact;
} fracture_options;

brc_status try_fracture(bench_case *c, fracture_options options);
void open_fracture(bench_case *c, fracture_options options);

/* A sudden pull along x, uneven along y so that no two elements are alike. */
#define FRACTURE_BURST(steps)                                                                                          \
    "stages:\n  - name: burst\n    solver: {dynamic: {steps: " #steps                                                  \
    "}}\n    initial:\n      - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}\n"
/* After 120 steps both have broken the same bonds, and some: every event to its last bit. */
void fracture_compare(fracture_options a, fracture_options b);
/* fracture_compare of the cpu and another device, exactly rounded, brittle and softening; returns the exit code of the
 * test, a skip where there is no such device. */
int fracture_device_run(const char *device);
/* Three cases of one body and stage, which are closed: without a strength, with one, and with `fracture` too. Fracture
 * alone takes arrays, and a strength alone changes no bit of 50 steps. */
void fracture_is_nothing_unless_asked(bench_case *plain, bench_case *strong, bench_case *with);
/* Two cases, which are closed, without fracture and with bonds too strong to break: the same motion in 50 steps to
 * 1e-10 of the largest displacement. The passes of fracture compute the same forces; the compiler may round them in
 * another order, some rounding of u a step, which a wave carries on. */
void fracture_that_never_comes_moves_nothing(bench_case *plain, bench_case *with);
/* Momentum and angular momentum about the origin of a free body of density 1 [kg m/s], [kg m^2/s]. */
void fracture_momenta(bench_case *c, double p[6]);

#endif
