#include "material_volume.h"
#include "../../../preprocess/domain/sets.h"
#include <math.h>

enum { STIFF, SOFT, HEAVY, MEANS };

/* Sums over a body of volume times E, 1 / E and density. */
static void add(double sum[MEANS], const brc_material *material, double volume)
{
    sum[STIFF] += volume * material->young;
    sum[SOFT] += volume / material->young;
    sum[HEAVY] += volume * material->density;
}

/* The region at x; the last wins, as where cells are given theirs. */
static int32_t region_at(const brc_body *body, double mean_spacing, double x[3])
{
    const brc_domain point = {.n_elements = 1, .position = x, .quality.mean_spacing = mean_spacing};
    for (int32_t r = body->n_regions; r > 0; --r)
        if (brc_predicate_holds(&body->regions[r - 1].where, BRC_SET_ELEMENTS, &point, 0)) return r;
    return 0;
}

/* Two directions across a face. */
static void across_face(const double area[3], double out[2][3])
{
    const double size = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    int least = 0;
    for (int k = 1; k < 3; ++k)
        if (fabs(area[k]) < fabs(area[least])) least = k;
    double length = 0;
    for (int k = 0; k < 3; ++k) {
        out[0][k] = (k == least) - area[least] * area[k] / (size * size);
        length += out[0][k] * out[0][k];
    }
    for (int k = 0; k < 3; ++k)
        out[0][k] /= sqrt(length);
    for (int k = 0; k < 3; ++k)
        out[1][k] = (area[(k + 1) % 3] * out[0][(k + 2) % 3] - area[(k + 2) % 3] * out[0][(k + 1) % 3]) / size;
}

/* The pyramid from the seed of a cell to a face of it, by four points: where the quarters of one with a square foot
 * have their middles. */
static void add_pyramid(double sum[MEANS], const brc_scene *scene, const brc_body *body, const brc_domain *d, int64_t e,
                        const double centre[3], const double area[3])
{
    double volume = 0, direction[2][3], to[3];
    const double foot = sqrt(sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2])) / 4;
    if (!(foot > 0)) return;
    across_face(area, direction);
    for (int k = 0; k < 3; ++k) {
        to[k] = centre[k] - d->position[3 * e + k];
        volume += to[k] * area[k] / 3;
    }
    for (int corner = 0; corner < 4; ++corner) {
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = d->position[3 * e + k] + 0.75 * (to[k] + foot * ((corner & 1 ? direction[0][k] : -direction[0][k]) +
                                                                    (corner & 2 ? direction[1][k] : -direction[1][k])));
        add(sum, &scene->materials[brc_body_material(body, region_at(body, d->quality.mean_spacing, x))], volume / 4);
    }
}

static double error_of_body(const brc_scene *scene, const brc_domain *d, int32_t b)
{
    const brc_body *body = &scene->bodies[b];
    double made[MEANS] = {0}, wanted[MEANS] = {0}, worst = 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (d->body[e] != b) continue;
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
            add_pyramid(wanted, scene, body, d, e, &d->face_centroid[3 * h], &d->area_vector[3 * h]);
        for (int64_t f = d->free_start[e]; f < d->free_start[e + 1]; ++f)
            add_pyramid(wanted, scene, body, d, e, &d->free_centroid[3 * f], &d->free_area_vector[3 * f]);
        add(made, &scene->materials[brc_body_material(body, d->region[e])], d->volume[e]);
    }
    for (int m = 0; m < MEANS; ++m)
        if (wanted[m] > 0) worst = fmax(worst, fabs(made[m] / wanted[m] - 1));
    return worst;
}

static bool is_told_by_place(const brc_body *body)
{
    bool by_place = body->n_regions > 0 && body->n_phases == 0;
    for (int32_t r = 0; r < body->n_regions; ++r)
        by_place &= !body->regions[r].where.has_wall;
    return by_place;
}

double brc_material_volume_error(const brc_setup *setup)
{
    double worst = 0;
    for (int32_t k = 0; k < setup->n; ++k) {
        const brc_scene *scene = setup->split->part[k].scene;
        for (int32_t b = 0; b < scene->n_bodies && setup->domain[k]->element_kind == BRC_ELEMENT_CELL; ++b)
            if (is_told_by_place(&scene->bodies[b])) worst = fmax(worst, error_of_body(scene, setup->domain[k], b));
    }
    return worst;
}
