/* A picture a measure of a study: its means with 95 % confidence against the first key that varies; where only what is
 * averaged over varies, the share of the runs up to each value. */
#include "study.h"
#include "../base/memory.h"
#include "../output/pictures/gnuplot.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VALUE = 256 };

typedef struct plot {
    const brc_study *study;
    const brc_study_outcome *outcome;
    const brc_study_groups *groups;
    const char *measure;
    int key;   /* -1: none varies */
    double *x; /* [n_runs] room */
} plot;

/* The number that a key has in a run, and the unit behind it; NAN: it has none. */
static double number_of(const brc_study *study, int run, int key, char unit[VALUE])
{
    char value[VALUE], *end;
    const double number = strtod(brc_study_value(study, run, key, value, sizeof value), &end);
    if (end == value) return NAN;
    snprintf(unit, VALUE, "%s", end + strspn(end, " "));
    return number;
}

/* The first key that is not averaged over and has different numbers with one unit; -1: none. */
static int varied_key(const brc_study *study)
{
    for (int k = 0; k < study->n_keys; ++k) {
        char unit[VALUE], other[VALUE];
        const double first = number_of(study, 0, k, unit);
        bool varies = false, numbers = !isnan(first);
        for (int run = 1; run < study->n_runs && numbers; ++run) {
            const double number = number_of(study, run, k, other);
            numbers = !isnan(number) && strcmp(unit, other) == 0;
            varies |= number != first;
        }
        if (varies && numbers && !brc_study_is_averaged(&study->keys[k])) return k;
    }
    return -1;
}

/* Values of runs `from` to `to` of the groups that have one, into room. */
static int take(const plot *p, int from, int to)
{
    int n = 0;
    for (int i = from; i < to; ++i) {
        p->x[n] = brc_study_measured(&p->outcome[p->groups->run[i]], p->measure);
        n += !isnan(p->x[n]);
    }
    return n;
}

static void draw_means(const plot *p, brc_text *script)
{
    char unit[VALUE] = "";
    brc_text_add(script, "$runs << END\n");
    for (int run = 0; run < p->study->n_runs; ++run) {
        const double y = brc_study_measured(&p->outcome[run], p->measure);
        if (!isnan(y)) brc_text_add(script, "%.9g %.9g\n", number_of(p->study, run, p->key, unit), y);
    }
    brc_text_add(script, "END\n$means << END\n");
    for (int g = 0; g < p->groups->n; ++g) {
        const int n = take(p, p->groups->start[g], p->groups->start[g + 1]);
        double mean = 0, square = 0;
        for (int i = 0; i < n; ++i)
            mean += p->x[i] / n;
        for (int i = 0; i < n; ++i)
            square += (p->x[i] - mean) * (p->x[i] - mean);
        if (n > 0)
            brc_text_add(script, "%.9g %.9g %.9g\n",
                         number_of(p->study, p->groups->run[p->groups->start[g]], p->key, unit), mean,
                         n > 1 ? brc_study_student(n - 1) * sqrt(square / (n - 1) / n) : 0);
    }
    brc_text_add(script,
                 "END\nset xlabel '%s%s%s%s' noenhanced\nset ylabel '%s' noenhanced\nset offsets graph 0.05, graph "
                 "0.05, graph 0.05, graph 0.05\nset format xy '%%.4g'\nset key above\n"
                 "plot $runs with points pointtype 6 pointsize 0.6 linecolor '#bbbbbb' title 'runs', "
                 "$means with yerrorbars pointtype 7 linecolor '#4477aa' title 'means, 95 %%'\n",
                 p->study->keys[p->key].key, unit[0] ? " [" : "", unit, unit[0] ? "]" : "", p->measure);
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void draw_shares(const plot *p, brc_text *script)
{
    const int n = take(p, 0, p->study->n_runs);
    qsort(p->x, (size_t)n, sizeof *p->x, by_value);
    brc_text_add(script, "$runs << END\n");
    for (int i = 0; i < n; ++i)
        brc_text_add(script, "%.9g %.9g\n", p->x[i], (i + 0.5) / n);
    brc_text_add(script,
                 "END\nset xlabel '%s' noenhanced\nset ylabel 'share of the runs'\nset yrange [0:1]\nset offsets graph "
                 "0.05, graph 0.05\nset format x '%%.4g'\nset xtics rotate by -30\nunset key\n"
                 "plot $runs with points pointtype 7 linecolor '#4477aa'\n",
                 p->measure);
}

static void draw(const void *self, brc_text *script)
{
    const plot *p = self;
    if (p->key >= 0)
        draw_means(p, script);
    else
        draw_shares(p, script);
}

brc_status brc_study_draw(brc_context *context, const brc_study *study, const char *folder,
                          const brc_study_outcome *outcome, const brc_study_groups *groups, const char *measure,
                          double *room)
{
    const plot p = {study, outcome, groups, measure, varied_key(study), room};
    bool made;
    char name[VALUE];
    if (take(&p, 0, study->n_runs) < 2) return BRC_OK;
    snprintf(name, sizeof name, "%s.png", measure);
    const brc_gnuplot_figure figure = {
        .folder = folder, .name = name, .numbers = "means.csv", .width = 800, .height = 600, .draw = draw, .self = &p};
    return brc_gnuplot_make(context, &figure, &made);
}
