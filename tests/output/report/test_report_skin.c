/* Frames read back, what of their cells can be seen, and the view that a page makes of it. */
#include "../support.h"
#include "../fake_simulation.h"
#include "../../../host/base/file.h"
#include "../../../host/output/frames/frame_file.h"
#include "../../../host/output/report/report_skin.h"
#include "../../../host/output/report/report_thin.h"
#include "../../../host/output/report/report_view.h"
#include <stdlib.h>
#include <unistd.h>

enum { FRAMES = 3 };
static brc_domain *domain;
static char *folder;
static int64_t opened; /* the bond that breaks before frame 1 */

/* Three frames of an affine motion, in the last two of which a bond in the middle is broken. */
static int begin(void **state)
{
    test_begin(state);
    domain = test_domain(300);
    folder = test_new_folder();
    for (int64_t b = 0; b < domain->n_bonds; ++b)
        if (fabs(domain->face_centroid[3 * (int64_t)domain->bond_half_edge[b]] - 1) < 0.3) opened = b;
    const brc_break one = {.bond = (int32_t)opened};
    uint8_t *whole = malloc((size_t)domain->row_start[domain->n_elements]);
    memset(whole, 1, (size_t)domain->row_start[domain->n_elements]);
    brc_scene scene = {.n_strikers = 0};
    brc_simulation s = {
        .scene = &scene, .domain = domain, .breaks = &one, .whole = whole, .gradient = {{1e-2}}, .stress = {3e6}};
    brc_simulation *const alone = &s;
    const brc_assembly assembly = brc_assembly_make(&scene, NULL, 1, &alone);
    brc_frames *frames;
    brc_status status = brc_frames_create(test_context, &assembly, 1, &frames);
    char *place;
    if (status == BRC_OK) status = brc_file_join(test_context, folder, "frames", &place);
    if (status == BRC_OK) status = brc_file_make_folder(test_context, place);
    for (int k = 0; status == BRC_OK && k < FRAMES; ++k) {
        const int64_t h = domain->bond_half_edge[opened];
        s.n_breaks = k > 0;
        s.factor = s.time = k;
        whole[h] = whole[domain->twin[h]] = k == 0;
        status = brc_frames_write(frames, place, k);
    }
    brc_frames_free(&frames);
    brc_memory_free(place);
    free(whole);
    return status == BRC_OK ? 0 : -1;
}

static int end(void **state)
{
    brc_domain_free(&domain);
    test_remove_folder(folder);
    return test_end(state);
}

static brc_report_frame frame_of(int64_t number)
{
    brc_report_frame frame;
    assert_int_equal(brc_report_frame_read(test_context, folder, number, &frame), BRC_OK);
    return frame;
}

static double area_of(const brc_report_frame *frame, const brc_report_skin *skin, int64_t f)
{
    const int64_t first = skin->face_start[f];
    double twice[3] = {0};
    for (int64_t k = first + 1; k + 1 < skin->face_start[f + 1]; ++k) {
        const float *o = frame->point + 3 * skin->point[skin->face_corner[first]];
        const float *a = frame->point + 3 * skin->point[skin->face_corner[k]],
                    *b = frame->point + 3 * skin->point[skin->face_corner[k + 1]];
        for (int c = 0; c < 3; ++c) {
            const int i = (c + 1) % 3, j = (c + 2) % 3;
            twice[c] += (double)((a[i] - o[i]) * (b[j] - o[j]) - (a[j] - o[j]) * (b[i] - o[i]));
        }
    }
    return 0.5 * sqrt(twice[0] * twice[0] + twice[1] * twice[1] + twice[2] * twice[2]);
}

static void an_intact_body_shows_its_outside(void **state)
{
    (void)state;
    brc_report_frame first = frame_of(0);
    brc_report_skin skin;
    double area = 0;
    assert_int_equal(first.n_elements, domain->n_elements);
    assert_int_equal(first.n_broken, 0);
    assert_int_equal(brc_report_skin_make(test_context, &first, &skin), BRC_OK);
    for (int64_t f = 0; f < skin.n_faces; ++f)
        area += area_of(&first, &skin, f);
    assert_true(fabs(area - 10) < 1e-4);               /* the box is 2 x 1 x 1 m; places are floats */
    assert_true(skin.n_elements < domain->n_elements); /* those inside are not seen */
    brc_report_skin_free(&skin);
    brc_report_frame_free(&first);
}

static void a_broken_bond_opens_two_faces_that_are_born_with_it(void **state)
{
    (void)state;
    brc_report_frame last = frame_of(FRAMES - 1);
    brc_report_skin skin;
    assert_int_equal(brc_report_skin_make(test_context, &last, &skin), BRC_OK);
    int64_t *place = calloc((size_t)skin.n_points, sizeof *place), born[FRAMES] = {0};
    for (int32_t k = 0; k < FRAMES; ++k) {
        brc_report_frame frame = frame_of(k);
        brc_report_skin_places(&skin, &last, &frame, place);
        for (int64_t p = 0; p < 3 * skin.n_points; ++p)
            assert_true(frame.point[3 * place[p / 3] + p % 3] == last.point[3 * skin.point[p / 3] + p % 3]);
        assert_int_equal(brc_report_skin_births(test_context, &skin, &frame, place, k), BRC_OK);
        brc_report_frame_free(&frame);
    }
    double area = 0;
    for (int64_t f = 0; f < skin.n_faces; ++f) {
        assert_in_range(skin.birth[f], 0, FRAMES - 1);
        ++born[skin.birth[f]];
        if (skin.birth[f] == 1) area += area_of(&last, &skin, f);
    }
    assert_int_equal(born[1], 2);
    assert_int_equal(born[2], 0);
    assert_int_equal(born[0] + 2, skin.n_faces);
    const double *face = domain->area_vector + 3 * (int64_t)domain->bond_half_edge[opened];
    const double once = sqrt(face[0] * face[0] + face[1] * face[1] + face[2] * face[2]);
    assert_true(fabs(area - 2 * once) < 1e-4 * once);
    free(place);
    brc_report_skin_free(&skin);
    brc_report_frame_free(&last);
}

