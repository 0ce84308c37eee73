#include "price_choices.h"
#include "price_rows.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What runs of a pair share, the precision and the fraction of the step both among it but for the one asked for; and
 * what is measured of them. */
static const char *const NAMES[] = {"model",       "error",    "run_s",        "precision",  "dt_fraction", "problem",
                                    "preparation", "elements", "bonds",        "integrator", "quantity",    "nu",
                                    "phi",         "level",    "coordination", "variant",    "seed",        "threads"};
enum { MODEL, ERROR, RUN_S, SHARED, N_NAMES = sizeof NAMES / sizeof *NAMES };

static int column_index(const char *column)
{
    for (int k = SHARED; k < N_NAMES; ++k)
        if (strcmp(NAMES[k], column) == 0) return k;
    return -1;
}

static bool is_measured(const char *const *value, const char *model)
{
    return strcmp(value[MODEL], model) == 0 && value[ERROR][0] && atof(value[RUN_S]) > 0;
}

/* The first run of the text that is like `value` but for the usual choice. */
static bool find_partner(const char *text, const char *const *value, int free, const char *usual, double *error,
                         double *seconds)
{
    brc_price_rows rows;
    const char *other[N_NAMES];
    brc_price_rows_begin(&rows, text, N_NAMES, NAMES);
    while (brc_price_rows_next(&rows, other)) {
        bool same = is_measured(other, value[MODEL]) && strcmp(other[free], usual) == 0;
        for (int k = SHARED; k < N_NAMES && same; ++k)
            same = k == free || strcmp(other[k], value[k]) == 0;
        if (!same) continue;
        *error = fabs(atof(other[ERROR]));
        *seconds = atof(other[RUN_S]);
        return true;
    }
    return false;
}

void brc_price_choices_read(const char *text, const char *model, const char *column, const char *usual, int *n,
                            brc_price_choice out[BRC_CHOICES_MOST])
{
    brc_price_rows rows;
    const char *value[N_NAMES];
    double seconds[BRC_CHOICES_MOST][2] = {{0}}; /* sums: with the choice, with the usual one */
    const int free = column_index(column);
    *n = 0;
    brc_price_rows_begin(&rows, text, N_NAMES, NAMES);
    while (free >= 0 && brc_price_rows_next(&rows, value)) {
        double error, partner_s;
        if (!is_measured(value, model) || strcmp(value[free], usual) == 0 ||
            !find_partner(text, value, free, usual, &error, &partner_s))
            continue;
        int c = 0;
        while (c < *n && strcmp(out[c].value, value[free]) != 0)
            ++c;
        if (c == BRC_CHOICES_MOST) continue;
        if (c == *n) {
            out[(*n)++] = (brc_price_choice){.pairs = 0};
            snprintf(out[c].value, sizeof out[c].value, "%s", value[free]);
        }
        seconds[c][0] += atof(value[RUN_S]);
        seconds[c][1] += partner_s;
        out[c].pairs += 1;
        out[c].time = seconds[c][0] / seconds[c][1];
        out[c].more_error = fmax(out[c].more_error, fabs(atof(value[ERROR])) - error);
    }
}

int brc_price_choice_best(int n, const brc_price_choice *choice, double error)
{
    int best = -1;
    for (int c = 0; c < n; ++c)
        if (choice[c].more_error <= error && choice[c].time < (best < 0 ? 1 : choice[best].time)) best = c;
    return best;
}
