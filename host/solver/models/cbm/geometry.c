/* Bonds of cbm on the device: branches and inverse lengths. */
#include "cbm_internal.h"
#include <math.h>

static void inverse_length(const brc_simulation *s, int64_t e, int64_t h, double out[3])
{
    const brc_domain *d = s->domain;
    const int64_t j = d->neighbour[h];
    double branch[3];
    for (int c = 0; c < 3; ++c)
        branch[c] = d->position[3 * j + c] - d->position[3 * e + c];
    out[0] = 1 / sqrt(branch[0] * branch[0] + branch[1] * branch[1] + branch[2] * branch[2]);
}

brc_status brc_cbm_upload(brc_simulation *s)
{
    static const double none[3] = {0, 0, 0}; /* missing: no stiffness */
    BRC_TRY(brc_beams_upload(s));
    BRC_TRY(brc_geometry_branches(s, brc_offset_of(s)));
    return brc_geometry_rows(s, brc_ratio_of(s), 1, inverse_length, none);
}
