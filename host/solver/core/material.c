/* Elastic constants derived from E and nu. */
#include "core_internal.h"

brc_elastic brc_elastic_of(const brc_material *material)
{
    const double young = material->young, nu = material->poisson;
    const double mu = young / (2 * (1 + nu)), bulk = young / (3 * (1 - 2 * nu));
    /* compaction follows the softer of shear and bulk (docs/notebook/theory.md T2) */
    const double mu_c = mu < 3 * bulk ? mu : 3 * bulk;
    const double bulk_c = bulk < 2 * mu / 3 ? bulk : 2 * mu / 3;
    const double lambda_c = bulk_c - 2 * mu_c / 3;
    return (brc_elastic){.lambda = bulk - 2 * mu / 3,
                         .mu = mu,
                         .young = young,
                         .density = material->density,
                         .k = mu_c,
                         .ell = lambda_c / (2 * mu_c)};
}

void brc_hooke(const brc_elastic *m, const double e[6], double out[6])
{
    const double pressure = m->lambda * (e[0] + e[1] + e[2]);
    for (int c = 0; c < 6; ++c)
        out[c] = 2 * m->mu * e[c] + (c < 3 ? pressure : 0);
}
