/* A model of bonds: what its elements are and what forces act between them. One descriptor each, in a folder of its
 * own, and one line in host/scene/models.def; the rest of the solver asks the descriptor and names no model. */
#ifndef BRC_SOLVER_MODELS_MODEL_H
#define BRC_SOLVER_MODELS_MODEL_H

#include "../../../preprocess/domain/domain.h"
#include "../../scene/scene.h"

struct brc_simulation;
struct brc_scope;
struct brc_force_request;
struct brc_rings;
struct brc_buffer;
struct brc_hooked;
struct brc_strengths;
struct brc_softening_report;
struct brc_state_store;
struct brc_chosen;
struct brc_ring_list;
struct brc_field_table;

/* How contact sees the surface of an element: as kernels number it (contact_body.h). */
typedef enum brc_surface { BRC_SURFACE_SPHERE, BRC_SURFACE_AFFINE, BRC_SURFACE_RIGID } brc_surface;

/* Something that `check` lists as in a run or left out of it; in NULL: with the model. */
typedef struct brc_model_effect {
    const char *name;
    bool (*in)(const brc_scene *scene);
} brc_model_effect;

/* Scopes of passes of held faces, in an evaluation and outside of one, of the loads that hold them, and of
 * tractions. */
typedef struct brc_face_scopes {
    const struct brc_scope *held, *held_state, *held_load, *traction;
    struct brc_pass **prescribe, **energy; /* to be made: held faces are put where they are to be; their energies */
} brc_face_scopes;

/* How cells go on where bonds broke (cell_breaks.c). */
typedef struct brc_model_breaking {
    brc_status (*create)(struct brc_simulation *s); /* arrays and passes of its own; those of all cells are there */
    int area_width;                                 /* numbers of a bond's area, which vanish with it */
    bool wide;                                      /* the forces of ring 3 change too, not only those of ring 2 */
    const char *record; /* kernel that records the stresses of elements, for criteria of elements */
    /* Branches of all half-edges, for the same. */
    brc_status (*branches)(struct brc_simulation *s, struct brc_buffer **out);
    /* Of elements that lost bonds. loosens: bonds that are left to one may be marked now, and break in turn. */
    brc_status (*rebuild)(struct brc_simulation *s);
    bool loosens;
    /* Whether the list of rings is to be placed (rings.h); NULL: never. */
    bool (*places)(const struct brc_simulation *s, const struct brc_rings *rings);
    /* Criteria of bonds: those above `share` of their limit are marked, `found` of elements or groups counts them. */
    brc_status (*mark)(struct brc_simulation *s, double share);
    /* Criteria of elements: more bonds than those that elements chose are marked, `found` counts them; NULL: none. */
    brc_status (*mark_beside)(struct brc_simulation *s);
    /* The largest ratio of a bond's stress to its limit. */
    brc_status (*ratio)(struct brc_simulation *s, double *out);
    /* Gradients of ring 0, before surfaces are looked for; NULL: surfaces move with rotations. */
    brc_status (*gradients_around)(struct brc_simulation *s, const struct brc_force_request *r);
    /* Forces around breaks take the place of those of the state. */
    brc_status (*replace_around)(struct brc_simulation *s, const struct brc_rings *rings);
    /* Energy of rings 0 and 1 of rings->around, elastic and of stabilisation, but for what both sides of a break have
     * in common; found: of what brc_rings_find has found last, before its bonds break. That of held faces is apart
     * [J]. Later (brc_vector_sum_later): part[0] - part[1] + part[2] - part[3]. */
    brc_status (*energy_around)(struct brc_simulation *s, const struct brc_rings *rings, bool found, double part[4]);
} brc_model_breaking;

/* Bonds that open against a cohesion before they break, and broken ones that still bear. Each does nothing where there
 * are none of them in a run; NULL: never. */
