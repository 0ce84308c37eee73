#include "report.h"
#include "../h5_read.h"
#include "report_cracks.h"
#include "report_curves.h"
#include "report_summary.h"
#include "web_file.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURES_MOST = 4096 };
static const size_t JSON_MOST = (size_t)1 << 28, PICTURE_MOST = (size_t)1 << 26, PICTURES_BYTES = (size_t)64 << 20;
static const size_t PICTURES_BESIDE_VIEW = 500000; /* the view shows what they do */

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
    for (const struct dirent *entry = directory ? readdir(directory) : NULL; entry && *n < PICTURES_MOST;
         entry = readdir(directory)) {
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
static brc_status add_picture(brc_context *context, brc_text *page, const char *folder, const char *name, size_t *room,
                              int *out)
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

/* Every picture of a folder. */
static brc_status add_folder(brc_context *context, brc_text *page, const char *folder, size_t *room, int *out)
{
    char **name = NULL;
    int n = 0;
    BRC_TRY(BRC_ALLOCATE(context, &name, PICTURES_MOST, "names of pictures"));
    brc_status status = list_pictures(context, folder, name, &n);
    for (int k = 0; k < n && status == BRC_OK; ++k)
        status = add_picture(context, page, folder, name[k], room, out);
    for (int k = 0; k < n; ++k)
        brc_memory_free(name[k]);
    brc_memory_free(name);
    return status;
}

/* Pictures of the folder and of its folder `pictures`: folded away where the page has a view of its own. */
static brc_status add_pictures(brc_context *context, brc_text *page, const char *folder, bool folded)
{
    brc_text pictures = {.context = context};
    const size_t most = folded ? PICTURES_BESIDE_VIEW : PICTURES_BYTES;
    size_t room = most;
    int left_out = 0;
    char *frames = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "pictures", &frames));
    BRC_TRY_OR(cleanup, add_folder(context, &pictures, folder, &room, &left_out));
    BRC_TRY_OR(cleanup, add_folder(context, &pictures, frames, &room, &left_out));
    if (!pictures.data && left_out == 0) goto cleanup;
    if (folded) brc_text_add(page, "<details><summary>pictures of the run</summary>\n");
    if (pictures.data) brc_text_add_bytes(page, pictures.data, pictures.length);
    if (left_out > 0)
        brc_text_add(
            page, "<p>%d pictures are left out: the page holds %.3g MB of them; the folder of the run has all.</p>\n",
            left_out, (double)most / 1e6);
    if (folded) brc_text_add(page, "</details>\n");
    status = pictures.status;
cleanup:
    brc_text_free(&pictures);
    brc_memory_free(frames);
    return status;
}

/* The resolved scene out of result.h5; NULL where there is none. */
static brc_status read_scene(brc_context *context, const char *folder, char **out)
{
    char *path = NULL;
    brc_h5_read h5;
    *out = NULL;
    BRC_TRY(brc_file_join(context, folder, "result.h5", &path));
    brc_status status = BRC_OK;
    if (brc_file_exists(path)) {
        BRC_TRY_OR(cleanup, brc_h5_read_open(context, path, &h5));
        if (brc_h5_read_has(&h5, "scene")) status = brc_h5_read_string(&h5, "scene", out);
        brc_h5_read_close(&h5);
    }
cleanup:
    brc_memory_free(path);
    return status;
}

static void add_scene(brc_text *page, const char *scene)
{
    if (!scene) return;
    brc_text_add(page, "<h2>Scene</h2>\n<details open><summary>as it was run, defaults included</summary>\n<pre>");
    brc_html_words(page, scene);
    brc_text_add(page, "</pre></details>\n");
}

/* Places that the scripts fill; without scripts a sentence. */
static void add_places(brc_text *page)
{
    brc_text_add(page, "<noscript><p>The view and the curves need JavaScript.</p></noscript>\n"
                       "<div id=\"view\"></div>\n<div id=\"curves\"></div>\n<div id=\"cracks\"></div>\n");
}

/* Whoever gets a page gets the licences of its libraries. */
static void add_licences(brc_text *page)
{
    static const char *const library[][2] = {{"three.js 0.180.0", "LICENSE.three"},
                                             {"Apache ECharts 6.1.0", "LICENSE.echarts"},
                                             {"zrender 6.1.0", "LICENSE.zrender"}};
    brc_text_add(page, "<details><summary>licences of the libraries in this page</summary>\n"
                       "<p>Apache ECharts, copyright 2017-2025 The Apache Software Foundation: this product includes "
                       "software developed at The Apache Software Foundation.</p>\n");
    for (size_t k = 0; k < sizeof library / sizeof *library; ++k) {
        const brc_web_file *file = brc_web_file_find(library[k][1]);
        brc_text_add(page, "<h3>%s</h3><pre>", library[k][0]);
        for (size_t c = 0; c < file->n; ++c) {
            const char letter[2] = {(char)file->bytes[c], '\0'};
            brc_html_words(page, letter);
        }
        brc_text_add(page, "</pre>\n");
    }
    brc_text_add(page, "</details>\n");
}

/* Libraries are packed, ours is not. */
static void add_scripts(brc_text *page)
{
    static const char *const library[] = {"three.mjs.gz", "echarts.mjs.gz"};
    static const char *const script[] = {"data.js",  "colours.js", "charts.js", "cracks.js",
                                         "solid.js", "view.js",    "page.js"};
    for (size_t k = 0; k < sizeof library / sizeof *library; ++k) {
        const brc_web_file *file = brc_web_file_find(library[k]);
        brc_html_packed(page, library[k], file->bytes, file->n);
    }
    brc_text_add(page, "<script>\n\"use strict\";\n");
    for (size_t k = 0; k < sizeof script / sizeof *script; ++k)
        brc_html_file(page, script[k]);
    brc_text_add(page, "</script>\n");
}

