/* The plane piece of a crack, a disc or a parallelogram, ready for questions. */
#ifndef BRC_PREPROCESS_CRACK_PATCH_H
#define BRC_PREPROCESS_CRACK_PATCH_H

#include "build.h"

typedef struct brc_crack_patch {
    brc_crack_kind kind;
    double point[3];   /* disc: centre; rectangle: corner [m] */
    double normal[3];  /* unit; rectangle: along edge 0 x edge 1 */
    double radius;     /* disc [m] */
    double edge[2][3]; /* rectangle [m] */
    double dual[2][3]; /* rectangle: dual[k] . edge[l] = (k == l), in the plane [1/m] */
} brc_crack_patch;

/* The crack was checked by brc_cracks_check. */
void brc_crack_patch_make(const brc_crack *crack, brc_crack_patch *patch);
/* Signed height of x over the plane [m]. */
double brc_crack_patch_height(const brc_crack_patch *patch, const double x[3]);
/* Does the projection of x on the plane lie in the patch, or no farther than `margin` [m] beyond its rim (beyond the
 * lines of its edges)? Inclusive. */
bool brc_crack_patch_covers(const brc_crack_patch *patch, const double x[3], double margin);
/* How far the projection of x on the plane of a rectangle lies inside one of its four sides [m], below 0 beyond it, and
 * the unit vector out of the patch across it; -HUGE_VAL where that side ends before. */
double brc_crack_patch_depth(const brc_crack_patch *patch, int side, const double x[3], double outward[3]);
/* Distance of x to the patch [m]. */
double brc_crack_patch_distance(const brc_crack_patch *patch, const double x[3]);

#endif
