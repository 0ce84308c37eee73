/* The recorder. While the simulation runs it samples the sensors, adds the samples to histories.csv and writes frames,
 * each with the index and the histories so far, so that a killed run keeps all but its last interval. Nothing here
 * draws: see picture.c, curve.c. */
#include "recorder_internal.h"
#include "../../preprocess/domain/domain_rows.h"
#include "sensors/assembly_sensors.h"
#include "cracks/crack_records.h"
#include "pictures/curve.h"
#include "earlier_results.h"
#include "frames/frame_file.h"
#include "sensors/history_csv.h"
#include "pictures/picture.h"
#include "result_file.h"
#include "sensors/stop.h"
#include "summary.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../base/spill.h"
#include "../solver/run/stage_end.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const FILE_NAME[BRC_N_RECORDS] = {
    "summary.json",      "result.h5",           "histories.csv", "cracks.csv",
    "fragments.csv",     "picture.png",         "curve.png",     "frames.vtkhdf.series",
    "cracks.vtu.series", "strikers.vtu.series", "frames",        "pictures"};

/* ---- the folder ---- */

/* An older run's results beside this one's would mislead. */
static brc_status clean(brc_recorder *recorder)
{
    for (int k = 0; k < BRC_RECORD_FRAMES; ++k)
        BRC_TRY(brc_earlier_remove_file(recorder->context, recorder->path[k]));
    return brc_recorder_remove_frames(recorder, 0);
}

static brc_status write_summary(brc_recorder *recorder, brc_context *context, bool running, brc_status end,
                                const char *reason, const brc_ledger *ledger)
{
    const brc_summary summary = {
        .scene = recorder->scene,
        .n_domains = recorder->n_domains,
        .domains = recorder->domains,
        .assembly = recorder->assembly,
        .ledger = ledger,
        .cracks = brc_crack_records_state(recorder->cracks),
        .history = recorder->history,
        .prediction = recorder->prediction,
        .n_measures = recorder->n_measures,
        .measures = recorder->measures,
        .n_frames = recorder->n_frames,
        .checkpoints = recorder->checkpoints,
        .total_s = brc_clock_s() - recorder->start,
        .build_s = recorder->build_s,
        .output_s = recorder->output_s,
        .running = running,
        .end = end,
        .reason = reason,
    };
    return brc_summary_write(context, &summary, recorder->path[BRC_RECORD_SUMMARY]);
}

static brc_status create(brc_context *context, const char *folder, double start, bool resumed, brc_recorder **out)
{
    brc_recorder *recorder = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &recorder, 1, "recorder"));
    *recorder = (brc_recorder){.context = context, .start = start, .build_s = NAN};
    for (int k = 0; k < BRC_N_RECORDS; ++k)
        BRC_TRY_OR(cleanup, brc_file_join(context, folder, FILE_NAME[k], &recorder->path[k]));
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "", &recorder->folder));
    BRC_TRY_OR(cleanup, brc_file_make_folder(context, folder));
    if (!resumed) BRC_TRY_OR(cleanup, clean(recorder));
    /* A run that is killed leaves this one. It also shows at once that the folder can be written. */
    BRC_TRY_OR(cleanup, write_summary(recorder, context, true, BRC_OK, "", NULL));
cleanup:
    if (status != BRC_OK) brc_recorder_free(&recorder);
    *out = recorder;
    return status;
}

brc_status brc_recorder_create(brc_context *context, const char *folder, double start, brc_recorder **out)
{
    return create(context, folder, start, false, out);
}

brc_status brc_recorder_reopen(brc_context *context, const char *folder, double start, brc_recorder **out)
{
    return create(context, folder, start, true, out);
}

