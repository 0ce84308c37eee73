/* Scenes of two models: a bar of cells (dlsm) beside a packing of spheres (cbm), each in its own place and turned. */
#ifndef TESTS_COMMANDS_SEVERAL_MODELS_H
#define TESTS_COMMANDS_SEVERAL_MODELS_H

#include "support.h"
#include "../../host/solver/simulation.h"
#include <string.h>

#define MATERIALS                                                                                                      \
    "version: 1\nmaterials:\n  glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3}\n"                                   \
    "  steel: {E: 200 GPa, nu: 0.3, density: 7800 kg/m^3, beam: {radius: 0.5, E: 500 GPa}}\n"
#define CELLS                                                                                                          \
    "  - name: bar\n    shape:\n      box: {size: [40 mm, 20 mm, 20 mm]}\n"                                            \
    "    fill:\n      noisy_grid: {cells: [8, 4, 4], spread: 50 %, seed: 3}\n    material: glass\n"                    \
    "    pose: {translation: [0, 30 mm, 0], rotation: [0, 0, 30 deg]}\n"
#define SPHERES                                                                                                        \
    "  - name: ball\n    shape:\n      box: {size: [30 mm, 20 mm, 20 mm]}\n"                                           \
    "    fill:\n      packing: {elements: 150, seed: 2}\n    material: steel\n    beams: 9\n"                          \
    "    pose: {translation: [0, -40 mm, 0], rotation: [0, 20 deg, 0]}\n"
#define BOTH MATERIALS "bodies:\n" CELLS "    model: dlsm\n" SPHERES "    model: cbm\n"
#define ALONE_CELLS MATERIALS "model: dlsm\nbodies:\n" CELLS
#define ALONE_SPHERES MATERIALS "model: cbm\nbodies:\n" SPHERES
#define UPPER_SET "  upper:\n    elements:\n      half_space: {point: [0, 5 mm, 0], normal: [0, 1, 0]}\n"
#define LOWER_SET "  lower:\n    elements:\n      half_space: {point: [0, 5 mm, 0], normal: [0, -1, 0]}\n"
#define ENDS "  left:\n    elements: {wall: x-}\n  right:\n    elements: {wall: x+}\n"
#define ALL_SET "  everything:\n    elements:\n      box: {from: [-1 m, -1 m, -1 m], to: [1 m, 1 m, 1 m]}\n"
#define QUIET "output:\n  frames: none\n  picture: false\n"

/* Fifty steps of 20 ns after a spin and a random push: half the critical step of the cells. */
#define SPIN                                                                                                           \
    "stages:\n  - name: fly\n    initial:\n      - spin: {angular_velocity: [0, 0, 100 rad/s]}\n"                      \
    "      - random: {amplitude: [1 m/s, 1 m/s, 1 m/s], seed: 5}\n"                                                    \
    "    solver:\n      dynamic: {steps: 50, time_step: 20 ns}\n"

static brc_context *context;

static inline int begin(void **state)
{
    (void)state;
    context = brc_context_create();
    return context ? 0 : -1;
}

static inline int end(void **state)
{
    (void)state;
    brc_context_free(&context);
    return 0;
}

static inline void must(brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
}

static inline brc_status interrupt(void *self, brc_simulation *simulation)
{
    (void)self;
    brc_simulation_interrupt(simulation);
    return BRC_OK;
}

#endif
