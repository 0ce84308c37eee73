/* Schema: sensors, measures and output. */
#include "schema_internal.h"

#define COMPONENT                                                                                                      \
    {                                                                                                                  \
        "component", BRC_TYPE_CHOICE, FIELD(brc_sensor, component), CHOICES("x", "y", "z"),                            \
            .required = true, .sample = "x", .meaning = "of the vector"                                                \
    }
#define TENSOR_COMPONENT                                                                                               \
    {                                                                                                                  \
        "component", BRC_TYPE_CHOICE, FIELD(brc_sensor, component), CHOICES("xx", "yy", "zz", "yz", "xz", "xy"),       \
            .required = true, .sample = "xx", .meaning = "of the tensor"                                               \
    }
#define ELEMENT_SET                                                                                                    \
    {                                                                                                                  \
        "set", BRC_TYPE_NAME, FIELD(brc_sensor, set), .refers = BRC_REFERS_ELEMENTS, .sample = "core",                 \
                                                      .meaning = "elements; left out: all"                             \
    }

#define AXIS_SIGN(compression)                                                                                         \
    {                                                                                                                  \
        "sign", BRC_TYPE_CHOICE, FIELD(brc_sensor, sign), CHOICES("axis", "compression"),                              \
            .given = "axis", .meaning = "what is positive; axis: along the component; compression: " compression       \
    }
#define TENSION_SIGN                                                                                                   \
    {                                                                                                                  \
        "sign", BRC_TYPE_CHOICE, FIELD(brc_sensor, sign), CHOICES("tension", "compression"),                           \
            .given = "tension", .meaning = "what is positive"                                                          \
    }

static const brc_entry ON_SET[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_sensor, set), .required = true, .refers = BRC_REFERS_SET, .sample = "x+",
     .meaning = "faces or elements"},
    COMPONENT,
    AXIS_SIGN("what pushes or moves into the solid, against the mean normal of the faces (of elements: towards the "
              "middle of the bodies)"),
};
static const brc_section REACTION_SECTION = {
    .title = "reaction",
    .meaning = "Force of the loads on the solid, summed over a set with prescribed motion [N]. Along the axes: a wall "
               "x+ that is pulled reads positive, one that is pushed negative; the wall x- the other way round.",
    ENTRIES(ON_SET)};
static const brc_entry MOMENT[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_sensor, set), .required = true, .refers = BRC_REFERS_SET, .sample = "x+",
     .meaning = "faces or elements"},
    {"point", BRC_TYPE_VECTOR, "m", FIELD(brc_sensor, point), .length = 3, .required = true, .sample = "[1 m, 0, 0]",
     .meaning = "moments are about it"},
    COMPONENT,
};
static const brc_section MOMENT_SECTION = {
    .title = "moment",
    .meaning =
        "Moment about a point of the forces (and of prescribed rotations) on a set with prescribed motion [N m].",
    ENTRIES(MOMENT)};
static const brc_entry ROUND[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_sensor, set), .required = true, .refers = BRC_REFERS_ELEMENTS, .sample = "core",
     .meaning = "elements of the surface"},
    {"centre", BRC_TYPE_VECTOR, "m", FIELD(brc_sensor, point), .length = 3, .required = true, .sample = "[0, 0, 0]",
     .meaning = "of the sphere"},
};
static const brc_section RADIAL_STRESS_SECTION = {.title = "radial_stress",
                                                  .meaning =
                                                      "Element forces of a set along the radii, over 4 pi R^2; R: mean "
                                                      "distance of the set from the centre plus the mean radius of "
                                                      "all spheres. Positive outward [Pa].",
                                                  ENTRIES(ROUND)};
static const brc_section VOLUME_STRAIN_SECTION = {
    .title = "volume_strain",
    .meaning = "3 times the mean radial displacement of a set over R, as in radial_stress [-].",
    ENTRIES(ROUND)};
static const brc_section FACE_MEAN_SECTION = {
    .title = "face_mean",
    .meaning = "Area mean of the displacement of faces, or mean of that of elements, along the axes [m].",
    ENTRIES(ON_SET)};
