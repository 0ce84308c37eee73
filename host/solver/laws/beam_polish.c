/* A secant in r_m, whose first slope is the law's. */
#include "beam_polish.h"
#include "beam_law.h"
#include "beam_sample.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

enum { MOST_TESTS = 3, REFERENCE_SPHERES = 10000, REFERENCES = 4 };
static const double CLOSE_ENOUGH = 5e-4;

/* The request at work: the law, and the coordination numbers to enter it with. */
typedef struct work {
    brc_context *context;
    brc_device *device;
    const brc_polish_request *request;
    const brc_beam_law *law;
    double body, reading;            /* of the body; its brc_beam_law_reading */
    double *sample, *sample_reading; /* [n_samples] */
    brc_beam_states *states;         /* [n_samples][n_axes] of tests before */
} work;

/* nu and E / E_m of the body, from those of the samples. */
static brc_status test(const work *w, double radius, double *nu, double *ratio)
{
    const brc_polish_request *request = w->request;
    const double share = 1.0 / (request->n_samples * request->n_axes);
    *nu = brc_beam_law_poisson(w->law, w->body, radius);
    *ratio = 0;
    for (int k = 0; k < request->n_samples; ++k)
        for (int axis = 0; axis < request->n_axes; ++axis) {
            brc_beam_answer answer;
            const brc_beam_pull pull = {.axis = axis,
                                        .radius = radius,
                                        .beam_poisson = request->beam_poisson,
                                        .states = &w->states[k * request->n_axes + axis]};
            BRC_TRY(brc_beam_sample_pull(w->context, w->device, request->samples[k], &pull, &answer));
            *nu += share * (answer.poisson - brc_beam_law_poisson(w->law, w->sample[k], radius));
            *ratio += share * answer.young / (brc_beam_law_young(w->law, w->sample[k], radius) * w->sample_reading[k]);
        }
    *ratio *= brc_beam_law_young(w->law, w->body, radius) * w->reading;
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

/* Bonds of the body and of the samples. */
static brc_status prepare(work *w, brc_beam_body *body)
{
    const brc_polish_request *request = w->request;
    for (int k = 0; k < request->n_samples; ++k) {
        brc_beam_body own;
        if (!request->samples[k]->radius)
            return BRC_FAIL(w->context, BRC_BAD_INPUT,
                            "polish: the sample is made of cells; expected spheres joined by beams");
        if (k == 0) w->law = brc_beam_law_for(spread_of(request->samples[0]));
        BRC_TRY(brc_beam_body_of(w->context, request->samples[k], -1, &own));
        w->sample[k] = brc_beam_law_coordination(w->law, &own);
        w->sample_reading[k] = brc_beam_law_reading(&own);
        if (k == 0) *body = own;
    }
    if (request->body) *body = *request->body;
    w->body = brc_beam_law_coordination(w->law, body);
    w->reading = brc_beam_law_reading(body);
    return BRC_OK;
}

brc_status brc_beam_polish(brc_context *context, brc_device *device, const brc_polish_request *request, brc_polish *out)
{
    const double start = brc_clock_s(), poisson = request->poisson;
    work w = {.context = context, .device = device, .request = request};
    brc_beam_body body;
    brc_status status = BRC_OK;
    memset(out, 0, sizeof *out);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &w.sample, request->n_samples, "samples of a polish"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &w.sample_reading, request->n_samples, "samples of a polish"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &w.states, request->n_samples * request->n_axes, "samples of a polish"));
    BRC_TRY_OR(cleanup, prepare(&w, &body));
    BRC_TRY_OR(cleanup, brc_beam_law_invert(context, w.law, &body, poisson, request->young, &out->law_radius,
                                            &out->law_beam_young, NULL));
    const double step = 1e-3 * out->law_radius;
    double radius = out->law_radius, last_radius = 0, last_nu = 0, nu, ratio;
    double slope =
        (brc_beam_law_poisson(w.law, w.body, radius + step) - brc_beam_law_poisson(w.law, w.body, radius - step)) /
        (2 * step);
    for (;;) {
        BRC_TRY_OR(cleanup, test(&w, radius, &nu, &ratio));
        if (out->n_tests == 0) {
            out->law_poisson = nu;
            out->law_young = ratio * out->law_beam_young;
        } else if (fabs(radius - last_radius) > 0 && (nu - last_nu) / (radius - last_radius) < 0) {
            slope = (nu - last_nu) / (radius - last_radius);
        }
        if (++out->n_tests == MOST_TESTS || fabs(nu / poisson - 1) <= CLOSE_ENOUGH) break;
        last_radius = radius;
        last_nu = nu;
        radius = fmin(fmax(radius + (poisson - nu) / slope, w.law->radius[0]), w.law->radius[1]);
    }
    out->radius = radius;
    out->beam_young = request->young / ratio;
    out->poisson = nu;
    out->seconds = brc_clock_s() - start;
    if (fabs(nu / poisson - 1) > 2 * CLOSE_ENOUGH)
        brc_log(context, BRC_LOG_WARNING, "polish: nu = %.5g after %d tests, asked %.5g: the sample hardly reaches it",
                nu, out->n_tests, poisson);
