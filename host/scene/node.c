/* Building the tree of nodes from libyaml's events, with every limit a hostile file may try. */
#include "node.h"
#include "../base/memory.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#define CHUNK ((size_t)1 << 16)

/* Memory of a tree: chunks freed together. */
typedef struct chunk {
    struct chunk *next;
    size_t used, size;
    _Alignas(16) char bytes[];
} chunk;

struct brc_tree {
    brc_context *context;
    chunk *chunks;
    int n_nodes;
};

/* An anchor of the document being parsed. */
typedef struct anchor {
    const char *name;
    brc_node *node;
    struct anchor *next;
} anchor;

/* One parsing: the open lists and maps from the root down, and a key waiting for its value. */
typedef struct builder {
    brc_tree *tree;
    brc_problems *problems;
    int source;
    brc_node *open[BRC_NODE_DEEPEST];
    const char *key[BRC_NODE_DEEPEST]; /* NULL: the next scalar of this map is a key */
    brc_mark key_mark[BRC_NODE_DEEPEST];
    int depth;
    brc_node *root;
    anchor *anchors;
    bool stopped; /* a problem that ends the parsing */
} builder;

brc_status brc_tree_create(brc_context *context, brc_tree **out)
{
    BRC_TRY(brc_memory_allocate(context, (void **)out, 1, sizeof **out, "scene tree"));
    (*out)->context = context;
    return BRC_OK;
}

void brc_tree_free(brc_tree **tree)
{
    if (!tree || !*tree) return;
    for (chunk *c = (*tree)->chunks; c;) {
        chunk *next = c->next;
        brc_memory_free(c);
        c = next;
    }
    brc_memory_free(*tree);
    *tree = NULL;
}

/* Zeroed bytes that live as long as the tree; NULL when memory is exhausted (the sentence is recorded). */
static void *tree_bytes(brc_tree *tree, size_t size)
{
    size = (size + 15) / 16 * 16;
    if (!tree->chunks || tree->chunks->size - tree->chunks->used < size) {
        const size_t room = size > CHUNK ? size : CHUNK;
        chunk *fresh = NULL;
        if (brc_memory_allocate(tree->context, (void **)&fresh, (int64_t)(sizeof *fresh + room), 1, "scene tree"))
            return NULL;
        fresh->size = room;
        fresh->next = tree->chunks;
        tree->chunks = fresh;
    }
    void *block = tree->chunks->bytes + tree->chunks->used;
    tree->chunks->used += size;
    return block;
}

static const char *tree_text(brc_tree *tree, const char *text, size_t length)
{
    char *copy = tree_bytes(tree, length + 1);
    if (copy) memcpy(copy, text, length);
    return copy;
}

static brc_node *tree_node(brc_tree *tree, brc_node_kind kind, brc_mark mark)
{
    brc_node *node = tree_bytes(tree, sizeof *node);
    if (!node) return NULL;
    ++tree->n_nodes;
    node->kind = kind;
    node->mark = node->key_mark = mark;
    node->key = node->text = "";
    return node;
}

static void append(brc_node *parent, brc_node *child)
{
    if (parent->last)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
    ++parent->n_children;
}

/* Deep copy for an alias, its marks those of the original: that is where its text must be mended. NULL: no memory, or
 * *refused is set because the copy would go beyond a limit. */
static brc_node *copy_node(brc_tree *tree, const brc_node *from, int depth, bool *refused)
{
    if (tree->n_nodes > BRC_NODE_MOST || depth > BRC_NODE_DEEPEST) *refused = true;
    if (*refused) return NULL;
    brc_node *node = tree_node(tree, from->kind, from->mark);
    if (!node) return NULL;
    node->quoted = from->quoted;
    node->key = from->key;
    node->key_mark = from->key_mark;
    node->text = from->text;
    for (const brc_node *child = from->first; child; child = child->next) {
        brc_node *copy = copy_node(tree, child, depth + 1, refused);
        if (!copy) return NULL;
        append(node, copy);
    }
    return node;
}