static const brc_entry FACE_STRAIN[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_sensor, set), .required = true, .refers = BRC_REFERS_SET, .sample = "x+",
     .meaning = "one end"},
    {"against", BRC_TYPE_NAME, FIELD(brc_sensor, set2), .required = true, .refers = BRC_REFERS_SET, .sample = "x-",
     .meaning = "the other end"},
    COMPONENT,
    TENSION_SIGN,
};
static const brc_section FACE_STRAIN_SECTION = {.title = "face_strain",
                                                .meaning =
                                                    "Difference of two mean displacements over the distance of the two "
                                                    "sets, along the component; for spheres a mean diameter is "
                                                    "added to the distance of their centres [-].",
                                                ENTRIES(FACE_STRAIN)};
static const brc_entry FACE_TWIST[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_sensor, set), .required = true, .refers = BRC_REFERS_SET, .sample = "x+",
     .meaning = "faces or elements"},
    {"axis", BRC_TYPE_DIRECTION, "", FIELD(brc_sensor, axis), .length = 3, .required = true, .sample = "[1, 0, 0]",
     .meaning = "of the rotation"},
};
static const brc_section FACE_TWIST_SECTION = {
    .title = "face_twist",
    .meaning = "Area mean of the rotation of faces about an axis, or mean of that of elements [rad].",
    ENTRIES(FACE_TWIST)};
static const brc_entry TENSOR[] = {ELEMENT_SET, TENSOR_COMPONENT, TENSION_SIGN};
static const brc_section STRESS_SECTION = {
    .title = "stress",
    .meaning =
        "Volume mean of the second Piola-Kirchhoff stress; tension is positive unless `sign` says otherwise [Pa].",
    ENTRIES(TENSOR)};
static const brc_section STRAIN_SECTION = {
    .title = "strain", .meaning = "Volume mean of the Green strain; positive where it is longer [-].", ENTRIES(TENSOR)};
static const brc_entry POINT[] = {
    {"point", BRC_TYPE_VECTOR, "m", FIELD(brc_sensor, point), .length = 3, .required = true, .sample = "[1 m, 0, 0]",
     .meaning = "the nearest element is watched"},
    COMPONENT,
};
static const brc_section POINT_SECTION = {
    .title = "point", .meaning = "Displacement of an element [m].", ENTRIES(POINT)};
static const brc_section POINT_VELOCITY_SECTION = {
    .title = "point_velocity", .meaning = "Velocity of an element [m/s].", ENTRIES(POINT)};
static const brc_section TURN_SECTION = {
    .title = "turn",
    .meaning = "Rotation vector of an element; for models whose elements have rotations [rad].",
    ENTRIES(POINT)};
static const brc_entry TIP[] = {
    {"direction", BRC_TYPE_DIRECTION, "", FIELD(brc_sensor, axis), .length = 3, .required = true, .sample = "[1, 0, 0]",
     .meaning = "where the crack runs"},
    {"from", BRC_TYPE_VECTOR, "m", FIELD(brc_sensor, point), .length = 3, .sample = "[0, 0, 0]",
     .meaning = "where lengths count from"},
};
static const brc_section TIP_SECTION = {
    .title = "crack_tip",
    .meaning =
        "How far broken bonds reach along a direction; 0 before the first. `rate` of it is the speed of the tip [m].",
    ENTRIES(TIP)};
