/* What a fracture campaign writes: coefficients, error map, quality, and the law as C. */
#include "strength_campaign.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include "../../base/version.h"
#include "../../output/text.h"
#include <math.h>

enum { ROWS = BRC_STRENGTH_LAW_ROWS, COLUMNS = BRC_STRENGTH_LAW_COLUMNS, PAPER = BRC_STRENGTH_LAW_PAPER };

static const char *const letters[PAPER] = {"m0", "n0", "p0", "m1", "n1", "p1", "q1", "m2", "n2", "p2"};

static void describe(const brc_strength_plan *plan, char *out, size_t room)
{
    const brc_calibration_plan *s = &plan->samples;
    snprintf(out, room,
             "%d samples of %lld spheres, %d of their axes, radii +-%g %%, seeds %llu to %llu, %d coordination numbers "
             "%g to %g, %d radii %g to %g, %d E_m from %g Pa, "
             "%d sigma_m from %g Pa, %g passages of a wave to the expected strength",
             s->n_samples, (long long)s->n_elements, s->n_axes, 100 * s->radius_spread, (unsigned long long)s->seed,
             (unsigned long long)s->seed + (unsigned long long)s->n_samples - 1, s->n_coordinations, s->coordination[0],
             s->coordination[s->n_coordinations - 1], s->n_radii, s->radius[0], s->radius[s->n_radii - 1], s->n_youngs,
             s->young[0], plan->n_limits, plan->limit[0], plan->passages);
}

