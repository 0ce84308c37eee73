/* What a finished domain is worth, in numbers. */
#ifndef BRC_PREPROCESS_QUALITY_H
#define BRC_PREPROCESS_QUALITY_H

#include "domain.h"
#include <stdio.h>

/* Fill the measured fields of domain->quality from the arrays: volume_cells, volume_error (volume_shape must be set),
 * smallest_distance, mean_spacing, closure_worst, support_smallest, coordination_*. Counts of the builder are kept. */
void brc_quality_measure(brc_domain *domain, int n_threads);
/* A table a person reads, with the histogram of the number of bonds. */
void brc_quality_print(FILE *file, const brc_quality *quality);

#endif
