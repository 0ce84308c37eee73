#include "price_error.h"
#include "../base/memory.h"
#include <math.h>

static const double affordable_s = 3, usual_order = 1.5, modes_order = 2.4, first_order = 1;
enum { LEAST_ELEMENTS = 200, QUARTER = 4, SEEDS = 2 };

/* What a measure's difference between two bodies says of the finer one; NAN where either was not measured. */
static double error_of(double fine, double coarse, double ratio, double order)
{
    return fabs(fine - coarse) / fabs(fine) / (pow(ratio, order) - 1);
}

/* The measures against those of a body of `share` of the scene's elements, whose error is `times` that of the scene. */
static brc_status compare(brc_context *context, brc_scene *scene, const brc_device_request *request, const double *fine, double fine_across, double share, double times,
                          brc_price_error *out)
{
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        brc_coarse coarse;
        const brc_status status = brc_trial_coarse(context, scene, request, NULL, share, seed, true, &coarse);
        for (int32_t k = 0; status == BRC_OK && coarse.across > 0 && k < scene->n_measures; ++k)
            out->error[k] = fmax(out->error[k], error_of(fine[k], coarse.measures[k], fine_across / coarse.across, out->order) / times); /* fmax passes NAN over */
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
    return scene->stages[scene->n_stages - 1].solver == BRC_SOLVER_MODES ? modes_order : usual_order;
}

brc_status brc_price_error_find(brc_context *context, brc_scene *scene, const brc_setup *setup, const brc_device_request *request, const brc_trial *trial, double seconds,
                                brc_price_error *out)
{
    const double across = brc_setup_across(setup), n = (double)brc_setup_n_elements(setup);
    brc_coarse middle = {0};
    brc_status status = BRC_OK;
    *out = (brc_price_error){.worst = -1, .order = order_of(scene)};
    BRC_TRY(BRC_ALLOCATE(context, &out->error, scene->n_measures, "errors"));
    for (int32_t k = 0; k < scene->n_measures; ++k) out->error[k] = NAN;
    if (scene->has_fracture || n < LEAST_ELEMENTS || scene->n_measures == 0 || trial->stopped || trial->n_measures < scene->n_measures) return BRC_OK;
    double share = 1;
    if (!isnan(trial->measures[0])) {
        BRC_TRY_OR(cleanup, compare(context, scene, request, trial->measures, across, 1.0 / QUARTER, 1, out));
    } else {
        share = fmin(fmax(1.0 / QUARTER, LEAST_ELEMENTS / n), pow(affordable_s / seconds, 0.75));
        if (!(share * n > LEAST_ELEMENTS - 0.5)) return BRC_OK;
        BRC_TRY_OR(cleanup, brc_trial_coarse(context, scene, request, NULL, share, 0, true, &middle));
        if (middle.across > 0)
            BRC_TRY_OR(cleanup, compare(context, scene, request, middle.measures, middle.across, share / QUARTER, pow(across / middle.across, out->order), out));
    }
    out->least_elements = (int64_t)(share * n / QUARTER);
    for (int32_t k = 0; k < scene->n_measures; ++k)
        if (!isnan(out->error[k]) && (out->worst < 0 || out->error[k] > out->error[out->worst])) out->worst = k;
cleanup:
    brc_coarse_free(&middle);
    return status;
}

void brc_price_error_free(brc_price_error *error)
{
    brc_memory_free(error->error);
    *error = (brc_price_error){.worst = -1};
}
