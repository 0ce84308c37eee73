/* Coefficients: written by `breccia calibrate` as law.h (docs/notebook/beams-calibration.md has its command, the solves
 * behind it and what is left). */
#include "beam_law.h"
#include "chebyshev.h"
#include "../../base/log.h"
#include "spread-12.5.h"
#include "spread-25.h"
#include <math.h>

static const brc_beam_law *const LAWS[] = {&brc_beam_law_spread_12_5, &brc_beam_law_spread_25};
/* Nearer to the end of the fit than this share of its range (of nu) a small error of nu is a large one of r_m. */
static const double NEAR_END = 0.03;
/* Bonds inside may leave the fit by this share without a word: samples differ by as much. */
static const double FAR_OUT = 0.005;

const brc_beam_law *brc_beam_law_for(double radius_spread)
{
    const brc_beam_law *best = LAWS[0];
    for (size_t k = 1; k < sizeof LAWS / sizeof *LAWS; ++k)
        if (fabs(LAWS[k]->radius_spread - radius_spread) < fabs(best->radius_spread - radius_spread)) best = LAWS[k];
    return best;
}

static double cubic(const double c[4], double x)
{
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

void brc_beam_law_terms(const brc_beam_law *law, double coordination, double radius,
                        double out[BRC_BEAM_LAW_ROWS][BRC_BEAM_LAW_COLUMNS])
{
    const double logarithms[2] = {log(law->radius[0]), log(law->radius[1])};
    double of_radius[BRC_BEAM_LAW_ROWS], of_coordination[BRC_BEAM_LAW_COLUMNS];
    brc_chebyshev(brc_chebyshev_place(logarithms, log(radius)), BRC_BEAM_LAW_ROWS, of_radius);
    brc_chebyshev(brc_chebyshev_place(law->coordination, coordination), BRC_BEAM_LAW_COLUMNS, of_coordination);
    for (int i = 0; i < BRC_BEAM_LAW_ROWS; ++i)
        for (int j = 0; j < BRC_BEAM_LAW_COLUMNS; ++j)
            out[i][j] = of_radius[i] * of_coordination[j];
}

static double surface(const brc_beam_law *law, const double c[BRC_BEAM_LAW_ROWS][BRC_BEAM_LAW_COLUMNS],
                      double coordination, double radius)
{
    double terms[BRC_BEAM_LAW_ROWS][BRC_BEAM_LAW_COLUMNS], sum = 0;
    brc_beam_law_terms(law, coordination, radius, terms);
    for (int i = 0; i < BRC_BEAM_LAW_ROWS; ++i)
        for (int j = 0; j < BRC_BEAM_LAW_COLUMNS; ++j)
            sum += c[i][j] * terms[i][j];
    return sum;
}

double brc_beam_law_poisson(const brc_beam_law *law, double coordination, double radius)
{
    return surface(law, law->poisson, coordination, radius);
}

double brc_beam_law_young(const brc_beam_law *law, double coordination, double radius)
{
    return exp(surface(law, law->young, coordination, radius));
}

double brc_beam_law_paper_poisson(const double c[4][4], double coordination, double radius)
{
    double k[4];
    for (int i = 0; i < 4; ++i)
        k[i] = c[i][0] + c[i][1] * tanh(c[i][2] * (coordination - 7) + c[i][3]);
    return cubic(k, radius);
}

double brc_beam_law_paper_young(const double c[4][4], double coordination, double radius)
{
    double k[4];
    for (int i = 0; i < 4; ++i)
        k[i] = cubic(c[i], coordination);
    return cubic(k, radius);
}

double brc_beam_law_inner(const brc_beam_law *law, double coordination)
{
    double terms[BRC_BEAM_LAW_INNER], sum = 0;
    brc_chebyshev(brc_chebyshev_place(law->coordination, coordination), BRC_BEAM_LAW_INNER, terms);
    for (int j = 0; j < BRC_BEAM_LAW_INNER; ++j)
        sum += law->inner[j] * terms[j];
    return sum;
}

double brc_beam_law_coordination(const brc_beam_law *law, const brc_beam_body *body)
{
    double low = law->coordination[0], high = law->coordination[1];
    if (!(body->inner > 0 && law->inner[0] > 0)) return body->coordination;
    for (int i = 0; i < 60; ++i) { /* bonds inside grow with bonds in all */
        const double middle = 0.5 * (low + high);
        if (middle * brc_beam_law_inner(law, middle) < body->inner)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

double brc_beam_law_reading(const brc_beam_body *body)
{
    static const double edges[3] = {20.37, 20.37, 20.37}; /* of a cube of 10 000 spheres, as packed for the fits */
    return body->reading > 0 ? body->reading / brc_beam_body_reading(edges) : 1;
}

brc_status brc_beam_law_invert(brc_context *context, const brc_beam_law *law, const brc_beam_body *body, double nu,
                               double young, double *radius, double *beam_young, bool *warning)
{
    if (!(body->coordination >= law->coordination[0] - 0.1 && body->coordination <= law->coordination[1] + 0.1))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "model cbm: the coordination number %.4g lies outside the calibrated laws (%.4g to %.4g); "
                        "choose another one under "
                        "`beams`, or give the material's `beam` parameters",
                        body->coordination, law->coordination[0], law->coordination[1]);
    const double coordination = brc_beam_law_coordination(law, body);
    if (body->inner > 0 && law->inner[0] > 0 &&
        fabs(coordination * brc_beam_law_inner(law, coordination) / body->inner - 1) > FAR_OUT)
        brc_log(context, BRC_LOG_WARNING,
                "model cbm: a body of its size and shape with %.4g bonds an element has %.4g inside, beyond the "
                "calibrated laws (%.4g to %.4g): they are taken as there",
                body->coordination, body->inner, law->coordination[0] * brc_beam_law_inner(law, law->coordination[0]),
                law->coordination[1] * brc_beam_law_inner(law, law->coordination[1]));
    double low = law->radius[0], high = law->radius[1]; /* nu falls with r_m */
    const double most = brc_beam_law_poisson(law, coordination, low),
                 least = brc_beam_law_poisson(law, coordination, high);
    if (!(nu <= most && nu >= least))
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "model cbm: beams cannot give nu = %.4g at the coordination number %.4g, only %.3f to %.3f; choose another "
            "coordination number, or give the material's `beam` parameters",
            nu, body->coordination, least, most);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        if (brc_beam_law_poisson(law, coordination, middle) > nu)
            low = middle;
        else
            high = middle;
    }
    *radius = 0.5 * (low + high);
    *beam_young = young / (brc_beam_law_young(law, coordination, *radius) * brc_beam_law_reading(body));
    if (warning) *warning = most - nu < NEAR_END * (most - least) || nu - least < NEAR_END * (most - least);
    return BRC_OK;
}
