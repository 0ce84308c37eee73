/* Where a solve begins: K (u + sum a_k d_k) balances the loads in all d_k, which lead from u to each known state. They
 * are made orthogonal in K one after the other, so that states that are nearly alike do no harm. */
#include "statics_internal.h"
#include <string.h>

/* A direction with less than this of its energy left is one of those before [-]. */
static const double least_left = 1e-12;

/* Vectors of all unknowns by elements: n numbers of displacements or forces, then as many of rotations or torques. */
static brc_status read(brc_simulation *s, brc_unknowns from, double *to)
{
    BRC_TRY(brc_state_from_rows(s, from.move, to, 3));
    return brc_state_from_rows(s, from.turn, to + 3 * s->domain->n_elements, 3);
}
static brc_status write(brc_simulation *s, const double *from, brc_unknowns to)
{
    BRC_TRY(brc_state_to_rows(s, to.move, from, 3, 0));
    return brc_state_to_rows(s, to.turn, from + 3 * s->domain->n_elements, 3, 0);
}

static double dot(int64_t n, const double *a, const double *b)
{
    double sum[8] = {0};
    int64_t i = 0;
    for (; i + 8 <= n; i += 8)
        for (int l = 0; l < 8; ++l)
            sum[l] += a[i + l] * b[i + l];
    for (; i < n; ++i)
        sum[i % 8] += a[i] * b[i];
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

static void add(int64_t n, double a, const double *x, double *y)
{
    for (int64_t i = 0; i < n; ++i)
        y[i] += a * x[i];
}

/* The k-th direction, and minus K times it. state: where they begin. */
static brc_status direction(brc_simulation *s, brc_solve_vectors *v, int32_t k, const double *state, double *d,
                            double *force)
{
    const int64_t n = s->domain->n_elements;
    for (int64_t e = 0; e < n; ++e)
        for (int c = 0; c < 3; ++c) {
            d[3 * e + c] = s->statics->known[k][6 * e + c] - state[3 * e + c];
            d[3 * (n + e) + c] = s->statics->known[k][6 * e + 3 + c] - state[3 * (n + e) + c];
        }
    BRC_TRY(write(s, d, v->p));
    BRC_TRY(brc_constrain(s, v->p.move, v->p.turn));
    BRC_TRY(brc_statics_apply(s, v));
    BRC_TRY(read(s, v->p, d));
    return read(s, v->kp, force);
}

brc_status brc_statics_mix_known(brc_simulation *s, brc_solve_vectors *v)
{
    const int64_t n = 6 * s->domain->n_elements;
    const int32_t n_known = s->statics->n_known;
    BRC_LOCAL(s->context, n, double, state, "known states");
    BRC_LOCAL(s->context, n, double, left, "known states");
    BRC_LOCAL(s->context, n, double, x, "known states");
    BRC_LOCAL(s->context, n * n_known, double, d, "known states");
    BRC_LOCAL(s->context, n * n_known, double, force, "known states");
    BRC_LOCAL(s->context, n_known, double, energy, "known states");
    BRC_TRY(read(s, (brc_unknowns){brc_displacement_of(s), v->theta}, state));
    BRC_TRY(read(s, (brc_unknowns){brc_force_of(s), brc_torque_of(s)}, left));
    for (int32_t k = 0; k < n_known; ++k) {
        double *const own = d + n * k, *const push = force + n * k;
        BRC_TRY(direction(s, v, k, state, own, push));
        const double before = -dot(n, own, push);
        for (int32_t i = 0; i < k; ++i) {
            if (!(energy[i] > 0)) continue;
            const double share = dot(n, d + n * i, push) / energy[i]; /* minus the part along it */
            add(n, share, d + n * i, own);
            add(n, share, force + n * i, push);
        }
        energy[k] = -dot(n, own, push);
        if (!(energy[k] > least_left * before)) {
            energy[k] = 0;
            continue;
        }
        const double way = dot(n, own, left) / energy[k];
        add(n, way, own, x);
        add(n, way, push, left);
    }
    return write(s, x, v->x);
}
