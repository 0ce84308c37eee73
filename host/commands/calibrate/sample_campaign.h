/* A campaign: tests of packed cubes of spheres, one thread a test, since one of 10 000 spheres is too small to share;
 * each result a line of a file at once, so that a campaign that was stopped or killed goes on where it was. What a test
 * is, its kind says (calibrate_campaign.c, strength_campaign.c). */
#ifndef BRC_COMMANDS_SAMPLE_CAMPAIGN_H
#define BRC_COMMANDS_SAMPLE_CAMPAIGN_H

#include "calibrate.h"

/* What tells a kind of test from another. A row is a struct of row_size bytes: the keys of a test, then its result.
 * `plan` is the kind's own. */
typedef struct brc_sample_campaign_kind {
    const char *file, *header; /* "solves.csv"; its first line, with newline */
    const char *title, *unit;  /* of the progress line: "calibration", "solves" */
    double edge;               /* of the cube [m] */
    size_t row_size;
    int (*count)(const void *plan); /* tests of one sample at one coordination number */
    void (*key)(const void *plan, uint64_t seed, double coordination, int k,
                void *row);                                  /* test k with its keys, and nothing else */
    bool (*same)(const void *row, const void *key);          /* is it that test? */
    int (*compare)(const void *left, const void *right);     /* order of the results */
    void (*print)(const void *row, char *line, size_t room); /* with newline */
    bool (*parse)(const char *line, void *row);              /* a whole line without newline; false: it is no result */
    /* The result of the keys in row. *kept: of the kind's own, NULL before the first test of one sample at one
     * coordination number. */
    brc_status (*test)(brc_context *context, brc_device *device, const brc_domain *domain, void *row, void **kept);
    /* Frees it. NULL: tests keep nothing. Where they do, those that are there already are made again before one that is
     * not, so that it has the same bits. */
    void (*forget)(void **kept);
} brc_sample_campaign_kind;

/* Results. `row` begins a list of structs of the kind. */
typedef struct brc_sample_campaign_rows {
    int64_t n, capacity;
    void *row; /* [n] owned */
} brc_sample_campaign_rows;

/* Run what the plan asks of the packings of `samples` (their seeds, coordination numbers and threads) and folder/file
 * lacks. Without `resume` a file that is there already is refused. Results of other plans stay in the file, *out has
 * those of this one, in the kind's order. */
brc_status brc_sample_campaign_run(brc_context *context, const brc_sample_campaign_kind *kind,
                                   const brc_calibration_plan *samples, const void *plan, const char *folder,
                                   bool resume, brc_sample_campaign_rows *out);

#endif