void brc_recorder_free(brc_recorder **recorder)
{
    if (!recorder || !*recorder) return;
    brc_recorder *r = *recorder;
    brc_assembly_sensors_free(&r->sensors);
    brc_crack_records_free(&r->cracks);
    brc_frames_free(&r->frames);
    brc_history_free(&r->history);
    brc_history_csv_free(&r->csv);
    for (int k = 0; k < BRC_N_RECORDS; ++k)
        brc_memory_free(r->path[k]);
    brc_memory_free(r->folder);
    brc_memory_free(r->value);
    brc_memory_free(r->frame_time);
    brc_memory_free(r->measures);
    brc_memory_free(r);
    *recorder = NULL;
}

void brc_recorder_set_prediction(brc_recorder *recorder, const brc_prediction *prediction)
{
    recorder->prediction = prediction;
}

void brc_recorder_set_scene(brc_recorder *recorder, const brc_scene *scene)
{
    recorder->scene = scene;
}

void brc_recorder_set_domains(brc_recorder *recorder, int32_t n, const brc_domain *const *domains, double build_seconds)
{
    recorder->n_domains = n;
    recorder->domains = domains;
    recorder->build_s = build_seconds;
}

void brc_recorder_set_threads(brc_recorder *recorder, int n_threads)
{
    recorder->n_threads = n_threads;
}

void brc_recorder_set_checkpoints(brc_recorder *recorder, const brc_checkpoint_report *report)
{
    recorder->checkpoints = *report;
}

/* ---- while the simulation runs ---- */

/* The stage may end when a sensor has fallen. */
static brc_status stop_if_asked(brc_recorder *r, brc_simulation *simulation)
{
    char reason[192];
    int64_t broken = 0;
    if (r->scene->stages[brc_simulation_stage(simulation)].stop_sensor[0] == '\0') return BRC_OK;
    for (int32_t k = 0; k < r->assembly->n && broken == 0; ++k)
        BRC_TRY(brc_simulation_broken(r->assembly->part[k], &broken));
    if (brc_stop_after_peak(r->scene, r->history, broken > 0 || !r->scene->has_fracture, reason, sizeof reason))
        brc_simulation_end_stage(simulation, reason);
    return BRC_OK;
}

static brc_status sample(void *self, brc_simulation *simulation)
{
    brc_recorder *r = self;
    const double begin = brc_clock_s();
    brc_status status = brc_assembly_sensors_evaluate(r->sensors, r->value);
    if (status == BRC_OK)
        status =
            brc_history_add(r->context, r->history, brc_simulation_stage(simulation), brc_simulation_step(simulation),
                            brc_simulation_time(simulation), brc_simulation_total_time(simulation), r->value);
    if (status == BRC_OK) status = brc_history_csv_add(r->context, r->csv, r->history);
    if (status == BRC_OK) status = stop_if_asked(r, simulation);
    r->output_s += brc_clock_s() - begin;
    return status;
}

/* Index and histories as they stand. */
static brc_status write_index(brc_recorder *r, brc_context *context, const brc_ledger *ledger)
{
    const brc_result result = {
        .scene = r->scene,
        .n_domains = r->n_domains,
        .domains = r->domains,
        .assembly = r->assembly,
        .ledger = ledger,
        .cracks = brc_crack_records_state(r->cracks),
        .history = r->history,
        .n_measures = r->n_measures,
        .measures = r->measures,
        .n_frames = r->n_frames,
        .frame_time = r->frame_time,
    };
    return brc_result_write(context, &result, r->path[BRC_RECORD_RESULT]);
}

static brc_status write_frame(brc_recorder *r, brc_simulation *simulation)
{
    brc_recorder_spill(r, true);
    const brc_status status = brc_recorder_add_frame(r, simulation);
    brc_recorder_spill(r, false);
    BRC_TRY(status);
    return write_index(r, r->context, NULL);
}

static brc_status frame(void *self, brc_simulation *simulation)
{
    brc_recorder *r = self;
    if (!r->frames) return BRC_OK;
    const double begin = brc_clock_s();
    const brc_status status = write_frame(r, simulation);
    r->output_s += brc_clock_s() - begin;
    return status;
}

