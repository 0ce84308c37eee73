/* Writing a scene back as YAML, by the table that reads it: every key that has a value, in SI units. */
#include "scene_reader.h"
#include "reader_internal.h"
#include "schema_internal.h"
#include "unit.h"
#include "../base/memory.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

typedef struct writer {
    FILE *file;
    const brc_scene *scene;
    const brc_stage *stage; /* being written, for units of time */
    bool dash;              /* the next line begins an item of a list */
} writer;

static void write_section(writer *w, const brc_section *section, const char *base, int indent);

static size_t field_bytes(const brc_entry *entry)
{
    return entry->type == BRC_TYPE_TABLE ? 0 : entry->size;
}

/* Is the value what it would be if the key were left out and had no default: zero, empty? */
static bool is_absent(const brc_entry *entry, const char *base)
{
    if (entry->type == BRC_TYPE_LIST || entry->type == BRC_TYPE_NAMED) {
        int32_t count;
        memcpy(&count, base + entry->count_offset, sizeof count);
        return count == 0;
    }
    if (entry->type == BRC_TYPE_TABLE) {
        brc_table table;
        memcpy(&table, base + entry->offset, sizeof table);
        return table.n == 0;
    }
    if (entry->type == BRC_TYPE_STRUCT) {
        for (int i = 0; entry->section && i < entry->section->n_entries; ++i)
            if (!is_absent(&entry->section->entries[i], base + entry->offset)) return false;
        return true;
    }
    if (entry->type == BRC_TYPE_STRING || entry->type == BRC_TYPE_NAME || entry->type == BRC_TYPE_WORD)
        return base[entry->offset] == '\0';
    for (size_t i = 0; i < field_bytes(entry); ++i)
        if (base[entry->offset + i] != 0) return false;
    return true;
}

static bool is_in_group(const brc_group *group, const char *key)
{
    for (int k = 0; group->keys[k]; ++k)
        if (strcmp(group->keys[k], key) == 0) return true;
    return false;
}

static bool is_written(const brc_section *section, const brc_entry *entry, const char *base)
{
    if (entry->another) return false;
    if (entry->has_flag) return base[entry->has_offset];
    if (entry->required || entry->type == BRC_TYPE_MATERIAL) return true;
    for (size_t g = 0; g < sizeof section->groups / sizeof section->groups[0]; ++g) {
        const brc_group *group = &section->groups[g];
        if (group->rule == BRC_GROUP_AT_MOST_ONE && entry->given && is_in_group(group, entry->key))
            for (int k = 0; group->keys[k]; ++k) { /* its default would clash with the key that is there */
                const brc_entry *other = brc_section_find(section, group->keys[k]);
                if (other != entry && !is_absent(other, base)) return false;
            }
    }
    if (!is_absent(entry, base)) return true;
    for (size_t g = 0; g < sizeof section->groups / sizeof section->groups[0]; ++g) {
        const brc_group *group = &section->groups[g];
        const bool due = group->rule == BRC_GROUP_AT_LEAST_ONE || group->rule == BRC_GROUP_EXACTLY_ONE;
        if (!due || strcmp(group->keys[0], entry->key) != 0) continue;
        bool any = false; /* the reader wants one: the first, though it is zero */
        for (int k = 1; group->keys[k]; ++k)
            any |= is_written(section, brc_section_find(section, group->keys[k]), base);
        if (!any) return true;
    }
    return entry->given != NULL;
}

static void begin_line(writer *w, int indent)
{
    fprintf(w->file, "%*s%s", w->dash ? indent - 2 : indent, "", w->dash ? "- " : "");
    w->dash = false;
}

/* Plain where YAML cannot take it for anything else, quoted otherwise. */
static void write_text(writer *w, const char *text)
{
    bool plain = isalpha((unsigned char)text[0]);
    for (const char *c = text; *c && plain; ++c)
        plain = isalnum((unsigned char)*c) || strchr("_+-./", *c) || (*c == ' ' && c[1] != '\0');
    if (plain) {
        fputs(text, w->file);
        return;
    }
    fputc('"', w->file);
    for (const char *c = text; *c; ++c) {
        if (*c == '"' || *c == '\\') fputc('\\', w->file);
        fputc(*c, w->file);
    }
    fputc('"', w->file);
}

static void write_number(writer *w, const brc_entry *entry, double value, const char *unit)
{
    char text[40];
    if (entry->word && value == entry->word_value) {
        fputs(entry->word, w->file);
        return;
    }
    brc_number_print(value, text, sizeof text);
    fprintf(w->file, "%s%s%s", text, unit[0] ? " " : "", unit);
}

static int64_t load_integer(const brc_entry *entry, const char *field)
{
    int64_t wide;
    int32_t narrow;
    if (entry->size == sizeof narrow) {
        memcpy(&narrow, field, sizeof narrow);
        return narrow;
    }
    memcpy(&wide, field, sizeof wide);
    return wide;
}

