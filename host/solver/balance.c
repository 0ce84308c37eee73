#include "balance.h"
#include "sym3.h"
#include <math.h>

void brc_balance(int64_t n, const double *place, const double *torque, double *force, double *rigid)
{
    double centre[3] = {0}, mean[3] = {0}, moment[3] = {0}, shape[6] = {0}, inverse[6], square = 0;
    for (int64_t k = 0; k < 3 * n; ++k) {
        centre[k % 3] += place[k] / (double)n;
        mean[k % 3] += force[k] / (double)n;
        if (torque) moment[k % 3] += torque[k];
    }
    for (int64_t i = 0; i < n; ++i) /* moment about the centre, and sum of |r|^2 1 - r (x) r */
        for (int c = 0; c < 3; ++c) {
            const int p = (c + 1) % 3, q = (c + 2) % 3;
            const double rp = place[3 * i + p] - centre[p], rq = place[3 * i + q] - centre[q];
            moment[c] += rp * force[3 * i + q] - rq * force[3 * i + p];
            shape[c] += rp * rp + rq * rq;
            shape[3 + c] -= rp * rq;
        }
    brc_sym3_pseudo_inverse(shape, 1e-9, inverse); /* elements in one line have one axis less to turn about */
    const double b[3] = {inverse[0] * moment[0] + inverse[5] * moment[1] + inverse[4] * moment[2],
                         inverse[5] * moment[0] + inverse[1] * moment[1] + inverse[3] * moment[2],
                         inverse[4] * moment[0] + inverse[3] * moment[1] + inverse[2] * moment[2]};
    for (int64_t i = 0; i < n; ++i)
        for (int c = 0; c < 3; ++c) {
            const int p = (c + 1) % 3, q = (c + 2) % 3;
            const double off = mean[c] + b[p] * (place[3 * i + q] - centre[q]) - b[q] * (place[3 * i + p] - centre[p]);
            force[3 * i + c] -= off;
            square += off * off;
        }
    *rigid = sqrt(square);
}
