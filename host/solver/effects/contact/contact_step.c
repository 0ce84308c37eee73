/* The time step that touching pairs allow. */
#include "../strikers/striker_contact.h"
#include "contact_internal.h"
#include <math.h>

static const double sphere_depth = 0.1; /* CONTACT_DEPTH of contact_law.h */

double brc_contact_stiffest_normal(const brc_simulation *s, int64_t e, int32_t other)
{
    const brc_domain *d = s->domain;
    const double *law = brc_contact_law_of(s, s->material_of_element[e], other);
    if (law[2] > 0) return law[2];
    if (!brc_has_spheres(s)) return law[1] * cbrt(d->volume[e]); /* a cube of edge h: k_n A^2 / h^3 = k_n h */
    return s->scene->contact.spheres == BRC_SPHERES_LINEAR ? law[0] * d->radius[e]
                                                           : 2 * law[0] * d->radius[e] * sqrt(sphere_depth);
}

/* The same, or the tangential spring with what turning adds to it, if that is more: a sphere has R^2 / I = 5 / (2 m), a
 * cube of edge h (h / 2)^2 / I = 3 / (2 m). */
static double stiffest(const brc_simulation *s, int64_t e, int32_t other)
{
    const double *law = brc_contact_law_of(s, s->material_of_element[e], other);
    const double rub = law[4] > 0 ? law[3] : 0;
    return brc_contact_stiffest_normal(s, e, other) * fmax(1, (brc_has_spheres(s) ? 3.5 : 2.5) * rub);
}

/* The largest area in which a striker meets the bodies: of the boxes around both, the smaller section across an axis
 * [m^2]. */
static double meeting_area(const brc_simulation *s, int32_t striker)
{
    const brc_striker_surface *surface = &brc_simulation_striker_body(s, striker)->surface;
    const double(*b)[3] = s->domain->bounds;
    double width[2][3] = {{0}}, most = 0;
    for (int c = 0; c < 3; ++c) {
        double low = INFINITY, high = -INFINITY;
        for (int32_t k = 0; k < surface->n_corners; ++k) {
            low = fmin(low, surface->corner[3 * (int64_t)k + c]);
            high = fmax(high, surface->corner[3 * (int64_t)k + c]);
        }
        width[0][c] = high - low;
        width[1][c] = b[1][c] - b[0][c];
    }
    for (int c = 0; c < 3; ++c) {
        const int i = (c + 1) % 3, j = (c + 2) % 3;
        most = fmax(most, fmin(width[0][i] * width[0][j], width[1][i] * width[1][j]));
    }
    return most;
}

/* omega^2 of a free striker on all n elements that it may touch at once, their springs k in one with sum K: k (u - U)^2
 * <= 2 k u^2 + 2 k U^2, so 4 k / m for elements between two springs and 2 K / M for the striker; turning, springs at
 * its rim have up to three times that arm squared over its gyration's. Dashpots, each a share b of what is critical for
 * its pair of reduced mass m', together are a share z = b sqrt(n m' / M) of it for the striker: such an oscillator
 * bears steps up to 2 / omega (sqrt(1 + z^2) - z). */
static double fastest_striker(const brc_simulation *s)
{
    const brc_domain *d = s->domain;
    double fastest = 0;
    for (int32_t i = 0; i < brc_simulation_n_strikers(s); ++i) {
        const brc_striker *striker = s->scene->strikers + i;
        const double mass = brc_simulation_striker_body(s, i)->mass;
        double stiffness = 0, damping = 0; /* of unit area: K [N/m^3], n m' b^2 [kg/m^2] */
        if (striker->motion != BRC_STRIKER_FREE) continue;
        for (int64_t e = 0; e < d->n_elements; ++e) {
            const double size = brc_has_spheres(s) ? 2 * d->radius[e] : cbrt(d->volume[e]),
                         share = brc_contact_law_of(s, s->material_of_element[e], striker->material)[5];
            const double own = brc_mass_of_element(s, e);
            stiffness = fmax(stiffness, stiffest(s, e, striker->material) / (size * size));
            damping = fmax(damping, share * share * own * mass / ((own + mass) * size * size));
        }
        const double area = meeting_area(s, i), z = sqrt(damping * area / mass), slower = sqrt(1 + z * z) - z;
        fastest = fmax(fastest, (striker->held_rotation ? 2 : 8) * stiffness * area / (mass * slower * slower));
    }
    return fastest;
}

/* Two bodies of mass m pressed together from either side by springs k: omega^2 = 2 k / m at a wall or between two
 * springs and 4 k / m between two equal bodies. */
brc_status brc_contact_critical_step(brc_simulation *s, double *out)
{
    const brc_domain *d = s->domain;
    *out = INFINITY;
    if (!s->contact) return BRC_OK;
    double fastest = fastest_striker(s);
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int32_t other = 0; other < s->scene->n_materials; ++other)
            fastest = fmax(fastest,
                           4 * stiffest(s, e, other) / (d->volume[e] * s->elastic[s->material_of_element[e]].density));
    *out = 2 / sqrt(fastest);
    return BRC_OK;
}

/* Two equal elements without bonds are an oscillator of half their mass between their surfaces: half a period of it is
 * a blow. */
void brc_contact_check_step(const brc_simulation *s, const char *stage, double touching, const brc_time_step *step)
{
    static const double enough = 20; /* steps of a blow: restitutions are met to 0.02 (docs/notebook/contact.md) */
    const brc_domain *d = s->domain;
    const double steps = M_PI / sqrt(2) * touching / step->value;
    bool damped = false, loose = s->scene->has_fracture;
    if (!s->contact || !(steps < enough)) return;
    for (int64_t k = 0; k < (int64_t)s->scene->n_materials * s->scene->n_materials; ++k)
        damped = damped || s->contact->law_of[k * BRC_CONTACT_LAW + 5] > 0;
    for (int64_t e = 0; e < d->n_elements && !loose; ++e)
        loose = d->row_start[e + 1] == d->row_start[e];
    if (!damped || !loose) return;
    brc_log(s->context, BRC_LOG_INFO,
            "stage '%s': elements without bonds may be through a blow in %.2g steps, too few for the restitution that "
            "is asked for; %g steps meet it to two hundredths: "
            "time_step: {auto: {safety: %.2g}}",
            stage, steps, enough, step->safety * steps / enough);
}
