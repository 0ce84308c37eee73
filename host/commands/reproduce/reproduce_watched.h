/* The sensors of a run's scene, for operators that look at every sample. */
#ifndef BRC_COMMANDS_REPRODUCE_WATCHED_H
#define BRC_COMMANDS_REPRODUCE_WATCHED_H

#include "../../output/sensors/sensors.h"

/* Zero before it is opened. */
typedef struct brc_watched {
    brc_sensors *sensors; /* owned; NULL: not open */
    double *value;        /* [n_sensors] as last read, in the order and units of the scene; owned */
} brc_watched;

/* Of the simulation's scene, which outlives them. BRC_BAD_INPUT as of brc_sensors_create. */
brc_status brc_watched_open(brc_context *context, brc_watched *watched, brc_simulation *simulation);
/* Read all of them now. */
brc_status brc_watched_read(brc_watched *watched, brc_simulation *simulation);
void brc_watched_close(brc_watched *watched);
/* Index of the scene's sensor of this name; n_sensors: there is none. */
int32_t brc_watched_find(const brc_scene *scene, const char *name);

#endif
