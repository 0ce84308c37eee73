/* Measures: the samples of a window are collected and scaled, then one operator runs over them. */
#include "measures.h"
#include "fit.h"
#include "sphere_box.h"
#include "spectrum.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

double brc_measure_area(const brc_domain *domain, int32_t set)
{
    if (domain->element_kind == BRC_ELEMENT_SPHERE) return brc_sphere_box_section(domain, set);
    if (set < 0 || domain->sets[set].kind != BRC_SET_FACES) return NAN;
    const brc_set *members = &domain->sets[set];
    double sum[3] = {0}, area = 0, all = 0;
    for (int64_t k = 0; k < members->n_members; ++k) {
        const double *s = domain->free_area_vector + 3 * (int64_t)members->members[k];
        for (int c = 0; c < 3; ++c)
            sum[c] += s[c];
        all += sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    }
    const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    if (!(length > 1e-9 * all)) return NAN; /* it goes all the way round: what is left is rounding */
    for (int64_t k = 0; k < members->n_members; ++k) {
        const double *s = domain->free_area_vector + 3 * (int64_t)members->members[k];
        area += fabs(s[0] * sum[0] + s[1] * sum[1] + s[2] * sum[2]) / length;
    }
    return area;
}

static void why_not(brc_measured *measured, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void why_not(brc_measured *measured, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(measured->why_not, sizeof measured->why_not, format, arguments);
    va_end(arguments);
    measured->value = NAN;
}

static int32_t find_sensor(const brc_scene *scene, const char *name)
{
    for (int32_t s = 0; s < scene->n_sensors; ++s)
        if (strcmp(scene->sensors[s].name, name) == 0) return s;
    return -1;
}

static int32_t find_stage(const brc_scene *scene, const char *name)
{
    if (name[0] == '\0') return scene->n_stages - 1;
    for (int32_t s = 0; s < scene->n_stages; ++s)
        if (strcmp(scene->stages[s].name, name) == 0) return s;
    return -1;
}

/* Whether the operator reads a second sensor, as the abscissa of a fit. */
static bool is_slope(brc_measure_kind kind)
{
    return kind == BRC_MEASURE_E || kind == BRC_MEASURE_NU || kind == BRC_MEASURE_K || kind == BRC_MEASURE_G ||
           kind == BRC_MEASURE_SLOPE;
}

/* What y is multiplied with: the measure's scale, one over the reference area, and minus for a Poisson's ratio. */
static double factor_of(const brc_measure *measure, const brc_domain *domain, brc_measured *measured)
{
    double factor = measure->kind == BRC_MEASURE_NU ? -measure->scale : measure->scale;
    if (measure->area_set[0] == '\0') return factor;
    const double area = domain ? brc_measure_area(domain, brc_domain_find_set(domain, measure->area_set)) : NAN;
    if (area > 0) return factor / area;
    why_not(measured,
            "\"%s\" is not a face set with an area (one that goes all the way round has none), nor a wall of a box or "
            "cylinder of spheres",
            measure->area_set);
    return NAN;
}

brc_status brc_measure_series_collect(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                      const brc_history *history, const brc_measure *measure, brc_measure_series *out,
                                      brc_measured *measured)
{
    *out = (brc_measure_series){0};
    const int32_t y = find_sensor(scene, measure->y);
    const int32_t x = is_slope(measure->kind) ? find_sensor(scene, measure->x) : y;
    const int32_t stage = find_stage(scene, measure->stage);
    const double factor = factor_of(measure, domain, measured);
    if (isnan(factor)) return BRC_OK;
    if (y < 0 || x < 0 || stage < 0) {
        why_not(measured, "there is no %s \"%s\"", stage < 0 ? "stage" : "sensor",
                stage < 0 ? measure->stage
                : y < 0   ? measure->y
                          : measure->x);
        return BRC_OK;
    }
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->time, history->n_samples, "samples of a measure"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->x, history->n_samples, "samples of a measure"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->y, history->n_samples, "samples of a measure"));
    const bool whole = !(measure->window[1] > measure->window[0]);
    const double slack = 1e-9 * (measure->window[1] - measure->window[0]); /* ends count, whatever their rounding */
    for (int64_t k = 0; k < history->n_samples; ++k) {
        const double t = history->stage_time[k];
        if (history->stage[k] != stage) continue;
        if (!whole && (t < measure->window[0] - slack || t > measure->window[1] + slack)) continue;
        const double *value = history->value + k * history->n_sensors;
        if (!isfinite(value[x]) || !isfinite(value[y])) continue;
        out->time[out->n] = t;
        out->x[out->n] = value[x];
        out->y[out->n++] = factor * value[y];
    }
    measured->n_used = out->n;
    if (out->n == 0) why_not(measured, "no sample lies in its window");
    return BRC_OK;