typedef struct brc_model_cohesion {
    bool (*is_on)(const struct brc_simulation *s); /* some bonds may open */
    brc_status (*create)(struct brc_simulation *s, const struct brc_strengths *strengths);
    void (*free)(struct brc_simulation *s);
    brc_status (*report)(struct brc_simulation *s, struct brc_softening_report *out);
    brc_status (*store)(struct brc_simulation *s, struct brc_state_store *store, const struct brc_chosen *bonds);
    /* Cells, after the forces of a step: bonds above `share` of their limit open, those that are at the end of their
     * cohesion are marked for breaking, *n_ended of them. */
    brc_status (*step)(struct brc_simulation *s, double share, double *n_ended);
    brc_status (*before_breaks)(struct brc_simulation *s);
    brc_status (*after_breaks)(struct brc_simulation *s);             /* before the forces around them are evaluated */
    brc_status (*change)(struct brc_simulation *s, double half_kick); /* after that */
    brc_status (*refresh)(struct brc_simulation *s);                  /* and after energies were found */
    brc_status (*settle)(struct brc_simulation *s, const struct brc_ring_list *around); /* and shared out */
    brc_status (*stored)(struct brc_simulation *s, double *out); /* energy that broken bonds hold [J], later
                                                                     (brc_vector_sum_later) */
    /* Of what steps ahead of what is known change (effects/fracture/ahead.h). */
    brc_status (*store_ahead)(struct brc_simulation *s, struct brc_state_store *store);
} brc_model_cohesion;

/* A material in a body, of which limits are asked: its first element, how many elements the body has and the sum of
 * their radii; the limit on shear of the solid. */
typedef struct brc_limit_case {
    const brc_material *material;
    int32_t body;
    int64_t element;
    double n_elements, radii, shear;
} brc_limit_case;

/* Room for the torques that displacements leave [n_rows][3]: zero: zeros, force: scratch; orientation [n_rows][4]. */
typedef struct brc_settle_room {
    struct brc_buffer *zero, *orientation, *force, *torque;
} brc_settle_room;

/* How a model is solved for equilibrium. */
typedef struct brc_model_statics {
    bool rotations;         /* are unknowns beside displacements */
    bool symmetric;         /* the linearised operator: conjugate gradients, else restarted GMRES */
    bool linear;            /* equilibrium is that of the linearised law, whatever the stage asks for */
    double least_tolerance; /* that displacements reach by themselves [-]; 0: that of the precision */
    double soft; /* of multigrid: stiffness that a rigid motion of a piece meets [-]; 0: by the precision (fine.c) */
    /* Inverses of diagonal blocks [n_rows][6], with rotations [n_rows][21]. */
    brc_status (*blocks)(struct brc_simulation *s, double *out);
    /* After a solve of displacements: the torques that rotations are to balance; NULL: there are none. */
    brc_status (*torques)(struct brc_simulation *s, const brc_settle_room *room);
    /* Bond between elements for multigrid, of a length and its square: stiffness along and across it [N/m], of its
     * ends' rotation across and along it [N m]; NULL: that of the solid. */
    void (*bond)(const struct brc_simulation *s, int64_t e, int64_t other, double length, double square,
                 double stiffness[4]);
} brc_model_statics;

/* A bound of the critical time step that needs no power iteration, and what a report calls it. */
typedef struct brc_model_step_bound {
    brc_status (*find)(struct brc_simulation *s, double *out);
    const char *name, *with_contact;
} brc_model_step_bound;

/* A pass of a step, and names (apart by spaces) that it does not read in this run; NULL: none. */
enum { BRC_STEP_PASSES = 8 };
typedef struct brc_step_pass {
    const struct brc_pass *pass;
    const char *unread;
} brc_step_pass;

