/* What a campaign writes: coefficients, error map, quality, and the law as C. */
#include "calibrate.h"
#include "../../../bench/rows.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include "../../base/version.h"
#include "../../output/text.h"
#include <math.h>
#include <string.h>

static const char *const letters[2][4] = {{"a1", "b1", "c1", "d1"}, {"a2", "b2", "c2", "d2"}};
static const char *const columns[4] = {"A", "B", "C", "D"};

static void describe(const brc_calibration_plan *plan, char *out, size_t room)
{
    snprintf(out, room,
             "%d samples of %lld spheres, pulled along %s, radii +-%g %%, seeds %llu to %llu, %d coordination numbers "
             "%g to %g, %d radii %g to %g",
             plan->n_samples, (long long)plan->n_elements,
             plan->n_axes == 1   ? "x"
             : plan->n_axes == 2 ? "x and y"
                                 : "x, y and z",
             100 * plan->radius_spread, (unsigned long long)plan->seed,
             (unsigned long long)plan->seed + (unsigned long long)plan->n_samples - 1, plan->n_coordinations,
             plan->coordination[0], plan->coordination[plan->n_coordinations - 1], plan->n_radii, plan->radius[0],
             plan->radius[plan->n_radii - 1]);
}

static void add_table(brc_text *text, const char *name, int n_rows, int n, const double *c)
{
    brc_text_add(text, "    .%s = {", name);
    for (int i = 0; i < n_rows; ++i) {
        brc_text_add(text, "%s{", i ? ",\n        " : "");
        for (int j = 0; j < n; ++j)
            brc_text_add(text, "%s%.11g", j ? ", " : "", c[n * i + j]);
        brc_text_add(text, "}");
    }
    brc_text_add(text, "}");
}

