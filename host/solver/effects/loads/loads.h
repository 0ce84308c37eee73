/* Loads of the current stage: what models and solvers ask of them. */
#ifndef BRC_SOLVER_LOADS_H
#define BRC_SOLVER_LOADS_H

#include "../../core/solver.h"

typedef struct brc_loads brc_loads;

/* ---- a load as the scene has it ---- */
/* a(t), or its integral from 0 to t for velocity loads; rate: its derivative. */
double brc_load_factor(const brc_load *load, double t, bool is_static);
double brc_load_rate(const brc_load *load, double t);
/* Integral of a table from 0 to t [s]. */
double brc_table_integral(const brc_table *table, double t);
/* Whether it prescribes the motion of faces; whether it is a force on faces. */
bool brc_load_holds_faces(const brc_load *load);
bool brc_load_pulls_faces(const brc_load *load);

/* ---- what is prescribed ---- */
/* Put held faces and prescribed elements where they are at time t of the stage (static: load factor). */
brc_status brc_loads_prescribe(brc_simulation *s, double t);
typedef struct brc_prescribed {
    int32_t element, face; /* face: of the free ones; -1: the element as a whole */
    int motion, rotation;  /* components, bits 1 2 4 */
    bool by_load;          /* else an element without bonds that is held still (model.keep_isolated) */
} brc_prescribed;
typedef void (*brc_prescribed_call)(void *self, const brc_prescribed *one);
/* One call for each: moved elements, then held faces, then turned elements. */
void brc_loads_each_prescribed(const brc_simulation *s, brc_prescribed_call call, void *self);
/* rows [n_rows]: 1 for elements that loads of this stage set in motion, at any time of it; the others, those that are
 * held where they are among them, as they were. */
brc_status brc_loads_driven(brc_simulation *s, uint8_t *rows);

/* ---- faces, for models (face_loads.c) ---- */
/* Some face is held or bears a traction; how many are held. */
bool brc_loads_on_faces(const brc_simulation *s);
int32_t brc_loads_n_held_faces(const brc_simulation *s);
/* A pass over the elements of held faces, which asks for `value`, and for `reaction` too; nothing where none is
 * held. */
brc_status brc_held_faces_run(brc_simulation *s, const brc_pass *pass, const brc_force_request *r, bool reactions);
/* A pass over all elements that does the held faces of its own too. */
brc_scope brc_scope_of_held_faces(const brc_simulation *s, const brc_scope *outer);
/* A pass over the elements under each traction, for moments [N m] and, booked as the request says, for forces; both ask
 * for `factor`. */
brc_status brc_traction_moments_run(brc_simulation *s, const brc_pass *pass, const brc_force_request *r);
brc_status brc_traction_forces_run(brc_simulation *s, const brc_pass *pass, const brc_force_request *r);
/* Held components of the displacement of n faces, in their place; out [n][3]. */
brc_status brc_held_faces_displacement(brc_simulation *s, int64_t n, const int32_t *faces, double *out);

#endif
