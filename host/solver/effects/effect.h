/* Effects: what a scene may ask for beside the bonds of its model. One descriptor each, and one line in effects.def;
 * what runs a simulation calls hooks and names no effect. Models hook themselves in likewise (../models/model.h). */
#ifndef BRC_SOLVER_EFFECTS_EFFECT_H
#define BRC_SOLVER_EFFECTS_EFFECT_H

#include "../core/fields.h"

struct brc_simulation;
struct brc_force_request;
struct brc_ledger;
struct brc_live_array;
struct brc_state_store;
struct brc_time_step;

/* Moments of a run at which effects act, and what of brc_occasion is there. */
typedef enum brc_hook {
    BRC_HOOK_ENTER,     /* a stage is to begin: its lists are made (stage) */
    BRC_HOOK_LEAVE,     /* it ends: its lists go */
    BRC_HOOK_ENTERED,   /* a stage has its loads and its time step */
    BRC_HOOK_BEGIN,     /* before its first forces */
    BRC_HOOK_STARTED,   /* they are there (ledger) */
    BRC_HOOK_STEPS,     /* the steps of a dynamic stage are to begin, or to go on after a store */
    BRC_HOOK_RESTART,   /* elements were moved otherwise than by a step */
    BRC_HOOK_PLACE,     /* what is prescribed is put where it is (t) */
    BRC_HOOK_OPEN_STEP, /* a step begins (t, until) */
    BRC_HOOK_ADVANCE,   /* bodies of an effect's own move (kick, drift, extra, numerical) */
    BRC_HOOK_DRAG,      /* velocities are slowed, in the middle of the motion of a step (dt) */
    BRC_HOOK_MOVED,     /* elements are at the end of the step */
    BRC_HOOK_PAIRS,     /* surfaces were looked for: a list of pairs was made, maybe amid an evaluation */
    BRC_HOOK_FORCE,     /* forces are added (request) */
    BRC_HOOK_CONSTRAIN, /* what is prescribed is zeroed in vectors (vector, rotations) */
    BRC_HOOK_BOOK,      /* forces are whole: reactions, and the work of loads (request) */
    BRC_HOOK_BREAK,     /* after the forces of a step (half_kick) */
    BRC_HOOK_CLOSE,     /* velocities were brought to the whole step (t) */
    BRC_HOOK_WHOLE,     /* after a step whose velocities are whole, where this is due */
    BRC_HOOK_READ,      /* what was seen on the device is read (several, ledger) */
    BRC_HOOK_BROKEN,    /* broken bonds are counted (count) */
    BRC_HOOK_LEDGER,    /* energies are added (ledger) */
    BRC_HOOK_STORE,     /* numbers of a checkpoint (store) */
    BRC_HOOK_STRETCH,   /* of these, what steps change, for steps that may be taken again (store) */
    BRC_HOOK_KICKED,    /* arrays that the half kick at the end of a batch changes, by even a rounding (store) */
    BRC_N_HOOKS
} brc_hook;

typedef struct brc_occasion {
    double t, until; /* of the stage [s] */
    double dt;
    double kick, drift; /* of velocities and places [s] */
    double extra;       /* (phi - 1) dt of Tchamwa-Wielgosz, else 0 [s] */
    bool numerical;     /* that scheme: its loss is booked */
    double half_kick;   /* dt/2 where velocities still want the force at the end of the step, else 0 [s] */
    const struct brc_force_request *request;
    struct brc_ledger *ledger; /* READ: NULL where none was drawn up */
    struct brc_state_store *store;
    const brc_stage *stage;
    brc_buffer *vector, *rotations; /* of displacements or forces, of rotations or torques; either may be NULL */
    bool several;                   /* parts of a scene run */
    int64_t *count;
} brc_occasion;

/* Order within a hook: lower first; equal ones as effects.def has them, the model last. */
enum {
    /* FORCE: sums of floating numbers depend on it */
    BRC_FORCE_OF_SURFACES = -20,
    BRC_FORCE_OF_WEIGHT = -10,
    BRC_FORCE_OF_LOADS = 0,
    BRC_FORCE_OF_OTHERS = 10,
    /* MOVED: surfaces ask where elements were, bonds open, then all is looked at */
    BRC_MOVED_SURFACES = -20,
    BRC_MOVED_BONDS = -10,
    BRC_MOVED_CHECKS = 10
};

/* Phases of the watch (../core/phases.h): that of the caller where it is 0. */
typedef struct brc_hooked {
    brc_hook hook;
    int order, phase;
    brc_status (*plain)(struct brc_simulation *s); /* this, or call */
    brc_status (*call)(struct brc_simulation *s, const brc_occasion *now);
    bool (*due)(const struct brc_simulation *s); /* NULL: always */
} brc_hooked;
/* Something to be hooked in that does one thing with what now says. */
#define BRC_CALLED(name, does)                                                                                         \
    static brc_status name(brc_simulation *s, const brc_occasion *now)                                                 \
    {                                                                                                                  \
        return does;                                                                                                   \
    }

