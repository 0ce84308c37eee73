/* The pages of docs/reference/scene, written from the schema table. */
#include "scene_reader.h"
#include "schema_internal.h"
#include <ctype.h>
#include <string.h>

#define MANY_SECTIONS 512

/* A page and the sections it begins with; with these come the sections they lead to that no other page begins with. */
typedef struct page_plan {
    const char *name, *title, *meaning;
    const brc_section *roots[6];
} page_plan;

static const page_plan PAGES[] = {
    {"README", "Scene files", "", {NULL}}, /* the top of the schema */
    {"materials", "Materials", "elastic constants, strengths, scatter, beams", {&brc_schema_material}},
    {"model", "Model", "the law between the elements", {&brc_schema_model}},
    {"bodies", "Bodies", "pose, regions, grains, cracks, limits on quality", {&brc_schema_body, &brc_schema_limit}},
    {"shapes", "Shapes", "boxes to STL files, and what is made of parts", {&brc_schema_shape}},
    {"fill", "Fill", "cells or spheres: how many and how even", {&brc_schema_fill}},
    {"sets", "Sets", "names for parts of the walls and of the inside", {&brc_schema_set, &brc_schema_predicate}},
    {"fracture",
     "Fracture",
     "when bonds break, and strengths of interfaces",
     {&brc_schema_fracture, &brc_schema_interactions}},
    {"contact",
     "Contact and strikers",
     "surfaces that meet, platens, jaws, rollers, walls, projectiles",
     {&brc_schema_contact, &brc_schema_striker, &brc_schema_platens, &brc_schema_jaws, &brc_schema_rollers}},
    {"stages", "Stages", "static, dynamic and modal solvers, and the guard of a run", {&brc_schema_stage, NULL}},
    {"initial", "Initial fields", "displacements and velocities that a stage begins with", {&brc_schema_initial}},
    {"loads", "Loads", "what holds and pulls during a stage", {&brc_schema_load}},
    {"sensors", "Sensors", "numbers watched through a run", {&brc_schema_sensor}},
    {"measures", "Measures", "numbers computed from sensors at the end", {&brc_schema_measure}},
    {"output", "Output", "frames, histories, pictures, checkpoints", {&brc_schema_output}},
};
#define N_PAGES ((int)(sizeof PAGES / sizeof PAGES[0]))

/* Every section with its page. */
typedef struct reference {
    struct {
        const brc_section *section;
        int page;
    } placed[MANY_SECTIONS];
    int n_placed;
} reference;

static const char INTRODUCTION[] =
    "# Scene files\n"
    "\n"
    "A scene is one YAML document (UTF-8, at most 16 MB) with the keys below. The order of keys is free. These pages "
    "are\n"
    "written by the program from the table that it reads scenes with; do not edit them.\n"
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
    "each body the set of its elements, and of its free faces where a load wants faces.\n"
    "\n"
    "**Signs**: forces, displacements, velocities and tractions are components along the axes of the scene, of loads "
    "and of\n"
    "sensors alike. A reaction is what the load does to the solid: a wall x+ that is pulled reads positive, one that "
    "is pressed\n"
    "negative, and the wall x- the other way round. The force of a striker is what the bodies do to it: platens above "
    "push up.\n"
    "Stress and strain are positive in tension. A `pressure` is positive where it pushes into the solid, strengths in\n"
    "`compression` are positive numbers, an `opening` is positive where it opens. A sensor with `sign: compression` is "
    "positive\n"
    "where the solid is compressed, whatever the side: a force that pushes, a wall that moves in, a stress of "
    "compression.\n"
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
    case BRC_REFERS_FACES: return "name of a wall, of a set of faces or of a body";
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

static int page_of_root(const brc_section *section)
{
    for (int p = 0; p < N_PAGES; ++p)
        for (int r = 0; r < 6; ++r)
            if (PAGES[p].roots[r] == section) return p;
    return -1;
}

/* Puts a section, and those it leads to that have no page yet, on a page. */
static void place(reference *all, const brc_section *section, int page)
{
    for (int i = 0; i < all->n_placed; ++i)
        if (all->placed[i].section == section) return;
    if (all->n_placed == MANY_SECTIONS) return;
    all->placed[all->n_placed].section = section;
    all->placed[all->n_placed++].page = page;
    for (int i = 0; i < section->n_entries; ++i) {
        const brc_section *next = section->entries[i].section;
        if (next && page_of_root(next) < 0) place(all, next, page);
    }
}

