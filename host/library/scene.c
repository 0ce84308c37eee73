/* Scenes: read once to find their errors; every run reads the kept text anew, since what is derived from a scene goes
 * into it. */
#include "library_internal.h"
#include "../base/file.h"
#include "../base/log.h"
#include "../base/memory.h"
#include "../base/version.h"
#include "../commands/price/check_scene.h"
#include "../commands/price/pace.h"
#include "../scene/scene_reader.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

breccia_status brc_public_status(brc_status status)
{
    switch (status) {
    case BRC_OK: return BRECCIA_OK;
    case BRC_PHYSICS_STOPPED: return BRECCIA_PHYSICS_STOPPED;
    case BRC_BAD_INPUT: return BRECCIA_BAD_INPUT;
    case BRC_NO_MEMORY: return BRECCIA_NO_MEMORY;
    case BRC_DEVICE_FAILED: return BRECCIA_DEVICE_FAILED;
    case BRC_FILE_FAILED: return BRECCIA_FILE_FAILED;
    case BRC_INTERRUPTED: return BRECCIA_INTERRUPTED;
    case BRC_BOUND_MISSED:
    case BRC_INTERNAL: break;
    }
    return BRECCIA_INTERNAL;
}

const char *breccia_version(void)
{
    return brc_version();
}
const char *breccia_commit(void)
{
    return brc_version_commit();
}
int breccia_interface(void)
{
    return BRECCIA_INTERFACE;
}

const char *breccia_status_text(breccia_status status)
{
    for (int k = BRC_OK; k <= BRC_INTERNAL; ++k)
        if (brc_public_status((brc_status)k) == status && k != BRC_BOUND_MISSED) return brc_status_text((brc_status)k);
    return "unknown status code";
}

int breccia_devices(int most, breccia_device *out)
{
    brc_context *context = brc_context_create();
    brc_device_list *list = NULL;
    int n = 0;
    if (context && brc_device_list_create(context, &list) == BRC_OK) n = list->n;
    for (int k = 0; k < n && k < most; ++k) {
        const brc_device_info *info = &list->items[k];
        out[k].usable = info->usable;
        snprintf(out[k].selector, sizeof out[k].selector, "%s", info->selector);
        snprintf(out[k].name, sizeof out[k].name, "%s", info->name);
        snprintf(out[k].why_not, sizeof out[k].why_not, "%s", info->why_not);
    }
    brc_device_list_free(&list);
    brc_context_free(&context);
    return n;
}

/* ---- problems ---- */

/* A number and what follows it, which must be `end`. */
static char *take_number(char *at, char end, int *out)
{
    char *rest;
    const long value = strtol(at, &rest, 10);
    if (rest == at || *rest != end || value < 0) return NULL;
    *out = (int)value;
    return rest + 1;
}

/* Bytes of `words` where the text begins with them, else 0. */
static size_t begins(const char *text, const char *words)
{
    const size_t n = strlen(words);
    return strncmp(text, words, n) == 0 ? n : 0;
}

/* "NAME:LINE:COLUMN: message" or "NAME: in the override 'SET': message", as host/scene/problem.c writes; else all is
 * message. */
static void read_problem(const breccia_scene *scene, char *sentence, breccia_problem *out)
{
    static const char in_override[] = " in the override '";
    const size_t named = begins(sentence, scene->name);
    char *const place = named && sentence[named] == ':' ? sentence + named + 1 : NULL, *rest = NULL, *end = NULL;
    *out = (breccia_problem){.file = scene->name, .set = "", .message = sentence, .cure = ""};
    if (place && (rest = take_number(place, ':', &out->line)) && (rest = take_number(rest, ':', &out->column)))
        out->message = rest + 1;
    else if (place && begins(place, in_override) && (end = strstr(place, "': "))) {
        *end = '\0';
        out->set = place + begins(place, in_override);
        out->message = end + 3;
    }
    out->message += begins(out->message, "error: ");
    for (const char *at = strstr(out->message, "; "); at; at = strstr(out->cure, "; "))
        out->cure = at + 2;
}

