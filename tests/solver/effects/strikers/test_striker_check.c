/* Strikers, and other parts of a scene, that cannot be meant: refused, or told of. */
#include "../../support.h"
#include "../../../../host/base/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HEAD "interactions: {contact: {}}\nstrikers:\n"
#define DURING(time) "  - name: move\n    solver: {dynamic: {duration: " time "}}\n"

/* What the log says while the case is made; *status: of that. Caller frees. */
static char *told(case_options options, brc_status *status)
{
    bench_case c;
    begin_listening();
    *status = try_case(&c, options);
    if (*status == BRC_OK) { /* once more, with what the default level shows */
        brc_simulation_free(&c.simulation);
        brc_log_set_level(c.context, BRC_LOG_INFO);
        *status = brc_simulation_create(c.context, c.scene, c.domain, c.device, &c.simulation);
        if (*status == BRC_OK) *status = brc_simulation_begin_stage(c.simulation, 0);
    }
    const size_t room = 16384;
    char *out = calloc(1, room);
    snprintf(out, room, "%s%s", heard(), *status != BRC_OK ? brc_context_message(c.context) : "");
    close_case(&c);
    return out;
}

static void expect_of(case_options options, const char *what, brc_status expected, const char *words)
{
    brc_status status;
    char *said = told(options, &status);
    if (status != expected || (words ? !strstr(said, words) : said[0] != 0))
        fail_msg("%s: status %d, said: %s", what, (int)status, said);
    free(said);
}

static void expect_silence(case_options options, const char *what, const char *words)
{
    brc_status status;
    char *said = told(options, &status);
    if (status != BRC_OK || strstr(said, words)) fail_msg("%s: status %d, said: %s", what, (int)status, said);
    free(said);
}

/* A cube of 1 m of 6^3 cells, E 1 Pa, density 1 kg/m^3, and a striker. */
static void expect_where(const char *striker, const char *stages, bool contact, brc_status expected, const char *words)
{
    char text[600];
    snprintf(text, sizeof text, HEAD "  it: {%s, material: stone}\n", striker);
    expect_of((case_options){.gravity = text, .stages = stages, .n_threads = 1, .no_contact = !contact}, striker,
              expected, words);
}

static void expect(const char *striker, const char *stages, brc_status expected, const char *words)
{
    expect_where(striker, stages, false, expected, words);
}

static void what_stands_apart_or_touches_is_quiet(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, 0], normal: [0, 0, 1]}", DURING("10 s"), BRC_OK, NULL);
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [1 m, 0, 0]}}", DURING("10 s"), BRC_OK, NULL);
    expect("shape: {sphere: {radius: 50 cm, centre: [50 cm, 50 cm, 1.55 m]}}, motion: {driven: {velocity: [0, 0, -0.1 "
           "m/s]}}",
           DURING("10 s"), BRC_OK, NULL);
}

/* The depth by hand: a plane through the cube's middle is half of it deep; the tip of a needle 0.3 m. */
static void strikers_inside_a_body_are_refused_with_depth_and_place(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, 0.5 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_BAD_INPUT,
           "striker 'it' stands 0.5 m deep in body 'body'");
    expect("plane: {point: [0, 0, 1.25 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_BAD_INPUT,
           "stands 1.25 m deep in body 'body' as the scene starts, deepest at");
    expect("plane: {point: [0, 0, 1.25 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_BAD_INPUT, "turn the normal");
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [0.8 m, 0, 0]}}", DURING("10 s"), BRC_BAD_INPUT,
           "stands 0.2 m deep");
    expect("shape: {sphere: {radius: 50 cm, centre: [50 cm, 50 cm, 1.3 m]}}", DURING("10 s"), BRC_BAD_INPUT,
           "striker 'it' stands");
    /* a needle that pricks a face between the corners of cells: only its own corner is inside */
    expect("shape: {cone: {length: 1 m, radius: 0, end_radius: 1 mm, axis: z, origin: [0.41 m, 0.37 m, 0.97 m]}}, "
           "facets: 8",
           DURING("10 s"), BRC_BAD_INPUT, "striker 'it' stands");
    expect("shape: {box: {size: [2 cm, 2 cm, 2 cm], origin: [0.5 m, 0.5 m, 0.5 m]}}", DURING("10 s"), BRC_BAD_INPUT,
           "striker 'it' stands");
}

