/* The levels on the device, shared by the files of this folder. */
#ifndef BRC_SOLVER_MULTIGRID_MULTIGRID_INTERNAL_H
#define BRC_SOLVER_MULTIGRID_MULTIGRID_INTERNAL_H

#include "fine.h"
#include "multigrid.h"

enum { BRC_MOST_LEVELS = 16 };

/* A vector of a level: displacements or forces [n][3], rotations or torques [n][3]; swellings or virials [n] of levels
 * that have them, else NULL. */
typedef struct brc_level_vector {
    brc_buffer *move, *turn, *swell;
} brc_level_vector;

/* n nodes; the finest has the rows of the simulation's layout. */
typedef struct brc_level {
    int64_t n;
    double weight;       /* of a step [-] */
    brc_buffer *inverse; /* [n][21] of diagonal blocks, [n][28] where nodes swell; the finest [n_slices][21][C] */
    brc_buffer *start, *column, *block;    /* its matrix; the finest: none, it is made from bonds */
    brc_level_vector right, x, left, step; /* right side and answer (none on the finest), residual, scratch */
    /* to the next level: P, and its places by columns; from the finest: aggregates */
    brc_buffer *p_start, *p_column, *p_block, *p_column_start, *p_entry;
    brc_buffer *aggregate, *member_start, *member, *arm, *free_bits;
} brc_level;

typedef struct brc_level_passes {
    brc_pass *all, *cells, *ground, *matrix, *step, *finest_step, *collect, *spread, *prolong, *restriction, *coarsest;
} brc_level_passes;
/* Vectors of a launch, as multigrid.cl calls them; right: of n_right parts, 0 none, 1 forces, 2 all. */
typedef struct brc_level_vectors {
    brc_buffer *move, *turn, *swell, *force, *torque, *virial;
    bool swells; /* the nodes of the level, in transfers of the coarser one */
    int32_t n_right;
    brc_buffer *right_force, *right_torque, *right_virial;
} brc_level_vectors;

struct brc_multigrid {
    brc_simulation *s;
    brc_level_passes pass;
    brc_buffer *vector, *number; /* of bonds, borrowed: branches and areas where cells turn, else areas and S/L */
    bool by_branch;
    double law_weight;       /* of a step of the law before and after the cycle [-]; 0: there is none */
    brc_buffer *law_inverse; /* [n_rows][6] its blocks */
    bool short_cycle;        /* without the longer steps, where steps of the law take their place */
    int coarse_steps;        /* before and after the levels below a coarser one */
    int coarse_unknowns;     /* of a node of coarser levels: six, or seven with its swelling */
    int n_levels;
    brc_level level[BRC_MOST_LEVELS];
    brc_buffer *inverse;    /* of the coarsest level's matrix; NULL: steps alone */
    brc_bond_moduli moduli; /* of the one material */
    brc_buffer *moduli_of;  /* [n_rows][3] of several */
    int32_t n_ground;
    brc_buffer *ground_element, *ground;
    brc_buffer *orientation; /* [n_rows][4] beams */
    int64_t most_held;       /* on the host while it was made [byte] */
    brc_multigrid_report report;
};

/* Largest eigenvalue of D^-1 A, from below, to some percent; of_law: of the law on the finest level. */
brc_status brc_level_stiffest(brc_multigrid *m, int level, bool of_law, double *out);

/* ---- multigrid_fields.c ---- */
extern const brc_field_table brc_multigrid_fields, brc_multigrid_ground_fields, brc_multigrid_law_fields,
    brc_multigrid_coarsest_fields, brc_multigrid_finest_fields, brc_multigrid_aggregate_fields,
    brc_multigrid_level_fields, brc_multigrid_matrix_fields, brc_multigrid_transfer_fields, brc_multigrid_start_fields,
    brc_multigrid_coarse_fields;
/* Room for a table of n things. */
brc_status brc_multigrid_list(const brc_multigrid *m, const brc_field_table *table, int64_t n, void *owner);
void brc_multigrid_fields_free(brc_multigrid *m);

#endif
