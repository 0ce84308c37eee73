/* The positions in a LAMMPS data file. */
#ifndef BRC_PREPROCESS_POINTS_LAMMPS_H
#define BRC_PREPROCESS_POINTS_LAMMPS_H

#include "lines.h"

/* Read the section "Atoms" into *position [*n][3] and, for styles with a diameter, *radius [*n], by ascending atom id,
 * in units of the file. Arrays as brc_points_read, also left to the caller after a failure. BRC_BAD_INPUT with the
 * faults of `lines`; BRC_NO_MEMORY. */
brc_status brc_points_read_lammps(brc_lines *lines, double **position, double **radius, int64_t *n);

#endif
