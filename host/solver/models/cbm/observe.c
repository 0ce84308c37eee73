/* What is read of a state of cbm, and the least bytes of a step. */
#include "../../effects/fracture/breaking.h"
#include "cbm_internal.h"
#include <string.h>

/* Strain that Hooke's law of the material gives for a stress. */
static void hooke_inverse(const brc_elastic *m, const double sigma[6], double out[6])
{
    const double nu = m->lambda / (2 * (m->lambda + m->mu)), trace = sigma[0] + sigma[1] + sigma[2];
    for (int c = 0; c < 6; ++c)
        out[c] = c < 3 ? ((1 + nu) * sigma[c] - nu * trace) / m->young : sigma[c] / (2 * m->mu);
}

brc_status brc_cbm_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    const int64_t n = s->domain->n_elements;
    BRC_LOCAL(s->context, 6 * n, double, sigma, "virial stress");
    const brc_status status = brc_beams_stress(s, 1, sigma);
    for (int64_t e = 0; status == BRC_OK && e < n; ++e) {
        if (strain) hooke_inverse(s->elastic + s->material_of_element[e], sigma + 6 * e, strain + 6 * e);
        if (stress) memcpy(stress + 6 * e, sigma + 6 * e, 6 * sizeof *sigma);
        if (cauchy) memcpy(cauchy + 6 * e, sigma + 6 * e, 6 * sizeof *sigma);
    }
    return status;
}

int brc_cbm_step_passes(const brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES])
{
    const brc_cbm_own *own = brc_cbm_own_of(s);
    out[0] = (brc_step_pass){s->fracture ? own->breaking_force : own->force, "rubs other bears"};
    return 1 + brc_fracture_step_passes(s, out + 1);
}