void brc_recorder_spill(const brc_recorder *recorder, bool begin)
{
    if (recorder->spills) brc_spill_into(begin ? recorder->folder : NULL);
}

/* On a disk, of what is held and made for frames: faces, corners, outlines, and fields. */
#define BYTES_OF_A_CELL 4e3

/* Where ranks have the cells between them, the one that writes gets all, in a file where its folder has room. */
static brc_status bring_cells(brc_recorder *r, const brc_assembly *assembly)
{
    double n = 0;
    for (int32_t k = 0; k < assembly->n; ++k) {
        const brc_domain *d = brc_simulation_domain(assembly->part[k]);
        n += d->here ? (double)d->n_elements : 0;
    }
    if (n == 0) return BRC_OK;
    brc_spill_into(brc_file_writes() ? r->folder : NULL);
    r->spills = brc_file_writes() && brc_spill_room() > BYTES_OF_A_CELL * n;
    brc_spill_into(NULL);
    for (int32_t k = 0; k < assembly->n; ++k) {
        const brc_domain *d = brc_simulation_domain(assembly->part[k]);
        double *const block[] = {d->vertex, d->area_vector, d->face_centroid};
        if (!d->here) continue;
        brc_recorder_spill(r, true);
        for (size_t b = 0; r->spills && b < sizeof block / sizeof *block; ++b)
            r->spills = brc_memory_spill_sparse(block[b]);
        brc_spill_into(NULL);
        BRC_TRY(brc_domain_bring_to_first(r->context, d));
    }
    return BRC_OK;
}

/* Sensors and an empty history. */
static brc_status prepare(brc_recorder *recorder, brc_assembly *assembly)
{
    recorder->assembly = assembly;
    const int32_t n = recorder->scene->n_sensors;
    BRC_TRY(brc_assembly_sensors_create(recorder->context, assembly, &recorder->sensors));
    BRC_TRY(brc_history_create(recorder->context, n, &recorder->history));
    const double begin = brc_clock_s();
    const brc_output *output = &recorder->scene->output;
    brc_status status = BRC_OK;
    if (output->n_frames >= 0 || output->picture) BRC_TRY(bring_cells(recorder, assembly));
    brc_recorder_spill(recorder, true);
    if (output->n_frames >= 0)
        status = brc_frames_create(recorder->context, assembly, recorder->n_threads, &recorder->frames);
    brc_recorder_spill(recorder, false);
    BRC_TRY(status);
    recorder->output_s += brc_clock_s() - begin;
    return BRC_ALLOCATE(recorder->context, &recorder->value, n, "sample");
}

static brc_status observe(brc_recorder *recorder)
{
    const brc_observer observer = {.self = recorder, .sample = sample, .frame = frame};
    return brc_simulation_observe(recorder->assembly->part[0], &observer);
}

brc_status brc_recorder_observe(brc_recorder *recorder, brc_assembly *assembly)
{
    BRC_TRY(prepare(recorder, assembly));
    BRC_TRY(brc_history_csv_create(recorder->context, recorder->scene, recorder->path[BRC_RECORD_HISTORIES],
                                   &recorder->csv));
    if (brc_simulation_has_fracture(assembly->part[0]))
        BRC_TRY(brc_crack_records_create(recorder->context, assembly, recorder->path[BRC_RECORD_CRACKS],
                                         recorder->path[BRC_RECORD_FRAGMENTS], &recorder->cracks));
    return observe(recorder);
}

/* ---- left and taken up again ---- */

/* Samples, frames, and what the assembly remembers. */
static brc_status store_position(brc_recorder *r, brc_state_store *store)
{
    BRC_TRY(brc_history_store(r->context, r->history, store));
    BRC_TRY(
        brc_store_array(r->context, store, "frame_time", BRC_STORED_DOUBLE, 1, &r->n_frames, (void **)&r->frame_time));
    if (r->frames) BRC_TRY(brc_frames_store(r->frames, store));
    BRC_TRY(brc_store_double(store, "peak_elastic", &r->assembly->peak_elastic));
    return brc_store_double(store, "peak_kinetic", &r->assembly->peak_kinetic);
}

