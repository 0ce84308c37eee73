#include "support.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/base/random.h"
#include "../../preprocess/points.h"

#include <locale.h>
#include <stdio.h>
#include <string.h>

static const char path[] = "test-points.csv";

static void write_text(const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

typedef struct points {
    double *position, *radius;
    int64_t n;
} points;

static points read_text(brc_context *context, const char *text)
{
    points p;
    write_text(text);
    if (brc_points_read(context, path, 1.0, &p.position, &p.radius, &p.n) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    return p;
}

static void free_points(points *p)
{
    brc_memory_free(p->position);
    brc_memory_free(p->radius);
}

static void refused(brc_context *context, const char *text, const char *part)
{
    points p;
    write_text(text);
    brc_context_clear(context);
    assert_int_equal(brc_points_read(context, path, 1.0, &p.position, &p.radius, &p.n), BRC_BAD_INPUT);
    assert_null(p.position);
    assert_null(p.radius);
    assert_int_equal(p.n, 0);
    test_says(context, part);
}

static void the_same_points_come_out_of_every_separator_order_and_line_end(void **state)
{
    static const char *const texts[] = {
        "x,y,z,radius\n1,2,3,0.5\n-4e-3,5.25,6,0.25\n",
        "x;y;z;radius\r\n1;2;3;0.5\r\n-4e-3;5.25;6;0.25\r\n",
        "x\ty\tz\tradius\tnote\n1\t2\t3\t0.5\t\n-4e-3\t5.25\t6\t0.25\tlast",
        "note\tx\ty\tz\tradius\n\t1\t2\t3\t0.5\nb\t-4e-3\t5.25\t6\t0.25\n",
        "  x y   z radius\n# a comment\n 1 2 3 0.5 \n\n-4e-3\t5.25 6   0.25",
        "# made by hand\nradius, Z ,Y,X\n0.5,3,2,1\n0.25, 6,5.25 ,-.4E-2\n",
        "\xef\xbb\xbf\"name\",\"x\",\"y\",\"z\",\"diameter\"\n\"a, b\",1,2,3,1\n\"c\",\"-4e-3\",5.25,6,0.5\n",
        "x,y,z,radius\n1,2,3,0.5,\n-0.004,5.25,6,0.25,\n",
    };
    const double x[6] = {1.0, 2.0, 3.0, -4e-3, 5.25, 6.0}, r[2] = {0.5, 0.25};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        points p = read_text(*state, texts[k]);
        assert_int_equal(p.n, 2);
        assert_non_null(p.radius);
        for (int c = 0; c < 6; ++c)
            assert_true(p.position[c] == x[c]);
        for (int c = 0; c < 2; ++c)
            assert_true(p.radius[c] == r[c]);
        free_points(&p);
    }
}

static void files_without_radii_give_none(void **state)
{
    points p = read_text(*state, "id,x,y,z,volume\n0,1,2,3,9\n");
    assert_int_equal(p.n, 1);
    assert_null(p.radius);
    free_points(&p);
}

static void the_scale_turns_file_units_into_metres(void **state)
{
    points p;
    write_text("x,y,z,diameter\n1,2,4,8\n");
    assert_int_equal(brc_points_read(*state, path, 0.125, &p.position, &p.radius, &p.n), BRC_OK);
    assert_true(p.position[0] == 0.125 && p.position[1] == 0.25 && p.position[2] == 0.5 && p.radius[0] == 0.5);
    free_points(&p);
    assert_int_equal(brc_points_read(*state, path, 0.0, &p.position, &p.radius, &p.n), BRC_BAD_INPUT);
    test_says(*state, "scale is 0 m, must be finite and > 0");
    assert_int_equal(brc_points_read(*state, path, 1e308, &p.position, &p.radius, &p.n), BRC_BAD_INPUT);
    test_says(*state, "beyond what a double holds");
}

static void every_fault_names_its_line_and_column(void **state)
{
    refused(*state, "x,y,z\n1,2,3\n1,two,3\n", "test-points.csv:3:3: y is 'two', expected a number");
    refused(*state, "x,y,z\n1,2,3m\n", ":2:5: z is '3m', expected a number");
    refused(*state, "x,y,z\n1,nan,3\n", ":2:3: y is 'nan', expected a number");
    refused(*state, "x,y,z\n1,-inf,3\n", ":2:3: y is '-inf', expected a number");
    refused(*state, "x,y,z\n1,2,1e999\n", ":2:5: z is '1e999', expected a number that a double holds");
    refused(*state, "x,y,z\n0x10,2,3\n", ":2:1: x is '0x10', expected a number");
    refused(*state, "x,y,z\n1,,3\n", ":2:3: y is empty, expected a number");
    refused(*state, "x;y;z\n1,5;2;3\n", ":2:1: x is '1,5', expected a number with a decimal point");
    refused(*state, "x,y,z\n1,5,2,5,3,5\n",
            ":2:7: more fields than the 3 names of the header; numbers need a decimal point");
    refused(*state, "x,y,z\n1,2\n", ":2:4: 2 fields, expected the 3 of the header");
    refused(*state, "x,y,z,radius\n1,2,3,0\n", ":2:1: radius is 0, must be > 0");
    refused(*state, "x,y,z,diameter\n1,2,3,-1\n", "diameter is -1, must be > 0");
    refused(*state, "1,2,3\n4,5,6\n", ":1:1: '1,2,3' names no coordinate, expected a row of names: x, y, z");
    refused(*state, "# x,y,z\n1,2,3\n", "a row behind '#' is a comment");
    refused(*state, "x,y,radius\n1,2,3\n", ":1:1: no column 'z'");
    refused(*state, "x,y,z,x\n1,2,3,4\n", ":1:7: a second column 'x'");
    refused(*state, "x,y,z,radius,diameter\n1,2,3,4,8\n", "'radius' and 'diameter', expected one of them");
    refused(*state, "", "no row found, expected a row of names");
    refused(*state, "x,y,z\n# nothing\n", "no point follows the header");
    remove(path);
    points p;
    assert_int_equal(brc_points_read(*state, path, 1.0, &p.position, &p.radius, &p.n), BRC_BAD_INPUT);
    test_says(*state, "test-points.csv: cannot open");
}

static void all_bad_lines_are_told_at_once_and_at_most_twenty_in_words(void **state)
{
    char text[2048] = "x,y,z\n";
    for (int k = 0; k < 23; ++k)
        strcat(text, k % 2 ? "1,2,c\n" : "a,b,3\n");
    strcat(text, "1,2,3\n");
    refused(*state, text, ":2:1: x is 'a'");
    test_says(*state, ":3:5: z is 'c'");
    test_says(*state, ":21:5: z is 'c'");
    test_says(*state, "3 more bad lines");
    const char *message = brc_context_message(*state);
    assert_null(strstr(message, ":22:"));
    int sentences = 1;
    for (const char *c = message; *c; ++c)
        sentences += *c == '\n';
    assert_int_equal(sentences, 21); /* one a line, though the odd ones have two faults */
}

/* Doubles of all magnitudes; %.17g is enough for any (IEEE 754), so equality is exact. */
static void points_written_read_back_bit_for_bit(void **state)
{
    enum { N = 200000 };
    brc_domain d = {.element_kind = BRC_ELEMENT_SPHERE, .n_elements = N};
    assert_int_equal(BRC_ALLOCATE(*state, &d.position, 3 * N, "positions"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(*state, &d.radius, N, "radii"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(*state, &d.region, N, "regions"), BRC_OK);
    d.volume = d.radius;
    d.body = d.grain = d.region;
    for (int e = 0; e < N; ++e) {
        double u[4];
        brc_random_uniform4(11, BRC_RANDOM_TEST, (uint64_t)e, 0, u);
        for (int k = 0; k < 3; ++k)
            d.position[3 * e + k] = (u[k] - 0.5) * exp(200.0 * (u[3] - 0.5));
        d.radius[e] = u[3] / 3.0;
        d.region[e] = e / 7;
    }
    setlocale(LC_ALL, "de_DE.UTF-8"); /* where it exists, it has a decimal comma */
    const double start = brc_clock_s();
    assert_int_equal(brc_points_write(*state, &d, path), BRC_OK);
    const double written = brc_clock_s();
    points p;
    assert_int_equal(brc_points_read(*state, path, 1.0, &p.position, &p.radius, &p.n), BRC_OK);
    print_message("%d points: %.2f s to write, %.2f s to read\n", N, written - start, brc_clock_s() - written);
    setlocale(LC_ALL, "C");
    assert_int_equal(p.n, N);
    assert_memory_equal(p.position, d.position, 3 * N * sizeof(double));
    assert_memory_equal(p.radius, d.radius, N * sizeof(double));
    free_points(&p);
    brc_memory_free(d.position);
    brc_memory_free(d.radius);
    brc_memory_free(d.region);
    assert_int_equal(remove("test-points.csv.part"), -1); /* nothing is left aside */
    remove(path);
}

/* Positions read back to the same bits, so the cells made of them are the same, bit for bit. */
static void a_domain_built_from_its_own_elements_is_the_same(void **state)
{
    brc_build_request request = test_box(1000, 0.9);
    brc_domain *first = test_build(*state, &request);
    assert_int_equal(brc_points_write(*state, first, path), BRC_OK);
    request.fill = (brc_fill){.kind = BRC_FILL_POINTS, .scale = 1.0};
    strcpy(request.fill.file, path);
    brc_domain *second = test_build(*state, &request);
    assert_int_equal(second->n_elements, first->n_elements);
    assert_int_equal(second->n_bonds, first->n_bonds);
    assert_memory_equal(second->position, first->position, 3 * (size_t)first->n_elements * sizeof(double));
    assert_memory_equal(second->volume, first->volume, (size_t)first->n_elements * sizeof(double));
    assert_memory_equal(second->area_vector, first->area_vector, 3 * (size_t)first->n_half_edges * sizeof(double));
    brc_domain_free(&first);
    brc_domain_free(&second);
    remove(path);
}

static void the_header_row_names_what_the_domain_has(void **state)
{
    double position[3] = {0.5, 0.25, -1.0}, volume[1] = {2.0}, radius[1] = {0.125};
    int32_t region[1] = {1}, body[1] = {3}, grain[1] = {7};
    brc_domain domain = {.n_elements = 1, .position = position, .volume = volume, .region = region, .body = body};
    char text[2][200];
    for (int k = 0; k < 2; ++k) {
        domain.radius = k ? radius : NULL;
        domain.grain = k ? grain : NULL;
        assert_int_equal(brc_points_write(*state, &domain, path), BRC_OK);
        FILE *file = fopen(path, "rb");
        assert_non_null(file);
        text[k][fread(text[k], 1, sizeof text[k] - 1, file)] = '\0';
        fclose(file);
    }
    assert_string_equal(text[0], "id,x,y,z,volume,region,body\n0,0.5,0.25,-1,2,1,3\n");
    assert_string_equal(text[1], "id,x,y,z,radius,volume,region,body,grain\n0,0.5,0.25,-1,0.125,2,1,3,7\n");
    assert_int_equal(brc_points_write(*state, &domain, "no/such/folder/points.csv"), BRC_FILE_FAILED);
    test_says(*state, "cannot create");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_same_points_come_out_of_every_separator_order_and_line_end, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(files_without_radii_give_none, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_scale_turns_file_units_into_metres, test_begin, test_end),
        cmocka_unit_test_setup_teardown(every_fault_names_its_line_and_column, test_begin, test_end),
        cmocka_unit_test_setup_teardown(all_bad_lines_are_told_at_once_and_at_most_twenty_in_words, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(points_written_read_back_bit_for_bit, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_domain_built_from_its_own_elements_is_the_same, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_header_row_names_what_the_domain_has, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
