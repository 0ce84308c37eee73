/* Schema: fracture. What a material bears is with the material (`strength`), how it fails is with the scene, what joins
 * materials and grains is with its interactions. */
#include "schema_internal.h"

#define ENERGY_SAMPLE "8 J/m^2"
static const brc_entry WEIBULL[] = {
    {"modulus", BRC_TYPE_QUANTITY, "", WITHIN(1, 1000), FIELD(brc_material, scatter.modulus), .required = true,
     .sample = "10", .meaning = "m: the larger, the less they scatter"},
    {"volume", BRC_TYPE_QUANTITY, "m^3", POSITIVE, FIELD(brc_material, scatter.volume), .sample = "1 mm^3",
     .meaning = "V_0 that the strength belongs to: a bond of volume V has (V_0 / V)^(1/m) times as much; left out: "
                "bonds of any size have the "
                "same"},
};
static const brc_section WEIBULL_SECTION = {.title = "weibull",
                                            .meaning = "Share 1 - exp(-f^m V / V_0) of the bonds has a factor below f.",
                                            ENTRIES(WEIBULL),
                                            .short_key = "modulus"};
static const brc_entry QUANTILE[] = {
    {"below", BRC_TYPE_QUANTITY, "", WITHIN(0, 1), FIELD(brc_quantile, below), .required = true, .sample = "0",
     .meaning = "share of the bonds with a smaller factor: 0 at the first, 1 at the last"},
    {"factor", BRC_TYPE_QUANTITY, "", POSITIVE, FIELD(brc_quantile, factor), .required = true, .sample = "0.8",
     .meaning = "ascending"},
};
static const brc_section QUANTILE_SECTION = {.title = "quantile",
                                             .meaning = "A point of the distribution of strengths.",
                                             ENTRIES(QUANTILE),
                                             .size = sizeof(brc_quantile)};
static const brc_entry SCATTER[] = {
    {"weibull", BRC_TYPE_STRUCT, .section = &WEIBULL_SECTION, .value = BRC_SCATTER_WEIBULL,
     .meaning = "the weakest link"},
    {"table", BRC_TYPE_LIST, .section = &QUANTILE_SECTION,
     COUNTED(brc_material, scatter.quantiles, scatter.n_quantiles), .value = BRC_SCATTER_TABLE,
     .meaning = "quantiles, linear between them"},
    {"file", BRC_TYPE_STRING, FIELD(brc_material, scatter.file), .value = BRC_SCATTER_FILE, .sample = "factors.csv",
     .meaning = "CSV with columns element_i, element_j, factor, relative to the scene; 1 for bonds that are not in it"},
};
static const brc_section SCATTER_SECTION = {
    .title = "scatter",
    .meaning = "Strength of bonds over that of the material: a factor a bond, drawn from the ids of its elements "
               "and the seed of `fracture`.",
    ENTRIES(SCATTER),
    .one_of = true,
    .has_kind = true,
    .kind_offset = offsetof(brc_material, scatter.kind)};
static const brc_entry STRENGTH[] = {
    {"tension", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, tension), .sample = "50 MPa",
     .meaning = "largest principal stress it bears"},
    {"measured_by", BRC_TYPE_CHOICE, FIELD(brc_material, measured_by), CHOICES("tension", "brazilian", "either"),
     .given = "tension",
     .meaning = "model cbm: the test that `tension` comes from; brazilian: 2 P / (pi t D) of discs pressed across over "
                "arcs of 24 degrees (NAH19 eq. 27), as rock is tested; "
                "such discs then split at it; either: not known, bodies pulled apart and discs share the difference "
                "between them, up to 3.7 % of the strength in tension"},
    {"compression", BRC_TYPE_QUANTITY, "Pa", POSITIVE, FIELD(brc_material, compression), .sample = "500 MPa",
     .meaning = "largest compressive principal stress it bears, a positive number; left out: any"},
    {"fracture_energy", BRC_TYPE_QUANTITY, "J/m^2", POSITIVE, FIELD(brc_material, fracture_energy),
     .sample = ENERGY_SAMPLE,
     .meaning = "energy per area of a crack: bonds soften in place of breaking at once; left out: what strength and "
                "cells make of it"},
    {"shear_fracture_energy", BRC_TYPE_QUANTITY, "J/m^2", POSITIVE, FIELD(brc_material, shear_fracture_energy),
     .sample = ENERGY_SAMPLE,
     .meaning = "with a fracture energy, model dlsm and criterion mohr-coulomb: energy per area of a crack whose sides "
                "slide (mode II), beside what they rub off; left out: the fracture energy"},
    {"softening", BRC_TYPE_CHOICE, FIELD(brc_material, softening), CHOICES("linear", "exponential"), .given = "linear",
     .meaning = "with a fracture energy: how the cohesion falls while a crack opens"},
    {"scatter", BRC_TYPE_STRUCT, .section = &SCATTER_SECTION,
     .meaning = "of the strength between bonds; left out: none"},
};
const brc_section brc_schema_strength = {
    .title = "strength",
    .meaning = "What the material bears, measured on a sample of it; used by scenes with `fracture`.",
    ENTRIES(STRENGTH),
    .short_key = "tension",
    .groups = {{BRC_GROUP_AT_LEAST_ONE, {"tension", "compression"}}}};