brc_node *brc_node_find(const brc_node *map, const char *key)
{
    if (map->kind != BRC_NODE_MAP) return NULL;
    for (brc_node *child = map->first; child; child = child->next)
        if (strcmp(child->key, key) == 0) return child;
    return NULL;
}

const char *brc_node_describe(const brc_node *node, char *out, size_t size)
{
    if (node->kind == BRC_NODE_LIST)
        snprintf(out, size, "a list of %d", node->n_children);
    else if (node->kind == BRC_NODE_MAP)
        snprintf(out, size, "a map");
    else if (node->text[0] == '\0')
        snprintf(out, size, "nothing");
    else
        snprintf(out, size, "'%.80s'%s", node->text, strlen(node->text) > 80 ? "..." : "");
    return out;
}

static brc_mark mark_of(const builder *b, yaml_mark_t mark)
{
    return (brc_mark){b->source, (int)mark.line + 1, (int)mark.column + 1};
}

#define STOP(b, mark, ...)                                                                                             \
    do {                                                                                                               \
        brc_problems_add((b)->problems, (mark), __VA_ARGS__);                                                          \
        (b)->stopped = true;                                                                                           \
        return BRC_OK;                                                                                                 \
    } while (0)

/* A finished or just opened node finds its place: root, item of a list, value of a key. */
static brc_status place(builder *b, brc_node *node)
{
    if (b->tree->n_nodes > BRC_NODE_MOST)
        STOP(b, node->mark, "more than %d values; aliases count as often as they are used", BRC_NODE_MOST);
    if (b->depth == 0) {
        b->root = node;
        return BRC_OK;
    }
    const int top = b->depth - 1;
    if (b->open[top]->kind == BRC_NODE_MAP) {
        if (!b->key[top]) STOP(b, node->mark, "a key must be a plain word, found a list or a map");
        node->key = b->key[top];
        node->key_mark = b->key_mark[top];
        b->key[top] = NULL;
    }
    append(b->open[top], node);
    return BRC_OK;
}

static brc_status remember(builder *b, const yaml_char_t *name, brc_node *node)
{
    if (!name) return BRC_OK;
    anchor *fresh = tree_bytes(b->tree, sizeof *fresh);
    if (!fresh) return BRC_NO_MEMORY;
    fresh->name = tree_text(b->tree, (const char *)name, strlen((const char *)name));
    if (!fresh->name) return BRC_NO_MEMORY;
    fresh->node = node;
    fresh->next = b->anchors;
    b->anchors = fresh;
    return BRC_OK;
}

static brc_status on_alias(builder *b, const yaml_event_t *event)
{
    const char *name = (const char *)event->data.alias.anchor;
    const brc_mark mark = mark_of(b, event->start_mark);
    if (b->depth > 0 && b->open[b->depth - 1]->kind == BRC_NODE_MAP && !b->key[b->depth - 1])
        STOP(b, mark, "a key must be a plain word, found the alias *%.80s", name);
    for (const anchor *a = b->anchors; a; a = a->next) {
        if (strcmp(a->name, name) != 0) continue;
        for (int d = 0; d < b->depth; ++d)
            if (b->open[d] == a->node) STOP(b, mark, "the alias *%.80s stands inside what it refers to", name);
        bool refused = false;
        brc_node *copy = copy_node(b->tree, a->node, b->depth, &refused);
        if (refused)
            STOP(b, mark, "the alias *%.80s leads to more than %d values or %d levels", name, BRC_NODE_MOST,
                 BRC_NODE_DEEPEST);
        if (!copy) return BRC_NO_MEMORY;
        copy->key = "";
        return place(b, copy);
    }
    STOP(b, mark, "the alias *%.80s has no anchor &%.80s before it; a text that begins with * stands in quotes", name,
         name);
}

