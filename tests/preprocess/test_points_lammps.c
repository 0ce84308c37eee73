#include "support.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../preprocess/points.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char path[] = "test-points.lmp";

typedef struct points {
    double *position, *radius;
    int64_t n;
} points;

static void write_text(const char *section, const char *rows, const char *after)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file,
            "x,y,z in the comment line that LAMMPS never reads\n\n3 atoms  # of two types\n2 bonds\n2 atom types\n"
            "0 10 xlo xhi\n0 10 ylo yhi\n-1 1 zlo zhi\n0 0 0 xy xz yz\n\nMasses\n\n1 1.0\n2 2.0\n\n%s\n\n%s%s",
            section, rows, after);
    assert_int_equal(fclose(file), 0);
}

static points read_rows(brc_context *context, const char *section, const char *rows)
{
    points p;
    write_text(section, rows, "\nVelocities\n\n1 0 0 0\n2 0 0 0\n3 0 0 0\n");
    if (brc_points_read(context, path, 1.0, &p.position, &p.radius, &p.n) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    return p;
}

static void free_points(points *p)
{
    brc_memory_free(p->position);
    brc_memory_free(p->radius);
}

static void refused(brc_context *context, const char *section, const char *rows, const char *part)
{
    points p;
    write_text(section, rows, "");
    brc_context_clear(context);
    assert_int_equal(brc_points_read(context, path, 1.0, &p.position, &p.radius, &p.n), BRC_BAD_INPUT);
    assert_null(p.position);
    assert_null(p.radius);
    test_says(context, part);
}

typedef struct style_case {
    const char *section, *rows;
    bool spheres;
} style_case;

/* The same three points in every style, by name and, where the number of columns tells it, without. */
static const style_case cases[] = {
    {"Atoms # atomic", "3 1 7 8 9\n1 2 1 2 3\n2 1 4 5 6.5\n", false},
    {"Atoms", "3 1 7 8 9\n1 2 1 2 3\n2 1 4 5 6.5\n", false},
    {"Atoms", "3 1 7 8 9 0 0 -1\n1 2 1 2 3 0 1 0\n2 1 4 5 6.5 0 0 0\n", false},
    {"Atoms  # sphere", "1 1 0.5 2.7 1 2 3\r\n2 1 0.25 2.7 4 5 6.5\r\n3 2 1 2.7 7 8 9\r\n", true},
    {"Atoms #sphere", "1 1 0.5 2.7 1 2 3 0 0 0\n2 1 0.25 2.7 4 5 6.5 0 0 0\n3 2 1 2.7 7 8 9 0 0 0\n", true},
    {"Atoms", "1 1 0.5 2.7 1 2 3\n2 1 0.25 2.7 4 5 6.5 # a comment\n3 2 1 2.7 7 8 9\n", true},
    {"Atoms # bond", "1 5 1 1 2 3\n2 5 C 4 5 6.5\n3 5 1 7 8 9\n", false},
    {"Atoms # molecular", "1 5 1 1 2 3\n2 5 1 4 5 6.5\n3 5 1 7 8 9\n", false},
    {"Atoms # angle", "1 5 1 1 2 3 0 0 0\n2 5 1 4 5 6.5 0 0 0\n3 5 1 7 8 9 0 0 0\n", false},
    {"Atoms", "1 5 1 1 2 3\n2 5 1 4 5 6.5\n3 5 1 7 8 9\n", false},
    {"Atoms # bpm/sphere", "1 0 1 0.5 2.7 1 2 3\n2 0 1 0.25 2.7 4 5 6.5\n3 0 1 1 2.7 7 8 9\n", true},
    {"Atoms", "1 0 1 0.5 2.7 1 2 3\n2 0 1 0.25 2.7 4 5 6.5\n3 0 1 1 2.7 7 8 9\n", true},
    {"Atoms", "1 0 1 0.5 2.7 1 2 3 0 0 0\n2 0 1 0.25 2.7 4 5 6.5 0 0 0\n3 0 1 1 2.7 7 8 9 0 0 0\n", true},
};

static void every_style_gives_the_same_points_by_ascending_id(void **state)
{
    const double x[9] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.5, 7.0, 8.0, 9.0}, r[3] = {0.25, 0.125, 0.5};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        points p = read_rows(*state, cases[k].section, cases[k].rows);
        assert_int_equal(p.n, 3);
        for (int c = 0; c < 9; ++c)
            assert_true(p.position[c] == x[c]);
        assert_true(cases[k].spheres == (p.radius != NULL));
        for (int c = 0; p.radius && c < 3; ++c)
            assert_true(p.radius[c] == r[c]);
        free_points(&p);
    }
}

