/* VTU files: XML with the arrays appended as raw bytes behind 64-bit sizes, written block by block from wherever they
 * lie. */
#ifndef BRC_OUTPUT_VTU_H
#define BRC_OUTPUT_VTU_H

#include "../../base/status.h"
#include <stdint.h>

typedef enum brc_vtu_number { BRC_VTU_FLOAT32, BRC_VTU_FLOAT64, BRC_VTU_INT64, BRC_VTU_UINT8 } brc_vtu_number;

/* Element of the XML tree that an array stands in. */
typedef enum brc_vtu_place {
    BRC_VTU_FIELD_DATA,
    BRC_VTU_POINTS,
    BRC_VTU_CELLS,
    BRC_VTU_POINT_DATA,
    BRC_VTU_CELL_DATA,
    BRC_VTU_N_PLACES
} brc_vtu_place;

typedef struct brc_vtu_array {
    brc_vtu_place place;
    const char *name;
    brc_vtu_number number;
    int columns;
    int64_t rows;
    /* Put rows first .. first + n - 1 into block, as numbers of the kind above. */
    brc_status (*read)(const struct brc_vtu_array *array, int64_t first, int64_t n, void *block);
    const void *source; /* for `read`; borrowed */
    int skip;           /* for `read`: leading rows of the source left out */
} brc_vtu_array;

/* The `read` of rows that lie in memory, at `source`. */
brc_status brc_vtu_from_memory(const brc_vtu_array *array, int64_t first, int64_t n, void *block);

/* Arrays by ascending place. Written aside, fsynced, renamed. The first failure of a read, or BRC_FILE_FAILED. */
brc_status brc_vtu_write(brc_context *context, const char *path, int64_t n_points, int64_t n_cells, int n_arrays,
                         const brc_vtu_array *arrays);

#endif
