/* Values of the files that describe cases and sweeps: nodes of a tree read as texts, numbers and lists, what is wrong
 * noted with its place. */
#ifndef BRC_COMMANDS_CASE_NODE_H
#define BRC_COMMANDS_CASE_NODE_H

#include "case.h"
#include "../../scene/node.h"

/* Everything a reading function needs; both borrowed. */
typedef struct brc_case_reader {
    brc_context *context;
    brc_problems *problems;
} brc_case_reader;

/* Note that the node is not what is expected. */
void brc_case_wrong(const brc_case_reader *r, const brc_node *node, const char *expected);
void brc_case_unknown_key(const brc_case_reader *r, const brc_node *item, const char *where);
/* Values; "", false, NAN or 0 with a note where the node is none. Texts are owned by the tree. */
const char *brc_case_text_of(const brc_case_reader *r, const brc_node *node);
bool brc_case_flag_of(const brc_case_reader *r, const brc_node *node);
/* A number, with a unit or without; in SI. */
double brc_case_number_of(const brc_case_reader *r, const brc_node *node);
/* The index of the word in a list that ends with NULL. */
int brc_case_word_of(const brc_case_reader *r, const brc_node *node, const char *const *words);
/* Texts of a list (a lone text is a list of one), at most BRC_CASE_LIST; how many. */
int brc_case_texts_of(const brc_case_reader *r, const brc_node *node, const char **out);
int brc_case_pairs_of(const brc_case_reader *r, const brc_node *node, brc_case_pair *out);

/* Read `file` of a case into a tree of its own; *root is owned by *tree. `problems` is made for it and shows the file
 * as `shown`, borrowed till then. All freed by the caller, also after a failure. */
brc_status brc_case_parse(brc_context *context, const char *folder, const char *name, const char *file,
                          const char *shown, brc_tree **tree, brc_problems **problems, brc_node **root);

#endif
