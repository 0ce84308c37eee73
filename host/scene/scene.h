/* A scene as typed structs, in SI units: what was asked, with every default filled in. Read by scene_reader.h from YAML
 * through the one schema table; made in code by tests and benches. Knows no device and no domain arrays.
 * A scene owns all its arrays, each got from brc_memory_allocate; brc_scene_free frees them. */
#ifndef BRC_SCENE_SCENE_H
#define BRC_SCENE_SCENE_H

#include "model_kinds.h"
#include "scene_output.h"
#include "../../preprocess/domain/build.h"
#include "../base/status.h"
#include <stdint.h>

/* Strength of bonds around that of their material: factors with which it is multiplied, drawn by bond. */
typedef enum brc_scatter_kind {
    BRC_SCATTER_NONE,
    BRC_SCATTER_WEIBULL, /* factor (-ln(1 - p) V_0 / V)^(1/m), p uniform, V the volume of the bond (S L / 3 of a cell's
                            face, its share of a sphere) */
    BRC_SCATTER_TABLE,   /* quantiles: the factor at probability p, linear between them */
    BRC_SCATTER_FILE /* a factor a bond, from a CSV with columns element_i, element_j, factor; 1 for a bond not in it */
} brc_scatter_kind;
typedef struct brc_quantile {
    double below;  /* share of the bonds with a smaller factor: 0 at the first, 1 at the last [-] */
    double factor; /* [-], ascending */
} brc_quantile;
typedef struct brc_scatter {
    brc_scatter_kind kind;
    double modulus; /* m [-] */
    double volume;  /* V_0 [m^3]; 0: V_0 = V, so that the strength is that of a bond whatever its size */
    int32_t n_quantiles;
    brc_quantile *quantiles; /* [n_quantiles] */
    char file[512];          /* relative to the scene */
} brc_scatter;

/* The test that gave a strength in tension: a body pulled apart, or a disc pressed across (NAH19 eq. 27), which
 * nominally fails at another load; or either, the error shared by both tests. */
typedef enum brc_strength_origin {
    BRC_STRENGTH_BY_TENSION,
    BRC_STRENGTH_BY_BRAZILIAN,
    BRC_STRENGTH_BY_EITHER
} brc_strength_origin;

/* How the traction of a bond falls from the strength to nothing while its crack opens; G_c is the area below. */
typedef enum brc_softening { BRC_SOFTENING_LINEAR, BRC_SOFTENING_EXPONENTIAL } brc_softening;

typedef struct brc_material {
    char name[BRC_NAME];
    double young;   /* E [Pa] > 0 */
    double poisson; /* nu [-] in (-1, 0.5) */
    double density; /* rho [kg/m^3] > 0 */
    /* cbm, given directly; 0: from the calibrated laws */
    double beam_radius; /* r_m: beam radius over the mean radius of the packed spheres [-] */
    double beam_young;  /* E_m of the beams [Pa] */
    /* only read in scenes with fracture; 0: no limit */
    double tension, compression;     /* strengths of the solid, positive [Pa] */
    brc_strength_origin measured_by; /* cbm: what `tension` is the result of */
    double beam_strength;    /* cbm: sigma_m, tensile limit of the virial stress; 0: from tension by the calibrated law
                                [Pa] */
    double beam_compression; /* cbm: its limit of compression, positive; 0: from compression by the law [Pa] */
    double fracture_energy;  /* G_c, energy per area of a crack [J/m^2]; 0: bonds break at once */
    double shear_fracture_energy; /* G_II, of a crack whose sides slide, beside what they rub off [J/m^2]; 0: G_c */
    brc_softening softening;      /* with a fracture energy: how cohesion falls with the opening */
    brc_scatter scatter;          /* of the strength between bonds */
} brc_material;

typedef enum brc_criterion_kind {
    BRC_CRITERION_AUTO,        /* bond-normal for cells, virial-principal for beams (brc_criterion_of) */
    BRC_CRITERION_BOND_NORMAL, /* normal stress of the bond's mean stress, AGH19 eq. 35 */
    BRC_CRITERION_PRINCIPAL,   /* principal values of the virial stress, NAH19 section 2.2 */
    BRC_CRITERION_MOHR_COULOMB,
    BRC_CRITERION_DRUCKER_PRAGER
} brc_criterion_kind;

