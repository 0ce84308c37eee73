#include "price_file.h"
#include "../reproduce/case_node.h"
#include "../scratch.h"
#include "../../base/file.h"
#include "../../base/log.h"
#include "../../base/memory.h"
#include "../../output/text.h"
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILE_NAME "price.json"

/* Numbers of the file and their names. */
typedef struct number {
    const char *name;
    size_t at;
} number;
#define NUMBER(field)                                                                                                  \
    {                                                                                                                  \
#field, offsetof(brc_prediction_told, field)                                                                   \
    }
static const number numbers[] = {NUMBER(seconds),      NUMBER(least_seconds),  NUMBER(most_seconds), NUMBER(host_bytes),
                                 NUMBER(device_bytes), NUMBER(resident_bytes), NUMBER(disk_bytes)};
enum { N_NUMBERS = sizeof numbers / sizeof *numbers };

static double *number_of(brc_prediction_told *told, int k)
{
    return (double *)(void *)((char *)told + numbers[k].at);
}

/* The scene as a list of its lines. */
static void add_lines(brc_json *json, const char *text)
{
    char line[1024];
    brc_json_begin_array(json, "scene");
    for (size_t n; *text; text += n + (text[n] != '\0')) {
        n = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)n, text);
        brc_json_string(json, NULL, line);
    }
    brc_json_end(json);
}

static bool has_lines(const brc_node *root, const char *text)
{
    char line[1024];
    const brc_node *list = brc_node_find(root, "scene"), *node = list ? list->first : NULL;
    for (size_t n; node && *text; text += n + (text[n] != '\0'), node = node->next) {
        n = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)n, text);
        if (strcmp(line, node->text) != 0) return false;
    }
    return list && !node && !*text;
}

brc_status brc_price_file_write(brc_context *context, const char *folder, const brc_price_of *of,
                                const brc_prediction_told *told)
{
    brc_json json = {.text = {.context = context}};
    brc_prediction_told copy = *told;
    char *path = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, FILE_NAME, &path));
    brc_json_begin_object(&json, NULL);
    brc_json_string(&json, "device", of->device);
    brc_json_string(&json, "precision", brc_precision_name(of->precision));
    brc_json_integer(&json, "threads", of->n_threads);
    brc_json_boolean(&json, "processor_time", told->processor_time);
    for (int k = 0; k < N_NUMBERS; ++k)
        brc_json_number(&json, numbers[k].name, *number_of(&copy, k));
    add_lines(&json, of->scene);
    status = brc_json_write(&json, path);
cleanup:
    brc_memory_free(path);
    return status;
}

static bool is(const brc_node *root, const char *key, const char *expected)
{
    const brc_node *node = brc_node_find(root, key);
    return node && strcmp(node->text, expected) == 0;
}

/* NULL: it is of this run; else what it is of. */
static const char *differs_in(const brc_node *root, const brc_price_of *of)
{
    char threads[16];
    snprintf(threads, sizeof threads, "%d", of->n_threads);
    return !has_lines(root, of->scene)                                 ? "scene"
           : !is(root, "device", of->device)                           ? "device"
           : !is(root, "precision", brc_precision_name(of->precision)) ? "precision"
           : !is(root, "threads", threads)                             ? "number of threads"
                                                                       : NULL;
}

/* told->known false: one of them is no number, or below zero. */
static void take_numbers(const brc_node *root, brc_prediction_told *told)
{
    bool whole = true;
    for (int k = 0; k < N_NUMBERS; ++k) {
        const brc_node *node = brc_node_find(root, numbers[k].name);
        char *end = NULL;
        const double value = node ? strtod(node->text, &end) : NAN;
        *number_of(told, k) = node && end != node->text ? value : NAN;
        whole = whole && isfinite(*number_of(told, k)) && *number_of(told, k) >= 0;
    }
    told->processor_time = is(root, "processor_time", "true");
    told->known = whole && told->seconds > 0;
}

brc_status brc_price_file_read(brc_context *context, const char *folder, const brc_price_of *of,
                               brc_prediction_told *told)
{
    char *path = NULL;
    brc_tree *tree = NULL;
    brc_problems *problems = NULL;
    brc_node *root = NULL;
    brc_status status = BRC_OK;
    *told = (brc_prediction_told){.known = false};
    if (brc_scratch_bytes(context, folder, FILE_NAME) == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, FILE_NAME, &path));
    if (brc_case_parse(context, folder, ".", FILE_NAME, path, &tree, &problems, &root) != BRC_OK || !root) {
        brc_context_clear(context);
        brc_log(context, BRC_LOG_WARNING, "%s cannot be read: what the run takes is compared with nothing", path);
        goto cleanup;
    }
    const char *other = differs_in(root, of);
    if (other)
        brc_log(context, BRC_LOG_INFO, "%s is of another %s: what the run takes is not compared with it", path, other);
    else
        take_numbers(root, told);
    if (!other && !told->known)
        brc_log(context, BRC_LOG_WARNING,
                "%s has no price: a number of it is missing, not finite or below zero; what the run takes is compared "
                "with nothing",
                path);
cleanup:
    brc_problems_free(&problems);
    brc_tree_free(&tree);
    brc_memory_free(path);
    return status;
}

static double off(double told, double was)
{
    return 100 * (told / was - 1);
}

void brc_price_file_compare(brc_context *context, const char *folder, const brc_prediction_told *told, double total_s,
                            int64_t device_bytes)
{
    const double took = told->processor_time ? brc_processor_s() : total_s, MB = 1e6;
    const struct {
        const char *what;
        double told, was;
    } rows[] = {{"the host", told->host_bytes, (double)brc_memory_peak()},
                {"the device", told->device_bytes, (double)device_bytes},
                {"resident", told->resident_bytes, (double)brc_memory_resident()},
                {"disk", told->disk_bytes,
                 (double)(brc_scratch_bytes(context, folder, NULL) - brc_scratch_bytes(context, folder, FILE_NAME))}};
    brc_text text = {.context = context};
    brc_text_add(&text, "check told %.3g s", told->seconds);
    if (told->least_seconds < told->seconds || told->most_seconds > told->seconds)
        brc_text_add(&text, " (%.3g to %.3g)", told->least_seconds, told->most_seconds);
    brc_text_add(&text, ", the run took %.3g s%s: %+.0f %%", took, told->processor_time ? " of processor time" : "",
                 off(told->seconds, took));
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k)
        brc_text_add(&text, "; %s: %.4g MB told, %.4g taken, %+.0f %%", rows[k].what, rows[k].told / MB,
                     rows[k].was / MB, off(rows[k].told, rows[k].was));
    if (text.status == BRC_OK) brc_log(context, BRC_LOG_INFO, "%s", text.data);
    brc_text_free(&text);
}