static void faults_name_their_place_and_the_cure(void **state)
{
    refused(*state, "Atoms # full", "1 1 1 0 1 2 3\n2 1 1 0 4 5 6\n3 1 1 0 7 8 9\n",
            ":16:9: atom style 'full', expected atomic, sphere, bond");
    refused(*state, "Atoms # atomic", "1 1 1 2 3\n2 1 1 2\n3 1 1 2 3\n",
            ":19:1: 4 columns, expected the 5 of style 'atomic', or 8");
    refused(*state, "Atoms # atomic", "1 1 1 2 3\n2 1 1 b 3\n3 1 1 2 3\n", ":19:7: y is 'b', expected a number");
    refused(*state, "Atoms # atomic", "1 1 1 2 3\n2.5 1 1 2 3\n3 1 1 2 3\n",
            ":19:1: the atom's id is '2.5', expected a whole number");
    refused(*state, "Atoms # atomic", "1 1 1 2 3 0 0 0.5\n2 1 1 2 3\n3 1 1 2 3\n", ":18:15: an image flag is '0.5'");
    refused(*state, "Atoms # sphere", "1 1 0 2.7 1 2 3\n2 1 1 2 1 2 3\n3 1 1 2 1 2 3\n",
            ":18:5: diameter is 0, must be > 0");
    refused(*state, "Atoms # atomic", "3 1 1 2 3\n1 1 1 2 3\n3 1 4 5 6\n",
            ":20:1: a second atom 3, the first is on line 18");
    refused(*state, "Atoms # atomic", "1 1 1 2 3\n2 1 1 2 3\n\n", "ends after 2 rows, the header says 3 atoms");
    refused(*state, "Atoms # atomic", "1 1 1 2 3\n2 1 1 2 3\n3 1 1 2 3\n4 1 1 2 3\n",
            "ends after 4 rows, the header says 3 atoms");
    refused(*state, "Atoms # atomic", "1 1 1 2 3\n", "the header says 3 atoms, only 2 lines follow here");
    refused(*state, "Atoms", "1 2 3 4\n2 2 3 4\n3 2 3 4\n", "4 columns belong to no atom style");
    refused(*state, "Bonds", "1 1 1 2\n2 1 2 3\n\n", "the file ends without a section 'Atoms'");
}

static void the_first_line_is_never_read(void **state)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("3 atoms\n\nAtoms # atomic\n\n1 1 1 2 3\n", file);
    fclose(file);
    points p;
    assert_int_equal(brc_points_read(*state, path, 1.0, &p.position, &p.radius, &p.n), BRC_BAD_INPUT);
    test_says(*state, "no 'N atoms' between the first line, which LAMMPS takes as a comment");
}

/* What is said on stderr while reading the rows. */
static void said(brc_context *context, const char *section, const char *rows, const char *part)
{
    char text[2048];
    test_caught caught = test_catch_stderr();
    brc_log_set_level(context, BRC_LOG_INFO);
    points p = read_rows(context, section, rows);
    test_release_stderr(&caught, text, sizeof text);
    free_points(&p);
    if (!strstr(text, part)) fail_msg("expected '%s' in: %s", part, text);
}

static void what_was_assumed_about_box_and_style_is_said(void **state)
{
    said(*state, cases[0].section, cases[0].rows, "3 atoms of style 'atomic'; the box is not used, nothing is wrapped");
    said(*state, cases[2].section, cases[2].rows, "2 atoms have image flags; positions are taken as they are written");
    said(*state, cases[2].section, cases[2].rows, "names no style; 8 columns are read as 'atomic'");
    said(*state, cases[11].section, cases[11].rows, "names no style; 8 columns are read as 'bpm/sphere'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_style_gives_the_same_points_by_ascending_id, test_begin, test_end),
        cmocka_unit_test_setup_teardown(faults_name_their_place_and_the_cure, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_first_line_is_never_read, test_begin, test_end),
        cmocka_unit_test_setup_teardown(what_was_assumed_about_box_and_style_is_said, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
