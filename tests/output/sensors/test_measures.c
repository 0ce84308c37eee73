#include "../support.h"
#include "../../../host/output/sensors/measures.h"
#include <math.h>
#include <stdlib.h>
#include <stdio.h>
#include <string.h>

/* Sensors: 0 force, 1 strain, 2 lateral, 3 signal. Two stages; samples made by hand. */
static brc_sensor sensors[] = {{.name = "force", .kind = BRC_SENSOR_REACTION},
                               {.name = "strain", .kind = BRC_SENSOR_FACE_STRAIN},
                               {.name = "lateral", .kind = BRC_SENSOR_FACE_STRAIN},
                               {.name = "signal", .kind = BRC_SENSOR_POINT}};
static brc_stage stages[] = {{.name = "pull"}, {.name = "ring"}};
static brc_material material = {.young = 2e9, .poisson = 0.25};

static brc_measured evaluate(const brc_measure *measure, const brc_domain *domain, const brc_history *history)
{
    brc_measured out;
    brc_measure copy = *measure;
    const brc_scene scene = {.n_sensors = 4,
                             .sensors = sensors,
                             .n_stages = 2,
                             .stages = stages,
                             .n_materials = 1,
                             .materials = &material,
                             .n_measures = 1,
                             .measures = &copy};
    assert_int_equal(brc_measure_evaluate(test_context, &scene, domain, history, NULL, 0, &out), BRC_OK);
    return out;
}

static brc_history *history_of_tension(void)
{
    brc_history *h;
    assert_int_equal(brc_history_create(test_context, 4, &h), BRC_OK);
    for (int k = 0; k <= 4; ++k) {
        const double e = 1e-3 * k;
        brc_history_add(test_context, h, 0, k, 0.25 * k, 0, (double[]){-2e9 * e * (1 + 1.5 * e), e, -0.25 * e, NAN});
    }
    for (int k = 0; k < 1001; ++k) { /* the last sample of the stage comes early */
        const double t = k < 1000 ? 1e-3 * k : 0.9993;
        brc_history_add(test_context, h, 1, k, t, t, (double[]){1, 2, 3, 5 + sin(2 * M_PI * 12.5 * t)});
    }
    return h;
}

static void the_modulus_is_force_over_the_flat_area_of_the_set(void **state)
{
    (void)state;
    brc_domain *domain = test_domain(200);
    brc_history *h = history_of_tension();
    brc_measured m = evaluate(&(brc_measure){.name = "E",
                                             .kind = BRC_MEASURE_E,
                                             .y = "force",
                                             .x = "strain",
                                             .area_set = "x-",
                                             .stage = "pull",
                                             .scale = -1},
                              domain, h);
    assert_true(fabs(m.value / 2e9 - 1) < 1e-10); /* wall area to 1e-12, fit to 1e-11 */
    assert_string_equal(m.unit, "Pa");
    assert_true(m.has_target && m.target == 2e9); /* of the only material */
    assert_true(fabs(m.error) < 1e-10);
    assert_int_equal(m.n_used, 5);
    brc_history_free(&h);
    brc_domain_free(&domain);
}

static void poissons_ratio_is_minus_the_slope_and_its_error_absolute(void **state)
{
    (void)state;
    brc_history *h = history_of_tension();
    const brc_measured m = evaluate(&(brc_measure){.name = "nu",
                                                   .kind = BRC_MEASURE_NU,
                                                   .y = "lateral",
                                                   .x = "strain",
                                                   .stage = "pull",
                                                   .scale = 1,
                                                   .has_target = true,
                                                   .target = 0.2},
                                    NULL, h);
    assert_true(fabs(m.value - 0.25) < 1e-12);
    assert_true(fabs(m.error - 0.05) < 1e-12);
    assert_string_equal(m.unit, "-");
    brc_history_free(&h);
}

static void a_frequency_leaves_out_the_early_last_sample(void **state)
{
    (void)state;
    brc_history *h = history_of_tension();
    const brc_measured m =
        evaluate(&(brc_measure){.name = "f", .kind = BRC_MEASURE_FREQUENCY, .y = "signal", .scale = 1}, NULL, h);
    assert_true(fabs(m.value / 12.5 - 1) < 1e-4);
    assert_string_equal(m.unit, "Hz");
    brc_history_free(&h);
}

static void peak_and_mean_look_at_their_window_alone(void **state)
{
    (void)state;
    brc_history *h = history_of_tension();
    brc_measure measure = {.name = "p", .kind = BRC_MEASURE_PEAK, .y = "force", .stage = "pull", .scale = 1};
    assert_true(fabs(evaluate(&measure, NULL, h).value + 2e9 * 4e-3 * 1.006) < 1e-3); /* rounding of 8e6 */
    measure.window[1] = 0.5;                                                          /* load factors; the end counts */
    assert_true(fabs(evaluate(&measure, NULL, h).value + 2e9 * 2e-3 * 1.003) < 1e-3);
    measure = (brc_measure){.name = "m", .kind = BRC_MEASURE_MEAN, .y = "strain", .stage = "pull", .scale = 10};
    assert_true(fabs(evaluate(&measure, NULL, h).value - 10 * 2e-3) < 1e-15);
    measure.window[0] = 0.5;
    measure.window[1] = 1;
    assert_true(fabs(evaluate(&measure, NULL, h).value - 10 * 3e-3) < 1e-15);
    brc_history_free(&h);
}

