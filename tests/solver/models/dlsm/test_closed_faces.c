/* Closed cracks (host/solver/models/dlsm/closed_faces.c, closed_face.h): the two sides of a brittle broken face
 * bear on each other: spring, force and energy, momentum, friction, step. */
#include "../../../../host/solver/models/dlsm/closed_faces.h"
#include "../../effects/contact/contact_case.h"
#include <math.h>
#include <stdlib.h>

/* Two equal materials on both sides of the plane x = 0.5 m, joined by an interface that breaks at once, in cells of 1/6
 * m. */
#define STIFFER                                                                                                        \
    "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1 Pa}}\n  twin: {E: 30 Pa, nu: 0.2, density: " \
    "1 kg/m^3, strength: {tension: 30 Pa}}"
#define TWINS                                                                                                          \
    "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1 Pa}}\n  twin: {E: 1 Pa, nu: 0.2, density: "  \
    "1 kg/m^3, strength: {tension: 1 Pa}}"
#define TWIN_HALF                                                                                                      \
    "    regions:\n      - {where: {box: {from: [0.5 m, -1 m, -1 m], to: [2 m, 2 m, 2 m]}}, material: twin}\n"
#define WEAK(more)                                                                                                     \
    CELLS_FRACTURE "interactions: {interfaces: [{materials: {first: stone, second: twin, tension: 1e-6 Pa}}]" more "}" \
                   "\n"
#define OPEN                                                                                                           \
    "  - name: open\n    solver: {dynamic: {steps: 100}}\n    initial:\n      - velocity: {gradient: {x: [1e-3 1/s, "  \
    "0, 0]}}\n"
#define REGULAR "cells: [6, 6, 6], spread: 0 %, seed: 1"
#define NOISY "cells: [6, 5, 5], spread: 90 %, seed: 3"
static const double spacing = 1.0 / 6, kappa = 1.15 / 2.4 / 36 * 6; /* k (1 + tau) S / L, k = mu = 1 / 2.4 Pa [N/m] */

static void open_cut_of(bench_case *c, const char *materials, const char *fill, const char *sets)
{
    open_case(c,
              (case_options){.materials = materials, .regions = TWIN_HALF, .sets = sets, .fill = fill, .stages = OPEN});
    begin_first(c);
    run_steps(c, 4);
}
static void open_cut(bench_case *c, const char *fill, const char *sets)
{
    open_cut_of(c, TWINS, fill, sets);
}

/* The right half comes nearer by `gap` and slides by `along` y, and all of it is turned about z (cosine 0.8, or not at
 * all). */
static double *shifted(const brc_domain *d, double gap, double along, bool turned)
{
    double *u = calloc((size_t)(3 * d->n_elements), sizeof *u);
    const double cosine = turned ? 0.8 : 1, sine = turned ? 0.6 : 0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = d->position + 3 * e, right = x[0] > 0.5;
        const double at[2] = {x[0] - gap * right, x[1] + along * right};
        u[3 * e] = cosine * at[0] - sine * at[1] - x[0];
        u[3 * e + 1] = sine * at[0] + cosine * at[1] - x[1];
    }
    return u;
}

static brc_ledger ledger_at(bench_case *c, const double *u)
{
    assert_done(c, brc_simulation_set_state(c->simulation, u, NULL));
    return ledger_now(c);
}

/* Every face of the cut is a spring k (1 + tau) S / L, in a body that stands or is turned; open it bears nothing. Sums
 * of 200 numbers. */
