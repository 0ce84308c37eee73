#include "strength_law.h"

static const brc_strength_law PUBLISHED = {.name = "NAH19 eq. 22",
                                           .coordination = {6, 13},
                                           .radius = {0.2, 1},
                                           .m0 = -0.56467,
                                           .n0 = 0.20824,
                                           .p0 = -0.00760,
                                           .m1 = 0.67697,
                                           .n1 = 0.09328,
                                           .p1 = -0.02298,
                                           .q1 = 0.00095,
                                           .m2 = -0.73898,
                                           .n2 = 0.08438,
                                           .p2 = -0.00240};

const brc_strength_law *brc_strength_law_published(void) { return &PUBLISHED; }

double brc_strength_law_ratio(const brc_strength_law *law, double coordination, double radius)
{
    const double c = coordination;
    const double constant = law->m0 + c * (law->n0 + c * law->p0), linear = law->m1 + c * (law->n1 + c * (law->p1 + c * law->q1));
    return constant + radius * (linear + radius * (law->m2 + c * (law->n2 + c * law->p2)));
}

static bool within(const double range[2], double value) { return value >= 0.9 * range[0] && value <= 1.1 * range[1]; }

brc_status brc_strength_law_find(brc_context *context, const brc_strength_law *law, double coordination, double radius, double *ratio)
{
    if (!within(law->coordination, coordination) || !within(law->radius, radius))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fracture: the law for strength (%s) holds for coordination numbers %.4g to %.4g and r_m %.4g to %.4g, the sample has "
                        "%.4g and %.4g; choose others, or give the material's `beam: {strength: ...}`",
                        law->name, law->coordination[0], law->coordination[1], law->radius[0], law->radius[1], coordination, radius);
    *ratio = brc_strength_law_ratio(law, coordination, radius);
    return BRC_OK;
}
