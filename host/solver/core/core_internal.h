/* What core/ keeps of a simulation, for its own files. */
#ifndef BRC_SOLVER_CORE_INTERNAL_H
#define BRC_SOLVER_CORE_INTERNAL_H

#include "awake.h"
#include "rings.h"

/* Numbers of the scene that kernels ask for by name; those of one material where there is one (kernels gather those of
 * several). */
typedef struct brc_constants {
    double lambda, mu, young, k, ell; /* brc_elastic */
    double axial, bend, twist;        /* brc_beam; cbm */
    double beta, one_plus_tau;        /* dlsm: 0 without compaction */
    double rotation_factor, couple;   /* dlsm-published */
    double gravity[3];                /* [m/s^2] */
    bool area_weights, finite, turns; /* finite: the full law */
} brc_constants;

/* What is hooked in at one moment, in order. */
typedef struct brc_hook_list {
    int n;
    const brc_hooked *at[BRC_MOST_EFFECTS];
} brc_hook_list;

/* What passes go over (awake.h). */
typedef struct brc_awake {
    int32_t n;
    const int32_t *groups; /* [n], borrowed; NULL: all */
    bool only;             /* what is done now goes over these alone */
    int rings;
    brc_rest_account account;
} brc_awake;

struct brc_rings {
    brc_pass *spread, *seed, *count_pass, *tops, *list_pass, *take_back, *forget, *replace, *replace_turns, *delta,
        *book;
    brc_buffer *touched, *level; /* [n_rows] */
    brc_buffer *count;           /* [lists][blocks], then what each list holds */
    brc_buffer *force, *torque;  /* [n_rows][3] of listed elements; the others hold nothing of meaning */
    brc_ring_list around;        /* the bonds that broke in this step */
    double half_kick;            /* brc_rings_begin */
    bool placed;                 /* level holds places (rings.cl) */
    bool whole_force;            /* for comparison: fluxes and forces of all elements */
};

struct brc_core {
    brc_pass *passes; /* all there are, of effects too (passes.h) */
    brc_constants constant;
    bool face_loads; /* some face is held or bears a traction in this stage */

    /* connectivity and geometry (geometry.c) */
    brc_buffer *row_start, *neighbour, *asked_ahead, *boundary;
    brc_buffer *area, *offset, *ratio; /* dlsm: s, d (dlsm_flux.h), q; published: branch (in offset), S (in area) */
    brc_buffer *inv_shape, *inv_volume;
    brc_buffer *material, *modulus, *ell_of, *lame_of;
    brc_buffer *mass, *volume, *inertia;
    brc_buffer *beam_of; /* cbm: branch in offset, 1/length in ratio; stiffness of elements (several materials) */

    /* state */
    brc_buffer *displacement, *velocity, *force;
    brc_buffer *gradient, *stress, *flux, *bond_part; /* dlsm: H, P, B; published: strain in gradient */
    brc_buffer *held_gradient, *held_moment;
    brc_buffer *orientation, *spin, *torque;                     /* published */
    brc_buffer *moved, *lost_numerical, *lost_damping;           /* only with these effects */
    brc_buffer *elastic_energy, *stabilisation_energy, *kinetic; /* [n_rows] scratch of the ledger */
    brc_buffer *partial;                                         /* block sums */

    brc_awake awake;

    int n_effects; /* of this run (hooks.c) */
    const brc_effect *effect[BRC_MOST_EFFECTS];
    void *own[BRC_MOST_EFFECTS];
    brc_hook_list hook[BRC_N_HOOKS];
    const char *effects_in[BRC_MOST_EFFECTS], *effects_out[BRC_MOST_EFFECTS];
    struct {
        brc_step_phase phase;
        double since, seconds[BRC_N_PHASES];
    } watch; /* phases.c */
};

#endif
