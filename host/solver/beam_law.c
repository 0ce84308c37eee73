/* Coefficients: fitted to 320 static solves each on packings of 10 000 spheres, 16 coordination numbers 5.5 to 13, r_m 0.2 to 1, four samples
 * (two-stage fit as in the paper; docs/beams.md has residuals). */
#include "beam_law.h"
#include <math.h>

static const brc_beam_law LAWS[] = {
    {.name = "radii +-12.5 %",
     .radius_spread = 0.125,
     .coordination = {5.5, 13},
     .radius = {0.2, 1},
     .poisson = {{0.4123082904, -0.1670671733, 0.3891434537, 0.1172463751},
                 {-0.3638354805, 0.3661570390, 0.4899574559, -0.07041376956},
                 {0.08053735917, -0.3100671939, 0.6611885209, -0.1241566280},
                 {-0.03397431045, 0.09309057254, 0.8283187437, -0.1701658818}},
     .young = {{-0.02203814179, 0.01514469843, -0.002276802731, 8.17518154e-05},
               {0.2009107690, -0.1516945971, 0.02351891689, -0.0008640460484},
               {-0.3038006756, 0.2440149384, -0.03293348114, 0.001279746043},
               {0.1055130055, -0.01411948197, 0.02024485172, -0.0007883146453}}},
    {.name = "radii +-25 %",
     .radius_spread = 0.25,
     .coordination = {5.5, 13},
     .radius = {0.2, 1},
     .poisson = {{0.3971928029, -0.1516461165, 0.397460826, 0.03967405471},
                 {-0.3419140611, 0.3432836641, 0.4916395811, -0.1255534994},
                 {0.07980692597, -0.297153237, 0.6482078648, -0.1595040997},
                 {-0.03551166437, 0.09018575965, 0.7958005983, -0.2066845003}},
     .young = {{-0.02587281606, 0.01588932499, -0.00232523684, 8.348660226e-05},
               {0.2342206394, -0.1572848145, 0.02375227559, -0.0008711267605},
               {-0.3295586004, 0.2422791506, -0.03197940952, 0.001241533788},
               {0.09869014377, -0.00958447018, 0.01870028226, -0.0007336405671}}},
};
/* The cubics are trusted a little beyond the fit: alumina at cn 13 needs r_m 0.188. */
static const double LEAST_RADIUS = 0.15;

const brc_beam_law *brc_beam_law_for(double radius_spread)
{
    const brc_beam_law *best = LAWS;
    for (size_t k = 1; k < sizeof LAWS / sizeof *LAWS; ++k)
        if (fabs(LAWS[k].radius_spread - radius_spread) < fabs(best->radius_spread - radius_spread)) best = &LAWS[k];
    return best;
}

static double cubic(double a, double b, double c, double d, double x) { return a + x * (b + x * (c + x * d)); }

double brc_beam_law_poisson(const brc_beam_law *law, double coordination, double radius)
{
    double k[4];
    for (int i = 0; i < 4; ++i) k[i] = law->poisson[i][0] + law->poisson[i][1] * tanh(law->poisson[i][2] * (coordination - 7) + law->poisson[i][3]);
    return cubic(k[0], k[1], k[2], k[3], radius);
}

double brc_beam_law_young(const brc_beam_law *law, double coordination, double radius)
{
    double k[4];
    for (int i = 0; i < 4; ++i) k[i] = cubic(law->young[i][0], law->young[i][1], law->young[i][2], law->young[i][3], coordination);
    return cubic(k[0], k[1], k[2], k[3], radius);
}

brc_status brc_beam_law_invert(brc_context *context, const brc_beam_law *law, double coordination, double nu, double young, double *radius,
                               double *beam_young, bool *warning)
{
    if (!(coordination >= law->coordination[0] - 0.1 && coordination <= law->coordination[1] + 0.1))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "model cbm: the coordination number %.4g lies outside the calibrated laws (%.4g to %.4g); choose another one under "
                        "`beams`, or give the material's `beam` parameters",
                        coordination, law->coordination[0], law->coordination[1]);
    double low = LEAST_RADIUS, high = law->radius[1]; /* nu falls with r_m */
    const double most = brc_beam_law_poisson(law, coordination, low), least = brc_beam_law_poisson(law, coordination, high);
    if (!(nu <= most && nu >= least))
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "model cbm: beams cannot give nu = %.4g at the coordination number %.4g, only %.3f to %.3f; choose another "
                        "coordination number, or give the material's `beam` parameters",
                        nu, coordination, least, most);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        if (brc_beam_law_poisson(law, coordination, middle) > nu) low = middle;
        else high = middle;
    }
    *radius = 0.5 * (low + high);
    *beam_young = young / brc_beam_law_young(law, coordination, *radius);
    if (warning) *warning = *radius < law->radius[0];
    return BRC_OK;
}
