#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "../../bench/accuracy_report.h"
#include "../../bench/accuracy_study.h"
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"

static void add(brc_accuracy_points *points, const char *model, int64_t elements, double spacing, double error,
                double seconds)
{
    brc_accuracy_point p = brc_accuracy_point_empty();
    strcpy(p.problem, "cube");
    snprintf(p.run, sizeof p.run, "%s-%lld-%lld", model, (long long)elements, (long long)points->n);
    strcpy(p.quantity, "rms");
    strcpy(p.model, model);
    strcpy(p.preparation, "lloyd-5");
    strcpy(p.precision, "double");
    strcpy(p.cost_of, "building and running");
    p.nu = 0.2;
    p.dt_fraction = 0.8;
    p.elements = elements;
    p.bonds = 7 * elements;
    p.spacing_over_length = spacing;
    p.error = error;
    p.seconds = seconds;
    assert_int_equal(brc_accuracy_points_add(points, &p), BRC_OK);
}

static brc_accuracy_points second_order(brc_context *context)
{
    brc_accuracy_points points = {.context = context};
    add(&points, "dlsm", 125, 0.2, 0.04, 1);
    add(&points, "dlsm", 1000, 0.1, 0.01, 16);
    add(&points, "dlsm", 8000, 0.05, 0.0025, 256);
    add(&points, "dlsm-published", 125, 0.2, 0.08, 0.5);
    add(&points, "dlsm-published", 1000, 0.1, 0.04, 8);
    add(&points, "dlsm-published", 8000, 0.05, 0.02, 128);
    return points;
}

static void points_come_back_from_their_file_to_the_last_bit(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_accuracy_points points = second_order(context), again = {.context = context};
    points.items[0].phi = 1.0 / 3;
    points.items[1].error = NAN;
    strcpy(points.items[1].note, "stopped");
    char path[] = "accuracy-test-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    assert_int_equal(brc_accuracy_points_write(&points, path), BRC_OK);
    assert_int_equal(brc_accuracy_points_read(&again, path), BRC_OK);
    unlink(path);
    assert_int_equal(again.n, points.n);
    for (int64_t k = 0; k < points.n; ++k) {
        assert_string_equal(again.items[k].run, points.items[k].run);
        assert_string_equal(again.items[k].note, points.items[k].note);
        assert_true(again.items[k].elements == points.items[k].elements &&
                    again.items[k].seconds == points.items[k].seconds);
    }
    assert_true(again.items[0].phi == 1.0 / 3 && isnan(again.items[2].phi) && isnan(again.items[1].error));
    assert_non_null(brc_accuracy_points_find(&again, "cube", points.items[3].run));
    assert_null(brc_accuracy_points_find(&again, "sphere", points.items[3].run));
    brc_accuracy_points_free(&points);
    brc_accuracy_points_free(&again);
    brc_context_free(&context);
}

/* Refused with the line; nothing of a torn file is taken for a figure. */
static void a_file_that_is_none_of_ours_is_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {"problem,run,error\ncube,a,1e-3\ncube,b\n", "problem,run,error\ncube,a,1e-3x\n",
                                        "a,b\n1,2\n", ""};
    static const char *const said[] = {":3: ", "'1e-3x' is no value of the column error", "no problem or no run",
                                       "empty"};
    char path[] = "accuracy-test-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    for (int k = 0; k < 4; ++k) {
        brc_context *context = brc_context_create();
        brc_accuracy_points points = {.context = context};
        assert_int_equal(brc_file_write_whole(context, path, texts[k], strlen(texts[k])), BRC_OK);
        assert_int_equal(brc_accuracy_points_read(&points, path), BRC_BAD_INPUT);
        assert_non_null(strstr(brc_context_message(context), said[k]));
        brc_accuracy_points_free(&points);
        brc_context_free(&context);
    }
    unlink(path);
}

static void orders_are_slopes_of_the_logarithms(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_accuracy_points points = second_order(context);
    brc_accuracy_study *study;
    assert_int_equal(brc_accuracy_study_create(context, &points, &study), BRC_OK);
    assert_int_equal(study->n_questions, 1);
    assert_int_equal(study->n_series, 2);
    assert_true(fabs(study->series[0].order - 2) < 1e-12); /* rounding of four logarithms */
    assert_true(fabs(study->series[1].order - 1) < 1e-12);
    brc_accuracy_study_free(&study);
    brc_accuracy_points_free(&points);
    brc_context_free(&context);
}

/* Only what is beaten in both leaves the front: the published law's cheapest point stays, its others do not. */
static void the_front_is_what_nothing_beats(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_accuracy_points points = second_order(context);
    add(&points, "dlsm", 1331, 0.0909, 0.012, 17); /* dearer and worse than 1000 elements */
    brc_accuracy_study *study;
    assert_int_equal(brc_accuracy_study_create(context, &points, &study), BRC_OK);
    int n_front = 0;
    for (int64_t m = 0; m < study->n_means; ++m) {
        const brc_accuracy_point *p = study->means[m].point;
        n_front += study->means[m].front;
        if (p->elements == 1331 || (strcmp(p->model, "dlsm-published") == 0 && p->elements > 125))
            assert_false(study->means[m].front);
    }
    assert_int_equal(n_front, 4);
    brc_accuracy_study_free(&study);
    brc_accuracy_points_free(&points);
    brc_context_free(&context);
}

