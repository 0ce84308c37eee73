/* The recorder: writes down everything a run shows, into one folder, of all models of the scene together. It observes
 * simulations and never changes them.
 *
 *     DIR/frames/NNNNNN.vtkhdf   deformed cells with their fields, one file a frame; index DIR/frames.vtkhdf.series
 *     DIR/histories.csv          the sensors, one column each; rows are added while the run goes on
 *     DIR/cracks.csv             with fracture: a row for each broken bond; fragments.csv: the fragments at every
 *                                frame; both grow with the frames
 *     DIR/frames/NNNNNN.cracks.vtu  with fracture: broken faces as polygons; index DIR/cracks.vtu.series
 *     DIR/frames/NNNNNN.strikers.vtu  with walls and strikers: their faces as polygons; index DIR/strikers.vtu.series
 *     DIR/result.h5              the index: histories, sensors, measures, ledger, resolved scene, provenance
 *     DIR/picture.png, curve.png where the scene asks for them; DIR/pictures/NNNNNN.png of every frame
 *     DIR/summary.json           what scripts read; written by every run, also a failed one
 *
 * How a command uses it:
 *
 *     const double start = brc_clock_s();
 *     brc_recorder_create(context, folder, start, &recorder);         // before anything of the run can fail
 *     status = brc_scene_read(...);          if ok brc_recorder_set_scene(recorder, scene);
 *     status = brc_domain_build(...);        if ok brc_recorder_set_domains(recorder, n, domains, build_seconds);
 *     status = brc_simulation_create(...);   if ok brc_recorder_observe(recorder, assembly);
 *     status = brc_lockstep_run(...);
 *     end = brc_recorder_finish(recorder, status);                    // always, whatever status is
 *     brc_recorder_free(&recorder);                                   // before simulation, domain and scene are freed
 *
 * so that a run that fails anywhere leaves a summary.json with the reason (the context's sentences). */
#ifndef BRC_OUTPUT_RECORDER_H
#define BRC_OUTPUT_RECORDER_H

#include "../../preprocess/domain/domain.h"
#include "../scene/scene.h"
#include "../solver/run/assembly.h"
#include "../solver/core/state_store.h"
#include "checkpoint/checkpoint_report.h"
#include "sensors/measures.h"
#include "prediction.h"

typedef struct brc_recorder brc_recorder;

/* Make `folder` (and its parents) and remove from it the results of an earlier run: exactly the files listed above,
 * nothing else. start: brc_clock_s() when the command began, for timing.total_s. context: borrowed until free.
 * BRC_FILE_FAILED where the folder cannot be made or written: then there is no recorder and no summary. */
brc_status brc_recorder_create(brc_context *context, const char *folder, double start, brc_recorder **out);
/* The same for a run that goes on with the results in the folder: nothing is removed yet. */
brc_status brc_recorder_reopen(brc_context *context, const char *folder, double start, brc_recorder **out);
/* Accepts NULL and a pointer to NULL. A recorder that was not finished leaves what it has written so far. */
void brc_recorder_free(brc_recorder **recorder);

/* All borrowed until brc_recorder_finish has returned; each in turn, the later ones may be missing. */
void brc_recorder_set_scene(brc_recorder *recorder, const brc_scene *scene);
/* Threads for what is found once for all frames; 0, as without this call: as OpenMP decides. */
void brc_recorder_set_threads(brc_recorder *recorder, int n_threads);
/* Read whenever a summary is written. */
void brc_recorder_set_prediction(brc_recorder *recorder, const brc_prediction *prediction);
/* domains [n]: of the parts. build_seconds: wall time of making or reading them. */
void brc_recorder_set_domains(brc_recorder *recorder, int32_t n, const brc_domain *const *domains,
                              double build_seconds);
/* Register as an observer of the assembly's first part, which hears of all of them. Sensors are checked
 * against the domain here: unknown or empty sets, faces where elements are needed and the like give BRC_BAD_INPUT with
 * one sentence each. */
brc_status brc_recorder_observe(brc_recorder *recorder, brc_assembly *assembly);

/* Going on later (checkpoint.h): its part of a checkpoint; and, instead of observe, as it was then, once the parts have
 * their states again: samples and files go on behind it, what was written after it goes. `part` of the store is the run
 * (-1). */
brc_status brc_recorder_save(brc_recorder *recorder, brc_state_store *store);
brc_status brc_recorder_resume(brc_recorder *recorder, brc_assembly *assembly, brc_state_store *store);

/* For summary.json; its strings are borrowed until brc_recorder_finish has returned. */
void brc_recorder_set_checkpoints(brc_recorder *recorder, const brc_checkpoint_report *report);

/* The end: last histories, result.h5, measures, picture, curve and, last of all, summary.json. end: what the run
 * returned; its reason is brc_context_message(context) at this moment. Returns `end` if that is a failure, else the
 * first failure of writing (BRC_FILE_FAILED; summary.json then says so too, if it can be written). A picture or curve
 * that cannot be made is a warning in the log, not a failure. */
brc_status brc_recorder_finish(brc_recorder *recorder, brc_status end);

/* After finish, for what a command prints; borrowed from the recorder, NULL or 0 where there is nothing.
 * Measures are in the order of the scene's. */
int32_t brc_recorder_measure_count(const brc_recorder *recorder);
const brc_measured *brc_recorder_measures(const brc_recorder *recorder);
/* Full paths of what was written: "summary.json", "picture.png", "curve.png", "result.h5", "histories.csv",
 * "frames.vtkhdf.series"; NULL for a file that does not exist. */
const char *brc_recorder_path(const brc_recorder *recorder, const char *name);
/* Wall seconds spent in writing and sampling so far (timing.output_s). */
double brc_recorder_seconds(const brc_recorder *recorder);

#endif