static brc_status write_c(brc_context *context, const brc_calibration_plan *plan, const brc_calibration_fit *fit,
                          const char *path)
{
    const brc_beam_law *law = &fit->law;
    char words[256], spread[32];
    brc_text text = {.context = context};
    describe(plan, words, sizeof words);
    snprintf(spread, sizeof spread, "%g", 100 * law->radius_spread);
    for (char *c = spread; *c; ++c)
        if (*c == '.') *c = '_';
    brc_text_add(&text,
                 "/* Written by breccia calibrate: %s. Relative error left, root mean square over the means of samples "
                 "and axes: nu %.2f %%, E %.2f %%. */\n",
                 words, 100 * fit->quality[BRC_FORM_SURFACE][BRC_QUANTITY_NU].mean_rms,
                 100 * fit->quality[BRC_FORM_SURFACE][BRC_QUANTITY_E].mean_rms);
    brc_text_add(&text,
                 "#ifndef BRC_LAWS_SPREAD_%s_H\n#define BRC_LAWS_SPREAD_%s_H\n\n#include \"beam_law.h\"\n\nstatic "
                 "const brc_beam_law brc_beam_law_spread_%s = {\n",
                 spread, spread, spread);
    brc_text_add(
        &text,
        "    .name = \"radii +-%g %%\", .radius_spread = %g,\n    .coordination = {%g, %g}, .radius = {%g, %g},\n",
        100 * law->radius_spread, law->radius_spread, law->coordination[0], law->coordination[1], law->radius[0],
        law->radius[1]);
    add_table(&text, "poisson", BRC_BEAM_LAW_ROWS, BRC_BEAM_LAW_COLUMNS, &law->poisson[0][0]);
    brc_text_add(&text, ",\n");
    add_table(&text, "young", BRC_BEAM_LAW_ROWS, BRC_BEAM_LAW_COLUMNS, &law->young[0][0]);
    brc_text_add(&text, ",\n");
    add_table(&text, "paper_poisson", 4, 4, &law->paper_poisson[0][0]);
    brc_text_add(&text, ",\n");
    add_table(&text, "paper_young", 4, 4, &law->paper_young[0][0]);
    brc_text_add(&text, ",\n    .inner = {");
    for (int j = 0; j < BRC_BEAM_LAW_INNER; ++j)
        brc_text_add(&text, "%s%.11g", j ? ", " : "", law->inner[j]);
    brc_text_add(&text, "},\n};\n\n#endif\n");
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

/* One line a coefficient. */
static brc_status write_coefficients(brc_context *context, const brc_calibration_fit *fit, const char *path)
{
    brc_text text = {.context = context};
    brc_text_add(&text, "form,quantity,coordination,row,column,value\n");
    for (int q = 0; q < BRC_QUANTITIES; ++q) {
        const char *quantity = brc_calibration_quantity(q);
        for (int c = 0; fit->made[BRC_FORM_CUBICS] && c < fit->n_coordinations; ++c)
            for (int k = 0; k < 4; ++k)
                brc_text_add(&text, "per-cn cubics,%s,%g,%s,,%.17g\n", quantity, fit->coordination[c], letters[q][k],
                             fit->cubic[q][c][k]);
        for (int form = BRC_FORM_TWO_STAGE; form <= BRC_FORM_JOINT; ++form)
            for (int k = 0; fit->made[form] && k < 16; ++k)
                brc_text_add(&text, "%s,%s,,%s,%s,%.17g\n", brc_calibration_form(form), quantity, letters[q][k / 4],
                             columns[k % 4], (form == BRC_FORM_JOINT ? fit->joint : fit->two_stage)[q][k / 4][k % 4]);
        for (int k = 0; fit->made[BRC_FORM_SURFACE] && k < BRC_BEAM_LAW_ROWS * BRC_BEAM_LAW_COLUMNS; ++k)
            brc_text_add(&text, "surface,%s,,%d,%d,%.17g\n", quantity, k / BRC_BEAM_LAW_COLUMNS,
                         k % BRC_BEAM_LAW_COLUMNS,
                         (q == BRC_QUANTITY_NU ? fit->law.poisson
                                               : fit->law.young)[k / BRC_BEAM_LAW_COLUMNS][k % BRC_BEAM_LAW_COLUMNS]);
    }
    for (int j = 0; fit->made[BRC_FORM_SURFACE] && j < BRC_BEAM_LAW_INNER; ++j)
        brc_text_add(&text, "surface,cn_in/cn,,,%d,%.17g\n", j, fit->law.inner[j]);
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

/* One line a pair of coordination number and radius: what was measured, and how far each form is off [-]. */
static brc_status write_errors(brc_context *context, const brc_calibration_fit *fit, const brc_calibration_rows *rows,
                               const char *path)
{
    static const char *const form_keys[BRC_FORMS] = {"cubics", "two_stage", "joint", "surface"},
                             *const keys[BRC_QUANTITIES] = {"nu", "E"};
    brc_calibration_mean *means = NULL;
    int64_t n;
    brc_text text = {.context = context};
    BRC_TRY(brc_calibration_means(context, rows, &n, &means));
    brc_text_add(&text, "cn,r_m,samples");
    for (int q = 0; q < BRC_QUANTITIES; ++q) {
        brc_text_add(&text, ",%s,%s_scatter", keys[q], keys[q]);
        for (int form = 0; form < BRC_FORMS; ++form)
            if (fit->made[form]) brc_text_add(&text, ",%s_error_%s", keys[q], form_keys[form]);
    }
    brc_text_add(&text, "\n");
    for (int64_t k = 0; k < n; ++k) {
        const brc_calibration_mean *m = &means[k];
        brc_text_add(&text, "%g,%g,%d", m->coordination, m->radius, m->n);
        for (int q = 0; q < BRC_QUANTITIES; ++q) {
            brc_text_add(&text, ",%.8g,%.4g", m->value[q], m->scatter[q]);
            for (int form = 0; form < BRC_FORMS; ++form)
                if (fit->made[form])
                    brc_text_add(&text, ",%.4g",
                                 brc_calibration_value(fit, form, q, m->coordination, m->radius) / m->value[q] - 1);
        }
        brc_text_add(&text, "\n");
    }
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    brc_memory_free(means);
    return status;
}

static void add_matrix(brc_json *json, const char *key, int n_rows, int n, const double *c)
{
    brc_json_begin_array(json, key);
    for (int i = 0; i < n_rows; ++i) {
        brc_json_begin_array(json, NULL);
        for (int j = 0; j < n; ++j)
            brc_json_number(json, NULL, c[n * i + j]);
        brc_json_end(json);
    }
    brc_json_end(json);
}

static void add_quality(brc_json *json, const brc_fit_quality *f)
{
    brc_json_number(json, "r2", f->r2);
    brc_json_number(json, "worst", f->worst);
    brc_json_number(json, "rms", f->rms);
    brc_json_number(json, "worst_of_means", f->mean_worst);
    brc_json_number(json, "rms_of_means", f->mean_rms);
}

static brc_status write_json(brc_context *context, const brc_calibration_plan *plan, const brc_calibration_rows *rows,
                             const brc_calibration_fit *fit, const char *path)
{
    brc_json json = {.text = {.context = context}};
    char words[256];
    describe(plan, words, sizeof words);
    brc_json_begin_object(&json, NULL);
    brc_json_string(&json, "version", brc_version());
    brc_json_string(&json, "commit", brc_version_commit());
    brc_json_string(&json, "campaign", words);
    brc_json_integer(&json, "solves", rows->n);
    brc_json_begin_array(&json, "inner");
    for (int j = 0; j < BRC_BEAM_LAW_INNER; ++j)
        brc_json_number(&json, NULL, fit->law.inner[j]);
    brc_json_end(&json);
    for (int form = 0; form < BRC_FORMS; ++form) {
        if (!fit->made[form]) continue;
        brc_json_begin_object(&json, brc_calibration_form(form));
        for (int q = 0; q < BRC_QUANTITIES; ++q) {
            brc_json_begin_object(&json, q == BRC_QUANTITY_NU ? "nu" : "E");
            add_quality(&json, &fit->quality[form][q]);
            if (form == BRC_FORM_CUBICS) {
                brc_json_begin_array(&json, "r2_of_each");
                for (int c = 0; c < fit->n_coordinations; ++c)
                    brc_json_number(&json, NULL, fit->cubic_r2[q][c]);
                brc_json_end(&json);
            }
            if (form == BRC_FORM_TWO_STAGE) {
                brc_json_begin_array(&json, "r2_of_coefficients");
                for (int k = 0; k < 4; ++k)
                    brc_json_number(&json, NULL, fit->stage_r2[q][k]);
                brc_json_end(&json);
            }
            if (form == BRC_FORM_TWO_STAGE) add_matrix(&json, "coefficients", 4, 4, &fit->two_stage[q][0][0]);
            if (form == BRC_FORM_JOINT) add_matrix(&json, "coefficients", 4, 4, &fit->joint[q][0][0]);
            if (form == BRC_FORM_SURFACE)
                add_matrix(&json, "coefficients", BRC_BEAM_LAW_ROWS, BRC_BEAM_LAW_COLUMNS,
                           q == BRC_QUANTITY_NU ? &fit->law.poisson[0][0] : &fit->law.young[0][0]);
            brc_json_end(&json);
        }
        brc_json_end(&json);
    }
    return brc_json_write(&json, path);
}

static brc_status write_rows(brc_context *context, const brc_calibration_plan *plan, const brc_calibration_rows *all,
                             const brc_calibration_fit *fit, const char *folder)
{
    brc_rows rows = {.context = context};
    double seconds = 0;
    for (int64_t k = 0; k < all->n; ++k)
        seconds += all->rows[k].seconds;
    for (int form = 0; form < BRC_FORMS; ++form)
        for (int q = 0; fit->made[form] && q < BRC_QUANTITIES; ++q) {
            const brc_fit_quality *f = &fit->quality[form][q];
            const struct {
                const char *key;
                double value;
            } numbers[] = {{"R2", f->r2},
                           {"worst error", f->worst},
                           {"rms error", f->rms},
                           {"worst error of means", f->mean_worst},
                           {"rms error of means", f->mean_rms}};
            for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
                char quantity[64];
                snprintf(quantity, sizeof quantity, "%s of %s", numbers[k].key, brc_calibration_quantity(q));
                brc_rows_begin(&rows);
                brc_rows_text(&rows, "case", "calibrate");
                brc_rows_text(&rows, "quantity", quantity);
                brc_rows_text(&rows, "model", "cbm");
                brc_rows_text(&rows, "form", brc_calibration_form(form));
                brc_rows_text(&rows, "unit", "-");
                brc_rows_number(&rows, "ours", numbers[k].value);
                brc_rows_number(&rows, "radius_spread", plan->radius_spread);
                brc_rows_integer(&rows, "elements", plan->n_elements);
                brc_rows_integer(&rows, "solves", f->n);
                brc_rows_number(&rows, "seconds", seconds);
                brc_rows_stamp(&rows);
            }
        }
    const brc_status status = brc_rows_write(&rows, folder);
    brc_rows_free(&rows);
    return status;
}

brc_status brc_calibrate_report(brc_context *context, const brc_calibration_plan *plan,
                                const brc_calibration_rows *rows, const brc_calibration_fit *fit, const char *folder)
{
    static const char *const names[] = {"law.h", "laws.csv", "errors.csv", "laws.json"};
    for (int k = 0; k < 4; ++k) {
        char *path;
        BRC_TRY(brc_file_join(context, folder, names[k], &path));
        const brc_status status = k == 0   ? fit->made[BRC_FORM_SURFACE] ? write_c(context, plan, fit, path) : BRC_OK
                                  : k == 1 ? write_coefficients(context, fit, path)
                                  : k == 2 ? write_errors(context, fit, rows, path)
                                           : write_json(context, plan, rows, fit, path);
        brc_memory_free(path);
        BRC_TRY(status);
    }
    return write_rows(context, plan, rows, fit, folder);
}
