/* Bonds of dlsm on the device: areas, offsets, lengths over areas. */
#include "consistent.h"
#include "dlsm_internal.h"

static void area(const brc_simulation *s, int64_t e, int64_t h, double out[3])
{
    double ratio;
    brc_consistent_bond(s, e, h, out, &ratio);
}

static void ratio(const brc_simulation *s, int64_t e, int64_t h, double out[3])
{
    double surface[3];
    brc_consistent_bond(s, e, h, surface, out);
}

/* From the middle of a branch to the centroid of its face, times the neighbour's part in it: 1 between equals
 * (kernels/models/dlsm/dlsm_flux.h). */
static void offset(const brc_simulation *s, int64_t e, int64_t h, double out[3])
{
    const brc_domain *d = s->domain;
    const int64_t j = d->neighbour[h];
    const double own = s->elastic[s->material_of_element[e]].k, other = s->elastic[s->material_of_element[j]].k;
    const double part = 2 * other / (own + other);
    for (int c = 0; c < 3; ++c)
        out[c] = part * (d->face_centroid[3 * h + c] - 0.5 * (d->position[3 * e + c] + d->position[3 * j + c]));
}

brc_status brc_dlsm_upload(brc_simulation *s)
{
    static const double none[3] = {0, 0, 0}, one[3] = {1, 0, 0}; /* missing: zero area, any ratio but zero */
    BRC_TRY(brc_geometry_shapes(s, true, brc_consistent_inverse));
    BRC_TRY(brc_geometry_materials(s));
    BRC_TRY(brc_geometry_rows(s, brc_area_of(s), 3, area, none));
    BRC_TRY(brc_geometry_rows(s, brc_offset_of(s), 3, offset, none));
    return brc_geometry_rows(s, brc_ratio_of(s), 1, ratio, one);
}
