/* Reading sweeps: every combination of the values of the axes becomes a run of a case. */
#include "sweep.h"
#include "../reproduce/case_files.h"
#include "../reproduce/operators.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { AXES = BRC_CASE_LIST, VALUES = 64, TEXT_BYTES = 1 << 16 };

/* Texts made while expanding, kept until the sweep goes. */
struct brc_sweep_texts {
    struct brc_sweep_texts *next;
    size_t used;
    char bytes[TEXT_BYTES];
};

static brc_status keep(brc_context *context, brc_sweep *sweep, const char *text, const char **out)
{
    const size_t bytes = strlen(text) + 1;
    if (!sweep->texts || sweep->texts->used + bytes > TEXT_BYTES) {
        struct brc_sweep_texts *fresh;
        if (bytes > TEXT_BYTES)
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: a text of %zu characters, at most %d", sweep->problem, bytes,
                            TEXT_BYTES);
        BRC_TRY(BRC_ALLOCATE(context, &fresh, 1, "texts of a sweep"));
        fresh->next = sweep->texts;
        sweep->texts = fresh;
    }
    char *to = sweep->texts->bytes + sweep->texts->used;
    memcpy(to, text, bytes);
    sweep->texts->used += bytes;
    *out = to;
    return BRC_OK;
}

/* One sweep being expanded: the axes of its scene and the values it gives them. */
typedef struct expansion {
    const char *name, *scene;
    bool quick;
    double reference;
    const brc_operator *operator;
    int n_axes;
    const brc_node *axis[AXES];
    int n_values[AXES];
    const char *value[AXES][VALUES];
} expansion;

/* "path=$" with the value in place of each $. */
static void fill_in(char *out, size_t size, const char *template, const char *value)
{
    size_t n = 0;
    for (const char *c = template; *c && n + 1 < size; ++c) {
        if (*c == '$')
            n += (size_t)snprintf(out + n, size - n, "%s", value);
        else
            out[n++] = *c;
        if (n >= size) n = size - 1;
    }
    out[n] = '\0';
}

/* What setting an axis to a value means: overrides, or the precision. */
static brc_status apply(const brc_case_reader *r, brc_sweep *sweep, const brc_node *axis, const char *value,
                        brc_case_run *run)
{
    static const char *const precisions[] = {"double", "mixed", "single"};
    const char *templates[BRC_CASE_LIST];
    const brc_node *meaning = axis;
    if (strcmp(axis->key, "precision") == 0) {
        run->has_precision = true;
        for (int k = 0; k < 3; ++k)
            if (strcmp(value, precisions[k]) == 0) run->precision = (brc_precision)k;
    }
    if (axis->kind == BRC_NODE_MAP) {
        meaning = brc_node_find(axis, value);
        if (!meaning) {
            brc_problems_add(r->problems, axis->key_mark, "axis %s has no value '%s'", axis->key, value);
            return BRC_OK;
        }
    }
    const int n = brc_case_texts_of(r, meaning, templates);
    for (int k = 0; k < n; ++k) {
        char text[512];
        if (run->n_overrides == BRC_CASE_LIST) {
            brc_problems_add(r->problems, axis->key_mark, "more than %d overrides for one run", BRC_CASE_LIST);
            return BRC_OK;
        }
        fill_in(text, sizeof text, templates[k], value);
        BRC_TRY(keep(r->context, sweep, text, &run->overrides[run->n_overrides++]));
    }
    return BRC_OK;
}

/* One combination: choice[a] is the value of axis a. A run that is there already is not made twice. */
static brc_status add_run(const brc_case_reader *r, brc_sweep *sweep, const expansion *x, const int *choice)
{
    char name[144] = "";
    brc_case_run run = {.scene = x->scene, .quick = x->quick, .operator= x->operator, .n_seeds = 1, .may_stop = true};
    for (int a = 0; a < x->n_axes; ++a) {
        const char *value = x->value[a][choice[a]];
        const size_t used = strlen(name);
        if (strcmp(value, "-") == 0) continue; /* left as the scene has it */
        snprintf(name + used, sizeof name - used, "%s%s", used ? "_" : "", value);
        run.labels[run.n_labels++] = (brc_case_pair){x->axis[a]->key, value};
        BRC_TRY(apply(r, sweep, x->axis[a], value, &run));
    }
    for (char *c = name; *c; ++c)
        if (*c == '/' || *c == ' ') *c = '-';
    for (int k = 0; k < sweep->what.n_runs; ++k)
        if (strcmp(sweep->what.runs[k].name, name) == 0) {
            sweep->what.runs[k].quick = sweep->what.runs[k].quick || x->quick;
            return BRC_OK;
        }
    BRC_TRY(keep(r->context, sweep, name, &run.name));
    const int64_t n = sweep->what.n_runs;
    BRC_TRY(brc_memory_resize(r->context, (void **)&sweep->what.runs, n + 1, sizeof run, "runs of a sweep"));
    BRC_TRY(
        brc_memory_resize(r->context, (void **)&sweep->sweep_of, n + 1, sizeof *sweep->sweep_of, "runs of a sweep"));
    sweep->what.runs[n] = run;
    BRC_TRY(brc_memory_resize(r->context, (void **)&sweep->reference_of, n + 1, sizeof *sweep->reference_of,
                              "runs of a sweep"));
    sweep->sweep_of[n] = x->name;
    sweep->reference_of[n] = x->reference;
    sweep->what.n_runs = (int)(n + 1);
    return BRC_OK;
}

