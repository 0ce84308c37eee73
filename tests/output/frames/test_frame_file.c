#include "../support.h"
#include "../fake_simulation.h"
#include "../../../host/base/memory.h"
#include "../../../host/base/file.h"
#include "../../../host/output/frames/frame_file.h"
#include "../../../host/output/h5_pack.h"
#include "../../../host/output/h5_read.h"
#include "../../../preprocess/cells/tessellation.h"
#include <stdio.h>
#include <stdlib.h>

static brc_domain *domain;
static brc_tessellation cells; /* as the frame should have them */
static char *folder;
static brc_h5_read h5;

static brc_frames *frames_of(const brc_assembly *assembly)
{
    brc_frames *frames;
    assert_int_equal(brc_frames_create(test_context, assembly, 1, &frames), BRC_OK);
    return frames;
}

static const brc_scene in_double = {.output = {.frame_numbers = BRC_FRAME_DOUBLE}};

/* One frame of an affine motion, open for reading. */
static int begin(void **state)
{
    test_begin(state);
    domain = test_domain(300);
    folder = test_new_folder();
    brc_simulation s = {.scene = &in_double,
                        .domain = domain,
                        .factor = 1,
                        .time = 0.125,
                        .step = 7,
                        .stage = 2,
                        .value = {0.1, 0, 0},
                        .gradient = {{1e-2, 2e-2, 0}, {0, -3e-3, 0}, {5e-3, 0, 4e-2}},
                        .stress = {1e6, 2e6, 3e6, 4e6, 5e6, 6e6}};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(s.scene, NULL, 1, &alone);
    brc_frames *frames = frames_of(&whole);
    if (brc_frames_write(frames, folder, 0) != BRC_OK) return -1;
    brc_frames_free(&frames);
    if (brc_tessellation_create(test_context, domain, 1, &cells) != BRC_OK ||
        brc_tessellation_join(test_context, NULL, 1, &cells) != BRC_OK)
        return -1;
    static char path[512];
    snprintf(path, sizeof path, "%s/000000.vtkhdf", folder);
    return brc_h5_read_open(test_context, path, &h5) == BRC_OK ? 0 : -1;
}

static int end(void **state)
{
    brc_h5_read_close(&h5);
    brc_tessellation_free(&cells);
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
    assert_true(version[0] == 2 && version[1] == 5);
    H5Aclose(second);
}

/* Place of every point: that of its first corner. */
static void assert_places(const float *x)
{
    for (int64_t p = 0; p < cells.n_points; ++p) {
        const int64_t v = cells.first[p];
        assert_int_equal(cells.point[v], p);
        for (int64_t w = 0; w < v; ++w)
            assert_true(cells.point[w] != p);
        for (int c = 0; c < 3; ++c)
            assert_true(x[3 * p + c] == (float)domain->vertex[3 * v + c]);
    }
}

/* Six times the volume inside a face and the origin. */
static double cone(const float *x, int64_t n, const int64_t *point, const double o[3])
{
    double sum = 0;
    for (int64_t k = 1; k + 1 < n; ++k) {
        const float *a = x + 3 * point[0], *b = x + 3 * point[k], *c = x + 3 * point[k + 1];
        for (int m = 0; m < 3; ++m) {
            const int i = (m + 1) % 3, j = (m + 2) % 3;
            sum += (a[m] - o[m]) * ((b[i] - o[i]) * (c[j] - o[j]) - (b[j] - o[j]) * (c[i] - o[i]));
        }
    }
    return sum;
}

/* Every edge of the faces of a cell is gone along once and back once. */
static void assert_closed(int64_t n_faces, const int64_t *face, const int64_t *start, const int64_t *point)
{
    for (int64_t f = 0; f < n_faces; ++f)
        for (int64_t k = start[face[f]], n = start[face[f] + 1]; k < n; ++k) {
            const int64_t a = point[k], b = point[k + 1 < n ? k + 1 : start[face[f]]];
            int forth = 0, back = 0;
            for (int64_t g = 0; g < n_faces; ++g)
                for (int64_t m = start[face[g]], end = start[face[g] + 1]; m < end; ++m) {
                    const int64_t c = point[m], d = point[m + 1 < end ? m + 1 : start[face[g]]];
                    forth += a == c && b == d;
                    back += a == d && b == c;
                }
            assert_true(forth == 1 && back == 1);
        }
}

