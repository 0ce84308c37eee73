/* The finest level on the host: elements with displacements and rotations, joined by bonds. Of beams it is their own
 * linear stiffness; of cells a stand-in that has the elasticity of the material and couples neighbours alone
 * (docs/notebook/theory.md T6). */
#ifndef BRC_SOLVER_MULTIGRID_FINE_H
#define BRC_SOLVER_MULTIGRID_FINE_H

#include "../../core/solver.h"
#include "rows.h"

/* Of a material: stiffness of its bonds over S/L along and across them, and of the frames of their ends over L^2
 * [Pa]. */
typedef struct brc_bond_moduli {
    double axial, shear, frame;
} brc_bond_moduli;
brc_bond_moduli brc_bond_moduli_of(const brc_elastic *elastic);

typedef double brc_block[36]; /* of two elements, by rows */

typedef struct brc_fine {
    const brc_simulation *s;
    brc_bond_moduli *moduli; /* [n_materials] */
    double *volume_modulus;  /* [n_materials] what coarser levels add to lambda, that springs cannot have [Pa] */
    bool volumes;            /* some do */
    bool stiff_volume;       /* that of some material is, nearly incompressible */
    int coarse_unknowns;     /* of a node of coarser levels: seven where the volume of some material is soft */
    uint8_t *whole;          /* [n_half_edges] 0: broken; NULL: none is */
    double *area; /* [n_bonds] of faces, where ranks have the domain between them [m^2]; NULL: the domain has all */
    double soft;  /* what the diagonal is raised by, so that rigid motions of pieces meet something [-] */
    int32_t n_ground;
    int32_t *ground_element;  /* [n_ground] ascending */
    brc_block *ground;        /* [n_ground] stiffness of held faces */
    double (*ground_area)[3]; /* [n_ground] their area vectors, in the components that are held [m^2] */
    brc_nodes nodes;
    brc_rows rows;
    double *spacing; /* [bodies] mean distance of neighbours [m] */
} brc_fine;

/* All ranks. Of the loads of the stage and the bonds as they were at a moment (brc_fracture_moment). Free it after a
 * failure too. */
brc_status brc_fine_create(brc_simulation *s, int64_t moment, brc_fine *out);
void brc_fine_free(brc_fine *fine);
/* Place of an element among those with held faces, -1: it has none. */
int32_t brc_fine_ground(const brc_fine *fine, int64_t element);
/* Area of the face of a half-edge [m^2]. */
double brc_fine_area(const brc_fine *fine, int64_t half_edge);
/* Add to the matrix of the first aggregates what their motions do to the volumes of cells. */
brc_status brc_fine_add_volumes(const brc_fine *fine, const int32_t *aggregate, const brc_nodes *coarse,
                                const brc_prolongation *p, brc_stored_rows *rows);

#endif
