#include "price_curves.h"
#include "price_rows.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sums of a problem's points, and what all of them share. */
typedef struct fit {
    brc_price_curve curve;
    char shared[160];
    double x, y, xx, xy;
} fit;

static void add_point(fit *f, double elements, double error)
{
    const double x = log(elements), y = log(error);
    f->x += x, f->y += y, f->xx += x * x, f->xy += x * y;
    f->curve.least = f->curve.n ? fmin(f->curve.least, elements) : elements;
    f->curve.most = f->curve.n ? fmax(f->curve.most, elements) : elements;
    f->curve.n += 1;
}

void brc_price_curves_read(const char *text, const char *model, const char *precision, int *n,
                           brc_price_curve out[BRC_CURVES_MOST])
{
    static const char *const names[] = {"problem", "model",        "precision",   "elements",    "error",
                                        "steps",   "cost_of",      "preparation", "dt_fraction", "integrator",
                                        "nu",      "coordination", "level",       "phi",         "variant"};
    enum { PROBLEM, MODEL, PRECISION, ELEMENTS, ERROR, STEPS, COST_OF, SHARED, NAMES = sizeof names / sizeof *names };
    int n_fits = 0;
    fit fits[BRC_CURVES_MOST];
    brc_price_rows rows;
    const char *value[NAMES];
    memset(fits, 0, sizeof fits);
    *n = 0;
    brc_price_rows_begin(&rows, text, NAMES, names);
    while (brc_price_rows_next(&rows, value)) {
        const double elements = atof(value[ELEMENTS]), error = fabs(atof(value[ERROR]));
        if (strcmp(value[MODEL], model) != 0 || strcmp(value[PRECISION], precision) != 0 || !(elements > 0) ||
            !(error > 0))
            continue;
        char shared[160] = "";
        for (int k = SHARED; k < NAMES; ++k)
            snprintf(shared + strlen(shared), sizeof shared - strlen(shared), "%s,", value[k]);
        int f = 0;
        while (f < n_fits && strcmp(fits[f].curve.problem, value[PROBLEM]) != 0)
            ++f;
        if (f == BRC_CURVES_MOST) continue;
        if (f == n_fits) {
            ++n_fits;
            snprintf(fits[f].curve.problem, sizeof fits[f].curve.problem, "%s", value[PROBLEM]);
            memcpy(fits[f].shared, shared, sizeof shared);
        }
        if (strcmp(fits[f].shared, shared) != 0) continue;
        add_point(&fits[f], elements, error);
        fits[f].curve.moves = fits[f].curve.moves || atof(value[STEPS]) > 0;
        fits[f].curve.rings = fits[f].curve.rings || strcmp(value[COST_OF], "building and 100 crossings") == 0;
    }
    for (int f = 0; f < n_fits; ++f) {
        fit *one = &fits[f];
        const double spread = one->xx - one->x * one->x / one->curve.n;
        if (one->curve.n < 2 || !(spread > 1e-9)) continue;
        const double slope = (one->xy - one->x * one->y / one->curve.n) / spread;
        if (!(slope < 0)) continue; /* does not converge: nothing to go by */
        one->curve.order = -3 * slope;
        one->curve.scale = exp((one->y - slope * one->x) / one->curve.n);
        out[(*n)++] = one->curve;
    }
}

double brc_price_curve_error(const brc_price_curve *curve, double elements)
{
    return curve->scale * pow(elements, -curve->order / 3);
}
double brc_price_curve_elements(const brc_price_curve *curve, double error)
{
    return pow(curve->scale / error, 3 / curve->order);
}
double brc_price_seconds_at(double seconds, double elements, double other_elements)
{
    return seconds * pow(other_elements / elements, 4. / 3);
}
double brc_price_elements_for(double seconds, double elements, double other_seconds)
{
    return elements * pow(other_seconds / seconds, 3. / 4);
}
