/* Load over strain at every sample of a run, as values and as a curve beside theory. */
#include "operators.h"
#include "reproduce_watched.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include "../../output/pictures/gnuplot.h"
#include <math.h>

#define SETTLED 0.02

typedef struct pressing {
    brc_context *context;
    brc_watched watched;
    int32_t load, strain;
    int64_t n, capacity;
    double *time, *modulus; /* [n] [s], [Pa] */
    double theory;          /* [Pa]; NAN: several materials */
} pressing;

static brc_status create(brc_context *context, void **out)
{
    pressing *p = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &p, 1, "curve of a run"));
    p->context = context;
    *out = p;
    return BRC_OK;
}

static void release(void *self)
{
    pressing *p = self;
    if (!p) return;
    brc_watched_close(&p->watched);
    brc_memory_free(p->time);
    brc_memory_free(p->modulus);
    brc_memory_free(p);
}

static brc_status prepare(pressing *p, brc_simulation *simulation)
{
    const brc_scene *scene = brc_simulation_scene(simulation);
    const brc_measure *measure = NULL;
    for (int32_t k = 0; k < scene->n_measures && !measure; ++k)
        if (scene->measures[k].kind == BRC_MEASURE_K) measure = &scene->measures[k];
    if (!measure) return BRC_FAIL(p->context, BRC_BAD_INPUT, "`with: pressing` expects a scene with a measure K");
    p->load = brc_watched_find(scene, measure->y);
    p->strain = brc_watched_find(scene, measure->x);
    const brc_material *material = &scene->materials[0];
    p->theory = scene->n_materials == 1 ? material->young / (3 * (1 - 2 * material->poisson)) : NAN;
    return brc_watched_open(p->context, &p->watched, simulation);
}

static brc_status sample(void *self, brc_simulation *simulation)
{
    pressing *p = self;
    if (!p->watched.sensors) BRC_TRY(prepare(p, simulation));
    BRC_TRY(brc_watched_read(&p->watched, simulation));
    if (p->watched.value[p->strain] == 0) return BRC_OK; /* the start */
    if (p->n == p->capacity) {
        p->capacity = p->capacity ? 2 * p->capacity : 1024;
        BRC_TRY(brc_memory_resize(p->context, (void **)&p->time, p->capacity, sizeof *p->time, "curve of a run"));
        BRC_TRY(brc_memory_resize(p->context, (void **)&p->modulus, p->capacity, sizeof *p->modulus, "curve of a run"));
    }
    p->time[p->n] = brc_simulation_time(simulation);
    p->modulus[p->n++] = p->watched.value[p->load] / p->watched.value[p->strain];
    return BRC_OK;
}

static brc_observer observer(void *self)
{
    return (brc_observer){.self = self, .sample = sample};
}

/* Time in microseconds, modulus in GPa. */
static brc_status write_numbers(const pressing *p, const char *path)
{
    brc_text text = {.context = p->context};
    brc_text_add(&text, "# time_us K_GPa theory_GPa\n");
    for (int64_t k = 0; k < p->n; ++k)
        brc_text_add(&text, "%.9g %.9g %.9g\n", 1e6 * p->time[k], 1e-9 * p->modulus[k], 1e-9 * p->theory);
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

static brc_status draw(const pressing *p, const brc_outcome *outcome, const char *numbers, const char *path)
{
    brc_text script = {.context = p->context};
    char *aside = NULL;
    bool made;
    brc_status status = BRC_OK;
    const brc_case_value *mean = brc_outcome_find(outcome, "K_mean");
    BRC_TRY_OR(cleanup, brc_file_aside(p->context, path, &aside));
    brc_gnuplot_begin(&script, 1000, 700, aside);
    brc_text_add(&script,
                 "set xlabel 'time [{/Symbol m}s]'\nset ylabel 'K_M [GPa]'\nset key bottom right\nset yrange [0:%g]\n",
                 2e-9 * mean->value);
    brc_text_add(&script,
                 "plot '%s' using 1:2 with lines linewidth 2 linecolor rgb '#4477aa' title 'load over strain', ",
                 numbers);
    brc_text_add(&script,
                 "%.9g with lines linewidth 2 dashtype 2 linecolor rgb '#cc6677' title 'E / (3 (1 - 2 {/Symbol n}))'\n",
                 1e-9 * p->theory);
    status = brc_gnuplot_draw(p->context, &script, aside, path, numbers, &made);
cleanup:
    brc_text_free(&script);
    brc_memory_free(aside);
    return status;
}

static brc_status values(const brc_campaign *campaign, const void *self, brc_outcome *outcome)
{
    const pressing *p = self;
    char name[2][80], *path[2] = {NULL, NULL};
    brc_status status = BRC_OK;
    if (p->n == 0) return BRC_FAIL(p->context, BRC_BAD_INPUT, "run %s: its sensors saw no load", outcome->run->name);
    const int64_t half = p->n / 2;
    double mean = 0;
    for (int64_t k = half; k < p->n; ++k)
        mean += p->modulus[k] / (double)(p->n - half);
    int64_t settled = p->n;
    while (settled > 0 && fabs(p->modulus[settled - 1] / mean - 1) <= SETTLED)
        --settled;
    brc_outcome_add(outcome, "K_mean", "Pa", mean, p->theory);
    brc_outcome_add(outcome, "settled", "s", settled < p->n ? p->time[settled] : NAN, NAN);
    static const char *const endings[2] = {"dat", "png"};
    for (int k = 0; k < 2; ++k) {
        snprintf(name[k], sizeof name[k], "%s.%s", outcome->run->name, endings[k]);
        BRC_TRY_OR(cleanup, brc_file_join(p->context, campaign->folder, name[k], &path[k]));
    }
    BRC_TRY_OR(cleanup, write_numbers(p, path[0]));
    status = draw(p, outcome, path[0], path[1]);
cleanup:
    brc_memory_free(path[0]);
    brc_memory_free(path[1]);
    return status;
}

/* At every sample the load over the strain of the scene's first measure of kind K. BRC_BAD_INPUT: it has none. K_mean,
 * over the last half of them (reference: E / (3 (1 - 2 nu)) of the scene's only material), and settled, the time after
 * which they stay within 2 % of it [s]; and <run>.png with its numbers, <run>.dat, in the campaign's folder. */
const brc_operator brc_operator_pressing = {
    .name = "pressing", .create = create, .observer = observer, .values = values, .release = release};
