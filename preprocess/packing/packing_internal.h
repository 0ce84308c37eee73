/* Shared by the files packing_*.c: the packing while it is being made. Nothing here depends on the number of threads:
 * every sphere gathers its own forces in the order of its row, and sums are taken over fixed blocks of spheres, in
 * order. */
#ifndef BRC_PREPROCESS_PACKING_INTERNAL_H
#define BRC_PREPROCESS_PACKING_INTERNAL_H

#include "../../host/base/log.h"
#include "packing.h"
#include "packing_lanes.h"
#include "soft_spheres.h"
#include "start.h"

/* Spheres with more contacts than this at rest overlap by about 3 %. */
#define BRC_PACK_MOST_CONTACTS 8.0

enum {
    BRC_PACK_BLOCK = 512,      /* spheres whose sums are taken together */
    BRC_PACK_LANES = 8,        /* spheres of a group, whose contacts are looked at together */
    BRC_PACK_PIECE = 12,       /* candidates for neighbours that are looked at together */
    BRC_PACK_CANDIDATES = 240, /* candidates of a sphere that are held at once */
    BRC_PACK_PLANES = 6        /* walls a sphere feels at once: the nearest ones */
};

/* The walls near one sphere as planes through their feet, asked for again when the sphere has moved. */
typedef struct brc_pack_wall {
    int32_t sphere;
    int16_t n_planes;
    bool flat;                        /* they are planes: nothing to ask again until the next list */
    double asked[3];                  /* where the sphere was then [m] */
    double plane[BRC_PACK_PLANES][4]; /* outward normal n and c: depth = c - n . x [m] */
} brc_pack_wall;

struct brc_pack {
    brc_context *context;
    const brc_solid *solid;
    int n_threads;
    int64_t n, n_blocks;
    double bounds[2][3];                /* of the solid [m] */
    double (*sphere)[4];                /* [n] x, y, z, radius [m]: one gather reads half a cache line */
    double (*velocity)[3];              /* [n] of the relaxation */
    double (*force)[3];                 /* [n] [m] */
    double mean_radius, largest_radius; /* [m] */

    /* packing_neighbours.c */
    double cutoff; /* side of the cells is at least this [m] */
    int32_t n_cells[3];
    double cells_per_m[3];
    int64_t cell_capacity;
    int32_t *cell_start;  /* [product of n_cells + 1] */
    int32_t *member;      /* [n + BRC_PACK_PIECE] spheres by cell, ascending within one */
    int32_t *place;       /* [n] where each sphere is among these */
    double *in_cells;     /* [4][n + BRC_PACK_PIECE] their x, y, z and radii, each in this order */
    double skin;          /* pairs nearer than R_i + R_j + skin are listed [m] */
    double (*listed)[3];  /* [n] positions when the list was made [m] */
    int64_t *block_list;  /* [n_blocks + 1] each block's part of the list */
    int64_t *block_need;  /* [n_blocks] room it takes */
    int64_t *group_start; /* [n / BRC_PACK_LANES + 2 n_blocks] a group is BRC_PACK_LANES spheres; group g of block b:
                             group_start[g + b] .. [g + b + 1] */
    int64_t list_capacity;
    int32_t *neighbour; /* all listed neighbours, every pair from both sides: of each group the first of every sphere,
                           then the second of every one ..., ends filled up with the sphere itself */

    /* packing_walls.c */
    float *depth_bound; /* [n] the sphere's centre is at least this deep inside the solid [m] */
    int32_t *wall_row;  /* [n] its row among the walls, -1: too deep inside to touch one */
    int64_t n_walls, wall_capacity;
    brc_pack_wall *wall;

    brc_pack_sums *block; /* [n_blocks] */
    double *block_moved;  /* [n_blocks] largest square of a way since the list was made [m^2] */
    brc_progress *progress;
    int64_t iterations;
};

/* The sphere in a lane of group g; beyond the last one that one again. */
static inline int32_t brc_pack_in_lane(const brc_pack *pack, int64_t g, int lane)
{
    const int64_t i = g * BRC_PACK_LANES + lane;
    return (int32_t)(i < pack->n ? i : pack->n - 1);
}

/* packing_neighbours.c. Sort the spheres into cells of at least `cutoff`. */
brc_status brc_pack_sort_cells(brc_pack *pack, double cutoff);
/* Cells around x: at most nine runs of `member`, begin[k] .. end[k]. Returns how many. */
int brc_pack_cells_around(const brc_pack *pack, const double *x, int32_t begin[9], int32_t end[9]);

/* packing_walls.c */
brc_status brc_pack_list_walls(brc_pack *pack);
/* Add the walls' push on sphere i at x to force; renews its planes when it has moved. */
void brc_pack_add_walls(brc_pack *pack, int64_t i, double force[3], brc_pack_sums *sums);

/* What contacts with spheres sum up to, for each sphere of a group (brc_pack_sums, but energy [m^2] four times as much:
 * every contact is met from both sides, as o^2). */
typedef struct brc_pack_contact_sums {
    double force[BRC_PACK_LANES][3];
    double energy[BRC_PACK_LANES], contact_force[BRC_PACK_LANES], overlap[BRC_PACK_LANES];
    int64_t n[BRC_PACK_LANES];
} brc_pack_contact_sums;

/* packing_contacts.c. The contacts of group g, which begins with sphere BRC_PACK_LANES g, among its part of the list.
 */
typedef void brc_pack_add_contacts(const brc_pack *pack, int64_t g, brc_pack_contact_sums *out);
/* The one for this processor. */
brc_pack_add_contacts *brc_pack_contacts_of_group(void);

/* packing_relax.c. Spheres and walls that sphere i touches; of the spheres only those with a nonzero `counts`. */
int brc_pack_contacts(const brc_pack *pack, int64_t i, const int8_t *counts);

#endif