static const brc_entry OPENING[] = {
    {"set", BRC_TYPE_NAME, FIELD(brc_sensor, set), FLAG(brc_sensor, of_sets), .refers = BRC_REFERS_SET, .sample = "x+",
     .meaning = "one side: faces or elements; with `against` and `direction`"},
    {"against", BRC_TYPE_NAME, FIELD(brc_sensor, set2), .refers = BRC_REFERS_SET, .sample = "x-",
     .meaning = "the other side"},
    {"from", BRC_TYPE_VECTOR, "m", FIELD(brc_sensor, point), FLAG(brc_sensor, of_points), .length = 3,
     .sample = "[215 mm, 0, 0]", .meaning = "one end of a gauge, the element nearest to it; with `to`"},
    {"to", BRC_TYPE_VECTOR, "m", FIELD(brc_sensor, point2), .length = 3, .sample = "[235 mm, 0, 0]",
     .meaning = "the other end"},
    {"crack", BRC_TYPE_NAME, FIELD(brc_sensor, set), FLAG(brc_sensor, of_crack), .refers = BRC_REFERS_WALL,
     .sample = "notch", .meaning = "a crack of a body of cells that was there from the start: mean over its two sides"},
    {"at", BRC_TYPE_VECTOR, "m", FIELD(brc_sensor, point), FLAG(brc_sensor, is_near), .length = 3,
     .sample = "[225 mm, 0, 0]",
     .meaning = "of a crack: only its faces near this point, as at its mouth; left out: all of them"},
    {"within", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_sensor, within), .sample = "1 cm",
     .meaning = "of `at`: how near the middle of a face must be"},
    {"direction", BRC_TYPE_DIRECTION, "", FIELD(brc_sensor, axis), .length = 3, .sample = "[1, 0, 0]",
     .meaning = "along which the opening is measured; its sign does not matter. Left out: from one point to the other, "
                "or across the crack"},
};
static const brc_section OPENING_SECTION = {
    .title = "opening",
    .meaning = "How far two places have moved apart, from how the scene starts [m]: of a notch, the crack mouth "
               "opening displacement (CMOD). Positive: they opened.",
    ENTRIES(OPENING),
    .groups = {{BRC_GROUP_EXACTLY_ONE, {"set", "from", "crack"}}}};
static const brc_entry SPIN[] = {ELEMENT_SET, COMPONENT};
static const brc_section SPIN_SECTION = {
    .title = "spin", .meaning = "Angular velocity of a set of elements about its mass centre [rad/s].", ENTRIES(SPIN)};
static const brc_entry OF_STRIKER[] = {
    {"name", BRC_TYPE_NAME, FIELD(brc_sensor, set), .required = true, .refers = BRC_REFERS_STRIKER, .sample = "anvil",
     .meaning = "of the striker"},
    {"quantity", BRC_TYPE_WORD, FIELD(brc_sensor, term),
     CHOICES("position", "displacement", "velocity", "rotation", "spin", "force", "torque", "energy", "applied"),
     .required = true, .sample = "force",
     .meaning = "of its mass centre (a plane: its point) [m], [m/s], [rad], [rad/s]; force and torque of the elements "
                "on it [N], [N m]; its "
                "kinetic energy [J]; applied: the prescribed force on it [N]"},
    {"component", BRC_TYPE_CHOICE, FIELD(brc_sensor, component), CHOICES("x", "y", "z"), .given = "x",
     .meaning = "of the vector"},
    {"against", BRC_TYPE_NAME, FIELD(brc_sensor, set2), .refers = BRC_REFERS_STRIKER, .sample = "anvil",
     .meaning = "another striker, whose value is taken off: how far two platens have come together"},
    AXIS_SIGN("a force that pushes the striker away from the bodies, a motion towards them; for force, displacement "
              "and velocity"),
};
static const brc_section OF_STRIKER_SECTION = {
    .title = "sensor striker", .meaning = "Motion of a striker, or what acts on it.", ENTRIES(OF_STRIKER)};
