/* Damping of noise: what it leaves alone, what it takes, and that the frequencies of its operator have the room its
 * factor counts on. */
#include "../../../host/solver/effects/noise_damping.h"
#include "../support.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STAGE(damping, more)                                                                                           \
    "  - name: shake\n    solver: {dynamic: {steps: 100000, time_step: {auto: {safety: 0.8}}, noise_damping: " damping \
    "}}\n" more
#define RANDOM "    initial:\n      - random: {amplitude: [1 mm/s, 1 mm/s, 1 mm/s], seed: 3}\n"

static int64_t length_of(const bench_case *c)
{
    return 3 * (int64_t)c->simulation->layout->n_rows;
}

static double *rows_of(bench_case *c, brc_buffer *buffer)
{
    double *out = calloc((size_t)length_of(c), sizeof *out);
    assert_done(c, brc_download(c->simulation, buffer, 8, out, length_of(c)));
    return out;
}

static double dot(int64_t n, const double *a, const double *b)
{
    double sum = 0;
    for (int64_t k = 0; k < n; ++k)
        sum += a[k] * b[k];
    return sum;
}

/* S v and M^-1 S v: what one pass takes of v; padding carries nothing. */
static void apply(bench_case *c, const double *v, double *drag, double *per_mass)
{
    brc_simulation *s = c->simulation;
    assert_done(c, brc_upload_state(s, brc_velocity_of(s), v, length_of(c)));
    assert_done(c, brc_noise_damp(s));
    double *force = rows_of(c, brc_noise_drag(s)), *after = rows_of(c, brc_velocity_of(s));
    for (int64_t k = 0; k < length_of(c); ++k) {
        if (drag) drag[k] = -force[k];
        if (per_mass) per_mass[k] = (v[k] - after[k]) / brc_noise_factor(s);
    }
    free(force);
    free(after);
}

static void open_shaken(bench_case *c, case_options options)
{
    open_case(c, options);
    assert_done(c, brc_simulation_begin_stage(c->simulation, 0));
    assert_non_null(brc_noise_drag(c->simulation));
}

/* Of a random velocity: no sum of forces, no moment about the undeformed places, and the same work of one field's drag
 * on another as the other way. */
static void the_drag_is_symmetric_and_keeps_momentum(void **state)
{
    (void)state;
    bench_case c;
    open_shaken(&c, (case_options){.stages = STAGE("5 %", RANDOM)});
    const int64_t n = length_of(&c);
    double *v = rows_of(&c, brc_velocity_of(c.simulation)), *w = calloc((size_t)n, sizeof *w),
           *sv = calloc((size_t)n, sizeof *sv), *sw = calloc((size_t)n, sizeof *sw);
    double sum[3] = {0}, scale = 0;
    for (int64_t k = 0; k < n; ++k)
        w[k] = v[k] == 0 ? 0 : 1e-3 * random_at((uint64_t)(k + 7919)); /* padding stays at rest */
    apply(&c, v, sv, NULL);
    apply(&c, w, sw, NULL);
    const double there = dot(n, w, sv), back = dot(n, v, sw);
    assert_true(fabs(there - back) <
                1e-12 * sqrt(dot(n, v, sv) * dot(n, w, sw))); /* sums of 216 elements' products, each rounded */
    assert_true(dot(n, v, sv) > 0);
    for (int64_t k = 0; k < n; ++k)
        sum[k % 3] += sv[k], scale += fabs(sv[k]);
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(sum[k]) < 1e-13 * scale);
    free(v), free(w), free(sv), free(sw);
    close_case(&c);
}

/* A velocity linear in the place, turning and straining: what is lost is rounding. By symmetry this is also the balance
 * of moments. */
static void linear_velocities_are_left_alone(void **state)
{
    (void)state;
    bench_case c;
    open_shaken(&c,
                (case_options){.stages = STAGE("10 %", "    initial:\n      - velocity: {velocity: [1 mm/s, 2 mm/s, "
                                                       "0], gradient: {x: [1e-3 1/s, 2e-3 1/s, 0], "
                                                       "y: [-3e-3 1/s, 0, 1e-3 1/s], z: [0, 1e-3 1/s, 5e-4 1/s]}}\n")});
    double *before = rows_of(&c, brc_velocity_of(c.simulation));
    assert_done(&c, brc_noise_damp(c.simulation));
    double *after = rows_of(&c, brc_velocity_of(c.simulation));
    for (int64_t k = 0; k < length_of(&c); ++k)
        assert_true(fabs(after[k] - before[k]) <
                    1e-13 * 5e-3); /* velocities up to 5 mm/s; the factor times S is below 2 M */
    free(before);
    free(after);
    close_case(&c);
}

