#include "report.h"
#include "html.h"
#include "report_curves.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURES_MOST = 4096 };
static const size_t JSON_MOST = (size_t)1 << 28, PICTURE_MOST = (size_t)1 << 26, PICTURES_BYTES = (size_t)64 << 20;

/* A JSON file as nodes; *root NULL where it does not exist. */
typedef struct json_file {
    char *path, *text;
    brc_tree *tree;
    brc_problems *problems;
    brc_node *root;
} json_file;

/* The reader of scenes takes no control characters, and reasons of several lines have escaped ones. */
static void blank_line_breaks(char *text)
{
    for (char *s = text; *s; ++s) {
        if (*s != '\\' || !s[1]) continue;
        if (s[1] == 'n' || s[1] == 't') s[0] = s[1] = ' ';
        ++s;
    }
}

static brc_status read_json(brc_context *context, const char *folder, const char *name, json_file *out)
{
    size_t bytes;
    BRC_TRY(brc_file_join(context, folder, name, &out->path));
    if (!brc_file_exists(out->path)) return BRC_OK;
    BRC_TRY(brc_file_read_whole(context, out->path, JSON_MOST, &out->text, &bytes));
    blank_line_breaks(out->text);
    BRC_TRY(brc_problems_create(context, out->path, 0, NULL, &out->problems));
    BRC_TRY(brc_tree_create(context, &out->tree));
    BRC_TRY(brc_tree_parse(out->tree, out->problems, 0, out->text, bytes, &out->root));
    return brc_problems_report(out->problems);
}

static void free_json(json_file *file)
{
    brc_tree_free(&file->tree);
    brc_problems_free(&file->problems);
    brc_memory_free(file->text);
    brc_memory_free(file->path);
}

static const char *text_of(const brc_node *map, const char *key)
{
    const brc_node *node = map ? brc_node_find(map, key) : NULL;
    return node && node->kind == BRC_NODE_SCALAR && strcmp(node->text, "null") != 0 ? node->text : "";
}

static double number_of(const brc_node *map, const char *key)
{
    return strtod(text_of(map, key), NULL);
}

static bool ends_with(const char *word, const char *end)
{
    const size_t length = strlen(word), n = strlen(end);
    return length > n && strcmp(word + length - n, end) == 0;
}

static int by_name(const void *left, const void *right)
{
    return strcmp(*(char *const *)left, *(char *const *)right);
}

/* Names of the PNGs of a folder in their order, freed one by one by the caller; none where there is no folder. */
static brc_status list_pictures(brc_context *context, const char *folder, char **name, int *n)
{
    brc_status status = BRC_OK;
    *n = 0;
    DIR *directory = opendir(folder);
    for (const struct dirent *entry = directory ? readdir(directory) : NULL; entry && *n < PICTURES_MOST; entry = readdir(directory)) {
        if (!ends_with(entry->d_name, ".png")) continue;
        const size_t length = strlen(entry->d_name) + 1;
        status = BRC_ALLOCATE(context, &name[*n], length, "name of a picture");
        if (status != BRC_OK) break;
        memcpy(name[(*n)++], entry->d_name, length);
    }
    if (directory) closedir(directory);
    qsort(name, (size_t)*n, sizeof *name, by_name);
    return status;
}

/* *room: bytes of pictures that still fit; *out: those left out. */
static brc_status add_picture(brc_context *context, brc_text *page, const char *folder, const char *name, size_t *room, int *out)
{
    char *path = NULL, *bytes = NULL;
    size_t n;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, name, &path));
    BRC_TRY_OR(cleanup, brc_file_read_whole(context, path, PICTURE_MOST, &bytes, &n));
    if (n > *room) {
        *out += 1;
        goto cleanup;
    }
    *room -= n;
    brc_html_picture(page, name, bytes, n);
    brc_text_add(page, "\n");
cleanup:
    brc_memory_free(bytes);
    brc_memory_free(path);
    return status;
}

/* Every picture of a folder; as a sequence only one is seen, which a slider chooses. */
static brc_status add_pictures(brc_context *context, brc_text *page, const char *folder, bool sequence, size_t *room, int *out)
{
    char **name = NULL;
    int n = 0;
    BRC_TRY(BRC_ALLOCATE(context, &name, PICTURES_MOST, "names of pictures"));
    brc_status status = list_pictures(context, folder, name, &n);
    if (status == BRC_OK && sequence && n > 0) brc_text_add(page, "<h2>Frames</h2>\n<div id=\"frames\">");
    for (int k = 0; k < n && status == BRC_OK; ++k) status = add_picture(context, page, folder, name[k], room, out);
    if (status == BRC_OK && sequence && n > 0)
        brc_text_add(page, "</div><input type=\"range\" id=\"at\" min=\"0\" step=\"1\" value=\"0\" aria-label=\"frame\">\n<script>"
                           "const f=[...document.querySelectorAll('#frames img')],r=document.getElementById('at');r.max=f.length-1;"
                           "const show=()=>f.forEach((p,k)=>p.style.display=k==r.value?'':'none');r.oninput=show;show();</script>\n");
    for (int k = 0; k < n; ++k) brc_memory_free(name[k]);
    brc_memory_free(name);
    return status;
}

