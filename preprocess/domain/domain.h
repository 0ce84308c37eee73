/* The domain: a solid as elements and bonds, as arrays: convex cells that share faces, or spheres joined by beams.
 * Built by brc_domain_build, read and written by domain_file.h.
 *
 * The position X of an element is its Voronoi seed, so that the branch R = X_j - X_i is parallel to the face normal:
 * R = (L / S) s with L = |R| and s = S N the area vector. Element mass is lumped at X.
 * Index types: int64_t for counts and row starts, int32_t for indices (a domain has fewer than 2^31 half-edges).
 * An element's index in these arrays is its id (never depends on storage order, device or threads). */
#ifndef BRC_PREPROCESS_DOMAIN_H
#define BRC_PREPROCESS_DOMAIN_H

#include "../../host/base/file_pages.h"
#include <stdbool.h>
#include <stdint.h>

typedef enum brc_set_kind { BRC_SET_FACES, BRC_SET_ELEMENTS } brc_set_kind;

/* A named list of free faces or of elements; members ascending, no duplicates. */
typedef struct brc_set {
    char *name; /* owned */
    brc_set_kind kind;
    int64_t n_members;
    int32_t *members; /* [n_members] indices into the free-face or element arrays; owned */
} brc_set;

/* What the builder found; every number is of the finished domain unless it says otherwise. */
typedef struct brc_quality {
    int64_t n_seeds_requested;
    int64_t n_seeds_duplicate;      /* seeds dropped because nearer than the minimal distance to an earlier one */
    int64_t n_seeds_lost;           /* seeds inside the shape for which Voro++ gave no cell (0, or building fails) */
    int64_t n_tiny_faces_dropped;   /* faces below tiny_face_threshold, removed from both sides */
    double tiny_face_threshold;     /* [-] of the mean face area */
    double tiny_face_area_fraction; /* [-] dropped area over total face area */
    double volume_shape;            /* exact volume of the shape asked for [m^3] */
    double volume_cells;            /* sum of the elements' own volumes [m^3] */
    double volume_error;            /* cells: volume_cells / volume_shape - 1 [-]; spheres: 0 */
    double smallest_distance;       /* shortest branch [m] */
    double mean_spacing;  /* cells: (volume_cells / n_elements)^(1/3), spheres: (volume_shape / n_elements)^(1/3) [m] */
    double closure_worst; /* largest |sum of face area vectors| of a cell over its total face area [-] */
    double twin_area_worst;   /* largest difference of a face area seen from its two sides, over the mean area [-] */
    double support_smallest;  /* cells: smallest eigenvalue of A_i / (2 V_i), A = sum (L/S) s (x) s [-]; spheres: 0 */
    double volume_fraction;   /* spheres: sphere volume over the shape's [-]; cells: 0 */
    double growth;            /* spheres: largest d / (R_i + R_j) of a bond (NAH19's growth factor) [-]; cells: 0 */
    double coordination_mean; /* 2 n_bonds / n_elements [-] */
    int64_t coordination_histogram[64]; /* elements with k bonds; the last bin also counts more */
    int64_t n_elements_without_bond;
    int64_t
        n_pieces; /* parts that no bond joins, elements without bonds among them; -1: memory was short for counting */
    double volume_spread[5]; /* element volumes over their mean: least, 5 %, median, 95 %, most [-] */
    double faces_spread[5];  /* cells: faces of a cell, shared and free, likewise; spheres: 0 */
    double branch_spread[5]; /* lengths of branches over mean_spacing, likewise [-] */
} brc_quality;

typedef enum brc_element_kind {
    BRC_ELEMENT_CELL,  /* convex cells, every array below */
    BRC_ELEMENT_SPHERE /* spheres joined by beams: no faces and corners. area_vector, face_centroid, free_*, vertex and
                        * free_polygon* are NULL, n_free_faces is 0; volume, inertia and centroid are those of the
                        * sphere; each wall's set holds the elements that touch it as packed, the set "<wall>_layer"
                        * those with centres within 2 R of it */
} brc_element_kind;

