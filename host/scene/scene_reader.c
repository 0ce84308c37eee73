/* Reading scenes: the tree of nodes against the schema table. */
#include "scene_reader.h"
#include "reader_internal.h"
#include "hint.h"
#include "schema_internal.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <stdio.h>
#include <string.h>

#define FILE_LIMIT ((size_t)16 << 20) /* a scene is a text; big data come from files of their own */
#define MANY_KEYS 64

/* In the places of keys that have no field of their own: of flags, where their key stands; of kinds, where the variant
 * is named. */
static const brc_entry KEY = {.key = ""};

static brc_status read_section(brc_reader *reader, const brc_section *section, const brc_node *node, char *base);

brc_status brc_reader_remember(brc_reader *reader, const void *address, const brc_entry *entry, brc_mark mark)
{
    if (reader->n_places == reader->n_places_held) {
        const int64_t held = reader->n_places_held ? 2 * reader->n_places_held : 256;
        BRC_TRY(brc_memory_resize(reader->context, (void **)&reader->places, held, sizeof *reader->places,
                                  "places of a scene"));
        reader->n_places_held = held;
    }
    reader->places[reader->n_places++] = (brc_place){address, entry, mark};
    return BRC_OK;
}

/* An item of a list or of a map of names, already in its place in the array. */
static brc_status read_item(brc_reader *reader, const brc_section *section, const brc_node *node, char *item)
{
    BRC_TRY(brc_reader_remember(reader, item, NULL, node->mark));
    if (section == &brc_schema_stage) reader->stage = (const brc_stage *)(const void *)item;
    return read_section(reader, section, node, item);
}

static brc_status read_list(brc_reader *reader, const brc_entry *entry, const brc_node *node, char *base)
{
    const bool named = entry->type == BRC_TYPE_NAMED;
    char found[128];
    if (node->kind != (named ? BRC_NODE_MAP : BRC_NODE_LIST)) {
        char hint[BRC_HINT];
        brc_problems_add(reader->problems, node->mark, "%s: expected %s, found %s%s", entry->key,
                         named ? "a map from names to what they mean" : "a list (lines that begin with '- ')",
                         brc_node_describe(node, found, sizeof found), brc_hint_list(entry, hint));
        return BRC_OK;
    }
    if (node->n_children > BRC_LIST_MOST) {
        brc_problems_add(reader->problems, node->mark, "%s: has %d items, at most %d are read", entry->key,
                         node->n_children, BRC_LIST_MOST);
        return BRC_OK;
    }
    if (node->n_children == 0) {
        if (entry->required)
            brc_problems_add(reader->problems, node->mark, "%s: is empty, at least one %s is due", entry->key,
                             entry->section->title);
        return BRC_OK;
    }
    char *items = NULL;
    const size_t size = entry->section->size;
    BRC_TRY(brc_memory_allocate(reader->context, (void **)&items, node->n_children + entry->spare, size, entry->key));
    memcpy(base + entry->offset, &items, sizeof items);
    const int32_t count = node->n_children;
    memcpy(base + entry->count_offset, &count, sizeof count);
    char *item = items;
    for (const brc_node *child = node->first; child; child = child->next, item += size) {
        if (named && brc_reader_name(reader, "key", NULL, child->key, child->key_mark)) strcpy(item, child->key);
        BRC_TRY(read_item(reader, entry->section, child, item));
    }
    return BRC_OK;
}

