/* breccia bench: measurements of speed, and of what accuracy costs. */
#include "bench/bench_accuracy.h"
#include "bench/bench_options.h"
#include "bench/bench_peers.h"
#include "bench/bench_ranks.h"
#include "bench/bench_rest.h"
#include "bench/bench_statics.h"
#include "../../bench/contact_cost.h"
#include "../../bench/effects.h"
#include "../../bench/launches.h"
#include "../../bench/sectors.h"
#include "../../bench/throughput.h"
#include "../base/memory.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("folder of rows.json and rows.csv (default results/throughput)"),
    {"sizes", 0, "LIST", false, "numbers of elements (default 1e4,1e5,1e6; effects, launches: 2e4; sectors: 1e5)"},
    {"models", 0, "LIST", false, "dlsm, dlsm-published, cbm (default the first two; effects, launches: all)"},
    {"devices", 0, "LIST", false, "default: cpu and every OpenCL device that is here; effects: cpu; launches: auto"},
    {"precisions", 0, "LIST", false, "default double,mixed,single; effects, launches: double"},
    {"threads", 't', "LIST", false, "threads of the cpu device (default 1,2; effects, peers: 1)"},
    BRC_OPTION_EXACT,
    {"sample", 0, "SECONDS", false, "least time of each of the five samples (default 0.5; effects: 0.2)"},
    {"copy", 0, "MB", false, "array of the copy that gives the bandwidth (default 256)"},
    {"problems", 0, "LIST", false,
     "accuracy: which problems (default all; `--problems list` names them); contact: of nothing-near, dust, dense; "
     "statics: of cantilever, cube (default all)"},
    {"quick", 'q', NULL, false, "accuracy: only the runs small enough for continuous integration"},
    {"folder", 'f', "DIR", false, "accuracy: read the problems from DIR/accuracy instead of from the program"},
    {"resume", 'r', NULL, false, "accuracy: go on with the points that the output folder has"},
    {"elements", 0, "N", false,
     "peers: spheres of the packing, and cells (default 2e4); statics: most that diagonal blocks solve too (default "
     "5e4)"},
    {"poisson", 0, "NU", false, "statics: Poisson's ratio (default 0.3)"},
    {"steps", 0, "N", false,
     "peers: steps of each of the five samples (default 200); launches: steps that are counted (default 1024)"},
};

/* "cpu" and the usable OpenCL devices, as a list. */
static brc_status default_devices(brc_context *context, char *out, size_t size)
{
    brc_device_list *list;
    BRC_TRY(brc_device_list_create(context, &list));
    snprintf(out, size, "cpu");
    for (int k = 0; k < list->n; ++k)
        if (list->items[k].usable && list->items[k].kind == BRC_DEVICE_OPENCL)
            snprintf(out + strlen(out), size - strlen(out), ",%s", list->items[k].selector);
    brc_device_list_free(&list);
    return BRC_OK;
}

static brc_status print_row(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    printf("%-15s %9.0f %-10s %-7s %3.0f", brc_row_text(row, "model"), brc_row_number(row, "elements"),
           brc_row_text(row, "device"), brc_row_text(row, "precision"), brc_row_number(row, "threads"));
    if (isnan(brc_row_number(row, "ours")))
        printf("  %s\n", brc_row_text(row, "note"));
    else
        printf(" %8.2f (%.2f-%.2f) %9.2f %10.4g %8.0f %8.2f %8.2f %9.0f\n",
               brc_row_number(row, "bond_updates_per_s") * 1e-6, brc_row_number(row, "bond_updates_per_s_min") * 1e-6,
               brc_row_number(row, "bond_updates_per_s_max") * 1e-6,
               brc_row_number(row, "element_updates_per_s") * 1e-6, brc_row_number(row, "seconds"),
               brc_row_number(row, "floor_bytes_per_bond"), brc_row_number(row, "copy_bandwidth") * 1e-9,
               brc_row_number(row, "bandwidth_fraction"), brc_row_number(row, "device_bytes_per_element"));
    fflush(stdout);
    return brc_rows_write(rows, self); /* a long bench that is stopped keeps its rows */
}

