/* Schema: stages with their solvers, loads and initial fields. */
#include "schema_internal.h"

/* Entries of a prescribed motion: `u` is "m" or "m/s", `g` its gradient's unit. A component is prescribed when its
 * value or its row of the gradient is given. */
#define GRADIENT_ENTRIES(type, g, ...)                                                                                 \
    {"x",                                                                                                              \
     BRC_TYPE_VECTOR,                                                                                                  \
     (g),                                                                                                              \
     FIELD(type, gradient[0]),                                                                                         \
     .length = 3,                                                                                                      \
     .sample = SAMPLE_ROW(g),                                                                                          \
     __VA_ARGS__(0).meaning = "row of the x component: its derivatives along x, y and z"},                             \
        {"y",                                                                                                          \
         BRC_TYPE_VECTOR,                                                                                              \
         (g),                                                                                                          \
         FIELD(type, gradient[1]),                                                                                     \
         .length = 3,                                                                                                  \
         .sample = SAMPLE_ROW(g),                                                                                      \
         __VA_ARGS__(1).meaning = "row of the y component"},                                                           \
        {"z",                                                                                                          \
         BRC_TYPE_VECTOR,                                                                                              \
         (g),                                                                                                          \
         FIELD(type, gradient[2]),                                                                                     \
         .length = 3,                                                                                                  \
         .sample = SAMPLE_ROW(g),                                                                                      \
         __VA_ARGS__(2).meaning = "row of the z component"},
#define SAMPLE_ROW(g) ((g)[0] == '\0' ? "[1e-6, 0, 0]" : "[1e-3 1/s, 0, 0]")
#define PRESCRIBES(i) FLAG(brc_load, component[i]),
#define NO_FLAG(i)
#define GRADIENT_GROUP                                                                                                 \
    {                                                                                                                  \
        BRC_GROUP_AT_LEAST_ONE,                                                                                        \
        {                                                                                                              \
            "x", "y", "z"                                                                                              \
        }                                                                                                              \
    }

#define TABLE_ENTRY                                                                                                    \
    {                                                                                                                  \
        "table", BRC_TYPE_TABLE, BRC_UNIT_STAGE_TIME,                                                                  \
            .offset = offsetof(brc_load, table),                                                                       \
            .meaning =                                                                                                 \
                "factor of time: pairs of time since the start of the stage and factor, linear between, constant "     \
                "outside; in a static stage the time is the fraction 0 to 1 of the load; left out: 1 in a dynamic "    \
                "stage, the fraction itself in a static one"                                                           \
    }

/* The same keys for faces and elements, displacement and velocity. */
#define MOTION(name, refers_to, set_sample, u, u_sample, gradient_section)                                             \
    static const brc_entry name[] = {                                                                                  \
        {"set", BRC_TYPE_NAME, FIELD(brc_load, set), .required = true, .refers = (refers_to), .sample = set_sample,    \
         .meaning = "what moves"},                                                                                     \
        {"x", BRC_TYPE_QUANTITY, u, FIELD(brc_load, value[0]), FLAG(brc_load, component[0]), .sample = u_sample,       \
         .meaning = "prescribed x component; a component left out stays free"},                                        \
        {"y", BRC_TYPE_QUANTITY, u, FIELD(brc_load, value[1]), FLAG(brc_load, component[1]), .sample = u_sample,       \
         .meaning = "prescribed y component"},                                                                         \
        {"z", BRC_TYPE_QUANTITY, u, FIELD(brc_load, value[2]), FLAG(brc_load, component[2]), .sample = u_sample,       \
         .meaning = "prescribed z component"},                                                                         \
        {"gradient", BRC_TYPE_STRUCT, .section = &(gradient_section),                                                  \
         .meaning =                                                                                                    \
             "added to the components: rows times the position from the origin; a row prescribes its component"},      \
        {"origin", BRC_TYPE_VECTOR, "m", FIELD(brc_load, origin), .length = 3, .sample = "[0, 0, 0]",                  \
         .meaning = "where the gradient counts from"},                                                                 \
        TABLE_ENTRY,                                                                                                   \
    }

static const brc_entry LOAD_STRAIN[] = {GRADIENT_ENTRIES(brc_load, "", PRESCRIBES)};
static const brc_section LOAD_STRAIN_SECTION = {.title = "displacement gradient",
                                                .meaning = "Rows of du/dx of a load.",
                                                ENTRIES(LOAD_STRAIN),
                                                .groups = {GRADIENT_GROUP}};
