/* The table of operators. */
#include "operators.h"

const brc_operator brc_operator_measures = {.name = "measures"};

const brc_operator *const brc_operators[] = {
    &brc_operator_measures,  &brc_operator_vibration, &brc_operator_drift,   &brc_operator_build,
    &brc_operator_isotropy,  &brc_operator_beams,     &brc_operator_hondros, &brc_operator_virial,
    &brc_operator_pressing,  &brc_operator_wave,      &brc_operator_field,   &brc_operator_told,
    &brc_operator_fragments, &brc_operator_bounce,    &brc_operator_sides,   NULL,
};
enum { N_OPERATORS = sizeof brc_operators / sizeof brc_operators[0] };

const brc_operator *brc_operator_of(const brc_case_reader *r, const brc_node *node)
{
    const char *names[N_OPERATORS] = {NULL};
    for (int k = 0; brc_operators[k]; ++k)
        names[k] = brc_operators[k]->name;
    return brc_operators[brc_case_word_of(r, node, names)];
}
