/* Restarted GMRES for operators that are not symmetric (dlsm-published). The basis lives on the host; each iteration
 * sends one vector to the device and fetches one back. */
#include "multigrid/multigrid.h"
#include <math.h>
#include <string.h>

enum { RESTART = 80 };

static double dot(const double *a, const double *b, int64_t n)
{
    double sum = 0;
    for (int64_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

static void add(double factor, const double *a, double *b, int64_t n)
{
    for (int64_t i = 0; i < n; ++i)
        b[i] += factor * a[i];
}

/* z = M x: multigrid on the device, or a symmetric 3 x 3 block per row. */
static brc_status precondition(brc_simulation *s, brc_solve_vectors *v, const double *blocks, const double *from,
                               double *z, int64_t rows)
{
    if (v->preconditioner.multigrid) {
        BRC_TRY(brc_upload_state(s, v->p.move, from, 3 * rows));
        BRC_TRY(brc_statics_project_free_motions(s, v, v->p)); /* which it would make large */
        BRC_TRY(brc_multigrid_apply(v->preconditioner.multigrid, v->p, v->z));
        BRC_TRY(brc_statics_project_free_motions(s, v, v->z));
        return brc_download(s, v->z.move, brc_precision_state_bytes(brc_device_get_precision(s->device)), z, 3 * rows);
    }
    for (int64_t r = 0; r < rows; ++r) {
        const double *p = blocks + 6 * r, *x = from + 3 * r;
        z[3 * r] = p[0] * x[0] + p[5] * x[1] + p[4] * x[2];
        z[3 * r + 1] = p[5] * x[0] + p[1] * x[1] + p[3] * x[2];
        z[3 * r + 2] = p[4] * x[0] + p[3] * x[1] + p[2] * x[2];
    }
    return BRC_OK;
}

/* out = K z through the device; the force is minus K p. */
static brc_status multiply(brc_simulation *s, brc_solve_vectors *v, const double *z, double *out, int64_t n)
{
    BRC_TRY(brc_upload_state(s, v->p.move, z, n));
    BRC_TRY(brc_loads_zero_imposed(s, v->p.move));
    BRC_TRY(brc_statics_apply(s, v));
    BRC_TRY(brc_download(s, v->kp.move, brc_precision_state_bytes(brc_device_get_precision(s->device)), out, n));
    for (int64_t i = 0; i < n; ++i)
        out[i] = -out[i];
    return BRC_OK;
}

/* From the start, without the motions that multigrid has put into x. */
static brc_status begin_with_blocks(brc_simulation *s, brc_solve_vectors *v, int64_t n, double *x, double *r,
                                    double *norm)
{
    brc_preconditioner_give_up(s, v);
    memset(x, 0, (size_t)n * sizeof *x);
    BRC_TRY(brc_download(s, v->r.move, brc_precision_state_bytes(brc_device_get_precision(s->device)), r, n));
    *norm = sqrt(dot(r, r, n));
    return BRC_OK;
}

brc_status brc_gmres(brc_simulation *s, brc_solve_vectors *v, double target, int32_t most, brc_progress *progress,
                     double *left)
{
    const int64_t rows = s->layout->n_rows, n = 3 * rows;
    const int bytes = brc_precision_state_bytes(brc_device_get_precision(s->device));
    double *basis = NULL, *x = NULL, *r = NULL, *z = NULL, *blocks = NULL;
    double h[RESTART + 1][RESTART], cosine[RESTART], sine[RESTART], g[RESTART + 1], y[RESTART];
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &basis, (RESTART + 1) * n, "GMRES basis"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &x, n, "GMRES"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &r, n, "GMRES"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &z, n, "GMRES"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &blocks, 6 * rows, "preconditioner"));
    BRC_TRY_OR(cleanup, brc_download(s, v->preconditioner.blocks, bytes, blocks, 6 * rows));
    BRC_TRY_OR(cleanup, brc_download(s, v->r.move, bytes, r, n));
    double norm = sqrt(dot(r, r, n));
    for (int32_t done = 0; done < most && norm > target && !s->left_off;) {
        for (int64_t i = 0; i < n; ++i)
            basis[i] = r[i] / norm;
        memset(g, 0, sizeof g);
        g[0] = norm;
        int k = 0;
        for (; k < RESTART && done < most && fabs(g[k]) > target && !brc_leaves_off(s); ++k, ++done) {
            double *next = basis + (int64_t)(k + 1) * n;
            BRC_TRY_OR(cleanup, precondition(s, v, blocks, basis + (int64_t)k * n, z, rows));
            BRC_TRY_OR(cleanup, multiply(s, v, z, next, n));
            for (int i = 0; i <= k; ++i) { /* modified Gram-Schmidt */
                h[i][k] = dot(next, basis + (int64_t)i * n, n);
                add(-h[i][k], basis + (int64_t)i * n, next, n);
            }
            const double length = sqrt(dot(next, next, n));
            for (int i = 0; i < k; ++i) {
                const double upper = h[i][k];
                h[i][k] = cosine[i] * upper + sine[i] * h[i + 1][k];
                h[i + 1][k] = -sine[i] * upper + cosine[i] * h[i + 1][k];
            }
            const double hyp = hypot(h[k][k], length);
            if (!(hyp > 0)) break;
            cosine[k] = h[k][k] / hyp;
            sine[k] = length / hyp;
            h[k][k] = hyp;
            g[k + 1] = -sine[k] * g[k];
            g[k] *= cosine[k];
            s->static_report.iterations += 1;
            brc_progress_update(progress, s->static_report.iterations);
            if (brc_simulation_is_to_stop(s)) {
                status = BRC_FAIL(s->context, BRC_INTERRUPTED, "interrupted in the static solver");
                goto cleanup;
            }
            if (length > 0)
                for (int64_t i = 0; i < n; ++i)
                    next[i] /= length;
        }
        if (k == 0) break;
        for (int i = k - 1; i >= 0; --i) {
            y[i] = g[i];
            for (int j = i + 1; j < k; ++j)
                y[i] -= h[i][j] * y[j];
            y[i] /= h[i][i];
        }
        memset(r, 0, (size_t)n * sizeof *r);
        for (int i = 0; i < k; ++i)
            add(y[i], basis + (int64_t)i * n, r, n);
        BRC_TRY_OR(cleanup, precondition(s, v, blocks, r, z, rows));
        add(1, z, x, n);
        /* true residual */
        BRC_TRY_OR(cleanup, multiply(s, v, x, z, n));
        BRC_TRY_OR(cleanup, brc_download(s, v->r.move, bytes, r, n));
        add(-1, z, r, n);
        const double now = sqrt(dot(r, r, n));
        const bool stands = !(now < (v->preconditioner.multigrid ? 0.9 : 0.9999) * norm);
        norm = now;
        if (stands && norm > target && v->preconditioner.multigrid)
            BRC_TRY_OR(cleanup, begin_with_blocks(s, v, n, x, r, &norm));
        else if (stands)
            break; /* keep what there is */
    }
    *left = norm;
    BRC_TRY_OR(cleanup, brc_upload_state(s, v->x.move, x, n));
    BRC_TRY_OR(cleanup, brc_loads_zero_imposed(s, v->x.move));
cleanup:
    brc_memory_free(basis);
    brc_memory_free(x);
    brc_memory_free(r);
    brc_memory_free(z);
    brc_memory_free(blocks);
    return status;
}
