#include "../support.h"
#include "../../skip.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/pictures/curve.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static brc_sensor sensors[] = {{.name = "axial_strain", .kind = BRC_SENSOR_FACE_STRAIN},
                               {.name = "axial_stress", .kind = BRC_SENSOR_STRESS}};
static brc_stage stages[] = {{.name = "pull"}};

static brc_history *history(int n, double last)
{
    brc_history *h;
    assert_int_equal(brc_history_create(test_context, 2, &h), BRC_OK);
    for (int k = 0; k < n; ++k)
        brc_history_add(test_context, h, 0, k, k, 0, (double[]){last * k, 2e10 * last * k});
    return h;
}

static bool draw(const char *title, const char *path, const brc_history *h)
{
    bool made;
    brc_measure measure = {.name = "E",
                           .kind = BRC_MEASURE_E,
                           .x = "axial_strain",
                           .y = "force",
                           .scale = 1,
                           .has_target = true,
                           .target = 2e10};
    brc_scene scene = {
        .n_sensors = 2, .sensors = sensors, .n_stages = 1, .stages = stages, .n_measures = 1, .measures = &measure};
    strcpy(scene.title, title);
    strcpy(scene.output.curve_x, "axial_strain");
    strcpy(scene.output.curve_y, "axial_stress");
    assert_int_equal(brc_curve_write(test_context, &scene, NULL, h, path, &made), BRC_OK);
    assert_true(made == brc_file_exists(path));
    return made;
}

static bool has_gnuplot(void)
{
    return access("/usr/bin/gnuplot", X_OK) == 0;
}

static void a_curve_is_drawn_whatever_the_words_and_paths_hold(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_history *few = history(5, 1e-7), *many = history(500, 1e-5);
    assert_true(draw("A \"title\" with 'quotes', \\ and `date`", test_path(folder, "it's `a` $b \"c\".png"), few));
    assert_true(draw("", test_path(folder, "b.png"), many));
    brc_history_free(&few);
    brc_history_free(&many);
    test_remove_folder(folder);
}

static void too_few_points_and_no_gnuplot_are_warnings(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_history *one = history(1, 1), *few = history(5, 1);
    assert_false(draw("t", test_path(folder, "a.png"), one));
    char *path = strdup(getenv("PATH"));
    setenv("PATH", "/nonexistent", 1);
    assert_false(draw("t", test_path(folder, "b.png"), few));
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(rmdir(folder), 0); /* nothing is left behind */
    free(folder);
    brc_history_free(&one);
    brc_history_free(&few);
}

/* In place of gnuplot stands a program that keeps its script. */
static void sign_and_scale_stand_beside_the_axis(void **state)
{
    (void)state;
    char *folder = test_new_folder(), *path = strdup(getenv("PATH")), *program, *script, longer[4096];
    const char *const keep = "#!/bin/sh\ncp \"$1\" \"$KEPT\"\n";
    brc_history *h = history(5, 1e-3);
    brc_measure measure = {.name = "s", .kind = BRC_MEASURE_SLOPE, .x = "axial_strain", .y = "axial_stress"};
    brc_scene scene = {
        .n_sensors = 2, .sensors = sensors, .n_stages = 1, .stages = stages, .n_measures = 1, .measures = &measure};
    strcpy(scene.output.curve_x, "axial_strain");
    strcpy(scene.output.curve_y, "axial_stress");
    assert_int_equal(brc_file_join(test_context, folder, "gnuplot", &program), BRC_OK);
    assert_int_equal(brc_file_write_whole(test_context, program, keep, strlen(keep)), BRC_OK);
    assert_int_equal(chmod(program, 0755), 0);
    snprintf(longer, sizeof longer, "%s:%s", folder, path);
    setenv("PATH", longer, 1);
    setenv("KEPT", test_path(folder, "kept"), 1);
    static const struct {
        double scale;
        const char *title;
    } known[] = {{1, "\"axial stress [MPa]"},
                 {-1, "\"\xe2\x88\x92 axial stress [MPa]"},
                 {0.5, "\"0.5 \xc3\x97 axial stress [MPa]"}};
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        bool made;
        measure.scale = known[k].scale;
        assert_int_equal(brc_curve_write(test_context, &scene, NULL, h, test_path(folder, "c.png"), &made), BRC_OK);
        assert_false(made); /* nothing drew it */
        script = test_read(test_path(folder, "kept"));
        assert_non_null(strstr(script, known[k].title));
        assert_non_null(strstr(script, "set xtics 0.5\n")); /* nine numbers from 0 to 4, times 10^-3 */
        brc_memory_free(script);
    }
    setenv("PATH", path, 1);
    free(path);
    brc_memory_free(program);
    brc_history_free(&h);
    test_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_curve_is_drawn_whatever_the_words_and_paths_hold),
        cmocka_unit_test(too_few_points_and_no_gnuplot_are_warnings),
        cmocka_unit_test(sign_and_scale_stand_beside_the_axis),
    };
    if (!has_gnuplot()) return test_skip("gnuplot is not installed (Debian: gnuplot-nox)");
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
