/* The elastic sample test against a lattice of chains, whose answer is exact, and against itself. */
#include "../../../host/base/memory.h"
#include "../../../host/solver/laws/beam_sample.h"
#include "../../../preprocess/packing/beams.h"
#include "../../../preprocess/domain/domain.h"
#include "../../../preprocess/shapes/solid.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "../../../host/base/log.h"

enum { EDGE = 4, SPHERES = EDGE * EDGE * EDGE };

typedef struct bench {
    brc_context *context;
    brc_device *device;
    brc_domain *domain;
} bench;

static void done(const bench *b, brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(b->context));
}

static void open_bench(bench *b, int n_threads)
{
    memset(b, 0, sizeof *b);
    b->context = brc_context_create();
    brc_log_set_level(b->context, BRC_LOG_ERROR);
    done(b, brc_device_open(b->context, &(brc_device_request){.selector = "cpu", .n_threads = n_threads}, &b->device));
}

static void close_bench(bench *b)
{
    brc_domain_free(&b->domain);
    brc_device_close(&b->device);
    brc_context_free(&b->context);
}

/* A cube of EDGE^3 equal touching spheres, bonded along the axes, spacing 1/EDGE. */
static void make_lattice(bench *b)
{
    const double a = 1.0 / EDGE;
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    brc_solid *solid = NULL;
    double *position = NULL, *radius = NULL;
    done(b, brc_solid_create(b->context, &shape, 1, &solid));
    done(b, BRC_ALLOCATE(b->context, &b->domain, 1, "domain"));
    done(b, BRC_ALLOCATE(b->context, &position, 3 * SPHERES, "positions"));
    done(b, BRC_ALLOCATE(b->context, &radius, SPHERES, "radii"));
    for (int e = 0; e < SPHERES; ++e) {
        const int at[3] = {e / (EDGE * EDGE), e / EDGE % EDGE, e % EDGE};
        for (int c = 0; c < 3; ++c)
            position[3 * e + c] = (at[c] + 0.5) * a;
        radius[e] = a / 2;
    }
    const double bonds = 3.0 * EDGE * EDGE * (EDGE - 1);
    done(b, brc_beams_build(b->context, solid, position, radius, SPHERES, 2 * bonds / SPHERES, false, 1, b->domain));
    done(b, BRC_ALLOCATE(b->context, &b->domain->region, SPHERES, "regions"));
    done(b, BRC_ALLOCATE(b->context, &b->domain->body, SPHERES, "bodies"));
    brc_solid_free(&solid);
}

static brc_fill packing_of(int64_t n, uint64_t seed)
{
    return (brc_fill){.kind = BRC_FILL_PACKING,
                      .n_elements = n,
                      .seed = seed,
                      .radius_spread = 0.125,
                      .coordination = 6.2,
                      .tolerance = 0.02};
}

static void pack(bench *b, int64_t n, double coordination)
{
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    const brc_fill fill = packing_of(n, 1);
    brc_beam_sample *sample;
    done(b, brc_beam_sample_pack(b->context, &shape, &fill, 1, &sample));
    done(b, brc_beam_sample_bond(b->context, sample, coordination, false, 1, &b->domain));
    brc_beam_sample_free(&sample);
}

/* EDGE^2 chains of EDGE - 1 beams, E S / a each; the bounding box is EDGE a wide in all directions, so that
 * E_M / E_m = pi r^2 / a^2 EDGE / (EDGE - 1), and nothing moves across. The solver leaves 1e-9 of the load; ten times
 * that for the force. */
static void a_lattice_of_chains_has_the_modulus_of_its_beams_along_every_axis(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 1);
    make_lattice(&b);
    const double ratio = 0.6, r_over_a = ratio / 2,
                 exact = 3.14159265358979324 * r_over_a * r_over_a * EDGE / (EDGE - 1);
    for (int axis = 0; axis < 3; ++axis) {
        brc_beam_answer answer;
        done(&b, brc_beam_sample_pull(
                     b.context, b.device, b.domain,
                     &(brc_beam_pull){.axis = axis, .radius = ratio, .beam_poisson = 0.3, .tolerance = 1e-9}, &answer));
        assert_true(fabs(answer.young / exact - 1) < 1e-8);
        assert_true(fabs(answer.poisson) < 1e-8);
        assert_int_equal(answer.n_loose, 0);
    }
    close_bench(&b);
}

