/* A mesh of a million triangles: its memory is a promise, its times are printed (docs/notebook/shapes.md quotes
 * them). */
#include "../support.h"
#include "../support_mesh.h"

#include "../../../host/base/log.h"
#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"

#include <stdio.h>

static const double ZERO[3] = {0.0, 0.0, 0.0};
static const char PATH[] = "test_mesh_large.stl";

typedef double question(const brc_mesh *mesh, const double x[3]);

static double ask_depth(const brc_mesh *mesh, const double x[3])
{
    return brc_mesh_depth(mesh, x);
}

static double ask_inside(const brc_mesh *mesh, const double x[3])
{
    return brc_mesh_inside(mesh, x) ? 1.0 : 0.0;
}

static double ask_feet(const brc_mesh *mesh, const double x[3])
{
    brc_mesh_foot feet[4];
    return brc_mesh_feet(mesh, x, 0.1, feet, 4);
}

/* Mean answer at random points of the box around the sphere; prints the time of one. */
static double mean_of(question *ask, const brc_mesh *mesh, int n, const char *name)
{
    double sum = 0.0;
    const double start = brc_clock_s();
    for (int k = 0; k < n; ++k) {
        double u[4];
        brc_random_uniform4(3, BRC_RANDOM_TEST, (uint64_t)k, 0, u);
        const double x[3] = {2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0, 2.0 * u[2] - 1.0};
        sum += ask(mesh, x);
    }
    print_message("%s: %.1f us\n", name, 1e6 * (brc_clock_s() - start) / n);
    return sum / n;
}

static void a_million_triangles_take_at_most_200_bytes_each(void **state)
{
    enum { F = 354 };
    const int64_t n = 8 * (int64_t)F * F;
    test_mesh list = {0};
    test_mesh_sphere(&list, ZERO, 1.0, F);
    test_mesh_write_binary(&list, PATH);
    test_mesh_free(&list);
    brc_mesh *mesh = NULL;
    const int64_t before = brc_memory_held();
    const double start = brc_clock_s();
    if (brc_mesh_read_stl(*state, PATH, 1.0, ZERO, 2, &mesh) != BRC_OK) fail_msg("%s", brc_context_message(*state));
    print_message("%lld triangles read in %.1f s; %.0f bytes a triangle held, %.0f at most\n", (long long)n,
                  brc_clock_s() - start, (double)(brc_memory_held() - before) / (double)n,
                  (double)brc_memory_peak() / (double)n);
    remove(PATH);
    assert_int_equal(brc_mesh_n_triangles(mesh), n);
    assert_true(brc_memory_peak() <= 200 * n);
    assert_true(brc_mesh_is_convex(mesh));
    /* The longest edges, in the middle of an octant, are sqrt(2) / F blown up by sqrt(3). A triangle lies at most h^2 /
     * 6 below the ball, so the volume lacks at most 3 h^2 / 6 of itself. */
    const double ball = 4.0 / 3.0 * acos(-1.0), h = sqrt(6.0) / F;
    assert_in_range((int64_t)(1e9 * (1.0 - brc_mesh_volume(mesh) / ball)), 0, (int64_t)(1e9 * 0.5 * h * h));
    const double inside = mean_of(ask_inside, mesh, 20000, "inside");
    assert_near(inside, ball / 8.0, 4.0 * 0.5 / sqrt(20000.0)); /* four standard deviations of a share */
    mean_of(ask_feet, mesh, 20000, "feet within a twentieth of the size");
    mean_of(ask_depth, mesh, 20000, "depth");
    brc_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_million_triangles_take_at_most_200_bytes_each, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
