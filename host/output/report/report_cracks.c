#include "report_cracks.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdlib.h>

void brc_report_cracks_rose(const brc_csv_read *cracks, int c, double out[BRC_REPORT_ROSE])
{
    static const char *const name[3] = {"nx", "ny", "nz"};
    const int a = brc_csv_read_column(cracks, name[(c + 1) % 3]), b = brc_csv_read_column(cracks, name[(c + 2) % 3]);
    const int area = brc_csv_read_column(cracks, "area");
    for (int k = 0; k < BRC_REPORT_ROSE; ++k)
        out[k] = 0;
    for (int64_t row = 0; a >= 0 && b >= 0 && area >= 0 && row < cracks->n_rows; ++row) {
        const double *value = cracks->value + row * cracks->n_columns;
        const double across =
            hypot(value[a], value[b]); /* the trace is the normal's part in the plane, turned by 90 degrees */
        const double turn = atan2(value[a], -value[b]) / M_PI, half = turn - floor(turn);
        const double seen = value[area] * across;
        if (!isfinite(half) || !isfinite(seen)) continue;
        const int sector = (int)(half * BRC_REPORT_ROSE);
        out[sector < BRC_REPORT_ROSE ? sector : 0] += seen;
    }
}

void brc_report_cracks_add_roses(const brc_csv_read *cracks, brc_json *json)
{
    if (cracks->n_rows == 0) return;
    brc_json_begin_array(json, "roses");
    for (int c = 0; c < 3; ++c) {
        double area[BRC_REPORT_ROSE];
        brc_report_cracks_rose(cracks, c, area);
        brc_json_begin_array(json, NULL);
        for (int k = 0; k < BRC_REPORT_ROSE; ++k)
            brc_json_number(json, NULL, area[k]);
        brc_json_end(json);
    }
    brc_json_end(json);
}

static int heavier_first(const void *left, const void *right)
{
    const float a = *(const float *)left, b = *(const float *)right;
    return a > b ? -1 : a < b;
}

/* The end of the run has the number -1. */
static bool is_shown(const brc_report_frames *frames, double number)
{
    bool shown = frames->n == 0 || number < 0;
    for (int64_t k = 0; k < frames->n && !shown; ++k)
        shown = (double)frames->number[k] == number;
    return shown;
}

brc_status brc_report_cracks_add_fragments(brc_context *context, const brc_csv_read *fragments,
                                           const brc_report_frames *frames, brc_text *page, brc_json *json)
{
    const int frame = brc_csv_read_column(fragments, "frame"), mass = brc_csv_read_column(fragments, "mass");
    float *masses = NULL;
    int64_t *start = NULL, *number = NULL, n = 0, n_masses = 0;
    brc_status status = BRC_OK;
    if (frame < 0 || mass < 0 || fragments->n_rows == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &masses, fragments->n_rows, "fragments of the report"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &start, fragments->n_rows + 1, "fragments of the report"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &number, fragments->n_rows, "fragments of the report"));
    for (int64_t row = 0; row < fragments->n_rows; ++row) {
        const double *value = fragments->value + row * fragments->n_columns;
        if (!is_shown(frames, value[frame])) continue;
        if (n == 0 || (double)number[n - 1] != value[frame]) {
            start[n] = n_masses;
            number[n++] = (int64_t)value[frame];
        }
        masses[n_masses++] = (float)value[mass];
    }
    start[n] = n_masses;
    for (int64_t k = 0; k < n; ++k)
        qsort(masses + start[k], (size_t)(start[k + 1] - start[k]), sizeof *masses, heavier_first);
    status = brc_html_array(page, "fragment-masses", masses, n_masses * (int64_t)sizeof *masses);
    brc_json_begin_object(json, "fragments");
    brc_json_begin_array(json, "frame");
    for (int64_t k = 0; k < n; ++k)
        brc_json_integer(json, NULL, number[k]);
    brc_json_end(json);
    brc_json_begin_array(json, "start");
    for (int64_t k = 0; k <= n; ++k)
        brc_json_integer(json, NULL, start[k]);
    brc_json_end(json);
    brc_json_end(json);
cleanup:
    brc_memory_free(masses);
    brc_memory_free(start);
    brc_memory_free(number);
    return status;
}
