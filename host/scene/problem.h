/* The errors and warnings of one reading: collected wherever they are found, told in the order of the text. */
#ifndef BRC_SCENE_PROBLEM_H
#define BRC_SCENE_PROBLEM_H

#include "../base/status.h"

/* Where a piece of a scene stands. source 0: the file, with line and column from 1 (columns count characters);
 * source k > 0: override k - 1, line and column unused. */
typedef struct brc_mark {
    int source, line, column;
} brc_mark;

typedef struct brc_problems brc_problems;

/* name: of the file, shown in front; overrides: [n_overrides] shown in place of file:line:col. All borrowed. */
brc_status brc_problems_create(brc_context *context, const char *name, int n_overrides, const char *const *overrides,
                               brc_problems **out);
void brc_problems_free(brc_problems **problems);
/* Add one: what was found, what is expected, the cure. More than BRC_PROBLEMS_MOST are only counted. */
void brc_problems_add(brc_problems *problems, brc_mark mark, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same for what is no error, but hardly meant: logged where there are no errors. */
void brc_problems_warn(brc_problems *problems, brc_mark mark, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
#define BRC_PROBLEMS_MOST 100
/* Errors so far. */
int brc_problems_count(const brc_problems *problems);
/* Record all errors, sorted by place, as "file:line:col: error: ..." in the context, and return BRC_BAD_INPUT. Without
 * any, log the warnings as "warning: file:line:col: ..." and return BRC_OK. */
brc_status brc_problems_report(brc_problems *problems);

/* A mark as errors begin with it, "file:line:col: error: ", or with the override. */
void brc_problems_place(const brc_problems *problems, brc_mark mark, char out[BRC_PLACE_LENGTH]);

/* The nearest of `n` known words to `found` by edit distance, NULL when none is near enough to be a slip. */
const char *brc_nearest_word(const char *found, int n, const char *const *known);
/* The same, but NULL when no more problems are told: a hostile file would make us guess for minutes. */
const char *brc_problems_nearest(const brc_problems *problems, const char *found, int n, const char *const *known);

#endif
