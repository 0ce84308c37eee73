#include "../support.h"
#include "../../../host/commands/bench/sweep.h"
#include "../../../host/commands/reproduce/operators.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A folder with the problem p in accuracy/p; removed by its user. */
static void write_problem(brc_context *context, char *folder, const char *text)
{
    char path[96];
    strcpy(folder, "sweep-test-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/accuracy/p", folder);
    assert_int_equal(brc_file_make_folder(context, path), BRC_OK);
    snprintf(path, sizeof path, "%s/accuracy/p/sweep.yaml", folder);
    assert_int_equal(brc_file_write_whole(context, path, text, strlen(text)), BRC_OK);
}

static void remove_problem(const char *folder)
{
    char command[96];
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

static const char *const good = "title: t\nquantity: rms\nwith: vibration\ncost: crossings\n"
                                "scenes:\n  scene.yaml:\n    axes:\n      model: {a: [], b: [model=b, x.y=1]}\n      "
                                "elements: n=$\n      precision: []\n      beta: model.beta=$\n"
                                "    defaults: {model: a, precision: double}\n"
                                "sweeps:\n  - {name: first, elements: [8, 27], model: [a, b]}\n  - {name: second, "
                                "elements: 27, precision: [double, mixed], quick: true}\n";

/* Two models by two sizes; of the second sweep one run is there already (and becomes quick), the other is new. */
static void every_combination_is_a_run_once(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_sweep *sweep;
    char folder[32];
    write_problem(context, folder, good);
    assert_int_equal(brc_sweep_read(context, folder, "p", &sweep), BRC_OK);
    assert_int_equal(sweep->what.n_runs, 5);
    assert_string_equal(sweep->what.runs[0].name, "a_8_double");
    assert_string_equal(sweep->what.runs[3].name, "b_27_double");
    assert_string_equal(sweep->what.runs[4].name, "a_27_mixed");
    assert_true(sweep->what.runs[1].quick && !sweep->what.runs[0].quick && sweep->what.runs[4].quick);
    assert_string_equal(sweep->sweep_of[1], "first");
    assert_string_equal(sweep->sweep_of[4], "second");
    assert_int_equal(sweep->cost, BRC_SWEEP_COST_CROSSINGS);
    assert_string_equal(sweep->what.runs[0].operator->name, "vibration");
    brc_sweep_free(&sweep);
    remove_problem(folder);
    brc_context_free(&context);
}

static void values_take_the_place_of_the_mark(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_sweep *sweep;
    char folder[32];
    write_problem(context, folder, good);
    assert_int_equal(brc_sweep_read(context, folder, "p", &sweep), BRC_OK);
    const brc_case_run *run = &sweep->what.runs[3];
    assert_int_equal(run->n_overrides, 3);
    assert_string_equal(run->overrides[0], "model=b");
    assert_string_equal(run->overrides[1], "x.y=1");
    assert_string_equal(run->overrides[2], "n=27");
    assert_true(run->has_precision && run->precision == BRC_DOUBLE && sweep->what.runs[4].precision == BRC_MIXED);
    assert_string_equal(brc_sweep_value(run, "elements"), "27");
    assert_null(brc_sweep_value(run, "beta")); /* no default, not named: as the scene has it */
    brc_sweep_free(&sweep);
    remove_problem(folder);
    brc_context_free(&context);
}

static void slips_are_told_with_their_place(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "title: t\nquantity: q\nscenes: {scene.yaml: {axes: {elements: n=$}}}\nsweeps:\n  - {name: s, elemens: 8}\n",
        "title: t\nquantity: q\nscenes: {scene.yaml: {axes: {model: {a: []}}}}\nsweeps:\n  - {name: s, model: b}\n",
        "title: t\nquantity: q\nscenes: {scene.yaml: {axes: {elements: n=$}}}\nsweeps:\n  - {name: s, scene: "
        "other.yaml}\n",
        "title: t\nquantity: q\n",
    };
    static const char *const said[] = {":5:15: error: unknown key 'elemens'", "axis model has no value 'b'",
                                       ":5:5: error: ", "expected a map with quantity, scenes and sweeps"};
    for (int k = 0; k < 4; ++k) {
        brc_context *context = brc_context_create();
        brc_sweep *sweep;
        char folder[32];
        write_problem(context, folder, texts[k]);
        assert_int_equal(brc_sweep_read(context, folder, "p", &sweep), BRC_BAD_INPUT);
        assert_null(sweep);
        assert_non_null(strstr(brc_context_message(context), said[k]));
        remove_problem(folder);
        brc_context_free(&context);
    }
}

/* The problems of the program are read without a slip. */
static void problems_of_the_program_are_well(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    int length, n = 0;
    for (const char *name; (name = brc_sweep_name(n, &length)); ++n) {
        char problem[64];
        brc_sweep *sweep;
        snprintf(problem, sizeof problem, "%.*s", length, name);
        assert_int_equal(brc_sweep_read(context, NULL, problem, &sweep), BRC_OK);
        assert_true(sweep->what.n_runs > 1 && sweep->what.title[0]);
        brc_sweep_free(&sweep);
    }
    assert_true(n >= 12);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_combination_is_a_run_once),
        cmocka_unit_test(values_take_the_place_of_the_mark),
        cmocka_unit_test(slips_are_told_with_their_place),
        cmocka_unit_test(problems_of_the_program_are_well),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
