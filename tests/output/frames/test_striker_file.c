/* Walls and strikers in files and pictures. */
#include "../support.h"
#include "../fake_simulation.h"
#include "../../../host/output/pictures/picture.h"
#include "../../../host/output/frames/striker_file.h"
#include <cairo.h>
#include <stdlib.h>

/* A tetrahedron with legs of 1 m along the axes, and a square of 20 m facing upward. */
static double corner[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
              square[12] = {-10, -10, 0, 10, -10, 0, 10, 10, 0, -10, 10, 0};
static int32_t start[5] = {0, 3, 6, 9, 12}, loop[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, square_start[2] = {0, 4},
               square_loop[4] = {0, 1, 2, 3};
static const brc_striker_body body[2] = {
    {.centre = {5, 0, 0},
     .surface = {.n_corners = 4, .n_faces = 4, .corner = corner, .loop_start = start, .loop = loop}},
    {.centre = {0, 0, -1},
     .surface = {.n_corners = 4, .n_faces = 1, .corner = square, .loop_start = square_start, .loop = square_loop}}};
/* The first has moved by (0, 0, 2) and turned by 90 degrees about z. */
static const brc_striker_now now[2] = {{.displacement = {0, 0, 2},
                                        .orientation = {0.70710678118654752, 0, 0, 0.70710678118654752},
                                        .velocity = {1, 2, 3},
                                        .force = {4, 5, 6}},
                                       {.orientation = {1, 0, 0, 0}}};

static void corners_move_with_the_rigid_motion(void **state)
{
    (void)state;
    double u[3];
    brc_striker_corner_moved(&body[0].surface, &now[0], 1, u); /* (1 0 0) to (0 1 0) */
    assert_true(fabs(u[0] + 1) < 1e-15 && fabs(u[1] - 1) < 1e-15 && fabs(u[2] - 2) < 1e-15);
    brc_striker_corner_moved(&body[0].surface, &now[0], 3, u); /* on the axis */
    assert_true(u[0] == 0 && u[1] == 0 && u[2] == 2);
}

/* Numbers of an appended array: its offset stands in the head, a size of 8 bytes before the data. */
static const void *appended(const char *file, size_t length, const char *name)
{
    char key[64];
    snprintf(key, sizeof key, "Name=\"%s\"", name);
    const char *at = strstr(file, key), *data = NULL;
    assert_non_null(at);
    const long long offset = atoll(strstr(at, "offset=\"") + 8);
    for (size_t k = 0; k + 12 < length && !data; ++k)
        if (memcmp(file + k, "<AppendedData", 13) == 0) data = strchr(file + k, '_') + 1;
    assert_non_null(data);
    return data + offset + 8;
}

static void all_faces_stand_in_one_file(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    const char *path = test_path(folder, "s.vtu");
    brc_scene scene = {.n_strikers = 2};
    brc_simulation s = {.scene = &scene, .striker_body = body, .strikers = now, .n_strikers = 2, .time = 0.25};
    brc_simulation *part = &s;
    const brc_assembly assembly = brc_assembly_make(&scene, NULL, 1, &part);
    assert_int_equal(brc_striker_file_write(test_context, &assembly, path), BRC_OK);
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 1 << 16);
    const size_t n = fread(text, 1, (1 << 16) - 1, file);
    fclose(file);
    assert_non_null(strstr(text, "NumberOfPoints=\"8\" NumberOfCells=\"5\""));
    float point[24], moved[24];
    int64_t id[16], end[5], striker[5];
    double velocity[15], force[15];
    memcpy(point, appended(text, n, "Points"), sizeof point);
    memcpy(moved, appended(text, n, "displacement"), sizeof moved);
    memcpy(id, appended(text, n, "connectivity"), sizeof id);
    memcpy(end, appended(text, n, "offsets"), sizeof end);
    memcpy(striker, appended(text, n, "striker"), sizeof striker);
    memcpy(velocity, appended(text, n, "velocity"), sizeof velocity);
    memcpy(force, appended(text, n, "force"), sizeof force);
    assert_true(point[0] == 5 && point[3] == 6 && point[12] == -10 && point[14] == -1);
    assert_true(fabsf(moved[3] + 1) < 1e-6f && fabsf(moved[4] - 1) < 1e-6f && moved[5] == 2 && moved[12] == 0);
    assert_true(id[0] == 0 && id[1] == 2 && id[12] == 4 && id[15] == 7 && end[0] == 3 && end[3] == 12 && end[4] == 16);
    assert_true(striker[3] == 0 && striker[4] == 1 && velocity[9] == 1 && velocity[11] == 3 && velocity[12] == 0 &&
                force[1] == 5);
    free(text);
    test_remove_folder(folder);
}

/* The tetrahedron stands in grey where white was without it; the endless plane is drawn, and gives the sample no
 * smaller place. */
static void pictures_show_strikers(void **state)
{
    (void)state;
    char *folder = test_new_folder();
    brc_domain *domain = test_domain(100);
    double *u = calloc((size_t)(3 * domain->n_elements), sizeof *u),
           *value = calloc((size_t)domain->n_elements, sizeof *value);
    const brc_picture_part cells = {.domain = domain, .displacement = u, .value = value};
    const brc_picture_striker strikers[2] = {
        {.body = &body[0], .now = {.orientation = {1, 0, 0, 0}, .displacement = {-3, -0.5, 1}}},
        {.body = &body[1], .now = now[1], .is_plane = true}};
    int grey[3] = {0}, blank[3] = {0};
    for (int n = 0; n < 3; ++n) {
        const brc_picture picture = {.n = 1,
                                     .part = &cells,
                                     .n_strikers = n == 2 ? 1 : n,
                                     .striker = n == 2 ? strikers + 1 : strikers,
                                     .name = "field",
                                     .unit = "-",
                                     .title = "",
                                     .scale = 1};
        assert_int_equal(brc_picture_draw(test_context, &picture, test_path(folder, "p.png")), BRC_OK);
        cairo_surface_t *image = cairo_image_surface_create_from_png(test_path(folder, "p.png"));
        for (int y = 100; y < 820; ++y)
            for (int x = 60; x < 960; ++x) {
                const unsigned char *p =
                    cairo_image_surface_get_data(image) + y * cairo_image_surface_get_stride(image) + 4 * x;
                blank[n] += p[0] > 250 && p[1] > 250 && p[2] > 250;
                grey[n] += p[0] > p[2] && p[0] - p[2] < 16 && p[0] > 120 && p[0] < 205;
            }
        cairo_surface_destroy(image);
    }
    assert_true(grey[0] == 0 && blank[0] > 10000);
    assert_true(grey[1] > 2000);
    assert_true(blank[2] < blank[0] / 2); /* the ground is behind the sample */
    free(u), free(value);
    brc_domain_free(&domain);
    test_remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_move_with_the_rigid_motion),
        cmocka_unit_test(all_faces_stand_in_one_file),
        cmocka_unit_test(pictures_show_strikers),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
