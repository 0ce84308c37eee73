/* Coefficients of the surface: written by `breccia calibrate` as strength/law.h (docs/notebook/beams-calibration.md has
 * its command and the tests behind it). */
#include "strength_law.h"
#include "../../base/log.h"
#include "chebyshev.h"
#include "disc.h"
#include "strength.h"
#include <math.h>

static const brc_strength_law PUBLISHED = {
    .name = "NAH19 eq. 22",
    .coordination = {6, 13},
    .radius = {0.2, 1},
    .is_paper = true,
    .paper = {-0.56467, 0.20824, -0.00760, 0.67697, 0.09328, -0.02298, 0.00095, -0.73898, 0.08438, -0.00240}};

const brc_strength_law *brc_strength_law_default(void)
{
    return &brc_strength_law_fitted;
}

const brc_strength_law *brc_strength_law_published(void)
{
    return &PUBLISHED;
}

void brc_strength_law_paper_terms(double coordination, double radius, double out[BRC_STRENGTH_LAW_PAPER])
{
    static const int cubic[] = {3, 4, 3}; /* polynomials of cn that go with 1, r_m and r_m^2 */
    double of_radius = 1;
    for (int i = 0, at = 0; i < 3; ++i, of_radius *= radius) {
        double power = of_radius;
        for (int j = 0; j < cubic[i]; ++j, power *= coordination)
            out[at++] = power;
    }
}

void brc_strength_law_terms(const brc_strength_law *law, double coordination, double radius,
                            double out[BRC_STRENGTH_LAW_ROWS][BRC_STRENGTH_LAW_COLUMNS])
{
    const double logarithms[2] = {log(law->radius[0]), log(law->radius[1])};
    double of_radius[BRC_STRENGTH_LAW_ROWS], of_coordination[BRC_STRENGTH_LAW_COLUMNS];
    brc_chebyshev(brc_chebyshev_place(logarithms, log(radius)), BRC_STRENGTH_LAW_ROWS, of_radius);
    brc_chebyshev(brc_chebyshev_place(law->coordination, coordination), BRC_STRENGTH_LAW_COLUMNS, of_coordination);
    for (int i = 0; i < BRC_STRENGTH_LAW_ROWS; ++i)
        for (int j = 0; j < BRC_STRENGTH_LAW_COLUMNS; ++j)
            out[i][j] = of_radius[i] * of_coordination[j];
}

double brc_strength_law_ratio(const brc_strength_law *law, double coordination, double radius)
{
    double sum = 0;
    if (law->is_paper) {
        double terms[BRC_STRENGTH_LAW_PAPER];
        brc_strength_law_paper_terms(coordination, radius, terms);
        for (int k = 0; k < BRC_STRENGTH_LAW_PAPER; ++k)
            sum += law->paper[k] * terms[k];
        return sum;
    }
    double terms[BRC_STRENGTH_LAW_ROWS][BRC_STRENGTH_LAW_COLUMNS];
    brc_strength_law_terms(law, coordination, radius, terms);
    for (int i = 0; i < BRC_STRENGTH_LAW_ROWS; ++i)
        for (int j = 0; j < BRC_STRENGTH_LAW_COLUMNS; ++j)
            sum += law->surface[i][j] * terms[i][j];
    return sum;
}

static bool within(const double range[2], double value)
{
    return value >= 0.9 * range[0] && value <= 1.1 * range[1];
}

brc_status brc_strength_law_find(brc_context *context, const brc_strength_law *law, double coordination, double radius,
                                 double *ratio)
{
    if (!within(law->coordination, coordination) || !within(law->radius, radius))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fracture: the law for strength (%s) holds for coordination numbers %.4g to %.4g and r_m %.4g "
                        "to %.4g, the sample has "
                        "%.4g and %.4g; choose others, or give the material's `beam: {strength: ...}`",
                        law->name, law->coordination[0], law->coordination[1], law->radius[0], law->radius[1],
                        coordination, radius);
    *ratio = brc_strength_law_ratio(law, coordination, radius);
    return BRC_OK;
}

brc_status brc_strength_law_disc(brc_context *context, double coordination, double radius, double *ratio)
{
    const brc_disc_law *law = &brc_disc_law_fitted;
    const double x = coordination - 10;
    if (!within(law->coordination, coordination) || !within(law->radius, radius))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "fracture: what discs read (`measured_by`) is known for coordination numbers %.4g to %.4g and "
                        "r_m %.4g to %.4g, the sample has %.4g and %.4g; choose others, or "
                        "give the strength in tension",
                        law->coordination[0], law->coordination[1], law->radius[0], law->radius[1], coordination,
                        radius);
    const double place = fmin(fmax(coordination - law->coordination[0], 0), BRC_STRENGTH_LAW_DISC_BANDS - 1);
    const int low = (int)fmin(place, BRC_STRENGTH_LAW_DISC_BANDS - 2);
    double band[2];
    for (int side = 0; side < 2; ++side)
        band[side] = law->band[low][side] + (place - low) * (law->band[low + 1][side] - law->band[low][side]);
    const double known = fmin(fmax(radius, band[0]), band[1]);
    if (fabs(radius - known) > 0.02 * known) /* packings move r_m by less */
        brc_log(context, BRC_LOG_WARNING,
                "what discs read (`measured_by`) was measured at coordination number %.4g for r_m %.4g to %.4g (nu "
                "near 0.23 and 0.24), the sample has %.4g: taken as at %.4g",
                coordination, band[0], band[1], radius, known);
    *ratio = law->term[0] + x * (law->term[1] + x * (law->term[2] + x * law->term[3])) +
             known * (law->term[4] + x * law->term[5]);
    return BRC_OK;
}

double brc_strength_law_either(double disc)
{
    return fmin(fmax(sqrt(disc), 1 / 1.037), 1 / 0.963);
}
