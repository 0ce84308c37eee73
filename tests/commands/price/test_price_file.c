/* What `check -o DIR` tells, in DIR/price.json, and what `run -o DIR` says of it. */
#include "../support.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const scene =
    "version: 1\nmaterials: {glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3}}\n"
    "bodies: [{name: bar, shape: {box: {size: [20 mm, 10 mm, 10 mm]}}, fill: {noisy_grid: {elements: 250}}, material: "
    "glass}]\n"
    "stages: [{name: pull, solver: static, loads: [{face_displacement: {set: x-, x: 0, y: 0, z: 0}}, "
    "{face_displacement: {set: x+, x: 1 um}}]}]\n"
    "sensors: {force: {reaction: {set: x+, component: x}}}\noutput: {frames: none, picture: false}\n";

static int begin(void **state)
{
    (void)state;
    return test_make_folder(scene);
}

static void call(const char *command, const char *more)
{
    char arguments[512];
    snprintf(arguments, sizeof arguments, "%s %s/scene.yaml --device cpu --threads 1 -o %s/run %s", command,
             test_folder(), test_folder(), more);
    assert_int_equal(test_program(arguments), 0);
}

/* The number behind `key` after `from`. */
static double number_of(const char *text, const char *from, const char *key)
{
    return test_number_behind(strstr(text, from), key);
}

/* A stage that a condition will end, long after the trial is cut, leaves a checkpoint: the folder holds little else. */
static void the_checkpoint_of_a_stage_that_ends_early_is_counted(void **state)
{
    (void)state;
    static const char swinging[] =
        "version: 1\nmaterials: {glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3}}\n"
        "bodies: [{name: bar, shape: {box: {size: [20 mm, 10 mm, 10 mm]}}, fill: {noisy_grid: {elements: 2000}}, "
        "material: glass}]\n"
        "stages: [{name: pull, solver: {dynamic: {duration: 20 ms, stop_after_peak: {sensor: force, below: 50 %}}}, "
        "loads: [{face_displacement: {set: x-, x: 0}}, "
        "{traction: {set: x+, x: 1 MPa, table: [[0, 0], [0.4 ms, 1], [0.42 ms, 0]]}}]}]\n"
        "sensors: {force: {energy: elastic}}\n"
        "output: {frames: none, picture: false, history_every: 10000}\n";
    test_remove_folder(NULL);
    assert_int_equal(test_make_folder(swinging), 0);
    call("check", "--brief");
    const double told = number_of(test_text_of("run/price.json"), "{", "\"disk_bytes\": ");
    call("run", "");
    const char *summary = test_text_of("run/summary.json");
    const double kept = number_of(summary, "\"checkpoints\"", "\"bytes\": ");
    assert_non_null(strstr(summary, "stop_after_peak"));
    if (!(kept > 0 && told > 0.9 * kept && told < 1.5 * kept + 1e5)) fail_msg("%g bytes told, %g kept", told, kept);
}

/* Numbers of the price are those of the summary, written with nine digits; what the run took stands beside them: of a
 * static stage too, of which the run itself predicts nothing. */
static void a_run_is_compared_with_the_price_that_check_told(void **state)
{
    (void)state;
    call("check", "");
    const char *price = test_text_of("run/price.json");
    const double seconds = number_of(price, "{", "\"seconds\": "), host = number_of(price, "{", "\"host_bytes\": "),
                 disk = number_of(price, "{", "\"disk_bytes\": ");
    assert_true(seconds > 0 && host > 0 && disk > 0);
    call("run", "");
    if (!strstr(test_program_stderr(), "check told")) fail_msg("no word of it in '%s'", test_program_stderr());
    const char *summary = test_text_of("run/summary.json"), *check = "\"check\": {";
    assert_near(number_of(summary, check, "\"seconds\": "), seconds, 1e-8 * seconds);
    assert_near(number_of(summary, check, "\"host_bytes\": "), host, 0);
    assert_near(number_of(summary, check, "\"disk_bytes\": "), disk, 0);
    assert_true(number_of(summary, check, "\"actual_seconds\": ") > 0);
    assert_near(number_of(summary, check, "\"actual_host_bytes\": "),
                number_of(summary, "\"memory\"", "\"host_bytes\": "), 0);
}

static void the_price_of_another_scene_is_not_compared(void **state)
{
    (void)state;
    call("check", "--set materials.glass.nu=0.24");
    call("run", "");
    if (!strstr(test_program_stderr(), "is of another scene")) fail_msg("no word of it in '%s'", test_program_stderr());
    assert_null(strstr(test_text_of("run/summary.json"), "\"check\": {"));
    call("check", "");
    call("run", "--precision single");
    if (!strstr(test_program_stderr(), "is of another precision"))
        fail_msg("no word of it in '%s'", test_program_stderr());
}

static void a_damaged_price_stops_no_run(void **state)
{
    (void)state;
    char path[256];
    call("check", "");
    snprintf(path, sizeof path, "%s/run/price.json", test_folder());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("{\"seconds\": [", file);
    fclose(file);
    call("run", "");
    if (!strstr(test_program_stderr(), "cannot be read")) fail_msg("no word of it in '%s'", test_program_stderr());
}

static void a_price_with_a_number_that_is_none_is_not_compared(void **state)
{
    (void)state;
    static const char *const forged[] = {"s/\"seconds\": [^,]*/\"seconds\": -5/",
                                         "s/\"disk_bytes\": [^,]*/\"disk_bytes\": null/",
                                         "s/\"host_bytes\"/\"bytes\"/"};
    for (size_t k = 0; k < sizeof forged / sizeof *forged; ++k) {
        char command[256];
        call("check", "");
        snprintf(command, sizeof command, "sed -i '%s' %s/run/price.json", forged[k], test_folder());
        assert_int_equal(system(command), 0);
        call("run", "");
        if (!strstr(test_program_stderr(), "has no price") || strstr(test_program_stderr(), "check told"))
            fail_msg("%s: '%s'", forged[k], test_program_stderr());
        assert_null(strstr(test_text_of("run/summary.json"), "\"check\": {"));
    }
}

static void a_price_that_cannot_be_written_is_refused_before_the_trial(void **state)
{
    (void)state;
    char arguments[512];
    snprintf(arguments, sizeof arguments, "check %s/scene.yaml --device cpu --threads 1 -o %s/scene.yaml",
             test_folder(), test_folder());
    assert_int_equal(test_program(arguments), 3);
    if (!strstr(test_program_stderr(), "is a file where a folder is needed"))
        fail_msg("no word of it in '%s'", test_program_stderr());
    assert_null(strstr(test_program_stdout(), "predicted:"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_run_is_compared_with_the_price_that_check_told, begin, test_remove_folder),
        cmocka_unit_test_setup_teardown(the_checkpoint_of_a_stage_that_ends_early_is_counted, begin,
                                        test_remove_folder),
        cmocka_unit_test_setup_teardown(the_price_of_another_scene_is_not_compared, begin, test_remove_folder),
        cmocka_unit_test_setup_teardown(a_price_with_a_number_that_is_none_is_not_compared, begin, test_remove_folder),
        cmocka_unit_test_setup_teardown(a_price_that_cannot_be_written_is_refused_before_the_trial, begin,
                                        test_remove_folder),
        cmocka_unit_test_setup_teardown(a_damaged_price_stops_no_run, begin, test_remove_folder)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
