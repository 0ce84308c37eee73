/* A simulation as every folder of the solver sees it: what a run is made of, and what its folders do for each other.
 * Device arrays are in storage rows (layout.h). */
#ifndef BRC_SOLVER_SOLVER_H
#define BRC_SOLVER_SOLVER_H

#include "../../base/log.h"
#include "../../base/memory.h"
#include "fields.h"
#include "layout.h"
#include "../effects/effect.h"
#include "passes.h"
#include "phases.h"
#include "../utilities/vectors.h"
#include "../simulation.h"
#include "state_store.h"

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

/* Two parts. What a run is made of is a value that every folder is handed: made by core/ and run/, which alone set it,
 * and the same to its end. What folders keep are pointers to structs that nobody else can look into. */
struct brc_simulation {
    brc_context *context;
    const brc_scene *scene;
    const brc_bond_model *model;
    const brc_domain *domain;
    brc_device *device;
    brc_layout *layout;
    brc_wants wants;              /* what the tables of fields ask */
    int n_groups;                 /* work-items of an element pass */
    brc_elastic *elastic;         /* [n_materials] */
    int32_t *material_of_element; /* [n_elements] index into scene.materials */

    /* Kept by each folder; NULL: not in this run. */
    struct brc_core *core;
    struct brc_run *run;
    struct brc_statics *statics;
    struct brc_vector_kernels *vectors;
    void *of_model;
    struct brc_loads *loads;
    struct brc_breaking *fracture;
    struct brc_ahead *ahead; /* from the first step that asks on */
    struct brc_strikers *strikers;
    struct brc_contact_state *contact;
    struct brc_noise *noise;       /* only where a stage has noise_damping */
    struct brc_guard_state *guard; /* from the first dynamic stage that is run (not stepped by hand) on */
};

/* A function that tells a value that its folder keeps: BRC_READ(int64_t, brc_simulation_step, s->run->step). */
#define BRC_READ(type, name, value)                                                                                    \
    type name(const brc_simulation *s)                                                                                 \
    {                                                                                                                  \
        return value;                                                                                                  \
    }

/* Whether a pass over rows may do what belongs to few of them too: where all rows are one device's (core/arrays.c). */
bool brc_pass_may_do_more(const brc_simulation *s);

/* ---- arrays of elements and bonds (core/element_arrays.c); NULL: not in this run ---- */
brc_buffer *brc_displacement_of(const brc_simulation *s); /* [n_rows][3] */
brc_buffer *brc_velocity_of(const brc_simulation *s);
brc_buffer *brc_force_of(const brc_simulation *s);
brc_buffer *brc_orientation_of(const brc_simulation *s); /* [n_rows][4]; models whose elements turn */
brc_buffer *brc_spin_of(const brc_simulation *s);
brc_buffer *brc_torque_of(const brc_simulation *s);
brc_buffer *brc_mass_of(const brc_simulation *s);
brc_buffer *brc_inertia_of(const brc_simulation *s);
brc_buffer *brc_gradient_of(const brc_simulation *s); /* dlsm: H; dlsm-published: strains */
brc_buffer *brc_flux_of(const brc_simulation *s);     /* dlsm: B */
brc_buffer *brc_held_moment_of(const brc_simulation *s);
brc_buffer *brc_elastic_energy_of(const brc_simulation *s); /* [n_rows] scratch of the ledger, as the next two */
brc_buffer *brc_stabilisation_energy_of(const brc_simulation *s);
brc_buffer *brc_kinetic_of(const brc_simulation *s);
brc_buffer *brc_lost_damping_of(const brc_simulation *s); /* [n_rows] */
brc_buffer *brc_lost_numerical_of(const brc_simulation *s);
brc_buffer *brc_neighbour_of(const brc_simulation *s); /* of half-edges, as the next three */
brc_buffer *brc_area_of(const brc_simulation *s);      /* dlsm: s; dlsm-published: S */
brc_buffer *brc_offset_of(const brc_simulation *s);    /* dlsm: d, times the neighbour's part; others: branches */
brc_buffer *brc_ratio_of(const brc_simulation *s);     /* dlsm: q; cbm: 1/length */
brc_buffer *brc_beam_array_of(const brc_simulation *s);
brc_buffer *brc_partial_of(const brc_simulation *s); /* block sums */