static void add_head(brc_text *page, const brc_node *summary)
{
    const char *title = text_of(summary, "title");
    brc_text_add(page, "<h1>");
    brc_html_words(page, title[0] ? title : "breccia");
    brc_text_add(page, "</h1>\n<p class=\"small\">");
    static const char *const keys[] = {"model", "precision", "device", "version", "commit"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k) {
        brc_text_add(page, "%s%s ", k ? " &middot; " : "", k >= 3 ? keys[k] : "");
        brc_html_words(page, text_of(summary, keys[k]));
    }
    brc_text_add(page, "</p>\n");
    const brc_node *end = brc_node_find(summary, "end");
    const bool done = strcmp(text_of(end, "status"), "done") == 0;
    brc_text_add(page, "<p class=\"%s\"><b>", done ? "done" : "stopped");
    brc_html_words(page, end ? text_of(end, "status") : "no end recorded: the run was killed");
    brc_text_add(page, "</b> ");
    brc_html_words(page, text_of(end, "reason"));
    brc_text_add(page, "</p>\n");
}

/* Values of a map with their share of `whole`; keys that end in `suffix` only. */
static void add_shares(brc_text *page, const brc_node *map, const char *suffix, double whole, const char *of)
{
    brc_text_add(page, "<table><tr><th></th><th></th><th>share of %s</th></tr>\n", of);
    for (const brc_node *child = map->first; child; child = child->next) {
        brc_text_add(page, "<tr><th>");
        brc_html_key(page, child->key);
        brc_text_add(page, "</th><td>");
        brc_html_value(page, child->key, child);
        brc_text_add(page, "</td><td>");
        if (whole > 0 && ends_with(child->key, suffix) && !ends_with(child->key, "_per_s") && child->kind == BRC_NODE_SCALAR)
            brc_text_add(page, "%.3g %%", 100 * strtod(child->text, NULL) / whole);
        brc_text_add(page, "</td></tr>\n");
    }
    brc_text_add(page, "</table>\n");
}

static bool is_told(const brc_node *child)
{
    static const char *const told[] = {"title", "model", "precision", "device", "version", "commit", "end"};
    for (size_t k = 0; k < sizeof told / sizeof *told; ++k)
        if (strcmp(child->key, told[k]) == 0) return true;
    return false;
}

/* Everything of the summary that the head has not told: single values together, then section by section. */
static void add_sections(brc_text *page, const brc_node *summary)
{
    brc_text_add(page, "<h2>run</h2>\n<table>");
    for (const brc_node *child = summary->first; child; child = child->next) {
        if (is_told(child) || child->kind != BRC_NODE_SCALAR) continue;
        brc_text_add(page, "<tr><th>");
        brc_html_key(page, child->key);
        brc_text_add(page, "</th><td>");
        brc_html_scalar(page, child->key, child->text);
        brc_text_add(page, "</td></tr>\n");
    }
    brc_text_add(page, "</table>\n");
    for (const brc_node *child = summary->first; child; child = child->next) {
        if (is_told(child) || child->kind == BRC_NODE_SCALAR || !child->first) continue;
        brc_text_add(page, "<h2>");
        brc_html_key(page, child->key);
        brc_text_add(page, "</h2>\n");
        if (strcmp(child->key, "ledger") == 0)
            add_shares(page, child, "_J", number_of(child, "peak_elastic_J"), "the elastic peak");
        else if (strcmp(child->key, "timing") == 0)
            add_shares(page, child, "_s", number_of(child, "total_s"), "the total");
        else
            brc_html_value(page, child->key, child);
        brc_text_add(page, "\n");
    }
}

static brc_status add_curves(brc_context *context, const char *folder, brc_text *page)
{
    int n;
    bool drawn;
    brc_text curves = {.context = context};
    brc_status status = brc_report_curves(context, folder, &curves, &n, &drawn);
    if (status == BRC_OK && (n > 0 || !drawn)) {
        brc_text_add(page, "<h2>Sensors</h2>\n");
        if (n > 0) brc_text_add_bytes(page, curves.data, curves.length);
        if (!drawn) brc_text_add(page, "<p>Curves need gnuplot (Debian package gnuplot-nox); the numbers are in histories.csv.</p>\n");
    }
    if (status == BRC_OK) status = curves.status;
    brc_text_free(&curves);
    return status;
}

brc_status brc_report_write(brc_context *context, const char *folder, const char *path)
{
    json_file summary = {0}, rows = {0};
    brc_text page = {.context = context};
    char *frames = NULL, *place = NULL;
    size_t room = PICTURES_BYTES;
    int left_out = 0;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, read_json(context, folder, "summary.json", &summary));
    BRC_TRY_OR(cleanup, read_json(context, folder, "rows.json", &rows));
    if (!summary.root && !rows.root) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%s: no summary.json and no rows.json in it; expected the folder of `breccia run`, `reproduce` or `bench`", folder);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "pictures", &frames));
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "report.html", &place));
    brc_html_begin(&page, summary.root ? text_of(summary.root, "title") : folder);
    if (summary.root) add_head(&page, summary.root);
    BRC_TRY_OR(cleanup, add_pictures(context, &page, folder, false, &room, &left_out));
    BRC_TRY_OR(cleanup, add_pictures(context, &page, frames, true, &room, &left_out));
    if (left_out > 0) brc_text_add(&page, "<p>%d pictures are left out: the page holds %zu MB of them.</p>\n", left_out, PICTURES_BYTES >> 20);
    if (rows.root) {
        brc_text_add(&page, "<h2>Rows</h2>\n");
        brc_html_value(&page, NULL, rows.root);
    }
    BRC_TRY_OR(cleanup, add_curves(context, folder, &page));
    if (summary.root) add_sections(&page, summary.root);
    brc_html_end(&page);
    status = brc_text_write(&page, path ? path : place);
cleanup:
    brc_text_free(&page);
    brc_memory_free(place);
    brc_memory_free(frames);
    free_json(&rows);
    free_json(&summary);
    return status;
}
