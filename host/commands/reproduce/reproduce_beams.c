/* Elastic tests of samples of beams that differ by their seed alone (NAH19 section 4.1): E and nu of a material whose
 * beams follow from the laws, from `beam` parameters, or from the polish on one sample, tried on a fresh one. */
#include "operators.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "../../solver/laws/beam_law.h"
#include "../../solver/laws/beam_polish.h"
#include "../../solver/laws/beam_sample.h"
#include <math.h>
#include <omp.h>
#include <stddef.h>
#include <string.h>

/* Packings of the runs so far: those of other materials and coordination numbers are the same. */
struct brc_sample_store {
    brc_shape shape;
    brc_fill fill;
    int n;
    brc_beam_sample *
        *sample; /* [n] seeds fill.seed, fill.seed + 1 ...; with polish the first half is polished, the second fresh */
};

void brc_sample_store_free(struct brc_sample_store **store)
{
    if (!store || !*store) return;
    for (int k = 0; k < (*store)->n; ++k)
        brc_beam_sample_free(&(*store)->sample[k]);
    brc_memory_free((*store)->sample);
    brc_memory_free(*store);
    *store = NULL;
}

/* What one sample gave. */
typedef struct result {
    double nu, young; /* along x, with the parameters below; with polish: of a fresh sample, means over its axes */
    double radius, beam_young;
    double nu_axis, young_axis; /* with polish along x and y: of the same sample along z */
    int64_t n_bonds;
} result;

typedef struct work {
    brc_context *context;
    const brc_scene *scene;
    struct brc_sample_store *store;
    result *results; /* [n_seeds] */
    brc_status status;
} work;

static void fail(work *w, brc_status status, const char *message)
{
#pragma omp critical(brc_reproduce_beams)
    if (w->status == BRC_OK) w->status = BRC_FAIL(w->context, status, "%s", message);
}

/* nu and E along some axes, means. */
static brc_status pull(const work *w, brc_context *context, brc_device *device, const brc_domain *domain, int from,
                       int to, double radius, double beam_young, double *nu, double *young)
{
    *nu = *young = 0;
    for (int axis = from; axis < to; ++axis) {
        brc_beam_answer a;
        BRC_TRY(brc_beam_sample_pull(
            context, device, domain,
            &(brc_beam_pull){.axis = axis, .radius = radius, .beam_poisson = w->scene->model.beam_poisson}, &a));
        *nu += a.poisson / (to - from);
        *young += a.young * beam_young / (to - from);
    }
    return BRC_OK;
}

/* Parameters polished on a sample along all axes, tried on a fresh one that the polish knows the bonds of, as of any
 * body; and polished along two axes, tried along the third. */
static brc_status try_polish(const work *w, brc_context *context, brc_device *device, const brc_domain *domain,
                             const brc_domain *fresh, result *out)
{
    const brc_material *material = &w->scene->materials[0];
    brc_beam_body bonds;
    brc_polish polish;
    BRC_TRY(brc_beam_body_of(context, fresh, -1, &bonds));
    brc_polish_request request = {.n_samples = 1,
                                  .samples = &domain,
                                  .n_axes = 3,
                                  .body = &bonds,
                                  .poisson = material->poisson,
                                  .young = material->young,
                                  .beam_poisson = w->scene->model.beam_poisson};
    BRC_TRY(brc_beam_polish(context, device, &request, &polish));
    out->radius = polish.radius;
    out->beam_young = polish.beam_young;
    BRC_TRY(pull(w, context, device, fresh, 0, 3, polish.radius, polish.beam_young, &out->nu, &out->young));
    request.body = NULL;
    request.n_axes = 2;
    BRC_TRY(brc_beam_polish(context, device, &request, &polish));
    return pull(w, context, device, domain, 2, 3, polish.radius, polish.beam_young, &out->nu_axis, &out->young_axis);
}

