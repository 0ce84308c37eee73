/* How even are the directions of the bonds? The papers' three-dimensional histogram (AGH19 section 7.1, Fig. 5) with
 * numbers; formulas and what they give for known distributions are in docs/notebook/isotropy.md. */
#ifndef BRC_PREPROCESS_ISOTROPY_H
#define BRC_PREPROCESS_ISOTROPY_H

#include "domain.h"
#include <stdio.h>

/* Bins: the cells of directions nearest to each vertex of an icosphere, a direction and its opposite counted in both (a
 * bond has no sense). */
typedef struct brc_isotropy {
    int32_t n_bins;      /* 12, 42, 162, 642, ... = 10 * 4^level + 2 */
    double *direction;   /* [n_bins][3] unit vectors; owned */
    double *solid_angle; /* [n_bins] [sr] of each bin; owned */
    double *count;       /* [n_bins] directions in the bin, or their weight; owned */
    double
        *density; /* [n_bins] count per solid angle over the mean of it: 1 everywhere for even directions [-]; owned */
    int32_t n_triangles;
    int32_t *triangle;        /* [n_triangles][3] of the icosphere, counter-clockwise from outside; owned */
    double fabric[6];         /* mean of n (x) n: xx yy zz yz xz xy; I/3 for even directions [-] */
    double fabric_anisotropy; /* sqrt(3/2) |fabric - I/3| / (1/3) with the Frobenius norm: 0 even, 3 all parallel, 1.5
                               * all in one plane; for a fabric round an axis: what it has along the axis less across
                               * it, over its mean 1/3 [-] */
    double worst_bin;         /* largest |density - 1| [-] */
    double rms_bin;           /* root mean square of density - 1, weighted with solid angle [-] */
    double noise; /* rms_bin that even, independent directions of this number would give: sqrt((n_bins - 2) / (2
                   * n_effective)), the root of the exact expectation of its square [-] */
    double
        excess; /* sqrt(rms_bin^2 - noise^2), 0 where that is negative: what the number of bonds does not explain [-] */
    double cubic; /* mean of (nx^4 + ny^4 + nz^4) over 3/5, minus 1: the order a grid leaves, which the fabric tensor
                   * cannot see [-]: 0 even, 2/3 along the axes, -4/9 along the diagonals of the cube */
    double fabric_noise; /* root of the exact expectation of fabric_anisotropy^2 for even, independent directions: 3 /
                            sqrt(n_effective) [-] */
    double cubic_noise;  /* the same for cubic: 4 / (3 sqrt(21 n_effective)) [-] */
    int64_t n_directions;
    double n_effective; /* (sum of weights)^2 / sum of their squares: n_directions where each counts once [-] */
} brc_isotropy;

/* What is counted. */
typedef enum brc_isotropy_weight {
    BRC_ISOTROPY_BONDS, /* every bond once */
    BRC_ISOTROPY_AREA   /* weighted with face area (cells only) */
} brc_isotropy_weight;

/* Measure the bonds of a domain. level 0..6. n_threads: 0 as OpenMP decides; the result does not depend on it, bit for
 * bit. BRC_BAD_INPUT: no bonds, level out of range, area of spheres. *out is to be freed by brc_isotropy_free. */
brc_status brc_isotropy_measure(brc_context *context, const brc_domain *domain, int level, brc_isotropy_weight weight,
                                int n_threads, brc_isotropy *out);
/* The same without what walls impose on their neighbourhood: only bonds of two elements that are both `layers` or more
 * bonds away from the elements at a wall (0: all bonds; 1: neither is at a wall). BRC_BAD_INPUT too: no bond is
 * left. */
brc_status brc_isotropy_measure_inside(brc_context *context, const brc_domain *domain, int layers, int level,
                                       brc_isotropy_weight weight, int n_threads, brc_isotropy *out);
/* The same for any directions: direction [n][3] of any length above 0, weight [n] not negative (NULL: 1 each). */
brc_status brc_isotropy_count(brc_context *context, int64_t n, const double *direction, const double *weight, int level,
                              int n_threads, brc_isotropy *out);
void brc_isotropy_free(brc_isotropy *isotropy);
/* The numbers as lines a person reads. */
void brc_isotropy_print(FILE *file, const brc_isotropy *isotropy);
/* The histogram as a closed surface, radius = density, as a VTP (VTK XML PolyData, readable by ParaView) or, by the
 * ending .stl, an STL file (binary). Written aside and renamed. BRC_FILE_FAILED. */
brc_status brc_isotropy_write_surface(brc_context *context, const brc_isotropy *isotropy, const char *path);

#endif
