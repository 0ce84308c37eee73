/* One domain for the ranks (host/base/ranks.h) of a machine. */
#ifndef BRC_PREPROCESS_DOMAIN_RANKS_H
#define BRC_PREPROCESS_DOMAIN_RANKS_H

#include "domain.h"

/* All ranks. *domain of the first rank of each machine becomes that of its others too, NULL there before: its arrays
 * are in memory once, and at no time twice, those of a domain file as its pages; a rank that writes to them writes to
 * pages of its own. *done: false where ranks cannot see one another's memory or the file; *domain of others than the
 * first is then as it was. Free it as any other.
 * After a failure, BRC_NO_MEMORY, its arrays hold nothing. */
brc_status brc_domain_share(brc_context *context, brc_domain **domain, bool *done);

#endif
