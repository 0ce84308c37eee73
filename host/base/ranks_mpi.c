/* Ranks of MPI (3.0 or later). Waiting is a loop of tests, in which a rank also hears that another one has failed: a
 * message of its own kind, for which a receive stands open from the beginning. */
#include "log.h"
#include "memory.h"
#include "ranks.h"
#include <limits.h>
#include <mpi.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    SENTENCE_ROOM = 2000,
    ALARM_TAG = 1, /* of its own communicator */
    TAGS = 30000,  /* MPI promises 32767 */
    PATIENT_POLLS = 200,
    PIECE = 1 << 30 /* bytes of one message of a gather or broadcast */
};
#define LATE_S 10.0    /* how long a rank that failed waits for rank 0 to say so */
#define TOLD_S 0.2     /* ... and for its alarms to leave */
#define ANSWER_S 8.0   /* how long a wait may last once a signal has come */
#define SLEEP_US 2000u /* between looks, where nothing is computed any more */

/* What the first rank that failed says. */
typedef struct alarm_message {
    int32_t status, rank;
    char sentence[SENTENCE_ROOM];
} alarm_message;

/* In memory that the ranks of a machine share. */
typedef struct node_table {
    atomic_int said; /* one of them has printed, or prints, why all end */
    struct {
        atomic_int pid; /* 0: left in order */
        int rank;
    } of[];
} node_table;

static struct {
    brc_ranks_place here;
    MPI_Comm all, alarms;
    MPI_Request alarm;
    alarm_message heard; /* received */
    alarm_message apart; /* status BRC_OK: all are together */
    brc_status agreed;   /* last failure that all have agreed on */
    MPI_Win window;
    node_table *node;
    int tag;
    unsigned delay_us, latency_us; /* for tests: messages leave late by up to this, and take so long at least */
    uint64_t draw;
    brc_ranks_cost cost;
    char name[MPI_MAX_PROCESSOR_NAME], engine[MPI_MAX_LIBRARY_VERSION_STRING];
} ranks = {.here = {.count = 1, .local_count = 1}};
static volatile sig_atomic_t signalled;

brc_ranks_place brc_ranks_here(void)
{
    return ranks.here;
}

brc_ranks_cost brc_ranks_cost_so_far(void)
{
    return ranks.cost;
}

/* ---- failures ---- */

static void set_sentence(brc_context *context, alarm_message *out, brc_status status)
{
    const char *own = brc_context_message(context);
    *out = (alarm_message){.status = (int32_t)status, .rank = ranks.here.mine};
    snprintf(out->sentence, sizeof out->sentence, "rank %d: %s", ranks.here.mine, *own ? own : brc_status_text(status));
    brc_context_clear(context);
    (void)BRC_FAIL(context, status, "%s", out->sentence);
}

/* What calls return while the ranks are apart. */
static brc_status say_apart(brc_context *context)
{
    const brc_status status = (brc_status)ranks.apart.status;
    if (status != BRC_OK && !strstr(brc_context_message(context), ranks.apart.sentence))
        return BRC_FAIL(context, status, "%s", ranks.apart.sentence);
    return status;
}

void brc_ranks_fail(brc_context *context, brc_status status)
{
    if (status == BRC_OK || ranks.here.count == 1 || ranks.apart.status != BRC_OK) return;
    set_sentence(context, &ranks.apart, status);
    MPI_Request *sent = calloc((size_t)ranks.here.count, sizeof(MPI_Request));
    int n = 0, done = 0;
    for (int k = 0; sent && k < ranks.here.count; ++k)
        if (k != ranks.here.mine)
            MPI_Isend(&ranks.apart, sizeof ranks.apart, MPI_BYTE, k, ALARM_TAG, ranks.alarms, &sent[n++]);
    for (const double start = brc_clock_s(); sent && !done && brc_clock_s() - start < TOLD_S;)
        if (MPI_Testall(n, sent, &done, MPI_STATUSES_IGNORE) != MPI_SUCCESS) break;
    free(sent); /* requests that have not ended stay MPI's */
}

static brc_status check(brc_context *context, int code, const char *what)
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
static brc_status enter(brc_context *context)
{
    ranks.draw = ranks.draw * 6364136223846793005u + 1442695040888963407u;
    if (ranks.delay_us > 0) usleep((unsigned)((ranks.draw >> 33) % (ranks.delay_us + 1)));
    return say_apart(context);
}

