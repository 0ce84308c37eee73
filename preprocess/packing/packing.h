/* Random dense packings of spheres in any solid: frictionless soft spheres, relaxed to rest at the density where the
 * mean number of contacts is the wanted one (NAH19 section 3.1; both papers prepare samples by packing). */
#ifndef BRC_PREPROCESS_PACKING_H
#define BRC_PREPROCESS_PACKING_H

#include "../shapes/solid.h"

typedef struct brc_packing {
    int64_t n;
    double *position;         /* [n][3] centres [m]; owned */
    double *radius;           /* [n] [m]; owned */
    double coordination;      /* 2 contacts / n, contacts with walls not counted [-] */
    double volume_fraction;   /* sphere volume (overlaps counted once per sphere) over the solid's volume [-] */
    double overlap_mean;      /* mean overlap of a contact over its distance [-] */
    double wall_overlap_mean; /* of contacts with walls: mean of (radius - depth) / radius [-] */
    double rattlers;          /* share of spheres that fewer than four contacts hold: they carry nothing [-] */
    double residual;          /* root mean square of the forces left over, over the mean contact force [-] */
    double crystal;           /* share of spheres in ordered surroundings, -1: not measured [-] */
    int32_t iterations;       /* relaxation steps in all */
    int32_t relaxations;      /* densities tried */
} brc_packing;

/* Pack. fill->kind is BRC_FILL_PACKING and was checked by brc_fill_check. The result depends on solid and fill alone,
 * not on the number of threads (n_threads >= 1), bit for bit. A progress line goes to the context's log. BRC_BAD_INPUT:
 * a shape too thin for the spheres, a coordination number or volume fraction that no packing at rest reaches (with what
 * it got and what can be reached); BRC_NO_MEMORY. */
brc_status brc_packing_make(brc_context *context, const brc_solid *solid, const brc_fill *fill, int n_threads,
                            brc_packing *out);
/* The same, cut out of a packing in the shape's bounding box, three mean diameters larger on each side: spheres with
 * their centres inside stay. No layers along the walls (spheres that touch a flat wall stand in a row), so the sample
 * is as even at its skin as inside; the number of spheres is met to a few standard deviations. volume_fraction and the
 * rest are those of the larger packing. */
brc_status brc_packing_cut(brc_context *context, const brc_solid *solid, const brc_fill *fill, int n_threads,
                           brc_packing *out);
void brc_packing_free(brc_packing *packing);

#endif