/* None of these has a corner or its middle in the other, and the plate is thinner than the depth that is refused: edges
 * of cells, or its own, go through. Cells are 1/6 m and noisy; the middle of what an edge of theirs has in the plate at
 * 0.4 m is at most half a cell from it, so at least 0.05 of 1/6 m from the cube's surface. Faces that lie on each other
 * are no such thing. */
static void what_goes_through_between_corners_is_refused(void **state)
{
    (void)state;
    expect_where("shape: {box: {size: [3.1 m, 2 m, 0.1 mm], origin: [-2 m, -0.5 m, 0.4 m]}}", DURING("10 s"), true,
                 BRC_BAD_INPUT, "striker 'it' stands at least 0.");
    expect_where("shape: {cylinder: {length: 4 m, radius: 1 mm, axis: z, origin: [0.4 m, 0.4 m, -1 m]}}, facets: 8",
                 DURING("10 s"), true, BRC_BAD_INPUT, "deep in body 'body' as the scene starts, at (");
    expect_where("shape: {box: {size: [0.1 mm, 2 m, 0.5 m], origin: [0.5 m, -0.5 m, 0.9 m]}}", DURING("10 s"), true,
                 BRC_BAD_INPUT, "striker 'it' stands");
    /* an edge across the cube's edge at x = z = 1 m, 1 mm nearer to its middle: 1 mm / sqrt(2) from both of its
     * faces */
    expect_where("shape: {box: {size: [1 m, 1 m, 1 m]}}, pose: {translation: [0.6457395 m, 0.41 m, 1.3528463 m], "
                 "rotation: [42.615589 deg, 42.615589 deg, -17.651955 deg]}",
                 DURING("10 s"), true, BRC_OK, "striker 'it' stands 0.0007071 m deep in body 'body'");
    expect_where("shape: {box: {size: [3 m, 3 m, 0.1 mm], origin: [-1 m, -1 m, 1 m]}}", DURING("10 s"), true, BRC_OK,
                 NULL);
    expect_where("shape: {box: {size: [0.1 mm, 0.1 mm, 3 m], origin: [1 m, 0.31 m, -1 m]}}", DURING("10 s"), true,
                 BRC_OK, NULL);
}

static void a_small_overlap_is_told(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, 1 mm], normal: [0, 0, 1]}", DURING("10 s"), BRC_OK, "stands 0.001 m deep");
}

/* Nothing stands in anything as it is built, but an initial field of 3 mm presses the cube 2 mm into the plane 1 mm
 * below it: its 6 x 6 lowest cells, by the volume over the area, which sides that are not upright change by some 2 mm
 * over the size of a cell, 1 %. */
static void what_begins_pressed_together_is_told(void **state)
{
    (void)state;
    static const char plane[] = "plane: {point: [0, 0, -1 mm], normal: [0, 0, 1]}";
#define SUNK(depth)                                                                                                    \
    "  - name: move\n    solver: {dynamic: {steps: 1}}\n    initial:\n      - affine: {displacement: [0, 0, -" depth   \
    "]}\n"
    expect_where(plane, SUNK("3 mm"), true, BRC_OK, "surfaces overlap as the scene starts");
    expect_where(plane, SUNK("3 mm"), true, BRC_OK, "36 pairs by up to 0.002");
    expect_where(plane, SUNK("0.9 mm"), true, BRC_OK, NULL);
}