static brc_status hear_alarm(brc_context *context)
{
    int heard = 0;
    BRC_TRY(check(context, MPI_Test(&ranks.alarm, &heard, MPI_STATUS_IGNORE), "listening"));
    if (heard) ranks.apart = ranks.heard;
    return say_apart(context);
}

/* Until all requests are done; the seconds are added to *waited_s. */
static brc_status wait_for(brc_context *context, int n, MPI_Request *requests, const char *what, double *waited_s)
{
    const double start = brc_clock_s();
    brc_status status = BRC_OK;
    int done = 0;
    for (int64_t polls = 0; status == BRC_OK; ++polls) {
        status = check(context, MPI_Testall(n, requests, &done, MPI_STATUSES_IGNORE), what);
        if (done || status != BRC_OK) break;
        if (polls % 16 == 15) status = hear_alarm(context);
        if (polls > PATIENT_POLLS) sched_yield();
        if (status == BRC_OK && signalled && brc_clock_s() - start > ANSWER_S) {
            status = BRC_FAIL(context, BRC_INTERRUPTED, "a signal came, and the other ranks do not answer");
            brc_ranks_fail(context, status);
        }
    }
    *waited_s += brc_clock_s() - start;
    return status;
}

/* A call of all ranks that was begun with `code`. */
static brc_status complete(brc_context *context, int code, MPI_Request *request, const char *what)
{
    BRC_TRY(check(context, code, what));
    ++ranks.cost.calls;
    return wait_for(context, 1, request, what, &ranks.cost.call_wait_s);
}

brc_status brc_ranks_agree(brc_context *context, brc_status status)
{
    int64_t first = status == BRC_OK ? INT64_MAX : ranks.here.mine;
    alarm_message message = {0};
    if (ranks.here.count == 1) return status;
    BRC_TRY(brc_ranks_reduce(context, BRC_LEAST, 1, &first));
    if (first == INT64_MAX) return BRC_OK;
    if (first == ranks.here.mine) set_sentence(context, &message, status);
    BRC_TRY(brc_ranks_broadcast(context, (int32_t)first, &message, sizeof message));
    ranks.agreed = (brc_status)message.status;
    if (first == ranks.here.mine) return ranks.agreed;
    brc_context_clear(context);
    return BRC_FAIL(context, ranks.agreed, "%s", message.sentence);
}

/* ---- beginning and end ---- */

static void share_table(void)
{
    MPI_Comm node;
    MPI_Aint bytes = 0;
    int unit;
    MPI_Comm_split_type(ranks.all, MPI_COMM_TYPE_SHARED, ranks.here.mine, MPI_INFO_NULL, &node);
    MPI_Comm_rank(node, &ranks.here.local);
    MPI_Comm_size(node, &ranks.here.local_count);
    int most = ranks.here.local_count;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, ranks.all);
    ranks.here.far = most < ranks.here.count || ranks.latency_us > 0;
    if (ranks.here.local == 0)
        bytes = (MPI_Aint)(sizeof(node_table) + (size_t)ranks.here.local_count * sizeof ranks.node->of[0]);
    MPI_Win_allocate_shared(bytes, 1, MPI_INFO_NULL, node, &ranks.node, &ranks.window);
    MPI_Win_shared_query(ranks.window, 0, &bytes, &unit, &ranks.node);
    if (ranks.here.local == 0) atomic_store(&ranks.node->said, 0);
    ranks.node->of[ranks.here.local].rank = ranks.here.mine;
    atomic_store(&ranks.node->of[ranks.here.local].pid, getpid());
    MPI_Barrier(node);
    MPI_Comm_free(&node);
}

brc_status brc_ranks_start(brc_context *context, int *argc, char ***argv)
{
    const char *delay = getenv("BRECCIA_RANKS_DELAY_US");
    int provided, length;
    if (MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS || provided < MPI_THREAD_FUNNELED)
        return BRC_FAIL(context, BRC_INTERNAL, "MPI cannot be started with threads; use a build of it that can");
    MPI_Comm_dup(MPI_COMM_WORLD, &ranks.all);
    MPI_Comm_dup(MPI_COMM_WORLD, &ranks.alarms);
    MPI_Comm_set_errhandler(ranks.all, MPI_ERRORS_RETURN);
    MPI_Comm_set_errhandler(ranks.alarms, MPI_ERRORS_RETURN);
    MPI_Comm_rank(ranks.all, &ranks.here.mine);
    MPI_Comm_size(ranks.all, &ranks.here.count);
    ranks.here.node = ranks.name;
    ranks.here.engine = ranks.engine;
    MPI_Get_processor_name(ranks.name, &length);
    MPI_Get_library_version(ranks.engine, &length);
    ranks.engine[strcspn(ranks.engine, ",\n")] = '\0';
    if (delay) (void)sscanf(delay, "%u,%u", &ranks.delay_us, &ranks.latency_us);
    ranks.draw = (uint64_t)getpid();
    if (ranks.here.count == 1) return BRC_OK;
    share_table();
    MPI_Irecv(&ranks.heard, sizeof ranks.heard, MPI_BYTE, MPI_ANY_SOURCE, ALARM_TAG, ranks.alarms, &ranks.alarm);
    if (ranks.here.mine == 0) return BRC_OK;
    brc_log_set_level(context, BRC_LOG_ERROR);
    return freopen("/dev/null", "w", stdout) ? BRC_OK : BRC_FAIL(context, BRC_FILE_FAILED, "no /dev/null to write to");
}

