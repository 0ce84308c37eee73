/* STL files as they are met: both kinds, damaged ones, and what is no STL at all. */
#include "../support.h"
#include "../support_mesh.h"

#include "../../../host/base/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double ZERO[3] = {0.0, 0.0, 0.0}, ONE[3] = {1.0, 1.0, 1.0};
static const char PATH[] = "test_mesh_stl.stl";

static void write_bytes(const void *data, size_t bytes)
{
    FILE *file = fopen(PATH, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, bytes, file), bytes);
    assert_int_equal(fclose(file), 0);
}

static size_t read_bytes(char *data, size_t most)
{
    FILE *file = fopen(PATH, "rb");
    assert_non_null(file);
    const size_t bytes = fread(data, 1, most, file);
    fclose(file);
    return bytes;
}

static void says(brc_context *context, brc_status code, const char *first, const char *second)
{
    brc_mesh *mesh = NULL;
    brc_context_clear(context);
    assert_int_equal(brc_mesh_read_stl(context, PATH, 1.0, ZERO, 1, &mesh), code);
    assert_null(mesh);
    test_says(context, first);
    test_says(context, second);
    remove(PATH);
}

static void write_cube(bool binary)
{
    test_mesh list = {0};
    test_mesh_box(&list, ZERO, ONE, 1);
    if (binary)
        test_mesh_write_binary(&list, PATH);
    else
        test_mesh_write_ascii(&list, PATH);
    test_mesh_free(&list);
}

static brc_mesh *read_good(brc_context *context, double scale, const double offset[3])
{
    brc_mesh *mesh = NULL;
    if (brc_mesh_read_stl(context, PATH, scale, offset, 1, &mesh) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    remove(PATH);
    return mesh;
}

static void both_kinds_are_told_apart_by_content_and_placed_by_scale_and_offset(void **state)
{
    const double offset[3] = {1.0, 2.0, 3.0};
    for (int binary = 0; binary < 2; ++binary) {
        write_cube(binary); /* the binary header begins with "solid" */
        brc_mesh *mesh = read_good(*state, 0.5, offset);
        double bounds[2][3];
        brc_mesh_bounds(mesh, bounds);
        for (int d = 0; d < 3; ++d) {
            assert_near(bounds[0][d], offset[d], 0.0);
            assert_near(bounds[1][d], offset[d] + 0.5, 0.0);
        }
        assert_near(brc_mesh_volume(mesh), 0.125, 1e-15);
        brc_mesh_free(&mesh);
    }
}

/* A tetrahedron, written as carelessly as people do. */
#define FACET(a, b, c)                                                                                                 \
    "FACET normal nan 0 -1e0 Outer LOOP\r\n\tvertex " a "  VERTEX " b "\n\n vertex\n" c " endloop endfacet\r\n"
#define TETRAHEDRON                                                                                                    \
    FACET("0 0 0", "0 1 0", "1 0 0")                                                                                   \
    FACET("0 0 0", "1 0 0", "0 0 1") FACET("0 0 0", "0 0 1.0E+0", "0 1 0") FACET("1 0 0", "0 1 0", "0 0 1")

static void ascii_may_be_of_any_case_and_white_space_and_hold_several_solids(void **state)
{
    static const char *const TEXT[] = {
        "solid\n" TETRAHEDRON "endsolid",
        "\xef\xbb\xbf\n  SOLID a facet, normal\n" TETRAHEDRON "EndSolid a facet, normal\n",
        "solid one " FACET("0 0 0", "0 1 0", "1 0 0") "endsolid one\n solid\ttwo\n" FACET("0 0 0", "1 0 0", "0 0 1")
            FACET("0 0 0", "0 0 1", "0 1 0") FACET("1 0 0", "0 1 0", "0 0 1") "\nendsolid two\n\n",
    };
    for (size_t k = 0; k < sizeof TEXT / sizeof *TEXT; ++k) {
        write_bytes(TEXT[k], strlen(TEXT[k]));
        brc_mesh *mesh = read_good(*state, 1.0, ZERO);
        assert_int_equal(brc_mesh_n_triangles(mesh), 4);
        assert_near(brc_mesh_volume(mesh), 1.0 / 6.0, 1e-16);
        brc_mesh_free(&mesh);
    }
}

static void faults_of_ascii_name_line_and_column(void **state)
{
    static const char *const CASE[][3] = {
        {"solid x\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 zero\n",
         "stl:4:14: z of a vertex is 'zero', expected a number", ""},
        {"solid x\nfacet normal 0 0 1\n outer loop\n  vertex 0,5 0 0\n", "stl:4:10: x of a vertex is '0,5'",
         "decimal point"},
        {"solid x\nfacet normal 0 0 1\n outer loop\n  vertex 0 nan 0\n", "stl:4:12: y of a vertex is 'nan'", ""},
        {"solid x\nfacet normal 0 0 1\n outer lop\n", "stl:3:8: 'lop' where 'loop' is expected",
         "export the mesh again"},
        {"solid x\nfacet normal 0 0 1\n outer loop\n vertex 0 0 0\n endloop",
         "stl:5:2: 'endloop' where 'vertex' is expected", ""},
        {"solid x\nfacet normal 0 0 1\n outer loop\n vertex 0 0 0\n", "where 'vertex' is expected (truncated?)",
         "export it again"},
        {"solid x\nfacet normal 0 0", "where 'a component of the normal' is expected (truncated?)", ""},
        {"solid x\n", "where 'facet' or 'endsolid' is expected (truncated?)", ""},
        {"solid x\nendsolid x\n", "has no triangles", "export a part that has a volume"},
        {"solid x\nendsolid x\nrubbish", "stl:3:1: 'rubbish' where 'solid' is expected", ""},
        {"solid x\n vertex", "stl:2:2: 'vertex' where 'facet' is expected", ""},
    };
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        write_bytes(CASE[k][0], strlen(CASE[k][0]));
        says(*state, BRC_BAD_INPUT, CASE[k][1], CASE[k][2]);
    }
}

