/* Tables of a run for the charts of a page: sensors, directions of cracks, sizes of fragments. */
#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/report/report_cracks.h"
#include "../../../host/output/report/report_curves.h"
#include "../../../host/output/report/report_pack.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void put(const char *folder, const char *name, const char *text)
{
    assert_int_equal(brc_file_write_whole(test_context, test_path(folder, name), text, strlen(text)), BRC_OK);
}

static void tables_have_names_units_and_whole_rows(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_csv_read csv;
    put(folder, "a.csv", "stage,it's [J],mode,z [m]\n0,1.5,tension,\n1,-2,shear,3\n2,4,cut");
    assert_int_equal(brc_csv_read_open(test_context, folder, "a.csv", &csv), BRC_OK);
    assert_int_equal(csv.n_columns, 4);
    assert_int_equal(csv.n_rows, 2); /* the last one is cut off */
    assert_string_equal(csv.name[1], "it's");
    assert_string_equal(csv.unit[1], "J");
    assert_string_equal(csv.unit[0], "");
    assert_int_equal(brc_csv_read_column(&csv, "z"), 3);
    assert_int_equal(brc_csv_read_column(&csv, "y"), -1);
    assert_true(csv.value[1] == 1.5 && isnan(csv.value[2]) && isnan(csv.value[3]) && csv.value[7] == 3);
    brc_csv_read_free(&csv);
    assert_int_equal(brc_csv_read_open(test_context, folder, "none.csv", &csv), BRC_OK);
    assert_int_equal(csv.n_columns, 0);
    test_remove_folder(folder);
}

static void curves_begin_with_the_axes_of_the_scene(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_text page = {.context = test_context};
    brc_json json = {.text = {.context = test_context}};
    put(folder, "histories.csv", "stage,step,stage_time,time_s,a [m],f [N]\n0,0,0,0,0,1\n0,1,0.5,0,1,\n");
    brc_json_begin_object(&json, NULL);
    assert_int_equal(brc_report_curves(test_context, folder, "output:\n  curve: {x: a, y: f}\n", &page, &json), BRC_OK);
    assert_non_null(strstr(json.text.data, "\"rows\": 2"));
    assert_non_null(strstr(json.text.data, "\"x\": \"a\""));
    assert_non_null(strstr(json.text.data, "\"y\": \"f\""));
    assert_non_null(strstr(page.data, "<script type=\"text/plain\" id=\"histories\">"));
    brc_text_free(&page);
    brc_text_free(&json.text);
    test_remove_folder(folder);
}

/* Ten thousand samples of fifty sensors are thinned; the last one is always there. */
static void many_samples_are_thinned_and_say_so(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_text text = {.context = test_context}, page = {.context = test_context};
    brc_json json = {.text = {.context = test_context}};
    brc_text_add(&text, "stage,step,stage_time,time_s");
    for (int k = 0; k < 46; ++k)
        brc_text_add(&text, ",s%d [m]", k);
    for (int row = 0; row < 10000; ++row) {
        brc_text_add(&text, "\n0,%d,0,0", row);
        for (int k = 0; k < 46; ++k)
            brc_text_add(&text, ",%d", row);
    }
    brc_text_add(&text, "\n");
    put(folder, "histories.csv", text.data);
    brc_json_begin_object(&json, NULL);
    assert_int_equal(brc_report_curves(test_context, folder, NULL, &page, &json), BRC_OK);
    assert_non_null(strstr(json.text.data, "\"every\": 2"));
    assert_non_null(strstr(json.text.data, "\"rows\": 5001"));
    brc_text_free(&text);
    brc_text_free(&page);
    brc_text_free(&json.text);
    test_remove_folder(folder);
}

/* Faces across x leave a trace along y in the plane xy, and none in the plane yz; one at 30 degrees leaves it at
 * 120. */
