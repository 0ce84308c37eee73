#include "support.h"
#include "fake_simulation.h"
#include "../../host/base/memory.h"
#include "../../host/output/frame_file.h"
#include "../../host/output/h5_read.h"
#include <stdio.h>

static brc_domain *domain;
static char *folder;
static brc_h5_read h5;

/* One frame of an affine motion, open for reading. */
static int begin(void **state)
{
    test_begin(state);
    domain = test_domain(300);
    folder = test_new_folder();
    brc_simulation s = {.domain = domain,
                        .factor = 1,
                        .time = 0.125,
                        .step = 7,
                        .stage = 2,
                        .value = {0.1, 0, 0},
                        .gradient = {{1e-2, 2e-2, 0}, {0, -3e-3, 0}, {5e-3, 0, 4e-2}},
                        .stress = {1e6, 2e6, 3e6, 4e6, 5e6, 6e6}};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(s.scene, NULL, 1, &alone);
    if (brc_frame_write(test_context, &whole, test_path(folder, "f.vtkhdf")) != BRC_OK) return -1;
    static char path[512];
    snprintf(path, sizeof path, "%s/f.vtkhdf", folder);
    return brc_h5_read_open(test_context, path, &h5) == BRC_OK ? 0 : -1;
}

static int end(void **state)
{
    brc_h5_read_close(&h5);
    brc_domain_free(&domain);
    test_remove_folder(folder);
    return test_end(state);
}

static void *load(const char *name, hid_t type, size_t size, int64_t rows, int64_t columns)
{
    int64_t r, c;
    void *data;
    char path[128];
    snprintf(path, sizeof path, "VTKHDF/%s", name);
    assert_int_equal(brc_h5_read_size(&h5, path, &r, &c), BRC_OK);
    assert_int_equal(r, rows);
    assert_int_equal(c, columns);
    assert_int_equal(brc_memory_allocate(test_context, &data, rows * columns, size, "test"), BRC_OK);
    assert_int_equal(brc_h5_read_rows(&h5, path, type, 0, rows, data), BRC_OK);
    return data;
}

