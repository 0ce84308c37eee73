/* Shared by the tests of host/output: folders, a small cube, a scene in memory, files as text. */
#ifndef BRC_TEST_OUTPUT_SUPPORT_H
#define BRC_TEST_OUTPUT_SUPPORT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include "../../host/scene/scene.h"

/* A new empty folder under the current one; the caller frees it by test_remove_folder, which takes all in it along. */
char *test_new_folder(void);
void test_remove_folder(char *folder);
/* folder/name in a static buffer (four of them in turn). */
const char *test_path(const char *folder, const char *name);
/* A whole file as text; the test fails where there is none. The caller frees it by brc_memory_free. */
char *test_read(const char *path);
/* Box 2 x 1 x 1 m of about `n` cells with walls as sets, and the element set "half" (x <= 1). */
brc_domain *test_domain(int64_t n);
/* n spheres along x, 1 m apart, of radii first + k step [m], each bonded to the next; no quality, regions or bodies
 * yet. */
brc_domain *test_row_of_spheres(int n, double first, double step);
/* Scene read from text; the test fails with the messages where it is wrong. */
brc_scene *test_scene(const char *yaml);
/* Head of a scene that fits test_domain: version, a material "m" (E 1 GPa, nu 0.25, rho 1000), model, body. */
#define TEST_SCENE_HEAD                                                                                                \
    "version: 1\ntitle: \"Test, \\\"quoted\\\"\"\nmaterials:\n  m: {E: 1 GPa, nu: 0.25, density: 1000 kg/m^3}\n"       \
    "model: dlsm\nbodies:\n  - name: bar\n    shape:\n      box: {size: [2 m, 1 m, 1 m]}\n    fill:\n"                 \
    "      noisy_grid: {elements: 200, spread: 50 %, seed: 3}\n    material: m\n"
extern brc_context *test_context;
/* Group setup and teardown: test_context made and freed. */
int test_begin(void **state);
int test_end(void **state);

#endif
