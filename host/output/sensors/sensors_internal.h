/* What the kinds of sensors share with what reads them all. */
#ifndef BRC_OUTPUT_SENSORS_INTERNAL_H
#define BRC_OUTPUT_SENSORS_INTERNAL_H

#include "crack_sensors.h"
#include "opening.h"
#include "sensor_patch.h"
#include "sensors.h"

/* Fields that are fetched once for all sensors before they are read; added up. */
typedef enum brc_sensor_field {
    BRC_NEEDS_DISPLACEMENT = 1,
    BRC_NEEDS_VELOCITY = 2,
    BRC_NEEDS_STRAIN = 4,
    BRC_NEEDS_STRESS = 8,
    BRC_NEEDS_ORIENTATION = 16,
    BRC_NEEDS_APPLIED = 32,
    BRC_NEEDS_LEDGER = 64
} brc_sensor_field;

struct brc_sensors {
    brc_context *context;
    const brc_scene *scene;
    const brc_domain *domain;
    int32_t n_patches;
    brc_sensor_patch *patches; /* [2 n_sensors] room, n_patches used */
    int32_t *first;            /* [n_sensors] patch, domain set, element, striker: its kind knows; -1: all, none */
    int32_t *second;           /* [n_sensors] patch of set2 */
    int32_t n_sensors;         /* of the scene, which may be gone when sensors are freed */
    brc_opening *opening;      /* [n_sensors] of openings */
    double *outward;  /* [n_sensors] sets and strikers whose `sign` is compression: +-1, the way out of the solid along
                         the component */
    double *distance; /* [n_sensors] face strain: reference distance along the component; spheres: R [m] */
    double *displacement, *velocity; /* [n_elements][3] or NULL */
    double *strain, *stress;         /* [n_elements][6] or NULL */
    double *orientation;             /* [n_elements][4] or NULL */
    double *applied;                 /* element forces [n_elements][3] or NULL */
    unsigned needs;                  /* brc_sensor_field of all sensors */
    brc_ledger ledger;               /* where needed */
    brc_crack_sensors *cracks;       /* NULL: no sensor watches cracks */
};

/* A kind of sensor. */
typedef struct brc_sensor_reader {
    unsigned needs; /* brc_sensor_field */
    /* Before the run: what sensor s names, looked up. NULL: nothing. BRC_BAD_INPUT with a sentence. */
    brc_status (*prepare)(brc_sensors *sensors, int32_t s);
    /* Sensor s now, in its unit, along its component. */
    brc_status (*read)(brc_sensors *sensors, brc_simulation *simulation, int32_t s, double *value);
    /* With `sign: compression`: is what pushes into the solid the negative of the value? outward: as of brc_sensors.
     * NULL: always. */
    bool (*reversed)(const brc_sensor *sensor, double outward);
} brc_sensor_reader;

/* The kind of a sensor; NULL: there is no such kind. */
const brc_sensor_reader *brc_sensor_reader_of(brc_sensor_kind kind);

#endif
