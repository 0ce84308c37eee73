/* Reading a study, and the values of its runs. */
#include "study.h"
#include "reproduce/case_node.h"
#include "../base/file.h"
#include "../base/memory.h"
#include "../base/random.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char DRAWS_KEY[] = "draws";

static bool is_random(const brc_study_key *key)
{
    return key->kind == BRC_STUDY_UNIFORM || key->kind == BRC_STUDY_NORMAL;
}

/* A whole number of at least `least`. */
static int64_t whole_of(const brc_case_reader *r, const brc_node *node, int64_t least, int64_t most)
{
    const double value = brc_case_number_of(r, node);
    if (value >= (double)least && value <= (double)most && value == floor(value)) return (int64_t)value;
    char expected[80];
    snprintf(expected, sizeof expected, "a whole number from %lld to %lld", (long long)least, (long long)most);
    if (!isnan(value)) brc_case_wrong(r, node, expected);
    return least;
}

static brc_status read_values(const brc_case_reader *r, const brc_node *node, brc_study_key *key)
{
    if (node->kind != BRC_NODE_LIST || node->n_children < 1 || node->n_children > BRC_STUDY_VALUES) {
        brc_case_wrong(r, node, "a list of 1 to " BRC_STRING(BRC_STUDY_VALUES) " values");
        return BRC_OK;
    }
    BRC_TRY(BRC_ALLOCATE(r->context, &key->values, node->n_children, "values of a study"));
    key->n_values = 0;
    for (const brc_node *item = node->first; item; item = item->next)
        key->values[key->n_values++] = brc_case_text_of(r, item);
    return BRC_OK;
}

static void read_pair(const brc_case_reader *r, const brc_node *node, brc_study_key *key)
{
    if (node->kind != BRC_NODE_LIST || node->n_children != 2) {
        brc_case_wrong(r, node,
                       key->kind == BRC_STUDY_UNIFORM ? "a list of two numbers: from, to"
                                                      : "a list of two numbers: mean, standard deviation");
        return;
    }
    key->a = brc_case_number_of(r, node->first);
    key->b = brc_case_number_of(r, node->last);
}

/* One of `vary`: {key: PATH, values: [...]}, {key: PATH, from: N, to: N}, {key: PATH, uniform: [A, B], unit: GPa},
 * {key: PATH, normal: [MEAN, DEVIATION], unit: GPa}. */
static brc_status read_key(const brc_case_reader *r, const brc_node *node, brc_study_key *key)
{
    int kinds = 0;
    int64_t to = 0;
    *key = (brc_study_key){.key = "", .n_values = 1, .unit = ""};
    for (const brc_node *item = node->kind == BRC_NODE_MAP ? node->first : NULL; item; item = item->next) {
        const bool uniform = strcmp(item->key, "uniform") == 0;
        if (strcmp(item->key, "key") == 0)
            key->key = brc_case_text_of(r, item);
        else if (strcmp(item->key, "unit") == 0)
            key->unit = brc_case_text_of(r, item);
        else if (strcmp(item->key, "average") == 0)
            key->averaged = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "to") == 0)
            to = whole_of(r, item, 0, INT32_MAX);
        else if (strcmp(item->key, "values") == 0) {
            ++kinds;
            BRC_TRY(read_values(r, item, key));
        } else if (strcmp(item->key, "from") == 0) {
            ++kinds;
            key->kind = BRC_STUDY_RANGE;
            key->from = whole_of(r, item, 0, INT32_MAX);
        } else if (uniform || strcmp(item->key, "normal") == 0) {
            ++kinds;
            key->kind = uniform ? BRC_STUDY_UNIFORM : BRC_STUDY_NORMAL;
            read_pair(r, item, key);
        } else
            brc_case_unknown_key(r, item, "key of a study");
    }
    if (!key->key[0] || kinds != 1)
        brc_case_wrong(r, node, "a map with `key` and one of `values`, `from` with `to`, `uniform`, `normal`");
    if (key->kind == BRC_STUDY_RANGE) {
        if (to < key->from || to - key->from >= BRC_STUDY_VALUES)
            brc_case_wrong(r, node, "`to` of at least `from`, and at most " BRC_STRING(BRC_STUDY_VALUES) " values");
        else
            key->n_values = (int)(to - key->from) + 1;
    }
    return BRC_OK;
}

static brc_status read_keys(const brc_case_reader *r, const brc_node *node, brc_study *study)
{
    if (node->kind != BRC_NODE_LIST || node->n_children > BRC_STUDY_KEYS) {
        brc_case_wrong(r, node, "a list of at most " BRC_STRING(BRC_STUDY_KEYS) " maps");
        return BRC_OK;
    }
    for (const brc_node *item = node->first; item; item = item->next)
        BRC_TRY(read_key(r, item, &study->keys[study->n_keys++]));
    return BRC_OK;
}

