/* The polish on a sample it can check itself. */
#include "../../host/solver/beam_polish.h"
#include "../../host/solver/beam_sample.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>
#include "../../host/base/log.h"

static brc_context *context;
static brc_device *device;
static brc_domain *domain;

static void done(brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
}

static int begin(void **state)
{
    (void)state;
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    const brc_fill fill = {.kind = BRC_FILL_PACKING, .n_elements = 1000, .seed = 3, .radius_spread = 0.125, .coordination = 6.2, .tolerance = 0.02};
    brc_beam_sample *sample;
    context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR);
    done(brc_device_open(context, &(brc_device_request){.selector = "cpu", .n_threads = 1}, &device));
    done(brc_beam_sample_pack(context, &shape, &fill, 1, &sample));
    done(brc_beam_sample_bond(context, sample, 8, 1, &domain));
    brc_beam_sample_free(&sample);
    return 0;
}

static int end(void **state)
{
    (void)state;
    brc_domain_free(&domain);
    brc_device_close(&device);
    brc_context_free(&context);
    return 0;
}

/* 1e-3: where the polish warns. E scales exactly, but for the tolerance of the solves, 3e-5. */
static void the_polished_sample_has_the_materials_e_and_nu(void **state)
{
    (void)state;
    brc_polish polish;
    done(brc_beam_polish(context, device, domain, 0.23, 72e9, 0.3, &polish));
    double nu = 0, young = 0;
    for (int axis = 0; axis < 3; ++axis) {
        brc_beam_answer answer;
        done(brc_beam_sample_pull(context, device, domain, &(brc_beam_pull){.axis = axis, .radius = polish.radius, .beam_poisson = 0.3, .tolerance = 1e-9}, &answer));
        nu += answer.poisson / 3;
        young += answer.young * polish.beam_young / 3;
    }
    assert_true(fabs(nu / 0.23 - 1) < 1e-3);
    assert_true(fabs(young / 72e9 - 1) < 1e-4);
    assert_true(polish.n_tests <= 3);
    assert_true(fabs(polish.law_young / 72e9 - 1) > 1e-3); /* there was something to do */
}

static void what_the_law_cannot_give_the_polish_refuses(void **state)
{
    (void)state;
    brc_polish polish;
    assert_int_equal(brc_beam_polish(context, device, domain, 0.45, 72e9, 0.3, &polish), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(context), "beams cannot give nu = 0.45"));
}

/* A scene made here: one body, one material. */
static void polish_scene(brc_shape_kind kind, int n_cracks, brc_material *material, brc_status expected)
{
    static brc_crack crack;
    brc_body body = {.name = "body", .shape = {.kind = kind, .size = {1, 1, 1}, .radius = 1}, .beams = 8, .n_cracks = n_cracks, .cracks = &crack,
                     .fill = {.kind = BRC_FILL_PACKING, .n_elements = 1000, .seed = 3, .radius_spread = 0.125, .coordination = 6.2, .tolerance = 0.02}};
    brc_scene scene = {.n_materials = 1, .materials = material, .model = {.kind = BRC_MODEL_CBM, .beam_poisson = 0.3, .polish = true}, .n_bodies = 1, .bodies = &body};
    assert_int_equal(brc_beam_polish_scene(context, &scene, domain, 1), expected);
}

/* A reference cube of the same fill is the same sample as a box of it: the same parameters, bit for bit. */
static void a_body_that_is_no_plain_box_is_polished_on_a_cube_packed_alike(void **state)
{
    (void)state;
    brc_material box = {.name = "m", .young = 72e9, .poisson = 0.23, .density = 1}, sphere = box, cracked = box;
    polish_scene(BRC_SHAPE_BOX, 0, &box, BRC_OK);
    polish_scene(BRC_SHAPE_SPHERE, 0, &sphere, BRC_OK);
    polish_scene(BRC_SHAPE_BOX, 1, &cracked, BRC_OK);
    assert_true(box.beam_radius > 0 && box.beam_young > 0);
    assert_true(sphere.beam_radius == box.beam_radius && sphere.beam_young == box.beam_young);
    assert_true(cracked.beam_radius == box.beam_radius && cracked.beam_young == box.beam_young);
}

static void beams_that_were_given_are_left_alone(void **state)
{
    (void)state;
    brc_material given = {.name = "m", .young = 72e9, .poisson = 0.23, .density = 1, .beam_radius = 0.5, .beam_young = 1e9};
    polish_scene(BRC_SHAPE_BOX, 0, &given, BRC_OK);
    assert_true(given.beam_radius == 0.5 && given.beam_young == 1e9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_polished_sample_has_the_materials_e_and_nu),
        cmocka_unit_test(what_the_law_cannot_give_the_polish_refuses),
        cmocka_unit_test(a_body_that_is_no_plain_box_is_polished_on_a_cube_packed_alike),
        cmocka_unit_test(beams_that_were_given_are_left_alone),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
