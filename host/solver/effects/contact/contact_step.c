/* What contact and the time step bear of each other: the step that touching pairs allow, and how soft surfaces are that
 * would want a smaller one. */
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../core/sym3.h"
#include "../strikers/striker_contact.h"
#include "contact_internal.h"
#include <math.h>

static const double sphere_depth = 0.1; /* CONTACT_DEPTH of contact_law.h */

/* Stiffest normal spring of element e against material `other` [N/m]. */
static double stiffest_normal(const brc_simulation *s, int64_t e, int32_t other)
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
    return stiffest_normal(s, e, other) * fmax(1, (brc_has_spheres(s) ? 3.5 : 2.5) * rub);
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

/* ---- surfaces that would want a smaller step ---- */

static const double least_left = 0.05; /* of what holds a cell along a branch without its bond: less, and breaks take
                                          the cell off (models/dlsm/breaks.c) */
static const double endless = 3e38;    /* a limit that nothing reaches; finite in single precision [N/m, N/m^5] */

/* omega^2 of a surface alone, over that of a whole face of a cube that is as stiff as the solid, or stiffer by the laws
 * given: what the bonds' part of the step, some five times that, and its safety leave to spare
 * (bench/results/2026-11-29-cuts.md). */
static double spared(const brc_simulation *s)
{
    double safety = 0;
    for (int32_t k = 0; k < s->scene->n_stages; ++k)
        if (s->scene->stages[k].solver == BRC_SOLVER_DYNAMIC &&
            s->scene->stages[k].time_step_rule == BRC_TIME_STEP_AUTO)
            safety = fmax(safety, s->scene->stages[k].safety);
    return safety > 0.8 ? 1 : 2;
}

static void times(const double g[6], const double a[3], double out[3])
{
    out[0] = g[0] * a[0] + g[5] * a[1] + g[4] * a[2];
    out[1] = g[5] * a[0] + g[1] * a[1] + g[3] * a[2];
    out[2] = g[4] * a[0] + g[3] * a[1] + g[2] * a[2];
}
static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Of half-edge h of cell e the branch R and S / L. */
static double branch(const brc_domain *d, int64_t e, int64_t h, double r[3])
{
    for (int c = 0; c < 3; ++c)
        r[c] = d->position[3 * (int64_t)d->neighbour[h] + c] - d->position[3 * e + c];
    return brc_norm3(d->area_vector + 3 * h) / brc_norm3(r);
}

/* Inverse of the least-squares matrix A = sum (S / L) R (x) R of cell e. */
static void inverse_shape(const brc_simulation *s, int64_t e, double g[6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    const brc_domain *d = s->domain;
    double shape[6] = {0, 0, 0, 0, 0, 0}, r[3];
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        const double ratio = branch(d, e, h, r);
        for (int c = 0; c < 6; ++c)
            shape[c] += ratio * r[row[c]] * r[column[c]];
    }
    brc_sym3_pseudo_inverse(shape, brc_geometry_least_span(s), g);
}

/* 1 / m of a point of cell e at `arm` from its place, which moves by u_e + H arm = sum of c_j u_j: sum of c_j^2 / m_j,
 * c_j = arm . A^-1 s_j, c_e = 1 - sum of c_j [1/kg]. g: A^-1; lost: a half-edge whose bond is gone, or -1. 0: without
 * it the cell does not hold. */
static double yields(const brc_simulation *s, int64_t e, const double g[6], int64_t lost, const double arm[3])
{
    const brc_domain *d = s->domain;
    double p[3], own = 1, sum = 0;
    times(g, arm, p);
    if (lost >= 0) { /* (A - w R (x) R)^-1 = A^-1 + w q (x) q / (1 - w R.q), q = A^-1 R */
        double r[3], q[3];
        const double ratio = branch(d, e, lost, r);
        times(g, r, q);
        const double left = 1 - ratio * dot(r, q), more = ratio * dot(q, arm) / left;
        if (left < least_left) return 0;
        for (int c = 0; c < 3; ++c)
            p[c] += more * q[c];
    }
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        if (h == lost) continue;
        const double c = dot(p, d->area_vector + 3 * h);
        own -= c;
        sum += c * c / brc_mass_of_element(s, d->neighbour[h]);
    }
    return sum + own * own / brc_mass_of_element(s, e);
}

/* The limits that a face of cell e sets: out as contact_bearing (contact_cells.cl). */
static void bear_face(const brc_simulation *s, int64_t e, const double g[6], int64_t lost, const double *area,
                      const double *centroid, double most, double out[2])
{
    const double *x = s->domain->position + 3 * e, size = brc_norm3(area);
    const double arm[3] = {centroid[0] - x[0], centroid[1] - x[1], centroid[2] - x[2]};
    const double yielding = yields(s, e, g, lost, arm);
    if (!(yielding > 0)) return;
    const double limit = most / (2 * yielding); /* one spring between two like surfaces */
    out[0] = fmin(out[0], limit / (size * size));
    out[1] = fmin(out[1], limit);
}

static void bear_cell(const brc_simulation *s, int64_t e, double most, double out[2])
{
    const brc_domain *d = s->domain;
    double g[6];
    inverse_shape(s, e, g);
    for (int64_t f = d->free_start[e]; f < d->free_start[e + 1]; ++f)
        bear_face(s, e, g, -1, d->free_area_vector + 3 * f, d->free_centroid + 3 * f, most, out);
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1] && s->scene->has_fracture; ++h)
        bear_face(s, e, g, h, d->area_vector + 3 * h, d->face_centroid + 3 * h, most, out);
}

/* Of elements [n_elements][2]. */
static brc_status find_bearing(const brc_simulation *s, double *bears)
{
    const brc_domain *d = s->domain;
    double most = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double k = s->elastic[s->material_of_element[e]].young * cbrt(d->volume[e]);
        for (int32_t other = 0; other < s->scene->n_materials; ++other)
            k = fmax(k, stiffest_normal(s, e, other));
        most = fmax(most, 4 * spared(s) * k / brc_mass_of_element(s, e));
    }
#pragma omp parallel for schedule(static)
    for (int64_t e = 0; e < d->n_elements; ++e) {
        bears[2 * e] = bears[2 * e + 1] = endless;
        if (brc_domain_mine(d, e) && d->row_start[e + 1] > d->row_start[e]) bear_cell(s, e, most, bears + 2 * e);
    }
    return d->here ? brc_domain_elements(s->context, d, 2, bears) : BRC_OK;
}

brc_status brc_contact_set_bearing(brc_simulation *s)
{
    const brc_contact_state *c = s->contact;
    const int64_t n = s->layout->n_rows, solids = n + c->n_pieces;
    if (!c->bears) return BRC_OK;
    BRC_LOCAL(s->context, 2 * s->domain->n_elements, double, bears, "stiffness that surfaces bear");
    BRC_LOCAL(s->context, 2 * solids, double, value, "stiffness that surfaces bear");
    if (c->affine)
        BRC_TRY(find_bearing(s, bears)); /* rigid cells: thin ones have 2.8 times a cube's, and no neighbours */
    for (int64_t r = 0; r < solids; ++r) {
        const int32_t e = r < n ? s->layout->element_of_row[r] : -1;
        for (int k = 0; k < 2; ++k)
            value[2 * r + k] = e >= 0 && c->affine ? bears[2 * (int64_t)e + k] : endless;
    }
    return brc_upload_state(s, c->bears, value, 2 * solids);
}
