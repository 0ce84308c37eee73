/* Every section is a definition; entries refer to those of their sections. */
#include "json_schema.h"
#include "../output/text.h"
#include "../scene/schema.h"
#include <ctype.h>
#include <math.h>
#include <string.h>

#define MANY_SECTIONS 512

/* A number as the reader takes it, and what may stand behind it. */
#define NUMBER "[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?"
#define PURE "^" NUMBER "( *%)?$"
#define QUANTITY "^(" NUMBER "( *(?![eE][-+]?[0-9])[A-Za-z%].*| +1/.*)|[-+]?[0.]+)$"
#define NAME "^[A-Za-z0-9_+-]+$"

typedef struct writing {
    brc_json json;
    const brc_section *section[MANY_SECTIONS]; /* [n] */
    int n;
} writing;

/* Name of the definition of a section: its title, with a number where an earlier one has the same. */
static void name_of(const writing *w, int index, char *name, size_t size)
{
    const brc_section *section = w->section[index];
    int same = 0;
    size_t at = 0;
    for (int k = 0; k < index; ++k)
        same += strcmp(w->section[k]->title, section->title) == 0;
    for (const char *c = section->title; *c && at + 16 < size; ++c)
        name[at++] = (char)(isalnum((unsigned char)*c) ? *c : '-');
    if (same)
        snprintf(name + at, size - at, "-%d", same + 1);
    else
        name[at] = '\0';
}

/* A section by its definition, which is written later where it was not met before. */
static void refer(writing *w, const brc_section *section)
{
    static const char place[] = "#/$defs/";
    char name[160];
    int k = 0;
    while (k < w->n && w->section[k] != section)
        ++k;
    if (k == MANY_SECTIONS) return;
    if (k == w->n) w->section[w->n++] = section;
    memcpy(name, place, sizeof place);
    name_of(w, k, name + sizeof place - 1, sizeof name - sizeof place + 1);
    brc_json_string(&w->json, "$ref", name);
}

/* One schema in a list of them, of a single keyword. */
static void choice_text(writing *w, const char *keyword, const char *value)
{
    brc_json_begin_object(&w->json, NULL);
    brc_json_string(&w->json, keyword, value);
    brc_json_end(&w->json);
}

static void pattern(writing *w, const char *key, const char *text)
{
    brc_json_begin_object(&w->json, key);
    brc_json_string(&w->json, "type", "string");
    brc_json_string(&w->json, "pattern", text);
    brc_json_end(&w->json);
}

static void range(writing *w, const brc_entry *entry)
{
    if (!brc_entry_has_range(entry)) return;
    if (isfinite(entry->range.low))
        brc_json_number(&w->json, entry->range.low_open ? "exclusiveMinimum" : "minimum", entry->range.low);
    if (isfinite(entry->range.high))
        brc_json_number(&w->json, entry->range.high_open ? "exclusiveMaximum" : "maximum", entry->range.high);
}

/* Alternatives of a quantity: a number where its unit allows one, else 0; a text; the entry's word. */
static void quantity(writing *w, const brc_entry *entry, const char *unit)
{
    const bool pure = !unit || unit[0] == '\0', either = unit && unit[0] == '@';
    brc_json_begin_array(&w->json, "anyOf");
    brc_json_begin_object(&w->json, NULL);
    if (pure || either) {
        brc_json_string(&w->json, "type",
                        entry->type == BRC_TYPE_INTEGER || entry->type == BRC_TYPE_INTEGERS ? "integer" : "number");
        if (pure) range(w, entry);
    } else {
        brc_json_integer(&w->json, "const", 0);
    }
    brc_json_end(&w->json);
    pattern(w, NULL, pure ? PURE : QUANTITY);
    if (either) pattern(w, NULL, PURE);
    if (entry->word) choice_text(w, "const", entry->word);
    brc_json_end(&w->json);
}

static void list_of(writing *w, const brc_entry *entry, int length, const char *unit)
{
    brc_json_string(&w->json, "type", "array");
    brc_json_integer(&w->json, "minItems", length);
    brc_json_integer(&w->json, "maxItems", length);
    brc_json_begin_object(&w->json, "items");
    quantity(w, entry, unit);
    brc_json_end(&w->json);
}

static void scalar_types(writing *w, const char *text_pattern)
{
    brc_json_begin_array(&w->json, "type");
    brc_json_string(&w->json, NULL, "string");
    brc_json_string(&w->json, NULL, "number");
    brc_json_end(&w->json);
    if (text_pattern) brc_json_string(&w->json, "pattern", text_pattern);
}

