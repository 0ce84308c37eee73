/* What is read of a state of dlsm, and the least bytes of a step. */
#include "../../effects/loads/loads.h"
#include "dlsm_internal.h"
#include <string.h>

/* G = F - I of every element [n_elements][9]. */
static brc_status deformation(brc_simulation *s, double *out)
{
    /* B is dead between force evaluations: its buffer takes G */
    BRC_TRY(BRC_RUN(brc_dlsm_own_of(s)->deformation, s->n_groups,
                    {"face_loads", BRC_INT(brc_loads_n_held_faces(s) > 0 ? 1 : 0)},
                    {"deformation", BRC_BUF(brc_flux_of(s))}));
    return brc_coeff_from_rows(s, brc_flux_of(s), out, 9);
}

/* Green strain of G, or its linear part. */
static void green(const double g[9], bool finite, double e[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (int c = 0; c < 6; ++c) {
        const int i = pair[c][0], j = pair[c][1];
        e[c] = 0.5 * (g[3 * i + j] + g[3 * j + i]);
        for (int k = 0; finite && k < 3; ++k)
            e[c] += 0.5 * g[3 * k + i] * g[3 * k + j];
    }
}

/* F Sigma F^T / det F, F = I + G */
static void cauchy_of(const double g[9], const double sigma[6], double out[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const double m[3][3] = {
        {sigma[0], sigma[5], sigma[4]}, {sigma[5], sigma[1], sigma[3]}, {sigma[4], sigma[3], sigma[2]}};
    double f[3][3], t[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            f[i][j] = g[3 * i + j] + (i == j);
    const double det = f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) -
                       f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
                       f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            t[i][j] = f[i][0] * m[0][j] + f[i][1] * m[1][j] + f[i][2] * m[2][j];
    for (int c = 0; c < 6; ++c) {
        const int i = pair[c][0], j = pair[c][1];
        out[c] = (t[i][0] * f[j][0] + t[i][1] * f[j][1] + t[i][2] * f[j][2]) / det;
    }
}

brc_status brc_dlsm_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    const int64_t n = s->domain->n_elements;
    BRC_LOCAL(s->context, 9 * n, double, g, "deformation");
    const brc_status status = deformation(s, g);
    const bool finite = brc_force_is_finite(s);
    for (int64_t e = 0; status == BRC_OK && e < n; ++e) {
        double own[6], sigma[6];
        green(g + 9 * e, finite, own);
        brc_hooke(s->elastic + s->material_of_element[e], own, sigma);
        if (strain) memcpy(strain + 6 * e, own, sizeof own);
        if (stress) memcpy(stress + 6 * e, sigma, sizeof sigma);
        if (cauchy && finite) cauchy_of(g + 9 * e, sigma, cauchy + 6 * e);
        if (cauchy && !finite) memcpy(cauchy + 6 * e, sigma, sizeof sigma);
    }
    return status;
}

brc_status brc_dlsm_face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    const brc_domain *d = s->domain;
    BRC_ENDS_WITH(brc_buffer_free) brc_buffer *element = NULL;
    BRC_ENDS_WITH(brc_buffer_free) brc_buffer *arm = NULL;
    BRC_ENDS_WITH(brc_buffer_free) brc_buffer *result = NULL;
    BRC_LOCAL(s->context, n, int32_t, rows, "faces");
    BRC_LOCAL(s->context, 3 * n, double, arms, "faces");
    for (int64_t i = 0; i < n; ++i) {
        const int64_t f = faces[i], e = d->free_element[f];
        rows[i] = s->layout->row_of_element[e];
        for (int c = 0; c < 3; ++c)
            arms[3 * i + c] = d->free_centroid[3 * f + c] - d->position[3 * e + c];
    }
    BRC_TRY(brc_new_int(s, &element, rows, n, "faces"));
    BRC_TRY(brc_new_coeff(s, &arm, 3 * n, "faces"));
    BRC_TRY(brc_upload_coeff(s, arm, arms, 3 * n));
    BRC_TRY(brc_new_state(s, &result, 3 * n, "faces"));
    BRC_TRY(BRC_RUN(brc_dlsm_own_of(s)->face_displacement, n, {"element", BRC_BUF(element)}, {"arm", BRC_BUF(arm)},
                    {"out", BRC_BUF(result)}));
    const int bytes = brc_state_bytes(s);
    BRC_TRY(brc_download(s, result, bytes, out, 3 * n));
    return brc_held_faces_displacement(s, n, faces, out);
}

int brc_dlsm_step_passes(const brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES])
{
    const brc_dlsm_own *own = brc_dlsm_own_of(s);
    out[0] = (brc_step_pass){own->gradient, NULL};
    out[1] = (brc_step_pass){own->stress, NULL};
    out[2] = (brc_step_pass){own->flux, s->wants.many_materials ? NULL : "displacement"};
    out[3] = (brc_step_pass){brc_cell_breaks_by_bond(s) ? own->screening_force : own->force, NULL};
    return 4 + brc_fracture_step_passes(s, out + 4);
}
