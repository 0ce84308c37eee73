#include "report_discs.h"
#include "report_pack.h"
#include "../../base/memory.h"
#include <math.h>

enum { DISCS_MOST = 20000, N_NUMBERS = 7 };

/* Place of an element in the skin, -1 where it is no sphere of it. */
static int32_t place_of(const brc_report_frame *last, const brc_report_skin *skin, double element)
{
    int64_t low = 0, high = skin->n_elements;
    if (!(element >= 0) || element >= (double)last->n_elements) return -1;
    if (!brc_report_frame_is_sphere(last, (int64_t)element)) return -1;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (skin->element[middle] < (int32_t)element)
            low = middle + 1;
        else
            high = middle;
    }
    return low < skin->n_elements && skin->element[low] == (int32_t)element ? (int32_t)low : -1;
}

typedef struct columns {
    int number[N_NUMBERS], element[2];
} columns;

static bool find_columns(const brc_csv_read *cracks, columns *out)
{
    static const char *const name[N_NUMBERS] = {"x", "y", "z", "nx", "ny", "nz", "area"};
    static const char *const element[2] = {"element_i", "element_j"};
    bool all = true;
    for (int k = 0; k < N_NUMBERS; ++k)
        all = (out->number[k] = brc_csv_read_column(cracks, name[k])) >= 0 && all;
    for (int k = 0; k < 2; ++k)
        all = (out->element[k] = brc_csv_read_column(cracks, element[k])) >= 0 && all;
    return all;
}

brc_status brc_report_discs(brc_context *context, const brc_csv_read *cracks, const brc_report_frame *last,
                            const brc_report_skin *skin, brc_text *page, brc_json *json)
{
    columns column;
    brc_report_pack numbers = {.context = context}, ends = {.context = context}, rows = {.context = context};
    brc_status status = BRC_OK;
    if (!last->radius || cracks->n_rows == 0 || !find_columns(cracks, &column)) return BRC_OK;
    const int64_t every = (cracks->n_rows + DISCS_MOST - 1) / DISCS_MOST;
    int64_t n = 0;
    for (int64_t row = 0; row < cracks->n_rows; row += every) {
        const double *value = cracks->value + row * cracks->n_columns;
        const int32_t place[2] = {place_of(last, skin, value[column.element[0]]),
                                  place_of(last, skin, value[column.element[1]])};
        if (place[0] < 0 || place[1] < 0) continue;
        for (int k = 0; k < N_NUMBERS; ++k) {
            const double v = value[column.number[k]];
            const float number = (float)(k < N_NUMBERS - 1 ? v : sqrt(v / M_PI));
            brc_report_pack_bytes(&numbers, sizeof number, &number);
        }
        const int32_t index = (int32_t)row;
        brc_report_pack_bytes(&ends, sizeof place, place);
        brc_report_pack_bytes(&rows, sizeof index, &index);
        ++n;
    }
    brc_report_pack_bytes(&numbers, ends.n, ends.data);
    brc_report_pack_bytes(&numbers, rows.n, rows.data);
    status = ends.status != BRC_OK ? ends.status : rows.status != BRC_OK ? rows.status : numbers.status;
    if (status == BRC_OK && n > 0) {
        status = brc_html_array(page, "view-discs", numbers.data, numbers.n);
        brc_json_begin_object(json, "discs");
        brc_json_integer(json, "n", n);
        brc_json_integer(json, "every", every);
        brc_json_end(json);
    }
    brc_report_pack_free(&numbers);
    brc_report_pack_free(&ends);
    brc_report_pack_free(&rows);
    return status;
}