static void table(writing *w, const brc_entry *entry)
{
    brc_json_string(&w->json, "type", "array");
    brc_json_integer(&w->json, "minItems", 1);
    brc_json_begin_object(&w->json, "items");
    brc_json_string(&w->json, "type", "array");
    brc_json_integer(&w->json, "minItems", 2);
    brc_json_integer(&w->json, "maxItems", 2);
    brc_json_begin_object(&w->json, "items");
    quantity(w, entry, BRC_UNIT_STAGE_TIME);
    brc_json_end(&w->json);
    brc_json_end(&w->json);
}

static void words(writing *w, const char *const *choices)
{
    brc_json_begin_array(&w->json, "enum");
    for (int k = 0; choices[k]; ++k)
        brc_json_string(&w->json, NULL, choices[k]);
    brc_json_end(&w->json);
}

/* The value of an entry, into the object that is open. */
static void value(writing *w, const brc_entry *entry)
{
    switch (entry->type) {
    case BRC_TYPE_QUANTITY: quantity(w, entry, entry->unit); return;
    case BRC_TYPE_INTEGER: quantity(w, entry, ""); return;
    case BRC_TYPE_VECTOR: list_of(w, entry, entry->length, entry->unit); return;
    case BRC_TYPE_DIRECTION: list_of(w, entry, 3, ""); return;
    case BRC_TYPE_INTEGERS: list_of(w, entry, entry->length, ""); return;
    case BRC_TYPE_BOOL: brc_json_string(&w->json, "type", "boolean"); return;
    case BRC_TYPE_STRING: scalar_types(w, NULL); return;
    case BRC_TYPE_NAME:
    case BRC_TYPE_MATERIAL: scalar_types(w, NAME); return;
    case BRC_TYPE_WORD:
    case BRC_TYPE_CHOICE: words(w, entry->choices); return;
    case BRC_TYPE_TABLE: table(w, entry); return;
    case BRC_TYPE_STRUCT:
        if (brc_entry_is_switch(entry)) {
            brc_json_begin_array(&w->json, "anyOf");
            brc_json_begin_object(&w->json, NULL);
            refer(w, entry->section);
            brc_json_end(&w->json);
            choice_text(w, "type", "boolean");
            brc_json_end(&w->json);
        } else if (entry->section) {
            refer(w, entry->section);
        } else {
            brc_json_string(&w->json, "type", "object");
            brc_json_integer(&w->json, "maxProperties", 0);
        }
        return;
    case BRC_TYPE_LIST:
        brc_json_string(&w->json, "type", "array");
        if (entry->required) brc_json_integer(&w->json, "minItems", 1);
        brc_json_begin_object(&w->json, "items");
        break;
    case BRC_TYPE_NAMED:
        brc_json_string(&w->json, "type", "object");
        if (entry->required) brc_json_integer(&w->json, "minProperties", 1);
        pattern(w, "propertyNames", NAME);
        brc_json_begin_object(&w->json, "additionalProperties");
        break;
    }
    refer(w, entry->section);
    brc_json_end(&w->json);
}

/* What an editor shows: meaning, range with its unit, why. */
static void description(writing *w, const brc_entry *entry)
{
    char text[1024], limits[96];
    const char *unit = entry->unit && entry->unit[0] && entry->unit[0] != '@' ? entry->unit : NULL;
    brc_range_text(entry, limits, sizeof limits);
    snprintf(text, sizeof text, "%s%s%s%s%s%s%s%s%s%s", entry->meaning ? entry->meaning : "", unit ? " [" : "",
             unit ? unit : "", unit ? "]" : "", limits[0] ? ", " : "", limits, entry->why ? "; " : "",
             entry->why ? entry->why : "", entry->sample ? "; as in " : "", entry->sample ? entry->sample : "");
    brc_json_string(&w->json, "description", text);
    if (entry->given && strcmp(entry->given, "{}") != 0) brc_json_string(&w->json, "default", entry->given);
}

/* The map of a section's keys, into the object that is open. */
static void map(writing *w, const brc_section *section)
{
    brc_json_string(&w->json, "type", "object");
    brc_json_begin_object(&w->json, "properties");
    for (int k = 0; k < section->n_entries; ++k) {
        brc_json_begin_object(&w->json, section->entries[k].key);
        description(w, &section->entries[k]);
        value(w, &section->entries[k]);
        brc_json_end(&w->json);
    }
    brc_json_end(&w->json);
    brc_json_boolean(&w->json, "additionalProperties", false);
    if (section->one_of) {
        brc_json_integer(&w->json, "minProperties", 1);
        brc_json_integer(&w->json, "maxProperties", 1);
        return;
    }
    brc_json_begin_array(&w->json, "required");
    for (int k = 0; k < section->n_entries; ++k)
        if (section->entries[k].required) brc_json_string(&w->json, NULL, section->entries[k].key);
    brc_json_end(&w->json);
}

