#include "support.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const char *folder;
static char scene[128];

static const char *const small_scene =
    "version: 1\nmaterials: {m: {E: 20 GPa, nu: 0.3, density: 1000 kg/m^3}}\n"
    "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 64}}}]\n"
    "stages: [{name: pull, solver: {dynamic: {steps: 50}}, initial: [{affine: {gradient: {x: [1e-4, 0, 0]}}}]}]\n"
    "sensors: {total: {energy: total}}\nmeasure: {energy: {mean: {of: total}}}\noutput: {frames: none, picture: "
    "false}\n";

static int begin(void **state)
{
    (void)state;
    const int status = test_make_folder(small_scene);
    folder = test_folder();
    snprintf(scene, sizeof scene, "%s/scene.yaml", folder);
    return status;
}

/* Run with the arguments `before`, and last a file `after` of the test's folder. */
static int run(const char *before, const char *after)
{
    char arguments[512];
    snprintf(arguments, sizeof arguments, "%s%s/%s", before, folder, after);
    return test_program(arguments);
}

static void expect(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("'%s' not in '%s'", part, text);
}

static void help_names_every_command(void **state)
{
    (void)state;
    assert_int_equal(test_program("--help"), 0);
    static const char *const names[] = {"check", "build", "run", "devices", "bench", "reproduce", "export"};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        assert_int_equal(test_program("--help"), 0);
        expect(test_program_stdout(), names[k]);
        char arguments[64];
        snprintf(arguments, sizeof arguments, "%s --help", names[k]);
        assert_int_equal(test_program(arguments), 0);
        expect(test_program_stdout(), "usage: breccia ");
    }
    assert_int_equal(test_program("--version"), 0);
    expect(test_program_stdout(), "breccia 0.");
}

static void wrong_words_end_with_two_and_one_sentence(void **state)
{
    (void)state;
    assert_int_equal(test_program("runn scene.yaml"), 2);
    assert_string_equal(test_program_stderr(),
                        "breccia: no command 'runn', did you mean 'run'?; `breccia --help` lists them\n");
    assert_int_equal(test_program("run scene.yaml"), 2);
    expect(test_program_stderr(), "-o DIR");
    assert_int_equal(test_program("run nowhere.yaml -o nowhere-results"), 2);
    expect(test_program_stderr(), "nowhere.yaml");
    assert_int_equal(system("rm -r nowhere-results"), 0); /* a failed run leaves its summary */
    assert_int_equal(test_program("bench speed"), 2);
    assert_int_equal(test_program("reproduce nothing"), 2);
}

static void an_unknown_device_ends_with_two_and_names_those_that_are_there(void **state)
{
    (void)state;
    char arguments[512];
    snprintf(arguments, sizeof arguments, "run %s --device cuda:0 -o %s/x", scene, folder);
    assert_int_equal(test_program(arguments), 2);
    expect(test_program_stderr(), "cpu");
}

static void check_prices_a_scene(void **state)
{
    (void)state;
    assert_int_equal(run("check --all --device cpu --threads 1 ", "scene.yaml"), 0);
    static const char *const parts[] = {"materials:", "64 elements",      "effects in:", "effects out:", "memory:",
                                        "time step",  "the paper's rule", "50 steps",    "predicted:"};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
        expect(test_program_stdout(), parts[k]);
    assert_int_equal(run("check --estimate ", "scene.yaml"), 0);
    assert_null(strstr(test_program_stdout(), "materials:"));
    expect(test_program_stdout(), "about 64 elements");
}

/* Ten lines or so, each with what it is about. */
static void check_says_what_matters_in_few_lines(void **state)
{
    (void)state;
    assert_int_equal(run("check --device cpu --threads 1 ", "scene.yaml"), 0);
    static const char *const parts[] = {
        "scene: ",     "\nelements: 64, ",        "\ndevice: cpu (",    "\nsimulated: conservative elasticity (dlsm)",
        "\nstage ",    ": 50 steps of ",          "\nmemory: ",         " MB on disk\n",
        "\nseconds: ", "\nerror class (elastic)", "breccia check --all"};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
        expect(test_program_stdout(), parts[k]);
    int lines = 0;
    for (const char *c = test_program_stdout(); *c; ++c)
        lines += *c == '\n';
    assert_true(lines >= 8 && lines <= 12);
}

static void a_run_prints_its_measures_and_writes_its_summary(void **state)
{
    (void)state;
    char arguments[512], path[128];
    snprintf(arguments, sizeof arguments,
             "run %s --device cpu --threads 1 --set bodies.cube.fill.noisy_grid.elements=27 -o %s/run", scene, folder);
    assert_int_equal(test_program(arguments), 0);
    expect(test_program_stdout(), "27 elements");
    expect(test_program_stdout(), "energy");
    expect(test_program_stdout(), "summary.json");
    snprintf(path, sizeof path, "%s/run/summary.json", folder);
    assert_int_equal(access(path, R_OK), 0);
}

static void a_built_domain_runs_like_the_scene_it_came_from(void **state)
{
    (void)state;
    char arguments[512];
    snprintf(arguments, sizeof arguments, "build %s -o %s/domain.h5", scene, folder);
    assert_int_equal(test_program(arguments), 0);
    expect(test_program_stdout(), "elements 64");
    char line[2][256] = {"", ""};
    for (int k = 0; k < 2; ++k) {
        snprintf(arguments, sizeof arguments, "run %s --device cpu --threads 1 -o %s/same%d", scene, folder, k);
        if (k) { /* the scene beside it, with the file in place of shape and fill */
            char command[512];
            snprintf(command, sizeof command, "sed 's/shape: .*}]$/domain: domain.h5}]/' %s > %s/from-file.yaml", scene,
                     folder);
            assert_int_equal(system(command), 0);
            snprintf(arguments, sizeof arguments, "run %s/from-file.yaml --device cpu --threads 1 -o %s/same%d", folder,
                     folder, k);
        }
        assert_int_equal(test_program(arguments), 0);
        const char *found = strstr(test_program_stdout(), "\nenergy ");
        assert_non_null(found);
        snprintf(line[k], sizeof line[k], "%.60s", found);
    }
    assert_string_equal(line[0], line[1]);
}

