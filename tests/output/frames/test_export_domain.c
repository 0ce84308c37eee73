#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/frames/export_domain.h"
#include "../../../preprocess/domain/sets.h"
#include "../../../preprocess/cells/tessellation.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A VTU as a reader sees it: the text, and where its raw data begin. */
typedef struct vtu {
    char *data;
    size_t bytes;
    const char *raw;
} vtu;

static vtu write_and_read(const brc_domain *d)
{
    vtu file;
    static const char mark[] = "<AppendedData encoding=\"raw\">\n_";
    if (brc_export_domain_vtu(test_context, d, "domain.vtu") != BRC_OK)
        fail_msg("%s", brc_context_message(test_context));
    assert_int_equal(brc_file_read_whole(test_context, "domain.vtu", (size_t)1 << 28, &file.data, &file.bytes), BRC_OK);
    file.raw = strstr(file.data, mark);
    assert_non_null(file.raw);
    file.raw += strlen(mark);
    remove("domain.vtu");
    return file;
}

/* The bytes of an array inside element `place` of the tree, of which there must be `bytes`. */
static const void *find(const vtu *file, const char *place, const char *name, const char *type, int64_t bytes)
{
    char words[96];
    snprintf(words, sizeof words, "<%s>", place);
    const char *at = strstr(file->data, words);
    assert_non_null(at);
    snprintf(words, sizeof words, "</%s>", place);
    const char *end = strstr(at, words);
    assert_non_null(end);
    snprintf(words, sizeof words, "<DataArray type=\"%s\" Name=\"%s\"", type, name);
    at = strstr(at, words);
    if (!at || at > end) fail_msg("%s is not in %s", words, place);
    const char *begin = file->raw + atol(strstr(at, "offset=\"") + 8);
    uint64_t size;
    memcpy(&size, begin, sizeof size);
    assert_int_equal(size, bytes);
    assert_true(begin + 8 + size <= file->data + file->bytes);
    return begin + 8;
}

static void assert_tree(const vtu *file, int64_t n_points, int64_t n_cells)
{
    char words[96];
    static const char *const order[] = {"<?xml version=\"1.0\"?>",
                                        "<VTKFile type=\"UnstructuredGrid\"",
                                        "<UnstructuredGrid>",
                                        "<FieldData>",
                                        "</FieldData>",
                                        "<Piece ",
                                        "<Points>",
                                        "</Points>",
                                        "<Cells>",
                                        "</Cells>",
                                        "<PointData>",
                                        "</PointData>",
                                        "<CellData>",
                                        "</CellData>",
                                        "</Piece>",
                                        "</UnstructuredGrid>",
                                        "<AppendedData"};
    const char *at = file->data;
    for (size_t k = 0; k < sizeof order / sizeof *order; ++k) {
        at = strstr(at, order[k]);
        if (!at) fail_msg("%s is missing or in the wrong place", order[k]);
    }
    snprintf(words, sizeof words, "<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">", (long long)n_points,
             (long long)n_cells);
    assert_non_null(strstr(file->data, words));
    static const char tail[] = "\n</AppendedData>\n</VTKFile>\n";
    assert_memory_equal(file->data + file->bytes - strlen(tail), tail, strlen(tail));
}

