/* The inside of a simulation, shared by the files of host/solver only. Device arrays are in storage rows (layout.h). */
#ifndef BRC_SOLVER_SIMULATION_INTERNAL_H
#define BRC_SOLVER_SIMULATION_INTERNAL_H

#include "../../base/log.h"
#include "../../base/memory.h"
#include "fields.h"
#include "layout.h"
#include "../effects/effect.h"
#include "passes.h"
#include "phases.h"
#include "trial_budget.h"
#include "../utilities/vectors.h"
#include "regime.h"
#include "../simulation.h"
#include "state_store.h"
#include <signal.h>

enum { BRC_MOST_OBSERVERS = 8, BRC_MOST_EFFECTS = 32 };

/* Derived constants of one material (material.c). */
typedef struct brc_elastic {
    double lambda, mu; /* Lame [Pa] */
    double young, density;
    double k;   /* stabilisation modulus of dlsm, mu_c [Pa] */
    double ell; /* lambda_c / (2 mu_c) [-] */
} brc_elastic;
brc_elastic brc_elastic_of(const brc_material *material);
/* Hooke's law: stress of a strain, xx yy zz yz xz xy. */
void brc_hooke(const brc_elastic *material, const double strain[6], double stress[6]);

/* Beams of one material in one body (beams.c). */
typedef struct brc_beam {
    double radius;             /* of the beams [m] */
    double axial, bend, twist; /* E S [N], 2 E I [N m^2], G J [N m^2] */
} brc_beam;

/* Passes of every run; of rotations only where elements turn. */
typedef struct brc_run_passes {
    brc_pass *advance, *advance_rotation, *advance_tchamwa, *numerical_close;
    brc_pass *kinetic_energy, *add_spin_energy, *divide_by_mass;
} brc_run_passes;

/* Numbers of the scene that kernels ask for by name; those of one material where there is one (kernels gather those of
 * several). */
typedef struct brc_constants {
    double lambda, mu, young, k, ell; /* brc_elastic */
    double axial, bend, twist;        /* brc_beam; cbm */
    double beta, one_plus_tau;        /* dlsm: 0 without compaction */
    double rotation_factor, couple;   /* dlsm-published */
    double gravity[3];                /* [m/s^2] */
    bool area_weights, finite, turns; /* finite: the full law */
} brc_constants;

typedef struct brc_breaking brc_breaking; /* fracture_internal.h */
typedef struct brc_strikers brc_strikers; /* strikers_internal.h */
struct brc_contact_state;                 /* contact.h */
struct brc_guard_state;                   /* guard.c */

/* Why a stage ended early (stage_end.c). */
typedef struct brc_stage_note {
    bool ended;
    char reason[192];
} brc_stage_note;

/* How far the current stage has come, beside its step (dynamics.c, static_events.c). */
typedef struct brc_stage_progress {
    int64_t calm_steps;          /* for which the kinetic energy has been small */
    int64_t judged_step;         /* of the last sample */
    double margin, largest_load; /* of the events of a static stage; margin 0: none yet */
} brc_stage_progress;

/* What is hooked in at one moment, in order. */
typedef struct brc_hook_list {
    int n;
    const brc_hooked *at[BRC_MOST_EFFECTS];
} brc_hook_list;

struct brc_simulation {
    brc_context *context;
    const brc_scene *scene;
    const brc_bond_model *model;
    void *of_model; /* what it keeps of its own */
    const brc_domain *domain;
    brc_device *device;
    brc_layout *layout;
    brc_wants wants; /* what the tables of fields ask */
    brc_vector_kernels kernel;
    brc_run_passes pass;
    brc_pass *passes; /* all there are, of effects too (passes.h) */
    brc_constants constant;
    int n_groups;                 /* work-items of an element pass */
    brc_elastic *elastic;         /* [n_materials] */
    brc_beam *beam;               /* cbm: [n_bodies][n_materials] */
    int32_t *material_of_element; /* [n_elements] index into scene.materials */

    /* connectivity and geometry (geometry.c) */
    brc_buffer *row_start, *neighbour, *asked_ahead, *boundary;
    brc_buffer *area, *offset, *ratio; /* dlsm: s, d, q; published: branch (in offset), S (in area) */
    brc_buffer *inv_shape, *inv_volume;
    brc_buffer *material, *modulus, *ell_of, *lame_of;
    brc_buffer *mass, *volume, *inertia;
    brc_buffer *beam_of; /* cbm: branch in offset, 1/length in ratio; stiffness of elements (several materials) */