#define LEVEL_ENTRY                                                                                                    \
    {                                                                                                                  \
        "level", BRC_TYPE_INTEGER, WITHIN(0, 2), FIELD(brc_fracture, level),                                           \
            .given = "1", .meaning = "shells of neighbours over unbroken bonds that the stress is averaged over"       \
    }
#define SHEAR_ENTRIES                                                                                                  \
    {"cohesion",                                                                                                       \
     BRC_TYPE_QUANTITY,                                                                                                \
     "Pa",                                                                                                             \
     POSITIVE,                                                                                                         \
     FIELD(brc_fracture, cohesion),                                                                                    \
     .required = true,                                                                                                 \
     .sample = "100 MPa",                                                                                              \
     .meaning = "shear stress borne without normal stress, of every material"},                                        \
    {                                                                                                                  \
        "friction", BRC_TYPE_QUANTITY, "rad",                                                                          \
            .range = {0, M_PI / 2, false, true}, FIELD(brc_fracture, friction), .required = true, .sample = "30 deg",  \
            .why = "at 90 degrees it would bear any shear", .meaning = "angle of internal friction"                    \
    }
static const brc_entry PRINCIPAL[] = {LEVEL_ENTRY};
static const brc_section PRINCIPAL_SECTION = {.title = "virial-principal",
                                              .meaning =
                                                  "An element fails when the largest principal value of its virial "
                                                  "stress reaches the tensile strength of its material, or the "
                                                  "smallest one the compressive strength (Nguyen, Andre and Huger "
                                                  "2019, section 2.2). It loses one bond a step, the one nearest "
                                                  "to the direction of that principal value.",
                                              ENTRIES(PRINCIPAL)};
static const brc_entry MOHR_COULOMB[] = {SHEAR_ENTRIES, LEVEL_ENTRY};
static const brc_section MOHR_COULOMB_SECTION = {
    .title = "mohr-coulomb",
    .meaning = "As virial-principal, with strengths only where materials give them, and a limit on shear: (s1 - s3) + "
               "sin(friction) (s1 + s3) "
               "= 2 cohesion cos(friction). The bond is the one nearest to the normal of a slip plane. Model dlsm with "
               "a fracture energy: faces within 60 degrees of a slip plane "
               "soften by sliding along it, those of an interface along themselves, as the stress at the face reaches "
               "the limit; `level` counts for nothing.",
    ENTRIES(MOHR_COULOMB)};
static const brc_entry DRUCKER_PRAGER[] = {SHEAR_ENTRIES, LEVEL_ENTRY};
static const brc_section DRUCKER_PRAGER_SECTION = {
    .title = "drucker-prager",
    .meaning = "As mohr-coulomb, with the smooth cone sqrt(J2) + a I1 = k through its compressive edges.",
    ENTRIES(DRUCKER_PRAGER)};
static const brc_entry AUTO_CRITERION[] = {LEVEL_ENTRY};
static const brc_section AUTO_CRITERION_SECTION = {
    .title = "auto", .meaning = "bond-normal for cells, virial-principal for beams.", ENTRIES(AUTO_CRITERION)};