static void a_rose_has_the_area_along_the_trace(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_csv_read csv;
    double rose[BRC_REPORT_ROSE], whole = 0;
    put(folder, "cracks.csv", "nx,ny,nz,area [m^2]\n1,0,0,2\n-1,0,0,1\n0.8660254,0.5,0,5\n0,0,1,7\n");
    assert_int_equal(brc_csv_read_open(test_context, folder, "cracks.csv", &csv), BRC_OK);
    brc_report_cracks_rose(&csv, 2, rose);
    for (int k = 0; k < BRC_REPORT_ROSE; ++k)
        whole += rose[k];
    assert_true(fabs(whole - 8) < 1e-6);
    assert_true(fabs(rose[9] - 3) < 1e-12);            /* 90 to 100 degrees from x */
    assert_true(fabs(rose[11] + rose[12] - 5) < 1e-6); /* on the border of two sectors */
    brc_report_cracks_rose(&csv, 0, rose); /* y z: the oblique one is seen by its half, the one across z whole */
    assert_true(fabs(rose[9] - 2.5) < 1e-6 && fabs(rose[0] - 7) < 1e-12);
    brc_csv_read_free(&csv);
    test_remove_folder(folder);
}

static void fragments_are_those_of_the_shown_frames(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_csv_read csv;
    brc_text page = {.context = test_context};
    brc_json json = {.text = {.context = test_context}};
    int64_t shown[2] = {0, 2};
    const brc_report_frames frames = {.n_all = 3, .n = 2, .number = shown};
    put(folder, "fragments.csv", "frame,mass [kg]\n0,9\n1,8\n1,1\n2,3\n2,6\n-1,2\n-1,4\n-1,3\n");
    assert_int_equal(brc_csv_read_open(test_context, folder, "fragments.csv", &csv), BRC_OK);
    brc_json_begin_object(&json, NULL);
    assert_int_equal(brc_report_cracks_add_fragments(test_context, &csv, &frames, &page, &json), BRC_OK);
    char plain[400];
    size_t n = 0;
    for (const char *s = json.text.data; *s && n < sizeof plain - 1; ++s)
        if (*s != ' ' && *s != '\n') plain[n++] = *s;
    plain[n] = '\0';
    assert_non_null(strstr(plain, "\"frame\":[0,2,-1],\"start\":[0,1,3,6]"));
    brc_csv_read_free(&csv);
    brc_text_free(&page);
    brc_text_free(&json.text);
    test_remove_folder(folder);
}

/* As web/data.js reads them: differences with their sign in the lowest bit, high bytes first. */
static void packed_numbers_are_differences_by_weight(void **state)
{
    (void)state;
    brc_report_pack pack = {.context = test_context};
    const int16_t small[3] = {3, 1, -32768};
    const int32_t large[2] = {-2, 65536};
    const float level[4] = {0, 0.5f, 2, NAN};
    brc_report_pack_int16(&pack, 3, small);
    brc_report_pack_int32(&pack, 2, large);
    brc_report_pack_levels(&pack, 4, level, 0, 1);
    static const unsigned char expected[] = {0, 0, 255, 6, 3, 254, 0, 0, 0, 2, 0, 0, 3, 4, 0, 128, 255, 0};
    assert_int_equal(pack.status, BRC_OK);
    assert_int_equal(pack.n, sizeof expected);
    /* 3 is 6; -2 is 3; -32769 wraps to 32767, which is 65534. -2 is 3; 65538 is 131076. */
    assert_memory_equal(pack.data, expected, sizeof expected);
    brc_report_pack_free(&pack);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_have_names_units_and_whole_rows),
        cmocka_unit_test(curves_begin_with_the_axes_of_the_scene),
        cmocka_unit_test(many_samples_are_thinned_and_say_so),
        cmocka_unit_test(a_rose_has_the_area_along_the_trace),
        cmocka_unit_test(fragments_are_those_of_the_shown_frames),
        cmocka_unit_test(packed_numbers_are_differences_by_weight),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
