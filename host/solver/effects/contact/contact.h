/* Touching: of free surfaces, fragments and strikers (docs/notebook/contact.md). Nothing of it exists in scenes without
 * `interactions: {contact: ...}`.
 *
 * A step asks in this order: brc_contact_follow when the elements have moved, brc_contact_gradients,
 * brc_contact_moments and brc_contact_forces while the forces are evaluated, brc_contact_broken when bonds broke. */
#ifndef BRC_SOLVER_CONTACT_H
#define BRC_SOLVER_CONTACT_H

#include "../../core/solver.h"

typedef struct brc_contact_state brc_contact_state;

/* s->contact, after fracture and strikers are there. It sleeps in static stages and modes, which come before dynamic
 * ones (the reader sees to it). BRC_BAD_INPUT: models or shapes that cannot touch. */
brc_status brc_contact_create(brc_simulation *s);
void brc_contact_free(brc_simulation *s);

/* Elements were moved by hand or a stage begins: look for pairs again. */
brc_status brc_contact_restart(brc_simulation *s);
/* The forces of the start of a stage are there, with this ledger: BRC_BAD_INPUT if the static stage before it has
 * pressed surfaces into each other; warned of if they overlap as the run begins. */
brc_status brc_contact_enable(brc_simulation *s, const brc_ledger *ledger);
/* Steps until the next probe of how far things moved ... */
int64_t brc_contact_next_probe(const brc_simulation *s);
/* ... and until the first that cannot be put off to the end of a stretch of steps (../fracture/ahead.h), as the probes
 * before it found something; INT64_MAX without contact. */
int64_t brc_contact_quiet_steps(const brc_simulation *s);
/* A stretch, in which probes are put down on the device; *stands: each would have found nothing to do. */
void brc_contact_begin_stretch(brc_simulation *s);
brc_status brc_contact_end_stretch(brc_simulation *s, bool *stands);
/* Elements moved by a step: look again where they moved far enough. */
brc_status brc_contact_follow(brc_simulation *s);
/* dlsm: the rotations of rigid cells go into the gradients. */
brc_status brc_contact_pose(brc_simulation *s);
/* dlsm: the gradients of this evaluation are there: the same, and the search that follow, restart or broken asked for,
 * which wants to know how cells stand now. */
brc_status brc_contact_gradients(brc_simulation *s);
/* dlsm: pairs are evaluated, and held_moment, zeroed before, gains their moments. */
brc_status brc_contact_moments(brc_simulation *s, const brc_force_request *r);
/* Forces (and, in models that turn, the evaluation and torques) of touching pairs, added. */
brc_status brc_contact_forces(brc_simulation *s, const brc_force_request *r);
/* Some pair may touch: whether contact has anything to do with this evaluation. */
bool brc_contact_acts(const brc_simulation *s, const brc_force_request *r);

/* Bonds broke at the end of this step. Cells: those of dlsm without bonds become rigid bodies, and what is exposed now
 * is listed; the forces are evaluated afterwards. Beams: the same, and forces and velocities are put right (half_kick
 * as brc_fracture_step). */
brc_status brc_contact_broken(brc_simulation *s, double half_kick);
/* Cells, after that, with the gradients that the breaks left: where something moved so far by them all pairs are looked
 * for again. */
brc_status brc_contact_settle(brc_simulation *s);
/* Cells, after that: elements of pairs that the breaks may have changed are given the level `to` where they have none
 * (rings.h). */
brc_status brc_contact_spread(brc_simulation *s, brc_buffer *level, int32_t to);
/* dlsm, sweeps of openings: a search is due, so that the next evaluation is one of all elements. */
bool brc_contact_is_due(const brc_simulation *s);
/* The pairs of touched [n_rows] elements, for requests of listed_pairs, and for brc_contact_spread; they hold until the
 * number of lists that were made is another one. */
brc_status brc_contact_list_around(brc_simulation *s, brc_buffer *touched);
int64_t brc_contact_lists(const brc_simulation *s);
/* Pairs listed now where the device works in the host's memory: how many; ends [n][2], rows of elements, the second one
 * of a striker's piece n_rows and above; touch [n], whether they touched when they were evaluated last. 0 elsewhere. */
int32_t brc_contact_pairs_here(const brc_simulation *s, const int32_t **ends, const int32_t **touch);
/* Rigid cells: momentum of turning gains kick times torque, then they turn for a time of drift [s]; extra as the kernel
 * advance_rotation. */
brc_status brc_contact_turn(brc_simulation *s, double kick, double drift, double extra);

/* dlsm, after breaks: where most cells are without bonds the others are listed ... */
brc_status brc_contact_list_bonded(brc_simulation *s);
/* ... for the element passes, as bonds give cells without any no force, and no stress (rings.h). NULL: there is no
 * list. */
const struct brc_ring_list *brc_contact_bonded(const brc_simulation *s);

/* What surfaces hold now, as last evaluated [J]; later (brc_vector_sum_later). */
brc_status brc_contact_stored(brc_simulation *s, double *out);
/* Terms contact, friction, impact of the ledger, and what is kinetic or numerical or fracture of contact's own. */
brc_status brc_contact_ledger(brc_simulation *s, brc_ledger *ledger);
/* Largest stable time step of the pairs that may touch [s]. */
brc_status brc_contact_critical_step(brc_simulation *s, double *out);
/* Tells where single elements may meet in so few steps that their restitution cannot be what is asked. touching: what
 * brc_contact_critical_step gave. */
void brc_contact_check_step(const brc_simulation *s, const char *stage, double touching, const brc_time_step *step);

/* What surfaces remember (state_store.h): who is exposed and rigid, the pairs with their friction, what was lost. */
brc_status brc_contact_store_state(brc_simulation *s, brc_state_store *store);
/* What steps change in which nobody looks for pairs, to a store of fields. */
brc_status brc_contact_store_stretch(brc_simulation *s, brc_state_store *store);

/* ---- what a list of pairs is made by, and what it holds ---- */
/* Law of two materials (BRC_CONTACT_LAW numbers, contact_law.h). */
const double *brc_contact_law_of(const brc_simulation *s, int32_t i, int32_t j);
/* Make the list anew, from where elements are and how they stand now; what pairs remember is kept. */
brc_status brc_contact_search(brc_simulation *s);
/* The list for places and pieces as they were taken last: the second half of a search. */
brc_status brc_contact_list_again(brc_simulation *s);
/* For comparison: breaks look for all pairs, and openings follow by evaluations of all. */
void brc_contact_always_whole(brc_simulation *s, bool whole);
/* Ends [n][2] and memory [n][BRC_CONTACT_HISTORY] of the n pairs listed now, read (either may be NULL); memory
 * written. */
enum { BRC_CONTACT_HISTORY = 20, BRC_CONTACT_LAW = 6 }; /* as in contact_search.cl, contact.cl */
brc_status brc_contact_read_pairs(brc_simulation *s, int32_t *ends, double *history);
brc_status brc_contact_write_pairs(brc_simulation *s, const double *history);
/* Kinetic energy of the turning of rigid cells [J]; their angular momenta [n_elements][3] [kg m^2/s]. */
brc_status brc_contact_spin_energy(brc_simulation *s, double *out);
brc_status brc_contact_momenta(brc_simulation *s, double *out);

#endif