static brc_status run_accuracy(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"sizes", "models",   "precisions", "exact",  "sample",
                                         "copy",  "elements", "steps",      "poisson"};
    brc_context *context = session->context;
    char problems[256], devices[256], threads[32];
    const char *pieces[BRC_THROUGHPUT_LIST], *device[BRC_THROUGHPUT_LIST], *count[BRC_THROUGHPUT_LIST];
    int n_devices = 0, n_counts = 0;
    double n_threads;
    brc_accuracy_request request = {.problems = pieces};
    BRC_TRY(brc_bench_refuse_options(context, arguments, "accuracy", sizeof others / sizeof *others, others));
    request.output =
        brc_arguments_value(arguments, "output") ? brc_arguments_value(arguments, "output") : "results/accuracy";
    request.folder = brc_arguments_value(arguments, "folder");
    request.quick = brc_arguments_value(arguments, "quick") != NULL;
    request.resume = brc_arguments_value(arguments, "resume") != NULL;
    const char *asked = brc_arguments_value(arguments, "problems");
    if (asked && strcmp(asked, "list") == 0) return brc_bench_accuracy_list(context, request.folder);
    if (asked)
        BRC_TRY(brc_bench_take_list(context, arguments, "problems", "", problems, sizeof problems, pieces,
                                    &request.n_problems));
    BRC_TRY(brc_bench_take_list(context, arguments, "devices", "cpu", devices, sizeof devices, device, &n_devices));
    BRC_TRY(brc_bench_take_list(context, arguments, "threads", "1", threads, sizeof threads, count, &n_counts));
    BRC_TRY(brc_bench_take_number(context, "threads", count[0], 1, 4096, &n_threads));
    if (n_devices > 1 || n_counts > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia bench accuracy: one device and one number of threads, found several");
    request.device = device[0];
    request.n_threads = (int)n_threads;
    return brc_bench_accuracy(session, &request);
}

static brc_status print_contact(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    printf("%-6s %9.0f %-13s %8.3f %-3s", brc_row_text(row, "model"), brc_row_number(row, "elements"),
           brc_row_text(row, "quantity"), brc_row_number(row, "ours"), brc_row_text(row, "unit"));
    if (isnan(brc_row_number(row, "bound")))
        printf(" %9s", "");
    else
        printf(" (<= %4.2f)", brc_row_number(row, "bound"));
    printf("  step %9.4g s, intact %9.4g s, ratios %.3f to %.3f", brc_row_number(row, "seconds"),
           brc_row_number(row, "seconds_without"), brc_row_number(row, "least"), brc_row_number(row, "most"));
    if (!isnan(brc_row_number(row, "touching"))) printf(", %.0f pairs touch", brc_row_number(row, "touching"));
    printf("\n");
    fflush(stdout);
    return brc_rows_write(rows, self);
}