static void the_head_is_what_vtk_asks_for(void **state)
{
    (void)state;
    char type[32] = "";
    int64_t version[2] = {0};
    const hid_t attribute = H5Aopen_by_name(h5.file, "VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t string = H5Aget_type(attribute);
    assert_true(H5Tis_variable_str(string) == 0); /* readers refuse other kinds of strings */
    assert_int_equal(H5Tget_cset(string), H5T_CSET_ASCII);
    assert_int_equal(H5Tget_size(string), strlen("UnstructuredGrid"));
    H5Aread(attribute, string, type);
    assert_string_equal(type, "UnstructuredGrid");
    H5Tclose(string);
    H5Aclose(attribute);
    const hid_t second = H5Aopen_by_name(h5.file, "VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT);
    H5Aread(second, H5T_NATIVE_INT64, version);
    assert_true(version[0] == 1 && version[1] == 0);
    H5Aclose(second);
}

static void cells_are_convex_point_sets_with_their_own_corners(void **state)
{
    (void)state;
    const int64_t n = domain->n_elements, n_points = domain->vertex_start[n];
    int64_t *count = load("NumberOfCells", H5T_NATIVE_INT64, 8, 1, 1);
    assert_int_equal(*count, n);
    int64_t *points = load("NumberOfPoints", H5T_NATIVE_INT64, 8, 1, 1);
    assert_int_equal(*points, n_points);
    int64_t *offset = load("Offsets", H5T_NATIVE_INT64, 8, n + 1, 1);
    int64_t *id = load("Connectivity", H5T_NATIVE_INT64, 8, n_points, 1);
    uint8_t *type = load("Types", H5T_NATIVE_UINT8, 1, n, 1);
    float *x = load("Points", H5T_NATIVE_FLOAT, 4, n_points, 3);
    for (int64_t e = 0; e < n; ++e) {
        assert_int_equal(type[e], 41);
        assert_int_equal(offset[e + 1], domain->vertex_start[e + 1]);
    }
    for (int64_t k = 0; k < n_points; ++k) {
        assert_int_equal(id[k], k);
        for (int c = 0; c < 3; ++c)
            assert_true(x[3 * k + c] == (float)domain->vertex[3 * k + c]);
    }
    brc_memory_free(count);
    brc_memory_free(points);
    brc_memory_free(offset);
    brc_memory_free(id);
    brc_memory_free(type);
    brc_memory_free(x);
}

static void corners_move_with_the_gradient_of_their_cell(void **state)
{
    (void)state;
    const int64_t n_points = domain->vertex_start[domain->n_elements];
    float *u = load("PointData/displacement", H5T_NATIVE_FLOAT, 4, n_points, 3);
    for (int64_t k = 0; k < n_points; ++k) {
        const double *x = domain->vertex + 3 * k;
        const double expected[3] = {0.1 + 1e-2 * x[0] + 2e-2 * x[1], -3e-3 * x[1], 5e-3 * x[0] + 4e-2 * x[2]};
        for (int c = 0; c < 3; ++c) /* least squares of a linear field is exact; a float has 6e-8 of 0.17 m */
            assert_true(fabs(u[3 * k + c] - expected[c]) < 2e-8);
    }
    brc_memory_free(u);
}

static void tensors_come_in_the_order_of_vtk(void **state)
{
    (void)state;
    const int64_t n = domain->n_elements;
    double *stress = load("CellData/stress", H5T_NATIVE_DOUBLE, 8, n, 6);
    double *mises = load("CellData/von_mises", H5T_NATIVE_DOUBLE, 8, n, 1);
    const double expected[6] = {1e6, 2e6, 3e6, 6e6, 4e6, 5e6}; /* xx yy zz xy yz xz */
    for (int64_t e = 0; e < n; ++e) {
        for (int c = 0; c < 6; ++c)
            assert_true(stress[6 * e + c] == expected[c]);
        assert_true(fabs(mises[e] / (1e6 * sqrt(3 + 3 * (16 + 25 + 36))) - 1) < 1e-14); /* (1+1+4)/2 = 3 */
    }
    brc_memory_free(stress);
    brc_memory_free(mises);
}

static void the_moment_is_kept(void **state)
{
    (void)state;
    double *time = load("FieldData/time", H5T_NATIVE_DOUBLE, 8, 1, 1);
    int64_t *step = load("FieldData/step", H5T_NATIVE_INT64, 8, 1, 1);
    int64_t *stage = load("FieldData/stage", H5T_NATIVE_INT64, 8, 1, 1);
    assert_true(*time == 0.125);
    assert_true(*step == 7 && *stage == 2);
    brc_memory_free(time);
    brc_memory_free(step);
    brc_memory_free(stage);
}

static void the_index_lists_every_frame_with_its_time(void **state)
{
    (void)state;
    const double time[] = {0, 0.1};
    assert_int_equal(brc_frame_write_series(test_context, 2, time, ".vtkhdf", test_path(folder, "s.series")), BRC_OK);
    char *text = test_read(test_path(folder, "s.series"));
    assert_non_null(strstr(text, "\"file-series-version\": \"1.0\""));
    assert_non_null(strstr(text, "\"name\": \"frames/000001.vtkhdf\",\n      \"time\": 0.1\n"));
    brc_memory_free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_head_is_what_vtk_asks_for),
        cmocka_unit_test(cells_are_convex_point_sets_with_their_own_corners),
        cmocka_unit_test(corners_move_with_the_gradient_of_their_cell),
        cmocka_unit_test(tensors_come_in_the_order_of_vtk),
        cmocka_unit_test(the_moment_is_kept),
        cmocka_unit_test(the_index_lists_every_frame_with_its_time),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