static const brc_entry LOAD_RATE[] = {GRADIENT_ENTRIES(brc_load, "1/s", PRESCRIBES)};
static const brc_section LOAD_RATE_SECTION = {.title = "velocity gradient",
                                              .meaning = "Rows of dv/dx of a load.",
                                              ENTRIES(LOAD_RATE),
                                              .groups = {GRADIENT_GROUP}};

MOTION(FACE_DISPLACEMENT, BRC_REFERS_FACES, "x+", "m", "1 um", LOAD_STRAIN_SECTION);
MOTION(FACE_VELOCITY, BRC_REFERS_FACES, "x+", "m/s", "1 mm/s", LOAD_RATE_SECTION);
MOTION(ELEMENT_DISPLACEMENT, BRC_REFERS_ELEMENTS, "core", "m", "1 um", LOAD_STRAIN_SECTION);
MOTION(ELEMENT_VELOCITY, BRC_REFERS_ELEMENTS, "core", "m/s", "1 mm/s", LOAD_RATE_SECTION);
#define MOTION_GROUPS .groups = {{BRC_GROUP_AT_LEAST_ONE, {"x", "y", "z", "gradient"}}}
static const brc_section FACE_DISPLACEMENT_SECTION = {.title = "face_displacement",
                                                      .meaning = "Prescribed displacement of boundary faces.",
                                                      ENTRIES(FACE_DISPLACEMENT),
                                                      MOTION_GROUPS};
static const brc_section FACE_VELOCITY_SECTION = {.title = "face_velocity",
                                                  .meaning = "Prescribed velocity of boundary faces.",
                                                  ENTRIES(FACE_VELOCITY),
                                                  MOTION_GROUPS};
static const brc_section ELEMENT_DISPLACEMENT_SECTION = {
    .title = "element_displacement",
    .meaning = "Prescribed displacement of whole elements, as the papers do it.",
    ENTRIES(ELEMENT_DISPLACEMENT),
    MOTION_GROUPS};
static const brc_section ELEMENT_VELOCITY_SECTION = {.title = "element_velocity",
                                                     .meaning = "Prescribed velocity of whole elements.",
                                                     ENTRIES(ELEMENT_VELOCITY),
                                                     MOTION_GROUPS};

static const brc_entry TRACTION[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_load, set), .required = true, .refers = BRC_REFERS_FACES, .sample = "x+",
     .meaning = "faces it acts on, as far as they reach into the box or half-space of their set"},
    {"x", BRC_TYPE_QUANTITY, "Pa", FIELD(brc_load, value[0]), .sample = "1 kPa",
     .meaning = "x component, 0 if left out"},
    {"y", BRC_TYPE_QUANTITY, "Pa", FIELD(brc_load, value[1]), .sample = "1 kPa",
     .meaning = "y component, 0 if left out"},
    {"z", BRC_TYPE_QUANTITY, "Pa", FIELD(brc_load, value[2]), .sample = "1 kPa",
     .meaning = "z component, 0 if left out"},
    TABLE_ENTRY,
};
static const brc_section TRACTION_SECTION = {.title = "traction",
                                             .meaning = "Force per reference area; keeps its direction and its sum.",
                                             ENTRIES(TRACTION),
                                             .groups = {{BRC_GROUP_AT_LEAST_ONE, {"x", "y", "z"}}}};
static const brc_entry PRESSURE[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_load, set), .required = true, .refers = BRC_REFERS_FACES, .sample = "x+",
     .meaning = "faces it acts on, as far as they reach into the box or half-space of their set"},
    {"value", BRC_TYPE_QUANTITY, "Pa", FIELD(brc_load, value[0]), .required = true, .sample = "1 MPa",
     .meaning = "positive pushes into the solid"},
    TABLE_ENTRY,
};
static const brc_section PRESSURE_SECTION = {
    .title = "pressure", .meaning = "Against the reference normal of each face.", ENTRIES(PRESSURE)};
static const brc_entry RADIAL[] = {
    {"total", BRC_TYPE_QUANTITY, "N", FIELD(brc_load, radial_force), .required = true, .sample = "-1 kN",
     .meaning = "sum of the magnitudes; positive pulls outward"},
    {"centre", BRC_TYPE_VECTOR, "m", FIELD(brc_load, origin), .length = 3, .required = true, .sample = "[0, 0, 0]",
     .meaning = "the forces point away from it"},
};
static const brc_section RADIAL_SECTION = {
    .title = "radial",
    .meaning = "Equal forces along the radii, minus what would move or turn the set as a rigid body.",
    ENTRIES(RADIAL)};
