/* Figures of the fracture campaign: NAH19 Figs. 8 and 9 with our points, and the error map. */
#include "strength_campaign.h"
#include "../../base/memory.h"
#include "../../output/pictures/gnuplot.h"
#include <math.h>

enum { CURVE_POINTS = 60 };

typedef struct figure {
    const brc_strength_plan *plan;
    const brc_strength_rows *rows;
    const brc_strength_fit *fit;
    const brc_strength_mean *means;
    int64_t n_means;
} figure;

static void colours(const figure *f, brc_text *text)
{
    const brc_calibration_plan *s = &f->plan->samples;
    const double low = s->coordination[0], high = s->coordination[s->n_coordinations - 1];
    brc_text_add(
        text, "set palette defined (0 '#4477aa', 0.5 '#228833', 1 '#cc6677')\nset cbrange [%g:%g]\nset cblabel 'cn'\n",
        low, high > low ? high : low + 1);
}

/* The tests of a narrow plan determine no surface: the built-in one stands in. */
static const brc_strength_law *law_of(const figure *f, int form)
{
    return f->fit->made[form] ? &f->fit->law[form] : brc_strength_law_default();
}

/* sigma_M against sigma_m: points of all tests; k times sigma_m by our law and by eq. 22, for the least and the most
 * bonds at each radius of the plan. */
static void against_limit(const void *self, brc_text *text)
{
    const figure *f = self;
    const brc_calibration_plan *s = &f->plan->samples;
    const double ends[2] = {s->coordination[0], s->coordination[s->n_coordinations - 1]};
    brc_text_add(
        text,
        "set xlabel '{/Symbol s}_m [MPa]'\nset ylabel '{/Symbol s}_M [MPa]'\nset key top left\nset logscale xy\n");
    colours(f, text);
    brc_text_add(text, "$points << END\n");
    for (int64_t k = 0; k < f->rows->n; ++k)
        brc_text_add(text, "%.8g %.8g %.8g\n", f->rows->rows[k].limit / 1e6,
                     f->rows->rows[k].ratio * f->rows->rows[k].limit / 1e6, f->rows->rows[k].coordination);
    brc_text_add(text, "END\n");
    for (int form = 0; form < BRC_STRENGTH_FORMS; form += BRC_STRENGTH_SURFACE) {
        brc_text_add(text, "$law%d << END\n", form);
        for (int c = 0; c < 2; ++c)
            for (int r = 0; r < s->n_radii; ++r) {
                const double k = brc_strength_law_ratio(law_of(f, form), ends[c], s->radius[r]);
                if (form == BRC_STRENGTH_PUBLISHED && s->radius[r] < f->fit->law[form].radius[0] - 1e-9) continue;
                brc_text_add(text, "2 %.8g %.8g\n1000 %.8g %.8g\n\n", 2 * k, ends[c], 1000 * k, ends[c]);
            }
        brc_text_add(text, "END\n");
    }
    brc_text_add(text,
                 "plot $law%d using 1:2:3 with lines linewidth 1 dashtype 3 linecolor palette title 'eq. 22', $law%d "
                 "using 1:2:3 with lines linewidth 1 linecolor "
                 "palette title 'law of breccia', $points using 1:2:3 with points pointtype 7 pointsize 0.8 linecolor "
                 "palette title 'tests'\n",
                 BRC_STRENGTH_PUBLISHED, BRC_STRENGTH_SURFACE);
}

/* k against E_m, one symbol a sigma_m: what is left of both when k is taken. */
static void against_young(const void *self, brc_text *text)
{
    const figure *f = self;
    const double *limit = f->plan->limit;
    brc_text_add(text, "set xlabel 'E_m [GPa]'\nset ylabel 'k = {/Symbol s}_M / {/Symbol s}_m'\nset key outside "
                       "right\nset xrange [400:2100]\n");
    for (int l = 0; l < f->plan->n_limits; ++l) {
        brc_text_add(text, "$limit%d << END\n", l);
        for (int64_t k = 0; k < f->rows->n; ++k)
            if (f->rows->rows[k].limit == limit[l])
                brc_text_add(text, "%.8g %.8g\n", f->rows->rows[k].beam_young / 1e9, f->rows->rows[k].ratio);
        brc_text_add(text, "END\n");
    }
    for (int l = 0; l < f->plan->n_limits; ++l)
        brc_text_add(text, "%s$limit%d using 1:2 with points pointtype %d title '{/Symbol s}_m = %g MPa'",
                     l ? ", " : "plot ", l, l + 1, limit[l] / 1e6);
    brc_text_add(text, "\n");
}

/* k against r_m, one colour a coordination number: means of the tests with their standard deviation, and three
 * forms. */
