/* What broke: bonds as events, damage of elements, fragments. Of simulations whose scene has `fracture`; BRC_BAD_INPUT
 * without. */
#ifndef BRC_SOLVER_FRACTURE_H
#define BRC_SOLVER_FRACTURE_H

#include "../../simulation.h"

typedef enum brc_break_mode {
    BRC_BREAK_TENSION = 1, /* the first three as in failure.h */
    BRC_BREAK_COMPRESSION,
    BRC_BREAK_SHEAR,
    BRC_BREAK_DETACHED /* cells: what was left of an element that its other bonds no longer held in place */
} brc_break_mode;
/* "tension", "compression", "shear", "detached". */
const char *brc_break_mode_name(int32_t mode);

/* One broken bond. Position and normal are those of the undeformed solid. */
typedef struct brc_break {
    double time;  /* total physical time [s]; of an event of a static stage: that before the stage */
    int64_t step; /* steps of dynamic stages and events of static ones so far, 1: at the end of the first */
    int32_t stage;
    int32_t mode;                       /* brc_break_mode */
    int32_t bond, element_i, element_j; /* ids */
    double position[3];                 /* middle of the bond; cells: centroid of the face [m] */
    double normal[3];                   /* unit vector from i to j */
    double stress; /* virial stress of the element that failed, in the direction of its mode; shear: half the difference
                      of the outer two [Pa] */
    double energy; /* elastic energy the bond held [J] */
    double area;   /* of crack it leaves (bond_area.h) [m^2] */
    double load;   /* static stages: load factor at which it broke; else 0 [-] */
} brc_break;

bool brc_simulation_has_fracture(const brc_simulation *simulation);
/* Bonds broken so far; 0 without fracture. A pass over the elements. */
brc_status brc_simulation_broken(brc_simulation *simulation, int64_t *out);
/* All of them, by step and then by bond. *out is borrowed until the next call or the end of the simulation. */
brc_status brc_simulation_breaks(brc_simulation *simulation, int64_t *n, const brc_break **out);
/* Broken bonds over bonds at the start of every element [n_elements] [-]; 0 for an element that had none. */
brc_status brc_simulation_damage(brc_simulation *simulation, double *out);
/* Number of the fragment of every element [n_elements], counted from 0 in the order of the lowest element id of each;
 * elements hang together over unbroken bonds. */
brc_status brc_simulation_fragments(brc_simulation *simulation, int32_t *fragment, int64_t *n_fragments);
/* The same of bonds that are unbroken where whole is not 0 [n_half_edges], read on the side that bond_half_edge names:
 * fragment [n_elements] and how many there are. */
int64_t brc_fragments_over(const brc_domain *domain, const uint8_t *whole, int32_t *fragment);
/* Half-edges of the domain whose bonds are unbroken [n_half_edges] (1, else 0); *out is the caller's (brc_memory_free),
 * NULL without fracture. */
brc_status brc_simulation_whole(brc_simulation *simulation, uint8_t **out);
/* Radius of the beams of element e [m]; 0 for cells. */
double brc_simulation_beam_radius(const brc_simulation *simulation, int64_t e);
/* The largest ratio of stress to limit over the elements as they stand: 1 is failure; 0 when nothing pulls. */
brc_status brc_simulation_failure_ratio(brc_simulation *simulation, double *out);
/* Cells: fracture energy per area that strength and cells imply where bonds break at once, mean of sigma_f^2 L / (2 E)
 * over them; 0: none does [J/m^2]. */
double brc_simulation_implied_fracture_energy(const brc_simulation *simulation);
/* Cells with a fracture energy: faces that have opened against their cohesion so far (docs/notebook/fracture.md); all 0
 * without. A pass over all bonds. */
typedef struct brc_softening_report {
    int64_t n_opened, n_ended; /* all, and those whose cohesion ended */
    double area;               /* of the latter, projected along their opening [m^2] */
    double spent, unfinished;  /* energy they took; part of it of those that still hold [J] */
} brc_softening_report;
brc_status brc_simulation_softening(brc_simulation *simulation, brc_softening_report *out);
/* Limit of tension of the virial stress of element e, sigma_m [Pa]; 0: none. */
double brc_simulation_element_strength(const brc_simulation *simulation, int64_t e);

#endif
