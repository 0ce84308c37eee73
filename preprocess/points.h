/* Seeds or packings from files: CSV with a header naming x, y, z and, for spheres, radius (or diameter), and LAMMPS data files
 * (atom styles atomic, sphere, bond, molecular with the style named in the comment of the section "Atoms"). */
#ifndef BRC_PREPROCESS_POINTS_H
#define BRC_PREPROCESS_POINTS_H

#include "build.h"

/* Read all points. `scale`: metres per unit of the file. *position [*n][3] and *radius [*n] (NULL when the file has none) are owned by
 * the caller (brc_memory_free). BRC_BAD_INPUT as "path:line:column: what was found, what is expected", for every bad line up to twenty in
 * one message; BRC_FILE_FAILED. */
brc_status brc_points_read(brc_context *context, const char *path, double scale, double **position, double **radius, int64_t *n);
/* Write the elements of a domain as CSV: id,x,y,z[,radius],volume,region,body[,grain], 17 digits. Written aside and renamed. */
brc_status brc_points_write(brc_context *context, const brc_domain *domain, const char *path);

#endif