static void what_cannot_be_measured_says_why(void **state)
{
    (void)state;
    brc_history *h = history_of_tension();
    brc_measured m =
        evaluate(&(brc_measure){.name = "a", .kind = BRC_MEASURE_MEAN, .y = "nothing", .scale = 1}, NULL, h);
    assert_true(isnan(m.value));
    assert_non_null(strstr(m.why_not, "no sensor \"nothing\""));
    m = evaluate(&(brc_measure){.name = "a", .kind = BRC_MEASURE_MEAN, .y = "signal", .stage = "pull", .scale = 1},
                 NULL, h);
    assert_non_null(strstr(m.why_not, "no sample"));
    m = evaluate(&(brc_measure){.name = "a", .kind = BRC_MEASURE_SLOPE, .y = "force", .x = "lateral", .scale = 1}, NULL,
                 h);
    assert_true(isnan(m.value)); /* constant over the last stage */
    assert_non_null(strstr(m.why_not, "two different values of \"lateral\""));
    m = evaluate(&(brc_measure){.name = "a", .kind = BRC_MEASURE_FREQUENCY, .y = "force", .stage = "pull", .scale = 1},
                 NULL, h);
    assert_true(isnan(m.value) && m.why_not[0]);
    m = evaluate(
        &(brc_measure){.name = "E", .kind = BRC_MEASURE_E, .y = "force", .x = "strain", .area_set = "x-", .scale = 1},
        NULL, h);
    assert_non_null(strstr(m.why_not, "\"x-\" is not a face set"));
    brc_domain *domain = test_domain(200);
    brc_set *set = domain->sets + brc_domain_find_set(domain, "x-"), was = *set;
    int32_t *all = calloc((size_t)domain->n_free_faces, sizeof *all);
    for (int32_t f = 0; f < domain->n_free_faces; ++f)
        all[f] = f;
    set->members = all,
    set->n_members = domain->n_free_faces; /* the whole surface, whose area vectors sum to rounding */
    m = evaluate(&(brc_measure){.name = "E",
                                .kind = BRC_MEASURE_E,
                                .y = "force",
                                .x = "strain",
                                .area_set = "x-",
                                .stage = "pull",
                                .scale = 1},
                 domain, h);
    assert_true(isnan(m.value) && strstr(m.why_not, "all the way round"));
    *set = was;
    free(all);
    brc_domain_free(&domain);
    brc_history_free(&h);
}

/* A straight line with a kink outside of the window, by hand; a break half way between two samples. */
static void a_rate_is_a_line_through_the_window(void **state)
{
    (void)state;
    brc_history *h;
    assert_int_equal(brc_history_create(test_context, 4, &h), BRC_OK);
    for (int k = 0; k <= 10; ++k)
        brc_history_add(test_context, h, 1, k, k, 100 + k,
                        (double[]){k < 8 ? 3 * k + (k % 2 ? 1e-3 : -1e-3) : 100, 0, 0, NAN});
    brc_measured m = evaluate(
        &(brc_measure){
            .name = "v", .kind = BRC_MEASURE_RATE, .y = "force", .stage = "ring", .scale = 2, .window = {0, 7}},
        NULL, h);
    /* alternating +-1e-3 on 8 points: least squares gives 1e-3 * 4 / 42 of slope */
    assert_true(fabs(m.value - 2 * (3 + 4e-3 / 42)) < 1e-12);
    m = evaluate(
        &(brc_measure){
            .name = "v", .kind = BRC_MEASURE_RATE, .y = "force", .stage = "ring", .scale = 1, .window = {2.5, 3.5}},
        NULL, h);
    assert_true(isnan(m.value) && strstr(m.why_not, "two times"));
    brc_history_free(&h);
}

/* Level 2 on a peak of -8: half of the rise, two whole intervals, three quarters of the passage through zero (6 of 16
 * on each side) and of the way back. */
static void a_duration_counts_what_lies_above_its_share_of_the_peak(void **state)
{
    (void)state;
    brc_history *h;
    assert_int_equal(brc_history_create(test_context, 4, &h), BRC_OK);
    for (int k = 0; k < 7; ++k)
        brc_history_add(test_context, h, 1, k, 2 * k, 2 * k,
                        (double[]){(double[]){0, -4, -8, -8, 8, 0, 0}[k], 0, 0, NAN});
    brc_measure measure = {
        .name = "d", .kind = BRC_MEASURE_DURATION, .y = "force", .stage = "ring", .scale = 3, .above = 0.25};
    const brc_measured m = evaluate(&measure, NULL, h);
    assert_true(fabs(m.value - 3 * 2 * (0.5 + 1 + 1 + 0.75 + 0.75)) < 1e-14);
    assert_string_equal(m.unit, "s");
    snprintf(measure.y, sizeof measure.y, "lateral"); /* which stays 0 */
    assert_true(evaluate(&measure, NULL, h).value == 0);
    brc_history_free(&h);
}

