/* Model cbm, shared by its files. */
#ifndef BRC_SOLVER_MODELS_CBM_CBM_H
#define BRC_SOLVER_MODELS_CBM_CBM_H

#include "../../core/solver.h"

/* Beams of one material in one body (beams.c). */
typedef struct brc_beam {
    double radius;             /* of the beams [m] */
    double axial, bend, twist; /* E S [N], 2 E I [N m^2], G J [N m^2] */
} brc_beam;

/* What a run of it keeps. */
typedef struct brc_cbm_own {
    brc_beam *beam; /* [n_bodies][n_materials] */
    brc_pass *force, *energy, *virial;
    brc_pass *breaking_force, *break_pass; /* only with fracture */
    struct brc_beam_softening *softening;  /* beams that open against cohesion (beam_softening.c); NULL: none does */
    struct brc_beam_closure *closure;      /* broken beams that bear (beam_closure.c); NULL: none does */
    struct brc_beam_bridges *bridges;      /* brittle beams that bridge a crack (beam_bridges.c); NULL: none does */
    struct brc_beam_alone *alone;          /* beams of brittle interfaces (beam_alone.c); NULL: there are none */
} brc_cbm_own;
static inline brc_cbm_own *brc_cbm_own_of(const brc_simulation *s)
{
    return s->of_model;
}

/* ---- passes.c ---- */
brc_status brc_cbm_create(brc_simulation *s);
void brc_cbm_free(brc_simulation *s);
brc_status brc_cbm_renew(brc_simulation *s);
brc_status brc_cbm_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request);

/* ---- force.c ---- */
brc_status brc_cbm_evaluate(brc_simulation *s, const brc_force_request *r);
brc_status brc_cbm_energies(brc_simulation *s, double *elastic, double *stabilisation);

/* ---- statics.c ---- */
void brc_cbm_bond(const brc_simulation *s, int64_t e, int64_t other, double length, double square, double stiffness[4]);

/* ---- breaks.c ---- */
/* Limits of the virial stress of one material in one body. */
brc_status brc_cbm_limits(brc_simulation *s, const brc_limit_case *of, double limit[3]);
brc_status brc_cbm_create_fracture(brc_simulation *s);
/* Forces of the full law, with the records that breaks need. */
brc_status brc_cbm_breaking_force(brc_simulation *s, const brc_force_request *r);
brc_status brc_cbm_break_bonds(brc_simulation *s, double half_kick);

/* ---- cohesion.c ---- */
extern const brc_model_cohesion brc_cbm_cohesion;

/* ---- beams.c ---- */
/* Beams of every material in every body; isolated elements are refused or reported. */
brc_status brc_beams_create(brc_simulation *s);
/* Stiffness of every row, where there are several materials. */
brc_status brc_beams_upload(brc_simulation *s);
/* Stiffness of element e's own beams. */
const brc_beam *brc_beam_of_element(const brc_simulation *s, int64_t e);
/* Stress of every element [n_elements][6] xx yy zz yz xz xy [Pa], averaged over the element and its neighbours over
 * bonds, `level` shells of them (NAH19 section 2.2; 1 in the paper). */
brc_status brc_beams_stress(brc_simulation *s, int level, double *out);
/* Inverses of the 6 x 6 diagonal blocks, upper triangles [n_rows][21]; elements without bonds get zero. */
brc_status brc_beams_precondition_blocks(brc_simulation *s, double *out);
/* Rigorous lower bound of the critical time step [s]: 2 / sqrt(2 max lambda(M_i^-1 D_i)) over the elements' diagonal
 * blocks (docs/notebook/beams.md). */
brc_status brc_beams_node_bound(brc_simulation *s, double *out);

/* ---- geometry.c ---- */
brc_status brc_cbm_upload(brc_simulation *s);

/* ---- observe.c: what is read of a state ---- */
/* Virial stress over an element and its neighbours, and the strain it means. */
brc_status brc_cbm_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy);
int brc_cbm_step_passes(const brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES]);

#endif
