/* The sensors of a whole scene: each part reads its own (sensors.h), what several parts read is put together. */
#ifndef BRC_OUTPUT_ASSEMBLY_SENSORS_H
#define BRC_OUTPUT_ASSEMBLY_SENSORS_H

#include "../../solver/run/assembly.h"

typedef struct brc_assembly_sensors brc_assembly_sensors;

/* assembly is borrowed until free. Errors as of brc_sensors_create, of all parts in one pass. */
brc_status brc_assembly_sensors_create(brc_context *context, brc_assembly *assembly, brc_assembly_sensors **out);
/* Accepts NULL and a pointer to NULL. */
void brc_assembly_sensors_free(brc_assembly_sensors **sensors);
/* Read all now; value: [scene.n_sensors]. With several parts the ledger is read every time, so that its peaks are those
 * of the samples. */
brc_status brc_assembly_sensors_evaluate(brc_assembly_sensors *sensors, double *value);

#endif
