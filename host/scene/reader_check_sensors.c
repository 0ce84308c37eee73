/* Sensors and measures against the rest of the scene. */
#include "reader_internal.h"
#include "schema_internal.h"
#include <stdio.h>
#include <string.h>

/* Is there a crack of the name in a body, or a file that may hold one? */
static bool has_crack(const brc_scene *scene, const char *name)
{
    for (int b = 0; b < scene->n_bodies; ++b) {
        for (int c = 0; c < scene->bodies[b].n_cracks; ++c)
            if (strcmp(scene->bodies[b].cracks[c].name, name) == 0) return true;
        if (scene->bodies[b].domain_file[0]) return true;
    }
    return false;
}

/* An opening: what each of its forms needs. */
static void check_opening(brc_reader *reader, const brc_sensor *sensor)
{
    const bool directed = sensor->axis[0] != 0 || sensor->axis[1] != 0 || sensor->axis[2] != 0;
    const brc_mark to = brc_reader_place(reader, sensor->point2, NULL), start = {0, 1, 1};
    const bool ended = memcmp(&to, &start, sizeof to) != 0;
    if (sensor->of_sets && sensor->set2[0] == '\0')
        COMPLAIN(reader, sensor->set, sensor, "opening: has one side; expected the other one too, as in against: x-");
    if (sensor->of_sets && !directed)
        COMPLAIN(reader, sensor->set, sensor,
                 "opening: between two sets needs a direction, as in direction: [1, 0, 0]");
    if (!sensor->of_sets && sensor->set2[0])
        COMPLAIN(reader, sensor->set2, sensor, "against: is the other side of a set; give `set` too, or leave it out");
    if (sensor->of_points && !ended)
        COMPLAIN(reader, sensor->point, sensor,
                 "opening: a gauge has two ends; expected `to` beside `from`, as in to: [235 mm, 0, 0]");
    if (sensor->of_points && ended && memcmp(sensor->point, sensor->point2, sizeof sensor->point) == 0)
        COMPLAIN(reader, sensor->point2, sensor,
                 "to: is the same point as `from`; expected the other end of the gauge");
    if (!sensor->of_points && ended)
        COMPLAIN(reader, sensor->point2, sensor, "to: is the other end of a gauge; give `from` too, or leave it out");
    if (sensor->of_crack && !has_crack(reader->scene, sensor->set) && !brc_reader_is_broken(reader, "bodies"))
        COMPLAIN(reader, sensor->set, sensor,
                 "crack: '%s' is a wall, not a crack, and has one side; name a crack of a body, or two sets by `set` "
                 "and `against`",
                 sensor->set);
    if (!sensor->of_crack && (sensor->is_near || sensor->within > 0))
        COMPLAIN(reader, &sensor->within, sensor,
                 "opening: `at` and `within` choose faces of a crack; give `crack` too, or leave them out");
    if (sensor->of_crack && sensor->is_near != (sensor->within > 0))
        COMPLAIN(reader, sensor->is_near ? sensor->point : (const void *)&sensor->within, sensor,
                 "opening: `at` and `within` go together; expected both, as in at: [225 mm, 0, 0], within: 1 cm");
}

/* Forces of prescribed motion where no motion is prescribed. */
static void check_reactions(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    for (int k = 0; k < scene->n_stages; ++k)
        for (int l = 0; l < scene->stages[k].n_loads; ++l)
            if (brc_load_is_motion(&scene->stages[k].loads[l]) ||
                scene->stages[k].loads[l].kind == BRC_LOAD_ELEMENT_ROTATION)
                return;
    if (brc_reader_is_broken(reader, "stages")) return;
    for (int i = 0; i < scene->n_sensors; ++i)
        if (scene->sensors[i].kind == BRC_SENSOR_REACTION || scene->sensors[i].kind == BRC_SENSOR_MOMENT)
            WARN(reader, scene->sensors[i].set, &scene->sensors[i],
                 "sensor %s: stays 0, as no stage prescribes the motion of a set; forces of strikers and platens are "
                 "sensors `striker`",
                 scene->sensors[i].name);
}

static void check_sign(brc_reader *reader, const brc_sensor *sensor)
{
    static const char *const SIGNED[] = {"force", "displacement", "velocity"};
    bool known = sensor->kind != BRC_SENSOR_STRIKER || sensor->sign == BRC_SIGN_AXIS;
    for (size_t k = 0; k < sizeof SIGNED / sizeof *SIGNED; ++k)
        known |= strcmp(sensor->term, SIGNED[k]) == 0;
    if (!known)
        COMPLAIN(reader, &sensor->sign, sensor,
                 "sign: %s of a striker is neither compression nor tension; leave `sign` out (it is for force, "
                 "displacement and velocity)",
                 sensor->term);
    if (sensor->kind == BRC_SENSOR_STRIKER && sensor->set2[0] && strcmp(sensor->set, sensor->set2) == 0)
        COMPLAIN(reader, sensor->set2, sensor, "against: is the same striker; expected another one");
}

