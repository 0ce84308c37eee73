/* The state of a simulation as the device holds it: for those who want to look without a copy. Rows are in storage
 * order (layout.h). */
#ifndef BRC_SOLVER_LIVE_ARRAYS_H
#define BRC_SOLVER_LIVE_ARRAYS_H

#include "../simulation.h"

enum { BRC_LIVE_ARRAYS_MOST = 8 };

typedef struct brc_live_array {
    const char *name, *unit; /* static storage */
    brc_buffer *buffer;      /* [n_rows][width] numbers of the state; borrowed from the simulation */
    int32_t width;
} brc_live_array;

/* displacement [m], velocity [m/s], force [N]; orientation (w x y z) [-] and spin [rad/s] of models with rotations;
 * broken, the number of bonds an element has lost, with fracture. Returns how many there are. */
int brc_simulation_live_arrays(const brc_simulation *simulation, brc_live_array out[BRC_LIVE_ARRAYS_MOST]);
/* Rows, and the element of each [n_rows], -1: padding; borrowed. */
int32_t brc_simulation_rows(const brc_simulation *simulation, const int32_t **element_of_row);

#endif
