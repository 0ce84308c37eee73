/* Shared by the tests of host/output. */
#include "support.h"
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/scene/scene_reader.h"
#include "../../preprocess/packing/beams.h"
#include "../../preprocess/domain/build.h"
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

brc_context *test_context;

int test_begin(void **state)
{
    (void)state;
    test_context = brc_context_create();
    brc_log_set_level(test_context, BRC_LOG_ERROR);
    return test_context ? 0 : -1;
}

int test_end(void **state)
{
    (void)state;
    brc_context_free(&test_context);
    return 0;
}

char *test_new_folder(void)
{
    char *path = strdup("output-test-XXXXXX");
    assert_non_null(path);
    assert_non_null(mkdtemp(path));
    return path;
}

static int remove_one(const char *path, const struct stat *information, int kind, struct FTW *walk)
{
    (void)information;
    (void)kind;
    (void)walk;
    return remove(path);
}

void test_remove_folder(char *folder)
{
    nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
    free(folder);
}

const char *test_path(const char *folder, const char *name)
{
    static char path[4][512];
    static int next;
    next = (next + 1) % 4;
    snprintf(path[next], sizeof path[next], "%s/%s", folder, name);
    return path[next];
}

char *test_read(const char *path)
{
    char *text;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(test_context, path, (size_t)1 << 28, &text, &bytes), BRC_OK);
    return text;
}

brc_domain *test_domain(int64_t n)
{
    brc_domain *domain;
    const brc_set_request half = {
        .name = "half",
        .kind = BRC_SET_ELEMENTS,
        .where = {.has_box = true, .box = {{0, 0, 0}, {1, 1, 1}}},
    };
    const brc_build_request request = {
        .shape = {.kind = BRC_SHAPE_BOX, .size = {2, 1, 1}},
        .fill = {.kind = BRC_FILL_NOISY_GRID, .n_elements = n, .spread = 0.5, .seed = 3},
        .n_sets = 1,
        .sets = &half,
        .n_threads = 1,
    };
    if (brc_domain_build(test_context, &request, &domain) != BRC_OK) fail_msg("%s", brc_context_message(test_context));
    return domain;
}

brc_domain *test_row_of_spheres(int n, double first, double step)
{
    double *x, *r;
    brc_domain *d;
    assert_int_equal(BRC_ALLOCATE(test_context, &d, 1, "domain"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(test_context, &x, 3 * n, "positions"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(test_context, &r, n, "radii"), BRC_OK);
    for (int e = 0; e < n; ++e) {
        x[3 * e] = e;
        r[e] = first + step * e;
    }
    if (brc_beams_bond(test_context, x, r, n, 2.0 * (n - 1) / n, 1, d) != BRC_OK)
        fail_msg("%s", brc_context_message(test_context));
    return d;
}

brc_scene *test_scene(const char *yaml)
{
    brc_scene *scene;
    if (brc_scene_read_text(test_context, "test.yaml", yaml, strlen(yaml), 0, NULL, &scene) != BRC_OK)
        fail_msg("%s", brc_context_message(test_context));
    return scene;
}