/* ---- ../core/arrays.c: host doubles by id <-> device rows ---- */
brc_status brc_upload_coeff(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count);
brc_status brc_upload_state(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count);
brc_status brc_upload_int(brc_buffer *buffer, const int32_t *values, int64_t count);
brc_status brc_download(brc_simulation *s, brc_buffer *buffer, int bytes_each, double *values, int64_t count);
/* [n_elements][width] by id to rows (padding: fill) and back. */
brc_status brc_state_to_rows(brc_simulation *s, brc_buffer *buffer, const double *values, int width, double fill);
brc_status brc_state_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width);
brc_status brc_coeff_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width);
/* The largest of a number of each element, 0 where all are below. */
brc_status brc_largest_coeff(brc_simulation *s, brc_buffer *buffer, double *out);
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
/* Velocities in place of displacements; what damping takes as `lost`; stresses of elements, not those of a criterion.
 */
brc_scope brc_scope_of_velocities(const brc_simulation *s, const brc_scope *outer);
brc_scope brc_scope_of_damping(const brc_simulation *s, const brc_scope *outer);
brc_scope brc_scope_of_stresses(const brc_simulation *s, const brc_scope *outer);
/* Numbers that kernels ask for by name: stiffness of beams of one material [N], [N m^2]; whether some face is held or
 * bears a traction in this stage. */
void brc_set_beam(brc_simulation *s, double axial, double bend, double twist);
brc_status brc_set_face_loads(brc_simulation *s, bool any); /* those of the stage before have left no trace */
/* Room that tables ask for: exposed elements and cells of their grid; polyhedra of rigid bodies. */
void brc_want_exposed(brc_simulation *s, int64_t exposed, int64_t buckets);
void brc_want_pieces(brc_simulation *s, const brc_convex *pieces);

/* ---- core/core.c ---- */
brc_status brc_core_create(brc_simulation *s);
void brc_core_free(brc_simulation *s);
/* Constants, kernels of vectors, the model's passes. */
brc_status brc_core_passes_make(brc_simulation *s);

/* ---- simulation_fields.c: state and work arrays ---- */
extern const brc_field_table brc_state_fields;
brc_status brc_simulation_fields_create(brc_simulation *s);
brc_status brc_simulation_set_upright(brc_simulation *s); /* orientations as they are at first, of models that turn */
void brc_simulation_fields_free(brc_simulation *s);

/* ---- geometry.c ---- */
extern const brc_field_table brc_geometry_fields; /* of it what breaks change is kept */
brc_status brc_geometry_create(brc_simulation *s);
void brc_geometry_free(brc_simulation *s);
/* What breaks changed of it. */
brc_status brc_geometry_store(brc_simulation *s, brc_state_store *store, const brc_chosen *bonds,
                              const brc_chosen *elements);
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
/* Directions whose eigenvalue of such a matrix is below this share of the largest are left out [-]. */
double brc_geometry_least_span(const brc_simulation *s);
/* Constants of each element, only for several materials. */
brc_status brc_geometry_materials(brc_simulation *s);
/* All ranks. Symmetric 3 x 3 preconditioner blocks [n_rows][6]: inverse of sum (S/L) [mu I + (lambda + mu) n n^T]. */
brc_status brc_geometry_precondition_blocks(brc_simulation *s, double *out);

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
/* From here on the state is that of this stage: by the full law, or, of a static stage without finite strain (and by a
 * model with small rotations), by its linearisation about the reference, in forces, energies, strains and stresses. */
void brc_force_take_law(brc_simulation *s, const brc_stage *stage);
bool brc_force_is_finite(const brc_simulation *s);
/* The simulation's own state, with that law, at its time. */
brc_force_request brc_force_request_of_state(brc_simulation *s, brc_booking book);
brc_status brc_force_of_state(brc_simulation *s, brc_booking book);
/* The same where only what broken bonds change is evaluated. */
brc_status brc_force_around_breaks(brc_simulation *s, const struct brc_rings *rings);
/* What surfaces reach by, of a state that was not evaluated; where there is contact. */
brc_status brc_force_refresh(brc_simulation *s);
/* For outputs after the state moved. */
brc_status brc_force_energies(brc_simulation *s, double *elastic, double *stabilisation);
brc_status brc_force_held_energy(brc_simulation *s, double *out); /* later (brc_vector_sum_later) */

