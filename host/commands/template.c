/* The list of the scenes to begin with. */
#include "template.h"
#include "../base/memory.h"
#include "../scene/problem.h"
#include <string.h>

const brc_template *brc_template_find(brc_context *context, const char *name)
{
    enum { ROOM = 64 };
    const char *names[ROOM];
    int n = 0;
    for (int k = 0; k < brc_template_count && n < ROOM; ++k) {
        if (strcmp(brc_templates[k].name, name) == 0) return &brc_templates[k];
        names[n++] = brc_templates[k].name;
    }
    const char *nearest = brc_nearest_word(name, n, names);
    BRC_FAIL(context, BRC_BAD_INPUT, "breccia new: no scene '%s'%s%s%s; `breccia new` lists them", name,
             nearest ? ", did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    return NULL;
}

bool brc_template_is_study(const brc_template *template)
{
    return strstr(template->text, "\nscene:") != NULL;
}
