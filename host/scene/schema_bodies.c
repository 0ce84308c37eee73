/* Schema: materials, the model, bodies and sets; shapes and fills are in schema_shapes.c. */
#include "schema_internal.h"

static const brc_entry MICRO[] = {
    {"radius", BRC_TYPE_QUANTITY, "", POSITIVE, FIELD(brc_material, beam_radius), .required = true, .sample = "0.35",
     .meaning = "r_m: beam radius over the mean radius of the packed spheres"},
    {"E", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, beam_young), .required = true, .sample = "620 GPa",
     .meaning = "E_m: Young's modulus of the beams"},
    {"strength", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, beam_strength), .sample = "60 MPa",
     .meaning = "sigma_m: tensile limit of the virial stress, in place of the law for it"},
    {"compression", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, beam_compression), .sample = "600 MPa",
     .meaning = "compressive limit of the virial stress, a positive number, in place of the law for it"},
};
static const brc_section MICRO_SECTION = {
    .title = "beam",
    .meaning = "Micro-parameters of model cbm, given directly in place of the calibrated laws.",
    ENTRIES(MICRO)};
static const brc_entry MATERIAL[] = {
    {"E", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, young), .required = true, .sample = "72 GPa",
     .meaning = "Young's modulus"},
    {"nu", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(-1, 0.5), FIELD(brc_material, poisson), .required = true,
     .sample = "0.23", .meaning = "Poisson's ratio",
     .why = "at 0.5 the solid is incompressible and at -1 it has no bulk stiffness against its shear stiffness, so the "
            "moduli are infinite"},
    {"density", BRC_TYPE_QUANTITY, "kg/m^3", POSITIVE, FIELD(brc_material, density), .required = true,
     .sample = "2500 kg/m^3", .meaning = "mass per volume"},
    {"strength", BRC_TYPE_STRUCT, .section = &brc_schema_strength,
     .meaning = "what it bears, `strength: 8 MPa` in tension; for scenes with `fracture`, where it does not break if "
                "this is left out"},
    {"beam", BRC_TYPE_STRUCT, .section = &MICRO_SECTION,
     .meaning = "micro-parameters of model cbm; from the calibrated laws when left out"},
};
const brc_section brc_schema_material = {.title = "material",
                                         .meaning = "An isotropic elastic material.",
                                         ENTRIES(MATERIAL),
                                         .size = sizeof(brc_material),
                                         .sample_name = "glass"};

#define BRC_MODEL(kind, name, word, meaning) extern const brc_section brc_schema_##word;
#include "models.def"
#undef BRC_MODEL
#define BRC_MODEL(kind, name, word, what)                                                                              \
    {name, BRC_TYPE_STRUCT, .section = &brc_schema_##word, .value = kind, .meaning = what},
static const brc_entry MODEL[] = {
#include "models.def"
};
#undef BRC_MODEL
const brc_section brc_schema_model = {.title = "model",
                                      .meaning = "The law between the elements.",
                                      ENTRIES(MODEL),
                                      .one_of = true,
                                      .has_kind = true,
                                      .kind_offset = offsetof(brc_model, kind)};

static const brc_entry PREDICATE_BOX[] = {
    {"from", BRC_TYPE_VECTOR, "m", FIELD(brc_predicate, box[0]), .length = 3, .required = true, .sample = "[0, 0, 0]",
     .meaning = "smallest corner, inclusive"},
    {"to", BRC_TYPE_VECTOR, "m", FIELD(brc_predicate, box[1]), .length = 3, .required = true,
     .sample = "[1 m, 1 m, 50 cm]", .meaning = "largest corner, inclusive"},
};
static const brc_section PREDICATE_BOX_SECTION = {
    .title = "where box", .meaning = "Inside a box.", ENTRIES(PREDICATE_BOX)};
static const brc_entry PREDICATE_SPHERE[] = {
    {"centre", BRC_TYPE_VECTOR, "m", FIELD(brc_predicate, sphere_centre), .length = 3, .required = true,
     .sample = "[50 cm, 50 cm, 50 cm]", .meaning = "centre"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_predicate, sphere_radius), .sample = "20 cm",
     .meaning = "radius, inclusive"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_predicate, sphere_radius), .another = true, .factor = 0.5,
     .sample = "40 cm", .meaning = "twice the radius, in its place"},
};
static const brc_section PREDICATE_SPHERE_SECTION = {.title = "where sphere",
                                                     .meaning = "Inside a sphere.",
                                                     ENTRIES(PREDICATE_SPHERE),
                                                     .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}}};
