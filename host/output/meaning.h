/* Unit and meaning, one line, of what the HDF5 files of a run hold. h5.c writes them as the attributes `unit` and
 * `meaning` of each dataset that it makes. */
#ifndef BRC_OUTPUT_MEANING_H
#define BRC_OUTPUT_MEANING_H

#include "../scene/scene.h"

typedef struct brc_meaning {
    const char *pattern; /* of the path in the file, as fnmatch reads it; * stands for all but a slash */
    const char *unit;    /* SI; "-": a number without one, a text; "m, N" in the order that the meaning names them */
    const char *meaning;
} brc_meaning;

/* Of the dataset of this path; NULL where there is none: names of sensors and measures are the scene's. */
const brc_meaning *brc_meaning_of(const char *path);
/* Tables of the files; each ends with a pattern that is NULL. */
extern const brc_meaning brc_meanings_of_results[];     /* result.h5 */
extern const brc_meaning brc_meanings_of_frames[];      /* frames/NNNNNN.vtkhdf */
extern const brc_meaning brc_meanings_of_checkpoints[]; /* checkpoints/NNNNNN.h5 */

/* What a sensor reads, and what a measure is. */
const char *brc_meaning_of_sensor(brc_sensor_kind kind);
const char *brc_meaning_of_measure(brc_measure_kind kind);

#endif