static void a_broken_face_is_a_spring_where_it_is_shut(void **state)
{
    (void)state;
    for (int turned = 0; turned < 2; ++turned) {
        bench_case c;
        const double gap = 0.01 * spacing;
        open_cut(&c, REGULAR, WEAK(""));
        assert_int_equal(count_broken(&c), 36);
        const brc_domain *d = c.domain;
        double *u = shifted(d, gap, 0, turned), *f = calloc((size_t)(3 * d->n_elements), sizeof *f), push[2] = {0, 0},
               sum[3] = {0, 0, 0}, moment = 0;
        const brc_ledger l = ledger_at(&c, u);
        assert_true(fabs(l.contact / (36 * 0.5 * kappa * gap * gap) - 1) < 1e-12);
        assert_true(l.elastic < 1e-12 * l.contact);
        assert_done(&c, brc_simulation_force(c.simulation, f));
        for (int64_t e = 0; e < d->n_elements; ++e) {
            const double *x = d->position + 3 * e, *v = u + 3 * e, *p = f + 3 * e;
            for (int k = 0; k < 3; ++k)
                sum[k] += p[k];
            for (int k = 0; k < 2; ++k)
                push[k] += x[0] > 0.5 ? p[k] : 0;
            moment += (x[0] + v[0]) * p[1] - (x[1] + v[1]) * p[0];
        }
        const double all = 36 * kappa * gap;
        assert_true(fabs(push[0] * (turned ? 0.8 : 1) + push[1] * (turned ? 0.6 : 0) - all) < 1e-12 * all);
        for (int k = 0; k < 3; ++k)
            assert_true(fabs(sum[k]) < 1e-12 * all);
        assert_true(fabs(moment) < 1e-12 * all);
        free(u);
        u = shifted(d, -gap, 0, turned);
        assert_true(ledger_at(&c, u).contact == 0);
        free(u), free(f);
        close_case(&c);
    }
}

static void without_closure_it_bears_nothing(void **state)
{
    (void)state;
    bench_case c;
    open_cut(&c, REGULAR,
             "fracture: {criterion: bond-normal, closure: false}\ninteractions: {interfaces: [{materials: {first: "
             "stone, second: twin, tension: 1e-6 Pa}}]}\n");
    double *u = shifted(c.domain, 0.01 * spacing, 0, false);
    const brc_ledger l = ledger_at(&c, u);
    assert_true(l.contact == 0 && l.elastic + l.stabilisation < 1e-25);
    free(u);
    close_case(&c);
}

/* Five-point differences over a step of which the energy, quartic in one component, knows no more than rounding
 * (test_cells_break.c): 1e-9. worst over the largest force. */
static double gradient_error(bench_case *c, double *u, double h)
{
    const brc_domain *d = c->domain;
    double *f = calloc((size_t)(3 * d->n_elements), sizeof *f), worst = 0, largest = 0;
    assert_done(c, brc_simulation_set_state(c->simulation, u, NULL));
    assert_true(ledger_now(c).contact > 0);
    assert_done(c, brc_simulation_force(c->simulation, f));
    for (int64_t i = 0; i < 3 * d->n_elements; ++i)
        largest = fmax(largest, fabs(f[i]));
    for (int64_t i = 0; i < 3 * d->n_elements; i += 3 * d->n_elements / 60 + 1) {
        const double at[4] = {-2, -1, 1, 2}, weight[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12}, middle = u[i];
        double slope = 0;
        for (int k = 0; k < 4; ++k) {
            u[i] = middle + at[k] * h;
            const brc_ledger l = ledger_at(c, u);
            slope += weight[k] * (l.elastic + l.stabilisation + l.contact) / h;
        }
        u[i] = middle;
        worst = fmax(worst, fabs(slope + f[i]) / largest);
    }
    free(f);
    return worst;
}

/* Of a cut whose sides are pressed and rub. */
static double gradient_error_of_cut(const char *materials)
{
    bench_case c;
    open_cut_of(&c, materials, NOISY, WEAK(""));
    assert_true(count_broken(&c) >= 25);
    double *u = shifted(c.domain, 0.15 * spacing, 0.1 * spacing, true);
    for (int64_t i = 0; i < 3 * c.domain->n_elements; ++i)
        u[i] += 0.01 * spacing * random_at((uint64_t)i);
    assert_done(&c, brc_simulation_set_state(c.simulation, u, NULL)); /* from here on friction holds what slides */
    for (int64_t i = 0; i < 3 * c.domain->n_elements; ++i)
        u[i] += 0.01 * spacing * random_at((uint64_t)i + 7777);
    const double error = gradient_error(&c, u, 1e-3 * spacing);
    free(u);
    close_case(&c);
    return error;
}

