/* Figures of the campaign, as NAH19 Figs. 5 to 7 with our points, and the error map. */
#include "calibrate.h"
#include "../../base/memory.h"
#include "../../output/pictures/gnuplot.h"
#include <math.h>
#include <string.h>

enum { CURVE_POINTS = 60 };

typedef struct figure {
    const brc_calibration_plan *plan;
    const brc_calibration_rows *rows;
    const brc_calibration_fit *fit;
    const brc_calibration_mean *means;
    int64_t n_means;
} figure;

static double value_of(const brc_calibration_row *row, int quantity)
{
    return quantity == BRC_QUANTITY_NU ? row->poisson : row->young;
}

/* Value against r_m, one colour a coordination number: points of all solves, the cubic through them, and the law as
 * dashes. */
static void against_radius(const figure *f, int quantity, brc_text *text)
{
    const brc_calibration_plan *plan = f->plan;
    brc_text_add(
        text,
        "set xlabel 'r_m'\nset ylabel '%s'\nset key %s\nset palette defined (0 '#4477aa', 0.5 '#228833', 1 '#cc6677')\n"
        "set cbrange [%g:%g]\nset cblabel 'cn'\n",
        quantity == BRC_QUANTITY_NU ? "{/Symbol n}_M" : "E_M / E_m",
        quantity == BRC_QUANTITY_NU ? "top right" : "bottom right", plan->coordination[0],
        plan->coordination[plan->n_coordinations - 1] + 1e-9);
    if (quantity == BRC_QUANTITY_E) brc_text_add(text, "set logscale xy\n");
    brc_text_add(text, "$points << END\n");
    for (int64_t k = 0; k < f->rows->n; ++k)
        brc_text_add(text, "%.8g %.8g %.8g\n", f->rows->rows[k].radius, value_of(&f->rows->rows[k], quantity),
                     f->rows->rows[k].coordination);
    brc_text_add(text, "END\n");
    for (int law = 0; law < 2; ++law) {
        brc_text_add(text, "$%s << END\n", law ? "law" : "cubic");
        for (int c = 0; c < plan->n_coordinations; ++c) {
            for (int k = 0; k <= CURVE_POINTS; ++k) {
                const double r =
                    plan->radius[0] + (plan->radius[plan->n_radii - 1] - plan->radius[0]) * k / CURVE_POINTS;
                brc_text_add(text, "%.8g %.8g %.8g\n", r,
                             brc_calibration_value(f->fit, law ? BRC_FORM_SURFACE : BRC_FORM_TWO_STAGE, quantity,
                                                   plan->coordination[c], r),
                             plan->coordination[c]);
            }
            brc_text_add(text, "\n");
        }
        brc_text_add(text, "END\n");
    }
    brc_text_add(text,
                 "plot $cubic using 1:2:3 with lines linewidth 1 linecolor palette title 'eq. 17 to 20, our fit', "
                 "$law using 1:2:3 with lines linewidth 2 dashtype 2 linecolor palette title 'law of breccia', "
                 "$points using 1:2:3 with points pointtype 7 pointsize 0.7 linecolor palette title 'solves'\n");
}

static void surface_of_nu(const void *self, brc_text *text)
{
    against_radius(self, BRC_QUANTITY_NU, text);
}
static void surface_of_e(const void *self, brc_text *text)
{
    against_radius(self, BRC_QUANTITY_E, text);
}

/* a b c d of eq. 17 or 18 against cn, with eq. 19 or 20 through them. */
static void coefficients(const figure *f, int quantity, brc_text *text)
{
    static const char letters[] = "abcd";
    const brc_calibration_plan *plan = f->plan;
    const double low = plan->coordination[0], high = plan->coordination[plan->n_coordinations - 1];
    brc_text_add(text, "set multiplot layout 2,2\nset xlabel 'cn'\nset key off\n");
    for (int k = 0; k < 4; ++k) {
        const double *c = f->fit->two_stage[quantity][k];
        brc_text_add(text, "set ylabel '%c_%d'\nset title 'R^2 = %.5f'\n$points << END\n", letters[k], quantity + 1,
                     f->fit->stage_r2[quantity][k]);
        for (int i = 0; i < plan->n_coordinations; ++i)
            brc_text_add(text, "%.8g %.8g\n", plan->coordination[i], f->fit->cubic[quantity][i][k]);
        brc_text_add(text, "END\n");
        if (quantity == BRC_QUANTITY_NU)
            brc_text_add(text, "f(x) = %.12g + %.12g * tanh(%.12g * (x - 7) + %.12g)\n", c[0], c[1], c[2], c[3]);
        else
            brc_text_add(text, "f(x) = %.12g + x * (%.12g + x * (%.12g + x * %.12g))\n", c[0], c[1], c[2], c[3]);
        brc_text_add(text,
                     "plot [%g:%g] f(x) with lines linewidth 2 linecolor rgb '#4477aa', $points with points pointtype "
                     "7 linecolor rgb '#222222'\n",
                     low, high);
    }
    brc_text_add(text, "unset multiplot\n");
}

