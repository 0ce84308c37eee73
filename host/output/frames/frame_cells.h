/* What a frame's cells are: points, polyhedra and what never changes about the elements. Written where it is new; other
 * frames refer to the frame that has it. */
#ifndef BRC_OUTPUT_FRAME_CELLS_H
#define BRC_OUTPUT_FRAME_CELLS_H

#include "../../../preprocess/cells/tessellation.h"
#include "../../solver/run/assembly.h"
#include "../../solver/core/state_store.h"
#include "../h5.h"

/* Where the rows of one part stand among those of all. */
typedef struct brc_frame_rows {
    int64_t first, n, all;
} brc_frame_rows;

typedef struct brc_frame_cells {
    brc_context *context; /* borrowed, as is the assembly */
    const brc_assembly *assembly;
    int n_threads;
    brc_tessellation *part; /* [assembly->n]; of a part of spheres, and on ranks that write no files: nothing */
    bool joined;            /* the parts have points */
    int64_t elements_frame; /* number of the frame that has what never changes; -1: none yet */
    int64_t points_frame;   /* number of the frame whose points are those of now */
    int64_t starts_frame;   /* number of the frame that has where the points and faces of each cell begin, where this
                               depends on the domains alone; -1 */
    int64_t n_broken;       /* bonds of cells that were broken when points_frame was written */
} brc_frame_cells;

/* n_threads 0: as OpenMP decides. The outlines of all cells are found here, by the rank that writes. BRC_NO_MEMORY. */
brc_status brc_frame_cells_create(brc_context *context, const brc_assembly *assembly, int n_threads,
                                  brc_frame_cells *out);
void brc_frame_cells_free(brc_frame_cells *cells);
/* Which frames have what later ones refer to, for a checkpoint. */
brc_status brc_frame_cells_store(brc_frame_cells *cells, brc_state_store *store);

bool brc_frame_is_sphere(const brc_domain *domain);
bool brc_frame_has_spheres(const brc_assembly *assembly);
bool brc_frame_has_cells(const brc_assembly *assembly);
/* Rows of a part's elements; and of its points, once they are numbered. */
brc_frame_rows brc_frame_element_rows(const brc_frame_cells *cells, int32_t part);
brc_frame_rows brc_frame_point_rows(const brc_frame_cells *cells, int32_t part);

/* Number the points where they are not what they were, and write them with the polyhedra into frame `number`, or links
 * to the frame that has them. */
brc_status brc_frame_cells_write(brc_frame_cells *cells, brc_h5 *h5, int64_t number);

#endif
