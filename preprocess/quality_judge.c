/* The numbers that a scene may limit, as one table, and the judgement. */
#include "quality.h"

#include "../host/base/log.h"
#include "../host/base/memory.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Level of the icosphere for the numbers of directions: 162 bins. */
#define ISOTROPY_LEVEL 2

#define VALUE(name, expression)                                                                                        \
    static double name(const brc_domain *domain, const brc_isotropy *isotropy)                                         \
    {                                                                                                                  \
        (void)domain;                                                                                                  \
        (void)isotropy;                                                                                                \
        return (expression);                                                                                           \
    }
VALUE(volume_error, fabs(domain->quality.volume_error))
VALUE(duplicates, (double)domain->quality.n_seeds_duplicate)
VALUE(lost, (double)domain->quality.n_seeds_lost)
VALUE(tiny_faces, (double)domain->quality.n_tiny_faces_dropped)
VALUE(tiny_face_area, domain->quality.tiny_face_area_fraction)
VALUE(closure, domain->quality.closure_worst)
VALUE(twin_area, domain->quality.twin_area_worst)
VALUE(smallest_distance, domain->quality.smallest_distance / domain->quality.mean_spacing)
VALUE(support, domain->quality.support_smallest)
VALUE(pieces, domain->quality.n_pieces < 0 ? NAN : (double)domain->quality.n_pieces)
VALUE(unbonded, (double)domain->quality.n_elements_without_bond)
VALUE(anisotropy_fabric, isotropy->fabric_anisotropy)
VALUE(anisotropy_worst_bin, isotropy->worst_bin)
VALUE(anisotropy_rms, isotropy->rms_bin)
VALUE(anisotropy_excess, isotropy->excess)
VALUE(anisotropy_cubic, fabs(isotropy->cubic))

static double coordination_least(const brc_domain *domain, const brc_isotropy *isotropy)
{
    (void)isotropy;
    int k = 0;
    while (k < 63 && domain->quality.coordination_histogram[k] == 0) ++k;
    return k;
}

#define RELAX "use a few `lloyd` sweeps, or another seed"
#define MORE_BONDS "use another seed or, with `beams`, a larger coordination"
#define DIRECTIONS "use a spread of 90 % or a packing, and more elements: few bonds are uneven by chance"
static const brc_quality_number numbers[] = {
    /* name, meaning, unit, less is worse, of cells, of spheres, of directions, cure, value */
    {"volume_error", "volume of all cells against the shape's: the size of the relative difference", "-", false, true, false, false,
     "use more elements", volume_error},
    {"duplicates", "seeds dropped because they were too near to an earlier one", "", false, true, true, false,
     "use a smaller `min_distance`, another seed, or points without doubles", duplicates},
    {"lost", "seeds that got no cell", "", false, true, false, false, "use another seed", lost},
    {"tiny_faces", "faces below `tiny_face_threshold`, which were dropped", "", false, true, false, false, RELAX, tiny_faces},
    {"tiny_face_area", "area of the dropped faces over the area of all", "-", false, true, false, false, RELAX, tiny_face_area},
    {"closure", "worst cell: size of the sum of its area vectors over its surface", "-", false, true, false, false, RELAX, closure},
    {"twin_area", "worst difference of a face's area seen from its two sides, over the mean area", "-", false, true, false, false,
     RELAX, twin_area},
    {"smallest_distance", "shortest branch over the mean spacing", "-", true, true, true, false,
     "use a few `lloyd` sweeps or a larger `min_distance`", smallest_distance},
    {"support", "worst cell: smallest eigenvalue of its least-squares matrix A/(2V); 0.5 for the corner of a grid of cubes", "-", true, true,
     false, false, RELAX ", or a smaller spread", support},
    {"coordination_least", "least number of bonds of an element", "", true, true, true, false, MORE_BONDS, coordination_least},
    {"pieces", "parts of the body that no bond joins to each other", "", false, true, true, false,
     MORE_BONDS ", or shorten cracks that cut through", pieces},
    {"unbonded", "elements without any bond", "", false, true, true, false, MORE_BONDS, unbonded},
    {"anisotropy_fabric", "anisotropy of the fabric tensor of bond directions", "-", false, true, true, true, DIRECTIONS, anisotropy_fabric},
    {"anisotropy_worst_bin", "largest relative deviation of a bin of bond directions (162 bins) from the mean", "-", false, true, true, true,
     DIRECTIONS, anisotropy_worst_bin},
    {"anisotropy_rms", "root mean square of the relative deviations of the bins of bond directions (162 bins)", "-", false, true, true, true,
     DIRECTIONS, anisotropy_rms},
    {"anisotropy_excess", "the part of anisotropy_rms that the number of bonds does not explain", "-", false, true, true, true, DIRECTIONS,
     anisotropy_excess},
    {"anisotropy_cubic", "order that a grid leaves in the bond directions, which the fabric tensor cannot see", "-", false, true, true, true,
     DIRECTIONS, anisotropy_cubic},
};
enum { N_NUMBERS = (int)(sizeof numbers / sizeof *numbers), SENTENCE = 512 };

const brc_quality_number *brc_quality_numbers(int32_t *n)
{
    *n = N_NUMBERS;
    return numbers;
}

static brc_status find_number(brc_context *context, const brc_domain *domain, const brc_quality_limit *limit, const brc_quality_number **out)
{
    const bool spheres = domain->element_kind == BRC_ELEMENT_SPHERE;
    char known[SENTENCE] = "";
    for (int k = 0; k < N_NUMBERS; ++k) {
        const bool has = spheres ? numbers[k].of_spheres : numbers[k].of_cells;
        if (strncmp(numbers[k].name, limit->number, sizeof limit->number) == 0) {
            if (!has)
                return BRC_FAIL(context, BRC_BAD_INPUT, "quality: '%s' is a number of cells, this body is made of %s; remove it",
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
    return BRC_FAIL(context, BRC_BAD_INPUT, "quality: there is no number '%.*s'; there are %s", (int)sizeof limit->number, limit->number,
                    known);
}

/* A value that is not a number is beyond every limit. */
static bool beyond(const brc_quality_number *number, double value, double limit)
{
    return number->less_is_worse ? !(value >= limit) : !(value <= limit);
}

static void describe(const brc_quality_number *number, double value, double limit, char sentence[SENTENCE])
{
    snprintf(sentence, SENTENCE, "%s is %.4g, must be at %s %.4g (%s): %s", number->name, value, number->less_is_worse ? "least" : "most",
             limit, number->meaning, number->cure);
}

brc_status brc_quality_judge(brc_context *context, const brc_domain *domain, int32_t n_limits, const brc_quality_limit *limits)
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
            BRC_TRY_OR(cleanup, brc_isotropy_measure(context, domain, ISOTROPY_LEVEL, BRC_ISOTROPY_BONDS, omp_get_max_threads(), &isotropy));
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