static void check_readings(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    int32_t n_modes = 0;
    check_reactions(reader);
    for (int k = 0; k < scene->n_stages; ++k)
        if (scene->stages[k].solver == BRC_SOLVER_MODES) n_modes = scene->stages[k].n_modes;
    for (int i = 0; i < scene->n_sensors; ++i) {
        const brc_sensor *sensor = &scene->sensors[i];
        if (sensor->kind == BRC_SENSOR_OPENING) check_opening(reader, sensor);
        check_sign(reader, sensor);
        if (sensor->kind == BRC_SENSOR_MODE && sensor->index >= n_modes && !brc_reader_is_broken(reader, "stages"))
            COMPLAIN(reader, &sensor->index, sensor,
                     "mode: %d is not computed: the scene's last modes stage computes %d, "
                     "counted from 0",
                     (int)sensor->index, (int)n_modes);
    }
}

static const brc_sensor *sensor_named(const brc_scene *scene, const char *name)
{
    for (int i = 0; i < scene->n_sensors; ++i)
        if (strcmp(scene->sensors[i].name, name) == 0) return &scene->sensors[i];
    return NULL;
}

/* A sensor's unit must be one of the two ("" : only the first). */
static void check_unit(brc_reader *reader, const brc_measure *measure, const char *name, const char *unit,
                       const char *other, const char *why)
{
    const brc_sensor *sensor = sensor_named(reader->scene, name);
    if (!sensor || strcmp(brc_sensor_unit(sensor), unit) == 0 || strcmp(brc_sensor_unit(sensor), other) == 0) return;
    COMPLAIN(reader, name, measure, "the sensor '%s' gives values in %s; expected %s%s%s%s", name,
             brc_sensor_unit(sensor), unit, other[0] ? " or " : "", other, why);
}

static void check_measure(brc_reader *reader, const brc_measure *measure)
{
    const brc_scene *scene = reader->scene;
    switch (measure->kind) {
    case BRC_MEASURE_E:
    case BRC_MEASURE_K:
    case BRC_MEASURE_G:
        if (measure->area_set[0])
            check_unit(reader, measure, measure->y, "N", "", ": a reaction, as `area` divides it");
        else
            check_unit(reader, measure, measure->y, "Pa", "", ": a stress; a reaction needs `area`");
        check_unit(reader, measure, measure->x, "-", measure->kind == BRC_MEASURE_G ? "rad" : "", "");
        break;
    case BRC_MEASURE_NU:
        check_unit(reader, measure, measure->y, "-", "", "");
        check_unit(reader, measure, measure->x, "-", "", "");
        break;
    case BRC_MEASURE_FREQUENCY:
    case BRC_MEASURE_PEAK:
    case BRC_MEASURE_SLOPE:
    case BRC_MEASURE_RATE:
    case BRC_MEASURE_INTEGRAL:
    case BRC_MEASURE_DURATION:
    case BRC_MEASURE_AT_FIRST_BREAK:
    case BRC_MEASURE_MEAN: break;
    }
    if (measure->area_set[0] && !brc_reader_is_broken(reader, "bodies") &&
        brc_names_is_closed(scene, measure->area_set))
        COMPLAIN(reader, measure->area_set, measure,
                 "area: '%s' goes all the way round, so that no area of it stands across a load; expected faces of one "
                 "side, as `sets: {NAME: {faces: {wall: %s, normal: ...}}}`, or "
                 "`scale` with one over the area that is meant",
                 measure->area_set, measure->area_set);
    if (measure->window[1] <= measure->window[0] && (measure->window[0] != 0 || measure->window[1] != 0))
        COMPLAIN(reader, measure->window, measure, "window: ends before it begins; expected [from, to]");
    const char *const in_time = measure->kind == BRC_MEASURE_FREQUENCY  ? "frequency"
                                : measure->kind == BRC_MEASURE_RATE     ? "rate"
                                : measure->kind == BRC_MEASURE_INTEGRAL ? "integral"
                                : measure->kind == BRC_MEASURE_DURATION ? "duration"
                                                                        : NULL;
    if (!in_time || scene->n_stages == 0 || brc_reader_is_broken(reader, "stages")) return;
    const brc_stage *stage = &scene->stages[scene->n_stages - 1];
    for (int k = 0; k < scene->n_stages; ++k)
        if (measure->stage[0] && strcmp(scene->stages[k].name, measure->stage) == 0) stage = &scene->stages[k];
    if (stage->solver != BRC_SOLVER_DYNAMIC)
        COMPLAIN(reader, measure->stage, measure, "%s: the stage '%s' is not dynamic and has no history in time",
                 in_time, stage->name);
}

void brc_reader_check_sensors(brc_reader *reader)
{
    check_readings(reader);
    for (int i = 0; i < reader->scene->n_measures; ++i)
        check_measure(reader, &reader->scene->measures[i]);
}
