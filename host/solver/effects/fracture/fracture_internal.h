/* Fracture inside the solver. */
#ifndef BRC_SOLVER_FRACTURE_INTERNAL_H
#define BRC_SOLVER_FRACTURE_INTERNAL_H

#include "fracture.h"
#include "../../core/simulation_internal.h"

/* A stage, for the times of its steps. */
typedef struct brc_break_span {
    int64_t first_step;           /* brc_fracture_moment when it began */
    int64_t first_load;           /* n_loads when it began */
    double first_time, time_step; /* [s]; time_step 0: static */
    int32_t stage;
} brc_break_span;

/* Everything that exists only in scenes with fracture. */
struct brc_breaking {
    brc_pass *force, *stress_pass, *stress_second, *check, *choose, *ratio, *break_pass;
    brc_buffer *record, *stress, *limits, *choice, *measure;           /* fracture.cl */
    brc_buffer *break_step, *break_mode, *break_stress, *break_energy; /* [n_slots][C] */
    brc_buffer *lost, *broken;                                         /* [n_rows] */
    brc_buffer *gone; /* [n_rows] bonds that bear nothing any more; NULL: those that are broken */
    brc_buffer *stress_bound, *limit_margin, *weight, *mark; /* fracture.cl */
    brc_buffer *branch;                                      /* [n_slots][3][C] of its elements' bonds; borrowed */
    brc_buffer *factor, *weakest;                            /* only if weighted */
    bool weighted;                                           /* bonds differ in strength */
    double scale[3]; /* 1 / smallest limit of tension, compression, shear; 0: none [1/Pa] */
    double *limit;   /* [n_elements][3] host */
    double slope, friction;
    bool drucker_prager;
    struct brc_beam_softening
        *beam_softening;                   /* beams that open against cohesion (beam_softening.c); NULL: none does */
    struct brc_beam_closure *beam_closure; /* broken beams that bear (beam_closure.c); NULL: none does */
    struct brc_cell_breaks
        *cells; /* models of cells (cell_breaks.c), which use the arrays of entries and `lost`, `broken` */
    int n_spans;
    brc_break_span *spans;
    double implied_energy; /* cells: what a crack costs per area by strength and cells, mean of sigma_f^2 L / (2 E) over
                              bonds that break at once [J/m^2] */
    int64_t n_loads;       /* events of static stages so far */
    double *load;          /* [n_loads] their load factors [-] */
    int64_t n_events;
    brc_break *events; /* [n_events] as of the last call */
};

extern const brc_field_table brc_break_fields, brc_criterion_fields;
/* Broken beams may bear, or leave forces behind. */
bool brc_wants_lost_beams(const brc_wants *wants);
/* What bonds that broke keep; what criteria of elements have, their numbers too. */
brc_scope brc_scope_of_breaks(const brc_simulation *s, const brc_scope *outer);
brc_scope brc_scope_of_criterion(const brc_simulation *s, const brc_scope *outer);
/* Arrays, limits and kernels; refuses models and materials that cannot break. */
brc_status brc_fracture_create(brc_simulation *s);
void brc_fracture_free(brc_simulation *s);
/* Criteria of elements: limits, records and kernels, for beams and cells. branch: borrowed for as long as the
 * simulation lives. */
brc_status brc_fracture_create_elements(brc_simulation *s, brc_buffer *branch);
/* Twice the volume that an element's stress stands for, with its share of the voids [m^3]. */
double brc_fracture_volume(const brc_domain *domain, int64_t e);
/* Of records as they stand: the bond each element loses, choice and measure; and the largest ratio of failure. */
brc_status brc_fracture_choose(brc_simulation *s, int32_t moment);
brc_status brc_fracture_ratio(brc_simulation *s, double *out);
/* Strengths of bonds, and bounds of stress (fracture_bound.c); the limits of the elements are there. */
brc_status brc_fracture_bound(brc_simulation *s);
/* A stage begins. */
brc_status brc_fracture_begin_stage(brc_simulation *s);
/* Steps and static events so far: what orders breaks. */
int64_t brc_fracture_moment(const brc_simulation *s);
/* An event of a static stage at the present load factor: what brc_fracture_step breaks next belongs to it. */
brc_status brc_fracture_begin_event(brc_simulation *s);
/* After the forces of a step: break what fails. half_kick: as in fracture.cl. */
brc_status brc_fracture_step(brc_simulation *s, double half_kick);
/* Energy that left with broken bonds [J]. */
brc_status brc_fracture_lost(brc_simulation *s, double *out);
/* What broke, and what that changed. */
brc_status brc_fracture_store_state(brc_simulation *s, brc_state_store *store);
/* What breaking beams change from step to step, to a store of fields. */
brc_status brc_fracture_store_stretch(brc_simulation *s, brc_state_store *store);
/* Elements, ascending, of ascending half-edges; out->id is the caller's (brc_memory_free). */
brc_status brc_fracture_owners(brc_simulation *s, const brc_chosen *half_edges, brc_chosen *out);
/* Unbroken half-edges of the domain [n_half_edges] (1, else 0); *out is the caller's (brc_memory_free). */
brc_status brc_fracture_whole(brc_simulation *s, uint8_t **out);
/* Those that were unbroken at a moment (brc_fracture_moment), its own breaks counted as broken. */
brc_status brc_fracture_whole_at(brc_simulation *s, int64_t moment, uint8_t **out);

#endif
