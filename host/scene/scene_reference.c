/* docs/reference/scene.md, written from the schema table. */
#include "scene_reader.h"
#include "reader_internal.h"
#include <ctype.h>
#include <string.h>

#define MANY_SECTIONS 512

static const char INTRODUCTION[] =
    "# Scene files\n"
    "\n"
    "Written by the program from its schema table; do not edit. A scene is one YAML document (UTF-8, at most 16 MB)\n"
    "with the keys below. The order of keys is free.\n"
    "\n"
    "**Quantities** carry their unit: `72 GPa`, `2500 kg/m^3`, `5 us`, `0.1 rad/m`, `90 %`. A number without a unit\n"
    "is an error where a dimension is due, unless it is 0. Units are products and quotients of m, g, s, N, Pa, J, W,\n"
    "Hz and rad with the SI prefixes (u for micro), and of deg, min, h and %, with powers: `N/m^2`, `m s^-2`, `1/s`.\n"
    "Angles are a dimension of their own. Each item of a vector has its own unit: `[1 mm, 2 mm, 0]`.\n"
    "Numbers are decimal; nan, inf and hexadecimal are refused, and so is anything after the unit.\n"
    "\n"
    "**One of** several: a map of exactly one key names the choice, `solver: {static: {increments: 4}}`; the word "
    "alone\n"
    "takes all its defaults, `solver: static`.\n"
    "\n"
    "**Names** are made of letters, digits and `_` `+` `-`. Each wall of a shape is a set of faces of that name,\n"
    "each body a set of elements.\n"
    "\n"
    "**Signs**: forces, displacements, velocities and tractions are components along the axes of the scene, of loads and of\n"
    "sensors alike. A reaction is what the load does to the solid: a wall x+ that is pulled reads positive, one that is pressed\n"
    "negative, and the wall x- the other way round. The force of a striker is what the bodies do to it: platens above push up.\n"
    "Stress and strain are positive in tension. A `pressure` is positive where it pushes into the solid, strengths in\n"
    "`compression` are positive numbers, an `opening` is positive where it opens. A sensor with `sign: compression` is positive\n"
    "where the solid is compressed, whatever the side: a force that pushes, a wall that moves in, a stress of compression.\n"
    "\n"
    "**Overrides**: `--set bodies.0.fill.noisy_grid.elements=1000`; lists by index from 0 or by the `name` of an "
    "item.\n"
    "\n"
    "All errors are told in one pass, as `file:line:column: error: ...`. What is no error but hardly meant\n"
    "is logged as `warning: file:line:column: ...`. Duplicate keys, tags, and more than one\n"
    "document are refused; anchors and aliases work. `breccia check --all` prints a scene with all its defaults.\n";

static const char *type_text(const brc_entry *entry, char *out, size_t size)
{
    const bool pure = !entry->unit || entry->unit[0] == '\0';
    size_t at = 0;
    switch (entry->type) {
    case BRC_TYPE_QUANTITY: return pure ? "number" : "quantity";
    case BRC_TYPE_VECTOR:
        snprintf(out, size, "list of %d %s", entry->length, pure ? "numbers" : "quantities");
        return out;
    case BRC_TYPE_DIRECTION: return "direction: 3 numbers, not all 0";
    case BRC_TYPE_INTEGER: return "whole number";
    case BRC_TYPE_INTEGERS: snprintf(out, size, "list of %d whole numbers", entry->length); return out;
    case BRC_TYPE_BOOL: return "true or false";
    case BRC_TYPE_STRING: return "text";
    case BRC_TYPE_NAME: break;
    case BRC_TYPE_MATERIAL: return "name of a material";
    case BRC_TYPE_TABLE: return "list of pairs [time, factor]";
    case BRC_TYPE_WORD:
    case BRC_TYPE_CHOICE:
        out[0] = '\0';
        for (int i = 0; entry->choices[i] && at < size; ++i)
            at += (size_t)snprintf(out + at, size - at, "%s`%s`", i ? ", " : "", entry->choices[i]);
        return out;
    case BRC_TYPE_STRUCT:
    case BRC_TYPE_LIST:
    case BRC_TYPE_NAMED: break;
    }
    switch (entry->refers) {
    case BRC_REFERS_FACES: return "name of a wall or of a set of faces";
    case BRC_REFERS_ELEMENTS: return "name of a body or of a set of elements";
    case BRC_REFERS_SET: return "name of a wall, a body or a set";
    case BRC_REFERS_WALL: return "name of a wall";
    case BRC_REFERS_SENSOR: return "name of a sensor";
    case BRC_REFERS_STAGE: return "name of a stage";
    case BRC_REFERS_STRIKER: return "name of a striker";
    case BRC_REFERS_BODY: return "name of a body";
    case BRC_REFERS_NOTHING: break;
    }
    return "name";
}

