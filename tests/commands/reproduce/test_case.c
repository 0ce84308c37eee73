#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/commands/reproduce/case.h"
#include "../../../host/commands/references/reference_beam.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static char folder[64];

static int begin(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "case-test-%d", (int)getpid());
    return 0;
}

/* Write a case of this text and read it back. */
static brc_status read_text(brc_context *context, const char *text, brc_case **out)
{
    char path[128];
    snprintf(path, sizeof path, "%s/made", folder);
    assert_int_equal(brc_file_make_folder(context, path), BRC_OK);
    snprintf(path, sizeof path, "%s/made/case.yaml", folder);
    assert_int_equal(brc_file_write_whole(context, path, text, strlen(text)), BRC_OK);
    const brc_status status = brc_case_read(context, folder, "made", out);
    unlink(path);
    snprintf(path, sizeof path, "%s/made", folder);
    rmdir(path);
    rmdir(folder);
    return status;
}

static void a_case_is_read_with_units_and_rules(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_case *what;
    assert_int_equal(
        read_text(context,
                  "title: A\nabout: B\nruns:\n"
                  "  - {name: one, set: [a=1, b=2], label: {nu: 0.3}, quick: true, rows: {E: {reference: 20 GPa, "
                  "paper: 21 GPa, bound: 1e-5}, nu: {absolute: true, at_most: 1}}}\n"
                  "derived:\n  - {quantity: order, formula: order, of: E, runs: [one], at_least: 2}\n",
                  &what),
        BRC_OK);
    assert_int_equal(what->n_runs, 1);
    const brc_case_run *run = &what->runs[0];
    assert_int_equal(run->n_overrides, 2);
    assert_string_equal(run->overrides[1], "b=2");
    assert_string_equal(run->scene, "scene.yaml");
    assert_true(run->quick);
    assert_int_equal(run->n_rows, 2);
    assert_near(run->rows[0].reference, 20e9, 1e-3);
    assert_near(run->rows[0].paper, 21e9, 1e-3);
    assert_int_equal(run->rows[0].rule, BRC_CASE_ERROR_BOUND);
    assert_true(run->rows[1].absolute);
    assert_int_equal(run->rows[1].rule, BRC_CASE_AT_MOST);
    assert_true(isnan(run->rows[1].paper));
    assert_int_equal(what->derived[0].formula, BRC_CASE_ORDER);
    assert_int_equal(what->derived[0].row.rule, BRC_CASE_AT_LEAST);
    brc_case_free(&what);
    brc_context_free(&context);
}

static void precisions_make_a_run_of_each(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_case *what;
    assert_int_equal(
        read_text(context,
                  "title: A\nruns:\n  - {name: one, about: said once, precisions: [double, single], label: {nu: 0.3}, "
                  "rows: {E: {}}}\n  - {name: two}\n"
                  "derived:\n  - {quantity: apart, formula: range, of: E, runs: [one-double, one-single]}\n",
                  &what),
        BRC_OK);
    assert_int_equal(what->n_runs, 3);
    assert_string_equal(what->runs[0].name, "one-double");
    assert_string_equal(what->runs[1].name, "one-single");
    assert_true(what->runs[1].has_precision && what->runs[1].precision == BRC_SINGLE);
    assert_string_equal(what->runs[0].about, "said once");
    assert_string_equal(what->runs[1].about, "");
    assert_string_equal(what->runs[1].labels[1].value, "single");
    assert_int_equal(what->runs[1].n_rows, 1);
    assert_false(what->runs[2].has_precision);
    brc_case_free(&what);
    brc_context_free(&context);
}

static void mistakes_are_told_with_their_place(void **state)
{
    (void)state;
    static const char *const texts[][2] = {
        {"runs:\n  - {name: one, bogus: 1}\n", "made/case.yaml:2:17: error: unknown key 'bogus' in a run"},
        {"runs:\n  - {rows: {}}\n", "expected a run with a name"},
        {"runs:\n  - {name: one, rows: {E: {reference: much}}}\n", "expected a number"},
        {"runs:\n  - {name: one, quick: maybe}\n", "expected true or false"},
        {"runs:\n  - {name: one, with: magic}\n", "expected one of: measures vibration drift build"},
        {"runs:\n  - {name: one}\nderived:\n  - {quantity: q, formula: mean, of: x, runs: [two]}\n",
         "the run 'two', which is not there"},
        {"runs:\n  - {name: one}\nderived:\n  - {quantity: q, quick: true, formula: mean, of: x, runs: [one]}\n",
         "the run 'one', which is not there in --quick"},
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        brc_context *context = brc_context_create();
        brc_case *what;
        assert_int_equal(read_text(context, texts[k][0], &what), BRC_BAD_INPUT);
        assert_null(what);
        if (!strstr(brc_context_message(context), texts[k][1]))
            fail_msg("'%s' not in '%s'", texts[k][1], brc_context_message(context));
        brc_context_free(&context);
    }
}