    /* state */
    brc_buffer *displacement, *velocity, *force;
    brc_buffer *gradient, *stress, *flux, *bond_part; /* dlsm: H, P, B; published: strain in gradient */
    brc_buffer *held_gradient, *held_moment;
    brc_buffer *orientation, *spin, *torque;                     /* published */
    brc_buffer *moved, *lost_numerical, *lost_damping;           /* only with these effects */
    brc_buffer *elastic_energy, *stabilisation_energy, *kinetic; /* [n_rows] scratch of the ledger */
    brc_buffer *partial;                                         /* block sums */

    brc_breaking *fracture;            /* only in scenes with fracture */
    brc_strikers *strikers;            /* only in scenes with strikers */
    struct brc_contact_state *contact; /* only in scenes with contact */
    struct brc_ahead *ahead;           /* from the first step that asks on (ahead.c) */
    struct brc_noise *noise;           /* only where a stage has noise_damping (noise_damping.c) */
    struct brc_look *look;             /* from the first look between two batches on (look.c) */
    struct brc_guard_state *guard;     /* from the first dynamic stage that is run (not stepped by hand) on */

    /* stage */
    int32_t stage;
    int64_t step, total_steps;
    double time, total_time_before, load_factor;
    bool open; /* velocities are those of half a step ago: half a kick is missing (dynamics.c) */
    brc_time_step time_step;
    char governed_by[64]; /* of the time step, where it came from a store */
    brc_stage_progress progress;
    struct brc_static_run *static_run; /* of a static stage that runs; else NULL */
    struct brc_loads *loads;           /* of the stage (effects/loads) */
    bool face_loads;                   /* some face is held or bears a traction in this stage, as kernels ask */
    double work_before, damping_before, numerical_before; /* of earlier stages */
    double initial_energy, peak_elastic, peak_kinetic;
    double total_before_stage; /* energy when the stage was entered [J] */
    double *modes;
    int32_t n_modes;
    brc_static_report static_report;
    brc_stage_note *note; /* [n_stages] */
    brc_regime regime;    /* of all parts, in the first one */
    double released;      /* elastic energy beyond that of the broken bonds that events of static stages set free [J] */

    int n_observers;
    brc_observer observers[BRC_MOST_OBSERVERS];
    volatile sig_atomic_t interrupted;
    const brc_patience *patience; /* of a trial; else NULL */
    bool left_off;                /* in this stage */
    brc_simulation *const
        *volatile others; /* [n_others] while they run in step with this one: an interrupt reaches them too */
    volatile int32_t n_others;
    int n_effects; /* of this run (hooks.c) */
    const brc_effect *effect[BRC_MOST_EFFECTS];
    void *own[BRC_MOST_EFFECTS];
    brc_hook_list hook[BRC_N_HOOKS];
    const char *effects_in[BRC_MOST_EFFECTS], *effects_out[BRC_MOST_EFFECTS];
    double setup_seconds, step_seconds;
    struct {
        brc_step_phase phase;
        double since, seconds[BRC_N_PHASES];
    } watch; /* phases.c */
};

/* Is it time to leave off? Asked once an iteration. */
bool brc_leaves_off(brc_simulation *s);

/* ---- ../core/arrays.c: host doubles by id <-> device rows ---- */
brc_status brc_upload_coeff(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count);
brc_status brc_upload_state(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count);
brc_status brc_upload_int(brc_buffer *buffer, const int32_t *values, int64_t count);
brc_status brc_download(brc_simulation *s, brc_buffer *buffer, int bytes_each, double *values, int64_t count);
/* [n_elements][width] by id to rows (padding: fill) and back. */
brc_status brc_state_to_rows(brc_simulation *s, brc_buffer *buffer, const double *values, int width, double fill);
brc_status brc_state_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width);
brc_status brc_coeff_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width);
/* New buffers of count numbers. */
brc_status brc_new_state(brc_simulation *s, brc_buffer **out, int64_t count, const char *what);
brc_status brc_new_coeff(brc_simulation *s, brc_buffer **out, int64_t count, const char *what);
brc_status brc_new_int(brc_simulation *s, brc_buffer **out, const int32_t *values, int64_t count, const char *what);