/* {"required": [keys]} in a list. */
static void require(writing *w, const char *one, const char *other)
{
    brc_json_begin_object(&w->json, NULL);
    brc_json_begin_array(&w->json, "required");
    brc_json_string(&w->json, NULL, one);
    if (other) brc_json_string(&w->json, NULL, other);
    brc_json_end(&w->json);
    brc_json_end(&w->json);
}

/* How many of some keys must be there, each group a schema in the list `allOf`. */
static void groups(writing *w, const brc_section *section)
{
    if (section->groups[0].rule == BRC_GROUP_NONE) return;
    brc_json_begin_array(&w->json, "allOf");
    for (size_t g = 0; g < sizeof section->groups / sizeof *section->groups; ++g) {
        const brc_group *group = &section->groups[g];
        if (group->rule == BRC_GROUP_NONE) continue;
        const bool none = group->rule == BRC_GROUP_AT_MOST_ONE;
        brc_json_begin_object(&w->json, NULL);
        if (none) brc_json_begin_object(&w->json, "not");
        brc_json_begin_array(&w->json, group->rule == BRC_GROUP_EXACTLY_ONE ? "oneOf" : "anyOf");
        for (int k = 0; group->keys[k]; ++k) {
            if (!none) require(w, group->keys[k], NULL);
            for (int m = 0; none && m < k; ++m)
                require(w, group->keys[m], group->keys[k]);
        }
        brc_json_end(&w->json);
        if (none) brc_json_end(&w->json);
        brc_json_end(&w->json);
    }
    brc_json_end(&w->json);
}

/* May a variant's name stand alone, for all its defaults? */
static bool stands_alone(const brc_entry *variant)
{
    if (variant->type != BRC_TYPE_STRUCT) return false;
    if (!variant->section) return true;
    if (variant->section->one_of) return false;
    for (int k = 0; k < variant->section->n_entries; ++k)
        if (variant->section->entries[k].required) return false;
    for (size_t g = 0; g < sizeof variant->section->groups / sizeof *variant->section->groups; ++g)
        if (variant->section->groups[g].rule == BRC_GROUP_EXACTLY_ONE ||
            variant->section->groups[g].rule == BRC_GROUP_AT_LEAST_ONE)
            return false;
    return true;
}

static void define(writing *w, const brc_section *section)
{
    const brc_entry *alone = section->short_key ? brc_section_find(section, section->short_key) : NULL;
    brc_json_string(&w->json, "description", section->meaning ? section->meaning : section->title);
    brc_json_begin_array(&w->json, "anyOf");
    brc_json_begin_object(&w->json, NULL);
    map(w, section);
    groups(w, section);
    brc_json_end(&w->json);
    if (alone) {
        brc_json_begin_object(&w->json, NULL);
        value(w, alone);
        brc_json_end(&w->json);
    }
    for (int k = 0; section->one_of && k < section->n_entries; ++k)
        if (stands_alone(&section->entries[k])) choice_text(w, "const", section->entries[k].key);
    brc_json_end(&w->json);
}

brc_status brc_json_schema_write(brc_context *context, FILE *file)
{
    writing w = {.json = {.text = {.context = context}}};
    brc_status status;
    brc_json_begin_object(&w.json, NULL);
    brc_json_string(&w.json, "$schema", "https://json-schema.org/draft/2020-12/schema");
    brc_json_string(&w.json, "title", "breccia scene");
    refer(&w, brc_schema());
    brc_json_begin_object(&w.json, "$defs");
    for (int k = 0; k < w.n; ++k) { /* grows as sections lead to others */
        char name[160];
        name_of(&w, k, name, sizeof name);
        brc_json_begin_object(&w.json, name);
        define(&w, w.section[k]);
        brc_json_end(&w.json);
    }
    brc_json_end(&w.json);
    brc_json_end(&w.json);
    status = w.json.text.status;
    if (status == BRC_OK && w.n == MANY_SECTIONS)
        status = BRC_FAIL(context, BRC_INTERNAL,
                          "the schema has more sections than its JSON form has room for; raise MANY_SECTIONS");
    if (status == BRC_OK &&
        (fwrite(w.json.text.data, 1, w.json.text.length, file) != w.json.text.length || fputc('\n', file) == EOF))
        status = BRC_FAIL(context, BRC_FILE_FAILED, "the schema cannot be written");
    brc_text_free(&w.json.text);
    return status;
}
