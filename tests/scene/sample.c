/* Writing a scene in block style from the schema, keeping count of line and column. */
#include "sample.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct maker {
    const sample_path *path;
    sample_fault fault;
    const char *value;
    sample_scene *out;
    int line, column;
    bool dash; /* the next line begins an item of a list */
} maker;

static void put(maker *m, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(maker *m, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *at = m->out->text + m->out->length;
    const int n = vsnprintf(at, sizeof m->out->text - (size_t)m->out->length, format, arguments);
    va_end(arguments);
    m->out->length += n;
    for (const char *c = at; *c; ++c) {
        m->column = *c == '\n' ? 1 : m->column + 1;
        m->line += *c == '\n';
    }
}

static void begin_line(maker *m, int indent)
{
    put(m, "%*s%s", m->dash ? indent - 2 : indent, "", m->dash ? "- " : "");
    m->dash = false;
}

static void mark(maker *m)
{
    m->out->line = m->line;
    m->out->column = m->column;
}

static bool path_has(const sample_path *path, const char *key)
{
    for (int i = 0; i < path->depth; ++i)
        if (strcmp(path->chain[i]->key, key) == 0) return true;
    return false;
}

/* The variant of a one-of that is not on the path: what the path needs elsewhere, else the first. */
static const brc_entry *usual_variant(const maker *m, const brc_section *section)
{
    const char *wanted = NULL;
    if (strcmp(section->title, "solver") == 0) {
        if (path_has(m->path, "face_velocity") || path_has(m->path, "element_velocity") ||
            path_has(m->path, "frequency") || path_has(m->path, "rate") || path_has(m->path, "integral") ||
            path_has(m->path, "duration") || path_has(m->path, "platens") || path_has(m->path, "jaws") ||
            path_has(m->path, "rollers") || path_has(m->path, "free"))
            wanted = "dynamic";
        if (path_has(m->path, "mode")) wanted = "modes";
    }
    return wanted ? brc_section_find(section, wanted) : &section->entries[0];
}

/* Mass and table of what a prescribed force moves. */
static bool needs_force(const brc_section *section, const brc_entry *on_path)
{
    return on_path && brc_section_find(section, "force") && brc_section_find(section, "mass") &&
           (strcmp(on_path->key, "mass") == 0 || strcmp(on_path->key, "table") == 0);
}

/* Is this entry written, the path's entry of this section being `on_path` (or NULL)? */
static bool is_used(const brc_section *section, const brc_entry *entry, const brc_entry *on_path)
{
    if (entry == on_path || entry->required) return true;
    if (section == brc_schema() && strcmp(entry->key, "sets") == 0) return true; /* the samples refer to them */
    if (section == brc_schema() && strcmp(entry->key, "sensors") == 0) return true;
    if (section == brc_schema() && strcmp(entry->key, "fracture") == 0) return true; /* sensors and stops need it */
    if (strcmp(section->title, "material") == 0 && strcmp(entry->key, "strength") == 0)
        return true; /* which needs one */
    if (strcmp(section->title, "strength") == 0 && strcmp(entry->key, "tension") == 0) return true;
    if (section == brc_schema() && strcmp(entry->key, "strikers") == 0) return true; /* and a sensor refers to one */
    if (section == brc_schema() && strcmp(entry->key, "interactions") == 0) return true; /* which needs contact */
    if (strcmp(section->title, "interactions") == 0 && strcmp(entry->key, "contact") == 0) return true;
    if (strcmp(section->title, "body") == 0 && strcmp(entry->key, "fill") == 0)
        return !on_path || strcmp(on_path->key, "domain") != 0;
    if (needs_force(section, on_path) && strcmp(entry->key, "force") == 0) return true;
    for (size_t g = 0; g < sizeof section->groups / sizeof section->groups[0]; ++g) {
        const brc_group *group = &section->groups[g];
        if (group->rule != BRC_GROUP_EXACTLY_ONE && group->rule != BRC_GROUP_AT_LEAST_ONE) continue;
        bool chosen = false;
        for (int k = 0; group->keys[k]; ++k)
            chosen |= on_path && (strcmp(group->keys[k], on_path->key) == 0 ||
                                  (needs_force(section, on_path) && strcmp(group->keys[k], "force") == 0));
        if (!chosen && strcmp(group->keys[0], entry->key) == 0) return true;
    }
    return false;
}

static void write_section(maker *m, const brc_section *section, int level, int indent);

/* A wall of the shape that the scene has: a box unless the path says otherwise. */
static const char *wall(const maker *m, const char *of_box)
{
    static const char *const ROUND[4][2] = {
        {"sphere", "surface"}, {"torus", "surface"}, {"mesh", "surface"}, {"cone", "side"}};
    const bool of_body =
        m->path->depth > 0 && strcmp(m->path->chain[0]->key, "bodies") == 0; /* strikers have shapes too */
    if (!of_body) return of_box;
    for (int i = 1; i < m->path->depth; ++i)
        for (int r = 0; r < 4 && strcmp(m->path->chain[i - 1]->key, "shape") == 0; ++r)
            if (strcmp(m->path->chain[i]->key, ROUND[r][0]) == 0) return ROUND[r][1];
    if (path_has(m->path, "parts") && path_has(m->path, "name")) return of_box[1] == '+' ? "hole_x+" : "hole_x-";
    return of_box;
}

static const char *sample_value(const maker *m, const brc_entry *entry)
{
    if (entry->type == BRC_TYPE_TABLE)
        return path_has(m->path, "face_velocity") || path_has(m->path, "element_velocity") ||
                       path_has(m->path, "driven")
                   ? "[[0 s, 0], [1 ms, 1]]"
                   : "[[0, 0], [1, 1]]";
    if (strcmp(entry->key, "load") == 0 && path_has(m->path, "area")) return "force"; /* the area divides a reaction */
    if (strcmp(entry->key, "window") == 0 && (path_has(m->path, "frequency") || path_has(m->path, "rate") ||
                                              path_has(m->path, "integral") || path_has(m->path, "duration")))
        return "[0, 1 ms]";
    if (entry->sample && (strcmp(entry->sample, "x+") == 0 || strcmp(entry->sample, "x-") == 0))
        return wall(m, entry->sample);
    return entry->sample ? entry->sample : entry->given ? entry->given : entry->choices ? entry->choices[0] : "true";
}

/* The value of an entry, after "key:". level: of its section's entries on the path, -1 off the path. */
static void write_value(maker *m, const brc_entry *entry, int level, int indent)
{
    const bool named = entry->type == BRC_TYPE_NAMED;
    if (entry->type == BRC_TYPE_LIST || named) {
        put(m, "\n");
        if (named && strcmp(entry->key, "sensors") == 0)
            put(m,
                "  force:\n    reaction: {set: %s, component: x}\n  stress:\n    stress: {component: xx}\n"
                "  strain:\n    face_strain: {set: %s, against: %s, component: x}\n",
                wall(m, "x+"), wall(m, "x+"), wall(m, "x-"));
        if (named && strcmp(entry->key, "sensors") == 0 && level < 0) return;
        if (named) {
            begin_line(m, indent);
            put(m, "%s:\n", entry->section->sample_name);
        } else {
            m->dash = true;
        }
        write_section(m, entry->section, level, indent + 2);
    } else if (entry->type == BRC_TYPE_STRUCT && entry->section) {
        bool any = entry->section->one_of;
        const brc_entry *on_path = level >= 0 && level < m->path->depth ? m->path->chain[level] : NULL;
        const bool removed = m->fault == SAMPLE_MISSING && on_path && level == m->path->depth - 1;
        for (int i = 0; i < entry->section->n_entries; ++i)
            any |= is_used(entry->section, &entry->section->entries[i], on_path) &&
                   !(removed && &entry->section->entries[i] == on_path);
        if (!any) {
            put(m, " ");
            if (removed) mark(m);
            put(m, "{}\n");
            return;
        }
        put(m, "\n");
        write_section(m, entry->section, level, indent);
    } else {
        put(m, " %s\n", entry->type == BRC_TYPE_STRUCT ? "{}" : sample_value(m, entry));
    }
}

static void write_section(maker *m, const brc_section *section, int level, int indent)
{
    const brc_entry *on_path = level >= 0 && level < m->path->depth ? m->path->chain[level] : NULL;
    const bool is_last = level == m->path->depth - 1;
    bool first = true;
    for (int i = 0; i < section->n_entries; ++i) {
        const brc_entry *entry = &section->entries[i];
        const bool used = section->one_of ? entry == (on_path ? on_path : usual_variant(m, section))
                                          : is_used(section, entry, on_path);
        if (!used) continue;
        const bool target = entry == on_path && is_last;
        if (target && m->fault == SAMPLE_MISSING) continue;
        for (int copy = 0; copy < (target && m->fault == SAMPLE_DUPLICATE ? 2 : 1); ++copy) {
            begin_line(m, indent);
            if (first && on_path && is_last && m->fault == SAMPLE_MISSING) mark(m);
            first = false;
            if (target && m->fault == SAMPLE_UNKNOWN) {
                mark(m);
                put(m, "unheard-of-key: 1\n");
                begin_line(m, indent);
            }
            if (target && copy == 1) mark(m);
            put(m, "%s:", entry->key);
            if (target && m->fault == SAMPLE_VALUE) {
                put(m, " ");
                mark(m);
                put(m, "%s\n", m->value);
            } else {
                write_value(m, entry, entry == on_path ? level + 1 : -1, indent + 2);
            }
        }
    }
}

void sample_make(const sample_path *path, sample_fault fault, const char *value, sample_scene *out)
{
    *out = (sample_scene){.line = 0};
    maker m = {.path = path, .fault = fault, .value = value, .out = out, .line = 1, .column = 1};
    write_section(&m, brc_schema(), 0, 0);
}

const char *sample_path_text(const sample_path *path, char *out, size_t size)
{
    size_t at = 0;
    for (int i = 0; i < path->depth; ++i)
        at += (size_t)snprintf(out + at, size - at, "%s%s", i ? "." : "", path->chain[i]->key);
    return out;
}

static void visit_section(const brc_section *section, sample_path *path,
                          void (*visit)(const sample_path *path, void *data), void *data)
{
    for (int i = 0; i < section->n_entries; ++i) {
        path->chain[path->depth++] = &section->entries[i];
        visit(path, data);
        if (section->entries[i].section) visit_section(section->entries[i].section, path, visit, data);
        --path->depth;
    }
}

void sample_visit(void (*visit)(const sample_path *path, void *data), void *data)
{
    sample_path path = {.depth = 0};
    visit_section(brc_schema(), &path, visit, data);
}