static const brc_entry SENSOR[] = {
    {"reaction", BRC_TYPE_STRUCT, .section = &REACTION_SECTION, .value = BRC_SENSOR_REACTION,
     .meaning = "force on a set with prescribed motion [N]"},
    {"face_mean", BRC_TYPE_STRUCT, .section = &FACE_MEAN_SECTION, .value = BRC_SENSOR_FACE_MEAN,
     .meaning = "mean displacement of a set [m]"},
    {"face_strain", BRC_TYPE_STRUCT, .section = &FACE_STRAIN_SECTION, .value = BRC_SENSOR_FACE_STRAIN,
     .meaning = "strain between two sets [-]"},
    {"face_twist", BRC_TYPE_STRUCT, .section = &FACE_TWIST_SECTION, .value = BRC_SENSOR_FACE_TWIST,
     .meaning = "mean rotation of a set [rad]"},
    {"stress", BRC_TYPE_STRUCT, .section = &STRESS_SECTION, .value = BRC_SENSOR_STRESS, .meaning = "mean stress [Pa]"},
    {"strain", BRC_TYPE_STRUCT, .section = &STRAIN_SECTION, .value = BRC_SENSOR_STRAIN, .meaning = "mean strain [-]"},
    {"energy", BRC_TYPE_WORD, FIELD(brc_sensor, term),
     CHOICES("kinetic", "elastic", "stabilisation", "work", "damping", "numerical", "fracture", "contact", "friction",
             "impact", "potential", "total", "closure"),
     .value = BRC_SENSOR_ENERGY, .sample = "kinetic", .meaning = "a term of the energy ledger [J]"},
    {"point", BRC_TYPE_STRUCT, .section = &POINT_SECTION, .value = BRC_SENSOR_POINT,
     .meaning = "displacement of the element nearest to a point [m]"},
    {"point_velocity", BRC_TYPE_STRUCT, .section = &POINT_VELOCITY_SECTION, .value = BRC_SENSOR_POINT_VELOCITY,
     .meaning = "its velocity [m/s]"},
    {"moment", BRC_TYPE_STRUCT, .section = &MOMENT_SECTION, .value = BRC_SENSOR_MOMENT,
     .meaning = "moment on a set with prescribed motion [N m]"},
    {"turn", BRC_TYPE_STRUCT, .section = &TURN_SECTION, .value = BRC_SENSOR_TURN,
     .meaning = "rotation of the element nearest to a point [rad]"},
    {"radial_stress", BRC_TYPE_STRUCT, .section = &RADIAL_STRESS_SECTION, .value = BRC_SENSOR_RADIAL_STRESS,
     .meaning = "pull of radial element forces on a sphere [Pa]"},
    {"volume_strain", BRC_TYPE_STRUCT, .section = &VOLUME_STRAIN_SECTION, .value = BRC_SENSOR_VOLUME_STRAIN,
     .meaning = "change of volume of a sphere [-]"},
    {"fracture", BRC_TYPE_WORD, FIELD(brc_sensor, term),
     CHOICES("broken", "crack_area", "fragments", "largest_fragment", "failure_ratio"), .value = BRC_SENSOR_FRACTURE,
     .sample = "broken",
     .meaning = "broken bonds [-], their area [m^2], number of fragments [-], share of the mass in the largest [-], "
                "largest stress over its "
                "limit [-]"},
    {"crack_tip", BRC_TYPE_STRUCT, .section = &TIP_SECTION, .value = BRC_SENSOR_CRACK_TIP,
     .meaning = "how far a crack has come [m]"},
    {"spin", BRC_TYPE_STRUCT, .section = &SPIN_SECTION, .value = BRC_SENSOR_SPIN,
     .meaning = "angular velocity of a set [rad/s]"},
    {"striker", BRC_TYPE_STRUCT, .section = &OF_STRIKER_SECTION, .value = BRC_SENSOR_STRIKER,
     .meaning = "of a striker"},
    {"contact", BRC_TYPE_WORD, FIELD(brc_sensor, term), CHOICES("pairs", "sliding", "penetration", "force"),
     .value = BRC_SENSOR_CONTACT, .sample = "pairs",
     .meaning = "touching pairs [-], those that slide [-], deepest overlap [m], sum of normal forces [N]"},
    {"opening", BRC_TYPE_STRUCT, .section = &OPENING_SECTION, .value = BRC_SENSOR_OPENING,
     .meaning = "of a crack, or between two places [m]"},
    {"mode", BRC_TYPE_INTEGER, WITHIN(0, 999), FIELD(brc_sensor, index), .value = BRC_SENSOR_MODE, .sample = "0",
     .meaning = "frequency of a mode of the last modes stage, 0 the lowest elastic one [Hz]"},
};
const brc_section brc_schema_sensor = {.title = "sensor",
                                       .meaning = "A number watched through the run.",
                                       ENTRIES(SENSOR),
                                       .size = sizeof(brc_sensor),
                                       .one_of = true,
                                       .has_kind = true,
                                       .kind_offset = offsetof(brc_sensor, kind),
                                       .sample_name = "probe"};

#define SENSOR_ENTRY(key_, field, sample_, meaning_)                                                                   \
    {                                                                                                                  \
        key_, BRC_TYPE_NAME, FIELD(brc_measure, field), .required = true, .refers = BRC_REFERS_SENSOR,                 \
                                                        .sample = sample_, .meaning = meaning_                         \
    }