static brc_status add_runs(const brc_case_reader *r, brc_sweep *sweep, const expansion *x)
{
    int choice[AXES] = {0};
    for (;;) {
        BRC_TRY(add_run(r, sweep, x, choice));
        int a = x->n_axes - 1; /* the last axis runs fastest */
        while (a >= 0 && ++choice[a] == x->n_values[a])
            choice[a--] = 0;
        if (a < 0) return BRC_OK;
    }
}

/* Values of an axis: a text or a list of texts. */
static void take_values(const brc_case_reader *r, const brc_node *node, expansion *x, int a)
{
    x->n_values[a] = 0;
    if (node->kind == BRC_NODE_SCALAR) {
        x->value[a][x->n_values[a]++] = node->text;
    } else if (node->kind == BRC_NODE_LIST && node->n_children >= 1 && node->n_children <= VALUES) {
        for (const brc_node *item = node->first; item; item = item->next)
            x->value[a][x->n_values[a]++] = brc_case_text_of(r, item);
    } else {
        brc_case_wrong(r, node, "a value or a list of at most " BRC_STRING(64) " values");
        x->value[a][x->n_values[a]++] = "";
    }
}

static brc_status read_sweep(const brc_case_reader *r, const brc_node *node, const brc_node *scenes,
                             const brc_operator *operator, brc_sweep * sweep)
{
    expansion *x = NULL;
    const brc_node *scene_name = node->kind == BRC_NODE_MAP ? brc_node_find(node, "scene") : NULL;
    const char *scene = scene_name ? brc_case_text_of(r, scene_name) : "scene.yaml";
    const brc_node *described = brc_node_find(scenes, scene),
                   *axes = described ? brc_node_find(described, "axes") : NULL;
    const brc_node *defaults = described ? brc_node_find(described, "defaults") : NULL;
    if (node->kind != BRC_NODE_MAP || !axes || axes->kind != BRC_NODE_MAP || axes->n_children > AXES ||
        (defaults && defaults->kind != BRC_NODE_MAP)) {
        brc_case_wrong(r, node, "a map with the axes of a scene that `scenes` describes");
        return BRC_OK;
    }
    BRC_TRY(BRC_ALLOCATE(r->context, &x, 1, "sweep"));
    const brc_node *reference = brc_node_find(described, "reference");
    *x = (expansion){.name = "",
                     .scene = scene,
                     .operator= operator,
                     .reference = reference ? brc_case_number_of(r, reference) : sweep->reference };
    for (const brc_node *axis = axes->first; axis; axis = axis->next) {
        const brc_node *given = brc_node_find(node, axis->key),
                       *otherwise = defaults ? brc_node_find(defaults, axis->key) : NULL;
        const int a = x->n_axes++;
        x->axis[a] = axis;
        x->n_values[a] = 1;
        x->value[a][0] = "-";
        if (given || otherwise) take_values(r, given ? given : otherwise, x, a);
    }
    for (const brc_node *item = node->first; item; item = item->next) {
        if (strcmp(item->key, "name") == 0)
            x->name = brc_case_text_of(r, item);
        else if (strcmp(item->key, "quick") == 0)
            x->quick = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "scene") != 0 && !brc_node_find(axes, item->key))
            brc_case_unknown_key(r, item, "sweep");
    }
    const brc_status status = add_runs(r, sweep, x);
    brc_memory_free(x);
    return status;
}

