/* Contact of spheres (model cbm) against exact results: Hertz's collision, restitution, momentum, sliding, fragments
 * that meet again. Spheres of radius 0.5 m, density 1 kg/m^3, E 1 Pa and nu 0.2: mass pi/6 kg, E* = 1/1.92 Pa. */
#include "../../../../host/solver/effects/contact/contact.h"
#include "../../models/cbm/beams_case.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double RADIUS = 0.5, MASS = M_PI / 6, HERTZ = 1 / 1.92;
static const char STONE[] = "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.2, E: 1 Pa}}";

/* Two loose spheres, 0 and 1, their centres `gap` beyond touching along x and `side` off it; each flies at speed / 2 to
 * the other. Two more lie far away, bonded, for beams want a bond. */
static void open_pair(beams_case *c, const char *contact, double gap, double side, double speed, const char *time_step,
                      beams_options o)
{
    const double x[12] = {1, 1, 1, 2 + gap, 1 + side, 1, 15, 15, 15, 15, 15.8, 15};
    static char stages[2048];
    snprintf(
        stages, sizeof stages,
        "interactions: {contact: %s}\nsets:\n  left: {elements: {sphere: {centre: [1 m, 1 m, 1 m], radius: 1 cm}}}\n"
        "  right: {elements: {sphere: {centre: [%.17g m, %.17g m, 1 m], radius: 1 cm}}}\n"
        "stages:\n  - name: meet\n    solver: {dynamic: {steps: 100000, time_step: %s}}\n    initial:\n"
        "      - velocity: {set: left, velocity: [%.17g m/s, 0, 0]}\n      - velocity: {set: right, velocity: [%.17g "
        "m/s, 0, 0]}\n",
        contact, x[3], x[4], time_step, speed / 2, -speed / 2);
    o.n = 4, o.n_threads = 1, o.position = x, o.radius = RADIUS, o.coordination = 0.5, o.stages = stages,
    o.materials = STONE;
    open_beams(c, o);
    assert_true(c->domain->n_bonds == 1 && c->domain->bond_half_edge[0] == 0 && c->domain->neighbour[0] == 3);
    beams_done(c, brc_simulation_begin_stage(c->simulation, 0));
}

static brc_ledger ledger_of(beams_case *c)
{
    brc_ledger ledger;
    beams_done(c, brc_simulation_ledger(c->simulation, &ledger));
    return ledger;
}

/* Steps until the spheres have touched and let go; *deepest: largest overlap on the way. */
static int64_t through_contact(beams_case *c, double *deepest, double *most)
{
    double u[12], f[12];
    int64_t touching = 0;
    *deepest = *most = 0;
    const double start = c->domain->position[3] - c->domain->position[0];
    for (int64_t step = 0; step < 100000; ++step) {
        beams_done(c, brc_simulation_advance(c->simulation, 1));
        beams_done(c, brc_simulation_displacement(c->simulation, u));
        beams_done(c, brc_simulation_force(c->simulation, f));
        const double depth = 2 * RADIUS - (start + u[3] - u[0]);
        *deepest = fmax(*deepest, depth);
        *most = fmax(*most, fabs(f[0]));
        touching += depth > 0;
        if (touching > 0 && depth <= 0) return touching;
    }
    fail_msg("they never met");
    return 0;
}

/* The whole of Hertz's theory of a collision: largest overlap (15 m v^2 / (16 E* sqrt(R)))^(2/5), force there,
 * time 2.8683 (m^2 / (R E*^2 v))^(1/5), m and R reduced. 2000 steps in contact: the scheme is second order, 1e-5 of the
 * depth; the time is known to a step. */
static void two_spheres_collide_as_hertz_says(void **state)
{
    (void)state;
    beams_case c;
    double deepest, most, v[12];
    const double m = MASS / 2, r = RADIUS / 2, speed = 1e-3;
    const double lasts = 2.8682655 * pow(m * m / (r * HERTZ * HERTZ * speed), 0.2);
    char step[40];
    snprintf(step, sizeof step, "%.17g s", lasts / 2000);
    open_pair(&c, "{}", 1e-4, 0, speed, step, (beams_options){0});
    const int64_t steps = through_contact(&c, &deepest, &most);
    const double depth = pow(15 * m * speed * speed / (16 * HERTZ * sqrt(r)), 0.4);
    assert_true(fabs(deepest / depth - 1) < 1e-4);
    assert_true(fabs(most / (4.0 / 3 * HERTZ * sqrt(r) * pow(depth, 1.5)) - 1) < 2e-4);
    assert_true(fabs((double)steps / 2000 - 1) < 2e-3);
    beams_done(&c, brc_simulation_velocity(c.simulation, v));
    assert_true(fabs((v[3] - v[0]) / speed - 1) < 1e-5);
    assert_true(fabs(v[3] + v[0]) < 1e-15 * speed * (double)steps);
    close_beams(&c);
}