cleanup:
    brc_measure_series_free(out);
    return status;
}

void brc_measure_series_free(brc_measure_series *series)
{
    brc_memory_free(series->time);
    brc_memory_free(series->x);
    brc_memory_free(series->y);
    *series = (brc_measure_series){0};
}

static double integral(const brc_measure_series *series)
{
    double sum = 0;
    for (int64_t k = 1; k < series->n; ++k)
        sum += (series->time[k] - series->time[k - 1]) * (series->y[k] + series->y[k - 1]) / 2;
    return sum;
}

/* Share of an interval in which y, going straight from a to b, lies above a level >= 0. */
static double share_above(double a, double b, double level)
{
    const double least = fmin(a, b), most = fmax(a, b);
    return least > level ? 1 : most > level ? (most - level) / (most - least) : 0;
}

static double duration(const brc_measure_series *series, double level)
{
    double sum = 0;
    for (int64_t k = 1; k < series->n; ++k)
        sum += (series->time[k] - series->time[k - 1]) * (share_above(series->y[k - 1], series->y[k], level) +
                                                          share_above(-series->y[k - 1], -series->y[k], level));
    return sum;
}

static double time_mean(const brc_measure_series *series)
{
    const double duration = series->time[series->n - 1] - series->time[0];
    return duration > 0 ? integral(series) / duration : series->y[series->n - 1];
}

static double peak(const brc_measure_series *series)
{
    double most = series->y[0];
    for (int64_t k = 1; k < series->n; ++k)
        if (fabs(series->y[k]) > fabs(most)) most = series->y[k];
    return most;
}

/* Time no farther from the first value than this share of it. */
static void time_near_first(const brc_measure_series *series, double share, brc_measured *measured)
{
    const double far = share * fabs(series->y[0]);
    double sum = 0;
    for (int64_t k = 1; k < series->n; ++k) {
        const double a = series->y[k - 1] - series->y[0], b = series->y[k] - series->y[0];
        sum += (series->time[k] - series->time[k - 1]) * (1 - share_above(a, b, far) - share_above(-a, -b, far));
    }
    if (far > 0)
        measured->value = sum;
    else
        why_not(measured, "a share of the first value needs one; the first value is 0");
}

/* Slope of y against time. */
static void rate(const brc_measure_series *series, brc_measured *measured)
{
    double t = 0, y = 0, ty = 0, tt = 0;
    for (int64_t k = 0; k < series->n; ++k) {
        t += series->time[k] / (double)series->n;
        y += series->y[k] / (double)series->n;
    }
    for (int64_t k = 0; k < series->n; ++k) {
        ty += (series->time[k] - t) * (series->y[k] - y);
        tt += (series->time[k] - t) * (series->time[k] - t);
    }
    if (tt > 0)
        measured->value = ty / tt;
    else
        why_not(measured, "a rate needs samples at two times");
}

/* When the first bond of the stage and window broke: time of the stage, of a static one its load factor; NAN: none
 * did. */
static double first_break(const brc_scene *scene, const brc_history *history, const brc_cracks *cracks,
                          const brc_measure *measure)
{
    const int32_t stage = find_stage(scene, measure->stage);
    const bool whole = !(measure->window[1] > measure->window[0]);
    double begin = 0;
    for (int64_t k = history->n_samples - 1; k >= 0; --k)
        if (history->stage[k] == stage) begin = history->time[k] - history->stage_time[k];
    for (int64_t k = 0; cracks && k < cracks->n_broken; ++k) {
        const brc_break *b = &cracks->breaks[k];
        const double t = scene->stages[stage].solver == BRC_SOLVER_DYNAMIC ? b->time - begin : b->load;
        if (b->stage == stage && (whole || (t >= measure->window[0] && t <= measure->window[1]))) return t;
    }
    return NAN;
}

