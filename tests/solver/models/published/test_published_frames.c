/* Frames of elements of dlsm-published: what holds them to the solid as it turns (docs/notebook/theory.md T3). E 1 Pa,
 * nu 0.2, density 1 kg/m^3. */
#include "../../support.h"
#include "../../../../host/solver/core/solver.h"
#include <math.h>
#include <stdlib.h>

#define COUPLED "{dlsm-published: {couple_modulus: 0.3}}"

/* Torque on every element [n][3] of a body at rest whose frames are all turned about z by an angle. */
static double *torques_of_turned_frames(bench_case *c, double angle)
{
    const int64_t n = c->domain->n_elements;
    double *q = calloc((size_t)(10 * n), sizeof *q), *zero = q + 4 * n, *force = zero + 3 * n,
           *torque = calloc((size_t)(3 * n), sizeof *torque);
    for (int64_t e = 0; e < n; ++e)
        q[4 * e] = cos(angle / 2), q[4 * e + 3] = sin(angle / 2);
    begin_first(c);
    assert_done(c, brc_state_to_rows(c->simulation, brc_orientation_of(c->simulation), q, 4, 0));
    assert_done(c, brc_simulation_set_state(c->simulation, zero, NULL));
    assert_done(c, brc_simulation_force(c->simulation, force));
    assert_done(c, brc_state_from_rows(c->simulation, brc_torque_of(c->simulation), torque, 3));
    free(q);
    return torque;
}

/* Nothing turns frames back in the published law but for terms of second order; with a couple modulus the bonds of an
 * element do, by mu_c sum of S L (angle - n (n . angle)) of them. Second order: angle^2 = 1e-10 over 1e-5; rounding
 * 1e-16 / 1e-5. */
static void frames_that_lag_are_turned_back_by_the_couple_modulus_alone(void **state)
{
    (void)state;
    const double angle = 1e-5, mu = 1 / 2.4;
    bench_case c;
    for (int coupled = 0; coupled < 2; ++coupled) {
        open_case(&c, (case_options){.model = coupled ? COUPLED : "dlsm-published",
                                     .fill = "cells: [4, 4, 4], spread: 90 %, seed: 2"});
        double *torque = torques_of_turned_frames(&c, angle), worst = 0, largest = 0;
        for (int64_t e = 0; e < c.domain->n_elements; ++e) {
            double expected[3] = {0}, unit = 0;
            for (int64_t k = c.domain->row_start[e]; k < c.domain->row_start[e + 1]; ++k) {
                const double *s = c.domain->area_vector + 3 * k, *x = c.domain->position + 3 * e,
                             *y = c.domain->position + 3 * c.domain->neighbour[k];
                const double S = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]),
                             R[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
                const double L = sqrt(R[0] * R[0] + R[1] * R[1] + R[2] * R[2]);
                for (int i = 0; i < 3; ++i)
                    expected[i] -= 0.3 * mu * S * L * angle * ((i == 2) - R[i] * R[2] / (L * L));
                unit += mu * S * L * angle;
            }
            for (int i = 0; i < 3; ++i)
                worst = fmax(worst, fabs(torque[3 * e + i] - coupled * expected[i]) / unit);
            largest = fmax(largest, fabs(torque[3 * e + 2]) / unit);
        }
        print_message("couple modulus %g of mu: torques up to %.3g of mu S L angle, off by %.2g of it\n", 0.3 * coupled,
                      largest, worst);
        assert_true(worst < 5e-5);
        assert_true(!coupled || largest > 0.1);
        free(torque);
        close_case(&c);
    }
}

/* Root of the mean square over elements of the angle between their frames and the best rotation of their neighbours
 * about them. */
static double lag_of(bench_case *c)
{
    const int64_t n = c->domain->n_elements;
    double *u = calloc((size_t)(7 * n), sizeof *u), *q = u + 3 * n, sum = 0;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    assert_done(c, brc_simulation_orientation(c->simulation, q, NULL));
    for (int64_t e = 0; e < n; ++e) { /* in its frame: sum of R x (R^T r - R) over sum of R^2 - R R, for small angles:
                                         those above half a radian only count as large */
        const double w = q[4 * e], p[3] = {q[4 * e + 1], q[4 * e + 2], q[4 * e + 3]};
        double moment[3] = {0}, room = 0;
        for (int64_t k = c->domain->row_start[e]; k < c->domain->row_start[e + 1]; ++k) {
            const int64_t j = c->domain->neighbour[k];
            double R[3], now[3], once[3], back[3];
            for (int i = 0; i < 3; ++i)
                R[i] = c->domain->position[3 * j + i] - c->domain->position[3 * e + i],
                now[i] = R[i] + u[3 * j + i] - u[3 * e + i];
            for (int i = 0; i < 3; ++i)
                once[i] = now[(i + 1) % 3] * p[(i + 2) % 3] - now[(i + 2) % 3] * p[(i + 1) % 3]; /* now x p */
            for (int i = 0; i < 3; ++i)
                back[i] = now[i] +
                          2 * (w * once[i] + once[(i + 1) % 3] * p[(i + 2) % 3] - once[(i + 2) % 3] * p[(i + 1) % 3]);
            for (int i = 0; i < 3; ++i)
                moment[i] += R[(i + 1) % 3] * back[(i + 2) % 3] - R[(i + 2) % 3] * back[(i + 1) % 3],
                    room += 2 * R[i] * R[i] / 3;
        }
        for (int i = 0; i < 3; ++i)
            sum += moment[i] * moment[i] / (room * room);
    }
    free(u);
    return sqrt(sum / (double)n);
}

/* A ball of 500 cells set vibrating by some 10 % of strain. As published its frames leave the solid until it runs away,
 * at the second swing; with a couple modulus they stay. */
static void frames_follow_a_vibrating_ball_with_a_couple_modulus(void **state)
{
    (void)state;
    double largest[2] = {0};
    for (int coupled = 0; coupled < 2; ++coupled) {
        bench_case c;
        open_case(&c, (case_options){.model = coupled ? "{dlsm-published: {couple_modulus: 0.5}}" : "dlsm-published",
                                     .shape = "{sphere: {centre: [0, 0, 0], radius: 0.5 m}}",
                                     .fill = "elements: 500, spread: 90 %, lloyd: 5, seed: 1",
                                     .stages =
                                         "  - name: swing\n    solver: {dynamic: {steps: 400, time_step: 20 ms, "
                                         "integrator: {tchamwa-wielgosz: {phi: 1.1}}}}\n    initial:\n"
                                         "      - velocity: {gradient: {x: [0.35 1/s, 0, 0], z: [0, 0, 0.35 1/s]}}\n"});
        begin_first(&c);
        for (int k = 0; k < 20 && largest[coupled] < 0.5; ++k) {
            if (brc_simulation_advance(c.simulation, 20) != BRC_OK)
                largest[coupled] = INFINITY;
            else
                largest[coupled] = fmax(largest[coupled], lag_of(&c));
        }
        close_case(&c);
    }
    print_message("frames lag by up to %.3f rad as published, %.3f with a couple modulus\n", largest[0], largest[1]);
    assert_true(largest[0] > 0.4 && largest[1] < 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_that_lag_are_turned_back_by_the_couple_modulus_alone),
        cmocka_unit_test(frames_follow_a_vibrating_ball_with_a_couple_modulus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