static void cells_are_closed_polyhedra_of_shared_points_that_turn_outward(void **state)
{
    (void)state;
    const int64_t n = domain->n_elements, n_faces = cells.face_start[n];
    int64_t *count[6];
    static const char *const name[6] = {"NumberOfCells",
                                        "NumberOfPoints",
                                        "NumberOfConnectivityIds",
                                        "NumberOfFaces",
                                        "NumberOfPolyhedronToFaceIds",
                                        "NumberOfFaceConnectivityIds"};
    const int64_t expected[6] = {n, cells.n_points, cells.point_start[n], n_faces, n_faces, cells.loop_start[n]};
    for (int k = 0; k < 6; ++k) {
        count[k] = load(name[k], H5T_NATIVE_INT64, 8, 1, 1);
        assert_int_equal(*count[k], expected[k]);
    }
    float *x = load("Points", H5T_NATIVE_FLOAT, 4, cells.n_points, 3);
    assert_places(x);
    int64_t *offset = load("Offsets", H5T_NATIVE_INT64, 8, n + 1, 1),
            *id = load("Connectivity", H5T_NATIVE_INT64, 8, cells.point_start[n], 1);
    int64_t *face_start = load("PolyhedronOffsets", H5T_NATIVE_INT64, 8, n + 1, 1),
            *face = load("PolyhedronToFaces", H5T_NATIVE_INT64, 8, n_faces, 1);
    int64_t *start = load("FaceOffsets", H5T_NATIVE_INT64, 8, n_faces + 1, 1),
            *point = load("FaceConnectivity", H5T_NATIVE_INT64, 8, cells.loop_start[n], 1);
    uint8_t *type = load("Types", H5T_NATIVE_UINT8, 1, n, 1);
    for (int64_t e = 0; e < n; ++e) {
        double volume = 0;
        assert_int_equal(type[e], 42);
        assert_int_equal(offset[e + 1], cells.point_start[e + 1]);
        assert_closed(face_start[e + 1] - face_start[e], face + face_start[e], start, point);
        for (int64_t f = face_start[e]; f < face_start[e + 1]; ++f)
            volume += cone(x, start[face[f] + 1] - start[face[f]], point + start[face[f]], domain->position + 3 * e);
        assert_true(fabs(volume / 6 / domain->volume[e] - 1) <
                    1e-5); /* floats of places up to 2 m in cells of 0.2 m: 2e-6 */
        for (int64_t k = start[face[face_start[e]]]; k < start[face[face_start[e + 1] - 1] + 1]; ++k) {
            int64_t m = offset[e];
            while (m < offset[e + 1] && id[m] != point[k])
                ++m;
            assert_true(m < offset[e + 1]);
        }
    }
    void *const block[] = {x,    offset,   id,       face_start, face,     start,    point,
                           type, count[0], count[1], count[2],   count[3], count[4], count[5]};
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        brc_memory_free(block[k]);
}

static void corners_move_with_the_gradient_of_their_cells(void **state)
{
    (void)state;
    float *u = load("PointData/displacement", H5T_NATIVE_FLOAT, 4, cells.n_points, 3);
    for (int64_t v = 0; v < domain->vertex_start[domain->n_elements]; ++v) {
        const double *x = domain->vertex + 3 * v;
        const double expected[3] = {0.1 + 1e-2 * x[0] + 2e-2 * x[1], -3e-3 * x[1], 5e-3 * x[0] + 4e-2 * x[2]};
        assert_true(cells.point[v] >= 0);
        for (int c = 0; c < 3; ++c) /* least squares of a linear field is exact; a float has 6e-8 of 0.17 m */
            assert_true(fabs(u[3 * cells.point[v] + c] - expected[c]) < 2e-8);
    }
    brc_memory_free(u);
}