/* Faces of the first frame of a body that bursts wholly all stay, whatever room there is; with room for some of the
 * cracks, cells keep all of their faces or none of them but those, and it is used up to less than a cell's faces.
 * Points and elements that nothing uses go. */
static void cracks_are_left_out_where_there_is_no_room(void **state)
{
    (void)state;
    for (int room = 0; room < 3; ++room) {
        brc_report_frame last = frame_of(FRAMES - 1), first = frame_of(0);
        brc_report_skin skin, outer;
        int64_t n_dropped;
        assert_int_equal(brc_report_skin_make(test_context, &first, &outer), BRC_OK);
        assert_int_equal(brc_report_skin_make(test_context, &last, &skin), BRC_OK);
        int64_t *place = calloc((size_t)skin.n_points, sizeof *place);
        brc_report_skin_places(&skin, &last, &first, place);
        assert_int_equal(brc_report_skin_births(test_context, &skin, &first, place, 0), BRC_OK);
        free(place);
        const int64_t all = brc_report_skin_bytes(&skin), least = brc_report_skin_bytes(&outer), faces = skin.n_faces;
        const int64_t bytes[3] = {0, all - 1, all};
        double area = 0, old_area = 0;
        for (int64_t f = 0; f < outer.n_faces; ++f)
            old_area += area_of(&first, &outer, f);
        assert_true(least < all);
        assert_int_equal(brc_report_skin_thin(test_context, &skin, bytes[room], &n_dropped), BRC_OK);
        assert_int_equal(skin.n_faces + n_dropped, faces);
        assert_true(room == 0 ? n_dropped == 2 : room == 1 ? n_dropped <= 1 : n_dropped == 0);
        for (int64_t f = 0; f < skin.n_faces; ++f) {
            if (skin.birth[f] == 0) area += area_of(&last, &skin, f);
            assert_in_range(skin.face_owner[f], 0, skin.n_elements - 1);
            for (int64_t k = skin.face_start[f]; k < skin.face_start[f + 1]; ++k)
                assert_in_range(skin.face_corner[k], 0, skin.n_points - 1);
        }
        assert_true(fabs(area - old_area) < 1e-6 * old_area);
        for (int64_t e = 1; e < skin.n_elements; ++e)
            assert_true(skin.element[e] > skin.element[e - 1]);
        brc_report_skin_free(&skin);
        brc_report_skin_free(&outer);
        brc_report_frame_free(&last);
        brc_report_frame_free(&first);
    }
}

static void a_view_tells_of_its_frames_and_needs_all_of_them(void **state)
{
    (void)state;
    brc_text page = {.context = test_context};
    brc_json json = {.text = {.context = test_context}};
    brc_report_frames frames;
    const brc_csv_read nothing = {0};
    brc_json_begin_object(&json, NULL);
    assert_int_equal(brc_report_view(test_context, folder, &nothing, &page, &json, &frames), BRC_OK);
    assert_int_equal(frames.n_all, FRAMES);
    assert_int_equal(frames.n, FRAMES);
    for (int64_t k = 0; k < FRAMES; ++k)
        assert_int_equal(frames.number[k], k);
    assert_non_null(strstr(json.text.data, "\"broken\": 1"));
    assert_non_null(strstr(page.data, "id=\"view-surface\""));
    assert_non_null(strstr(page.data, "id=\"view-2\""));
    brc_report_frames_free(&frames);
    assert_int_equal(unlink(test_path(folder, "frames/000000.vtkhdf")), 0); /* frame 2 refers to it */
    assert_int_equal(brc_report_view(test_context, folder, &nothing, &page, &json, &frames), BRC_OK);
    assert_int_equal(frames.n_all, 0); /* without a first frame there is none */
    brc_text_free(&page);
    brc_text_free(&json.text);
}

static void damaged_frames_are_refused(void **state)
{
    (void)state;
    brc_report_frame frame;
    assert_int_equal(brc_report_frame_read(test_context, folder, 2, &frame), BRC_BAD_INPUT); /* its first one is gone */
    assert_int_equal(brc_file_write_whole(test_context, test_path(folder, "frames/000000.vtkhdf"), "no", 2), BRC_OK);
    assert_int_equal(brc_report_frame_read(test_context, folder, 0, &frame), BRC_BAD_INPUT);
    assert_null(frame.point);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_intact_body_shows_its_outside),
        cmocka_unit_test(a_broken_bond_opens_two_faces_that_are_born_with_it),
        cmocka_unit_test(cracks_are_left_out_where_there_is_no_room),
        cmocka_unit_test(a_view_tells_of_its_frames_and_needs_all_of_them),
        cmocka_unit_test(damaged_frames_are_refused),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
