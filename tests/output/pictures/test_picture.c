#include "../support.h"
#include "../fake_simulation.h"
#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/pictures/colour.h"
#include "../../../host/output/pictures/label.h"
#include "../../../host/output/pictures/picture.h"
#include <cairo.h>
#include <stdlib.h>

static brc_domain *domain;
static char *folder;

static int begin(void **state)
{
    test_begin(state);
    domain = test_domain(400);
    folder = test_new_folder();
    return 0;
}

static int end(void **state)
{
    brc_domain_free(&domain);
    test_remove_folder(folder);
    return test_end(state);
}

static cairo_surface_t *draw(double low, double slope, double bad)
{
    double *u, *value;
    const int64_t n = domain->n_elements;
    assert_int_equal(BRC_ALLOCATE(test_context, &u, 3 * n, "test"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(test_context, &value, n, "test"), BRC_OK);
    for (int64_t e = 0; e < n; ++e) {
        u[3 * e] = bad;
        value[e] = low + slope * domain->position[3 * e];
    }
    const brc_picture_part cells = {.domain = domain, .displacement = u, .value = value};
    const brc_picture picture = {.n = 1, .part = &cells, .name = "field", .unit = "Pa", .title = "Title"};
    assert_int_equal(brc_picture_draw(test_context, &picture, test_path(folder, "p.png")), BRC_OK);
    brc_memory_free(u);
    brc_memory_free(value);
    cairo_surface_t *image = cairo_image_surface_create_from_png(test_path(folder, "p.png"));
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(image), 1200);
    assert_int_equal(cairo_image_surface_get_height(image), 900);
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

/* The middle of the sample is covered: from the first coloured pixel of a row to its last there is no white one, which
 * a seam between two cells would be. */
static void the_sample_has_no_seams(void **state)
{
    (void)state;
    cairo_surface_t *image = draw(1e6, 1e6, 0);
    for (int y = 300; y <= 600; y += 3) {
        int first = 61, last = 959;
        while (is_white(pixel(image, first, y)))
            ++first;
        while (is_white(pixel(image, last, y)))
            --last;
        assert_true(last - first > 400);
        for (int x = first + 1; x < last; ++x)
            assert_false(is_white(pixel(image, x, y)));
    }
    cairo_surface_destroy(image);
}

static void larger_values_are_lighter(void **state)
{
    (void)state;
    cairo_surface_t *image = draw(1e6, 1e6, 0);
    int before = 0;
    for (int x = 150; x <= 750; x += 150) { /* along the front wall, small x to large */
        const unsigned char *p = pixel(image, x, 450 + (x - 150) / 6);
        const int light = p[0] + 2 * p[1] + p[2];
        assert_true(light > before);
        before = light;
    }
    cairo_surface_destroy(image);
}

static void a_uniform_field_shows_one_colour_and_not_its_rounding(void **state)
{
    (void)state;
    cairo_surface_t *image = draw(1e6, 1e-4, 0);
    const unsigned char *a = pixel(image, 200, 450), *b = pixel(image, 600, 520);
    for (int c = 0; c < 3; ++c)
        assert_true(abs(a[c] - b[c]) <= 40); /* lines between the cells may be hit */
    cairo_surface_destroy(image);
}

static void a_state_that_is_not_finite_gives_a_picture_that_says_so(void **state)
{
    (void)state;
    cairo_surface_t *image = draw(1e6, 1, NAN);
    assert_true(is_white(pixel(image, 300, 300)));
    cairo_surface_destroy(image);
}

static void an_unknown_colour_word_is_refused_with_the_list(void **state)
{
    (void)state;
    brc_scene scene = {.output = {.picture_colour = "temperature"}};
    brc_simulation s = {.scene = &scene, .domain = domain, .factor = 1};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(s.scene, NULL, 1, &alone);
    assert_int_equal(brc_picture_write(test_context, &whole, test_path(folder, "q.png")), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(test_context), "von_mises"));
    brc_context_clear(test_context);
    static const char *const good[] = {"von_mises",  "displacement", "displacement_z",
                                       "velocity_x", "stress_xy",    "strain_yz"};
    strcpy(scene.output.picture_colour, good[5]);
    assert_int_equal(brc_picture_write(test_context, &whole, test_path(folder, "q.png")), BRC_OK);
    static const char *const wrong[] = {"displacement_w", "stress", "stress_xyz", "velocityx", "displacement_xx"};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        strcpy(scene.output.picture_colour, wrong[k]);
        assert_int_equal(brc_picture_write(test_context, &whole, test_path(folder, "q.png")), BRC_BAD_INPUT);
        brc_context_clear(test_context);
    }
}

