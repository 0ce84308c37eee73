/* Mistakes of a newcomer who writes a Brazilian disc, a bent beam and a struck plate: each sentence says what to write
 * instead. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include "../../host/scene/hint.h"
#include "bad.h"

/* One entry a line, so that a mistake replaces a line. */
static const char *const SCENE[] = {
    "version: 1",
    "materials: {rock: {E: 50 GPa, nu: 0.25, density: 2650 kg/m^3, strength: 8 MPa}}",
    "bodies: [{name: disc, shape: {cylinder: {axis: z, length: 10 mm, diameter: 50 mm}}, fill: {noisy_grid: {spacing: "
    "2.5 mm}}}]",
    "platens: {axis: y, speed: 0.2 m/s, friction: 0.3}",
    "fracture: true",
    "stages: [{name: press, solver: {dynamic: {duration: 1.2 ms}}}]",
    "output: {frames: none}",
};
enum { LINES = sizeof SCENE / sizeof *SCENE };

static void write_scene(int line, const char *mistake, char *out, size_t room)
{
    size_t at = 0;
    for (int k = 0; k < LINES; ++k)
        at += (size_t)snprintf(out + at, room - at, "%s\n", k == line - 1 ? mistake : SCENE[k]);
}

static void the_scene_without_mistakes_is_good(void **state)
{
    (void)state;
    char text[2048];
    write_scene(0, "", text, sizeof text);
    assert_int_equal(count_errors(text), 0);
}

