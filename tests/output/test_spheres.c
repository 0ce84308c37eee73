/* Spheres in frames, their export and the picture. */
#include "support.h"
#include "fake_simulation.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/output/frames/export_vtu.h"
#include "../../host/output/frames/frame_file.h"
#include "../../host/output/h5_read.h"
#include "../../host/output/pictures/picture.h"
#include "../../preprocess/domain/quality.h"
#include <cairo.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 3 };

/* Three spheres along x, 1 m apart, of radii 0.3, 0.35 and 0.4 m. */
static brc_domain *three_spheres(void)
{
    brc_domain *d = test_row_of_spheres(N, 0.3, 0.05);
    d->quality.volume_shape = 3.0;
    brc_quality_measure(d, 1);
    return d;
}

static void *load(const brc_h5_read *h5, const char *name, hid_t type, int64_t rows, int64_t columns)
{
    int64_t r, c;
    void *data;
    assert_int_equal(brc_h5_read_size(h5, name, &r, &c), BRC_OK);
    assert_int_equal(r, rows);
    assert_int_equal(c, columns);
    assert_int_equal(brc_memory_allocate(test_context, &data, rows * columns, 8, "test"), BRC_OK);
    assert_int_equal(brc_h5_read_rows(h5, name, type, 0, rows, data), BRC_OK);
    return data;
}

static void a_frame_holds_spheres_as_vertices_that_move_with_them(void **state)
{
    (void)state;
    brc_domain *d = three_spheres();
    brc_scene scene = {.output = {.frame_numbers = BRC_FRAME_DOUBLE}};
    brc_simulation s = {
        .scene = &scene, .domain = d, .factor = 1, .value = {0.1, 0, 0}, .gradient = {{0.5, 0, 0}}, .stress = {1e6}};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(s.scene, NULL, 1, &alone);
    brc_h5_read h5;
    brc_frames *frames;
    char *folder = test_new_folder();
    static char frame[512];
    snprintf(frame, sizeof frame, "%s/000000.vtkhdf", folder);
    assert_int_equal(brc_frames_create(test_context, &whole, 1, &frames), BRC_OK);
    assert_int_equal(brc_frames_write(frames, folder, 0), BRC_OK);
    scene.output.frame_numbers = BRC_FRAME_SINGLE; /* one displacement under two names */
    assert_int_equal(brc_frames_write(frames, folder, 1), BRC_OK);
    const hid_t file = H5Fopen(test_path(folder, "000001.vtkhdf"), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t of_points = H5Dopen2(file, "VTKHDF/PointData/displacement", H5P_DEFAULT),
                of_cells = H5Dopen2(file, "VTKHDF/CellData/displacement", H5P_DEFAULT);
    const float written[3 * N] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    float same[3 * N];
    assert_true(H5Dwrite(of_points, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, written) >= 0 &&
                H5Dread(of_cells, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, same) >= 0);
    assert_memory_equal(same, written, sizeof same);
    H5Dclose(of_points);
    H5Dclose(of_cells);
    H5Fclose(file);
    brc_frames_free(&frames);
    assert_int_equal(brc_h5_read_open(test_context, frame, &h5), BRC_OK);
    assert_false(brc_h5_read_has(&h5, "VTKHDF/FaceConnectivity"));
    float *point = load(&h5, "VTKHDF/Points", H5T_NATIVE_FLOAT, N, 3),
          *moved = load(&h5, "VTKHDF/PointData/displacement", H5T_NATIVE_FLOAT, N, 3);
    int64_t *offset = load(&h5, "VTKHDF/Offsets", H5T_NATIVE_INT64, N + 1, 1),
            *id = load(&h5, "VTKHDF/Connectivity", H5T_NATIVE_INT64, N, 1);
    uint8_t *type = load(&h5, "VTKHDF/Types", H5T_NATIVE_UINT8, N, 1);
    double *radius = load(&h5, "VTKHDF/PointData/radius", H5T_NATIVE_DOUBLE, N, 1);
    double *turn = load(&h5, "VTKHDF/CellData/orientation", H5T_NATIVE_DOUBLE, N, 4);
    for (int e = 0; e < N; ++e) {
        assert_true(point[3 * e] == (float)e && point[3 * e + 1] == 0 && point[3 * e + 2] == 0);
        assert_true(moved[3 * e] == (float)(0.1 + 0.5 * e));
        assert_true(radius[e] == 0.3 + 0.05 * e);
        assert_true(turn[4 * e] == cos(0.25) && turn[4 * e + 3] == sin(0.25));
        assert_int_equal(type[e], 1);
        assert_int_equal(id[e], e);
        assert_int_equal(offset[e + 1], e + 1);
    }
    brc_h5_read_close(&h5);
    void *const block[] = {point, moved, offset, id, type, radius, turn};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);

    assert_int_equal(brc_export_vtu_frame(test_context, frame, "spheres.vtu"), BRC_OK);
    char *text = test_read("spheres.vtu");
    assert_non_null(strstr(text, "<Piece NumberOfPoints=\"3\" NumberOfCells=\"3\">"));
    const char *name = strstr(text, "<DataArray type=\"Float64\" Name=\"radius\"");
    assert_non_null(name);
    assert_true(name > strstr(text, "<PointData>") && name < strstr(text, "</PointData>"));
    double third;
    memcpy(&third, strstr(text, "raw\">\n_") + 7 + atol(strstr(name, "offset=\"") + 8) + 8 + 16, sizeof third);
    assert_true(third == 0.3 + 0.05 * 2);
    brc_memory_free(text);
    test_remove_folder(folder);
    remove("spheres.vtu");
    brc_domain_free(&d);
}

/* Lightness of a pixel: sum of its colours. */
static int light(cairo_surface_t *image, int x, int y)
{
    const unsigned char *p =
        cairo_image_surface_get_data(image) + (long)y * cairo_image_surface_get_stride(image) + 4L * x;
    return p[0] + p[1] + p[2];
}

/* Three separate balls: along the line of their centres the picture is ball, gap, ball, gap, ball, each wider than the
 * one before. */
static void a_picture_shows_balls_with_gaps_between_them(void **state)
{
    (void)state;
    brc_domain *d = three_spheres();
    double u[3 * N] = {0}, value[N] = {0, 1, 2};
    const brc_picture_part balls = {.domain = d, .displacement = u, .value = value};
    const brc_picture picture = {.n = 1, .part = &balls, .name = "number", .unit = "-", .title = "", .scale = 1};
    assert_int_equal(brc_picture_draw(test_context, &picture, "spheres.png"), BRC_OK);
    cairo_surface_t *image = cairo_image_surface_create_from_png("spheres.png");
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    cairo_surface_flush(image);
    int widest[8] = {0}, n = 0;
    bool before = false;
    for (int x = 40; x < 1000; ++x) { /* columns with paint, above the axes */
        bool painted = false;
        for (int y = 110; y < 760 && !painted; ++y)
            painted = light(image, x, y) < 3 * 250;
        if (painted && !before && n < 7) ++n;
        if (painted) ++widest[n];
        before = painted;
    }
    assert_int_equal(n, N);
    assert_true(widest[1] < widest[2] && widest[2] < widest[3]);
    /* diameters are as 6 : 8, to a pixel at each rim of some hundred */
    assert_true(fabs((double)widest[1] / widest[3] - 0.75) < 0.02);
    cairo_surface_destroy(image);
    remove("spheres.png");
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_holds_spheres_as_vertices_that_move_with_them),
        cmocka_unit_test(a_picture_shows_balls_with_gaps_between_them),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