static void a_picture_that_cannot_be_written_is_file_trouble(void **state)
{
    (void)state;
    brc_scene scene = {.n_stages = 0};
    brc_simulation s = {.scene = &scene, .domain = domain, .factor = 1};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(s.scene, NULL, 1, &alone);
    assert_int_equal(brc_picture_write(test_context, &whole, "no-such-folder/p.png"), BRC_FILE_FAILED);
    brc_context_clear(test_context);
}

static void the_automatic_scale_is_round_and_makes_motion_visible(void **state)
{
    (void)state;
    double *u;
    assert_int_equal(BRC_ALLOCATE(test_context, &u, 3 * domain->n_elements, "test"), BRC_OK);
    const brc_picture_part cells = {.domain = domain, .displacement = u};
    assert_true(brc_picture_automatic_scale(1, &cells) == 1); /* nothing moves */
    for (int64_t e = 0; e < domain->n_elements; ++e)
        u[3 * e] = 3e-7 * domain->position[3 * e] + 1; /* a rigid part does not count */
    const double scale = brc_picture_automatic_scale(1, &cells);
    assert_true(scale == 2e5); /* 0.04 of 2.45 m over 0.9 to 1 times 3e-7 m is 3.3e5 to 3.6e5 */
    for (int64_t e = 0; e < domain->n_elements; ++e)
        u[3 * e] = 0.5 * domain->position[3 * e];
    assert_true(brc_picture_automatic_scale(1, &cells) == 1);
    brc_memory_free(u);
}

/* First and last coloured column along the middle row of a picture of the sample, moved by `shift` along x [m]. */
static void seen(bool steady, double shift, int *first, int *last, int *light)
{
    double *u, *value;
    const int64_t n = domain->n_elements;
    assert_int_equal(BRC_ALLOCATE(test_context, &u, 3 * n, "test"), BRC_OK);
    assert_int_equal(BRC_ALLOCATE(test_context, &value, n, "test"), BRC_OK);
    for (int64_t e = 0; e < n; ++e) {
        u[3 * e] = shift;
        value[e] = 0.5;
    }
    const brc_picture_part cells = {.domain = domain, .displacement = u, .value = value};
    const brc_picture picture = {.n = 1,
                                 .part = &cells,
                                 .name = "field",
                                 .unit = "-",
                                 .title = "",
                                 .scale = 1,
                                 .steady = steady,
                                 .range = {0, steady ? shift + 1 : 0}};
    assert_int_equal(brc_picture_draw(test_context, &picture, test_path(folder, "s.png")), BRC_OK);
    brc_memory_free(u);
    brc_memory_free(value);
    cairo_surface_t *image = cairo_image_surface_create_from_png(test_path(folder, "s.png"));
    for (*first = 61; is_white(pixel(image, *first, 450));)
        ++*first;
    for (*last = 959; is_white(pixel(image, *last, 450));)
        --*last;
    const unsigned char *p = pixel(image, (*first + *last) / 2, 450);
    *light = p[0] + 2 * p[1] + p[2];
    cairo_surface_destroy(image);
}

/* The 2 m long sample is some 600 px wide there: 0.3 m are tens of pixels. */
static void pictures_of_a_sequence_have_one_view_and_one_range(void **state)
{
    (void)state;
    int first[4], last[4], light[4];
    seen(true, 0, &first[0], &last[0], &light[0]);
    seen(true, 0.3, &first[1], &last[1], &light[1]);
    seen(false, 0, &first[2], &last[2], &light[2]);
    seen(false, 0.3, &first[3], &last[3], &light[3]);
    assert_true(first[1] - first[0] > 20 && abs(first[3] - first[2]) <= 1 && abs(last[3] - last[2]) <= 1);
    assert_true(light[1] < light[0]); /* 0.5 of 0 to 1.3 is darker than of 0 to 1 */
}

