/* Lowest free vibration modes K x = omega^2 M x of the linearised operator, by locally optimal block preconditioned
 * conjugate gradients (Knyazev, SIAM J. Sci. Comput. 23, 2001) on the very force kernels of the scene, with multigrid
 * or diagonal blocks for K^-1; the small dense problems go to LAPACK. The operator of dlsm-published is not symmetric:
 * there the dense problem is the unsymmetric one and the modes are its eigenvalues of smallest magnitude. Rigid motions
 * are in the first block, so they converge at once and are left out of the result. */
#include "../../base/random.h"
#include "../effects/loads/loads.h"
#include "statics_internal.h"
#include "ritz.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD_VECTORS = 6, RIGID_MOTIONS = 6, MOST_ROUNDS = 1500, CHUNK = 512, WATCH = 20 };
/* The residual |K x - l M x| in M^-1 over l at which a mode is done: the eigenvalue's own error is its square for a
 * symmetric operator, and about itself for the published one. */
static const double settled = 3e-5;
/* A mode is also done when WATCH rounds change its eigenvalue by less than this part of it. Ritz values of a symmetric
 * operator fall monotonically, at a rate that leaves a few times the last change to come; nearly incompressible solids
 * take hundreds of rounds for each digit of the residual while the eigenvalue stands still. The published operator has
 * complex pairs, whose real and imaginary vectors leave a residual of the size of the imaginary part: there this is the
 * only criterion that is met. */
static const double steady[2] = {1e-6 /* dlsm */, 1e-5 /* dlsm-published */};
/* Eigenvalues below this part of the smallest elastic one count as rigid motions. */
static const double rigid_part = 1e-6;
/* Pairs whose residual falls below this add no directions to the search space any more, nor do rigid motions: what is
 * left of them is rounding, and scaled up to a direction it has Ritz values that belong to nothing. */
static const double finished = 1e-9;

/* Column-major blocks of m host vectors of length n, in rows. */
typedef struct mode_space {
    brc_simulation *s;
    int64_t n;
    int m;
    double *x, *kx, *w, *kw, *p, *kp, *fresh, *k_fresh; /* [m][n] each */
    double *mass;                                       /* [n] */
    double *blocks;                                     /* [n_rows][6]; NULL: multigrid */
    brc_multigrid *multigrid;
    brc_pieces pieces;    /* whose free motions multigrid would make large */
    unsigned char *fixed; /* [n] 1: prescribed */
    brc_buffer *in, *out, *orientation, *torque;
} mode_space;

BRC_WANTED(modes, brc_wants_solver(w, BRC_SOLVER_MODES))

#define AT(member) BRC_FIELD_AT(mode_space, member)
static const brc_field_row mode_rows[] = {
    {"displacement", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(in), "modes", "-", BRC_NOT_KEPT},
    {"force", brc_each_row, 3, BRC_FIELD_STATE, NULL, AT(out), "modes", "-", BRC_NOT_KEPT},
    BRC_FIELD(orientation, brc_each_row, 4, STATE, brc_wants_turning, "modes", "-"),
    BRC_FIELD(torque, brc_each_row, 3, STATE, brc_wants_turning, "modes", "-"),
};
BRC_FIELD_TABLE(brc_mode_fields, "free vibration modes", BRC_LIFE_SOLVE, modes, mode_rows);

static brc_status prepare_preconditioner(mode_space *t)
{
    brc_simulation *s = t->s;
    if (s->domain->n_elements >= BRC_MULTIGRID_LEAST) {
        brc_multigrid_origin origin = {0};
        BRC_TRY(brc_multigrid_create(s, &origin, &t->multigrid));
        return brc_pieces_find(s, &t->pieces);
    }
    BRC_TRY(BRC_ALLOCATE(s->context, &t->blocks, 2 * t->n, "modes"));
    return brc_geometry_precondition_blocks(s, t->blocks);
}

/* Displacements of elements; held faces are in the operator. */
static void fix(void *self, const brc_prescribed *one)
{
    mode_space *t = self;
    for (int c = 0; one->face < 0 && c < 3; ++c)
        if (one->motion >> c & 1) t->fixed[3 * (int64_t)t->s->layout->row_of_element[one->element] + c] = 1;
}