/* Largest frequency of M^-1 S by power iteration, over the critical frequency of the body. */
static double frequency_ratio(const char *materials, const char *fill)
{
    bench_case c;
    open_shaken(&c, (case_options){.materials = materials, .fill = fill, .stages = STAGE("1 %", RANDOM)});
    const int64_t n = length_of(&c);
    double *v = rows_of(&c, brc_velocity_of(c.simulation)), *next = calloc((size_t)n, sizeof *next), square = 0;
    for (int i = 0; i < 40; ++i) {
        apply(&c, v, NULL, next);
        square = sqrt(dot(n, next, next) / dot(n, v, v));
        const double length = sqrt(dot(n, next, next));
        for (int64_t k = 0; k < n; ++k)
            v[k] = 1e-3 * next[k] / length;
    }
    const double critical = 2 / brc_simulation_time_step(c.simulation).critical;
    free(v), free(next);
    close_case(&c);
    return sqrt(square) / critical;
}

static void frequencies_of_the_drag_leave_room_for_its_factor(void **state)
{
    (void)state;
    static const char *const nu[] = {"-0.9", "-0.3", "0", "0.49"};
    static const char *const fill[] = {"cells: [5, 5, 5], spread: 90 %", "cells: [6, 6, 6], spread: 0",
                                       "cells: [6, 6, 6], spread: 90 %, lloyd: 5"};
    for (size_t i = 0; i < sizeof nu / sizeof *nu; ++i)
        for (size_t k = 0; k < sizeof fill / sizeof *fill; ++k) {
            char materials[128];
            snprintf(materials, sizeof materials, "  stone: {E: 1 Pa, nu: %s, density: 1 kg/m^3}", nu[i]);
            const double ratio = frequency_ratio(materials, fill[k]);
            print_message("nu %s, %s: %.3f\n", nu[i], fill[k], ratio);
            assert_true(ratio < 1.4); /* its square times the largest share, 1, is then below 2: a contraction */
        }
}

/* What one pass takes of the kinetic energy is what it books. */
static void what_is_lost_is_booked(void **state)
{
    (void)state;
    bench_case c;
    open_shaken(&c, (case_options){.stages = STAGE("10 %", RANDOM)});
    brc_ledger before, after;
    assert_done(&c, brc_simulation_ledger(c.simulation, &before));
    assert_done(&c, brc_noise_damp(c.simulation));
    assert_done(&c, brc_simulation_ledger(c.simulation, &after));
    assert_true(after.damping > 0.01 * before.kinetic);
    assert_true(fabs(before.kinetic - after.kinetic - after.damping) < 1e-13 * before.kinetic);
    close_case(&c);
}

/* Total energy, kinetic and elastic, that is left of an initial velocity v(x) after n_steps; the ledger closes as
 * Verlet does at least. */
static double left_of(const char *stages, bool wave, int64_t n_steps)
{
    bench_case c;
    brc_ledger before, after;
    open_shaken(&c, (case_options){.shape = "{box: {size: [4 m, 0.5 m, 0.5 m]}}",
                                   .fill = "cells: [32, 4, 4], spread: 90 %",
                                   .stages = stages});
    if (wave) { /* the first free vibration along the bar: 64 cells a wave */
        double *v = calloc((size_t)length_of(&c), sizeof *v);
        for (int64_t e = 0; e < c.domain->n_elements; ++e)
            v[3 * c.simulation->layout->row_of_element[e]] = 1e-3 * cos(acos(-1) * c.domain->position[3 * e] / 4);
        assert_done(&c, brc_upload_state(c.simulation, brc_velocity_of(c.simulation), v, length_of(&c)));
        free(v);
    }
    assert_done(&c, brc_simulation_ledger(c.simulation, &before));
    assert_done(&c, brc_simulation_advance(c.simulation, n_steps));
    assert_done(&c, brc_simulation_ledger(c.simulation, &after));
    const double left = (before.kinetic - after.damping) / before.kinetic;
    close_case(&c);
    return left;
}

/* 400 steps are some 12 crossings of the bar. Residuals of a wave of 64 cells are (2 pi / 64)^3 and less of those of
 * noise, so its loss is below 1e-5 of the noise's; the cosine is not quite the mode of 512 uneven cells, which is noise
 * of some 1e-3 in velocity. */
static void noise_goes_and_long_waves_stay(void **state)
{
    (void)state;
    const double noise = left_of(STAGE("5 %", RANDOM), false, 400), wave = left_of(STAGE("5 %", ""), true, 400);
    print_message("left of noise %.4f, of a wave of 64 cells %.7f\n", noise, wave);
    assert_true(noise < 0.5);
    assert_true(wave > 1 - 1e-3);
}

static void other_models_and_softening_faces_are_refused(void **state)
{
    (void)state;
    bench_case c;
    assert_int_equal(try_case(&c, (case_options){.model = "dlsm-published", .stages = STAGE("5 %", RANDOM)}),
                     BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(c.context), "noise_damping: it is made of the bonds of model dlsm"));
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_drag_is_symmetric_and_keeps_momentum),
        cmocka_unit_test(linear_velocities_are_left_alone),
        cmocka_unit_test(frequencies_of_the_drag_leave_room_for_its_factor),
        cmocka_unit_test(what_is_lost_is_booked),
        cmocka_unit_test(noise_goes_and_long_waves_stay),
        cmocka_unit_test(other_models_and_softening_faces_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