static void against_radius(const void *self, brc_text *text)
{
    const figure *f = self;
    const brc_calibration_plan *s = &f->plan->samples;
    brc_text_add(text, "set xlabel 'r_m'\nset ylabel 'k = {/Symbol s}_M / {/Symbol s}_m'\nset key bottom right\n");
    colours(f, text);
    brc_text_add(text, "$points << END\n");
    for (int64_t k = 0; k < f->n_means; ++k)
        brc_text_add(text, "%.8g %.8g %.8g %.8g\n", f->means[k].radius, f->means[k].ratio,
                     f->means[k].n > 1 ? f->means[k].scatter * f->means[k].ratio : 0, f->means[k].coordination);
    brc_text_add(text, "END\n");
    for (int form = 0; form < BRC_STRENGTH_FORMS; ++form) {
        const brc_strength_law *law = &f->fit->law[form];
        brc_text_add(text, "$law%d << END\n", form);
        for (int c = 0; c < s->n_coordinations; ++c) {
            if (s->coordination[c] < law->coordination[0]) continue;
            for (int k = 0; k <= CURVE_POINTS; ++k) {
                const double r = law->radius[0] + (law->radius[1] - law->radius[0]) * k / CURVE_POINTS;
                brc_text_add(text, "%.8g %.8g %.8g\n", r, brc_strength_law_ratio(law, s->coordination[c], r),
                             s->coordination[c]);
            }
            brc_text_add(text, "\n");
        }
        brc_text_add(text, "END\n");
    }
    brc_text_add(text,
                 "plot $law%d using 1:2:3 with lines linewidth 2 dashtype 3 linecolor palette title 'eq. 22 as "
                 "printed', $law%d using 1:2:3 with lines linewidth 1 "
                 "dashtype 2 linecolor palette title 'eq. 22, our fit', $law%d using 1:2:3 with lines linewidth 2 "
                 "linecolor palette title 'law of breccia', "
                 "$points using 1:2:3:4 with yerrorbars pointtype 7 pointsize 1 linecolor palette title 'tests, mean "
                 "and scatter'\n",
                 BRC_STRENGTH_PUBLISHED, BRC_STRENGTH_REFITTED, BRC_STRENGTH_SURFACE);
}

/* Relative errors of the three forms over cn and r_m. */
static void errors(const void *self, brc_text *text)
{
    const figure *f = self;
    brc_text_add(text, "set multiplot layout 2,2\nset xlabel 'cn'\nset ylabel 'r_m'\nset key off\nset cblabel 'error "
                       "of k [%%]'\nset offsets 0.4, 0.4, 0.06, 0.06\n"
                       "set palette defined (0 '#4477aa', 0.5 '#f7f7f7', 1 '#cc6677')\n");
    for (int form = 0; form < BRC_STRENGTH_FORMS; ++form) {
        const brc_strength_law *law = &f->fit->law[form];
        double most = 0.1;
        brc_text_add(text, "$map << END\n");
        for (int64_t k = 0; k < f->n_means; ++k) {
            const brc_strength_mean *m = &f->means[k];
            if (m->radius < law->radius[0] - 1e-9 || m->coordination < law->coordination[0]) continue;
            const double error = 100 * (brc_strength_law_ratio(law, m->coordination, m->radius) / m->ratio - 1);
            most = fmax(most, fabs(error));
            brc_text_add(text, "%.8g %.8g %.8g\n", m->coordination, m->radius, error);
        }
        brc_text_add(text,
                     "END\nset title '%s'\nset cbrange [%g:%g]\nplot $map using 1:2:3 with points pointtype 5 "
                     "pointsize 3 linecolor palette\n",
                     brc_strength_form(form), -most, most);
    }
    brc_text_add(text, "unset multiplot\n");
}

brc_status brc_strength_figures(brc_context *context, const brc_strength_plan *plan, const brc_strength_rows *rows,
                                const brc_strength_fit *fit, const char *folder)
{
    static const struct {
        const char *name;
        void (*draw)(const void *self, brc_text *text);
        bool of_fits;
    } figures[] = {{"fig8a.png", against_limit, false},
                   {"fig8b.png", against_young, false},
                   {"fig9.png", against_radius, true},
                   {"errors.png", errors, true}};
    brc_strength_mean *means = NULL;
    figure f = {.plan = plan, .rows = rows, .fit = fit};
    brc_status status = BRC_OK;
    const bool all_made =
        fit->made[BRC_STRENGTH_PUBLISHED] && fit->made[BRC_STRENGTH_REFITTED] && fit->made[BRC_STRENGTH_SURFACE];
    BRC_TRY(brc_strength_means(context, fit, rows, &f.n_means, &means));
    f.means = means;
    bool made = true; /* one warning is enough */
    for (size_t k = 0; status == BRC_OK && made && k < sizeof figures / sizeof *figures; ++k) {
        if (figures[k].of_fits && !all_made) continue;
        const brc_gnuplot_figure one = {.folder = folder,
                                        .name = figures[k].name,
                                        .numbers = "tests.csv",
                                        .width = 1400,
                                        .height = 1000,
                                        .draw = figures[k].draw,
                                        .self = &f};
        status = brc_gnuplot_make(context, &one, &made);
    }
    brc_memory_free(means);
    return status;
}
