/* Nodes of a tree read as values. */
#include "case_node.h"
#include "../../base/memory.h"
#include "../../scene/unit.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

void brc_case_wrong(const brc_case_reader *r, const brc_node *node, const char *expected)
{
    char found[96];
    brc_problems_add(r->problems, node->mark, "%s%sfound %s, expected %s", node->key, node->key[0] ? ": " : "",
                     brc_node_describe(node, found, sizeof found), expected);
}

const char *brc_case_text_of(const brc_case_reader *r, const brc_node *node)
{
    if (node->kind == BRC_NODE_SCALAR) return node->text;
    brc_case_wrong(r, node, "a text");
    return "";
}

bool brc_case_flag_of(const brc_case_reader *r, const brc_node *node)
{
    if (node->kind == BRC_NODE_SCALAR && strcmp(node->text, "true") == 0) return true;
    if (node->kind != BRC_NODE_SCALAR || strcmp(node->text, "false") != 0) brc_case_wrong(r, node, "true or false");
    return false;
}

double brc_case_number_of(const brc_case_reader *r, const brc_node *node)
{
    double value = NAN;
    brc_dimension dimension;
    bool bare;
    if (node->kind != BRC_NODE_SCALAR || brc_quantity_parse(node->text, &value, &dimension, &bare) != BRC_QUANTITY_OK)
        brc_case_wrong(r, node, "a number, e.g. 20 GPa or 1e-5");
    return value;
}

int brc_case_word_of(const brc_case_reader *r, const brc_node *node, const char *const *words)
{
    char expected[160] = "one of:";
    for (int k = 0; words[k]; ++k) {
        if (node->kind == BRC_NODE_SCALAR && strcmp(node->text, words[k]) == 0) return k;
        snprintf(expected + strlen(expected), sizeof expected - strlen(expected), " %s", words[k]);
    }
    brc_case_wrong(r, node, expected);
    return 0;
}

int brc_case_texts_of(const brc_case_reader *r, const brc_node *node, const char **out)
{
    if (node->kind == BRC_NODE_SCALAR) {
        out[0] = node->text;
        return 1;
    }
    int n = 0;
    if (node->kind != BRC_NODE_LIST || node->n_children > BRC_CASE_LIST)
        brc_case_wrong(r, node, "a list of at most " BRC_STRING(BRC_CASE_LIST) " texts");
    else
        for (const brc_node *item = node->first; item; item = item->next)
            out[n++] = brc_case_text_of(r, item);
    return n;
}

int brc_case_pairs_of(const brc_case_reader *r, const brc_node *node, brc_case_pair *out)
{
    int n = 0;
    if (node->kind != BRC_NODE_MAP || node->n_children > BRC_CASE_LIST)
        brc_case_wrong(r, node, "a map of at most " BRC_STRING(BRC_CASE_LIST) " texts");
    else
        for (const brc_node *item = node->first; item; item = item->next)
            out[n++] = (brc_case_pair){item->key, brc_case_text_of(r, item)};
    return n;
}

void brc_case_unknown_key(const brc_case_reader *r, const brc_node *item, const char *where)
{
    brc_problems_add(r->problems, item->key_mark, "unknown key '%s' in a %s", item->key, where);
}

brc_status brc_case_parse(brc_context *context, const char *folder, const char *name, const char *file,
                          const char *shown, brc_tree **tree, brc_problems **problems, brc_node **root)
{
    char *text = NULL;
    size_t bytes = 0;
    *tree = NULL;
    *problems = NULL;
    *root = NULL;
    BRC_TRY(brc_case_text(context, folder, name, file, &text, &bytes));
    brc_status status = brc_tree_create(context, tree);
    if (status == BRC_OK) status = brc_problems_create(context, shown, 0, NULL, problems);
    if (status == BRC_OK) status = brc_tree_parse(*tree, *problems, 0, text, bytes, root);
    brc_memory_free(text);
    return status;
}