/* Both normal laws and restitutions from nearly elastic to nearly dead, at two speeds: b alone decides. 400 and more
 * steps in contact; the rate is that of the middle of the last step, an error of the order of a step over the time of
 * contact. */
static void the_restitution_is_the_one_asked_for_at_any_speed(void **state)
{
    (void)state;
    static const double wanted[3] = {0.9, 0.5, 0.2}, speeds[2] = {1e-2, 1e-4};
    static const char *const laws[2] = {"hertz", "linear"};
    for (int law = 0; law < 2; ++law)
        for (int k = 0; k < 3; ++k)
            for (int q = 0; q < 2; ++q) {
                beams_case c;
                char contact[80], step[40];
                double deepest, most, v[12];
                snprintf(contact, sizeof contact, "{restitution: %g, spheres: %s}", wanted[k], laws[law]);
                const double lasts = law ? M_PI * sqrt(MASS / 2 / (HERTZ * RADIUS / 2))
                                         : 2.87 * pow(MASS * MASS / 4 / (RADIUS / 2 * HERTZ * HERTZ * speeds[q]), 0.2);
                snprintf(step, sizeof step, "%.17g s", lasts / 1000);
                open_pair(&c, contact, 0.3 * speeds[q] * lasts, 0, speeds[q], step, (beams_options){0});
                through_contact(&c, &deepest, &most);
                beams_done(&c, brc_simulation_advance(c.simulation, 2000));
                beams_done(&c, brc_simulation_velocity(c.simulation, v));
                const double e = (v[3] - v[0]) / speeds[q];
                if (!(fabs(e - wanted[k]) < 5e-3))
                    fail_msg("%s: restitution %.5g instead of %g at %g m/s", laws[law], e, wanted[k], speeds[q]);
                const brc_ledger ledger = ledger_of(&c);
                assert_true(fabs(ledger.closure) < 5e-3);
                assert_true(fabs(ledger.impact / ledger.initial - (1 - e * e)) < 5e-3);
                assert_true(ledger.contact == 0);
                close_beams(&c);
            }
}

/* What the note about few steps promises, at the safety it proposes: 20 steps for the quickest blow of two spheres.
 * Surfaces meet somewhere within a step, so the dashpot's first force, 2 b omega m v, acts up to a step too short or
 * too long: that changes the speed by up to 2 b omega dt, half of it to either side, b pi / 20 of v; velocity Verlet's
 * own oscillation, (omega dt)^2 / 8 of the energy, adds half of that twice. And 0.02 is what is promised down to a
 * restitution of 0.6. */
static void twenty_steps_of_a_blow_meet_the_restitution(void **state)
{
    (void)state;
    static const double wanted[3] = {0.9, 0.6, 0.3};
    for (int law = 0; law < 2; ++law)
        for (int k = 0; k < 3; ++k) {
            beams_case c;
            char contact[80];
            double deepest, most, v[12];
            snprintf(contact, sizeof contact, "{restitution: %g, spheres: %s}", wanted[k], law ? "linear" : "hertz");
            open_pair(&c, contact, 1e-3, 0, 1e-2, "{auto: {safety: 0.11}}", (beams_options){0});
            through_contact(&c, &deepest, &most);
            beams_done(&c, brc_simulation_advance(c.simulation, 30));
            beams_done(&c, brc_simulation_velocity(c.simulation, v));
            const double e = (v[3] - v[0]) / 1e-2;
            const double bound =
                fmin(M_PI / 20 * brc_contact_law_of(c.simulation, 0, 0)[5] + pow(M_PI / 20, 2) / 8, k < 2 ? 0.02 : 1);
            if (!(fabs(e - wanted[k]) < bound))
                fail_msg("%s: restitution %.5g instead of %g", law ? "linear" : "hertz", e, wanted[k]);
            close_beams(&c);
        }
}

/* A block of eight spheres and their beams on a plane at an angle whose tangent is 1 % below the friction comes to
 * rest, one 1 % above keeps going: drag of c = 0.5 /s lets it settle, and the excess of 0.4 % of g = 1 mm/s^2 then
 * moves it at 0.004 g / c along the slope, as in test_contact_cells. After 80 s drag has left exp(-20), 2e-9, of what
 * began. */
