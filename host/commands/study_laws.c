/* fits.csv: each law for each group of runs, a row a parameter. */
#include "study.h"
#include "../base/memory.h"
#include "../output/text.h"
#include "../scene/unit.h"
#include <math.h>
#include <string.h>

enum { VALUE = 256 };

static const char *law_name(brc_study_law law)
{
    static const char *const names[] = {"weibull",   "power",         "size_effect", "fragments power",
                                        "schuhmann", "rosin_rammler", "gilvarry"};
    return names[law];
}

/* In SI; NAN: no number. */
static double key_value(const brc_study *study, int run, const char *key)
{
    char text[VALUE];
    double value = NAN;
    brc_dimension dimension;
    bool bare;
    for (int k = 0; k < study->n_keys; ++k)
        if (strcmp(study->keys[k].key, key) == 0 &&
            brc_quantity_parse(brc_study_value(study, run, k, text, sizeof text), &value, &dimension, &bare) !=
                BRC_QUANTITY_OK)
            return NAN;
    return value;
}

/* Groups of runs are told apart where the study averages over something; else all runs are one. */
static bool has_groups(const brc_study *study)
{
    for (int k = 0; k < study->n_keys; ++k)
        if (brc_study_is_averaged(&study->keys[k])) return true;
    return false;
}

static void add_number(brc_text *text, double value)
{
    brc_text_add(text, ",");
    if (!isnan(value)) brc_text_add_number(text, value);
}

/* A row a parameter; one with `no fit` where there is none. first: a run of the group. */
static void add_rows(brc_text *text, const brc_study *study, const brc_study_fit *fit, int first,
                     const brc_study_found *found)
{
    char value[VALUE];
    const int rows = found->n_parameters > 0 ? found->n_parameters : 1;
    for (int row = 0; row < rows; ++row) {
        for (int k = 0; k < study->n_keys && has_groups(study); ++k) {
            if (brc_study_is_averaged(&study->keys[k])) continue;
            const bool own = strcmp(study->keys[k].key, fit->by) != 0;
            brc_study_add_cell(text, own ? brc_study_value(study, first, k, value, sizeof value) : "");
            brc_text_add(text, ",");
        }
        brc_text_add(text, "%s,%s,%s,%d,%s", law_name(fit->law), fit->of, fit->by, found->n,
                     found->n_parameters > 0 ? found->parameter[row].name : "no fit");
        add_number(text, found->n_parameters > 0 ? found->parameter[row].value : NAN);
        add_number(text, found->n_parameters > 0 ? found->parameter[row].error : NAN);
        brc_text_add(text, "\n");
    }
}

/* The law of a measure over the n runs of a group; x, y: [n] room. */
static brc_study_found fit_measure(const brc_study *study, const brc_study_outcome *outcome, const brc_study_fit *fit,
                                   int n_runs, const int *run, double *x, double *y)
{
    int n = 0;
    for (int i = 0; i < n_runs; ++i) {
        y[n] = brc_study_measured(&outcome[run[i]], fit->of);
        x[n] = fit->by[0] ? key_value(study, run[i], fit->by) : 0;
        n += !isnan(x[n]) && !isnan(y[n]);
    }
    if (fit->law == BRC_STUDY_WEIBULL) return brc_study_fit_weibull(n, y);
    return fit->law == BRC_STUDY_POWER ? brc_study_fit_power(n, x, y) : brc_study_fit_size_effect(n, x, y);
}

static brc_status fit_fragments(brc_context *context, const char *folder, const brc_study_outcome *outcome,
                                const brc_study_fit *fit, int n_runs, const int *run, brc_study_found *found)
{
    brc_study_pieces pieces = {0};
    brc_status status = BRC_OK;
    for (int i = 0; status == BRC_OK && i < n_runs; ++i)
        if (strcmp(outcome[run[i]].status, "done") == 0)
            status = brc_study_pieces_add(context, folder, run[i], &pieces);
    if (status == BRC_OK) status = brc_study_pieces_sort(context, &pieces);
    if (status == BRC_OK) status = brc_study_fit_fragments(context, &pieces, fit, found);
    brc_study_pieces_free(&pieces);
    return status;
}

/* The law for each group; x, y: [n_runs] room. */
static brc_status add_fit(brc_context *context, const brc_study *study, const char *folder,
                          const brc_study_outcome *outcome, const brc_study_fit *fit, double *x, double *y,
                          brc_text *text)
{
    brc_study_groups groups = {0};
    brc_status status = brc_study_group(context, study, fit->by, !has_groups(study), &groups);
    for (int g = 0; status == BRC_OK && g < groups.n; ++g) {
        const int *run = groups.run + groups.start[g], n = groups.start[g + 1] - groups.start[g];
        brc_study_found found;
        if (fit->law <= BRC_STUDY_SIZE_EFFECT)
            found = fit_measure(study, outcome, fit, n, run, x, y);
        else
            status = fit_fragments(context, folder, outcome, fit, n, run, &found);
        if (status == BRC_OK) add_rows(text, study, fit, run[0], &found);
    }
    brc_study_groups_free(&groups);
    return status;
}

brc_status brc_study_write_fits(brc_context *context, const brc_study *study, const char *folder,
                                const brc_study_outcome *outcome)
{
    brc_text text = {.context = context};
    double *x = NULL, *y = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &x, study->n_runs, "values of a study"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &y, study->n_runs, "values of a study"));
    for (int k = 0; k < study->n_keys && has_groups(study); ++k)
        if (!brc_study_is_averaged(&study->keys[k])) brc_text_add(&text, "%s,", study->keys[k].key);
    brc_text_add(&text, "law,measure,by,n,parameter,value,error\n");
    for (int f = 0; f < study->n_fits; ++f)
        BRC_TRY_OR(cleanup, add_fit(context, study, folder, outcome, &study->fits[f], x, y, &text));
    status = brc_text_write_into(&text, folder, "fits.csv");
cleanup:
    if (status != BRC_OK) brc_text_free(&text);
    brc_memory_free(x);
    brc_memory_free(y);
    return status;
}