static const brc_entry PREDICATE_CYLINDER[] = {
    {"point", BRC_TYPE_VECTOR, "m", FIELD(brc_predicate, cylinder_point), .length = 3, .required = true,
     .sample = "[0, 0, 0]", .meaning = "a point of the axis"},
    {"axis", BRC_TYPE_DIRECTION, "", FIELD(brc_predicate, cylinder_axis), .length = 3, .required = true,
     .sample = "[1, 0, 0]", .meaning = "its direction"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_predicate, cylinder_radius), .sample = "20 cm",
     .meaning = "radius, inclusive"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_predicate, cylinder_radius), .another = true,
     .factor = 0.5, .sample = "40 cm", .meaning = "twice the radius, in its place"},
};
static const brc_section PREDICATE_CYLINDER_SECTION = {.title = "where cylinder",
                                                       .meaning = "Inside an endless cylinder.",
                                                       ENTRIES(PREDICATE_CYLINDER),
                                                       .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}}};
static const brc_entry HALF_SPACE[] = {
    {"point", BRC_TYPE_VECTOR, "m", FIELD(brc_predicate, half_space_point), .length = 3, .required = true,
     .sample = "[50 cm, 0, 0]", .meaning = "a point of the plane"},
    {"normal", BRC_TYPE_DIRECTION, "", FIELD(brc_predicate, half_space_normal), .length = 3, .required = true,
     .sample = "[1, 0, 0]", .meaning = "points into the half space"},
};
static const brc_section HALF_SPACE_SECTION = {
    .title = "where half_space", .meaning = "On one side of a plane, inclusive.", ENTRIES(HALF_SPACE)};
static const brc_entry NORMAL[] = {
    {"direction", BRC_TYPE_DIRECTION, "", FIELD(brc_predicate, normal), .length = 3, .required = true,
     .sample = "[0, 0, 1]", .meaning = "where the outward normal points"},
    {"within", BRC_TYPE_QUANTITY, "rad", ABOVE_UP_TO(0, M_PI), FIELD(brc_predicate, normal_angle), .given = "1 deg",
     .meaning = "largest angle between the two"},
};
static const brc_section NORMAL_SECTION = {
    .title = "where normal", .meaning = "Faces that look in a direction.", ENTRIES(NORMAL)};
static const brc_entry PREDICATE[] = {
    {"body", BRC_TYPE_NAME, FIELD(brc_predicate, body_name), FLAG(brc_predicate, has_body), .refers = BRC_REFERS_BODY,
     .sample = "body", .meaning = "elements of this body, or its faces; not for regions, which belong to one"},
    {"wall", BRC_TYPE_NAME, FIELD(brc_predicate, wall), FLAG(brc_predicate, has_wall), .refers = BRC_REFERS_WALL,
     .sample = "x-", .meaning = "faces of this wall; elements with a face on it"},
    {"box", BRC_TYPE_STRUCT, .section = &PREDICATE_BOX_SECTION, FLAG(brc_predicate, has_box),
     .meaning = "inside a box"},
    {"sphere", BRC_TYPE_STRUCT, .section = &PREDICATE_SPHERE_SECTION, FLAG(brc_predicate, has_sphere),
     .meaning = "inside a sphere"},
    {"cylinder", BRC_TYPE_STRUCT, .section = &PREDICATE_CYLINDER_SECTION, FLAG(brc_predicate, has_cylinder),
     .meaning = "inside an endless cylinder"},
    {"half_space", BRC_TYPE_STRUCT, .section = &HALF_SPACE_SECTION, FLAG(brc_predicate, has_half_space),
     .meaning = "on one side of a plane"},
    {"normal", BRC_TYPE_STRUCT, .section = &NORMAL_SECTION, FLAG(brc_predicate, has_normal),
     .meaning = "faces that look in a direction; not for elements"},
};
const brc_section brc_schema_predicate = {
    .title = "where",
    .meaning = "Which faces (by centroid and outward normal) or elements (by position). All given parts "
               "must hold. A word alone is a wall.",
    ENTRIES(PREDICATE),
    .short_key = "wall",
    .groups = {{BRC_GROUP_AT_LEAST_ONE, {"wall", "body", "box", "sphere", "cylinder", "half_space", "normal"}}}};

