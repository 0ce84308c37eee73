/* How large a domain will be before it is built. */
#ifndef BRC_PREPROCESS_ESTIMATE_H
#define BRC_PREPROCESS_ESTIMATE_H

#include "../shapes/solid.h"

/* Bytes of the finished domain of n elements, by the sizes of domain.h; within about a tenth. */
double brc_estimate_bytes(const brc_solid *solid, const brc_build_request *request, double n);
/* Elements a fill leads to before any is placed (points: those wanted, 0 when the file decides). */
double brc_estimate_elements(const brc_solid *solid, const brc_fill *fill);
/* BRC_BAD_INPUT when building n elements of so many bytes needs more memory than the machine has. */
brc_status brc_estimate_check_memory(brc_context *context, double n, double bytes);

#endif