static const brc_entry ELEMENT_FORCE[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_load, set), .required = true, .refers = BRC_REFERS_ELEMENTS, .sample = "core",
     .meaning = "elements it acts on"},
    {"x", BRC_TYPE_QUANTITY, "N", FIELD(brc_load, value[0]), .sample = "1 kN",
     .meaning = "x component of the total, 0 if left out"},
    {"y", BRC_TYPE_QUANTITY, "N", FIELD(brc_load, value[1]), .sample = "1 kN",
     .meaning = "y component of the total, 0 if left out"},
    {"z", BRC_TYPE_QUANTITY, "N", FIELD(brc_load, value[2]), .sample = "1 kN",
     .meaning = "z component of the total, 0 if left out"},
    {"share", BRC_TYPE_CHOICE, FIELD(brc_load, share), CHOICES("number", "mass"), .given = "number",
     .meaning = "of x, y, z: equal parts for all, or by mass"},
    {"radial", BRC_TYPE_STRUCT, .section = &RADIAL_SECTION, FLAG(brc_load, radial),
     .meaning = "in place of x, y, z: forces along radii, as on a sphere under pressure"},
    TABLE_ENTRY,
};
static const brc_section ELEMENT_FORCE_SECTION = {
    .title = "element_force",
    .meaning = "A total force over a set of elements, at their centres; keeps its direction.",
    ENTRIES(ELEMENT_FORCE),
    .groups = {{BRC_GROUP_AT_LEAST_ONE, {"x", "y", "z", "radial"}}}};
#define TURN(key_, i)                                                                                                  \
    {                                                                                                                  \
        key_, BRC_TYPE_QUANTITY, "rad", FIELD(brc_load, value[i]), FLAG(brc_load, component[i]),                       \
            .sample = "0", .meaning = "prescribed " key_ " component; 0 clamps, a component left out stays free"       \
    }
static const brc_entry ELEMENT_ROTATION[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_load, set), .required = true, .refers = BRC_REFERS_ELEMENTS, .sample = "core",
     .meaning = "what turns"},
    TURN("x", 0),
    TURN("y", 1),
    TURN("z", 2),
    TABLE_ENTRY,
};
static const brc_section ELEMENT_ROTATION_SECTION = {
    .title = "element_rotation",
    .meaning = "Prescribed rotation of elements since the start of the stage, about axes through their own centres; "
               "for models whose "
               "elements have rotations (cbm; dlsm-published in dynamic stages).",
    ENTRIES(ELEMENT_ROTATION),
    .groups = {{BRC_GROUP_AT_LEAST_ONE, {"x", "y", "z"}}}};
static const brc_entry LOAD[] = {
    {"face_displacement", BRC_TYPE_STRUCT, .section = &FACE_DISPLACEMENT_SECTION, .value = BRC_LOAD_FACE_DISPLACEMENT,
     .meaning = "prescribed displacement of faces"},
    {"face_velocity", BRC_TYPE_STRUCT, .section = &FACE_VELOCITY_SECTION, .value = BRC_LOAD_FACE_VELOCITY,
     .meaning = "prescribed velocity of faces"},
    {"element_displacement", BRC_TYPE_STRUCT, .section = &ELEMENT_DISPLACEMENT_SECTION,
     .value = BRC_LOAD_ELEMENT_DISPLACEMENT, .meaning = "prescribed displacement of elements"},
    {"element_velocity", BRC_TYPE_STRUCT, .section = &ELEMENT_VELOCITY_SECTION, .value = BRC_LOAD_ELEMENT_VELOCITY,
     .meaning = "prescribed velocity of elements"},
    {"traction", BRC_TYPE_STRUCT, .section = &TRACTION_SECTION, .value = BRC_LOAD_TRACTION,
     .meaning = "force per area"},
    {"pressure", BRC_TYPE_STRUCT, .section = &PRESSURE_SECTION, .value = BRC_LOAD_PRESSURE,
     .meaning = "force per area against the normal"},
    {"element_force", BRC_TYPE_STRUCT, .section = &ELEMENT_FORCE_SECTION, .value = BRC_LOAD_ELEMENT_FORCE,
     .meaning = "total force over elements"},
    {"element_rotation", BRC_TYPE_STRUCT, .section = &ELEMENT_ROTATION_SECTION, .value = BRC_LOAD_ELEMENT_ROTATION,
     .meaning = "prescribed rotation of elements"},
};
const brc_section brc_schema_load = {.title = "load",
                                     .meaning = "What acts on the solid during a stage.",
                                     ENTRIES(LOAD),
                                     .size = sizeof(brc_load),
                                     .one_of = true,
                                     .has_kind = true,
                                     .kind_offset = offsetof(brc_load, kind)};

