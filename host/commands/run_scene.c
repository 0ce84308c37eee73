/* One whole run. */
#include "run_scene.h"
#include "price/price.h"
#include "price/price_file.h"
#include "setup.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../base/ranks.h"
#include "../output/checkpoint/checkpoint.h"
#include "../output/checkpoint/checkpoint_identity.h"
#include "../output/recorder.h"
#include "../solver/statics/free_bodies.h"
#include "../solver/run/lockstep.h"
#include <math.h>
#include <string.h>

static const char *const file_names[BRC_RUN_FILES] = {"summary.json",         "result.h5",     "histories.csv",
                                                      "frames.vtkhdf.series", "picture.png",   "curve.png",
                                                      "cracks.csv",           "fragments.csv", "cracks.vtu.series"};

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
    brc_checkpoints *checkpoints;
    brc_scene *scene;
    brc_setup setup;
    char *yaml; /* the scene as it was read, where there are results */
    brc_price price;
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
    out->n_elements = brc_setup_n_elements(&now->setup);
    out->n_bonds = brc_setup_n_bonds(&now->setup);
    for (int32_t k = 0; k < now->setup.n; ++k) {
        if (!now->setup.device[k]) continue;
        const brc_device_info *info = brc_device_get_info(now->setup.device[k]);
        snprintf(out->device, sizeof out->device, "%s", info->selector);
        snprintf(out->device_name, sizeof out->device_name, "%s", info->name);
        out->device_bytes += brc_device_bytes(now->setup.device[k]);
    }
    const brc_assembly *assembly = &now->setup.assembly;
    if (assembly->n > 0) {
        out->steps = brc_simulation_total_steps(assembly->part[0]);
        out->setup_s = brc_assembly_setup_seconds(assembly);
        out->steps_s = brc_simulation_step_seconds(assembly->part[0]);
        for (int phase = 0; phase < BRC_N_PHASES; ++phase)
            out->phase_s[phase] = brc_assembly_phase_seconds(assembly, (brc_step_phase)phase);
        out->at_rest = brc_assembly_at_rest(assembly);
        out->time_step = brc_assembly_time_step(assembly);
    }
    out->output_s = now->recorder ? brc_recorder_seconds(now->recorder) : 0;
    return BRC_OK;
}

/* A run whose energies do not add up went wrong somewhere, however well it ended. Sound ones stay below 2 %. */
static void tell_ledger(brc_context *context, const brc_assembly *assembly, const brc_ledger *ledger)
{
    static const double most = 0.05;
    for (int32_t k = 0; k < assembly->n; ++k)
        if (!brc_simulation_conserves(assembly->part[k])) return;
    if (fabs(ledger->closure) <= most) return;
    brc_log(
        context, BRC_LOG_WARNING,
        "the energy ledger is off by %.3g %% in the end: what was put in, what is there and what was lost do not add "
        "up, so figures of this run are not to be trusted; see whether they stay with a smaller time step "
        "(`time_step: {auto: {safety: 0.4}}`); `guard: {closure: 5 %%}` ends such a run where it begins",
        100 * ledger->closure);
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
    if (now->recorder) brc_recorder_set_threads(now->recorder, request->n_threads);
    if (now->recorder)
        BRC_TRY(brc_checkpoints_create(context, request->folder, now->scene, request->resume, &now->checkpoints));
    if (now->recorder) BRC_TRY(brc_checkpoint_scene(context, now->scene, &now->yaml));
    const double build_start = brc_clock_s();
    BRC_TRY(brc_setup_domains(context, now->scene, request->domain, request->n_threads, &now->setup));
    out->build_s = brc_clock_s() - build_start;
    if (now->recorder) brc_recorder_set_domains(now->recorder, now->setup.n, now->setup.domain, out->build_s);
    BRC_TRY(brc_setup_polish(context, request->n_threads, &now->setup));
    const brc_device_request device = {.selector = request->device ? request->device : "auto",
                                       .precision = request->precision,
                                       .n_threads = request->n_threads,
                                       .exact = request->exact};
    BRC_TRY(brc_setup_simulations(context, &device, &now->setup));
    if (request->exact && brc_device_get_info(now->setup.device[0])->joins_roundings)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "--exact: this build has no cpu kernels that round each product and sum by itself; "
                        "./quickstart build makes them");
    for (int32_t k = 0; k < now->setup.n; ++k)
        BRC_TRY(brc_free_bodies_tell(context, now->setup.split->part[k].scene, now->setup.domain[k], false));
    brc_assembly *assembly = &now->setup.assembly;
    brc_simulation *first = assembly->part[0]; /* hears, and is told, for all */
    if (now->recorder) {
        const brc_price_of of = {now->yaml, brc_device_get_info(now->setup.device[0])->selector, request->precision,
                                 request->n_threads};
        BRC_TRY(brc_price_watch_output(context, &now->setup, &now->price));
        BRC_TRY(brc_price_file_read(context, request->folder, &of, &now->price.prediction.told));
        BRC_TRY(brc_checkpoints_observe(now->checkpoints, assembly, now->recorder));
        BRC_TRY(brc_price_watch(&now->setup, &now->price));
        brc_recorder_set_prediction(now->recorder, &now->price.prediction);
    }
    if (request->assembled) BRC_TRY(request->assembled(request->self, assembly));
    if (request->observer) BRC_TRY(brc_simulation_observe(first, request->observer));
    if (request->created) BRC_TRY(request->created(request->self, first));
    if (request->running) request->running(first);
    const brc_status status =
        now->checkpoints ? brc_checkpoints_run(now->checkpoints) : brc_lockstep_run(assembly->n, assembly->part);
    if (request->running) request->running(NULL);
    BRC_TRY(status);
    BRC_TRY(brc_assembly_ledger(assembly, &out->ledger));
    tell_ledger(context, assembly, &out->ledger);
    return request->finished ? request->finished(request->self, first) : BRC_OK;
}

brc_status brc_run_scene(brc_context *context, const brc_run_request *request, brc_run_results *out)
{
    const double start = brc_clock_s();
    run now = {0};
    memset(out, 0, sizeof *out);
    /* First of all, so that also a run that fails at once leaves a summary. */
    if (request->folder)
        BRC_TRY(request->resume ? brc_recorder_reopen(context, request->folder, start, &now.recorder)
                                : brc_recorder_create(context, request->folder, start, &now.recorder));
    brc_status status = simulate(context, request, &now, out);
    brc_ranks_fail(context, status);
    if (now.checkpoints) {
        const brc_checkpoint_report report = brc_checkpoints_report(now.checkpoints);
        brc_recorder_set_checkpoints(now.recorder, &report);
    }
    if (now.recorder) status = brc_recorder_finish(now.recorder, status);
    const brc_status taken = take_results(context, &now, out);
    if (status == BRC_OK) status = taken;
    if (status == BRC_OK && now.recorder) brc_price_compare(&now.price);
    if (status == BRC_OK && now.price.prediction.told.known)
        brc_price_file_compare(context, request->folder, &now.price.prediction.told, brc_clock_s() - start,
                               out->device_bytes);
    if (request->released) request->released(request->self);
    brc_checkpoints_free(&now.checkpoints);
    brc_recorder_free(&now.recorder);
    brc_setup_free(&now.setup);
    brc_scene_free(&now.scene);
    brc_memory_free(now.yaml);
    out->total_s = brc_clock_s() - start;
    return status;
}
