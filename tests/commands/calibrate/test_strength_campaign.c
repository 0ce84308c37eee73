/* The fracture campaign: its tests give the same k whatever E_m and sigma_m, its fits find laws that were put in, its
 * file survives a stop. */
#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../host/commands/calibrate/strength_campaign.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static brc_strength_plan wide_plan(void)
{
    brc_strength_plan plan = {.samples = {.n_elements = 1000,
                                          .radius_spread = 0.125,
                                          .n_samples = 1,
                                          .n_axes = 1,
                                          .n_coordinations = 8,
                                          .n_radii = 6,
                                          .n_youngs = 1,
                                          .young = {2e12},
                                          .seed = 1,
                                          .n_threads = 1,
                                          .radius = {0.14, 0.2, 0.4, 0.6, 0.8, 1.0}},
                              .n_limits = 1,
                              .limit = {2e6},
                              .passages = 30};
    for (int k = 0; k < 8; ++k)
        plan.samples.coordination[k] = 6 + k;
    return plan;
}

/* Tests without scatter that follow a law, and one more at each place that a larger sigma_m spoils: it is not to be
 * seen. */
static void make_rows(const brc_strength_plan *plan, const brc_strength_law *law, brc_strength_rows *rows)
{
    const brc_calibration_plan *s = &plan->samples;
    memset(rows, 0, sizeof *rows);
    test_done(BRC_ALLOCATE(test_context, &rows->rows, 2 * s->n_coordinations * s->n_radii, "rows"));
    for (int c = 0; c < s->n_coordinations; ++c)
        for (int r = 0; r < s->n_radii; ++r)
            for (int spoilt = 0; spoilt < 2; ++spoilt)
                rows->rows[rows->n++] = (brc_strength_row){
                    .coordination = s->coordination[c],
                    .radius = s->radius[r],
                    .beam_young = 2e12,
                    .limit = spoilt ? 1e9 : 2e6,
                    .ratio = spoilt ? 0.1 : brc_strength_law_ratio(law, s->coordination[c], s->radius[r])};
}

/* Data on eq. 22 exactly: linear least squares gives its coefficients back to rounding times the condition of the
 * equations (powers up to r_m^2 cn^3: below 1e6). */
static void the_fit_of_eq_22_finds_the_printed_coefficients(void **state)
{
    (void)state;
    const brc_strength_plan plan = wide_plan();
    const brc_strength_law *published = brc_strength_law_published();
    brc_strength_rows rows;
    brc_strength_fit fit;
    make_rows(&plan, published, &rows);
    test_done(brc_strength_fit_make(test_context, &plan, &rows, &fit));
    assert_true(fit.made[BRC_STRENGTH_REFITTED]);
    for (int k = 0; k < BRC_STRENGTH_LAW_PAPER; ++k)
        assert_near(fit.law[BRC_STRENGTH_REFITTED].paper[k], published->paper[k], 1e-9);
    assert_int_equal(fit.quality[BRC_STRENGTH_REFITTED].n, 40); /* r_m 0.14 is no place of eq. 22 */
    assert_true(fit.quality[BRC_STRENGTH_PUBLISHED].worst < 1e-15);
    assert_true(fit.quality[BRC_STRENGTH_REFITTED].r2 > 1 - 1e-14);
    brc_strength_rows_free(&rows);
}

/* Data on the built-in surface: its coefficients come back to rounding times the condition (some 1e2), if the plan's
 * ranges are the law's. */
static void the_surface_is_found_again(void **state)
{
    (void)state;
    brc_strength_plan plan = wide_plan();
    const brc_strength_law *law = brc_strength_law_default();
    brc_strength_rows rows;
    brc_strength_fit fit;
    for (int k = 0; k < 8; ++k)
        plan.samples.coordination[k] = law->coordination[0] + (law->coordination[1] - law->coordination[0]) * k / 7;
    for (int k = 0; k < 6; ++k)
        plan.samples.radius[k] = law->radius[0] * pow(law->radius[1] / law->radius[0], k / 5.0);
    plan.samples.radius[5] = law->radius[1];
    make_rows(&plan, law, &rows);
    test_done(brc_strength_fit_make(test_context, &plan, &rows, &fit));
    for (int i = 0; i < BRC_STRENGTH_LAW_ROWS; ++i)
        for (int j = 0; j < BRC_STRENGTH_LAW_COLUMNS; ++j)
            assert_near(fit.law[BRC_STRENGTH_SURFACE].surface[i][j], law->surface[i][j], 1e-12);
    brc_strength_rows_free(&rows);
}

static void few_places_leave_eq_22_out(void **state)
{
    (void)state;
    brc_strength_plan plan = wide_plan();
    brc_strength_rows rows;
    brc_strength_fit fit;
    plan.samples.n_coordinations = 3;
    make_rows(&plan, brc_strength_law_published(), &rows);
    test_done(brc_strength_fit_make(test_context, &plan, &rows, &fit));
    assert_true(fit.made[BRC_STRENGTH_SURFACE] && !fit.made[BRC_STRENGTH_REFITTED]);
    brc_strength_rows_free(&rows);
}

