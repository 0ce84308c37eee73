/* What broke, for files: the stream of broken bonds in result.h5 and cracks.csv, damage and fragments in frames. */
#ifndef BRC_OUTPUT_CRACKS_H
#define BRC_OUTPUT_CRACKS_H

#include "../../solver/run/assembly.h"
#include "../../solver/effects/fracture/fracture.h"
#include "../append.h"

typedef struct brc_h5 brc_h5; /* h5.h */

/* What broke so far; ids of elements and bonds are those of the whole (assembly.h). */
typedef struct brc_cracks {
    int64_t n_broken;
    const brc_break *breaks; /* [n_broken] by step, then bond; borrowed from the simulation, or `own` */
    brc_break *own;          /* of several parts, put together; owned */
    int64_t n_fragments;
} brc_cracks;

/* Of a scene with fracture. What *out held is freed. */
brc_status brc_cracks_take(brc_context *context, const brc_assembly *assembly, brc_cracks *out);
void brc_cracks_free(brc_cracks *cracks);
/* Number of the fragment of every element of the whole, part after part; [elements of all parts]. */
brc_status brc_cracks_fragments(const brc_assembly *assembly, int32_t *fragment, int64_t *n_fragments);
/* Group `cracks` of an open file: one dataset a column, one row a broken bond; attribute fragments. */
brc_status brc_cracks_write_h5(brc_context *context, brc_h5 *h5, const brc_cracks *cracks);
/* cracks.csv: its head line, static storage; and the rows that it has not yet, *n_written being those it has: later
 * breaks come after all earlier ones, so that the file only grows. */
const char *brc_cracks_csv_head(void);
brc_status brc_cracks_csv_add(brc_context *context, brc_append *file, const brc_cracks *cracks, int64_t *n_written);
/* CellData damage [-] and fragment, FieldData n_fragments and n_broken of a frame. */
brc_status brc_cracks_write_frame(brc_context *context, brc_h5 *h5, const brc_assembly *assembly, int n_threads);

#endif
