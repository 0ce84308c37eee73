#include "fracture_case.h"
#include "../../../../host/base/log.h"
#include "../../../skip.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

brc_status try_fracture(bench_case *c, fracture_options o)
{
    char text[8192];
    memset(c, 0, sizeof *c);
    c->context = brc_context_create();
    brc_log_set_level(c->context, BRC_LOG_ERROR);
    const int length =
        snprintf(text, sizeof text,
                 "version: 1\nmaterials:\n  glass: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, beam: "
                 "%s%s%s}\n%s%s%smodel: cbm\nbodies:\n  - name: cube\n"
                 "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n    fill: {packing: {elements: %d, seed: "
                 "%d}}\n    beams: 8\n    material: glass\n%s%s%s%s%s%s%s%s%s%s"
                 "output: {frames: none, picture: false}\n",
                 o.beam ? o.beam : "{radius: 0.4, E: 8 Pa}", o.strength ? ", " : "", o.strength ? o.strength : "",
                 o.more ? "  " : "", o.more ? o.more : "", o.more ? "\n" : "", o.elements ? o.elements : 500,
                 o.seed ? o.seed : 1, o.grains ? "    grains: " : "", o.grains ? o.grains : "", o.grains ? "\n" : "",
                 o.regions ? "    regions: " : "", o.regions ? o.regions : "", o.regions ? "\n" : "",
                 o.fracture ? "fracture: " : "", o.fracture ? o.fracture : "", o.fracture ? "\n" : "",
                 o.stages ? o.stages : "stages:\n  - name: move\n    solver: {dynamic: {steps: 1}}\n");
    assert_true(length < (int)sizeof text);
    BRC_TRY(brc_scene_read_text(c->context, "test.yaml", text, (size_t)length, 0, NULL, &c->scene));
    const brc_body *body = c->scene->bodies;
    brc_predicate regions[8];
    assert_true(body->n_regions <= 8);
    for (int32_t r = 0; r < body->n_regions; ++r)
        regions[r] = body->regions[r].where;
    const brc_build_request request = {.shape = body->shape,
                                       .fill = body->fill,
                                       .beams = body->beams,
                                       .grains = body->grains,
                                       .n_regions = body->n_regions,
                                       .regions = regions,
                                       .n_sets = c->scene->n_sets,
                                       .sets = c->scene->sets};
    BRC_TRY(brc_domain_build(c->context, &request, &c->domain));
    const brc_device_request device = {.selector = o.device ? o.device : "cpu",
                                       .precision = o.precision,
                                       .many_materials = brc_simulation_needs_many_materials(c->scene, c->domain),
                                       .n_threads = o.n_threads,
                                       .lanes = o.lanes,
                                       .exact = o.exact};
    BRC_TRY(brc_device_open(c->context, &device, &c->device));
    return brc_simulation_create(c->context, c->scene, c->domain, c->device, &c->simulation);
}

void open_fracture(bench_case *c, fracture_options options)
{
    assert_done(c, try_fracture(c, options));
}

void fracture_is_nothing_unless_asked(bench_case *plain, bench_case *strong, bench_case *with)
{
    assert_true(is_listed(brc_simulation_effects_out(strong->simulation), "fracture") &&
                !is_listed(brc_simulation_effects_in(strong->simulation), "fracture"));
    assert_true(is_listed(brc_simulation_effects_in(with->simulation), "fracture"));
    assert_true(brc_device_bytes(plain->device) == brc_device_bytes(strong->device));
    assert_true(brc_device_bytes(with->device) > brc_device_bytes(strong->device));
    const int64_t n = 3 * plain->domain->n_elements;
    double *u = calloc((size_t)(2 * n), sizeof *u);
    begin_first(plain), begin_first(strong);
    run_steps(plain, 50), run_steps(strong, 50);
    assert_done(plain, brc_simulation_displacement(plain->simulation, u));
    assert_done(strong, brc_simulation_displacement(strong->simulation, u + n));
    assert_memory_equal(u, u + n, (size_t)n * sizeof *u);
    free(u);
    close_case(plain), close_case(strong), close_case(with);
}

void fracture_that_never_comes_moves_nothing(bench_case *plain, bench_case *with)
{
    const int64_t n = 3 * plain->domain->n_elements;
    double *u = calloc((size_t)(2 * n), sizeof *u), largest = 0;
    begin_first(plain), begin_first(with);
    run_steps(plain, 50), run_steps(with, 50);
    assert_done(plain, brc_simulation_displacement(plain->simulation, u));
    assert_done(with, brc_simulation_displacement(with->simulation, u + n));
    for (int64_t k = 0; k < n; ++k)
        largest = fmax(largest, fabs(u[k]));
    for (int64_t k = 0; k < n; ++k)
        assert_true(fabs(u[k] - u[k + n]) < 1e-10 * largest);
    assert_int_equal(count_broken(with), 0);
    free(u);
    close_case(plain), close_case(with);
}

void fracture_compare(fracture_options a, fracture_options b)
{
    bench_case x, y;
    open_fracture(&x, a);
    open_fracture(&y, b);
    assert_same_breaks(&x, &y, 120);
    close_case(&x);
    close_case(&y);
}

void fracture_momenta(bench_case *c, double p[6])
{
    const brc_domain *d = c->domain;
    const int64_t n = d->n_elements;
    double *u = calloc((size_t)(13 * n), sizeof *u), *v = u + 3 * n, *w = u + 6 * n, *q = u + 9 * n;
    assert_done(c, brc_simulation_displacement(c->simulation, u));
    assert_done(c, brc_simulation_velocity(c->simulation, v));
    assert_done(c, brc_simulation_orientation(c->simulation, q, w));
    for (int k = 0; k < 6; ++k)
        p[k] = 0;
    for (int64_t e = 0; e < n; ++e) {
        const double inertia = (d->inertia[6 * e] + d->inertia[6 * e + 1] + d->inertia[6 * e + 2]) / 3;
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = d->position[3 * e + k] + u[3 * e + k];
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            p[k] += d->volume[e] * v[3 * e + k];
            p[3 + k] += d->volume[e] * (x[a] * v[3 * e + b] - x[b] * v[3 * e + a]) + inertia * w[3 * e + k];
        }
    }
    free(u);
}

static const char *other_device;

static void compare_devices(const char *strength)
{
    const fracture_options cpu = {.stages = FRACTURE_BURST(400),
                                  .strength = strength,
                                  .fracture = "{criterion: {virial-principal: {level: 1}}}",
                                  .exact = true};
    fracture_options other = cpu;
    other.device = other_device;
    fracture_compare(cpu, other);
}

static void beams_break_as_on_the_cpu(void **state)
{
    (void)state;
    compare_devices("strength: {tension: 2e-4 Pa}");
}

static void beams_soften_as_on_the_cpu(void **state)
{
    (void)state;
    compare_devices("strength: {tension: 2e-4 Pa, fracture_energy: 1e-8 J/m^2, softening: exponential}");
}

int fracture_device_run(const char *device)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(beams_break_as_on_the_cpu),
                                       cmocka_unit_test(beams_soften_as_on_the_cpu)};
    other_device = device;
    if (!device_is_there(device)) return test_skip("there is no such device with double precision");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
