/* The provenance of a domain: one line that says how it was made. */
#ifndef BRC_PREPROCESS_DESCRIBE_H
#define BRC_PREPROCESS_DESCRIBE_H

#include "../cells/seeds.h"

/* Fill domain->provenance. grid: of a noisy-grid fill. */
brc_status brc_describe(brc_context *context, const brc_build_request *request, const brc_grid *grid,
                        brc_domain *domain);

#endif
