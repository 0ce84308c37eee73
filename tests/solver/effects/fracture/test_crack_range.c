/* What is told of materials that do not break, and of bodies too coarse for what a crack costs in them, with the size
 * that is wanted. */
#include "cells_case.h"
#include "../../../../host/base/log.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The log of making the simulation once more, at the default level. */
static const char *told_of(case_options options)
{
    bench_case c;
    open_case(&c, options);
    brc_simulation_free(&c.simulation);
    brc_log_set_level(c.context, BRC_LOG_INFO);
    begin_listening();
    const brc_status status = brc_simulation_create(c.context, c.scene, c.domain, c.device, &c.simulation);
    const char *said = heard();
    assert_done(&c, status);
    close_case(&c);
    return said;
}

static void expect(const char *said, const char *words)
{
    if (!strstr(said, words)) fail_msg("expected '%s', heard '%s'", words, said);
}

/* E 1 Pa; E G_c / sigma_f^2 in metres is the energy over the square of the strength. */
#define SOFT(energy)                                                                                                   \
    "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1e-3 Pa, fracture_energy: " energy " J/m^2}}"
#define GRID(n) "cells: [" n "], spread: 0 %"

static void ranges_name_the_cells_they_want(void **state)
{
    (void)state;
    const char *said = told_of((case_options){
        .materials = SOFT("2e-7"), .sets = CELLS_FRACTURE, .fill = GRID("8, 8, 8")}); /* 0.2 m, cells of 125 mm */
    expect(said, "less than 4 cells at");
    expect(said, "use cells of 50 mm (they are of 125 mm; notched parts: 25 mm)");
    said = told_of(
        (case_options){.materials = SOFT("8e-7"), .sets = CELLS_FRACTURE, .fill = GRID("8, 8, 8")}); /* 6.4 cells */
    expect(said, "use cells of 100 mm where that matters (they are of 125 mm)");
    said = told_of((case_options){.materials = SOFT("2e-6"), .sets = CELLS_FRACTURE, .fill = GRID("8, 8, 8")}); /* 16 */
    assert_string_equal(said, "");
}

static void thin_bodies_and_short_cracks_are_warned_of_with_the_size_wanted(void **state)
{
    (void)state;
    const char *plate = "{box: {size: [1 m, 250 mm, 1 m]}}";
    expect(told_of((case_options){
               .materials = SOFT("2e-6"), .sets = CELLS_FRACTURE, .shape = plate, .fill = GRID("8, 2, 8")}),
           "warning: fracture_energy: body 'body' is about 2.0 cells thick along y, expected 4 or more where a crack "
           "runs through it (a plane of symmetry doubles them); use cells of 62.5 mm");
    expect(told_of((case_options){.materials =
                                      "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1e-3 Pa}}",
                                  .sets = CELLS_FRACTURE,
                                  .shape = plate,
                                  .fill = GRID("8, 2, 8")}),
           "bonds break at once"); /* and no size is wanted */
    bench_case c;                  /* half of it is cut, from a side */
    open_case(&c, (case_options){.materials = SOFT("2e-6"), .sets = CELLS_FRACTURE, .fill = GRID("8, 8, 8")});
    brc_crack crack = {
        .name = "notch", .kind = BRC_CRACK_RECTANGLE, .point = {-0.1, -0.1, 0.5}, .edge = {{0.6, 0, 0}, {0, 2, 0}}};
    c.scene->bodies[0].cracks = &crack;
    c.scene->bodies[0].n_cracks = 1;
    brc_simulation_free(&c.simulation);
    brc_log_set_level(c.context, BRC_LOG_INFO);
    begin_listening();
    brc_simulation_create(c.context, c.scene, c.domain, c.device, &c.simulation);
    const char *said = heard();
    expect(said,
           "crack 'notch' of body 'body' is about 4.0 cells long and leaves 4.0: notched parts of uneven cells bear "
           "some 5 to 11 % too much with 15 along it, 4 % with 30; use cells of 33.3 mm for 15, 16.7 mm for 30");
    assert_null(strstr(said, "whole, expected"));
    brc_simulation_free(&c.simulation);
    crack.edge[0][0] = 0.85;
    begin_listening();
    brc_simulation_create(c.context, c.scene, c.domain, c.device, &c.simulation);
    expect(heard(), "leaves about 2.0 cells whole, expected 4 or more; use cells of 62.5 mm");
    c.scene->bodies[0].cracks = NULL;
    c.scene->bodies[0].n_cracks = 0;
    close_case(&c);
}

/* ---- materials without a strength ---- */

#define TWO(strength)                                                                                                  \
    "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {" strength                                              \
    "}}\n  steel: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3}"
#define HALF "    regions: [{material: steel, where: {half_space: {point: [0.5 m, 0, 0], normal: [1, 0, 0]}}}]\n"

/* Glass with a film: the strength of the one over the stiffness of the other is no length that cells could have, so it
 * is told with its cure and counts for no size that is wanted; stiffer neighbours count. */
