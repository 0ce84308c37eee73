/* Fits of the laws: what is linear in its coefficients by least squares, the rest by Levenberg and Marquardt's method
 * as in the paper (MINPACK through cminpack). */
#include "calibrate.h"
#include "least_squares.h"
#include "../../base/memory.h"
#include <cminpack.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = BRC_BEAM_LAW_ROWS, COLUMNS = BRC_BEAM_LAW_COLUMNS, CUBIC = 4, JOINT = 16 };

const char *brc_calibration_form(int form)
{
    static const char *const names[BRC_FORMS] = {"per-cn cubics", "two-stage", "joint", "surface"};
    return names[form];
}

const char *brc_calibration_quantity(int quantity)
{
    return quantity == BRC_QUANTITY_NU ? "nu" : "E/E_m";
}

static double value_of(const brc_calibration_row *row, int quantity)
{
    return quantity == BRC_QUANTITY_NU ? row->poisson : row->young;
}

/* Radii of the paper's Table 2. */
static bool of_the_paper(double radius)
{
    static const double radii[] = {0.2, 0.4, 0.6, 0.8, 1.0};
    for (size_t k = 0; k < sizeof radii / sizeof *radii; ++k)
        if (fabs(radius - radii[k]) < 1e-9) return true;
    return false;
}

static void powers(double x, double out[CUBIC])
{
    out[0] = 1;
    for (int k = 1; k < CUBIC; ++k)
        out[k] = out[k - 1] * x;
}

/* y = c0 + c1 x + c2 x^2 + c3 x^3 through n points; *r2: coefficient of determination. */
static brc_status fit_cubic(brc_context *context, int n, const double *x, const double *y, double c[CUBIC], double *r2)
{
    brc_equations e;
    double mean = 0, left = 0, all = 0;
    brc_status status = brc_equations_create(context, n, CUBIC, &e);
    if (status != BRC_OK) goto cleanup;
    for (int k = 0; k < n; ++k) {
        powers(x[k], e.a + CUBIC * k);
        e.b[k] = y[k];
        mean += y[k] / n;
    }
    BRC_TRY_OR(cleanup, brc_equations_solve(context, &e));
    memcpy(c, e.b, CUBIC * sizeof *c);
    for (int k = 0; k < n; ++k) {
        const double fitted = c[0] + x[k] * (c[1] + x[k] * (c[2] + x[k] * c[3]));
        left += (y[k] - fitted) * (y[k] - fitted);
        all += (y[k] - mean) * (y[k] - mean);
    }
    *r2 = all > 0 ? 1 - left / all : 1;
cleanup:
    brc_equations_free(&e);
    return status;
}

/* What the nonlinear fits minimise. */
typedef struct residuals {
    int n;
    const double *x, *y;              /* tanh: points */
    const brc_calibration_row **rows; /* joint: solves */
} residuals;

static int tanh_residual(void *self, int m, int n, const double *p, double *out, int flag)
{
    const residuals *r = self;
    (void)n, (void)flag;
    for (int k = 0; k < m; ++k)
        out[k] = p[0] + p[1] * tanh(p[2] * (r->x[k] - 7) + p[3]) - r->y[k];
    return 0;
}

static int joint_residual(void *self, int m, int n, const double *p, double *out, int flag)
{
    const residuals *r = self;
    double c[4][4];
    (void)flag;
    memcpy(c, p, (size_t)n * sizeof *p);
    for (int k = 0; k < m; ++k)
        out[k] = brc_beam_law_paper_poisson(c, r->rows[k]->coordination, r->rows[k]->radius) / r->rows[k]->poisson - 1;
    return 0;
}

static brc_status minimise(brc_context *context, cminpack_func_mn function, residuals *r, int n, double *p, double *sum)
{
    const int m = r->n, room = m * n + 5 * n + m;
    int *order = NULL;
    double *left = NULL, *scratch = NULL;
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &order, n, "fit"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &left, m, "fit"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &scratch, room, "fit"));
    if (lmdif1(function, r, m, n, p, left, 1e-12, order, scratch, room) <= 0)
        BRC_TRY_OR(cleanup,
                   BRC_FAIL(context, BRC_INTERNAL, "cminpack refused a fit of %d coefficients to %d points", n, m));
    *sum = 0;
    for (int k = 0; k < m; ++k)
        *sum += left[k] * left[k];
cleanup:
    brc_memory_free(order);
    brc_memory_free(left);
    brc_memory_free(scratch);
    return status;
}

