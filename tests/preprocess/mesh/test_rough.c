/* Rough surfaces: scanned or noisy meshes, whose triangles are smaller than a cell and bend at every edge. */
#include "../support.h"
#include "../support_mesh.h"

#include "../../../host/base/log.h"
#include "../../../preprocess/cells/mirror.h"
#include "../../../preprocess/shapes/solid.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double ZERO[3] = {0.0, 0.0, 0.0};

typedef enum body { BALL, CUBE } body;

typedef struct rough {
    const char *name;
    body body;
    int fineness;                 /* ball: 8 f^2 triangles; cube: 12 f^2 */
    double amplitude, wavelength; /* [of a cell of 10 000 in the volume] */
} rough;

static const rough cases[] = {
    {"ball, smooth", BALL, 80, 0.0, 0.0},
    {"ball, noise 0.05", BALL, 80, 0.05, 0.0},
    {"ball, noise 0.2", BALL, 80, 0.2, 0.0},
    {"ball, noise 0.5", BALL, 80, 0.5, 0.0},
    {"ball, bumps 0.2 over 1", BALL, 80, 0.2, 1.0},
    {"ball, bumps 0.5 over 3", BALL, 80, 0.5, 3.0},
    {"ball, finer, noise 0.05", BALL, 158, 0.05, 0.0},
    {"ball, finer, noise 0.2", BALL, 158, 0.2, 0.0},
    {"cube, noise 0.2", CUBE, 70, 0.2, 0.0},
    {"cube, finer, noise 0.2", CUBE, 129, 0.2, 0.0},
};
enum { N_CASES = (int)(sizeof cases / sizeof *cases) };

static void write_case(const rough *r, const char *path)
{
    const double low[3] = {-1.0, -1.0, -1.0}, high[3] = {1.0, 1.0, 1.0};
    const double cell = cbrt((r->body == BALL ? 4.18879 : 8.0) / 1e4);
    test_mesh mesh = {0};
    if (r->body == BALL)
        test_mesh_sphere(&mesh, ZERO, 1.0, r->fineness);
    else
        test_mesh_box(&mesh, low, high, r->fineness);
    if (r->amplitude > 0.0) test_mesh_roughen(&mesh, ZERO, r->amplitude * cell, r->wavelength * cell);
    test_mesh_write_binary(&mesh, path);
    test_mesh_free(&mesh);
}

static brc_build_request request_for(const rough *r, int64_t n)
{
    brc_build_request request = {.shape = {.kind = BRC_SHAPE_MESH, .scale = 1.0}, .n_threads = 1};
    request.fill = (brc_fill){.n_elements = n, .spread = 0.9, .seed = 3};
    snprintf(request.shape.file, sizeof request.shape.file, "test_rough_%ld.stl", (long)getpid());
    write_case(r, request.shape.file);
    return request;
}

static const rough *case_of(const char *name)
{
    for (int k = 0; k < N_CASES; ++k)
        if (strcmp(cases[k].name, name) == 0) return &cases[k];
    abort();
}

/* The asked bound at 10 000 cells, for a surface that stands off its mean by up to a fifth of a cell; closure and
 * twins as of any domain. */
static void rough_surfaces_are_met_to_half_a_percent(void **state)
{
    static const char *const name[] = {"ball, noise 0.2", "ball, bumps 0.5 over 3", "cube, noise 0.2",
                                       "ball, finer, noise 0.2"};
    for (int k = 0; k < 4; ++k) {
        const brc_build_request r = request_for(case_of(name[k]), 10000);
        brc_domain *d = test_build(*state, &r);
        remove(r.shape.file);
        if (!(fabs(d->quality.volume_error) < 0.005))
            fail_msg("%s: volume off by %g", name[k], d->quality.volume_error);
        if (brc_domain_check(*state, d) != BRC_OK) fail_msg("%s: %s", name[k], brc_context_message(*state));
        assert_true(test_worst_closure(d) < 1e-12);
        assert_true(d->quality.twin_area_worst < 1e-11);
        assert_int_equal(d->quality.n_pieces, 1);
        brc_domain_free(&d);
    }
}

