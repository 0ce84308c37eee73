/* Collecting errors and warnings, and guessing what a misspelt word was meant to be. */
#include "problem.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define TEXT_LENGTH 768
#define WORD_LENGTH 48 /* longer words are not guessed at */

typedef struct problem {
    brc_mark mark;
    int order; /* of finding, so that equal places keep it */
    char text[TEXT_LENGTH];
} problem;

typedef struct problem_list {
    int n, n_all;
    problem items[BRC_PROBLEMS_MOST];
} problem_list;

struct brc_problems {
    brc_context *context;
    const char *name;
    int n_overrides;
    const char *const *overrides;
    problem_list errors, warnings;
};

brc_status brc_problems_create(brc_context *context, const char *name, int n_overrides, const char *const *overrides,
                               brc_problems **out)
{
    BRC_TRY(brc_memory_allocate(context, (void **)out, 1, sizeof **out, "list of errors"));
    (*out)->context = context;
    (*out)->name = name;
    (*out)->n_overrides = n_overrides;
    (*out)->overrides = overrides;
    return BRC_OK;
}

void brc_problems_free(brc_problems **problems)
{
    if (!problems) return;
    brc_memory_free(*problems);
    *problems = NULL;
}

static void add(problem_list *list, brc_mark mark, const char *format, va_list arguments)
{
    ++list->n_all;
    if (list->n == BRC_PROBLEMS_MOST) return;
    problem *fresh = &list->items[list->n];
    fresh->mark = mark;
    fresh->order = list->n++;
    vsnprintf(fresh->text, sizeof fresh->text, format, arguments);
}

void brc_problems_add(brc_problems *problems, brc_mark mark, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add(&problems->errors, mark, format, arguments);
    va_end(arguments);
}

void brc_problems_warn(brc_problems *problems, brc_mark mark, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add(&problems->warnings, mark, format, arguments);
    va_end(arguments);
}

int brc_problems_count(const brc_problems *problems)
{
    return problems->errors.n_all;
}

static int by_place(const void *left, const void *right)
{
    const problem *a = left, *b = right;
    if (a->mark.source != b->mark.source) return a->mark.source < b->mark.source ? -1 : 1;
    if (a->mark.line != b->mark.line) return a->mark.line < b->mark.line ? -1 : 1;
    if (a->mark.column != b->mark.column) return a->mark.column < b->mark.column ? -1 : 1;
    return a->order < b->order ? -1 : a->order > b->order;
}

/* "file:line:col: ", or the override in its place. */
static const char *place_of(const brc_problems *problems, brc_mark mark, char *out, size_t room)
{
    if (mark.source == 0)
        snprintf(out, room, "%s:%d:%d: ", problems->name, mark.line, mark.column);
    else
        snprintf(out, room, "%s: in the override '%.200s': ", problems->name, problems->overrides[mark.source - 1]);
    return out;
}

void brc_problems_place(const brc_problems *problems, brc_mark mark, char out[BRC_PLACE_LENGTH])
{
    static const char word[] = "error: ";
    place_of(problems, mark, out, BRC_PLACE_LENGTH - sizeof word);
    strcat(out, word);
}

brc_status brc_problems_report(brc_problems *problems)
{
    problem_list *list = problems->errors.n_all > 0 ? &problems->errors : &problems->warnings;
    char place[1024];
    qsort(list->items, (size_t)list->n, sizeof list->items[0], by_place);
    for (int i = 0; i < list->n; ++i) {
        place_of(problems, list->items[i].mark, place, sizeof place);
        if (list == &problems->errors)
            BRC_FAIL(problems->context, BRC_BAD_INPUT, "%serror: %s", place, list->items[i].text);
        else
            brc_log(problems->context, BRC_LOG_WARNING, "%s%s", place, list->items[i].text);
    }
    if (list == &problems->warnings) return BRC_OK;
    if (list->n_all > list->n)
        BRC_FAIL(problems->context, BRC_BAD_INPUT, "%s: and %d more errors", problems->name, list->n_all - list->n);
    return BRC_BAD_INPUT;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* Slips (insert, delete, replace a byte, swap two neighbours) from a to b, both shorter than WORD_LENGTH. */
static int edit_distance(const char *a, const char *b)
{
    int rows[3][WORD_LENGTH + 1]; /* of the first i bytes of a, in turn */
    const int n = (int)strlen(b);
    for (int j = 0; j <= n; ++j)
        rows[0][j] = j;
    int i = 0;
    for (; a[i] != '\0'; ++i) {
        const int *before = rows[(i + 2) % 3], *last = rows[i % 3];
        int *row = rows[(i + 1) % 3];
        row[0] = i + 1;
        for (int j = 0; j < n; ++j) {
            row[j + 1] = least(last[j] + (a[i] != b[j]), 1 + least(last[j + 1], row[j]));
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                row[j + 1] = least(row[j + 1], 1 + before[j - 1]);
        }
    }
    return rows[i % 3][n];
}

const char *brc_nearest_word(const char *found, int n, const char *const *known)
{
    const char *nearest = NULL;
    const size_t length = strnlen(found, WORD_LENGTH);
    if (length == WORD_LENGTH) return NULL;
    int best = 1 + (length > 4 ? (int)length / 3 : length > 1); /* a slip changes up to a third of the word */
    for (int i = 0; i < n; ++i)                                 /* capitals are the smallest slip */
        if (strcasecmp(found, known[i]) == 0) return known[i];
    for (int i = 0; i < n; ++i) {
        if (strnlen(known[i], WORD_LENGTH) == WORD_LENGTH) continue;
        const int distance = edit_distance(found, known[i]);
        if (distance >= best) continue;
        best = distance;
        nearest = known[i];
    }
    return nearest;
}

const char *brc_problems_nearest(const brc_problems *problems, const char *found, int n, const char *const *known)
{
    return problems->errors.n == BRC_PROBLEMS_MOST ? NULL : brc_nearest_word(found, n, known);
}
