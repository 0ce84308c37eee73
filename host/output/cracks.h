/* What broke, for files: the stream of broken bonds in result.h5 and cracks.csv, damage and fragments in frames. */
#ifndef BRC_OUTPUT_CRACKS_H
#define BRC_OUTPUT_CRACKS_H

#include "../solver/fracture.h"
#include "h5.h"
#include "text.h"

/* What broke so far; breaks are borrowed from the simulation. */
typedef struct brc_cracks {
    int64_t n_broken;
    const brc_break *breaks; /* [n_broken] by step, then bond */
    int64_t n_fragments;
} brc_cracks;

/* Of a simulation with fracture. */
brc_status brc_cracks_take(brc_context *context, brc_simulation *simulation, brc_cracks *out);
/* Group `cracks` of an open file: one dataset a column, one row a broken bond; attribute fragments. */
brc_status brc_cracks_write_h5(brc_context *context, brc_h5 *h5, const brc_cracks *cracks);
/* The same rows as text. */
brc_status brc_cracks_write_csv(brc_context *context, const brc_cracks *cracks, const char *path);
/* CellData damage [-] and fragment, FieldData n_fragments and n_broken of a frame. */
brc_status brc_cracks_write_frame(brc_context *context, brc_h5 *h5, brc_simulation *simulation);
/* Object `fracture` of summary.json: fragments, when the first and the last bond broke, how many by mode. */
void brc_cracks_add(brc_json *json, const brc_cracks *cracks);

#endif
