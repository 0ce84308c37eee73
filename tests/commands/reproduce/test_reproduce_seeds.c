/* Runs of a case over several seeds, and the demands of the operators hondros and sides. */
#include "../support.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Cubes of 300 spheres pulled by a static solve. */
static int reproduce(const char *runs)
{
    char command[4096];
    snprintf(command, sizeof command,
             "rm -rf made-seeds && mkdir -p made-seeds/one && cat > made-seeds/one/case.yaml <<'X'\n"
             "title: One\nruns:\n%s\nX\n"
             "cat > made-seeds/one/scene.yaml <<'X'\n"
             "version: 1\nmaterials: {m: {E: 20 GPa, nu: 0.2, density: 1000 kg/m^3, beam: {radius: 0.4, E: 200 "
             "GPa}}}\nmodel: cbm\n"
             "bodies: [{name: cube, shape: {box: {size: [1 m, 1 m, 1 m]}}, fill: {packing: {elements: 300, seed: 5}}, "
             "beams: 9}]\n"
             "stages: [{name: pull, solver: {static: {finite_strain: false}}, loads: [{element_displacement: {set: x-, "
             "x: 0}}, {element_displacement: {set: x+, x: 1 um}}]}]\n"
             "sensors: {force: {reaction: {set: x+, component: x}}}\nmeasure: {pull: {peak: {of: force}}}\noutput: "
             "{frames: none, picture: false}\nX\n",
             runs);
    assert_int_equal(system(command), 0);
    return test_program("reproduce one --folder made-seeds --threads 1 --device cpu -o made-seeds/out");
}

