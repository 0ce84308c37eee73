/* What broke, for files: the stream of broken bonds in result.h5 and cracks.csv, damage and fragments in frames. */
#ifndef BRC_OUTPUT_CRACKS_H
#define BRC_OUTPUT_CRACKS_H

#include "../solver/assembly.h"
#include "../solver/fracture.h"
#include "h5.h"
#include "text.h"

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
/* Group `cracks` of an open file: one dataset a column, one row a broken bond; attribute fragments. */
brc_status brc_cracks_write_h5(brc_context *context, brc_h5 *h5, const brc_cracks *cracks);
/* The same rows as text. */
brc_status brc_cracks_write_csv(brc_context *context, const brc_cracks *cracks, const char *path);
/* CellData damage [-] and fragment, FieldData n_fragments and n_broken of a frame. */
brc_status brc_cracks_write_frame(brc_context *context, brc_h5 *h5, const brc_assembly *assembly);
/* Object `fracture` of summary.json: fragments, when the first and the last bond broke, how many by mode. */
void brc_cracks_add(brc_json *json, const brc_cracks *cracks);

#endif
