#include "bench_statics.h"
#include "bench_options.h"
#include "../reproduce/case.h"
#include "../../../bench/statics_cost.h"
#include "../../../bench/throughput.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static brc_status find_peer(brc_context *context, const char *folder, brc_statics_peer **out)
{
    static const char name[] = "statics-fenics.py";
    char *script = NULL;
    size_t bytes;
    brc_status status = brc_case_text(context, NULL, "peers", name, &script, &bytes);
    if (status == BRC_OK) status = brc_statics_peer_find(context, folder, name, script, out);
    brc_memory_free(script);
    return status;
}

static brc_status print_statics(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    printf("%-10s %9.0f %-9s %7.0f %9.4g s", brc_row_text(row, "body"), brc_row_number(row, "elements"),
           brc_row_text(row, brc_row_text(row, "preconditioner")[0] ? "preconditioner" : "program"),
           brc_row_number(row, "iterations"), brc_row_number(row, "seconds"));
    if (brc_row_number(row, "multigrid_bytes_per_element") > 0)
        printf(", of these %.3g s setup, %.0f bytes an element", brc_row_number(row, "setup_s"),
               brc_row_number(row, "multigrid_bytes_per_element"));
    if (!isnan(brc_row_number(row, "blocks_over_this")))
        printf(", blocks took %.3g times as long", brc_row_number(row, "blocks_over_this"));
    if (!isnan(brc_row_number(row, "assembly_s")))
        printf(", of these %.3g s setup; %.3g times breccia's; assembly %.3g s before", brc_row_number(row, "setup_s"),
               brc_row_number(row, "ratio"), brc_row_number(row, "assembly_s"));
    printf("%s%s\n", brc_row_text(row, "note")[0] ? ", no figures: " : "", brc_row_text(row, "note"));
    fflush(stdout);
    return brc_rows_write(rows, self);
}

brc_status brc_bench_statics(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"models", "exact", "sample", "copy", "quick", "folder", "resume", "steps"};
    brc_context *context = session->context;
    char copy[5][256], folder[512];
    const char *size[BRC_THROUGHPUT_LIST], *device[BRC_THROUGHPUT_LIST], *count[BRC_THROUGHPUT_LIST],
        *body[BRC_THROUGHPUT_LIST], *precision[BRC_THROUGHPUT_LIST];
    int n_sizes = 0, n_devices = 0, n_counts = 0, n_bodies = 0, n_precisions = 0;
    double number, most = 5e4;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "statics", sizeof others / sizeof *others, others));
    const char *given = brc_arguments_value(arguments, "output");
    snprintf(folder, sizeof folder, "%s", given ? given : "results/statics");
    brc_statics_cost_request request = {.poisson = 0.3, .row = print_statics, .self = folder};
    BRC_TRY(brc_bench_take_list(context, arguments, "sizes", "1e3,1e4,1e5", copy[0], sizeof copy[0], size, &n_sizes));
    BRC_TRY(brc_bench_take_list(context, arguments, "devices", "cpu", copy[1], sizeof copy[1], device, &n_devices));
    BRC_TRY(brc_bench_take_list(context, arguments, "threads", "1", copy[2], sizeof copy[2], count, &n_counts));
    BRC_TRY(brc_bench_take_list(context, arguments, "problems", "cantilever,cube", copy[3], sizeof copy[3], body,
                                &n_bodies));
    BRC_TRY(brc_bench_take_list(context, arguments, "precisions", "double", copy[4], sizeof copy[4], precision,
                                &n_precisions));
    BRC_TRY(brc_bench_take_number(context, "threads", count[0], 1, 4096, &number));
    if (n_devices > 1 || n_counts > 1 || n_precisions > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia bench statics: one device, precision and number of threads, found several");
    request.device = device[0];
    request.n_threads = (int)number;
    BRC_TRY(brc_precision_parse(context, precision[0], &request.precision));
    if (brc_arguments_value(arguments, "elements"))
        BRC_TRY(brc_bench_take_number(context, "elements", brc_arguments_value(arguments, "elements"), 0, 1e9, &most));
    request.most_of_blocks = (int64_t)most;
    for (int k = 0; k < n_bodies; ++k) {
        const bool cantilever = strcmp(body[k], "cantilever") == 0, cube = strcmp(body[k], "cube") == 0;
        if (!cantilever && !cube)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "breccia bench statics: no problem '%s', expected cantilever or cube", body[k]);
        request.cantilever |= cantilever;
        request.cube |= cube;
    }
    if (brc_arguments_value(arguments, "poisson"))
        BRC_TRY(brc_bench_take_number(context, "poisson", brc_arguments_value(arguments, "poisson"), -0.999, 0.4999,
                                      &request.poisson));
    brc_rows rows = {.context = context};
    brc_statics_peer *peer = NULL;
    brc_status status = BRC_OK;
    if (request.n_threads == 1) status = find_peer(context, folder, &peer);
    request.peer = peer;
    for (int k = 0; k < n_sizes && status == BRC_OK; ++k) {
        status = brc_bench_take_number(context, "sizes", size[k], 500, 1e9, &number);
        request.elements = (int64_t)number;
        if (status == BRC_OK) status = brc_statics_cost_measure(context, &request, &rows);
    }
    if (status == BRC_OK) printf("%s/rows.json\n", folder);
    brc_rows_free(&rows);
    brc_statics_peer_free(&peer);
    return status;
}
