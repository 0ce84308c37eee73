/* The whole of a scene for those who look at it or act between its bodies: the simulations of all its parts, which
 * stand at the same moment (lockstep.h). What has one value for all (scene, stage, step, times) is that of the first
 * part. Elements and bonds of the whole are numbered part after part. Contact between bodies of different models will
 * find positions, velocities and forces of all parts here. */
#ifndef BRC_SOLVER_ASSEMBLY_H
#define BRC_SOLVER_ASSEMBLY_H

#include "../core/phases.h"
#include "split.h"

typedef struct brc_assembly {
    const brc_scene *scene;            /* the whole */
    const brc_split *split;            /* NULL where there is one part */
    int32_t n;                         /* parts */
    brc_simulation *const *part;       /* [n] */
    double peak_elastic, peak_kinetic; /* several parts: of their sums, whenever the ledger was asked for [J] */
} brc_assembly;

/* All borrowed. split: NULL, or with n parts. */
brc_assembly brc_assembly_make(const brc_scene *scene, const brc_split *split, int32_t n, brc_simulation *const *part);
/* The model of a part, with a number where another has one of the kind. */
const char *brc_assembly_part_name(const brc_assembly *assembly, int32_t part);
/* "dlsm, cbm": the models of all parts, cut where `room` ends. Returns words. */
const char *brc_assembly_models(const brc_assembly *assembly, char *words, size_t room);
/* Ids of a part's first element and bond in the whole; part n: their numbers in all. */
int64_t brc_assembly_first_element(const brc_assembly *assembly, int32_t part);
int64_t brc_assembly_first_bond(const brc_assembly *assembly, int32_t part);
/* Index in the whole scene of the body of a part's element. */
int32_t brc_assembly_body(const brc_assembly *assembly, int32_t part, int64_t element);
/* Terms summed over the parts; closure and peaks are of the sums. A pass over the elements of each. */
brc_status brc_assembly_ledger(brc_assembly *assembly, brc_ledger *out);
/* The step that all take; critical and published: the smallest of the parts. */
brc_time_step brc_assembly_time_step(const brc_assembly *assembly);
/* Mode `index` of the last modes stage, bodies of all parts counted together, ascending [rad/s]; NAN: not computed. */
double brc_assembly_mode(const brc_assembly *assembly, int32_t index);
/* Wall seconds in a phase of the steps, of all parts. */
double brc_assembly_phase_seconds(const brc_assembly *assembly, brc_step_phase phase);
/* Share of the elements' steps, of this run of the program, that were left out at rest (core/awake.h) [-]. */
double brc_assembly_at_rest(const brc_assembly *assembly);
/* Wall seconds of setting up all parts. */
double brc_assembly_setup_seconds(const brc_assembly *assembly);
/* Device bytes of all parts. */
int64_t brc_assembly_device_bytes(const brc_assembly *assembly);

#endif
