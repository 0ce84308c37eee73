/* Fragments as bodies: mass, momenta, energies. */
#include "fracture_case.h"
#include "../../../../host/base/memory.h"
#include "../../../../host/solver/effects/fracture/fragments.h"
#include <math.h>
#include <stdlib.h>

static const char CRITERION[] = "{criterion: {virial-principal: {level: 1}}}";

/* V + w x (x - centre) at every element, all turning with w: the fragment that is the whole body moves just so, to the
 * rounding of sums over 500 elements; nothing moves inside. */
static void a_rigid_motion_is_read_back(void **state)
{
    (void)state;
    static const double v[3] = {0.3, -0.2, 0.5}, w[3] = {0.7, 0.4, -0.9};
    bench_case c;
    brc_fragment *list;
    brc_ledger ledger;
    int64_t n;
    open_fracture(&c, (fracture_options){.fracture = CRITERION, .strength = "strength: {tension: 1 GPa}"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    const int64_t n_elements = c.domain->n_elements;
    double *velocity = calloc((size_t)(3 * n_elements), sizeof *velocity),
           *spin = calloc((size_t)(3 * n_elements), sizeof *spin);
    for (int64_t e = 0; e < n_elements; ++e)
        for (int k = 0; k < 3; ++k) {
            const double *x = c.domain->position + 3 * e;
            velocity[3 * e + k] = v[k] + w[(k + 1) % 3] * x[(k + 2) % 3] - w[(k + 2) % 3] * x[(k + 1) % 3];
            spin[3 * e + k] = w[k];
        }
    assert_done(&c, brc_simulation_set_state(c.simulation, NULL, velocity));
    assert_done(&c, brc_state_to_rows(c.simulation, brc_spin_of(c.simulation), spin, 3, 0));
    assert_done(&c, brc_simulation_fragment_list(c.simulation, &n, &list));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    assert_int_equal(n, 1);
    assert_true(list->n_elements == n_elements && list->first_element == 0);
    double mass = 0;
    for (int64_t e = 0; e < n_elements; ++e)
        mass += c.domain->volume[e];
    assert_true(fabs(list->mass / mass - 1) < 1e-12); /* density 1 */
    for (int k = 0; k < 3; ++k) {
        const double at =
            v[k] + w[(k + 1) % 3] * list->centre[(k + 2) % 3] - w[(k + 2) % 3] * list->centre[(k + 1) % 3];
        assert_true(fabs(list->velocity[k] - at) < 1e-12 && fabs(list->spin[k] - w[k]) < 1e-12);
    }
    assert_true(fabs(list->translation + list->rotation - ledger.kinetic) < 1e-12 * ledger.kinetic);
    assert_true(fabs(list->internal) < 1e-12 * ledger.kinetic);
    free(velocity), free(spin);
    brc_memory_free(list);
    close_case(&c);
}

/* A burst into many pieces, single elements and pairs among them: masses, momenta and kinetic energies sum to those of
 * the body. Rounding of sums over the elements. */
static void fragments_share_out_mass_momentum_and_energy(void **state)
{
    (void)state;
    bench_case c;
    brc_fragment *list;
    brc_ledger ledger;
    int64_t n, n_single = 0, n_elements = 0;
    double mass = 0, momentum[3] = {0}, moment[3] = {0}, energy = 0, all = 0, p[3] = {0}, l[3] = {0}, size = 0;
    open_fracture(&c, (fracture_options){.fracture = CRITERION,
                                         .strength = "strength: {tension: 1e-5 Pa}",
                                         .stages = FRACTURE_BURST(300)});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, 300));
    assert_done(&c, brc_simulation_fragment_list(c.simulation, &n, &list));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    const int64_t n_all = c.domain->n_elements;
    double *m = calloc((size_t)n_all, sizeof *m), *j = calloc((size_t)n_all, sizeof *j),
           *v = calloc((size_t)(3 * n_all), sizeof *v);
    double *x = calloc((size_t)(3 * n_all), sizeof *x), *q = calloc((size_t)(4 * n_all), sizeof *q),
           *w = calloc((size_t)(3 * n_all), sizeof *w);
    assert_done(&c, brc_state_from_rows(c.simulation, brc_mass_of(c.simulation), m, 1));
    assert_done(&c, brc_state_from_rows(c.simulation, brc_inertia_of(c.simulation), j, 1));
    assert_done(&c, brc_simulation_velocity(c.simulation, v));
    assert_done(&c, brc_simulation_displacement(c.simulation, x));
    assert_done(&c, brc_simulation_orientation(c.simulation, q, w));
    for (int64_t e = 0; e < n_all; ++e) {
        all += m[e];
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const double xa = c.domain->position[3 * e + a] + x[3 * e + a],
                         xb = c.domain->position[3 * e + b] + x[3 * e + b];
            p[k] += m[e] * v[3 * e + k];
            l[k] += m[e] * (xa * v[3 * e + b] - xb * v[3 * e + a]) + j[e] * w[3 * e + k];
            size += m[e] * fabs(v[3 * e + k]);
        }
    }
    for (int64_t i = 0; i < n; ++i) {
        const brc_fragment *f = &list[i];
        const double *t = f->inertia;
        const double own[3] = {t[0] * f->spin[0] + t[5] * f->spin[1] + t[4] * f->spin[2],
                               t[5] * f->spin[0] + t[1] * f->spin[1] + t[3] * f->spin[2],
                               t[4] * f->spin[0] + t[3] * f->spin[1] + t[2] * f->spin[2]};
        n_single += f->n_elements == 1;
        n_elements += f->n_elements;
        mass += f->mass;
        energy += f->translation + f->rotation + f->internal;
        assert_true(f->internal > -1e-12 * ledger.kinetic);
        if (i > 0) assert_true(f->first_element > list[i - 1].first_element);
        if (f->n_elements == 1)
            assert_true(fabs(f->spin[0] - w[3 * f->first_element]) <= 1e-12 * fabs(w[3 * f->first_element]));
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            momentum[k] += f->mass * f->velocity[k];
            moment[k] += f->mass * (f->centre[a] * f->velocity[b] - f->centre[b] * f->velocity[a]) + own[k];
        }
    }
    assert_true(n > 20 && n_single > 5 && n < n_all); /* or this would show little */
    assert_int_equal(n_elements, n_all);
    assert_true(fabs(mass / all - 1) < 1e-12);
    assert_true(fabs(energy / ledger.kinetic - 1) < 1e-12);
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(momentum[k] - p[k]) < 1e-12 * size && fabs(moment[k] - l[k]) < 1e-12 * size);
    free(m), free(j), free(v), free(x), free(q), free(w);
    brc_memory_free(list);
    close_case(&c);
}

