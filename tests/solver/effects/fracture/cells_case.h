/* Pieces of scenes of cells that may break, for the tests of fracture. */
#ifndef BRC_TESTS_SOLVER_CELLS_CASE_H
#define BRC_TESTS_SOLVER_CELLS_CASE_H

#include "../../../../host/solver/effects/fracture/breaking.h"
#include "../../support.h"

/* Key `fracture`, where open_case takes keys of the scene. */
#define CELLS_FRACTURE "fracture: {criterion: bond-normal}\n"
/* One material of E 1 Pa, density 1 kg/m^3. */
#define CELLS_STRENGTH(tension) "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: " tension "}}"
/* E 1 Pa, density 1 kg/m^3, and strength: {...}. */
#define CELLS_SOFT(nu, strength) "  stone: {E: 1 Pa, nu: " nu ", density: 1 kg/m^3, strength: {" strength "}}"
/* Two equal materials on both sides of the plane x = 0.5 m, joined by an interface that is weaker. */
#define CELLS_TWINS(nu)                                                                                                \
    "  stone: {E: 1 Pa, nu: " nu ", density: 1 kg/m^3, strength: {tension: 1 Pa}}\n"                                   \
    "  twin: {E: 1 Pa, nu: " nu ", density: 1 kg/m^3, strength: {tension: 1 Pa}}"
#define CELLS_TWIN_HALF                                                                                                \
    "    regions:\n      - {where: {box: {from: [0.5 m, -1 m, -1 m], to: [2 m, 2 m, 2 m]}}, material: twin}\n"
#define CELLS_WEAK_PLANE(energy)                                                                                       \
    CELLS_FRACTURE "interactions: {interfaces: [{materials: {first: stone, second: twin, tension: 1e-3 Pa, "           \
                   "fracture_energy: " energy " J/m^2}}]}\n"
/* A sudden pull along x, uneven along y so that no two elements are alike. */
#define CELLS_BURST(steps)                                                                                             \
    "  - name: burst\n    solver: {dynamic: {steps: " #steps                                                           \
    "}}\n    initial:\n      - velocity: {gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}\n"

/* Pressed together along x and y while it bursts, so that broken faces shut. */
#define CELLS_CRUSH(steps, safety)                                                                                     \
    "  - name: crush\n    solver: {dynamic: {steps: " #steps ", time_step: {auto: {safety: " safety                    \
    "}}}}\n    initial:\n"                                                                                             \
    "      - velocity: {gradient: {x: [-4e-3 1/s, 1e-3 1/s, 0], y: [-2e-3 1/s, 3e-3 1/s, 1e-3 1/s], z: [0, 0, 5e-3 "   \
    "1/s]}}\n"

/* After 60 steps both have broken the same bonds, and some: every event to its last bit. */
void cells_compare(case_options a, case_options b);
/* cells_compare of the cpu and another device, exactly rounded: cells that break, that soften with one material and
 * with two, of dlsm-published and by the stress of elements; returns the exit code of the test, a skip where there is
 * no such device. */
int cells_device_run(const char *device);

#endif
