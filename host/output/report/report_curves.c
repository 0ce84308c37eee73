#include "report_curves.h"
#include "../csv_read.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

/* output.curve of the resolved scene, which the program wrote itself. */
static brc_status add_axes(brc_context *context, const char *scene, brc_json *json)
{
    brc_tree *tree = NULL;
    brc_problems *problems = NULL;
    brc_node *root = NULL;
    const brc_node *curve = NULL;
    brc_status status = BRC_OK;
    if (scene) {
        BRC_TRY_OR(cleanup, brc_problems_create(context, "scene", 0, NULL, &problems));
        BRC_TRY_OR(cleanup, brc_tree_create(context, &tree));
        BRC_TRY_OR(cleanup, brc_tree_parse(tree, problems, 0, scene, strlen(scene), &root));
    }
    const brc_node *output = root && root->kind == BRC_NODE_MAP ? brc_node_find(root, "output") : NULL;
    if (output && output->kind == BRC_NODE_MAP) curve = brc_node_find(output, "curve");
    for (const char *axis = "xy"; *axis; ++axis) {
        const char key[2] = {*axis, '\0'};
        const brc_node *sensor = curve && curve->kind == BRC_NODE_MAP ? brc_node_find(curve, key) : NULL;
        brc_json_string(json, key, sensor && sensor->text[0] ? sensor->text : NULL);
    }
cleanup:
    brc_tree_free(&tree);
    brc_problems_free(&problems);
    return status;
}

static brc_status add_numbers(brc_context *context, const brc_csv_read *csv, int64_t every, brc_text *page,
                              int64_t *n_shown)
{
    float *value = NULL;
    int64_t n = 0;
    BRC_TRY(BRC_ALLOCATE(context, &value, csv->n_columns * (csv->n_rows / every + 2), "curves of the report"));
    for (int column = 0; column < csv->n_columns; ++column)
        for (int64_t row = 0; row < csv->n_rows;
             row = row == csv->n_rows - 1 || row + every < csv->n_rows ? row + every : csv->n_rows - 1)
            value[n++] = (float)csv->value[row * csv->n_columns + column];
    *n_shown = n / csv->n_columns;
    const brc_status status = brc_html_array(page, "histories", value, n * (int64_t)sizeof *value);
    brc_memory_free(value);
    return status;
}

static void add_names(brc_json *json, const char *key, const brc_csv_read *csv, const char *const *name)
{
    brc_json_begin_array(json, key);
    for (int k = 0; k < csv->n_columns; ++k)
        brc_json_string(json, NULL, name[k]);
    brc_json_end(json);
}

brc_status brc_report_curves(brc_context *context, const char *folder, const char *scene, brc_text *page,
                             brc_json *json)
{
    brc_csv_read csv;
    int64_t n_shown = 0;
    BRC_TRY(brc_csv_read_open(context, folder, "histories.csv", &csv));
    brc_status status = BRC_OK;
    if (csv.n_rows == 0) goto cleanup;
    const int64_t every = (csv.n_rows * csv.n_columns + BRC_REPORT_SAMPLES - 1) / BRC_REPORT_SAMPLES;
    BRC_TRY_OR(cleanup, add_numbers(context, &csv, every, page, &n_shown));
    brc_json_begin_object(json, "histories");
    brc_json_integer(json, "rows", n_shown);
    brc_json_integer(json, "every", every);
    add_names(json, "name", &csv, csv.name);
    add_names(json, "unit", &csv, csv.unit);
    status = add_axes(context, scene, json);
    brc_json_end(json);
cleanup:
    brc_csv_read_free(&csv);
    return status;
}
