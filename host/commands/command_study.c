/* breccia study: many runs of one scene. */
#include "command.h"
#include "study.h"
#include "../base/file.h"
#include <stdio.h>
#include <string.h>

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("folder of the runs and their tables (needed)"),
    {"jobs", 'j', "N", false, "runs at once (default: as many as there are processors for their threads)"},
    {"threads", 't', "N", false, "threads of each run (default 1)"},
    BRC_OPTION_DEVICE,
    BRC_OPTION_PRECISION,
    {"now", 'n', NULL, false, "begin at once: no trial of the first run to tell what all will take"},
    {"slurm", 0, NULL, false,
     "run nothing: write DIR/slurm.sh, an array job for `sbatch`, with at most --jobs tasks at once"},
    {"task", 0, "K/N", false,
     "only the runs K, K + N, ... counted from 0, and no tables: what a task of the array job does"},
    {"collect", 'c', NULL, false, "run nothing: put together what is in DIR"},
};

/* "K/N" with 0 <= K < N. */
static brc_status read_task(brc_context *context, const char *text, brc_study_request *request)
{
    int end = 0;
    if (!text) return BRC_OK;
    if (sscanf(text, "%d/%d%n", &request->task, &request->n_tasks, &end) == 2 && !text[end] && request->task >= 0 &&
        request->task < request->n_tasks)
        return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "breccia study: --task: found '%s', expected K/N with K from 0 to N - 1, as 0/40", text);
}

/* Run, or do not, and put together. */
static brc_status run_and_tell(brc_context *context, const brc_study *study, const brc_study_request *request,
                               const char *path)
{
    brc_study_outcome *outcome = NULL;
    int n_done = 0;
    brc_status status = brc_study_run(context, study, request, &outcome);
    if (status == BRC_OK && request->n_tasks == 0) status = brc_study_write(context, study, request->folder, outcome);
    for (int k = 0; status == BRC_OK && k < study->n_runs; ++k)
        n_done += strcmp(outcome[k].status, "done") == 0;
    if (status == BRC_OK && request->n_tasks == 0)
        printf("%d of %d runs are done: %s/table.csv, means.csv%s\n", n_done, study->n_runs, request->folder,
               study->n_fits > 0 ? ", fits.csv" : "");
    else if (status == BRC_OK)
        printf("%d runs of this task are done; all together: breccia study %s -o %s --collect\n", n_done, path,
               request->folder);
    brc_study_outcomes_free(study->n_runs, &outcome);
    return status;
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    int64_t jobs, threads;
    brc_precision precision;
    brc_study *study = NULL;
    brc_study_request request = {.folder = brc_arguments_value(arguments, "output"),
                                 .device = brc_arguments_value(arguments, "device"),
                                 .precision = brc_arguments_value(arguments, "precision"),
                                 .now = brc_arguments_value(arguments, "now") != NULL,
                                 .collect = brc_arguments_value(arguments, "collect") != NULL};
    const char *path = arguments->positional[0], *task = brc_arguments_value(arguments, "task");
    const bool slurm = brc_arguments_value(arguments, "slurm") != NULL;
    brc_status status = BRC_OK;
    if (!request.folder) return BRC_FAIL(context, BRC_BAD_INPUT, "breccia study: say where the runs go with -o DIR");
    if (slurm + request.collect + (task != NULL) > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia study: one of --slurm, --task, --collect at a time");
    BRC_TRY(brc_arguments_integer(context, arguments, "jobs", 0, 4096, 0, &jobs));
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 1, 4096, 1, &threads));
    BRC_TRY(brc_arguments_precision(context, arguments, &precision));
    BRC_TRY(read_task(context, task, &request));
    request.jobs = task ? 1 : (int)jobs;
    request.threads = (int)threads;
    request.now |= task != NULL;
    BRC_TRY(brc_study_read(context, path, &study));
    BRC_TRY_OR(cleanup, brc_file_make_folder(context, request.folder));
    if (!slurm)
        status = run_and_tell(context, study, &request, path);
    else {
        BRC_TRY_OR(cleanup, brc_study_write_slurm(context, study, path, &request));
        printf("%d runs: sbatch --wait %s/slurm.sh; breccia study %s -o %s%s%s%s%s --collect\n", study->n_runs,
               request.folder, path, request.folder, request.device ? " --device " : "",
               request.device ? request.device : "", request.precision ? " --precision " : "",
               request.precision ? request.precision : "");
    }
cleanup:
    brc_study_free(&study);
    return status;
}

const brc_command brc_command_study = {
    .name = "study",
    .operands = "STUDY.yaml",
    .least = 1,
    .most = 1,
    .summary = "run a scene many times with keys that vary, and put what it measures together",
    .details =
        "What is done already in DIR is not done again; a run that fails leaves the others alone and has its reason in "
        "the table.\nOn a cluster: --slurm, sbatch, --collect.\ndocs/reference/study.md describes the file.",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run};
