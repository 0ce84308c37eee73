#include "bench_rest.h"
#include "bench_options.h"
#include "../../../bench/rest_cost.h"
#include "../../../bench/throughput.h"
#include <math.h>
#include <stdio.h>

static brc_status print_rest(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    printf(
        "%-15s %9.0f %-6s threads %2.0f  %.3f times as fast (>= %.2f; %.3f to %.3f): %.4g s, all %.4g s, %.0f steps, "
        "%.1f %% left out\n",
        brc_row_text(row, "model"), brc_row_number(row, "elements"), brc_row_text(row, "precision"),
        brc_row_number(row, "threads"), brc_row_number(row, "ours"), brc_row_number(row, "bound"),
        brc_row_number(row, "least"), brc_row_number(row, "most"), brc_row_number(row, "seconds"),
        brc_row_number(row, "seconds_without"), brc_row_number(row, "steps"), 100 * brc_row_number(row, "left_out"));
    fflush(stdout);
    return brc_rows_write(rows, self);
}

brc_status brc_bench_rest(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"problems", "exact",  "sample", "copy",    "quick",
                                         "folder",   "resume", "steps",  "poisson", "elements"};
    brc_context *context = session->context;
    char copy[5][256], folder[512];
    const char *size[BRC_THROUGHPUT_LIST], *device[BRC_THROUGHPUT_LIST], *count[BRC_THROUGHPUT_LIST],
        *model[BRC_THROUGHPUT_LIST], *precision[BRC_THROUGHPUT_LIST];
    brc_model_kind models[BRC_THROUGHPUT_LIST];
    int n_sizes = 0, n_devices = 0, n_counts = 0, n_models = 0, n_precisions = 0;
    double number;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "rest", sizeof others / sizeof *others, others));
    const char *given = brc_arguments_value(arguments, "output");
    snprintf(folder, sizeof folder, "%s", given ? given : "results/rest");
    brc_rest_cost_request request = {.row = print_rest, .self = folder};
    BRC_TRY(brc_bench_take_list(context, arguments, "sizes", "1e5", copy[0], sizeof copy[0], size, &n_sizes));
    BRC_TRY(brc_bench_take_list(context, arguments, "devices", "cpu", copy[1], sizeof copy[1], device, &n_devices));
    BRC_TRY(brc_bench_take_list(context, arguments, "threads", "1", copy[2], sizeof copy[2], count, &n_counts));
    BRC_TRY(brc_bench_take_list(context, arguments, "models", "dlsm,dlsm-published,cbm", copy[3], sizeof copy[3], model,
                                &n_models));
    BRC_TRY(brc_bench_take_list(context, arguments, "precisions", "double", copy[4], sizeof copy[4], precision,
                                &n_precisions));
    BRC_TRY(brc_bench_take_models(context, n_models, model, models));
    BRC_TRY(brc_bench_take_number(context, "threads", count[0], 1, 4096, &number));
    if (n_devices > 1 || n_counts > 1 || n_precisions > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia bench rest: one device, precision and number of threads, found several");
    request.device = device[0];
    request.n_threads = (int)number;
    BRC_TRY(brc_precision_parse(context, precision[0], &request.precision));
    brc_rows rows = {.context = context};
    brc_status status = BRC_OK;
    for (int k = 0; k < n_sizes * n_models && status == BRC_OK; ++k) {
        status = brc_bench_take_number(context, "sizes", size[k / n_models], 500, 1e9, &number);
        request.elements = (int64_t)number;
        request.model = models[k % n_models];
        if (status == BRC_OK) status = brc_rest_cost_measure(context, &request, &rows);
    }
    if (status == BRC_OK) printf("%s/rows.json\n", folder);
    brc_rows_free(&rows);
    return status;
}