/* The sentences of `said`, a line each. */
static brc_status read_problems(breccia_scene *scene, bool are_warnings)
{
    int n = 0;
    for (const char *at = scene->said; at && *at; ++at)
        n += *at == '\n';
    BRC_TRY(BRC_ALLOCATE(scene->context, &scene->problems, n + 1, "problems of a scene"));
    for (char *at = scene->said, *next; at && *at; at = next) {
        next = at + strcspn(at, "\n");
        if (*next) *next++ = '\0';
        read_problem(scene, at, &scene->problems[scene->n_problems]);
        scene->problems[scene->n_problems++].is_warning = are_warnings;
    }
    return BRC_OK;
}

static brc_status append(brc_context *context, char **text, const char *line, const char *end)
{
    const size_t had = *text ? strlen(*text) : 0, more = strlen(line) + strlen(end) + 1;
    if (!*text) BRC_TRY(BRC_ALLOCATE(context, text, 1, "text"));
    BRC_TRY(brc_memory_resize(context, (void **)text, (int64_t)(had + more), 1, "text"));
    snprintf(*text + had, more, "%s%s", line, end);
    return BRC_OK;
}

static void keep_warning(void *self, brc_log_level level, const char *line)
{
    breccia_scene *scene = self;
    if (level == BRC_LOG_WARNING) (void)append(scene->context, &scene->said, line, "\n");
}

/* ---- reading ---- */

static brc_status copy_text(brc_context *context, const char *from, char **out)
{
    *out = NULL;
    return append(context, out, from, "");
}

static brc_status parse(breccia_scene *s)
{
    brc_scene *scene = NULL;
    brc_log_set_sink(s->context, keep_warning, s);
    brc_status status =
        brc_scene_read_text(s->context, s->name, s->text, s->bytes, s->n_set, (const char *const *)s->set, &scene);
    if (status == BRC_OK) status = brc_scene_to_yaml(s->context, scene, &s->yaml);
    brc_scene_free(&scene);
    return status;
}

/* name and set as given; the text is read from the file where it is NULL. */
static breccia_scene *load(const char *name, const char *text, size_t bytes, int n_set, const char *const *set)
{
    enum { FILE_LIMIT = 64 << 20 };
    breccia_scene *s = calloc(1, sizeof *s);
    if (s) s->context = brc_context_create();
    if (!s || !s->context) {
        free(s);
        return NULL;
    }
    brc_log_set_level(s->context, BRC_LOG_WARNING);
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, copy_text(s->context, name, &s->name));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &s->set, n_set, "overrides"));
    for (; s->n_set < n_set; ++s->n_set)
        BRC_TRY_OR(cleanup, copy_text(s->context, set[s->n_set], &s->set[s->n_set]));
    if (text) {
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &s->text, (int64_t)bytes + 1, "text of a scene"));
        memcpy(s->text, text, bytes);
        s->bytes = bytes;
    } else {
        BRC_TRY_OR(cleanup, brc_file_read_whole(s->context, name, FILE_LIMIT, &s->text, &s->bytes));
    }
    status = parse(s);
cleanup:
    s->status = status;
    if (status != BRC_OK) {
        brc_memory_free(s->said); /* warnings count only without errors */
        s->said = NULL;
        status = copy_text(s->context, brc_context_message(s->context), &s->said);
    }
    if (status == BRC_OK) status = read_problems(s, s->status == BRC_OK);
    if (status == BRC_OK) return s;
    breccia_scene_free(s);
    return NULL;
}

breccia_scene *breccia_scene_load(const char *path, int n_set, const char *const *set)
{
    return load(path, NULL, 0, n_set, set);
}

breccia_scene *breccia_scene_text(const char *name, const char *text, size_t bytes, int n_set, const char *const *set)
{
    return load(name, text, bytes, n_set, set);
}

