/* Studies: the file, the values of runs, and the laws they are held against. */
#include "support.h"
#include "../../host/commands/study.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static brc_status read_text(brc_context *context, const char *text, brc_study **out)
{
    char path[] = "study-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0 && write(file, text, strlen(text)) == (ssize_t)strlen(text));
    close(file);
    const brc_status status = brc_study_read(context, path, out);
    unlink(path);
    return status;
}

static void the_last_key_changes_fastest(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_study *study;
    char value[64];
    assert_int_equal(read_text(context, "scene: a.yaml\nvary:\n  - {key: x, values: [1 mm, 2 mm]}\n  - {key: seed, from: 3, to: 5}\nfit: [{power: m, by: x}]\n", &study), BRC_OK);
    assert_true(study->n_runs == 6 && study->n_fits == 1 && study->fits[0].power);
    assert_string_equal(study->scene, "a.yaml");
    static const char *const expected[6][2] = {{"1 mm", "3"}, {"1 mm", "4"}, {"1 mm", "5"}, {"2 mm", "3"}, {"2 mm", "4"}, {"2 mm", "5"}};
    for (int run = 0; run < 6; ++run)
        for (int k = 0; k < 2; ++k) assert_string_equal(brc_study_value(study, run, k, value, sizeof value), expected[run][k]);
    brc_study_free(&study);
    brc_context_free(&context);
}

static void draws_have_their_distribution_and_their_seed(void **state)
{
    (void)state;
    enum { N = 4000 };
    brc_context *context = brc_context_create();
    brc_study *study, *other;
    char value[64], again[64];
    double sum[2] = {0}, square[2] = {0};
    static const char text[] = "scene: a.yaml\nvary: [{key: x, uniform: [2, 4], unit: GPa}, {key: y, normal: [10, 2]}]\ndraws: 4000\nseed: %d\n";
    char seven[160], eight[160];
    snprintf(seven, sizeof seven, text, 7);
    snprintf(eight, sizeof eight, text, 8);
    assert_int_equal(read_text(context, seven, &study), BRC_OK);
    assert_int_equal(read_text(context, eight, &other), BRC_OK);
    for (int run = 0; run < N; ++run)
        for (int k = 0; k < 2; ++k) {
            char *end;
            const double x = strtod(brc_study_value(study, run, k, value, sizeof value), &end);
            assert_string_equal(end, k ? "" : " GPa");
            assert_true(k || (x > 2 && x < 4));
            assert_string_equal(brc_study_value(study, run, k, again, sizeof again), value);
            assert_string_not_equal(brc_study_value(other, run, k, again, sizeof again), value);
            sum[k] += x / N;
            square[k] += x * x / N;
        }
    assert_true(fabs(sum[0] - 3) < 0.04 && fabs(sum[1] - 10) < 0.13); /* four standard errors */
    assert_true(fabs(sqrt(square[0] - sum[0] * sum[0]) - 2 / sqrt(12)) < 0.02 && fabs(sqrt(square[1] - sum[1] * sum[1]) - 2) < 0.09);
    brc_study_free(&study);
    brc_study_free(&other);
    brc_context_free(&context);
}

static void keys_together_change_in_step(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_study *study;
    char value[64];
    static const char *const text = "scene: a.yaml\ntogether: true\nvary:\n  - {key: x, values: [1 mm, 2 mm, 4 mm]}\n  - {key: seed, from: 7, to: 9}\n"
                                    "  - {key: E, uniform: [1, 2], unit: GPa}\ndraws: 2\n";
    assert_int_equal(read_text(context, text, &study), BRC_OK);
    assert_int_equal(study->n_runs, 6);
    static const char *const expected[6][2] = {{"1 mm", "7"}, {"1 mm", "7"}, {"2 mm", "8"}, {"2 mm", "8"}, {"4 mm", "9"}, {"4 mm", "9"}};
    for (int run = 0; run < 6; ++run)
        for (int k = 0; k < 2; ++k) assert_string_equal(brc_study_value(study, run, k, value, sizeof value), expected[run][k]);
    brc_study_free(&study);
    brc_context_free(&context);
}