static brc_status on_scalar(builder *b, const yaml_event_t *event)
{
    const brc_mark mark = mark_of(b, event->start_mark);
    const char *value = (const char *)event->data.scalar.value;
    const size_t length = event->data.scalar.length;
    for (size_t i = 0; i < length; ++i)
        if ((unsigned char)value[i] < 0x20 || value[i] == 0x7f)
            STOP(b, mark, "the text contains a control character or a line break; write it as one line");
    if (event->data.scalar.tag) STOP(b, mark, "tags like '%.80s' are not used in scenes", event->data.scalar.tag);
    const char *text = tree_text(b->tree, value, length);
    if (!text) return BRC_NO_MEMORY;
    const int top = b->depth - 1;
    if (b->depth > 0 && b->open[top]->kind == BRC_NODE_MAP && !b->key[top]) {
        b->key[top] = text;
        b->key_mark[top] = mark;
        return BRC_OK;
    }
    brc_node *node = tree_node(b->tree, BRC_NODE_SCALAR, mark);
    if (!node) return BRC_NO_MEMORY;
    node->text = text;
    node->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    BRC_TRY(remember(b, event->data.scalar.anchor, node));
    return place(b, node);
}

static brc_status on_open(builder *b, const yaml_event_t *event, brc_node_kind kind, const yaml_char_t *name,
                          const yaml_char_t *tag)
{
    const brc_mark mark = mark_of(b, event->start_mark);
    if (tag) STOP(b, mark, "tags like '%.80s' are not used in scenes", (const char *)tag);
    if (b->depth == BRC_NODE_DEEPEST) STOP(b, mark, "nested deeper than %d levels", BRC_NODE_DEEPEST);
    brc_node *node = tree_node(b->tree, kind, mark);
    if (!node) return BRC_NO_MEMORY;
    BRC_TRY(remember(b, name, node));
    BRC_TRY(place(b, node));
    b->open[b->depth] = node;
    b->key[b->depth] = NULL;
    ++b->depth;
    return BRC_OK;
}

static int by_key(const void *left, const void *right)
{
    const brc_node *a = *(const brc_node *const *)left, *b = *(const brc_node *const *)right;
    const int order = strcmp(a->key, b->key);
    if (order != 0) return order;
    if (a->key_mark.line != b->key_mark.line) return a->key_mark.line < b->key_mark.line ? -1 : 1;
    return a->key_mark.column < b->key_mark.column ? -1 : a->key_mark.column > b->key_mark.column;
}

/* libyaml takes a key twice without a word; here every repetition is a problem. */
static brc_status refuse_duplicates(builder *b, const brc_node *map)
{
    if (map->n_children < 2) return BRC_OK;
    const brc_node **sorted = NULL;
    BRC_TRY(BRC_ALLOCATE(b->tree->context, &sorted, map->n_children, "keys of a map"));
    int n = 0;
    for (const brc_node *child = map->first; child; child = child->next)
        sorted[n++] = child;
    qsort(sorted, (size_t)n, sizeof *sorted, by_key);
    for (int i = 1; i < n; ++i)
        if (strcmp(sorted[i - 1]->key, sorted[i]->key) == 0)
            brc_problems_add(b->problems, sorted[i]->key_mark, "duplicate key '%.80s', given before at %d:%d; keep one",
                             sorted[i]->key, sorted[i - 1]->key_mark.line, sorted[i - 1]->key_mark.column);
    brc_memory_free(sorted);
    return BRC_OK;
}

