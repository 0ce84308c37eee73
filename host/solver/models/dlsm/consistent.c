/* With D = (sum R (x) s) A^-1 a body turned by Q has H = (Q - I) D, and a bond's force is (Q - I) c,
 * c = w R - kappa (D_i + D_j) s / 2, kappa = k (1 + tau), w = kappa / q, all as rounded. The torque of all bonds
 * depends on the tensor sum R (x) c alone, and an element's half of it vanishes when, with P = sum R (x) s and N = sum
 * (w/kappa) R (x) R, P A^-1 P^T = N. Exactly that is solved here; without rounding it is the inverse of A = P = N. */
#include "consistent.h"
#include "../../core/sym3.h"
#include <math.h>

typedef long double wide; /* at least as good as double; 11 bits better on x86, 60 on most others */

/* A coefficient as the device holds it. */
static double held(const brc_simulation *s, double value)
{
    return brc_device_get_precision(s->device) == BRC_DOUBLE ? value : (double)(float)value;
}

/* X_j - X_i, unrounded. */
static void branch_of(const brc_domain *d, int64_t element, int64_t half_edge, wide branch[3])
{
    const int64_t j = d->neighbour[half_edge];
    for (int c = 0; c < 3; ++c)
        branch[c] = (wide)d->position[3 * j + c] - d->position[3 * element + c];
}

void brc_consistent_bond(const brc_simulation *s, int64_t element, int64_t half_edge, double area[3], double *ratio)
{
    wide exact[3];
    branch_of(s->domain, element, half_edge, exact);
    const double branch[3] = {(double)exact[0], (double)exact[1], (double)exact[2]};
    const double *surface = s->domain->area_vector + 3 * half_edge;
    *ratio = held(s, sqrt(brc_dot3(branch, branch) / brc_dot3(surface, surface)));
    for (int c = 0; c < 3; ++c)
        area[c] = held(s, (double)(exact[c] / *ratio));
}

static void add_bond(const brc_simulation *s, int64_t element, int64_t half_edge, double spring, wide p[3][3],
                     wide n[3][3])
{
    wide branch[3];
    double area[3], ratio;
    branch_of(s->domain, element, half_edge, branch);
    brc_consistent_bond(s, element, half_edge, area, &ratio);
    const wide weight = (wide)held(s, spring / ratio) / spring;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            p[a][b] += branch[a] * area[b];
            n[a][b] += weight * branch[a] * branch[b];
        }
}

static void invert(const wide a[3][3], wide out[3][3])
{
    wide det = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out[j][i] = a[(i + 1) % 3][(j + 1) % 3] * a[(i + 2) % 3][(j + 2) % 3] -
                        a[(i + 1) % 3][(j + 2) % 3] * a[(i + 2) % 3][(j + 1) % 3];
    for (int i = 0; i < 3; ++i)
        det += a[0][i] * out[i][0];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out[i][j] /= det;
}

void brc_consistent_inverse(const brc_simulation *s, int64_t element, double out[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    const double k = s->elastic[s->material_of_element[element]].k, one_plus_tau = 1 + s->scene->model.tau;
    const double spring = held(s, held(s, k) * held(s, one_plus_tau)); /* the product the force pass takes */
    wide p[3][3] = {{0}}, n[3][3] = {{0}}, inverse[3][3], half[3][3] = {{0}};
    for (int64_t h = s->domain->row_start[element]; h < s->domain->row_start[element + 1]; ++h)
        add_bond(s, element, h, spring, p, n);
    invert(p, inverse);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int l = 0; l < 3; ++l)
                half[i][j] += inverse[i][l] * n[l][j];
    for (int c = 0; c < 6; ++c) { /* P^-1 N P^-T */
        wide sum = 0;
        for (int l = 0; l < 3; ++l)
            sum += half[pair[c][0]][l] * inverse[pair[c][1]][l];
        out[c] = (double)sum;
    }
}
