/* The campaign: its fits find laws that were put in, its file survives a stop. */
#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../host/commands/calibrate/calibrate.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A law of the paper's form, of the size ours has. */
static const double NU[4][4] = {{0.41, -0.167, 0.389, 0.117},
                                {-0.364, 0.366, 0.49, -0.07},
                                {0.08, -0.31, 0.66, -0.12},
                                {-0.034, 0.093, 0.83, -0.17}};
static const double E[4][4] = {{-0.022, 0.0151, -0.00228, 8.2e-5},
                               {0.2, -0.152, 0.0235, -0.00086},
                               {-0.304, 0.244, -0.0329, 0.00128},
                               {0.1055, -0.0141, 0.0202, -0.00079}};

/* Samples without scatter, of that law. */
static void make_rows(const brc_calibration_plan *plan, brc_calibration_rows *rows)
{
    memset(rows, 0, sizeof *rows);
    test_done(BRC_ALLOCATE(test_context, &rows->rows, plan->n_coordinations * plan->n_radii, "rows"));
    for (int c = 0; c < plan->n_coordinations; ++c)
        for (int r = 0; r < plan->n_radii; ++r)
            rows->rows[rows->n++] =
                (brc_calibration_row){.coordination = plan->coordination[c],
                                      .radius = plan->radius[r],
                                      .beam_young = 1,
                                      .poisson = brc_beam_law_paper_poisson(NU, plan->coordination[c], plan->radius[r]),
                                      .young = brc_beam_law_paper_young(E, plan->coordination[c], plan->radius[r])};
}

static brc_calibration_plan paper_plan(int n_coordinations)
{
    brc_calibration_plan plan = {.n_elements = 1000,
                                 .radius_spread = 0.125,
                                 .n_samples = 1,
                                 .n_axes = 1,
                                 .n_coordinations = n_coordinations,
                                 .n_radii = 5,
                                 .n_youngs = 1,
                                 .young = {1},
                                 .seed = 1,
                                 .n_threads = 1,
                                 .radius = {0.2, 0.4, 0.6, 0.8, 1.0}};
    for (int k = 0; k < n_coordinations; ++k)
        plan.coordination[k] = 5.5 + 0.5 * k;
    return plan;
}

/* Data that lie on the form exactly: the fits end where nothing is left, at the square root of rounding or better. */
static void both_fits_of_the_papers_form_find_the_law_that_made_the_data(void **state)
{
    (void)state;
    const brc_calibration_plan plan = paper_plan(16);
    brc_calibration_rows rows;
    brc_calibration_fit fit;
    make_rows(&plan, &rows);
    test_done(brc_calibrate_fit(test_context, &plan, &rows, &fit));
    for (int form = BRC_FORM_TWO_STAGE; form <= BRC_FORM_JOINT; ++form) {
        assert_true(fit.made[form]);
        for (int q = 0; q < BRC_QUANTITIES; ++q) {
            assert_true(fit.quality[form][q].worst < 1e-6);
            assert_true(fit.quality[form][q].r2 > 1 - 1e-10);
        }
    }
    for (int k = 0; k < 16; ++k)
        assert_true(fabs(fit.two_stage[BRC_QUANTITY_NU][k / 4][k % 4] - NU[k / 4][k % 4]) < 1e-5);
    brc_calibration_rows_free(&rows);
}

/* Data that lie on the built-in surface: linear least squares gives its coefficients back to rounding, times the
 * condition of the equations (some 1e3). */
static void the_surface_is_found_again(void **state)
{
    (void)state;
    static const double radii[] = {0.1, 0.14, 0.2, 0.28, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0};
    brc_calibration_plan plan = paper_plan(16);
    brc_calibration_rows rows;
    brc_calibration_fit fit;
    const brc_beam_law *law = brc_beam_law_for(0.125);
    plan.n_radii = sizeof radii / sizeof *radii;
    memcpy(plan.radius, radii, sizeof radii);
    make_rows(&plan, &rows);
    for (int64_t k = 0; k < rows.n; ++k) {
        rows.rows[k].poisson = brc_beam_law_poisson(law, rows.rows[k].coordination, rows.rows[k].radius);
        rows.rows[k].young = brc_beam_law_young(law, rows.rows[k].coordination, rows.rows[k].radius);
    }
    test_done(brc_calibrate_fit(test_context, &plan, &rows, &fit));
    for (int i = 0; i < BRC_BEAM_LAW_ROWS; ++i)
        for (int j = 0; j < BRC_BEAM_LAW_COLUMNS; ++j) {
            assert_near(fit.law.poisson[i][j], law->poisson[i][j], 1e-11);
            assert_near(fit.law.young[i][j], law->young[i][j], 1e-11);
        }
    brc_calibration_rows_free(&rows);
}

