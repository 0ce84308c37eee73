/* What breaks, in files: growing tables, statistics, surfaces, sensors, the end of a stage by a sensor. */
#include "../support.h"
#include "../fake_simulation.h"
#include "../../../host/base/file.h"
#include "../../../host/output/append.h"
#include "../../../host/output/sensors/crack_sensors.h"
#include "../../../host/output/cracks/crack_statistics.h"
#include "../../../host/output/cracks/crack_surface.h"
#include "../../../host/output/frames/deform.h"
#include "../../../host/output/sensors/stop.h"
#include <stdlib.h>

/* ---- files that grow ---- */

static void a_file_grows_text_by_text(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    const char *path = test_path(folder, "grows.csv");
    brc_append *file;
    brc_text text = {.context = test_context};
    assert_int_equal(brc_append_create(test_context, path, "head\n", &file), BRC_OK);
    char *read = test_read(path);
    assert_string_equal(read, "head\n"); /* there at once, for a run that is killed */
    brc_memory_free(read);
    brc_text_add(&text, "one\n");
    assert_int_equal(brc_append_add(test_context, file, &text), BRC_OK);
    assert_int_equal(brc_append_add(test_context, file, &text), BRC_OK);
    read = test_read(path);
    assert_string_equal(read, "head\none\none\n");
    brc_memory_free(read);
    /* pieces: short ones wait, long ones go, and what did not come to its end is taken back */
    text.length = 0;
    brc_text_add(&text, "two\n");
    assert_int_equal(brc_append_piece(test_context, file, &text), BRC_OK);
    assert_true(text.length == 4 && brc_append_bytes(file) == 13);
    while (text.length < 70000)
        brc_text_add(&text, "row\n");
    const int64_t long_one = (int64_t)text.length;
    assert_int_equal(brc_append_piece(test_context, file, &text), BRC_OK);
    assert_true(text.length == 0 && brc_append_bytes(file) == 13 + long_one);
    brc_append_cut(file, 13);
    brc_text_add(&text, "three\n");
    assert_int_equal(brc_append_add(test_context, file, &text), BRC_OK);
    read = test_read(path);
    assert_string_equal(read, "head\none\none\nthree\n");
    brc_memory_free(read);
    assert_int_equal(brc_append_finish(test_context, file), BRC_OK);
    brc_append_free(&file);
    brc_append_free(&file);
    brc_text_free(&text);
    assert_int_equal(brc_append_create(test_context, test_path(folder, "no/such/file"), "head\n", &file),
                     BRC_FILE_FAILED);
    assert_null(file);
    brc_context_clear(test_context);
    test_remove_folder(folder);
}

static void a_full_disk_is_told(void **state)
{
    (void)state;
    brc_append *file;
    assert_int_equal(brc_append_create(test_context, "/dev/full", "head\n", &file), BRC_FILE_FAILED);
    if (!strstr(brc_context_message(test_context), "free some space"))
        fail_msg("%s", brc_context_message(test_context));
    brc_context_clear(test_context);
}

/* ---- statistics ---- */

/* Four faces in the plane z = 0.1 x, one away from it; those of the plane lie between two fragments. Normals by
 * hand. */
static void the_mean_plane_is_that_of_the_faces(void **state)
{
    (void)state;
    const double tilt = atan(0.1), n[3] = {-sin(tilt), 0, cos(tilt)};
    brc_break b[5] = {{.position = {1, 1, 0.1}, .area = 1},
                      {.position = {-1, 1, -0.1}, .area = 1},
                      {.position = {1, -1, 0.1}, .area = 1},
                      {.position = {-1, -1, -0.1}, .area = 1, .mode = BRC_BREAK_SHEAR},
                      {.position = {0, 0, 5}, .normal = {1, 0, 0}, .area = 2}};
    const int32_t fragment[3] = {0, 1, 0};
    brc_crack_statistics s;
    for (int k = 0; k < 4; ++k) {
        memcpy(b[k].normal, n, sizeof n);
        b[k].element_j = 1;
        if (b[k].mode == 0) b[k].mode = BRC_BREAK_TENSION;
    }
    b[4].element_j = 2;
    b[4].mode = BRC_BREAK_TENSION;
    brc_crack_statistics_of(5, b, fragment, &s);
    assert_true(s.total_area == 6 && s.count[BRC_BREAK_TENSION] == 4 && s.count[BRC_BREAK_SHEAR] == 1 &&
                s.area[BRC_BREAK_SHEAR] == 1);
    assert_int_equal(s.separating.n, 4);
    assert_true(s.separating.area == 4 && s.separating.rough < 1e-8); /* the root of rounding */
    for (int c = 0; c < 3; ++c)
        assert_true(fabs(s.separating.normal[c] - n[c]) < 1e-12 && fabs(s.separating.point[c]) < 1e-12);
    assert_true(fabs(brc_crack_angle(s.separating.normal, 2) - tilt * 180 / M_PI) < 1e-10);
    assert_true(fabs(brc_crack_angle(s.separating.normal, 1) - 90) < 1e-10);
    assert_true(fabs(s.fabric[0] + s.fabric[1] + s.fabric[2] - 1) < 1e-12);
    assert_true(fabs(s.fabric[0] - (4 * n[0] * n[0] + 2) / 6) < 1e-12 &&
                fabs(s.fabric[4] - 4 * n[0] * n[2] / 6) < 1e-12);
    assert_true(s.normal[2] > 0.9);
    assert_int_equal(s.all.n, 5);
}