static void force_is_the_gradient_of_the_energy(void **state)
{
    (void)state;
    const double shut = fmax(gradient_error_of_cut(TWINS), gradient_error_of_cut(STIFFER));
    bench_case c;
    /* a body of which cells came off; faces that just touch are where the law has a kink, so the step is small, and
     * what it leaves of sums of 0.1 J is 1e-8 */
    open_case(&c, (case_options){.stages = CELLS_BURST(200),
                                 .materials = CELLS_STRENGTH("4e-4 Pa"),
                                 .sets = CELLS_FRACTURE,
                                 .fill = "cells: [5, 5, 5], spread: 90 %, seed: 3"});
    begin_first(&c);
    run_steps(&c, 60);
    double *u = calloc((size_t)(3 * c.domain->n_elements), sizeof *u);
    for (int64_t i = 0; i < 3 * c.domain->n_elements; ++i)
        u[i] = 0.01 * random_at((uint64_t)i);
    const double rubble = gradient_error(&c, u, 1e-5 * spacing);
    print_message("%lld bonds broken; force against energy: %.1e, of rubble %.1e\n", (long long)count_broken(&c), shut,
                  rubble);
    assert_true(shut < 1e-9);
    assert_true(rubble < 1e-8);
    free(u);
    close_case(&c);
}

/* ---- in a run ---- */

/* Sums of some thousand terms over three hundred steps. n: components that must hold: cells without bonds are masses at
 * their places, which do not turn, so that what rubs between two of them moves the angular momentum. */
static void check_momenta(const char *fracture, int n)
{
    bench_case c;
    double before[6], after[6], size = 0, most = 0;
    open_case(&c, (case_options){
                      .stages = CELLS_CRUSH(400, "0.8"), .materials = CELLS_STRENGTH("5e-4 Pa"), .sets = fracture});
    begin_first(&c);
    cell_momenta(&c, before);
    for (int k = 0; k < 30; ++k) {
        run_steps(&c, 10);
        most = fmax(most, ledger_now(&c).contact);
    }
    cell_momenta(&c, after);
    print_message("%lld of %lld bonds broken, pressed faces held up to %.2e J\n", (long long)count_broken(&c),
                  (long long)c.domain->n_bonds, most);
    assert_true(count_broken(&c) > 100 && most > 1e-9);
    for (int k = 0; k < 6; ++k)
        size = fmax(size, fabs(before[k]));
    for (int k = 0; k < n; ++k)
        assert_true(fabs(after[k] - before[k]) < 1e-12 * size);
    close_case(&c);
}

static void pressed_faces_keep_momentum_and_without_friction_angular_momentum(void **state)
{
    (void)state;
    check_momenta(CELLS_FRACTURE, 3);
    check_momenta("fracture: {criterion: bond-normal, friction: 0}\n", 6);
}

/* Of a body that is pressed together and bursts to rubble, the largest error on the way; with the bounds of bonds that
 * break (test_cells_break.c). A step that the springs did not bear would run away within the thousand steps after the
 * last break. */
static void the_ledger_closes_and_the_step_bears_the_springs(void **state)
{
    (void)state;
    const double bound[] = {0.05, 0.01};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        double worst = 0, most = 0;
        open_case(&c, (case_options){.stages = k ? CELLS_CRUSH(4000, "0.35") : CELLS_CRUSH(2000, "0.8"),
                                     .materials = CELLS_STRENGTH("5e-4 Pa"),
                                     .sets = CELLS_FRACTURE});
        begin_first(&c);
        for (int64_t done = 0; done < (k ? 4000 : 2000); done += 20) {
            run_steps(&c, 20);
            const brc_ledger l = ledger_now(&c);
            worst = fmax(worst, fabs(l.closure));
            most = fmax(most, l.contact / l.initial);
        }
        print_message(
            "closure %.2e at worst; %lld of %lld bonds broken; pressed faces held up to %.3f of the energy there is\n",
            worst, (long long)count_broken(&c), (long long)c.domain->n_bonds, most);
        assert_true(most > 0.01 && worst < bound[k]);
        close_case(&c);
    }
}

