/* Checkpoints: the state of a run, written now and then so that another run can go on from it as if there had been no
 * end (docs/reference/checkpoint.md).
 *
 *     DIR/checkpoints/NNNNNN.h5   the two last ones, numbered from 000000; HDF5, written aside, sealed (seal.h),
 *                                 flushed to the disk, renamed
 *
 *   /identity      format_version, version, commit, scene (YAML), device, precision; model_K, domain_K: elements,
 *                  bonds, checksum
 *   /moment        stage, step, total_steps, time [s] of all stages
 *   /parts/K/...   the state of the simulation of part K (state_store.h), in the order of ids
 *   /run/...       samples so far, times of the frames, how far the files of fragments had come
 *
 * Written at the end of a batch of steps, an increment or an event: when the scene asks for it, at the end of stages of
 * scenes that ask, where a stage ends before its plan, and on a signal. Nothing of a run depends on whether or when
 * checkpoints are written. */
#ifndef BRC_OUTPUT_CHECKPOINT_H
#define BRC_OUTPUT_CHECKPOINT_H

#include "../recorder.h"

typedef struct brc_checkpoints brc_checkpoints;

/* The checkpoints of a run into `folder`. The scene is as it was read: nothing may have been derived into it. resume:
 * look for the newest one that is whole and read it from there; damaged ones are passed over with a warning. Else those
 * of an earlier run are removed. BRC_BAD_INPUT: there is no whole one, or it is of another scene or format; nothing in
 * the folder is changed then. scene and context are borrowed until free. */
brc_status brc_checkpoints_create(brc_context *context, const char *folder, const brc_scene *scene, bool resume,
                                  brc_checkpoints **out);
/* Accepts NULL and a pointer to NULL. */
void brc_checkpoints_free(brc_checkpoints **checkpoints);

/* Both borrowed until free. A new run: the recorder observes the assembly, and these do after it. A resumed one: parts
 * and recorder are brought to the moment of the checkpoint first; BRC_BAD_INPUT where domain or precision are
 * others. */
brc_status brc_checkpoints_observe(brc_checkpoints *checkpoints, brc_assembly *assembly, brc_recorder *recorder);
/* brc_lockstep_run or brc_lockstep_continue. What ends the run early names the last checkpoint too. */
brc_status brc_checkpoints_run(brc_checkpoints *checkpoints);

/* Strings are borrowed until free. */
brc_checkpoint_report brc_checkpoints_report(const brc_checkpoints *checkpoints);

#endif