static int page_named(const char *name)
{
    for (int p = 0; p < N_PAGES; ++p)
        if (strcmp(PAGES[p].name, name) == 0) return p;
    return 0;
}

static brc_status place_all(brc_context *context, reference *all)
{
    all->n_placed = 1;
    all->placed[0].section = brc_schema();
    all->placed[0].page = 0;
    for (int p = 1; p < N_PAGES; ++p)
        for (int r = 0; r < 6 && PAGES[p].roots[r]; ++r)
            place(all, PAGES[p].roots[r], p);
    for (int i = 0; i < brc_schema()->n_entries; ++i) /* what no page begins with: the guard */
        if (brc_schema()->entries[i].section && page_of_root(brc_schema()->entries[i].section) < 0)
            place(all, brc_schema()->entries[i].section, page_named("stages"));
    if (all->n_placed == MANY_SECTIONS)
        return BRC_FAIL(context, BRC_INTERNAL,
                        "the schema has more sections than the scene reference has room for; raise MANY_SECTIONS");
    return BRC_OK;
}

static int page_of(const reference *all, const brc_section *section)
{
    for (int i = 0; i < all->n_placed; ++i)
        if (all->placed[i].section == section) return all->placed[i].page;
    return 0;
}

/* Link from a page to a section's heading, as GitHub and most renderers make anchors. */
static void write_link(FILE *file, const reference *all, int from, const brc_section *section)
{
    const int to = page_of(all, section);
    fprintf(file, "[%s](", section->title);
    if (to != from) fprintf(file, "%s.md", PAGES[to].name);
    fputc('#', file);
    for (const char *c = section->title; *c; ++c)
        if (*c == ' ')
            fputc('-', file);
        else if (isalnum((unsigned char)*c) || *c == '-' || *c == '_')
            fputc(tolower((unsigned char)*c), file);
    fputs(")", file);
}

static const char *unit_text(const brc_entry *entry)
{
    const char *unit = entry->unit ? entry->unit : "";
    if (strcmp(unit, BRC_UNIT_STAGE_TIME) == 0 || strcmp(unit, BRC_UNIT_MEASURE_TIME) == 0)
        return "s; static: fraction";
    return strcmp(unit, BRC_UNIT_MEASURE) == 0 ? "unit of the measure" : unit;
}

/* What an entry takes: kind, unit, range. */
static void write_kind(FILE *file, const reference *all, int page, const brc_entry *entry)
{
    char text[512];
    if (entry->type == BRC_TYPE_STRUCT && !entry->section)
        fputs("the word alone", file);
    else if (entry->section) {
        fputs(entry->type == BRC_TYPE_LIST    ? "list of "
              : entry->type == BRC_TYPE_NAMED ? "map of names to "
                                              : "",
              file);
        write_link(file, all, page, entry->section);
        if (brc_entry_is_switch(entry)) fputs(", or `true` for all its defaults, or `false`", file);
    } else
        fputs(type_text(entry, text, sizeof text), file);
    if (unit_text(entry)[0]) fprintf(file, ", %s", unit_text(entry));
    if (brc_range_text(entry, text, sizeof text)[0]) fprintf(file, ", %s", text);
    if (entry->word) fprintf(file, " or `%s`", entry->word);
}

static void write_item(FILE *file, const reference *all, int page, const brc_section *section, const brc_entry *entry)
{
    if (section->one_of && entry->section && strcmp(entry->key, entry->section->title) == 0) {
        fputs("- ", file);
        write_link(file, all, page, entry->section);
        fprintf(file, ": %s\n", entry->meaning);
        return;
    }
    fprintf(file, "- `%s` (", entry->key);
    write_kind(file, all, page, entry);
    if (!section->one_of && entry->required)
        fputs("; required", file);
    else if (!section->one_of && entry->given)
        fprintf(file, "; default `%s`", entry->given);
    fprintf(file, "): %s%s%s", entry->meaning, entry->why ? "; " : "", entry->why ? entry->why : "");
    const bool telling =
        entry->type != BRC_TYPE_NAME && entry->type != BRC_TYPE_MATERIAL && entry->type != BRC_TYPE_STRING;
    if (telling && entry->sample && !(entry->given && strcmp(entry->given, entry->sample) == 0))
        fprintf(file, "; e.g. `%s`", entry->sample);
    fputs("\n", file);
}