static brc_status read_entry(brc_reader *reader, const brc_entry *entry, const brc_node *node, char *base)
{
    const bool given = brc_entry_is_switch(entry) && node->kind == BRC_NODE_SCALAR;
    char found[128];
    if (given && strcmp(node->text, "false") == 0) return BRC_OK;
    if (given && strcmp(node->text, "true") != 0) {
        brc_problems_add(reader->problems, node->mark, "%s: expected a map of keys, or true or false; found %s",
                         entry->key, brc_node_describe(node, found, sizeof found));
        return BRC_OK;
    }
    const brc_node nothing = {
        .kind = BRC_NODE_MAP, .mark = node->mark, .key_mark = node->key_mark, .key = "", .text = ""};
    if (given) node = &nothing;
    if (entry->has_flag) {
        base[entry->has_offset] = true;
        BRC_TRY(brc_reader_remember(reader, base + entry->has_offset, &KEY, node->key_mark));
    }
    switch (entry->type) {
    case BRC_TYPE_STRUCT: return read_section(reader, entry->section, node, base + entry->offset);
    case BRC_TYPE_LIST:
    case BRC_TYPE_NAMED: return read_list(reader, entry, node, base);
    default:
        BRC_TRY(brc_reader_remember(reader, base + entry->offset, entry, node->mark));
        return brc_reader_value(reader, entry, node, base + entry->offset);
    }
}

/* "E, nu, density" into `out`, which is returned; `words` receives the same keys as an array. */
static const char *known_keys(const brc_section *section, const char **words, int *n, char *out, size_t size)
{
    size_t at = 0;
    *n = 0;
    out[0] = '\0';
    for (int i = 0; i < section->n_entries && *n < MANY_KEYS; ++i) {
        words[(*n)++] = section->entries[i].key;
        const int more = at < size ? snprintf(out + at, size - at, "%s%s", at ? ", " : "", section->entries[i].key) : 0;
        at += (size_t)more;
    }
    return out;
}

/* "a ", "an ", or nothing before what is many. */
static const char *article(const char *title)
{
    const size_t n = strlen(title);
    if (n > 1 && title[n - 1] == 's' && !strchr("su", title[n - 2])) return "";
    return strchr("aeiouE", title[0]) ? "an " : "a ";
}

static void complain_of_key(brc_reader *reader, const brc_section *section, const brc_node *node)
{
    const char *words[MANY_KEYS];
    char list[256];
    int n;
    known_keys(section, words, &n, list, sizeof list);
    char hint[BRC_HINT];
    brc_problems_add(reader->problems, node->key_mark, "unknown key '%.60s' in %s%s%s; known: %s", node->key,
                     article(section->title), section->title, brc_hint_key(reader->problems, section, node->key, hint),
                     list);
}

static brc_status read_one_of(brc_reader *reader, const brc_section *section, const brc_node *node, char *base)
{
    const char *words[MANY_KEYS];
    char list[256], found[128];
    int n;
    known_keys(section, words, &n, list, sizeof list);
    const brc_entry *variant = NULL;
    const brc_node *value = node;
    const brc_node nothing = {.kind = BRC_NODE_MAP, .mark = node->mark, .key_mark = node->mark, .key = "", .text = ""};
    if (node->kind == BRC_NODE_SCALAR) { /* a word alone: the variant with its defaults */
        variant = brc_section_find(section, node->text);
        if (variant && variant->type == BRC_TYPE_STRUCT)
            value = &nothing;
        else
            variant = section->short_key && !variant ? brc_section_find(section, section->short_key) : NULL;
    } else if (node->kind == BRC_NODE_MAP && node->n_children == 1) {
        value = node->first;
        variant = brc_section_find(section, value->key);
        if (!variant) {
            complain_of_key(reader, section, value);
            return BRC_OK;
        }
    }
    if (!variant) {
        char hint[BRC_HINT] = "";
        if (node->kind == BRC_NODE_SCALAR) brc_hint_key(reader->problems, section, node->text, hint);
        brc_problems_add(
            reader->problems, node->mark, "%s: expected exactly one of %s; found %s%s%s", section->title, list,
            brc_node_describe(node, found, sizeof found),
            node->kind == BRC_NODE_MAP ? (node->n_children ? " of several keys, keep one" : " without a key") : "",
            hint);
        return BRC_OK;
    }
    if (section->has_kind) {
        const int32_t kind = variant->value;
        memcpy(base + section->kind_offset, &kind, sizeof kind);
        BRC_TRY(brc_reader_remember(reader, base + section->kind_offset, &KEY, node->mark));
    }
    return read_entry(reader, variant, value, base);
}