#define AREA_ENTRY                                                                                                     \
    {                                                                                                                  \
        "area", BRC_TYPE_NAME, FIELD(brc_measure, area_set),                                                           \
            .refers = BRC_REFERS_SET, .sample = "x+",                                                                  \
            .meaning = "faces, or a wall's spheres, whose reference area divides the load; left out: a stress"         \
    }
#define COMMON_ENTRIES(target_sample)                                                                                  \
    {"stage",                                                                                                          \
     BRC_TYPE_NAME,                                                                                                    \
     FIELD(brc_measure, stage),                                                                                        \
     .refers = BRC_REFERS_STAGE,                                                                                       \
     .sample = "pull",                                                                                                 \
     .meaning = "stage looked at; left out: the last"},                                                                \
        {"window",                                                                                                     \
         BRC_TYPE_VECTOR,                                                                                              \
         BRC_UNIT_MEASURE_TIME,                                                                                        \
         NOT_NEGATIVE,                                                                                                 \
         FIELD(brc_measure, window),                                                                                   \
         .length = 2,                                                                                                  \
         .sample = "[0, 1]",                                                                                           \
         .meaning = "from and to, time since the start of the stage (a fraction 0 to 1 of a "                          \
                    "static one); left out: all of it"},                                                               \
        {"scale",      BRC_TYPE_QUANTITY,                                                                              \
         "",           FIELD(brc_measure, scale),                                                                      \
         .given = "1", .meaning = "factor on the result, e.g. -1 for the reaction of the other side"},                 \
    {                                                                                                                  \
        "target", BRC_TYPE_QUANTITY, BRC_UNIT_MEASURE, FIELD(brc_measure, target), FLAG(brc_measure, has_target),      \
            .sample = target_sample, .meaning = "what the material or theory says, shown beside the value"             \
    }

static const brc_entry MODULUS_E[] = {
    SENSOR_ENTRY("load", y, "stress", "sensor of the reaction or stress"),
    SENSOR_ENTRY("strain", x, "strain", "sensor of the strain along it"),
    AREA_ENTRY,
    COMMON_ENTRIES("20 GPa"),
};
static const brc_section E_SECTION = {.title = "E",
                                      .meaning =
                                          "Young's modulus: slope at zero strain of load over area against strain.",
                                      ENTRIES(MODULUS_E)};
static const brc_entry POISSON[] = {
    SENSOR_ENTRY("lateral", y, "strain", "sensor of the strain across"),
    SENSOR_ENTRY("axial", x, "strain", "sensor of the strain along the pull"),
    COMMON_ENTRIES("0.3"),
};
static const brc_section NU_SECTION = {
    .title = "nu", .meaning = "Poisson's ratio: minus the slope of lateral against axial strain.", ENTRIES(POISSON)};
static const brc_entry BULK[] = {
    SENSOR_ENTRY("load", y, "stress", "sensor of the reaction or stress"),
    SENSOR_ENTRY("strain", x, "strain",
                 "sensor of the volume strain; where all directions strain alike, one of them, with the scale 1/3"),
    AREA_ENTRY,
    COMMON_ENTRIES("20 GPa"),
};
static const brc_section K_SECTION = {
    .title = "K", .meaning = "Bulk modulus: slope at zero of load over area against volume strain.", ENTRIES(BULK)};
static const brc_entry SHEAR[] = {
    SENSOR_ENTRY("load", y, "stress", "sensor of the reaction or stress"),
    SENSOR_ENTRY("strain", x, "strain", "sensor of the shear angle; a strain xy is half of it and needs the scale 0.5"),
    AREA_ENTRY,
    COMMON_ENTRIES("8 GPa"),
};
static const brc_section G_SECTION = {
    .title = "G", .meaning = "Shear modulus: slope at zero of load over area against shear angle.", ENTRIES(SHEAR)};
static const brc_entry OF_FREQUENCY[] = {SENSOR_ENTRY("of", y, "force", "sensor"), COMMON_ENTRIES("1118 Hz")};
static const brc_section FREQUENCY_SECTION = {
    .title = "frequency", .meaning = "Largest peak of the spectrum of a sensor, interpolated.", ENTRIES(OF_FREQUENCY)};
