/* How much larger than it is a displacement must be drawn to be seen. */
#include "picture.h"
#include <math.h>

double brc_picture_automatic_scale(int32_t n, const brc_picture_part *part)
{
    double mean[3] = {0}, most = 0, diagonal = 0, low[3], high[3];
    int64_t n_elements = 0;
    for (int32_t k = 0; k < n; ++k)
        n_elements += part[k].domain->n_elements;
    for (int32_t k = 0; k < n; ++k)
        for (int64_t e = 0; e < part[k].domain->n_elements; ++e)
            for (int c = 0; c < 3; ++c)
                mean[c] += part[k].displacement[3 * e + c] / (double)n_elements;
    for (int32_t k = 0; k < n; ++k)
        for (int64_t e = 0; e < part[k].domain->n_elements; ++e) {
            double square = 0;
            for (int c = 0; c < 3; ++c)
                square += pow(part[k].displacement[3 * e + c] - mean[c], 2);
            most = fmax(most, sqrt(square));
        }
    for (int c = 0; c < 3; ++c) {
        low[c] = part[0].domain->bounds[0][c];
        high[c] = part[0].domain->bounds[1][c];
        for (int32_t k = 1; k < n; ++k) {
            low[c] = fmin(low[c], part[k].domain->bounds[0][c]);
            high[c] = fmax(high[c], part[k].domain->bounds[1][c]);
        }
        diagonal += pow(high[c] - low[c], 2);
    }
    const double wanted = 0.04 * sqrt(diagonal) / most;
    if (!isfinite(wanted) || wanted < 2) return 1;
    const double decade = pow(10, floor(log10(wanted)));
    return decade * (wanted / decade < 2 ? 1 : wanted / decade < 5 ? 2 : 5);
}
