/* A run that is killed without warning leaves what its sensors read, equal to the beginning of a run that was not. */
#include "support.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[64], path[128];

static const char *const scene =
    "version: 1\nmaterials: {m: {E: 20 GPa, nu: 0.3, density: 1000 kg/m^3}}\n"
    "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {noisy_grid: {elements: 64}}}]\n"
    "stages: [{name: pull, solver: {dynamic: {steps: 1000000000}}, initial: [{affine: {gradient: {x: [1e-4, 0, "
    "0]}}}]}]\n"
    "sensors: {total: {energy: total}, kinetic: {energy: kinetic}}\noutput: {history_every: 10, frames: none, picture: "
    "false}\n";

static char *read_histories(const char *run)
{
    snprintf(path, sizeof path, "%s/%s/histories.csv", folder, run);
    FILE *file = fopen(path, "r");
    char *text = calloc(1, 1 << 22);
    if (file) {
        text[fread(text, 1, (1 << 22) - 1, file)] = '\0';
        fclose(file);
    }
    return text;
}

static int lines(const char *text)
{
    int n = 0;
    for (; *text; ++text)
        n += *text == '\n';
    return n;
}

static pid_t start(const char *out)
{
    char scene_path[128], out_path[128];
    snprintf(scene_path, sizeof scene_path, "%s/scene.yaml", folder);
    snprintf(out_path, sizeof out_path, "%s/%s", folder, out);
    const pid_t child = fork();
    if (child == 0) {
        if (!freopen("/dev/null", "w", stderr) || !freopen("/dev/null", "w", stdout)) _exit(99);
        const char *program = getenv("BRC_PROGRAM") ? getenv("BRC_PROGRAM") : BRC_PROGRAM_PATH;
        execl(program, program, "run", scene_path, "--device", "cpu", "--threads", "1", "-o", out_path, (char *)NULL);
        _exit(98);
    }
    assert_true(child > 0);
    return child;
}

static void a_killed_run_leaves_the_rows_of_its_sensors(void **state)
{
    (void)state;
    char *text = NULL;
    const pid_t child = start("killed");
    for (int k = 0; k < 600 && (!text || lines(text) < 20); ++k) { /* at most 30 s */
        usleep(50000);
        free(text);
        text = read_histories("killed");
    }
    assert_true(lines(text) >= 20);
    free(text);
    assert_int_equal(kill(child, SIGKILL), 0);
    int result;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFSIGNALED(result));
    text = read_histories("killed");
    const int n = lines(text) - 1; /* samples at the steps 0, 10, ... 10 (n - 1) */
    char arguments[400];
    snprintf(arguments, sizeof arguments,
             "run %s/scene.yaml --device cpu --threads 1 --set stages.0.solver.dynamic.steps=%d -o %s/whole", folder,
             10 * n, folder);
    assert_int_equal(test_program(arguments), 0);
    char *whole = read_histories("whole");
    assert_true(lines(whole) >= n);
    assert_memory_equal(text, whole, (size_t)(strrchr(text, '\n') + 1 - text));
    free(text);
    free(whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_killed_run_leaves_the_rows_of_its_sensors),
    };
    char command[128];
    snprintf(folder, sizeof folder, "killed-test-XXXXXX");
    if (!mkdtemp(folder)) return 1;
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    FILE *file = fopen(path, "w");
    if (!file || fputs(scene, file) < 0 || fclose(file) != 0) return 1;
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command) == 0 ? failures : 1;
}
