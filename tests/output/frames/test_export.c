#include "../support.h"
#include "../fake_simulation.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/frames/export.h"
#include "../../../host/output/frames/frame_file.h"
#include <stdio.h>
#include <stdlib.h>

#include "../../../preprocess/cells/tessellation.h"

static brc_domain *domain;
static brc_tessellation cells;
static char *folder;

/* What a killed run leaves at least: frames without an index. */
static int begin(void **state)
{
    test_begin(state);
    domain = test_domain(100);
    folder = test_new_folder();
    brc_file_make_folder(test_context, test_path(folder, "frames"));
    const brc_scene in_double = {.output = {.frame_numbers = BRC_FRAME_DOUBLE}};
    brc_simulation s = {.scene = &in_double, .domain = domain, .gradient = {{1e-2, 0, 0}}, .stress = {1e6}};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(s.scene, NULL, 1, &alone);
    brc_frames *frames;
    if (brc_frames_create(test_context, &whole, 1, &frames) != BRC_OK) return -1;
    for (int k = 0; k < 2; ++k) {
        s.factor = k;
        if (brc_frames_write(frames, test_path(folder, "frames"), k) != BRC_OK) return -1;
    }
    brc_frames_free(&frames);
    if (brc_tessellation_create(test_context, domain, 1, &cells) != BRC_OK ||
        brc_tessellation_join(test_context, NULL, 1, &cells) != BRC_OK)
        return -1;
    return 0;
}

static int end(void **state)
{
    brc_tessellation_free(&cells);
    brc_domain_free(&domain);
    test_remove_folder(folder);
    return test_end(state);
}

static void export_to(const char *format, int64_t expected)
{
    int64_t n;
    if (brc_export(test_context, folder, format, NULL, &n) != BRC_OK) fail_msg("%s", brc_context_message(test_context));
    assert_int_equal(n, expected);
}

/* The appended bytes are found by the offset in the head, as a reader does. */
static void a_vtu_holds_the_arrays_where_its_head_says(void **state)
{
    (void)state;
    export_to("vtu", 3);
    char *data;
    size_t bytes;
    assert_int_equal(
        brc_file_read_whole(test_context, test_path(folder, "export/frames/000001.vtu"), 1 << 26, &data, &bytes),
        BRC_OK);
    const char *name = strstr(data, "Name=\"von_mises\"");
    assert_non_null(name);
    const long offset = atol(strstr(name, "offset=\"") + 8);
    const char *raw = strstr(data, "<AppendedData encoding=\"raw\">\n_") + strlen("<AppendedData encoding=\"raw\">\n_");
    uint64_t size;
    double value;
    memcpy(&size, raw + offset, sizeof size);
    memcpy(&value, raw + offset + 8, sizeof value);
    assert_int_equal(size, 8 * domain->n_elements);
    assert_true(value == 1e6);
    /* It is the last array: then the tail, and nothing else. */
    const char *tail = raw + offset + 8 + size;
    assert_string_equal(tail, "\n</AppendedData>\n</VTKFile>\n");
    assert_int_equal(tail + strlen(tail) - data, bytes);
    const char *offsets = strstr(data, "Name=\"offsets\"");
    int64_t first;
    memcpy(&first, raw + atol(strstr(offsets, "offset=\"") + 8) + 8, sizeof first);
    assert_int_equal(first, cells.point_start[1]); /* ends, without the first 0 */
    const char *faces = strstr(data, "Name=\"faces\""), *ends = strstr(data, "Name=\"faceoffsets\"");
    int64_t count[2], end;
    memcpy(count, raw + atol(strstr(faces, "offset=\"") + 8) + 8, sizeof count);
    int32_t corners[256], points[4096];
    assert_int_equal(count[0], brc_tessellation_faces(&cells, 0, corners, points));
    assert_int_equal(count[1], corners[0]);
    memcpy(&end, raw + atol(strstr(ends, "offset=\"") + 8) + 8, sizeof end);
    assert_int_equal(end, 1 + cells.face_start[1] + cells.loop_start[1]);
    brc_memory_free(data);
    char *index = test_read(test_path(folder, "export/frames.pvd"));
    assert_non_null(strstr(index, "<DataSet timestep=\"1\" file=\"frames/000001.vtu\"/>"));
    brc_memory_free(index);
}

static void a_csv_has_a_row_for_each_element(void **state)
{
    (void)state;
    export_to("csv", 2);
    char *text = test_read(test_path(folder, "export/elements_000001.csv"));
    assert_int_equal(strncmp(text, "element_id,position_x [m],", 26), 0);
    int64_t lines = 0;
    for (const char *s = text; *s; ++s)
        lines += *s == '\n';
    assert_int_equal(lines, domain->n_elements + 1);
    const char *row = strchr(text, '\n') + 1;
    assert_int_equal(strncmp(row, "0,", 2), 0);
    assert_true(strtod(row + 2, NULL) == domain->position[0]);
    brc_memory_free(text);
}

static void vtkhdf_is_copied_byte_for_byte(void **state)
{
    (void)state;
    export_to("vtkhdf", 3);
    char *a, *b;
    size_t n, m;
    brc_file_read_whole(test_context, test_path(folder, "frames/000000.vtkhdf"), 1 << 26, &a, &n);
    brc_file_read_whole(test_context, test_path(folder, "export/frames/000000.vtkhdf"), 1 << 26, &b, &m);
    assert_int_equal(n, m);
    assert_memory_equal(a, b, n);
    brc_memory_free(a);
    brc_memory_free(b);
}

static void assert_refused(const char *from, const char *format, const char *part)
{
    assert_int_equal(brc_export(test_context, from, format, NULL, NULL), BRC_BAD_INPUT);
    if (!strstr(brc_context_message(test_context), part)) fail_msg("%s", brc_context_message(test_context));
    brc_context_clear(test_context);
}

static void wrong_formats_folders_and_damaged_frames_are_refused(void **state)
{
    (void)state;
    assert_refused(folder, "pdf", "known are vtu, vtkhdf, csv");
    assert_refused("no-such-folder", "vtu", "name the folder that `breccia run` wrote");
    char *other = test_new_folder();
    char *whole;
    size_t n;
    brc_file_make_folder(test_context, test_path(other, "frames"));
    brc_file_read_whole(test_context, test_path(folder, "frames/000000.vtkhdf"), 1 << 26, &whole, &n);
    for (size_t part = 0; part < n; part += n / 7) { /* cut off here and there */
        brc_file_write_whole(test_context, test_path(other, "frames/000000.vtkhdf"), whole, part);
        assert_int_equal(brc_export(test_context, other, "vtu", NULL, NULL), BRC_BAD_INPUT);
        assert_non_null(strstr(brc_context_message(test_context), "000000.vtkhdf"));
        brc_context_clear(test_context);
        assert_false(brc_file_exists(test_path(other, "export/frames/000000.vtu")));
    }
    brc_memory_free(whole);
    test_remove_folder(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_vtu_holds_the_arrays_where_its_head_says),
        cmocka_unit_test(a_csv_has_a_row_for_each_element),
        cmocka_unit_test(vtkhdf_is_copied_byte_for_byte),
        cmocka_unit_test(wrong_formats_folders_and_damaged_frames_are_refused),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