/* ---- phases.c ---- */
/* The watch goes on in `phase`; returns the one before, to go back to. A failure need not: the run ends. */
brc_step_phase brc_phase_enter(brc_simulation *s, brc_step_phase phase);
/* The same for work that is also done outside steps: not counted there, BRC_PHASE_NONE stays. */
brc_step_phase brc_phase_within(brc_simulation *s, brc_step_phase phase);

/* ---- run/clock.c; more of it in ../simulation.h ---- */
const brc_stage *brc_current_stage(const brc_simulation *s);
/* Where tables of loads are read: the time of the stage; static: the load factor. */
double brc_loads_time(const brc_simulation *s);
/* Static stages and modes set them. */
void brc_clock_set_step(brc_simulation *s, int64_t step);
void brc_clock_set_load(brc_simulation *s, double factor);
/* Velocities are those of half a step ago: half a kick is missing. */
bool brc_half_kick_is_missing(const brc_simulation *s);
void brc_half_kick_missing(brc_simulation *s, bool missing);
bool brc_stage_has_ended(const brc_simulation *s); /* early (stage_end.h) */
/* Is it time to leave off a trial (trial_budget.h)? Asked once an iteration. */
bool brc_trial_is_over(brc_simulation *s);

/* ---- run/motion.c ---- */
/* Velocities gain kick times force over mass, spins of elements whose bonds turn with them likewise. */
brc_status brc_elements_kick(brc_simulation *s, double kick);

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
brc_status brc_statics_create(brc_simulation *s);
void brc_statics_free(brc_simulation *s);
/* Elastic energy beyond that of the broken bonds that events of static stages set free [J]. */
double brc_statics_released(const brc_simulation *s);
/* The present stage is static or of modes, and the one before it, but for modes, static: the loads of one are taken off
 * as those of the other are put on. */
bool brc_statics_go_on(const brc_simulation *s);
/* Work of such changes [J], and more of it. */
double brc_statics_changing(const brc_simulation *s);
void brc_statics_change(brc_simulation *s, double work);
/* Reports, modes and how far events have come, for a store; and what a stage that runs keeps from increment to
 * increment. */
brc_status brc_statics_store(brc_simulation *s, brc_state_store *store);
/* Effects of this run, after all they ask for is there; a failure leaves what was made for brc_effects_free. */
brc_status brc_effects_create(brc_simulation *s);
void brc_effects_free(brc_simulation *s);
brc_status brc_notify_sample(brc_simulation *s);
brc_status brc_notify_frame(brc_simulation *s);
/* The run could go on from here later; why: BRC_PAUSE_INTERRUPTED where it was asked to stop, and stops. */
brc_status brc_notify_pause(brc_simulation *s, brc_pause why);
brc_status brc_statics_store_stage(brc_simulation *s, brc_state_store *store);

/* Of a number of the device. */
static inline int brc_coeff_bytes(const brc_simulation *s)
{
    return brc_precision_coeff_bytes(brc_device_get_precision(s->device));
}
static inline int brc_state_bytes(const brc_simulation *s)
{
    return brc_precision_state_bytes(brc_device_get_precision(s->device));
}
/* Stiffness of two halves of a bond, one of each material. */
static inline double brc_in_series(double a, double b)
{
    return 2 * a * b / (a + b);
}
static inline double brc_mass_of_element(const brc_simulation *s, int64_t e)
{
    return s->domain->volume[e] * s->elastic[s->material_of_element[e]].density;
}
static inline bool brc_has_spheres(const brc_simulation *s)
{
    return s->model->element == BRC_ELEMENT_SPHERE;
}

/* Was brc_simulation_interrupt called, on any rank? All ranks. */
bool brc_simulation_is_to_stop(brc_simulation *simulation);

#endif
