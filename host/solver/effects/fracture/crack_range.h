/* Is a body fine enough for cracks that cost a fracture energy? Ranges of the laws, by the size of cells or spheres
 * that they want. */
#ifndef BRC_SOLVER_CRACK_RANGE_H
#define BRC_SOLVER_CRACK_RANGE_H

#include "../../core/solver.h"
#include "strengths.h"

/* Lengths E G_c / sigma_f^2 of the bonds that soften over the size of their elements, ascending; bonds that never break
 * have none. Nor have those of a material with a softer one without a strength that open at once: by the other's
 * strength, which no cells of use would be small enough for. */
typedef struct brc_crack_lengths {
    int64_t n;
    double *ratio;          /* [n] owned */
    int64_t n_below[3];     /* of these, below what is asked for, twice that, and 1 */
    double size;            /* of the elements, mean [m] */
    int64_t n_lent;         /* bonds left out for the softer side */
    double lent;            /* their smallest length [m] */
    int32_t lender, softer; /* and its materials */
} brc_crack_lengths;

/* Ratios of all bonds; elements are as large as the cube root of their volume (cells) or their diameter (spheres). Free
 * with brc_crack_lengths_free. BRC_NO_MEMORY. */
brc_status brc_crack_lengths_find(brc_simulation *s, const brc_strengths *strengths, double asked,
                                  brc_crack_lengths *out);
void brc_crack_lengths_free(brc_crack_lengths *lengths);
/* The size of elements with which half of the bonds have at least `ratio` and all but a hundredth at least 1 [m]. */
double brc_crack_lengths_size(const brc_crack_lengths *lengths, double ratio);
/* Warn of bonds that were left out, with the cure. */
void brc_crack_lengths_tell(brc_simulation *s, const brc_crack_lengths *lengths);
/* Warn of bodies that soften with few elements through their smallest extent, and of cracks that are there from the
 * start with few along them or ahead of them, by the size wanted. Extents are of boxes around bodies, and cracks count
 * where they lie across one axis. All ranks. */
brc_status brc_crack_range_tell(brc_simulation *s, const char *elements);

#endif
