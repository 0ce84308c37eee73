/* Features of a shape that are smaller than its cells, and so vanish or nearly do. */
#ifndef BRC_PREPROCESS_FEATURES_H
#define BRC_PREPROCESS_FEATURES_H

#include "../domain/domain.h"
#include "solid.h"

/* Warn of parts that are added or removed and thinner than a cell of size `spacing` [m] although the solid ends at
 * them, and of walls on which no cell has a face although the solid ends there; each by its name, its size and the
 * cells it takes. Spheres: of parts only. */
void brc_features_warn(brc_context *context, const brc_solid *solid, double spacing, const brc_domain *domain);

#endif
