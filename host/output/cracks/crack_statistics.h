/* Where cracks lie: sums over broken bonds. */
#ifndef BRC_OUTPUT_CRACK_STATISTICS_H
#define BRC_OUTPUT_CRACK_STATISTICS_H

#include "../../solver/effects/fracture/fracture.h"

enum { BRC_BREAK_MODES = 8 }; /* room for modes of failure, counted from 1 */

/* The mean plane of a crack: through the area-weighted centre of its faces, across the direction in which they spread
 * least. */
typedef struct brc_crack_plane {
    int64_t n;        /* faces; fewer than 3, or all on a line: no plane, and the rest is 0 */
    double area;      /* of the faces [m^2] */
    double point[3];  /* [m] */
    double normal[3]; /* unit; its largest component is positive */
    double rough;     /* root mean square distance of the faces from it [m] */
} brc_crack_plane;

typedef struct brc_crack_statistics {
    int64_t count[BRC_BREAK_MODES]; /* broken bonds by mode */
    double area[BRC_BREAK_MODES];   /* by mode [m^2] */
    double total_area;              /* [m^2] */
    double fabric[6]; /* sum of area n (x) n over the area, xx yy zz yz xz xy, trace 1 [-]; 1/3 of the unit tensor: no
                         direction */
    double normal[3]; /* its largest principal axis: where most faces look; sign as above */
    brc_crack_plane all;        /* of all broken bonds */
    brc_crack_plane separating; /* of those between two fragments: the cracks that went through */
} brc_crack_statistics;

/* fragment: number of the fragment of every element, by the ids in the breaks. */
void brc_crack_statistics_of(int64_t n, const brc_break *breaks, const int32_t *fragment, brc_crack_statistics *out);
/* Angle between a line along `normal` and the axis c, 0 to 90 [degrees]. */
double brc_crack_angle(const double normal[3], int c);

#endif