/* Twice the radius: four times the axial stiffness of chains. */
static void chains_stiffen_with_the_square_of_the_radius(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 1);
    make_lattice(&b);
    brc_beam_answer thin, thick;
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain,
                                  &(brc_beam_pull){.radius = 0.3, .beam_poisson = 0.3, .tolerance = 1e-9}, &thin));
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain,
                                  &(brc_beam_pull){.radius = 0.6, .beam_poisson = 0.3, .tolerance = 1e-9}, &thick));
    assert_true(fabs(thick.young / thin.young - 4) < 1e-7);
    close_bench(&b);
}

/* Work of the kernels is shared in blocks that do not depend on the threads. */
static void answers_are_the_same_bytes_for_any_number_of_threads(void **state)
{
    (void)state;
    brc_beam_answer answer[2];
    for (int k = 0; k < 2; ++k) {
        bench b;
        open_bench(&b, 1 + k);
        pack(&b, 600, 9);
        done(&b, brc_beam_sample_pull(b.context, b.device, b.domain,
                                      &(brc_beam_pull){.radius = 0.4, .beam_poisson = 0.3}, &answer[k]));
        close_bench(&b);
    }
    assert_memory_equal(&answer[0].young, &answer[1].young, sizeof(double));
    assert_memory_equal(answer[0].lateral, answer[1].lateral, sizeof answer[0].lateral);
}

/* The default tolerance against one 1e5 times finer: the header's own figures. */
static void the_default_tolerance_is_as_good_as_its_header_says(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 1);
    pack(&b, 1500, 6);
    brc_beam_answer coarse, fine;
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain, &(brc_beam_pull){.radius = 0.3, .beam_poisson = 0.3},
                                  &coarse));
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain,
                                  &(brc_beam_pull){.radius = 0.3, .beam_poisson = 0.3, .tolerance = 1e-10}, &fine));
    assert_true(fabs(coarse.young / fine.young - 1) < 1e-4);
    assert_true(fabs(coarse.poisson / fine.poisson - 1) < 1e-4);
    assert_true(coarse.iterations < fine.iterations);
    close_bench(&b);
}

/* Thicker beams make nu smaller and E larger at any coordination number (NAH19 Fig. 5); far beyond any rounding. */
static void nu_falls_and_e_grows_with_the_radius(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 1);
    pack(&b, 1500, 8);
    double young = 0, nu = 0.5;
    for (double ratio = 0.2; ratio < 1.1; ratio += 0.4) {
        brc_beam_answer answer;
        done(&b, brc_beam_sample_pull(b.context, b.device, b.domain,
                                      &(brc_beam_pull){.radius = ratio, .beam_poisson = 0.3}, &answer));
        assert_true(answer.young > 1.5 * young);
        assert_true(answer.poisson < nu - 0.02);
        young = answer.young;
        nu = answer.poisson;
    }
    close_bench(&b);
}

/* Pulls with other radii begin from the ones before: the same answers to what the tolerance leaves, in fewer
 * iterations; more of them than are kept. The same radius again needs none. */
static void pulls_begin_from_those_before(void **state)
{
    (void)state;
    static const double radii[] = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
    bench b;
    open_bench(&b, 1);
    pack(&b, 1500, 8);
    brc_beam_states states = {0};
    brc_beam_answer answer, alone;
    for (size_t k = 0; k < sizeof radii / sizeof *radii; ++k) {
        brc_beam_pull pull = {.axis = 1, .radius = radii[k], .beam_poisson = 0.3};
        done(&b, brc_beam_sample_pull(b.context, b.device, b.domain, &pull, &alone));
        pull.states = &states;
        done(&b, brc_beam_sample_pull(b.context, b.device, b.domain, &pull, &answer));
        assert_true(fabs(answer.young / alone.young - 1) < 1e-4);
        assert_true(fabs(answer.poisson / alone.poisson - 1) < 1e-4);
        if (k == 0)
            assert_int_equal(answer.iterations, alone.iterations);
        else
            assert_true(answer.iterations < alone.iterations);
    }
    assert_true(2 * answer.iterations < alone.iterations);
    assert_int_equal(states.n, BRC_BEAM_STATES);
    const brc_beam_pull again = {.axis = 1, .radius = 0.8, .beam_poisson = 0.3, .states = &states};
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain, &again, &answer));
    assert_int_equal(answer.iterations, 0);
    brc_beam_states_free(&states);
    close_bench(&b);
}

