/* Waiting for ranks of MPI: a loop of tests, in which a rank also hears that another one has failed: a message of its
 * own kind, for which a receive stands open from the beginning. */
#include "log.h"
#include "ranks_mpi_internal.h"
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATIENT_POLLS = 200 };
#define TOLD_S 0.2   /* how long a rank that failed waits for its alarms to leave */
#define ANSWER_S 8.0 /* how long a wait may last once a signal has come */

struct brc_mpi_ranks brc_mpi = {.here = {.count = 1, .local_count = 1}, .whole = {.count = 1, .local_count = 1}};
volatile sig_atomic_t brc_mpi_signalled;

void brc_mpi_set_sentence(brc_context *context, brc_alarm_message *out, brc_status status)
{
    const char *own = brc_context_message(context);
    *out = (brc_alarm_message){.status = (int32_t)status, .rank = brc_mpi.whole.mine};
    if (strncmp(own, "rank ", 5) == 0) /* as the ranks of a smaller circle agreed */
        snprintf(out->sentence, sizeof out->sentence, "%s", own);
    else
        snprintf(out->sentence, sizeof out->sentence, "rank %d: %s", brc_mpi.whole.mine,
                 *own ? own : brc_status_text(status));
    brc_context_clear(context);
    (void)BRC_FAIL(context, status, "%s", out->sentence);
}

/* What calls return while the ranks are apart. */
brc_status brc_mpi_say_apart(brc_context *context)
{
    const brc_status status = (brc_status)brc_mpi.apart.status;
    if (status != BRC_OK && !strstr(brc_context_message(context), brc_mpi.apart.sentence))
        return BRC_FAIL(context, status, "%s", brc_mpi.apart.sentence);
    return status;
}

void brc_ranks_fail(brc_context *context, brc_status status)
{
    if (status == BRC_OK || brc_mpi.whole.count == 1 || brc_mpi.apart.status != BRC_OK) return;
    brc_mpi_set_sentence(context, &brc_mpi.apart, status);
    MPI_Request *sent = calloc((size_t)brc_mpi.whole.count, sizeof(MPI_Request));
    int n = 0, done = 0;
    for (int k = 0; sent && k < brc_mpi.whole.count; ++k)
        if (k != brc_mpi.whole.mine)
            MPI_Isend(&brc_mpi.apart, sizeof brc_mpi.apart, MPI_BYTE, k, BRC_ALARM_TAG, brc_mpi.alarms, &sent[n++]);
    for (const double start = brc_clock_s(); sent && !done && brc_clock_s() - start < TOLD_S;)
        if (MPI_Testall(n, sent, &done, MPI_STATUSES_IGNORE) != MPI_SUCCESS) break;
    free(sent); /* requests that have not ended stay MPI's */
}

brc_status brc_mpi_check(brc_context *context, int code, const char *what)
{
    if (code == MPI_SUCCESS) return BRC_OK;
    char text[MPI_MAX_ERROR_STRING];
    int length = 0;
    MPI_Error_string(code, text, &length);
    const brc_status status = BRC_FAIL(context, BRC_INTERNAL, "%s between ranks failed: %s", what, text);
    brc_ranks_fail(context, status);
    return status;
}

/* Before anything is sent; late, where a test wants that. */
brc_status brc_mpi_enter(brc_context *context)
{
    brc_mpi.draw = brc_mpi.draw * 6364136223846793005u + 1442695040888963407u;
    if (brc_mpi.delay_us > 0) usleep((unsigned)((brc_mpi.draw >> 33) % (brc_mpi.delay_us + 1)));
    return brc_mpi_say_apart(context);
}

static brc_status hear_alarm(brc_context *context)
{
    int heard = 0;
    BRC_TRY(brc_mpi_check(context, MPI_Test(&brc_mpi.alarm, &heard, MPI_STATUS_IGNORE), "listening"));
    if (heard) brc_mpi.apart = brc_mpi.heard;
    return brc_mpi_say_apart(context);
}

/* Until all requests are done; the seconds are added to *waited_s. */
brc_status brc_mpi_wait(brc_context *context, int n, MPI_Request *requests, const char *what, double *waited_s)
{
    const double start = brc_clock_s();
    brc_status status = BRC_OK;
    int done = 0;
    for (int64_t polls = 0; status == BRC_OK; ++polls) {
        status = brc_mpi_check(context, MPI_Testall(n, requests, &done, MPI_STATUSES_IGNORE), what);
        if (done || status != BRC_OK) break;
        if (polls % 16 == 15) status = hear_alarm(context);
        if (polls > PATIENT_POLLS) sched_yield();
        if (status == BRC_OK && brc_mpi_signalled && brc_clock_s() - start > ANSWER_S) {
            status = BRC_FAIL(context, BRC_INTERRUPTED, "a signal came, and the other ranks do not answer");
            brc_ranks_fail(context, status);
        }
    }
    *waited_s += brc_clock_s() - start;
    return status;
}

/* A call of all ranks that was begun with `code`. */
brc_status brc_mpi_complete(brc_context *context, int code, MPI_Request *request, const char *what)
{
    BRC_TRY(brc_mpi_check(context, code, what));
    ++brc_mpi.cost.calls;
    return brc_mpi_wait(context, 1, request, what, &brc_mpi.cost.call_wait_s);
}
