/* Schema: the top of a scene, and small questions to entries. */
#include "schema_internal.h"
#include <stdio.h>
#include <string.h>

static const brc_entry GUARD[] = {
    {"every", BRC_TYPE_INTEGER, WITHIN(1, 1e12), FIELD(brc_guard, every), .given = "auto", .word = "auto",
     .sample = "1000", .meaning = "steps between looks at the energy ledger and at every element"},
    {"closure", BRC_TYPE_QUANTITY, "", POSITIVE, FIELD(brc_guard, closure), .given = "off", .word = "off",
     .sample = "5 %",
     .meaning = "largest error of the energy ledger; off: only runs that run away, gain by losses or are not finite "
                "stop"},
};
static const brc_section GUARD_SECTION = {
    .title = "guard", .meaning = "Stops a run that goes wrong, and says where.", ENTRIES(GUARD)};

static const brc_entry SCENE[] = {
    {"version", BRC_TYPE_INTEGER, WITHIN(1, 1), FIELD(brc_scene, version), .required = true, .sample = "1",
     .why = "this breccia reads format 1", .meaning = "of the scene format"},
    {"title", BRC_TYPE_STRING, FIELD(brc_scene, title), .sample = "A cube under tension", .meaning = "one line"},
    {"materials", BRC_TYPE_NAMED, .section = &brc_schema_material, COUNTED(brc_scene, materials, n_materials),
     .spare = 1, .required = true, .sample = "{glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3}}",
     .meaning = "materials by name"},
    {"model", BRC_TYPE_STRUCT, .section = &brc_schema_model, .offset = offsetof(brc_scene, model), .given = "dlsm",
     .meaning = "the law between the elements"},
    {"bodies", BRC_TYPE_LIST, .section = &brc_schema_body, COUNTED(brc_scene, bodies, n_bodies), .required = true,
     .sample = "[{shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 1000}}}]",
     .meaning = "the solids"},
    {"sets", BRC_TYPE_NAMED, .section = &brc_schema_set, COUNTED(brc_scene, sets, n_sets),
     .meaning = "named parts, besides the walls"},
    {"quality", BRC_TYPE_NAMED, .section = &brc_schema_limit, COUNTED(brc_scene, limits, n_limits),
     .meaning = "limits on the numbers of the quality report, by name; each body is judged as it is built"},
    {"fracture", BRC_TYPE_STRUCT, .section = &brc_schema_fracture, .offset = offsetof(brc_scene, fracture),
     FLAG(brc_scene, has_fracture), .meaning = "how bonds break"},
    {"strikers", BRC_TYPE_NAMED, .section = &brc_schema_striker, COUNTED(brc_scene, strikers, n_strikers),
     .spare = BRC_FIXTURE_STRIKERS, .meaning = "rigid walls and strikers, by name"},
    {"platens", BRC_TYPE_STRUCT, .section = &brc_schema_platens, .offset = offsetof(brc_scene, platens),
     FLAG(brc_scene, platens.given), .another = true, .meaning = "two flat platens of a testing machine, in one line"},
    {"jaws", BRC_TYPE_STRUCT, .section = &brc_schema_jaws, .offset = offsetof(brc_scene, jaws),
     FLAG(brc_scene, jaws.given), .another = true, .meaning = "two hollow jaws, as of a Brazilian test"},
    {"rollers", BRC_TYPE_STRUCT, .section = &brc_schema_rollers, .offset = offsetof(brc_scene, rollers),
     FLAG(brc_scene, rollers.given), .another = true, .meaning = "three rollers that bend a beam"},
    {"interactions", BRC_TYPE_STRUCT, .section = &brc_schema_interactions,
     .meaning = "what joins materials and grains, and how surfaces touch"},
    {"guard", BRC_TYPE_STRUCT, .section = &GUARD_SECTION, .offset = offsetof(brc_scene, guard), .given = "{}",
     .meaning = "what stops a run that goes wrong"},
    {"accuracy", BRC_TYPE_QUANTITY, "", STRICTLY_WITHIN(0, 1), FIELD(brc_scene, accuracy), .sample = "1 %",
     .meaning = "wanted relative error: `breccia check` proposes resolution, precision and time step for it"},
    {"budget", BRC_TYPE_QUANTITY, "s", POSITIVE, FIELD(brc_scene, budget), .sample = "10 min",
     .meaning = "wanted time of the run: `breccia check` proposes what it buys"},
    {"gravity", BRC_TYPE_VECTOR, "m/s^2", FIELD(brc_scene, gravity), .length = 3, FLAG(brc_scene, has_gravity),
     .sample = "[0, 0, -9.81 m/s^2]", .meaning = "acceleration of every element"},
    {"stages", BRC_TYPE_LIST, .section = &brc_schema_stage, COUNTED(brc_scene, stages, n_stages), .required = true,
     .sample = "[{name: pull, solver: static}]", .meaning = "what happens, one after the other"},
    {"output", BRC_TYPE_STRUCT, .section = &brc_schema_output, .offset = offsetof(brc_scene, output), .given = "{}",
     .meaning = "frames, histories, picture and curve"},
    {"sensors", BRC_TYPE_NAMED, .section = &brc_schema_sensor, COUNTED(brc_scene, sensors, n_sensors),
     .spare = BRC_FIXTURE_SENSORS, .meaning = "numbers watched through the run, by name"},
    {"measure", BRC_TYPE_NAMED, .section = &brc_schema_measure, COUNTED(brc_scene, measures, n_measures),
     .meaning = "numbers computed from sensors when the run ends, by name"},
};
static const brc_section SCENE_SECTION = {.title = "scene",
                                          .meaning = "The top of a scene file.",
                                          ENTRIES(SCENE),
                                          .size = sizeof(brc_scene),
                                          .groups = {{BRC_GROUP_AT_MOST_ONE, {"accuracy", "budget"}}}};