static brc_status run_contact(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"precisions", "exact",    "copy",  "quick",  "folder",
                                         "resume",     "elements", "steps", "poisson"};
    brc_context *context = session->context;
    char copy[5][256], folder[512];
    const char *device[BRC_THROUGHPUT_LIST], *size[BRC_THROUGHPUT_LIST], *model[BRC_THROUGHPUT_LIST],
        *count[BRC_THROUGHPUT_LIST], *row[BRC_THROUGHPUT_LIST];
    int n_devices = 0, n_sizes = 0, n_models = 0, n_counts = 0, n_rows = 0;
    double number;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "contact", sizeof others / sizeof *others, others));
    const char *given = brc_arguments_value(arguments, "output");
    snprintf(folder, sizeof folder, "%s", given ? given : "results/contact");
    brc_contact_cost_request request = {.sample_s = 0.5, .row = print_contact, .self = folder};
    BRC_TRY(brc_bench_take_list(context, arguments, "devices", "cpu", copy[0], sizeof copy[0], device, &n_devices));
    BRC_TRY(brc_bench_take_list(context, arguments, "sizes", "3e4", copy[1], sizeof copy[1], size, &n_sizes));
    BRC_TRY(brc_bench_take_list(context, arguments, "models", "dlsm,cbm", copy[2], sizeof copy[2], model, &n_models));
    BRC_TRY(brc_bench_take_list(context, arguments, "threads", "1", copy[3], sizeof copy[3], count, &n_counts));
    BRC_TRY(brc_bench_take_number(context, "threads", count[0], 1, 4096, &number));
    if (n_devices > 1 || n_counts > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia bench contact: one device and one number of threads, found several");
    request.device = device[0];
    request.n_threads = (int)number;
    for (int k = 0; k < n_models; ++k) {
        const bool cells = strcmp(model[k], "dlsm") == 0, spheres = strcmp(model[k], "cbm") == 0;
        if (!cells && !spheres)
            return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench contact: no model '%s', expected dlsm or cbm",
                            model[k]);
        request.cells |= cells;
        request.spheres |= spheres;
    }
    BRC_TRY(brc_bench_take_list(context, arguments, "problems", "nothing-near,dust,dense", copy[4], sizeof copy[4], row,
                                &n_rows));
    for (int k = 0; k < n_rows; ++k) {
        bool *const wanted = strcmp(row[k], "nothing-near") == 0 ? &request.nothing_near
                             : strcmp(row[k], "dust") == 0       ? &request.dust
                             : strcmp(row[k], "dense") == 0      ? &request.dense
                                                                 : NULL;
        if (!wanted)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "breccia bench contact: no problem '%s', expected nothing-near, dust or dense", row[k]);
        *wanted = true;
    }
    if (brc_arguments_value(arguments, "sample"))
        BRC_TRY(brc_bench_take_number(context, "sample", brc_arguments_value(arguments, "sample"), 1e-3, 3600,
                                      &request.sample_s));
    brc_rows rows = {.context = context};
    brc_status status = BRC_OK;
    for (int k = 0; k < n_sizes && status == BRC_OK; ++k) {
        status = brc_bench_take_number(context, "sizes", size[k], 64, 1e9, &number);
        request.elements = (int64_t)number;
        if (status == BRC_OK) status = brc_contact_cost_measure(context, &request, &rows);
    }
    if (status == BRC_OK) printf("%s/rows.json\n", folder);
    brc_rows_free(&rows);
    return status;
}

static brc_status print_effect(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    char share[32] = "", bound[32] = "";
    if (brc_row_number(row, "share_in_100_steps") > 0)
        snprintf(share, sizeof share, "%.2f", 100 * brc_row_number(row, "share_in_100_steps"));
    if (!isnan(brc_row_number(row, "bound"))) snprintf(bound, sizeof bound, "%.2f", brc_row_number(row, "bound"));
    printf("%-15s %-52s %9.3f %8.3f (%.3f-%.3f) %6s %-8s %8s\n", brc_row_text(row, "model"),
           brc_row_text(row, "quantity"), 1e3 * brc_row_number(row, "seconds"), brc_row_number(row, "ours"),
           brc_row_number(row, "ours_min"), brc_row_number(row, "ours_max"), bound, brc_row_text(row, "verdict"),
           share);
    fflush(stdout);
    return brc_rows_write(rows, self);
}

/* What a bench of one case is asked: models, and one of each of the rest. */
typedef struct one_case {
    brc_model_kind models[BRC_THROUGHPUT_LIST];
    int n_models;
    int64_t size; /* elements */
    brc_precision precision;
    int n_threads;
    const char *device; /* in copy */
    char copy[5][256];
} one_case;