cleanup:
    for (int k = 0; w.states && k < request->n_samples * request->n_axes; ++k)
        brc_beam_states_free(&w.states[k]);
    brc_memory_free(w.states);
    brc_memory_free(w.sample);
    brc_memory_free(w.sample_reading);
    return status;
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
    return scene->n_bodies == 1 && b->shape.kind == BRC_SHAPE_BOX && b->fill.kind == BRC_FILL_PACKING &&
           !b->domain_file[0] && b->n_cracks == 0 && brc_body_n_regions(b) == 0 && b->rotation[0] == 0 &&
           b->rotation[1] == 0 && b->rotation[2] == 0;
}

/* Cubes packed as the body is. */
static brc_status make_references(brc_context *context, const brc_body *body, int n_threads,
                                  brc_domain *out[REFERENCES])
{
    const brc_shape cube = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    brc_fill fill = body->fill;
    if (fill.kind != BRC_FILL_PACKING || body->domain_file[0])
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "polish: body '%s' is not packed by its scene, so no reference sample can be packed like it; "
                        "give the material's `beam` parameters, or "
                        "leave `polish` out",
                        body->name);
    if (fill.n_elements == 0 || fill.n_elements > REFERENCE_SPHERES) fill.n_elements = REFERENCE_SPHERES;
    fill.radius = 0;
    for (int k = 0; k < REFERENCES; ++k, ++fill.seed) {
        brc_beam_sample *sample;
        BRC_TRY(brc_beam_sample_pack(context, &cube, &fill, n_threads, &sample));
        const brc_status status = brc_beam_sample_bond(context, sample, body->beams, true, n_threads, &out[k]);
        brc_beam_sample_free(&sample);
        BRC_TRY(status);
    }
    return BRC_OK;
}

static brc_status polish_material(brc_context *context, brc_scene *scene, int32_t m, const brc_domain *domain,
                                  brc_device *device, int n_threads)
{
    brc_material *material = &scene->materials[m];
    const brc_body *first = NULL;
    brc_domain *reference[REFERENCES] = {NULL};
    const brc_domain *samples[REFERENCES] = {domain};
    const bool plain = is_plain_box(scene);
    brc_beam_body bonds;
    brc_polish polish;
    brc_status status = BRC_OK;
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        const brc_body *body = &scene->bodies[b];
        if (!uses(body, m)) continue;
        if (first && (body->beams != first->beams || body->fill.radius_spread != first->fill.radius_spread ||
                      body->fill.n_radii != first->fill.n_radii))
            return BRC_FAIL(
                context, BRC_BAD_INPUT,
                "polish: bodies '%s' and '%s' are packed differently and share the material '%s'; give each its own",
                first->name, body->name, material->name);
        if (!first) first = body;
    }
    if (!first || material->beam_radius > 0) return BRC_OK;
    BRC_TRY(brc_beam_body_of(context, domain, (int32_t)(first - scene->bodies), &bonds));
    if (!plain) BRC_TRY_OR(cleanup, make_references(context, first, n_threads, reference));
    for (int k = 0; !plain && k < REFERENCES; ++k)
        samples[k] = reference[k];
    const brc_polish_request request = {.n_samples = plain ? 1 : REFERENCES,
                                        .samples = samples,
                                        .n_axes = 3,
                                        .body = &bonds,
                                        .poisson = material->poisson,
                                        .young = material->young,
                                        .beam_poisson = scene->model.beam_poisson};
    BRC_TRY_OR(cleanup, brc_beam_polish(context, device, &request, &polish));
    material->beam_radius = polish.radius;
    material->beam_young = polish.beam_young;
    brc_log(context, BRC_LOG_INFO,
            "material '%s': r_m = %.4f, E_m = %.5g Pa, polished on %s in %d tests, %.1f s; by the law r_m = %.4f, E_m "
            "= %.5g Pa, which would give nu = %.4f, E = %.5g Pa; now nu = %.4f",
            material->name, polish.radius, polish.beam_young, plain ? "the sample itself" : "four reference cubes",
            polish.n_tests, polish.seconds, polish.law_radius, polish.law_beam_young, polish.law_poisson,
            polish.law_young, polish.poisson);
cleanup:
    for (int k = 0; k < REFERENCES; ++k)
        brc_domain_free(&reference[k]);
    return status;
}

brc_status brc_beam_polish_scene(brc_context *context, brc_scene *scene, const brc_domain *domain, int n_threads)
{
    brc_device *device = NULL;
    brc_status status =
        brc_device_open(context, &(brc_device_request){.selector = "cpu", .n_threads = n_threads}, &device);
    for (int32_t m = 0; status == BRC_OK && m < scene->n_materials; ++m)
        status = polish_material(context, scene, m, domain, device, n_threads);
    brc_device_close(&device);
    return status;
}