#define INITIAL_SET                                                                                                    \
    {                                                                                                                  \
        "set", BRC_TYPE_NAME, FIELD(brc_initial, set), .refers = BRC_REFERS_ELEMENTS, .sample = "core",                \
                                                       .meaning = "set of elements; left out: all"                     \
    }
#define INITIAL_ORIGIN                                                                                                 \
    {                                                                                                                  \
        "origin", BRC_TYPE_VECTOR, "m", FIELD(brc_initial, origin), .length = 3, .sample = "[0, 0, 0]",                \
                                                                    .meaning = "where positions count from"            \
    }

static const brc_entry INITIAL_STRAIN[] = {GRADIENT_ENTRIES(brc_initial, "", NO_FLAG)};
static const brc_section INITIAL_STRAIN_SECTION = {.title = "initial displacement gradient",
                                                   .meaning = "Rows of du/dx; a row left out is zero.",
                                                   ENTRIES(INITIAL_STRAIN)};
static const brc_entry INITIAL_RATE[] = {GRADIENT_ENTRIES(brc_initial, "1/s", NO_FLAG)};
static const brc_section INITIAL_RATE_SECTION = {
    .title = "initial velocity gradient", .meaning = "Rows of dv/dx; a row left out is zero.", ENTRIES(INITIAL_RATE)};
static const brc_entry AFFINE[] = {
    INITIAL_SET,
    {"displacement", BRC_TYPE_VECTOR, "m", FIELD(brc_initial, value), .length = 3, .sample = "[1 um, 0, 0]",
     .meaning = "at the origin"},
    {"gradient", BRC_TYPE_STRUCT, .section = &INITIAL_STRAIN_SECTION, .meaning = "of the displacement"},
    INITIAL_ORIGIN,
};
static const brc_section AFFINE_SECTION = {.title = "affine",
                                           .meaning = "u = displacement + gradient (X - origin).",
                                           ENTRIES(AFFINE),
                                           .groups = {{BRC_GROUP_AT_LEAST_ONE, {"displacement", "gradient"}}}};
static const brc_entry VELOCITY[] = {
    INITIAL_SET,
    {"velocity", BRC_TYPE_VECTOR, "m/s", FIELD(brc_initial, value), .length = 3, .sample = "[1 m/s, 0, 0]",
     .meaning = "at the origin"},
    {"gradient", BRC_TYPE_STRUCT, .section = &INITIAL_RATE_SECTION, .meaning = "of the velocity"},
    INITIAL_ORIGIN,
};
static const brc_section VELOCITY_SECTION = {.title = "velocity",
                                             .meaning = "v = velocity + gradient (X - origin).",
                                             ENTRIES(VELOCITY),
                                             .groups = {{BRC_GROUP_AT_LEAST_ONE, {"velocity", "gradient"}}}};
static const brc_entry TWIST[] = {
    INITIAL_SET,
    {"rate", BRC_TYPE_QUANTITY, "rad/m", FIELD(brc_initial, rate), .required = true, .sample = "1e-4 rad/m",
     .meaning = "angle over length along the axis"},
    {"axis", BRC_TYPE_DIRECTION, "", FIELD(brc_initial, axis), .length = 3, .required = true, .sample = "[1, 0, 0]",
     .meaning = "of the twist"},
    INITIAL_ORIGIN,
};
static const brc_section TWIST_SECTION = {.title = "twist",
                                          .meaning = "Sections turn about the axis in proportion to "
                                                     "their distance from the origin.",
                                          ENTRIES(TWIST)};
