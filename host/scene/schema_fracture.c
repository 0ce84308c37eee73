/* Schema: fracture. What a material bears is with the material (`strength`), how it fails is with the scene. */
#include "schema_internal.h"

static const brc_entry STRENGTH[] = {
    {"tension", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, tension), .sample = "50 MPa",
     .meaning = "largest principal stress it bears"},
    {"compression", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, compression), .sample = "500 MPa",
     .meaning = "largest compressive principal stress it bears, a positive number; left out: any"},
};
const brc_section brc_schema_strength = {.title = "strength",
                                         .meaning = "What the material bears, measured on a sample of it; used by scenes with `fracture`.",
                                         ENTRIES(STRENGTH),
                                         .groups = {{BRC_GROUP_AT_LEAST_ONE, {"tension", "compression"}}}};

#define LEVEL_ENTRY                                                                                                    \
    {                                                                                                                  \
        "level", BRC_TYPE_INTEGER, WITHIN(0, 2), FIELD(brc_fracture, level), .given = "1",                             \
            .meaning = "shells of neighbours over unbroken bonds that the stress is averaged over"                     \
    }
#define SHEAR_ENTRIES                                                                                                  \
    {"cohesion", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_fracture, cohesion), .required = true,                   \
     .sample = "100 MPa", .meaning = "shear stress borne without normal stress, of every material"},                   \
    {"friction", BRC_TYPE_QUANTITY, "rad", .range = {0, M_PI / 2, false, true}, FIELD(brc_fracture, friction),         \
     .required = true, .sample = "30 deg", .why = "at 90 degrees it would bear any shear", .meaning = "angle of internal friction"}
static const brc_entry PRINCIPAL[] = {LEVEL_ENTRY};
static const brc_section PRINCIPAL_SECTION = {
    .title = "virial-principal",
    .meaning = "An element fails when the largest principal value of its virial stress reaches the tensile strength of its material, or the "
               "smallest one the compressive strength (Nguyen, Andre and Huger 2019, section 2.2). It loses one bond a step, the one nearest "
               "to the direction of that principal value.",
    ENTRIES(PRINCIPAL)};
static const brc_entry MOHR_COULOMB[] = {SHEAR_ENTRIES, LEVEL_ENTRY};
static const brc_section MOHR_COULOMB_SECTION = {
    .title = "mohr-coulomb",
    .meaning = "As virial-principal, with strengths only where materials give them, and a limit on shear: (s1 - s3) + sin(friction) (s1 + s3) "
               "= 2 cohesion cos(friction). The bond is the one nearest to the normal of a slip plane.",
    ENTRIES(MOHR_COULOMB)};
static const brc_entry DRUCKER_PRAGER[] = {SHEAR_ENTRIES, LEVEL_ENTRY};
static const brc_section DRUCKER_PRAGER_SECTION = {
    .title = "drucker-prager",
    .meaning = "As mohr-coulomb, with the smooth cone sqrt(J2) + a I1 = k through its compressive edges.",
    ENTRIES(DRUCKER_PRAGER)};
static const brc_entry CRITERION[] = {
    {"virial-principal", BRC_TYPE_STRUCT, .section = &PRINCIPAL_SECTION, .value = BRC_CRITERION_PRINCIPAL,
     .meaning = "principal values of the virial stress"},
    {"mohr-coulomb", BRC_TYPE_STRUCT, .section = &MOHR_COULOMB_SECTION, .value = BRC_CRITERION_MOHR_COULOMB,
     .meaning = "and shear with friction"},
    {"drucker-prager", BRC_TYPE_STRUCT, .section = &DRUCKER_PRAGER_SECTION, .value = BRC_CRITERION_DRUCKER_PRAGER,
     .meaning = "and shear with friction, smooth"},
};
static const brc_section CRITERION_SECTION = {.title = "criterion",
                                              .meaning = "When an element fails, and which of its bonds breaks.",
                                              ENTRIES(CRITERION),
                                              .one_of = true,
                                              .has_kind = true,
                                              .kind_offset = offsetof(brc_fracture, kind)};
static const brc_entry FRACTURE[] = {
    {"criterion", BRC_TYPE_STRUCT, .section = &CRITERION_SECTION, .given = "virial-principal", .meaning = "when bonds break"},
};
const brc_section brc_schema_fracture = {.title = "fracture",
                                         .meaning = "Bonds break in dynamic stages; left out: they hold for ever. For model cbm.",
                                         ENTRIES(FRACTURE)};
