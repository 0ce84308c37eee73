/* Fracture of cells, shared by its files: bonds by their normal stress in dlsm and dlsm-published
 * (models/), elements by their own stress in both (cell_criteria.c). */
#ifndef BRC_SOLVER_CELL_BREAKS_INTERNAL_H
#define BRC_SOLVER_CELL_BREAKS_INTERNAL_H

#include "cell_breaks.h"
#include "fracture_internal.h"
#include "../../core/rings.h"

struct brc_cell_breaks {
    brc_pass *force, *force_listed, *check, *ratio, *break_pass, *rebuild, *share, *elastic, *bonds;
    brc_pass *rim_stress, *rim_inner_flux, *rim_flux, *rim_force; /* rims.cl */
    brc_rings *rings;                                             /* around the bonds that break */
    brc_buffer *limit, *twin, *alive, *mark, *measure;            /* [n_slots][C] */
    brc_buffer *modulus, *least, *support, *stiffest, *changed;   /* [n_rows] */
    brc_buffer *look;                                             /* [n_groups] */
    brc_buffer *weight, *found;                                   /* [n_rows] */
    struct brc_softening_faces *softening; /* faces that open against cohesion (cell_softening.c); NULL: none does */
    struct brc_closed_faces *closed; /* sides of broken faces that bear on each other (closed_faces.c); NULL: none do */
    bool by_element;                 /* criteria of elements: what follows, and the arrays of fracture.cl */
    brc_pass *record, *mark_chosen, *weigh; /* cell_criteria.cl */
    brc_buffer *branch;                     /* dlsm: [n_slots][3][C], owned */
    brc_pass *breaking_strain, *breaking_force, *breaking_strain_listed,
        *breaking_force_listed;       /* dlsm-published: published_breaks.cl */
    brc_buffer *spanned, *bond_ratio; /* [n_slices][6][C], [n_rows] */
};

/* Arrays of the cells' bonds, then of the rings around breaks, then what broken bonds keep. Three scopes, which must
 * stay where they are. */
typedef struct brc_cell_scopes {
    brc_scope breaks, rings, cells;
} brc_cell_scopes;
const brc_scope *brc_cell_scopes_make(const brc_simulation *s, const brc_scope *outer, brc_cell_scopes *room);

/* ---- cell_criteria.c: elements by their stress ---- */
brc_status brc_cell_criteria_create(brc_simulation *s);
/* Bonds that failing elements choose are marked; *n: elements that fail. */
brc_status brc_cell_criteria_mark(brc_simulation *s, double *n);
/* After bonds broke: who is whose neighbour. */
brc_status brc_cell_criteria_settle(brc_simulation *s);
brc_status brc_cell_criteria_ratio(brc_simulation *s, double *out);

#endif