static const brc_entry OF_SENSOR[] = {SENSOR_ENTRY("of", y, "force", "sensor"), COMMON_ENTRIES("1 N")};
static const brc_entry OF_RATE[] = {SENSOR_ENTRY("of", y, "force", "sensor"), COMMON_ENTRIES("1 N/s")};
static const brc_entry OF_PEAK[] = {SENSOR_ENTRY("of", y, "force", "sensor"), AREA_ENTRY, COMMON_ENTRIES("1 N")};
static const brc_section PEAK_SECTION = {.title = "peak",
                                         .meaning =
                                             "The value of largest magnitude; of a load over an area, the strength.",
                                         ENTRIES(OF_PEAK)};
static const brc_section MEAN_SECTION = {.title = "mean", .meaning = "Mean over time.", ENTRIES(OF_SENSOR)};
static const brc_entry OF_TWO[] = {SENSOR_ENTRY("of", y, "force", "sensor"),
                                   SENSOR_ENTRY("against", x, "force", "sensor it depends on"), COMMON_ENTRIES("1")};
static const brc_section RATE_SECTION = {.title = "rate",
                                         .meaning =
                                             "Slope of a sensor against time, by a straight line through the window.",
                                         ENTRIES(OF_RATE)};
static const brc_entry OF_INTEGRAL[] = {SENSOR_ENTRY("of", y, "force", "sensor"), COMMON_ENTRIES("1 N s")};
static const brc_section INTEGRAL_SECTION = {
    .title = "integral", .meaning = "Of a sensor over time, by trapezoids between samples.", ENTRIES(OF_INTEGRAL)};
static const brc_entry OF_DURATION[] = {
    SENSOR_ENTRY("of", y, "force", "sensor"),
    {"above", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(0, 1), FIELD(brc_measure, above), .given = "0.1 %",
     .sample = "0.1 %", .meaning = "share of its largest magnitude in the window"},
    {"within", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(0, 1), FIELD(brc_measure, within), .sample = "2 %",
     .meaning = "in its place: how long it is no farther than this share of its first value from it"},
    COMMON_ENTRIES("1 ms"),
};
static const brc_section DURATION_SECTION = {
    .title = "duration",
    .meaning = "How long the magnitude of a sensor is above a share of its largest, all times together, between "
               "samples by a straight line: of a force, the time of contact.",
    ENTRIES(OF_DURATION),
    .groups = {{BRC_GROUP_AT_MOST_ONE, {"above", "within"}}}};
static const brc_section AT_FIRST_BREAK_SECTION = {.title = "at_first_break",
                                                   .meaning =
                                                       "The value when the first bond breaks, between samples by a "
                                                       "straight line; of a load over an area, the stress at failure.",
                                                   ENTRIES(OF_PEAK)};
static const brc_section SLOPE_SECTION = {
    .title = "slope", .meaning = "Slope at zero of one sensor against another.", ENTRIES(OF_TWO)};
