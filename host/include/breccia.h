/* breccia as a library: read a scene, check it, run it or step it by hand, look at the state while it runs. The
 * program's own commands do the same work through the same code. Compile and link with what `pkg-config --cflags --libs
 * breccia` says, or find_package(breccia) and breccia::breccia (CMake).
 *
 *     breccia_scene *scene = breccia_scene_load("scene.yaml", 0, NULL);
 *     breccia_run *run = breccia_run_create(scene, &(breccia_options){.folder = "results"});
 *     if (breccia_run_go(run) != BRECCIA_OK) fprintf(stderr, "%s\n", breccia_run_message(run));
 *     breccia_run_free(run);
 *     breccia_scene_free(scene);
 *
 * Step by hand, with the velocities where the device keeps them:
 *
 *     breccia_array v;
 *     while (breccia_run_step(run, 100, &done) == BRECCIA_OK && done > 0)
 *         if (breccia_run_array(run, "velocity", 0, &v) == BRECCIA_OK) look_at(v.data, v.n_rows, v.width);
 *     breccia_run_end(run);
 *
 * Nothing here ends the program, handles signals or prints. Every text is UTF-8, every number SI. Scenes and runs are
 * independent of each other; one of them belongs to one thread at a time. Free functions accept NULL. Where a function
 * needs an object, a NULL one gives BRECCIA_NO_MEMORY, so that a chain of calls needs one check at its end. Two
 * versions with the same BRECCIA_INTERFACE have the same functions and structs.
 *
 * Waiting OpenMP threads spin as the environment says when the process begins: GOMP_SPINCOUNT=1000 is what the program
 * runs itself with (docs/notebook/devices.md). */
#ifndef BRECCIA_H
#define BRECCIA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define BRECCIA_PUBLIC __attribute__((visibility("default")))
#else
#define BRECCIA_PUBLIC
#endif

/* Of this header, and of the soname libbreccia.so.N. */
#define BRECCIA_INTERFACE 1

typedef enum breccia_status {
    BRECCIA_OK,
    BRECCIA_PHYSICS_STOPPED, /* a value that is not finite, or energy that runs away */
    BRECCIA_BAD_INPUT,       /* the scene, an option, or a call out of place */
    BRECCIA_NO_MEMORY,
    BRECCIA_DEVICE_FAILED,
    BRECCIA_FILE_FAILED,
    BRECCIA_INTERRUPTED, /* as asked; results up to there are written */
    BRECCIA_INTERNAL     /* an error of breccia */
} breccia_status;

/* "0.1.0", the commit it was built from, and BRECCIA_INTERFACE of the library that is loaded. */
BRECCIA_PUBLIC const char *breccia_version(void);
BRECCIA_PUBLIC const char *breccia_commit(void);
BRECCIA_PUBLIC int breccia_interface(void);
/* What a status says in words; static storage. */
BRECCIA_PUBLIC const char *breccia_status_text(breccia_status status);

/* ---- devices ---- */

typedef struct breccia_device {
    char selector[32]; /* "cpu", "opencl:0", "target:1": for breccia_options.device */
    char name[128];
    bool usable;
    char why_not[256]; /* where it is not: the reason and the cure */
} breccia_device;
/* The first `most` devices into out [most]; returns how many there are, 0 where memory is exhausted. */
BRECCIA_PUBLIC int breccia_devices(int most, breccia_device *out);

/* ---- scenes ---- */

typedef struct breccia_scene breccia_scene;

/* One error or warning of a scene. Texts are owned by the scene. */
typedef struct breccia_problem {
    bool is_warning;
    const char *file;    /* as it was named */
    int line, column;    /* from 1; 0: no place in the file */
    const char *set;     /* the override it is in; "": none */
    const char *message; /* what was found and what is expected, with the cure */
    const char *cure;    /* the last part of the message, "" where it has one part */
} breccia_problem;

/* Read a scene from a file, or from a text, whose name stands for the file in problems and gives the folder of relative
 * paths. set [n_set]: overrides "dotted.path=value" in YAML, as of the program's --set. Arguments are copied. NULL only
 * where memory is exhausted: a scene with errors is an object with problems. */
BRECCIA_PUBLIC breccia_scene *breccia_scene_load(const char *path, int n_set, const char *const *set);
BRECCIA_PUBLIC breccia_scene *breccia_scene_text(const char *name, const char *text, size_t bytes, int n_set,
                                                 const char *const *set);
/* No run may be left that was made of it. */
BRECCIA_PUBLIC void breccia_scene_free(breccia_scene *scene);
/* BRECCIA_OK; BRECCIA_BAD_INPUT with problems, of which a file that is not there is one; BRECCIA_FILE_FAILED. */
BRECCIA_PUBLIC breccia_status breccia_scene_status(const breccia_scene *scene);
/* All errors, in the order of the file; warnings where there are none. *n: their number. */
BRECCIA_PUBLIC const breccia_problem *breccia_scene_problems(const breccia_scene *scene, int *n);
/* The scene with all defaults as YAML that reads back to the same scene; NULL where it has errors. Owned by the
 * scene. */