brc_status brc_reader_defaults(brc_reader *reader, const brc_section *section, brc_mark mark, void *base)
{
    const brc_node nothing = {.kind = BRC_NODE_MAP, .mark = mark, .key_mark = mark, .key = "", .text = ""};
    return read_section(reader, section, &nothing, base);
}

static void check_group(brc_reader *reader, const brc_section *section, const brc_group *group, const brc_node *map)
{
    char list[160] = "";
    int n_given = 0;
    const brc_node *last = NULL;
    for (int i = 0; group->keys[i]; ++i) {
        const size_t at = strlen(list);
        snprintf(list + at, sizeof list - at, "%s%s", i ? ", " : "", group->keys[i]);
        const brc_node *child = brc_node_find(map, group->keys[i]);
        if (!child) continue;
        ++n_given;
        const brc_mark *late = last ? &last->key_mark : NULL, *here = &child->key_mark;
        if (!late || here->line > late->line || (here->line == late->line && here->column > late->column)) last = child;
    }
    const bool too_few = n_given == 0 && group->rule != BRC_GROUP_AT_MOST_ONE;
    const bool too_many = n_given > 1 && group->rule != BRC_GROUP_AT_LEAST_ONE;
    if (too_few)
        brc_problems_add(reader->problems, map->mark, "%s: expected %s one of %s; found none", section->title,
                         group->rule == BRC_GROUP_EXACTLY_ONE ? "exactly" : "at least", list);
    else if (too_many)
        brc_problems_add(reader->problems, last->key_mark, "%s: expected only one of %s; found %d of them, keep one",
                         section->title, list, n_given);
}

/* An entry that the text leaves out. */
static brc_status read_default(brc_reader *reader, const brc_section *section, const brc_entry *entry,
                               const brc_node *map, char *base)
{
    if (entry->required)
        brc_problems_add(reader->problems, map->mark, "the key '%s' is missing in this %s: %s%s%s%s%s", entry->key,
                         section->title, entry->meaning, entry->sample ? ", as in " : "",
                         entry->sample ? entry->key : "", entry->sample ? ": " : "",
                         entry->sample ? entry->sample : "");
    if (entry->required || !entry->given) return BRC_OK;
    const brc_node node = {.kind = strcmp(entry->given, "{}") == 0 ? BRC_NODE_MAP : BRC_NODE_SCALAR,
                           .mark = map->mark,
                           .key_mark = map->mark,
                           .key = entry->key,
                           .text = entry->given};
    return read_entry(reader, entry, &node, base);
}

/* The key that a section's map follows: the last word of its title ("solver dynamic", "contact"). */
static const char *key_of(const brc_section *section)
{
    const char *last = strrchr(section->title, ' ');
    return last ? last + 1 : section->title;
}

static brc_status read_section(brc_reader *reader, const brc_section *section, const brc_node *node, char *base)
{
    static const brc_section EMPTY = {.title = "variant without keys"};
    if (!section) section = &EMPTY;
    if (section->one_of) return read_one_of(reader, section, node, base);
    char found[128];
    brc_node short_value = *node, short_map = {.kind = BRC_NODE_MAP, .mark = node->mark, .key = "", .text = ""};
    if (node->kind == BRC_NODE_SCALAR && section->short_key && node->text[0] != '\0') { /* as if the key were there */
        short_value.key = section->short_key;
        short_value.key_mark = node->mark;
        short_value.next = NULL;
        short_map.n_children = 1;
        short_map.first = short_map.last = &short_value;
        node = &short_map;
    }
    if (node->kind != BRC_NODE_MAP) {
        char hint[BRC_HINT];
        brc_problems_add(reader->problems, node->mark, "%s: expected a map of keys, found %s%s", section->title,
                         brc_node_describe(node, found, sizeof found), brc_hint_map(section, key_of(section), hint));
        return BRC_OK;
    }
    for (const brc_node *child = node->first; child; child = child->next)
        if (!brc_section_find(section, child->key)) complain_of_key(reader, section, child);
    for (int i = 0; i < section->n_entries; ++i) {
        const brc_entry *entry = &section->entries[i];
        const int before = brc_problems_count(reader->problems);
        if (section == brc_schema() && strcmp(entry->key, "measure") == 0) BRC_TRY(brc_reader_expand_fixtures(reader));
        const brc_node *child = brc_node_find(node, entry->key);
        BRC_TRY(child ? read_entry(reader, entry, child, base) : read_default(reader, section, entry, node, base));
        if (section == brc_schema()) reader->broken[i] = brc_problems_count(reader->problems) > before;
    }
    for (size_t g = 0; g < sizeof section->groups / sizeof section->groups[0]; ++g)
        if (section->groups[g].rule != BRC_GROUP_NONE) check_group(reader, section, &section->groups[g], node);
    return BRC_OK;
}

