/* Restarted GMRES for operators that are not symmetric (dlsm-published). The basis lives on the host; each iteration
 * sends one vector to the device and fetches one back. */
#include "statics_internal.h"
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
        return brc_download(s, v->z.move, brc_state_bytes(s), z, 3 * rows);
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
    BRC_TRY(brc_constrain(s, v->p.move, NULL));
    BRC_TRY(brc_statics_apply(s, v));
    BRC_TRY(brc_download(s, v->kp.move, brc_state_bytes(s), out, n));
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
    BRC_TRY(brc_download(s, v->r.move, brc_state_bytes(s), r, n));
    *norm = sqrt(dot(r, r, n));
    return BRC_OK;
}

/* A Krylov space with its Hessenberg matrix, turned to a triangle, and the host's vectors. */
typedef struct space {
    int64_t n;                          /* numbers of a vector */
    double *basis, *x, *r, *z, *blocks; /* [RESTART + 1][n], [n] ... */
    double h[RESTART + 1][RESTART], cosine[RESTART], sine[RESTART], g[RESTART + 1];
} space;

static brc_status make(brc_simulation *s, brc_solve_vectors *v, space *q)
{
    const int64_t rows = s->layout->n_rows, n = q->n;
    const int bytes = brc_state_bytes(s);
    BRC_TRY(BRC_ALLOCATE(s->context, &q->basis, (RESTART + 1) * n, "GMRES basis"));
    BRC_TRY(BRC_ALLOCATE(s->context, &q->x, n, "GMRES"));
    BRC_TRY(BRC_ALLOCATE(s->context, &q->r, n, "GMRES"));
    BRC_TRY(BRC_ALLOCATE(s->context, &q->z, n, "GMRES"));
    BRC_TRY(BRC_ALLOCATE(s->context, &q->blocks, 6 * rows, "preconditioner"));
    BRC_TRY(brc_download(s, v->preconditioner.blocks, bytes, q->blocks, 6 * rows));
    return brc_download(s, v->r.move, bytes, q->r, n);
}

/* The k-th column of the matrix; *next: the vector that follows, of this length, not yet of length one. */
static void turn_column(space *q, int k, double *next, double *length)
{
    for (int i = 0; i <= k; ++i) { /* modified Gram-Schmidt */
        q->h[i][k] = dot(next, q->basis + (int64_t)i * q->n, q->n);
        add(-q->h[i][k], q->basis + (int64_t)i * q->n, next, q->n);
    }
    *length = sqrt(dot(next, next, q->n));
    for (int i = 0; i < k; ++i) {
        const double upper = q->h[i][k];
        q->h[i][k] = q->cosine[i] * upper + q->sine[i] * q->h[i + 1][k];
        q->h[i + 1][k] = -q->sine[i] * upper + q->cosine[i] * q->h[i + 1][k];
    }
}

/* Vectors of the space until the residual is at the target, at most RESTART: *k of them. */
static brc_status grow(brc_simulation *s, brc_solve_vectors *v, space *q, double target, int32_t most, int32_t *done,
                       brc_progress *progress, int *k)
{
    for (*k = 0; *k < RESTART && *done < most && fabs(q->g[*k]) > target && !brc_trial_is_over(s); ++*k, ++*done) {
        double *next = q->basis + (int64_t)(*k + 1) * q->n, length;
        BRC_TRY(precondition(s, v, q->blocks, q->basis + (int64_t)*k * q->n, q->z, s->layout->n_rows));
        BRC_TRY(multiply(s, v, q->z, next, q->n));
        turn_column(q, *k, next, &length);
        const double hyp = hypot(q->h[*k][*k], length);
        if (!(hyp > 0)) break;
        q->cosine[*k] = q->h[*k][*k] / hyp;
        q->sine[*k] = length / hyp;
        q->h[*k][*k] = hyp;
        q->g[*k + 1] = -q->sine[*k] * q->g[*k];
        q->g[*k] *= q->cosine[*k];
        s->statics->report.iterations += 1;
        brc_progress_update(progress, s->statics->report.iterations);
        if (brc_simulation_is_to_stop(s))
            return BRC_FAIL(s->context, BRC_INTERRUPTED, "interrupted in the static solver");
        if (length > 0)
            for (int64_t i = 0; i < q->n; ++i)
                next[i] /= length;
    }
    return BRC_OK;
}

/* x becomes what is nearest in the space of k vectors, r the true residual. */
static brc_status step(brc_simulation *s, brc_solve_vectors *v, space *q, int k)
{
    const int bytes = brc_state_bytes(s);
    double y[RESTART];
    for (int i = k - 1; i >= 0; --i) {
        y[i] = q->g[i];
        for (int j = i + 1; j < k; ++j)
            y[i] -= q->h[i][j] * y[j];
        y[i] /= q->h[i][i];
    }
    memset(q->r, 0, (size_t)q->n * sizeof *q->r);
    for (int i = 0; i < k; ++i)
        add(y[i], q->basis + (int64_t)i * q->n, q->r, q->n);
    BRC_TRY(precondition(s, v, q->blocks, q->r, q->z, s->layout->n_rows));
    add(1, q->z, q->x, q->n);
    BRC_TRY(multiply(s, v, q->x, q->z, q->n));
    BRC_TRY(brc_download(s, v->r.move, bytes, q->r, q->n));
    add(-1, q->z, q->r, q->n);
    return BRC_OK;
}

brc_status brc_gmres(brc_simulation *s, brc_solve_vectors *v, double target, int32_t most, brc_progress *progress,
                     double *left)
{
    space q = {.n = 3 * (int64_t)s->layout->n_rows};
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, make(s, v, &q));
    double norm = sqrt(dot(q.r, q.r, q.n));
    for (int32_t done = 0; done < most && norm > target && !brc_simulation_stopped_early(s);) {
        int k;
        for (int64_t i = 0; i < q.n; ++i)
            q.basis[i] = q.r[i] / norm;
        memset(q.g, 0, sizeof q.g);
        q.g[0] = norm;
        BRC_TRY_OR(cleanup, grow(s, v, &q, target, most, &done, progress, &k));
        if (k == 0) break;
        BRC_TRY_OR(cleanup, step(s, v, &q, k));
        const double now = sqrt(dot(q.r, q.r, q.n));
        const bool stands = !(now < (v->preconditioner.multigrid ? 0.9 : 0.9999) * norm);
        norm = now;
        if (stands && norm > target && v->preconditioner.multigrid)
            BRC_TRY_OR(cleanup, begin_with_blocks(s, v, q.n, q.x, q.r, &norm));
        else if (stands)
            break; /* keep what there is */
    }
    *left = norm;
    BRC_TRY_OR(cleanup, brc_upload_state(s, v->x.move, q.x, q.n));
    BRC_TRY_OR(cleanup, brc_constrain(s, v->x.move, NULL));
cleanup:
    brc_memory_free(q.basis);
    brc_memory_free(q.x);
    brc_memory_free(q.r);
    brc_memory_free(q.z);
    brc_memory_free(q.blocks);
    return status;
}