/* Storage of a scene's elements. */
brc_status brc_simulation_layout(brc_context *context, const brc_scene *scene, const brc_domain *domain, int32_t slice,
                                 brc_layout **out);

/* ---- scopes.c: what passes find by name (passes.h) ---- */
/* Arrays of elements and their bonds, and constants. */
brc_scope brc_scope_of_run(const brc_simulation *s);
/* Those of an evaluation: a brc_force_request, which each launch gives. */
brc_scope brc_scope_of_request(const brc_scope *outer);
/* Kernels that write a number of each element, to be summed, into `kinetic`: their parameters `out` and `found`. */
brc_scope brc_scope_of_sums(const brc_simulation *s, const brc_scope *outer);
brc_status brc_passes_make(brc_simulation *s, const brc_scope *scope, int n, const brc_pass_wanted *wanted);
#define BRC_PASSES_MAKE(s, scope, wanted)                                                                              \
    brc_passes_make((s), (scope), (int)(sizeof(wanted) / sizeof *(wanted)), (wanted))
#define BRC_PASSES(s, scope, ...)                                                                                      \
    brc_passes_make((s), (scope), (int)(sizeof((brc_pass_wanted[]){__VA_ARGS__}) / sizeof(brc_pass_wanted)),           \
                    (brc_pass_wanted[]){__VA_ARGS__})
/* Passes of the run (brc_run_passes) and kernels of vectors. */
brc_status brc_run_passes_make(brc_simulation *s);

/* ---- simulation_fields.c: state and work arrays ---- */
extern const brc_field_table brc_state_fields;
brc_status brc_simulation_fields_create(brc_simulation *s);
void brc_simulation_fields_free(brc_simulation *s);

/* ---- geometry.c ---- */
extern const brc_field_table brc_geometry_fields; /* of it what breaks change is kept */
brc_status brc_geometry_create(brc_simulation *s);
void brc_geometry_free(brc_simulation *s);
/* Numbers of half-edge h of element e. */
typedef void (*brc_bond_values)(const brc_simulation *s, int64_t e, int64_t h, double out[3]);
/* They, `width` each, of all half-edges into [n_slots][width][C]; missing: where a row has no neighbour. */
brc_status brc_geometry_rows(brc_simulation *s, brc_buffer *buffer, int width, brc_bond_values values,
                             const double missing[3]);
/* Branches likewise. */
brc_status brc_geometry_branches(brc_simulation *s, brc_buffer *buffer);
/* Inverses of the least-squares matrices, with weights 1 or S/L; refine: another inverse where neighbours span space,
 * or NULL. */
typedef void (*brc_shape_refinement)(const brc_simulation *s, int64_t e, double inverse[6]);
brc_status brc_geometry_shapes(brc_simulation *s, bool weighted, brc_shape_refinement refine);
/* Constants of each element, only for several materials. */
brc_status brc_geometry_materials(brc_simulation *s);
/* Symmetric 3 x 3 preconditioner blocks [n_rows][6]: inverse of sum (S/L) [mu I + (lambda + mu) n n^T]. */
brc_status brc_geometry_precondition_blocks(brc_simulation *s, double *out);

/* ---- beams.c: cbm ---- */
/* Beams of every material in every body; isolated elements are refused or reported. */
brc_status brc_beams_create(brc_simulation *s);
/* Stiffness of every row, where there are several materials. */
brc_status brc_beams_upload(brc_simulation *s);
/* Stiffness of element e's own beams. */
const brc_beam *brc_beam_of_element(const brc_simulation *s, int64_t e);
/* Stress of every element [n_elements][6] xx yy zz yz xz xy [Pa], averaged over the element and its neighbours over
 * bonds, `level` shells of them (NAH19 section 2.2; 1 in the paper). Volumes are those of the spheres over the
 * packing's volume fraction. */
brc_status brc_beams_stress(brc_simulation *s, int level, double *out);
/* Inverses of the 6 x 6 diagonal blocks, upper triangles [n_rows][21]; elements without bonds get zero. */
brc_status brc_beams_precondition_blocks(brc_simulation *s, double *out);
/* Rigorous lower bound of the critical time step [s]: 2 / sqrt(2 max lambda(M_i^-1 D_i)) over the elements' diagonal
 * blocks (docs/notebook/beams.md). */
brc_status brc_beams_node_bound(brc_simulation *s, double *out);

