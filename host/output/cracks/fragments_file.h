/* Fragments in files: fragments.csv with a row for each at every frame, and their state at the last frame in
 * result.h5. */
#ifndef BRC_OUTPUT_FRAGMENTS_FILE_H
#define BRC_OUTPUT_FRAGMENTS_FILE_H

#include "../../solver/run/assembly.h"
#include "../../solver/effects/fracture/fragments.h"
#include "../append.h"
#include "../h5.h"

/* Fragments of the whole now, numbered part after part as in frames. */
typedef struct brc_fragment_table {
    double time; /* of all stages [s] */
    int32_t stage;
    int64_t n;
    brc_fragment *row; /* [n]; owned */
    double *below;     /* [n] share of the mass in fragments that are not heavier [-]; owned */
    brc_fragment_sizes sizes;
} brc_fragment_table;

/* Of a scene with fracture. What *out held is freed. */
brc_status brc_fragment_table_take(brc_context *context, const brc_assembly *assembly, brc_fragment_table *out);
void brc_fragment_table_free(brc_fragment_table *table);
/* fragments.csv: its head line, static storage; a row for each fragment. frame: number of the frame. */
const char *brc_fragment_table_csv_head(void);
brc_status brc_fragment_table_csv_add(brc_context *context, brc_append *file, int64_t frame,
                                      const brc_fragment_table *table);
/* Group `fragments` of an open file: one dataset a column, one row a fragment; attribute time [s]. */
brc_status brc_fragment_table_write_h5(brc_context *context, brc_h5 *h5, const brc_fragment_table *table);

#endif
