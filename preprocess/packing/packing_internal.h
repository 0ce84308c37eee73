/* Shared by the files packing_*.c: the packing while it is being made. Spheres are soft: two of them that overlap by o
 * = R_i + R_j - d push each other apart with the force o (stiffness 1), a wall counts as the sphere's mirror image: o =
 * 2 (R - depth). Nothing here depends on the number of threads: every sphere gathers its own forces in the order of its
 * row, and sums are taken over fixed blocks of spheres, in order. */
#ifndef BRC_PREPROCESS_PACKING_INTERNAL_H
#define BRC_PREPROCESS_PACKING_INTERNAL_H

#include "../../host/base/log.h"
#include "packing.h"

/* Spheres with more contacts than this at rest overlap by about 3 %. */
#define BRC_PACK_MOST_CONTACTS 8.0

enum {
    BRC_PACK_BLOCK = 512, /* spheres whose sums are taken together */
    BRC_PACK_PLANES = 6   /* walls a sphere feels at once: the nearest ones */
};

/* What one pass over the forces finds; the sums of a block and of all. */
typedef struct brc_pack_sums {
    double energy;       /* sum of o^2 / 2 over contacts, of (R - depth)^2 over walls [m^2] */
    double power;        /* sum of force . velocity */
    double force_square; /* sum of |force|^2 [m^2] */
    double velocity_square;
    double contact_force; /* sum of o over contacts of two spheres, each counted from both sides [m] */
    double overlap;       /* sum of o / d, likewise [-] */
    double wall_force;    /* sum of 2 (R - depth) [m] */
    double wall_overlap;  /* sum of (R - depth) / R [-] */
    int64_t contact_ends; /* twice the number of contacts of two spheres */
    int64_t wall_contacts;
} brc_pack_sums;

/* The walls near one sphere as planes through their feet, asked for again when the sphere has moved. */
typedef struct brc_pack_wall {
    int32_t sphere;
    int16_t n_planes;
    bool flat;                        /* they are planes: nothing to ask again until the next list */
    double asked[3];                  /* where the sphere was then [m] */
    double plane[BRC_PACK_PLANES][4]; /* outward normal n and c: depth = c - n . x [m] */
} brc_pack_wall;

typedef struct brc_pack {
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
    int32_t *cell_start; /* [product of n_cells + 1] */
    int32_t *member;     /* [n] spheres by cell, ascending within one */
    double skin;         /* pairs nearer than R_i + R_j + skin are listed [m] */
    double (*listed)[3]; /* [n] positions when the list was made [m] */
    int64_t *block_list; /* [n_blocks + 1] each block's part of the list */
    int64_t *block_need; /* [n_blocks] room it takes */
    int64_t *row_start;  /* [n + n_blocks] row of sphere i of block b: row_start[i + b] .. row_start[i + b + 1] */
    int64_t list_capacity;
    int32_t *neighbour; /* all listed neighbours, every pair from both sides */

    /* packing_walls.c */
    float *depth_bound; /* [n] the sphere's centre is at least this deep inside the solid [m] */
    int32_t *wall_row;  /* [n] its row among the walls, -1: too deep inside to touch one */
    int64_t n_walls, wall_capacity;
    brc_pack_wall *wall;

    brc_pack_sums *block; /* [n_blocks] */
    double *block_moved;  /* [n_blocks] largest square of a way since the list was made [m^2] */
    brc_progress *progress;
    int64_t iterations;
} brc_pack;

/* packing_start.c. How the radii of a fill are spread: moments of radius / mean radius. */
double brc_pack_mean_radius(const brc_fill *fill); /* of the table [m]; 1 without a table */
double brc_pack_mean_square(const brc_fill *fill); /* mean of (radius / mean radius)^2 */
double brc_pack_mean_cube(const brc_fill *fill);   /* mean of (radius / mean radius)^3 */
double brc_pack_largest(const brc_fill *fill);
/* Share (by number) of the spheres of a table that are so small and so little of the volume that they fit into the
 * holes between the others, where nothing presses them. */
double brc_pack_loose_share(const brc_fill *fill); /* largest radius / mean radius */
/* Radius of an element over the mean radius: a draw by its id. */
double brc_pack_radius(const brc_fill *fill, int64_t element);
/* n start points inside the solid, at least `margin` [m] from the walls, along the Hilbert curve; *out [n][3] is the
 * caller's. Every region holds its share of them (one random point in each cell of a grid), so that nothing has to flow
 * far. *deepest: largest distance of one to the walls [m]. BRC_BAD_INPUT when the solid holds no such points. */
brc_status brc_pack_start(brc_context *context, const brc_solid *solid, const brc_fill *fill, int64_t n, double margin,
                          int n_threads, double **out, double *deepest);

/* packing_neighbours.c. Sort the spheres into cells of at least `cutoff`. */
brc_status brc_pack_sort_cells(brc_pack *pack, double cutoff);
/* Cells around x: at most nine runs of `member`, begin[k] .. end[k]. Returns how many. */
int brc_pack_cells_around(const brc_pack *pack, const double *x, int32_t begin[9], int32_t end[9]);
/* Make the lists of neighbours and walls at the present positions and radii. A centre outside the solid goes back to
 * where it was when the list was last made. */
brc_status brc_pack_list(brc_pack *pack, double skin);

/* packing_walls.c */
brc_status brc_pack_list_walls(brc_pack *pack);
/* Add the walls' push on sphere i at x to force; renews its planes when it has moved. */
void brc_pack_add_walls(brc_pack *pack, int64_t i, double force[3], brc_pack_sums *sums);

/* Walls that sphere i touches. */
int brc_pack_wall_contacts(const brc_pack *pack, int64_t i);

/* packing_relax.c. One pass over the forces at the present positions; the lists must be good there. */
brc_pack_sums brc_pack_forces(brc_pack *pack);
/* Relax until the root mean square of the forces that remain is below `tolerance` of the mean contact force, or nothing
 * touches, or after `most` iterations. *converged tells which. */
brc_status brc_pack_relax(brc_pack *pack, double tolerance, int64_t most, brc_pack_sums *sums, bool *converged);

/* Spheres and walls that sphere i touches; of the spheres only those with a nonzero `counts`. */
int brc_pack_contacts(const brc_pack *pack, int64_t i, const int8_t *counts);

/* packing_crystal.c. Share of spheres in ordered surroundings. */
brc_status brc_pack_crystal(brc_pack *pack, double *share);

/* packing.c */
brc_status brc_pack_create(brc_context *context, const brc_solid *solid, int64_t n, int n_threads, brc_pack *pack);
void brc_pack_free(brc_pack *pack);
/* Multiply all radii. */
void brc_pack_scale(brc_pack *pack, double factor);

#endif