static const brc_entry SPIN[] = {
    INITIAL_SET,
    {"angular_velocity", BRC_TYPE_VECTOR, "rad/s", FIELD(brc_initial, value), .length = 3, .required = true,
     .sample = "[0, 0, 10 rad/s]", .meaning = "rotation vector per second"},
    INITIAL_ORIGIN,
};
static const brc_section SPIN_SECTION = {
    .title = "spin", .meaning = "v = angular_velocity x (X - origin).", ENTRIES(SPIN)};
static const brc_entry RANDOM[] = {
    INITIAL_SET,
    {"amplitude", BRC_TYPE_VECTOR, "m/s", NOT_NEGATIVE, FIELD(brc_initial, value), .length = 3, .required = true,
     .sample = "[1 mm/s, 1 mm/s, 1 mm/s]", .meaning = "each component of v is uniform between minus and plus this"},
    {"seed", BRC_TYPE_INTEGER, WITHIN(0, 9e15), FIELD(brc_initial, seed), .given = "1",
     .meaning = "of the random numbers"},
};
static const brc_section RANDOM_SECTION = {.title = "random", .meaning = "Random velocities.", ENTRIES(RANDOM)};
static const brc_entry INITIAL[] = {
    {"affine", BRC_TYPE_STRUCT, .section = &AFFINE_SECTION, .value = BRC_INITIAL_AFFINE,
     .meaning = "a displacement linear in the position"},
    {"velocity", BRC_TYPE_STRUCT, .section = &VELOCITY_SECTION, .value = BRC_INITIAL_VELOCITY,
     .meaning = "a velocity linear in the position"},
    {"twist", BRC_TYPE_STRUCT, .section = &TWIST_SECTION, .value = BRC_INITIAL_TWIST, .meaning = "a twisted bar"},
    {"spin", BRC_TYPE_STRUCT, .section = &SPIN_SECTION, .value = BRC_INITIAL_SPIN, .meaning = "a rigid rotation"},
    {"random", BRC_TYPE_STRUCT, .section = &RANDOM_SECTION, .value = BRC_INITIAL_RANDOM,
     .meaning = "random velocities"},
    {"file", BRC_TYPE_STRING, FIELD(brc_initial, file), .value = BRC_INITIAL_FILE, .sample = "state.h5",
     .meaning = "HDF5 datasets displacement and/or velocity, [elements][3] by element id; relative to the scene"},
};
const brc_section brc_schema_initial = {.title = "initial field",
                                        .meaning = "Added to the state at the start of a stage, in the order given.",
                                        ENTRIES(INITIAL),
                                        .size = sizeof(brc_initial),
                                        .one_of = true,
                                        .has_kind = true,
                                        .kind_offset = offsetof(brc_initial, kind)};

static const brc_entry TCHAMWA[] = {
    {"phi", BRC_TYPE_QUANTITY, "", WITHIN(1, 2), FIELD(brc_stage, phi), .given = "1.03",
     .meaning = "numerical dissipation; 1: none, 1.03 to 1.1 usual"},
};
static const brc_section TCHAMWA_SECTION = {
    .title = "tchamwa-wielgosz", .meaning = "Damps what the time step does not resolve.", ENTRIES(TCHAMWA)};
static const brc_entry INTEGRATOR[] = {
    {"verlet", BRC_TYPE_STRUCT, .value = BRC_VELOCITY_VERLET, .meaning = "velocity Verlet: keeps the energy"},
    {"tchamwa-wielgosz", BRC_TYPE_STRUCT, .section = &TCHAMWA_SECTION, .value = BRC_TCHAMWA_WIELGOSZ,
     .meaning = "first order, dissipative"},
};
static const brc_section INTEGRATOR_SECTION = {.title = "integrator",
                                               .meaning = "How time advances.",
                                               ENTRIES(INTEGRATOR),
                                               .one_of = true,
                                               .has_kind = true,
                                               .kind_offset = offsetof(brc_stage, integrator)};
static const brc_entry AUTO_STEP[] = {
    {"safety", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 1), FIELD(brc_stage, safety), .given = "0.8",
     .meaning = "fraction of the critical step"},
};
static const brc_section AUTO_STEP_SECTION = {.title = "automatic time step",
                                              .meaning = "From the highest frequency of the scene's own forces.",
                                              ENTRIES(AUTO_STEP)};
