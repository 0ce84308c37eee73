/* Bonds of dlsm-published that break: which and when, against the law of AGH19 written down a second time here, and the
 * least squares that are left. */
#include "../../../../host/base/memory.h"
#include "../../../../host/solver/core/sym3.h"
#include "../../effects/fracture/cells_case.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PUBLISHED "dlsm-published"
#define COUPLED "{dlsm-published: {couple_modulus: 0.5}}"

/* ---- the law, a second time: plain loops, no lanes, no rotations left out ---- */

typedef struct reference {
    int64_t n, n_half_edges;
    double *u, *q, *strain, *stress, *force; /* [n][3], [n][4], [n][9], [n_half_edges], [n][3] */
    uint8_t *whole;                          /* [n_half_edges] */
    double couple;                           /* couple modulus over mu */
    int64_t n_flat;                          /* elements whose bonds do not span space */
} reference;

static void matrix_of(const double q[4], double r[3][3])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(r, m, sizeof m);
}

/* Inverse of a symmetric matrix, zero where not every eigenvalue is above least; *kept: how many are. */
static void invert(double a[3][3], double least, double out[3][3], int *kept)
{
    const double six[6] = {a[0][0], a[1][1], a[2][2], a[1][2], a[0][2], a[0][1]};
    double value[3], axis[3][3];
    brc_sym3_eigen(six, value, axis);
    memset(out, 0, 9 * sizeof out[0][0]);
    *kept = 0;
    for (int k = 0; k < 3; ++k) {
        if (!(value[k] > least)) continue;
        *kept += 1;
    }
    for (int k = 0; *kept == 3 && k < 3; ++k)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                out[i][j] += axis[k][i] * axis[k][j] / value[k];
}

/* Couple modulus: 2 couple mu S times the shear of bond k, from e to j, against the mean of both frames beyond that of
 * the mean strain. n: its direction; old: its length in the reference. */
static void add_couple(const bench_case *c, reference *r, int64_t e, int64_t k, const double n[3], double old, double S,
                       double mu, double strain[3][3])
{
    const brc_domain *d = c->domain;
    const int64_t j = d->neighbour[k];
    double at_e[3][3], at_j[3][3], frame[3] = {0}, lag[3], along = 0;
    matrix_of(r->q + 4 * e, at_e);
    matrix_of(r->q + 4 * j, at_j);
    for (int i = 0; i < 3; ++i)
        for (int l = 0; l < 3; ++l)
            frame[i] += 0.5 * (at_e[i][l] + at_j[i][l]) * (d->position[3 * j + l] - d->position[3 * e + l]) / old;
    for (int i = 0; i < 3; ++i) {
        lag[i] = (d->position[3 * j + i] - d->position[3 * e + i] + r->u[3 * j + i] - r->u[3 * e + i]) / old - frame[i];
        for (int l = 0; l < 3; ++l)
            lag[i] -= strain[i][l] * frame[l];
        along += lag[i] * n[i];
    }
    for (int i = 0; i < 3; ++i)
        r->force[3 * e + i] += 2 * r->couple * mu * S * (lag[i] - along * n[i]);
}

