/* Schema: contact, and rigid walls and strikers. */
#include "schema_internal.h"

/* `at` is offsetof the law in the struct that the section describes. */
#define OF_LAW(at, field)                                                                                              \
    .offset = (at) + offsetof(brc_contact_law, field), .size = sizeof(((brc_contact_law *)0)->field)
#define LAW_ENTRIES(at)                                                                                                \
    {"friction",                                                                                                       \
     BRC_TYPE_QUANTITY,                                                                                                \
     "",                                                                                                               \
     NOT_NEGATIVE,                                                                                                     \
     OF_LAW(at, friction),                                                                                             \
     .given = "0",                                                                                                     \
     .sample = "0.4",                                                                                                  \
     .meaning = "Coulomb's coefficient"},                                                                              \
        {"restitution",                                                                                                \
         BRC_TYPE_QUANTITY,                                                                                            \
         "",                                                                                                           \
         ABOVE_UP_TO(0, 1),                                                                                            \
         OF_LAW(at, restitution),                                                                                      \
         .sample = "0.8",                                                                                              \
         .meaning = "speed after a central blow over that before, of rigid bodies; left out: 1, nothing is damped"},   \
        {"damping",                                                                                                    \
         BRC_TYPE_QUANTITY,                                                                                            \
         "",                                                                                                           \
         WITHIN(0, 1),                                                                                                 \
         OF_LAW(at, damping),                                                                                          \
         .sample = "10 %",                                                                                             \
         .meaning = "viscous damping of contact as a share of the critical one, in place of the restitution"},         \
        {"stiffness",    BRC_TYPE_QUANTITY,     "N/m",                                                                 \
         POSITIVE,       OF_LAW(at, stiffness), .given = "auto",                                                       \
         .word = "auto", .sample = "1 MN/m",    .meaning = "of a touching pair; auto: from the materials"},            \
    {                                                                                                                  \
        "tangential", BRC_TYPE_QUANTITY, "", POSITIVE, OF_LAW(at, tangential),                                         \
            .given = "auto", .word = "auto", .sample = "0.8",                                                          \
            .meaning = "tangential over normal stiffness of surfaces that stick; auto: 2 (1 - nu) / (2 - nu)"          \
    }
#define LAW_GROUP .groups = {{BRC_GROUP_AT_MOST_ONE, {"restitution", "damping"}}}

static const brc_entry PAIR[] = {
    {"first", BRC_TYPE_MATERIAL, FIELD(brc_contact_law, material[0]), .required = true, .sample = "glass",
     .meaning = "one side"},
    {"second", BRC_TYPE_MATERIAL, FIELD(brc_contact_law, material[1]), .required = true, .sample = "glass",
     .meaning = "the other side"},
    LAW_ENTRIES(0),
};
static const brc_section PAIR_SECTION = {.title = "contact of a pair",
                                         .meaning = "How two materials meet, in place of what `contact` says for all.",
                                         ENTRIES(PAIR),
                                         .size = sizeof(brc_contact_law),
                                         LAW_GROUP};
static const brc_entry CONTACT[] = {
    LAW_ENTRIES(offsetof(brc_scene, contact.law)),
    {"pairs", BRC_TYPE_LIST, .section = &PAIR_SECTION, COUNTED(brc_scene, contact.pairs, contact.n_pairs),
     .meaning = "laws of their own for pairs of materials; later ones win"},
    {"spheres", BRC_TYPE_CHOICE, FIELD(brc_scene, contact.spheres), CHOICES("hertz", "linear"), .given = "hertz",
     .meaning = "normal force between spheres, and of spheres on walls"},
    {"within", BRC_TYPE_BOOL, FIELD(brc_scene, contact.within), .given = "true",
     .meaning = "elements of one body touch each other: closed cracks and fragments; false: different bodies and "
                "strikers only"},
    {"rotation", BRC_TYPE_BOOL, FIELD(brc_scene, contact.rotation), .given = "true",
     .meaning = "cells that lost all their bonds turn as rigid bodies"},
    {"skin", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_scene, contact.skin), .given = "auto", .word = "auto",
     .sample = "1 mm", .meaning = "pairs nearer than this are kept in the list between two searches"},
};
const brc_section brc_schema_contact = {
    .title = "contact",
    .meaning =
        "Free surfaces of bodies and fragments, walls and strikers touch; left out: they pass through each other.",
    ENTRIES(CONTACT),
    LAW_GROUP};

static const brc_entry PLANE[] = {
    {"point", BRC_TYPE_VECTOR, "m", FIELD(brc_striker, point), .length = 3, .required = true, .sample = "[0, 0, 0]",
     .meaning = "a point of the plane"},
    {"normal", BRC_TYPE_DIRECTION, "", FIELD(brc_striker, normal), .length = 3, .required = true, .sample = "[0, 0, 1]",
     .meaning = "points out of the wall, to where the bodies are"},
};
static const brc_section PLANE_SECTION = {.title = "plane of a striker", .meaning = "An endless wall.", ENTRIES(PLANE)};
static const brc_entry STRIKER_POSE[] = {POSE_ENTRIES(brc_striker)};
static const brc_section STRIKER_POSE_SECTION = {
    .title = "pose of a striker", .meaning = "Where it stands at the start.", ENTRIES(STRIKER_POSE)};
