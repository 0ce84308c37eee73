/* A domain that ranks (host/base/ranks.h) have between them: the corners and shared faces of a cell, its centroid and
 * inertia, 1.4 of its 1.7 kB, are at home on the rank that computed them; all have the rest (domain.h, here). The
 * arrays are as long as of all, in pages that take no memory where there is nothing. */
#ifndef BRC_PREPROCESS_DOMAIN_ROWS_H
#define BRC_PREPROCESS_DOMAIN_ROWS_H

#include "domain.h"

/* Whether what all ranks count together is this one's to count at element e: each has some, where they are apart. */
bool brc_domain_mine(const brc_domain *domain, int64_t e);

/* All ranks, where domain->here is not NULL. This rank then has the faces of cells `wanted` [n_elements] too. */
brc_status brc_domain_bring(brc_context *context, const brc_domain *domain, const uint8_t *wanted);
/* Faces that are not of this rank's home are here no more. Not collective. */
void brc_domain_keep_home(const brc_domain *domain);
/* All ranks, likewise: the home of all cells is rank 0, which writes. Again: nothing. */
brc_status brc_domain_bring_to_first(brc_context *context, const brc_domain *domain);
/* All ranks, likewise, before either of these: every one then has all, in a domain that says so. */
brc_status brc_domain_bring_whole(brc_context *context, brc_domain *domain);

/* All ranks, likewise: the log says how much of the domain a machine has at most. */
brc_status brc_domain_tell(brc_context *context, brc_domain *domain);

/* All ranks, with the same n half-edges: their area vectors and centroids, out [n][6]. */
brc_status brc_domain_faces(brc_context *context, const brc_domain *domain, int64_t n, const int32_t *half_edge,
                            double *out);

/* All ranks, where domain->here is not NULL: value [n_elements][width] of elements that are another's to count
 * (brc_domain_mine) comes from there. */
brc_status brc_domain_elements(brc_context *context, const brc_domain *domain, int64_t width, double *value);
/* The same of value [n_bonds], whose bonds count with their smaller element. */
brc_status brc_domain_bonds(brc_context *context, const brc_domain *domain, double *value);

/* All ranks: cells of `from` move to their homes in `to`, where cell e is cell `at` + e; from->here NULL: each rank has
 * them and copies. Rows of both are there, and homes of `to`. */
brc_status brc_domain_settle(brc_context *context, const brc_domain *from, int64_t at, const brc_domain *to);

/* Where the arrays are of which a rank has a part. */
enum { BRC_DOMAIN_PARTS = 5 };
void brc_domain_parts(brc_domain *domain, void **out[BRC_DOMAIN_PARTS]);
/* Room for these in a domain whose other arrays are there; nothing is here. */
brc_status brc_domain_make_room(brc_context *context, brc_domain *domain);

#endif