static brc_status take_one_case(brc_context *context, const brc_arguments *arguments, const char *bench,
                                const char *device, one_case *out)
{
    const char *pieces[BRC_THROUGHPUT_LIST];
    double number;
    int n_sizes = 0, n_devices = 0, n_precisions = 0, n_threads = 0;
    BRC_TRY(brc_bench_take_list(context, arguments, "models", "dlsm,dlsm-published,cbm", out->copy[0],
                                sizeof out->copy[0], pieces, &out->n_models));
    BRC_TRY(brc_bench_take_models(context, out->n_models, pieces, out->models));
    BRC_TRY(
        brc_bench_take_list(context, arguments, "sizes", "2e4", out->copy[1], sizeof out->copy[1], pieces, &n_sizes));
    BRC_TRY(brc_bench_take_number(context, "sizes", pieces[0], 8, 1e9, &number));
    out->size = (int64_t)number;
    BRC_TRY(brc_bench_take_list(context, arguments, "precisions", "double", out->copy[2], sizeof out->copy[2], pieces,
                                &n_precisions));
    BRC_TRY(brc_precision_parse(context, pieces[0], &out->precision));
    BRC_TRY(
        brc_bench_take_list(context, arguments, "threads", "1", out->copy[3], sizeof out->copy[3], pieces, &n_threads));
    BRC_TRY(brc_bench_take_number(context, "threads", pieces[0], 1, 4096, &number));
    out->n_threads = (int)number;
    BRC_TRY(brc_bench_take_list(context, arguments, "devices", device, out->copy[4], sizeof out->copy[4], pieces,
                                &n_devices));
    out->device = pieces[0];
    if (n_sizes > 1 || n_precisions > 1 || n_threads > 1 || n_devices > 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia bench %s: one size, device, precision and number of threads, found several", bench);
    return BRC_OK;
}

/* The rows of a bench that ended with `status`: written, named, freed. */
static brc_status close_rows(brc_status status, brc_rows *rows, const char *folder)
{
    if (status == BRC_OK) status = brc_rows_write(rows, folder);
    if (status == BRC_OK) printf("%s/rows.json\n", folder);
    brc_rows_free(rows);
    return status;
}

static brc_status run_effects(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"problems", "quick",    "folder", "resume", "exact",
                                         "copy",     "elements", "steps",  "poisson"};
    brc_context *context = session->context;
    const char *output = brc_arguments_value(arguments, "output");
    char folder[512];
    one_case given;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "effects", sizeof others / sizeof *others, others));
    snprintf(folder, sizeof folder, "%s", output ? output : "results/effects");
    BRC_TRY(take_one_case(context, arguments, "effects", "cpu", &given));
    brc_effects_request request = {.models = given.models,
                                   .n_models = given.n_models,
                                   .size = given.size,
                                   .precision = given.precision,
                                   .n_threads = given.n_threads,
                                   .device = given.device,
                                   .sample_s = 0.2,
                                   .folder = folder,
                                   .row = print_effect,
                                   .self = folder};
    if (brc_arguments_value(arguments, "sample"))
        BRC_TRY(brc_bench_take_number(context, "sample", brc_arguments_value(arguments, "sample"), 1e-3, 3600,
                                      &request.sample_s));
    printf("milliseconds a step and multiple of the elastic step (median of alternating samples, least and most); "
           "share of bonds or faces in 100 steps [%%]\n");
    brc_rows rows = {.context = context};
    brc_status status = brc_effects_measure(context, &request, &rows);
    return close_rows(status, &rows, folder);
}

static brc_status print_launches(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    printf("%-15s %9.0f %-22s %8.2f %9.1f %9.0f %9.0f %11.0f %10.4g %10.4g %6.2f %10.4g\n", brc_row_text(row, "model"),
           brc_row_number(row, "elements"), brc_row_text(row, "quantity"), brc_row_number(row, "launches_per_step"),
           brc_row_number(row, "waits_per_1000_steps"), brc_row_number(row, "read_bytes_per_step"),
           brc_row_number(row, "written_bytes_per_step"), brc_row_number(row, "copied_bytes_per_step"),
           brc_row_number(row, "seconds"), brc_row_number(row, "seconds_by_model"),
           brc_row_number(row, "model_over_seconds"), brc_row_number(row, "h200_seconds_by_model"));
    fflush(stdout);
    return brc_rows_write(rows, self);
}