static brc_status on_event(builder *b, const yaml_event_t *event, int *n_documents)
{
    switch (event->type) {
    case YAML_DOCUMENT_START_EVENT:
        if (++*n_documents > 1)
            STOP(b, mark_of(b, event->start_mark), "a second document begins; a scene is one document");
        return BRC_OK;
    case YAML_ALIAS_EVENT: return on_alias(b, event);
    case YAML_SCALAR_EVENT: return on_scalar(b, event);
    case YAML_SEQUENCE_START_EVENT:
        return on_open(b, event, BRC_NODE_LIST, event->data.sequence_start.anchor, event->data.sequence_start.tag);
    case YAML_MAPPING_START_EVENT:
        return on_open(b, event, BRC_NODE_MAP, event->data.mapping_start.anchor, event->data.mapping_start.tag);
    case YAML_MAPPING_END_EVENT: --b->depth; return refuse_duplicates(b, b->open[b->depth]);
    case YAML_SEQUENCE_END_EVENT: --b->depth; return BRC_OK;
    default: return BRC_OK;
    }
}

/* Length of the UTF-8 sequence at `s`, 0 when it is none (RFC 3629: no overlong forms, no surrogates). */
static size_t utf8_length(const unsigned char *s, size_t left)
{
    const unsigned char c = s[0];
    if (c < 0x80) return 1;
    const size_t n = c >= 0xc2 && c <= 0xdf ? 2 : (c & 0xf0) == 0xe0 ? 3 : c >= 0xf0 && c <= 0xf4 ? 4 : 0;
    if (n == 0 || n > left) return 0;
    for (size_t i = 1; i < n; ++i)
        if ((s[i] & 0xc0) != 0x80) return 0;
    if (c == 0xe0 && s[1] < 0xa0) return 0;
    if (c == 0xed && s[1] > 0x9f) return 0;
    if (c == 0xf0 && s[1] < 0x90) return 0;
    if (c == 0xf4 && s[1] > 0x8f) return 0;
    return n;
}

/* libyaml reports bad bytes without a line; this does it first. */
static bool bytes_are_text(builder *b, const char *text, size_t bytes)
{
    brc_mark mark = {b->source, 1, 1};
    for (size_t at = 0; at < bytes;) {
        const unsigned char *s = (const unsigned char *)text + at;
        const size_t length = utf8_length(s, bytes - at);
        if (length == 0) {
            brc_problems_add(b->problems, mark, "the byte 0x%02x is not UTF-8; save the file as UTF-8", s[0]);
            return false;
        }
        if ((s[0] < 0x20 && s[0] != '\n' && s[0] != '\r' && s[0] != '\t') || s[0] == 0x7f) {
            brc_problems_add(b->problems, mark, "the control byte 0x%02x does not belong in a text", s[0]);
            return false;
        }
        if (s[0] == '\n')
            mark = (brc_mark){b->source, mark.line + 1, 1};
        else
            ++mark.column;
        at += length;
    }
    return true;
}

/* What to do about the commonest slips in YAML's own grammar. */
static const char *cure_of(const yaml_parser_t *parser, const char *text, size_t bytes)
{
    const char *problem = parser->problem ? parser->problem : "";
    if (parser->problem_mark.index < bytes && text[parser->problem_mark.index] == '\t')
        return "; indent with blanks, not with tabs";
    if (strstr(problem, "expected ':'")) return "; write `key: value`, with a blank behind the colon";
    if (strstr(problem, "expected ',' or '}'")) return "; separate entries by commas, and close every { with }";
    if (strstr(problem, "expected ',' or ']'"))
        return "; separate items by commas, and close every [ with ]; each item has its own unit";
    if (strstr(problem, "mapping values are not allowed"))
        return "; begin a new line for the next key, and put blanks behind colons only";
    if (strstr(problem, "did not find expected key") || strstr(problem, "block"))
        return "; keys of one map begin in the same column";
    return "";
}

