/* A secant in r_m, whose first slope is the law's. */
#include "beam_polish.h"
#include "beam_law.h"
#include "beam_sample.h"
#include "../base/log.h"
#include <math.h>
#include <string.h>

enum { MOST_TESTS = 3, REFERENCE_SPHERES = 10000 };
static const double CLOSE_ENOUGH = 5e-4;

/* nu and E / E_m, means over the axes. */
static brc_status test(brc_context *context, brc_device *device, const brc_domain *domain, double radius, double beam_poisson, double *nu, double *ratio)
{
    *nu = *ratio = 0;
    for (int axis = 0; axis < 3; ++axis) {
        brc_beam_answer answer;
        BRC_TRY(brc_beam_sample_pull(context, device, domain, &(brc_beam_pull){.axis = axis, .radius = radius, .beam_poisson = beam_poisson}, &answer));
        *nu += answer.poisson / 3;
        *ratio += answer.young / 3;
    }
    return BRC_OK;
}

/* Half width of the spread of the radii. */
static double spread_of(const brc_domain *domain)
{
    double sum = 0, least = INFINITY, most = 0;
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        sum += domain->radius[e];
        least = fmin(least, domain->radius[e]);
        most = fmax(most, domain->radius[e]);
    }
    return (most - least) / 2 / (sum / (double)domain->n_elements);
}

brc_status brc_beam_polish(brc_context *context, brc_device *device, const brc_domain *domain, double poisson, double young, double beam_poisson,
                           brc_polish *out)
{
    const double start = brc_clock_s();
    const double coordination = 2.0 * (double)domain->n_bonds / (double)domain->n_elements;
    memset(out, 0, sizeof *out);
    if (!domain->radius) return BRC_FAIL(context, BRC_BAD_INPUT, "polish: the sample is made of cells; expected spheres joined by beams");
    const brc_beam_law *law = brc_beam_law_for(spread_of(domain));
    BRC_TRY(brc_beam_law_invert(context, law, coordination, poisson, young, &out->law_radius, &out->law_beam_young, NULL));
    const double step = 1e-3 * out->law_radius;
    double radius = out->law_radius, last_radius = 0, last_nu = 0, nu, ratio;
    double slope = (brc_beam_law_poisson(law, coordination, radius + step) - brc_beam_law_poisson(law, coordination, radius - step)) / (2 * step);
    for (;;) {
        BRC_TRY(test(context, device, domain, radius, beam_poisson, &nu, &ratio));
        if (out->n_tests == 0) {
            out->law_poisson = nu;
            out->law_young = ratio * out->law_beam_young;
        } else if (fabs(radius - last_radius) > 0 && (nu - last_nu) / (radius - last_radius) < 0) {
            slope = (nu - last_nu) / (radius - last_radius);
        }
        if (++out->n_tests == MOST_TESTS || fabs(nu / poisson - 1) <= CLOSE_ENOUGH) break;
        last_radius = radius;
        last_nu = nu;
        radius = fmin(fmax(radius + (poisson - nu) / slope, law->radius[0]), law->radius[1]);
    }
    out->radius = radius;
    out->beam_young = young / ratio;
    out->poisson = nu;
    out->seconds = brc_clock_s() - start;
    if (fabs(nu / poisson - 1) > 2 * CLOSE_ENOUGH)
        brc_log(context, BRC_LOG_WARNING, "polish: nu = %.5g after %d tests, asked %.5g: the sample hardly reaches it", nu, out->n_tests, poisson);
    return BRC_OK;
}

static bool uses(const brc_body *body, int32_t material)
{
    for (int32_t r = 0; r <= brc_body_n_regions(body); ++r)
        if (brc_body_material(body, r) == material) return true;
    return false;
}

/* Is the scene's domain itself a sample that can be pulled? */
static bool is_plain_box(const brc_scene *scene)
{
    const brc_body *b = &scene->bodies[0];
    return scene->n_bodies == 1 && b->shape.kind == BRC_SHAPE_BOX && b->fill.kind == BRC_FILL_PACKING && !b->domain_file[0] && b->n_cracks == 0 &&
           brc_body_n_regions(b) == 0 && b->rotation[0] == 0 && b->rotation[1] == 0 && b->rotation[2] == 0;
}

/* A cube packed as the body is. */
static brc_status make_reference(brc_context *context, const brc_body *body, int n_threads, brc_domain **out)
{
    const brc_shape cube = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    brc_fill fill = body->fill;
    brc_beam_sample *sample;
    if (fill.kind != BRC_FILL_PACKING || body->domain_file[0])
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "polish: body '%s' is not packed by its scene, so no reference sample can be packed like it; give the material's `beam` parameters, or "
                        "leave `polish` out", body->name);
    if (fill.n_elements == 0 || fill.n_elements > REFERENCE_SPHERES) fill.n_elements = REFERENCE_SPHERES;
    fill.radius = 0;
    BRC_TRY(brc_beam_sample_pack(context, &cube, &fill, n_threads, &sample));
    const brc_status status = brc_beam_sample_bond(context, sample, body->beams, n_threads, out);
    brc_beam_sample_free(&sample);
    return status;
}

static brc_status polish_material(brc_context *context, brc_scene *scene, int32_t m, const brc_domain *domain, brc_device *device, int n_threads)
{
    brc_material *material = &scene->materials[m];
    const brc_body *first = NULL;
    brc_domain *reference = NULL;
    brc_polish polish;
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        const brc_body *body = &scene->bodies[b];
        if (!uses(body, m)) continue;
        if (first && (body->beams != first->beams || body->fill.radius_spread != first->fill.radius_spread || body->fill.n_radii != first->fill.n_radii))
            return BRC_FAIL(context, BRC_BAD_INPUT, "polish: bodies '%s' and '%s' are packed differently and share the material '%s'; give each its own", first->name,
                            body->name, material->name);
        if (!first) first = body;
    }
    if (!first || material->beam_radius > 0) return BRC_OK;
    if (!is_plain_box(scene)) BRC_TRY(make_reference(context, first, n_threads, &reference));
    const brc_status status = brc_beam_polish(context, device, reference ? reference : domain, material->poisson, material->young, scene->model.beam_poisson, &polish);
    brc_domain_free(&reference);
    BRC_TRY(status);
    material->beam_radius = polish.radius;
    material->beam_young = polish.beam_young;
    brc_log(context, BRC_LOG_INFO,
            "material '%s': r_m = %.4f, E_m = %.5g Pa, polished on %s in %d tests, %.1f s; the law's r_m = %.4f, E_m = %.5g Pa gave nu = %.4f, E = %.5g Pa there, now nu = %.4f",
            material->name, polish.radius, polish.beam_young, is_plain_box(scene) ? "the sample itself" : "a reference cube", polish.n_tests, polish.seconds,
            polish.law_radius, polish.law_beam_young, polish.law_poisson, polish.law_young, polish.poisson);
    return BRC_OK;
}

brc_status brc_beam_polish_scene(brc_context *context, brc_scene *scene, const brc_domain *domain, int n_threads)
{
    brc_device *device = NULL;
    brc_status status = brc_device_open(context, &(brc_device_request){.selector = "cpu", .n_threads = n_threads}, &device);
    for (int32_t m = 0; status == BRC_OK && m < scene->n_materials; ++m) status = polish_material(context, scene, m, domain, device, n_threads);
    brc_device_close(&device);
    return status;
}
