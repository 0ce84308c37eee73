/* What the runs of a study say together: tables that depend on the study and the outcomes alone. */
#include "study.h"
#include "../base/memory.h"
#include "../output/text.h"
#include "../scene/unit.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VALUE = 256 };

/* A cell of a table: in quotation marks where it has to be. */
static void add_cell(brc_text *text, const char *cell)
{
    if (!strpbrk(cell, ",\"\n")) {
        brc_text_add_bytes(text, cell, strlen(cell));
        return;
    }
    brc_text_add(text, "\"");
    for (const char *c = cell; *c; ++c) {
        if (*c == '"') brc_text_add(text, "\"");
        brc_text_add_bytes(text, *c == '\n' ? " " : c, 1);
    }
    brc_text_add(text, "\"");
}

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
            while (k < all.n && strcmp(all.name[k], outcome[run].name[m]) != 0) ++k;
            if (k == all.n && all.n < BRC_STUDY_MEASURES) all.name[all.n++] = outcome[run].name[m];
        }
    return all;
}

static const char *measured(const brc_study_outcome *o, const char *name)
{
    for (int m = 0; m < o->n_measures; ++m)
        if (strcmp(o->name[m], name) == 0) return o->text[m];
    return "";
}

/* NAN: none, of a run that is not done. */
static double number_of(const brc_study_outcome *o, const char *name)
{
    const char *text = measured(o, name);
    return strcmp(o->status, "done") == 0 && text[0] ? strtod(text, NULL) : NAN;
}

static void add_table(brc_text *text, const brc_study *study, const brc_study_outcome *outcome)
{
    const names all = measures_of(study, outcome);
    char value[VALUE];
    brc_text_add(text, "run,status");
    for (int k = 0; k < study->n_keys; ++k) brc_text_add(text, ",%s", study->keys[k].key);
    for (int m = 0; m < all.n; ++m) brc_text_add(text, ",%s", all.name[m]);
    brc_text_add(text, ",reason\n");
    for (int run = 0; run < study->n_runs; ++run) {
        brc_text_add(text, "%05d,%s", run, outcome[run].status);
        for (int k = 0; k < study->n_keys; ++k) {
            brc_text_add(text, ",");
            add_cell(text, brc_study_value(study, run, k, value, sizeof value));
        }
        for (int m = 0; m < all.n; ++m) brc_text_add(text, ",%s", measured(&outcome[run], all.name[m]));
        brc_text_add(text, ",");
        add_cell(text, outcome[run].reason ? outcome[run].reason : "");
        brc_text_add(text, "\n");
    }
}

/* ---- means ---- */

static bool is_averaged(const brc_study_key *key) { return key->averaged || key->kind == BRC_STUDY_UNIFORM || key->kind == BRC_STUDY_NORMAL; }

/* Do two runs differ only in what is averaged over? */
static bool same_group(const brc_study *study, int run, int other)
{
    char one[VALUE], two[VALUE];
    for (int k = 0; k < study->n_keys; ++k)
        if (!is_averaged(&study->keys[k]) && strcmp(brc_study_value(study, run, k, one, sizeof one), brc_study_value(study, other, k, two, sizeof two)) != 0) return false;
    return true;
}

static void add_mean(brc_text *text, int n, const double *x)
{
    double mean = 0, square = 0;
    for (int i = 0; i < n; ++i) mean += x[i] / n;
    for (int i = 0; i < n; ++i) square += (x[i] - mean) * (x[i] - mean);
    const double deviation = n > 1 ? sqrt(square / (n - 1)) : NAN;
    brc_text_add(text, ",%d", n);
    const double all[] = {mean, deviation, n > 1 ? brc_study_student(n - 1) * deviation / sqrt(n) : NAN};
    for (int k = 0; k < 3; ++k) {
        brc_text_add(text, ",");
        if (!isnan(all[k])) brc_text_add_number(text, all[k]);
    }
    brc_text_add(text, "\n");
}

