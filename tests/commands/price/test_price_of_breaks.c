/* What `check` tells of a body that breaks, which its trial of a second does not see, against the run. */
#include "../support.h"
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const scene =
    "version: 1\nmaterials:\n  plaster: {E: 5 GPa, nu: 0.2, density: 1200 kg/m^3, strength: {tension: 4 MPa}}\n  wall: "
    "{E: 50 GPa, nu: 0.2, density: 2500 kg/m^3}\n"
    "bodies: [{name: ball, shape: {sphere: {centre: [0, 0, 20.1 mm], radius: 20 mm}}, fill: {noisy_grid: {elements: "
    "1200, spread: 90 %, lloyd: 3}}, material: plaster}]\n"
    "fracture: {criterion: bond-normal}\ninteractions: {contact: {restitution: 0.5}}\nstrikers: {wall: {plane: {point: "
    "[0, 0, 0], normal: [0, 0, 1]}, material: wall}}\n"
    "stages: [{name: hit, solver: {dynamic: {duration: 100 us}}, initial: [{velocity: {velocity: [0, 0, -14 m/s]}}]}]\n"
    "sensors: {broken: {fracture: broken}}\noutput: {frames: 6, picture: false}\n";

static int begin(void **state)
{
    (void)state;
    return test_make_folder(scene);
}

typedef struct memory {
    double host, device; /* [MB] */
    double broken;       /* [%] of all bonds */
} memory;

/* What check tells of the scene, with an option of its own, and what its run takes; true: the trial came to its end. */
static bool tell_and_run(const char *option, memory *told, memory *was)
{
    static const char looked[] = "broken bonds: about ", whole[] = "broken bonds: ";
    char arguments[512];
    snprintf(arguments, sizeof arguments, "check %s/scene.yaml --all --device cpu --threads 1 %s", test_folder(),
             option);
    assert_int_equal(test_program(arguments), 0);
    const char *text = strstr(test_program_stdout(), "predicted:");
    const bool is_whole = text && !strstr(text, looked);
    *told = (memory){test_number_behind(text, "; "), test_number_behind(text, "MB on the host, "),
                     test_number_behind(text, is_whole ? whole : looked)};
    snprintf(arguments, sizeof arguments, "run %s/scene.yaml --device cpu --threads 1 -o %s/run", test_folder(),
             test_folder());
    assert_int_equal(test_program(arguments), 0);
    const char *summary = test_text_of("run/summary.json");
    *was = (memory){test_number_behind(summary, "\"host_bytes\": ") / 1e6,
                    test_number_behind(summary, "\"device_bytes\": ") / 1e6,
                    100 * test_number_behind(summary, "\"broken\": ") / test_number_behind(summary, "\"bonds\": ")};
    return is_whole;
}

/* A run of a second or two is made in the trial as a whole, with the same breaks and pairs: equal to the digits that
 * are printed (four, of breaks three), but for what the trial holds on the host beside it (sentences, paths). */
static void a_short_run_is_told_as_it_is(void **state)
{
    (void)state;
    memory told, was;
    if (!tell_and_run("", &told, &was)) fail_msg("the trial of a short run was cut");
    if (!(fabs(told.host / was.host - 1) < 1e-2)) fail_msg("host: told %g MB, was %g", told.host, was.host);
    if (!(fabs(told.device / was.device - 1) < 6e-4)) fail_msg("device: told %g MB, was %g", told.device, was.device);
    if (!(fabs(told.broken / was.broken - 1) < 6e-3)) fail_msg("broken: told %g %%, were %g", told.broken, was.broken);
}

/* Memory of the host within 10 % (the bound asked for every scene), and of the device within a half: the body of a
 * quarter of the elements or fewer breaks more easily, by up to so much. The trial alone, whose lists of pairs know the
 * whole ball only, tells half of that. */
static void what_breaks_is_in_the_price(void **state)
{
    (void)state;
    memory told, was;
    if (tell_and_run("--brief", &told, &was)) fail_msg("a brief trial came to its end");
    print_message("host %g MB for %g, device %g for %g, broken %g %% for %g\n", told.host, was.host, told.device,
                  was.device, told.broken, was.broken);
    if (!(fabs(told.host / was.host - 1) < 0.1)) fail_msg("host: told %g MB, was %g", told.host, was.host);
    if (!(fabs(told.device / was.device - 1) < 0.5)) fail_msg("device: told %g MB, was %g", told.device, was.device);
    if (!(told.broken > 0.5 * was.broken && told.broken < 2 * was.broken))
        fail_msg("broken: told %g %%, were %g", told.broken, was.broken);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_short_run_is_told_as_it_is, begin, test_remove_folder),
        cmocka_unit_test_setup_teardown(what_breaks_is_in_the_price, begin, test_remove_folder)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