static void a_rough_mesh_gives_the_same_bytes_on_two_threads(void **state)
{
    brc_build_request r = request_for(case_of("ball, noise 0.2"), 2000);
    brc_domain *one = test_build(*state, &r);
    r.n_threads = 2;
    brc_domain *two = test_build(*state, &r);
    test_same_bytes(*state, one, two);
    brc_domain_free(&one);
    brc_domain_free(&two);
    remove(r.shape.file);
}

/* Spikes as high as a cell and a third as wide leave no wall to be met: that is said, with the number. */
static void spikes_as_large_as_cells_are_warned_of_or_refused(void **state)
{
    const brc_build_request r = request_for(case_of("ball, noise 0.5"), 10000);
    brc_domain *d = NULL;
    char said[4096];
    brc_log_set_level(*state, BRC_LOG_WARNING);
    test_caught caught = test_catch_stderr();
    const brc_status status = brc_domain_build(*state, &r, &d);
    test_release_stderr(&caught, said, sizeof said);
    brc_log_set_level(*state, BRC_LOG_ERROR);
    remove(r.shape.file);
    if (status != BRC_OK)
        test_says(*state, "ask for more elements");
    else if (fabs(d->quality.volume_error) > 0.005)
        assert_non_null(strstr(said, "more elements bring them nearer"));
    brc_domain_free(&d);
}

/* The nearest point of a rough surface is the nearest foot, however many patches are near. */
static void the_nearest_foot_is_the_nearest_point(void **state)
{
    const brc_build_request r = request_for(case_of("ball, noise 0.2"), 1000);
    brc_solid *solid = NULL;
    assert_int_equal(brc_solid_create(*state, &r.shape, 1, &solid), BRC_OK);
    remove(r.shape.file);
    for (int k = 0; k < 300; ++k) {
        const double phi = 2.4 * k, z = 1.8 * (k + 0.5) / 300 - 0.9, radius = 0.9 + 0.05 * sin(k);
        const double x[3] = {radius * sqrt(1.0 - z * z) * cos(phi), radius * sqrt(1.0 - z * z) * sin(phi), radius * z};
        brc_foot feet[24];
        const int32_t n = brc_solid_feet(solid, x, 0.25, feet, 24);
        double least = HUGE_VAL;
        assert_in_range(n, 1, 24);
        for (int32_t f = 0; f < n; ++f)
            least = fmin(least, feet[f].depth);
        assert_near(least, brc_solid_depth(solid, x), 1e-12);
        assert_near(brc_solid_distance(solid, x, 0.25), least, 1e-12);
    }
    brc_solid_free(&solid);
}

/* A line knows what a walk by small steps may miss: many thin gaps, and more crossings than a list holds. */
static void a_line_through_thousands_of_crossings_keeps_its_length(void **state)
{
    enum { PLATES = 1500 };
    test_mesh mesh = {0};
    for (int i = 0; i < PLATES; ++i) {
        const double low[3] = {i / (double)PLATES, 0.0, 0.0}, high[3] = {(i + 0.75) / PLATES, 1.0, 1.0};
        test_mesh_box(&mesh, low, high, 1);
    }
    brc_shape shape = {.kind = BRC_SHAPE_MESH, .scale = 1.0};
    snprintf(shape.file, sizeof shape.file, "plates_%ld.stl", (long)getpid());
    test_mesh_write_binary(&mesh, shape.file);
    test_mesh_free(&mesh);
    brc_solid *solid = NULL;
    if (brc_solid_create(*state, &shape, 1, &solid) != BRC_OK) fail_msg("%s", brc_context_message(*state));
    remove(shape.file);
    /* three quarters of the way; single precision of the file moves each of 3000 faces by up to 3e-8 */
    const double a[3] = {-0.1, 0.5, 0.5}, b[3] = {1.1, 0.5, 0.5}, skew[3] = {1.1, 0.6, 0.7};
    assert_near(brc_solid_outside(solid, a, b), 1.2 - 0.75, 1e-4);
    assert_near(brc_solid_outside(solid, a, skew), sqrt(1.44 + 0.01 + 0.04) * (1.0 - 0.75 / 1.2), 1e-4);
    brc_solid_free(&solid);
}

/* Images of a regular grid at two walls at right angles fall on one another: each place is kept once. A grid of n^3 has
 * n^2 of them with the same x. */