/* Value of a key of the k-th row of rows.csv. */
static double row_value(const char *key, int row)
{
    char header[4096], line[4096] = "";
    FILE *file = fopen("made-seeds/out/rows.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(header, sizeof header, file));
    for (int k = 0; k <= row; ++k)
        assert_non_null(fgets(line, sizeof line, file));
    fclose(file);
    const char *k = header, *v = line;
    for (;;) { /* plain fields: the values of these rows hold no commas */
        const size_t nk = strcspn(k, ",\n"), nv = strcspn(v, ",\n");
        if (nk == strlen(key) && memcmp(k, key, nk) == 0) return nv > 0 ? strtod(v, NULL) : NAN;
        assert_true(k[nk] == ',' && v[nv] == ',');
        k += nk + 1;
        v += nv + 1;
    }
}

/* The mean and the standard deviation of two numbers, to rounding. */
static void several_seeds_give_the_mean_of_single_runs_and_their_scatter(void **state)
{
    (void)state;
    assert_int_equal(reproduce("  - {name: a, rows: {pull: {}}}\n"
                               "  - {name: b, set: bodies.0.fill.packing.seed=6, rows: {pull: {}}}\n"
                               "  - {name: both, seeds: 2, rows: {pull: {}, elements: {}}}"),
                     0);
    const double a = row_value("ours", 0), b = row_value("ours", 1), both = row_value("ours", 2);
    assert_true(a > 0 && b > 0 && a != b);
    assert_near(both, 0.5 * (a + b), 1e-12 * a);
    assert_near(row_value("scatter", 2), fabs(a - b) / sqrt(2),
                1e-6 * fabs(a - b)); /* a difference of nearly equal squares */
    assert_near(row_value("ours", 3), 300, 0);
    assert_int_equal(system("test -f made-seeds/out/runs/both/seed-5/summary.json && test -f "
                            "made-seeds/out/runs/both/seed-6/summary.json"),
                     0);
    assert_int_equal(system("rm -r made-seeds"), 0);
}

/* A block falls 5 cm on a wall without friction: it touches after sqrt(2 h / g) = 0.1 s, within the step that the touch
 * begins in (5 %), and rises to where it was but for what vibrates (5 % of the 5 cm). Means of two seeds of a grid. */
static void a_bounce_is_timed_and_its_rebound_found(void **state)
{
    (void)state;
    assert_int_equal(
        system("rm -rf made-seeds && mkdir -p made-seeds/one && cat > made-seeds/one/case.yaml <<'X'\n"
               "title: One\nruns:\n  - {name: hop, with: bounce, seeds: 2, rows: {first_contact: {}, apex: {}, "
               "spin_after: {}, bounces: {}, stopped: {}}}\nX\n"
               "cat > made-seeds/one/scene.yaml <<'X'\n"
               "version: 1\nmaterials: {m: {E: 1 MPa, nu: 0.2, density: 1000 kg/m^3}, w: {E: 1 GPa, nu: 0.2, density: "
               "1000 kg/m^3}}\n"
               "bodies: [{name: cube, shape: {box: {origin: [0, 0, 5 cm], size: [0.2 m, 0.2 m, 0.2 m]}}, fill: "
               "{noisy_grid: {elements: 27, spread: 20 %}}, material: m}]\n"
               "gravity: [0, 0, -10 m/s^2]\ninteractions: {contact: {stiffness: 20 kN/m}}\nstrikers: {floor: {plane: "
               "{point: [0, 0, 0], normal: [0, 0, 1]}, material: w}}\n"
               "sets: {all: {elements: {box: {from: [-1 m, -1 m, -1 m], to: [1 m, 1 m, 1 m]}}}}\nstages: [{name: hop, "
               "solver: {dynamic: {duration: 0.25 s}}}]\n"
               "sensors: {push: {striker: {name: floor, quantity: force, component: z}}, height: {face_mean: {set: "
               "all, component: z}}, spin: {spin: {component: y}}}\n"
               "measure: {top: {peak: {of: height}}}\noutput: {frames: none, picture: false, history_every: 1}\nX\n"),
        0);
    assert_int_equal(test_program("reproduce one --folder made-seeds --threads 1 --device cpu -o made-seeds/out"), 0);
    assert_near(row_value("ours", 0), 0.1, 5e-3);
    assert_near(row_value("ours", 1), 0, 0.05 * 0.05);
    assert_near(row_value("ours", 2), 0, 0.05);
    assert_near(row_value("ours", 3), 1, 0);
    assert_near(row_value("ours", 4), 0, 0);
    assert_int_equal(system("test -f made-seeds/out/runs/hop/seed-2/summary.json && rm -r made-seeds"), 0);
}

static void seeds_hondros_and_sides_say_what_they_cannot_do(void **state)
{
    (void)state;
    assert_int_equal(reproduce("  - {name: a, seeds: 2, keep: true, rows: {pull: {}}}"), 1);
    assert_non_null(strstr(test_program_stderr(), "run a: no seeds together with keep"));
    assert_int_equal(reproduce("  - {name: a, with: bounce, rows: {pull: {}}}"), 1);
    assert_non_null(strstr(test_program_stderr(),
                           "run a: `with: bounce` expects gravity along -z and sensors named push, height and spin"));
    assert_int_equal(reproduce("  - {name: a, with: hondros, half_angle: 12 deg, rows: {pull: {}}}"), 1);
    assert_non_null(strstr(test_program_stderr(), "run a: `with: hondros` expects one cylinder"));
    assert_int_equal(reproduce("  - {name: a, with: sides, rows: {pull: {}}}"), 1);
    assert_non_null(
        strstr(test_program_stderr(),
               "`with: sides` expects a scene with two measures of kind peak, one for each side; there are 1"));
    assert_int_equal(reproduce("  - {name: a, with: sides, set: [\"measure.pull.peak.area=x+\"], rows: {pull: {}}}"),
                     1);
    assert_non_null(strstr(test_program_stderr(), "measure pull has an area, a stage or a window"));
    assert_int_equal(system("rm -r made-seeds"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(several_seeds_give_the_mean_of_single_runs_and_their_scatter),
        cmocka_unit_test(a_bounce_is_timed_and_its_rebound_found),
        cmocka_unit_test(seeds_hondros_and_sides_say_what_they_cannot_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
