/* Reading single values: quantities, vectors, integers, words, names, tables. */
#include "reader_internal.h"
#include "hint.h"
#include "unit.h"
#include "../base/memory.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SENTENCE 448

const char *brc_entry_unit(const brc_entry *entry, const brc_scene *scene, const brc_stage *stage, const void *measure)
{
    const char *unit = entry->unit ? entry->unit : "";
    if (unit[0] != '@') return unit;
    if (strcmp(unit, BRC_UNIT_STAGE_TIME) == 0) return stage && stage->solver == BRC_SOLVER_DYNAMIC ? "s" : "";
    const brc_measure *m = measure;
    if (strcmp(unit, BRC_UNIT_MEASURE) == 0) {
        const char *of = brc_measure_unit(scene, m);
        return strcmp(of, "-") == 0 ? "" : of;
    }
    for (int k = scene->n_stages - 1; k >= 0; --k) /* the measure's stage; unnamed: the last */
        if (m->stage[0] == '\0' || strcmp(scene->stages[k].name, m->stage) == 0)
            return scene->stages[k].solver == BRC_SOLVER_DYNAMIC ? "s" : "";
    return "s";
}

const char *brc_entry_expects(const brc_entry *entry, const char *unit, char *out, size_t size)
{
    char what[SENTENCE] = "", range[96], measured[64];
    const char *sample = entry->sample ? entry->sample : entry->given ? entry->given : "";
    const bool pure = unit[0] == '\0';
    if (entry->unit && strcmp(entry->unit, BRC_UNIT_MEASURE_TIME) == 0 && !pure) sample = "[0, 1 ms]";
    if (entry->unit && strcmp(entry->unit, BRC_UNIT_MEASURE) == 0) {
        snprintf(measured, sizeof measured, pure ? "1" : "1 %s", unit);
        sample = measured;
    }
    switch (entry->type) {
    case BRC_TYPE_QUANTITY:
        if (pure)
            snprintf(what, sizeof what, "a number");
        else
            snprintf(what, sizeof what, "a quantity in %s", unit);
        break;
    case BRC_TYPE_VECTOR:
        snprintf(what, sizeof what, "a list of %d %s%s", entry->length, pure ? "numbers" : "quantities in ", unit);
        break;
    case BRC_TYPE_DIRECTION: snprintf(what, sizeof what, "a direction, 3 numbers that are not all 0,"); break;
    case BRC_TYPE_INTEGER: snprintf(what, sizeof what, "a whole number"); break;
    case BRC_TYPE_INTEGERS: snprintf(what, sizeof what, "a list of %d whole numbers", entry->length); break;
    case BRC_TYPE_BOOL: snprintf(what, sizeof what, "true or false"); break;
    case BRC_TYPE_STRING: snprintf(what, sizeof what, "a text"); break;
    case BRC_TYPE_NAME: snprintf(what, sizeof what, "a name"); break;
    case BRC_TYPE_MATERIAL: snprintf(what, sizeof what, "the name of a material"); break;
    case BRC_TYPE_TABLE:
        snprintf(what, sizeof what, "a list of pairs of time and factor such as %s",
                 pure ? "[[0, 0], [1, 1]] (time is a fraction of the stage)" : "[[0 s, 0], [1 ms, 1]]");
        sample = "";
        break;
    case BRC_TYPE_WORD:
    case BRC_TYPE_CHOICE: {
        size_t at = (size_t)snprintf(what, sizeof what, "one of ");
        for (int i = 0; entry->choices[i]; ++i) {
            const int n = snprintf(what + at, sizeof what - at, "%s%s", i ? ", " : "", entry->choices[i]);
            if (n < 0 || at + (size_t)n >= sizeof what) break;
            at += (size_t)n;
        }
        sample = "";
        break;
    }
    case BRC_TYPE_STRUCT: snprintf(what, sizeof what, "a map"); break;
    case BRC_TYPE_LIST: snprintf(what, sizeof what, "a list"); break;
    case BRC_TYPE_NAMED: snprintf(what, sizeof what, "a map of names"); break;
    }
    brc_range_text(entry, range, sizeof range);
    snprintf(out, size, "%s%s%s%s%s%s%s", what, range[0] ? " " : "", range, sample[0] ? " such as " : "", sample,
             entry->word ? ", or the word " : "", entry->word ? entry->word : "");
    return out;
}

