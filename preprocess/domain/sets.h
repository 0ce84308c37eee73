/* Named sets: which free faces or elements a predicate picks. */
#ifndef BRC_PREPROCESS_SETS_H
#define BRC_PREPROCESS_SETS_H

#include "build.h"

#define BRC_SET_SLACK 1e-9 /* of the mean spacing: faces on the rim of a region belong to it whatever the rounding */

/* Refuse predicates that name an unknown wall, use a zero direction or negative radius, ask elements for a normal, or
 * spheres for faces. `what` names the set or region in the sentence. */
brc_status brc_predicate_check(brc_context *context, const brc_predicate *where, brc_set_kind kind,
                               const brc_domain *domain, const char *what);
/* Does element e or free face f fit? Comparisons are inclusive to 1e-9 of the mean spacing. */
bool brc_predicate_holds(const brc_predicate *where, brc_set_kind kind, const brc_domain *domain, int64_t index);
/* Fill domain->sets: one set per wall (cells: its free faces; spheres: those that touch it, and all "<wall>_layer"
 * sets, which brc_beams_build made and which are kept), then the requests in order, then the sets the domain had before
 * whose names are not among those. BRC_BAD_INPUT for a set that stays empty, a name used twice or empty, and bad
 * predicates. The arrays of the domain are complete but for the sets. */
brc_status brc_sets_build(brc_context *context, int32_t n, const brc_set_request *requests, brc_domain *domain);
/* Name of the set of spheres next to a wall. */
#define BRC_LAYER_NAME 64
void brc_sets_layer_name(const char *wall, char out[BRC_LAYER_NAME]);
/* Add a set without members, for a body that a region only reaches with faces it cuts (set_share.h), while others have
 * its members. Errors as of brc_sets_append. */
brc_status brc_sets_add_empty(brc_context *context, brc_domain *domain, const char *name, brc_set_kind kind);
/* Append an empty set of `n_members` members to domain->sets, which has room; *out is borrowed. */
brc_status brc_sets_append(brc_context *context, brc_domain *domain, const char *name, brc_set_kind kind,
                           int64_t n_members, brc_set **out);

#endif