/* Pressure waves run at sqrt(E (1 - nu) / (rho (1 + nu) (1 - 2 nu))) = 1.054 m/s. */
static void speeds_beyond_sound_are_told(void **state)
{
    (void)state;
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [2 m, 0, 0]}}, motion: {free: {velocity: [-1 m/s, 0, 0]}}",
           DURING("10 s"), BRC_OK, NULL);
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [2 m, 0, 0]}}, motion: {free: {velocity: [-1.1 m/s, 0, 0]}}",
           DURING("10 s"), BRC_OK, "faster than the pressure wave of 'stone', 1.054 m/s");
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}, motion: {driven: {velocity: [0, 0, 0.6 m/s], table: [[0, "
           "1], [2 s, -2]]}}",
           DURING("10 s"), BRC_OK, "up to 1.2 m/s");
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}",
           "  - name: move\n    solver: {dynamic: {duration: 10 s}}\n    initial:\n      - velocity: {velocity: [0, 0, "
           "-2 m/s]}\n",
           BRC_OK, "up to 2 m/s");
    /* a field's largest speed is in a corner of the body: 0.75 m/s where it grows from the middle, 1.5 m/s from a
     * side */
#define GROWING(x)                                                                                                     \
    "  - name: move\n    solver: {dynamic: {duration: 10 s}}\n    initial:\n      - velocity: {gradient: {x: [1.5 "    \
    "1/s, 0, 0]}, origin: [" x " m, 0, 0]}\n"
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}", GROWING("0.5"), BRC_OK, NULL);
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}", GROWING("0"), BRC_OK, "up to 1.5 m/s");
}

/* Cells of 1/6 m hit at 0.1 m/s, waves at 1.054 m/s: 15.8 mm of sinking, three times that 47.4 mm. A cube that thick
 * each way is far from it, a plate of 40 mm is not; at a tenth of the speed it is. */
static void strikers_thinner_than_what_sinks_into_them_are_told(void **state)
{
    (void)state;
#define PLATE(thick, speed)                                                                                            \
    "shape: {box: {size: [1 m, 1 m, " thick "], origin: [0, 0, 1.1 m]}}, motion: {driven: {velocity: [0, 0, -" speed   \
    " m/s]}}"
    expect(PLATE("40 mm", "0.1"), DURING("10 s"), BRC_OK,
           "striker 'it' is 0.04 m thick where it is thinnest, and surfaces that meet with up to 0.1 m/s sink into "
           "each other by some 0.0158 m");
    expect(PLATE("50 mm", "0.1"), DURING("10 s"), BRC_OK, NULL);
    expect(PLATE("40 mm", "0.01"), DURING("10 s"), BRC_OK, NULL);
}

/* A rail holds what the velocity asks for: the rest of it is as given. */
static void a_velocity_against_the_rail_is_told(void **state)
{
    (void)state;
#define ON_RAIL(hold)                                                                                                  \
    "shape: {box: {size: [1 m, 1 m, 1 m], origin: [1.5 m, 0, 0]}}, motion: {free: {velocity: [-0.1 m/s, 0, 0.2 m/s], " \
    "spin: [0, 0.3 rad/s, 0], hold: {" hold "}}}"
    expect(ON_RAIL("y: true"), DURING("10 s"), BRC_OK, NULL);
    expect(ON_RAIL("z: true"), DURING("10 s"), BRC_OK, "its velocity of 0.2 m/s along z is left out");
    expect(ON_RAIL("rotation: true"), DURING("10 s"), BRC_OK, "its spin of 0.3 rad/s is left out");
}

/* Parts of a scene of two bodies, thrown at each other with 0.6 m/s each: 1.2 m/s between them, and the wave runs
 * at 1.054 m/s; both the same way: 0.9 m/s beside what rests. One body alone meets nobody. */
