/* Finite elements beside `breccia bench statics`: FEniCSx (dolfinx, as Debian has it) with the multigrid of PETSc
 * solves the same bodies with as many unknowns (bench/peers/statics-fenics.py). */
#ifndef BRC_BENCH_STATICS_PEER_H
#define BRC_BENCH_STATICS_PEER_H

#include "../host/base/status.h"
#include "rows.h"

typedef struct brc_statics_peer brc_statics_peer;

typedef struct brc_statics_peer_body {
    const char *name; /* cantilever or cube */
    int64_t elements; /* cells of breccia, hence nodes of the peer */
    double poisson;
    double ours; /* seconds that breccia took */
} brc_statics_peer_body;

/* What a peer printed: the lines "breccia-peer KEY NUMBER"; NAN: not told. */
typedef struct brc_statics_peer_result {
    char version[64];
    double nodes, iterations;
    double assembly, setup, seconds; /* of the processor: of the stiffness; of the levels; of levels and solution [s] */
    double resident;                 /* most resident memory [bytes] */
} brc_statics_peer_result;

/* A Python on PATH, or Debian's own, that has dolfinx and PETSc; *out NULL and a line in the log that says what
 * installs it where there is none. The script goes into `folder`, which is made. Freed by brc_statics_peer_free. */
brc_status brc_statics_peer_find(brc_context *context, const char *folder, const char *name, const char *script,
                                 brc_statics_peer **out);
void brc_statics_peer_free(brc_statics_peer **peer);
/* Adds the row of a body: iterations and seconds to a residual of 1e-10 of the load, one thread; a note and no figures
 * where the peer failed. */
brc_status brc_statics_peer_row(brc_context *context, const brc_statics_peer *peer, const brc_statics_peer_body *body,
                                brc_rows *rows);
void brc_statics_peer_read(const char *text, brc_statics_peer_result *out);

#endif