/* Eq. 19 through n points, from several starts: A and B follow from C and D. */
static brc_status fit_tanh(brc_context *context, int n, const double *x, const double *y, double c[CUBIC], double *r2)
{
    static const double slopes[] = {0.2, 0.4, 0.7, 1.1}, shifts[] = {-0.4, 0, 0.4};
    double best = INFINITY, mean = 0, all = 0;
    residuals r = {.n = n, .x = x, .y = y};
    for (int k = 0; k < n; ++k)
        mean += y[k] / n;
    for (int k = 0; k < n; ++k)
        all += (y[k] - mean) * (y[k] - mean);
    for (size_t i = 0; i < sizeof slopes / sizeof *slopes; ++i)
        for (size_t j = 0; j < sizeof shifts / sizeof *shifts; ++j) {
            double t_mean = 0, ty = 0, tt = 0, sum;
            for (int k = 0; k < n; ++k)
                t_mean += tanh(slopes[i] * (x[k] - 7) + shifts[j]) / n;
            for (int k = 0; k < n; ++k) {
                const double t = tanh(slopes[i] * (x[k] - 7) + shifts[j]) - t_mean;
                ty += t * (y[k] - mean);
                tt += t * t;
            }
            double p[CUBIC] = {mean - ty / tt * t_mean, ty / tt, slopes[i], shifts[j]};
            BRC_TRY(minimise(context, tanh_residual, &r, CUBIC, p, &sum));
            if (!(sum < best)) continue;
            best = sum;
            memcpy(c, p, sizeof p);
        }
    if (!isfinite(best)) return BRC_FAIL(context, BRC_INTERNAL, "eq. 19 could not be fitted");
    if (c[2] < 0) c[1] = -c[1], c[2] = -c[2], c[3] = -c[3]; /* the same curve */
    *r2 = all > 0 ? 1 - best / all : 1;
    return BRC_OK;
}

/* Eq. 17 and 18 at each coordination number, then eq. 19 and 20 through the coefficients. */
static brc_status fit_stages(brc_context *context, int n, const brc_calibration_row **rows, brc_calibration_fit *fit)
{
    double *x = NULL, *y = NULL, along[BRC_CALIBRATE_LIST];
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &x, n, "points of a fit"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &y, n, "points of a fit"));
    for (int q = 0; q < BRC_QUANTITIES; ++q) {
        for (int c = 0; c < fit->n_coordinations; ++c) {
            int m = 0;
            for (int k = 0; k < n; ++k)
                if (rows[k]->coordination == fit->coordination[c])
                    x[m] = rows[k]->radius, y[m++] = value_of(rows[k], q);
            BRC_TRY_OR(cleanup, fit_cubic(context, m, x, y, fit->cubic[q][c], &fit->cubic_r2[q][c]));
        }
        fit->made[BRC_FORM_CUBICS] = true;
        if (fit->n_coordinations < CUBIC + 1) continue;
        for (int k = 0; k < CUBIC; ++k) {
            for (int c = 0; c < fit->n_coordinations; ++c)
                along[c] = fit->cubic[q][c][k];
            BRC_TRY_OR(cleanup, (q == BRC_QUANTITY_NU ? fit_tanh
                                                      : fit_cubic)(context, fit->n_coordinations, fit->coordination,
                                                                   along, fit->two_stage[q][k], &fit->stage_r2[q][k]));
        }
        fit->made[BRC_FORM_TWO_STAGE] = true;
    }
cleanup:
    brc_memory_free(x);
    brc_memory_free(y);
    return status;
}

/* All coefficients of the paper's form at once, on relative errors. E is linear in them; nu starts from the two
 * stages. */
static brc_status fit_joint(brc_context *context, int n, const brc_calibration_row **rows, brc_calibration_fit *fit)
{
    brc_equations e;
    double sum;
    residuals r = {.n = n, .rows = rows};
    memcpy(fit->joint[BRC_QUANTITY_NU], fit->two_stage[BRC_QUANTITY_NU], sizeof fit->joint[BRC_QUANTITY_NU]);
    BRC_TRY(minimise(context, joint_residual, &r, JOINT, &fit->joint[BRC_QUANTITY_NU][0][0], &sum));
    brc_status status = brc_equations_create(context, n, JOINT, &e);
    if (status != BRC_OK) goto cleanup;
    for (int k = 0; k < n; ++k) {
        double of_radius[CUBIC], of_coordination[CUBIC];
        powers(rows[k]->radius, of_radius);
        powers(rows[k]->coordination, of_coordination);
        for (int i = 0; i < JOINT; ++i)
            e.a[JOINT * k + i] = of_radius[i / CUBIC] * of_coordination[i % CUBIC] / rows[k]->young;
        e.b[k] = 1;
    }
    BRC_TRY_OR(cleanup, brc_equations_solve(context, &e));
    memcpy(fit->joint[BRC_QUANTITY_E], e.b, JOINT * sizeof *e.b);
    fit->made[BRC_FORM_JOINT] = true;
cleanup:
    brc_equations_free(&e);
    return status;
}

