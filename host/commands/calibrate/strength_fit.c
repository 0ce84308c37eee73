/* Fits of k: both forms are linear in their coefficients. */
#include "least_squares.h"
#include "strength_campaign.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

enum { ROWS = BRC_STRENGTH_LAW_ROWS, COLUMNS = BRC_STRENGTH_LAW_COLUMNS, PAPER = BRC_STRENGTH_LAW_PAPER };

const char *brc_strength_form(int form)
{
    static const char *const names[BRC_STRENGTH_FORMS] = {"eq. 22 as printed", "eq. 22 refitted", "surface"};
    return names[form];
}

bool brc_strength_is_fitted(const brc_strength_fit *fit, const brc_strength_row *row)
{
    return row->limit / row->beam_young <= fit->smallest * (1 + 1e-9);
}

/* Is the test within what a form was fitted to, or the paper says it was? */
static bool sees(const brc_strength_fit *fit, int form, double coordination, double radius)
{
    const brc_strength_law *law = &fit->law[form];
    return coordination >= law->coordination[0] && coordination <= law->coordination[1] &&
           radius >= law->radius[0] - 1e-9 && radius <= law->radius[1] + 1e-9;
}

/* The tests that a form is fitted to; *n of them. */
static void choose(const brc_strength_fit *fit, int form, const brc_strength_rows *rows, const brc_strength_row **seen,
                   int *n)
{
    *n = 0;
    for (int64_t k = 0; k < rows->n; ++k)
        if (brc_strength_is_fitted(fit, &rows->rows[k]) &&
            sees(fit, form, rows->rows[k].coordination, rows->rows[k].radius))
            seen[(*n)++] = &rows->rows[k];
}

static brc_status fit_paper(brc_context *context, int n, const brc_strength_row **seen, brc_strength_law *law)
{
    brc_equations e;
    brc_status status = brc_equations_create(context, n, PAPER, &e);
    for (int k = 0; status == BRC_OK && k < n; ++k) {
        brc_strength_law_paper_terms(seen[k]->coordination, seen[k]->radius, e.a + PAPER * k);
        e.b[k] = seen[k]->ratio;
    }
    if (status == BRC_OK) status = brc_equations_solve(context, &e);
    if (status == BRC_OK) memcpy(law->paper, e.b, sizeof law->paper);
    brc_equations_free(&e);
    return status;
}

/* As many polynomials as the plan's values determine, the rest zero. */
static brc_status fit_surface(brc_context *context, const brc_strength_plan *plan, int n, const brc_strength_row **seen,
                              brc_strength_law *law)
{
    const int n_radii = plan->samples.n_radii, n_coordinations = plan->samples.n_coordinations;
    const int ni = n_radii < ROWS ? n_radii : ROWS, nj = n_coordinations < COLUMNS ? n_coordinations : COLUMNS;
    brc_equations e;
    brc_status status = brc_equations_create(context, n, ni * nj, &e);
    for (int k = 0; status == BRC_OK && k < n; ++k) {
        double terms[ROWS][COLUMNS];
        brc_strength_law_terms(law, seen[k]->coordination, seen[k]->radius, terms);
        for (int i = 0; i < ni; ++i)
            for (int j = 0; j < nj; ++j)
                e.a[(k * ni + i) * nj + j] = terms[i][j] / seen[k]->ratio;
        e.b[k] = 1;
    }
    if (status == BRC_OK) status = brc_equations_solve(context, &e);
    for (int i = 0; status == BRC_OK && i < ni; ++i)
        for (int j = 0; j < nj; ++j)
            law->surface[i][j] = e.b[i * nj + j];
    brc_equations_free(&e);
    return status;
}

brc_status brc_strength_means(brc_context *context, const brc_strength_fit *fit, const brc_strength_rows *rows,
                              int64_t *n, brc_strength_mean **out)
{
    *n = 0;
    BRC_TRY(BRC_ALLOCATE(context, out, rows->n, "means of a campaign"));
    for (int64_t k = 0; k < rows->n;) { /* rows are sorted */
        brc_strength_mean mean = {.coordination = rows->rows[k].coordination, .radius = rows->rows[k].radius};
        const int64_t first = k;
        double square = 0;
        for (; k < rows->n && rows->rows[k].coordination == mean.coordination && rows->rows[k].radius == mean.radius;
             ++k) {
            if (!brc_strength_is_fitted(fit, &rows->rows[k])) continue;
            ++mean.n;
            mean.ratio += rows->rows[k].ratio;
            mean.first += rows->rows[k].first;
        }
        mean.ratio /= mean.n;
        mean.first /= mean.n;
        for (int64_t i = first; i < k; ++i)
            if (brc_strength_is_fitted(fit, &rows->rows[i]))
                square += (rows->rows[i].ratio - mean.ratio) * (rows->rows[i].ratio - mean.ratio);
        mean.scatter = mean.n > 1 ? sqrt(square / (mean.n - 1)) / mean.ratio : NAN;
        (*out)[(*n)++] = mean;
    }
    return BRC_OK;
}