/* Masses 1, 4, 1, 2: by hand. */
static void sizes_are_shares_of_the_mass(void **state)
{
    (void)state;
    static const brc_fragment list[4] = {{.mass = 1}, {.mass = 4}, {.mass = 1}, {.mass = 2}};
    static const double expected[4] = {0.25, 1, 0.25, 0.5};
    brc_context *context = brc_context_create();
    brc_fragment_sizes sizes;
    double below[4];
    assert_int_equal(brc_fragment_sizes_of(context, 4, list, &sizes, below), BRC_OK);
    assert_true(sizes.mass == 8 && sizes.largest_share == 0.5 && sizes.mean_mass == 22.0 / 8);
    for (int k = 0; k < 4; ++k)
        assert_true(below[k] == expected[k]);
    assert_int_equal(brc_fragment_sizes_of(context, 0, NULL, &sizes, NULL), BRC_OK);
    assert_true(sizes.mass == 0 && sizes.largest_share == 0);
    brc_context_free(&context);
}

/* Cells that turn rigidly, all and half of them: I^-1 of the moment of their velocities is the angular velocity, to the
 * rounding of sums over 216 cells. */
static void the_spin_of_a_set_is_that_of_its_rigid_turning(void **state)
{
    (void)state;
    bench_case c;
    brc_fragment whole, part;
    open_case(&c,
              (case_options){.sets = "sets:\n  half: {elements: {box: {from: [0, 0, 0], to: [0.5 m, 1 m, 1 m]}}}\n",
                             .stages = "  - name: turn\n    solver: {dynamic: {steps: 1}}\n    initial:\n      - spin: "
                                       "{angular_velocity: [1 mrad/s, -2 mrad/s, 0.5 mrad/s], origin: [3 m, 0, 0]}\n"});
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_set_motion(c.simulation, -1, &whole));
    assert_done(&c, brc_simulation_set_motion(c.simulation, brc_domain_find_set(c.domain, "half"), &part));
    static const double w[3] = {1e-3, -2e-3, 5e-4};
    assert_true(whole.n_elements == c.domain->n_elements && part.n_elements < whole.n_elements && part.n_elements > 0);
    for (int k = 0; k < 3; ++k)
        assert_true(fabs(whole.spin[k] - w[k]) < 1e-15 && fabs(part.spin[k] - w[k]) < 1e-15);
    close_case(&c);
}

static void scenes_without_fracture_have_no_fragments(void **state)
{
    (void)state;
    bench_case c;
    brc_fragment *list;
    int64_t n;
    open_fracture(&c, (fracture_options){.elements = 200});
    assert_int_equal(brc_simulation_fragment_list(c.simulation, &n, &list), BRC_BAD_INPUT);
    assert_null(list);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rigid_motion_is_read_back),
        cmocka_unit_test(fragments_share_out_mass_momentum_and_energy),
        cmocka_unit_test(sizes_are_shares_of_the_mass),
        cmocka_unit_test(the_spin_of_a_set_is_that_of_its_rigid_turning),
        cmocka_unit_test(scenes_without_fracture_have_no_fragments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
