/* The other programs of `breccia bench peers`: which are on PATH, and a run of one of them, whose own clock and words
 * are read from what it prints. */
#ifndef BRC_BENCH_PEER_H
#define BRC_BENCH_PEER_H

#include "../host/base/status.h"
#include <stdint.h>

typedef enum brc_peer_kind {
    BRC_PEER_YADE,
    BRC_PEER_LAMMPS,        /* bonds that bend and twist: the style bpm/rotational of its package BPM */
    BRC_PEER_LAMMPS_SPRINGS /* a LAMMPS without that package: springs between spheres that do not turn, a lower bound */
} brc_peer_kind;

typedef struct brc_peer {
    brc_peer_kind kind;
    const char *program; /* "yade", "lmp": name and first word of the command */
    const char *law;     /* what stands for the beam in it */
    const char *script;  /* name of its input file */
    bool turning;        /* it carries moments, so that it vibrates as breccia does */
    char path[512];      /* of the program */
    char launcher[512];  /* of mpiexec, for LAMMPS on several processes; "" otherwise */
} brc_peer;

#define BRC_PEERS_MOST 2
#define BRC_PEER_WORDS_MOST 40

/* The first executable file of this name on PATH, into out [size]; false: none. */
bool brc_peer_on_path(const char *name, char *out, size_t size);
/* Run a program (words[0] its path, NULL after the last) to its end, without a shell, without input and with one
 * thread, all that it prints into the file `output`. *state: as of waitpid. BRC_FILE_FAILED: it cannot be started. */
brc_status brc_peer_spawn(brc_context *context, const char *const words[BRC_PEER_WORDS_MOST], const char *output,
                          int *state);
/* The last line of `text` (cut into lines by it) that says something, of a program that failed, into out [size]. */
void brc_peer_last_line(char *text, char *out, size_t size);

/* Those on PATH that can use n_threads. What is missing, or lacks a package, is told in the log with what would install
 * it. `folder` is there and takes what LAMMPS says of itself. BRC_FILE_FAILED: a program cannot be started. */
brc_status brc_peer_find(brc_context *context, int n_threads, const char *folder, brc_peer out[BRC_PEERS_MOST], int *n);

/* Momentum of a shape (docs/notebook/peers.md) [kg m/s] and kinetic energy [J] after a step. */
typedef struct brc_peer_sample {
    int64_t step;
    double momentum, kinetic;
} brc_peer_sample;

typedef struct brc_peer_request {
    const char
        *folder; /* of the packing (peer_work.h) and the script; <script>.txt there takes all that the program prints */
    int64_t steps, warm,
        every; /* steps that are timed, after `warm` others; every > 0: samples of every so many steps instead */
    double time_step, longest; /* [s]; longest branch [m] */
    int n_threads;
} brc_peer_request;

typedef struct brc_peer_result {
    char version[64];
    double wall_s, processor_s; /* of the timed steps; NAN: not told */
    int64_t bonds;              /* -1: not told */
    int64_t n_samples, capacity;
    brc_peer_sample *samples; /* [n_samples]; owned */
    char note[160];           /* why there are no figures; "" where there are */
} brc_peer_result;

/* Run a peer to its end. A program that fails is a result with a note, not a failure. The result begins as {0} and is
 * freed by the caller. */
brc_status brc_peer_run(brc_context *context, const brc_peer *peer, const brc_peer_request *request,
                        brc_peer_result *out);
/* Read what a peer printed: the lines "breccia-peer KEY ..." (version, seconds, processor, bonds, sample), and LAMMPS's
 * own "Loop time of" and "% CPU use", of which the last ones count. note: that figures are missing (seconds of a timed
 * run, samples of the other), or that LAMMPS ran on another number of processes. */
brc_status brc_peer_read(brc_context *context, const char *text, const brc_peer_request *request, brc_peer_result *out);
void brc_peer_result_free(brc_peer_result *result);

#endif
