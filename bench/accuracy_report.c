/* Tables in Markdown, diagrams by gnuplot. */
#include "accuracy_report.h"
#include "../host/base/file.h"
#include "../host/base/memory.h"
#include "../host/output/pictures/gnuplot.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *const models[] = {"dlsm", "dlsm-simple", "dlsm-published", "dlsm-published-weighted", "cbm"};
static const char *const colours[] = {"#4477aa", "#66ccee", "#cc6677", "#ee8866", "#228833"};
enum { MODELS = sizeof models / sizeof *models };
/* Ratios beyond this are no figures any more when they are drawn on. */
#define MOST_DRAWN_ON 1e4

__attribute__((format(printf, 3, 4))) static void append(char *out, size_t size, const char *format, ...)
{
    const size_t used = strlen(out);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out + used, size - used, format, arguments);
    va_end(arguments);
}

const char *brc_accuracy_describe(const brc_accuracy_point *p, bool with_elements, char *out, size_t size)
{
    snprintf(out, size, "%s", p->model);
    if (!isnan(p->coordination)) append(out, size, " cn %g", p->coordination);
    if (p->preparation[0]) append(out, size, ", %s", p->preparation);
    if (with_elements) append(out, size, ", %lld elements", (long long)p->elements);
    if (strcmp(p->precision, "double") != 0) append(out, size, ", %s", p->precision);
    const bool other = p->integrator[0] && strcmp(p->integrator, "verlet") != 0;
    if (other && isnan(p->phi))
        append(out, size, ", %s", p->integrator);
    else if (other)
        append(out, size, ", phi %g", p->phi);
    if (fabs(p->dt_fraction - 0.8) > 1e-9) append(out, size, ", step %g", p->dt_fraction);
    if (!isnan(p->level)) append(out, size, ", level %g", p->level);
    if (p->variant[0]) append(out, size, ", %s", p->variant);
    return out;
}

static const char *question_name(const brc_accuracy_point *p, char *out, size_t size)
{
    snprintf(out, size, "%s", p->problem);
    if (!isnan(p->nu)) append(out, size, ", nu %g", p->nu);
    return out;
}

static const char *percent(double error, char *out, size_t size)
{
    if (error < 1e-6)
        snprintf(out, size, "%.1e", error);
    else
        snprintf(out, size, "%.2g %%", 100 * error);
    return out;
}

