#include "../support.h"
#include "../../../host/commands/reproduce/reproduce_fragments.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A made-up campaign of three runs: q = 5 + 3 h^2 at h = 1/2, 1/4, 1/8; the last one may be missing. */
typedef struct made {
    brc_case_run runs[3];
    brc_case what;
    brc_outcome outcomes[3];
    brc_campaign campaign;
    double displacement[2][6];
} made;

static made *make(void)
{
    static made m; /* large */
    static const char *const names[] = {"a", "b", "c"};
    memset(&m, 0, sizeof m);
    for (int k = 0; k < 3; ++k) {
        const double h = pow(0.5, k + 1);
        m.runs[k].name = names[k];
        m.outcomes[k].run = &m.runs[k];
        m.outcomes[k].done = true;
        m.outcomes[k].n_elements = (int64_t)lround(1 / (h * h * h));
        brc_outcome_add(&m.outcomes[k], "q", "m", 5 + 3 * h * h, NAN);
        brc_outcome_add(&m.outcomes[k], "time_step", "s", h * h, NAN);
    }
    m.what = (brc_case){.name = "made", .n_runs = 3, .runs = m.runs};
    m.campaign = (brc_campaign){.what = &m.what, .outcomes = m.outcomes};
    return &m;
}

static double derive(const made *m, brc_case_formula formula, const char *against, double origin, int n_runs,
                     char *note)
{
    const brc_case_derived derived = {.formula = formula,
                                      .of = "q",
                                      .against = against,
                                      .origin = origin,
                                      .n_runs = n_runs,
                                      .runs = {"a", "b", "c", "a"}};
    return brc_derived_value(&m->campaign, &derived, note, 200);
}

static void order_is_the_slope_against_spacing_or_another_quantity(void **state)
{
    (void)state;
    char note[200];
    const made *m = make();
    assert_near(derive(m, BRC_CASE_ORDER, "spacing", 5, 3, note), 2, 1e-12);
    assert_near(derive(m, BRC_CASE_ORDER, "time_step", 5, 3, note), 1, 1e-12);
}

/* 5.75, 5.1875, 5.046875 at the labels 10, 20, 40 pass 5.1 where the second part has 0.0875 of its fall of 0.140625. */
static void crossing_is_where_a_quantity_passes_a_value_along_a_label(void **state)
{
    (void)state;
    char note[200];
    made *m = make();
    static const char *const speeds[] = {"10 m/s", "20 m/s", "40 m/s"};
    for (int k = 0; k < 3; ++k) {
        m->runs[k].labels[0] = (brc_case_pair){"speed", speeds[k]};
        m->runs[k].n_labels = 1;
    }
    assert_near(derive(m, BRC_CASE_CROSSING, "speed", 5.1, 3, note), 20 + 20 * 0.0875 / 0.140625, 1e-12);
    assert_true(isnan(derive(m, BRC_CASE_CROSSING, "speed", 4, 3, note)));
    assert_true(isnan(brc_outcome_label(&m->outcomes[0], "cells")));
}

/* Masses at the middles of equal parts of m^-tau between 1 and 100 have its exponent, but for what quantiles are off
 * the mean: a share 1 / (24 n^2) of the curvature of ln m over them. */
static void the_exponent_of_masses_is_that_they_were_drawn_with(void **state)
{
    (void)state;
    enum { N = 4000 };
    static double mass[N + 2];
    static const double taus[] = {0.5, 1, 1.7, 2.3, 4};
    for (size_t t = 0; t < sizeof taus / sizeof *taus; ++t) {
        const double a = 1 - taus[t];
        int64_t n;
        double error;
        for (int k = 0; k < N; ++k) {
            const double p = (k + 0.5) / N;
            mass[k] = a == 0 ? pow(100, p) : pow(1 + p * (pow(100, a) - 1), 1 / a);
        }
        mass[N] = 0.5, mass[N + 1] = 200; /* outside */
        assert_near(brc_fragments_exponent(N + 2, mass, 1, 100, &n, &error), taus[t], 1e-3);
        assert_int_equal(n, N);
        assert_true(error > 0.2 / sqrt(N) && error < 5 / sqrt(N)); /* ln m scatters by 0.3 (tau 4) to 1.3 */
        double half;
        for (int k = 0; k < N / 4; ++k)
            mass[k] = mass[4 * k + 2];
        brc_fragments_exponent(N / 4, mass, 1, 100, &n, &half);
        assert_near(half / error, 2, 0.05); /* a quarter of them is twice as uncertain */
    }
    int64_t n;
    double error;
    const double same[] = {2, 2, 2};
    assert_true(isnan(brc_fragments_exponent(3, same, 1, 100, &n, &error)));
}

static void mean_and_worst_are_over_the_runs_named(void **state)
{
    (void)state;
    char note[200];
    const made *m = make();
    assert_near(derive(m, BRC_CASE_MEAN, "spacing", 0, 2, note), 5 + 3 * (0.25 + 0.0625) / 2, 1e-12);
    assert_near(derive(m, BRC_CASE_WORST, "spacing", 0, 3, note), 5.75, 1e-12);
}