/* The first of this machine to ask may print why all end. */
static bool may_speak(void)
{
    return atomic_exchange(&ranks.node->said, 1) == 0;
}

brc_status brc_ranks_end(brc_context *context, brc_status status, bool *speaks)
{
    *speaks = ranks.here.mine == 0;
    if (ranks.here.count == 1) return status;
    if (status != BRC_OK && status != ranks.agreed) brc_ranks_fail(context, status);
    if (ranks.apart.status == BRC_OK && brc_ranks_barrier(context) == BRC_OK) return status;
    (void)say_apart(context);
    for (const double start = brc_clock_s(); ranks.here.mine != 0 && brc_clock_s() - start < LATE_S;)
        usleep(SLEEP_US); /* rank 0 ends this */
    *speaks = may_speak();
    return (brc_status)ranks.apart.status;
}

void brc_ranks_leave(int exit_code)
{
    if (ranks.apart.status != BRC_OK) MPI_Abort(MPI_COMM_WORLD, exit_code);
    if (ranks.here.count > 1) {
        atomic_store(&ranks.node->of[ranks.here.local].pid, 0);
        ranks.node = NULL; /* a signal may still come */
        MPI_Cancel(&ranks.alarm);
        MPI_Wait(&ranks.alarm, MPI_STATUS_IGNORE);
        MPI_Win_free(&ranks.window);
    }
    MPI_Finalize();
}

bool brc_ranks_signal_is_loss(void)
{
    char sentence[200];
    signalled = 1;
    if (!ranks.node) return false;
    if (atomic_load(&ranks.node->said)) return true;
    for (int k = 0; k < ranks.here.local_count; ++k) {
        const int pid = atomic_load(&ranks.node->of[k].pid);
        if (pid == 0 || kill(pid, 0) == 0) continue;
        const int length = snprintf(sentence, sizeof sentence,
                                    "rank %d is gone without a word (killed, or out of memory); "
                                    "a run with checkpoints goes on with --resume\n",
                                    ranks.node->of[k].rank);
        if (may_speak() && write(STDERR_FILENO, sentence, (size_t)length) < 0) return true;
        return true;
    }
    return false;
}

/* ---- exchange with neighbours ---- */

struct brc_exchange {
    int n; /* requests */
    MPI_Request *request;
    int64_t messages, bytes; /* sent each time */
    double begun_s;
};

static brc_status make_requests(brc_context *context, int32_t n, const brc_neighbour *neighbours, brc_exchange *x)
{
    BRC_TRY(BRC_ALLOCATE(context, &x->request, 2 * n, "requests of an exchange"));
    for (int32_t k = 0; k < n; ++k) {
        const brc_neighbour *b = &neighbours[k];
        if (b->send_bytes > INT_MAX || b->receive_bytes > INT_MAX || b->rank == ranks.here.mine)
            return BRC_FAIL(context, BRC_INTERNAL, "rank %d cannot exchange %lld and %lld bytes with rank %d",
                            ranks.here.mine, (long long)b->send_bytes, (long long)b->receive_bytes, (int)b->rank);
        if (b->receive_bytes > 0)
            BRC_TRY(check(context,
                          MPI_Recv_init(b->receive, (int)b->receive_bytes, MPI_BYTE, b->rank, ranks.tag, ranks.all,
                                        &x->request[x->n]),
                          "an exchange"));
        x->n += b->receive_bytes > 0;
    }
    for (int32_t k = 0; k < n; ++k) {
        const brc_neighbour *b = &neighbours[k];
        if (b->send_bytes == 0) continue;
        BRC_TRY(check(
            context,
            MPI_Send_init(b->send, (int)b->send_bytes, MPI_BYTE, b->rank, ranks.tag, ranks.all, &x->request[x->n]),
            "an exchange"));
        ++x->n, ++x->messages;
        x->bytes += b->send_bytes;
    }
    return BRC_OK;
}