static const brc_entry MEASURE[] = {
    {"E", BRC_TYPE_STRUCT, .section = &E_SECTION, .value = BRC_MEASURE_E, .meaning = "Young's modulus [Pa]"},
    {"nu", BRC_TYPE_STRUCT, .section = &NU_SECTION, .value = BRC_MEASURE_NU, .meaning = "Poisson's ratio [-]"},
    {"K", BRC_TYPE_STRUCT, .section = &K_SECTION, .value = BRC_MEASURE_K, .meaning = "bulk modulus [Pa]"},
    {"G", BRC_TYPE_STRUCT, .section = &G_SECTION, .value = BRC_MEASURE_G, .meaning = "shear modulus [Pa]"},
    {"frequency", BRC_TYPE_STRUCT, .section = &FREQUENCY_SECTION, .value = BRC_MEASURE_FREQUENCY,
     .meaning = "frequency of a sensor [Hz]"},
    {"peak", BRC_TYPE_STRUCT, .section = &PEAK_SECTION, .value = BRC_MEASURE_PEAK, .meaning = "extreme of a sensor"},
    {"slope", BRC_TYPE_STRUCT, .section = &SLOPE_SECTION, .value = BRC_MEASURE_SLOPE,
     .meaning = "slope of one sensor against another"},
    {"mean", BRC_TYPE_STRUCT, .section = &MEAN_SECTION, .value = BRC_MEASURE_MEAN, .meaning = "mean of a sensor"},
    {"rate", BRC_TYPE_STRUCT, .section = &RATE_SECTION, .value = BRC_MEASURE_RATE,
     .meaning = "change of a sensor per time"},
    {"integral", BRC_TYPE_STRUCT, .section = &INTEGRAL_SECTION, .value = BRC_MEASURE_INTEGRAL,
     .meaning = "a sensor summed over time"},
    {"duration", BRC_TYPE_STRUCT, .section = &DURATION_SECTION, .value = BRC_MEASURE_DURATION,
     .meaning = "how long a sensor is up"},
    {"at_first_break", BRC_TYPE_STRUCT, .section = &AT_FIRST_BREAK_SECTION, .value = BRC_MEASURE_AT_FIRST_BREAK,
     .meaning = "a sensor when the first bond breaks"},
};
const brc_section brc_schema_measure = {.title = "measure",
                                        .meaning = "A number computed from sensors when the run ends.",
                                        ENTRIES(MEASURE),
                                        .size = sizeof(brc_measure),
                                        .one_of = true,
                                        .has_kind = true,
                                        .kind_offset = offsetof(brc_measure, kind),
                                        .sample_name = "result"};

static const brc_entry PICTURE_CUT[] = {
    {"point", BRC_TYPE_VECTOR, "m", FIELD(brc_output, picture_cut_point), .length = 3, .required = true,
     .sample = "[0, 0, 0]", .meaning = "a point of the plane"},
    {"normal", BRC_TYPE_DIRECTION, "", FIELD(brc_output, picture_cut_normal), .length = 3, .required = true,
     .sample = "[1, 0, 0]", .meaning = "towards what is left out"},
};
static const brc_section PICTURE_CUT_SECTION = {
    .title = "cut of pictures",
    .meaning = "Elements placed in front of a plane in the undeformed solid are not drawn, so that one sees inside.",
    ENTRIES(PICTURE_CUT)};
static const brc_entry CAMERA[] = {
    {"from", BRC_TYPE_VECTOR, "m", FIELD(brc_output, picture_from), .length = 3, .required = true,
     .sample = "[3 m, -2 m, 1 m]", .meaning = "where the viewer stands"},
    {"towards", BRC_TYPE_VECTOR, "m", FIELD(brc_output, picture_towards), .length = 3, .sample = "[1 m, 0, 0]",
     .meaning = "the point looked at; left out: the origin"},
};
static const brc_section CAMERA_SECTION = {
    .title = "camera",
    .meaning = "Pictures have no perspective and show the whole solid, so that only the direction counts.",
    ENTRIES(CAMERA)};
static const brc_entry PICTURE[] = {
    {"draw", BRC_TYPE_BOOL, FIELD(brc_output, picture), .given = "true", .meaning = "draw picture.png at the end"},
    {"frames", BRC_TYPE_BOOL, FIELD(brc_output, picture_frames), .given = "false",
     .meaning = "draw every frame too, pictures/NNNNNN.png"},
    {"cut", BRC_TYPE_STRUCT, .section = &PICTURE_CUT_SECTION, FLAG(brc_output, has_picture_cut),
     .meaning = "left out: the whole solid is drawn"},
    {"view", BRC_TYPE_WORD, FIELD(brc_output, picture_view), CHOICES("corner", "x", "-x", "y", "-y", "z", "-z"),
     .given = "corner", .meaning = "the side it is seen from; z: from above; corner: from above, between x and -y"},
    {"camera", BRC_TYPE_STRUCT, .section = &CAMERA_SECTION, FLAG(brc_output, has_picture_camera),
     .meaning = "in place of `view`"},
    {"colour", BRC_TYPE_WORD, FIELD(brc_output, picture_colour),
     CHOICES("von_mises", "damage", "displacement", "displacement_x", "displacement_y", "displacement_z", "velocity",
             "velocity_x", "velocity_y", "velocity_z", "stress_xx", "stress_yy", "stress_zz", "stress_yz", "stress_xz",
             "stress_xy", "strain_xx", "strain_yy", "strain_zz", "strain_yz", "strain_xz", "strain_xy"),
     .given = "von_mises", .meaning = "what the colours show"},
    {"scale", BRC_TYPE_QUANTITY, "", POSITIVE, FIELD(brc_output, picture_scale), .given = "auto", .word = "auto",
     .sample = "100",
     .meaning = "factor on the displacement; auto: 1 with contact or strikers, else what makes it visible"},
};
static const brc_section PICTURE_SECTION = {.title = "picture",
                                            .meaning = "The deformed solid. true or false alone is "
                                                       "`draw`.",
                                            ENTRIES(PICTURE),
                                            .short_key = "draw"};
