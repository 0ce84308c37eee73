/* The program: finds the command, hands signals to the running simulation, prints the sentences of a failure once and
 * turns the status into an exit code. The only place that owns process-wide state. */
#include "command.h"
#include "../base/log.h"
#include "../base/ranks.h"
#include "../base/version.h"
#include <malloc.h>
#include <omp.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A signal handler reaches nothing else. */
static brc_simulation *volatile running_simulation;

static void on_signal(int number)
{
    brc_simulation *simulation = running_simulation;
    if (brc_ranks_signal_is_loss()) _exit(brc_status_exit_code(BRC_INTERRUPTED));
    /* The first signal asks for an orderly end; a second one, or one while nothing runs, ends the process at once. */
    signal(number, SIG_DFL);
    if (simulation)
        brc_simulation_interrupt(simulation);
    else
        raise(number);
}

static void set_running(brc_simulation *simulation)
{
    running_simulation = simulation;
}

static brc_status dispatch(const brc_session *session, int argc, const char *const *argv)
{
    if (argc < 2 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        brc_command_print_list(stdout);
        return BRC_OK;
    }
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        printf("breccia %s (commit %s, %s)\n", brc_version(), brc_version_commit(), brc_version_compiler());
        return BRC_OK;
    }
    const brc_command *command = brc_command_find(session->context, argv[1]);
    if (!command) return BRC_BAD_INPUT;
    const bool of_ranks =
        command->ranks && (command != &brc_command_bench || strcmp(argc > 2 ? argv[2] : "", "ranks") == 0);
    if (brc_ranks_count() > 1 && !of_ranks)
        return BRC_FAIL(session->context, BRC_BAD_INPUT, "breccia %s does not run on %d ranks; start one",
                        command->name, (int)brc_ranks_count());
    brc_arguments arguments;
    BRC_TRY(brc_arguments_parse(session->context, command, argc - 2, argv + 2, &arguments));
    if (arguments.help) {
        brc_command_print_help(command, stdout);
        return BRC_OK;
    }
    return command->run(session, &arguments);
}

/* Threads that wait, and those of the BLAS, are chosen before a program begins; so the program starts itself once more
 * with what suits it, unless the user has chosen. If that fails, it goes on as it is (figures:
 * docs/notebook/devices.md, "Waiting threads"). GNU OpenMP lets waiting threads spin for milliseconds. When another
 * program wants the same core, each launch of a step then loses a time slice; but a core that falls asleep between
 * launches takes longer to wake, on virtual machines, than a launch of 10 000 elements takes. A spin of some ten
 * microseconds is within a tenth of the best there is on a quiet machine (without: 1.3 to 3.5 times the seconds of
 * steps) and within a third of it beside other programs. Other OpenMP libraries do not know the count and do not spin.
 * OpenBLAS keeps threads of its own, which get in the way of ours: our matrices are small, and static stages took 1.03
 * to 1.9 times the seconds. */
static void choose_threads(char **argv)
{
    const bool waiting = getenv("GOMP_SPINCOUNT") || getenv("OMP_WAIT_POLICY"), blas = getenv("OPENBLAS_NUM_THREADS");
    if (waiting && blas) return;
    if (!waiting && (setenv("GOMP_SPINCOUNT", "1000", 1) || setenv("OMP_WAIT_POLICY", "passive", 1))) return;
    if (!blas && setenv("OPENBLAS_NUM_THREADS", "1", 1)) return;
    execv("/proc/self/exe", argv);
}

/* Once a large block was freed, glibc keeps all that are smaller, up to 32 MB each, and lists of pairs that grow leave
 * holes: a plate under impact held 262 MB for 222. So large blocks go back to the system at once. */
static void return_large_blocks(void)
{
    enum { LARGE = 1 << 20 };
    (void)mallopt(M_MMAP_THRESHOLD, LARGE);
}

/* Ranks of one machine share its cores, unless the user or the launcher has dealt them out. */
static void share_cores(void)
{
    const brc_ranks_place place = brc_ranks_here();
    const int cores = omp_get_num_procs();
    if (place.local_count == 1 || getenv("OMP_NUM_THREADS") || cores < sysconf(_SC_NPROCESSORS_ONLN)) return;
    omp_set_num_threads(cores > place.local_count ? cores / place.local_count : 1);
}

int main(int argc, char **argv)
{
    choose_threads(argv);
    return_large_blocks();
    brc_context *context = brc_context_create();
    if (!context) {
        fprintf(stderr, "breccia: out of memory before anything began\n");
        return brc_status_exit_code(BRC_NO_MEMORY);
    }
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
    signal(SIGXFSZ, SIG_IGN); /* a file-size limit is then a refused write with a sentence */
    const brc_session session = {context, set_running};
    bool speaks = true;
    brc_status status = brc_ranks_start(context, &argc, &argv);
    if (brc_ranks_count() > 1) signal(SIGUSR2, on_signal); /* the one that mpirun hands on to the ranks */
    share_cores();
    if (status == BRC_OK) status = dispatch(&session, argc, (const char *const *)argv);
    if (fflush(stdout) != 0 && status == BRC_OK)
        status = BRC_FAIL(context, BRC_FILE_FAILED, "standard output cannot be written (closed, or the disk is full)");
    status = brc_ranks_end(context, status, &speaks);
    if (status != BRC_OK && speaks) {
        const char *message = brc_context_message(context);
        fprintf(stderr, "%s\n", *message ? message : brc_status_text(status));
    }
    brc_context_free(&context);
    brc_ranks_leave(brc_status_exit_code(status));
    return brc_status_exit_code(status);
}