static brc_status try_sample(const work *w, brc_context *context, brc_device *device, int k, result *out)
{
    const brc_scene *scene = w->scene;
    const brc_material *material = &scene->materials[0];
    const double coordination = scene->bodies[0].beams;
    brc_domain *domain = NULL, *fresh = NULL;
    brc_beam_body bonds;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup,
               brc_beam_sample_bond(context, w->store->sample[k], coordination, scene->model.polish, 1, &domain));
    out->n_bonds = domain->n_bonds;
    if (scene->model.polish) {
        BRC_TRY_OR(cleanup,
                   brc_beam_sample_bond(context, w->store->sample[w->store->n / 2 + k], coordination, true, 1, &fresh));
        BRC_TRY_OR(cleanup, try_polish(w, context, device, domain, fresh, out));
        goto cleanup;
    }
    out->radius = material->beam_radius;
    out->beam_young = material->beam_young;
    BRC_TRY_OR(cleanup, brc_beam_body_of(context, domain, -1, &bonds));
    if (!(out->radius > 0))
        BRC_TRY_OR(cleanup,
                   brc_beam_law_invert(context, brc_beam_law_for(scene->bodies[0].fill.radius_spread), &bonds,
                                       material->poisson, material->young, &out->radius, &out->beam_young, NULL));
    BRC_TRY_OR(cleanup, pull(w, context, device, domain, 0, 1, out->radius, out->beam_young, &out->nu, &out->young));
cleanup:
    brc_domain_free(&domain);
    brc_domain_free(&fresh);
    return status;
}

/* Packings first, then tests: a thread a sample. packing: which of the two. */
static void share(work *w, int n, int n_threads, bool packing)
{
#pragma omp parallel for schedule(dynamic, 1) num_threads(n_threads)
    for (int k = 0; k < n; ++k) {
        brc_context *context = brc_context_create();
        brc_device *device = NULL;
        if (!context) {
            fail(w, BRC_NO_MEMORY, "no memory for the threads of a run");
            continue;
        }
        brc_log_set_level(context, BRC_LOG_ERROR);
        brc_fill fill = w->store->fill;
        fill.seed += (uint64_t)k;
        brc_status status =
            packing ? brc_beam_sample_pack(context, &w->store->shape, &fill, 1, &w->store->sample[k])
                    : brc_device_open(context, &(brc_device_request){.selector = "cpu", .n_threads = 1}, &device);
        if (status == BRC_OK && !packing) status = try_sample(w, context, device, k, &w->results[k]);
        if (status != BRC_OK) fail(w, status, brc_context_message(context));
        brc_device_close(&device);
        brc_context_free(&context);
    }
}

static brc_status find_samples(brc_campaign *campaign, work *w, int n, int n_threads)
{
    const brc_body *body = &w->scene->bodies[0];
    struct brc_sample_store *store = campaign->samples;
    if (store && store->n == n && memcmp(&store->shape, &body->shape, sizeof body->shape) == 0 &&
        memcmp(&store->fill, &body->fill, sizeof body->fill) == 0) {
        w->store = store;
        return BRC_OK;
    }
    brc_sample_store_free(&campaign->samples);
    BRC_TRY(BRC_ALLOCATE(w->context, &campaign->samples, 1, "samples of a case"));
    w->store = store = campaign->samples;
    BRC_TRY(BRC_ALLOCATE(w->context, &store->sample, n, "samples of a case"));
    store->n = n;
    memcpy(&store->shape, &body->shape, sizeof body->shape);
    memcpy(&store->fill, &body->fill, sizeof body->fill);
    share(w, n, n_threads, true);
    return w->status;
}

/* Mean over the samples with its scatter. */
static void add_mean(brc_outcome *outcome, const char *name, const char *unit, const result *results, int n,
                     size_t member, double reference)
{
    double mean = 0, square = 0;
    for (int k = 0; k < n; ++k)
        mean += *(const double *)((const char *)&results[k] + member) / n;
    for (int k = 0; k < n; ++k) {
        const double off = *(const double *)((const char *)&results[k] + member) - mean;
        square += off * off;
    }
    brc_outcome_add(outcome, name, unit, mean, reference);
    if (n > 1) outcome->values[outcome->n_values - 1].scatter = sqrt(square / (n - 1));
}

