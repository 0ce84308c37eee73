/* One whole run: read the scene, build the domain, open the device, simulate, record. What `breccia run` does, and each
 * row of `breccia reproduce`. */
#ifndef BRC_COMMANDS_RUN_SCENE_H
#define BRC_COMMANDS_RUN_SCENE_H

#include "../output/sensors/measures.h"
#include "../scene/scene_reader.h"
#include "../solver/run/assembly.h"

/* All borrowed during the call; zero or NULL is the default of each member but the scene's text or path. */
typedef struct brc_run_request {
    const char *path; /* of the scene file; with text: its name in messages */
    const char *text; /* the scene itself, NULL: read from path */
    size_t text_bytes;
    int n_overrides;
    const char *const *overrides; /* as in brc_scene_read */
    const brc_domain *domain;     /* made already; NULL: built from the scene */
    const char *folder;           /* where results go; NULL: nothing is recorded, so there are no measures */
    const char *device;           /* NULL: "auto" */
    brc_precision precision;
    int n_threads;
    bool exact;                   /* as in brc_device_request */
    bool resume;                  /* go on from the last checkpoint in the folder */
    const brc_observer *observer; /* besides the recorder; its self may be filled in `created` */
    /* Called first when all simulations exist; the assembly is borrowed until the call returns that runs the scene. May
     * be NULL. */
    brc_status (*assembled)(void *self, const brc_assembly *assembly);
    /* Called when the simulation exists (of several models: the first), before it runs; may be NULL. */
    brc_status (*created)(void *self, brc_simulation *simulation);
    /* Called when it ended, with its state still there; may be NULL. */
    brc_status (*finished)(void *self, brc_simulation *simulation);
    /* Called before the simulations go, however the run ended; may be NULL. */
    void (*released)(void *self);
    void *self;
    void (*running)(brc_simulation *simulation); /* as in brc_session */
} brc_run_request;

#define BRC_RUN_FILES 9

typedef struct brc_run_measure {
    char name[BRC_NAME];
    char unit[16];
    double value; /* NAN: why_not */
    bool has_target;
    double target, error;
    char why_not[256];
} brc_run_measure;

typedef struct brc_run_results {
    int32_t n_measures;
    brc_run_measure *measures; /* owned */
    char *file[BRC_RUN_FILES]; /* paths of what was written, NULL: not there; owned. Names: brc_run_file_name */
    char device[32], device_name[128];
    int64_t n_elements, n_bonds, steps, device_bytes;
    double build_s, setup_s, steps_s, output_s, total_s;
    double phase_s[BRC_N_PHASES]; /* of the steps (phases.h) */
    double at_rest;               /* share of the elements' steps that were left out (solver/core/awake.h) [-] */
    brc_time_step time_step;      /* of the last dynamic stage */
    brc_ledger ledger;
} brc_run_results;

/* Fills *out also when the run fails (with what is known). Free it in any case. */
brc_status brc_run_scene(brc_context *context, const brc_run_request *request, brc_run_results *out);
void brc_run_results_free(brc_run_results *results);
/* The k-th of "summary.json", "result.h5", "histories.csv", "frames.vtkhdf.series", "picture.png", "curve.png". */
const char *brc_run_file_name(int k);

#endif