/* first: [n_runs] the first run of each one's group; x: [n_runs] room. */
static void add_means(brc_text *text, const brc_study *study, const brc_study_outcome *outcome, const int *first, double *x)
{
    const names all = measures_of(study, outcome);
    char value[VALUE];
    for (int k = 0; k < study->n_keys; ++k)
        if (!is_averaged(&study->keys[k])) brc_text_add(text, "%s,", study->keys[k].key);
    brc_text_add(text, "measure,n,mean,deviation,confidence\n");
    for (int run = 0; run < study->n_runs; ++run)
        for (int m = 0; first[run] == run && m < all.n; ++m) {
            int n = 0;
            for (int other = run; other < study->n_runs; ++other)
                if (first[other] == run && !isnan(number_of(&outcome[other], all.name[m]))) x[n++] = number_of(&outcome[other], all.name[m]);
            if (n == 0) continue;
            for (int k = 0; k < study->n_keys; ++k) {
                if (is_averaged(&study->keys[k])) continue;
                add_cell(text, brc_study_value(study, run, k, value, sizeof value));
                brc_text_add(text, ",");
            }
            brc_text_add(text, "%s", all.name[m]);
            add_mean(text, n, x);
        }
}

/* ---- fits ---- */

/* In SI; NAN: no number. */
static double key_value(const brc_study *study, int run, const char *key)
{
    char text[VALUE];
    double value = NAN;
    brc_dimension dimension;
    bool bare;
    for (int k = 0; k < study->n_keys; ++k)
        if (strcmp(study->keys[k].key, key) == 0 && brc_quantity_parse(brc_study_value(study, run, k, text, sizeof text), &value, &dimension, &bare) != BRC_QUANTITY_OK) return NAN;
    return value;
}

static void add_power(brc_text *text, const brc_study *study, const brc_study_outcome *outcome, const brc_study_fit *fit, double *x, double *y)
{
    double a, b, error;
    int n = 0;
    for (int run = 0; run < study->n_runs; ++run) {
        y[n] = number_of(&outcome[run], fit->of);
        x[n] = key_value(study, run, fit->by);
        n += !isnan(x[n]) && !isnan(y[n]);
    }
    brc_text_add(text, "power,%s,%s,%d,", fit->of, fit->by, n);
    if (brc_study_power(n, x, y, &a, &b, &error)) {
        brc_text_add(text, "exponent %.9g", b);
        if (!isnan(error)) brc_text_add(text, " +- %.3g", error);
        brc_text_add(text, "; factor %.9g", a);
    } else brc_text_add(text, "no fit: fewer than two different values above 0");
    brc_text_add(text, "\n");
}

static void add_weibull(brc_text *text, const brc_study *study, const brc_study_outcome *outcome, const brc_study_fit *fit, double *x)
{
    double modulus, scale;
    int n = 0;
    for (int run = 0; run < study->n_runs; ++run) {
        x[n] = number_of(&outcome[run], fit->of);
        n += !isnan(x[n]);
    }
    brc_text_add(text, "weibull,%s,,%d,", fit->of, n);
    if (brc_study_weibull(n, x, &modulus, &scale)) brc_text_add(text, "modulus %.9g; scale %.9g", modulus, scale);
    else brc_text_add(text, "no fit: fewer than two different values above 0");
    brc_text_add(text, "\n");
}

brc_status brc_study_write(brc_context *context, const brc_study *study, const char *folder, const brc_study_outcome *outcome)
{
    brc_text table = {.context = context}, means = table, fits = table;
    double *x = NULL, *y = NULL;
    int *first = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &x, study->n_runs, "values of a study"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &y, study->n_runs, "values of a study"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &first, study->n_runs, "groups of a study"));
    for (int run = 0; run < study->n_runs; ++run)
        for (first[run] = 0; !same_group(study, first[run], run); ++first[run]) {}
    add_table(&table, study, outcome);
    BRC_TRY_OR(cleanup, brc_text_write_into(&table, folder, "table.csv"));
    add_means(&means, study, outcome, first, x);
    BRC_TRY_OR(cleanup, brc_text_write_into(&means, folder, "means.csv"));
    if (study->n_fits > 0) {
        brc_text_add(&fits, "law,measure,key,n,found\n");
        for (int f = 0; f < study->n_fits; ++f) {
            if (study->fits[f].power) add_power(&fits, study, outcome, &study->fits[f], x, y);
            else add_weibull(&fits, study, outcome, &study->fits[f], x);
        }
        status = brc_text_write_into(&fits, folder, "fits.csv");
    }
cleanup:
    brc_memory_free(x);
    brc_memory_free(y);
    brc_memory_free(first);
    return status;
}