/* One problem of a value: "E: '3 m' has a unit of another kind; expected a quantity in Pa > 0 such as 72 GPa". */
static void complain(brc_reader *reader, const brc_entry *entry, const char *unit, const brc_node *node,
                     const char *problem)
{
    char found[128], expected[SENTENCE];
    brc_problems_add(reader->problems, node->mark, "%s: %s %s; expected %s", entry->key,
                     brc_node_describe(node, found, sizeof found), problem,
                     brc_entry_expects(entry, unit, expected, sizeof expected));
}

static void complain_of_range(brc_reader *reader, const brc_entry *entry, const brc_node *node, double value)
{
    char found[128], range[96], hint[BRC_HINT];
    brc_problems_add(reader->problems, node->mark, "%s: %s is out of range, it must be %s%s%s%s", entry->key,
                     brc_node_describe(node, found, sizeof found), brc_range_text(entry, range, sizeof range),
                     entry->why ? ": " : "", entry->why ? entry->why : "",
                     brc_hint_range(entry, node->text, value, hint));
}

static bool read_quantity(brc_reader *reader, const brc_entry *entry, const char *unit, const brc_node *node,
                          double *out)
{
    if (node->kind != BRC_NODE_SCALAR) {
        complain(reader, entry, unit, node, "is not a single value");
        return false;
    }
    if (entry->word && strcmp(node->text, entry->word) == 0) {
        *out = entry->word_value;
        return true;
    }
    const brc_quantity_result result = brc_quantity_read(node->text, unit, out);
    if (result != BRC_QUANTITY_OK) {
        char found[128], expected[SENTENCE], hint[BRC_HINT];
        brc_problems_add(reader->problems, node->mark, "%s: %s %s; expected %s%s", entry->key,
                         brc_node_describe(node, found, sizeof found), brc_quantity_problem(result),
                         brc_entry_expects(entry, unit, expected, sizeof expected),
                         brc_hint_quantity(node->text, unit, hint));
        return false;
    }
    if (*out == 0) *out = 0; /* no minus zero, which would be written differently */
    if (!brc_range_contains(entry, *out)) {
        complain_of_range(reader, entry, node, *out);
        return false;
    }
    if (entry->factor > 0) *out *= entry->factor;
    return true;
}

static bool read_quantities(brc_reader *reader, const brc_entry *entry, const char *unit, const brc_node *node,
                            double *out)
{
    if (node->kind != BRC_NODE_LIST || node->n_children != entry->length) {
        complain(reader, entry, unit, node, "does not fit");
        return false;
    }
    bool good = true;
    int i = 0;
    for (const brc_node *item = node->first; item; item = item->next)
        good &= read_quantity(reader, entry, unit, item, &out[i++]);
    return good;
}

static void read_direction(brc_reader *reader, const brc_entry *entry, const brc_node *node, double out[3])
{
    if (!read_quantities(reader, entry, "", node, out)) return;
    const double largest = fmax(fabs(out[0]), fmax(fabs(out[1]), fabs(out[2])));
    if (largest == 0) {
        complain(reader, entry, "", node, "has no direction");
        return;
    }
    /* A vector that is a unit vector already stays as it is, so that a written scene reads back to the same bits. */
    const double square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
    if (fabs(square - 1) < 1e-15) return;
    for (int i = 0; i < 3; ++i)
        out[i] /= largest;
    const double length = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    for (int i = 0; i < 3; ++i)
        out[i] = out[i] / length + 0.0;
}

static bool read_integer(brc_reader *reader, const brc_entry *entry, const brc_node *node, int64_t *out)
{
    double value;
    if (!read_quantity(reader, entry, "", node, &value)) return false;
    if (value != floor(value) || fabs(value) > 9007199254740992.0) { /* 2^53: beyond it doubles skip integers */
        complain(reader, entry, "", node, "is not whole");
        return false;
    }
    *out = (int64_t)value;
    return true;
}

static void store_integer(const brc_entry *entry, void *field, int64_t value)
{
    const int32_t narrow = (int32_t)value;
    if (entry->size == sizeof narrow)
        memcpy(field, &narrow, sizeof narrow);
    else
        memcpy(field, &value, sizeof value);
}