/* Bonds inside over bonds in all, against cn; all zero where samples are too small to have an inside. */
static brc_status fit_inner(brc_context *context, const brc_calibration_plan *plan, const brc_calibration_rows *rows,
                            brc_calibration_fit *fit)
{
    const int n = plan->n_coordinations < BRC_BEAM_LAW_INNER ? plan->n_coordinations : BRC_BEAM_LAW_INNER;
    brc_equations e;
    brc_status status = BRC_OK;
    for (int64_t k = 0; k < rows->n; ++k)
        if (!(rows->rows[k].inner > 0)) return BRC_OK;
    BRC_TRY_OR(cleanup, brc_equations_create(context, (int)rows->n, n, &e));
    for (int64_t k = 0; k < rows->n; ++k) {
        double terms[ROWS][COLUMNS];
        brc_beam_law_terms(&fit->law, rows->rows[k].coordination, fit->law.radius[0],
                           terms); /* row 0 depends on cn alone */
        memcpy(e.a + k * n, terms[0], (size_t)n * sizeof *e.a);
        e.b[k] = rows->rows[k].inner / rows->rows[k].coordination;
    }
    BRC_TRY_OR(cleanup, brc_equations_solve(context, &e));
    memcpy(fit->law.inner, e.b, (size_t)n * sizeof *e.b);
cleanup:
    brc_equations_free(&e);
    return status;
}

/* The surface of beam_law.h on relative errors; as many polynomials as the plan's values determine, the rest zero. */
static brc_status fit_surface(brc_context *context, const brc_calibration_plan *plan, const brc_calibration_rows *rows,
                              brc_calibration_fit *fit)
{
    const int ni = plan->n_radii < ROWS ? plan->n_radii : ROWS,
              nj = plan->n_coordinations < COLUMNS ? plan->n_coordinations : COLUMNS;
    double *const out[BRC_QUANTITIES] = {&fit->law.poisson[0][0], &fit->law.young[0][0]};
    for (int q = 0; q < BRC_QUANTITIES; ++q) {
        brc_equations e;
        brc_status status = brc_equations_create(context, (int)rows->n, ni * nj, &e);
        for (int64_t k = 0; status == BRC_OK && k < rows->n; ++k) {
            const brc_calibration_row *row = &rows->rows[k];
            double terms[ROWS][COLUMNS];
            const double weight = q == BRC_QUANTITY_NU ? 1 / row->poisson : 1;
            brc_beam_law_terms(&fit->law, row->coordination, row->radius, terms);
            for (int i = 0; i < ni; ++i)
                for (int j = 0; j < nj; ++j)
                    e.a[(k * ni + i) * nj + j] = weight * terms[i][j];
            e.b[k] = q == BRC_QUANTITY_NU ? 1 : log(row->young);
        }
        if (status == BRC_OK) status = brc_equations_solve(context, &e);
        for (int i = 0; status == BRC_OK && i < ni; ++i)
            for (int j = 0; j < nj; ++j)
                out[q][COLUMNS * i + j] = e.b[i * nj + j];
        brc_equations_free(&e);
        BRC_TRY(status);
    }
    fit->made[BRC_FORM_SURFACE] = true;
    return fit_inner(context, plan, rows, fit);
}

double brc_calibration_value(const brc_calibration_fit *fit, int form, int quantity, double coordination, double radius)
{
    const bool nu = quantity == BRC_QUANTITY_NU;
    if (form == BRC_FORM_SURFACE)
        return (nu ? brc_beam_law_poisson : brc_beam_law_young)(&fit->law, coordination, radius);
    if (form == BRC_FORM_TWO_STAGE || form == BRC_FORM_JOINT) {
        const double(*c)[4] = form == BRC_FORM_JOINT ? fit->joint[quantity] : fit->two_stage[quantity];
        return (nu ? brc_beam_law_paper_poisson : brc_beam_law_paper_young)(c, coordination, radius);
    }
    for (int c = 0; c < fit->n_coordinations; ++c)
        if (fit->coordination[c] == coordination) {
            const double *k = fit->cubic[quantity][c];
            return k[0] + radius * (k[1] + radius * (k[2] + radius * k[3]));
        }
    return NAN;
}

