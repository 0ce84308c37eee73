/* A simulation: a scene, its domain and a device, stepped through the scene's stages. All arrays that cross this header
 * are host doubles in the order of element ids (not storage order), borrowed for the call. SI units.
 *
 * Output observes: whoever wants samples or frames registers a brc_observer; the solver never includes output. */
#ifndef BRC_SOLVER_SIMULATION_H
#define BRC_SOLVER_SIMULATION_H

#include "../../preprocess/domain/domain.h"
#include "../device/device.h"
#include "../scene/scene.h"

typedef struct brc_simulation brc_simulation;

/* Scene, domain and device are borrowed until brc_simulation_free. The device must have been opened with many_materials
 * = brc_simulation_needs_many_materials(scene, domain). Sets named in loads are looked up in the domain; overlapping
 * prescribed components, unknown sets, face loads on element sets and the like: BRC_BAD_INPUT, all in one pass; also a
 * body whose model is not the scene's (split.h). */
brc_status brc_simulation_create(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                                 brc_device *device, brc_simulation **out);
void brc_simulation_free(brc_simulation **simulation);
/* More than one material on the elements of the domain. */
bool brc_simulation_needs_many_materials(const brc_scene *scene, const brc_domain *domain);
/* Device bytes that scene and domain ask for, from the tables of fields (fields.h): what brc_simulation_create takes,
 * to the byte, and what the first search for contact takes for elements. Lists of a stage's loads, of pairs, and
 * vectors of static solves come on top. */
int64_t brc_simulation_planned_bytes(const brc_simulation *simulation);

/* ---- running ---- */

/* Why observers hear that a run could go on from here later. */
typedef enum brc_pause {
    BRC_PAUSE_GOING,      /* between batches of steps, increments or events; the stage goes on */
    BRC_PAUSE_DONE,       /* the stage ends here, as planned */
    BRC_PAUSE_ENDED,      /* it ends here before its plan (stage_end.h) */
    BRC_PAUSE_INTERRUPTED /* the run stops here */
} brc_pause;

/* What an observer may do; any member may be NULL. A status other than BRC_OK stops the run and is returned by it. */
typedef struct brc_observer {
    void *self;
    brc_status (*stage_begin)(void *self, brc_simulation *simulation, int32_t stage);
    /* History sample: at the start, every scene.output.history_every steps (or increment), at the end of a stage. */
    brc_status (*sample)(void *self, brc_simulation *simulation);
    /* Frame: as scene.output says, always at the start of the first stage and the end of each stage. */
    brc_status (*frame)(void *self, brc_simulation *simulation);
    brc_status (*stage_end)(void *self, brc_simulation *simulation, int32_t stage);
    /* The state may be kept here (state_store.h): the samples and frames of this moment are taken, but for the frame
     * that ends a stage. */
    brc_status (*pause)(void *self, brc_simulation *simulation, brc_pause why);
    /* Looks at steps of its own choice (increments, events): the first one after `step` of the current stage,
     * INT64_MAX: none; both or neither. Velocities are those of the whole step while it looks, and the run goes on with
     * the bits that it would have had without (look.h). What ends the stage there (stage_end.h) ends it at once; an
     * interrupt waits for the next pause, from which the run can be taken up. */
    int64_t (*next_look)(void *self, const brc_simulation *simulation, int64_t step);
    brc_status (*look)(void *self, brc_simulation *simulation);
} brc_observer;
/* The observer struct is copied, *self is borrowed. */
brc_status brc_simulation_observe(brc_simulation *simulation, const brc_observer *observer);
/* Run every stage with progress lines. BRC_PHYSICS_STOPPED on a non-finite value or a runaway ledger: what was sampled
 * so far stays with the observers. SIGINT/SIGTERM via brc_simulation_interrupt: BRC_INTERRUPTED at the next batch. */
brc_status brc_simulation_run(brc_simulation *simulation);
/* Beams (r_m, E_m) of the scene's materials were changed by its owner since: the law anew, all elements back where they
 * were at first, at rest, and brc_simulation_run runs all stages again; energies of the ledger go on from before.
 * Making one anew takes an eighth of a static solve of 10 000 spheres. Model cbm without fracture and contact;
 * BRC_INTERNAL else. */
brc_status brc_simulation_renew(brc_simulation *simulation);
/* Async-signal-safe request to stop. */
void brc_simulation_interrupt(brc_simulation *simulation);