/* Pulled alike along x and y it bursts at once, to rubble that two of its faces hold: cells at rest between open faces
 * are pushed into others within a few steps. Faces that were looked at again when the speed of their cells had used up
 * the gap, within 32 steps, made energy here, without end in two of six such runs. Bound: half of what a burst into
 * free space may miss. */
static void what_is_pushed_into_an_open_face_meets_it(void **state)
{
    (void)state;
    static const char *const damping[] = {"8e-4", "8e-3", "8e-2"};
    for (int k = 0; k < 3; ++k) {
        bench_case c;
        char stages[512];
        double worst = 0;
        snprintf(stages, sizeof stages,
                 "  - name: pull\n    solver: {dynamic: {steps: 2500, mass_damping: %s 1/s}}\n    loads:\n"
                 "      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: y-, y: 0}\n"
                 "      - face_velocity: {set: x+, x: 1e-5 m/s, table: [[0, 0], [20 s, 1], [1e3 s, 1]]}\n"
                 "      - face_velocity: {set: y+, y: 1e-5 m/s, table: [[0, 0], [20 s, 1], [1e3 s, 1]]}\n",
                 damping[k]);
        open_case(&c, (case_options){.stages = stages,
                                     .materials = CELLS_STRENGTH("3e-4 Pa"),
                                     .sets = CELLS_FRACTURE,
                                     .fill = "cells: [10, 10, 10], spread: 90 %, lloyd: 3, seed: 0"});
        begin_first(&c);
        for (int64_t done = 0; done < 2500; done += 50) {
            run_steps(&c, 50);
            worst = fmax(worst, fabs(ledger_now(&c).closure));
        }
        print_message("closure %.2e at worst; %lld of %lld bonds broken\n", worst, (long long)count_broken(&c),
                      (long long)c.domain->n_bonds);
        assert_true(count_broken(&c) > c.domain->n_bonds / 2 && worst < 0.025);
        close_case(&c);
    }
}

/* ---- friction and contact ---- */

/* Friction holds up to its share of the pressure, here the usual 0.3, and slides beyond. */
static void friction_holds_and_slides(void **state)
{
    (void)state;
    bench_case c;
    const double gap = 0.01 * spacing;
    open_cut(&c, REGULAR, WEAK(""));
    double *u = shifted(c.domain, gap, 0, false), *f = calloc((size_t)(3 * c.domain->n_elements), sizeof *f),
           *still = calloc((size_t)(3 * c.domain->n_elements), sizeof *still);
    const double held = 36 * 0.5 * kappa * gap * gap;
    assert_done(&c, brc_simulation_set_state(c.simulation, u, still));
    assert_true(fabs(ledger_now(&c).contact / held - 1) < 1e-9);
    for (int far = 0; far < 2; ++far) {
        double side = 0, push = 0;
        const double along = (far ? 0.6 : 0.1) * gap;
        free(u);
        u = shifted(c.domain, gap, along, false);
        assert_done(&c, brc_simulation_set_state(c.simulation, u, still));
        run_steps(&c, 1);
        assert_done(&c, brc_simulation_force(c.simulation, f));
        for (int64_t e = 0; e < c.domain->n_elements; ++e)
            if (c.domain->position[3 * e] > 0.5) push += f[3 * e], side += f[3 * e + 1];
        const double share = -side / push; /* the step moves both by as large a part */
        print_message("slide %.1f of the gap: friction %.4f of the push, lost %.3e J\n", along / gap, share,
                      ledger_now(&c).friction);
        assert_true(fabs(share - (far ? 0.3 : 0.1)) < 1e-3);
        assert_true(far ? ledger_now(&c).friction > 1e-3 * held : ledger_now(&c).friction < 1e-20);
    }
    free(u), free(f), free(still);
    close_case(&c);
}

/* Two halves that meet and slide along each other at some speed: what they rub off is booked. A step works by the mean
 * force of its ends and is booked by the last: 1.4 % of it here. */