static void an_interrupted_run_ends_with_three_and_keeps_its_results(void **state)
{
    (void)state;
    char out[128], summary[160], file[128];
    snprintf(out, sizeof out, "%s/long", folder);
    snprintf(summary, sizeof summary, "%s/summary.json", out);
    snprintf(file, sizeof file, "%s/long.txt", folder);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (!freopen(file, "w", stderr) || !freopen("/dev/null", "w", stdout)) _exit(99);
        const char *program = getenv("BRC_PROGRAM") ? getenv("BRC_PROGRAM") : BRC_PROGRAM_PATH;
        execl(program, program, "run", scene, "--device", "cpu", "--threads", "1", "--set",
              "stages.0.solver.dynamic.steps=1000000000", "-o", out, (char *)NULL);
        _exit(98);
    }
    /* The progress line tells that steps are being made. */
    char text[4096] = "";
    for (int k = 0; k < 600 && !strstr(text, "pull:"); ++k) {
        usleep(50000);
        FILE *log = fopen(file, "r");
        if (!log) continue;
        text[fread(text, 1, sizeof text - 1, log)] = '\0';
        fclose(log);
    }
    usleep(200000);
    assert_int_equal(kill(child, SIGINT), 0);
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result));
    assert_int_equal(WEXITSTATUS(result), 3);
    assert_int_equal(access(summary, R_OK), 0);
}

/* Every element of a packing is in a layer, in the core, or near two walls: the rows of the table tell of it, and cells
 * have no such skin. */
static void build_tells_the_skin_of_a_packing(void **state)
{
    (void)state;
    char arguments[640], path[128], text[4096] = "";
    snprintf(arguments, sizeof arguments, "build %s -o %s/d.h5 --skin %s/skin.csv", scene, folder, folder);
    assert_int_equal(test_program(arguments), 2);
    expect(test_program_stderr(), "--skin: body 'cube' is made of cells");
    snprintf(path, sizeof path, "%s/packed.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(
        "version: 1\nmaterials: {m: {E: 20 GPa, nu: 0.2, density: 1000 kg/m^3}}\nmodel: {cbm: {keep_isolated: true}}\n"
        "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {packing: {elements: 1500, seed: 1}}, "
        "beams: 10}]\n"
        "stages: [{name: hold, solver: {dynamic: {steps: 1}}}]\noutput: {frames: none, picture: false}\n",
        file);
    fclose(file);
    snprintf(arguments, sizeof arguments, "build %s -o %s/d.h5 --skin %s/skin.csv", path, folder, folder);
    assert_int_equal(test_program(arguments), 0);
    expect(test_program_stdout(), "missing stiffness");
    snprintf(path, sizeof path, "%s/skin.csv", folder);
    file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    expect(text, "from_diameters,to_diameters,volume_m3,solid_fraction,elements,coordination,stiffness_along,stiffness_"
                 "shear,stiffness_across\n0,0.25,");
    expect(text, "\n2.5,,");
    int rows = 0;
    for (const char *at = text; (at = strchr(at, '\n')); ++at)
        ++rows;
    assert_int_equal(rows, 12);
}

static void export_needs_a_format_and_a_run(void **state)
{
    (void)state;
    assert_int_equal(test_program("export nowhere"), 2);
    expect(test_program_stderr(), "--format");
    assert_int_equal(test_program("export nowhere --format vtu"), 2);
    assert_int_equal(run("export --format stl ", ""), 2);
}

static void a_small_bench_writes_its_rows(void **state)
{
    (void)state;
    char arguments[512];
    snprintf(
        arguments, sizeof arguments,
        "bench throughput --sizes 64 --devices cpu --threads 1 --precisions double --sample 0.001 --copy 1 -o %s/bench",
        folder);
    assert_int_equal(test_program(arguments), 0);
    const char *text = test_text_of("bench/rows.json");
    static const char *const keys[] = {
        "bond_updates_per_s", "bandwidth_fraction", "copy_bandwidth", "device_bytes_per_element",
        "contraction",        "compiler",           "commit",         "date",
        "\"dlsm-published\""};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k)
        expect(text, keys[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_names_every_command),
        cmocka_unit_test(wrong_words_end_with_two_and_one_sentence),
        cmocka_unit_test(an_unknown_device_ends_with_two_and_names_those_that_are_there),
        cmocka_unit_test(check_prices_a_scene),
        cmocka_unit_test(check_says_what_matters_in_few_lines),
        cmocka_unit_test(a_run_prints_its_measures_and_writes_its_summary),
        cmocka_unit_test(a_built_domain_runs_like_the_scene_it_came_from),
        cmocka_unit_test(an_interrupted_run_ends_with_three_and_keeps_its_results),
        cmocka_unit_test(build_tells_the_skin_of_a_packing),
        cmocka_unit_test(export_needs_a_format_and_a_run),
        cmocka_unit_test(a_small_bench_writes_its_rows),
    };
    return cmocka_run_group_tests(tests, begin, test_remove_folder);
}
