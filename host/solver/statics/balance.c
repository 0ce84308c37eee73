#include "balance.h"
#include "../core/sym3.h"
#include <lapacke.h>
#include <math.h>
#include <string.h>

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

void brc_free_motions_begin(brc_free_motions *free, int64_t n, const double *place)
{
    memset(free, 0, sizeof *free);
    for (int64_t k = 0; k < 3 * n; ++k)
        free->centre[k % 3] += place[k] / (double)n;
    for (int64_t k = 0; k < 3 * n; ++k)
        free->arm += pow(place[k] - free->centre[k % 3], 2) / (double)n;
    free->arm = free->arm > 0 ? sqrt(free->arm) : 1;
}

static void add_row(brc_free_motions *free, const double row[6])
{
    for (int p = 0; p < 6; ++p)
        for (int q = 0; q < 6; ++q)
            free->held[p][q] += row[p] * row[q];
}

void brc_free_motions_hold(brc_free_motions *free, const double place[3], int component)
{
    const int p = (component + 1) % 3, q = (component + 2) % 3;
    double row[6] = {0}; /* u_c = a_c + b_p r_q - b_q r_p */
    row[component] = 1;
    row[3 + p] = (place[q] - free->centre[q]) / free->arm;
    row[3 + q] = -(place[p] - free->centre[p]) / free->arm;
    add_row(free, row);
}

void brc_free_motions_clamp(brc_free_motions *free, int component)
{
    double row[6] = {0};
    row[3 + component] = 1;
    add_row(free, row);
}

bool brc_free_motions_find(brc_free_motions *free)
{
    /* what a support does not hold is zero to rounding; what it holds badly is some (size of the support / arm)^2 of
     * the largest */
    static const double held_least = 1e-10;
    double values[6], work[64], vectors[6][6];
    memcpy(vectors, free->held, sizeof vectors);
    if (LAPACKE_dsyev_work(LAPACK_ROW_MAJOR, 'V', 'U', 6, &vectors[0][0], 6, values, work, 64) != 0) return false;
    free->n = 0;
    for (int m = 0; m < 6; ++m) {
        if (values[m] > held_least * values[5]) continue;
        for (int c = 0; c < 6; ++c)
            free->motion[free->n][c] = vectors[c][m] / (c < 3 ? 1 : free->arm);
        ++free->n;
    }
    return true;
}

static void motion_at(const brc_free_motions *free, int m, const double *place, double u[3])
{
    const double *a = free->motion[m], *b = a + 3;
    for (int c = 0; c < 3; ++c) {
        const int p = (c + 1) % 3, q = (c + 2) % 3;
        u[c] = a[c] + b[p] * (place[q] - free->centre[q]) - b[q] * (place[p] - free->centre[p]);
    }
}

void brc_free_motions_project(const brc_free_motions *free, int64_t n, const double *place, double *force,
                              double *torque)
{
    double done[6] = {0}, gram[6][6] = {{0}}, u[6][3];
    for (int64_t i = 0; i < n; ++i) {
        for (int m = 0; m < free->n; ++m)
            motion_at(free, m, place + 3 * i, u[m]);
        for (int m = 0; m < free->n; ++m)
            for (int c = 0; c < 3; ++c) {
                done[m] += u[m][c] * force[3 * i + c] + (torque ? free->motion[m][3 + c] * torque[3 * i + c] : 0);
                for (int k = 0; k < free->n; ++k)
                    gram[m][k] += u[m][c] * u[k][c] + (torque ? free->motion[m][3 + c] * free->motion[k][3 + c] : 0);
            }
    }
    if (free->n == 0 || LAPACKE_dposv(LAPACK_ROW_MAJOR, 'U', free->n, 1, &gram[0][0], 6, done, 1) != 0) return;
    for (int64_t i = 0; i < n; ++i) {
        for (int m = 0; m < free->n; ++m)
            motion_at(free, m, place + 3 * i, u[m]);
        for (int m = 0; m < free->n; ++m)
            for (int c = 0; c < 3; ++c) {
                force[3 * i + c] -= done[m] * u[m][c];
                if (torque) torque[3 * i + c] -= done[m] * free->motion[m][3 + c];
            }
    }
}
