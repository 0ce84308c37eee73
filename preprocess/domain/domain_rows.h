/* A domain that ranks (host/base/ranks.h) have between them: each has the shared faces of its own cells and of those
 * beside them, and until they are written the corners of those that it has computed, 1.4 of the 1.7 kB a cell; positions,
 * volumes, bonds and free faces have all (domain.h, here). The arrays are as long as of all, in pages that take no memory
 * where there is nothing. */
#ifndef BRC_PREPROCESS_DOMAIN_ROWS_H
#define BRC_PREPROCESS_DOMAIN_ROWS_H

#include "domain.h"

/* Whether what all ranks count together is this one's to count at element e: each has some, where they are apart. */
bool brc_domain_mine(const brc_domain *domain, int64_t e);

/* All ranks, where domain->here is not NULL. This rank then has the faces of cells `wanted` [n_elements], which come from
 * those that have them, and of no others. holder [n_elements]: a rank that wants those of the cell; NULL: holders want
 * what they have. */
brc_status brc_domain_bring(brc_context *context, const brc_domain *domain, const uint8_t *wanted,
                            const int32_t *holder);
/* All ranks, likewise: rank 0, which writes, then has the faces and corners of all cells, the others no corners. Again:
 * nothing. */
brc_status brc_domain_bring_to_first(brc_context *context, const brc_domain *domain);
/* All ranks, likewise, before either of these: every one then has all, in a domain that says so. */
brc_status brc_domain_bring_whole(brc_context *context, brc_domain *domain);

/* All ranks, with the same n half-edges: their area vectors and centroids, out [n][6]. */
brc_status brc_domain_faces(brc_context *context, const brc_domain *domain, int64_t n, const int32_t *half_edge,
                            double *out);

/* All ranks, where domain->here is not NULL: value [n_bonds] of bonds whose smaller element is another's to count
 * (brc_domain_mine) comes from there. */
brc_status brc_domain_bonds(brc_context *context, const brc_domain *domain, double *value);

/* Room for the corners and shared faces of a domain whose other arrays are there, none of which is here. */
brc_status brc_domain_make_room(brc_context *context, brc_domain *domain);

#endif