/* Within 2 of the first value, -8: half of the interval to -4 and of that back, 2 of 3 on the way to -11, and from
 * there to -1 what lies between -10 and -6, 4 of 10. */
static void a_duration_counts_what_lies_within_a_share_of_the_first_value(void **state)
{
    (void)state;
    brc_history *h;
    assert_int_equal(brc_history_create(test_context, 4, &h), BRC_OK);
    for (int k = 0; k < 5; ++k)
        brc_history_add(test_context, h, 1, k, 2 * k, 2 * k,
                        (double[]){(double[]){-8, -4, -8, -11, -1}[k], 1.0 * (k > 1), 0, NAN});
    brc_measure measure = {
        .name = "d", .kind = BRC_MEASURE_DURATION, .y = "force", .stage = "ring", .scale = 3, .within = 0.25};
    assert_true(fabs(evaluate(&measure, NULL, h).value - 3 * 2 * (0.5 + 0.5 + 2.0 / 3 + 0.4)) < 1e-14);
    snprintf(measure.y, sizeof measure.y, "lateral"); /* which is 0 at first, and then not */
    assert_non_null(strstr(evaluate(&measure, NULL, h).why_not, "first value is 0"));
    brc_history_free(&h);
}

static void the_first_break_is_met_between_samples(void **state)
{
    (void)state;
    brc_measure measure = {.name = "s", .kind = BRC_MEASURE_AT_FIRST_BREAK, .y = "force", .stage = "ring", .scale = 1};
    const brc_break breaks[] = {{.stage = 0, .load = 0.25}, {.stage = 1, .time = 102.25}, {.stage = 1, .time = 107.5}};
    const brc_cracks cracks = {.n_broken = 3, .breaks = breaks};
    brc_stage two[2] = {{.name = "pull", .solver = BRC_SOLVER_STATIC}, {.name = "ring", .solver = BRC_SOLVER_DYNAMIC}};
    const brc_scene scene = {.n_sensors = 4,
                             .sensors = sensors,
                             .n_stages = 2,
                             .stages = two,
                             .n_materials = 1,
                             .materials = &material,
                             .n_measures = 1,
                             .measures = &measure};
    brc_measured m;
    brc_history *h;
    assert_int_equal(brc_history_create(test_context, 4, &h), BRC_OK);
    /* events of a static stage, the second at a lower load: time is the load factor */
    brc_history_add(test_context, h, 0, 0, 0, 100, (double[]){0, 0, 0, NAN});
    brc_history_add(test_context, h, 0, 0, 0.25, 100, (double[]){50, 0, 0, NAN});
    brc_history_add(test_context, h, 0, 1, 0.2, 100, (double[]){30, 0, 0, NAN});
    for (int k = 0; k <= 10; ++k)
        brc_history_add(test_context, h, 1, k, k, 100 + k, (double[]){k * k, 0, 0, NAN});
    assert_int_equal(brc_measure_evaluate(test_context, &scene, NULL, h, &cracks, 0, &m), BRC_OK);
    assert_true(fabs(m.value - (4 + 0.25 * 5)) < 1e-12);
    measure.window[0] = 3, measure.window[1] = 9; /* the first break of the window */
    assert_int_equal(brc_measure_evaluate(test_context, &scene, NULL, h, &cracks, 0, &m), BRC_OK);
    assert_true(fabs(m.value - (49 + 0.5 * 15)) < 1e-12);
    measure = (brc_measure){.name = "s", .kind = BRC_MEASURE_AT_FIRST_BREAK, .y = "force", .stage = "pull", .scale = 1};
    assert_int_equal(brc_measure_evaluate(test_context, &scene, NULL, h, &cracks, 0, &m), BRC_OK);
    assert_true(m.value == 50);
    assert_int_equal(brc_measure_evaluate(test_context, &scene, NULL, h, NULL, 0, &m), BRC_OK);
    assert_true(isnan(m.value) && strstr(m.why_not, "no bond broke"));
    brc_history_free(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rate_is_a_line_through_the_window),
        cmocka_unit_test(the_first_break_is_met_between_samples),
        cmocka_unit_test(a_duration_counts_what_lies_above_its_share_of_the_peak),
        cmocka_unit_test(a_duration_counts_what_lies_within_a_share_of_the_first_value),
        cmocka_unit_test(the_modulus_is_force_over_the_flat_area_of_the_set),
        cmocka_unit_test(poissons_ratio_is_minus_the_slope_and_its_error_absolute),
        cmocka_unit_test(a_frequency_leaves_out_the_early_last_sample),
        cmocka_unit_test(peak_and_mean_look_at_their_window_alone),
        cmocka_unit_test(what_cannot_be_measured_says_why),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
