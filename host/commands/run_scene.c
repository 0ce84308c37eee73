/* One whole run. */
#include "run_scene.h"
#include "scene_domain.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../output/recorder.h"
#include "../solver/beam_polish.h"
#include <string.h>

static const char *const file_names[BRC_RUN_FILES] = {"summary.json",         "result.h5",   "histories.csv",
                                                      "frames.vtkhdf.series", "picture.png", "curve.png", "cracks.csv"};

const char *brc_run_file_name(int k)
{
    return file_names[k];
}

void brc_run_results_free(brc_run_results *results)
{
    brc_memory_free(results->measures);
    for (int k = 0; k < BRC_RUN_FILES; ++k)
        brc_memory_free(results->file[k]);
    memset(results, 0, sizeof *results);
}

/* Everything a run holds, so that one place frees it in the right order. */
typedef struct run {
    brc_recorder *recorder;
    brc_scene *scene;
    brc_domain *built;        /* by this run; NULL when it was given */
    const brc_domain *domain; /* used */
    brc_device *device;
    brc_simulation *simulation;
} run;

static brc_status take_results(brc_context *context, const run *now, brc_run_results *out)
{
    const int32_t n = now->recorder ? brc_recorder_measure_count(now->recorder) : 0;
    BRC_TRY(BRC_ALLOCATE(context, &out->measures, n, "measures of a run"));
    const brc_measured *measured = now->recorder ? brc_recorder_measures(now->recorder) : NULL;
    for (int32_t k = 0; measured && k < n; ++k) {
        brc_run_measure *to = &out->measures[out->n_measures++];
        snprintf(to->name, sizeof to->name, "%s", measured[k].name);
        snprintf(to->unit, sizeof to->unit, "%s", measured[k].unit);
        snprintf(to->why_not, sizeof to->why_not, "%s", measured[k].why_not);
        to->value = measured[k].value;
        to->has_target = measured[k].has_target;
        to->target = measured[k].target;
        to->error = measured[k].error;
    }
    for (int k = 0; now->recorder && k < BRC_RUN_FILES; ++k) {
        const char *path = brc_recorder_path(now->recorder, file_names[k]);
        if (!path) continue;
        BRC_TRY(BRC_ALLOCATE(context, &out->file[k], strlen(path) + 1, "path of a result"));
        memcpy(out->file[k], path, strlen(path));
    }
    if (now->domain) {
        out->n_elements = now->domain->n_elements;
        out->n_bonds = now->domain->n_bonds;
    }
    if (now->device) {
        const brc_device_info *info = brc_device_get_info(now->device);
        snprintf(out->device, sizeof out->device, "%s", info->selector);
        snprintf(out->device_name, sizeof out->device_name, "%s", info->name);
        out->device_bytes = brc_device_bytes(now->device);
    }
    if (now->simulation) {
        out->steps = brc_simulation_total_steps(now->simulation);
        out->setup_s = brc_simulation_setup_seconds(now->simulation);
        out->steps_s = brc_simulation_step_seconds(now->simulation);
        out->time_step = brc_simulation_time_step(now->simulation);
    }
    out->output_s = now->recorder ? brc_recorder_seconds(now->recorder) : 0;
    return BRC_OK;
}

/* Up to the end of the simulation; what failed is told by the status, what was made is in *now. */
static brc_status simulate(brc_context *context, const brc_run_request *request, run *now, brc_run_results *out)
{
    if (request->text)
        BRC_TRY(brc_scene_read_text(context, request->path, request->text, request->text_bytes, request->n_overrides,
                                    request->overrides, &now->scene));
    else
        BRC_TRY(brc_scene_read(context, request->path, request->n_overrides, request->overrides, &now->scene));
    if (now->recorder) brc_recorder_set_scene(now->recorder, now->scene);
    const double build_start = brc_clock_s();
    now->domain = request->domain;
    if (!now->domain) {
        BRC_TRY(brc_scene_domain_build(context, now->scene, request->n_threads, &now->built));
        now->domain = now->built;
    }
    out->build_s = brc_clock_s() - build_start;
    if (now->recorder) brc_recorder_set_domain(now->recorder, now->domain, out->build_s);
    if (now->scene->model.kind == BRC_MODEL_CBM && now->scene->model.polish)
        BRC_TRY(brc_beam_polish_scene(context, now->scene, now->domain, request->n_threads));
    const brc_device_request device = {.selector = request->device ? request->device : "auto",
                                       .precision = request->precision,
                                       .many_materials = brc_simulation_needs_many_materials(now->scene, now->domain),
                                       .n_threads = request->n_threads,
                                       .exact = request->exact};
    BRC_TRY(brc_device_open(context, &device, &now->device));
    BRC_TRY(brc_simulation_create(context, now->scene, now->domain, now->device, &now->simulation));
    if (now->recorder) BRC_TRY(brc_recorder_observe(now->recorder, now->simulation));
    if (request->observer) BRC_TRY(brc_simulation_observe(now->simulation, request->observer));
    if (request->created) BRC_TRY(request->created(request->self, now->simulation));
    if (request->running) request->running(now->simulation);
    const brc_status status = brc_simulation_run(now->simulation);
    if (request->running) request->running(NULL);
    BRC_TRY(status);
    BRC_TRY(brc_simulation_ledger(now->simulation, &out->ledger));
    return request->finished ? request->finished(request->self, now->simulation) : BRC_OK;
}

brc_status brc_run_scene(brc_context *context, const brc_run_request *request, brc_run_results *out)
{
    const double start = brc_clock_s();
    run now = {0};
    memset(out, 0, sizeof *out);
    /* First of all, so that also a run that fails at once leaves a summary. */
    if (request->folder) BRC_TRY(brc_recorder_create(context, request->folder, start, &now.recorder));
    brc_status status = simulate(context, request, &now, out);
    if (now.recorder) status = brc_recorder_finish(now.recorder, status);
    const brc_status taken = take_results(context, &now, out);
    if (status == BRC_OK) status = taken;
    brc_recorder_free(&now.recorder);
    brc_simulation_free(&now.simulation);
    brc_device_close(&now.device);
    brc_domain_free(&now.built);
    brc_scene_free(&now.scene);
    out->total_s = brc_clock_s() - start;
    return status;
}