brc_status brc_exchange_create(brc_context *context, int32_t n, const brc_neighbour *neighbours, brc_exchange **out)
{
    *out = NULL;
    ranks.tag = ranks.tag % TAGS + 1;
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "exchange"));
    const brc_status status = make_requests(context, n, neighbours, *out);
    if (status != BRC_OK) brc_exchange_free(out);
    return status;
}

void brc_exchange_free(brc_exchange **exchange)
{
    if (!exchange || !*exchange) return;
    for (int k = 0; k < (*exchange)->n; ++k)
        MPI_Request_free(&(*exchange)->request[k]);
    brc_memory_free((*exchange)->request);
    brc_memory_free(*exchange);
    *exchange = NULL;
}

brc_status brc_exchange_begin(brc_context *context, brc_exchange *exchange)
{
    BRC_TRY(enter(context));
    exchange->begun_s = brc_clock_s();
    ranks.cost.messages += exchange->messages;
    ranks.cost.bytes += exchange->bytes;
    return exchange->n > 0 ? check(context, MPI_Startall(exchange->n, exchange->request), "an exchange") : BRC_OK;
}

brc_status brc_exchange_poke(brc_context *context, brc_exchange *exchange)
{
    int done;
    return check(context, MPI_Testall(exchange->n, exchange->request, &done, MPI_STATUSES_IGNORE), "an exchange");
}

brc_status brc_exchange_finish(brc_context *context, brc_exchange *exchange)
{
    BRC_TRY(enter(context));
    const double now = brc_clock_s(), left = exchange->begun_s + 1e-6 * ranks.latency_us - now;
    ++ranks.cost.exchanges;
    ranks.cost.flight_s += now - exchange->begun_s;
    if (left > 0) usleep((unsigned)(1e6 * left));
    ranks.cost.exchange_wait_s += brc_clock_s() - now;
    return wait_for(context, exchange->n, exchange->request, "an exchange", &ranks.cost.exchange_wait_s);
}

/* ---- of all ranks ---- */

brc_status brc_ranks_gather_all(brc_context *context, const void *mine, int64_t size, const int64_t *n_of, void *all)
{
    int *n = NULL, *first = NULL;
    int64_t sum = 0;
    MPI_Datatype item = MPI_DATATYPE_NULL;
    MPI_Request request;
    brc_status status = enter(context);
    if (status != BRC_OK) return status;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &n, ranks.here.count, "what ranks send"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &first, ranks.here.count, "what ranks send"));
    for (int k = 0; k < ranks.here.count; sum += n_of[k++]) {
        if (sum + n_of[k] > INT_MAX || size > INT_MAX) {
            status = BRC_FAIL(context, BRC_INTERNAL, "more than %d items are gathered", INT_MAX);
            goto cleanup;
        }
        n[k] = (int)n_of[k];
        first[k] = (int)sum;
    }
    MPI_Type_contiguous((int)size, MPI_BYTE, &item);
    MPI_Type_commit(&item);
    const bool in_place = mine == (char *)all + size * first[ranks.here.mine];
    status = complete(context,
                      MPI_Iallgatherv(in_place ? MPI_IN_PLACE : mine, n[ranks.here.mine], item, all, n, first, item,
                                      ranks.all, &request),
                      &request, "a gather");
cleanup:
    if (item != MPI_DATATYPE_NULL) MPI_Type_free(&item);
    brc_memory_free(n);
    brc_memory_free(first);
    return status;
}

static int64_t pieces_of(int64_t bytes)
{
    return (bytes + PIECE - 1) / PIECE;
}

/* Requests that send (or receive) bytes in pieces; returns their number. */
static int64_t begin_pieces(bool sends, int rank, char *data, int64_t bytes, MPI_Request *request, int *code)
{
    int64_t n = 0;
    for (int64_t at = 0; at < bytes && *code == MPI_SUCCESS; at += PIECE, ++n) {
        const int some = (int)(bytes - at < PIECE ? bytes - at : PIECE);
        *code = sends ? MPI_Isend(data + at, some, MPI_BYTE, rank, 0, ranks.all, &request[n])
                      : MPI_Irecv(data + at, some, MPI_BYTE, rank, 0, ranks.all, &request[n]);
    }
    return n;
}