static void cells_are_polyhedra_that_share_their_corners(void **state)
{
    (void)state;
    brc_domain *d = test_domain(200);
    const int64_t n = d->n_elements;
    brc_tessellation cells;
    assert_int_equal(brc_tessellation_create(test_context, d, 1, &cells), BRC_OK);
    assert_int_equal(brc_tessellation_join(test_context, NULL, 1, &cells), BRC_OK);
    const int64_t n_points = cells.n_points, n_ids = cells.point_start[n],
                  n_stream = n + cells.face_start[n] + cells.loop_start[n];
    assert_true(3 * n_points < d->vertex_start[n]);
    assert_int_equal(BRC_ALLOCATE(test_context, &d->grain, n, "grains"), BRC_OK);
    for (int64_t e = 0; e < n; ++e)
        d->grain[e] = (int32_t)(e % 7);
    vtu file = write_and_read(d);
    assert_tree(&file, n_points, n);
    const float *x = find(&file, "Points", "Points", "Float32", 12 * n_points);
    const int64_t *point = find(&file, "Cells", "connectivity", "Int64", 8 * n_ids),
                  *end = find(&file, "Cells", "offsets", "Int64", 8 * n);
    const int64_t *stream = find(&file, "Cells", "faces", "Int64", 8 * n_stream),
                  *stream_end = find(&file, "Cells", "faceoffsets", "Int64", 8 * n);
    const uint8_t *type = find(&file, "Cells", "types", "UInt8", n);
    const int64_t *grain = find(&file, "CellData", "grain", "Int64", 8 * n),
                  *id = find(&file, "CellData", "element_id", "Int64", 8 * n);
    const int64_t *bonds = find(&file, "CellData", "coordination", "Int64", 8 * n);
    const double *volume = find(&file, "CellData", "volume", "Float64", 8 * n);
    for (int64_t e = 0, place = 0; e < n; ++e) {
        int64_t at, from = 0, value;
        double number;
        memcpy(&at, end + e, 8); /* raw data need not be aligned */
        if (e > 0) memcpy(&from, end + e - 1, 8);
        assert_int_equal(at, cells.point_start[e + 1]);
        int32_t own[256], count[256], loops[4096];
        assert_int_equal(brc_tessellation_points(&cells, e, own), at - from);
        for (int64_t v = from; v < at; ++v) {
            memcpy(&value, point + v, 8);
            assert_int_equal(value, own[v - from]);
        }
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1];
             ++v) { /* copies of a corner agree to rounding */
            float corner[3];
            memcpy(corner, x + 3 * cells.point[v], 12);
            for (int c = 0; c < 3; ++c)
                assert_true(fabs(corner[c] - d->vertex[3 * v + c]) < 2e-7);
        }
        const int64_t n_faces = brc_tessellation_faces(&cells, e, count, loops);
        memcpy(&value, stream + place++, 8);
        assert_int_equal(value, n_faces);
        for (int64_t f = 0, k = 0; f < n_faces; ++f) {
            memcpy(&value, stream + place++, 8);
            assert_int_equal(value, count[f]);
            for (int32_t m = 0; m < count[f]; ++m) {
                memcpy(&value, stream + place++, 8);
                assert_int_equal(value, loops[k++]);
            }
        }
        memcpy(&value, stream_end + e, 8);
        assert_int_equal(value, place);
        assert_int_equal(type[e], 42);
        memcpy(&value, grain + e, 8);
        assert_int_equal(value, e % 7);
        memcpy(&value, id + e, 8);
        assert_int_equal(value, e);
        memcpy(&value, bonds + e, 8);
        assert_int_equal(value, d->row_start[e + 1] - d->row_start[e]);
        memcpy(&number, volume + e, 8);
        assert_true(number == d->volume[e]);
    }
    find(&file, "CellData", "region", "Int64", 8 * n);
    find(&file, "CellData", "body", "Int64", 8 * n);
    find(&file, "CellData", "position", "Float64", 24 * n);
    assert_null(strstr(file.data, "Name=\"radius\""));
    brc_memory_free(file.data);
    brc_tessellation_free(&cells);
    brc_domain_free(&d);
}

static void spheres_are_vertices_with_a_radius(void **state)
{
    (void)state;
    enum { N = 5 };
    brc_domain *d = test_row_of_spheres(N, 0.5, 0.01);
    assert_int_equal(BRC_ALLOCATE(test_context, &d->region, N, "regions"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(test_context, &d->body, N, "bodies"), BRC_OK);
    vtu file = write_and_read(d);
    assert_tree(&file, N, N);
    const float *at = find(&file, "Points", "Points", "Float32", 12 * N);
    const int64_t *end = find(&file, "Cells", "offsets", "Int64", 8 * N),
                  *bonds = find(&file, "CellData", "coordination", "Int64", 8 * N);
    const uint8_t *type = find(&file, "Cells", "types", "UInt8", N);
    const double *radius = find(&file, "PointData", "radius", "Float64", 8 * N);
    for (int e = 0; e < N; ++e) {
        float place[3];
        double number;
        int64_t value;
        memcpy(place, at + 3 * e, 12);
        assert_true(place[0] == (float)e && place[1] == 0.0f && place[2] == 0.0f);
        memcpy(&number, radius + e, 8);
        assert_true(number == 0.5 + 0.01 * e);
        memcpy(&value, end + e, 8);
        assert_int_equal(value, e + 1);
        memcpy(&value, bonds + e, 8);
        assert_int_equal(value, e == 0 || e == N - 1 ? 1 : 2); /* a chain of four bonds */
        assert_int_equal(type[e], 1);
    }
    assert_null(strstr(file.data, "Name=\"grain\""));
    brc_memory_free(file.data);
    brc_domain_free(&d);
}

static void a_folder_that_is_not_there_is_an_error(void **state)
{
    (void)state;
    brc_domain *d = test_domain(50);
    assert_int_equal(brc_export_domain_vtu(test_context, d, "no/such/folder/d.vtu"), BRC_FILE_FAILED);
    assert_non_null(strstr(brc_context_message(test_context), "no/such/folder/d.vtu"));
    brc_context_clear(test_context);
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_polyhedra_that_share_their_corners),
        cmocka_unit_test(spheres_are_vertices_with_a_radius),
        cmocka_unit_test(a_folder_that_is_not_there_is_an_error),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