static void add_worst(brc_outcome *outcome, const char *name, const result *results, int n, size_t member,
                      double reference)
{
    double worst = 0;
    for (int k = 0; k < n; ++k) {
        const double value = *(const double *)((const char *)&results[k] + member);
        worst = fmax(worst, fabs(value / reference - 1));
    }
    brc_outcome_add(outcome, name, "-", worst, NAN);
}

static brc_status obtain(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes,
                         const char *folder)
{
    (void)folder; /* no files */
    const brc_case_run *run = outcome->run;
    const int n = run->n_seeds, wanted = run->n_threads > 0 ? run->n_threads : campaign->n_threads,
              n_threads = wanted > 0 ? wanted : omp_get_max_threads();
    brc_scene *scene = NULL;
    brc_status status = BRC_OK;
    work w = {.context = campaign->session->context};
    const double start = brc_clock_s();
    BRC_TRY(brc_scene_read_text(w.context, name, text, bytes, run->n_overrides, run->overrides, &scene));
    w.scene = scene;
    if (scene->n_bodies != 1 || scene->n_materials != 1 || !(scene->bodies[0].beams > 0) ||
        scene->bodies[0].fill.n_radii > 0 || scene->bodies[0].shape.n_parts > 0)
        BRC_TRY_OR(cleanup, BRC_FAIL(w.context, BRC_BAD_INPUT,
                                     "%s: `with: beams` expects one packed box of one material with beams", name));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(w.context, &w.results, n, "results of a run"));
    BRC_TRY_OR(cleanup, find_samples(campaign, &w, scene->model.polish ? 2 * n : n, n_threads));
    share(&w, n, n_threads, false);
    BRC_TRY_OR(cleanup, w.status);
    outcome->seconds = brc_clock_s() - start;
    outcome->n_elements = scene->bodies[0].fill.n_elements;
    outcome->n_bonds = w.results[0].n_bonds;
    snprintf(outcome->device, sizeof outcome->device, "cpu");
    const brc_material *material = &scene->materials[0];
    add_mean(outcome, "nu", "-", w.results, n, offsetof(result, nu), material->poisson);
    add_mean(outcome, "E", "Pa", w.results, n, offsetof(result, young), material->young);
    add_mean(outcome, "r_m", "-", w.results, n, offsetof(result, radius), NAN);
    add_mean(outcome, "E_m", "Pa", w.results, n, offsetof(result, beam_young), NAN);
    add_worst(outcome, "nu_worst", w.results, n, offsetof(result, nu), material->poisson);
    add_worst(outcome, "E_worst", w.results, n, offsetof(result, young), material->young);
    if (scene->model.polish) {
        add_mean(outcome, "nu_axis", "-", w.results, n, offsetof(result, nu_axis), material->poisson);
        add_mean(outcome, "E_axis", "Pa", w.results, n, offsetof(result, young_axis), material->young);
        add_worst(outcome, "nu_axis_worst", w.results, n, offsetof(result, nu_axis), material->poisson);
        add_worst(outcome, "E_axis_worst", w.results, n, offsetof(result, young_axis), material->young);
    }
    brc_outcome_add(outcome, "seconds", "s", outcome->seconds, NAN);
cleanup:
    brc_memory_free(w.results);
    brc_scene_free(&scene);
    return status;
}

/* The beams operator: elastic tests of run->n_seeds samples of the scene's box along x: nu, E (means with scatter;
 * references: the material's), r_m, E_m, nu_worst, E_worst. A scene with `polish`: each sample polished along all
 * axes, the result tried on a fresh sample (seeds after the last), means over its axes; and polished along x and y,
 * tried along z: nu_axis, E_axis (means with scatter), nu_axis_worst, E_axis_worst. */
const brc_operator brc_operator_beams = {.name = "beams", .obtain = obtain};
