/* Elements around those whose bonds broke or whose faces are open, in rings by bonds (rings.cl), and element
 * passes over lists of them (members.cl). What a broken bond changes ends in the third ring of dlsm: H of its
 * two elements, ring 0; P of ring 1, B of ring 2, forces of ring 3. In dlsm-published strains change in ring 0 and
 * forces in ring 1, and of what touches in ring 2. All of it exists only in scenes of cells with fracture. */
#ifndef BRC_SOLVER_RINGS_H
#define BRC_SOLVER_RINGS_H

#include "solver.h"

enum { BRC_RING_KINDS = 4 };

/* Elements of the rings 0 to k, n[k] of them, in the order of the rows. */
typedef struct brc_ring_list {
    brc_buffer *upto[BRC_RING_KINDS];
    int32_t n[BRC_RING_KINDS];
    struct brc_rows_among *among; /* all of them, for several ranks (device/shares.h) */
} brc_ring_list;

/* Rings of one simulation, and what is done within them. */
typedef struct brc_rings brc_rings;

brc_status brc_rings_create(brc_simulation *s, brc_rings **out);
void brc_rings_free(brc_rings **rings);
/* Around the bonds that broke in this step. */
const brc_ring_list *brc_rings_around(const brc_rings *rings);
/* The list of an evaluation; NULL: it is of all elements. */
const brc_ring_list *brc_request_list(const brc_force_request *request);
/* For comparison: fluxes and forces around breaks are evaluated of all elements. */
bool brc_rings_are_whole(const brc_rings *rings);
void brc_rings_make_whole(brc_rings *rings);
/* level holds places (rings.cl). */
bool brc_rings_are_placed(const brc_rings *rings);
/* [n_rows] who is touched; 1 + the ring. */
brc_buffer *brc_rings_touched(const brc_rings *rings);
brc_buffer *brc_rings_level(const brc_rings *rings);
/* Arrays of the rings, and half_kick. */
brc_scope brc_scope_of_rings(const brc_rings *rings, const brc_scope *outer);
/* Rows of a brc_ring_list: around breaks, around open faces, of cells that still have bonds (made when most have
 * none). */
extern const brc_field_table brc_ring_fields, brc_ring_list_fields, brc_open_list_fields, brc_bonded_list_fields;
/* What is new in ring 0 (touched) and ring 1 since the last list was closed: rings->around, up to n[0] touched ones
 * that were found before, up to n[1] touched ones that were not, up to n[2] those of ring 1 alone. First they are
 * counted; *marked: whether marks of bonds that hold are among what touched some. */
brc_status brc_rings_find(brc_simulation *s, brc_rings *rings, bool *marked);
brc_status brc_rings_list_found(brc_simulation *s, brc_rings *rings);
/* Those that were touched by now, in n[0] of rings->around. */
brc_status brc_rings_list_touched(brc_simulation *s, brc_rings *rings);
/* Rings first to last around all that were touched, into rings->level: 1 + the ring. */
brc_status brc_rings_spread(brc_simulation *s, brc_rings *rings, int first, int last);
/* All that were touched and the rings that were spread around them; nothing is touched afterwards, or, kept, until
 * cells_share has gone over ring 0. Placed: kept, and level knows the rings and the places in the list of the rings 0
 * to 2 until brc_rings_forget. out NULL: rings->around. */
typedef enum brc_rings_closing { BRC_RINGS_DROP, BRC_RINGS_KEEP, BRC_RINGS_PLACE } brc_rings_closing;
brc_status brc_rings_close(brc_simulation *s, brc_rings *rings, brc_rings_closing how, brc_ring_list *out);
/* In two parts, with rings->around. First all of them are counted; where *marked as above, the rings 2 and 3 are taken
 * back, and there is no second part. */
brc_status brc_rings_count(brc_simulation *s, brc_rings *rings, bool *marked);
brc_status brc_rings_list(brc_simulation *s, brc_rings *rings, brc_rings_closing how);
brc_status brc_rings_forget(brc_rings *rings);
/* Elements whose number is above 0 are touched, and no others. */
brc_status brc_rings_seed(brc_simulation *s, brc_rings *rings, brc_buffer *number);
/* Elements whose number is not above 0, in every ring. */
brc_status brc_rings_without(brc_simulation *s, brc_rings *rings, brc_buffer *number, brc_ring_list *out);

/* A pass over the rings 0 to `ring` of a list, by `listed`, or, where list is NULL or they are so many that this is
 * quicker, over all by `whole` (NULL: never). request, given: as for brc_pass_run_on, without the list, which `listed`
 * has open beside (BRC_LISTED). */
brc_status brc_pass_over(brc_simulation *s, const brc_pass *whole, const brc_pass *listed, const brc_ring_list *list,
                         int ring, const brc_force_request *request, const brc_given *given);
/* Whether a pass over the rings 0 to `ring` goes over all elements: list NULL, or half of the elements and more. */
bool brc_pass_is_whole(const brc_simulation *s, const brc_ring_list *list, int ring);

/* Before and after bonds break: velocities take half_kick (dt/2, 0: none) of the forces that change. Where all are
 * evaluated they take it here, and what velocity Verlet loses by the jump is booked, as brc_rings_replace does. */
brc_status brc_rings_begin(brc_simulation *s, brc_rings *rings, double half_kick);
brc_status brc_rings_end(brc_simulation *s, const brc_rings *rings);
/* Forces (and torques) of rings take the places of the forces of the listed rings 0 to `inner`, and the velocities
 * their difference over half a step; of those up to k, which brc_rims_force has replaced, what that loses is booked
 * too. */
brc_status brc_rings_replace(brc_simulation *s, const brc_rings *rings, int inner, int k);
/* Sum of x [n_rows] over the rings 0 to k, in the order of the list, later (brc_vector_sum_later). */
brc_status brc_rings_sum(brc_simulation *s, const brc_ring_list *list, int k, brc_buffer *x, double *out);

#endif