static brc_status run_launches(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"problems", "quick",  "folder",   "resume",
                                         "exact",    "sample", "elements", "poisson"};
    brc_context *context = session->context;
    const char *output = brc_arguments_value(arguments, "output");
    char folder[512];
    one_case given;
    double megabytes = 256, steps = 1024;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "launches", sizeof others / sizeof *others, others));
    snprintf(folder, sizeof folder, "%s", output ? output : "results/launches");
    BRC_TRY(take_one_case(context, arguments, "launches", "auto", &given));
    brc_launches_request request = {.models = given.models,
                                    .n_models = given.n_models,
                                    .size = given.size,
                                    .precision = given.precision,
                                    .n_threads = given.n_threads,
                                    .device = given.device,
                                    .row = print_launches,
                                    .self = folder};
    if (brc_arguments_value(arguments, "copy"))
        BRC_TRY(brc_bench_take_number(context, "copy", brc_arguments_value(arguments, "copy"), 1, 1e5, &megabytes));
    if (brc_arguments_value(arguments, "steps"))
        BRC_TRY(brc_bench_take_number(context, "steps", brc_arguments_value(arguments, "steps"), 1, 1e9, &steps));
    request.bandwidth_bytes = (int64_t)(megabytes * 1e6);
    request.n_steps = (int64_t)steps;
    printf("launches a step, waits in 1000 steps, bytes read, written and copied on the device a step, seconds a step, "
           "by the model, model over seconds, of an H200 by the model\n");
    brc_rows rows = {.context = context};
    brc_status status = brc_launches_measure(context, &request, &rows);
    return close_rows(status, &rows, folder);
}

static brc_status print_sectors(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    const bool card = strcmp(brc_row_text(row, "case"), "card") == 0;
    if (card || strcmp(brc_row_text(row, "case"), "passes") == 0) {
        printf("%-14s %-22s %-7s %8.4g cells: %6.0f bytes a bond, %6.0f from L2, %5.0f operations",
               brc_row_text(row, "model"), brc_row_text(row, "quantity"), brc_row_text(row, "precision"),
               brc_row_number(row, "elements"), brc_row_number(row, "memory_bytes_per_bond"),
               brc_row_number(row, "cache_bytes_per_bond"), brc_row_number(row, "operations_per_bond"));
        if (card)
            printf("; %8.3g s a step, %5.2f G bonds/s, %3.0f %% of copy", brc_row_number(row, "seconds_by_model"),
                   1e-9 * brc_row_number(row, "bond_updates_per_s"), 100 * brc_row_number(row, "of_copy_bandwidth"));
        printf("\n");
        return brc_rows_write(rows, self);
    }
    printf("%-32s %-14s %-7s %4.0f %8.3f %8.3f %8.1f %8.1f %8.1f %8.1f\n", brc_row_text(row, "quantity"),
           brc_row_text(row, "precision"), brc_row_text(row, "storage"), brc_row_number(row, "record_bytes"),
           brc_row_number(row, "sectors_per_gather"), brc_row_number(row, "fetched_over_wanted"),
           brc_row_number(row, "group_128_bytes"), brc_row_number(row, "group_256_bytes"),
           brc_row_number(row, "group_512_bytes"), brc_row_number(row, "group_1024_bytes"));
    fflush(stdout);
    return brc_rows_write(rows, self);
}

static brc_status run_sectors(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"models", "devices", "precisions", "threads", "problems", "quick",   "folder",
                                         "resume", "exact",   "sample",     "copy",    "elements", "poisson", "steps"};
    brc_context *context = session->context;
    const char *given = brc_arguments_value(arguments, "output"), *pieces[BRC_THROUGHPUT_LIST];
    char folder[512], copy[256];
    double number;
    int n = 0;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "sectors", sizeof others / sizeof *others, others));
    snprintf(folder, sizeof folder, "%s", given ? given : "results/sectors");
    brc_sectors_request request = {.row = print_sectors, .self = folder};
    BRC_TRY(brc_bench_take_list(context, arguments, "sizes", "1e5", copy, sizeof copy, pieces, &n));
    if (n > 1) return BRC_FAIL(context, BRC_BAD_INPUT, "breccia bench sectors: one size, found several");
    BRC_TRY(brc_bench_take_number(context, "sizes", pieces[0], 8, 1e8, &number));
    request.size = (int64_t)number;
    printf("bytes of a record, sectors a gather, bytes fetched over wanted, bytes a half-edge where groups of 128, "
           "256, 512, 1024 fetch each sector once; then passes and steps on a card\n");
    brc_rows rows = {.context = context};
    brc_status status = brc_sectors_measure(context, &request, &rows);
    return close_rows(status, &rows, folder);
}

