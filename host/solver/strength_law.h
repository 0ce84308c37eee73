/* From the strength of a solid to the limit of the virial stress of its elements (NAH19 eq. 21, 22):
 *     k = sigma_M / sigma_m = m0 + n0 cn + p0 cn^2 + r_m (m1 + n1 cn + p1 cn^2 + q1 cn^3) + r_m^2 (m2 + n2 cn + p2 cn^2)
 * for the stress over an element and its direct neighbours; cn: mean coordination number, r_m: beam radius over mean radius. */
#ifndef BRC_SOLVER_STRENGTH_LAW_H
#define BRC_SOLVER_STRENGTH_LAW_H

#include "../base/status.h"

typedef struct brc_strength_law {
    const char *name;
    double coordination[2], radius[2]; /* ranges of cn and r_m it was fitted in */
    double m0, n0, p0, m1, n1, p1, q1, m2, n2, p2;
} brc_strength_law;

/* As the paper prints it; static storage. */
const brc_strength_law *brc_strength_law_published(void);
/* k [-]. */
double brc_strength_law_ratio(const brc_strength_law *law, double coordination, double radius);
/* The same; BRC_BAD_INPUT with the cure where the law says nothing (a tenth beyond its ranges is let through). */
brc_status brc_strength_law_find(brc_context *context, const brc_strength_law *law, double coordination, double radius, double *ratio);

#endif
