/* Faces that a stage moves with a velocity go on from where the stage before left them. */
#include "../../support.h"
#include <math.h>

/* A pull in uniform stress, where the displacement of a face is that of the cell's linear field, held by a second
 * stage: the force stays. 1e-6: the tolerance of the static solve. */
static void faces_go_on_from_where_they_are(void **state)
{
    (void)state;
    bench_case c;
    double force[3];
    open_case(&c, (case_options){
                      .stages =
                          "  - name: pull\n    solver: {static: {tolerance: 1e-8}}\n"
                          "    loads:\n      - face_displacement: {set: x-, x: 0}\n      - face_displacement: {set: "
                          "x+, x: 1 mm}\n"
                          "      - face_displacement: {set: y-, y: 0}\n      - face_displacement: {set: z-, z: 0}\n"
                          "  - name: hold\n    solver: {dynamic: {steps: 3}}\n"
                          "    loads:\n      - face_velocity: {set: x-, x: 0}\n      - face_velocity: {set: x+, x: 0}\n"
                          "      - face_displacement: {set: y-, y: 0}\n      - face_displacement: {set: z-, z: 0}\n"});
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_done(&c, brc_simulation_reaction(c.simulation, brc_domain_find_set(c.domain, "x+"), force));
    const double e = 1e-3; /* E 1 Pa: P = (1 + e) times the Green strain */
    assert_true(fabs(force[0] / ((1 + e) * (e + 0.5 * e * e)) - 1) < 1e-6);
    close_case(&c);
}

/* A block whose end is pushed aside between held faces, where stress is uneven and no face stands where its cell puts
 * it: force of the end, of one stage or two.
 */
#define PUSHED                                                                                                         \
    "  - name: push\n    solver: {static: {tolerance: 1e-8}}\n    loads:\n"                                            \
    "      - face_displacement: {set: x-, x: 0, y: 0, z: 0}\n"                                                         \
    "      - face_displacement: {set: x+, x: 0, y: 0, z: 1 mm}\n"
static double pushed(const char *stages)
{
    bench_case c;
    double force[3];
    open_case(&c, (case_options){.stages = stages});
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_done(&c, brc_simulation_reaction(c.simulation, brc_domain_find_set(c.domain, "x+"), force));
    close_case(&c);
    return force[2];
}
static void so_they_do_where_stress_is_uneven(void **state)
{
    (void)state;
    const double held = pushed(PUSHED), goes_on = pushed(PUSHED "  - name: hold\n    solver: {dynamic: {steps: 3}}\n"
                                                                "    loads:\n"
                                                                "      - face_velocity: {set: x-, x: 0, y: 0, z: 0}\n"
                                                                "      - face_velocity: {set: x+, x: 0, y: 0, z: 0}\n");
    assert_true(fabs(goes_on / held - 1) < 1e-6);
}

/* Energy at the end [J]. */
static double stored(const char *stages)
{
    bench_case c;
    brc_ledger ledger;
    open_case(&c, (case_options){.stages = stages});
    assert_done(&c, brc_simulation_run(c.simulation));
    assert_done(&c, brc_simulation_ledger(c.simulation, &ledger));
    close_case(&c);
    return ledger.elastic + ledger.stabilisation;
}
/* A pushed block that a second stage holds at one side alone is at rest. 1e-9: the tolerance of the solve, squared,
 * with room. */
static void faces_that_are_let_go_are_free(void **state)
{
    (void)state;
    const double pushed_aside = stored(PUSHED),
                 at_rest = stored(PUSHED "  - name: rest\n    solver: {static: {tolerance: 1e-8}}\n"
                                         "    loads:\n      - face_displacement: {set: y-, x: 0, y: 0, z: 0}\n");
    assert_true(pushed_aside > 0);
    assert_true(at_rest < 1e-9 * pushed_aside);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(faces_go_on_from_where_they_are),
                                       cmocka_unit_test(so_they_do_where_stress_is_uneven),
                                       cmocka_unit_test(faces_that_are_let_go_are_free)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
