/* What `check` tells of a body that breaks, which its trial of a second does not see, against the run. */
#include "support.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *folder;

static const char *const scene =
    "version: 1\nmaterials:\n  plaster: {E: 5 GPa, nu: 0.2, density: 1200 kg/m^3, strength: {tension: 4 MPa}}\n  wall: {E: 50 GPa, nu: 0.2, density: 2500 kg/m^3}\n"
    "bodies: [{name: ball, shape: {sphere: {centre: [0, 0, 20.1 mm], radius: 20 mm}}, fill: {noisy_grid: {elements: 1200, spread: 90 %, lloyd: 3}}, material: plaster}]\n"
    "fracture: {criterion: bond-normal}\ninteractions: {contact: {restitution: 0.5}}\nstrikers: {wall: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: wall}}\n"
    "stages: [{name: hit, solver: {dynamic: {duration: 100 us}}, initial: [{velocity: {velocity: [0, 0, -14 m/s]}}]}]\n"
    "sensors: {broken: {fracture: broken}}\noutput: {frames: 6, picture: false}\n";

static int begin(void **state)
{
    (void)state;
    folder = test_scene_folder(scene);
    return folder ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    return test_remove_folder();
}

/* The number behind the first `mark` in a text. */
static double number_behind(const char *text, const char *mark)
{
    const char *at = text ? strstr(text, mark) : NULL;
    if (!at) fail_msg("no '%s' in '%s'", mark, text ? text : "");
    return strtod(at + strlen(mark), NULL);
}

/* Memory of the host within 10 % (the bound asked for every scene), and of the device within a half: the body of a quarter of the elements or fewer
 * breaks more easily, by up to so much. The trial alone, whose lists of pairs know the whole ball only, tells half of that. */
static void what_breaks_is_in_the_price(void **state)
{
    (void)state;
    char arguments[256], path[128], summary[65536];
    snprintf(arguments, sizeof arguments, "check %s/scene.yaml --device cpu --threads 1", folder);
    assert_int_equal(test_program(arguments), 0);
    const char *told = strstr(test_program_stdout(), "predicted:");
    const double host = number_behind(told, "; "), device = number_behind(told, "MB on the host, "), share = number_behind(told, "broken bonds: about ");
    snprintf(arguments, sizeof arguments, "run %s/scene.yaml --device cpu --threads 1 -o %s/run", folder, folder);
    assert_int_equal(test_program(arguments), 0);
    snprintf(path, sizeof path, "%s/run/summary.json", folder);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    summary[fread(summary, 1, sizeof summary - 1, file)] = '\0';
    fclose(file);
    const double actual_host = number_behind(summary, "\"host_bytes\": ") / 1e6, actual_device = number_behind(summary, "\"device_bytes\": ") / 1e6;
    const double actual_share = 100 * number_behind(summary, "\"broken\": ") / number_behind(summary, "\"bonds\": ");
    if (!(fabs(host / actual_host - 1) < 0.1)) fail_msg("host: told %g MB, was %g", host, actual_host);
    if (!(fabs(device / actual_device - 1) < 0.5)) fail_msg("device: told %g MB, was %g", device, actual_device);
    if (!(share > 0.5 * actual_share && share < 2 * actual_share)) fail_msg("broken: told %g %%, were %g", share, actual_share);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(what_breaks_is_in_the_price, begin, end)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
