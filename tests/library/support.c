#include "support.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char TEXT[] = "version: 1\n"
                           "materials:\n  glass: {density: 1 kg/m^3, E: 1 Pa, nu: 0.2, strength: {tension: 6e-4 Pa}}\n"
                           "model: dlsm\n"
                           "fracture: {}\n"
                           "bodies:\n  - name: block\n    shape: {box: {size: [1 m, 1 m, 1 m]}}\n    fill: "
                           "{noisy_grid: {cells: [6, 6, 6], spread: 90 %}}\n    material: glass\n"
                           "stages:\n  - name: burst\n    solver: {dynamic: {steps: 120}}\n    initial: [velocity: "
                           "{gradient: {x: [2e-3 1/s, 5e-4 1/s, 0]}}]\n"
                           "  - name: after\n    solver: {dynamic: {steps: 30}}\n"
                           "sensors:\n  kinetic: {energy: kinetic}\n  broken: {fracture: broken}\n"
                           "output: {frames: 3, picture: false, history_every: 40}\n";

breccia_scene *make_scene(void)
{
    breccia_scene *scene = breccia_scene_text("burst.yaml", TEXT, strlen(TEXT), 0, NULL);
    int n;
    const breccia_problem *problem = breccia_scene_problems(scene, &n);
    if (breccia_scene_status(scene) != BRECCIA_OK)
        fail_msg("%d:%d: %s", problem->line, problem->column, problem->message);
    return scene;
}

void make_folder(char folder[FOLDER])
{
    snprintf(folder, FOLDER, "%s/breccia-library-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    assert_non_null(mkdtemp(folder));
}

void remove_folder(const char *folder)
{
    char command[FOLDER + 16];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    assert_int_equal(system(command), 0);
}

char *read_file(const char *folder, const char *name, size_t *bytes)
{
    char path[2 * FOLDER];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    if (!file) fail_msg("%s is not there", path);
    enum { ROOM = 1 << 22 };
    char *text = malloc(ROOM);
    assert_non_null(text);
    *bytes = fread(text, 1, ROOM - 1, file);
    text[*bytes] = '\0';
    fclose(file);
    return text;
}

void assert_same_results(const char *a, const char *b)
{
    static const char *const names[] = {"histories.csv",        "cracks.csv",           "fragments.csv",
                                        "frames/000000.vtkhdf", "frames/000003.vtkhdf", "frames/000004.vtkhdf"};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        size_t bytes[2];
        char *text[2] = {read_file(a, names[k], &bytes[0]), read_file(b, names[k], &bytes[1])};
        if (bytes[0] != bytes[1] || memcmp(text[0], text[1], bytes[0]) != 0) fail_msg("%s differs", names[k]);
        for (int i = 0; i < 2; ++i)
            free(text[i]);
    }
}