static void bodies_that_meet_faster_than_sound_are_told(void **state)
{
    (void)state;
#define THROWN(left, right)                                                                                            \
    "  - name: meet\n    solver: {dynamic: {steps: 1}}\n    initial:\n      - velocity: {set: left, velocity: [" left  \
    " m/s, 0, 0]}\n      - velocity: {set: right, velocity: [" right " m/s, 0, 0]}\n"
    case_options both = {
        .n_threads = 1,
        .gravity = "interactions: {contact: {}}\n",
        .sets = "sets:\n  left: {elements: {half_space: {point: [0.5 m, 0, 0], normal: [-1, 0, 0]}}}\n  right: "
                "{elements: {half_space: {point: [0.5 m, 0, 0], normal: [1, 0, 0]}}}\n",
        .shape = "{box: {size: [1 m, 1 m, 1 m]}}\n    fill: {noisy_grid: {cells: [4, 4, 4]}}\n    material: stone\n  - "
                 "name: other\n    shape: {box: {size: [1 m, 1 m, 1 m], origin: [2 m, 0, 0]}}"};
    both.stages = THROWN("0.6", "-0.6");
    expect_of(both, both.stages, BRC_OK,
              "bodies meet with up to 1.2 m/s, faster than the pressure wave of 'stone', 1.054 m/s");
    case_options alone = both;
    alone.shape = NULL;
    expect_of(alone, alone.stages, BRC_OK, NULL);
    both.stages = THROWN("-0.9", "-0.6");
    expect_of(both, both.stages, BRC_OK, NULL);
}

/* Cells that may come off, damped contact, contact as stiff as bonds: at 0.8 of the critical step a blow of two of them
 * lasts pi / sqrt(2) / 0.8 = 2.8 of the steps that contact alone would allow, some more of those that bonds allow too.
 * Enough steps, no damping or nothing that can come off: nothing is said. */
static void too_few_steps_of_a_damped_blow_are_told(void **state)
{
    (void)state;
    static const char *const breaks =
                                 "fracture: {criterion: bond-normal}\ninteractions: {contact: {restitution: 0.5}}\n",
                             *const told_of =
                                 "too few for the restitution that is asked for; 20 steps meet it to two hundredths";
    case_options o = {.n_threads = 1,
                      .fill = "cells: [4, 4, 4], spread: 50 %, seed: 1",
                      .materials = "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1 Pa}}",
                      .sets = breaks,
                      .stages = "  - name: move\n    solver: {dynamic: {steps: 1}}\n"};
    expect_of(o, "breaks, damped", BRC_OK, told_of);
    o.sets = "fracture: {criterion: bond-normal}\ninteractions: {contact: {}}\n";
    expect_silence(o, "breaks", told_of);
    o.sets = "interactions: {contact: {restitution: 0.5}}\n";
    expect_silence(o, "damped", told_of);
    o.sets = breaks;
    o.stages = "  - name: move\n    solver: {dynamic: {steps: 1, time_step: {auto: {safety: 0.1}}}}\n";
    expect_silence(o, "fine steps", told_of);
}

static void what_comes_near_nothing_is_told(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_OK, "is 1 m away from all bodies");
    expect(
        "shape: {sphere: {radius: 50 cm, centre: [50 cm, 50 cm, 9 m]}}, motion: {driven: {velocity: [0, 0, -0.1 m/s]}}",
        DURING("10 s"), BRC_OK, "come 1 m nearer in its 10 s and will not meet");
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}", "  - name: move\n    solver: {dynamic: {steps: 10}}\n",
           BRC_OK, NULL); /* no time is known */
}

/* Two strikers, the first of them free: it is told what it does not meet; a fixed one beside a driven one has nothing
 * to meet. */
static void free_strikers_beside_others_are_told_what_they_do_not_meet(void **state)
{
    (void)state;
#define BESIDE(motion)                                                                                                 \
    HEAD                                                                                                               \
        "  ball: {shape: {sphere: {radius: 20 cm, centre: [0.5 m, 0.5 m, 1.25 m]}}, material: stone, motion: {" motion \
        ": {velocity: [0, 0, -0.1 m/s]}}}\n  floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, material: stone}\n"
    case_options o = {.n_threads = 1, .stages = DURING("10 s"), .gravity = BESIDE("free")};
    expect_of(o, "free", BRC_OK,
              "striker 'ball' meets the bodies only and passes through other strikers, such as 'floor'");
    o.gravity = BESIDE("driven");
    expect_of(o, "driven", BRC_OK, NULL);
}