/* ---- force.c: one evaluation, either model ---- */
typedef enum brc_booking { BRC_BOOK_NOTHING, BRC_BOOK_WORK, BRC_BOOK_START } brc_booking; /* `book` of the kernels */
struct brc_rings;                                                                         /* rings.h */
struct brc_ring_list;
typedef struct brc_force_request {
    brc_buffer *displacement, *force; /* [n_rows][3] */
    brc_buffer *orientation, *torque; /* published */
    bool finite;                      /* the full law, or its linearisation */
    bool homogeneous;                 /* held faces at zero, no tractions, no gravity: the linear operator */
    brc_booking book;                 /* work of loads: leave, add, or start from here */
    double t;                         /* time of the stage, for tractions */
    const struct brc_rings *rings;    /* cells: only what the bonds that broke in this step change; NULL: everything */
    bool listed_pairs;                /* dlsm: of the pairs of surfaces those of brc_contact_list_around alone */
} brc_force_request;
brc_status brc_force_evaluate(brc_simulation *s, const brc_force_request *request);
/* The simulation's own state, with the full law, at its time. */
brc_force_request brc_force_request_of_state(brc_simulation *s, brc_booking book);
brc_status brc_force_of_state(brc_simulation *s, brc_booking book);
/* The same where only what broken bonds change is evaluated. */
brc_status brc_force_around_breaks(brc_simulation *s, const struct brc_rings *rings);
/* What surfaces reach by, of a state that was not evaluated; where there is contact. */
brc_status brc_force_refresh(brc_simulation *s);
/* For outputs after the state moved. */
brc_status brc_force_energies(brc_simulation *s, double *elastic, double *stabilisation);
brc_status brc_force_held_energy(brc_simulation *s, double *out);

/* ---- phases.c ---- */
/* The watch goes on in `phase`; returns the one before, to go back to. A failure need not: the run ends. */
brc_step_phase brc_phase_enter(brc_simulation *s, brc_step_phase phase);
/* The same for work that is also done outside steps: not counted there, BRC_PHASE_NONE stays. */
brc_step_phase brc_phase_within(brc_simulation *s, brc_step_phase phase);

/* ---- stages ---- */
brc_status brc_initial_apply(brc_simulation *s, const brc_stage *stage);
brc_status brc_time_step_find(brc_simulation *s, const brc_stage *stage, brc_time_step *out);
brc_status brc_dynamics_advance(brc_simulation *s, int64_t n_steps);
/* Velocities and spins of the whole step, where they are not. */
brc_status brc_dynamics_close(brc_simulation *s);
/* Leave the stage before; initial fields, loads and the time step of this one, which may be made shorter before
 * brc_stage_start evaluates the first forces. */
brc_status brc_stage_enter(brc_simulation *s, int32_t stage);
brc_status brc_stage_start(brc_simulation *s);
/* The current stage of the n simulations of one scene (lockstep.c), one for each of its models: all take the same steps
 * or increments, and observers of the first hear of each when all have arrived. resumed: the stage goes on from the
 * state that the parts were given (state_store.h). */
brc_status brc_dynamics_run(int32_t n, brc_simulation *const *part, bool resumed);
brc_status brc_statics_run(int32_t n, brc_simulation *const *part, brc_state_store *resumed);
/* Modes of one; tells nobody. */
brc_status brc_modes_run(brc_simulation *s);
/* Effects of this run, after all they ask for is there; a failure leaves what was made for brc_effects_free. */
brc_status brc_effects_create(brc_simulation *s);
void brc_effects_free(brc_simulation *s);
brc_status brc_notify_sample(brc_simulation *s);
brc_status brc_notify_frame(brc_simulation *s);
/* The run could go on from here later; why: BRC_PAUSE_INTERRUPTED where it was asked to stop, and stops. */
brc_status brc_notify_pause(brc_simulation *s, brc_pause why);
/* What a static stage that runs keeps from increment to increment. */
brc_status brc_statics_store_run(brc_simulation *s, struct brc_static_run *run, brc_state_store *store);

static inline const brc_stage *brc_current_stage(const brc_simulation *s)
{
    return &s->scene->stages[s->stage];
}
static inline bool brc_has_spheres(const brc_simulation *s)
{
    return s->model->element == BRC_ELEMENT_SPHERE;
}

/* Was brc_simulation_interrupt called, on any rank? All ranks. */
bool brc_simulation_is_to_stop(brc_simulation *simulation);

#endif