static brc_status run_peers(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"sizes", "models",   "devices", "precisions", "exact",  "sample",
                                         "copy",  "problems", "quick",   "folder",     "resume", "poisson"};
    brc_context *context = session->context;
    double elements = 2e4, steps = 200, threads = 1;
    BRC_TRY(brc_bench_refuse_options(context, arguments, "peers", sizeof others / sizeof *others, others));
    const char *output = brc_arguments_value(arguments, "output");
    if (brc_arguments_value(arguments, "elements"))
        BRC_TRY(brc_bench_take_number(context, "elements", brc_arguments_value(arguments, "elements"), 200, 1e8,
                                      &elements));
    if (brc_arguments_value(arguments, "steps"))
        BRC_TRY(brc_bench_take_number(context, "steps", brc_arguments_value(arguments, "steps"), 1, 1e9, &steps));
    if (brc_arguments_value(arguments, "threads"))
        BRC_TRY(
            brc_bench_take_number(context, "threads", brc_arguments_value(arguments, "threads"), 1, 4096, &threads));
    return brc_bench_peers(context, output ? output : "results/peers", (int64_t)elements, (int64_t)steps, (int)threads);
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    static const char *const others[] = {"problems", "quick", "folder", "resume", "elements", "steps", "poisson"};
    brc_context *context = session->context;
    if (strcmp(arguments->positional[0], "peers") == 0) return run_peers(session, arguments);
    if (strcmp(arguments->positional[0], "accuracy") == 0) return run_accuracy(session, arguments);
    if (strcmp(arguments->positional[0], "contact") == 0) return run_contact(session, arguments);
    if (strcmp(arguments->positional[0], "effects") == 0) return run_effects(session, arguments);
    if (strcmp(arguments->positional[0], "statics") == 0) return brc_bench_statics(session, arguments);
    if (strcmp(arguments->positional[0], "sectors") == 0) return run_sectors(session, arguments);
    if (strcmp(arguments->positional[0], "launches") == 0) return run_launches(session, arguments);
    if (strcmp(arguments->positional[0], "ranks") == 0) return brc_bench_ranks(session, arguments);
    if (strcmp(arguments->positional[0], "rest") == 0) return brc_bench_rest(session, arguments);
    if (strcmp(arguments->positional[0], "throughput") != 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "breccia bench: no bench '%s'; this version has: throughput, accuracy, contact, effects, "
                        "statics, launches, sectors, ranks, rest, peers",
                        arguments->positional[0]);
    BRC_TRY(brc_bench_refuse_options(context, arguments, "throughput", sizeof others / sizeof *others, others));
    const char *given_folder = brc_arguments_value(arguments, "output");
    char folder[512], here[256], copy[4][256], devices[256];
    snprintf(folder, sizeof folder, "%s", given_folder ? given_folder : "results/throughput");
    brc_throughput_request request = {.sample_s = 0.5, .bandwidth_bytes = 256000000, .row = print_row, .self = folder};
    request.exact = brc_arguments_value(arguments, "exact") != NULL;
    const char *pieces[BRC_THROUGHPUT_LIST];
    double number;
    BRC_TRY(default_devices(context, here, sizeof here));
    BRC_TRY(brc_bench_take_list(context, arguments, "devices", here, devices, sizeof devices, request.devices,
                                &request.n_devices));
    BRC_TRY(brc_bench_take_list(context, arguments, "sizes", "1e4,1e5,1e6", copy[0], sizeof copy[0], pieces,
                                &request.n_sizes));
    for (int k = 0; k < request.n_sizes; ++k) {
        BRC_TRY(brc_bench_take_number(context, "sizes", pieces[k], 8, 1e9, &number));
        request.sizes[k] = (int64_t)number;
    }
    BRC_TRY(
        brc_bench_take_list(context, arguments, "threads", "1,2", copy[1], sizeof copy[1], pieces, &request.n_threads));
    for (int k = 0; k < request.n_threads; ++k) {
        BRC_TRY(brc_bench_take_number(context, "threads", pieces[k], 1, 4096, &number));
        request.threads[k] = (int)number;
    }
    BRC_TRY(brc_bench_take_list(context, arguments, "precisions", "double,mixed,single", copy[2], sizeof copy[2],
                                pieces, &request.n_precisions));
    for (int k = 0; k < request.n_precisions; ++k)
        BRC_TRY(brc_precision_parse(context, pieces[k], &request.precisions[k]));
    BRC_TRY(brc_bench_take_list(context, arguments, "models", "dlsm,dlsm-published", copy[3], sizeof copy[3], pieces,
                                &request.n_models));
    BRC_TRY(brc_bench_take_models(context, request.n_models, pieces, request.models));
    if (brc_arguments_value(arguments, "sample"))
        BRC_TRY(brc_bench_take_number(context, "sample", brc_arguments_value(arguments, "sample"), 1e-3, 3600,
                                      &request.sample_s));
    if (brc_arguments_value(arguments, "copy")) {
        BRC_TRY(brc_bench_take_number(context, "copy", brc_arguments_value(arguments, "copy"), 1, 1e5, &number));
        request.bandwidth_bytes = (int64_t)(number * 1e6);
    }
    printf("million updates a second (median of five, least and most); bandwidth in GB/s; contraction %s\n",
           request.exact ? "off" : "allowed");
    printf("%-15s %9s %-10s %-7s %3s %8s %13s %9s %10s %8s %8s %8s %9s\n", "model", "elements", "device", "prec.",
           "thr", "bonds", "", "elements", "s/step", "B/bond", "copy", "fraction", "B/element");
    brc_rows rows = {.context = context};
    brc_status status = brc_throughput_measure(context, &request, &rows);
    if (status == BRC_OK) status = brc_rows_write(&rows, folder);
    if (status == BRC_OK) printf("%s/rows.json\n", folder);
    brc_rows_free(&rows);
    return status;
}