static void what_decides_nothing_is_told(void **state)
{
    (void)state;
    static const char *const still = "  - name: load\n    solver: {static: {increments: 1}}\n";
    expect_where(
        "plane: {point: [0, 0, 0], normal: [0, 0, 1]}", still, true, BRC_OK,
        "contact acts in dynamic stages and the scene has none: surfaces, walls and strikers pass through each other");
    case_options o = {.n_threads = 1,
                      .stages = DURING("10 s"),
                      .materials = "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1 Pa}}",
                      .gravity =
                          "interactions: {interfaces: [{materials: {first: stone, second: stone, factor: 0.5}}]}\n"};
    expect_of(o, "interfaces alone", BRC_OK, "the scene has no `fracture`: they decide nothing");
    o.sets = "fracture: {criterion: bond-normal}\n";
    expect_silence(o, "interfaces of what breaks", "decide nothing");
}

static void free_strikers_need_mass(void **state)
{
    (void)state;
    expect("shape: {sphere: {radius: 1e-120 m, centre: [5 m, 0, 0]}}, motion: {free: {}}", DURING("10 s"),
           BRC_BAD_INPUT, "give it a mass");
}

/* Cells of a sixth of a metre, E 1 Pa, strength 1e-3 Pa: n cells of E G_c / sigma_f^2 are G_c = n 1.6667e-7 J/m^2. Half
 * a cell off 4 and 8, as cells are not of one size. */
static void cracks_that_cells_do_not_resolve_are_told_of(void **state)
{
    (void)state;
    const struct {
        const char *energy, *words;
    } at[] = {{"5.8e-7", "less than 4 cells"},
              {"7.5e-7", "less than 8 cells"},
              {"1.25e-6", "less than 8 cells"},
              {"1.42e-6", NULL}};
    for (size_t k = 0; k < sizeof at / sizeof *at; ++k) {
        char material[200];
        snprintf(
            material, sizeof material,
            "  stone: {E: 1 Pa, nu: 0.2, density: 1 kg/m^3, strength: {tension: 1e-3 Pa, fracture_energy: %s J/m^2}}",
            at[k].energy);
        const case_options options = {.materials = material,
                                      .sets = "fracture: {criterion: bond-normal}\n",
                                      .stages = DURING("1 s"),
                                      .n_threads = 1};
        if (at[k].words)
            expect_of(options, at[k].energy, BRC_OK, at[k].words);
        else
            expect_silence(options, at[k].energy, "fracture_energy");
        if (at[k].words && strstr(at[k].words, "8")) expect_silence(options, at[k].energy, "less than 4");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_stands_apart_or_touches_is_quiet),
        cmocka_unit_test(strikers_inside_a_body_are_refused_with_depth_and_place),
        cmocka_unit_test(what_goes_through_between_corners_is_refused),
        cmocka_unit_test(a_small_overlap_is_told),
        cmocka_unit_test(what_begins_pressed_together_is_told),
        cmocka_unit_test(speeds_beyond_sound_are_told),
        cmocka_unit_test(strikers_thinner_than_what_sinks_into_them_are_told),
        cmocka_unit_test(a_velocity_against_the_rail_is_told),
        cmocka_unit_test(bodies_that_meet_faster_than_sound_are_told),
        cmocka_unit_test(too_few_steps_of_a_damped_blow_are_told),
        cmocka_unit_test(what_comes_near_nothing_is_told),
        cmocka_unit_test(free_strikers_beside_others_are_told_what_they_do_not_meet),
        cmocka_unit_test(what_decides_nothing_is_told),
        cmocka_unit_test(cracks_that_cells_do_not_resolve_are_told_of),
        cmocka_unit_test(free_strikers_need_mass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
