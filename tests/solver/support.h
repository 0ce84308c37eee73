/* A simulation made from a few lines of YAML, for the tests of the solver. */
#ifndef BRC_TESTS_SOLVER_SUPPORT_H
#define BRC_TESTS_SOLVER_SUPPORT_H

#include "../../host/scene/scene_reader.h"
#include "../../host/solver/effects/fracture/fracture.h"
#include "../../host/solver/simulation.h"
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on

typedef struct bench_case {
    brc_context *context;
    brc_scene *scene;
    brc_domain *domain;
    brc_device *device;
    brc_simulation *simulation;
} bench_case;

/* What a test varies; zero means the default. */
typedef struct case_options {
    const char *model;     /* default "dlsm" */
    const char *materials; /* default one: E 1 Pa, nu 0.2, density 1 kg/m^3, named stone */
    const char *shape;     /* default box of 1 m */
    const char *fill;      /* default "cells: [6, 6, 6], spread: 90 %" */
    const char *regions;   /* default none; other keys of the body after them */
    const char *sets;
    const char *gravity;
    const char *stages; /* default one dynamic stage of 1 step, time step auto */
    const char *device; /* default "cpu" */
    brc_precision precision;
    int n_threads, lanes;
    bool exact;
    bool no_contact; /* read, but left out: strikers are moved by hand */
} case_options;

/* Open everything; fails the test with the context's sentence. The stage is not entered. */
void open_case(bench_case *c, case_options options);
/* The same, but the status and sentence of brc_simulation_create + begin_stage(0) are the test's business. */
brc_status try_case(bench_case *c, case_options options);
void close_case(bench_case *c);
/* Assert a status is BRC_OK, showing the sentence. */
void assert_done(bench_case *c, brc_status status);
/* From here on what is logged is kept, until it is asked for: in static storage. */
void begin_listening(void);
const char *heard(void);
/* What is warned of while all stages of a scene run; likewise. */
const char *heard_of_run(case_options options);
/* Enter the first stage; take steps and wait for them. */
void begin_first(bench_case *c);
void run_steps(bench_case *c, int64_t n_steps);
/* Broken bonds, energy ledger and softening as they are now. */
int64_t count_broken(bench_case *c);
brc_ledger ledger_now(bench_case *c);
brc_softening_report softening_now(bench_case *c);
/* Momentum [kg m/s] and angular momentum about the origin [kg m^2/s] of free cells of density 1 kg/m^3, whose masses
 * sit at their positions. */
void cell_momenta(bench_case *c, double p[6]);
/* Is the name in a list that ends with NULL? */
bool is_listed(const char *const *names, const char *name);
/* After n_steps of their first stage both cases, which are opened and stay the test's, have broken the same bonds, and
 * more than 20: every event to its last bit. */
void assert_same_breaks(bench_case *a, bench_case *b, int64_t n_steps);
/* The named device can run here in double precision. */
bool device_is_there(const char *selector);
/* Tip of a slender beam along x, clamped at 0, under dead forces along and across it at its end: how far it moved along
 * x and across [m]. Euler's elastica, EI theta'' = along sin(theta) - across cos(theta), theta(0) = theta'(length) = 0,
 * by Runge and Kutta's steps and bisection for theta'(0): its first root, of a beam that bends one way. */
void elastica_tip(double stiffness, double length, double along, double across, double tip[2]);
/* Uniform in (-1, 1), a fixed sequence by index. */
double random_at(uint64_t index);

#endif