static brc_status allocate(mode_space *t)
{
    brc_simulation *s = t->s;
    double **all[] = {&t->x, &t->kx, &t->w, &t->kw, &t->p, &t->kp, &t->fresh, &t->k_fresh};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
        BRC_TRY(BRC_ALLOCATE(s->context, all[i], t->n * t->m, "modes"));
    BRC_TRY(BRC_ALLOCATE(s->context, &t->mass, t->n, "modes"));
    BRC_TRY(BRC_ALLOCATE(s->context, &t->fixed, t->n, "modes"));
    BRC_TRY(brc_fields_create(s->device, &brc_mode_fields, &s->wants, t));
    BRC_TRY(prepare_preconditioner(t));
    double *mass = t->w; /* scratch */
    BRC_TRY(brc_download(s, brc_mass_of(s), brc_state_bytes(s), mass, t->n / 3));
    for (int64_t i = 0; i < t->n; ++i) {
        t->mass[i] = mass[i / 3];
        t->fixed[i] = s->layout->element_of_row[i / 3] < 0;
    }
    brc_loads_each_prescribed(s, fix, t);
    return BRC_OK;
}

static void release(mode_space *t)
{
    double *all[] = {t->x, t->kx, t->w, t->kw, t->p, t->kp, t->fresh, t->k_fresh, t->mass, t->blocks};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
        brc_memory_free(all[i]);
    brc_memory_free(t->fixed);
    brc_multigrid_free(&t->multigrid);
    brc_pieces_free(&t->pieces);
    brc_fields_free(&brc_mode_fields, t);
}

/* out = K in */
static brc_status multiply(mode_space *t, const double *in, double *out)
{
    brc_simulation *s = t->s;
    BRC_TRY(brc_upload_state(s, t->in, in, t->n));
    if (s->model->turns) {
        BRC_TRY(brc_buffer_fill_zero(t->torque));
        BRC_TRY(brc_vector_small_rotation(s, t->torque, t->orientation));
    }
    BRC_TRY(brc_force_evaluate(s, &(brc_force_request){.displacement = t->in,
                                                       .force = t->out,
                                                       .orientation = t->orientation,
                                                       .torque = t->torque,
                                                       .homogeneous = true}));
    BRC_TRY(brc_download(s, t->out, brc_state_bytes(s), out, t->n));
    for (int64_t i = 0; i < t->n; ++i)
        out[i] = t->fixed[i] ? 0 : -out[i];
    return BRC_OK;
}

static brc_status first_block(mode_space *t)
{
    const brc_domain *d = t->s->domain;
    for (int64_t i = 0; i < t->n; ++i) {
        const int64_t e = t->s->layout->element_of_row[i / 3];
        if (t->fixed[i]) continue;
        const int c = (int)(i % 3), a = (c + 1) % 3, b = (c + 2) % 3;
        t->x[c * t->n + i] = 1;
        t->x[(3 + a) * t->n + i] = d->position[3 * e + b]; /* rotation about a: u_c = +-x_b */
        t->x[(3 + b) * t->n + i] = -d->position[3 * e + a];
        for (int k = RIGID_MOTIONS; k < t->m; ++k) {
            double draws[4];
            brc_random_uniform4((uint64_t)k, BRC_RANDOM_MODES, (uint64_t)e, (uint64_t)c, draws);
            /* smooth fields converge sooner than noise: random cubic polynomials, with a little noise for
             * completeness */
            double value = 0.01 * draws[0];
            for (int power = 0; power < 20; ++power) {
                double factor[4];
                brc_random_uniform4((uint64_t)k, BRC_RANDOM_MODES, 1u << 30, (uint64_t)(power * 3 + c), factor);
                double term = 2 * factor[0] - 1;
                for (int axis = 0, left = power + 1; axis < 3; ++axis, left /= 3) {
                    const double at = 2 * (d->position[3 * e + axis] - d->bounds[0][axis]) /
                                          (d->bounds[1][axis] - d->bounds[0][axis]) -
                                      1;
                    for (int times = left % 3; times > 0; --times)
                        term *= at;
                }
                value += term;
            }
            t->x[k * t->n + i] = value;
        }
    }
    for (int k = 0; k < t->m; ++k)
        BRC_TRY(multiply(t, t->x + k * t->n, t->kx + k * t->n));
    return BRC_OK;
}

