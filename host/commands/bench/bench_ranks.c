#include "bench_ranks.h"
#include "bench_options.h"
#include "../../../bench/ranks.h"
#include "../../base/ranks.h"
#include <string.h>

static brc_status print_row(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    const char *what = brc_row_text(row, "quantity");
    printf("%-9s %5.0f ranks", what, brc_row_number(row, "ranks"));
    if (strcmp(what, "surface") == 0)
        printf(" %9.0f elements %9.0f rows %8.0f ghosts (most %8.0f) %5.2f rows^(2/3) %5.1f neighbours (most %3.0f), "
               "inside %.2f, computed while messages fly %.2f\n",
               brc_row_number(row, "elements"), brc_row_number(row, "rows_per_rank"),
               brc_row_number(row, "ghosts_per_rank"), brc_row_number(row, "ghosts_most"),
               brc_row_number(row, "surface_constant"), brc_row_number(row, "neighbours_per_rank"),
               brc_row_number(row, "neighbours_most"), brc_row_number(row, "inside_least"),
               brc_row_number(row, "meanwhile_least"));
    else if (strcmp(what, "step") == 0)
        printf(" %9.0f elements %10.4g s/step %6.1f messages %10.0f bytes, waited %.3g s, in flight %.3g s, %.0f MB\n",
               brc_row_number(row, "elements"), brc_row_number(row, "seconds"),
               brc_row_number(row, "messages_per_step"), brc_row_number(row, "exchanged_bytes_most"),
               brc_row_number(row, "exchange_wait_s"), brc_row_number(row, "flight_s"),
               1e-6 * brc_row_number(row, "most_resident_bytes"));
    else if (strcmp(what, "exchange") == 0)
        printf(" %9.0f bytes %10.2f us %8.2f GB/s\n", brc_row_number(row, "message_bytes"),
               1e6 * brc_row_number(row, "seconds"), 1e-9 * brc_row_number(row, "exchange_bandwidth"));
    else
        printf(" %26.2f us\n", 1e6 * brc_row_number(row, "seconds"));
    fflush(stdout);
    return brc_rows_write(rows, self);
}

static brc_status take_sizes(brc_context *context, const brc_arguments *arguments, brc_ranks_request *out)
{
    const char *piece[BRC_THROUGHPUT_LIST];
    char copy[256];
    double size;
    BRC_TRY(brc_bench_take_list(context, arguments, "sizes", "1e4,1e5", copy, sizeof copy, piece, &out->n_sizes));
    for (int k = 0; k < out->n_sizes; ++k) {
        BRC_TRY(brc_bench_take_number(context, "sizes", piece[k], 8, 1e9, &size));
        out->sizes[k] = (int64_t)size;
    }
    return BRC_OK;
}

/* surface, exchange, step; without a word: what the ranks that there are can do. */
static brc_status take_kinds(brc_context *context, const brc_arguments *arguments, brc_ranks_request *out)
{
    const char *piece[BRC_THROUGHPUT_LIST];
    char copy[64];
    int n = 0;
    bool *const kinds[] = {&out->surface, &out->exchange, &out->step};
    static const char *const names[] = {"surface", "exchange", "step"};
    BRC_TRY(brc_bench_take_list(context, arguments, "problems", brc_ranks_count() == 1 ? "surface,step" : "exchange",
                                copy, sizeof copy, piece, &n));
    for (int k = 0; k < n; ++k) {
        int kind = 0;
        while (kind < 3 && strcmp(piece[k], names[kind]) != 0)
            ++kind;
        if (kind == 3) return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench ranks: no problem '%s'", piece[k]);
        *kinds[kind] = true;
    }
    return BRC_OK;
}

brc_status brc_bench_ranks(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"exact", "sample", "copy", "quick", "folder", "resume", "elements", "poisson"};
    brc_context *context = session->context;
    const char *output = brc_arguments_value(arguments, "output"),
               *precision = brc_arguments_value(arguments, "precisions"),
               *device = brc_arguments_value(arguments, "devices");
    const char *const models = brc_arguments_value(arguments, "models"), *const model = models ? models : "dlsm";
    char folder[512];
    int64_t n_threads;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "ranks", sizeof others / sizeof *others, others));
    snprintf(folder, sizeof folder, "%s", output ? output : "results/ranks");
    brc_ranks_request request = {.device = device ? device : "cpu", .row = print_row, .self = folder};
    BRC_TRY(take_sizes(context, arguments, &request));
    BRC_TRY(take_kinds(context, arguments, &request));
    BRC_TRY(brc_bench_take_models(context, 1, &model, &request.model));
    BRC_TRY(brc_precision_parse(context, precision ? precision : "double", &request.precision));
    BRC_TRY(brc_arguments_integer(context, arguments, "threads", 0, 4096, 0, &n_threads));
    BRC_TRY(brc_arguments_integer(context, arguments, "steps", 1, 1000000, 100, &request.n_steps));
    request.n_threads = (int)n_threads;
    brc_rows rows = {.context = context};
    brc_status status = brc_ranks_measure(context, &request, &rows);
    if (status == BRC_OK) status = brc_rows_write(&rows, folder);
    if (status == BRC_OK) printf("%s/rows.json\n", folder);
    brc_rows_free(&rows);
    return status;
}