static void ratio_is_of_magnitudes_of_means_of_halves(void **state)
{
    (void)state;
    char note[200];
    made *m = make();
    m->outcomes[0].values[0].value = -2;
    m->outcomes[1].values[0].value = 8;
    assert_near(derive(m, BRC_CASE_RATIO, "spacing", 0, 2, note), 0.25, 1e-15);
    assert_true(isnan(derive(m, BRC_CASE_RATIO, "spacing", 0, 3, note)));
    m->outcomes[2].values[0].value = -4;
    assert_near(derive(m, BRC_CASE_RATIO, "spacing", 0, 4, note), 1, 1e-15); /* (-2 + 8) / (-4 - 2) */
    m->outcomes[1].values[0].value = 0;
    assert_true(isnan(derive(m, BRC_CASE_RATIO, "spacing", 0, 2, note)));
}

static void difference_is_largest_over_largest(void **state)
{
    (void)state;
    char note[200];
    made *m = make();
    for (int k = 0; k < 2; ++k) {
        m->outcomes[k].n_elements = 2;
        m->outcomes[k].displacement = m->displacement[k];
    }
    m->displacement[0][4] = 4;
    m->displacement[1][4] = 4;
    m->displacement[1][1] = -1;
    assert_near(derive(m, BRC_CASE_DIFFERENCE, "spacing", 0, 2, note), 0.25, 1e-15);
    m->outcomes[1].displacement = NULL;
    assert_true(isnan(derive(m, BRC_CASE_DIFFERENCE, "spacing", 0, 2, note)));
}

static void a_missing_run_gives_no_value_and_a_reason(void **state)
{
    (void)state;
    char note[200];
    made *m = make();
    m->outcomes[2].done = false;
    m->outcomes[2].skipped = true;
    snprintf(m->outcomes[2].note, sizeof m->outcomes[2].note, "no device");
    assert_true(isnan(derive(m, BRC_CASE_ORDER, "spacing", 5, 3, note)));
    assert_string_equal(note, "skipped: no device");
}

/* Two small cases in a folder: equal but for their bounds. */
static int reproduce(const char *bound)
{
    char command[2048];
    snprintf(
        command, sizeof command,
        "rm -rf made-cases && mkdir -p made-cases/one && cat > made-cases/one/case.yaml <<'X'\n"
        "title: One\nruns:\n  - {name: r, rows: {energy: {reference: 1 J, %s}, seconds: {unit: s}}}\nX\n"
        "cat > made-cases/one/scene.yaml <<'X'\n"
        "version: 1\nmaterials: {m: {E: 20 GPa, nu: 0.3, density: 1000 kg/m^3}}\n"
        "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 27}}}]\n"
        "stages: [{name: pull, solver: {dynamic: {steps: 10}}, initial: [{affine: {gradient: {x: [1e-4, 0, 0]}}}]}]\n"
        "sensors: {total: {energy: total}, error: {energy: closure}}\n"
        "measure: {energy: {mean: {of: total}}, closure: {peak: {of: error}}}\n"
        "output: {frames: none, picture: false}\nX\n",
        bound);
    assert_int_equal(system(command), 0);
    return test_program("reproduce one --folder made-cases --threads 1 --device cpu -o made-cases/out");
}

static void a_missed_bound_ends_with_one_and_a_kept_one_with_zero(void **state)
{
    (void)state;
    assert_int_equal(reproduce("bound: 1e-9"), 1); /* the energy is about 135 J */
    assert_non_null(strstr(test_program_stdout(), "MISSED"));
    assert_non_null(strstr(test_program_stderr(), "one: 1 row(s) missed their bound"));
    assert_int_equal(reproduce("bound: 1e9"), 0);
    assert_non_null(strstr(test_program_stdout(), "1 of 1 bounded rows within their bounds"));
    assert_int_equal(reproduce("at_least: 1 J"), 0);
    assert_int_equal(reproduce("at_most: 1 J"), 1);
    assert_int_equal(system("grep -q '\"verdict\": \"missed\"' made-cases/out/rows.json"), 0);
    assert_int_equal(system("rm -r made-cases"), 0);
}

/* A measure by the name of a value that every run has stands in its place, over seeds too. */
static void a_measure_goes_before_a_value_of_its_name(void **state)
{
    (void)state;
    assert_int_equal(reproduce("bound: 1e9}}}\n  - {name: s, seeds: 2, rows: {closure: {at_most: 1}, "
                               "energy: {reference: 1 J, bound: 1e9"),
                     0);
    assert_non_null(strstr(test_program_stdout(), "3 of 3 bounded rows within their bounds"));
    assert_int_equal(system("rm -r made-cases"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_is_the_slope_against_spacing_or_another_quantity),
        cmocka_unit_test(crossing_is_where_a_quantity_passes_a_value_along_a_label),
        cmocka_unit_test(the_exponent_of_masses_is_that_they_were_drawn_with),
        cmocka_unit_test(mean_and_worst_are_over_the_runs_named),
        cmocka_unit_test(ratio_is_of_magnitudes_of_means_of_halves),
        cmocka_unit_test(difference_is_largest_over_largest),
        cmocka_unit_test(a_missing_run_gives_no_value_and_a_reason),
        cmocka_unit_test(a_missed_bound_ends_with_one_and_a_kept_one_with_zero),
        cmocka_unit_test(a_measure_goes_before_a_value_of_its_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