static brc_status write_c(brc_context *context, const char *words, const brc_strength_fit *fit, const char *path)
{
    const brc_strength_law *law = &fit->law[BRC_STRENGTH_SURFACE];
    brc_text text = {.context = context};
    brc_text_add(&text,
                 "/* Written by breccia calibrate: %s. Relative error left, root mean square over the means of "
                 "samples: %.2f %%. */\n",
                 words, 100 * fit->quality[BRC_STRENGTH_SURFACE].mean_rms);
    brc_text_add(&text, "#ifndef BRC_LAWS_STRENGTH_H\n#define BRC_LAWS_STRENGTH_H\n\n#include "
                        "\"strength_law.h\"\n\nstatic const brc_strength_law brc_strength_law_fitted = {\n");
    brc_text_add(&text, "    .name = \"%s\",\n    .coordination = {%g, %g}, .radius = {%g, %g},\n    .surface = {",
                 law->name, law->coordination[0], law->coordination[1], law->radius[0], law->radius[1]);
    for (int i = 0; i < ROWS; ++i) {
        brc_text_add(&text, "%s{", i ? ",\n        " : "");
        for (int j = 0; j < COLUMNS; ++j)
            brc_text_add(&text, "%s%.11g", j ? ", " : "", law->surface[i][j]);
        brc_text_add(&text, "}");
    }
    brc_text_add(&text, "},\n};\n\n#endif\n");
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

/* One line a coefficient. */
static brc_status write_coefficients(brc_context *context, const brc_strength_fit *fit, const char *path)
{
    brc_text text = {.context = context};
    brc_text_add(&text, "form,row,column,value\n");
    for (int form = 0; form < BRC_STRENGTH_SURFACE; ++form)
        for (int k = 0; fit->made[form] && k < PAPER; ++k)
            brc_text_add(&text, "%s,%s,,%.17g\n", brc_strength_form(form), letters[k], fit->law[form].paper[k]);
    for (int k = 0; fit->made[BRC_STRENGTH_SURFACE] && k < ROWS * COLUMNS; ++k)
        brc_text_add(&text, "%s,%d,%d,%.17g\n", brc_strength_form(BRC_STRENGTH_SURFACE), k / COLUMNS, k % COLUMNS,
                     fit->law[BRC_STRENGTH_SURFACE].surface[k / COLUMNS][k % COLUMNS]);
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

/* One line a pair of coordination number and radius: what was measured, and how far each form is off [-]. */
static brc_status write_errors(brc_context *context, const brc_strength_fit *fit, const brc_strength_rows *rows,
                               const char *path)
{
    static const char *const keys[BRC_STRENGTH_FORMS] = {"published", "refitted", "surface"};
    brc_strength_mean *means = NULL;
    int64_t n;
    brc_text text = {.context = context};
    BRC_TRY(brc_strength_means(context, fit, rows, &n, &means));
    brc_text_add(&text, "cn,r_m,tests,k,k_scatter,k_first");
    for (int form = 0; form < BRC_STRENGTH_FORMS; ++form)
        if (fit->made[form]) brc_text_add(&text, ",k_error_%s", keys[form]);
    brc_text_add(&text, "\n");
    for (int64_t k = 0; k < n; ++k) {
        const brc_strength_mean *m = &means[k];
        brc_text_add(&text, "%g,%g,%d,%.8g,%.4g,%.4g", m->coordination, m->radius, m->n, m->ratio, m->scatter,
                     m->first);
        for (int form = 0; form < BRC_STRENGTH_FORMS; ++form)
            if (fit->made[form])
                brc_text_add(&text, ",%.4g",
                             brc_strength_law_ratio(&fit->law[form], m->coordination, m->radius) / m->ratio - 1);
        brc_text_add(&text, "\n");
    }
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    brc_memory_free(means);
    return status;
}

static brc_status write_json(brc_context *context, const char *words, const brc_strength_rows *rows,
                             const brc_strength_fit *fit, const char *path)
{
    brc_json json = {.text = {.context = context}};
    brc_json_begin_object(&json, NULL);
    brc_json_string(&json, "version", brc_version());
    brc_json_string(&json, "commit", brc_version_commit());
    brc_json_string(&json, "campaign", words);
    brc_json_integer(&json, "tests", rows->n);
    for (int form = 0; form < BRC_STRENGTH_FORMS; ++form) {
        const brc_fit_quality *f = &fit->quality[form];
        const brc_strength_law *law = &fit->law[form];
        if (!fit->made[form]) continue;
        brc_json_begin_object(&json, brc_strength_form(form));
        brc_json_integer(&json, "fitted_tests", f->n);
        brc_json_number(&json, "r2", f->r2);
        brc_json_number(&json, "worst", f->worst);
        brc_json_number(&json, "rms", f->rms);
        brc_json_number(&json, "worst_of_means", f->mean_worst);
        brc_json_number(&json, "rms_of_means", f->mean_rms);
        brc_json_begin_array(&json, "coefficients");
        for (int i = 0; i < (law->is_paper ? PAPER : ROWS); ++i) {
            if (law->is_paper) {
                brc_json_number(&json, NULL, law->paper[i]);
                continue;
            }
            brc_json_begin_array(&json, NULL);
            for (int j = 0; j < COLUMNS; ++j)
                brc_json_number(&json, NULL, law->surface[i][j]);
            brc_json_end(&json);
        }
        brc_json_end(&json);
        brc_json_end(&json);
    }
    return brc_json_write(&json, path);
}

static brc_status write_rows(brc_context *context, const brc_strength_plan *plan, const brc_strength_rows *all,
                             const brc_strength_fit *fit, const char *folder)
{
    brc_rows rows = {.context = context};
    double seconds = 0;
    for (int64_t k = 0; k < all->n; ++k)
        seconds += all->rows[k].seconds;
    for (int form = 0; form < BRC_STRENGTH_FORMS; ++form) {
        const brc_fit_quality *f = &fit->quality[form];
        const struct {
            const char *quantity;
            double value;
        } numbers[] = {{"R2 of k", f->r2},
                       {"worst error of k", f->worst},
                       {"rms error of k", f->rms},
                       {"worst error of means of k", f->mean_worst},
                       {"rms error of means of k", f->mean_rms}};
        for (size_t k = 0; fit->made[form] && k < sizeof numbers / sizeof *numbers; ++k) {
            brc_rows_begin(&rows);
            brc_rows_text(&rows, "case", "calibrate");
            brc_rows_text(&rows, "quantity", numbers[k].quantity);
            brc_rows_text(&rows, "model", "cbm");
            brc_rows_text(&rows, "form", brc_strength_form(form));
            brc_rows_text(&rows, "unit", "-");
            brc_rows_number(&rows, "ours", numbers[k].value);
            brc_rows_number(&rows, "radius_spread", plan->samples.radius_spread);
            brc_rows_integer(&rows, "elements", plan->samples.n_elements);
            brc_rows_integer(&rows, "tests", f->n);
            brc_rows_number(&rows, "seconds", seconds);
            brc_rows_stamp(&rows);
        }
    }
    const brc_status status = brc_rows_write(&rows, folder);
    brc_rows_free(&rows);
    return status;
}

brc_status brc_strength_report(brc_context *context, const brc_strength_plan *plan, const brc_strength_rows *rows,
                               const brc_strength_fit *fit, const char *folder)
{
    static const char *const names[] = {"law.h", "laws.csv", "errors.csv", "laws.json"};
    char words[512];
    describe(plan, words, sizeof words);
    for (int k = 0; k < 4; ++k) {
        char *path;
        BRC_TRY(brc_file_join(context, folder, names[k], &path));
        const brc_status status = k == 0 ? fit->made[BRC_STRENGTH_SURFACE] ? write_c(context, words, fit, path) : BRC_OK
                                  : k == 1 ? write_coefficients(context, fit, path)
                                  : k == 2 ? write_errors(context, fit, rows, path)
                                           : write_json(context, words, rows, fit, path);
        brc_memory_free(path);
        BRC_TRY(status);
    }
    return write_rows(context, plan, rows, fit, folder);
}
