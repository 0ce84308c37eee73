/* breccia run: simulate a scene and write its results. */
#include "command.h"
#include "run_scene.h"
#include "../output/pictures/label.h"
#include <math.h>

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("folder of the results (needed)"),
    BRC_OPTION_DEVICE,
    BRC_OPTION_PRECISION,
    BRC_OPTION_THREADS,
    BRC_OPTION_EXACT,
    {"resume", 'r', NULL, false, "go on from the last checkpoint in DIR (docs/reference/checkpoint.md)"},
    BRC_OPTION_SET,
};

static void print_measures(const brc_run_results *results)
{
    if (results->n_measures > 0) printf("\n%-20s %16s %16s %12s\n", "measure", "value", "target", "error");
    for (int32_t k = 0; k < results->n_measures; ++k) {
        const brc_run_measure *measure = &results->measures[k];
        char value[64], target[64] = "", error[32] = "";
        if (isnan(measure->value)) {
            printf("%-20s not measured: %s\n", measure->name, measure->why_not);
            continue;
        }
        brc_label_value(measure->value, measure->unit, 6, value);
        if (measure->has_target) {
            brc_label_value(measure->target, measure->unit, 6, target);
            brc_label_error(measure->value, measure->target, measure->error, error);
        }
        printf("%-20s %16s %16s %12s\n", measure->name, value, target, error);
    }
}

/* Where the steps spent their time, phases of a thousandth or more. */
static void print_phases(const brc_run_results *results)
{
    double all = 0;
    const char *comma = "";
    for (int phase = 0; phase < BRC_N_PHASES; ++phase)
        all += results->phase_s[phase];
    if (results->steps == 0 || !(all > 0)) return;
    printf("of the steps:");
    for (int phase = 0; phase < BRC_N_PHASES; ++phase)
        if (results->phase_s[phase] >= 1e-3 * all) {
            printf("%s %s %.1f %%", comma, brc_phase_name((brc_step_phase)phase), 100 * results->phase_s[phase] / all);
            comma = ",";
        }
    printf("; %.4g s for 1000 steps\n", 1000 * all / (double)results->steps);
    if (results->at_rest >= 1e-3)
        printf("at rest: %.1f %% of the elements' steps were left out, as nothing had reached them\n",
               100 * results->at_rest);
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_run_request request = {.path = arguments->positional[0],
                               .folder = brc_arguments_value(arguments, "output"),
                               .device = brc_arguments_value(arguments, "device"),
                               .running = session->running,
                               .resume = brc_arguments_value(arguments, "resume") != NULL,
                               .exact = brc_arguments_value(arguments, "exact") != NULL};
    if (!request.folder)
        return BRC_FAIL(session->context, BRC_BAD_INPUT, "breccia run: say where the results go with -o DIR");
    int64_t n_threads;
    BRC_TRY(brc_arguments_integer(session->context, arguments, "threads", 0, 4096, 0, &n_threads));
    BRC_TRY(brc_arguments_precision(session->context, arguments, &request.precision));
    request.n_threads = (int)n_threads;
    request.overrides = brc_arguments_values(arguments, "set", &request.n_overrides);
    brc_run_results results;
    const brc_status status = brc_run_scene(session->context, &request, &results);
    if (status == BRC_OK) {
        printf("%s: %lld elements, %lld bonds on %s (%s, %s)\n", request.path, (long long)results.n_elements,
               (long long)results.n_bonds, results.device, results.device_name, brc_precision_name(request.precision));
        printf("seconds: build %.3g, setup %.3g, steps %.3g, output %.3g, all %.3g", results.build_s, results.setup_s,
               results.steps_s, results.output_s, results.total_s);
        if (results.steps > 0 && results.steps_s > 0)
            printf("; %lld steps, %.3g bond updates/s", (long long)results.steps,
                   (double)results.steps * (double)results.n_bonds / results.steps_s);
        printf("\n");
        print_phases(&results);
        print_measures(&results);
    }
    for (int k = 0; k < BRC_RUN_FILES; ++k)
        if (results.file[k]) printf("%s%s\n", k == 0 ? "\n" : "", results.file[k]);
    brc_run_results_free(&results);
    return status;
}

const brc_command brc_command_run = {
    .name = "run",
    .operands = "SCENE",
    .least = 1,
    .most = 1,
    .summary = "simulate a scene and write its results into a folder",
    .details = "DIR/summary.json is written by every run, also a failed one; an interrupted run "
               "keeps its results so far\nand a checkpoint, from which --resume goes on.",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run,
    .ranks = true};
