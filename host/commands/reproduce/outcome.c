/* Values that a case of a paper gives. */
#include "reproduce.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void brc_outcome_add(brc_outcome *outcome, const char *name, const char *unit, double value, double reference)
{
    if (outcome->n_values == BRC_CASE_VALUES) return;
    brc_case_value *to = &outcome->values[outcome->n_values++];
    snprintf(to->name, sizeof to->name, "%s", name);
    snprintf(to->unit, sizeof to->unit, "%s", unit);
    to->value = value;
    to->reference = reference;
    to->scatter = NAN;
}

const brc_case_value *brc_outcome_find(const brc_outcome *outcome, const char *name)
{
    for (int k = 0; k < outcome->n_values; ++k)
        if (strcmp(outcome->values[k].name, name) == 0) return &outcome->values[k];
    return NULL;
}

double brc_outcome_label(const brc_outcome *outcome, const char *key)
{
    for (int k = 0; k < outcome->run->n_labels; ++k) {
        char *end;
        const double value =
            strcmp(outcome->run->labels[k].key, key) == 0 ? strtod(outcome->run->labels[k].value, &end) : NAN;
        if (!isnan(value) && end != outcome->run->labels[k].value) return value;
    }
    return NAN;
}
