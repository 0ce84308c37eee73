/* A checkpoint's file as a store of the state (state_store.h): datasets /parts/K/<name> of the simulation of part K,
 * /run/<name> of the run as a whole. */
#ifndef BRC_OUTPUT_CHECKPOINT_STORE_H
#define BRC_OUTPUT_CHECKPOINT_STORE_H

#include "../../solver/core/state_store.h"
#include "../h5.h"
#include "../h5_read.h"

/* Groups for n parts and the run; the store writes to *h5, borrowed. */
brc_state_store brc_checkpoint_store_write(brc_h5 *h5, int32_t n_parts);
/* The store reads from *h5, borrowed. */
brc_state_store brc_checkpoint_store_read(brc_h5_read *h5);

#endif