const brc_section *brc_schema(void)
{
    return &SCENE_SECTION;
}

const brc_entry *brc_section_find(const brc_section *section, const char *key)
{
    for (int i = 0; section && i < section->n_entries; ++i)
        if (strcmp(section->entries[i].key, key) == 0) return &section->entries[i];
    return NULL;
}

bool brc_entry_has_range(const brc_entry *entry)
{
    return entry->range.low != 0 || entry->range.high != 0;
}

bool brc_range_contains(const brc_entry *entry, double value)
{
    if (!brc_entry_has_range(entry)) return true;
    const brc_range *range = &entry->range;
    if (range->low_open ? !(value > range->low) : !(value >= range->low)) return false;
    return range->high_open ? value < range->high : value <= range->high;
}

bool brc_entry_is_switch(const brc_entry *entry)
{
    const brc_section *section = entry->section;
    if (entry->type != BRC_TYPE_STRUCT || !entry->has_flag || !section || section->one_of || section->short_key)
        return false;
    for (int i = 0; i < section->n_entries; ++i)
        if (section->entries[i].required) return false;
    for (size_t g = 0; g < sizeof section->groups / sizeof section->groups[0]; ++g)
        if (section->groups[g].rule == BRC_GROUP_EXACTLY_ONE || section->groups[g].rule == BRC_GROUP_AT_LEAST_ONE)
            return false;
    return true;
}

const char *brc_range_text(const brc_entry *entry, char *out, size_t size)
{
    const brc_range *range = &entry->range;
    const char *unit = entry->unit && entry->unit[0] != '@' ? entry->unit : "";
    const char *blank = unit[0] ? " " : "";
    if (!brc_entry_has_range(entry))
        out[0] = '\0';
    else if (isinf(range->high))
        snprintf(out, size, "%s %.12g%s%s", range->low_open ? ">" : ">=", range->low, range->low != 0 ? blank : "",
                 range->low != 0 ? unit : "");
    else if (range->low == range->high)
        snprintf(out, size, "%.12g", range->low);
    else
        snprintf(out, size, "in %c%.12g, %.12g%c%s%s", range->low_open ? '(' : '[', range->low, range->high,
                 range->high_open ? ')' : ']', blank, unit);
    return out;
}