/* y at time t, by a straight line from the sample before the first that is not earlier. */
static void at_time(const brc_measure_series *series, double t, brc_measured *measured)
{
    int64_t k = 0;
    if (isnan(t)) {
        why_not(measured, "no bond broke in its stage and window");
        return;
    }
    while (k + 1 < series->n && series->time[k] < t)
        ++k;
    if (k == 0 || !(series->time[k] > series->time[k - 1])) {
        measured->value = series->y[k];
        return;
    }
    const double share = fmin((t - series->time[k - 1]) / (series->time[k] - series->time[k - 1]), 1);
    measured->value = series->y[k - 1] + share * (series->y[k] - series->y[k - 1]);
}

static brc_status frequency(brc_context *context, const brc_measure_series *series, brc_measured *measured)
{
    int64_t n = series->n;
    const double interval = n > 1 ? series->time[1] - series->time[0] : 0;
    /* A stage ends where it must: its last sample may come early and is left out then. */
    for (int64_t k = 1; k < n; ++k) {
        if (fabs(series->time[k] - series->time[k - 1] - interval) <= 1e-6 * interval) continue;
        if (k == n - 1) {
            --n;
        } else {
            why_not(measured, "the samples are not evenly spaced in time");
            return BRC_OK;
        }
    }
    BRC_TRY(brc_spectrum_peak(context, n, series->y, interval, &measured->value));
    if (isnan(measured->value)) why_not(measured, "the spectrum of %lld samples has no peak", (long long)n);
    return BRC_OK;
}

/* The scene's word, else what the only material says of E, nu, K and G. */
static bool target_of(const brc_scene *scene, const brc_measure *measure, double *target)
{
    *target = measure->has_target ? measure->target : NAN;
    if (measure->has_target) return true;
    if (scene->n_materials != 1) return false;
    const double young = scene->materials[0].young, nu = scene->materials[0].poisson;
    switch (measure->kind) {
    case BRC_MEASURE_E: *target = young; return true;
    case BRC_MEASURE_NU: *target = nu; return true;
    case BRC_MEASURE_K: *target = young / (3 * (1 - 2 * nu)); return true;
    case BRC_MEASURE_G: *target = young / (2 * (1 + nu)); return true;
    default: return false;
    }
}

brc_status brc_measure_evaluate(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                const brc_history *history, const brc_cracks *cracks, int32_t index, brc_measured *out)
{
    const brc_measure *measure = &scene->measures[index];
    brc_measure_series series;
    brc_fit fit;
    *out = (brc_measured){.name = measure->name, .unit = brc_measure_unit(scene, measure), .value = NAN, .error = NAN};
    out->has_target = target_of(scene, measure, &out->target);
    BRC_TRY(brc_measure_series_collect(context, scene, domain, history, measure, &series, out));
    brc_status status = BRC_OK;
    if (out->why_not[0] == '\0') {
        switch (measure->kind) {
        case BRC_MEASURE_FREQUENCY: status = frequency(context, &series, out); break;
        case BRC_MEASURE_PEAK: out->value = peak(&series); break;
        case BRC_MEASURE_MEAN: out->value = time_mean(&series); break;
        case BRC_MEASURE_INTEGRAL: out->value = integral(&series); break;
        case BRC_MEASURE_DURATION:
            if (measure->within > 0)
                time_near_first(&series, measure->within, out);
            else
                out->value = duration(&series, measure->above * fabs(peak(&series)));
            out->value *= measure->scale;
            break;
        case BRC_MEASURE_RATE: rate(&series, out); break;
        case BRC_MEASURE_AT_FIRST_BREAK: at_time(&series, first_break(scene, history, cracks, measure), out); break;
        default:
            fit = brc_fit_polynomial(series.n, series.x, series.y);
            if (fit.order > 0)
                out->value = fit.coefficient[1];
            else
                why_not(out, "a slope needs two different values of \"%s\"", measure->x);
        }
    }
    brc_measure_series_free(&series);
    if (out->has_target) {
        const bool absolute = measure->kind == BRC_MEASURE_NU || out->target == 0;
        out->error = absolute ? out->value - out->target : out->value / out->target - 1;
    }
    return status;
}