static void few_faces_have_no_plane(void **state)
{
    (void)state;
    const int32_t fragment[2] = {0, 1};
    const brc_break line[4] = {{.position = {0, 0, 0}, .area = 1, .element_j = 1},
                               {.position = {1, 1, 0}, .area = 1, .element_j = 1},
                               {.position = {2, 2, 0}, .area = 1, .element_j = 1},
                               {.position = {5, 5, 0}, .area = 1, .element_j = 1}};
    brc_crack_statistics s;
    brc_crack_statistics_of(0, NULL, fragment, &s);
    assert_true(s.total_area == 0 && s.all.n == 0 && s.fabric[0] == 0);
    for (int n = 1; n <= 4; ++n) {
        brc_crack_statistics_of(n, line, fragment, &s);
        assert_true(s.all.n == n && s.all.normal[0] == 0 && s.all.normal[1] == 0 && s.all.normal[2] == 0);
    }
}

/* ---- surfaces ---- */

/* Corners of every face, in order: their polygon has the area vector of the face. Cells close to 1e-9 of their faces
 * (domain.h). */
static void the_corners_of_a_face_are_its_polygon(void **state)
{
    (void)state;
    brc_domain *d = test_domain(200);
    for (int64_t h = 0; h < d->n_half_edges; ++h) {
        int64_t corner[64];
        double area[3] = {0};
        const int n = brc_crack_surface_corners(d, h, 64, corner);
        if (n < 3) fail_msg("half-edge %lld has %d corners", (long long)h, n);
        for (int k = 0; k < n; ++k) {
            const double *o = d->face_centroid + 3 * h, *a = d->vertex + 3 * corner[k],
                         *b = d->vertex + 3 * corner[(k + 1) % n];
            for (int c = 0; c < 3; ++c) {
                const int p = (c + 1) % 3, q = (c + 2) % 3;
                area[c] += 0.5 * ((a[p] - o[p]) * (b[q] - o[q]) - (a[q] - o[q]) * (b[p] - o[p]));
            }
        }
        const double *s = d->area_vector + 3 * h, size = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        for (int c = 0; c < 3; ++c)
            if (!(fabs(area[c] - s[c]) < 1e-6 * size + 1e-9))
                fail_msg("half-edge %lld: %g for %g", (long long)h, area[c], s[c]);
    }
    brc_domain_free(&d);
}

static const char SCENE[] =
    TEST_SCENE_HEAD "fracture: {criterion: {mohr-coulomb: {cohesion: 1 MPa, friction: 30 deg}}}\nstages:\n  - name: "
                    "pull\n    solver: {static: {}}\n"
                    "sensors:\n  a: {fracture: crack_area}\n  n: {fracture: broken}\n  f: {fracture: fragments}\n  l: "
                    "{fracture: largest_fragment}\n"
                    "  r: {fracture: failure_ratio}\n  t: {crack_tip: {direction: [0, 0, 1], from: [0 m, 0 m, 1 m]}}\n";