typedef struct brc_bond_model {
    brc_element_kind element; /* that it takes */
    bool turns;               /* elements have rotations of their own */
    bool deforms;             /* elements have a displacement gradient, with which their faces and surfaces move */
    brc_surface surface;
    brc_model_effect effect[2]; /* name NULL: no more */

    /* Before arrays are made, and at the end; NULL: nothing. Then what its bonds have on the device. */
    brc_status (*create)(struct brc_simulation *s);
    void (*free)(struct brc_simulation *s);
    brc_status (*upload)(struct brc_simulation *s);
    /* What it made of the scene's materials, anew (brc_simulation_renew); NULL: it cannot. */
    brc_status (*renew)(struct brc_simulation *s);
    /* The passes of the law, in the scopes of the run and of an evaluation; and of loads on faces (NULL: it has no
     * faces). */
    brc_status (*make_passes)(struct brc_simulation *s, const struct brc_scope *run, const struct brc_scope *request);
    brc_status (*make_face_passes)(struct brc_simulation *s, const brc_face_scopes *in);
    /* Forces of bonds, and torques, of held faces and tractions too: written, not added. */
    brc_status (*evaluate)(struct brc_simulation *s, const struct brc_force_request *r);
    /* Tractions that are forces on elements, added after those of loads on elements; NULL: evaluate has them. */
    brc_status (*late_tractions)(struct brc_simulation *s, const struct brc_force_request *r);
    brc_status (*energies)(struct brc_simulation *s, double *elastic, double *stabilisation);
    /* What surfaces reach by, of a state that was not evaluated; NULL: its motion says it. */
    brc_status (*refresh)(struct brc_simulation *s);
    /* Of cells that may open against a cohesion: gradients, stresses and fluxes as the state has them, around a list or
     * (NULL) of all; moved: gradients of ring 2 too. */
    brc_status (*fluxes_of_state)(struct brc_simulation *s, const struct brc_ring_list *list, bool moved);
    /* The passes of a step in which nothing breaks, for the least that it must move (brc_simulation_floor_bytes);
     * returns how many. */
    int (*step_passes)(const struct brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES]);

    /* Of every element [n_elements][6] xx yy zz yz xz xy, each may be NULL; of faces [n][3]. */
    brc_status (*strain_stress)(struct brc_simulation *s, double *strain, double *stress, double *cauchy);
    brc_status (*face_displacement)(struct brc_simulation *s, int64_t n, const int32_t *faces, double *out);
    /* Averaged over `level` shells of neighbours; NULL: stress is not a sum over bonds. */
    brc_status (*virial_stress)(struct brc_simulation *s, int level, double *stress);

    const brc_model_statics *statics; /* NULL: dynamic stages alone */
    /* Kernels, then NULL: forces on what is not linear from neighbour to neighbour, into an array `force`, where their
     * scope has rates as displacements; NULL: there are none. */
    const char *const *smoothing;
    const brc_model_step_bound *step_bound; /* NULL: power iteration of the forces */
    bool conserves;                         /* the law has an energy */
    /* Why a run of this model may have lost its energy balance, appended to text; NULL: nothing of its own. */
    void (*explain_loss)(const struct brc_simulation *s, char *text, size_t size);
    /* Only in scenes with fracture: what is made for it, and after the forces of a step (half_kick: dt/2 where
     * velocities still want the force at its end, else 0); limits of stress in tension, compression, shear [Pa], NULL:
     * those of the material. */
    brc_status (*create_fracture)(struct brc_simulation *s);
    brc_status (*break_bonds)(struct brc_simulation *s, double half_kick);
    double (*bond_radius)(const struct brc_simulation *s, int64_t e); /* of element e's beams [m]; NULL: faces */
    brc_status (*limits)(struct brc_simulation *s, const brc_limit_case *of, double limit[3]);
    const brc_model_breaking *breaking; /* of cells; NULL: of spheres */
    const brc_model_cohesion *cohesion;

    const struct brc_field_table *const *fields; /* tables of its own, then NULL; NULL: none */
    int n_hooked;
    const struct brc_hooked *hooked; /* what it does beside its forces (../effects/effect.h) */
} brc_bond_model;

/* Whether equilibrium has rotations as unknowns. */
static inline bool brc_solves_rotations(const brc_bond_model *model)
{
    return model->statics && model->statics->rotations;
}

/* The descriptor of a kind. */
const brc_bond_model *brc_bond_model_of(brc_model_kind kind);
/* All of them; *n: how many. */
const brc_bond_model *const *brc_bond_models(int *n);

#endif