BRECCIA_PUBLIC const char *breccia_scene_yaml(const breccia_scene *scene);

/* How to run; zero is the default of each. All borrowed during the call that takes it. */
typedef struct breccia_options {
    const char *device;    /* "auto" (default), "cpu", "opencl:N", "opencl:auto", "target:N" */
    const char *precision; /* "double" (default), "mixed", "single" */
    int threads;           /* of the cpu device and of building; 0: as OpenMP decides */
    bool exact;            /* every product and sum is rounded by itself: equal bits on every device, slower */
    const char *folder;    /* of the results, made where it is missing; NULL: nothing is written */
    bool resume;           /* go on from the last checkpoint in the folder */
} breccia_options;

/* What `breccia check` finds. NAN: not known. */
typedef struct breccia_price {
    int64_t n_elements, n_bonds, n_models;
    int64_t device_bytes; /* of the arrays as the run begins */
    double build_seconds;
    double seconds, least_seconds, most_seconds; /* of the whole run, output included, and its range */
    double most_device_bytes, host_bytes,
        disk_bytes; /* of the whole run; what multigrid holds on the device while a static stage solves comes on top */
} breccia_price;
/* Build everything as a run would, which refuses what the run would refuse, and with `trial` also price it by a trial
 * of about a second a stage; else the last two lines are NAN. options may be NULL; folder, exact and resume are not
 * looked at. */
BRECCIA_PUBLIC breccia_status breccia_scene_check(breccia_scene *scene, const breccia_options *options, bool trial,
                                                  breccia_price *out);
/* Sentences of the last check that failed, a line each; "": none. Owned by the scene. */
BRECCIA_PUBLIC const char *breccia_scene_message(const breccia_scene *scene);

/* ---- runs ---- */

typedef struct breccia_run breccia_run;

/* Where a run stands. */
typedef struct breccia_moment {
    int stage, n_stages;    /* stage: from 0 */
    const char *stage_name; /* owned by the run */
    int64_t step, planned;  /* of the stage: steps, increments or events so far, and as planned */
    int64_t total_steps;    /* dynamic steps of all stages so far */
    double time;            /* of the stage [s]; of static ones the load factor [-] */
    double total_time;      /* of all stages so far [s] */
    double time_step;       /* of a dynamic stage [s], else 0 */
    double seconds;         /* by the clock since the run began */
    double seconds_left;    /* of this stage, by its pace so far; NAN: not known yet */
} breccia_moment;

/* What a callback wants. END_STAGE: dynamic, static and event stages end here as if they were done, and the next one
 * begins. STOP: the run ends with BRECCIA_INTERRUPTED at its next pause (at most 256 steps on), with a checkpoint where
 * it has a folder. */
typedef enum breccia_answer { BRECCIA_GO_ON, BRECCIA_END_STAGE, BRECCIA_STOP } breccia_answer;

/* Looks at a run at steps of its own choice; also at the start of a stage (step 0). What it looks at is never changed
 * by looking: files and states of the run are the same bytes as without it. */
typedef struct breccia_observer {
    void *self;          /* borrowed until the run is freed */
    int64_t every_steps; /* 0: not by steps. Increments and events of static stages count as steps */
    double
        every_seconds; /* simulated, of dynamic stages: the first step at or after each multiple; 0: not by time [s] */
    bool stage_ends;   /* also when a stage is done */
    breccia_answer (*look)(void *self, breccia_run *run, const breccia_moment *moment);
} breccia_observer;

/* A copy of the options is kept; the scene is borrowed until the run is freed. NULL only where memory is exhausted. */
BRECCIA_PUBLIC breccia_run *breccia_run_create(const breccia_scene *scene, const breccia_options *options);
/* Ends it as breccia_run_end does where it has not ended. */
BRECCIA_PUBLIC void breccia_run_free(breccia_run *run);

/* Before the run begins. Observers are copied. BRECCIA_BAD_INPUT: it has begun, or there are 32 already. */
BRECCIA_PUBLIC breccia_status breccia_run_observe(breccia_run *run, const breccia_observer *observer);
/* Called about every `every` seconds of the clock, in static solves too; END_STAGE is not heard. */
BRECCIA_PUBLIC breccia_status breccia_run_progress(breccia_run *run, double every,
                                                   breccia_answer (*told)(void *self, const breccia_moment *moment),
                                                   void *self);
/* Lines of the log instead of nothing: level 0 errors, 1 warnings, 2 what the program tells, 3 all. */
BRECCIA_PUBLIC breccia_status breccia_run_log(breccia_run *run, int level,
                                              void (*line)(void *self, int level, const char *text), void *self);