static const brc_entry CURVE[] = {
    {"x", BRC_TYPE_NAME, FIELD(brc_output, curve_x), .required = true, .refers = BRC_REFERS_SENSOR, .sample = "force",
     .meaning = "sensor across"},
    {"y", BRC_TYPE_NAME, FIELD(brc_output, curve_y), .required = true, .refers = BRC_REFERS_SENSOR, .sample = "force",
     .meaning = "sensor upward"},
};
static const brc_section CURVE_SECTION = {
    .title = "curve", .meaning = "One sensor against another, in curve.png.", ENTRIES(CURVE)};
static const brc_entry CHECKPOINT[] = {
    {"every", BRC_TYPE_QUANTITY, "s", POSITIVE, FIELD(brc_output, checkpoint_every), .given = "off", .word = "off",
     .sample = "1 ms", .meaning = "simulated time between checkpoints"},
    {"wall", BRC_TYPE_QUANTITY, "s", POSITIVE, FIELD(brc_output, checkpoint_wall), .given = "off", .word = "off",
     .sample = "10 min", .meaning = "time of the clock between checkpoints"},
};
static const brc_section CHECKPOINT_SECTION = {
    .title = "checkpoint",
    .meaning = "Files from which `breccia run --resume` goes on; the last two are kept.",
    ENTRIES(CHECKPOINT),
    .short_key = "wall"};
static const brc_entry OUTPUT[] = {
    {"frames", BRC_TYPE_INTEGER, WITHIN(0, 1e6), FIELD(brc_output, n_frames), .given = "0", .word = "none",
     .word_value = -1, .sample = "10",
     .meaning = "equal intervals over each stage; 0: its start and end only; none: no frames at all"},
    {"frame_interval", BRC_TYPE_QUANTITY, "s", POSITIVE, FIELD(brc_output, frame_interval), .sample = "1 ms",
     .meaning = "time between frames, in place of their number"},
    {"frame_numbers", BRC_TYPE_CHOICE, FIELD(brc_output, frame_numbers), CHOICES("single", "double"), .given = "single",
     .meaning = "of the fields of frames: 7 digits, or all 16 in twice the bytes; histories and checkpoints have all"},
    {"history_every", BRC_TYPE_INTEGER, WITHIN(1, 1e9), FIELD(brc_output, history_every), .given = "auto",
     .word = "auto", .sample = "10",
     .meaning =
         "steps between samples of the sensors; auto: 500 samples a dynamic stage, every increment of a static one"},
    {"picture", BRC_TYPE_STRUCT, .section = &PICTURE_SECTION, .given = "{}", .meaning = "the deformed solid"},
    {"crack_surface", BRC_TYPE_BOOL, FIELD(brc_output, crack_surface), .given = "true",
     .meaning = "with fracture: broken faces as polygons beside every frame"},
    {"checkpoint", BRC_TYPE_STRUCT, .section = &CHECKPOINT_SECTION, FLAG(brc_output, has_checkpoint),
     .meaning = "left out: only when the run is interrupted or stopped"},
    {"curve", BRC_TYPE_STRUCT, .section = &CURVE_SECTION, .meaning = "one sensor against another; left out: none"},
};
const brc_section brc_schema_output = {.title = "output",
                                       .meaning = "What is written besides the summary.",
                                       ENTRIES(OUTPUT),
                                       .groups = {{BRC_GROUP_AT_MOST_ONE, {"frames", "frame_interval"}}}};