void breccia_scene_free(breccia_scene *s)
{
    if (!s) return;
    for (int k = 0; k < s->n_set; ++k)
        brc_memory_free(s->set[k]);
    brc_memory_free(s->set);
    brc_memory_free(s->name);
    brc_memory_free(s->text);
    brc_memory_free(s->yaml);
    brc_memory_free(s->said);
    brc_memory_free(s->problems);
    brc_context_free(&s->context);
    free(s);
}

breccia_status breccia_scene_status(const breccia_scene *scene)
{
    return scene ? brc_public_status(scene->status) : BRECCIA_NO_MEMORY;
}

const breccia_problem *breccia_scene_problems(const breccia_scene *scene, int *n)
{
    *n = scene ? scene->n_problems : 0;
    return scene ? scene->problems : NULL;
}

const char *breccia_scene_yaml(const breccia_scene *scene)
{
    return scene ? scene->yaml : NULL;
}
const char *breccia_scene_message(const breccia_scene *scene)
{
    return scene ? brc_context_message(scene->context) : "out of memory";
}

/* ---- checking ---- */

brc_status brc_library_precision(brc_context *context, const char *name, brc_precision *out)
{
    for (int p = BRC_DOUBLE; p <= BRC_SINGLE; ++p)
        if (strcmp(name ? name : "double", brc_precision_name((brc_precision)p)) == 0) {
            *out = (brc_precision)p;
            return BRC_OK;
        }
    return BRC_FAIL(context, BRC_BAD_INPUT, "precision '%s' is unknown, expected double, mixed or single", name);
}

static void take_price(const brc_check *check, breccia_price *out)
{
    *out = (breccia_price){.n_elements = brc_setup_n_elements(&check->setup),
                           .n_bonds = brc_setup_n_bonds(&check->setup),
                           .n_models = check->setup.n,
                           .build_seconds = check->build_s,
                           .seconds = NAN,
                           .least_seconds = NAN,
                           .most_seconds = NAN,
                           .most_device_bytes = NAN,
                           .host_bytes = NAN,
                           .disk_bytes = NAN};
    for (int32_t k = 0; k < check->setup.n; ++k)
        out->device_bytes += brc_device_bytes(check->setup.device[k]);
}

static brc_status price(breccia_scene *s, brc_scene *scene, const brc_device_request *request, brc_check *check,
                        breccia_price *out)
{
    brc_status status = brc_check_try(s->context, request, false, check);
    if (status == BRC_OK) status = brc_check_price(s->context, scene, request, check);
    if (status != BRC_OK || !check->told.known) return status;
    const brc_prediction_told *told = &check->told;
    out->seconds = told->seconds;
    out->least_seconds = told->least_seconds;
    out->most_seconds = told->most_seconds;
    out->most_device_bytes = told->device_bytes;
    out->host_bytes = told->host_bytes;
    out->disk_bytes = told->disk_bytes;
    return BRC_OK;
}

breccia_status breccia_scene_check(breccia_scene *s, const breccia_options *options, bool trial, breccia_price *out)
{
    const breccia_options none = {0}, *o = options ? options : &none;
    if (!s) return BRECCIA_NO_MEMORY;
    if (s->status != BRC_OK) return brc_public_status(s->status);
    brc_context_clear(s->context);
    brc_check check = {0};
    brc_scene *scene = NULL;
    brc_device_request request = {.selector = o->device ? o->device : "auto", .n_threads = o->threads};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, brc_library_precision(s->context, o->precision, &request.precision));
    BRC_TRY_OR(cleanup, brc_scene_read_text(s->context, s->name, s->text, s->bytes, s->n_set,
                                            (const char *const *)s->set, &scene));
    BRC_TRY_OR(cleanup, brc_check_build(s->context, scene, &request, brc_pace_clock_s(&request), &check));
    take_price(&check, out);
    if (trial) status = price(s, scene, &request, &check, out);
cleanup:
    brc_check_free(&check);
    brc_scene_free(&scene);
    return brc_public_status(status);
}
