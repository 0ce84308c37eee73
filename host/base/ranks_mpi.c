/* Ranks of MPI (3.0 or later): beginning and end, and what all agree on. */
#include "log.h"
#include "ranks_mpi_internal.h"
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define LATE_S 10.0    /* how long a rank that failed waits for rank 0 to say so */
#define SLEEP_US 2000u /* between looks, where nothing is computed any more */

brc_ranks_place brc_ranks_here(void)
{
    return brc_mpi.here;
}

brc_ranks_cost brc_ranks_cost_so_far(void)
{
    return brc_mpi.cost;
}

brc_status brc_ranks_agree(brc_context *context, brc_status status)
{
    int64_t first = status == BRC_OK ? INT64_MAX : brc_mpi.here.mine;
    brc_alarm_message message = {0};
    if (brc_mpi.here.count == 1) return status;
    BRC_TRY(brc_ranks_reduce(context, BRC_LEAST, 1, &first));
    if (first == INT64_MAX) return BRC_OK;
    if (first == brc_mpi.here.mine) brc_mpi_set_sentence(context, &message, status);
    BRC_TRY(brc_ranks_broadcast(context, (int32_t)first, &message, sizeof message));
    brc_mpi.agreed = (brc_status)message.status;
    if (first == brc_mpi.here.mine) return brc_mpi.agreed;
    brc_context_clear(context);
    return BRC_FAIL(context, brc_mpi.agreed, "%s", message.sentence);
}

/* ---- beginning and end ---- */

/* For tests: machines that this one is taken for. */
static brc_status read_machines(brc_context *context, int *out)
{
    const char *const wanted = getenv("BRECCIA_RANKS_MACHINES");
    char *end;
    *out = 1;
    if (!wanted || !*wanted) return BRC_OK;
    const long n = strtol(wanted, &end, 10);
    if (*end || n < 1 || n > INT_MAX)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "BRECCIA_RANKS_MACHINES is '%s', must be a number of machines, 1 or more, that the ranks of this "
            "one are taken for; leave it out where they are real",
            wanted);
    *out = (int)n;
    return BRC_OK;
}

/* Ranks of this machine, or of its part of so many. */
static MPI_Comm find_node(int machines)
{
    MPI_Comm node, part;
    MPI_Comm_split_type(brc_mpi.all, MPI_COMM_TYPE_SHARED, brc_mpi.whole.mine, MPI_INFO_NULL, &node);
    if (machines <= 1) return node;
    const int mine = (int)((int64_t)brc_mpi.whole.mine * machines / brc_mpi.whole.count);
    const size_t length = strlen(brc_mpi.name);
    snprintf(brc_mpi.name + length, sizeof brc_mpi.name - length, "/%d", mine);
    MPI_Comm_split(node, mine, brc_mpi.whole.mine, &part);
    MPI_Comm_free(&node);
    return part;
}

static void share_table(int machines)
{
    MPI_Comm node = find_node(machines);
    MPI_Aint bytes = 0;
    int unit;
    MPI_Comm_rank(node, &brc_mpi.whole.local);
    MPI_Comm_size(node, &brc_mpi.whole.local_count);
    int most = brc_mpi.whole.local_count;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, brc_mpi.all);
    brc_mpi.whole.far = most < brc_mpi.whole.count || brc_mpi.latency_us > 0;
    if (brc_mpi.whole.local == 0)
        bytes = (MPI_Aint)(sizeof(brc_node_table) + (size_t)brc_mpi.whole.local_count * sizeof brc_mpi.node->of[0]);
    MPI_Win_allocate_shared(bytes, 1, MPI_INFO_NULL, node, &brc_mpi.node, &brc_mpi.window);
    MPI_Win_shared_query(brc_mpi.window, 0, &bytes, &unit, &brc_mpi.node);
    if (brc_mpi.whole.local == 0) atomic_store(&brc_mpi.node->said, 0);
    brc_mpi.node->of[brc_mpi.whole.local].rank = brc_mpi.whole.mine;
    atomic_store(&brc_mpi.node->of[brc_mpi.whole.local].pid, getpid());
    MPI_Barrier(node);
    MPI_Comm_free(&node);
    MPI_Comm_split(brc_mpi.all, brc_mpi.whole.local == 0 ? 0 : MPI_UNDEFINED, brc_mpi.whole.mine, &brc_mpi.firsts);
    if (brc_mpi.whole.local == 0) MPI_Comm_set_errhandler(brc_mpi.firsts, MPI_ERRORS_RETURN);
}

