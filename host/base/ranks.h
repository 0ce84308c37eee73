/* Ranks: processes that compute one run together, and what they send one another. Two implementations beside what they
 * share (ranks.c): ranks_one.c, one rank, of which the plain program is made; ranks_mpi.c, MPI, which `breccia-mpi` is
 * linked with in its place. One set of ranks a process; calls come from the thread that started them.
 *
 * Functions marked "all" are called by every rank, in the same order. They return BRC_OK, or what the first rank that
 * failed said, with its sentence and number in the context: no rank waits for one that has failed or left. After that
 * the ranks are apart: every later call returns the same at once. Their own failures: BRC_INTERNAL. */
#ifndef BRC_BASE_RANKS_H
#define BRC_BASE_RANKS_H

#include "status.h"
#include <stdint.h>

/* ---- beginning and end: the main program ---- */

/* Join the ranks; argc, argv: of main. Other ranks than 0 write to standard output in vain, and log errors alone. */
brc_status brc_ranks_start(brc_context *context, int *argc, char ***argv);
/* Before the program says why it ends. status: of this rank. Returns that of the run: BRC_OK where all ranks ended
 * well; else that of the first that failed, whose sentence with its number is in the context. *speaks: this rank is to
 * print it. A rank that fails while others compute waits for them 10 s at most. */
brc_status brc_ranks_end(brc_context *context, brc_status status, bool *speaks);
/* Leave; exit_code: of the program. Where ranks are apart, the launcher ends those that still compute. */
void brc_ranks_leave(int exit_code);
/* In a signal handler: a rank of this node has died. The first one to see it says so on stderr; true: nothing is left
 * but to end the process. False: all are there, the signal is the user's. */
bool brc_ranks_signal_is_loss(void);

/* ---- who is there ---- */

typedef struct brc_ranks_place {
    int32_t mine, count;        /* 0 .. count - 1 */
    int32_t local, local_count; /* the same among those of this machine (node), in the order of ranks */
    bool far;                   /* some are on other machines: messages take time in which a rank can compute */
    const char *node;           /* name of this machine; static storage, as is the next */
    const char *engine;         /* the implementation and its version: "one rank", or as MPI tells */
} brc_ranks_place;
brc_ranks_place brc_ranks_here(void);
int32_t brc_ranks_mine(void);
int32_t brc_ranks_count(void);

/* From the first ranks of machines (local 0), all of them and no others: until brc_ranks_widen "all" are these, with
 * numbers of their own, each alone on its machine. The rest waits in a call of all, or does something else. */
void brc_ranks_narrow(void);
void brc_ranks_widen(void);

/* ---- failures ---- */

/* This rank has failed: the others are told, and return its status and sentence from their next call. Not collective;
 * at once after the failure, before anything else here is called. Later calls, and those with BRC_OK, do nothing. */
void brc_ranks_fail(brc_context *context, brc_status status);
/* All. Before ranks go on together after doing different things: BRC_OK where all say so, else the status and sentence
 * of the lowest rank that failed. The ranks stay together. */
brc_status brc_ranks_agree(brc_context *context, brc_status status);

/* ---- exchange with neighbours ---- */

/* One neighbour: `send_bytes` from `send` go to it, `receive_bytes` come from it; 0 on both sides: no message. At most
 * 2^31 - 1 each. Buffers are borrowed until the exchange is freed. */
typedef struct brc_neighbour {
    int32_t rank; /* another than mine; each once */
    const void *send;
    int64_t send_bytes;
    void *receive;
    int64_t receive_bytes;
} brc_neighbour;

/* An exchange that is done again and again: requests are made once. */
typedef struct brc_exchange brc_exchange;

/* All, in the same order; n may be 0. Both sides of a pair name each other and the same bytes. neighbours [n]: copied.
 * BRC_NO_MEMORY. */
brc_status brc_exchange_create(brc_context *context, int32_t n, const brc_neighbour *neighbours, brc_exchange **out);
/* Accepts NULL and a pointer to NULL. */
void brc_exchange_free(brc_exchange **exchange);
/* Messages leave: send buffers stay as they are, receive buffers are not read until brc_exchange_finish. Neighbours
 * alone must do the same, in the same order of exchanges. */
brc_status brc_exchange_begin(brc_context *context, brc_exchange *exchange);
/* Messages that fly go on while others compute: MPI may do nothing between its calls. Now and then, not collective. */
brc_status brc_exchange_poke(brc_context *context, brc_exchange *exchange);
/* Every message has come and gone. */
brc_status brc_exchange_finish(brc_context *context, brc_exchange *exchange);

/* ---- of all ranks; bytes are bytes, in the order of ranks ---- */

/* All: items of `size` bytes, n_of[k] of rank k, n_of[mine] at `mine`, come to stand in `all` of every rank. Together
 * fewer than 2^31. `mine` may be their place in `all`. */
brc_status brc_ranks_gather_all(brc_context *context, const void *mine, int64_t size, const int64_t *n_of, void *all);
/* All: bytes_of[k] bytes of rank k come to stand in `all` of rank 0 (elsewhere not read). Any number. */
brc_status brc_ranks_gather_first(brc_context *context, const void *mine, const int64_t *bytes_of, void *all);
/* All: bytes of `data` of rank `from` to every rank. */
brc_status brc_ranks_broadcast(brc_context *context, int32_t from, void *data, int64_t bytes);
/* All: send_bytes[k] bytes for rank k, one after another in `send`; what comes is in *received, one rank after another,
 * receive_bytes[k] of rank k. Nobody knows before what he gets: for lists, not for steps. *received: freed by
 * brc_memory_free. BRC_NO_MEMORY. */
brc_status brc_ranks_trade(brc_context *context, const void *send, const int64_t *send_bytes, void **received,
                           int64_t *receive_bytes);

/* All: of each of n values over the ranks, in place. There are no sums of floating-point numbers: they would depend on
 * the number of ranks. -0 is less than 0, NAN is greater than every number. */
typedef enum brc_reduction { BRC_SUM, BRC_LEAST, BRC_MOST, BRC_ANY_BIT } brc_reduction;
brc_status brc_ranks_reduce(brc_context *context, brc_reduction reduction, int64_t n, int64_t *values);
brc_status brc_ranks_least(brc_context *context, int64_t n, double *values);
brc_status brc_ranks_most(brc_context *context, int64_t n, double *values);
/* All: nobody goes on before everybody has come. */
brc_status brc_ranks_barrier(brc_context *context);

/* ---- what it cost this rank since the start ---- */

typedef struct brc_ranks_cost {
    int64_t messages, bytes;  /* sent to neighbours (exchanges) */
    int64_t exchanges, calls; /* exchanges finished; calls of all ranks, reductions, gathers and so on */
    double flight_s;          /* between begin and finish: computing while messages fly [s] */
    double exchange_wait_s;   /* waiting in brc_exchange_finish [s] */
    double call_wait_s;       /* waiting in calls of all ranks [s] */
} brc_ranks_cost;
brc_ranks_cost brc_ranks_cost_so_far(void);

#endif
