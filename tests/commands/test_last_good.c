/* A run that the guard stops, and what it says of its checkpoints. The step is 1.1 times the critical one, so that the
 * highest mode grows by a factor of 2.4 a step: some tens of steps to the guard's limit, fewer than the 256 between its
 * readings, with a checkpoint wherever the run can be left. */
#include "support.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[64];

static const char *const scene =
    "version: 1\nmaterials: {m: {E: 20 GPa, nu: 0.2, density: 1000 kg/m^3}}\n"
    "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {cells: [4, 4, 4]}}}]\n"
    "stages: [{name: swing, solver: {dynamic: {steps: 600, time_step: {fixed: %s}}}, initial: [{affine: {gradient: {x: "
    "[1e-4, 0, 0]}}}]}]\n"
    "sensors: {total: {energy: kinetic}}\noutput: {frames: none, picture: false, history_every: 5%s}\n";

static int begin(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "last-good-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int end(void **state)
{
    char command[128];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static void write_scene(const char *step, const char *output)
{
    char path[128];
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, scene, step, output);
    assert_int_equal(fclose(file), 0);
}

/* Run, or resume, into the folder `into`. */
static int run(const char *into, const char *more)
{
    char arguments[512];
    snprintf(arguments, sizeof arguments, "run %s/scene.yaml --device cpu --threads 1 -o %s/%s %s", folder, folder,
             into, more);
    return test_program(arguments);
}

/* The critical step of these cells is 24.2 us (`breccia check`). */
static void the_sentence_names_a_checkpoint_of_before_the_breach(void **state)
{
    (void)state;
    write_scene("26.6 us", ", checkpoint: {every: 1 ns}");
    assert_int_equal(run("kept", ""), 1);
    const double stopped = test_number_behind(test_program_stderr(), "stopped at step "),
                 good = test_number_behind(test_program_stderr(), "of stage 'swing' at step ");
    assert_non_null(strstr(test_program_stderr(), "kept/checkpoints/"));
    assert_true(good > 0 && good < stopped);
    assert_true(stopped - good <= 5); /* pauses are five steps apart, and each is a checkpoint */
    /* from a good state the same run goes on to the same end */
    assert_int_equal(run("kept", "--resume"), 1);
    assert_true(test_number_behind(test_program_stderr(), "stopped at step ") == stopped);
}

static void without_checkpoints_it_says_so(void **state)
{
    (void)state;
    write_scene("26.6 us", "");
    assert_int_equal(run("bare", ""), 1);
    assert_non_null(strstr(test_program_stderr(), "there is no checkpoint to go back to"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sentence_names_a_checkpoint_of_before_the_breach),
        cmocka_unit_test(without_checkpoints_it_says_so),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