/* The laws of fragments by their words, in the order of brc_study_law from BRC_STUDY_FRAGMENTS_POWER on. */
static const char *const fragment_laws[] = {"power", "schuhmann", "rosin_rammler", "gilvarry", NULL};

static double share_of(const brc_case_reader *r, const brc_node *node)
{
    const double share = brc_case_number_of(r, node);
    if (!isnan(share) && !(share > 0 && share < 1)) brc_case_wrong(r, node, "a share of the mass between 0 and 1");
    return share;
}

/* One of `fit`. */
static void read_fit(const brc_case_reader *r, const brc_node *node, const brc_study *study, brc_study_fit *fit)
{
    enum { ELEMENTS = 3, MOST = 1000000 };
    int laws = 0;
    *fit = (brc_study_fit){.of = "", .by = "", .elements = ELEMENTS};
    const brc_node *by = NULL, *bounds = NULL, *count = NULL;
    for (const brc_node *item = node->kind == BRC_NODE_MAP ? node->first : NULL; item; item = item->next) {
        const bool power = strcmp(item->key, "power") == 0, size_effect = strcmp(item->key, "size_effect") == 0;
        if (power || size_effect || strcmp(item->key, "weibull") == 0) {
            ++laws;
            fit->law = power ? BRC_STUDY_POWER : size_effect ? BRC_STUDY_SIZE_EFFECT : BRC_STUDY_WEIBULL;
            fit->of = brc_case_text_of(r, item);
        } else if (strcmp(item->key, "fragments") == 0) {
            ++laws;
            fit->law = (brc_study_law)(BRC_STUDY_FRAGMENTS_POWER + brc_case_word_of(r, item, fragment_laws));
        } else if (strcmp(item->key, "by") == 0)
            by = item;
        else if (strcmp(item->key, "elements") == 0)
            count = item;
        else if (strcmp(item->key, "above") == 0)
            fit->above = share_of(r, bounds = item);
        else if (strcmp(item->key, "below") == 0)
            fit->below = share_of(r, bounds = item);
        else
            brc_case_unknown_key(r, item, "fit");
    }
    const bool has_by = fit->law == BRC_STUDY_POWER || fit->law == BRC_STUDY_SIZE_EFFECT;
    const bool whole = laws == 1 && has_by == (by != NULL) && (!bounds || fit->law == BRC_STUDY_FRAGMENTS_POWER) &&
                       (!count || fit->law >= BRC_STUDY_FRAGMENTS_POWER);
    if (!whole) {
        brc_case_wrong(r, node,
                       "{weibull: MEASURE}, {power: MEASURE, by: KEY}, {size_effect: MEASURE, by: KEY}, {fragments: "
                       "LAW, elements: N}, or "
                       "{fragments: power, elements: N, above: SHARE, below: SHARE}");
        return;
    }
    if (count) fit->elements = (int)whole_of(r, count, 1, MOST);
    if (fit->above > 0 && fit->below > 0 && fit->above >= fit->below)
        brc_case_wrong(r, bounds, "`above` that is less than `below`");
    bool known = !by;
    if (by) fit->by = brc_case_text_of(r, by);
    for (int k = 0; k < study->n_keys; ++k)
        known |= strcmp(study->keys[k].key, fit->by) == 0;
    if (!known) brc_case_wrong(r, by, "a key of `vary`");
}

static void read_fits(const brc_case_reader *r, const brc_node *node, brc_study *study)
{
    if (node->kind != BRC_NODE_LIST || node->n_children > BRC_STUDY_FITS) {
        brc_case_wrong(r, node, "a list of at most " BRC_STRING(BRC_STUDY_FITS) " maps");
        return;
    }
    for (const brc_node *item = node->first; item; item = item->next)
        read_fit(r, item, study, &study->fits[study->n_fits++]);
}

/* Runs without draws: all combinations, or with `together` as many as each list and range has values that has more
 * than one. */
static int64_t points_of(const brc_case_reader *r, const brc_node *root, const brc_study *study)
{
    int64_t points = 1;
    for (int k = 0; k < study->n_keys; ++k) {
        const brc_study_key *key = &study->keys[k];
        if (is_random(key)) continue;
        if (!study->together)
            points = points > BRC_STUDY_RUNS ? points : points * key->n_values;
        else if (points == 1)
            points = key->n_values;
        else if (key->n_values > 1 && key->n_values != points)
            brc_case_wrong(r, root, "with `together` as many values in each key of `vary`");
    }
    return points;
}