brc_status brc_tree_parse(brc_tree *tree, brc_problems *problems, int source, const char *text, size_t bytes,
                          brc_node **out)
{
    *out = NULL;
    builder b = {.tree = tree, .problems = problems, .source = source};
    if (!bytes_are_text(&b, text, bytes)) return BRC_OK;
    if (bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) { /* a byte order mark, which libyaml takes for a word */
        text += 3;
        bytes -= 3;
    }
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) return BRC_FAIL(tree->context, BRC_NO_MEMORY, "no memory for libyaml");
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, bytes);
    brc_status status = BRC_OK;
    int n_documents = 0;
    for (bool done = false; !done && !b.stopped && status == BRC_OK;) {
        yaml_event_t event;
        if (!yaml_parser_parse(&parser, &event)) {
            if (parser.error == YAML_MEMORY_ERROR)
                status = BRC_FAIL(tree->context, BRC_NO_MEMORY, "no memory for libyaml");
            else
                brc_problems_add(problems, mark_of(&b, parser.problem_mark), "not YAML: %s%s%s%s",
                                 parser.problem ? parser.problem : "unreadable", parser.context ? ", " : "",
                                 parser.context ? parser.context : "", cure_of(&parser, text, bytes));
            b.stopped = true;
            break;
        }
        done = event.type == YAML_STREAM_END_EVENT;
        status = on_event(&b, &event, &n_documents);
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    if (status == BRC_OK && !b.stopped) *out = b.root;
    return status;
}

/* --- overrides --- */

/* Step from `at` to the child that `word` names; NULL when a list has no such item. */
static brc_node *step(brc_tree *tree, brc_node *at, const char *word, brc_mark mark)
{
    if (at->kind == BRC_NODE_LIST) {
        char *end = NULL;
        const long index = strtol(word, &end, 10);
        const bool is_index = word[0] >= '0' && word[0] <= '9' && *end == '\0';
        long i = 0;
        for (brc_node *child = at->first; child; child = child->next, ++i) {
            if (is_index && i == index) return child;
            const brc_node *name = brc_node_find(child, "name");
            if (!is_index && name && strcmp(name->text, word) == 0) return child;
        }
        return NULL;
    }
    if (at->kind == BRC_NODE_SCALAR) { /* "solver: static" on the way to solver.static.increments */
        at->kind = BRC_NODE_MAP;
        at->text = "";
    }
    brc_node *child = brc_node_find(at, word);
    if (child) return child;
    child = tree_node(tree, BRC_NODE_SCALAR, mark);
    if (!child) return NULL;
    child->key = tree_text(tree, word, strlen(word));
    if (!child->key) return NULL;
    append(at, child);
    return child;
}

brc_status brc_tree_override(brc_tree *tree, brc_problems *problems, brc_node *root, int source, const char *override)
{
    const brc_mark mark = {source, 0, 0};
    const char *equals = strchr(override, '=');
    if (!equals || equals == override) {
        brc_problems_add(problems, mark, "expected dotted.path=value, as in bodies.0.fill.noisy_grid.elements=1000");
        return BRC_OK;
    }
    brc_node *value = NULL;
    BRC_TRY(brc_tree_parse(tree, problems, source, equals + 1, strlen(equals + 1), &value));
    if (!value) {
        if (equals[1] == '\0') brc_problems_add(problems, mark, "there is no value after '='");
        return BRC_OK;
    }
    char *path = tree_bytes(tree, (size_t)(equals - override) + 1);
    if (!path) return BRC_NO_MEMORY;
    memcpy(path, override, (size_t)(equals - override));
    brc_node *at = root;
    for (char *word = path, *dot; word; word = dot ? dot + 1 : NULL) {
        dot = strchr(word, '.');
        if (dot) *dot = '\0';
        const brc_node *parent = at;
        at = step(tree, at, word, mark);
        if (at) continue;
        if (parent->kind != BRC_NODE_LIST) return BRC_NO_MEMORY;
        brc_problems_add(problems, mark, "the list has no item '%.80s': it has %d, counted from 0 or called by `name`",
                         word, parent->n_children);
        return BRC_OK;
    }
    /* The value takes the place of what stood there, and keeps its key. */
    at->kind = value->kind;
    at->quoted = value->quoted;
    at->mark = value->mark;
    at->text = value->text;
    at->n_children = value->n_children;
    at->first = value->first;
    at->last = value->last;
    return BRC_OK;
}
