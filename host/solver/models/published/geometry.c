/* Bonds of dlsm-published on the device: branches and areas. */
#include "published_internal.h"
#include <math.h>

static void surface(const brc_simulation *s, int64_t e, int64_t h, double out[3])
{
    const double *area = s->domain->area_vector + 3 * h;
    (void)e;
    out[0] = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
}

brc_status brc_published_upload(brc_simulation *s)
{
    static const double none[3] = {0, 0, 0};
    BRC_TRY(brc_geometry_shapes(s, s->scene->model.area_weights, NULL));
    BRC_TRY(brc_geometry_materials(s));
    BRC_TRY(brc_geometry_branches(s, brc_offset_of(s)));
    return brc_geometry_rows(s, brc_area_of(s), 1, surface, none);
}