static void read_bool(brc_reader *reader, const brc_entry *entry, const brc_node *node, bool *out)
{
    if (node->kind == BRC_NODE_SCALAR && strcmp(node->text, "true") == 0)
        *out = true;
    else if (node->kind == BRC_NODE_SCALAR && strcmp(node->text, "false") == 0)
        *out = false;
    else
        complain(reader, entry, "", node, "is neither");
}

static void read_text(brc_reader *reader, const brc_entry *entry, const brc_node *node, char *out)
{
    if (node->kind != BRC_NODE_SCALAR || node->text[0] == '\0')
        complain(reader, entry, "", node, "does not fit");
    else if (strlen(node->text) >= entry->size)
        brc_problems_add(reader->problems, node->mark, "%s: has %zu bytes, at most %zu are kept", entry->key,
                         strlen(node->text), entry->size - 1);
    else
        memcpy(out, node->text, strlen(node->text) + 1);
}

bool brc_reader_name(brc_reader *reader, const char *key, const brc_node *node, const char *text, brc_mark mark)
{
    bool good = text[0] != '\0' && strlen(text) < BRC_NAME;
    for (const char *c = text; good && *c; ++c)
        good = isalnum((unsigned char)*c) || *c == '_' || *c == '+' || *c == '-';
    if (node && node->kind != BRC_NODE_SCALAR) good = false;
    char found[128];
    if (!good)
        brc_problems_add(reader->problems, mark, "%s%s%.80s is no name: expected 1 to %d letters, digits or _ + -", key,
                         node ? ": " : " ", node ? brc_node_describe(node, found, sizeof found) : text, BRC_NAME - 1);
    return good;
}

static void read_name(brc_reader *reader, const brc_entry *entry, const brc_node *node, char *out)
{
    if (!brc_reader_name(reader, entry->key, node, node->text, node->mark)) return;
    if (strlen(node->text) >= entry->size)
        brc_problems_add(reader->problems, node->mark, "%s: '%s' is longer than %zu letters", entry->key, node->text,
                         entry->size - 1);
    else
        memcpy(out, node->text, strlen(node->text) + 1);
}

/* Index of a word among the choices, -1 with a problem when it is none. */
static int read_choice(brc_reader *reader, const brc_entry *entry, const brc_node *node)
{
    int n = 0;
    for (; entry->choices[n]; ++n)
        if (node->kind == BRC_NODE_SCALAR && strcmp(entry->choices[n], node->text) == 0) return n;
    const char *near =
        node->kind == BRC_NODE_SCALAR ? brc_problems_nearest(reader->problems, node->text, n, entry->choices) : NULL;
    char hint[128];
    snprintf(hint, sizeof hint, "is none of the words%s%s%s", near ? " (did you mean " : "", near ? near : "",
             near ? "?)" : "");
    complain(reader, entry, "", node, hint);
    return -1;
}

static void read_material(brc_reader *reader, const brc_entry *entry, const brc_node *node, int32_t *out)
{
    if (!brc_reader_name(reader, entry->key, node, node->text, node->mark)) return;
    const brc_scene *scene = reader->scene;
    for (int i = 0; i < scene->n_materials; ++i) {
        if (strcmp(scene->materials[i].name, node->text) != 0) continue;
        *out = i;
        return;
    }
    const char *near = NULL;
    char known[200] = "";
    size_t length = 0;
    for (int i = 0; i < scene->n_materials; ++i) {
        const char *const name = scene->materials[i].name;
        if (!near) near = brc_problems_nearest(reader->problems, node->text, 1, &name);
        if (length + strlen(name) + sizeof "; known: " >= sizeof known) continue;
        length +=
            (size_t)snprintf(known + length, sizeof known - length, "%s%s", length == 0 ? "; known: " : ", ", name);
    }
    brc_problems_add(reader->problems, node->mark, "%s: there is no material '%s'%s%s%s%s; define it under materials",
                     entry->key, node->text, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "", known);
}

