#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/pictures/isotropy_picture.h"
#include "../../../preprocess/domain/icosphere.h"
#include <cairo.h>
#include <math.h>

static char *folder;

static int begin(void **state)
{
    folder = test_new_folder();
    return test_begin(state);
}

static int end(void **state)
{
    test_remove_folder(folder);
    return test_end(state);
}

/* Every bin's own direction, weighted so that its density is 1 + a P2 of the height, exactly up to a common factor. */
static brc_isotropy histogram(double a)
{
    brc_icosphere sphere;
    brc_isotropy isotropy;
    double *weight;
    assert_int_equal(brc_icosphere_make(test_context, 3, &sphere), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(test_context, &weight, sphere.n_vertices, "test"), BRC_OK);
    for (int32_t v = 0; v < sphere.n_vertices; ++v) {
        const double z = sphere.vertex[3 * v + 2];
        weight[v] = sphere.solid_angle[v] * (1 + a * (3 * z * z - 1) / 2);
    }
    assert_int_equal(brc_isotropy_count(test_context, sphere.n_vertices, sphere.vertex, weight, 3, 1, &isotropy),
                     BRC_OK);
    brc_memory_free(weight);
    brc_icosphere_free(&sphere);
    return isotropy;
}

static cairo_surface_t *draw(const brc_isotropy *isotropy)
{
    assert_int_equal(brc_isotropy_picture(test_context, isotropy, test_path(folder, "a.png")), BRC_OK);
    cairo_surface_t *image = cairo_image_surface_create_from_png(test_path(folder, "a.png"));
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(image), 900);
    return image;
}

static const unsigned char *pixel(cairo_surface_t *image, int x, int y) /* B G R */
{
    return cairo_image_surface_get_data(image) + y * cairo_image_surface_get_stride(image) + 4 * x;
}

static bool is_white(const unsigned char *p)
{
    return p[0] > 250 && p[1] > 250 && p[2] > 250;
}

/* Radius 340 px round (450, 440): the polyhedron of 642 corners covers the disc to 1 %, and the dashed line adds 1 % at
 * most. */
static void even_directions_fill_the_circle_and_nothing_else(void **state)
{
    (void)state;
    brc_isotropy i = histogram(0);
    cairo_surface_t *image = draw(&i);
    int inside = 0, outside = 0;
    for (int y = 70; y < 785; ++y)
        for (int x = 0; x < 900; ++x) {
            const double radius = hypot(x + 0.5 - 450, y + 0.5 - 440);
            inside += radius < 340 && !is_white(pixel(image, x, y));
            outside += radius > 342 && (x > 150 || y < 720) && !is_white(pixel(image, x, y)); /* the axes stand there */
        }
    assert_int_equal(outside, 0);
    assert_true(inside > 0.98 * M_PI * 340 * 340);
    cairo_surface_destroy(image);
    brc_isotropy_free(&i);
}

/* Along z, up in the picture, there are too many directions: red there, blue at the sides. */
static void more_is_red_and_less_is_blue(void **state)
{
    (void)state;
    brc_isotropy i = histogram(0.6);
    cairo_surface_t *image = draw(&i);
    const unsigned char *top = pixel(image, 450, 190), *side = pixel(image, 320, 440);
    assert_true(top[2] > top[0] + 40);
    assert_true(side[0] > side[2] + 20);
    assert_true(is_white(pixel(image, 120, 440))); /* inside the reach of an even histogram */
    cairo_surface_destroy(image);
    brc_isotropy_free(&i);
}

static void a_montage_has_a_place_for_each(void **state)
{
    (void)state;
    brc_isotropy a = histogram(0), b = histogram(0.9);
    const double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    brc_isotropy c;
    assert_int_equal(brc_isotropy_count(test_context, 3, axes, NULL, 3, 1, &c), BRC_OK);
    const brc_isotropy_panel panels[3] = {{&a, "a", "even"}, {&b, "b", ""}, {&c, "c", "spikes"}};
    assert_int_equal(brc_isotropy_montage(test_context, 3, panels, 2, "Three", test_path(folder, "m.png")), BRC_OK);
    cairo_surface_t *image = cairo_image_surface_create_from_png(test_path(folder, "m.png"));
    const int width = cairo_image_surface_get_width(image), height = cairo_image_surface_get_height(image);
    assert_int_equal(width % 2, 0);
    int used[4] = {0};
    for (int y = 44; y < height - 40; ++y) /* below the title, above the legend */
        for (int x = 0; x < width; ++x)
            used[2 * (y > height / 2) + (x >= width / 2)] += !is_white(pixel(image, x, y));
    assert_true(used[0] > width * width / 8); /* a disc of nearly half the width */
    assert_true(used[1] > width * width / 20);
    assert_true(used[2] > width); /* lines */
    assert_int_equal(used[3], 0);
    cairo_surface_destroy(image);
    brc_isotropy_free(&a);
    brc_isotropy_free(&b);
    brc_isotropy_free(&c);
}

static void a_path_that_cannot_be_written_is_a_status(void **state)
{
    (void)state;
    brc_isotropy i = histogram(0);
    assert_int_equal(brc_isotropy_picture(test_context, &i, test_path(folder, "no/such/a.png")), BRC_FILE_FAILED);
    brc_isotropy_free(&i);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(even_directions_fill_the_circle_and_nothing_else, begin, end),
        cmocka_unit_test_setup_teardown(more_is_red_and_less_is_blue, begin, end),
        cmocka_unit_test_setup_teardown(a_montage_has_a_place_for_each, begin, end),
        cmocka_unit_test_setup_teardown(a_path_that_cannot_be_written_is_a_status, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
