/* Schema: tools of a testing machine, which become strikers, sensors and a law of contact (reader_fixtures.c). */
#include "schema_internal.h"

#define COMMON_ENTRIES                                                                                                 \
    {"body",                                                                                                           \
     BRC_TYPE_NAME,                                                                                                    \
     FIELD(brc_fixture, body),                                                                                         \
     .refers = BRC_REFERS_BODY,                                                                                        \
     .sample = "body",                                                                                                 \
     .meaning = "what is pressed; may be left out where the scene has only one"},                                      \
        {"axis",           BRC_TYPE_CHOICE, FIELD(brc_fixture, axis),           CHOICES("x", "y", "z"),                \
         .required = true, .sample = "y",   .meaning = "along which it presses"},                                      \
        {"speed",                                                                                                      \
         BRC_TYPE_QUANTITY,                                                                                            \
         "m/s",                                                                                                        \
         POSITIVE,                                                                                                     \
         FIELD(brc_fixture, speed),                                                                                    \
         .sample = "20 mm/s",                                                                                          \
         .meaning = "at which both sides come together, whatever resists"},                                            \
        {"force",                                                                                                      \
         BRC_TYPE_QUANTITY,                                                                                            \
         "N",                                                                                                          \
         POSITIVE,                                                                                                     \
         FIELD(brc_fixture, force),                                                                                    \
         .sample = "10 kN",                                                                                            \
         .meaning = "in place of the speed: what presses each tool that moves, however the body gives way; it moves "  \
                    "along the axis only"},                                                                            \
        {"mass",                                                                                                       \
         BRC_TYPE_QUANTITY,                                                                                            \
         "kg",                                                                                                         \
         POSITIVE,                                                                                                     \
         FIELD(brc_fixture, mass),                                                                                     \
         .sample = "1 kg",                                                                                             \
         .meaning = "of each tool that is pressed by the force; left out: volume times density of its material"},      \
        {"ramp",                                                                                                       \
         BRC_TYPE_QUANTITY,                                                                                            \
         "s",                                                                                                          \
         POSITIVE,                                                                                                     \
         FIELD(brc_fixture, ramp),                                                                                     \
         .sample = "1 ms",                                                                                             \
         .meaning =                                                                                                    \
             "time in which speed or force rises from 0; left out: at once, which sends a wave through the body"},     \
        {"friction",                                                                                                   \
         BRC_TYPE_QUANTITY,                                                                                            \
         "",                                                                                                           \
         NOT_NEGATIVE,                                                                                                 \
         FIELD(brc_fixture, friction),                                                                                 \
         FLAG(brc_fixture, has_friction),                                                                              \
         .sample = "0.3",                                                                                              \
         .meaning = "between tools and body; left out: that of `interactions: {contact: ...}`, which is also that of " \
                    "crack faces and fragments"},                                                                      \
        {"material",                                                                                                   \
         BRC_TYPE_MATERIAL,                                                                                            \
         FIELD(brc_fixture, material),                                                                                 \
         FLAG(brc_fixture, has_material),                                                                              \
         .sample = "glass",                                                                                            \
         .meaning = "of the tools; left out: `steel` of the scene, or one with E 210 GPa, nu 0.3, 7850 kg/m^3"},       \
    {                                                                                                                  \
        "gap", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fixture, gap),                                              \
            .given = "auto", .word = "auto", .sample = "1 um",                                                         \
            .meaning =                                                                                                 \
                "between tools and body as the scene starts; auto: none, at round walls what their cells stand out"    \
    }

#define MOVES_ENTRY(tool)                                                                                              \
    {                                                                                                                  \
        "moves", BRC_TYPE_CHOICE, FIELD(brc_fixture, moves), CHOICES("high", "low", "both"),                           \
            .given = "high",                                                                                           \
            .meaning = "the " tool " at the larger coordinate, the one at the smaller, or both, each with half the "   \
                       "speed or with the whole force"                                                                 \
    }

static const brc_entry PLATENS[] = {COMMON_ENTRIES, MOVES_ENTRY("platen")};
const brc_section brc_schema_platens = {
    .title = "platens",
    .meaning = "Two flat platens press a body between them. They become the strikers `platen_low` and `platen_high`, "
               "the sensors `platens_force`, `platens_reaction` (on the "
               "high and on the low one) and `platens_displacement` (how far they came together), all positive in "
               "compression, the measure `platens_peak_force` "
               "and, where there is none, the `curve` of force over displacement.",
    ENTRIES(PLATENS),
    .groups = {{BRC_GROUP_EXACTLY_ONE, {"speed", "force"}}}};
static const brc_entry JAWS[] = {
    COMMON_ENTRIES,
    MOVES_ENTRY("jaw"),
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fixture, radius), .sample = "40 mm",
     .meaning = "of the hollow face; discs of rock are pressed by jaws of 1.5 times their own (ISRM)"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fixture, radius), .another = true, .factor = 0.5,
     .sample = "80 mm", .meaning = "twice the radius, in its place"},
    {"width", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fixture, width), .given = "auto", .word = "auto",
     .sample = "20 mm", .meaning = "of a jaw; auto: half that of the body"},
};
const brc_section brc_schema_jaws = {
    .title = "jaws",
    .meaning = "Two jaws with hollow faces press a disc or cylinder, as in a Brazilian test. They become `jaw_low` and "
               "`jaw_high`, with sensors and measure as of platens: "
               "`jaws_force`, `jaws_reaction`, `jaws_displacement`, `jaws_peak_force`.",
    ENTRIES(JAWS),
    .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}, {BRC_GROUP_EXACTLY_ONE, {"speed", "force"}}}};
static const brc_entry ROLLERS[] = {
    COMMON_ENTRIES,
    {"moves", BRC_TYPE_CHOICE, FIELD(brc_fixture, moves), CHOICES("high", "low"), .given = "high",
     .meaning = "where the load is, with the supports on the other side; high: at the larger coordinate"},
    {"span", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fixture, span), .required = true, .sample = "400 mm",
     .meaning = "between the axes of the two supports, about the middle of the body"},
    {"along", BRC_TYPE_CHOICE, FIELD(brc_fixture, along), CHOICES("auto", "x", "y", "z"), .given = "auto",
     .meaning = "direction of the span; auto: along which the body is longest"},
    {"radius", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fixture, radius), .sample = "10 mm",
     .meaning = "of the rollers"},
    {"diameter", BRC_TYPE_QUANTITY, "m", POSITIVE, FIELD(brc_fixture, radius), .another = true, .factor = 0.5,
     .sample = "20 mm", .meaning = "twice the radius, in its place"},
};
const brc_section brc_schema_rollers = {
    .title = "rollers",
    .meaning = "Bending in three points: a roller presses in the middle of a beam that lies on two others. They become "
               "`roller_load`, `roller_left` and `roller_right` (at the "
               "smaller and the larger coordinate along the span), with the sensors `rollers_force` and "
               "`rollers_displacement` of the load and the measure `rollers_peak_force`.",
    ENTRIES(ROLLERS),
    .groups = {{BRC_GROUP_EXACTLY_ONE, {"radius", "diameter"}}, {BRC_GROUP_EXACTLY_ONE, {"speed", "force"}}}};