/* Link of an object of frame `number` to a frame, "" where it is its own. */
static const char *owner(int number, const char *object)
{
    static char words[64];
    char name[32];
    const char *file, *path;
    H5L_info_t link;
    snprintf(name, sizeof name, "%06d.vtkhdf", number);
    const hid_t h = H5Fopen(test_path(folder, name), H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(h >= 0 && H5Lget_info(h, object, &link, H5P_DEFAULT) >= 0);
    words[0] = '\0';
    if (link.type == H5L_TYPE_EXTERNAL) {
        char value[160];
        H5Lget_val(h, object, value, sizeof value, H5P_DEFAULT);
        H5Lunpack_elink_val(value, link.u.val_size, NULL, &file, &path);
        assert_string_equal(path + 1, object);
        snprintf(words, sizeof words, "%s", file);
    }
    H5Fclose(h);
    return words;
}

/* Four frames; a bond breaks before the third. */
static void what_an_earlier_frame_has_is_referred_to(void **state)
{
    (void)state;
    static const char *const ELEMENTS = "VTKHDF/CellData/position", *const POINTS = "VTKHDF/Points",
                             *const FACES = "VTKHDF/FaceConnectivity", *const STARTS = "VTKHDF/FaceOffsets";
    static const char *const expected[4][4] = {{"", "", "", ""},
                                               {"000000.vtkhdf", "000000.vtkhdf", "000000.vtkhdf", "000000.vtkhdf"},
                                               {"000000.vtkhdf", "", "", "000000.vtkhdf"},
                                               {"000000.vtkhdf", "000002.vtkhdf", "000002.vtkhdf", "000002.vtkhdf"}};
    int64_t bond = 0; /* one inside, so that its corners are all joined around it, or nearly */
    for (int64_t b = 0; b < domain->n_bonds; ++b)
        if (fabs(domain->face_centroid[3 * (int64_t)domain->bond_half_edge[b]] - 1) < 0.3) bond = b;
    const brc_break one = {.bond = (int32_t)bond};
    brc_scene *scene = test_scene(
        TEST_SCENE_HEAD "stages:\n  - name: pull\n    solver:\n      static: {increments: 4}\n    loads:\n"
                        "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: x+, x: 2 mm}\n");
    brc_simulation s = {.scene = scene, .domain = domain, .factor = 1, .breaks = &one};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(scene, NULL, 1, &alone);
    brc_frames *frames = frames_of(&whole);
    for (int k = 0; k < 4; ++k) {
        s.n_breaks = k >= 2;
        assert_int_equal(brc_frames_write(frames, folder, k), BRC_OK);
        const char *const object[4] = {ELEMENTS, POINTS, FACES, STARTS};
        for (int m = 0; m < 4; ++m)
            assert_string_equal(owner(k, object[m]), expected[k][m]);
    }
    brc_frames_free(&frames);
    brc_scene_free(&scene);
}

/* Bytes of a number of a field; of the place of an element 8 always. */
static size_t bytes_of(const brc_h5_read *file, const char *name)
{
    const hid_t dataset = H5Dopen2(file->file, name, H5P_DEFAULT), type = H5Dget_type(dataset);
    const size_t bytes = H5Tget_size(type);
    H5Tclose(type);
    H5Dclose(dataset);
    return bytes;
}

/* Without being asked for all digits a field has those of a float: each number the nearest to the one in double. */
static void fields_are_single_unless_the_scene_says_double(void **state)
{
    (void)state;
    static const char *const field[] = {"VTKHDF/CellData/displacement", "VTKHDF/CellData/velocity",
                                        "VTKHDF/CellData/stress", "VTKHDF/CellData/strain",
                                        "VTKHDF/CellData/von_mises"};
    static const int columns[] = {3, 3, 6, 6, 1};
    const brc_scene scene = {.output = {.frame_numbers = BRC_FRAME_SINGLE}};
    brc_simulation s = {.scene = &scene,
                        .domain = domain,
                        .factor = 1,
                        .time = 0.125,
                        .value = {0.1, 0, 0},
                        .gradient = {{1e-2, 2e-2, 0}, {0, -3e-3, 0}, {5e-3, 0, 4e-2}},
                        .stress = {1e6, 2e6, 3e6, 4e6, 5e6, 6e6}};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(&scene, NULL, 1, &alone);
    brc_frames *frames = frames_of(&whole);
    char *other = test_new_folder();
    brc_h5_read file;
    assert_int_equal(brc_frames_write(frames, other, 0), BRC_OK);
    brc_frames_free(&frames);
    assert_int_equal(brc_h5_read_open(test_context, test_path(other, "000000.vtkhdf"), &file), BRC_OK);
    for (int k = 0; k < 5; ++k) {
        const int64_t n = domain->n_elements;
        double *both[2] = {malloc((size_t)(n * columns[k]) * sizeof(double)),
                           malloc((size_t)(n * columns[k]) * sizeof(double))};
        assert_true(bytes_of(&file, field[k]) == 4 && bytes_of(&h5, field[k]) == 8);
        assert_int_equal(brc_h5_read_rows(&h5, field[k], H5T_NATIVE_DOUBLE, 0, n, both[0]), BRC_OK);
        assert_int_equal(brc_h5_read_rows(&file, field[k], H5T_NATIVE_DOUBLE, 0, n, both[1]), BRC_OK);
        for (int64_t m = 0; m < n * columns[k]; ++m)
            assert_true(both[1][m] == (double)(float)both[0][m]);
        free(both[0]);
        free(both[1]);
    }
    assert_int_equal(bytes_of(&file, "VTKHDF/CellData/position"), 8);
    brc_h5_read_close(&file);
    test_remove_folder(other);
}

/* Blocks that shrink, blocks that do not, and a last one that is not full come back as they were, from any number of
 * threads in the same bytes. */
static void packed_rows_come_back(void **state)
{
    (void)state;
    enum { ROWS = 5 * (1 << 14) + 77 };
    double *in = malloc(2 * ROWS * sizeof *in), *out = malloc(2 * ROWS * sizeof *out);
    char *bytes[2];
    size_t n[2];
    for (int64_t k = 0; k < 2 * ROWS; ++k)
        in[k] = k < ROWS ? sin((double)(k * k)) : (double)(k / 1000);
    for (int k = 0; k < 2; ++k) {
        brc_h5 file;
        assert_int_equal(brc_h5_create(test_context, test_path(folder, "p.h5"), &file), BRC_OK);
        brc_h5_packed(&file, "rows", H5T_NATIVE_DOUBLE, ROWS, 2);
        brc_h5_pack_rows(&file, "rows", H5T_NATIVE_DOUBLE, 0, ROWS, in, 1 + 3 * k);
        assert_int_equal(brc_h5_commit(&file), BRC_OK);
        assert_int_equal(brc_file_read_whole(test_context, test_path(folder, "p.h5"), 1 << 26, &bytes[k], &n[k]),
                         BRC_OK);
    }
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(bytes[0], bytes[1], n[0]);
    assert_true(n[0] < ROWS * 16 * 2 / 3);
    brc_h5_read file;
    assert_int_equal(brc_h5_read_open(test_context, test_path(folder, "p.h5"), &file), BRC_OK);
    assert_int_equal(brc_h5_read_rows(&file, "rows", H5T_NATIVE_DOUBLE, 0, ROWS, out), BRC_OK);
    assert_memory_equal(in, out, 2 * ROWS * sizeof *in);
    brc_h5_read_close(&file);
    void *const block[] = {bytes[0], bytes[1]};
    for (int k = 0; k < 2; ++k)
        brc_memory_free(block[k]);
    free(in);
    free(out);
}

/* Places of which each stands there some four times, in no order, then numbers that never occur again. */
static void rows_that_occur_again_are_packed_as_they_stand(void **state)
{
    (void)state;
    enum { ROWS = 2 * (1 << 14) + 77 };
    float *in = malloc(3 * ROWS * sizeof *in), *out = malloc(3 * ROWS * sizeof *out);
    uint32_t skipped[3];
    for (int64_t k = 0; k < 3 * ROWS; ++k) {
        const int64_t row = k / 3;
        const uint32_t any = (uint32_t)row * 2654435761u >> 16;
        const int64_t place = row < 1 << 14 ? row / 1000 * 250 + any % 250 : row;
        in[k] = (float)sin((double)(3 * place + k % 3));
    }
    brc_h5 file;
    assert_int_equal(brc_h5_create(test_context, test_path(folder, "e.h5"), &file), BRC_OK);
    brc_h5_packed(&file, "rows", H5T_NATIVE_FLOAT, ROWS, 3);
    brc_h5_pack_rows_either(&file, "rows", H5T_NATIVE_FLOAT, 0, ROWS, in, 2);
    assert_int_equal(brc_h5_commit(&file), BRC_OK);
    brc_h5_read back;
    assert_int_equal(brc_h5_read_open(test_context, test_path(folder, "e.h5"), &back), BRC_OK);
    assert_int_equal(brc_h5_read_rows(&back, "rows", H5T_NATIVE_FLOAT, 0, ROWS, out), BRC_OK);
    assert_memory_equal(in, out, 3 * ROWS * sizeof *in);
    const hid_t dataset = H5Dopen2(back.file, "rows", H5P_DEFAULT);
    for (int k = 0; k < 3; ++k) {
        hsize_t bytes;
        const hsize_t at[2] = {(hsize_t)k << 14, 0};
        assert_true(H5Dget_chunk_info_by_coord(dataset, at, &skipped[k], NULL, &bytes) >= 0);
    }
    H5Dclose(dataset);
    assert_int_equal(skipped[0], 1); /* not shuffled */
    assert_int_equal(skipped[1], 0);
    brc_h5_read_close(&back);
    free(in);
    free(out);
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
        cmocka_unit_test(cells_are_closed_polyhedra_of_shared_points_that_turn_outward),
        cmocka_unit_test(corners_move_with_the_gradient_of_their_cells),
        cmocka_unit_test(tensors_come_in_the_order_of_vtk),
        cmocka_unit_test(the_moment_is_kept),
        cmocka_unit_test(what_an_earlier_frame_has_is_referred_to),
        cmocka_unit_test(fields_are_single_unless_the_scene_says_double),
        cmocka_unit_test(packed_rows_come_back),
        cmocka_unit_test(rows_that_occur_again_are_packed_as_they_stand),
        cmocka_unit_test(the_index_lists_every_frame_with_its_time),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