static void a_soft_film_asks_for_no_cells_of_its_own(void **state)
{
    (void)state;
    static const char
        film[] = "\n  film: {E: 1e-3 Pa, nu: 0.2, density: 1 kg/m^3}",
        wall[] = "\n  film: {E: 1e3 Pa, nu: 0.2, density: 1 kg/m^3}",
        half[] = "    regions: [{material: film, where: {half_space: {point: [0.5 m, 0, 0], normal: [1, 0, 0]}}}]\n";
    char both[256];
    snprintf(both, sizeof both, "%s%s", SOFT("2e-6"), film);
    const char *said =
        told_of((case_options){.materials = both, .sets = CELLS_FRACTURE, .fill = GRID("8, 8, 8"), .regions = half});
    expect(said,
           "64 bonds between 'stone' and the softer 'film', which has no strength, bear as much as 'stone' and open at "
           "once: E G_c / sigma_f^2 is 2 mm there; give the joint a tension and a fracture energy of its own, as in "
           "`interactions: {interfaces: [{materials: {first: stone, second: film");
    assert_null(strstr(said, "use cells of"));
    said = told_of((case_options){.materials = both,
                                  .sets = CELLS_FRACTURE
                                  "interactions: {interfaces: [{materials: {first: stone, second: film, "
                                  "tension: 1e-5 Pa, fracture_energy: 2e-6 J/m^2}}]}\n",
                                  .fill = GRID("8, 8, 8"),
                                  .regions = half});
    assert_null(strstr(said, "softer"));
    snprintf(both, sizeof both, "%s%s", SOFT("2e-6"), wall);
    said = told_of((case_options){.materials = both, .sets = CELLS_FRACTURE, .fill = GRID("8, 8, 8"), .regions = half});
    assert_null(strstr(said, "softer"));
}

/* Of a body whose half x > 0.5 m has no strength: bonds that broke with a side of stone, and with none. */
static void count_sides(bench_case *c, int64_t *stone, int64_t *steel)
{
    const brc_break *events;
    int64_t n;
    assert_done(c, brc_simulation_breaks(c->simulation, &n, &events));
    *stone = *steel = 0;
    for (int64_t k = 0; k < n; ++k) {
        if (events[k].mode == BRC_BREAK_DETACHED) continue;
        const int64_t h = c->domain->bond_half_edge[events[k].bond], i = c->domain->neighbour[c->domain->twin[h]],
                      j = c->domain->neighbour[h];
        *(c->domain->position[3 * i] < 0.5 || c->domain->position[3 * j] < 0.5 ? stone : steel) += 1;
    }
}

static void materials_without_a_strength_do_not_break_in_any_model_of_cells(void **state)
{
    (void)state;
    static const struct {
        const char *model, *fracture, *strength;
    } kinds[] = {{"dlsm", CELLS_FRACTURE, "tension: 2e-4 Pa"},
                 {"dlsm", "fracture: {criterion: virial-principal}\n", "tension: 2e-4 Pa"},
                 {"dlsm-published", CELLS_FRACTURE, "tension: 2e-4 Pa"},
                 {"dlsm", CELLS_FRACTURE, "tension: 2e-4 Pa, fracture_energy: 1e-7 J/m^2"}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
        bench_case c;
        int64_t stone, steel;
        const case_options o = {.model = kinds[k].model,
                                .stages = CELLS_BURST(150),
                                .materials = k == 3 ? TWO("tension: 2e-4 Pa, fracture_energy: 1e-7 J/m^2")
                                                    : TWO("tension: 2e-4 Pa"),
                                .sets = kinds[k].fracture,
                                .regions = HALF};
        expect(told_of(o), k == 1 ? "fracture: no strength is given for 'steel', which does not break; its bonds with "
                                    "others break by theirs"
                                  : "fracture: no strength in tension is given for 'steel', which does not break; its "
                                    "bonds with others break by theirs");
        open_case(&c, o);
        begin_first(&c);
        run_steps(&c, 150);
        count_sides(&c, &stone, &steel);
        print_message("%s %s: %lld bonds with stone broke, %lld of steel alone\n", kinds[k].model, kinds[k].strength,
                      (long long)stone, (long long)steel);
        assert_true(stone > 20 && steel == 0);
        close_case(&c);
    }
}

/* What a strength of 1000 GPa was for: what strength and cells imply is that of the stone. */
static void bonds_that_never_break_imply_no_fracture_energy(void **state)
{
    (void)state;
    bench_case c;
    double implied[2];
    for (int k = 0; k < 2; ++k) {
        open_case(&c, (case_options){.materials = TWO("tension: 1e-3 Pa"),
                                     .sets = CELLS_FRACTURE,
                                     .fill = GRID("8, 8, 8"),
                                     .regions = k ? HALF : NULL});
        implied[k] = brc_simulation_implied_fracture_energy(c.simulation);
        close_case(&c);
    }
    assert_true(fabs(implied[0] / (0.5e-6 * 0.125) - 1) < 1e-9 && fabs(implied[1] / implied[0] - 1) < 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges_name_the_cells_they_want),
        cmocka_unit_test(a_soft_film_asks_for_no_cells_of_its_own),
        cmocka_unit_test(thin_bodies_and_short_cracks_are_warned_of_with_the_size_wanted),
        cmocka_unit_test(materials_without_a_strength_do_not_break_in_any_model_of_cells),
        cmocka_unit_test(bonds_that_never_break_imply_no_fracture_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