/* Bonds between two materials, or between grains, that are weaker or stronger than what they join. Later ones win. */
typedef enum brc_interface_kind { BRC_INTERFACE_GRAINS, BRC_INTERFACE_MATERIALS } brc_interface_kind;
typedef struct brc_interface {
    brc_interface_kind kind;
    int32_t material[2]; /* materials: indices into scene.materials, in any order */
    double factor;  /* on the strength and the fracture energy of the weaker side [-]; 0: left out, which means 1 */
    double tension; /* in place of the factor's strength; 0: by the factor [Pa] */
    double fracture_energy; /* in place of the factor's; 0: by the factor [J/m^2] */
} brc_interface;

typedef struct brc_fracture {
    brc_criterion_kind kind;
    int32_t level;             /* shells of neighbours the stress is averaged over: 0, 1, 2; not for bond-normal */
    double cohesion, friction; /* the last two kinds: [Pa], [rad] */
    bool closure; /* sides of a broken face bear on each other until they stand clear (docs/notebook/fracture.md "Closed
                     faces") */
    double side_friction; /* Coulomb friction of those sides where the scene has no contact [-]; -1: 0.3
                             (brc_scene_side_friction) */
    uint64_t seed;        /* of the draws of strengths, keyed by the ids of a bond's elements */
} brc_fracture;

typedef struct brc_model {
    brc_model_kind kind;
    /* dlsm */
    bool compaction; /* true: beta as given; false: beta = 0 */
    double beta;     /* [-] cross term, default 1.06 (docs/notebook/theory.md T2) */
    double tau;      /* [-] stabilisation, default 0.15; beta^2 <= 1 + tau keeps W positive */
    /* dlsm-published */
    bool small_rotations; /* dlsm and published: the law linearised about the reference: a body that turns grows and
                             strains; for comparison */
    bool area_weights;    /* least squares with weights S/L instead of 1 (default false, as printed) */
    double rotation_stiffness; /* [-] factor on K = E S^2 / (4 pi L0), default 1 */
    double couple_modulus; /* [-] over mu: holds the frames of elements to the turning solid; 0, as printed, by default
                              (docs/notebook/theory.md T3) */
    /* cbm */
    double beam_poisson; /* nu_m of the beams, default 0.3: hardly matters (docs/notebook/beams.md) [-] */
    bool keep_isolated;  /* hold elements without bonds still instead of refusing them */
    bool polish;         /* correct the laws' r_m and E_m on a sample (beam_polish.h) */
} brc_model;

/* How surfaces of two materials meet. */
typedef struct brc_contact_law {
    int32_t material[2]; /* of a pair: indices into scene.materials, in any order */
    double friction;     /* Coulomb mu [-] */
    double
        restitution; /* of a central blow between rigid bodies, in (0, 1]; 0: left out, which means 1: no damping [-] */
    double
        damping; /* viscous, as a share of the critical one, in place of the restitution; 0: by the restitution [-] */
    double stiffness;  /* K_s of a touching pair [N/m]; 0: from the materials */
    double tangential; /* tangential over normal stiffness, of sticking surfaces [-]; 0: from Poisson's ratios, 2 (1 -
                          nu) / (2 - nu) */
} brc_contact_law;

typedef enum brc_sphere_law { BRC_SPHERES_HERTZ, BRC_SPHERES_LINEAR } brc_sphere_law;

typedef struct brc_contact {
    brc_contact_law law; /* of all pairs of materials but those in `pairs`; its material[] is not read */
    int32_t n_pairs;
    brc_contact_law *pairs; /* [n_pairs] later ones win */
    brc_sphere_law spheres; /* normal force of spheres; cells: pressure from the energy of their overlap */
    bool within;            /* elements of one body touch each other: closed cracks, fragments */
    bool rotation;          /* cells without bonds turn as rigid bodies */
    double skin;            /* pairs nearer than this are kept in the list [m]; 0: automatic */
} brc_contact;

/* Factor of time a(t): linear between its points, constant outside. n = 0: 1 at all times. t = 0 at the start of the
 * stage. A static stage runs it over its increments: t from 0 to 1 [-]. */
typedef struct brc_table {
    int32_t n;
    double *time;  /* [n] ascending [s] */
    double *value; /* [n] [-] */
} brc_table;