/* Lightness of OKLab from sRGB, by the published matrices: what "equally far apart" means. */
static double lightness(const double rgb[3])
{
    double linear[3];
    for (int c = 0; c < 3; ++c)
        linear[c] = rgb[c] <= 0.04045 ? rgb[c] / 12.92 : pow((rgb[c] + 0.055) / 1.055, 2.4);
    const double l = cbrt(0.4122214708 * linear[0] + 0.5363325363 * linear[1] + 0.0514459929 * linear[2]);
    const double m = cbrt(0.2119034982 * linear[0] + 0.6806995451 * linear[1] + 0.1073969566 * linear[2]);
    const double s = cbrt(0.0883024619 * linear[0] + 0.2817188376 * linear[1] + 0.6299787005 * linear[2]);
    return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

static void lightness_rises_evenly_along_the_sequential_map(void **state)
{
    (void)state;
    double rgb[3];
    brc_colour_sequential(0, rgb);
    double before = lightness(rgb);
    for (int k = 1; k <= 20; ++k) {
        brc_colour_sequential(k / 20.0, rgb);
        const double now = lightness(rgb);
        assert_true(fabs(now - before - 0.65 / 20) < 2e-3); /* a colour cut off at the screen's edge would show here */
        before = now;
    }
    brc_colour_sequential(NAN, rgb);
    assert_true(rgb[0] == rgb[1] && rgb[1] == rgb[2]);
    double low[3], high[3];
    brc_colour_diverging(0.2, low);
    brc_colour_diverging(0.8, high);
    assert_true(fabs(lightness(low) - lightness(high)) < 5e-3);
    assert_true(low[2] > low[0] && high[0] > high[2]);
}

static void labels_are_round_and_carry_prefixes(void **state)
{
    (void)state;
    char words[64];
    assert_true(brc_label_step(1.0, 5) == 0.2);
    assert_true(fabs(brc_label_unit("Pa", 3.2e7, words) / 1e-6 - 1) < 1e-15);
    assert_string_equal(words, "MPa");
    assert_true(fabs(brc_label_unit("m", 2e-7, words) / 1e9 - 1) < 1e-15);
    assert_string_equal(words, "nm");
    assert_true(brc_label_unit("-", 2e-7, words) == 1);
    assert_true(brc_label_unit("m", 5000, words) == 1);
    brc_label_number(1.25, 0.05, words);
    assert_string_equal(words, "1.25");
    brc_label_number(-1e-18, 0.5, words);
    assert_string_equal(words, "0.0");
    brc_label_number(2e-7, 5e-8, words);
    assert_string_equal(words, "2.0e-07");
    assert_true(brc_label_unit("kg", 2.5e-3, words) == 1e3);
    assert_string_equal(words, "g");
    assert_true(brc_label_unit("m^2", 6.3e-3, words) == 1e6);
    assert_string_equal(words, "mm^2");
    brc_label_value(8062403.6, "Pa", 5, words);
    assert_string_equal(words, "8.0624 MPa");
    brc_label_value(4.564, "N m", 4, words);
    assert_string_equal(words, "4.564 N m");
    brc_label_value(0.25, "-", 5, words);
    assert_string_equal(words, "0.25");
    brc_label_error(8.0624e6, 8e6, 0.0078, words);
    assert_string_equal(words, "+0.78 %");
    brc_label_error(0.202, 0.2, 0.002, words);
    assert_string_equal(words, "+0.002");
}

/* Pixels of a drawn box of 2 x 1 x 1 m, seen from a side: wide and tall. */
static void extent_seen(const brc_paint_view *view, int *wide, int *tall)
{
    double *zero = calloc((size_t)(3 * domain->n_elements), sizeof *zero);
    const brc_picture_part cells = {.domain = domain, .displacement = zero, .value = zero};
    const brc_picture picture = {
        .n = 1, .part = &cells, .name = "", .unit = "-", .title = "", .scale = 1, .view = view};
    assert_int_equal(brc_picture_draw(test_context, &picture, test_path(folder, "p.png")), BRC_OK);
    cairo_surface_t *image = cairo_image_surface_create_from_png(test_path(folder, "p.png"));
    int low[2] = {1200, 900}, high[2] = {0, 0};
    for (int y = 95; y < 825; ++y)
        for (int x = 150; x < 975; ++x) {
            const unsigned char *p = pixel(image, x, y);
            if (is_white(p) || abs(p[0] - p[2]) < 20) continue; /* words and lines are grey */
            low[0] = x < low[0] ? x : low[0], high[0] = x > high[0] ? x : high[0];
            low[1] = y < low[1] ? y : low[1], high[1] = y > high[1] ? y : high[1];
        }
    *wide = high[0] - low[0] + 1;
    *tall = high[1] - low[1] + 1;
    cairo_surface_destroy(image);
    free(zero);
}

static void a_box_has_the_sides_of_its_views(void **state)
{
    (void)state;
    static const double from[3] = {1, 0.5, 9}, towards[3] = {1, 0.5, 0.5};
    const brc_paint_view above = brc_paint_side_view("z"), end_on = brc_paint_side_view("-x"),
                         same = brc_paint_view_between(from, towards);
    int wide, tall;
    extent_seen(&end_on, &wide, &tall);
    assert_in_range(wide, tall - 2, tall + 2);
    extent_seen(&above, &wide, &tall);
    assert_in_range(wide, 805, 815); /* 900 px from 60 on, of which those from 150 on are looked at */
    assert_in_range(tall, 440, 460);
    assert_memory_equal(&same, &above, sizeof same);
}

static void views_are_right_handed_and_their_labels_apart(void **state)
{
    (void)state;
    static const double origin[2] = {90, 830}, none[3] = {0, 0, 0};
    for (int k = 0; k < 4000; ++k) {
        const double angle = 0.01 * k, from[3] = {cos(angle), sin(angle),
                                                  k % 7 == 0 ? 0
                                                  : k % 2    ? 0.05 * k
                                                             : -0.01 * k};
        const brc_paint_view v = brc_paint_view_between(from, none);
        double label[3][2];
        for (int c = 0; c < 3; ++c) {
            const int a = (c + 1) % 3, b = (c + 2) % 3;
            assert_true(fabs(v.right[a] * v.up[b] - v.right[b] * v.up[a] - v.toward[c]) < 1e-12);
        }
        brc_paint_axis_labels(&v, origin, 52, label);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < i; ++j)
                assert_true(hypot(label[i][0] - label[j][0], label[i][1] - label[j][1]) >= 17.99);
    }
    const brc_paint_view odd = brc_paint_side_view("corner"), corner = brc_paint_corner_view();
    assert_memory_equal(&odd, &corner, sizeof odd);
}