static void a_block_of_beams_slides_where_the_slope_is_the_friction(void **state)
{
    (void)state;
    for (int above = 0; above < 2; ++above) {
        beams_case c;
        double x[24], v[24], speed = 0;
        static char stages[700];
        const double slope = 0.4 * (above ? 1.01 : 0.99), g = 1e-3, cosine = 1 / sqrt(1 + slope * slope),
                     excess = g * cosine * (slope - 0.4) / 0.5;
        for (int k = 0; k < 24; ++k)
            x[k] = 0.5 + (k / 3 >> k % 3 & 1);
        snprintf(stages, sizeof stages,
                 "interactions: {contact: {friction: 0.4, damping: 50 %%}}\nstrikers:\n  slope: {plane: {point: [0, 0, "
                 "0], normal: [0, 0, 1]}, material: stone}\ngravity: [%.17g m/s^2, 0, %.17g m/s^2]\n"
                 "stages:\n  - name: rest\n    solver: {dynamic: {duration: 80 s, mass_damping: 0.5 1/s}}\n",
                 g * slope * cosine, -g * cosine);
        open_beams(&c,
                   (beams_options){
                       .n = 8,
                       .n_threads = 1,
                       .position = x,
                       .radius = RADIUS,
                       .coordination = 3,
                       .stages = stages,
                       .materials = "  stone: {E: 30 Pa, nu: 0.2, density: 1 kg/m^3, beam: {radius: 0.5, E: 30 Pa}}"});
        beams_done(&c, brc_simulation_run(c.simulation));
        beams_done(&c, brc_simulation_velocity(c.simulation, v));
        for (int e = 0; e < 8; ++e)
            speed += v[3 * e] / 8;
        print_message("%s the friction: %.7g m/s, %.7g m/s by hand\n", above ? "above" : "below", speed,
                      fmax(excess, 0));
        if (!(above ? fabs(speed / excess - 1) < 0.05 : fabs(speed) < 1e-3 * fabs(excess)))
            fail_msg("%d: %.6g m/s, %.6g m/s by hand", above, speed, excess);
        close_beams(&c);
    }
}

/* A blow off centre with friction: what one loses the other gains, turning included. */
static void momentum_and_its_moment_stay_through_an_oblique_blow(void **state)
{
    (void)state;
    beams_case c;
    double u[12], v[12], q[16], w[12], before[6] = {0}, after[6] = {0};
    open_pair(&c, "{friction: 0.4, restitution: 0.8}", 0.01, 0.4, 0.02, "0.05 s", (beams_options){0});
    for (int part = 0; part < 2; ++part) {
        double *sum = part ? after : before;
        if (part) beams_done(&c, brc_simulation_advance(c.simulation, 3000));
        beams_done(&c, brc_simulation_displacement(c.simulation, u));
        beams_done(&c, brc_simulation_velocity(c.simulation, v));
        beams_done(&c, brc_simulation_orientation(c.simulation, q, w));
        for (int e = 0; e < 2; ++e)
            for (int k = 0; k < 3; ++k) {
                const int a = (k + 1) % 3, b = (k + 2) % 3;
                const double *x = c.domain->position + 3 * e;
                sum[k] += MASS * v[3 * e + k];
                sum[3 + k] += MASS * ((x[a] + u[3 * e + a]) * v[3 * e + b] - (x[b] + u[3 * e + b]) * v[3 * e + a]) +
                              0.4 * MASS * RADIUS * RADIUS * w[3 * e + k];
            }
    }
    assert_true(fabs(w[2]) > 1e-4); /* the blow turned them */
    for (int k = 0; k < 6; ++k)
        assert_true(fabs(after[k] - before[k]) < 1e-13 * MASS * 0.02);
    assert_true(ledger_of(&c).friction > 0);
    close_beams(&c);
}

/* Halving the step takes the ledger's gap of an oblique blow with friction and damping to a quarter, or it is at
 * rounding. */
static void the_ledger_closes_through_a_blow_with_friction(void **state)
{
    (void)state;
    double gap[3];
    static const char *const steps[3] = {"0.08 s", "0.04 s", "0.02 s"};
    for (int k = 0; k < 3; ++k) {
        beams_case c;
        open_pair(&c, "{friction: 0.4}", 0.01, 0.4, 0.02, steps[k], (beams_options){0});
        beams_done(&c, brc_simulation_advance(c.simulation, 1500 << k));
        gap[k] = fabs(ledger_of(&c).closure);
        close_beams(&c);
    }
    print_message("closure at steps of 0.08, 0.04, 0.02 s: %.3g %.3g %.3g\n", gap[0], gap[1], gap[2]);
    assert_true(gap[2] < 1e-3);
    assert_true(gap[2] < gap[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_spheres_collide_as_hertz_says),
        cmocka_unit_test(the_restitution_is_the_one_asked_for_at_any_speed),
        cmocka_unit_test(twenty_steps_of_a_blow_meet_the_restitution),
        cmocka_unit_test(a_block_of_beams_slides_where_the_slope_is_the_friction),
        cmocka_unit_test(momentum_and_its_moment_stay_through_an_oblique_blow),
        cmocka_unit_test(the_ledger_closes_through_a_blow_with_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