static void images_of_a_regular_grid_are_kept_once(void **state)
{
    enum { N = 30 };
    brc_shape_part part[2] = {{.shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}}},
                              {.shape = {.kind = BRC_SHAPE_BOX, .origin = {0, 1, 0}, .size = {0.5, 1, 1}}}};
    const brc_shape shape = {.kind = BRC_SHAPE_PARTS, .n_parts = 2, .parts = part};
    static double x[N * N * N * 2][3];
    int64_t n = 0;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < 2 * N; ++j)
            for (int k = 0; k < N; ++k) {
                if (j >= N && i >= N / 2) continue;
                const double at[3] = {(i + 0.5) / N, (j + 0.5) / N, (k + 0.5) / N};
                memcpy(x[n++], at, sizeof at);
            }
    brc_solid *solid = NULL;
    brc_walls walls;
    assert_int_equal(brc_solid_create(*state, &shape, 1, &solid), BRC_OK);
    assert_int_equal(brc_walls_create(*state, solid, 1.0 / N, &walls), BRC_OK);
    const double start = brc_clock_s();
    assert_int_equal(brc_mirror_make(*state, x[0], n, 2.0 / N, 1, &walls), BRC_OK);
    print_message("%lld images of %lld seeds in %.2f s\n", (long long)walls.n_ghosts, (long long)n,
                  brc_clock_s() - start);
    assert_true(walls.n_ghosts > 0);
    for (int64_t g = 0; g < walls.n_ghosts; ++g)
        for (int64_t h = g + 1; h < walls.n_ghosts; ++h) {
            const double *a = walls.ghost + 3 * g, *b = walls.ghost + 3 * h;
            assert_false(fabs(a[0] - b[0]) + fabs(a[1] - b[1]) + fabs(a[2] - b[2]) < 1e-9);
        }
    brc_walls_free(&walls);
    brc_solid_free(&solid);
}

/* The table of docs/notebook/shapes.md: test_rough table [elements [first [last [packing]]]]. */
static int print_table(int64_t n, int first, int last, bool packing)
{
    brc_context *context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_WARNING);
    printf("| surface | triangles | cells | volume error | free faces a cell | support | s |\n| --- | --- | --- | --- "
           "| --- | --- | --- |\n");
    for (int k = first; k < N_CASES && k <= last; ++k) {
        brc_build_request r = request_for(&cases[k], n);
        brc_domain *d = NULL;
        r.n_threads = 0;
        if (packing)
            r.fill = (brc_fill){
                .kind = BRC_FILL_PACKING, .n_elements = n, .seed = 3, .coordination = 6.2, .radius_spread = 0.125};
        const long triangles = (cases[k].body == BALL ? 8L : 12L) * cases[k].fineness * cases[k].fineness;
        brc_context_clear(context);
        const double start = brc_clock_s();
        const brc_status status = brc_domain_build(context, &r, &d);
        const double seconds = brc_clock_s() - start;
        remove(r.shape.file);
        if (status != BRC_OK)
            printf("| %s | %ld | %s | %.1f |\n", cases[k].name, triangles, brc_context_message(context), seconds);
        else
            printf("| %s | %ld | %lld | %.1e | %.2f | %.3f | %.1f |\n", cases[k].name, triangles,
                   (long long)d->n_elements, d->quality.volume_error, (double)d->n_free_faces / (double)d->n_elements,
                   d->quality.support_smallest, seconds);
        fflush(stdout);
        brc_domain_free(&d);
    }
    brc_context_free(&context);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "table") == 0)
        return print_table(argc > 2 ? atoll(argv[2]) : 10000, argc > 3 ? atoi(argv[3]) : 0,
                           argc > 4 ? atoi(argv[4]) : N_CASES, argc > 5);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(rough_surfaces_are_met_to_half_a_percent, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_rough_mesh_gives_the_same_bytes_on_two_threads, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spikes_as_large_as_cells_are_warned_of_or_refused, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_nearest_foot_is_the_nearest_point, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_line_through_thousands_of_crossings_keeps_its_length, test_begin, test_end),
        cmocka_unit_test_setup_teardown(images_of_a_regular_grid_are_kept_once, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
