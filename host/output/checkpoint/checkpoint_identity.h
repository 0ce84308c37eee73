/* What a run must share with a checkpoint to go on from it: the scene, its domains, the precision; and what it is told
 * where it does not share it: program and device. */
#ifndef BRC_OUTPUT_CHECKPOINT_IDENTITY_H
#define BRC_OUTPUT_CHECKPOINT_IDENTITY_H

#include "../../solver/run/assembly.h"
#include "../h5.h"
#include "../h5_read.h"

#define BRC_CHECKPOINT_FORMAT_VERSION 7

/* The scene as it was read, without what it says about checkpoints: YAML, freed by brc_memory_free. */
brc_status brc_checkpoint_scene(brc_context *context, const brc_scene *scene, char **yaml);

/* Group `identity` of a checkpoint: format, program, scene, device, precision, exact; of every part its model,
 * elements, bonds, and CRC-32 of what its domain is made of. scene: of brc_checkpoint_scene; sums: of
 * brc_checkpoint_sums. */
void brc_checkpoint_identity_write(brc_h5 *h5, const brc_assembly *assembly, const char *scene, const int64_t *sums);
/* All ranks, where they have just built a domain between them (domain.h, here): the sum over its area vectors. */
brc_status brc_checkpoint_sum_areas(brc_context *context, brc_domain *domain);
/* CRC-32 of the domain of every part: positions, volumes, bodies, regions, radii, neighbours, faces, sets. sums
 * [assembly->n]. */
void brc_checkpoint_sums(const brc_assembly *assembly, int64_t *sums);

/* BRC_BAD_INPUT where the file is of another format, or its scene another than `scene`, with the first key that
 * differs. Another program is a warning. */
brc_status brc_checkpoint_same_scene(brc_context *context, const brc_h5_read *h5, const char *scene);
/* BRC_BAD_INPUT where models, domains or the precision differ, with what there is and what is expected. Another device
 * is a warning: from here on the numbers are those of the new one. */
brc_status brc_checkpoint_same_run(brc_context *context, const brc_h5_read *h5, const brc_assembly *assembly,
                                   const int64_t *sums);

#endif