static void damaged_binary_files_say_what_was_found_and_expected(void **state)
{
    char data[1024];
    write_cube(true);
    const size_t bytes = read_bytes(data, sizeof data);
    assert_int_equal(bytes, 84 + 12 * 50);
    write_bytes(data, bytes - 1);
    says(*state, BRC_BAD_INPUT, "announces 12 triangles, which take 684 bytes, but it has 683 (truncated?)",
         "export it again");
    write_bytes(data, 90);
    says(*state, BRC_BAD_INPUT, "but it has 90", "");
    memset(data + 80, 0xff, 4); /* 4294967295 triangles: nothing of that size may be reserved */
    write_bytes(data, bytes);
    says(*state, BRC_BAD_INPUT, "announces 4294967295 triangles, which take 214748364834 bytes, but it has 684", "");
    memset(data + 80, 0, 4);
    write_bytes(data, 84);
    says(*state, BRC_BAD_INPUT, "has no triangles", "");
    write_cube(true);
    read_bytes(data, sizeof data);
    const float infinite = (float)HUGE_VAL;
    memcpy(data + 84 + 50 + 12 + 16, &infinite, 4);
    write_bytes(data, bytes);
    says(*state, BRC_BAD_INPUT, "triangle 2: y of corner 2 is inf, expected a finite number", "repair tool");
}

static void what_is_no_stl_at_all_says_so(void **state)
{
    write_bytes("", 0);
    says(*state, BRC_BAD_INPUT, "not an STL file: it has 0 bytes", "export the part as STL");
    write_bytes("solid", 5);
    says(*state, BRC_BAD_INPUT, "not an STL file: it has 5 bytes", "");
    remove(PATH);
    says(*state, BRC_BAD_INPUT, "test_mesh_stl.stl: cannot open", "");
    brc_mesh *mesh = NULL;
    assert_int_equal(brc_mesh_read_stl(*state, ".", 1.0, ZERO, 1, &mesh), BRC_BAD_INPUT);
    test_says(*state, "is a folder, a file is expected");
    const double scales[] = {0.0, -1.0, HUGE_VAL, NAN};
    for (int k = 0; k < 4; ++k)
        assert_int_equal(brc_mesh_read_stl(*state, PATH, scales[k], ZERO, 1, &mesh), BRC_BAD_INPUT);
    test_says(*state, "the scale must be finite and > 0");
    write_cube(true);
    assert_int_equal(brc_mesh_read_stl(*state, PATH, 1e300, ZERO, 1, &mesh), BRC_BAD_INPUT);
    test_says(*state, "at most 1e30 m is possible");
    assert_int_equal(brc_mesh_read_stl(*state, PATH, 1e-200, ZERO, 1, &mesh), BRC_BAD_INPUT); /* squares vanish */
    assert_null(mesh);
    remove(PATH);
}

