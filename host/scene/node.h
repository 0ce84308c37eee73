/* The text of a scene as a tree of nodes, each with its place; before any meaning is given to it.
 *
 * YAML through libyaml's events. Refused here: what is not UTF-8, more than one document, tags, keys that are not plain
 * words, duplicate keys, nesting deeper than BRC_NODE_DEEPEST, more than BRC_NODE_MOST nodes after aliases are copied
 * (so a "billion laughs" file ends early). */
#ifndef BRC_SCENE_NODE_H
#define BRC_SCENE_NODE_H

#include "problem.h"

#define BRC_NODE_DEEPEST 64
#define BRC_NODE_MOST 250000

typedef enum brc_node_kind { BRC_NODE_SCALAR, BRC_NODE_LIST, BRC_NODE_MAP } brc_node_kind;

/* Children are a linked list in the order of the text; in a map each child has its key. */
typedef struct brc_node {
    brc_node_kind kind;
    bool quoted;   /* scalar in quotation marks */
    brc_mark mark; /* of the value */
    brc_mark key_mark;
    const char *key;  /* "" outside maps */
    const char *text; /* scalar: its text, NUL-terminated without inner NUL; else "" */
    int n_children;
    struct brc_node *first, *last, *next;
} brc_node;

/* Owner of nodes and their texts. */
typedef struct brc_tree brc_tree;

brc_status brc_tree_create(brc_context *context, brc_tree **out);
void brc_tree_free(brc_tree **tree);
/* Parse a text into nodes owned by the tree. Errors are added to `problems`, *out is NULL when no tree came of it.
 * source: as in brc_mark. Returns BRC_NO_MEMORY or BRC_OK (also with problems). */
brc_status brc_tree_parse(brc_tree *tree, brc_problems *problems, int source, const char *text, size_t bytes,
                          brc_node **out);
/* Apply "dotted.path=value" to a root: lists by index or by the `name` of an item. Missing keys are made (the schema
 * judges them); a word standing for a map ("solver: static") becomes the map. */
brc_status brc_tree_override(brc_tree *tree, brc_problems *problems, brc_node *root, int source, const char *override);
/* The child with this key, NULL when there is none. */
brc_node *brc_node_find(const brc_node *map, const char *key);
/* "a list", "a map", "the text 'abc'" for messages; written into `out`, which is also returned. */
const char *brc_node_describe(const brc_node *node, char *out, size_t size);

#endif