static void what_slides_is_booked(void **state)
{
    (void)state;
    bench_case c;
    open_cut(&c, NOISY, WEAK(""));
    const int64_t n = c.domain->n_elements;
    double *u = calloc((size_t)(3 * n), sizeof *u), *v = calloc((size_t)(3 * n), sizeof *v);
    for (int64_t e = 0; e < n; ++e)
        if (c.domain->position[3 * e] > 0.5) v[3 * e] = -2e-3, v[3 * e + 1] = 4e-3;
    assert_done(&c, brc_simulation_set_state(c.simulation, u, v));
    const brc_ledger before = ledger_now(&c);
    run_steps(&c, 40);
    const brc_ledger after = ledger_now(&c);
    const double lost = before.kinetic + before.elastic + before.stabilisation + before.contact - after.kinetic -
                        after.elastic - after.stabilisation - after.contact,
                 rubbed = after.friction - before.friction;
    print_message("lost %.4e J, rubbed %.4e J, of %.4e J\n", lost, rubbed, before.kinetic);
    assert_true(rubbed > 0.02 * before.kinetic && fabs(rubbed / lost - 1) < 0.03);
    free(u), free(v);
    close_case(&c);
}

/* Sides that came apart by half of the bond bear nothing afterwards; by a little less, they do. */
static void sides_that_stand_clear_bear_nothing(void **state)
{
    (void)state;
    const double gap = 0.01 * spacing, held = 36 * 0.5 * kappa * gap * gap, apart[2] = {0.48 * spacing, 0.52 * spacing};
    for (int k = 0; k < 2; ++k) {
        bench_case c;
        open_cut(&c, REGULAR, WEAK(""));
        double *still = calloc((size_t)(3 * c.domain->n_elements), sizeof *still),
               *u = shifted(c.domain, -apart[k], 0, false);
        assert_done(&c, brc_simulation_set_state(c.simulation, u, still));
        run_steps(&c, 1);
        free(u);
        u = shifted(c.domain, gap, 0, false);
        const double now = ledger_at(&c, u).contact;
        if (k == 0)
            assert_true(fabs(now / held - 1) < 1e-9);
        else
            assert_true(now == 0);
        free(u), free(still);
        close_case(&c);
    }
}

/* Contact has the pairs of broken faces, by its own stiffness k_n A^2 / h^3 (docs/notebook/contact.md). */
static void with_contact_its_law_bears(void **state)
{
    (void)state;
    bench_case c;
    open_cut(&c, REGULAR, WEAK(", contact: {friction: 0.3}"));
    const double gap = 0.01 * spacing,
                 by_contact = 36 * 0.5 * 1.0 / 36 / 36 / (spacing * spacing * spacing) * gap * gap;
    double *u = shifted(c.domain, gap, 0, false);
    const double now = ledger_at(&c, u).contact;
    print_message("held %.4e J by contact, %.4e expected\n", now, by_contact);
    assert_true(fabs(now / by_contact - 1) < 1e-6);
    free(u);
    close_case(&c);
}

static void the_same_bonds_break_for_any_number_of_threads(void **state)
{
    (void)state;
    const case_options one = {.stages = CELLS_CRUSH(100, "0.8"),
                              .materials = CELLS_STRENGTH("3e-4 Pa"),
                              .sets = CELLS_FRACTURE,
                              .n_threads = 1,
                              .exact = true};
    case_options two = one;
    two.n_threads = 2;
    cells_compare(one, two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_broken_face_is_a_spring_where_it_is_shut),
        cmocka_unit_test(without_closure_it_bears_nothing),
        cmocka_unit_test(force_is_the_gradient_of_the_energy),
        cmocka_unit_test(pressed_faces_keep_momentum_and_without_friction_angular_momentum),
        cmocka_unit_test(the_ledger_closes_and_the_step_bears_the_springs),
        cmocka_unit_test(what_is_pushed_into_an_open_face_meets_it),
        cmocka_unit_test(friction_holds_and_slides),
        cmocka_unit_test(what_slides_is_booked),
        cmocka_unit_test(sides_that_stand_clear_bear_nothing),
        cmocka_unit_test(with_contact_its_law_bears),
        cmocka_unit_test(the_same_bonds_break_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
