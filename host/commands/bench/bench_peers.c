#include "bench_peers.h"
#include "../reproduce/case.h"
#include "../../../bench/peers.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void print_bar(const brc_row *row)
{
    const bool ours = strcmp(brc_row_text(row, "program"), "breccia") == 0;
    printf("%-8s %-9.9s %-26s %9.2f Hz", brc_row_text(row, "program"), brc_row_text(row, "version"),
           brc_row_text(row, "law"), brc_row_number(row, ours ? "ours" : "peer"));
    if (ours)
        printf("  (slender bar %.2f Hz)\n", brc_row_number(row, "reference"));
    else
        printf("  %+.1e of breccia's, kinetic energy within %.1e\n", brc_row_number(row, "difference"),
               brc_row_number(row, "kinetic_difference"));
}

static void print_speed(const brc_row *row)
{
    printf("%-8s %-9.9s %-26s %9.0f %9.0f %3.0f %10.4g %8.2f", brc_row_text(row, "program"),
           brc_row_text(row, "version"), brc_row_text(row, "law"), brc_row_number(row, "elements"),
           brc_row_number(row, "bonds"), brc_row_number(row, "threads"), 1e3 * brc_row_number(row, "seconds"),
           1e-6 * brc_row_number(row, "bond_updates_per_s"));
    if (isnan(brc_row_number(row, "ratio")))
        printf("\n");
    else
        printf("  %6.2f (%.2f-%.2f)\n", brc_row_number(row, "ratio"), brc_row_number(row, "ratio_min"),
               brc_row_number(row, "ratio_max"));
}

static brc_status print_row(void *self, const brc_rows *rows)
{
    const brc_row *row = &rows->rows[rows->n_rows - 1];
    const bool speed = strcmp(brc_row_text(row, "case"), "peers") == 0;
    if (rows->n_rows == 1) printf("a bar let go in its first longitudinal mode, in each program\n");
    if (speed && rows->n_rows > 1 && strcmp(brc_row_text(row - 1, "case"), "peers") != 0)
        printf("a cube of beams, in turns, medians of five, %s time; ratio: how much faster breccia's cbm is (least "
               "and most)\n%-8s %-9s %-26s %9s %9s %3s %10s %8s  %6s\n",
               brc_row_text(row, "clock"), "program", "version", "law", "elements", "bonds", "thr", "ms/step",
               "M bonds/s", "ratio");
    if (brc_row_text(row, "note")[0])
        printf("%-8s %-9.9s %-26s no figures: %s\n", brc_row_text(row, "program"), brc_row_text(row, "version"),
               brc_row_text(row, "law"), brc_row_text(row, "note"));
    else if (speed)
        print_speed(row);
    else
        print_bar(row);
    fflush(stdout);
    return brc_rows_write(rows, self);
}

brc_status brc_bench_peers(brc_context *context, const char *output, int64_t elements, int64_t steps, int n_threads)
{
    static const char *const names[] = {"yade.py", "lammps-bpm.in", "lammps-springs.in", "lammps-rest.in"};
    enum { N_NAMES = sizeof names / sizeof *names };
    char *texts[N_NAMES] = {NULL}, folder[512];
    brc_peer_script scripts[N_NAMES];
    size_t bytes;
    brc_rows rows = {.context = context};
    brc_status status = BRC_OK;
    snprintf(folder, sizeof folder, "%s", output);
    for (int k = 0; k < N_NAMES; ++k) {
        BRC_TRY_OR(cleanup, brc_case_text(context, NULL, "peers", names[k], &texts[k], &bytes));
        scripts[k] = (brc_peer_script){names[k], texts[k]};
    }
    const brc_peers_request request = {.elements = elements,
                                       .steps = steps,
                                       .n_threads = n_threads,
                                       .folder = folder,
                                       .n_scripts = N_NAMES,
                                       .scripts = scripts,
                                       .row = print_row,
                                       .self = folder};
    BRC_TRY_OR(cleanup, brc_peers_measure(context, &request, &rows));
    printf("%s/rows.json\n", folder);
cleanup:
    brc_rows_free(&rows);
    for (int k = 0; k < N_NAMES; ++k)
        brc_memory_free(texts[k]);
    return status;
}