/* send [count] to and receive [count] from every other rank, each a run of bytes in rank order. */
static brc_status move_all(brc_context *context, const void *send, const int64_t *send_bytes, void *receive,
                           const int64_t *receive_bytes)
{
    char *from = (char *)(uintptr_t)send, *to = receive;
    MPI_Request *request = NULL;
    int64_t room = 0, n = 0;
    int code = MPI_SUCCESS;
    for (int k = 0; k < ranks.here.count; ++k)
        room += pieces_of(send_bytes[k]) + pieces_of(receive_bytes[k]);
    BRC_TRY(BRC_ALLOCATE(context, &request, room, "requests of ranks"));
    for (int k = 0; k < ranks.here.count; to += receive_bytes[k++])
        if (k != ranks.here.mine) n += begin_pieces(false, k, to, receive_bytes[k], request + n, &code);
    to = receive;
    for (int k = 0; k < ranks.here.mine; ++k)
        to += receive_bytes[k];
    for (int k = 0; k < ranks.here.count; from += send_bytes[k++])
        if (k != ranks.here.mine)
            n += begin_pieces(true, k, from, send_bytes[k], request + n, &code);
        else if (receive_bytes[k] > 0)
            memmove(to, from, (size_t)receive_bytes[k]);
    brc_status status = check(context, code, "sending");
    ++ranks.cost.calls;
    if (status == BRC_OK) status = wait_for(context, (int)n, request, "sending", &ranks.cost.call_wait_s);
    brc_memory_free(request);
    return status;
}

brc_status brc_ranks_gather_first(brc_context *context, const void *mine, const int64_t *bytes_of, void *all)
{
    int64_t *send = NULL, *none = NULL;
    brc_status status = enter(context);
    if (status != BRC_OK) return status;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &send, ranks.here.count, "what ranks send"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &none, ranks.here.count, "what ranks send"));
    send[0] = bytes_of[ranks.here.mine];
    status = move_all(context, mine, send, all, ranks.here.mine == 0 ? bytes_of : none);
cleanup:
    brc_memory_free(send);
    brc_memory_free(none);
    return status;
}

brc_status brc_ranks_broadcast(brc_context *context, int32_t from, void *data, int64_t bytes)
{
    MPI_Request request;
    BRC_TRY(enter(context));
    if (ranks.here.count == 1) return BRC_OK;
    for (int64_t at = 0; at < bytes; at += PIECE) {
        const int some = (int)(bytes - at < PIECE ? bytes - at : PIECE);
        BRC_TRY(complete(context, MPI_Ibcast((char *)data + at, some, MPI_BYTE, from, ranks.all, &request), &request,
                         "a broadcast"));
    }
    return BRC_OK;
}

brc_status brc_ranks_trade(brc_context *context, const void *send, const int64_t *send_bytes, void **received,
                           int64_t *receive_bytes)
{
    MPI_Request request;
    int64_t sum = 0;
    *received = NULL;
    BRC_TRY(enter(context));
    BRC_TRY(complete(context,
                     MPI_Ialltoall(send_bytes, 1, MPI_INT64_T, receive_bytes, 1, MPI_INT64_T, ranks.all, &request),
                     &request, "a trade"));
    for (int k = 0; k < ranks.here.count; ++k)
        sum += receive_bytes[k];
    BRC_TRY(brc_memory_allocate(context, received, sum, 1, "what ranks send"));
    return move_all(context, send, send_bytes, *received, receive_bytes);
}

brc_status brc_ranks_reduce(brc_context *context, brc_reduction reduction, int64_t n, int64_t *values)
{
    const MPI_Op of[] = {[BRC_SUM] = MPI_SUM, [BRC_LEAST] = MPI_MIN, [BRC_MOST] = MPI_MAX, [BRC_ANY_BIT] = MPI_BOR};
    MPI_Request request;
    BRC_TRY(enter(context));
    if (ranks.here.count == 1) return BRC_OK;
    return complete(context,
                    MPI_Iallreduce(MPI_IN_PLACE, values, (int)n, MPI_INT64_T, of[reduction], ranks.all, &request),
                    &request, "a reduction");
}

brc_status brc_ranks_barrier(brc_context *context)
{
    MPI_Request request;
    BRC_TRY(enter(context));
    if (ranks.here.count == 1) return BRC_OK;
    return complete(context, MPI_Ibarrier(ranks.all, &request), &request, "a barrier");
}