static void few_coordination_numbers_leave_the_paper_form_out(void **state)
{
    (void)state;
    const brc_calibration_plan plan = paper_plan(3);
    brc_calibration_rows rows;
    brc_calibration_fit fit;
    make_rows(&plan, &rows);
    test_done(brc_calibrate_fit(test_context, &plan, &rows, &fit));
    assert_true(fit.made[BRC_FORM_CUBICS] && fit.made[BRC_FORM_SURFACE]);
    assert_false(fit.made[BRC_FORM_TWO_STAGE] || fit.made[BRC_FORM_JOINT]);
    brc_calibration_rows_free(&rows);
}

static brc_calibration_plan small_plan(int n_threads)
{
    return (brc_calibration_plan){.n_elements = 300,
                                  .radius_spread = 0.125,
                                  .n_samples = 2,
                                  .n_axes = 1,
                                  .n_coordinations = 2,
                                  .n_radii = 2,
                                  .n_youngs = 2,
                                  .coordination = {7, 9},
                                  .radius = {0.4, 0.8},
                                  .young = {1, 5e11},
                                  .seed = 1,
                                  .n_threads = n_threads};
}

static void same_rows(const brc_calibration_rows *a, const brc_calibration_rows *b)
{
    assert_int_equal(a->n, b->n);
    for (int64_t k = 0; k < a->n; ++k) {
        assert_true(a->rows[k].coordination == b->rows[k].coordination && a->rows[k].radius == b->rows[k].radius &&
                    a->rows[k].seed == b->rows[k].seed);
        assert_true(a->rows[k].young == b->rows[k].young && a->rows[k].poisson == b->rows[k].poisson);
    }
}

/* Killed in the middle of a line, resumed on two threads: the same numbers, bit for bit, and every solve once. E_m
 * scales out: its last digits alone may differ, the tolerance of the solves is relative to the load. */
static void a_stopped_campaign_goes_on_to_the_same_results(void **state)
{
    (void)state;
    char whole[128], stopped[128], path[160];
    brc_calibration_rows first, second, third;
    char *text;
    size_t bytes;
    snprintf(whole, sizeof whole, "%s/whole", test_folder());
    snprintf(stopped, sizeof stopped, "%s/stopped", test_folder());
    const brc_calibration_plan one = small_plan(1), two = small_plan(2);
    test_done(brc_calibrate_campaign(test_context, &one, whole, false, &first));
    assert_int_equal(first.n, 16);
    for (int64_t k = 0; k + 2 < first.n; ++k) /* rows run over seeds within E_m */
        if (first.rows[k].beam_young == 1 && first.rows[k].radius == first.rows[k + 2].radius)
            assert_true(fabs(first.rows[k + 2].young / first.rows[k].young - 1) < 1e-9);
    snprintf(path, sizeof path, "%s/solves.csv", whole);
    test_done(brc_file_read_whole(test_context, path, 1 << 20, &text, &bytes));
    test_done(brc_file_make_folder(test_context, stopped));
    snprintf(path, sizeof path, "%s/solves.csv", stopped);
    test_done(brc_file_write_whole(test_context, path, text, bytes / 2 + 3));
    brc_memory_free(text);
    test_done(brc_calibrate_campaign(test_context, &two, stopped, true, &second));
    same_rows(&first, &second);
    test_done(brc_calibrate_campaign(test_context, &two, stopped, true, &third)); /* nothing left to do */
    same_rows(&first, &third);
    test_done(brc_file_read_whole(test_context, path, 1 << 20, &text, &bytes));
    int lines = 0;
    for (const char *c = text; *c; ++c)
        lines += *c == '\n';
    assert_int_equal(lines, 17);
    brc_memory_free(text);
    brc_calibration_rows_free(&first);
    brc_calibration_rows_free(&second);
    brc_calibration_rows_free(&third);
}

static void results_that_are_there_are_not_mixed_unasked(void **state)
{
    (void)state;
    char there[128];
    brc_calibration_rows rows;
    brc_calibration_plan plan = small_plan(1);
    plan.n_samples = plan.n_coordinations = plan.n_radii = plan.n_youngs = 1;
    snprintf(there, sizeof there, "%s/there", test_folder());
    test_done(brc_calibrate_campaign(test_context, &plan, there, false, &rows));
    brc_calibration_rows_free(&rows);
    assert_int_equal(brc_calibrate_campaign(test_context, &plan, there, false, &rows), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "--resume goes on with it"));
    brc_context_clear(test_context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_fits_of_the_papers_form_find_the_law_that_made_the_data),
        cmocka_unit_test(the_surface_is_found_again),
        cmocka_unit_test(few_coordination_numbers_leave_the_paper_form_out),
        cmocka_unit_test(a_stopped_campaign_goes_on_to_the_same_results),
        cmocka_unit_test(results_that_are_there_are_not_mixed_unasked),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