static brc_strength_plan small_plan(int n_threads)
{
    return (brc_strength_plan){.samples = {.n_elements = 400,
                                           .radius_spread = 0.125,
                                           .n_samples = 2,
                                           .n_axes = 1,
                                           .n_coordinations = 2,
                                           .n_radii = 1,
                                           .n_youngs = 2,
                                           .young = {1e12, 2e12},
                                           .coordination = {7, 10},
                                           .radius = {0.4},
                                           .seed = 1,
                                           .n_threads = n_threads},
                               .n_limits = 2,
                               .limit = {2e6, 4e6},
                               .passages = 10};
}

static void same_rows(const brc_strength_rows *a, const brc_strength_rows *b)
{
    assert_int_equal(a->n, b->n);
    for (int64_t k = 0; k < a->n; ++k) {
        const brc_strength_row *p = &a->rows[k], *q = &b->rows[k];
        assert_true(p->coordination == q->coordination && p->limit == q->limit && p->beam_young == q->beam_young &&
                    p->seed == q->seed);
        assert_true(p->ratio == q->ratio && p->first == q->first && p->strain == q->strain &&
                    p->n_broken == q->n_broken && p->n_steps == q->n_steps);
    }
}

/* Killed in the middle of a line, resumed on two threads: the same numbers, bit for bit, and every test once. */
static void a_stopped_campaign_goes_on_to_the_same_results(void **state)
{
    (void)state;
    char whole[128], stopped[128], path[160];
    brc_strength_rows first, second, third;
    char *text;
    size_t bytes;
    snprintf(whole, sizeof whole, "%s/whole", test_folder());
    snprintf(stopped, sizeof stopped, "%s/stopped", test_folder());
    const brc_strength_plan one = small_plan(1), two = small_plan(2);
    test_done(brc_strength_campaign(test_context, &one, whole, false, &first));
    assert_int_equal(first.n, 16);
    snprintf(path, sizeof path, "%s/tests.csv", whole);
    test_done(brc_file_read_whole(test_context, path, 1 << 20, &text, &bytes));
    test_done(brc_file_make_folder(test_context, stopped));
    snprintf(path, sizeof path, "%s/tests.csv", stopped);
    test_done(brc_file_write_whole(test_context, path, text, bytes / 2 + 3));
    brc_memory_free(text);
    test_done(brc_strength_campaign(test_context, &two, stopped, true, &second));
    same_rows(&first, &second);
    test_done(brc_strength_campaign(test_context, &two, stopped, true, &third)); /* nothing left to do */
    same_rows(&first, &third);
    test_done(brc_file_read_whole(test_context, path, 1 << 20, &text, &bytes));
    int lines = 0;
    for (const char *c = text; *c; ++c)
        lines += *c == '\n';
    assert_int_equal(lines, 17);
    brc_memory_free(text);
    brc_strength_rows_free(&second);
    brc_strength_rows_free(&third);

    /* E_m and sigma_m scale out: the four tests of a sample differ in their strains only (1e-6 to 4e-5 at the peak),
     * which turn bonds by some of their own size. Where that changes the order of two breaks k jumps by what one of
     * 1400 bonds carries: 1e-3. The first failure knows no order. */
    for (int64_t k = 0; k < first.n; ++k)
        for (int64_t i = 0; i < k; ++i) {
            const brc_strength_row *a = &first.rows[i], *b = &first.rows[k];
            if (a->coordination != b->coordination || a->seed != b->seed) continue;
            assert_near(b->first / a->first, 1, 1e-4);
            assert_near(b->ratio / a->ratio, 1, 3e-3);
        }
    /* A peak lies above the first failure, and no sample carries more than its elements' limit. */
    for (int64_t k = 0; k < first.n; ++k)
        assert_true(first.rows[k].ratio > first.rows[k].first && first.rows[k].ratio < 1.2 &&
                    first.rows[k].n_broken > 0);
    brc_strength_rows_free(&first);
}

static void results_that_are_no_results_are_named(void **state)
{
    (void)state;
    char there[128], path[160];
    brc_strength_rows rows;
    brc_strength_plan plan = small_plan(1);
    char *text;
    size_t bytes;
    plan.samples.n_samples = plan.samples.n_coordinations = plan.samples.n_youngs = plan.n_limits = 1;
    snprintf(there, sizeof there, "%s/there", test_folder());
    test_done(brc_strength_campaign(test_context, &plan, there, false, &rows));
    brc_strength_rows_free(&rows);
    assert_int_equal(brc_strength_campaign(test_context, &plan, there, false, &rows), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "--resume goes on with it"));
    brc_context_clear(test_context);
    snprintf(path, sizeof path, "%s/tests.csv", there);
    test_done(brc_file_read_whole(test_context, path, 1 << 20, &text, &bytes));
    char *spoilt = malloc(bytes + 16);
    snprintf(spoilt, bytes + 16, "%sno result\n", text);
    test_done(brc_file_write_whole(test_context, path, spoilt, strlen(spoilt)));
    assert_int_equal(brc_strength_campaign(test_context, &plan, there, true, &rows), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "tests.csv:3: not a result"));
    brc_context_clear(test_context);
    free(spoilt);
    brc_memory_free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fit_of_eq_22_finds_the_printed_coefficients),
        cmocka_unit_test(the_surface_is_found_again),
        cmocka_unit_test(few_places_leave_eq_22_out),
        cmocka_unit_test(a_stopped_campaign_goes_on_to_the_same_results),
        cmocka_unit_test(results_that_are_no_results_are_named),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
