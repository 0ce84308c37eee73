/* Strikers that cannot be meant: refused, or told of. */
#include "support.h"
#include "../../host/base/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define HEAD "interactions: {contact: {}}\nstrikers:\n"
#define DURING(time) "  - name: move\n    solver: {dynamic: {duration: " time "}}\n"

/* What the log says while a cube of 1 m of 6^3 cells, E 1 Pa, density 1 kg/m^3, and the striker are made; *status: of that. Caller frees. */
static char *told(const char *striker, const char *stages, brc_status *status)
{
    char text[600];
    bench_case c;
    snprintf(text, sizeof text, HEAD "  it: {%s, material: stone}\n", striker);
    fflush(stderr);
    FILE *file = tmpfile();
    const int kept = dup(2);
    dup2(fileno(file), 2);
    *status = try_case(&c, (case_options){.gravity = text, .stages = stages, .n_threads = 1, .no_contact = true});
    if (*status == BRC_OK) { /* warnings are for the eyes of the default level */
        brc_simulation_free(&c.simulation);
        brc_log_set_level(c.context, BRC_LOG_WARNING);
        *status = brc_simulation_create(c.context, c.scene, c.domain, c.device, &c.simulation);
    }
    fflush(stderr);
    dup2(kept, 2);
    close(kept);
    const size_t room = 4000;
    char *out = calloc(1, room);
    rewind(file);
    const size_t n = fread(out, 1, room - 1, file);
    if (*status != BRC_OK) snprintf(out + n, room - n, "%s", brc_context_message(c.context));
    fclose(file);
    close_case(&c);
    return out;
}

static void expect(const char *striker, const char *stages, brc_status expected, const char *words)
{
    brc_status status;
    char *said = told(striker, stages, &status);
    if (status != expected || (words ? !strstr(said, words) : said[0] != 0)) fail_msg("%s: status %d, said: %s", striker, (int)status, said);
    free(said);
}

static void what_stands_apart_or_touches_is_quiet(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, 0], normal: [0, 0, 1]}", DURING("10 s"), BRC_OK, NULL);
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [1 m, 0, 0]}}", DURING("10 s"), BRC_OK, NULL);
    expect("shape: {sphere: {radius: 50 cm, centre: [50 cm, 50 cm, 1.55 m]}}, motion: {driven: {velocity: [0, 0, -0.1 m/s]}}", DURING("10 s"), BRC_OK, NULL);
}

/* The depth by hand: a plane through the cube's middle is half of it deep; the tip of a needle 0.3 m. */
static void strikers_inside_a_body_are_refused_with_depth_and_place(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, 0.5 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_BAD_INPUT, "striker 'it' stands 0.5 m deep in body 'body'");
    expect("plane: {point: [0, 0, 1.25 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_BAD_INPUT, "stands 1.25 m deep in body 'body' as the scene starts, deepest at");
    expect("plane: {point: [0, 0, 1.25 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_BAD_INPUT, "turn the normal");
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [0.8 m, 0, 0]}}", DURING("10 s"), BRC_BAD_INPUT, "stands 0.2 m deep");
    expect("shape: {sphere: {radius: 50 cm, centre: [50 cm, 50 cm, 1.3 m]}}", DURING("10 s"), BRC_BAD_INPUT, "striker 'it' stands");
    /* a needle that pricks a face between the corners of cells: only its own corner is inside */
    expect("shape: {cone: {length: 1 m, radius: 0, end_radius: 1 mm, axis: z, origin: [0.41 m, 0.37 m, 0.97 m]}}, facets: 8", DURING("10 s"), BRC_BAD_INPUT, "striker 'it' stands");
    expect("shape: {box: {size: [2 cm, 2 cm, 2 cm], origin: [0.5 m, 0.5 m, 0.5 m]}}", DURING("10 s"), BRC_BAD_INPUT, "striker 'it' stands");
}

static void a_small_overlap_is_told(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, 1 mm], normal: [0, 0, 1]}", DURING("10 s"), BRC_OK, "stands 0.001 m deep");
}

/* Pressure waves run at sqrt(E (1 - nu) / (rho (1 + nu) (1 - 2 nu))) = 1.054 m/s. */
static void speeds_beyond_sound_are_told(void **state)
{
    (void)state;
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [2 m, 0, 0]}}, motion: {free: {velocity: [-1 m/s, 0, 0]}}", DURING("10 s"), BRC_OK, NULL);
    expect("shape: {box: {size: [1 m, 1 m, 1 m], origin: [2 m, 0, 0]}}, motion: {free: {velocity: [-1.1 m/s, 0, 0]}}", DURING("10 s"), BRC_OK, "faster than the pressure wave of 'stone', 1.054 m/s");
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}, motion: {driven: {velocity: [0, 0, 0.6 m/s], table: [[0, 1], [2 s, -2]]}}", DURING("10 s"), BRC_OK, "up to 1.2 m/s");
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}", "  - name: move\n    solver: {dynamic: {duration: 10 s}}\n    initial:\n      - velocity: {velocity: [0, 0, -2 m/s]}\n", BRC_OK, "up to 2 m/s");
}

static void what_comes_near_nothing_is_told(void **state)
{
    (void)state;
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}", DURING("10 s"), BRC_OK, "is 1 m away from all bodies");
    expect("shape: {sphere: {radius: 50 cm, centre: [50 cm, 50 cm, 9 m]}}, motion: {driven: {velocity: [0, 0, -0.1 m/s]}}", DURING("10 s"), BRC_OK, "come 1 m nearer in its 10 s and will not meet");
    expect("plane: {point: [0, 0, -1 m], normal: [0, 0, 1]}", "  - name: move\n    solver: {dynamic: {steps: 10}}\n", BRC_OK, NULL); /* no time is known */
}

static void free_strikers_need_mass(void **state)
{
    (void)state;
    expect("shape: {sphere: {radius: 1e-120 m, centre: [5 m, 0, 0]}}, motion: {free: {}}", DURING("10 s"), BRC_BAD_INPUT, "give it a mass");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_stands_apart_or_touches_is_quiet),
        cmocka_unit_test(strikers_inside_a_body_are_refused_with_depth_and_place),
        cmocka_unit_test(a_small_overlap_is_told),
        cmocka_unit_test(speeds_beyond_sound_are_told),
        cmocka_unit_test(what_comes_near_nothing_is_told),
        cmocka_unit_test(free_strikers_need_mass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