/* Bytes of the picture of a small stretch; the caller frees them. */
static char *drawn(const brc_scene *scene, size_t *n)
{
    char *bytes;
    brc_simulation s = {.scene = scene, .domain = domain, .factor = 1, .gradient = {{1e-4}}};
    brc_simulation *const alone = &s;
    const brc_assembly whole = brc_assembly_make(scene, NULL, 1, &alone);
    assert_int_equal(brc_picture_write(test_context, &whole, test_path(folder, "q.png")), BRC_OK);
    assert_int_equal(brc_file_read_whole(test_context, test_path(folder, "q.png"), 1 << 26, &bytes, n), BRC_OK);
    return bytes;
}

static void solids_that_touch_are_drawn_where_they_are(void **state)
{
    (void)state;
    const brc_scene free = {.n_strikers = 0}, touching = {.has_contact = true},
                    fixed = {.output = {.picture_scale = 1}};
    size_t n[3];
    char *const bytes[3] = {drawn(&free, &n[0]), drawn(&touching, &n[1]), drawn(&fixed, &n[2])};
    assert_int_equal(n[1], n[2]);
    assert_memory_equal(bytes[1], bytes[2], n[1]);
    assert_true(n[0] != n[2] || memcmp(bytes[0], bytes[2], n[0]) != 0); /* this one is amplified */
    for (int k = 0; k < 3; ++k)
        brc_memory_free(bytes[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sample_has_no_seams),
        cmocka_unit_test(larger_values_are_lighter),
        cmocka_unit_test(a_uniform_field_shows_one_colour_and_not_its_rounding),
        cmocka_unit_test(a_state_that_is_not_finite_gives_a_picture_that_says_so),
        cmocka_unit_test(an_unknown_colour_word_is_refused_with_the_list),
        cmocka_unit_test(a_picture_that_cannot_be_written_is_file_trouble),
        cmocka_unit_test(the_automatic_scale_is_round_and_makes_motion_visible),
        cmocka_unit_test(pictures_of_a_sequence_have_one_view_and_one_range),
        cmocka_unit_test(lightness_rises_evenly_along_the_sequential_map),
        cmocka_unit_test(labels_are_round_and_carry_prefixes),
        cmocka_unit_test(a_box_has_the_sides_of_its_views),
        cmocka_unit_test(views_are_right_handed_and_their_labels_apart),
        cmocka_unit_test(solids_that_touch_are_drawn_where_they_are),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
