/* Error and cost from measured curves: against curves made up to be exact powers. */
#include "../support.h"
#include "../../../host/base/memory.h"
#include "../../../host/commands/reproduce/case.h"
#include "../../../host/commands/price/price_choices.h"
#include "../../../host/commands/price/price_curves.h"
#include <string.h>

/* error = 2 h^2 = 2 N^(-2/3) of a cube, and 5 N^(-1/3) of a bar; other models, precisions and preparations in
 * between. */
static const char text[] =
    "problem,model,preparation,elements,bonds,precision,dt_fraction,integrator,threads,error\n"
    "cube,dlsm,lloyd,1000,6000,double,0.8,,1,0.02\n"
    "bar,dlsm,grid,1000,6000,double,0.8,,1,0.5\n"
    "cube,dlsm,grid,1000,6000,double,0.8,,1,0.3\n"
    "cube,dlsm-published,lloyd,8000,6000,double,0.8,,1,0.9\n"
    "cube,dlsm,lloyd,8000,48000,single,0.8,,1,0.7\n"
    "cube,dlsm,lloyd,8000,48000,double,0.8,,1,-0.005\n"
    "bar,dlsm,grid,8000,48000,double,0.8,,1,0.25\n"
    "once,dlsm,grid,8000,48000,double,0.8,,1,0.25\n"
    "worse,dlsm,grid,1000,48000,double,0.8,,1,0.1\nworse,dlsm,grid,8000,48000,double,0.8,,1,0.2\n"
    "cube,dlsm,lloyd,64000,384000,double,0.8,,1,0.00125";

static void powers_are_found_again(void **state)
{
    (void)state;
    brc_price_curve curve[BRC_CURVES_MOST];
    int n;
    brc_price_curves_read(text, "dlsm", "double", &n, curve);
    assert_int_equal(n, 2); /* one point, and a problem that does not converge, are no curves */
    assert_string_equal(curve[0].problem, "cube");
    assert_int_equal(curve[0].n, 3);
    assert_near(curve[0].order, 2, 1e-9);
    assert_near(curve[0].scale, 2, 1e-8);
    assert_near(curve[0].least, 1000, 0);
    assert_near(curve[0].most, 64000, 0);
    assert_near(curve[1].order, 1, 1e-9);
    assert_near(brc_price_curve_error(&curve[0], 27000), 2. / 900, 1e-10);
    assert_near(brc_price_curve_elements(&curve[0], 2. / 900), 27000, 1e-4);
    brc_price_curves_read(text, "cbm", "double", &n, curve);
    assert_int_equal(n, 0);
    brc_price_curves_read("", "dlsm", "double", &n, curve);
    assert_int_equal(n, 0);
}

/* One run of a problem that was stepped through time makes it one of those. */
static void problems_that_move_are_known_by_their_steps(void **state)
{
    (void)state;
    int n;
    brc_price_curve curve[BRC_CURVES_MOST];
    brc_price_curves_read("problem,model,elements,precision,error,steps\nwave,dlsm,100,double,0.04,50\nbeam,dlsm,100,"
                          "double,0.04,0\nwave,dlsm,800,double,0.02,100\nbeam,dlsm,800,double,0.01,0\n",
                          "dlsm", "double", &n, curve);
    assert_int_equal(n, 2);
    assert_true(curve[0].moves && !curve[1].moves);
}

static void modes_are_known_by_what_their_seconds_are_of(void **state)
{
    (void)state;
    int n;
    brc_price_curve curve[BRC_CURVES_MOST];
    brc_price_curves_read(
        "problem,model,elements,precision,error,cost_of\ncube,dlsm,100,double,0.04,building and 100 "
        "crossings\nbeam,dlsm,100,double,0.04,building and running\n"
        "cube,dlsm,800,double,0.02,building and 100 crossings\nbeam,dlsm,800,double,0.01,building and running\n",
        "dlsm", "double", &n, curve);
    assert_int_equal(n, 2);
    assert_true(curve[0].rings && !curve[1].rings);
}

static void eight_times_the_elements_cost_sixteen_times(void **state)
{
    (void)state;
    assert_near(brc_price_seconds_at(3, 1000, 8000), 48, 1e-9);
    assert_near(brc_price_elements_for(3, 1000, 48), 8000, 1e-6);
}

static void the_program_has_curves_of_its_default_model(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    char *csv;
    size_t bytes;
    int n;
    brc_price_curve curve[BRC_CURVES_MOST];
    assert_int_equal(brc_case_text(context, NULL, "results", "accuracy-curves.csv", &csv, &bytes), BRC_OK);
    brc_price_curves_read(csv, "dlsm", "double", &n, curve);
    assert_true(n >= 1);
    for (int k = 0; k < n; ++k)
        assert_true(curve[k].order > 0 && brc_price_curve_error(&curve[k], curve[k].most) < 1);
    brc_memory_free(csv);
    brc_context_free(&context);
}

/* Two pairs of single and one of mixed by hand: seconds add up (3 + 1 over 4 + 4), the worst error counts, a partner
 * must share all else, and what errs less has 0. */
static void choices_are_pairs_of_runs_that_differ_in_nothing_else(void **state)
{
    (void)state;
    static const char csv[] = "problem,model,elements,precision,dt_fraction,error,run_s\n"
                              "cube,dlsm,100,double,0.8,0.01,4\ncube,dlsm,100,single,0.8,0.012,3\ncube,dlsm,800,single,"
                              "0.8,0.0025,1\ncube,dlsm,800,double,0.8,-0.002,4\n"
                              "cube,dlsm,800,mixed,0.8,-0.001,3\ncube,dlsm,900,mixed,0.8,0.5,1\ncube,cbm,100,mixed,0.8,"
                              "0.5,1\ncube,dlsm,100,double,0.4,0.01,8\ncube,dlsm,100,single,0.8,,1\n";
    int n;
    brc_price_choice choice[BRC_CHOICES_MOST];
    brc_price_choices_read(csv, "dlsm", "precision", "double", &n, choice);
    assert_int_equal(n, 2);
    assert_string_equal(choice[0].value, "single");
    assert_int_equal(choice[0].pairs, 2);
    assert_near(choice[0].time, 0.5, 1e-15);
    assert_near(choice[0].more_error, 0.002, 1e-15);
    assert_string_equal(choice[1].value, "mixed");
    assert_int_equal(choice[1].pairs, 1);
    assert_near(choice[1].time, 0.75, 1e-15);
    assert_true(choice[1].more_error == 0);
    assert_int_equal(brc_price_choice_best(n, choice, 0.01), 0);
    assert_int_equal(brc_price_choice_best(n, choice, 0.001), 1);
    brc_price_choices_read(csv, "dlsm", "dt_fraction", "0.8", &n,
                           choice); /* half the step takes twice the time: no gain */
    assert_int_equal(n, 1);
    assert_near(choice[0].time, 2, 1e-15);
    assert_int_equal(brc_price_choice_best(n, choice, 1), -1);
    brc_price_choices_read(csv, "dlsm-published", "precision", "double", &n, choice);
    assert_int_equal(n, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_found_again),
        cmocka_unit_test(choices_are_pairs_of_runs_that_differ_in_nothing_else),
        cmocka_unit_test(problems_that_move_are_known_by_their_steps),
        cmocka_unit_test(modes_are_known_by_what_their_seconds_are_of),
        cmocka_unit_test(eight_times_the_elements_cost_sixteen_times),
        cmocka_unit_test(the_program_has_curves_of_its_default_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