static uint32_t random_word(uint64_t a, uint64_t b)
{
    double u[4];
    brc_random_uniform4(5, BRC_RANDOM_TEST, a, b, u);
    return (uint32_t)(u[0] * 4294967295.0);
}

/* Good or refused with a sentence, never anything else (run with the sanitizers, this is where they look). */
static void random_damage_never_does_harm(void **state)
{
    enum { MOST = 65536 };
    char *good = malloc(MOST), *bad = malloc(MOST);
    assert_true(good && bad);
    int n_refused = 0;
    for (uint64_t k = 0; k < 600; ++k) {
        test_mesh list = {0};
        if (k % 3 == 0)
            test_mesh_box(&list, ZERO, ONE, 2);
        else if (k % 3 == 1)
            test_mesh_sphere(&list, ZERO, 1.0, 3);
        else
            test_mesh_torus(&list, 1.0, 0.5, 7, 5);
        const bool binary = k % 2;
        if (binary)
            test_mesh_write_binary(&list, PATH);
        else
            test_mesh_write_ascii(&list, PATH);
        test_mesh_free(&list);
        const size_t bytes = read_bytes(good, MOST);
        assert_true(bytes < MOST);
        memcpy(bad, good, bytes);
        const uint32_t n = 1 + random_word(k, 0) % 4;
        for (uint32_t i = 1; i <= n; ++i) {
            const size_t at = (binary ? 84 : 0) + random_word(k, 2 * i) % (bytes - (binary ? 84 : 0));
            bad[at] = binary ? (char)random_word(k, 2 * i + 1) : "0123456789.- evx\n"[random_word(k, 2 * i + 1) % 17];
        }
        write_bytes(bad, bytes);
        brc_mesh *mesh = NULL;
        brc_context_clear(*state);
        const brc_status status = brc_mesh_read_stl(*state, PATH, 1.0, ZERO, 1, &mesh);
        if (status == BRC_OK) {
            const double x[3] = {0.1, 0.2, 0.3};
            brc_mesh_foot feet[4];
            assert_true(brc_mesh_volume(mesh) > 0.0);
            assert_true(isfinite(brc_mesh_depth(mesh, x)));
            assert_true(brc_mesh_feet(mesh, x, 10.0, feet, 4) > 0);
        } else {
            ++n_refused;
            assert_int_equal(status, BRC_BAD_INPUT);
            test_says(*state, PATH);
        }
        brc_mesh_free(&mesh);
    }
    assert_in_range(n_refused, 100, 599); /* the damage is real, and some of it is harmless (normals, spare bytes) */
    for (uint64_t k = 0; k < 200; ++k) {  /* noise of any length */
        const size_t bytes = random_word(k, 100) % 2000;
        for (size_t i = 0; i < bytes; ++i)
            bad[i] = (char)random_word(k, 200 + i);
        if (k % 2 && bytes > 6) memcpy(bad, "solid ", 6);
        write_bytes(bad, bytes);
        brc_mesh *mesh = NULL;
        assert_int_equal(brc_mesh_read_stl(*state, PATH, 1.0, ZERO, 1, &mesh), BRC_BAD_INPUT);
        assert_null(mesh);
    }
    remove(PATH);
    free(good);
    free(bad);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(both_kinds_are_told_apart_by_content_and_placed_by_scale_and_offset, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(ascii_may_be_of_any_case_and_white_space_and_hold_several_solids, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(faults_of_ascii_name_line_and_column, test_begin, test_end),
        cmocka_unit_test_setup_teardown(damaged_binary_files_say_what_was_found_and_expected, test_begin, test_end),
        cmocka_unit_test_setup_teardown(what_is_no_stl_at_all_says_so, test_begin, test_end),
        cmocka_unit_test_setup_teardown(random_damage_never_does_harm, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
