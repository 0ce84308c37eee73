/* Iterations grow as the elements across the body: how many a solve takes is asked of the same scene with fewer elements. */
#include "trial.h"
#include "pace.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../solver/lockstep.h"
#include "../solver/patience.h"
#include "../solver/stage_end.h"
#include <math.h>
#include <string.h>

static const double coarse_s = 4; /* for the solves of a stage */

typedef struct coarse_watch {
    const brc_device_request *request;
    const brc_setup *setup;
    brc_patience patience;
    double begin;
    int64_t *iterations; /* [n_stages] */
} coarse_watch;

static brc_status coarse_begin(void *self, brc_simulation *simulation, int32_t stage)
{
    coarse_watch *w = self;
    (void)simulation, (void)stage;
    w->begin = brc_pace_clock_s(w->request);
    return BRC_OK;
}

static bool coarse_is_over(void *self)
{
    const coarse_watch *w = self;
    return brc_pace_clock_s(w->request) - w->begin > coarse_s;
}

static brc_status coarse_pause(void *self, brc_simulation *simulation, brc_pause why)
{
    (void)self;
    if (why == BRC_PAUSE_GOING) brc_simulation_end_stage(simulation, "trial"); /* increments go on */
    return BRC_OK;
}

static brc_status coarse_end(void *self, brc_simulation *simulation, int32_t stage)
{
    coarse_watch *w = self;
    const brc_assembly *all = &w->setup->assembly;
    bool left_off = false;
    (void)simulation;
    w->iterations[stage] = 0;
    for (int32_t k = 0; k < all->n; ++k) {
        left_off |= brc_simulation_left_off(all->part[k]);
        w->iterations[stage] += brc_simulation_static_report(all->part[k]).iterations;
    }
    if (left_off) w->iterations[stage] = 0;
    return BRC_OK;
}

/* false: the elements are given one by one. */
static bool coarsen(brc_fill *fill, double share)
{
    const double longer = cbrt(1 / share);
    if (fill->kind == BRC_FILL_POINTS) return false;
    fill->n_elements = fill->n_elements > 0 ? (int64_t)fmax(20, (double)fill->n_elements * share) : 0;
    fill->spacing *= longer;
    fill->radius *= longer;
    fill->min_distance *= longer;
    for (int d = 0; d < 3; ++d)
        if (fill->cells[d] > 0) fill->cells[d] = (int64_t)fmax(1, round((double)fill->cells[d] / longer));
    return true;
}

static brc_status run_coarse(brc_context *context, brc_scene *scene, const brc_device_request *request, int64_t *iterations, double *across)
{
    brc_setup setup = {0};
    brc_status status = BRC_OK;
    coarse_watch w = {.request = request, .setup = &setup, .iterations = iterations};
    w.patience = (brc_patience){.self = &w, .over = coarse_is_over, .batch = 1};
    BRC_TRY_OR(cleanup, brc_setup_domains(context, scene, NULL, request->n_threads, &setup));
    BRC_TRY_OR(cleanup, brc_setup_simulations(context, request, &setup));
    *across = brc_setup_across(&setup);
    BRC_TRY_OR(cleanup, brc_simulation_observe(setup.simulation[0], &(brc_observer){.self = &w, .stage_begin = coarse_begin, .pause = coarse_pause, .stage_end = coarse_end}));
    for (int32_t k = 0; k < setup.n; ++k) brc_simulation_set_patience(setup.simulation[k], &w.patience);
    status = brc_lockstep_run(setup.n, setup.simulation);
cleanup:
    brc_setup_free(&setup);
    return status;
}

brc_status brc_trial_coarse(brc_context *context, brc_scene *scene, const brc_device_request *request, double share, int64_t *iterations, double *across)
{
    const brc_log_level level = brc_log_get_level(context);
    brc_fill *kept = NULL;
    bool can = true;
    memset(iterations, 0, (size_t)scene->n_stages * sizeof *iterations);
    *across = 0;
    BRC_TRY(BRC_ALLOCATE(context, &kept, scene->n_bodies, "fills"));
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        kept[b] = scene->bodies[b].fill;
        can &= !scene->bodies[b].domain_file[0] && coarsen(&scene->bodies[b].fill, share);
    }
    brc_log_set_level(context, BRC_LOG_ERROR);
    /* What a coarser body cannot do (a thin part, an empty set) is no failure: then there is nothing to learn from it. */
    if (can && run_coarse(context, scene, request, iterations, across) != BRC_OK) brc_context_clear(context);
    brc_log_set_level(context, level);
    for (int32_t b = 0; b < scene->n_bodies; ++b) scene->bodies[b].fill = kept[b];
    brc_memory_free(kept);
    return BRC_OK;
}