const brc_command brc_command_bench = {
    .name = "bench",
    .operands = "throughput|accuracy|contact|effects|statics|launches|sectors|ranks|rest|peers",
    .least = 1,
    .most = 1,
    .summary = "measure speed (bond updates per second, fraction of the copy bandwidth), or what accuracy, contact or "
               "other effects cost, or what other programs take",
    .details =
        "Noisy-grid cubes; packings with ten beams an element for cbm. Lists are separated by commas; every "
        "combination is measured. "
        "accuracy: problems with exact answers, error against seconds (one device, one number of threads). "
        "contact: the step with nothing near, of a ball gone to dust, and of dust pressed together, over the step "
        "without contact (default 3e4 elements). "
        "statics: a cantilever and a cube in equilibrium, with multigrid, with diagonal blocks and, on one thread, by "
        "finite "
        "elements where python3 has dolfinx (one device, "
        "precision and number of threads). "
        "launches: what a step asks of a device, counted, and its price by a model of the device (one size, device, "
        "precision). "
        "sectors: what gathers cost the memory of a GPU, counted from neighbour lists (one size). "
        "ranks: what several ranks cost; --problems surface,exchange,step. "
        "rest: a bar struck at one end, all elements over those that the wave has reached (default 1e5). "
        "effects: fracture and others as multiples of the elastic step of a cube (one size, device, precision, number "
        "of threads). "
        "peers: the same packing in breccia and in YADE and LAMMPS, where they are on PATH (one number of threads).",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .ranks = true,
    .run = run};