/* ---- stepping by hand, for benches and tests (dynamic stages) ---- */

/* Enter stage `stage`: initial fields, loads, time step, first force evaluation. */
brc_status brc_simulation_begin_stage(brc_simulation *simulation, int32_t stage);
/* n steps of the current dynamic stage; velocities are at whole steps when it returns. Nothing is sampled. */
brc_status brc_simulation_advance(brc_simulation *simulation, int64_t n_steps);
/* Wait for the device. */
brc_status brc_simulation_wait(brc_simulation *simulation);

/* ---- state ---- */

const brc_scene *brc_simulation_scene(const brc_simulation *simulation);
const brc_domain *brc_simulation_domain(const brc_simulation *simulation);
const brc_device *brc_simulation_device(const brc_simulation *simulation);
int32_t brc_simulation_stage(const brc_simulation *simulation); /* current stage, -1 before the first */
int64_t brc_simulation_step(const brc_simulation *simulation);  /* steps (static: increments) of the current stage */
int64_t brc_simulation_total_steps(const brc_simulation *simulation); /* dynamic steps of all stages so far */
double brc_simulation_time(
    const brc_simulation *simulation); /* since the start of the stage [s]; static: load factor 0..1 */
double brc_simulation_total_time(const brc_simulation *simulation); /* physical time of all stages so far [s] */

/* [n_elements][3]: displacement [m], velocity [m/s], and force on every element [N] (loads included). */
brc_status brc_simulation_displacement(brc_simulation *simulation, double *out);
brc_status brc_simulation_velocity(brc_simulation *simulation, double *out);
brc_status brc_simulation_force(brc_simulation *simulation, double *out);
/* Overwrite [n_elements][3] and re-evaluate the forces. NULL: leave. */
brc_status brc_simulation_set_state(brc_simulation *simulation, const double *displacement, const double *velocity);
/* Orientation (w x y z) [n_elements][4] and spin [n_elements][3] [rad/s] of dlsm-published and cbm; BRC_BAD_INPUT for
 * dlsm. spin may be NULL. */
brc_status brc_simulation_orientation(brc_simulation *simulation, double *orientation, double *spin);
/* [n_elements][6] xx yy zz yz xz xy: Green strain [-], second Piola-Kirchhoff stress [Pa], Cauchy stress [Pa]
 * (published: its small strain and stress in the global frame, for all three). Any may be NULL. */
brc_status brc_simulation_strain_stress(brc_simulation *simulation, double *strain, double *stress, double *cauchy);
/* Model cbm: virial stress of every element over `level` shells of neighbours (NAH19 eq. 5 and 6, shells over unbroken
 * bonds) [n_elements][6] xx yy zz yz xz xy [Pa], tension positive; the stress above is that of level 1. BRC_BAD_INPUT:
 * another model, a level outside 0 to 2. */
brc_status brc_simulation_virial_stress(brc_simulation *simulation, int level, double *stress);
/* u_f [n][3] of listed free faces [m]: prescribed components as prescribed, the others u_i + H_i (C - X_i)
 * (dlsm-published: u_i + (R_i - I)(C - X_i)). */
brc_status brc_simulation_face_displacement(brc_simulation *simulation, int64_t n, const int32_t *faces, double *out);
/* Force of the loads with prescribed motion on the solid [N], summed over the members of the domain's set (a face set:
 * its held faces; an element set: its prescribed elements; a face set under element loads: the prescribed elements that
 * own one of its faces). */
brc_status brc_simulation_reaction(brc_simulation *simulation, int32_t set, double out[3]);
/* Moment about `point` of the same forces where they act now, plus the moments that hold prescribed rotations of the
 * set's elements [N m]. */
brc_status brc_simulation_reaction_moment(brc_simulation *simulation, int32_t set, const double point[3],
                                          double out[3]);
/* Sum of all element_force loads on every element, at the last force evaluation [n_elements][3] [N]. */
brc_status brc_simulation_applied_force(brc_simulation *simulation, double *out);

/* The energy ledger [J]. closure = (kinetic + elastic + stabilisation + potential - work + damping + numerical +
 * fracture + contact + friction + impact - initial) over the largest of peak elastic energy, initial kinetic energy and
 * work done [-] (docs/notebook/theory.md T4). */
