/* Reading a case: the node tree of scenes, with keys of our own. */
#include "case_files.h"
#include "case_node.h"
#include "operators.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

/* Position of "/case.yaml" in a path of that file, 0 for other files. */
static size_t case_part(const char *path)
{
    const char *slash = strchr(path, '/');
    return slash && strcmp(slash, "/case.yaml") == 0 ? (size_t)(slash - path) : 0;
}

const char *brc_case_name(int k)
{
    for (int f = 0; f < brc_case_file_count; ++f)
        if (case_part(brc_case_files[f].path) > 0 && k-- == 0) return brc_case_files[f].path;
    return NULL;
}

/* A key of a row; false when it is none. */
static bool read_row_key(const brc_case_reader *r, const brc_node *item, brc_case_row *row)
{
    if (strcmp(item->key, "unit") == 0)
        row->unit = brc_case_text_of(r, item);
    else if (strcmp(item->key, "reference") == 0)
        row->reference = brc_case_number_of(r, item);
    else if (strcmp(item->key, "paper") == 0)
        row->paper = brc_case_number_of(r, item);
    else if (strcmp(item->key, "absolute") == 0)
        row->absolute = brc_case_flag_of(r, item);
    else if (strcmp(item->key, "bound") == 0)
        row->rule = BRC_CASE_ERROR_BOUND, row->bound = brc_case_number_of(r, item);
    else if (strcmp(item->key, "at_most") == 0)
        row->rule = BRC_CASE_AT_MOST, row->bound = brc_case_number_of(r, item);
    else if (strcmp(item->key, "at_least") == 0)
        row->rule = BRC_CASE_AT_LEAST, row->bound = brc_case_number_of(r, item);
    else
        return false;
    return true;
}

static brc_case_row empty_row(const char *quantity)
{
    return (brc_case_row){
        .quantity = quantity, .unit = "-", .reference = NAN, .paper = NAN, .rule = BRC_CASE_INFORMATION};
}

static brc_status read_rows(const brc_case_reader *r, const brc_node *node, brc_case_run *run)
{
    if (node->kind != BRC_NODE_MAP) {
        brc_case_wrong(r, node, "a map from quantity to what is expected of it");
        return BRC_OK;
    }
    BRC_TRY(BRC_ALLOCATE(r->context, &run->rows, node->n_children, "rows of a case"));
    for (const brc_node *item = node->first; item; item = item->next) {
        brc_case_row *row = &run->rows[run->n_rows++];
        *row = empty_row(item->key);
        if (item->kind != BRC_NODE_MAP) brc_case_wrong(r, item, "a map such as {reference: 0.3, bound: 1e-5}");
        for (const brc_node *key = item->first; item->kind == BRC_NODE_MAP && key; key = key->next)
            if (!read_row_key(r, key, row)) brc_case_unknown_key(r, key, "row");
    }
    return BRC_OK;
}

static const char *const precisions[] = {"double", "mixed", "single", NULL};

static brc_status read_run(const brc_case_reader *r, const brc_node *node, brc_case_run *run)
{
    *run = (brc_case_run){
        .name = "", .scene = "scene.yaml", .about = "", .operator= & brc_operator_measures, .n_seeds = 1};
    if (node->kind != BRC_NODE_MAP) brc_case_wrong(r, node, "a map");
    for (const brc_node *item = node->first; node->kind == BRC_NODE_MAP && item; item = item->next) {
        if (strcmp(item->key, "name") == 0)
            run->name = brc_case_text_of(r, item);
        else if (strcmp(item->key, "scene") == 0)
            run->scene = brc_case_text_of(r, item);
        else if (strcmp(item->key, "about") == 0)
            run->about = brc_case_text_of(r, item);
        else if (strcmp(item->key, "precisions") == 0)
            continue; /* read_runs makes one run of each */
        else if (strcmp(item->key, "quick") == 0)
            run->quick = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "keep") == 0)
            run->keep = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "may_stop") == 0)
            run->may_stop = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "exact") == 0)
            run->exact = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "with") == 0)
            run->operator= brc_operator_of(r, item);
        else if (strcmp(item->key, "device") == 0)
            run->device = brc_case_text_of(r, item);
        else if (strcmp(item->key, "precision") == 0)
            run->has_precision = true, run->precision = (brc_precision)brc_case_word_of(r, item, precisions);
        else if (strcmp(item->key, "threads") == 0)
            run->n_threads = (int)brc_case_number_of(r, item);
        else if (strcmp(item->key, "seeds") == 0) {
            run->n_seeds = (int)brc_case_number_of(r, item);
            if (run->n_seeds < 1) brc_case_wrong(r, item, "1 or more samples");
        } else if (strcmp(item->key, "half_angle") == 0)
            run->half_angle = brc_case_number_of(r, item);
        else if (strcmp(item->key, "files") == 0)
            run->n_files = brc_case_texts_of(r, item, run->files);
        else if (strcmp(item->key, "set") == 0)
            run->n_overrides = brc_case_texts_of(r, item, run->overrides);
        else if (strcmp(item->key, "label") == 0)
            run->n_labels = brc_case_pairs_of(r, item, run->labels);
        else if (strcmp(item->key, "rows") == 0)
            BRC_TRY(read_rows(r, item, run));
        else
            brc_case_unknown_key(r, item, "run");
    }
    if (!run->name[0]) brc_case_wrong(r, node, "a run with a name");
    return BRC_OK;
}