static void every_case_in_the_program_reads_and_has_its_scenes(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const char *path;
    int n = 0;
    for (; (path = brc_case_name(n)); ++n) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)(strchr(path, '/') - path), path);
        brc_case *what;
        if (brc_case_read(context, NULL, name, &what) != BRC_OK) fail_msg("%s", brc_context_message(context));
        for (int r = 0; r < what->n_runs; ++r) {
            char *text;
            size_t bytes;
            assert_int_equal(brc_case_text(context, NULL, name, what->runs[r].scene, &text, &bytes), BRC_OK);
            assert_int_equal(strlen(text), bytes);
            brc_memory_free(text);
            for (int s = 0; s < r; ++s)
                assert_string_not_equal(what->runs[r].name, what->runs[s].name); /* runs have folders of their names */
        }
        brc_case_free(&what);
    }
    assert_true(n >= 8);
    brc_context_free(&context);
}

static void an_unknown_case_is_answered_with_the_nearest(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_case *what;
    assert_int_equal(brc_case_read(context, NULL, "agh19-tabel3", &what), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(context), "did you mean 'agh19-table3'?"));
    brc_context_free(&context);
}

/* The reference of a row of a run; NAN when it is not there. */
static double reference(brc_context *context, const char *name, const char *run, const char *quantity)
{
    brc_case *what;
    double value = NAN;
    assert_int_equal(brc_case_read(context, NULL, name, &what), BRC_OK);
    for (int r = 0; r < what->n_runs; ++r)
        for (int k = 0; strcmp(what->runs[r].name, run) == 0 && k < what->runs[r].n_rows; ++k)
            if (strcmp(what->runs[r].rows[k].quantity, quantity) == 0) value = what->runs[r].rows[k].reference;
    brc_case_free(&what);
    return value;
}

/* The scenes' own numbers: E 20 GPa, nu 0.3, 1 m x 0.1 m x 0.1 m under 10 N; twist of 1e-5 over 0.3 m; Table 4 with nu
 * 0.4. Written with nine digits and more. */
static void references_of_the_cases_are_those_of_theory(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    const double shear = 20e9 / 2.6;
    assert_near(reference(context, "cantilever", "across-4", "tip") /
                    brc_reference_cantilever(20e9, 0.3, 1, 0.1, 0.1, 10),
                1, 1e-8);
    assert_near(reference(context, "twisted-bar", "square-4", "energy") /
                    brc_reference_torsion_energy(shear, brc_reference_torsion_rectangle(0.1, 0.1), 0.3, 1e-5),
                1, 1e-8);
    assert_near(reference(context, "twisted-bar", "round-4", "energy") /
                    brc_reference_torsion_energy(shear, brc_reference_torsion_circle(0.05), 0.3, 1e-5),
                1, 1e-8);
    assert_near(reference(context, "agh19-table4", "dlsm-tension", "frequency") /
                    brc_reference_bar_frequency(20e9, 1000, 1),
                1, 1e-8);
    assert_near(reference(context, "agh19-table4", "dlsm-torsion", "frequency") /
                    brc_reference_bar_frequency(20e9 / 2.8, 1000, 1),
                1, 1e-8);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_case_is_read_with_units_and_rules),
        cmocka_unit_test(precisions_make_a_run_of_each),
        cmocka_unit_test(mistakes_are_told_with_their_place),
        cmocka_unit_test(every_case_in_the_program_reads_and_has_its_scenes),
        cmocka_unit_test(an_unknown_case_is_answered_with_the_nearest),
        cmocka_unit_test(references_of_the_cases_are_those_of_theory),
    };
    return cmocka_run_group_tests(tests, begin, NULL);
}
