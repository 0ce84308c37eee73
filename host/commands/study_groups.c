/* Runs of a study that are averaged together. */
#include "study.h"
#include "../base/memory.h"
#include "../output/text.h"
#include <stdlib.h>
#include <string.h>

enum { VALUE = 256 };

/* A run, and the values that tell its group. */
typedef struct member {
    const char *values;
    int run, first; /* first: run of its group */
} member;

static int by_values(const void *a, const void *b)
{
    const member *one = a, *other = b;
    const int order = strcmp(one->values, other->values);
    return order ? order : (one->run > other->run) - (one->run < other->run);
}

static int by_first(const void *a, const void *b)
{
    const member *one = a, *other = b;
    if (one->first != other->first) return one->first < other->first ? -1 : 1;
    return (one->run > other->run) - (one->run < other->run);
}

bool brc_study_is_averaged(const brc_study_key *key)
{
    return key->averaged || key->kind == BRC_STUDY_UNIFORM || key->kind == BRC_STUDY_NORMAL;
}

/* A line a run; start: [n_runs] where it begins. */
static brc_status write_values(const brc_study *study, const char *by, bool one, brc_text *text, size_t *start)
{
    char value[VALUE];
    for (int run = 0; run < study->n_runs; ++run) {
        start[run] = text->length;
        for (int k = 0; k < study->n_keys && !one; ++k) {
            const brc_study_key *key = &study->keys[k];
            if (brc_study_is_averaged(key) || (by && strcmp(key->key, by) == 0)) continue;
            brc_study_add_cell(text, brc_study_value(study, run, k, value, sizeof value));
            brc_text_add(text, ",");
        }
        brc_text_add_bytes(text, "", 1);
    }
    return text->status;
}

brc_status brc_study_group(brc_context *context, const brc_study *study, const char *by, bool one,
                           brc_study_groups *out)
{
    const int n = study->n_runs;
    brc_text text = {.context = context};
    size_t *place = NULL;
    member *all = NULL;
    brc_status status = BRC_OK;
    *out = (brc_study_groups){0};
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &place, n, "groups of a study"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &all, n, "groups of a study"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->run, n, "groups of a study"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &out->start, n + 1, "groups of a study"));
    BRC_TRY_OR(cleanup, write_values(study, by, one, &text, place));
    for (int run = 0; run < n; ++run)
        all[run] = (member){.values = text.data + place[run], .run = run};
    qsort(all, (size_t)n, sizeof *all, by_values);
    for (int i = 0; i < n; ++i)
        all[i].first = i > 0 && strcmp(all[i].values, all[i - 1].values) == 0 ? all[i - 1].first : all[i].run;
    qsort(all, (size_t)n, sizeof *all, by_first);
    for (int i = 0; i < n; ++i) {
        if (all[i].run == all[i].first) out->start[out->n++] = i;
        out->run[i] = all[i].run;
    }
    out->start[out->n] = n;
cleanup:
    brc_text_free(&text);
    brc_memory_free(place);
    brc_memory_free(all);
    return status;
}

void brc_study_groups_free(brc_study_groups *groups)
{
    brc_memory_free(groups->run);
    brc_memory_free(groups->start);
    *groups = (brc_study_groups){0};
}
