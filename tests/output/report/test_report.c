#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/report/report.h"
#include <stdlib.h>
#include <string.h>

static const char SUMMARY[] =
    "{\n  \"version\": \"1\",\n  \"title\": \"A <b>bar</b> & more\",\n  \"steps\": 12,\n"
    "  \"ledger\": {\"kinetic_J\": 0.5, \"peak_elastic_J\": 2},\n  \"memory\": {\"host_bytes\": 2500000},\n"
    "  \"timing\": {\"total_s\": 8, \"steps_s\": 2},\n"
    "  \"measures\": {\"E\": {\"value\": 72.1234567e9, \"unit\": \"Pa\", \"target\": null, \"error\": null},\n"
    "    \"nu\": {\"value\": 0.202, \"unit\": \"-\", \"target\": 0.2, \"error\": 0.002},\n"
    "    \"load\": {\"value\": 5050, \"unit\": \"N\", \"target\": 5000, \"error\": 0.01}},\n"
    "  \"fracture\": {\"tension\": 3, \"crack_area_m2\": 0.0063, \"energy\": {\"released_J\": 2.5e-4}},\n"
    "  \"effects\": {\"in\": [\"one\", \"two\"], \"out\": []},\n"
    "  \"end\": {\"status\": \"done\", \"reason\": \"one\\ntwo \\\\name\"}\n}\n";

static void put(const char *folder, const char *name, const char *text, size_t bytes)
{
    assert_int_equal(brc_file_write_whole(test_context, test_path(folder, name), text, bytes), BRC_OK);
}

static int count(const char *text, const char *what)
{
    int n = 0;
    for (const char *at = strstr(text, what); at; at = strstr(at + 1, what))
        ++n;
    return n;
}

static void a_page_holds_values_shares_and_pictures_and_needs_nothing_else(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    put(folder, "summary.json", SUMMARY, strlen(SUMMARY));
    put(folder, "picture.png", "foobar", 6); /* RFC 4648, section 10: Zm9vYmFy, Zm9vYmE=, Zm9vYg== */
    assert_int_equal(brc_file_make_folder(test_context, test_path(folder, "pictures")), BRC_OK);
    put(folder, "pictures/000000.png", "fooba", 5);
    put(folder, "pictures/000001.png", "foob", 4);
    assert_int_equal(brc_report_write(test_context, folder, NULL), BRC_OK);
    char *page = test_read(test_path(folder, "report.html"));
    assert_non_null(strstr(page, "A &lt;b&gt;bar&lt;/b&gt; &amp; more"));
    assert_null(strstr(page, "<b>bar"));
    assert_non_null(strstr(page, "<th>kinetic</th><td><span title=\"0.5 J\">500 mJ</span></td><td>25 %</td>"));
    assert_non_null(strstr(page, "<th>steps</th><td><span title=\"2 s\">2 s</span></td><td>25 %</td>"));
    assert_non_null(strstr(page, "2.5 MB"));
    assert_non_null(strstr(page, "<tr><th>E</th><td><span title=\"72.1234567e9 Pa\">72.123 GPa</span></td>"
                                 "<td>&ndash;</td><td>&ndash;</td><td></td></tr>"));
    assert_non_null(strstr(page, "0.2</span></td><td>+0.002</td>")); /* a difference, no share */
    assert_non_null(strstr(page, "5.05 kN</span></td><td><span title=\"5000 N\">5 kN</span></td><td>+1 %</td>"));
    assert_non_null(strstr(page, "<th>bonds broken in tension</th><td>3</td>"));
    assert_non_null(strstr(page, "6300 mm^2</span>"));
    assert_non_null(strstr(page, "250 \xc2\xb5J</span>"));
    assert_non_null(strstr(page, "one; two"));
    assert_non_null(strstr(page, "one  two \\name"));
    assert_int_equal(count(page, "data:image/png;base64,"), 3);
    assert_non_null(strstr(page, "base64,Zm9vYmFy\""));
    assert_true(strstr(page, "base64,Zm9vYmE=\"") < strstr(page, "base64,Zm9vYg==\""));
    assert_null(strstr(page, "src=\"http"));
    assert_null(strstr(page, "href"));
    brc_memory_free(page);
    test_remove_folder(folder);
}

static void rows_of_a_case_are_a_table(void **state)
{
    (void)state;
    static const char rows[] = "[{\"case\": \"a\", \"ours\": 1.5}, {\"case\": \"b\", \"paper\": 2}]\n";
    char *folder = test_new_folder();
    put(folder, "rows.json", rows, strlen(rows));
    assert_int_equal(brc_report_write(test_context, folder, NULL), BRC_OK);
    char *page = test_read(test_path(folder, "report.html"));
    assert_non_null(strstr(page, "<tr><th>case</th><th>ours</th><th>paper</th></tr>"));
    assert_non_null(strstr(page, "<tr><td>b</td><td></td><td>2</td></tr>"));
    brc_memory_free(page);
    test_remove_folder(folder);
}

static void folders_without_results_and_damaged_files_are_refused(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    assert_int_equal(brc_report_write(test_context, folder, NULL), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "no summary.json and no rows.json"));
    put(folder, "summary.json", "{\"a\": [1, 2\n", 12);
    assert_int_equal(brc_report_write(test_context, folder, NULL), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "summary.json:2:1: error"));
    assert_false(brc_file_exists(test_path(folder, "report.html")));
    test_remove_folder(folder);
}

static void a_damaged_frame_costs_the_view_and_not_the_page(void **state)
{
    (void)state;
    static const char rows[] = "stage,step,stage_time,time_s,a</script> [m]\n0,0,0,0,1\n0,1,1,1,2\n";
    char *folder = test_new_folder();
    put(folder, "summary.json", SUMMARY, strlen(SUMMARY));
    put(folder, "histories.csv", rows, strlen(rows));
    assert_int_equal(brc_file_make_folder(test_context, test_path(folder, "frames")), BRC_OK);
    put(folder, "frames/000000.vtkhdf", "no frame", 8);
    assert_int_equal(brc_report_write(test_context, folder, NULL), BRC_OK);
    char *page = test_read(test_path(folder, "report.html"));
    assert_non_null(strstr(page, "\"no_view\": "));
    assert_non_null(strstr(page, "cannot be opened as an HDF5 file"));
    assert_null(strstr(page, "id=\"view-surface\""));
    assert_non_null(strstr(page, "a\\u003c/script>")); /* words of a file end no script */
    assert_null(strstr(page, "a</script>"));
    assert_non_null(strstr(page, "Apache License"));
    assert_non_null(strstr(page, "copyright notice and this permission notice"));
    brc_memory_free(page);
    test_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_page_holds_values_shares_and_pictures_and_needs_nothing_else),
        cmocka_unit_test(rows_of_a_case_are_a_table),
        cmocka_unit_test(a_damaged_frame_costs_the_view_and_not_the_page),
        cmocka_unit_test(folders_without_results_and_damaged_files_are_refused),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