brc_status brc_calibration_means(brc_context *context, const brc_calibration_rows *rows, int64_t *n,
                                 brc_calibration_mean **out)
{
    *n = 0;
    BRC_TRY(BRC_ALLOCATE(context, out, rows->n, "means of a campaign"));
    for (int64_t k = 0; k < rows->n;) { /* rows are sorted */
        const brc_calibration_row *first = &rows->rows[k];
        brc_calibration_mean *mean = &(*out)[(*n)++];
        double square[BRC_QUANTITIES] = {0};
        *mean = (brc_calibration_mean){.coordination = first->coordination, .radius = first->radius};
        for (; k < rows->n && rows->rows[k].coordination == mean->coordination && rows->rows[k].radius == mean->radius;
             ++k) {
            ++mean->n;
            for (int q = 0; q < BRC_QUANTITIES; ++q)
                mean->value[q] += value_of(&rows->rows[k], q);
        }
        for (int q = 0; q < BRC_QUANTITIES; ++q) {
            mean->value[q] /= mean->n;
            for (const brc_calibration_row *row = first; row < rows->rows + k; ++row)
                square[q] += (value_of(row, q) - mean->value[q]) * (value_of(row, q) - mean->value[q]);
            mean->scatter[q] = mean->n > 1 ? sqrt(square[q] / (mean->n - 1)) / mean->value[q] : NAN;
        }
    }
    return BRC_OK;
}

/* Over the rows the form was fitted to. */
static brc_status judge(brc_context *context, const brc_calibration_fit *fit, int form, const brc_calibration_rows *all,
                        bool papers, brc_fit_quality out[BRC_QUANTITIES])
{
    brc_calibration_mean *means = NULL;
    int64_t n_means;
    BRC_TRY(brc_calibration_means(context, all, &n_means, &means));
    for (int q = 0; q < BRC_QUANTITIES; ++q) {
        brc_fit_quality f = {0};
        double mean = 0, left = 0, spread = 0;
        int64_t n = 0;
        for (int64_t k = 0; k < all->n; ++k)
            if (!papers || of_the_paper(all->rows[k].radius)) mean += value_of(&all->rows[k], q), ++f.n;
        mean /= (double)f.n;
        for (int64_t k = 0; k < all->n; ++k) {
            const brc_calibration_row *row = &all->rows[k];
            if (papers && !of_the_paper(row->radius)) continue;
            const double y = value_of(row, q),
                         off = brc_calibration_value(fit, form, q, row->coordination, row->radius) - y;
            left += off * off;
            spread += (y - mean) * (y - mean);
            f.worst = fmax(f.worst, fabs(off / y));
            f.rms += off / y * (off / y) / (double)f.n;
        }
        for (int64_t k = 0; k < n_means; ++k) {
            if (papers && !of_the_paper(means[k].radius)) continue;
            const double off =
                brc_calibration_value(fit, form, q, means[k].coordination, means[k].radius) / means[k].value[q] - 1;
            f.mean_worst = fmax(f.mean_worst, fabs(off));
            f.mean_rms += off * off;
            ++n;
        }
        f.r2 = 1 - left / spread;
        f.rms = sqrt(f.rms);
        f.mean_rms = sqrt(f.mean_rms / (double)n);
        out[q] = f;
    }
    brc_memory_free(means);
    return BRC_OK;
}

brc_status brc_calibrate_fit(brc_context *context, const brc_calibration_plan *plan, const brc_calibration_rows *rows,
                             brc_calibration_fit *fit)
{
    const brc_calibration_row **seen = NULL;
    int n = 0, of_paper = 0;
    memset(fit, 0, sizeof *fit);
    fit->n_coordinations = plan->n_coordinations;
    memcpy(fit->coordination, plan->coordination, sizeof fit->coordination);
    for (int r = 0; r < plan->n_radii; ++r)
        of_paper += of_the_paper(plan->radius[r]);
    const bool papers = of_paper > CUBIC;
    fit->law = (brc_beam_law){.radius_spread = plan->radius_spread,
                              .coordination = {plan->coordination[0], plan->coordination[plan->n_coordinations - 1]},
                              .radius = {plan->radius[0], plan->radius[plan->n_radii - 1]}};
    if (plan->n_radii < 2 || plan->n_coordinations < 2) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, &seen, rows->n, "solves of a fit"));
    for (int64_t k = 0; k < rows->n; ++k)
        if (!papers || of_the_paper(rows->rows[k].radius)) seen[n++] = &rows->rows[k];
    brc_status status = BRC_OK;
    if (plan->n_radii >= CUBIC) BRC_TRY_OR(cleanup, fit_stages(context, n, seen, fit));
    if (fit->made[BRC_FORM_TWO_STAGE] && n > JOINT) BRC_TRY_OR(cleanup, fit_joint(context, n, seen, fit));
    BRC_TRY_OR(cleanup, fit_surface(context, plan, rows, fit));
    memcpy(fit->law.paper_poisson, fit->two_stage[BRC_QUANTITY_NU], sizeof fit->law.paper_poisson);
    memcpy(fit->law.paper_young, fit->two_stage[BRC_QUANTITY_E], sizeof fit->law.paper_young);
    for (int form = 0; form < BRC_FORMS; ++form)
        if (fit->made[form])
            BRC_TRY_OR(cleanup,
                       judge(context, fit, form, rows, papers && form != BRC_FORM_SURFACE, fit->quality[form]));
cleanup:
    brc_memory_free(seen);
    return status;
}