/* gram[a][b] = sum_i u_a[i] weight[i] v_b[i] over the columns of u and v (pointers to vectors); weight NULL: 1. Chunks
 * are summed in order, each by one thread. */
static brc_status gram_matrix(mode_space *t, int count, double *const *u, double *const *v, const double *weight,
                              double *gram)
{
    const int64_t n_chunks = (t->n + CHUNK - 1) / CHUNK;
    enum { PARTS = 16 };
    BRC_LOCAL(t->s->context, (int64_t)PARTS * count * count, double, parts, "modes");
#pragma omp parallel for schedule(dynamic, 1)
    for (int part = 0; part < PARTS; ++part)
        for (int64_t chunk = n_chunks * part / PARTS; chunk < n_chunks * (part + 1) / PARTS; ++chunk) {
            const int64_t begin = chunk * CHUNK, end = begin + CHUNK < t->n ? begin + CHUNK : t->n;
            double weighted[CHUNK];
            for (int a = 0; a < count; ++a) {
                for (int64_t i = begin; i < end; ++i)
                    weighted[i - begin] = u[a][i] * (weight ? weight[i] : 1);
                for (int b = 0; b < count; ++b) {
                    double sum[4] = {0, 0, 0, 0};
                    int64_t i = begin;
                    for (; i + 4 <= end; i += 4)
                        for (int lane = 0; lane < 4; ++lane)
                            sum[lane] += weighted[i - begin + lane] * v[b][i + lane];
                    for (; i < end; ++i)
                        sum[0] += weighted[i - begin] * v[b][i];
                    parts[((int64_t)part * count + a) * count + b] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
                }
            }
        }
    memset(gram, 0, (size_t)count * (size_t)count * sizeof *gram);
    for (int part = 0; part < PARTS; ++part)
        for (int k = 0; k < count * count; ++k)
            gram[k] += parts[(int64_t)part * count * count + k];
    return BRC_OK;
}

/* fresh_k = sum over columns from `from` of coefficient * column. */
static void combine(mode_space *t, int count, int from, double *const *columns, const double *coefficients, double *out)
{
#pragma omp parallel for schedule(static)
    for (int64_t begin = 0; begin < t->n; begin += CHUNK) {
        const int64_t end = begin + CHUNK < t->n ? begin + CHUNK : t->n;
        for (int k = 0; k < t->m; ++k) {
            double *to = out + k * t->n;
            for (int64_t i = begin; i < end; ++i)
                to[i] = 0;
            for (int a = from; a < count; ++a) {
                const double factor = coefficients[k * count + a];
                for (int64_t i = begin; i < end; ++i)
                    to[i] += factor * columns[a][i];
            }
        }
    }
}

/* w = K x - l M x for every column; the largest relative residual of the first `wanted` elastic modes. active [m]:
 * columns that are worth a direction. */
static double residuals(mode_space *t, const double *values, int wanted, unsigned char *active)
{
    double worst = 0;
    int counted = 0;
    const double largest = values[t->m - 1];
    for (int k = 0; k < t->m; ++k) {
        double *w = t->w + k * t->n, square = 0;
        const double *x = t->x + k * t->n, *kx = t->kx + k * t->n;
        for (int64_t i = 0; i < t->n; ++i) {
            w[i] = t->fixed[i] ? 0 : kx[i] - values[k] * t->mass[i] * x[i];
            square += w[i] * w[i] / t->mass[i];
        }
        const bool rigid = values[k] < rigid_part * largest;
        active[k] = !rigid && sqrt(square) > finished * values[k];
        if (!rigid && counted++ < wanted && sqrt(square) > worst * values[k]) worst = sqrt(square) / values[k];
    }
    return counted < wanted ? INFINITY : worst;
}