brc_status brc_recorder_save(brc_recorder *recorder, brc_state_store *store)
{
    BRC_TRY(store_position(recorder, store));
    return recorder->cracks ? brc_crack_records_save(recorder->context, recorder->cracks, store) : BRC_OK;
}

/* Frames of the past that are gone are missed by the index, not by the run. */
static void look_for_frames(const brc_recorder *r)
{
    int64_t missing = 0;
    char name[32], *path = NULL;
    for (int64_t k = 0; k < r->n_frames; ++k) {
        snprintf(name, sizeof name, "%06lld.vtkhdf", (long long)k);
        if (brc_file_join(r->context, r->path[BRC_RECORD_FRAMES], name, &path) == BRC_OK)
            missing += !brc_file_exists(path);
        brc_memory_free(path);
    }
    if (missing)
        brc_log(r->context, BRC_LOG_WARNING, "%s: %lld of the %lld frames before the checkpoint are not there",
                r->path[BRC_RECORD_FRAMES], (long long)missing, (long long)r->n_frames);
}

/* The folder as it was at the last frame before the checkpoint. */
static brc_status go_back(brc_recorder *r)
{
    look_for_frames(r);
    BRC_TRY(brc_recorder_remove_frames(r, r->n_frames));
    if (r->n_frames == 0) return BRC_OK;
    BRC_TRY(brc_recorder_write_series(r));
    return write_index(r, r->context, NULL);
}

brc_status brc_recorder_resume(brc_recorder *recorder, brc_assembly *assembly, brc_state_store *store)
{
    brc_recorder *r = recorder;
    BRC_TRY(prepare(r, assembly));
    BRC_TRY(store_position(r, store));
    if (brc_simulation_has_fracture(assembly->part[0]))
        BRC_TRY(brc_crack_records_resume(r->context, assembly, r->path[BRC_RECORD_CRACKS],
                                         r->path[BRC_RECORD_FRAGMENTS], store, &r->cracks));
    BRC_TRY(brc_history_csv_create(r->context, r->scene, r->path[BRC_RECORD_HISTORIES], &r->csv));
    BRC_TRY(brc_history_csv_add(r->context, r->csv, r->history));
    BRC_TRY(go_back(r));
    return observe(r);
}

/* ---- the end ---- */

/* Writing goes on past a failure, with a context of its own: the run keeps one sentence, that of the first failure. */
static void note(brc_recorder *r, brc_context *quiet, brc_status one, brc_status *status)
{
    if (one == BRC_OK) return;
    if (*status == BRC_OK) *status = BRC_FAIL(r->context, one, "%s", brc_context_message(quiet));
    brc_context_clear(quiet);
}

static void warn(brc_recorder *r, brc_context *quiet, brc_status one, const char *what)
{
    if (one != BRC_OK) brc_log(r->context, BRC_LOG_WARNING, "no %s: %s", what, brc_context_message(quiet));
    brc_context_clear(quiet);
}

/* The domain that has an area's set; any where there is none. */
static const brc_domain *domain_of(const brc_recorder *r, const char *set)
{
    const int32_t owner = r->assembly->split ? brc_split_owner(r->assembly->split, r->domains, set) : 0;
    return r->domains[owner > 0 ? owner : 0];
}

static brc_status evaluate_measures(brc_recorder *r, brc_context *quiet)
{
    const int32_t n = r->scene->n_measures;
    const brc_crack_state *cracks = brc_crack_records_state(r->cracks);
    BRC_TRY(BRC_ALLOCATE(quiet, &r->measures, n, "measures"));
    for (r->n_measures = 0; r->n_measures < n; ++r->n_measures)
        BRC_TRY(brc_measure_evaluate(quiet, r->scene, domain_of(r, r->scene->measures[r->n_measures].area_set),
                                     r->history, cracks ? &cracks->cracks : NULL, r->n_measures,
                                     &r->measures[r->n_measures]));
    return BRC_OK;
}

