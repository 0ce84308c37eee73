/* Curves of a report, which gnuplot draws: a program of its own, since it can be missing. */
#include "support.h"
#include "../skip.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include "../../host/output/report.h"
#include <string.h>
#include <unistd.h>

/* Two units: two figures; a static run has no time and is drawn over its load. */
static void put(const char *folder, const char *name, const char *text)
{
    assert_int_equal(brc_file_write_whole(test_context, test_path(folder, name), text, strlen(text)), BRC_OK);
}

static void sensors_of_one_unit_share_a_figure(void **state)
{
    (void)state;
    static const char summary[] = "{\"title\": \"curves\", \"end\": {\"status\": \"done\", \"reason\": \"\"}}\n";
    static const char rows[] = "stage,step,stage_time,time_s,a [m],it's [J],c [m]\n0,0,0,0,0,0,1\n0,1,0.5,0,1,2,\n0,2,1,0,3,2,3\n";
    char *folder = test_new_folder();
    put(folder, "summary.json", summary);
    put(folder, "histories.csv", rows);
    assert_int_equal(brc_report_write(test_context, folder, test_path(folder, "page.html")), BRC_OK);
    char *page = test_read(test_path(folder, "page.html"));
    const char *first = strstr(page, "data:image/png;base64,iVBOR"), *second = first ? strstr(first + 1, "data:image/png;base64,iVBOR") : NULL; /* the signature of a PNG */
    assert_non_null(second);
    assert_null(strstr(second + 1, "data:image/png"));
    assert_false(brc_file_exists(test_path(folder, "report-curve.png")));
    brc_memory_free(page);
    test_remove_folder(folder);
}

int main(void)
{
    if (access("/usr/bin/gnuplot", X_OK) != 0) return test_skip("gnuplot is not installed (Debian: gnuplot-nox)");
    const struct CMUnitTest tests[] = {cmocka_unit_test(sensors_of_one_unit_share_a_figure)};
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