/* The view. A frame that cannot be read costs the view, not the page: `no_view` says why. */
static brc_status add_view(brc_context *context, const char *folder, const brc_csv_read *cracks, brc_text *page,
                           brc_report_frames *frames)
{
    brc_text arrays = {.context = context};
    brc_json view = {.text = {.context = context}};
    brc_json_begin_object(&view, NULL);
    brc_status status = brc_report_view(context, folder, cracks, &arrays, &view, frames);
    if (status == BRC_OK && arrays.data) brc_text_add_bytes(page, arrays.data, arrays.length);
    if (status == BRC_BAD_INPUT) {
        brc_log(context, BRC_LOG_WARNING, "the page has no view: %s", brc_context_message(context));
        brc_text_free(&view.text);
        view = (brc_json){.text = {.context = context}};
        brc_json_begin_object(&view, NULL);
        brc_json_string(&view, "no_view", brc_context_message(context));
        status = BRC_OK;
    }
    if (status == BRC_OK) brc_html_json(page, "view-data", &view);
    brc_text_free(&view.text);
    brc_text_free(&arrays);
    return status;
}

/* Do solids touch each other or a rigid body? Then an amplified displacement shows gaps that are not there. */
static bool is_touching(const brc_node *summary)
{
    static const char *const touching[] = {"contact", "walls and strikers"};
    const brc_node *effects = brc_node_find(summary, "effects");
    const brc_node *in = effects && effects->kind == BRC_NODE_MAP ? brc_node_find(effects, "in") : NULL;
    for (const brc_node *effect = in ? in->first : NULL; effect; effect = effect->next)
        for (size_t k = 0; k < sizeof touching / sizeof *touching; ++k)
            if (strcmp(effect->text, touching[k]) == 0) return true;
    return false;
}

/* Arrays and their description for the scripts. */
static brc_status add_data(brc_context *context, const char *folder, const char *scene, const brc_node *summary,
                           brc_text *page, bool *has_view)
{
    brc_csv_read cracks = {0}, fragments = {0};
    brc_report_frames frames = {0};
    brc_json data = {.text = {.context = context}};
    brc_status status = BRC_OK;
    brc_json_begin_object(&data, NULL);
    brc_json_boolean(&data, "touching", is_touching(summary));
    BRC_TRY_OR(cleanup, brc_csv_read_open(context, folder, "cracks.csv", &cracks));
    BRC_TRY_OR(cleanup, brc_csv_read_open(context, folder, "fragments.csv", &fragments));
    BRC_TRY_OR(cleanup, add_view(context, folder, &cracks, page, &frames));
    *has_view = frames.n > 0;
    BRC_TRY_OR(cleanup, brc_report_curves(context, folder, scene, page, &data));
    brc_report_cracks_add_roses(&cracks, &data);
    BRC_TRY_OR(cleanup, brc_report_cracks_add_fragments(context, &fragments, &frames, page, &data));
    brc_html_json(page, "data", &data);
cleanup:
    brc_text_free(&data.text);
    brc_report_frames_free(&frames);
    brc_csv_read_free(&cracks);
    brc_csv_read_free(&fragments);
    return status;
}

static brc_status add_run(brc_context *context, const char *folder, const brc_node *summary, brc_text *page)
{
    brc_text data = {.context = context};
    char *scene = NULL;
    bool has_view = false;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, read_scene(context, folder, &scene));
    BRC_TRY_OR(cleanup, add_data(context, folder, scene, summary, &data, &has_view));
    brc_report_summary_head(page, summary, folder);
    brc_report_summary_results(page, summary);
    add_places(page);
    BRC_TRY_OR(cleanup, add_pictures(context, page, folder, has_view));
    brc_report_summary_cost(page, summary);
    add_scene(page, scene);
    brc_report_summary_rest(page, summary);
    add_licences(page);
    BRC_TRY_OR(cleanup, data.status);
    if (data.data) brc_text_add_bytes(page, data.data, data.length);
    add_scripts(page);
cleanup:
    brc_memory_free(scene);
    brc_text_free(&data);
    return status;
}

brc_status brc_report_write(brc_context *context, const char *folder, const char *path)
{
    json_file summary = {0}, rows = {0};
    brc_text page = {.context = context};
    char *place = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, read_json(context, folder, "summary.json", &summary));
    BRC_TRY_OR(cleanup, read_json(context, folder, "rows.json", &rows));
    if (!summary.root && !rows.root) {
        status = BRC_FAIL(
            context, BRC_BAD_INPUT,
            "%s: no summary.json and no rows.json in it; expected the folder of `breccia run`, `reproduce` or `bench`",
            folder);
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, "report.html", &place));
    brc_html_begin(&page, summary.root ? brc_report_summary_title(summary.root, folder) : folder);
    if (rows.root) {
        brc_text_add(&page, "<h2>Rows</h2>\n");
        brc_html_value(&page, NULL, rows.root);
    }
    if (summary.root)
        BRC_TRY_OR(cleanup, add_run(context, folder, summary.root, &page));
    else
        BRC_TRY_OR(cleanup, add_pictures(context, &page, folder, false));
    brc_html_end(&page);
    status = brc_text_write(&page, path ? path : place);
cleanup:
    brc_text_free(&page);
    brc_memory_free(place);
    free_json(&rows);
    free_json(&summary);
    return status;
}