static brc_status read_root(const brc_case_reader *r, const brc_node *root, const char *path, brc_study *study)
{
    const brc_node *fits = NULL;
    const char *scene = "";
    bool random = false;
    if (root->kind != BRC_NODE_MAP) brc_case_wrong(r, root, "a map with `scene` and `vary`");
    for (const brc_node *item = root->kind == BRC_NODE_MAP ? root->first : NULL; item; item = item->next) {
        if (strcmp(item->key, "scene") == 0)
            scene = brc_case_text_of(r, item);
        else if (strcmp(item->key, "vary") == 0)
            BRC_TRY(read_keys(r, item, study));
        else if (strcmp(item->key, DRAWS_KEY) == 0)
            study->draws = (int)whole_of(r, item, 1, BRC_STUDY_RUNS);
        else if (strcmp(item->key, "seed") == 0)
            study->seed = (uint64_t)whole_of(r, item, 0, INT32_MAX);
        else if (strcmp(item->key, "together") == 0)
            study->together = brc_case_flag_of(r, item);
        else if (strcmp(item->key, "fit") == 0)
            fits = item;
        else
            brc_case_unknown_key(r, item, "study");
    }
    if (fits) read_fits(r, fits, study);
    for (int k = 0; k < study->n_keys; ++k)
        random |= is_random(&study->keys[k]);
    const int64_t runs = points_of(r, root, study);
    if (!scene[0] || study->n_keys == 0) brc_case_wrong(r, root, "`scene: FILE` and `vary: [...]`");
    if (random != (study->draws > 0))
        brc_case_wrong(r, root, "`draws` with keys that are `uniform` or `normal`, and only with them");
    if (study->draws == 0) study->draws = 1;
    if (runs * study->draws > BRC_STUDY_RUNS)
        brc_case_wrong(r, root, "at most " BRC_STRING(BRC_STUDY_RUNS) " runs in all");
    study->n_runs = (int)(runs * study->draws > BRC_STUDY_RUNS ? 0 : runs * study->draws);
    const char *slash = strrchr(path, '/');
    const size_t folder = scene[0] == '/' || !slash ? 0 : (size_t)(slash - path) + 1, room = folder + strlen(scene) + 1;
    BRC_TRY(BRC_ALLOCATE(r->context, &study->scene, room, "path of a scene"));
    snprintf(study->scene, room, "%.*s%s", (int)folder, path, scene);
    return BRC_OK;
}

brc_status brc_study_read(brc_context *context, const char *path, brc_study **out)
{
    enum { FILE_LIMIT = 1 << 24 };
    brc_study *study = NULL;
    brc_problems *problems = NULL;
    brc_node *root = NULL;
    char *text = NULL;
    size_t bytes;
    brc_status status = BRC_OK;
    *out = NULL;
    BRC_TRY_OR(cleanup, brc_file_read_whole(context, path, FILE_LIMIT, &text, &bytes));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &study, 1, "study"));
    BRC_TRY_OR(cleanup, brc_tree_create(context, &study->tree));
    BRC_TRY_OR(cleanup, brc_problems_create(context, path, 0, NULL, &problems));
    BRC_TRY_OR(cleanup, brc_tree_parse(study->tree, problems, 0, text, bytes, &root));
    const brc_case_reader reader = {context, problems};
    if (root) BRC_TRY_OR(cleanup, read_root(&reader, root, path, study));
    BRC_TRY_OR(cleanup, brc_problems_report(problems));
    *out = study;
    study = NULL;
cleanup:
    brc_problems_free(&problems);
    brc_memory_free(text);
    brc_study_free(&study);
    return status;
}

void brc_study_free(brc_study **handle)
{
    brc_study *study = handle ? *handle : NULL;
    if (!study) return;
    for (int k = 0; k < study->n_keys; ++k)
        brc_memory_free(study->keys[k].values);
    brc_memory_free(study->scene);
    brc_tree_free(&study->tree);
    brc_memory_free(study);
    *handle = NULL;
}

/* ---- runs: the last key changes fastest, and draws fastest of all ---- */

static int index_of(const brc_study *study, int run, int key)
{
    int rest = run / study->draws;
    if (study->together) return study->keys[key].n_values > 1 ? rest : 0;
    for (int k = study->n_keys - 1; k > key; --k)
        rest /= study->keys[k].n_values;
    return rest % study->keys[key].n_values;
}

const char *brc_study_value(const brc_study *study, int run, int k, char *out, size_t room)
{
    const brc_study_key *key = &study->keys[k];
    double u[4];
    if (key->kind == BRC_STUDY_LIST)
        snprintf(out, room, "%s", key->values[index_of(study, run, k)]);
    else if (key->kind == BRC_STUDY_RANGE)
        snprintf(out, room, "%lld", (long long)(key->from + index_of(study, run, k)));
    else {
        brc_random_uniform4(study->seed, BRC_RANDOM_STUDY, (uint64_t)run, (uint64_t)k, u);
        const double standard = sqrt(-2 * log(u[0])) * cos(2 * acos(-1) * u[1]); /* Box and Muller */
        const double value =
            key->kind == BRC_STUDY_UNIFORM ? key->a + (key->b - key->a) * u[0] : key->a + key->b * standard;
        snprintf(out, room, "%.12g%s%s", value, key->unit[0] ? " " : "", key->unit);
    }
    return out;
}