/* Everything before a "/" at the end of the name, "." when there is none. */
static void set_folder(brc_scene *scene, const char *name)
{
    const char *slash = strrchr(name, '/');
    const size_t length = slash == name ? 1 : slash ? (size_t)(slash - name) : 0;
    if (length > 0 && length < sizeof scene->folder)
        memcpy(scene->folder, name, length);
    else
        strcpy(scene->folder, ".");
}

static brc_status read_tree(brc_reader *reader, brc_tree *tree, const char *name, const char *text, size_t bytes,
                            int n_overrides, const char *const *overrides)
{
    brc_node *root = NULL;
    char found[128];
    BRC_TRY(brc_tree_parse(tree, reader->problems, 0, text, bytes, &root));
    const brc_mark start = {0, 1, 1};
    if (!root) {
        if (brc_problems_count(reader->problems) == 0)
            brc_problems_add(reader->problems, start,
                             "the scene is empty; expected keys such as version, materials, "
                             "bodies, stages");
        return BRC_OK;
    }
    if (root->kind != BRC_NODE_MAP) {
        brc_problems_add(reader->problems, root->mark,
                         "expected a map with keys such as version, materials, bodies, "
                         "stages; found %s",
                         brc_node_describe(root, found, sizeof found));
        return BRC_OK;
    }
    for (int i = 0; i < n_overrides; ++i)
        BRC_TRY(brc_tree_override(tree, reader->problems, root, i + 1, overrides[i]));
    set_folder(reader->scene, name);
    BRC_TRY(read_section(reader, brc_schema(), root, (char *)reader->scene));
    return brc_reader_check(reader);
}

brc_status brc_scene_read_text(brc_context *context, const char *name, const char *text, size_t bytes, int n_overrides,
                               const char *const *overrides, brc_scene **out)
{
    *out = NULL;
    brc_reader reader = {.context = context};
    brc_tree *tree = NULL;
    brc_status status;
    if (bytes > FILE_LIMIT)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: has %zu bytes, at most %zu are read as a scene", name, bytes,
                        FILE_LIMIT);
    BRC_TRY_OR(cleanup, brc_problems_create(context, name, n_overrides, overrides, &reader.problems));
    BRC_TRY_OR(cleanup, brc_tree_create(context, &tree));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &reader.scene, 1, "scene"));
    BRC_TRY_OR(cleanup, read_tree(&reader, tree, name, text, bytes, n_overrides, overrides));
    BRC_TRY_OR(cleanup, brc_problems_report(reader.problems));
    *out = reader.scene;
    reader.scene = NULL;
cleanup:
    brc_scene_free(&reader.scene);
    brc_memory_free(reader.places);
    brc_tree_free(&tree);
    brc_problems_free(&reader.problems);
    return status;
}

brc_status brc_scene_read(brc_context *context, const char *path, int n_overrides, const char *const *overrides,
                          brc_scene **out)
{
    *out = NULL;
    char *text = NULL;
    size_t bytes = 0;
    BRC_TRY(brc_file_read_whole(context, path, FILE_LIMIT, &text, &bytes));
    const brc_status status = brc_scene_read_text(context, path, text, bytes, n_overrides, overrides, out);
    brc_memory_free(text);
    return status;
}
