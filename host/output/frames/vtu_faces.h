/* Faces of polyhedra as VTU has them: for each cell the number of its faces, and for each of these the number of its
 * points and the points. */
#ifndef BRC_OUTPUT_VTU_FACES_H
#define BRC_OUTPUT_VTU_FACES_H

#include "../../../preprocess/cells/tessellation.h"
#include "../h5_read.h"
#include "vtu.h"

typedef struct brc_vtu_faces {
    int64_t n_cells, n;
    int64_t *stream; /* [n] */
    int64_t *end;    /* [n_cells] where each cell's part ends; -1: it has no faces */
} brc_vtu_faces;

/* Of a frame; none where it has no polyhedra. BRC_BAD_INPUT: damaged; BRC_NO_MEMORY. Caller frees. */
brc_status brc_vtu_faces_of_frame(const brc_h5_read *h5, brc_vtu_faces *out);
/* Of cells whose points are numbered. BRC_NO_MEMORY. Caller frees. */
brc_status brc_vtu_faces_of_cells(brc_context *context, const brc_tessellation *cells, brc_vtu_faces *out);
void brc_vtu_faces_free(brc_vtu_faces *faces);
/* The two arrays of a file; they borrow the faces. */
enum { BRC_VTU_FACE_ARRAYS = 2 };
void brc_vtu_faces_arrays(const brc_vtu_faces *faces, brc_vtu_array arrays[BRC_VTU_FACE_ARRAYS]);

#endif