/* A bound of the critical time step [s] beside that of the model's bonds. */
typedef struct brc_effect_step_bound {
    brc_status (*find)(struct brc_simulation *s, double *out); /* INFINITY: none */
    void (*check)(const struct brc_simulation *s, const char *stage, double bound, const struct brc_time_step *step);
    const char *alone, *with_power; /* what a report calls it, and it with the power iteration */
} brc_effect_step_bound;

/* Steps ahead of what is known: how many, of at most n, may now be taken so (0: each is to be known); their begin;
 * their end, *stands: they are good, else the simulation is where it was at the beginning. */
typedef struct brc_effect_ahead {
    int64_t (*steps)(const struct brc_simulation *s, int64_t n);
    brc_status (*begin)(struct brc_simulation *s);
    brc_status (*end)(struct brc_simulation *s, bool *stands);
} brc_effect_ahead;

/* Looks of the host that may be put off to the end of a stretch of steps: steps until the next one; the stretch begins;
 * it has ended, *stands: each probe would have found nothing to do. */
typedef struct brc_effect_probes {
    int64_t (*next)(const struct brc_simulation *s);
    void (*begin)(struct brc_simulation *s);
    brc_status (*end)(struct brc_simulation *s, bool *stands);
} brc_effect_probes;

typedef struct brc_effect {
    const char *name;                   /* as `check` lists it; NULL: it is not listed */
    bool (*in)(const brc_wants *wants); /* whether a run has it; NULL: every one */
    /* What of scene and domain its tables ask for, into wants; material [n_elements]. NULL: nothing. */
    void (*ask)(brc_wants *wants, const int32_t *material);
    bool (*exposes)(const brc_scene *scene);        /* any element may come to have a free face; NULL: no */
    const brc_field_table *const *fields;           /* all of its tables, then NULL; NULL: none */
    brc_status (*create)(struct brc_simulation *s); /* NULL: nothing is made */
    void (*free)(struct brc_simulation *s);
    bool follows_surfaces;                   /* it asks where the surfaces of elements are */
    const brc_effect_step_bound *step_bound; /* NULL: none */
    const brc_effect_ahead *ahead;           /* NULL: none */
    const brc_effect_probes *probes;         /* NULL: none */
    /* Steps for which it asks nothing of the host; NULL: all. The step after `step` at which it is to be read
     * (BRC_HOOK_READ); NULL: never. */
    int64_t (*quiet_steps)(const struct brc_simulation *s);
    int64_t (*next_reading)(const struct brc_simulation *s, int64_t step);
    /* An array that others may look at; false: none in this run. */
    bool (*live)(const struct brc_simulation *s, struct brc_live_array *out);
    int n_hooked;
    const brc_hooked *hooked;
} brc_effect;
#define BRC_HOOKED(rows) .n_hooked = (int)(sizeof(rows) / sizeof *(rows)), .hooked = (rows)

/* All of them, in the order of effects.def; *n: how many. */
const brc_effect *const *brc_effects(int *n);

/* ---- of a run (../core/hooks.c) ---- */
/* What an effect keeps of its own in a run; NULL at first. */
void **brc_effect_own(struct brc_simulation *s, const brc_effect *effect);
enum { BRC_MOST_EFFECTS = 32 };
/* Whether a run has it. */
bool brc_effect_is_in(const struct brc_simulation *s, const brc_effect *effect);
/* The k-th effect of a run; NULL: there are no more. */
const brc_effect *brc_effect_at(const struct brc_simulation *s, int k);
/* Whether something is hooked in here that is due. */
bool brc_hook_is_due(const struct brc_simulation *s, brc_hook hook);
/* All that is hooked in here and due, in order. now: NULL where the hook says nothing. */
brc_status brc_hook_run(struct brc_simulation *s, brc_hook hook, const brc_occasion *now);
/* BRC_HOOK_CONSTRAIN. */
brc_status brc_constrain(struct brc_simulation *s, brc_buffer *vector, brc_buffer *rotations);
/* The fewest steps for which no effect asks the host; the next step after `step` at which one is to be read. INT64_MAX:
 * no end. */
int64_t brc_effects_quiet_steps(const struct brc_simulation *s);
int64_t brc_effects_next_reading(const struct brc_simulation *s, int64_t step);
/* Whether one of them follows the surfaces of elements. */
bool brc_effects_follow_surfaces(const struct brc_simulation *s);
/* Steps until the next probe of one of them; what begins and ends theirs (brc_effect_probes). */
int64_t brc_effects_next_probe(const struct brc_simulation *s);
void brc_effects_begin_probes(struct brc_simulation *s);
brc_status brc_effects_end_probes(struct brc_simulation *s, bool *stands);
/* The effect that takes steps ahead; NULL: none. */
const brc_effect_ahead *brc_effects_ahead(const struct brc_simulation *s);

#endif
