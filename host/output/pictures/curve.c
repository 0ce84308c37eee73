/* curve.png: the data and a script go into one file, gnuplot draws it. */
#include "curve.h"
#include "../sensors/fit.h"
#include "gnuplot.h"
#include "label.h"
#include "../sensors/measures.h"
#include "../text.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* One axis: what it is called, and what values are multiplied with to be in its unit. */
typedef struct axis {
    char title[256];
    double factor;
} axis;

static bool is_slope(brc_measure_kind kind)
{
    return kind != BRC_MEASURE_FREQUENCY && kind != BRC_MEASURE_PEAK && kind != BRC_MEASURE_MEAN;
}

/* What is drawn: the measure that reads just these two sensors, else a plain slope of one against the other. */
static brc_measure curve_measure(const brc_scene *scene)
{
    const brc_output *output = &scene->output;
    for (int32_t m = 0; m < scene->n_measures; ++m)
        if (is_slope(scene->measures[m].kind) && strcmp(scene->measures[m].x, output->curve_x) == 0 &&
            strcmp(scene->measures[m].y, output->curve_y) == 0)
            return scene->measures[m];
    brc_measure measure = {.kind = BRC_MEASURE_SLOPE, .scale = 1};
    snprintf(measure.x, sizeof measure.x, "%s", output->curve_x);
    snprintf(measure.y, sizeof measure.y, "%s", output->curve_y);
    return measure;
}

void brc_curve_area_set(const brc_scene *scene, char out[BRC_NAME])
{
    const brc_measure measure = curve_measure(scene);
    memcpy(out, measure.area_set, BRC_NAME);
}

/* The slope aimed at: of the measure drawn, else of one against the same sensor in the same unit (a curve of stress
 * beside a modulus measured from forces). */
static double curve_target(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                           const brc_history *history, const brc_measure *drawn)
{
    const char *unit = brc_measure_unit(scene, drawn);
    for (int32_t m = 0; m < scene->n_measures; ++m) {
        const brc_measure *measure = &scene->measures[m];
        brc_measured measured;
        const bool same = strcmp(measure->name, drawn->name) == 0;
        if (!is_slope(measure->kind) || strcmp(measure->x, drawn->x) != 0) continue;
        if (!same && (drawn->name[0] || strcmp(brc_measure_unit(scene, measure), unit) != 0)) continue;
        if (!same && measure->scale != 1) continue; /* of another quantity */
        if (brc_measure_evaluate(context, scene, domain, history, NULL, m, &measured) == BRC_OK && measured.has_target)
            return measured.target;
    }
    return NAN;
}

/* Words inside gnuplot's double quotes, underscores as blanks. */
static void clean_words(char *out, size_t room, const char *words)
{
    size_t n = 0;
    for (; *words && n + 1 < room; ++words)
        out[n++] = *words == '_' ? ' ' : *words == '"' || *words == '\\' || (unsigned char)*words < ' ' ? '\'' : *words;
    out[n] = '\0';
}

static double largest(int64_t n, const double *v)
{
    double most = 0;
    for (int64_t k = 0; k < n; ++k)
        most = fmax(most, fabs(v[k]));
    return most;
}

static axis make_axis(const char *name, const char *unit, double most)
{
    axis a;
    char words[BRC_NAME], prefixed[32];
    clean_words(words, sizeof words, name);
    a.factor = brc_label_unit(unit, most, prefixed);
    int power = 0;
    if (a.factor == 1 && most > 0 && (most < 0.01 || most >= 1e5)) { /* no prefix at hand: a power of a thousand */
        power = 3 * (int)floor(log10(most * (1 + 1e-9)) / 3);
        a.factor = pow(10, -power);
    }
    int n = snprintf(a.title, sizeof a.title, "%s", words);
    if (strcmp(unit, "-") != 0) n += snprintf(a.title + n, sizeof a.title - (size_t)n, " [%s]", prefixed);
    if (power != 0) snprintf(a.title + n, sizeof a.title - (size_t)n, " \xc3\x97 10^{%d}", -power);
    return a;
}

/* What the values of the sensor are multiplied with, before its name: "", "\xe2\x88\x92 ", "0.5 \xc3\x97 ". */
static void sign_and_scale(const brc_measure *measure, char out[32])
{
    const double factor = measure->kind == BRC_MEASURE_NU ? -measure->scale : measure->scale;
    out[0] = '\0';
    if (factor == -1)
        snprintf(out, 32, "\xe2\x88\x92 ");
    else if (factor != 1)
        snprintf(out, 32, "%g \xc3\x97 ", factor);
}

