/* DIR/price.json: what `breccia check SCENE -o DIR` told of a run, kept so that `breccia run SCENE -o DIR` can say how
 * far off it was. */
#ifndef BRC_COMMANDS_PRICE_FILE_H
#define BRC_COMMANDS_PRICE_FILE_H

#include "../../device/device.h"
#include "../../output/prediction.h"

/* What a price is of: it says nothing of another scene, device, precision or number of threads. Borrowed. */
typedef struct brc_price_of {
    const char *scene;  /* brc_checkpoint_scene of the scene as it was read */
    const char *device; /* selector of what is used, "cpu" */
    brc_precision precision;
    int n_threads; /* as asked for; 0: all */
} brc_price_of;

/* Into a folder that is there. BRC_FILE_FAILED. */
brc_status brc_price_file_write(brc_context *context, const char *folder, const brc_price_of *of,
                                const brc_prediction_told *told);
/* told->known false: there is none, or it is of something else or no price at all, which a line of the log says. */
brc_status brc_price_file_read(brc_context *context, const char *folder, const brc_price_of *of,
                               brc_prediction_told *told);
/* A line of the log: told, taken, how far off; of a run that is over. total_s: by the clock; device_bytes: on its
 * devices. */
void brc_price_file_compare(brc_context *context, const char *folder, const brc_prediction_told *told, double total_s,
                            int64_t device_bytes);

#endif