static void what_is_wrong_is_told_with_its_place(void **state)
{
    (void)state;
    static const struct {
        const char *text, *told;
    } wrong[] = {{"scene: a.yaml\nvary: [{key: x}]\n", ":2:8: error: found a map, expected a map with `key` and one of"},
                 {"scene: a.yaml\nvary: [{key: x, uniform: [1, 2]}]\n", "`draws` with keys"},
                 {"scene: a.yaml\nvary: [{key: x, values: [1]}]\ndraws: 3\n", "`draws` with keys"},
                 {"vary: [{key: x, values: [1]}]\n", "`scene: FILE`"},
                 {"scene: a.yaml\ntogether: true\nvary: [{key: x, values: [1, 2]}, {key: y, values: [1, 2, 3]}]\n", "as many values in each key"},
                 {"scene: a.yaml\nvary: [{key: x, from: 5, to: 2}]\n", "`to` of at least `from`"},
                 {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nfit: [{power: m, by: y}]\n", "by: found 'y', expected a key of `vary`"},
                 {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nseeds: 1\n", ":3:1: error: unknown key 'seeds'"}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        brc_context *context = brc_context_create();
        brc_study *study;
        assert_int_equal(read_text(context, wrong[k].text, &study), BRC_BAD_INPUT);
        assert_null(study);
        if (!strstr(brc_context_message(context), wrong[k].told)) fail_msg("%s instead of %s", brc_context_message(context), wrong[k].told);
        brc_context_free(&context);
    }
}

/* Quantiles of a Weibull law of modulus 8 and scale 50: its own parameters come back, to what so many quantiles leave. */
static void weibulls_law_is_found(void **state)
{
    (void)state;
    enum { N = 4001 };
    static double x[N];
    double modulus, scale;
    for (int i = 0; i < N; ++i) x[i] = 50 * pow(-log(1 - (i + 0.5) / N), 1.0 / 8);
    assert_true(brc_study_weibull(N, x, &modulus, &scale));
    assert_true(fabs(modulus / 8 - 1) < 2e-3 && fabs(scale / 50 - 1) < 2e-4);
    const double equal[3] = {1, 1, 1}, negative[2] = {-1, 1};
    assert_true(!brc_study_weibull(3, equal, &modulus, &scale) && !brc_study_weibull(2, negative, &modulus, &scale) && !brc_study_weibull(1, x, &modulus, &scale));
}

static void a_power_law_is_found_with_its_error(void **state)
{
    (void)state;
    double x[4] = {1, 2, 4, 8}, y[4], a, b, error;
    for (int i = 0; i < 4; ++i) y[i] = 3 * pow(x[i], -0.25);
    assert_true(brc_study_power(4, x, y, &a, &b, &error));
    assert_true(fabs(a - 3) < 1e-12 && fabs(b + 0.25) < 1e-12 && error < 1e-12);
    y[3] *= exp(0.1); /* residuals of one point off by d among four at equal distances h: b moves by 0.3 d / h, the sum of squares is 0.3 d^2 */
    assert_true(brc_study_power(4, x, y, &a, &b, &error));
    assert_true(fabs(b + 0.25 - 0.03 / log(2)) < 1e-12 && fabs(error - sqrt(0.003 / 2 / (5 * log(2) * log(2)))) < 1e-12);
    assert_true(brc_study_power(2, x, y, &a, &b, &error) && isnan(error));
    x[1] = x[2] = x[3] = 1;
    assert_true(!brc_study_power(4, x, y, &a, &b, &error));
    assert_true(fabs(brc_study_student(30) / 2.0423 - 1) < 2e-3 && brc_study_student(1) == 12.706 && isnan(brc_study_student(0)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_key_changes_fastest),        cmocka_unit_test(draws_have_their_distribution_and_their_seed),
        cmocka_unit_test(keys_together_change_in_step), cmocka_unit_test(what_is_wrong_is_told_with_its_place), cmocka_unit_test(weibulls_law_is_found),
        cmocka_unit_test(a_power_law_is_found_with_its_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
