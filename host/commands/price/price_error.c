#include "price_error.h"
#include "material_volume.h"
#include "price_work.h"
#include "../../base/memory.h"
#include <math.h>

static const double affordable_work = 4e7, usual_order = 1.5, first_order = 1;
const double brc_price_error_stage_s = 60;
enum { LEAST_ELEMENTS = 200, QUARTER = 4, SEEDS = 3 };

/* What a measure's difference between two bodies says of the finer one; NAN where either was not measured. */
static double error_of(double fine, double coarse, double ratio, double order)
{
    return fabs(fine - coarse) / fabs(fine) / (pow(ratio, order) - 1);
}

/* The measures against those of bodies of `share` of the scene's elements, whose error is `times` that of the scene. */
static brc_status compare(brc_context *context, brc_scene *scene, const brc_device_request *request, const double *fine,
                          double fine_across, double share, double times, brc_price_error *out)
{
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        brc_coarse coarse;
        const brc_coarse_request asked = {
            .share = share, .seed = seed, .whole = true, .stage_s = brc_price_error_stage_s};
        const brc_status status = brc_trial_coarse(context, scene, request, &asked, &coarse);
        for (int32_t k = 0; status == BRC_OK && coarse.across > 0 && k < scene->n_measures; ++k)
            out->error[k] =
                fmax(out->error[k], error_of(fine[k], coarse.measures[k], fine_across / coarse.across, out->order) /
                                        times); /* fmax passes NAN over */
        out->out_of_time |= coarse.out_of_time;
        brc_coarse_free(&coarse);
        BRC_TRY(status);
    }
    return BRC_OK;
}

/* Boundaries of materials do not cut cells: what is on the wrong side of one is of first order. */
static double order_of(const brc_scene *scene)
{
    for (int32_t b = 0; b < scene->n_bodies; ++b)
        if (scene->bodies[b].n_regions > 0 || scene->bodies[b].n_phases > 0) return first_order;
    return usual_order;
}

/* Of the scene's elements in the largest body that is run: 1, 1/2, 1/4, ...; halves, so that a step more or less of a
 * stage does not change it. */
static double affordable_share(double work)
{
    double share = 1;
    while (work * pow(share, 4. / 3) > affordable_work)
        share /= 2;
    return share;
}

brc_status brc_price_error_find(brc_context *context, brc_scene *scene, const brc_setup *setup,
                                const brc_device_request *request, const brc_trial *trial, brc_price_error *out)
{
    const double n = (double)brc_setup_n_elements(setup);
    brc_coarse largest = {0};
    brc_status status = BRC_OK;
    *out = (brc_price_error){.worst = -1, .order = order_of(scene)};
    BRC_TRY(BRC_ALLOCATE(context, &out->error, scene->n_measures, "errors"));
    for (int32_t k = 0; k < scene->n_measures; ++k)
        out->error[k] = NAN;
    if (scene->has_fracture || scene->n_measures == 0 || trial->stopped || trial->n_measures < scene->n_measures)
        return BRC_OK;
    const double share = affordable_share(brc_price_work(scene, setup, trial)), *fine = trial->measures;
    double across = brc_setup_across(setup), times = 1;
    if (share * n < LEAST_ELEMENTS) return BRC_OK;
    if (share < 1 || isnan(fine[0])) {
        const brc_coarse_request asked = {.share = share, .whole = true, .stage_s = brc_price_error_stage_s};
        BRC_TRY_OR(cleanup, brc_trial_coarse(context, scene, request, &asked, &largest));
        out->out_of_time = largest.out_of_time;
        if (!(largest.across > 0) || largest.out_of_time) goto cleanup;
        times = pow(across / largest.across, out->order);
        across = largest.across;
        fine = largest.measures;
    }
    BRC_TRY_OR(cleanup, compare(context, scene, request, fine, across, share / QUARTER, times, out));
    if (out->out_of_time) goto cleanup;
    out->least_elements = (int64_t)(share * n / QUARTER);
    out->volumes = brc_material_volume_error(setup);
    for (int32_t k = 0; k < scene->n_measures; ++k) {
        out->error[k] += out->volumes;
        if (!isnan(out->error[k]) && (out->worst < 0 || out->error[k] > out->error[out->worst])) out->worst = k;
    }
cleanup:
    brc_coarse_free(&largest);
    return status;
}

void brc_price_error_free(brc_price_error *error)
{
    brc_memory_free(error->error);
    *error = (brc_price_error){.worst = -1};
}
