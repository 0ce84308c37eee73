/* breccia study: many runs of one scene. */
#include "command.h"
#include "study.h"
#include "../base/file.h"
#include <string.h>

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("folder of the runs and their tables (needed)"),
    {"jobs", 'j', "N", false, "runs at once (default: as many as there are processors for their threads)"},
    {"threads", 't', "N", false, "threads of each run (default 1)"},
    BRC_OPTION_DEVICE,
    BRC_OPTION_PRECISION,
    {"now", 'n', NULL, false, "begin at once: no trial of the first run to tell what all will take"},
};

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    int64_t jobs, threads;
    brc_precision precision;
    brc_study *study = NULL;
    brc_study_outcome *outcome = NULL;
    brc_study_request request = {.folder = brc_arguments_value(arguments, "output"), .device = brc_arguments_value(arguments, "device"),
                                 .precision = brc_arguments_value(arguments, "precision"), .now = brc_arguments_value(arguments, "now") != NULL};
    brc_status status = BRC_OK;
    if (!request.folder) return BRC_FAIL(context, BRC_BAD_INPUT, "breccia study: say where the runs go with -o DIR");
    BRC_TRY(brc_arguments_integer(context, arguments, "jobs", 0, 4096, 0, &jobs));
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 1, 4096, 1, &threads));
    BRC_TRY(brc_arguments_precision(context, arguments, &precision));
    request.jobs = (int)jobs;
    request.threads = (int)threads;
    BRC_TRY(brc_study_read(context, arguments->positional[0], &study));
    const int n = study->n_runs;
    int n_done = 0;
    BRC_TRY_OR(cleanup, brc_file_make_folder(context, request.folder));
    BRC_TRY_OR(cleanup, brc_study_run(context, study, &request, &outcome));
    BRC_TRY_OR(cleanup, brc_study_write(context, study, request.folder, outcome));
    for (int k = 0; k < n; ++k) n_done += strcmp(outcome[k].status, "done") == 0;
    printf("%d of %d runs are done: %s/table.csv, means.csv%s\n", n_done, n, request.folder, study->n_fits > 0 ? ", fits.csv" : "");
cleanup:
    brc_study_outcomes_free(n, &outcome);
    brc_study_free(&study);
    return status;
}

const brc_command brc_command_study = {.name = "study",
                                       .operands = "STUDY.yaml",
                                       .least = 1,
                                       .most = 1,
                                       .summary = "run a scene many times with keys that vary, and put what it measures together",
                                       .details = "What is done already in DIR is not done again; a run that fails leaves the others alone and has its reason in the table.\ndocs/reference/study.md describes the file.",
                                       .options = options,
                                       .n_options = sizeof options / sizeof *options,
                                       .run = run};