static const brc_entry TIME_STEP[] = {
    {"auto", BRC_TYPE_STRUCT, .section = &AUTO_STEP_SECTION, .value = BRC_TIME_STEP_AUTO,
     .meaning = "a fraction of the critical step"},
    {"published", BRC_TYPE_STRUCT, .value = BRC_TIME_STEP_PUBLISHED, .meaning = "the rule of the paper (2019, eq. 39)"},
    {"fixed", BRC_TYPE_QUANTITY, "s", POSITIVE, FIELD(brc_stage, time_step), .value = BRC_TIME_STEP_FIXED,
     .sample = "0.5 us", .meaning = "as given"},
};
static const brc_section TIME_STEP_SECTION = {.title = "time_step",
                                              .meaning = "A time alone is a fixed step: `time_step: 0.5 us`.",
                                              ENTRIES(TIME_STEP),
                                              .one_of = true,
                                              .has_kind = true,
                                              .kind_offset = offsetof(brc_stage, time_step_rule),
                                              .short_key = "fixed"};
static const brc_entry STOP[] = {
    {"sensor", BRC_TYPE_NAME, FIELD(brc_stage, stop_sensor), .required = true, .refers = BRC_REFERS_SENSOR,
     .sample = "force", .meaning = "what is watched"},
    {"below", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(0, 1), FIELD(brc_stage, stop_share), .given = "50 %",
     .meaning = "share of its largest magnitude in the stage"},
};
static const brc_section STOP_SECTION = {
    .title = "stop_after_peak",
    .meaning = "Ends the stage when a sensor has fallen from its peak; judged when sensors are sampled.",
    ENTRIES(STOP),
    .short_key = "sensor"};
static const brc_entry DYNAMIC[] = {
    {"duration", BRC_TYPE_QUANTITY, "s", POSITIVE, FIELD(brc_stage, duration), .sample = "1 ms",
     .meaning = "time simulated"},
    {"steps", BRC_TYPE_INTEGER, WITHIN(1, 1e15), FIELD(brc_stage, steps), .sample = "1000",
     .meaning = "number of time steps, in place of the duration"},
    {"integrator", BRC_TYPE_STRUCT, .section = &INTEGRATOR_SECTION, .given = "verlet", .meaning = "how time advances"},
    {"time_step", BRC_TYPE_STRUCT, .section = &TIME_STEP_SECTION, .given = "auto", .meaning = "the step"},
    {"mass_damping", BRC_TYPE_QUANTITY, "1/s", NOT_NEGATIVE, FIELD(brc_stage, mass_damping), .given = "0",
     .sample = "10 1/s", .meaning = "force -c m v on every element: the drag of a surrounding fluid"},
    {"noise_damping", BRC_TYPE_QUANTITY, "", WITHIN(0, 0.1), FIELD(brc_stage, noise_damping), .given = "0",
     .sample = "2 %",
     .meaning = "model dlsm: drag on what an element moves otherwise than its neighbours do, as a share of the "
                "critical damping of the fastest oscillation; long waves pass; not with a fracture energy"},
    {"stop_when_kinetic_below", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(0, 1), FIELD(brc_stage, stop_kinetic),
     .given = "off", .word = "off", .sample = "1e-6",
     .meaning = "ends the stage when the kinetic energy was below this part of the elastic energy for 100 steps"},
    {"stop_when_broken", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(0, 1), FIELD(brc_stage, stop_broken), .given = "off",
     .word = "off", .sample = "10 %",
     .meaning = "ends the stage when more than this share of all bonds is broken; needs `fracture`"},
    {"stop_after_peak", BRC_TYPE_STRUCT, .section = &STOP_SECTION,
     .meaning = "ends the stage when a load has dropped; left out: it runs on"},
};
static const brc_section DYNAMIC_SECTION = {.title = "solver dynamic",
                                            .meaning = "Explicit steps through time.",
                                            ENTRIES(DYNAMIC),
                                            .groups = {{BRC_GROUP_EXACTLY_ONE, {"duration", "steps"}}}};
static const brc_entry EVENTS[] = {
    {"most", BRC_TYPE_INTEGER, WITHIN(1, 1e9), FIELD(brc_stage, most_events), .required = true, .sample = "200",
     .meaning = "events after which the stage ends"},
    {"below", BRC_TYPE_QUANTITY, "", WITHIN(0, 1), FIELD(brc_stage, stop_load), .given = "0",
     .meaning = "ends the stage when the load of an event falls below this share of the largest so far"},
};
static const brc_section EVENTS_SECTION = {.title = "events",
                                           .meaning =
                                               "Quasi-static fracture: the load is scaled to where the next bond "
                                               "fails, that bond breaks, and the body is solved anew. Needs "
                                               "`fracture`; for small damage, a dynamic stage is cheaper for much.",
                                           ENTRIES(EVENTS),
                                           .short_key = "most"};