typedef struct brc_domain {
    brc_element_kind element_kind;
    int64_t n_elements, n_bonds, n_half_edges /* = 2 n_bonds */, n_free_faces;

    /* elements */
    double *position; /* [n_elements][3] seed X [m] */
    double *volume; /* [n_elements] [m^3] of the body that an element stands for: a cell's own; a sphere's own over the
                       body's volume fraction, so that the body weighs what its material does (NAH19 eq. 15, 16) */
    double *centroid; /* [n_elements][3] centre of mass of the cell [m] */
    double *inertia;  /* [n_elements][6] xx yy zz yz xz xy of the inertia tensor about the centroid at unit density
                         [m^5];  of a sphere 2/5 volume radius^2 */
    int32_t *region;  /* [n_elements] index of the material region (0: the body's own material) */
    int32_t *body;    /* [n_elements] index of the body */
    int32_t *grain;   /* [n_elements] index of the grain, numbered through all bodies; NULL: no grains */
    double *radius;   /* [n_elements] spheres: as packed, before any growth [m]; cells: NULL */

    /* half-edges: rows sorted by neighbour id; row of element e is row_start[e] .. row_start[e + 1] */
    int64_t *row_start;      /* [n_elements + 1] */
    int32_t *neighbour;      /* [n_half_edges] */
    int32_t *twin;           /* [n_half_edges] the same face seen from the neighbour */
    int32_t *bond;           /* [n_half_edges] bond of the half-edge */
    double *area_vector;     /* [n_half_edges][3] s = S N, outward [m^2]; exactly minus the twin's */
    double *face_centroid;   /* [n_half_edges][3] C [m]; exactly the twin's */
    int32_t *bond_half_edge; /* [n_bonds] the half-edge seen from the smaller id, ascending: bond_i = its row */

    /* free faces: rows by element */
    int64_t *free_start;      /* [n_elements + 1] */
    int32_t *free_element;    /* [n_free_faces] */
    double *free_area_vector; /* [n_free_faces][3] outward [m^2] */
    double *free_centroid;    /* [n_free_faces][3] [m] */
    int32_t *free_wall;       /* [n_free_faces] index into wall_name */
    int32_t n_walls;
    char **wall_name; /* [n_walls] e.g. "x-", "x+", "side", "surface"; owned */

    /* cell corners, for pictures and results; each cell has its own copies */
    int64_t *vertex_start;       /* [n_elements + 1] */
    double *vertex;              /* [vertex_start[n_elements]][3] [m] */
    int64_t *free_polygon_start; /* [n_free_faces + 1] */
    int32_t *free_polygon;       /* corners of free face f, counter-clockwise from outside: indices into vertex */

    /* Where several ranks have a domain between them (domain_rows.h), this one has the shared faces of some cells, and
     * corners, centroids and inertia of fewer: those arrays hold nothing of others. All NULL: it has all. */
    uint8_t *here;       /* [n_elements] 1: it has the faces of the cell */
    int64_t *home;       /* [ranks + 1] rank k has all of the cells home[k] to home[k + 1] */
    double *free_corner; /* [free_polygon_start[n_free_faces]][3] places of the corners in free_polygon [m] */
    uint32_t area_sum;   /* CRC-32 of all area vectors, in their order */

    int32_t n_sets;
    brc_set *sets; /* [n_sets] one set per wall first (cells: faces; spheres: elements, all "<wall>_layer" after them),
                    * then the requested ones; names are unique */

    double bounds[2][3]; /* smallest and largest corner [m] */
    brc_quality quality;
    char *provenance; /* how it was made, one line of text; owned */

    brc_machine_memory elsewhere; /* arrays lie there: of all ranks of the machine (domain_ranks.h), pages of a file */
    brc_file_pages pages;         /* ... and those of a domain file; what is written to them is not in the file */
} brc_domain;

/* Free a domain and all its arrays; accepts a pointer to NULL; sets *domain to NULL. */
void brc_domain_free(brc_domain **domain);
/* Every block that a domain owns, what blocks point to before them (or, down, after them): visit gets where its
 * pointer is kept. Stops at the first failure. */
typedef brc_status (*brc_domain_visit)(void *self, void **block);
brc_status brc_domain_each_block(brc_domain *domain, bool down, brc_domain_visit visit, void *self);
/* Arrays that are pages of a file become the domain's own: before many of them are written. BRC_NO_MEMORY. */
brc_status brc_domain_take_pages(brc_context *context, brc_domain *domain);
/* Append a copy of the name to the walls; wall_name has room for it. BRC_NO_MEMORY. */
brc_status brc_domain_add_wall(brc_context *context, brc_domain *domain, const char *name);
static inline double brc_sphere_volume(double radius)
{
    return 4.1887902047863910 * radius * radius * radius;
}
/* The volume that element e fills itself [m^3]: a sphere less than it stands for. */
static inline double brc_domain_own_volume(const brc_domain *domain, int64_t e)
{
    return domain->radius ? brc_sphere_volume(domain->radius[e]) : domain->volume[e];
}
/* The shared faces of element e are here. */
static inline bool brc_domain_has(const brc_domain *domain, int64_t e)
{
    return !domain->here || domain->here[e];
}
/* Place of corner k of free_polygon. */
static inline const double *brc_domain_free_corner(const brc_domain *domain, int64_t k)
{
    return domain->free_corner ? domain->free_corner + 3 * k : domain->vertex + 3 * (int64_t)domain->free_polygon[k];
}
/* Index of the named set, -1 when there is none. */
int32_t brc_domain_find_set(const brc_domain *domain, const char *name);
/* Closure of element e: |sum of its face area vectors| over its total face area [-]. */
double brc_domain_closure(const brc_domain *domain, int64_t e);
/* Check every stated property of the arrays (indices in range, twins, area vectors equal and opposite, closed cells,
 * finite values, sorted rows). BRC_BAD_INPUT with one sentence per broken property. Used after reading a file. */
brc_status brc_domain_check(brc_context *context, const brc_domain *domain);

#endif
