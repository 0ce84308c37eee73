/* Model dlsm-published, shared by its files. */
#ifndef BRC_SOLVER_MODELS_PUBLISHED_PUBLISHED_H
#define BRC_SOLVER_MODELS_PUBLISHED_PUBLISHED_H

#include "../../effects/fracture/breaking.h"

/* What a run of it keeps. */
typedef struct brc_published_own {
    brc_pass *strain, *force, *energy, *traction;
    brc_pass *force_listed, *energy_listed; /* only with fracture */
    brc_pass *breaking_strain, *breaking_force, *breaking_strain_listed, *breaking_force_listed, *rebuild, *check;
} brc_published_own;
static inline brc_published_own *brc_published_own_of(const brc_simulation *s)
{
    return s->of_model;
}

/* ---- passes.c ---- */
brc_status brc_published_create(brc_simulation *s);
void brc_published_free(brc_simulation *s);
brc_status brc_published_make_passes(brc_simulation *s, const brc_scope *run, const brc_scope *request);
brc_status brc_published_make_face_passes(brc_simulation *s, const brc_face_scopes *in);

/* ---- force.c ---- */
brc_status brc_published_evaluate(brc_simulation *s, const brc_force_request *r);
/* Force and torque of tractions, added to those of the request. */
brc_status brc_published_tractions(brc_simulation *s, const brc_force_request *r);
brc_status brc_published_energies(brc_simulation *s, double *elastic, double *stabilisation);
/* Around breaks: as brc_model_breaking says. */
brc_status brc_published_replace_around(brc_simulation *s, const brc_rings *rings);
brc_status brc_published_energy_around(brc_simulation *s, const brc_rings *rings, bool found, double part[4]);

/* ---- statics.c ---- */
/* Torques of the displacements just found. */
brc_status brc_published_torques(brc_simulation *s, const brc_settle_room *room);

/* ---- breaks.c: as brc_model_breaking says ---- */
brc_status brc_published_breaks_create(brc_simulation *s);
/* Strains of either law, by least squares over the bonds that are left. */
brc_status brc_published_breaks_strains(brc_simulation *s, const brc_force_request *r);
/* Forces of the full law, with what marks and ratios need. */
brc_status brc_published_breaks_force(brc_simulation *s, const brc_force_request *r);
brc_status brc_published_mark(brc_simulation *s, double share);
brc_status brc_published_rebuild(brc_simulation *s);
brc_status brc_published_ratio(brc_simulation *s, double *out);
brc_status brc_published_branches(brc_simulation *s, brc_buffer **out);

/* ---- geometry.c ---- */
brc_status brc_published_upload(brc_simulation *s);

/* ---- observe.c: what is read of a state ---- */
brc_status brc_published_strain_stress(brc_simulation *s, double *strain, double *stress, double *cauchy);
/* A face moves rigidly with its element. */
brc_status brc_published_face_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out);
int brc_published_step_passes(const brc_simulation *s, brc_step_pass out[BRC_STEP_PASSES]);

#endif
