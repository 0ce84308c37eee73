/* Fracture inside the solver. */
#ifndef BRC_SOLVER_FRACTURE_INTERNAL_H
#define BRC_SOLVER_FRACTURE_INTERNAL_H

#include "breaking.h"
#include "fracture.h"

typedef struct brc_breaking brc_breaking;

/* A stage, for the times of its steps. */
typedef struct brc_break_span {
    int64_t first_step;           /* brc_fracture_moment when it began */
    int64_t first_load;           /* n_loads when it began */
    double first_time, time_step; /* [s]; time_step 0: static */
    int32_t stage;
} brc_break_span;

/* Everything that exists only in scenes with fracture. */
struct brc_breaking {
    brc_pass *stress_pass, *stress_second, *near_pass, *check, *choose, *ratio;
    brc_buffer *record, *stress, *limits, *choice, *measure;           /* fracture.cl */
    brc_buffer *break_step, *break_mode, *break_stress, *break_energy; /* [n_slots][C] */
    brc_buffer *lost, *broken;                                         /* [n_rows] */
    brc_buffer *gone; /* [n_rows] bonds that bear nothing any more; NULL: those that are broken */
    brc_buffer *stress_bound, *limit_margin, *near_margin, *weight, *near, *mark; /* fracture.cl */
    brc_buffer *branch;           /* [n_slots][3][C] of its elements' bonds; borrowed */
    brc_buffer *factor, *weakest; /* only if weighted */
    brc_buffer *plane;            /* [n_slots][3][C] normals of interfaces [-]; only if joined */
    brc_buffer *turned;           /* [n_rows][4] orientations of the elements; borrowed, only if joined is 3 */
    bool weighted;                /* bonds differ in strength */
    int32_t joined;               /* bonds lie in interfaces: 1, whose normals turn with elements: 3 (fracture.cl) */
    bool screened;   /* groups far from failure are passed by: cpu, one rank, level 1, bonds of like strength */
    double scale[3]; /* 1 / smallest limit of tension, compression, shear; 0: none [1/Pa] */
    double *limit;   /* [n_elements][3] host */
    double slope, friction;
    bool drucker_prager;
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
/* Arrays, limits and kernels; refuses models and materials that cannot break. */
brc_status brc_fracture_create(brc_simulation *s);
void brc_fracture_free(brc_simulation *s);
/* Twice the volume that an element's stress stands for, with its share of the voids [m^3]. */
double brc_fracture_volume(const brc_domain *domain, int64_t e);
/* The largest ratio of failure, of records as they stand. */
brc_status brc_fracture_ratio(brc_simulation *s, double *out);
/* Strengths of bonds, and bounds of stress (fracture_bound.c); the limits of the elements are there. */
brc_status brc_fracture_bound(brc_simulation *s);
/* The weakest bonds that are left to the elements, and bounds by them, once it was loaded which ones are broken. */
brc_status brc_fracture_raise_bounds(brc_simulation *s);
/* A stage begins. */
brc_status brc_fracture_begin_stage(brc_simulation *s);
/* What broke, and what that changed. */
brc_status brc_fracture_store_state(brc_simulation *s, brc_state_store *store);
/* What breaking beams change from step to step, to a store of fields. */
brc_status brc_fracture_store_stretch(brc_simulation *s, brc_state_store *store);
/* Elements, ascending, of ascending half-edges; out->id is the caller's (brc_memory_free). */
brc_status brc_fracture_owners(brc_simulation *s, const brc_chosen *half_edges, brc_chosen *out);
#endif
