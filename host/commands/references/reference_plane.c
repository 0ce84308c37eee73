/* Discs and rings. */
#include "reference_plane.h"
#include "reference_gauss.h"
#include <lapacke.h>
#include <math.h>

enum { ARC_POINTS = 64 };

/* A load of 1 a thickness pushes inward at the rim's point q: Flamant's -2/pi (d.s) s (x) s / |s|^4, d the direction of
 * the push, s from q. */
static void add_flamant(const double q[2], double x, double y, double weight, double stress[3])
{
    const double s[2] = {x - q[0], y - q[1]}, square = s[0] * s[0] + s[1] * s[1];
    const double factor = weight * 2 / M_PI * (q[0] * s[0] + q[1] * s[1]) / (square * square);
    stress[0] += factor * s[0] * s[0];
    stress[1] += factor * s[1] * s[1];
    stress[2] += factor * s[0] * s[1];
}

void brc_reference_disc(double half_angle, double x, double y, double stress[3])
{
    double at[ARC_POINTS], weight[ARC_POINTS];
    brc_reference_gauss(ARC_POINTS, at, weight);
    stress[0] = stress[1] = stress[2] = 0;
    for (int k = 0; k < ARC_POINTS; ++k) {
        const double angle = half_angle * (2 * at[k] - 1), load = 2 * half_angle * weight[k]; /* of a pressure of 1 */
        const double q[2] = {sin(angle), cos(angle)}, opposite[2] = {-q[0], -q[1]};
        add_flamant(q, x, y, load, stress);
        add_flamant(opposite, x, y, load, stress);
        stress[0] += load / M_PI;
        stress[1] += load / M_PI;
    }
    const double nominal = 2 * sin(half_angle) / M_PI; /* resultant 2 p R sin(half_angle), over pi R */
    for (int c = 0; c < 3; ++c)
        stress[c] /= nominal;
}

brc_status brc_reference_ring_solve(brc_context *context, double inner, double outer, double young, double poisson,
                                    double e_xx, double e_yy, brc_reference_ring *out)
{
    if (!(inner > 0 && outer > inner))
        return BRC_FAIL(context, BRC_BAD_INPUT, "ring from %g to %g m, expected 0 < inner < outer", inner, outer);
    const double mu = young / (2 * (1 + poisson)), lambda = 2 * mu * poisson / (1 - 2 * poisson),
                 kappa = 3 - 4 * poisson;
    const double mean = (e_xx + e_yy) / 2, apart = (e_xx - e_yy) / 2, b = outer / inner;
    *out = (brc_reference_ring){.inner = inner, .outer = outer, .lambda = lambda, .mu = mu};
    out->even = mean / (1 + (lambda + mu) / (mu * b * b));
    out->even_inner = out->even * inner * inner * (lambda + mu) / mu;
    /* Radial and shear stress at a are 0; 2 mu u_r and 2 mu u_theta at b are those of the affine field; lengths in
     * units of a. */
    double matrix[4][4] = {{-2, 0, -6, -4},
                           {1, 3, -3, -1},
                           {-2 * b, -(3 - kappa) * b * b * b, 2 / (b * b * b), (kappa + 1) / b},
                           {2 * b, (3 + kappa) * b * b * b, 2 / (b * b * b), -(kappa - 1) / b}};
    double right[4] = {0, 0, 2 * mu * apart * b, -2 * mu * apart * b};
    lapack_int pivots[4];
    const lapack_int info = LAPACKE_dgesv(LAPACK_ROW_MAJOR, 4, 1, &matrix[0][0], 4, pivots, right, 1);
    if (info != 0) return BRC_FAIL(context, BRC_INTERNAL, "ring: dgesv gave %d", (int)info);
    for (int k = 0; k < 4; ++k)
        out->c[k] = right[k];
    return BRC_OK;
}

void brc_reference_ring_at(const brc_reference_ring *ring, double x, double y, double stress[3], double displacement[2])
{
    const double r = sqrt(x * x + y * y), s = r / ring->inner, cosine = x / r, sine = y / r;
    const double cos2 = cosine * cosine - sine * sine, sin2 = 2 * cosine * sine, *c = ring->c;
    const double kappa = (ring->lambda + 3 * ring->mu) / (ring->lambda + ring->mu);
    const double even = 2 * (ring->lambda + ring->mu) * ring->even, odd = 2 * ring->mu * ring->even_inner / (r * r);
    const double radial = even - odd + (-2 * c[0] - 6 * c[2] / pow(s, 4) - 4 * c[3] / (s * s)) * cos2;
    const double hoop = even + odd + (2 * c[0] + 12 * c[1] * s * s + 6 * c[2] / pow(s, 4)) * cos2;
    const double shear = 2 * (c[0] + 3 * c[1] * s * s - 3 * c[2] / pow(s, 4) - c[3] / (s * s)) * sin2;
    stress[0] = radial * cosine * cosine + hoop * sine * sine - 2 * shear * sine * cosine;
    stress[1] = radial * sine * sine + hoop * cosine * cosine + 2 * shear * sine * cosine;
    stress[2] = (radial - hoop) * sine * cosine + shear * (cosine * cosine - sine * sine);
    if (!displacement) return;
    const double scale = ring->inner / (2 * ring->mu);
    const double out =
        ring->even * r + ring->even_inner / r +
        scale * (-2 * c[0] * s - (3 - kappa) * c[1] * pow(s, 3) + 2 * c[2] / pow(s, 3) + (kappa + 1) * c[3] / s) * cos2;
    const double around =
        scale * (2 * c[0] * s + (3 + kappa) * c[1] * pow(s, 3) + 2 * c[2] / pow(s, 3) - (kappa - 1) * c[3] / s) * sin2;
    displacement[0] = out * cosine - around * sine;
    displacement[1] = out * sine + around * cosine;
}
