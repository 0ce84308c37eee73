/* What a finished domain is worth, in numbers, and the limits a scene may set them. */
#ifndef BRC_PREPROCESS_QUALITY_H
#define BRC_PREPROCESS_QUALITY_H

#include "build.h"
#include "isotropy.h"
#include <stdio.h>

/* Fill the measured fields of domain->quality from the arrays: volume_cells, volume_error (volume_shape must be set),
 * smallest_distance, mean_spacing, closure_worst, support_smallest, volume_fraction, coordination_*,
 * n_elements_without_bond, n_pieces and the spreads. Counts of the builder are kept. The result does not depend on
 * n_threads (>= 1). */
void brc_quality_measure(brc_domain *domain, int n_threads);
/* All ranks, where they have the domain between them: its worst cases are those of all. */
brc_status brc_quality_agree(brc_context *context, brc_domain *domain);
/* A table a person reads, with the histogram of the number of bonds. */
void brc_quality_print(FILE *file, const brc_domain *domain);

/* A number that `quality:` may limit. */
typedef struct brc_quality_number {
    const char *name;
    const char *meaning; /* half a sentence, for the reference of the scene */
    const char *unit;
    bool less_is_worse; /* else more is */
    bool of_cells, of_spheres;
    bool of_directions; /* taken from the isotropy, which is measured only if a limit asks for it */
    const char *cure;
    double (*value)(const brc_domain *domain, const brc_isotropy *isotropy); /* isotropy: NULL unless of_directions */
} brc_quality_number;

/* All of them, static; *n receives how many. */
const brc_quality_number *brc_quality_numbers(int32_t *n);
/* Compare a measured domain with limits. Beyond `warn`: one warning in the log each. Beyond `refuse`: BRC_BAD_INPUT,
 * one sentence that lists all broken limits with value, limit and cure. BRC_BAD_INPUT too for unknown names (with the
 * known ones), limits that are not finite, and numbers that this kind of elements does not have. */
brc_status brc_quality_judge(brc_context *context, const brc_domain *domain, int32_t n_limits,
                             const brc_quality_limit *limits);

#endif