/* Over the tests that the form was fitted to. */
static void judge(const brc_strength_fit *fit, int form, int n, const brc_strength_row **seen, int64_t n_means,
                  const brc_strength_mean *means, brc_fit_quality *out)
{
    const brc_strength_law *law = &fit->law[form];
    brc_fit_quality f = {.n = n};
    double mean = 0, left = 0, spread = 0;
    int64_t n_seen = 0;
    for (int k = 0; k < n; ++k)
        mean += seen[k]->ratio / n;
    for (int k = 0; k < n; ++k) {
        const double off = brc_strength_law_ratio(law, seen[k]->coordination, seen[k]->radius) - seen[k]->ratio,
                     relative = off / seen[k]->ratio;
        left += off * off;
        spread += (seen[k]->ratio - mean) * (seen[k]->ratio - mean);
        f.worst = fmax(f.worst, fabs(relative));
        f.rms += relative * relative / n;
    }
    for (int64_t k = 0; k < n_means; ++k) {
        if (!sees(fit, form, means[k].coordination, means[k].radius)) continue;
        const double off = brc_strength_law_ratio(law, means[k].coordination, means[k].radius) / means[k].ratio - 1;
        f.mean_worst = fmax(f.mean_worst, fabs(off));
        f.mean_rms += off * off;
        ++n_seen;
    }
    f.r2 = spread > 0 ? 1 - left / spread : NAN; /* one test has no spread */
    f.rms = sqrt(f.rms);
    f.mean_rms = sqrt(f.mean_rms / (double)n_seen);
    *out = f;
}

/* Values of an ascending list from `low` on. */
static int count_from(int n, const double *list, double low)
{
    int count = 0;
    for (int k = 0; k < n; ++k)
        count += list[k] >= low - 1e-9;
    return count;
}

brc_status brc_strength_fit_make(brc_context *context, const brc_strength_plan *plan, const brc_strength_rows *rows,
                                 brc_strength_fit *fit)
{
    const brc_calibration_plan *s = &plan->samples;
    const brc_strength_row **seen = NULL;
    brc_strength_mean *means = NULL;
    int64_t n_means;
    brc_status status = BRC_OK;
    memset(fit, 0, sizeof *fit);
    fit->smallest = INFINITY;
    for (int64_t k = 0; k < rows->n; ++k)
        fit->smallest = fmin(fit->smallest, rows->rows[k].limit / rows->rows[k].beam_young);
    const brc_strength_law *published = brc_strength_law_published();
    const brc_strength_law whole = {.name = "fit of breccia calibrate",
                                    .coordination = {s->coordination[0], s->coordination[s->n_coordinations - 1]},
                                    .radius = {s->radius[0], s->radius[s->n_radii - 1]}};
    fit->law[BRC_STRENGTH_PUBLISHED] = *published;
    fit->law[BRC_STRENGTH_SURFACE] = fit->law[BRC_STRENGTH_REFITTED] = whole;
    fit->law[BRC_STRENGTH_REFITTED].name = "NAH19 eq. 22, refitted";
    fit->law[BRC_STRENGTH_REFITTED].is_paper = true;
    for (int c = 0; c < 2; ++c) { /* where the paper's form is meant to hold, no farther than the tests reach */
        fit->law[BRC_STRENGTH_REFITTED].coordination[c] =
            fmin(fmax(published->coordination[c], whole.coordination[0]), whole.coordination[1]);
        fit->law[BRC_STRENGTH_REFITTED].radius[c] = fmin(fmax(published->radius[c], whole.radius[0]), whole.radius[1]);
    }
    fit->made[BRC_STRENGTH_PUBLISHED] = true;
    fit->made[BRC_STRENGTH_SURFACE] = s->n_radii > 1 && s->n_coordinations > 1;
    fit->made[BRC_STRENGTH_REFITTED] = count_from(s->n_radii, s->radius, published->radius[0]) >= 3 &&
                                       count_from(s->n_coordinations, s->coordination, published->coordination[0]) >= 4;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &seen, rows->n, "tests of a fit"));
    BRC_TRY_OR(cleanup, brc_strength_means(context, fit, rows, &n_means, &means));
    for (int form = 0; form < BRC_STRENGTH_FORMS; ++form) {
        int n;
        choose(fit, form, rows, seen, &n);
        if (n == 0) fit->made[form] = false;
        if (!fit->made[form]) continue;
        if (form == BRC_STRENGTH_REFITTED) BRC_TRY_OR(cleanup, fit_paper(context, n, seen, &fit->law[form]));
        if (form == BRC_STRENGTH_SURFACE) BRC_TRY_OR(cleanup, fit_surface(context, plan, n, seen, &fit->law[form]));
        judge(fit, form, n, seen, n_means, means, &fit->quality[form]);
    }
cleanup:
    brc_memory_free(seen);
    brc_memory_free(means);
    return status;
}
