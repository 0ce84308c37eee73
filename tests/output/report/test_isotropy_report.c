#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/report/isotropy_report.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One row a bin: solid angles of a sphere, every bond in two bins, and densities whose mean over the sphere is 1. */
static void the_table_counts_every_bond_in_both_senses(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_domain *domain = test_domain(400);
    assert_int_equal(brc_isotropy_report(test_context, domain, 2, test_path(folder, "new/dir")), BRC_OK);
    char *text = test_read(test_path(folder, "new/dir/isotropy.csv")), *at = text;
    assert_int_equal(strncmp(text, "x,y,z,solid_angle_sr,count,density\n", 35), 0);
    double angle = 0, count = 0, mean = 0;
    int rows = 0;
    for (at += 35; *at; at = strchr(at, '\n') + 1, ++rows) {
        double v[6];
        char *from = at;
        for (int k = 0; k < 6; ++k)
            v[k] = strtod(from, &from), ++from;
        assert_true(fabs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) < 1e-14);
        angle += v[3];
        count += v[4];
        mean += v[3] * v[5] / (4 * M_PI);
    }
    assert_int_equal(rows, 162);
    assert_true(fabs(angle - 4 * M_PI) < 1e-12);
    assert_true(count == 2 * (double)domain->n_bonds);
    assert_true(fabs(mean - 1) < 1e-12);
    assert_true(brc_file_exists(test_path(folder, "new/dir/isotropy.vtp")));
    assert_true(brc_file_exists(test_path(folder, "new/dir/isotropy.png")));
    brc_memory_free(text);
    brc_domain_free(&domain);
    test_remove_folder(folder);
}

static void a_level_that_is_not_there_is_refused(void **state)
{
    (void)state;
    brc_domain *domain = test_domain(100);
    assert_int_equal(brc_isotropy_report(test_context, domain, 9, "never-made"), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "level 9"));
    assert_false(brc_file_exists("never-made"));
    brc_domain_free(&domain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_table_counts_every_bond_in_both_senses, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_level_that_is_not_there_is_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