static void write_value(writer *w, const brc_entry *entry, const char *base)
{
    const char *field = base + entry->offset;
    const char *unit = brc_entry_unit(entry, w->scene, w->stage, base);
    double numbers[3] = {0, 0, 0};
    switch (entry->type) {
    case BRC_TYPE_QUANTITY:
        memcpy(numbers, field, sizeof(double));
        write_number(w, entry, numbers[0], unit);
        break;
    case BRC_TYPE_VECTOR:
    case BRC_TYPE_DIRECTION:
        memcpy(numbers, field, (size_t)entry->length * sizeof(double));
        for (int i = 0; i < entry->length; ++i) {
            fputs(i ? ", " : "[", w->file);
            write_number(w, entry, numbers[i], unit);
        }
        fputs("]", w->file);
        break;
    case BRC_TYPE_INTEGER: {
        const int64_t value = load_integer(entry, field);
        if (entry->word && (double)value == entry->word_value)
            fputs(entry->word, w->file);
        else
            fprintf(w->file, "%lld", (long long)value);
        break;
    }
    case BRC_TYPE_INTEGERS:
        for (int i = 0; i < entry->length; ++i) {
            int64_t value;
            memcpy(&value, field + sizeof value * (size_t)i, sizeof value);
            fprintf(w->file, "%s%lld", i ? ", " : "[", (long long)value);
        }
        fputs("]", w->file);
        break;
    case BRC_TYPE_BOOL: fputs(*field ? "true" : "false", w->file); break;
    case BRC_TYPE_STRING:
    case BRC_TYPE_NAME:
    case BRC_TYPE_WORD: write_text(w, field); break;
    case BRC_TYPE_CHOICE: {
        int32_t choice;
        memcpy(&choice, field, sizeof choice);
        fputs(entry->choices[choice], w->file);
        break;
    }
    case BRC_TYPE_MATERIAL: {
        int32_t material;
        memcpy(&material, field, sizeof material);
        write_text(w, w->scene->materials[material].name);
        break;
    }
    case BRC_TYPE_TABLE: {
        const brc_table *table = (const brc_table *)(const void *)field;
        for (int i = 0; i < table->n; ++i) {
            fputs(i ? ", [" : "[[", w->file);
            write_number(w, entry, table->time[i], unit);
            fputs(", ", w->file);
            write_number(w, entry, table->value[i], "");
            fputs("]", w->file);
        }
        fputs("]", w->file);
        break;
    }
    default: break;
    }
}

static void write_list(writer *w, const brc_entry *entry, const char *base, int indent)
{
    const char *items;
    int32_t count;
    memcpy(&items, base + entry->offset, sizeof items);
    memcpy(&count, base + entry->count_offset, sizeof count);
    for (int32_t i = 0; i < count; ++i) {
        const char *item = items + entry->section->size * (size_t)i;
        if (entry->section == &brc_schema_stage) w->stage = (const brc_stage *)(const void *)item;
        if (entry->type == BRC_TYPE_NAMED) {
            begin_line(w, indent);
            write_text(w, item);
            fputs(":\n", w->file);
        } else {
            w->dash = true;
        }
        write_section(w, entry->section, item, indent + 2);
    }
}

static bool has_written(const brc_section *section, const char *base)
{
    if (section && section->one_of) return true;
    for (int i = 0; section && i < section->n_entries; ++i)
        if (is_written(section, &section->entries[i], base)) return true;
    return false;
}

static void write_entry(writer *w, const brc_entry *entry, const char *base, int indent)
{
    begin_line(w, indent);
    fprintf(w->file, "%s:", entry->key);
    if (entry->type == BRC_TYPE_LIST || entry->type == BRC_TYPE_NAMED) {
        fputs("\n", w->file);
        write_list(w, entry, base, indent + 2);
    } else if (entry->type == BRC_TYPE_STRUCT && has_written(entry->section, base + entry->offset)) {
        fputs("\n", w->file);
        write_section(w, entry->section, base + entry->offset, indent + 2);
    } else if (entry->type == BRC_TYPE_STRUCT) {
        fputs(" {}\n", w->file);
    } else {
        fputs(" ", w->file);
        write_value(w, entry, base);
        fputs("\n", w->file);
    }
}

static void write_section(writer *w, const brc_section *section, const char *base, int indent)
{
    int32_t kind = 0;
    if (section->one_of) memcpy(&kind, base + section->kind_offset, sizeof kind);
    for (int i = 0; i < section->n_entries; ++i) {
        const brc_entry *entry = &section->entries[i];
        if (section->one_of ? entry->value == kind : is_written(section, entry, base))
            write_entry(w, entry, base, indent);
    }
}

brc_status brc_scene_to_yaml(brc_context *context, const brc_scene *scene, char **out)
{
    *out = NULL;
    char *text = NULL;
    size_t bytes = 0;
    FILE *file = open_memstream(&text, &bytes);
    if (!file) return BRC_FAIL(context, BRC_NO_MEMORY, "no memory for the text of the scene");
    writer w = {.file = file, .scene = scene};
    write_section(&w, brc_schema(), (const char *)scene, 0);
    const bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed) {
        free(text);
        return BRC_FAIL(context, BRC_NO_MEMORY, "no memory for the text of the scene");
    }
    const brc_status status = brc_memory_allocate(context, (void **)out, (int64_t)bytes + 1, 1, "text of the scene");
    if (status == BRC_OK) memcpy(*out, text, bytes);
    free(text);
    return status;
}
