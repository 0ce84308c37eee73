/* Error and cost from measured curves: against curves made up to be exact powers. */
#include "support.h"
#include "../../host/base/memory.h"
#include "../../host/commands/case.h"
#include "../../host/commands/price_curves.h"
#include <string.h>

/* error = 2 h^2 = 2 N^(-2/3) of a cube, and 5 N^(-1/3) of a bar; other models, precisions and preparations in between. */
static const char text[] = "problem,model,preparation,elements,bonds,precision,dt_fraction,integrator,threads,error\n"
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
    for (int k = 0; k < n; ++k) assert_true(curve[k].order > 0 && brc_price_curve_error(&curve[k], curve[k].most) < 1);
    brc_memory_free(csv);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_are_found_again),
        cmocka_unit_test(eight_times_the_elements_cost_sixteen_times),
        cmocka_unit_test(the_program_has_curves_of_its_default_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
