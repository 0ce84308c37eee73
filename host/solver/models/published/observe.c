/* What is read of a state of dlsm-published, and the least bytes of a step. */
#include "published_internal.h"
#include <string.h>

brc_status brc_published_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy)
{
    const int64_t n = s->domain->n_elements;
    BRC_LOCAL(s->context, 6 * n, double, own, "strains");
    const brc_status status = brc_coeff_from_rows(s, brc_gradient_of(s), own, 6);
    for (int64_t e = 0; status == BRC_OK && e < n; ++e) {
        double sigma[6];
        brc_hooke(s->elastic + s->material_of_element[e], own + 6 * e, sigma);
        if (strain) memcpy(strain + 6 * e, own + 6 * e, sizeof sigma);
        if (stress) memcpy(stress + 6 * e, sigma, sizeof sigma);
        if (cauchy) memcpy(cauchy + 6 * e, sigma, sizeof sigma);
    }
    return status;
}

brc_status brc_published_face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out)
{
    const brc_domain *d = s->domain;
    BRC_LOCAL(s->context, 3 * d->n_elements, double, u, "displacements");
    BRC_LOCAL(s->context, 4 * d->n_elements, double, q, "orientations");
    BRC_TRY(brc_state_from_rows(s, brc_displacement_of(s), u, 3));
    BRC_TRY(brc_state_from_rows(s, brc_orientation_of(s), q, 4));
    for (int64_t i = 0; i < n; ++i) {
        const int64_t f = faces[i], e = d->free_element[f];
        double a[3], once[3], twice[3];
        const double w = q[4 * e], *v = q + 4 * e + 1;
        for (int c = 0; c < 3; ++c)
            a[c] = d->free_centroid[3 * f + c] - d->position[3 * e + c];
        for (int c = 0; c < 3; ++c)
            once[c] = v[(c + 1) % 3] * a[(c + 2) % 3] - v[(c + 2) % 3] * a[(c + 1) % 3];
        for (int c = 0; c < 3; ++c)
            twice[c] = v[(c + 1) % 3] * once[(c + 2) % 3] - v[(c + 2) % 3] * once[(c + 1) % 3];
        for (int c = 0; c < 3; ++c)
            out[3 * i + c] = u[3 * e + c] + 2 * (w * once[c] + twice[c]);
    }
    return BRC_OK;
}

int brc_published_step_passes(const brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES])
{
    static const char of_marked[] =
        "row_start neighbour branch area displacement orientation strain lame_of limit mark "
        "measure touched found";
    const brc_published_own *own = brc_published_own_of(s);
    const bool by_bond = brc_cell_breaks_by_bond(s);
    out[0] =
        (brc_step_pass){s->fracture ? own->breaking_strain : own->strain, s->scene->model.area_weights ? NULL : "area"};
    out[1] = (brc_step_pass){by_bond ? own->breaking_force : own->force, NULL};
    if (!by_bond) return 2 + brc_fracture_step_passes(s, out + 2);
    out[2] = (brc_step_pass){own->check, of_marked};
    return 3;
}
