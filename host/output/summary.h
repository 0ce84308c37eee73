/* DIR/summary.json: what scripts and tests read of a run; its keys are stable (docs/reference/results.md). */
#ifndef BRC_OUTPUT_SUMMARY_H
#define BRC_OUTPUT_SUMMARY_H

#include "../solver/run/assembly.h"
#include "checkpoint/checkpoint_report.h"
#include "cracks/crack_records.h"
#include "sensors/history.h"
#include "sensors/measures.h"
#include "prediction.h"

/* All pointers are borrowed for the call; what is NULL is null in the file. */
typedef struct brc_summary {
    const brc_scene *scene;
    int32_t n_domains;
    const brc_domain *const *domains; /* [n_domains] of the parts; 0: not built */
    const brc_assembly *assembly;
    const brc_ledger *ledger;
    const brc_crack_state *cracks; /* NULL: nothing can break */
    const brc_history *history;
    const brc_prediction *prediction;
    int32_t n_measures;
    const brc_measured *measures;
    int64_t n_frames;
    brc_checkpoint_report checkpoints; /* last and from may be NULL */
    double total_s, build_s, output_s; /* wall seconds; setup_s and steps_s are the assembly's */
    bool running;                      /* true: end.status is "running" */
    brc_status end;                    /* how the run ended */
    const char *reason;                /* sentences of the failure; why the last stage ended early; "" : none */
} brc_summary;

/* Written aside and renamed. With several models `model` names all of them, counts, energies and memory are sums,
 * effects.in is what some part contains and effects.out what none does; `parts` then has one object a model: model,
 * bodies, counts, time_step (its own critical one), ledger, memory, effects. Numbers that are not finite are null.
 * end.status is "running", "done", "physics_stopped", "bound_missed", "bad_input", "no_memory", "device_failed",
 * "file_failed", "interrupted" or "internal". */
brc_status brc_summary_write(brc_context *context, const brc_summary *summary, const char *path);

#endif