/* A rigid wall or striker. */
typedef enum brc_striker_motion { BRC_STRIKER_FIXED, BRC_STRIKER_DRIVEN, BRC_STRIKER_FREE } brc_striker_motion;
typedef struct brc_striker {
    char name[BRC_NAME];
    bool is_plane;              /* the half-space behind a plane, in place of a shape */
    double point[3], normal[3]; /* plane: a point of it, and the unit vector out of the wall */
    brc_shape shape;
    int32_t facets;                     /* curved shapes: flat faces around a full turn */
    double translation[3], rotation[3]; /* pose of the shape, as of a body */
    int32_t material;                   /* index into scene.materials */
    brc_striker_motion motion;
    double velocity[3],
        spin[3];     /* driven: times the table; free: at the start of the run [m/s], [rad/s] about the mass centre */
    bool pushed;     /* free: a prescribed force acts on its mass centre */
    double force[3]; /* that, times the table [N] */
    brc_table table; /* factor of velocity and spin, or of force, over the time since the start of the run; n = 0: 1 */
    double mass;     /* free: [kg]; 0: volume times density */
    bool held[3];    /* free: components of its motion that stay zero */
    bool held_rotation; /* free: it does not turn */
} brc_striker;

/* Tools of a testing machine: platens, jaws, rollers. The reader turns them into strikers, sensors and a law of
 * contact; nothing else reads them but for reports. */
typedef enum brc_fixture_moves { BRC_FIXTURE_HIGH, BRC_FIXTURE_LOW, BRC_FIXTURE_BOTH } brc_fixture_moves;
typedef struct brc_fixture {
    bool given;
    char body[BRC_NAME]; /* "": the only one */
    int32_t axis;        /* along which it presses: 0 x 1 y 2 z */
    double speed;        /* at which the sides come together [m/s]; 0: they are pressed by `force` */
    double force;        /* on each tool that moves [N] */
    double mass;         /* of each of these [kg]; 0: volume times density */
    double ramp;         /* time in which speed or force rises to that [s]; 0: at once */
    bool has_friction;
    double friction; /* between tools and body [-]; without: that of the scene's contact */
    bool has_material;
    int32_t material; /* index into scene.materials */
    brc_fixture_moves moves;
    double gap;    /* between tool and body [m]; 0: automatic */
    double radius; /* of the jaws' hollow, of the rollers [m] */
    double width;  /* of jaws [m]; 0: half the body's */
    double span;   /* of the supports [m] */
    int32_t along; /* direction of the span: 0 automatic, else 1 + axis */
} brc_fixture;

typedef struct brc_region {
    int32_t material; /* index into scene.materials */
    brc_predicate where;
} brc_region;

typedef struct brc_phase {
    int32_t material; /* index into scene.materials */
    double fraction;  /* of the grains, by number [-] */
} brc_phase;

typedef struct brc_body {
    char name[BRC_NAME];
    char place[BRC_PLACE_LENGTH]; /* in the scene file, of errors that building shows; "": made in code */
    char domain_file[512];        /* "" : built from shape and fill; else read from this file (relative to the scene) */
    brc_shape shape;
    brc_fill fill;
    double translation[3], rotation[3]; /* pose, as in brc_build_request */
    double tiny_face_threshold;         /* as in brc_build_request; 0: default */
    bool has_model;
    brc_model model;  /* its own, in place of the scene's */
    int32_t material; /* index into scene.materials */
    int32_t n_regions;
    brc_region *regions; /* [n_regions] later ones win */
    double beams;        /* spheres joined by beams: their mean coordination number; 0: cells */
    int32_t n_cracks;
    brc_crack *cracks; /* [n_cracks] */
    brc_grains grains; /* its phases are the body's: n_phases and fraction stay 0 here */
    int32_t n_phases;
    brc_phase *phases; /* [n_phases] phase p is region n_regions + 1 + p */
} brc_body;

typedef enum brc_load_kind {
    BRC_LOAD_FACE_DISPLACEMENT,    /* u_f = a(t) (value + gradient (C - origin)) on boundary faces, per component [m] */
    BRC_LOAD_FACE_VELOCITY,        /* the same for the velocity [m/s]; the displacement starts from the stage's start */
    BRC_LOAD_ELEMENT_DISPLACEMENT, /* imposed elements, as the papers do it: u of whole elements */
    BRC_LOAD_ELEMENT_VELOCITY,
    BRC_LOAD_TRACTION,      /* force per reference area, dead: t = a(t) value [Pa] */
    BRC_LOAD_PRESSURE,      /* dead pressure: t = -a(t) value[0] N [Pa] */
    BRC_LOAD_ELEMENT_FORCE, /* dead: a(t) times value, a total over the set, shared out; or radial_force (below) [N] */
    BRC_LOAD_ELEMENT_ROTATION /* rotation of elements since the start of the stage, a(t) value per component [rad];
                                 models with rotations */
} brc_load_kind;

typedef enum brc_share { BRC_SHARE_NUMBER, BRC_SHARE_MASS } brc_share; /* of a total: equal parts, or by mass */

