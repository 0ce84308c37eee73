/* Cells as the eye should see them: moved and strained with their neighbourhood. */
#include "deform.h"
#include <math.h>
#include <string.h>

/* Inverse of a symmetric matrix; false where it is far from spanning space. */
static bool invert(const double a[3][3], double out[3][3])
{
    const double trace = a[0][0] + a[1][1] + a[2][2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            out[j][i] = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
        }
    const double determinant = a[0][0] * out[0][0] + a[0][1] * out[1][0] + a[0][2] * out[2][0];
    if (!(determinant > 1e-6 * trace * trace * trace / 27)) return false;
    for (int k = 0; k < 9; ++k)
        (&out[0][0])[k] /= determinant;
    return true;
}

void brc_deform_gradient(const brc_domain *domain, const uint8_t *whole, const double *displacement, int64_t element,
                         double gradient[3][3])
{
    double shape[3][3] = {{0}}, jump[3][3] = {{0}}, inverse[3][3];
    const double *x = domain->position + 3 * element, *u = displacement + 3 * element;
    for (int64_t h = domain->row_start[element]; h < domain->row_start[element + 1]; ++h) {
        if (whole && !whole[h]) continue;
        const int64_t j = domain->neighbour[h];
        const double *s = domain->area_vector + 3 * h;
        const double *xj = domain->position + 3 * j, *uj = displacement + 3 * j;
        const double branch =
            sqrt((xj[0] - x[0]) * (xj[0] - x[0]) + (xj[1] - x[1]) * (xj[1] - x[1]) + (xj[2] - x[2]) * (xj[2] - x[2]));
        const double q = branch / sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                shape[a][b] += q * s[a] * s[b];
                jump[a][b] += (uj[a] - u[a]) * s[b];
            }
    }
    memset(gradient, 0, 9 * sizeof(double));
    if (!invert((const double(*)[3])shape, inverse)) return;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            for (int k = 0; k < 3; ++k)
                gradient[a][b] += jump[a][k] * inverse[k][b];
}

void brc_deform_point(const brc_domain *domain, const double *displacement, int64_t element,
                      const double gradient[3][3], const double x[3], double out[3])
{
    const double *centre = domain->position + 3 * element;
    for (int a = 0; a < 3; ++a)
        out[a] = displacement[3 * element + a] + gradient[a][0] * (x[0] - centre[0]) +
                 gradient[a][1] * (x[1] - centre[1]) + gradient[a][2] * (x[2] - centre[2]);
}

double brc_deform_von_mises(const double s[6])
{
    const double normal = (s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) + (s[2] - s[0]) * (s[2] - s[0]);
    return sqrt(normal / 2 + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}
