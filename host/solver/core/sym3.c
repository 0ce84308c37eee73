#include "sym3.h"
#include <math.h>
#include <string.h>

void brc_sym3_eigen(const double a[6], double values[3], double vectors[3][3])
{
    double m[3][3] = {{a[0], a[5], a[4]}, {a[5], a[1], a[3]}, {a[4], a[3], a[2]}};
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; /* rows are the eigenvectors being built */
    for (int sweep = 0; sweep < 30; ++sweep) {
        const double off = fabs(m[0][1]) + fabs(m[0][2]) + fabs(m[1][2]);
        const double on = fabs(m[0][0]) + fabs(m[1][1]) + fabs(m[2][2]);
        if (off <= 1e-17 * on || off == 0) break;
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0) continue;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double t = copysign(1.0, theta) / (fabs(theta) + sqrt(theta * theta + 1));
                const double c = 1 / sqrt(t * t + 1), s = t * c;
                for (int k = 0; k < 3; ++k) {
                    const double kp = m[k][p], kq = m[k][q];
                    m[k][p] = c * kp - s * kq;
                    m[k][q] = s * kp + c * kq;
                }
                for (int k = 0; k < 3; ++k) {
                    const double pk = m[p][k], qk = m[q][k];
                    m[p][k] = c * pk - s * qk;
                    m[q][k] = s * pk + c * qk;
                }
                for (int k = 0; k < 3; ++k) {
                    const double pk = v[p][k], qk = v[q][k];
                    v[p][k] = c * pk - s * qk;
                    v[q][k] = s * pk + c * qk;
                }
            }
        }
    }
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 2; ++i)
        for (int j = i + 1; j < 3; ++j)
            if (m[order[j]][order[j]] < m[order[i]][order[i]]) {
                const int swap = order[i];
                order[i] = order[j];
                order[j] = swap;
            }
    for (int i = 0; i < 3; ++i) {
        values[i] = m[order[i]][order[i]];
        if (vectors) memcpy(vectors[i], v[order[i]], sizeof v[0]);
    }
}

int brc_sym3_pseudo_inverse(const double a[6], double relative, double out[6])
{
    double values[3], v[3][3];
    brc_sym3_eigen(a, values, v);
    memset(out, 0, 6 * sizeof *out);
    int kept = 0;
    for (int i = 0; i < 3; ++i) {
        if (!(values[i] > relative * values[2])) continue;
        ++kept;
        const double w = 1 / values[i];
        out[0] += w * v[i][0] * v[i][0];
        out[1] += w * v[i][1] * v[i][1];
        out[2] += w * v[i][2] * v[i][2];
        out[3] += w * v[i][1] * v[i][2];
        out[4] += w * v[i][0] * v[i][2];
        out[5] += w * v[i][0] * v[i][1];
    }
    return kept;
}