static void coefficients_of_nu(const void *self, brc_text *text)
{
    coefficients(self, BRC_QUANTITY_NU, text);
}
static void coefficients_of_e(const void *self, brc_text *text)
{
    coefficients(self, BRC_QUANTITY_E, text);
}

/* Relative errors of the paper's form and of the law, over cn and r_m. */
static void errors(const void *self, brc_text *text)
{
    const figure *f = self;
    static const int forms[2] = {BRC_FORM_TWO_STAGE, BRC_FORM_SURFACE};
    brc_text_add(text, "set multiplot layout 2,2\nset xlabel 'cn'\nset ylabel 'r_m'\nset key off\nset cblabel 'error "
                       "[%%]'\nset offsets 0.4, 0.4, 0.06, 0.06\n"
                       "set palette defined (0 '#4477aa', 0.5 '#f7f7f7', 1 '#cc6677')\n");
    for (int form = 0; form < 2; ++form)
        for (int q = 0; q < BRC_QUANTITIES; ++q) {
            double most = 0.1;
            brc_text_add(text, "$map << END\n");
            for (int64_t k = 0; k < f->n_means; ++k) {
                const brc_calibration_mean *m = &f->means[k];
                if (form == 0 && m->radius < 0.2) continue; /* the paper's form begins there */
                const double error =
                    100 * (brc_calibration_value(f->fit, forms[form], q, m->coordination, m->radius) / m->value[q] - 1);
                most = fmax(most, fabs(error));
                brc_text_add(text, "%.8g %.8g %.8g\n", m->coordination, m->radius, error);
            }
            brc_text_add(text,
                         "END\nset title '%s, %s'\nset cbrange [%g:%g]\nplot $map using 1:2:3 with points pointtype 5 "
                         "pointsize 3 linecolor palette\n",
                         form ? "law of breccia" : "eq. 17 to 20", q == BRC_QUANTITY_NU ? "{/Symbol n}" : "E", -most,
                         most);
        }
    brc_text_add(text, "unset multiplot\n");
}

brc_status brc_calibrate_figures(brc_context *context, const brc_calibration_plan *plan,
                                 const brc_calibration_rows *rows, const brc_calibration_fit *fit, const char *folder)
{
    static const struct {
        const char *name;
        void (*draw)(const void *self, brc_text *text);
    } figures[] = {{"fig5a.png", surface_of_nu},
                   {"fig5b.png", surface_of_e},
                   {"fig6.png", coefficients_of_nu},
                   {"fig7.png", coefficients_of_e},
                   {"errors.png", errors}};
    brc_calibration_mean *means = NULL;
    figure f = {.plan = plan, .rows = rows, .fit = fit};
    brc_status status = BRC_OK;
    if (!fit->made[BRC_FORM_TWO_STAGE] || !fit->made[BRC_FORM_SURFACE]) return BRC_OK;
    BRC_TRY(brc_calibration_means(context, rows, &f.n_means, &means));
    f.means = means;
    bool made = true; /* one warning is enough */
    for (size_t k = 0; status == BRC_OK && made && k < sizeof figures / sizeof *figures; ++k) {
        const brc_gnuplot_figure one = {.folder = folder,
                                        .name = figures[k].name,
                                        .numbers = "solves.csv",
                                        .width = 1400,
                                        .height = 1000,
                                        .draw = figures[k].draw,
                                        .self = &f};
        status = brc_gnuplot_make(context, &one, &made);
    }
    brc_memory_free(means);
    return status;
}
