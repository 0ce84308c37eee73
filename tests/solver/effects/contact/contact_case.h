/* Scenes of cells that break and meet again, for the tests of contact. */
#ifndef BRC_TESTS_SOLVER_CONTACT_CASE_H
#define BRC_TESTS_SOLVER_CONTACT_CASE_H

#include "../../../../host/solver/effects/contact/contact.h"
#include "../../../../host/solver/effects/contact/touching.h"
#include "../fracture/cells_case.h"

/* Pressed together along x and y while it bursts, so that what broke off meets again. */
#define CONTACT_CRUSH                                                                                                  \
    "  - name: burst\n    solver: {dynamic: {steps: 2000, time_step: {auto: {safety: 0.4}}}}\n    initial:\n"          \
    "      - velocity: {gradient: {x: [-4e-3 1/s, 1e-3 1/s, 0], y: [-2e-3 1/s, 3e-3 1/s, 1e-3 1/s], z: [0, 0, 5e-3 "   \
    "1/s]}}\n"
#define CONTACT_KEYS "fracture: {criterion: bond-normal}\ninteractions: {contact: {friction: 0.3, restitution: 0.7}}\n"

/* The crushed cube of 4 x 4 x 4 cells after 400 steps on both: displacements, velocities and spins of what came off,
 * and what touches, to the last bit. */
void contact_compare(case_options a, case_options b);
/* A blade of 1 mm goes down through the top of cells of 250 mm, 1 mm a step, and begins 0.5 mm above it. While it is
 * half in, volume over area is the depth; when it is all in, the areas of its two sides cancel and their quotient is
 * metres. The cells give way by less than 0.1 mm. */
void contact_blade(case_options options);
/* contact_compare of the cpu and another device, exactly rounded, and the blade there; returns the exit code of the
 * test, a skip where there is none. */
int contact_device_run(const char *device);

#endif
