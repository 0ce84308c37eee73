/* Ten blocks on top of each other, each of eight cells of its own, on a fixed floor under gravity: they settle in a
 * drag, near the critical one of their slowest motion (swaying, 2.8 rad/s), and then rest without it. Material of E 10
 * kPa and density 1 kg/m^3. Environment BRC_STACK_STEPS: steps of rest, by default 2000 (docs/notebook/contact.md has
 * 1e5). */
#include "../../support.h"
#include "../../../../host/base/log.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCKS = 10, SETTLING = 10000 };

/* Cells of neighbouring blocks do not match: every block has seeds of its own. */
static void open_stack(bench_case *c, int steps)
{
    memset(c, 0, sizeof *c);
    c->context = brc_context_create();
    brc_log_set_level(c->context, BRC_LOG_ERROR);
    char text[8192];
    int at = snprintf(text, sizeof text,
                      "version: 1\ntitle: stack\nmaterials:\n  stone: {E: 10 kPa, nu: 0.2, density: 1 kg/m^3}\nmodel: "
                      "dlsm\ngravity: [0, 0, -1 mm/s^2]\n"
                      "interactions: {contact: {friction: 0.5}}\nstrikers:\n  floor: {plane: {point: [0, 0, 0], "
                      "normal: [0, 0, 1]}, material: stone}\nbodies:\n");
    for (int k = 0; k < BLOCKS; ++k)
        at += snprintf(text + at, sizeof text - (size_t)at,
                       "  - name: block%d\n    shape: {box: {size: [1 m, 1 m, 0.5 m], origin: [0, 0, %.1f m]}}\n"
                       "    fill: {noisy_grid: {cells: [2, 2, 2], spread: 30 %%, seed: %d}}\n    material: stone\n",
                       k, 0.5 * k, k + 1);
    at += snprintf(
        text + at, sizeof text - (size_t)at,
        "stages:\n  - name: settle\n    solver: {dynamic: {steps: %d, time_step: 1 ms, mass_damping: 5.5 1/s}}\n"
        "  - name: rest\n    solver: {dynamic: {steps: %d, time_step: 1 ms}}\noutput: {frames: none, picture: false}\n",
        (int)SETTLING, steps);
    assert_done(c, brc_scene_read_text(c->context, "stack.yaml", text, (size_t)at, 0, NULL, &c->scene));
    brc_domain *block[BLOCKS] = {NULL};
    for (int k = 0; k < BLOCKS; ++k) {
        const brc_build_request request = {
            .shape = c->scene->bodies[k].shape, .fill = c->scene->bodies[k].fill, .body = k};
        assert_done(c, brc_domain_build(c->context, &request, &block[k]));
    }
    assert_done(c, brc_domain_join(c->context, BLOCKS, (const brc_domain *const *)block, NULL, BRC_ALONE, &c->domain));
    for (int k = 0; k < BLOCKS; ++k)
        brc_domain_free(&block[k]);
    const brc_device_request request = {
        .selector = "cpu", .n_threads = 1, .many_materials = brc_simulation_needs_many_materials(c->scene, c->domain)};
    assert_done(c, brc_device_open(c->context, &request, &c->device));
    assert_done(c, brc_simulation_create(c->context, c->scene, c->domain, c->device, &c->simulation));
}

/* The sag is some 1e-6 m. Rounding of an overlap, 1e-16 of a block's cubic metre, is 1e-11 N in its contact, 1e-8 of a
 * block's weight of 5e-4 N: so much of the sag, and the speeds that go with it, may remain of the motion and nothing
 * may be added to it. */
static void ten_blocks_at_rest_neither_move_nor_heat(void **state)
{
    (void)state;
    const char *const wanted = getenv("BRC_STACK_STEPS");
    const int steps = wanted ? atoi(wanted) : 2000;
    bench_case c;
    open_stack(&c, steps);
    const int64_t n = c.domain->n_elements;
    double *u = calloc((size_t)(6 * n), sizeof *u), *now = u + 3 * n, sag = 0, moved = 0;
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 0));
    assert_done(&c, brc_simulation_advance(c.simulation, SETTLING));
    assert_done(&c, brc_simulation_displacement(c.simulation, u));
    for (int64_t k = 0; k < 3 * n; ++k)
        sag = fmax(sag, fabs(u[k]));
    assert_done(&c, brc_simulation_begin_stage(c.simulation, 1));
    brc_ledger first, last;
    assert_done(&c, brc_simulation_ledger(c.simulation, &first));
    double warmest = 0;
    for (int done = 0; done < steps; done += steps / 10) {
        assert_done(&c, brc_simulation_advance(c.simulation, steps / 10));
        assert_done(&c, brc_simulation_ledger(c.simulation, &last));
        warmest = fmax(warmest, last.kinetic);
        assert_done(&c, brc_simulation_displacement(c.simulation, now));
        for (int64_t k = 0; k < 3 * n; ++k)
            moved = fmax(moved, fabs(now[k] - u[k]));
    }
    print_message("%lld cells, %d steps: sag %.4g m, moved %.3g m; kinetic energy %.3g J settled, at most %.3g J, %.3g "
                  "J held in contact, closure %.3g\n",
                  (long long)n, steps, sag, moved, first.kinetic, warmest, last.contact, last.closure);
    assert_true(last.contact > 0 && sag > 0);
    assert_true(moved < 1e-6 * sag);
    assert_true(warmest < 1e-12 * last.contact);
    free(u);
    close_case(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_blocks_at_rest_neither_move_nor_heat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
