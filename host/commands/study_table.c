/* What the runs of a study say together: tables that depend on the study and the outcomes alone. */
#include "study.h"
#include "../base/memory.h"
#include "../output/text.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VALUE = 256 };

/* Measures in the order of the first run that has them. */
typedef struct names {
    int n;
    const char *name[BRC_STUDY_MEASURES];
} names;

static names measures_of(const brc_study *study, const brc_study_outcome *outcome)
{
    names all = {0};
    for (int run = 0; run < study->n_runs; ++run)
        for (int m = 0; m < outcome[run].n_measures; ++m) {
            int k = 0;
            while (k < all.n && strcmp(all.name[k], outcome[run].name[m]) != 0)
                ++k;
            if (k == all.n && all.n < BRC_STUDY_MEASURES) all.name[all.n++] = outcome[run].name[m];
        }
    return all;
}

static void add_table(brc_text *text, const brc_study *study, const brc_study_outcome *outcome)
{
    const names all = measures_of(study, outcome);
    char value[VALUE];
    brc_text_add(text, "run,status");
    for (int k = 0; k < study->n_keys; ++k)
        brc_text_add(text, ",%s", study->keys[k].key);
    for (int m = 0; m < all.n; ++m)
        brc_text_add(text, ",%s", all.name[m]);
    brc_text_add(text, ",reason\n");
    for (int run = 0; run < study->n_runs; ++run) {
        brc_text_add(text, "%05d,%s", run, outcome[run].status);
        for (int k = 0; k < study->n_keys; ++k) {
            brc_text_add(text, ",");
            brc_study_add_cell(text, brc_study_value(study, run, k, value, sizeof value));
        }
        for (int m = 0; m < all.n; ++m)
            brc_text_add(text, ",%s", brc_study_measure(&outcome[run], all.name[m]));
        brc_text_add(text, ",");
        brc_study_add_cell(text, outcome[run].reason ? outcome[run].reason : "");
        brc_text_add(text, "\n");
    }
}

/* ---- means ---- */

static void add_mean(brc_text *text, int n, const double *x)
{
    double mean = 0, square = 0;
    for (int i = 0; i < n; ++i)
        mean += x[i] / n;
    for (int i = 0; i < n; ++i)
        square += (x[i] - mean) * (x[i] - mean);
    const double deviation = n > 1 ? sqrt(square / (n - 1)) : NAN;
    brc_text_add(text, ",%d", n);
    const double all[] = {mean, deviation, n > 1 ? brc_study_student(n - 1) * deviation / sqrt(n) : NAN};
    for (int k = 0; k < 3; ++k) {
        brc_text_add(text, ",");
        if (!isnan(all[k])) brc_text_add_number(text, all[k]);
    }
    brc_text_add(text, "\n");
}

/* x: [n_runs] room. */
static void add_means(brc_text *text, const brc_study *study, const brc_study_outcome *outcome,
                      const brc_study_groups *groups, double *x)
{
    const names all = measures_of(study, outcome);
    char value[VALUE];
    for (int k = 0; k < study->n_keys; ++k)
        if (!brc_study_is_averaged(&study->keys[k])) brc_text_add(text, "%s,", study->keys[k].key);
    brc_text_add(text, "measure,n,mean,deviation,confidence\n");
    for (int g = 0; g < groups->n; ++g)
        for (int m = 0; m < all.n; ++m) {
            int n = 0;
            for (int i = groups->start[g]; i < groups->start[g + 1]; ++i) {
                x[n] = brc_study_measured(&outcome[groups->run[i]], all.name[m]);
                n += !isnan(x[n]);
            }
            if (n == 0) continue;
            for (int k = 0; k < study->n_keys; ++k) {
                if (brc_study_is_averaged(&study->keys[k])) continue;
                const int run = groups->run[groups->start[g]];
                brc_study_add_cell(text, brc_study_value(study, run, k, value, sizeof value));
                brc_text_add(text, ",");
            }
            brc_text_add(text, "%s", all.name[m]);
            add_mean(text, n, x);
        }
}

brc_status brc_study_write(brc_context *context, const brc_study *study, const char *folder,
                           const brc_study_outcome *outcome)
{
    brc_text table = {.context = context}, means = table;
    double *x = NULL;
    brc_study_groups groups = {0};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &x, study->n_runs, "values of a study"));
    BRC_TRY_OR(cleanup, brc_study_group(context, study, NULL, false, &groups));
    add_table(&table, study, outcome);
    BRC_TRY_OR(cleanup, brc_text_write_into(&table, folder, "table.csv"));
    add_means(&means, study, outcome, &groups, x);
    BRC_TRY_OR(cleanup, brc_text_write_into(&means, folder, "means.csv"));
    if (study->n_fits > 0) BRC_TRY_OR(cleanup, brc_study_write_fits(context, study, folder, outcome));
    const names all = measures_of(study, outcome);
    for (int m = 0; m < all.n && status == BRC_OK; ++m)
        status = brc_study_draw(context, study, folder, outcome, &groups, all.name[m], x);
cleanup:
    brc_memory_free(x);
    brc_study_groups_free(&groups);
    return status;
}