static brc_status read_top(const brc_case_reader *r, const brc_node *root, brc_sweep *sweep)
{
    static const char *const costs[] = {"run", "crossings", NULL};
    const brc_node *scenes = NULL, *sweeps = NULL;
    const brc_operator *operator= & brc_operator_measures;
    double half_angle = 0;
    for (const brc_node *item = root->kind == BRC_NODE_MAP ? root->first : NULL; item; item = item->next) {
        if (strcmp(item->key, "title") == 0)
            sweep->what.title = brc_case_text_of(r, item);
        else if (strcmp(item->key, "about") == 0)
            sweep->what.about = brc_case_text_of(r, item);
        else if (strcmp(item->key, "quantity") == 0)
            sweep->quantity = brc_case_text_of(r, item);
        else if (strcmp(item->key, "unit") == 0)
            sweep->unit = brc_case_text_of(r, item);
        else if (strcmp(item->key, "reference") == 0)
            sweep->reference = brc_case_number_of(r, item);
        else if (strcmp(item->key, "with") == 0)
            operator= brc_operator_of(r, item);
        else if (strcmp(item->key, "half_angle") == 0)
            half_angle = brc_case_number_of(r, item);
        else if (strcmp(item->key, "cost") == 0)
            sweep->cost = (brc_sweep_cost)brc_case_word_of(r, item, costs);
        else if (strcmp(item->key, "scenes") == 0 && item->kind == BRC_NODE_MAP)
            scenes = item;
        else if (strcmp(item->key, "sweeps") == 0 && item->kind == BRC_NODE_LIST)
            sweeps = item;
        else
            brc_case_unknown_key(r, item, "problem");
    }
    if (!scenes || !sweeps || !sweep->quantity[0]) brc_case_wrong(r, root, "a map with quantity, scenes and sweeps");
    for (const brc_node *item = scenes && sweeps ? sweeps->first : NULL; item; item = item->next)
        BRC_TRY(read_sweep(r, item, scenes, operator, sweep));
    for (int k = 0; k < sweep->what.n_runs; ++k)
        sweep->what.runs[k].half_angle = half_angle;
    return BRC_OK;
}

/* Length of the problem's name in a path "accuracy/<problem>/sweep.yaml", 0 for other files. */
static int problem_part(const char *path)
{
    static const char before[] = "accuracy/", after[] = "/sweep.yaml";
    const size_t length = strlen(path), rest = sizeof before - 1 + sizeof after - 1;
    if (length <= rest || strncmp(path, before, sizeof before - 1) != 0 ||
        strcmp(path + length - (sizeof after - 1), after) != 0)
        return 0;
    return (int)(length - rest);
}

const char *brc_sweep_name(int k, int *length)
{
    for (int f = 0; f < brc_case_file_count; ++f) {
        *length = problem_part(brc_case_files[f].path);
        if (*length > 0 && k-- == 0) return brc_case_files[f].path + strlen("accuracy/");
    }
    return NULL;
}

brc_status brc_sweep_read(brc_context *context, const char *folder, const char *problem, brc_sweep **out)
{
    brc_status status = BRC_OK;
    brc_problems *problems = NULL;
    brc_sweep *sweep = NULL;
    brc_node *root = NULL;
    char shown[96];
    *out = NULL;
    snprintf(shown, sizeof shown, "accuracy/%s/sweep.yaml", problem);
    BRC_TRY(BRC_ALLOCATE(context, &sweep, 1, "a sweep"));
    snprintf(sweep->name, sizeof sweep->name, "accuracy/%s", problem);
    sweep->problem = problem;
    sweep->quantity = "";
    sweep->unit = "-";
    sweep->reference = NAN;
    sweep->what = (brc_case){.name = sweep->name, .title = "", .about = "", .folder = folder};
    BRC_TRY_OR(cleanup,
               brc_case_parse(context, folder, sweep->name, "sweep.yaml", shown, &sweep->what.tree, &problems, &root));
    const brc_case_reader r = {context, problems};
    if (root) BRC_TRY_OR(cleanup, read_top(&r, root, sweep));
    BRC_TRY_OR(cleanup, brc_problems_report(problems));
    *out = sweep;
    sweep = NULL;
cleanup:
    brc_problems_free(&problems);
    brc_sweep_free(&sweep);
    return status;
}

void brc_sweep_free(brc_sweep **sweep)
{
    if (!sweep || !*sweep) return;
    while ((*sweep)->texts) {
        struct brc_sweep_texts *next = (*sweep)->texts->next;
        brc_memory_free((*sweep)->texts);
        (*sweep)->texts = next;
    }
    brc_memory_free((*sweep)->what.runs);
    brc_memory_free((*sweep)->sweep_of);
    brc_memory_free((*sweep)->reference_of);
    brc_tree_free(&(*sweep)->what.tree);
    brc_memory_free(*sweep);
    *sweep = NULL;
}

const char *brc_sweep_value(const brc_case_run *run, const char *axis)
{
    for (int k = 0; k < run->n_labels; ++k)
        if (strcmp(run->labels[k].key, axis) == 0) return run->labels[k].value;
    return NULL;
}