static brc_status write_curve(brc_recorder *r, brc_context *quiet)
{
    char set[BRC_NAME];
    bool made;
    brc_curve_area_set(r->scene, set);
    return brc_curve_write(quiet, r->scene, domain_of(r, set), r->history, r->path[BRC_RECORD_CURVE], &made);
}

static void write_results(brc_recorder *r, brc_context *quiet, brc_status *status, const brc_ledger *ledger)
{
    if (r->cracks) note(r, quiet, brc_crack_records_finish(quiet, r->cracks, ledger != NULL), status);
    note(r, quiet, evaluate_measures(r, quiet), status);
    note(r, quiet, write_index(r, quiet, ledger), status);
    note(r, quiet, brc_history_csv_finish(quiet, r->csv, r->history), status);
    if (*status == BRC_FILE_FAILED) return; /* no room for pictures */
    brc_recorder_spill(r, true);
    if (r->scene->output.picture && ledger) /* a simulation that gives no ledger has no state to show */
        warn(r, quiet, brc_picture_write(quiet, r->assembly, r->path[BRC_RECORD_PICTURE]), "picture");
    brc_recorder_spill(r, false);
    if (r->scene->output.curve_x[0] && r->scene->output.curve_y[0]) warn(r, quiet, write_curve(r, quiet), "curve");
}

/* Whether the device can still be asked. */
static bool is_alive(brc_status end)
{
    return end != BRC_DEVICE_FAILED && end != BRC_INTERNAL;
}

/* Are all parts in a stage? One that failed to enter has no loads and forces to show. */
static bool has_begun(const brc_assembly *assembly)
{
    for (int32_t k = 0; k < assembly->n; ++k)
        if (brc_simulation_stage(assembly->part[k]) < 0) return false;
    return true;
}

/* Why the last stage of a run that went well ended early; "" where it did not. */
static const char *last_reason(const brc_recorder *r)
{
    return r->assembly ? brc_simulation_stage_reason(r->assembly->part[0], r->scene->n_stages - 1) : "";
}

brc_status brc_recorder_finish(brc_recorder *recorder, brc_status end)
{
    brc_recorder *r = recorder;
    const double begin = brc_clock_s();
    brc_status status = end;
    brc_ledger ledger;
    bool has_ledger = false;
    brc_context *quiet = brc_context_create();
    if (!quiet) return end != BRC_OK ? end : BRC_FAIL(r->context, BRC_NO_MEMORY, "no memory for a context");
    brc_log_follow(quiet, r->context);
    if (r->assembly && r->csv) {
        if (is_alive(end) && has_begun(r->assembly)) has_ledger = brc_assembly_ledger(r->assembly, &ledger) == BRC_OK;
        write_results(r, quiet, &status, has_ledger ? &ledger : NULL);
    }
    r->output_s += brc_clock_s() - begin;
    const char *reason = status == BRC_OK ? last_reason(r) : brc_context_message(r->context);
    note(r, quiet, write_summary(r, quiet, false, status, reason, has_ledger ? &ledger : NULL), &status);
    brc_context_free(&quiet);
    return status;
}

int32_t brc_recorder_measure_count(const brc_recorder *recorder)
{
    return recorder->n_measures;
}

const brc_measured *brc_recorder_measures(const brc_recorder *recorder)
{
    return recorder->measures;
}

const char *brc_recorder_path(const brc_recorder *recorder, const char *name)
{
    for (int k = 0; k < BRC_RECORD_FRAMES; ++k)
        if (strcmp(name, FILE_NAME[k]) == 0) return brc_file_exists(recorder->path[k]) ? recorder->path[k] : NULL;
    return NULL;
}

double brc_recorder_seconds(const brc_recorder *recorder)
{
    return recorder->output_s;
}