/* One run, or with `precisions` one in each of them: called NAME-PRECISION, labelled with it, the sentence at the
 * first. */
static brc_status read_runs(const brc_case_reader *r, const brc_node *node, brc_case *what)
{
    const char *wanted[BRC_CASE_LIST];
    int n = 0;
    for (const brc_node *item = node->kind == BRC_NODE_MAP ? node->first : NULL; item; item = item->next)
        if (strcmp(item->key, "precisions") == 0)
            for (const brc_node *word = item->kind == BRC_NODE_LIST ? item->first : item; word && n < 3;
                 word = item->kind == BRC_NODE_LIST ? word->next : NULL)
                wanted[n++] = precisions[brc_case_word_of(r, word, precisions)];
    if (n == 0) return read_run(r, node, &what->runs[what->n_runs++]);
    for (int k = 0; k < n; ++k) {
        brc_case_run *run = &what->runs[what->n_runs++];
        char *name;
        BRC_TRY(read_run(r, node, run));
        run->has_precision = true;
        for (int p = 0; precisions[p]; ++p)
            if (wanted[k] == precisions[p]) run->precision = (brc_precision)p;
        if (k > 0) run->about = "";
        if (run->n_labels == BRC_CASE_LIST) continue;
        run->labels[run->n_labels++] = (brc_case_pair){"precision", wanted[k]};
        const size_t size = strlen(run->name) + strlen(wanted[k]) + 2;
        BRC_TRY(BRC_ALLOCATE(r->context, &name, (int64_t)size, "name of a run"));
        snprintf(name, size, "%s-%s", run->name, wanted[k]);
        run->name = run->own_name = name;
    }
    return BRC_OK;
}

static void read_derived(const brc_case_reader *r, const brc_node *node, brc_case_derived *derived)
{
    static const char *const formulas[] = {"mean", "worst", "order", "range", "ratio", "difference", "crossing", NULL};
    *derived = (brc_case_derived){.row = empty_row(""), .of = "", .against = "spacing"};
    if (node->kind != BRC_NODE_MAP) brc_case_wrong(r, node, "a map");
    for (const brc_node *item = node->first; node->kind == BRC_NODE_MAP && item; item = item->next) {
        if (strcmp(item->key, "quantity") == 0)
            derived->row.quantity = brc_case_text_of(r, item);
        else if (strcmp(item->key, "formula") == 0)
            derived->formula = (brc_case_formula)brc_case_word_of(r, item, formulas);
        else if (strcmp(item->key, "quick") == 0)
            derived->quick = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "of") == 0)
            derived->of = brc_case_text_of(r, item);
        else if (strcmp(item->key, "against") == 0)
            derived->against = brc_case_text_of(r, item);
        else if (strcmp(item->key, "origin") == 0)
            derived->origin = brc_case_number_of(r, item);
        else if (strcmp(item->key, "runs") == 0)
            derived->n_runs = brc_case_texts_of(r, item, derived->runs);
        else if (strcmp(item->key, "label") == 0)
            derived->n_labels = brc_case_pairs_of(r, item, derived->labels);
        else if (!read_row_key(r, item, &derived->row))
            brc_case_unknown_key(r, item, "derived row");
    }
    if (derived->n_runs == 0) brc_case_wrong(r, node, "a derived row with runs");
}