/* Two sides of every broken face, each with all its numbers, in the file that ParaView reads. */
static void a_surface_has_two_sides_of_every_break(void **state)
{
    (void)state;
    brc_scene *scene = test_scene(SCENE);
    brc_domain *d = test_domain(100);
    char *folder = test_new_folder();
    brc_break b[2] = {{.bond = 3, .area = 0.5}, {.bond = 7, .area = 0.25}};
    for (int k = 0; k < 2; ++k) {
        const int64_t h = d->bond_half_edge[b[k].bond];
        b[k].element_i = d->neighbour[d->twin[h]];
        b[k].element_j = d->neighbour[h];
    }
    brc_simulation fake = {.scene = scene,
                           .domain = d,
                           .factor = 1,
                           .gradient = {{1e-3, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                           .breaks = b,
                           .n_breaks = 2};
    brc_simulation *alone = &fake;
    const brc_assembly whole = brc_assembly_make(scene, NULL, 1, &alone);
    const char *path = test_path(folder, "s.vtu");
    assert_int_equal(brc_crack_surface_write(test_context, &whole, path), BRC_OK);
    char *data;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(test_context, path, (size_t)1 << 20, &data, &bytes), BRC_OK);
    assert_non_null(strstr(data, "NumberOfCells=\"4\""));
    static const char *const names[] = {"side", "mode", "bond", "element_i",    "energy",   "stress",
                                        "area", "time", "load", "displacement", "TimeValue"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        char word[64];
        snprintf(word, sizeof word, "Name=\"%s\"", names[k]);
        if (!strstr(data, word)) fail_msg("no %s", word);
    }
    brc_memory_free(data);
    fake.n_breaks = 0;
    assert_int_equal(brc_crack_surface_write(test_context, &whole, path),
                     BRC_OK); /* a series begins before anything breaks */
    test_remove_folder(folder);
    brc_domain_free(&d);
    brc_scene_free(&scene);
}

/* Every bond broken: more points than the file is written in at a time (256 kB), and 72 bytes kept of a polygon of
 * some 5.5 corners at most: 16, and 22 that grow by half with the old ones beside the new; besides the block and what
 * is of elements. */
static void a_large_surface_is_written_in_pieces_and_little_of_it_is_kept(void **state)
{
    (void)state;
    brc_scene *scene = test_scene(SCENE);
    brc_domain *d = test_domain(700);
    char *folder = test_new_folder(), *data;
    brc_break *b = calloc((size_t)d->n_bonds, sizeof *b);
    for (int64_t k = 0; k < d->n_bonds; ++k) {
        const int64_t h = d->bond_half_edge[k];
        b[k] = (brc_break){
            .bond = (int32_t)k, .element_i = d->neighbour[d->twin[h]], .element_j = d->neighbour[h], .area = 1};
    }
    brc_simulation fake = {.scene = scene,
                           .domain = d,
                           .factor = 1,
                           .gradient = {{1e-3, 0, 0}, {0, 2e-3, 0}, {0, 1e-3, 0}},
                           .breaks = b,
                           .n_breaks = d->n_bonds};
    brc_simulation *alone = &fake;
    const brc_assembly whole = brc_assembly_make(scene, NULL, 1, &alone);
    const char *path = test_path(folder, "s.vtu");
    size_t bytes;
    void *filler; /* up to the most that was ever held, so that what the call holds shows */
    assert_int_equal(
        brc_memory_allocate(test_context, &filler, brc_memory_peak() - brc_memory_held() + 4096, 1, "filler"), BRC_OK);
    const int64_t before = brc_memory_peak();
    assert_int_equal(brc_crack_surface_write(test_context, &whole, path), BRC_OK);
    const int64_t kept = brc_memory_peak() - before;
    brc_memory_free(filler);
    if (!(kept < ((int64_t)1 << 18) + 72 * 2 * d->n_bonds + 64 * d->n_elements + 16384))
        fail_msg("%lld bytes for %lld bonds", (long long)kept, (long long)d->n_bonds);
    assert_int_equal(brc_file_read_whole(test_context, path, (size_t)1 << 24, &data, &bytes), BRC_OK);
    const char *points = strstr(data, "encoding=\"raw\">\n_") + strlen("encoding=\"raw\">\n_") + 16 + 8;
    uint64_t size;
    memcpy(&size, points - 8, sizeof size);
    assert_true(size > (uint64_t)1 << 18);
    const char *moved = points + size + (8 + size / 12 * 8) + (8 + 16 * (uint64_t)d->n_bonds) +
                        (8 + 2 * (uint64_t)d->n_bonds) + 8; /* behind connectivity, offsets, types */
    double *displacement = calloc((size_t)d->n_elements * 3, sizeof *displacement);
    uint8_t *unbroken;
    assert_int_equal(brc_simulation_displacement(&fake, displacement), BRC_OK);
    assert_int_equal(brc_simulation_whole(&fake, &unbroken), BRC_OK);
    int64_t at = 0;
    for (int64_t k = 0; k < 2 * d->n_bonds; ++k) {
        const int64_t h = k % 2 == 0 ? d->bond_half_edge[k / 2] : d->twin[d->bond_half_edge[k / 2]],
                      e = d->neighbour[d->twin[h]];
        int64_t corner[256];
        double gradient[3][3];
        const int n = brc_crack_surface_corners(d, h, 256, corner);
        brc_deform_gradient(d, unbroken, displacement, e, gradient);
        for (int i = 0; i < n; ++i, ++at) {
            float x[3], u[3];
            double expected[3];
            brc_deform_point(d, displacement, e, (const double(*)[3])gradient, d->vertex + 3 * corner[i], expected);
            memcpy(x, points + 12 * at, sizeof x);
            memcpy(u, moved + 12 * at, sizeof u);
            for (int c = 0; c < 3; ++c)
                if (x[c] != (float)d->vertex[3 * corner[i] + c] || u[c] != (float)expected[c])
                    fail_msg("point %lld of polygon %lld", (long long)at, (long long)k);
        }
    }
    assert_int_equal(12 * at, size);
    brc_memory_free(unbroken);
    free(displacement);
    free(b);
    brc_memory_free(data);
    test_remove_folder(folder);
    brc_domain_free(&d);
    brc_scene_free(&scene);
}

/* ---- sensors ---- */

static double read_sensor(brc_crack_sensors *sensors, brc_simulation *fake, const char *name)
{
    double value = NAN;
    for (int32_t k = 0; k < fake->scene->n_sensors; ++k)
        if (strcmp(fake->scene->sensors[k].name, name) == 0)
            assert_int_equal(brc_crack_sensors_read(sensors, fake, &fake->scene->sensors[k], &value), BRC_OK);
    return value;
}

static void sensors_read_what_broke(void **state)
{
    (void)state;
    static const brc_break b[3] = {{.position = {0, 0, 1.5}, .area = 0.5},
                                   {.position = {0, 0, 3}, .area = 0.25},
                                   {.position = {9, 9, 2}, .area = 1}};
    brc_scene *scene = test_scene(SCENE);
    brc_domain *d = test_domain(100);
    brc_crack_sensors *sensors;
    brc_simulation fake = {.scene = scene, .domain = d, .factor = 0.75, .breaks = b};
    double rest = 0;
    assert_int_equal(brc_crack_sensors_create(test_context, scene, d, &sensors), BRC_OK);
    assert_true(read_sensor(sensors, &fake, "t") == 0 && read_sensor(sensors, &fake, "a") == 0 &&
                read_sensor(sensors, &fake, "n") == 0);
    fake.n_breaks = 3;
    assert_true(read_sensor(sensors, &fake, "t") == 2 && read_sensor(sensors, &fake, "a") == 1.75 &&
                read_sensor(sensors, &fake, "n") == 3);
    assert_true(read_sensor(sensors, &fake, "r") == 0.75 && read_sensor(sensors, &fake, "f") == 2);
    for (int64_t e = 0; e + 1 < d->n_elements; ++e)
        rest += d->volume[e];
    assert_true(fabs(read_sensor(sensors, &fake, "l") - rest / (rest + d->volume[d->n_elements - 1])) < 1e-12);
    brc_crack_sensors_free(&sensors);
    brc_domain_free(&d);
    brc_scene_free(&scene);
}

/* ---- the end of a stage by a sensor ---- */

static void a_stage_ends_when_its_sensor_fell(void **state)
{
    (void)state;
    static const double force[] = {0, -1, -0.2, -4, -8, -5, -3.9};
    brc_sensor sensor = {.name = "force"};
    brc_stage stages[2] = {{.name = "first"}, {.name = "second", .stop_sensor = "force", .stop_share = 0.5}};
    const brc_scene scene = {.n_sensors = 1, .sensors = &sensor, .n_stages = 2, .stages = stages};
    brc_history *h;
    char reason[192];
    assert_int_equal(brc_history_create(test_context, 1, &h), BRC_OK);
    assert_false(brc_stop_after_peak(&scene, h, true, reason, sizeof reason));
    assert_int_equal(brc_history_add(test_context, h, 0, 0, 0, 0, (double[]){100}),
                     BRC_OK); /* another stage's peak is not this one's */
    for (int k = 0; k < 7; ++k) {
        assert_int_equal(brc_history_add(test_context, h, 1, k, k, k, &force[k]), BRC_OK);
        assert_false(brc_stop_after_peak(&scene, h, false, reason, sizeof reason));
        assert_true(brc_stop_after_peak(&scene, h, true, reason, sizeof reason) == (k == 2 || k == 6));
    }
    if (!strstr(reason, "force fell to 48.8 %")) fail_msg("%s", reason);
    brc_history_free(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_grows_text_by_text),
        cmocka_unit_test(a_full_disk_is_told),
        cmocka_unit_test(the_mean_plane_is_that_of_the_faces),
        cmocka_unit_test(few_faces_have_no_plane),
        cmocka_unit_test(the_corners_of_a_face_are_its_polygon),
        cmocka_unit_test(a_surface_has_two_sides_of_every_break),
        cmocka_unit_test(a_large_surface_is_written_in_pieces_and_little_of_it_is_kept),
        cmocka_unit_test(sensors_read_what_broke),
        cmocka_unit_test(a_stage_ends_when_its_sensor_fell),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