/* Does an earlier section of the page have the same key? */
static bool same_key(const brc_section *section, const brc_entry *entry, const brc_section *earlier)
{
    const brc_entry *other = brc_section_find(earlier, entry->key);
    const char *given = entry->given ? entry->given : "";
    return other && section->one_of == earlier->one_of && other->type == entry->type &&
           other->section == entry->section && other->refers == entry->refers && other->required == entry->required &&
           other->length == entry->length && memcmp(&other->range, &entry->range, sizeof entry->range) == 0 &&
           strcmp(unit_text(other), unit_text(entry)) == 0 && strcmp(other->given ? other->given : "", given) == 0 &&
           strcmp(other->meaning, entry->meaning) == 0;
}

static int n_same(const brc_section *section, const brc_section *earlier)
{
    int n = 0;
    for (int i = 0; i < section->n_entries; ++i)
        n += same_key(section, &section->entries[i], earlier);
    return n;
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

/* The earlier section of the page with the most keys in common, which are named then and not written again; NULL when
 * there are none. */
static const brc_section *alike(const reference *all, int at)
{
    const brc_section *best = NULL;
    int most = 0;
    for (int i = 0; i < at; ++i)
        if (all->placed[i].page == all->placed[at].page) {
            const int n = n_same(all->placed[at].section, all->placed[i].section);
            if (n > most) {
                most = n;
                best = all->placed[i].section;
            }
        }
    return best;
}

static void write_section(FILE *file, const reference *all, int at)
{
    const brc_section *section = all->placed[at].section, *earlier = alike(all, at);
    const int page = all->placed[at].page;
    fprintf(file, "\n## %s\n\n%s%s\n\n", section->title, section->meaning, section->one_of ? " One of:" : "");
    for (int i = 0; i < section->n_entries; ++i)
        if (!earlier || !same_key(section, &section->entries[i], earlier))
            write_item(file, all, page, section, &section->entries[i]);
    if (earlier) {
        fputs(n_same(section, earlier) < section->n_entries ? "\nFurther keys, as in " : "As in ", file);
        write_link(file, all, page, earlier);
        const char *between = ": ";
        for (int i = 0; i < section->n_entries; ++i)
            if (same_key(section, &section->entries[i], earlier)) {
                fprintf(file, "%s`%s`", between, section->entries[i].key);
                between = ", ";
            }
        fputs(".\n", file);
    }
    write_groups(file, section);
    if (section->short_key) fprintf(file, "\nA single value in place of the map is its `%s`.\n", section->short_key);
}

int brc_scene_n_pages(void)
{
    return N_PAGES;
}

const char *brc_scene_page_name(int page)
{
    return PAGES[page].name;
}

brc_status brc_scene_write_page(brc_context *context, int page, const char *example, FILE *file)
{
    reference all;
    BRC_TRY(place_all(context, &all));
    if (page == 0) {
        fputs(INTRODUCTION, file);
        fputs("\n## Contents\n\n", file);
        for (int p = 1; p < N_PAGES; ++p)
            fprintf(file, "- [%s](%s.md): %s\n", PAGES[p].title, PAGES[p].name, PAGES[p].meaning);
    } else
        fprintf(file, "# %s\n\nOf [scene files](README.md): %s.\n", PAGES[page].title, PAGES[page].meaning);
    fprintf(file, "\n## A complete scene\n\n`%s.yaml`, beside this page:\n\n```yaml\n%s```\n", PAGES[page].name,
            example);
    for (int i = 0; i < all.n_placed; ++i)
        if (all.placed[i].page == page) write_section(file, &all, i);
    if (fflush(file) != 0 || ferror(file))
        return BRC_FAIL(context, BRC_FILE_FAILED, "the scene reference cannot be written");
    return BRC_OK;
}