/* A simulation with other beams goes on from where a new one would begin: the same bits. */
static void a_renewed_simulation_is_as_good_as_new(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 1);
    pack(&b, 800, 8);
    brc_beam_states states = {0}, apart = {0};
    brc_beam_answer renewed, anew;
    brc_beam_pull pull = {.axis = 2, .radius = 0.3, .beam_poisson = 0.3, .states = &states};
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain, &pull, &renewed));
    const int64_t n = 6 * b.domain->n_elements;
    done(&b, BRC_ALLOCATE(b.context, &apart.state[0], n, "state"));
    memcpy(apart.state[0], states.state[0], (size_t)n * sizeof(double));
    apart.n = 1;
    pull.radius = 0.7, pull.beam_poisson = 0.1, pull.tolerance = 1e-6;
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain, &pull, &renewed));
    pull.states = &apart;
    done(&b, brc_beam_sample_pull(b.context, b.device, b.domain, &pull, &anew));
    assert_true(renewed.iterations > 0);
    assert_int_equal(renewed.iterations, anew.iterations);
    assert_memory_equal(&renewed.young, &anew.young, sizeof(double));
    assert_memory_equal(renewed.lateral, anew.lateral, sizeof anew.lateral);
    assert_memory_equal(states.state[0], apart.state[0], (size_t)n * sizeof(double));
    brc_beam_states_free(&states);
    brc_beam_states_free(&apart);
    close_bench(&b);
}

static void a_sample_without_walls_is_refused_with_the_wall_by_name(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 1);
    make_lattice(&b);
    brc_beam_answer answer;
    memcpy(b.domain->sets[brc_domain_find_set(b.domain, "y+")].name, "q+", 2);
    assert_int_equal(brc_beam_sample_pull(b.context, b.device, b.domain, &(brc_beam_pull){.radius = 0.3}, &answer),
                     BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(b.context), "no wall 'y+'"));
    close_bench(&b);
}

static void a_sample_of_another_fill_is_refused(void **state)
{
    (void)state;
    bench b;
    open_bench(&b, 1);
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    const brc_fill fill = {.kind = BRC_FILL_NOISY_GRID, .n_elements = 100};
    brc_beam_sample *sample;
    assert_int_equal(brc_beam_sample_pack(b.context, &shape, &fill, 1, &sample), BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(b.context), "kind packing"));
    close_bench(&b);
}

/* Sum over the axes of (E / mean E - 1)^2. */
static double spread_of_axes(bench *b, const brc_beam_sample *sample, bool balanced)
{
    double young[3], mean = 0, sum = 0;
    done(b, brc_beam_sample_bond(b->context, sample, 8, balanced, 1, &b->domain));
    for (int axis = 0; axis < 3; ++axis) {
        brc_beam_answer answer;
        done(b, brc_beam_sample_pull(b->context, b->device, b->domain,
                                     &(brc_beam_pull){.axis = axis, .radius = 0.4, .beam_poisson = 0.3}, &answer));
        young[axis] = answer.young;
        mean += answer.young / 3;
    }
    brc_domain_free(&b->domain);
    for (int axis = 0; axis < 3; ++axis)
        sum += (young[axis] / mean - 1) * (young[axis] / mean - 1);
    return sum;
}

/* The unevenness of the fabric is most of what the axes differ by: without it less than half of the square is left,
 * mean of four packings, the same for both. */
static void balanced_bonds_make_the_axes_more_alike(void **state)
{
    (void)state;
    const brc_shape shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    double plain = 0, balanced = 0;
    bench b;
    open_bench(&b, 1);
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        const brc_fill fill = packing_of(1500, seed);
        brc_beam_sample *sample;
        done(&b, brc_beam_sample_pack(b.context, &shape, &fill, 1, &sample));
        plain += spread_of_axes(&b, sample, false);
        balanced += spread_of_axes(&b, sample, true);
        brc_beam_sample_free(&sample);
    }
    assert_true(balanced < plain / 2);
    close_bench(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lattice_of_chains_has_the_modulus_of_its_beams_along_every_axis),
        cmocka_unit_test(chains_stiffen_with_the_square_of_the_radius),
        cmocka_unit_test(answers_are_the_same_bytes_for_any_number_of_threads),
        cmocka_unit_test(the_default_tolerance_is_as_good_as_its_header_says),
        cmocka_unit_test(nu_falls_and_e_grows_with_the_radius),
        cmocka_unit_test(pulls_begin_from_those_before),
        cmocka_unit_test(a_renewed_simulation_is_as_good_as_new),
        cmocka_unit_test(a_sample_without_walls_is_refused_with_the_wall_by_name),
        cmocka_unit_test(a_sample_of_another_fill_is_refused),
        cmocka_unit_test(balanced_bonds_make_the_axes_more_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