/* w becomes P w. */
static brc_status precondition(mode_space *t, double *w)
{
    brc_simulation *s = t->s;
    if (t->multigrid) {
        const brc_solve_vectors pieces = {.pieces = t->pieces};
        const brc_unknowns in = {t->in, NULL}, out = {t->out, NULL};
        BRC_TRY(brc_upload_state(s, t->in, w, t->n));
        BRC_TRY(brc_statics_project_free_motions(s, &pieces, in));
        BRC_TRY(brc_multigrid_apply(t->multigrid, in, out));
        BRC_TRY(brc_statics_project_free_motions(s, &pieces, out));
        BRC_TRY(brc_download(s, t->out, brc_state_bytes(s), w, t->n));
    }
    for (int64_t r = 0; t->blocks && r < t->n / 3; ++r) {
        const double *b = t->blocks + 6 * r, a0 = w[3 * r], a1 = w[3 * r + 1], a2 = w[3 * r + 2];
        w[3 * r] = b[0] * a0 + b[5] * a1 + b[4] * a2;
        w[3 * r + 1] = b[5] * a0 + b[1] * a1 + b[3] * a2;
        w[3 * r + 2] = b[4] * a0 + b[3] * a1 + b[2] * a2;
    }
    for (int64_t i = 0; i < t->n; ++i)
        if (t->fixed[i]) w[i] = 0;
    return BRC_OK;
}

/* Largest relative change of the elastic eigenvalues since the last look, which is renewed. */
static double change_since(const double *values, double *before, int m)
{
    double worst = 0;
    for (int k = 0; k < m; ++k) {
        if (values[k] > rigid_part * values[m - 1]) worst = fmax(worst, fabs(values[k] / before[k] - 1));
        before[k] = values[k];
    }
    return isfinite(worst) ? worst : INFINITY;
}

static void swap(double **a, double **b)
{
    double *c = *a;
    *a = *b;
    *b = c;
}

static brc_status iterate(mode_space *t, double *values, int wanted, brc_progress *progress)
{
    const int m = t->m, most = 3 * m;
    brc_simulation *s = t->s;
    BRC_LOCAL(s->context, most, double *, u, "modes");
    BRC_LOCAL(s->context, most, double *, ku, "modes");
    BRC_LOCAL(s->context, most * most, double, k_small, "modes");
    BRC_LOCAL(s->context, most * most, double, g_small, "modes");
    BRC_LOCAL(s->context, m * most, double, coefficients, "modes");
    BRC_LOCAL(s->context, m, double, before, "modes");
    BRC_LOCAL(s->context, m, unsigned char, active, "modes");
    for (int round = 0; round < MOST_ROUNDS; ++round) {
        int count = 0;
        for (int k = 0; k < m; ++k, ++count)
            u[count] = t->x + k * t->n, ku[count] = t->kx + k * t->n;
        for (int k = 0; k < m; ++k)
            if (active[k]) u[count] = t->w + k * t->n, ku[count++] = t->kw + k * t->n;
        for (int k = 0; k < m; ++k)
            if (active[k] && round > 1) u[count] = t->p + k * t->n, ku[count++] = t->kp + k * t->n;
        BRC_TRY(gram_matrix(t, count, u, ku, NULL, k_small));
        BRC_TRY(gram_matrix(t, count, u, u, t->mass, g_small));
        BRC_TRY(brc_rayleigh_ritz(t->s->context, t->s->model->statics->symmetric, t->m, count, k_small, g_small, values,
                                  coefficients));
        if (count > m) { /* directions: the part of the new vectors outside the old ones */
            combine(t, count, m, u, coefficients, t->fresh);
            combine(t, count, m, ku, coefficients, t->k_fresh);
        }
        double *px = t->p, *pkx = t->kp; /* new vectors are built in the old directions' place once those are used up */
        if (count > m) {
            for (int k = 0; k < m; ++k)
                for (int a = m; a < count; ++a)
                    coefficients[k * count + a] = 0;
            /* x = X c_x + fresh */
            combine(t, count, 0, u, coefficients, px);
            combine(t, count, 0, ku, coefficients, pkx);
            for (int64_t i = 0; i < m * t->n; ++i)
                px[i] += t->fresh[i], pkx[i] += t->k_fresh[i];
            swap(&t->x, &t->p), swap(&t->kx, &t->kp);          /* x is the new block */
            swap(&t->p, &t->fresh), swap(&t->kp, &t->k_fresh); /* p is the direction */
        } else {
            combine(t, count, 0, u, coefficients, px);
            combine(t, count, 0, ku, coefficients, pkx);
            swap(&t->x, &t->p), swap(&t->kx, &t->kp);
        }
        const double worst = residuals(t, values, wanted, active);
        brc_progress_update(progress, round + 1);
        s->statics->report.iterations = round + 1;
        if (worst < settled) return BRC_OK;
        if ((round + 1) % WATCH == 0 &&
            change_since(values, before, m - GUARD_VECTORS) < steady[!s->model->statics->symmetric])
            return BRC_OK;
        if (brc_trial_is_over(s)) return BRC_OK;
        if (brc_simulation_is_to_stop(s))
            return BRC_FAIL(s->context, BRC_INTERRUPTED, "interrupted in the modes solver");
        if (!memchr(active, 1, (size_t)m)) return BRC_OK;
        for (int k = 0; k < m; ++k) {
            if (!active[k]) continue;
            BRC_TRY(precondition(t, t->w + k * t->n));
            BRC_TRY(multiply(t, t->w + k * t->n, t->kw + k * t->n));
        }
    }
    return BRC_FAIL(s->context, BRC_PHYSICS_STOPPED, "the modes did not settle in %d rounds", MOST_ROUNDS);
}

