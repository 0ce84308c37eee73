/* Storage order of elements on a device: along a Hilbert curve, then by degree inside small windows, in slices of C
 * rows whose neighbour lists are padded to the longest of the slice (SELL-C). Element ids never change; files and
 * results use ids, device arrays use rows. */
#ifndef BRC_SOLVER_LAYOUT_H
#define BRC_SOLVER_LAYOUT_H

#include "../../../preprocess/domain/domain.h"
#include <stdint.h>

typedef struct brc_layout {
    int32_t slice; /* C: rows of a slice */
    int32_t n_slices;
    int32_t n_rows;          /* n_slices * C; rows without an element are last and padded */
    int64_t n_slots;         /* sum over slices of the longest row; entries are [n_slots][C] */
    int32_t *row_of_element; /* [n_elements] */
    int32_t *element_of_row; /* [n_rows], -1: padding */
    int32_t *slot_start;     /* [n_slices + 1] */
    int32_t *half_edge;      /* [n_slots][C] half-edge of the domain stored there, -1: padding */
    int32_t *ahead;          /* [n_rows] see brc_layout_ahead */
    int32_t *boundary;       /* [n_slices] number of the boundary block, -1: no element of the slice has a free face */
    int32_t n_boundary;
} brc_layout;

/* BRC_BAD_INPUT when the domain needs more than 2^31 entries (with the size), BRC_NO_MEMORY. */
brc_status brc_layout_create(brc_context *context, const brc_domain *domain, int32_t slice, brc_layout **out);
/* Every slice gets a boundary block, in order. */
void brc_layout_all_boundary(brc_layout *layout);
/* Which rows the groups of a CPU ask for ahead (kernels/core/vec.h), one for each row of the group that asks: those
 * that a group some BRC_AHEAD_LEAD rows further on gathers, while none of the BRC_AHEAD_ROWS before it gathers or goes
 * over them; the row itself where there is none. As many rows as stay in a second-level cache of 1 MB while their lists
 * of neighbours pass through it. */
enum { BRC_AHEAD_ROWS = 512, BRC_AHEAD_LEAD = 32 };
brc_status brc_layout_ahead(brc_context *context, const brc_domain *domain, brc_layout *layout);
void brc_layout_free(brc_layout **layout);
/* Where the other half-edge of every stored bond is stored, twin [n_slots * C]; 0 for padding. */
brc_status brc_layout_twins(brc_context *context, const brc_layout *layout, const brc_domain *domain, int32_t *twin);

#endif
