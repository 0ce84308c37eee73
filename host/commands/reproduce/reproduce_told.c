/* The error class that `breccia check` gives of a scene, against the error of the run. */
#include "operators.h"
#include "../price/price.h"
#include "../price/trial.h"
#include <math.h>

static brc_status find_class(brc_campaign *campaign, const brc_outcome *outcome, const char *name, const char *text,
                             size_t bytes, double *error_class)
{
    brc_context *context = campaign->session->context;
    const brc_case_run *run = outcome->run;
    const brc_device_request request = {.selector = run->device        ? run->device
                                                    : campaign->device ? campaign->device
                                                                       : "auto",
                                        .precision = outcome->precision,
                                        .n_threads = run->n_threads > 0 ? run->n_threads : campaign->n_threads,
                                        .exact = run->exact || campaign->exact};
    brc_scene *scene = NULL;
    brc_setup setup = {0};
    brc_trial trial = {0};
    brc_price_error own = {.worst = -1};
    brc_price_judgement judgement;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_scene_read_text(context, name, text, bytes, run->n_overrides, run->overrides, &scene));
    BRC_TRY_OR(cleanup, brc_setup_domains(context, scene, NULL, request.n_threads, &setup));
    BRC_TRY_OR(cleanup, brc_setup_polish(context, request.n_threads, &setup));
    BRC_TRY_OR(cleanup, brc_setup_simulations(context, &request, &setup));
    BRC_TRY_OR(cleanup, brc_trial_run(context, &setup, &request, false, &trial));
    brc_setup_free_simulations(&setup);
    BRC_TRY_OR(cleanup, brc_price_error_find(context, scene, &setup, &request, &trial, &own));
    BRC_TRY_OR(cleanup, brc_price_judge(context, scene, &setup, outcome->precision, &own, &judgement));
    if (!judgement.known)
        BRC_TRY_OR(cleanup, BRC_FAIL(context, BRC_BAD_INPUT, "run %s: no error class is known of model %s", run->name,
                                     brc_model_name(setup.split->part[0].scene->model.kind)));
    *error_class = brc_price_class(brc_price_curve_error(&judgement.by, (double)brc_setup_n_elements(&setup)));
cleanup:
    brc_price_error_free(&own);
    brc_trial_free(&trial);
    brc_setup_free(&setup);
    brc_scene_free(&scene);
    return status;
}

static void add_values(double error_class, brc_outcome *outcome)
{
    double actual = NAN;
    for (int k = 0; k < outcome->n_values; ++k) {
        const brc_case_value *value = &outcome->values[k];
        if (!isnan(value->reference) && value->reference != 0)
            actual = fmax(actual, fabs(value->value / value->reference - 1));
    }
    const bool finest = error_class <= brc_price_class(0),
               right = actual <= pow(10, 0.25) * error_class && (finest || actual >= 0.1 * error_class);
    brc_outcome_add(outcome, "told", "-", error_class, NAN);
    brc_outcome_add(outcome, "actual", "-", actual, NAN);
    brc_outcome_add(outcome, "right", "-", right, NAN);
}

/* What `check` says of the scene, then the run. */
static brc_status obtain(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes,
                         const char *folder)
{
    double error_class;
    BRC_TRY(find_class(campaign, outcome, name, text, bytes, &error_class));
    BRC_TRY(brc_outcome_simulate(campaign, outcome, name, text, bytes, folder));
    add_values(error_class, outcome);
    return BRC_OK;
}

/* told (the class of the scene by a trial and coarser bodies, price.h [-]; BRC_BAD_INPUT where none is known), actual
 * (the largest error of the measures with a target) and right: 1 where actual is at most the upper edge of the class,
 * 10^(1/4) of it, and not below a tenth of it unless the class is the finest; else 0. */
const brc_operator brc_operator_told = {.name = "told", .obtain = obtain};
