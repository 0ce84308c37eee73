/* DIR/result.h5: the index of a run. */
#ifndef BRC_OUTPUT_RESULT_FILE_H
#define BRC_OUTPUT_RESULT_FILE_H

#include "../solver/run/assembly.h"
#include "cracks/crack_records.h"
#include "sensors/history.h"
#include "sensors/measures.h"

#define BRC_RESULT_FORMAT_VERSION 1

/* What goes into it; all borrowed for the call. */
typedef struct brc_result {
    const brc_scene *scene;
    int32_t n_domains;                /* 0: left out */
    const brc_domain *const *domains; /* [n_domains] of the parts */
    const brc_assembly *assembly;     /* NULL: left out */
    const brc_ledger *ledger;         /* NULL: left out */
    const brc_crack_state *cracks;    /* NULL: left out */
    const brc_history *history;       /* NULL: left out */
    int32_t n_measures;
    const brc_measured *measures; /* [n_measures] */
    int64_t n_frames;
    const double *frame_time; /* [n_frames] [s] */
} brc_result;

/*   /              attributes format_version, version, commit, compiler, model (all, in the order of CellData/model of
 *                  frames), title
 *   /scene         the resolved scene with all defaults, YAML
 *   /histories     stage, step, stage_time, time; sensors/<name> with attributes unit, last, min, max
 *   /measures      <name> with attributes unit, target, error
 *   /ledger        <term> [J]; closure [-]
 *   /cracks        time, step, stage, mode, bond, element_i, element_j, position, normal, stress, energy, area, load of
 *                  every broken bond; attribute fragments; only of scenes with fracture
 *   /fragments     first_element, elements, mass, centre, velocity, spin, inertia, translation, rotation, internal,
 *                  share_below of every fragment at the last frame or the end (fragments.h); attribute time; likewise
 *   /frames        NNNNNN: external links to frames/NNNNNN.vtkhdf; time
 *   /provenance    attributes domain (of every part, between bars), device, driver, precision
 * Made in memory, written aside, renamed. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_result_write(brc_context *context, const brc_result *result, const char *path);

#endif