/* Numbers along x at round steps so far apart that none meets the next. */
static void add_steps(brc_text *text, const brc_measure_series *series, double factor)
{
    double low = INFINITY, high = -INFINITY;
    for (int64_t k = 0; k < series->n; ++k) {
        low = fmin(low, factor * series->x[k]);
        high = fmax(high, factor * series->x[k]);
    }
    if (high - low > 0 && isfinite(high - low)) brc_text_add(text, "set xtics %.12g\n", brc_label_step(high - low, 6));
}

static void add_script(brc_text *text, const brc_scene *scene, const brc_measure *measure,
                       const brc_measure_series *series, const brc_fit *fit, double target, const char *unit_x,
                       const char *unit_y, const char *picture)
{
    const axis x = make_axis(measure->x, unit_x, largest(series->n, series->x));
    const axis y = make_axis(measure->area_set[0] ? "stress" : measure->y, unit_y, largest(series->n, series->y));
    const char *unit = brc_measure_unit(scene, measure);
    const double to_axes = y.factor / x.factor;
    char title[256], slope[64], before[32];
    sign_and_scale(measure, before);
    clean_words(title, sizeof title, scene->title);
    brc_gnuplot_begin(text, 1200, 900, picture);
    brc_text_add(text, "set title \"%s\" noenhanced\nset xlabel \"%s\"\nset ylabel \"%s%s\"\n", title, x.title, before,
                 y.title);
    add_steps(text, series, x.factor);
    brc_text_add(text, "set key left top Left reverse spacing 1.3\n"
                       "set autoscale noextend\nset offsets graph 0.02, graph "
                       "0.04, graph 0.06, graph 0.02\n");
    brc_text_add(text, "$data << END\n");
    for (int64_t k = 0; k < series->n; ++k)
        brc_text_add(text, "%.12g %.12g\n", x.factor * series->x[k], y.factor * series->y[k]);
    brc_text_add(text, "END\n");
    const char *const lines = series->n > 60 ? "lines" : "points pointtype 7 pointsize 1.6";
    if (scene->has_fracture) { /* a slope at zero says nothing of a curve that breaks off */
        brc_text_add(text, "plot $data using 1:2 title \"simulation\" with %s linecolor rgb '#222222'\n", lines);
        return;
    }
    brc_label_value(fit->coefficient[1], unit, 6, slope);
    brc_text_add(text, "slope(x) = %.12g + %.12g * x\n", y.factor * fit->coefficient[0], to_axes * fit->coefficient[1]);
    brc_text_add(text, "plot slope(x) title \"slope at zero: %s\" with lines linewidth 2 linecolor rgb '#4477aa'",
                 slope);
    if (isfinite(target)) {
        brc_label_value(target, unit, 6, slope);
        brc_text_add(text,
                     ", \\\n %.12g + %.12g * x title \"target: %s\" with lines linewidth 2 dashtype 2 "
                     "linecolor rgb '#cc6677'",
                     y.factor * fit->coefficient[0], to_axes * target, slope);
    }
    brc_text_add(text, ", \\\n $data using 1:2 title \"simulation\" with %s linecolor rgb '#222222'\n", lines);
}

static const char *unit_of_sensor(const brc_scene *scene, const char *name)
{
    for (int32_t s = 0; s < scene->n_sensors; ++s)
        if (strcmp(scene->sensors[s].name, name) == 0) return brc_sensor_unit(&scene->sensors[s]);
    return "-";
}

brc_status brc_curve_write(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                           const brc_history *history, const char *path, bool *made)
{
    const brc_measure measure = curve_measure(scene);
    brc_measured measured = {0};
    brc_measure_series series;
    brc_text script = {.context = context};
    char *aside = NULL;
    *made = false;
    BRC_TRY(brc_measure_series_collect(context, scene, domain, history, &measure, &series, &measured));
    brc_status status = BRC_OK;
    const brc_fit fit = brc_fit_polynomial(series.n, series.x, series.y);
    if (fit.order == 0) {
        brc_log(context, BRC_LOG_WARNING, "no %s: %s", path,
                measured.why_not[0] ? measured.why_not : "it has fewer than two different points");
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_file_aside(context, path, &aside));
    const double target = curve_target(context, scene, domain, history, &measure);
    add_script(&script, scene, &measure, &series, &fit, target, unit_of_sensor(scene, measure.x),
               measure.area_set[0] ? "Pa" : unit_of_sensor(scene, measure.y), aside);
    status = brc_gnuplot_draw(context, &script, aside, path, "histories.csv", made);
cleanup:
    brc_memory_free(aside);
    brc_text_free(&script);
    brc_measure_series_free(&series);
    return status;
}