typedef struct brc_load {
    brc_load_kind kind;
    char set[BRC_NAME];
    bool component[3]; /* prescribed components x y z; others stay free. Tractions: all true */
    double value[3];
    double gradient[3][3]; /* row i: d u_i / d x_j [-] or [1/s]; element loads: with C replaced by X */
    double origin[3];      /* [m]; radial element force: the centre */
    brc_share share;       /* element force */
    bool radial;           /* element force: equal forces away from the origin, minus what would move the set rigidly */
    double radial_force;   /* sum of their magnitudes, positive outward [N] */
    brc_table table;
} brc_load;

typedef enum brc_initial_kind {
    BRC_INITIAL_AFFINE,   /* u = value + gradient (X - origin) */
    BRC_INITIAL_VELOCITY, /* v = value + gradient (X - origin) */
    BRC_INITIAL_TWIST,    /* u = rotation by rate * (X - origin).axis about the axis, minus identity (AGH19 8.2.2) */
    BRC_INITIAL_SPIN,     /* v = value x (X - origin), value: angular velocity [rad/s] */
    BRC_INITIAL_RANDOM,   /* v uniform in +-value per component, by brc_random_uniform4(seed) */
    BRC_INITIAL_FILE      /* HDF5 datasets displacement and/or velocity [n_elements][3] by element id */
} brc_initial_kind;

typedef struct brc_initial {
    brc_initial_kind kind;
    char set[BRC_NAME]; /* element set, "" : all */
    double value[3];
    double gradient[3][3];
    double origin[3];
    double axis[3]; /* twist: unit vector */
    double rate;    /* twist [rad/m] */
    uint64_t seed;
    char file[512];
} brc_initial;

typedef enum brc_solver_kind {
    BRC_SOLVER_DYNAMIC,
    BRC_SOLVER_STATIC, /* elastic equilibrium by preconditioned conjugate gradients (dlsm) or GMRES (published) */
    BRC_SOLVER_MODES   /* lowest free vibration frequencies of the linearised operator */
} brc_solver_kind;

typedef enum brc_integrator { BRC_VELOCITY_VERLET, BRC_TCHAMWA_WIELGOSZ } brc_integrator;

typedef enum brc_time_step_rule {
    BRC_TIME_STEP_AUTO,     /* safety * 2 / omega_max by power iteration on the scene's own force kernels */
    BRC_TIME_STEP_FIXED,    /* as given */
    BRC_TIME_STEP_PUBLISHED /* AGH19 eq. 39: 1/3 min sqrt(m L / (E S)) */
} brc_time_step_rule;

/* What stands for the inverse of the stiffness in the iterations of a linear solve. */
typedef enum brc_preconditioner_kind {
    BRC_PRECONDITIONER_AUTO,      /* multigrid from 500 elements on */
    BRC_PRECONDITIONER_MULTIGRID, /* of bodies of any size */
    BRC_PRECONDITIONER_BLOCKS,    /* the diagonal block of each element */
    BRC_PRECONDITIONER_PARTS      /* and of beams a few parts of the body moved as rigid ones; no scene asks for it */
} brc_preconditioner_kind;

typedef struct brc_stage {
    char name[BRC_NAME];
    brc_solver_kind solver;
    int32_t n_initials;
    brc_initial *initials; /* applied in order at the start of the stage, added to the state */
    int32_t n_loads;
    brc_load *loads;
    /* dynamic */
    brc_integrator integrator;
    double phi; /* Tchamwa-Wielgosz parameter, >= 1 */
    brc_time_step_rule time_step_rule;
    double time_step;     /* fixed [s] */
    double safety;        /* auto: fraction of the critical step, default 0.8 */
    double duration;      /* [s]; 0: by steps */
    int64_t steps;        /* 0: by duration */
    double mass_damping;  /* force -c m v, c [1/s] >= 0: drag of a surrounding fluid on every element; 0: none */
    double noise_damping; /* share in [0, 0.1] of the critical damping of the fastest oscillation, on motion not linear
                             over the neighbours; 0: none */
    double stop_kinetic;  /* stop when kinetic <= this fraction of elastic energy for 100 steps; 0: off */
    double stop_broken;   /* stop when more than this fraction of the bonds is broken; 0: off */
    char stop_sensor[BRC_NAME]; /* stop when this sensor fell below stop_share of its largest magnitude in the stage; ""
                                   : off */
    double stop_share;          /* [-] */
    /* static */
    double tolerance;       /* residual over load [-]; 0: by precision (1e-10, 1e-6, 1e-5) */
    int32_t increments;     /* load increments, default 1 */
    int32_t max_iterations; /* per linear solve; 0: automatic */
    brc_preconditioner_kind preconditioner;
    double to_failure;   /* scale the load so that the worst element is at this fraction of its limit; 0: the load as
                            given [-] */
    int32_t most_events; /* quasi-static fracture: the load is scaled to the next failing bond, most_events times; 0:
                            nothing breaks */
    double stop_load;    /* events end when the load that breaks falls below this share of the largest so far [-] */
    bool finite_strain;  /* true (default): the full law, by modified Newton; false: the linearised operator alone */
    /* modes */
    int32_t n_modes;
} brc_stage;

