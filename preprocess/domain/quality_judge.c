/* Limits of a scene against the numbers of a domain. */
#include "quality.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Level of the icosphere for the numbers of directions: 162 bins. */
#define ISOTROPY_LEVEL 2

enum { SENTENCE = 512 };

static brc_status find_number(brc_context *context, const brc_domain *domain, const brc_quality_limit *limit,
                              const brc_quality_number **out)
{
    const bool spheres = domain->element_kind == BRC_ELEMENT_SPHERE;
    char known[SENTENCE] = "";
    int32_t n;
    const brc_quality_number *numbers = brc_quality_numbers(&n);
    for (int32_t k = 0; k < n; ++k) {
        const bool has = spheres ? numbers[k].of_spheres : numbers[k].of_cells;
        if (strncmp(numbers[k].name, limit->number, sizeof limit->number) == 0) {
            if (!has)
                return BRC_FAIL(context, BRC_BAD_INPUT,
                                "quality: '%s' is a number of cells, this body is made of %s; remove it",
                                numbers[k].name, spheres ? "spheres" : "cells");
            if ((limit->has_warn && !isfinite(limit->warn)) || (limit->has_refuse && !isfinite(limit->refuse)))
                return BRC_FAIL(context, BRC_BAD_INPUT, "quality: the limits of '%s' must be finite", numbers[k].name);
            *out = &numbers[k];
            return BRC_OK;
        }
        if (!has) continue;
        if (known[0]) strcat(known, ", ");
        strcat(known, numbers[k].name);
    }
    return BRC_FAIL(context, BRC_BAD_INPUT, "quality: there is no number '%.*s'; there are %s",
                    (int)sizeof limit->number, limit->number, known);
}

/* A value that is not a number is beyond every limit. */
static bool beyond(const brc_quality_number *number, double value, double limit)
{
    return number->less_is_worse ? !(value >= limit) : !(value <= limit);
}

static void describe(const brc_quality_number *number, double value, double limit, char sentence[SENTENCE])
{
    snprintf(sentence, SENTENCE, "%s is %.4g, must be at %s %.4g (%s): %s", number->name, value,
             number->less_is_worse ? "least" : "most", limit, number->meaning, number->cure);
}

brc_status brc_quality_judge(brc_context *context, const brc_domain *domain, int32_t n_limits,
                             const brc_quality_limit *limits)
{
    brc_isotropy isotropy = {0};
    const brc_quality_number *number = NULL;
    char *broken = NULL, sentence[SENTENCE];
    size_t length = 0;
    brc_status status = BRC_OK;
    bool measured = false;
    BRC_TRY(BRC_ALLOCATE(context, &broken, (int64_t)n_limits * (SENTENCE + 2) + 1, "broken limits"));
    for (int32_t k = 0; k < n_limits; ++k) {
        const brc_quality_limit *limit = &limits[k];
        BRC_TRY_OR(cleanup, find_number(context, domain, limit, &number));
        if (number->of_directions && !measured) {
            BRC_TRY_OR(cleanup, brc_isotropy_measure(context, domain, ISOTROPY_LEVEL, BRC_ISOTROPY_BONDS,
                                                     omp_get_max_threads(), &isotropy));
            measured = true;
        }
        const double value = number->value(domain, number->of_directions ? &isotropy : NULL);
        if (limit->has_refuse && beyond(number, value, limit->refuse)) {
            describe(number, value, limit->refuse, sentence);
            length += (size_t)sprintf(broken + length, "%s%s", length > 0 ? "; " : "", sentence);
        } else if (limit->has_warn && beyond(number, value, limit->warn)) {
            describe(number, value, limit->warn, sentence);
            brc_log(context, BRC_LOG_WARNING, "quality: %s", sentence);
        }
    }
    if (length > 0) status = BRC_FAIL(context, BRC_BAD_INPUT, "quality of the body: %s", broken);
cleanup:
    brc_isotropy_free(&isotropy);
    brc_memory_free(broken);
    return status;
}