static brc_status read_table(brc_reader *reader, const brc_entry *entry, const brc_node *node, brc_table *out)
{
    const char *unit = brc_entry_unit(entry, reader->scene, reader->stage, NULL);
    if (node->kind != BRC_NODE_LIST || node->n_children == 0) {
        complain(reader, entry, unit, node, "does not fit");
        return BRC_OK;
    }
    BRC_TRY(BRC_ALLOCATE(reader->context, &out->time, node->n_children, "table"));
    BRC_TRY(BRC_ALLOCATE(reader->context, &out->value, node->n_children, "table"));
    const brc_entry time = {.key = "table, time",
                            .type = BRC_TYPE_QUANTITY,
                            .range = {0, unit[0] ? INFINITY : 1, false, false},
                            .sample = unit[0] ? "1 ms" : "0.5"};
    const brc_entry factor = {.key = "table, factor", .type = BRC_TYPE_QUANTITY, .sample = "0.5"};
    for (const brc_node *row = node->first; row; row = row->next) {
        if (row->kind != BRC_NODE_LIST || row->n_children != 2) {
            complain(reader, entry, unit, row, "is no pair");
            continue;
        }
        const int k = out->n;
        const bool good = read_quantity(reader, &time, unit, row->first, &out->time[k]);
        if (!read_quantity(reader, &factor, "", row->last, &out->value[k]) || !good) continue;
        if (k > 0 && !(out->time[k] > out->time[k - 1])) {
            brc_problems_add(reader->problems, row->first->mark,
                             "table: the time '%s' does not come after the one "
                             "before; expected times that grow",
                             row->first->text);
            continue;
        }
        ++out->n;
    }
    return BRC_OK;
}

brc_status brc_reader_value(brc_reader *reader, const brc_entry *entry, const brc_node *node, void *field)
{
    int64_t integer = 0;
    int index;
    switch (entry->type) {
    case BRC_TYPE_QUANTITY:
    case BRC_TYPE_VECTOR: {
        /* Only entries of a measure have units of measures, and these come after the names they depend on. */
        const bool of_measure = entry->unit && (strcmp(entry->unit, BRC_UNIT_MEASURE) == 0 ||
                                                strcmp(entry->unit, BRC_UNIT_MEASURE_TIME) == 0);
        const void *measure = of_measure ? (const char *)field - entry->offset : NULL;
        const char *unit = brc_entry_unit(entry, reader->scene, reader->stage, measure);
        if (entry->type == BRC_TYPE_QUANTITY)
            read_quantity(reader, entry, unit, node, field);
        else
            read_quantities(reader, entry, unit, node, field);
        return BRC_OK;
    }
    case BRC_TYPE_DIRECTION: read_direction(reader, entry, node, field); return BRC_OK;
    case BRC_TYPE_INTEGER:
        if (read_integer(reader, entry, node, &integer)) store_integer(entry, field, integer);
        return BRC_OK;
    case BRC_TYPE_INTEGERS: {
        if (node->kind != BRC_NODE_LIST || node->n_children != entry->length) {
            complain(reader, entry, "", node, "does not fit");
            return BRC_OK;
        }
        int i = 0;
        for (const brc_node *item = node->first; item; item = item->next, ++i)
            if (read_integer(reader, entry, item, &integer)) ((int64_t *)field)[i] = integer;
        return BRC_OK;
    }
    case BRC_TYPE_BOOL: read_bool(reader, entry, node, field); return BRC_OK;
    case BRC_TYPE_STRING: read_text(reader, entry, node, field); return BRC_OK;
    case BRC_TYPE_NAME: read_name(reader, entry, node, field); return BRC_OK;
    case BRC_TYPE_MATERIAL: read_material(reader, entry, node, field); return BRC_OK;
    case BRC_TYPE_WORD:
        index = read_choice(reader, entry, node);
        if (index >= 0) snprintf(field, entry->size, "%s", entry->choices[index]);
        return BRC_OK;
    case BRC_TYPE_CHOICE: {
        index = read_choice(reader, entry, node);
        const int32_t kept = index < 0 ? 0 : index;
        memcpy(field, &kept, sizeof kept);
        return BRC_OK;
    }
    case BRC_TYPE_TABLE: return read_table(reader, entry, node, field);
    case BRC_TYPE_STRUCT:
    case BRC_TYPE_LIST:
    case BRC_TYPE_NAMED: break;
    }
    return BRC_FAIL(reader->context, BRC_INTERNAL, "entry '%s' is not a value", entry->key);
}