/* What watches over a run. */
typedef struct brc_guard {
    int64_t every;  /* steps between looks; 0: automatic */
    double closure; /* largest |closure| of the energy ledger [-]; 0: off (running away is always looked for) */
} brc_guard;

typedef struct brc_scene {
    int32_t version; /* of the format: 1 */
    char title[256];
    char folder[512]; /* of the scene file, for relative paths; "." when made in code */
    int32_t n_materials;
    brc_material *materials;
    brc_model model; /* of bodies without their own */
    int32_t n_bodies;
    brc_body *bodies;
    int32_t n_sets;
    brc_set_request *sets;
    int32_t n_limits;
    brc_quality_limit *limits; /* [n_limits] for every body as it is built */
    bool has_fracture;
    brc_fracture fracture;
    int32_t n_interfaces;
    brc_interface *interfaces; /* [n_interfaces] only read with fracture */
    bool has_contact;
    brc_contact contact;
    int32_t n_strikers;
    brc_striker *strikers; /* [n_strikers] */
    brc_fixture platens, jaws, rollers;
    brc_guard guard;
    double accuracy; /* wanted relative error, for proposals of `breccia check` [-]; 0: not asked */
    double budget;   /* wanted time of the run, likewise [s]; 0: not asked */
    bool has_gravity;
    double gravity[3]; /* [m/s^2] */
    int32_t n_stages;
    brc_stage *stages;
    int32_t n_sensors;
    brc_sensor *sensors;
    int32_t n_measures;
    brc_measure *measures;
    brc_output output;
} brc_scene;

/* Free a scene and everything it owns; accepts a pointer to NULL; sets *scene to NULL. */
void brc_scene_free(brc_scene **scene);
/* Material of the elements of a region of a body (0: the body's own), index into scene.materials. */
int32_t brc_body_material(const brc_body *body, int32_t region);
/* Regions a body has besides its own material: predicates and phases of grains. */
int32_t brc_body_n_regions(const brc_body *body);
/* Is some of the body of this material? */
bool brc_body_uses(const brc_body *body, int32_t material);
/* The model of a body: its own, or the scene's. */
const brc_model *brc_body_model(const brc_scene *scene, int32_t body);
/* a(t) of a table at time t. */
double brc_table_value(const brc_table *table, double t);
/* The criterion of a model: fracture.kind, or what AUTO stands for. */
brc_criterion_kind brc_criterion_of(const brc_fracture *fracture, brc_model_kind model);
/* Do elements of the material fail in bodies of a model, or have they no limit that its criterion looks at? */
bool brc_material_breaks(const brc_scene *scene, brc_model_kind model, const brc_material *material);
/* Does some material or interface have a fracture energy? */
bool brc_scene_softens(const brc_scene *scene);
/* Do the bonds of this model break by what they carry themselves, rather than by the stress of elements: cells by
 * bond-normal, and faces that soften in shear too (dlsm by mohr-coulomb with a fracture energy)? */
bool brc_scene_breaks_by_bond(const brc_scene *scene, brc_model_kind model);
/* The latter alone. */
bool brc_scene_slides(const brc_scene *scene, brc_model_kind model);
/* Do bonds that broke at once still bear on each other? With contact they do not: its law has such sides. */
bool brc_scene_shuts(const brc_scene *scene);
/* Friction of the sides of broken faces where they do [-]. */
double brc_scene_side_friction(const brc_scene *scene);
/* Unit of a sensor's value ("N", "m", "-", "rad", "Pa", "J", "m/s", "Hz", "N m", "m^2"); static storage. */
const char *brc_sensor_unit(const brc_sensor *sensor);
/* Unit of a measure's value, given the scene (for sensors' units); static storage. */
const char *brc_measure_unit(const brc_scene *scene, const brc_measure *measure);

#endif
