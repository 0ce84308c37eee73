/* Seeds or packings from files, told apart by content:
 * - CSV: a row of names with x, y, z and, for spheres, radius or diameter, in any order and case, then a row for each
 *   point;
 *   further columns are ignored. Separated by commas, semicolons, tabs or blanks (found in the row of names); '#'
 *   begins a comment line; LF or CRLF; fields may stand in quotes. Points keep the order of the file.
 * - LAMMPS data files: the section "Atoms" in the styles atomic, sphere, bond, molecular, angle or bpm/sphere, named in
 *   the comment
 *   behind the section or, missing, told by the number of columns (said as a warning). Points come out by ascending
 *   atom id. Positions are taken as written: nothing is wrapped into the box, and image flags are not applied (said in
 *   the log). */
#ifndef BRC_PREPROCESS_POINTS_H
#define BRC_PREPROCESS_POINTS_H

#include "domain/build.h"

/* Read all points. `scale`: metres per unit of the file. *position [*n][3] [m] and *radius [*n] [m] (NULL when the file
 * has none) are owned by the caller (brc_memory_free). Numbers are decimal, in the C locale, finite; radii are > 0.
 * BRC_BAD_INPUT as "path:line:column: what was found, what is expected", for every bad line up to twenty in one
 * message, and for a path that cannot be read (as base/file.h); BRC_NO_MEMORY. Equal points are not looked for. */
brc_status brc_points_read(brc_context *context, const char *path, double scale, double **position, double **radius,
                           int64_t *n);
/* Write the elements of a domain as CSV: id,x,y,z[,radius],volume,region,body[,grain], in SI units and 17 digits, which
 * read back to the same bits. Written aside and renamed. BRC_FILE_FAILED. */
brc_status brc_points_write(brc_context *context, const brc_domain *domain, const char *path);

#endif