brc_status brc_modes_run(brc_simulation *s)
{
    const brc_stage *stage = brc_current_stage(s);
    const int wanted = stage->n_modes > 0 ? stage->n_modes : 8;
    mode_space t = {.s = s, .n = 3 * (int64_t)s->layout->n_rows, .m = wanted + RIGID_MOTIONS + GUARD_VECTORS};
    brc_progress *progress = NULL;
    double *values = NULL;
    brc_status status = BRC_OK;
    if (!s->model->statics || s->model->statics->rotations)
        return BRC_FAIL(
            s->context, BRC_BAD_INPUT,
            "stage '%s': free vibration modes are there for dlsm and dlsm-published; take them for cbm from a "
            "dynamic stage with `frequency`",
            stage->name);
    if (3 * s->domain->n_elements < 3 * t.m)
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "stage '%s': %d modes of %lld elements; ask for fewer modes or build more elements",
                        stage->name, wanted, (long long)s->domain->n_elements);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &values, t.m, "modes"));
    BRC_TRY_OR(cleanup, brc_progress_create(s->context, &progress, stage->name, 0, "rounds",
                                            (double)s->domain->n_bonds * t.m, "bond updates/s"));
    BRC_TRY_OR(cleanup, allocate(&t));
    BRC_TRY_OR(cleanup, first_block(&t));
    s->statics->report = (brc_static_report){0};
    BRC_TRY_OR(cleanup, iterate(&t, values, wanted, progress));
    brc_memory_free(s->statics->modes);
    s->statics->modes = NULL;
    s->statics->n_modes = 0;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &s->statics->modes, t.m, "modes"));
    for (int k = 0; k < t.m && s->statics->n_modes < wanted; ++k)
        if (values[k] > rigid_part * values[t.m - 1]) s->statics->modes[s->statics->n_modes++] = sqrt(values[k]);
    if (s->statics->n_modes < wanted &&
        !brc_simulation_stopped_early(
            s)) /* the rounding of forces in less than double precision grows in the search space */
        BRC_TRY_OR(cleanup,
                   BRC_FAIL(s->context, BRC_PHYSICS_STOPPED,
                            "stage '%s': %d of %d modes found above the rigid motions; modes want double precision",
                            stage->name, s->statics->n_modes, wanted));
    brc_clock_set_step(s, 1);
    brc_clock_set_load(s, 1);
    BRC_TRY_OR(cleanup, brc_force_of_state(s, BRC_BOOK_NOTHING));
cleanup:
    brc_progress_finish(&progress);
    release(&t);
    brc_memory_free(values);
    return status;
}
