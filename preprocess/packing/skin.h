/* What walls do to the spheres and beams next to them: a packing is loose and bonds are few where a body ends. Layer by
 * layer, by the depth below the surface. */
#ifndef BRC_PREPROCESS_SKIN_H
#define BRC_PREPROCESS_SKIN_H

#include "../domain/domain.h"
#include "../shapes/solid.h"

enum { BRC_SKIN_LAYERS = 10, BRC_SKIN_DIRECTIONS = 3 };
/* Thickness of a layer in mean diameters. */
#define BRC_SKIN_THICKNESS 0.25

typedef enum brc_skin_direction {
    BRC_SKIN_ALONG, /* stretching along the wall: mean of n_t^4 over the directions t in the wall (shear in the wall is
                       a third of it) */
    BRC_SKIN_SHEAR, /* shear of the wall against what lies below: mean of n_t^2 n_n^2 */
    BRC_SKIN_ACROSS /* stretching across the wall: n_n^4 */
} brc_skin_direction;

typedef struct brc_skin_layer {
    double volume; /* [m^3] of points of the solid, found by random points: to some 1 % in a layer of a packing of 10
                      000 */
    double solid;  /* share of it inside spheres; where two overlap both count [-] */
    int64_t n_elements;  /* with their centres in the layer */
    double coordination; /* their bonds, mean; 0 where there are none [-] */
    double
        stiffness[BRC_SKIN_DIRECTIONS]; /* sum over beams of (length in the layer) times n n n n, per volume, over what
                                           beams without a preferred direction and as dense as the core's have [-] */
} brc_skin_layer;

typedef struct brc_skin {
    double diameter;                       /* mean of the spheres [m] */
    brc_skin_layer layer[BRC_SKIN_LAYERS]; /* layer k is k to k + 1 thicknesses deep; points that a second wall is as
                                              near to as the deepest layer count nowhere */
    brc_skin_layer core; /* deeper than all layers; its stiffnesses have no wall to be told apart by and are 1 */
    double missing[BRC_SKIN_DIRECTIONS]; /* what the layers lack together: a wall of this thickness [mean diameters]
                                            without any beams would lack as much */
} brc_skin;

/* Measure spheres joined by beams of one section under uniform strain (Voigt's stiffness). The domain stands where
 * `solid`, the shape that it was built in, does: it was not moved or turned. Equal input gives equal bytes for any
 * n_threads (0: as OpenMP decides). BRC_BAD_INPUT: cells; fewer than 100 spheres deeper than the layers, with their
 * number. */
brc_status brc_skin_measure(brc_context *context, const brc_solid *solid, const brc_domain *domain, int n_threads,
                            brc_skin *out);

#endif