/* Strains of the elements; none of those whose bonds no longer span space. */
static void find_strains(const bench_case *c, reference *r)
{
    const brc_domain *d = c->domain;
    r->n_flat = 0;
    for (int64_t e = 0; e < r->n; ++e) {
        double whole[3][3] = {{0}}, least[3], turn[3][3], a[3][3] = {{0}}, b[3][3] = {{0}}, inverse[3][3],
               h[3][3] = {{0}}, local[3][3];
        matrix_of(r->q + 4 * e, turn);
        for (int64_t k = d->row_start[e]; k < d->row_start[e + 1]; ++k) {
            const int64_t j = d->neighbour[k];
            double R[3], now[3], back[3];
            for (int i = 0; i < 3; ++i)
                R[i] = d->position[3 * j + i] - d->position[3 * e + i];
            for (int i = 0; i < 3; ++i)
                for (int l = 0; l < 3; ++l)
                    whole[i][l] += R[i] * R[l];
            if (!r->whole[k]) continue;
            for (int i = 0; i < 3; ++i)
                now[i] = R[i] + r->u[3 * j + i] - r->u[3 * e + i];
            for (int i = 0; i < 3; ++i)
                back[i] = turn[0][i] * now[0] + turn[1][i] * now[1] + turn[2][i] * now[2] - R[i];
            for (int i = 0; i < 3; ++i)
                for (int l = 0; l < 3; ++l)
                    a[i][l] += R[i] * R[l], b[i][l] += back[i] * R[l];
        }
        memset(r->strain + 9 * e, 0, 9 * sizeof *r->strain);
        const double six[6] = {whole[0][0], whole[1][1], whole[2][2], whole[1][2], whole[0][2], whole[0][1]};
        int kept;
        brc_sym3_eigen(six, least, NULL);
        invert(a, 0.2 * least[0], inverse, &kept);
        r->n_flat += kept < 3;
        for (int i = 0; i < 3; ++i)
            for (int l = 0; l < 3; ++l)
                for (int k = 0; k < 3; ++k)
                    h[i][l] += b[i][k] * inverse[k][l];
        for (int i = 0; i < 3; ++i)
            for (int l = 0; l < 3; ++l)
                local[i][l] = 0.5 * (h[i][l] + h[l][i]);
        for (int i = 0; i < 3; ++i)
            for (int l = 0; l < 3; ++l)
                for (int k = 0; k < 3; ++k)
                    for (int m = 0; m < 3; ++m)
                        r->strain[9 * e + 3 * i + l] += turn[i][k] * local[k][m] * turn[l][m];
    }
}

/* And normal stresses of the bonds, forces; E 1 Pa, nu 0.2. */
static void evaluate(bench_case *c, reference *r)
{
    const brc_domain *d = c->domain;
    const double mu = 1 / 2.4, lambda = 0.2 / (1.2 * 0.6);
    find_strains(c, r);
    memset(r->force, 0, 3 * (size_t)r->n * sizeof *r->force);
    for (int64_t e = 0; e < r->n; ++e)
        for (int64_t k = d->row_start[e]; k < d->row_start[e + 1]; ++k) {
            const int64_t j = d->neighbour[k];
            double n[3], strain[3][3], old = 0, now = 0, S = 0, trace = 0, normal = 0, stress[3][3];
            r->stress[k] = 0;
            if (!r->whole[k]) continue;
            for (int i = 0; i < 3; ++i) {
                const double R = d->position[3 * j + i] - d->position[3 * e + i];
                n[i] = R + r->u[3 * j + i] - r->u[3 * e + i];
                old += R * R, now += n[i] * n[i], S += d->area_vector[3 * k + i] * d->area_vector[3 * k + i];
            }
            old = sqrt(old), now = sqrt(now), S = sqrt(S);
            for (int i = 0; i < 3; ++i)
                n[i] /= now;
            for (int i = 0; i < 3; ++i)
                for (int l = 0; l < 3; ++l) {
                    strain[i][l] = 0.5 * (r->strain[9 * e + 3 * i + l] + r->strain[9 * j + 3 * i + l]);
                    normal += n[i] * strain[i][l] * n[l];
                }
            if (r->couple > 0) add_couple(c, r, e, k, n, old, S, mu, strain);
            for (int i = 0; i < 3; ++i) /* the bond's own elongation in the place of n.e n */
                for (int l = 0; l < 3; ++l)
                    strain[i][l] += ((now - old) / old - normal) * n[i] * n[l];
            trace = strain[0][0] + strain[1][1] + strain[2][2];
            for (int i = 0; i < 3; ++i)
                for (int l = 0; l < 3; ++l)
                    stress[i][l] = 2 * mu * strain[i][l] + (i == l) * lambda * trace;
            for (int i = 0; i < 3; ++i)
                for (int l = 0; l < 3; ++l) {
                    r->stress[k] += n[i] * stress[i][l] * n[l];
                    r->force[3 * e + i] += S * stress[i][l] * n[l];
                }
        }
}

static void open_reference(bench_case *c, reference *r)
{
    r->n = c->domain->n_elements, r->n_half_edges = c->domain->n_half_edges;
    r->u = calloc((size_t)(3 * r->n), sizeof *r->u), r->q = calloc((size_t)(4 * r->n), sizeof *r->q);
    r->strain = calloc((size_t)(9 * r->n), sizeof *r->strain), r->force = calloc((size_t)(3 * r->n), sizeof *r->force);
    r->stress = calloc((size_t)r->n_half_edges, sizeof *r->stress);
    r->whole = NULL;
    r->couple = 0;
}