brc_status brc_ranks_start(brc_context *context, int *argc, char ***argv)
{
    const char *delay = getenv("BRECCIA_RANKS_DELAY_US");
    int provided, length, machines;
    if (MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS || provided < MPI_THREAD_FUNNELED)
        return BRC_FAIL(context, BRC_INTERNAL, "MPI cannot be started with threads; use a build of it that can");
    MPI_Comm_dup(MPI_COMM_WORLD, &brc_mpi.all);
    MPI_Comm_dup(MPI_COMM_WORLD, &brc_mpi.alarms);
    MPI_Comm_set_errhandler(brc_mpi.all, MPI_ERRORS_RETURN);
    MPI_Comm_set_errhandler(brc_mpi.alarms, MPI_ERRORS_RETURN);
    MPI_Comm_rank(brc_mpi.all, &brc_mpi.whole.mine);
    MPI_Comm_size(brc_mpi.all, &brc_mpi.whole.count);
    brc_mpi.whole.node = brc_mpi.name;
    brc_mpi.whole.engine = brc_mpi.engine;
    MPI_Get_processor_name(brc_mpi.name, &length);
    MPI_Get_library_version(brc_mpi.engine, &length);
    brc_mpi.engine[strcspn(brc_mpi.engine, ",\n")] = '\0';
    if (delay) (void)sscanf(delay, "%u,%u", &brc_mpi.delay_us, &brc_mpi.latency_us);
    brc_mpi.draw = (uint64_t)getpid();
    brc_mpi.here = brc_mpi.whole;
    const brc_status status = read_machines(context, &machines);
    if (brc_mpi.whole.count == 1) return status;
    share_table(machines);
    brc_mpi.here = brc_mpi.whole;
    MPI_Irecv(&brc_mpi.heard, sizeof brc_mpi.heard, MPI_BYTE, MPI_ANY_SOURCE, BRC_ALARM_TAG, brc_mpi.alarms,
              &brc_mpi.alarm);
    if (brc_mpi.whole.mine == 0 || status != BRC_OK) return status;
    brc_log_set_level(context, BRC_LOG_ERROR);
    return freopen("/dev/null", "w", stdout) ? BRC_OK : BRC_FAIL(context, BRC_FILE_FAILED, "no /dev/null to write to");
}

/* The communicator of those that calls are of now is `all`. */
static void change_circle(brc_ranks_place here)
{
    const MPI_Comm other = brc_mpi.firsts;
    brc_mpi.firsts = brc_mpi.all;
    brc_mpi.all = other;
    brc_mpi.here = here;
}

void brc_ranks_narrow(void)
{
    brc_ranks_place here = brc_mpi.whole;
    if (brc_mpi.whole.count == 1) return;
    MPI_Comm_rank(brc_mpi.firsts, &here.mine);
    MPI_Comm_size(brc_mpi.firsts, &here.count);
    here.local_count = 1;
    change_circle(here);
}

void brc_ranks_widen(void)
{
    if (brc_mpi.whole.count > 1) change_circle(brc_mpi.whole);
}

/* The first of this machine to ask may print why all end. */
static bool may_speak(void)
{
    return atomic_exchange(&brc_mpi.node->said, 1) == 0;
}

brc_status brc_ranks_end(brc_context *context, brc_status status, bool *speaks)
{
    *speaks = brc_mpi.whole.mine == 0;
    if (brc_mpi.whole.count == 1) return status;
    if (status != BRC_OK && status != brc_mpi.agreed) brc_ranks_fail(context, status);
    if (brc_mpi.apart.status == BRC_OK && brc_ranks_barrier(context) == BRC_OK) return status;
    (void)brc_mpi_say_apart(context);
    for (const double start = brc_clock_s(); brc_mpi.whole.mine != 0 && brc_clock_s() - start < LATE_S;)
        usleep(SLEEP_US); /* rank 0 ends this */
    *speaks = may_speak();
    return (brc_status)brc_mpi.apart.status;
}

void brc_ranks_leave(int exit_code)
{
    if (brc_mpi.apart.status != BRC_OK) MPI_Abort(MPI_COMM_WORLD, exit_code);
    if (brc_mpi.whole.count > 1) {
        atomic_store(&brc_mpi.node->of[brc_mpi.whole.local].pid, 0);
        brc_mpi.node = NULL; /* a signal may still come */
        MPI_Cancel(&brc_mpi.alarm);
        MPI_Wait(&brc_mpi.alarm, MPI_STATUS_IGNORE);
        MPI_Win_free(&brc_mpi.window);
    }
    MPI_Finalize();
}

bool brc_ranks_signal_is_loss(void)
{
    char sentence[200];
    brc_mpi_signalled = 1;
    if (!brc_mpi.node) return false;
    if (atomic_load(&brc_mpi.node->said)) return true;
    for (int k = 0; k < brc_mpi.whole.local_count; ++k) {
        const int pid = atomic_load(&brc_mpi.node->of[k].pid);
        if (pid == 0 || kill(pid, 0) == 0) continue;
        const int length = snprintf(sentence, sizeof sentence,
                                    "rank %d is gone without a word (killed, or out of memory); "
                                    "a run with checkpoints goes on with --resume\n",
                                    brc_mpi.node->of[k].rank);
        if (may_speak() && write(STDERR_FILENO, sentence, (size_t)length) < 0) return true;
        return true;
    }
    return false;
}
