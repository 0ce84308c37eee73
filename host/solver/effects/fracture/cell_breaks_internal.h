/* Fracture of cells, shared by its files: bonds by their normal stress in dlsm and dlsm-published
 * (models/), elements by their own stress in both (cell_criteria.c). */
#ifndef BRC_SOLVER_CELL_BREAKS_INTERNAL_H
#define BRC_SOLVER_CELL_BREAKS_INTERNAL_H

#include "fracture_internal.h"

struct brc_cell_breaks {
    brc_pass *break_pass, *share;
    brc_rings *rings;                                           /* around the bonds that break */
    brc_buffer *limit, *twin, *alive, *mark, *measure;          /* [n_slots][C] */
    brc_buffer *delta;                                          /* measure, as scratch (rims.cl) */
    brc_buffer *n_marked;                                       /* [n_groups] found, as scratch of groups */
    brc_buffer *modulus, *least, *support, *stiffest, *changed; /* [n_rows] */
    brc_buffer *look;                                           /* [n_groups] */
    brc_buffer *weight, *found;                                 /* [n_rows] */
    bool by_element;                        /* criteria of elements: what follows, and the arrays of fracture.cl */
    brc_pass *record, *mark_chosen, *weigh; /* cell_criteria.cl */
    brc_buffer *branch;                     /* dlsm: [n_slots][3][C], owned */
    brc_buffer *spanned, *bond_ratio;       /* [n_slices][6][C], [n_rows] */
};

extern const brc_field_table brc_cell_break_fields;

/* ---- cell_criteria.c: elements by their stress ---- */
brc_status brc_cell_criteria_create(brc_simulation *s);
/* Bonds that failing elements choose are marked; found: the elements that fail. */
brc_status brc_cell_criteria_mark(brc_simulation *s);
/* After bonds broke: who is whose neighbour. */
brc_status brc_cell_criteria_settle(brc_simulation *s);
brc_status brc_cell_criteria_ratio(brc_simulation *s, double *out);

#endif