/* Link to a section's heading, as GitHub and most renderers make anchors. */
static void write_link(FILE *file, const brc_section *section)
{
    fprintf(file, "[%s](#", section->title);
    for (const char *c = section->title; *c; ++c)
        if (*c == ' ')
            fputc('-', file);
        else if (isalnum((unsigned char)*c) || *c == '-' || *c == '_')
            fputc(tolower((unsigned char)*c), file);
    fputs(")", file);
}

static void write_unit(FILE *file, const brc_entry *entry)
{
    const char *unit = entry->unit ? entry->unit : "";
    if (strcmp(unit, BRC_UNIT_STAGE_TIME) == 0 || strcmp(unit, BRC_UNIT_MEASURE_TIME) == 0)
        fputs("s; static: fraction", file);
    else if (strcmp(unit, BRC_UNIT_MEASURE) == 0)
        fputs("of the measure", file);
    else
        fputs(unit, file);
}

static void write_row(FILE *file, const brc_section *section, const brc_entry *entry)
{
    char text[512];
    fprintf(file, "| `%s` | ", entry->key);
    if (entry->type == BRC_TYPE_STRUCT && !entry->section)
        fputs("the word alone", file);
    else if (entry->section) {
        fputs(entry->type == BRC_TYPE_LIST    ? "list of "
              : entry->type == BRC_TYPE_NAMED ? "map of names to "
                                              : "",
              file);
        write_link(file, entry->section);
        if (brc_entry_is_switch(entry)) fputs(", or `true` for all its defaults, or `false`", file);
    } else
        fputs(type_text(entry, text, sizeof text), file);
    fputs(" | ", file);
    write_unit(file, entry);
    fprintf(file, " | %s%s%s%s | ", brc_range_text(entry, text, sizeof text), entry->word ? " or `" : "",
            entry->word ? entry->word : "", entry->word ? "`" : "");
    if (section->one_of)
        fputs(" | ", file);
    else if (entry->required)
        fputs("required | ", file);
    else if (entry->given)
        fprintf(file, "`%s` | ", entry->given);
    else
        fputs("- | ", file);
    fprintf(file, "%s%s%s", entry->meaning, entry->why ? "; " : "", entry->why ? entry->why : "");
    if (entry->sample) fprintf(file, "; as in `%s: %s`", entry->key, entry->sample);
    fputs(" |\n", file);
}

static void write_groups(FILE *file, const brc_section *section)
{
    for (size_t g = 0; g < sizeof section->groups / sizeof section->groups[0]; ++g) {
        const brc_group *group = &section->groups[g];
        if (group->rule == BRC_GROUP_NONE) continue;
        fputs(group->rule == BRC_GROUP_EXACTLY_ONE    ? "\nExactly one of"
              : group->rule == BRC_GROUP_AT_LEAST_ONE ? "\nAt least one of"
                                                      : "\nAt most one of",
              file);
        for (int k = 0; group->keys[k]; ++k)
            fprintf(file, "%s `%s`", k ? "," : "", group->keys[k]);
        fputs(".\n", file);
    }
}

/* A section, then those it leads to that have not been written. */
static void write_section(FILE *file, const brc_section *section, const brc_section **written, int *n)
{
    for (int i = 0; i < *n; ++i)
        if (written[i] == section) return;
    if (*n == MANY_SECTIONS) return;
    written[(*n)++] = section;
    fprintf(file, "\n## %s\n\n%s%s\n\n", section->title, section->meaning, section->one_of ? " One of:" : "");
    fputs("| key | what | unit | range | default | meaning |\n| --- | --- | --- | --- | --- | --- |\n", file);
    for (int i = 0; i < section->n_entries; ++i)
        write_row(file, section, &section->entries[i]);
    write_groups(file, section);
    if (section->short_key) fprintf(file, "\nA single value in place of the map is its `%s`.\n", section->short_key);
    for (int i = 0; i < section->n_entries; ++i)
        if (section->entries[i].section) write_section(file, section->entries[i].section, written, n);
}

brc_status brc_scene_write_reference(brc_context *context, FILE *file)
{
    const brc_section *written[MANY_SECTIONS];
    int n = 0;
    fputs(INTRODUCTION, file);
    write_section(file, brc_schema(), written, &n);
    if (n == MANY_SECTIONS)
        return BRC_FAIL(context, BRC_INTERNAL, "the schema has more sections than the scene reference has room for; raise MANY_SECTIONS");
    if (fflush(file) != 0 || ferror(file))
        return BRC_FAIL(context, BRC_FILE_FAILED, "the scene reference cannot be written");
    return BRC_OK;
}