static const brc_entry CRITERION[] = {
    {"auto", BRC_TYPE_STRUCT, .section = &AUTO_CRITERION_SECTION, .value = BRC_CRITERION_AUTO,
     .meaning = "by the model"},
    {"bond-normal", BRC_TYPE_STRUCT, .value = BRC_CRITERION_BOND_NORMAL,
     .meaning = "normal stress of a bond: the mean stress of its two elements, with the bond's own elongation (Andre, "
                "Girardot and Hubert 2019, "
                "eq. 35); for cells"},
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
    {"criterion", BRC_TYPE_STRUCT, .section = &CRITERION_SECTION, .given = "auto", .meaning = "when bonds break"},
    {"closure", BRC_TYPE_BOOL, FIELD(brc_fracture, closure), .given = "true",
     .meaning = "the sides of a face or beam that broke bear on each other until they stand clear (where bonds break "
                "at once, only without `contact`, whose law takes them over), and brittle beams across a crack let "
                "go; false: neither"},
    {"friction", BRC_TYPE_QUANTITY, "", NOT_NEGATIVE, FIELD(brc_fracture, side_friction), .given = "auto",
     .word = "auto", .word_value = -1, .sample = "0.5",
     .meaning = "Coulomb friction of the sides of broken faces (model dlsm: bonds that break at once, and faces that "
                "slide by mohr-coulomb with a fracture energy; cbm: interfaces that break at once) in a scene without "
                "`contact`, which has a friction of its own; auto: 0.3"},
    {"seed", BRC_TYPE_INTEGER, WITHIN(0, 9e15), FIELD(brc_fracture, seed), .given = "1",
     .meaning = "of the strengths that scatter; the draw of a bond depends on its elements' ids only"},
};
const brc_section brc_schema_fracture = {
    .title = "fracture",
    .meaning = "Bonds break in dynamic stages, and by events in static ones; left out: they hold for ever. Materials "
               "without a strength do not break: bonds "
               "between one of them and another break by the other's. `fracture: true` takes all defaults.",
    ENTRIES(FRACTURE)};

#define INTERFACE_ENTRIES                                                                                              \
    {"factor",                                                                                                         \
     BRC_TYPE_QUANTITY,                                                                                                \
     "",                                                                                                               \
     POSITIVE,                                                                                                         \
     FIELD(brc_interface, factor),                                                                                     \
     .sample = "50 %",                                                                                                 \
     .meaning = "on the strength and the fracture energy of the weaker side"},                                         \
        {"tension",          BRC_TYPE_QUANTITY,        "Pa", POSITIVE, FIELD(brc_interface, tension),                  \
         .sample = "20 MPa", .meaning = "its strength"},                                                               \
    {                                                                                                                  \
        "fracture_energy", BRC_TYPE_QUANTITY, "J/m^2", POSITIVE, FIELD(brc_interface, fracture_energy),                \
            .sample = ENERGY_SAMPLE,                                                                                   \
            .meaning = "energy per area of a crack along it; left out: that of the weaker side, times the factor"      \
    }
#define INTERFACE_GROUPS                                                                                               \
    .groups = {{BRC_GROUP_AT_LEAST_ONE, {"factor", "tension", "fracture_energy"}},                                     \
               {BRC_GROUP_AT_MOST_ONE, {"factor", "tension"}}}
static const brc_entry GRAINS[] = {INTERFACE_ENTRIES};
static const brc_section GRAINS_SECTION = {.title = "interface of grains",
                                           .meaning = "Bonds between elements of different grains.",
                                           ENTRIES(GRAINS),
                                           INTERFACE_GROUPS};
static const brc_entry MATERIALS[] = {
    {"first", BRC_TYPE_MATERIAL, FIELD(brc_interface, material[0]), .required = true, .sample = "glass",
     .meaning = "one side"},
    {"second", BRC_TYPE_MATERIAL, FIELD(brc_interface, material[1]), .required = true, .sample = "glass",
     .meaning = "the other side"},
    INTERFACE_ENTRIES,
};
static const brc_section MATERIALS_SECTION = {.title = "interface of materials",
                                              .meaning = "Bonds between elements of two materials.",
                                              ENTRIES(MATERIALS),
                                              INTERFACE_GROUPS};
static const brc_entry INTERFACE[] = {
    {"grains", BRC_TYPE_STRUCT, .section = &GRAINS_SECTION, .value = BRC_INTERFACE_GRAINS,
     .meaning = "between grains of a body"},
    {"materials", BRC_TYPE_STRUCT, .section = &MATERIALS_SECTION, .value = BRC_INTERFACE_MATERIALS,
     .meaning = "between two materials"},
};
static const brc_section INTERFACE_SECTION = {
    .title = "interface",
    .meaning = "Bonds with a strength of their own; later ones win. For scenes with `fracture`.",
    ENTRIES(INTERFACE),
    .size = sizeof(brc_interface),
    .one_of = true,
    .has_kind = true,
    .kind_offset = offsetof(brc_interface, kind)};
static const brc_entry INTERACTIONS[] = {
    {"interfaces", BRC_TYPE_LIST, .section = &INTERFACE_SECTION, COUNTED(brc_scene, interfaces, n_interfaces),
     .meaning = "bonds between materials or grains"},
    {"contact", BRC_TYPE_STRUCT, .section = &brc_schema_contact, FLAG(brc_scene, has_contact),
     .meaning = "surfaces that meet touch"},
};
const brc_section brc_schema_interactions = {
    .title = "interactions", .meaning = "What joins parts of the solids.", ENTRIES(INTERACTIONS)};
