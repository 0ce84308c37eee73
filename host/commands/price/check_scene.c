#include "check_scene.h"
#include "pace.h"

/* The simulations, and how long making them took. */
static brc_status make_simulations(brc_context *context, const brc_device_request *request, brc_setup *setup,
                                   double *seconds)
{
    const double start = brc_pace_clock_s(request);
    BRC_TRY(brc_setup_simulations(context, request, setup));
    *seconds = brc_pace_clock_s(request) - start;
    return BRC_OK;
}

brc_status brc_check_build(brc_context *context, brc_scene *scene, const brc_device_request *request, double start,
                           brc_check *check)
{
    const double build_start = brc_pace_clock_s(request);
    BRC_TRY(brc_setup_domains(context, scene, NULL, request->n_threads, &check->setup));
    check->build_s = brc_pace_clock_s(request) - build_start;
    if (check->built) check->built(check->details, &check->setup, check->build_s);
    BRC_TRY(brc_setup_polish(context, request->n_threads, &check->setup));
    check->before_s = brc_pace_clock_s(request) - start;
    return make_simulations(context, request, &check->setup, &check->simulations_s);
}

/* OpenCL drivers compile a kernel when it is first launched and keep it on disk for later runs: PoCL takes some ten
 * seconds for all of a run, which would be taken for its pace. So a brief trial goes before the one that is
 * measured. */
static brc_status compile_first(brc_context *context, const brc_device_request *request, brc_check *check)
{
    brc_setup *setup = &check->setup;
    brc_trial trial = {0};
    if (brc_device_get_info(setup->device[0])->kind != BRC_DEVICE_OPENCL) return BRC_OK;
    const brc_status status = brc_trial_run(context, setup, request, true, &trial);
    brc_trial_free(&trial);
    brc_setup_free_simulations(setup);
    for (int32_t k = 0; k < setup->n; ++k)
        brc_device_close(&setup->device[k]);
    BRC_TRY(status);
    return make_simulations(context, request, setup, &check->simulations_s);
}

brc_status brc_check_try(brc_context *context, const brc_device_request *request, bool brief, brc_check *check)
{
    BRC_TRY(compile_first(context, request, check));
    return brc_trial_run(context, &check->setup, request, brief, &check->trial);
}

brc_status brc_check_price(brc_context *context, brc_scene *scene, const brc_device_request *request, brc_check *check)
{
    FILE *const nowhere = check->details ? NULL : fopen("/dev/null", "w"), *const details =
                                                                               nowhere ? nowhere : check->details;
    if (!details) return BRC_FAIL(context, BRC_FILE_FAILED, "/dev/null cannot be opened");
    brc_setup_free_simulations(&check->setup); /* a coarser body may need the room */
    const brc_status status = brc_price_tell_trial(context, scene, &check->setup, request, &check->trial,
                                                   check->before_s + check->simulations_s, details, &check->told);
    if (nowhere) fclose(nowhere);
    return status;
}

void brc_check_free(brc_check *check)
{
    brc_trial_free(&check->trial);
    brc_setup_free(&check->setup);
}