static const brc_entry REGION[] = {
    {"material", BRC_TYPE_MATERIAL, FIELD(brc_region, material), .required = true, .sample = "glass",
     .meaning = "of the elements in the region"},
    {"where", BRC_TYPE_STRUCT, .section = &brc_schema_predicate, .offset = offsetof(brc_region, where),
     .required = true, .sample = "{half_space: {point: [0, 0, 0], normal: [1, 0, 0]}}", .meaning = "which elements"},
};
static const brc_section REGION_SECTION = {.title = "region",
                                           .meaning = "A part of a body made of another material.",
                                           ENTRIES(REGION),
                                           .size = sizeof(brc_region)};
static const brc_entry POSE[] = {POSE_ENTRIES(brc_body)};
static const brc_section POSE_SECTION = {.title = "pose", .meaning = "Where the body stands.", ENTRIES(POSE)};
static const brc_entry BEAMS[] = {
    {"coordination", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 40), FIELD(brc_body, beams), .required = true, .sample = "8",
     .meaning = "mean number of bonds of an element, 2 bonds / elements; the papers use 6 to 13"},
};
static const brc_section BEAMS_SECTION = {.title = "beams",
                                          .meaning = "Spheres joined by beams: bonds between the nearest spheres.",
                                          ENTRIES(BEAMS),
                                          .short_key = "coordination"};
static const brc_entry BODY[] = {
    {"name", BRC_TYPE_NAME, FIELD(brc_body, name), .given = "body",
     .meaning = "for messages and overrides, and of the set of all its elements"},
    {"domain", BRC_TYPE_STRING, FIELD(brc_body, domain_file), .sample = "domain.h5",
     .meaning = "domain file written by `breccia build`, relative to the scene; in place of shape and fill"},
    {"shape", BRC_TYPE_STRUCT, .section = &brc_schema_shape, .offset = offsetof(brc_body, shape),
     .meaning = "what is cut"},
    {"fill", BRC_TYPE_STRUCT, .section = &brc_schema_fill, .offset = offsetof(brc_body, fill),
     .meaning = "how it is cut; due with a shape"},
    {"material", BRC_TYPE_MATERIAL, FIELD(brc_body, material), .sample = "glass",
     .meaning = "may be left out where the scene has only one"},
    {"regions", BRC_TYPE_LIST, .section = &REGION_SECTION, COUNTED(brc_body, regions, n_regions),
     .meaning = "parts of another material; later ones win"},
    {"grains", BRC_TYPE_STRUCT, .section = &brc_schema_grains, .meaning = "coarse grains over the elements"},
    {"cracks", BRC_TYPE_LIST, .section = &brc_schema_crack, COUNTED(brc_body, cracks, n_cracks),
     .meaning = "notches and cracks that are there from the start; posed coordinates"},
    {"beams", BRC_TYPE_STRUCT, .section = &BEAMS_SECTION,
     .meaning = "spheres joined by beams in place of cells; needs a fill with radii (`breccia build`; for model cbm)"},
    {"pose", BRC_TYPE_STRUCT, .section = &POSE_SECTION, .meaning = "where it stands; sets and regions see it posed"},
    {"model", BRC_TYPE_STRUCT, .section = &brc_schema_model, .offset = offsetof(brc_body, model),
     FLAG(brc_body, has_model), .meaning = "the law between its elements; left out: the scene's"},
    {"tiny_face_threshold", BRC_TYPE_QUANTITY, "", ABOVE_UP_TO(0, 0.01), FIELD(brc_body, tiny_face_threshold),
     .given = "auto", .word = "auto", .sample = "1e-7",
     .meaning = "faces below this part of the mean face area are dropped; auto: 1e-12"},
};
const brc_section brc_schema_body = {.title = "body",
                                     .meaning = "A solid.",
                                     ENTRIES(BODY),
                                     .size = sizeof(brc_body),
                                     .groups = {{BRC_GROUP_EXACTLY_ONE, {"shape", "domain"}}}};

static const brc_entry SET[] = {
    {"elements", BRC_TYPE_STRUCT, .section = &brc_schema_predicate, .offset = offsetof(brc_set_request, where),
     .value = BRC_SET_ELEMENTS, .meaning = "a set of elements"},
    {"faces", BRC_TYPE_STRUCT, .section = &brc_schema_predicate, .offset = offsetof(brc_set_request, where),
     .value = BRC_SET_FACES, .meaning = "a set of boundary faces"},
};
const brc_section brc_schema_set = {.title = "set",
                                    .meaning =
                                        "A named part of the solid. Each wall is a set of faces and each body a set of "
                                        "elements without being asked for.",
                                    ENTRIES(SET),
                                    .size = sizeof(brc_set_request),
                                    .one_of = true,
                                    .has_kind = true,
                                    .kind_offset = offsetof(brc_set_request, kind),
                                    .sample_name = "core"};
