/* How even the bonds of a domain are, as files and as lines for a person. */
#ifndef BRC_OUTPUT_ISOTROPY_REPORT_H
#define BRC_OUTPUT_ISOTROPY_REPORT_H

#include "../../../preprocess/domain/domain.h"

/* Measure the bonds, every one once, in the bins of this level (0..6; 3 has 642), print the numbers to stdout, and
 * write into `dir` (made where it is not there): isotropy.csv, one row a bin; isotropy.vtp, the surface; isotropy.png,
 * its picture. Of cells the numbers with bonds weighted by face area are printed too. Refused as brc_isotropy_measure;
 * BRC_FILE_FAILED. */
brc_status brc_isotropy_report(brc_context *context, const brc_domain *domain, int level, const char *dir);

#endif
