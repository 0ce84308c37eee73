/* Factors of time, units of sensors and measures, freeing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>
#include "../../host/scene/scene.h"
#include "../../host/scene/unit.h"

static void a_table_is_linear_between_its_points_and_constant_outside(void **state)
{
    (void)state;
    double time[] = {1, 2, 4}, value[] = {0, 10, -10};
    const brc_table table = {3, time, value};
    assert_true(brc_table_value(&table, 0) == 0);
    assert_true(brc_table_value(&table, 1) == 0);
    assert_true(brc_table_value(&table, 1.25) == 2.5);
    assert_true(brc_table_value(&table, 2) == 10);
    assert_true(brc_table_value(&table, 3) == 0);
    assert_true(brc_table_value(&table, 4) == -10);
    assert_true(brc_table_value(&table, 1e9) == -10);
}

static void an_empty_table_is_one_and_a_single_point_is_constant(void **state)
{
    (void)state;
    double time = 3, value = 7;
    assert_true(brc_table_value(&(brc_table){0, NULL, NULL}, 5) == 1);
    assert_true(brc_table_value(&(brc_table){1, &time, &value}, -5) == 7);
    assert_true(brc_table_value(&(brc_table){1, &time, &value}, 5) == 7);
}

static void a_long_table_finds_every_interval(void **state)
{
    (void)state;
    enum { N = 1000 };
    static double time[N], value[N];
    for (int i = 0; i < N; ++i) {
        time[i] = i;
        value[i] = (double)i * i;
    }
    const brc_table table = {N, time, value};
    for (int i = 0; i + 1 < N; ++i)
        assert_true(brc_table_value(&table, i + 0.5) == value[i] + 0.5 * (value[i + 1] - value[i]));
}

/* Every combination of two sensors: the slope's unit must have the dimension of the quotient. */
static void units_of_slopes_are_quotients(void **state)
{
    (void)state;
    brc_sensor sensors[2] = {{.name = "y"}, {.name = "x"}};
    brc_measure measure = {.kind = BRC_MEASURE_SLOPE, .y = "y", .x = "x"};
    const brc_scene scene = {.n_sensors = 2, .sensors = sensors, .n_measures = 1, .measures = &measure};
    for (int y = BRC_SENSOR_REACTION; y <= BRC_SENSOR_MODE; ++y)
        for (int x = BRC_SENSOR_REACTION; x <= BRC_SENSOR_MODE; ++x) {
            sensors[0].kind = (brc_sensor_kind)y;
            sensors[1].kind = (brc_sensor_kind)x;
            brc_dimension top, bottom, quotient;
            double one;
            assert_true(brc_unit_parse(brc_sensor_unit(&sensors[0]), &one, &top) && one == 1);
            assert_true(brc_unit_parse(brc_sensor_unit(&sensors[1]), &one, &bottom) && one == 1);
            const char *unit = brc_measure_unit(&scene, &measure);
            if (!brc_unit_parse(unit, &one, &quotient) || one != 1) fail_msg("'%s' is no SI unit", unit);
            for (int k = 0; k < 4; ++k)
                if (quotient.exponent[k] != top.exponent[k] - bottom.exponent[k])
                    fail_msg("%s over %s is not %s", brc_sensor_unit(&sensors[0]), brc_sensor_unit(&sensors[1]), unit);
        }
}

static void units_follow_the_kind_of_measure(void **state)
{
    (void)state;
    brc_sensor sensor = {.name = "s", .kind = BRC_SENSOR_ENERGY, .term = "kinetic"};
    brc_measure measure = {.kind = BRC_MEASURE_E, .y = "s", .x = "s"};
    const brc_scene scene = {.n_sensors = 1, .sensors = &sensor, .n_measures = 1, .measures = &measure};
    assert_string_equal(brc_measure_unit(&scene, &measure), "Pa");
    measure.kind = BRC_MEASURE_NU;
    assert_string_equal(brc_measure_unit(&scene, &measure), "-");
    measure.kind = BRC_MEASURE_FREQUENCY;
    assert_string_equal(brc_measure_unit(&scene, &measure), "Hz");
    measure.kind = BRC_MEASURE_MEAN;
    assert_string_equal(brc_measure_unit(&scene, &measure), "J");
    strcpy(sensor.term, "closure");
    assert_string_equal(brc_measure_unit(&scene, &measure), "-");
    strcpy(measure.y, "nobody");
    assert_string_equal(brc_measure_unit(&scene, &measure), "-");
}

static void freeing_nothing_is_fine(void **state)
{
    (void)state;
    brc_scene *scene = NULL;
    brc_scene_free(&scene);
    brc_scene_free(NULL);
    assert_null(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_is_linear_between_its_points_and_constant_outside),
        cmocka_unit_test(an_empty_table_is_one_and_a_single_point_is_constant),
        cmocka_unit_test(a_long_table_finds_every_interval),
        cmocka_unit_test(units_of_slopes_are_quotients),
        cmocka_unit_test(units_follow_the_kind_of_measure),
        cmocka_unit_test(freeing_nothing_is_fine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