static const brc_entry STATIC[] = {
    {"increments", BRC_TYPE_INTEGER, WITHIN(1, 100000), FIELD(brc_stage, increments), .given = "1",
     .meaning = "steps from no load to the whole load"},
    {"tolerance", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 0.1), FIELD(brc_stage, tolerance), .given = "auto",
     .word = "auto", .sample = "1e-9",
     .meaning = "residual over load; auto: 1e-10 in double, 1e-6 in mixed, 1e-5 in single precision"},
    {"max_iterations", BRC_TYPE_INTEGER, WITHIN(1, 1e9), FIELD(brc_stage, max_iterations), .given = "auto",
     .word = "auto", .sample = "5000", .meaning = "of each linear solve"},
    {"preconditioner", BRC_TYPE_CHOICE, FIELD(brc_stage, preconditioner), CHOICES("auto", "multigrid", "blocks"),
     .given = "auto",
     .meaning = "what makes iterations few: multigrid, their number hardly growing with the body, or the elements' own "
                "stiffness; auto: multigrid from 500 elements on"},
    {"to_failure", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 1), FIELD(brc_stage, to_failure), .given = "off",
     .word = "off", .sample = "80 %",
     .meaning = "scale the whole load so that the element nearest to failure is at this fraction of its limit; needs "
                "`fracture`"},
    {"events", BRC_TYPE_STRUCT, .section = &EVENTS_SECTION,
     .meaning = "bonds break one event after the other; left out: none breaks"},
    {"finite_strain", BRC_TYPE_BOOL, FIELD(brc_stage, finite_strain), .given = "true",
     .meaning = "false: only the law linearised about the reference, for small turns"},
};
static const brc_section STATIC_SECTION = {
    .title = "solver static", .meaning = "Elastic equilibrium.", ENTRIES(STATIC)};
static const brc_entry MODES[] = {
    {"count", BRC_TYPE_INTEGER, WITHIN(1, 1000), FIELD(brc_stage, n_modes), .required = true, .sample = "8",
     .meaning = "number of elastic modes, lowest first; rigid motions are not counted"},
};
static const brc_section MODES_SECTION = {
    .title = "solver modes", .meaning = "Lowest free vibrations of the linearised law.", ENTRIES(MODES)};
static const brc_entry SOLVER[] = {
    {"static", BRC_TYPE_STRUCT, .section = &STATIC_SECTION, .value = BRC_SOLVER_STATIC,
     .meaning = "elastic equilibrium"},
    {"dynamic", BRC_TYPE_STRUCT, .section = &DYNAMIC_SECTION, .value = BRC_SOLVER_DYNAMIC, .meaning = "motion in time"},
    {"modes", BRC_TYPE_STRUCT, .section = &MODES_SECTION, .value = BRC_SOLVER_MODES, .meaning = "free vibrations"},
};
static const brc_section SOLVER_SECTION = {.title = "solver",
                                           .meaning = "What a stage computes.",
                                           ENTRIES(SOLVER),
                                           .one_of = true,
                                           .has_kind = true,
                                           .kind_offset = offsetof(brc_stage, solver)};

static const brc_entry STAGE[] = {
    {"name", BRC_TYPE_NAME, FIELD(brc_stage, name), .required = true, .sample = "pull",
     .meaning = "for messages, results and measures"},
    {"solver", BRC_TYPE_STRUCT, .section = &SOLVER_SECTION, .required = true, .sample = "{dynamic: {duration: 1 ms}}",
     .meaning = "what the stage computes"},
    {"initial", BRC_TYPE_LIST, .section = &brc_schema_initial, COUNTED(brc_stage, initials, n_initials),
     .meaning = "fields added to the state at its start"},
    {"loads", BRC_TYPE_LIST, .section = &brc_schema_load, COUNTED(brc_stage, loads, n_loads),
     .meaning = "what acts on the solid"},
};
const brc_section brc_schema_stage = {.title = "stage",
                                      .meaning = "Stages follow one another; the state carries over.",
                                      ENTRIES(STAGE),
                                      .size = sizeof(brc_stage)};
