/* A sample cut out of a larger packing. */
#include "packing.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <string.h>

/* Order along a wall has died out three diameters away from it (docs/notebook/isotropy.md). */
#define SKIN_DIAMETERS 3.0
/* Between two spheres that touch at this share of the volume lie mean diameters of (6 / pi * share * V / n)^(1/3). */
#define USUAL_FRACTION 0.63
/* The least room of the shape's bounds, as between walls (packing.c). */
#define DIAMETERS_LEAST 2.0
/* A centre nearer than this to a wall [mean diameters] would leave its cell, or the gap to its mirror image, no
 * room. */
#define WALL_MARGIN 0.05

static int64_t keep_inside(const brc_solid *solid, double margin, brc_packing *packing)
{
    int64_t to = 0;
    for (int64_t e = 0; e < packing->n; ++e) {
        if (!brc_solid_inside(solid, packing->position + 3 * e, margin)) continue;
        memmove(packing->position + 3 * to, packing->position + 3 * e, 3 * sizeof(double));
        packing->radius[to++] = packing->radius[e];
    }
    return to;
}

brc_status brc_packing_cut(brc_context *context, const brc_solid *solid, const brc_fill *fill, int n_threads,
                           brc_packing *out)
{
    const double volume = brc_solid_volume(solid, NULL);
    const double diameter = fill->n_elements > 0 ? cbrt(6.0 / M_PI * USUAL_FRACTION * volume / (double)fill->n_elements)
                                                 : 2.0 * fill->radius;
    double bounds[2][3], larger = 1.0;
    brc_shape box = {.kind = BRC_SHAPE_BOX};
    brc_fill all = *fill;
    brc_solid *around = NULL;
    brc_status status = BRC_OK;
    memset(out, 0, sizeof *out);
    brc_solid_bounds(solid, bounds);
    for (int k = 0; k < 3; ++k) {
        box.origin[k] = bounds[0][k] - SKIN_DIAMETERS * diameter;
        box.size[k] = bounds[1][k] - bounds[0][k] + 2.0 * SKIN_DIAMETERS * diameter;
        larger *= box.size[k];
        if (bounds[1][k] - bounds[0][k] >= DIAMETERS_LEAST * diameter) continue;
        status =
            BRC_FAIL(context, BRC_BAD_INPUT,
                     "fill: the shape is %.2g diameters of its spheres across %c (%g m), at least %.0f are needed; use "
                     "more and so "
                     "smaller spheres",
                     (bounds[1][k] - bounds[0][k]) / diameter, "xyz"[k], bounds[1][k] - bounds[0][k], DIAMETERS_LEAST);
        goto cleanup;
    }
    if (fill->n_elements > 0) all.n_elements = llround((double)fill->n_elements * larger / volume);
    BRC_TRY_OR(cleanup, brc_solid_create(context, &box, n_threads, &around));
    BRC_TRY_OR(cleanup, brc_packing_make(context, around, &all, n_threads, out));
    out->n = keep_inside(solid, WALL_MARGIN * diameter, out);
    if (out->n < 1)
        status = BRC_FAIL(context, BRC_BAD_INPUT,
                          "packing: no centre of a sphere lies in the shape; use more elements, or walls: contact");
cleanup:
    if (status != BRC_OK) brc_packing_free(out);
    brc_solid_free(&around);
    return status;
}