typedef struct brc_ledger {
    double kinetic, elastic, stabilisation;
    double potential; /* of gravity */
    double work;      /* of prescribed motion and tractions, since the start */
    double damping;   /* lost to mass damping, and to what events of static stages set free */
    double numerical; /* lost to the integrator, by exact expressions on a linear system: Tchamwa-Wielgosz; dlsm with
                         velocity Verlet: where bonds break (docs/notebook/fracture.md) */
    double initial;   /* total brought in by initial fields */
    double total;     /* kinetic + elastic + stabilisation + potential + contact */
    double closure;
    double peak_elastic, peak_kinetic;
    double fracture; /* elastic energy that bonds held when they broke */
    double contact;  /* held by touching surfaces; part of the total */
    double friction; /* lost to sliding */
    double impact;   /* lost to the damping of contact */
} brc_ledger;
/* Evaluated now (a pass over the elements). */
brc_status brc_simulation_ledger(brc_simulation *simulation, brc_ledger *out);
/* Its law has an energy: the ledger of a sound run closes. */
bool brc_simulation_conserves(const brc_simulation *simulation);
/* Total and closure from the other terms. */
void brc_ledger_close(brc_ledger *ledger);
/* Value of a term by its name in brc_sensor.term; NAN for an unknown name. */
double brc_ledger_term(const brc_ledger *ledger, const char *term);

typedef struct brc_time_step {
    double value;            /* [s] */
    double critical;         /* 2 / omega_max by power iteration [s]; 0 when not computed */
    double published;        /* AGH19 eq. 39 [s] */
    double safety;           /* value / critical [-] */
    const char *governed_by; /* "auto: power iteration", "fixed", "published: AGH19 eq. 39" */
} brc_time_step;
/* Of the current stage; for `check`: brc_simulation_find_time_step computes it for a stage without entering it. */
brc_time_step brc_simulation_time_step(const brc_simulation *simulation);
brc_status brc_simulation_find_time_step(brc_simulation *simulation, int32_t stage, brc_time_step *out);
/* Steps the stage will take. */
int64_t brc_simulation_planned_steps(const brc_simulation *simulation, int32_t stage, double time_step);

/* Modes of the last modes stage: n values, ascending, rigid modes excluded [rad/s]; valid until the next stage. */
const double *brc_simulation_modes(const brc_simulation *simulation, int32_t *n);
/* What the static solver did in the last stage. */
typedef struct brc_static_report {
    int64_t iterations;  /* linear iterations in all; of a modes stage: rounds */
    int64_t corrections; /* nonlinear (modified Newton) corrections in all */
    double residual;     /* last, relative to the load [-] */
    /* multigrid of the stage (docs/notebook/theory.md T6): levels, 0 where there was none; seconds of making it, in
     * all; bytes that it held on the device */
    int multigrid_levels;
    double multigrid_seconds;
    int64_t multigrid_bytes;
} brc_static_report;
brc_static_report brc_simulation_static_report(const brc_simulation *simulation);
/* Of beams: displacement [m] and small rotation [rad] of every element [n_elements][6]. */
brc_status brc_simulation_static_state(brc_simulation *simulation, double *out);
/* Such states of the same loads on other stiffness: static solves of the linear law begin from the mixture of all n
 * that has the least energy of the error. Borrowed while stages run; n 0: none, as at first. */
void brc_simulation_know_states(brc_simulation *simulation, int32_t n, const double *const *state);

/* Effects that the run contains and leaves out: NULL-terminated lists of static strings such as "dlsm elasticity",
 * "prescribed faces", "traction", "gravity", "mass damping", "several materials", "Tchamwa-Wielgosz". */
const char *const *brc_simulation_effects_in(const brc_simulation *simulation);
const char *const *brc_simulation_effects_out(const brc_simulation *simulation);

/* The least a step must move through memory [byte]: every word that a pass needs, once; padding, index arithmetic and
 * repeated gathers do not count (docs/notebook/performance.md has the count). Bond updates in a step: n_bonds. */
double brc_simulation_floor_bytes(const brc_simulation *simulation);

/* Wall seconds: setup (create and begin_stage), stepping. */
double brc_simulation_setup_seconds(const brc_simulation *simulation);
double brc_simulation_step_seconds(const brc_simulation *simulation);

#endif