#define MATERIAL(keys) "materials: {rock: {" keys "}}"
#define BODY(shape, fill) "bodies: [{name: disc, shape: {" shape "}, fill: {" fill "}}]"
#define ROUND "cylinder: {axis: z, length: 10 mm, diameter: 50 mm}"
#define GRID "noisy_grid: {spacing: 2.5 mm}"
static const struct {
    int line;
    const char *mistake, *place, *cure;
} MISTAKE[] = {
    {2, MATERIAL("E: 50 Gpa, nu: 0.25, density: 2650 kg/m^3"), "2:23", "did you mean '50 GPa'?"},
    {2, MATERIAL("E: 50000 mpa, nu: 0.25, density: 2650 kg/m^3"), "2:23", "did you mean '50000 MPa'?"},
    {2, MATERIAL("E: 50 GPa, nu: 0.25, density: 2650 kg/m3"), "2:50", "did you mean '2650 kg/m^3'?"},
    {2, MATERIAL("E: 50 GPa, nu: 0.25, density: 2.65 g/cm3"), "2:50", "did you mean '2.65 g/cm^3'?"},
    {2, MATERIAL("young: 50 GPa, nu: 0.25, density: 2650 kg/m^3"), "2:20", "did you mean 'E'?"},
    {2, MATERIAL("E: 50 GPa, Poisson: 0.25, density: 2650 kg/m^3"), "2:31", "did you mean 'nu'?"},
    {2, MATERIAL("E: 50 GPa, Nu: 0.25, density: 2650 kg/m^3"), "2:31", "did you mean 'nu'?"},
    {2, MATERIAL("E: 50 GPa, nu: 0.25, rho: 2650 kg/m^3"), "2:41", "did you mean 'density'?"},
    {2, MATERIAL("E: 50 GPa, nu: 0.25, density: 2650 kg/m^3, fracture_energy: 20 N/m"), "2:63",
     "as in strength: {fracture_energy: ...}"},
    {2, MATERIAL("E: 50 GPa, nu: 0.25, density: 2650 kg/m^3, strength: {tensile: 8 MPa}"), "2:74",
     "did you mean 'tension'?"},
    {2, MATERIAL("E: 50 GPa, nu: 0.25, density: 2650 kg/m^3, strength: {tension: 8 MPa, weibull: 9}"), "2:90",
     "as in scatter: {weibull: ...}"},
    {2, "materials: [{name: rock, E: 50 GPa}]", "2:12", "as in materials: {glass: ...}"},
    {3, BODY("disc: {axis: z, length: 10 mm, diameter: 50 mm}", GRID), "3:31", "did you mean 'cylinder'?"},
    {3, BODY("cylinder: {axis: z, thickness: 10 mm, diameter: 50 mm}", GRID), "3:51", "did you mean 'length'?"},
    {3, BODY("cylinder: {axis: Z, length: 10 mm, diameter: 50 mm}", GRID), "3:48", "did you mean z?"},
    {3, BODY("cylinder: {center: [0, 0, 0], length: 10 mm, diameter: 50 mm}", GRID), "3:42", "did you mean 'origin'?"},
    {3, BODY(ROUND, "grid: {spacing: 2.5 mm}"), "3:92", "did you mean 'noisy_grid'?"},
    {3, "bodies: [{name: disc, notches: [], shape: {" ROUND "}, fill: {" GRID "}}]", "3:23", "did you mean 'cracks'?"},
    {3, BODY(ROUND, "noisy_grid: {cell_size: 2.5 mm}"), "3:105", "did you mean 'spacing'?"},
    {3, BODY(ROUND, "noisy_grid: 2.5 mm"), "3:104", "as in noisy_grid: {elements: 1000}"},
    {3, BODY("box: {size: 10 mm}", GRID), "3:43", "expected a list of 3 quantities in m > 0 such as [1 m, 1 m, 1 m]"},
    {3, "bodies: {disc: {shape: {" ROUND "}}}", "3:9", "begin each with '- name: ...'"},
    {3, "body: [{name: disc}]", "3:1", "did you mean 'bodies'?"},
    {4, "platens: {axis: y, velocity: 0.2 m/s}", "4:20", "did you mean 'speed'?"},
    {4, "platens: {axis: y, speed: 0.2 m/s, mu: 0.3}", "4:36", "did you mean 'friction'?"},
    {4, "contact: {friction: 0.3}", "4:1", "as in interactions: {contact: ...}"},
    {4, "gravity: -9.81 m/s^2", "4:10", "such as [0, 0, -9.81 m/s^2]"},
    {4, "model: DLSM", "4:8", "did you mean 'dlsm'?"},
    {4, "loads: [{pressure: {set: z+, value: 1 MPa}}]", "4:1", "as in stages: [{loads: ...}]"},
    {4, "sensors: {f: {force: {set: z+}}}", "4:15", "did you mean 'reaction'?"},
    {4, "sensors: [{f: {energy: kinetic}}]", "4:10",
     "write a name for each in place of '-', as in sensors: {probe: ...}"},
    {4, "sensors: {f: {reaction: {set: y+, component: y}}}", "4:31",
     "there is no wall, body or set 'y+'; did you mean 'z+'?; known: z-, z+, side"},
    {4, "sets: {a: {box: {from: [0, 0, 0], to: [1 mm, 1 mm, 1 mm]}}}", "4:12", "as in elements: {box: ...}"},
    {6, "stages: [{name: press, solver: {duration: 1.2 ms}}]", "6:33", "as in dynamic: {duration: ...}"},
    {6, "stages: [{name: press, solver: {explicit: {duration: 1.2 ms}}}]", "6:33", "did you mean 'dynamic'?"},
    {6, "stages: [{name: press, solver: {dynamic: {duration: 1.2 ms}}, loads: [{clamp: {set: z-}}]}]", "6:72",
     "did you mean 'face_displacement'?"},
    {6, "stages: [{name: press, solver: {dynamic: {time: 1.2 ms}}}]", "6:43", "did you mean 'duration'?"},
    {6, "stages: [{name: press, solver: {dynamic: {duration: 1.2 sec}}}]", "6:53", "did you mean '1.2 s'?"},
    {6, "stages: [{name: press, solver: {dynamic: {duration: 0.0012}}}]", "6:53",
     "has no unit; expected a quantity in s > 0 such as 1 ms"},
    {6, "stages: {press: {solver: static}}", "6:9", "begin each with '- name: ...'"},
    {6,
     "stages: [{name: press, solver: {dynamic: {duration: 1 ms, stop_after_peak: {sensor: platens_force, below: "
     "60}}}}]",
     "6:107", "did you mean '60 %'?"},
    {6, "stages: [{name: press, solver: {dynamic: {duration: 1 ms}}, loads: [{pressure: 1 MPa}]}]", "6:80",
     "as in pressure: {set: x+, value: 1 MPa}"},
    {2, MATERIAL("E:50 GPa, nu: 0.25, density: 2650 kg/m^3"), "2:20", "a blank belongs behind the colon"},
    {4, "platens: {axis: y, speed: 0,2 m/s}", "4:29", "decimals have a point"},
    {4, "sensors: {f: {energy: *kinetic}}", "4:23", "stands in quotes"},
    {7, "measure: {s: {peak: {of: platens_force, area: z+, target: 8 N}}}", "7:59",
     "expected a quantity in Pa such as 1 Pa"},
    {7, "\toutput: {frames: none}", "7:1", "indent with blanks, not with tabs"},
    {7, "output frames", "8:1", "write `key: value`, with a blank behind the colon"},
    {7, "output: {frame_every: 10}", "7:10", "did you mean 'frame_interval'?"},
    {7, "output: {frames: none", "8:1", "close every { with }"},
};

static void every_mistake_has_a_place_and_a_cure(void **state)
{
    (void)state;
    char text[2048];
    for (size_t k = 0; k < sizeof MISTAKE / sizeof *MISTAKE; ++k) {
        write_scene(MISTAKE[k].line, MISTAKE[k].mistake, text, sizeof text);
        bad_scene(text, MISTAKE[k].place, MISTAKE[k].cure);
    }
}

static void a_comma_is_no_decimal_point(void **state)
{
    (void)state;
    char hint[BRC_HINT];
    assert_string_equal(brc_hint_quantity("0,2 m/s", "m/s", hint), "; decimals have a point, not a comma");
    assert_string_equal(brc_hint_quantity("2 parsec", "m", hint), "");
    assert_string_equal(brc_hint_quantity("2 MPA", "m", hint), "");
}

static void reactions_without_prescribed_motion_are_warned_of(void **state)
{
    (void)state;
    char text[2048];
    write_scene(7, "sensors: {f: {reaction: {set: z+, component: z}}}", text, sizeof text);
    warned_scene(
        text, "7:31",
        "stays 0, as no stage prescribes the motion of a set; forces of strikers and platens are sensors `striker`");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scene_without_mistakes_is_good),
        cmocka_unit_test(every_mistake_has_a_place_and_a_cure),
        cmocka_unit_test(a_comma_is_no_decimal_point),
        cmocka_unit_test(reactions_without_prescribed_motion_are_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