/* Second order in space at a cost of h^-4: cost goes with error^-2; first order: error^-4. */
static void cost_at_an_error_lies_on_the_front(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_accuracy_points points = second_order(context);
    brc_accuracy_study *study;
    int beyond;
    assert_int_equal(brc_accuracy_study_create(context, &points, &study), BRC_OK);
    assert_true(fabs(brc_accuracy_cost(study, 0, "dlsm", 0.02, &beyond) / 4 - 1) < 1e-12 && beyond == 0);
    assert_true(fabs(brc_accuracy_cost(study, 0, "dlsm-published", 0.02, &beyond) / 128 - 1) < 1e-12 && beyond == 0);
    assert_true(brc_accuracy_cost(study, 0, "dlsm", 0.1, &beyond) == 1 && beyond == 1);
    assert_true(isnan(brc_accuracy_cost(study, 0, "dlsm", 0.001, &beyond)) && beyond == -1);
    assert_true(fabs(brc_accuracy_cost_beyond(study, 0, "dlsm", 0.00125) / 1024 - 1) < 1e-12);
    assert_true(fabs(brc_accuracy_cost_beyond(study, 0, "dlsm-published", 0.01) / 2048 - 1) < 1e-12);
    const int64_t best = brc_accuracy_cheapest(study, 0, NULL, 0.04);
    assert_true(best >= 0 && study->means[best].cost_s == 1);
    assert_int_equal(brc_accuracy_cheapest(study, 0, NULL, 1e-4), -1);
    brc_accuracy_study_free(&study);
    brc_accuracy_points_free(&points);
    brc_context_free(&context);
}

static void seeds_of_one_resolution_are_one_mean(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_accuracy_points points = {.context = context};
    add(&points, "dlsm", 1000, 0.1, 0.03, 10);
    add(&points, "dlsm", 1003, 0.0999, 0.04, 12);
    add(&points, "dlsm", 1000, 0.1, NAN, 1e9); /* a run that failed */
    brc_accuracy_study *study;
    assert_int_equal(brc_accuracy_study_create(context, &points, &study), BRC_OK);
    assert_int_equal(study->n_means, 1);
    assert_int_equal(study->means[0].n, 2);
    assert_true(fabs(study->means[0].error - sqrt((9e-4 + 16e-4) / 2)) < 1e-15 &&
                fabs(study->means[0].cost_s - 11) < 1e-12);
    assert_true(isnan(study->series[0].order));
    brc_accuracy_study_free(&study);
    brc_accuracy_points_free(&points);
    brc_context_free(&context);
}

/* A size between coarser and finer ones that is right because its error changes sign: it counts as what the finer ones
 * show. */
static void an_error_that_changes_sign_is_no_bargain(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_accuracy_points points = {.context = context};
    add(&points, "dlsm", 125, 0.2, 0.001, 1);
    add(&points, "dlsm", 1000, 0.1, 0.015, 16);
    add(&points, "dlsm", 8000, 0.05, 0.005, 256);
    brc_accuracy_study *study;
    assert_int_equal(brc_accuracy_study_create(context, &points, &study), BRC_OK);
    const int64_t best = brc_accuracy_cheapest(study, 0, "dlsm", 0.01);
    assert_true(best >= 0 && study->means[best].cost_s == 256);
    assert_true(study->means[0].error == 0.001 && study->means[0].sure == 0.015 && study->means[2].sure == 0.005);
    brc_accuracy_study_free(&study);
    brc_accuracy_points_free(&points);
    brc_context_free(&context);
}

/* Equal error 2 %: 4 s against 128 s, a ratio of 32; to 1 % the published law's front is drawn on (2048 s against
 * 16). */
static void the_report_says_what_other_models_cost(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR); /* gnuplot may be missing */
    brc_accuracy_points points = second_order(context);
    brc_accuracy_study *study;
    char folder[] = "accuracy-test-XXXXXX", path[64], *text;
    size_t bytes;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(brc_accuracy_study_create(context, &points, &study), BRC_OK);
    assert_int_equal(brc_accuracy_report_write(context, study, folder), BRC_OK);
    snprintf(path, sizeof path, "%s/accuracy.md", folder);
    assert_int_equal(brc_file_read_whole(context, path, 100000, &text, &bytes), BRC_OK);
    assert_non_null(strstr(text, " 32 | ~1.3e+02 |"));
    assert_non_null(
        strstr(text, "| cube, nu 0.2 | 1 % | dlsm, lloyd-5, 1000 elements | 1 % | building and running | 16 |"));
    assert_non_null(strstr(text, "| cube, nu 0.2 | 0.1 % | not reached; finer dlsm |"));
    snprintf(path, sizeof path, "rm -r %s", folder);
    assert_int_equal(system(path), 0);
    brc_memory_free(text);
    brc_accuracy_study_free(&study);
    brc_accuracy_points_free(&points);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_come_back_from_their_file_to_the_last_bit),
        cmocka_unit_test(a_file_that_is_none_of_ours_is_refused),
        cmocka_unit_test(orders_are_slopes_of_the_logarithms),
        cmocka_unit_test(the_front_is_what_nothing_beats),
        cmocka_unit_test(cost_at_an_error_lies_on_the_front),
        cmocka_unit_test(seeds_of_one_resolution_are_one_mean),
        cmocka_unit_test(an_error_that_changes_sign_is_no_bargain),
        cmocka_unit_test(the_report_says_what_other_models_cost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
