/* Effects: what a scene may ask for beside the bonds of its model. One descriptor each, and one line in effects.def;
 * what runs a simulation calls hooks and names no effect. Models hook themselves in likewise (../models/model.h). */
#ifndef BRC_SOLVER_EFFECTS_EFFECT_H
#define BRC_SOLVER_EFFECTS_EFFECT_H

#include "../core/fields.h"

struct brc_simulation;
struct brc_force_request;
struct brc_ledger;
struct brc_state_store;

/* Moments of a run at which effects act, and what of brc_occasion is there. */
typedef enum brc_hook {
    BRC_HOOK_ENTERED,   /* a stage has its loads and its time step */
    BRC_HOOK_BEGIN,     /* before its first forces */
    BRC_HOOK_STARTED,   /* they are there (ledger) */
    BRC_HOOK_RESTART,   /* elements were moved otherwise than by a step */
    BRC_HOOK_PLACE,     /* what is prescribed is put where it is (t) */
    BRC_HOOK_OPEN_STEP, /* a step begins (t, until) */
    BRC_HOOK_ADVANCE,   /* bodies of an effect's own move (kick, drift, extra, numerical) */
    BRC_HOOK_DRAG,      /* velocities are slowed, in the middle of the motion of a step (dt) */
    BRC_HOOK_MOVED,     /* elements are at the end of the step */
    BRC_HOOK_FORCE,     /* forces are added (request) */
    BRC_HOOK_BOOK,      /* forces are whole: reactions, and the work of loads (request) */
    BRC_HOOK_BREAK,     /* after the forces of a step (half_kick) */
    BRC_HOOK_CLOSE,     /* velocities were brought to the whole step (t) */
    BRC_HOOK_WHOLE,     /* after a step whose velocities are whole, where this is due */
    BRC_HOOK_LEDGER,    /* energies are added (ledger) */
    BRC_HOOK_STORE,     /* numbers of a checkpoint (store) */
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
    struct brc_ledger *ledger;
    struct brc_state_store *store;
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

/* Phases of the watch (../run/phases.h): that of the caller where it is 0. */
typedef struct brc_hooked {
    brc_hook hook;
    int order, phase;
    brc_status (*plain)(struct brc_simulation *s); /* this, or call */
    brc_status (*call)(struct brc_simulation *s, const brc_occasion *now);
    bool (*due)(const struct brc_simulation *s); /* NULL: always */
} brc_hooked;

typedef struct brc_effect {
    const char *name;                               /* as `check` lists it; NULL: it is not listed */
    bool (*in)(const brc_wants *wants);             /* whether a run has it; NULL: every one */
    const brc_field_table *const *fields;           /* all of its tables, then NULL; NULL: none */
    brc_status (*create)(struct brc_simulation *s); /* NULL: nothing is made */
    void (*free)(struct brc_simulation *s);
    int n_hooked;
    const brc_hooked *hooked;
} brc_effect;
#define BRC_HOOKED(rows) .n_hooked = (int)(sizeof(rows) / sizeof *(rows)), .hooked = (rows)

/* All of them, in the order of effects.def; *n: how many. */
const brc_effect *const *brc_effects(int *n);

/* ---- of a run (../run/hooks.c) ---- */
/* What an effect keeps of its own in a run; NULL at first. */
void **brc_effect_own(struct brc_simulation *s, const brc_effect *effect);
/* Whether something is hooked in here that is due. */
bool brc_hook_is_due(const struct brc_simulation *s, brc_hook hook);
/* All that is hooked in here and due, in order. now: NULL where the hook says nothing. */
brc_status brc_hook_run(struct brc_simulation *s, brc_hook hook, const brc_occasion *now);

#endif
