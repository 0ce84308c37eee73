/* Inside of the ranks of MPI: what they know of each other, and waiting. */
#ifndef BRC_BASE_RANKS_MPI_INTERNAL_H
#define BRC_BASE_RANKS_MPI_INTERNAL_H

#include "ranks.h"
#include <mpi.h>
#include <signal.h>
#include <stdatomic.h>

enum { BRC_SENTENCE_ROOM = 2000, BRC_ALARM_TAG = 1 /* of its own communicator */ };

/* What the first rank that failed says. */
typedef struct brc_alarm_message {
    int32_t status, rank;
    char sentence[BRC_SENTENCE_ROOM];
} brc_alarm_message;

/* In memory that the ranks of a machine share. */
typedef struct brc_node_table {
    atomic_int said; /* one of them has printed, or prints, why all end */
    struct {
        atomic_int pid; /* 0: left in order */
        int rank;
    } of[];
} brc_node_table;

/* The ranks of this process. */
struct brc_mpi_ranks {
    brc_ranks_place here, whole; /* those that calls are of now, and of all */
    MPI_Comm all;                /* of those now */
    MPI_Comm firsts; /* the first ranks of machines, MPI_COMM_NULL on others; while calls are of these, the whole */
    MPI_Comm alarms; /* the whole */
    MPI_Request alarm;
    brc_alarm_message heard; /* received */
    brc_alarm_message apart; /* status BRC_OK: all are together */
    brc_status agreed;       /* last failure that all have agreed on */
    MPI_Win window;
    brc_node_table *node;
    int tag;
    unsigned delay_us, latency_us; /* for tests: messages leave late by up to this, and take so long at least */
    uint64_t draw;
    brc_ranks_cost cost;
    char name[MPI_MAX_PROCESSOR_NAME], engine[MPI_MAX_LIBRARY_VERSION_STRING];
};
extern struct brc_mpi_ranks brc_mpi;
extern volatile sig_atomic_t brc_mpi_signalled; /* a signal has come */

/* The sentence of this rank's failure with its number, in the context too. */
void brc_mpi_set_sentence(brc_context *context, brc_alarm_message *out, brc_status status);
/* What calls return while the ranks are apart. */
brc_status brc_mpi_say_apart(brc_context *context);

/* BRC_INTERNAL, which the others are told, where code is not MPI_SUCCESS. */
brc_status brc_mpi_check(brc_context *context, int code, const char *what);
/* Before anything is sent; late, where a test wants that. */
brc_status brc_mpi_enter(brc_context *context);
/* Until all requests are done; the seconds are added to *waited_s. */
brc_status brc_mpi_wait(brc_context *context, int n, MPI_Request *requests, const char *what, double *waited_s);
/* A call of all ranks that was begun with `code`. */
brc_status brc_mpi_complete(brc_context *context, int code, MPI_Request *request, const char *what);

#endif
