/* Cells of tables. */
#include "study.h"
#include "../output/text.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void brc_study_add_cell(brc_text *text, const char *cell)
{
    if (!strpbrk(cell, ",\"\n")) {
        brc_text_add_bytes(text, cell, strlen(cell));
        return;
    }
    brc_text_add(text, "\"");
    for (const char *c = cell; *c; ++c) {
        if (*c == '"') brc_text_add(text, "\"");
        brc_text_add_bytes(text, *c == '\n' ? " " : c, 1);
    }
    brc_text_add(text, "\"");
}

const char *brc_study_measure(const brc_study_outcome *o, const char *name)
{
    for (int m = 0; m < o->n_measures; ++m)
        if (strcmp(o->name[m], name) == 0) return o->text[m];
    return "";
}

double brc_study_measured(const brc_study_outcome *o, const char *name)
{
    const char *text = brc_study_measure(o, name);
    return strcmp(o->status, "done") == 0 && text[0] ? strtod(text, NULL) : NAN;
}