static void close_reference(reference *r)
{
    free(r->u), free(r->q), free(r->strain), free(r->force), free(r->stress);
    brc_memory_free(r->whole);
}

/* The state, and the bonds as they are now. */
static void read_state(bench_case *c, reference *r)
{
    assert_done(c, brc_simulation_displacement(c->simulation, r->u));
    assert_done(c, brc_simulation_orientation(c->simulation, r->q, NULL));
}
static void read_bonds(bench_case *c, reference *r)
{
    brc_memory_free(r->whole);
    assert_done(c, brc_simulation_whole(c->simulation, &r->whole));
}

/* ---- when ---- */

/* nu 0 and a velocity that grows along x, the end cells moved alike: every bond across x has the stress E (L - L0) / L0
 * = E t du/dx, and all of them break in the step in which it first exceeds the strength. */
static void regular_cells_break_at_exactly_the_strength(void **state)
{
    (void)state;
    const double strength = 1e-3, rate = 1e-3;
    bench_case c;
    const brc_break *events;
    int64_t n, expected = 1;
    open_case(&c, (case_options){
                      .model = PUBLISHED,
                      .materials = "  stone: {E: 1 Pa, nu: 0, density: 1 kg/m^3, strength: {tension: 1e-3 Pa}}",
                      .sets = CELLS_FRACTURE "sets:\n  left: {elements: {wall: x-}}\n  right: {elements: {wall: x+}}\n",
                      .fill = "cells: [6, 4, 4], spread: 0 %, seed: 1",
                      .stages = "  - name: pull\n    solver: {dynamic: {steps: 1000, time_step: 0.0317 s}}\n"
                                "    loads:\n      - element_velocity: {set: left, x: 8.333333333333333e-5 m/s}\n"
                                "      - element_velocity: {set: right, x: 9.166666666666667e-4 m/s}\n"
                                "    initial:\n      - velocity: {gradient: {x: [1e-3 1/s, 0, 0]}}\n"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    const double dt = brc_simulation_time_step(c.simulation).value;
    while (rate * dt * (double)expected <= strength)
        ++expected;
    run_steps(&c, expected - 1);
    assert_int_equal(count_broken(&c), 0);
    run_steps(&c, 1);
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
    assert_int_equal(n, 5 * 4 * 4); /* the planes across x, and nothing comes off with them */
    for (int64_t k = 0; k < n; ++k) {
        assert_int_equal(events[k].step, expected);
        assert_int_equal(events[k].mode, BRC_BREAK_TENSION);
        assert_true(fabs(events[k].normal[0]) > 1 - 1e-12);
        assert_true(fabs(events[k].stress - rate * dt * (double)expected) <
                    1e-12); /* rounding of u over L, 1e-16 / 0.17, of thirty steps */
    }
    close_case(&c);
}

/* ---- which, and what is left ---- */

/* A turning, stretching, uneven start: strains of some 1e-3, turns of some hundredths. */
#define SPIN_AND_PULL                                                                                                  \
    "  - name: burst\n    solver: {dynamic: {steps: 400}}\n"                                                           \
    "    initial:\n      - velocity: {gradient: {x: [2e-3 1/s, -0.05 1/s, 0], y: [0.05 1/s, 3e-4 1/s, 4e-4 1/s]}}\n"

/* Every step: exactly the bonds break whose stress the second writing of the law finds above the limit, with that
 * stress. A bond nearer to its limit than the two ways of rounding are apart (1e-16 of displacements of the body's
 * size, over bonds of a tenth, 1e-12 with room) may go either way. And the forces of the body that is left are those of
 * the law without these bonds. */
static void compare_breaks(const char *model, double couple)
{
    const double limit = 1.2e-3;
    bench_case c;
    reference r;
    int64_t seen = 0, compared = 0, elements = 0;
    open_case(&c, (case_options){.model = model,
                                 .materials = CELLS_STRENGTH("1.2e-3 Pa"),
                                 .sets = CELLS_FRACTURE,
                                 .stages = SPIN_AND_PULL,
                                 .fill = "cells: [5, 5, 5], spread: 90 %, seed: 3"});
    open_reference(&c, &r);
    r.couple = couple;
    double *force = calloc((size_t)(3 * r.n), sizeof *force);
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    for (int step = 1; step <= 60; ++step) {
        const brc_break *events;
        int64_t n;
        read_bonds(&c, &r);
        run_steps(&c, 1);
        assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
        if (n == seen && step % 10) continue;
        read_state(&c, &r);
        evaluate(&c, &r);
        for (int64_t b = 0; b < c.domain->n_bonds; ++b) {
            const int64_t h = c.domain->bond_half_edge[b];
            bool broke = false;
            double stress = 0;
            for (int64_t k = seen; k < n; ++k)
                if (events[k].bond == b) broke = true, stress = events[k].stress;
            if (!r.whole[h]) continue;
            ++compared;
            if (fabs(r.stress[h] - limit) > 1e-12) assert_int_equal(broke, r.stress[h] > limit);
            if (broke) assert_true(fabs(stress - r.stress[h]) < 1e-12);
        }
        seen = n;
        read_bonds(&c, &r);
        evaluate(&c, &r);
        assert_done(&c, brc_simulation_force(c.simulation, force));
        for (int64_t k = 0; k < r.n; ++k) {
            ++elements;
            for (int i = 0; i < 3; ++i)
                assert_true(fabs(force[3 * k + i] - r.force[3 * k + i]) < 1e-12 * 0.04); /* as above, times the face */
        }
    }
    print_message("%lld of %lld bonds broke; %lld stresses and %lld forces compared; %lld flat elements at the end\n",
                  (long long)seen, (long long)c.domain->n_bonds, (long long)compared, (long long)elements,
                  (long long)r.n_flat);
    assert_true(seen > 100 && compared > 3000 && elements > 1000);
    free(force);
    close_reference(&r);
    close_case(&c);
}

static void the_bonds_break_that_the_law_says_and_leave_its_least_squares(void **state)
{
    (void)state;
    compare_breaks(PUBLISHED, 0);
    compare_breaks(COUPLED, 0.5);
}

/* The elements' own rotations make a rigid motion cost nothing however few bonds they have left: forces in units of E S
 * of a cell. */
static void turn_rubble(const char *model, const char *materials)
{
    bench_case c;
    open_case(
        &c, (case_options){.model = model, .materials = materials, .sets = CELLS_FRACTURE, .stages = CELLS_BURST(200)});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    run_steps(&c, 150);
    const int64_t n = count_broken(&c);
    print_message("%lld of %lld bonds broken\n", (long long)n, (long long)c.domain->n_bonds);
    assert_true(n > c.domain->n_bonds / 3 && n < c.domain->n_bonds);
    double *zero = calloc((size_t)(3 * c.domain->n_elements), sizeof *zero),
           *f = calloc((size_t)(3 * c.domain->n_elements), sizeof *f);
    double *q = calloc((size_t)(4 * c.domain->n_elements), sizeof *q);
    for (int64_t e = 0; e < c.domain->n_elements; ++e)
        q[4 * e] = cos(0.35), q[4 * e + 3] = sin(0.35);
    assert_done(&c, brc_state_to_rows(c.simulation, brc_orientation_of(c.simulation), q, 4, 0));
    for (int64_t e = 0; e < c.domain->n_elements; ++e) {
        const double *x = c.domain->position + 3 * e;
        zero[3 * e] = cos(0.7) * x[0] - sin(0.7) * x[1] - x[0];
        zero[3 * e + 1] = sin(0.7) * x[0] + cos(0.7) * x[1] - x[1];
    }
    assert_done(&c, brc_simulation_set_state(c.simulation, zero, NULL));
    assert_done(&c, brc_simulation_force(c.simulation, f));
    for (int64_t k = 0; k < 3 * c.domain->n_elements; ++k)
        assert_true(fabs(f[k]) < 1e-13); /* rounding of turned branches, times E S / L of a few faces */
    free(zero), free(f), free(q);
    close_case(&c);
}
static void rubble_that_turns_as_a_whole_feels_nothing(void **state)
{
    (void)state;
    turn_rubble(PUBLISHED, CELLS_STRENGTH("8e-4 Pa"));
    turn_rubble(COUPLED, CELLS_STRENGTH("2e-4 Pa")); /* fewer bonds break where frames follow the solid */
}

static void breaking_keeps_momentum(void **state)
{
    (void)state;
    bench_case c;
    double before[3], after[3];
    open_case(&c, (case_options){.model = PUBLISHED,
                                 .stages = CELLS_BURST(200),
                                 .materials = CELLS_STRENGTH("8e-4 Pa"),
                                 .sets = CELLS_FRACTURE});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    double *v = calloc((size_t)(3 * c.domain->n_elements), sizeof *v);
    for (int k = 0; k < 2; ++k) {
        double *p = k ? after : before;
        assert_done(&c, brc_simulation_velocity(c.simulation, v));
        p[0] = p[1] = p[2] = 0;
        for (int64_t e = 0; e < c.domain->n_elements; ++e)
            for (int i = 0; i < 3; ++i)
                p[i] += c.domain->volume[e] * v[3 * e + i];
        if (k == 0) run_steps(&c, 100);
    }
    assert_true(count_broken(&c) > 100);
    for (int i = 0; i < 3; ++i)
        assert_true(fabs(after[i] - before[i]) < 1e-12 * 1e-3); /* sums of some thousand terms over a hundred steps */
    free(v);
    close_case(&c);
}

/* What breaking takes off the energy of the least-squares strains is what the ledger calls fracture, shared among the
 * events. */
static void the_ledger_books_the_strain_energy_that_breaking_takes(void **state)
{
    (void)state;
    bench_case c;
    const brc_break *events;
    brc_ledger ledger;
    int64_t n;
    double sum = 0;
    open_case(&c, (case_options){.model = PUBLISHED,
                                 .stages = CELLS_BURST(200),
                                 .materials = CELLS_STRENGTH("8e-4 Pa"),
                                 .sets = CELLS_FRACTURE});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    run_steps(&c, 50);
    assert_done(&c, brc_simulation_breaks(c.simulation, &n, &events));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    for (int64_t k = 0; k < n; ++k)
        sum += events[k].energy;
    assert_true(n > 50 && ledger.fracture != 0);
    assert_true(fabs(sum - ledger.fracture) < 1e-12 * ledger.peak_elastic);
    close_case(&c);
}

/* What is set here has few roundings in common with a run without fracture: a wave carries them on (as
 * test_cells_break). */
static void what_never_breaks_moves_as_without_fracture(void **state)
{
    (void)state;
    bench_case plain, with;
    open_case(&plain, (case_options){.model = PUBLISHED, .stages = CELLS_BURST(50)});
    open_case(&with, (case_options){.model = PUBLISHED,
                                    .stages = CELLS_BURST(50),
                                    .materials = CELLS_STRENGTH("1 GPa"),
                                    .sets = CELLS_FRACTURE});
    const int64_t n = 3 * plain.domain->n_elements;
    double *u = calloc((size_t)(2 * n), sizeof *u), largest = 0;
    assert_done(&plain, brc_simulation_begin_stage(plain.simulation, 0));
    assert_done(&with, brc_simulation_begin_stage(with.simulation, 0));
    run_steps(&plain, 50), run_steps(&with, 50);
    assert_done(&plain, brc_simulation_displacement(plain.simulation, u));
    assert_done(&with, brc_simulation_displacement(with.simulation, u + n));
    for (int64_t k = 0; k < n; ++k)
        largest = fmax(largest, fabs(u[k]));
    for (int64_t k = 0; k < n; ++k)
        assert_true(fabs(u[k] - u[k + n]) < 1e-10 * largest);
    assert_int_equal(count_broken(&with), 0);
    free(u);
    close_case(&plain), close_case(&with);
}

static void the_same_bonds_break_for_any_number_of_threads(void **state)
{
    (void)state;
    const case_options one = {.model = PUBLISHED,
                              .stages = CELLS_BURST(60),
                              .materials = CELLS_STRENGTH("2e-4 Pa"),
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
        cmocka_unit_test(regular_cells_break_at_exactly_the_strength),
        cmocka_unit_test(the_bonds_break_that_the_law_says_and_leave_its_least_squares),
        cmocka_unit_test(rubble_that_turns_as_a_whole_feels_nothing),
        cmocka_unit_test(breaking_keeps_momentum),
        cmocka_unit_test(the_ledger_books_the_strain_energy_that_breaking_takes),
        cmocka_unit_test(what_never_breaks_moves_as_without_fracture),
        cmocka_unit_test(the_same_bonds_break_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
