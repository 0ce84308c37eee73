/* The inside of the library's handles. */
#ifndef BRC_LIBRARY_INTERNAL_H
#define BRC_LIBRARY_INTERNAL_H

#include "../commands/run_scene.h"
#include "../include/breccia.h"
#include "../output/sensors/assembly_sensors.h"
#include "../solver/core/trial_budget.h"
#include <pthread.h>

/* The same status in the public list. */
breccia_status brc_public_status(brc_status status);
/* "double", "mixed", "single"; NULL: double. */
brc_status brc_library_precision(brc_context *context, const char *name, brc_precision *out);

/* ---- scenes (scene.c) ---- */

struct breccia_scene {
    brc_context *context;
    brc_status status;
    char *name, *text; /* owned; text NULL: the file could not be read */
    size_t bytes;
    int n_set;
    char **set; /* [n_set] owned */
    char *yaml; /* owned; NULL: errors */
    char *said; /* sentences that the problems point into; owned */
    int n_problems;
    breccia_problem *problems; /* [n_problems] owned */
};

/* ---- runs ---- */

enum { BRC_LIBRARY_OBSERVERS = 32, BRC_LIBRARY_COPIES = 24 };

/* Stepping by hand (by_hand.c). All but the thread is guarded by the mutex. */
typedef struct brc_by_hand {
    bool begun; /* the thread is there */
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    bool standing;     /* the run waits */
    bool over;         /* the run has returned */
    bool all_done;     /* it waits behind its last stage */
    bool leave;        /* it shall end where it is */
    int64_t left;      /* steps it may still make */
    int64_t from;      /* step of the stage from which `left` counts */
    int64_t made;      /* steps of the present call */
    brc_status status; /* once it is over */
} brc_by_hand;

/* What was worked out or read back for breccia_run_array. */
typedef struct brc_copy {
    char name[24];
    int part;
    void *data; /* owned */
} brc_copy;

struct breccia_run {
    brc_context *context;
    const breccia_scene *scene;
    char *device, *folder; /* owned; NULL: default, none */
    char precision[16];
    int threads;
    bool exact, resume;

    int n_observers;
    breccia_observer observers[BRC_LIBRARY_OBSERVERS];
    int32_t told_stage; /* moment at which they were last told */
    int64_t told_step;
    breccia_answer (*told)(void *self, const breccia_moment *moment);
    void *told_self;
    double told_every, told_at; /* brc_clock_s */
    void (*line)(void *self, int level, const char *text);
    void *line_self;

    bool begun, ended;
    volatile bool asked_to_stop;
    double begin, stage_begin;     /* brc_clock_s */
    int64_t stage_first;           /* step at which the stage was begun, or taken up */
    brc_trial_budget budget;       /* hears of iterations */
    brc_assembly assembly;         /* of its own, for reading; n = 0: the state is not there */
    brc_simulation *running;       /* the first part; NULL: the state is not there */
    brc_assembly_sensors *sensors; /* made when they are first asked for */
    int n_copies;
    brc_copy copies[BRC_LIBRARY_COPIES];
    brc_by_hand hand;
    brc_run_results results;
};

/* The whole run in this thread (run.c). */
brc_status brc_library_run(breccia_run *run);
/* Where the run stands. */
breccia_moment brc_library_moment(const breccia_run *run);
/* Ask what the caller wants to know, if it is time; true: stop. */
bool brc_library_tell(breccia_run *run);

/* Called by the run's own observer (by_hand.c); nothing where nobody steps. */
brc_status brc_hand_stage_begin(breccia_run *run);
void brc_hand_stage_end(breccia_run *run, int64_t step);
brc_status brc_hand_look(breccia_run *run);
int64_t brc_hand_next(const breccia_run *run, int64_t step);
void brc_hand_finished(breccia_run *run);
/* The thread, if there is one, is over when this returns. */
void brc_hand_close(breccia_run *run);

#endif
