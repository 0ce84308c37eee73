#include "spheres.h"
#include "support.h"

#include "../../host/base/memory.h"
#include "../../host/base/random.h"
#include "../../preprocess/packing/beams.h"
#include "../../preprocess/domain/quality.h"
#include "../../preprocess/domain/sets.h"

#include <string.h>

static void require(brc_context *context, brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
}

brc_domain *test_spheres(brc_context *context, const int count[3], double coordination, int32_t body, int n_threads)
{
    const int64_t n = (int64_t)count[0] * count[1] * count[2];
    brc_shape box = {.kind = BRC_SHAPE_BOX, .size = {count[0], count[1], count[2]}};
    brc_domain *d;
    brc_solid *solid;
    double *x, *r;
    require(context, BRC_ALLOCATE(context, &d, 1, "domain"));
    require(context, BRC_ALLOCATE(context, &x, 3 * n, "positions"));
    require(context, BRC_ALLOCATE(context, &r, n, "radii"));
    for (int64_t e = 0; e < n; ++e) {
        const int64_t at[3] = {e % count[0], e / count[0] % count[1], e / count[0] / count[1]};
        double u[4];
        brc_random_uniform4(7, BRC_RANDOM_TEST, (uint64_t)e, 0, u);
        r[e] = 0.45 * (0.9 + 0.2 * u[3]);
        for (int c = 0; c < 3; ++c) {
            x[3 * e + c] = (double)at[c] + 0.4 + 0.2 * u[c];
            if (at[c] == 0) x[3 * e + c] = r[e];
            if (at[c] == count[c] - 1) x[3 * e + c] = count[c] - r[e];
        }
    }
    require(context, brc_solid_create(context, &box, n_threads, &solid));
    require(context, brc_beams_build(context, solid, x, r, n, coordination, false, n_threads, d));
    d->quality.volume_shape = brc_solid_volume(solid, NULL);
    brc_solid_free(&solid);
    require(context, BRC_ALLOCATE(context, &d->region, n, "regions"));
    require(context, BRC_ALLOCATE(context, &d->body, n, "bodies"));
    for (int64_t e = 0; e < n; ++e)
        d->body[e] = body;
    brc_quality_measure(d, n_threads);
    brc_beams_fill(d, d->quality.volume_fraction);
    require(context, brc_sets_build(context, 0, NULL, d));
    require(context, BRC_ALLOCATE(context, &d->provenance, 8, "provenance"));
    strcpy(d->provenance, "by hand");
    require(context, brc_domain_check(context, d));
    return d;
}