/* Run all that is left, and write the results. */
BRECCIA_PUBLIC breccia_status breccia_run_go(breccia_run *run);
/* n steps (increments, events), over the ends of stages; the first call begins the run, n = 0 only that. *done (or
 * NULL): steps that were made, fewer than n once all stages are done. Between steps the arrays are there. The files and
 * states are those of a run that was left alone. The run goes on in a thread of its own, which also calls the
 * observers; `told` of breccia_run_progress is called in this one, and its STOP ends the run. A stage of modes is one
 * step and cannot be divided. */
BRECCIA_PUBLIC breccia_status breccia_run_step(breccia_run *run, int64_t n, int64_t *done);
/* End a run that was stepped, with results of what was done: BRECCIA_OK where all stages were, else
 * BRECCIA_INTERRUPTED. */
BRECCIA_PUBLIC breccia_status breccia_run_end(breccia_run *run);
/* Ask it to stop, from any thread or a signal handler. */
BRECCIA_PUBLIC void breccia_run_interrupt(breccia_run *run);

/* Sentences of what went wrong, a line each; "": nothing. Owned by the run. */
BRECCIA_PUBLIC const char *breccia_run_message(const breccia_run *run);

/* ---- the state, inside callbacks and between steps ---- */

/* Numbers of the elements of one model, [n_rows][width]. */
typedef struct breccia_array {
    const char *name, *unit; /* static */
    void *data; /* as precision says; owned by the run. Live: until the run ends; else until the same array is asked for
                   again */
    int precision; /* bytes of a number: 8 double, 4 float */
    int64_t n_rows;
    int32_t width;
    const int32_t
        *element; /* [n_rows] id of the element of each row, -1: none. NULL: row k is element k. Owned by the run */
    bool is_live; /* the device's own memory, not a copy */
} breccia_array;

/* Models of the scene that run apart, each with its elements; 0: the state is not there. */
BRECCIA_PUBLIC int breccia_run_parts(const breccia_run *run);
/* Names of the arrays of a part: displacement, velocity, force; orientation, spin (models with rotations); broken
 * (bonds that an element has lost; with fracture): live on the cpu, read back from other devices. reference: positions
 * as the scene begins, live. position, strain, stress (Cauchy, tension positive; both xx yy zz yz xz xy), damage
 * (broken over bonds; with fracture): worked out when they are asked for. The first `most` into names; returns how many
 * there are. Static storage. */
BRECCIA_PUBLIC int breccia_run_array_names(const breccia_run *run, int part, int most, const char **names);
BRECCIA_PUBLIC breccia_status breccia_run_array(breccia_run *run, const char *name, int part, breccia_array *out);
BRECCIA_PUBLIC breccia_status breccia_run_moment(const breccia_run *run, breccia_moment *out);
/* Bonds of all parts, and how many of them are broken. */
BRECCIA_PUBLIC breccia_status breccia_run_bonds(breccia_run *run, int64_t *n_bonds, int64_t *n_broken);

/* Sensors of the scene, in its order; 0 and NULL where the state is not there. Names and units are owned by the run. */
BRECCIA_PUBLIC int breccia_run_sensor_count(const breccia_run *run);
BRECCIA_PUBLIC const char *breccia_run_sensor_name(const breccia_run *run, int sensor);
BRECCIA_PUBLIC const char *breccia_run_sensor_unit(const breccia_run *run, int sensor);
/* What they read now, value [sensors]; NAN: nothing to read. */
BRECCIA_PUBLIC breccia_status breccia_run_read_sensors(breccia_run *run, double *value);

/* ---- after the end ---- */

typedef struct breccia_measure {
    const char *name, *unit, *why_not; /* owned by the run; why_not: where the value is NAN */
    double value;
    bool has_target;
    double target, error; /* where it has one; error: relative [-] */
} breccia_measure;

typedef struct breccia_report {
    int64_t n_elements, n_bonds, steps, device_bytes;
    double build_seconds, setup_seconds, steps_seconds, output_seconds, total_seconds;
    const char *device, *device_name; /* owned by the run */
} breccia_report;

/* Of runs with a folder, as docs/reference/results.md says: path of "summary.json", "result.h5", "histories.csv",
 * "cracks.csv", "fragments.csv", "frames.vtkhdf.series", "cracks.vtu.series", "picture.png", "curve.png"; NULL: not
 * written. Owned by the run. */
BRECCIA_PUBLIC const char *breccia_run_file(const breccia_run *run, const char *name);
BRECCIA_PUBLIC int breccia_run_measure_count(const breccia_run *run);
BRECCIA_PUBLIC breccia_status breccia_run_measure(const breccia_run *run, int k, breccia_measure *out);
BRECCIA_PUBLIC breccia_status breccia_run_report(const breccia_run *run, breccia_report *out);

#ifdef __cplusplus
}
#endif

#endif