#define VELOCITY_ENTRIES(when)                                                                                         \
    {"velocity",                                                                                                       \
     BRC_TYPE_VECTOR,                                                                                                  \
     "m/s",                                                                                                            \
     FIELD(brc_striker, velocity),                                                                                     \
     .length = 3,                                                                                                      \
     .sample = "[0, 0, -10 m/s]",                                                                                      \
     .meaning = "of its mass centre, " when},                                                                          \
    {                                                                                                                  \
        "spin", BRC_TYPE_VECTOR, "rad/s", FIELD(brc_striker, spin),                                                    \
            .length = 3, .sample = "[0, 0, 10 rad/s]", .meaning = "angular velocity about its mass centre, " when      \
    }
static const brc_entry DRIVEN[] = {
    VELOCITY_ENTRIES("times the table"),
    {"table", BRC_TYPE_TABLE, "s", .offset = offsetof(brc_striker, table),
     .meaning = "factor of time: pairs of time since the start of the run and factor, linear between, constant "
                "outside; left out: 1"},
};
static const brc_section DRIVEN_SECTION = {.title = "driven striker",
                                           .meaning = "It moves as told, whatever resists.",
                                           ENTRIES(DRIVEN),
                                           .groups = {{BRC_GROUP_AT_LEAST_ONE, {"velocity", "spin"}}}};
static const brc_entry HOLD[] = {
    {"x", BRC_TYPE_BOOL, FIELD(brc_striker, held[0]), .given = "false", .meaning = "no motion along x"},
    {"y", BRC_TYPE_BOOL, FIELD(brc_striker, held[1]), .given = "false", .meaning = "no motion along y"},
    {"z", BRC_TYPE_BOOL, FIELD(brc_striker, held[2]), .given = "false", .meaning = "no motion along z"},
    {"rotation", BRC_TYPE_BOOL, FIELD(brc_striker, held_rotation), .given = "false", .meaning = "it does not turn"},
};
static const brc_section HOLD_SECTION = {
    .title = "hold", .meaning = "What a free striker may not do, as on a rail.", ENTRIES(HOLD)};
static const brc_entry FREE[] = {
    VELOCITY_ENTRIES("at the start of the run"),
    {"force", BRC_TYPE_VECTOR, "N", FIELD(brc_striker, force), FLAG(brc_striker, pushed), .length = 3,
     .sample = "[0, 0, -10 kN]",
     .meaning = "on its mass centre, times the table, however it moves; gravity and contact come on top. Acts in "
                "dynamic stages"},
    {"table", BRC_TYPE_TABLE, "s", .offset = offsetof(brc_striker, table),
     .meaning = "factor of the force: pairs of time since the start of the run and factor, linear between, constant "
                "outside; left out: 1"},
    {"mass", BRC_TYPE_QUANTITY, "kg", POSITIVE, FIELD(brc_striker, mass), .given = "auto", .word = "auto",
     .sample = "1 kg", .meaning = "auto: volume times density; the inertia follows from the shape"},
    {"hold", BRC_TYPE_STRUCT, .section = &HOLD_SECTION, .given = "{}", .meaning = "motions that are not free"},
};
static const brc_section FREE_SECTION = {
    .title = "free striker",
    .meaning = "A rigid body with mass and inertia; gravity acts on it, and a prescribed force where one is given.",
    ENTRIES(FREE)};
static const brc_entry MOTION[] = {
    {"fixed", BRC_TYPE_STRUCT, .value = BRC_STRIKER_FIXED, .meaning = "it stays"},
    {"driven", BRC_TYPE_STRUCT, .section = &DRIVEN_SECTION, .value = BRC_STRIKER_DRIVEN, .meaning = "it moves as told"},
    {"free", BRC_TYPE_STRUCT, .section = &FREE_SECTION, .value = BRC_STRIKER_FREE,
     .meaning = "it moves as forces make it"},
};
static const brc_section MOTION_SECTION = {.title = "motion",
                                           .meaning = "How a striker moves.",
                                           ENTRIES(MOTION),
                                           .one_of = true,
                                           .has_kind = true,
                                           .kind_offset = offsetof(brc_striker, motion)};
static const brc_entry STRIKER[] = {
    {"plane", BRC_TYPE_STRUCT, .section = &PLANE_SECTION, FLAG(brc_striker, is_plane),
     .meaning = "an endless wall; fixed or driven"},
    {"shape", BRC_TYPE_STRUCT, .section = &brc_schema_shape, .offset = offsetof(brc_striker, shape),
     .meaning = "a rigid body of this shape"},
    {"facets", BRC_TYPE_INTEGER, WITHIN(8, 400), FIELD(brc_striker, facets), .given = "48",
     .meaning =
         "flat faces around a full turn of curved shapes; exact for spheres of beams against spheres and planes"},
    {"pose", BRC_TYPE_STRUCT, .section = &STRIKER_POSE_SECTION, .meaning = "where it stands"},
    {"material", BRC_TYPE_MATERIAL, FIELD(brc_striker, material), .required = true, .sample = "glass",
     .meaning = "for the law of contact and the mass"},
    {"motion", BRC_TYPE_STRUCT, .section = &MOTION_SECTION, .given = "fixed", .meaning = "how it moves"},
};
const brc_section brc_schema_striker = {.title = "striker",
                                        .meaning = "A rigid wall or striker; needs `interactions: {contact: {}}`.",
                                        ENTRIES(STRIKER),
                                        .size = sizeof(brc_striker),
                                        .sample_name = "anvil",
                                        .groups = {{BRC_GROUP_EXACTLY_ONE, {"plane", "shape"}}}};