static void add_targets(const brc_accuracy_study *s, brc_text *text)
{
    static const double targets[] = {1e-2, 1e-3, 1e-4};
    brc_text_add(text, "## For an error of 1 %%, 0.1 %%, 0.01 %% take\n\nThe cheapest measured way that is within it, "
                       "as are all finer ones of its series (where errors change sign, one size may be right by "
                       "chance); seconds on one thread. \"Of that\": building, and one crossing of a wave "
                       "in dynamics. ~: not measured; drawn on from the best measured way with the order of its "
                       "series, at most 2, and time as spacing^-4.\n\n"
                       "| problem | error | take | measured error | seconds of | seconds | building | a crossing |\n| "
                       "--- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (int32_t q = 0; q < s->n_questions; ++q)
        for (size_t t = 0; t < sizeof targets / sizeof *targets; ++t) {
            char name[64], what[256], error[32];
            const int64_t m = brc_accuracy_cheapest(s, q, NULL, targets[t]);
            brc_text_add(text, "| %s | %g %% | ", question_name(s->questions[q].point, name, sizeof name),
                         100 * targets[t]);
            if (m >= 0) {
                const brc_accuracy_mean *mean = &s->means[m];
                brc_text_add(text, "%s | %s | %s | %.3g | %.2g | %.2g |\n",
                             brc_accuracy_describe(mean->point, true, what, sizeof what),
                             percent(mean->error, error, sizeof error), mean->point->cost_of, mean->cost_s,
                             mean->build_s, mean->crossing_s);
                continue;
            }
            double least = INFINITY;
            int by = -1;
            for (int k = 0; k < MODELS; ++k) {
                const double cost = brc_accuracy_cost_beyond(s, q, models[k], targets[t]);
                if (cost < least) least = cost, by = k;
            }
            if (by < 0)
                brc_text_add(text, "not reached | | | | | |\n");
            else
                brc_text_add(text, "not reached; finer %s | | %s | ~%.2g | | |\n", models[by],
                             s->questions[q].point->cost_of, least);
        }
}

static void add_ratios(const brc_accuracy_study *s, brc_text *text)
{
    static const double levels[] = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
    brc_text_add(text,
                 "\n## What other models cost at equal error\n\nSeconds over those of `dlsm`, each along its own "
                 "front. >: `dlsm` is better than that already with its cheapest "
                 "measured run; <: so is the other model; ~: one of them was not measured to that error, and is drawn "
                 "on from its best with the order of its series (at most 2) and time as "
                 "spacing^-4. Empty: its series does not converge, or says nothing there.\n\n| problem | model |");
    for (size_t l = 0; l < sizeof levels / sizeof *levels; ++l)
        brc_text_add(text, " %g %% |", 100 * levels[l]);
    brc_text_add(text, " its best |\n| --- | --- |");
    for (size_t l = 0; l <= sizeof levels / sizeof *levels; ++l)
        brc_text_add(text, " --- |");
    brc_text_add(text, "\n");
    for (int32_t q = 0; q < s->n_questions; ++q)
        for (int k = 1; k < MODELS; ++k) {
            char name[64], error[32];
            double best = INFINITY;
            for (int64_t m = 0; m < s->n_means; ++m) {
                const brc_accuracy_series *series = &s->series[s->means[m].series];
                if (series->question == q && strcmp(series->point->model, models[k]) == 0)
                    best = fmin(best, s->means[m].error);
            }
            if (!isfinite(best)) continue;
            brc_text_add(text, "| %s | %s |", question_name(s->questions[q].point, name, sizeof name), models[k]);
            for (size_t l = 0; l < sizeof levels / sizeof *levels; ++l) {
                int beyond, other_beyond;
                double ours = brc_accuracy_cost(s, q, models[0], levels[l], &beyond),
                       other = brc_accuracy_cost(s, q, models[k], levels[l], &other_beyond);
                if (beyond < 0) ours = brc_accuracy_cost_beyond(s, q, models[0], levels[l]);
                if (other_beyond < 0) other = brc_accuracy_cost_beyond(s, q, models[k], levels[l]);
                if (isnan(other / ours) || (beyond > 0 && other_beyond > 0) || (beyond < 0 && other_beyond < 0))
                    brc_text_add(text, " |");
                else if ((beyond < 0 || other_beyond < 0) && other / ours > MOST_DRAWN_ON)
                    brc_text_add(text, " >~1e+04 |");
                else
                    brc_text_add(text, " %s%s%s%.2g |", beyond > 0 ? ">" : "", other_beyond > 0 ? "<" : "",
                                 beyond < 0 || other_beyond < 0 ? "~" : "", other / ours);
            }
            brc_text_add(text, " %s |\n", percent(best, error, sizeof error));
        }
}

static void add_orders(const brc_accuracy_study *s, brc_text *text)
{
    brc_text_add(text, "\n## Every series\n\nError (root of the mean square over seeds) at each number of elements, "
                       "and the order: the slope of log error against log spacing.\n\n"
                       "| problem | way | elements: error | order |\n| --- | --- | --- | --- |\n");
    for (int32_t r = 0; r < s->n_series; ++r) {
        char name[64], what[256], error[32];
        const brc_accuracy_series *series = &s->series[r];
        brc_text_add(text, "| %s | %s |", question_name(series->point, name, sizeof name),
                     brc_accuracy_describe(series->point, false, what, sizeof what));
        for (int64_t m = 0; m < s->n_means; ++m)
            if (s->means[m].series == r)
                brc_text_add(text, " %lld: %s;", (long long)s->means[m].point->elements,
                             percent(s->means[m].error, error, sizeof error));
        if (isnan(series->order))
            brc_text_add(text, " | |\n");
        else
            brc_text_add(text, " | %.1f |\n", series->order);
    }
}

static void add_fronts(const brc_accuracy_study *s, brc_text *text)
{
    brc_text_add(
        text, "\n## Pareto fronts\n\nWays that nothing measured beats in both error (the largest of this and the finer "
              "ones of the series) and seconds.\n\n| problem | way | error | seconds |\n| --- | --- | --- | --- |\n");
    for (int32_t q = 0; q < s->n_questions; ++q)
        for (int64_t m = 0; m < s->n_means; ++m) {
            char name[64], what[256], error[32];
            const brc_accuracy_mean *mean = &s->means[m];
            if (!mean->front || s->series[mean->series].question != q) continue;
            brc_text_add(text, "| %s | %s | %s | %.3g |\n", question_name(mean->point, name, sizeof name),
                         brc_accuracy_describe(mean->point, true, what, sizeof what),
                         percent(mean->error, error, sizeof error), mean->cost_s);
        }
}

/* The front as steps, cheapest first. */
static void add_front_data(const brc_accuracy_study *s, int32_t q, brc_text *text)
{
    double after = 0;
    brc_text_add(text, "$front << END\n");
    for (;;) {
        const brc_accuracy_mean *next = NULL;
        for (int64_t m = 0; m < s->n_means; ++m)
            if (s->means[m].front && s->series[s->means[m].series].question == q && s->means[m].cost_s > after &&
                (!next || s->means[m].cost_s < next->cost_s))
                next = &s->means[m];
        if (!next) break;
        brc_text_add(text, "%.6g %.6g\n", next->cost_s, 100 * next->error);
        after = next->cost_s;
    }
    brc_text_add(text, "END\n");
}

static brc_status draw(brc_context *context, const brc_accuracy_study *s, int32_t q, const char *folder)
{
    enum { TITLES = 40 }; /* as many as the picture is high */
    const brc_accuracy_point *question = s->questions[q].point;
    brc_text script = {.context = context};
    char *path = NULL, *aside = NULL, name[64], file[96];
    bool made;
    int titles = 0;
    brc_status status = BRC_OK;
    snprintf(file, sizeof file, isnan(question->nu) ? "%s.png" : "%s_%g.png", question->problem, question->nu);
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, file, &path));
    BRC_TRY_OR(cleanup, brc_file_aside(context, path, &aside));
    brc_gnuplot_begin(&script, 1300, 760, aside);
    add_front_data(s, q, &script);
    for (int32_t r = 0; r < s->n_series; ++r) {
        if (s->series[r].question != q) continue;
        brc_text_add(&script, "$s%d << END\n", (int)r);
        for (int64_t m = 0; m < s->n_means; ++m)
            if (s->means[m].series == r && s->means[m].error > 0)
                brc_text_add(&script, "%.6g %.6g\n", s->means[m].cost_s, 100 * s->means[m].error);
        brc_text_add(&script, "END\n");
    }
    brc_text_add(&script,
                 "set logscale xy\nset format x '10^{%%L}'\nset format y '%%g'\nset title '%s: %s' noenhanced\nset "
                 "xlabel 'seconds of one thread (%s)' offset 0,0.6\nset ylabel 'error [%%]'\n",
                 question_name(question, name, sizeof name), question->quantity, question->cost_of);
    brc_text_add(&script, "set key outside right top maxcols 1 samplen 2 spacing 0.9 font ',11' noenhanced\nplot "
                          "$front using 1:2 with steps linewidth 5 linecolor rgb '#dddddd' title 'Pareto front'");
    for (int32_t r = 0; r < s->n_series; ++r) {
        if (s->series[r].question != q) continue;
        char what[256];
        int model = 0;
        while (model < MODELS && strcmp(models[model], s->series[r].point->model) != 0)
            ++model;
        const bool line = s->series[r].n > 1, titled = line && titles < TITLES;
        brc_text_add(&script, ", $s%d using 1:2 with %s pointtype %d linecolor rgb '%s' %s%s%s", (int)r,
                     line ? "linespoints" : "points", 4 + (int)(r % 10), model < MODELS ? colours[model] : "#666666",
                     titled ? "title '" : "notitle",
                     titled ? brc_accuracy_describe(s->series[r].point, false, what, sizeof what) : "",
                     titled ? "'" : "");
        titles += titled;
    }
    brc_text_add(&script, "\n");
    status = brc_gnuplot_draw(context, &script, aside, path, "curves.csv", &made);
cleanup:
    brc_text_free(&script);
    brc_memory_free(path);
    brc_memory_free(aside);
    return status;
}

brc_status brc_accuracy_report_write(brc_context *context, const brc_accuracy_study *study, const char *folder)
{
    brc_text text = {.context = context};
    char *path = NULL;
    brc_status status = BRC_OK;
    brc_text_add(&text, "# What accuracy costs in time: tables of `breccia bench accuracy`\n\n");
    add_targets(study, &text);
    add_ratios(study, &text);
    add_fronts(study, &text);
    add_orders(study, &text);
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "accuracy.md", &path));
    BRC_TRY_OR(cleanup, brc_text_write(&text, path));
    for (int32_t q = 0; q < study->n_questions; ++q)
        BRC_TRY_OR(cleanup, draw(context, study, q, folder));
cleanup:
    brc_text_free(&text);
    brc_memory_free(path);
    return status;
}