/* Every run that a derived row names exists, and is quick where the row is. */
static void check_names(const brc_case_reader *r, const brc_node *root, const brc_case *what)
{
    for (int d = 0; d < what->n_derived; ++d)
        for (int k = 0; k < what->derived[d].n_runs; ++k) {
            int found = 0;
            while (found < what->n_runs && strcmp(what->runs[found].name, what->derived[d].runs[k]) != 0)
                ++found;
            if (found == what->n_runs || (what->derived[d].quick && !what->runs[found].quick))
                brc_problems_add(r->problems, root->mark, "derived row %s names the run '%s', which is not there%s",
                                 what->derived[d].row.quantity, what->derived[d].runs[k],
                                 found < what->n_runs ? " in --quick" : "");
        }
}

static brc_status read_top(const brc_case_reader *r, const brc_node *root, brc_case *what)
{
    if (root->kind != BRC_NODE_MAP) {
        brc_case_wrong(r, root, "a map with title and runs");
        return BRC_OK;
    }
    for (const brc_node *item = root->first; item; item = item->next) {
        if (strcmp(item->key, "title") == 0)
            what->title = brc_case_text_of(r, item);
        else if (strcmp(item->key, "about") == 0)
            what->about = brc_case_text_of(r, item);
        else if (strcmp(item->key, "runs") == 0 && item->kind == BRC_NODE_LIST) {
            BRC_TRY(BRC_ALLOCATE(r->context, &what->runs, 3 * (int64_t)item->n_children,
                                 "runs of a case")); /* in three precisions at most */
            for (const brc_node *run = item->first; run; run = run->next)
                BRC_TRY(read_runs(r, run, what));
        } else if (strcmp(item->key, "derived") == 0 && item->kind == BRC_NODE_LIST) {
            BRC_TRY(BRC_ALLOCATE(r->context, &what->derived, item->n_children, "derived rows of a case"));
            for (const brc_node *derived = item->first; derived; derived = derived->next)
                read_derived(r, derived, &what->derived[what->n_derived++]);
        } else
            brc_case_unknown_key(r, item, "case");
    }
    check_names(r, root, what);
    return BRC_OK;
}

/* Names of the cases, for the nearest one. */
static brc_status unknown_case(brc_context *context, const char *name)
{
    char names[32][64];
    const char *pointers[32];
    int n = 0;
    for (const char *path; n < 32 && (path = brc_case_name(n)); ++n) {
        snprintf(names[n], sizeof names[n], "%.*s", (int)case_part(path), path);
        pointers[n] = names[n];
    }
    const char *nearest = brc_nearest_word(name, n, pointers);
    return BRC_FAIL(context, BRC_BAD_INPUT, "no case '%s'%s%s%s; `breccia reproduce --list` names them", name,
                    nearest ? ", did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
}

brc_status brc_case_read(brc_context *context, const char *folder, const char *name, brc_case **out)
{
    brc_status status = BRC_OK;
    brc_problems *problems = NULL;
    brc_case *what = NULL;
    brc_node *root = NULL;
    char file_name[160];
    snprintf(file_name, sizeof file_name, "%s/case.yaml", name);
    *out = NULL;
    if (!folder) {
        bool known = false;
        const char *path;
        for (int k = 0; !known && (path = brc_case_name(k)); ++k)
            known = strlen(name) == case_part(path) && memcmp(name, path, case_part(path)) == 0;
        if (!known) return unknown_case(context, name);
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &what, 1, "a case"));
    what->name = name;
    what->folder = folder;
    what->title = what->about = "";
    BRC_TRY_OR(cleanup, brc_case_parse(context, folder, name, "case.yaml", file_name, &what->tree, &problems, &root));
    const brc_case_reader r = {context, problems};
    if (root) BRC_TRY_OR(cleanup, read_top(&r, root, what));
    BRC_TRY_OR(cleanup, brc_problems_report(problems));
    *out = what;
    what = NULL;
cleanup:
    brc_problems_free(&problems);
    brc_case_free(&what);
    return status;
}

void brc_case_free(brc_case **what)
{
    if (!what || !*what) return;
    for (int k = 0; k < (*what)->n_runs; ++k) {
        brc_memory_free((*what)->runs[k].rows);
        brc_memory_free((*what)->runs[k].own_name);
    }
    brc_memory_free((*what)->runs);
    brc_memory_free((*what)->derived);
    brc_tree_free(&(*what)->tree);
    brc_memory_free(*what);
    *what = NULL;
}
