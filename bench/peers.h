/* `breccia bench peers`: the same packing, beams, masses and time step in breccia and in the other programs of this
 * kind that are on PATH (peer.h).
 *   peers-bar  a bar let go with the velocities of its first longitudinal mode: frequency and kinetic energy in each
 *              program, that the reader sees all compute the same
 *   peers      a cube: bond updates a second of model cbm and of each peer, in turns, five rounds; model dlsm with as
 *              many cells beside them
 * Seconds are of the processor with one thread, which other programs on the machine do not lengthen, else of the wall.
 * Rows say the median, least and most. */
#ifndef BRC_BENCH_PEERS_H
#define BRC_BENCH_PEERS_H

#include "../host/base/status.h"
#include "rows.h"

/* An input file of a peer, as in bench/peers. */
typedef struct brc_peer_script {
    const char *name, *text; /* borrowed */
} brc_peer_script;

typedef struct brc_peers_request {
    int64_t elements, steps; /* of the cube; of each timed sample */
    int n_threads;
    const char *folder; /* the peers' files are left in its folders bar and cube; made where it is missing */
    int n_scripts;
    const brc_peer_script *scripts; /* all of bench/peers */
    /* Called after each row; a status other than BRC_OK stops. */
    brc_status (*row)(void *self, const brc_rows *rows);
    void *self;
} brc_peers_request;

/* Adds the rows. Peers that are missing are told in the log; one that fails gives a row with a note and no figures. */
brc_status brc_peers_measure(brc_context *context, const brc_peers_request *request, brc_rows *rows);

#endif
