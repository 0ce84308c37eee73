/* What is read of a state of cbm, and the least bytes of a step. */
#include "cbm.h"
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
    double *sigma = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &sigma, 6 * n, "virial stress"));
    const brc_status status = brc_beams_stress(s, 1, sigma);
    for (int64_t e = 0; status == BRC_OK && e < n; ++e) {
        if (strain) hooke_inverse(s->elastic + s->material_of_element[e], sigma + 6 * e, strain + 6 * e);
        if (stress) memcpy(stress + 6 * e, sigma + 6 * e, 6 * sizeof *sigma);
        if (cauchy) memcpy(cauchy + 6 * e, sigma + 6 * e, 6 * sizeof *sigma);
    }
    brc_memory_free(sigma);
    return status;
}

double brc_cbm_floor_bytes(const brc_simulation *s)
{
    const brc_precision precision = brc_device_get_precision(s->device);
    const double state = brc_precision_state_bytes(precision), coeff = brc_precision_coeff_bytes(precision);
    const double half_edges = (double)s->domain->n_half_edges, n = (double)s->domain->n_elements;
    const double many = brc_device_has_many_materials(s->device) ? 1 : 0;
    /* force pass: neighbour, branch, 1/length; u, q read, f and t written; motion: f, v, u, m and t, w, q, I read; v,
     * u, w, q written */
    const double force = half_edges * (4 + 4 * coeff) + n * (7 * state + 3 * many * coeff + 6 * state);
    return force + n * (3 + 3 + 3 + 1 + 3 + 3 + 4 + 1 + 3 + 3 + 3 + 4) * state;
}
