/* histories.csv: rows are added while the run goes on, so that a killed run leaves what its sensors read. */
#ifndef BRC_OUTPUT_HISTORY_CSV_H
#define BRC_OUTPUT_HISTORY_CSV_H

#include "history.h"

typedef struct brc_history_csv brc_history_csv;

/* Begin the file with its head line "stage,step,stage_time,time_s,<name> [<unit>],..."; names and units are the scene's
 * sensors. Caller frees. BRC_FILE_FAILED, BRC_NO_MEMORY. */
brc_status brc_history_csv_create(brc_context *context, const brc_scene *scene, const char *path,
                                  brc_history_csv **out);
/* Add the samples that are not in the file yet, 17 significant digits, empty where NAN: at once while that costs less
 * than a hundredth of the time, else every second. BRC_FILE_FAILED, BRC_NO_MEMORY leave whole rows, and may be tried
 * again. */
brc_status brc_history_csv_add(brc_context *context, brc_history_csv *csv, const brc_history *history);
/* Add all that is missing and see it to the disk. */
brc_status brc_history_csv_finish(brc_context *context, brc_history_csv *csv, const brc_history *history);
/* Accepts NULL and a pointer to NULL. */
void brc_history_csv_free(brc_history_csv **csv);

#endif
