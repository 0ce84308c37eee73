/* A program that only sends: what every function of ranks.h promises, and ranks that fail.
 *
 *     transport check [MACHINES]  all of it, with answers that are known, on one machine or as many
 *     transport loop SECONDS      exchanges and reductions; each rank first writes "pid RANK PID" to stderr
 *     transport fail RANK         ... in the midst of which a rank fails
 *     transport fail-all          ... in which all fail at the same place, each for itself
 *     transport refuse RANK       one rank has something against it, and all agree
 */
#include "../../host/base/log.h"
#include "../../host/base/machine_memory.h"
#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define EXPECT(condition)                                                                                              \
    do {                                                                                                               \
        if (!(condition)) return BRC_FAIL(context, BRC_INTERNAL, "line %d: not so: %s", __LINE__, #condition);         \
    } while (0)

enum { MOST = 16, LONGEST = 200000, ROUNDS = 20 };

/* Byte i of what rank `from` sends to rank `to` in a round. */
static unsigned char sent_byte(int from, int to, int round, int64_t i)
{
    return (unsigned char)(31 * from + 17 * to + 7 * round + i * 13);
}

/* Bytes from one rank to another: also none, one, and more than an eager message. */
static int64_t sent_bytes(int from, int to)
{
    const int64_t lengths[] = {0, 1, 100, 5000, LONGEST};
    return from == to ? 0 : lengths[(3 * from + to) % 5];
}

typedef struct pair {
    int n;
    unsigned char *out[MOST], *in[MOST];
    brc_neighbour neighbour[MOST];
    brc_exchange *exchange;
} pair;

static brc_status make_exchange(brc_context *context, pair *p)
{
    const int mine = brc_ranks_mine();
    memset(p, 0, sizeof *p);
    for (int k = 0; k < brc_ranks_count(); ++k) {
        if (k == mine) continue;
        BRC_TRY(BRC_ALLOCATE(context, &p->out[p->n], LONGEST, "out"));
        BRC_TRY(BRC_ALLOCATE(context, &p->in[p->n], LONGEST, "in"));
        p->neighbour[p->n] = (brc_neighbour){k, p->out[p->n], sent_bytes(mine, k), p->in[p->n], sent_bytes(k, mine)};
        ++p->n;
    }
    return brc_exchange_create(context, p->n, p->neighbour, &p->exchange);
}

static void free_exchange(pair *p)
{
    brc_exchange_free(&p->exchange);
    for (int k = 0; k < p->n; ++k) {
        brc_memory_free(p->out[k]);
        brc_memory_free(p->in[k]);
    }
}

static brc_status begin(brc_context *context, pair *p, int round)
{
    for (int k = 0; k < p->n; ++k)
        for (int64_t i = 0; i < p->neighbour[k].send_bytes; ++i)
            p->out[k][i] = sent_byte(brc_ranks_mine(), p->neighbour[k].rank, round, i);
    return brc_exchange_begin(context, p->exchange);
}

static brc_status finish(brc_context *context, pair *p, int round)
{
    BRC_TRY(brc_exchange_finish(context, p->exchange));
    for (int k = 0; k < p->n; ++k)
        for (int64_t i = 0; i < p->neighbour[k].receive_bytes; ++i)
            EXPECT(p->in[k][i] == sent_byte(p->neighbour[k].rank, brc_ranks_mine(), round, i));
    return BRC_OK;
}

/* Two exchanges at once, ended in the other order. */
static brc_status check_exchanges(brc_context *context)
{
    pair one, other;
    BRC_TRY(make_exchange(context, &one));
    BRC_TRY(make_exchange(context, &other));
    const brc_ranks_cost before = brc_ranks_cost_so_far();
    int64_t bytes = 0, messages = 0;
    for (int k = 0; k < one.n; ++k) {
        bytes += one.neighbour[k].send_bytes;
        messages += one.neighbour[k].send_bytes > 0;
    }
    for (int round = 0; round < ROUNDS; ++round) {
        BRC_TRY(begin(context, &one, round));
        BRC_TRY(begin(context, &other, 100 + round));
        BRC_TRY(finish(context, &other, 100 + round));
        BRC_TRY(finish(context, &one, round));
    }
    const brc_ranks_cost after = brc_ranks_cost_so_far();
    EXPECT(after.bytes - before.bytes == 2 * ROUNDS * bytes);
    EXPECT(after.messages - before.messages == 2 * ROUNDS * messages);
    EXPECT(brc_ranks_count() == 1 || after.exchanges - before.exchanges == 2 * ROUNDS);
    free_exchange(&one);
    free_exchange(&other);
    return BRC_OK;
}

static brc_status check_gathers(brc_context *context)
{
    enum { SIZE = 3 };
    const int mine = brc_ranks_mine(), n = brc_ranks_count();
    int64_t n_of[MOST], first = 0, all = 0;
    unsigned char own[SIZE * MOST], place[SIZE * MOST * MOST];
    for (int k = 0; k < n; all += n_of[k++]) {
        n_of[k] = (k + 1) % 3 == 0 ? 0 : k + 1;
        if (k < mine) first += n_of[k];
    }
    for (int64_t i = 0; i < SIZE * n_of[mine]; ++i)
        own[i] = sent_byte(mine, 0, 0, i);
    for (int in_place = 0; in_place < 2; ++in_place) {
        memset(place, 0, sizeof place);
        if (in_place) memcpy(place + SIZE * first, own, (size_t)(SIZE * n_of[mine]));
        BRC_TRY(brc_ranks_gather_all(context, in_place ? place + SIZE * first : own, SIZE, n_of, place));
        const unsigned char *at = place;
        for (int k = 0; k < n; at += SIZE * n_of[k++])
            for (int64_t i = 0; i < SIZE * n_of[k]; ++i)
                EXPECT(at[i] == sent_byte(k, 0, 0, i));
    }
    memset(place, 0, sizeof place);
    BRC_TRY(brc_ranks_gather_first(context, own, n_of, place));
    const unsigned char *at = place;
    for (int k = 0; mine == 0 && k < n; at += n_of[k++])
        for (int64_t i = 0; i < n_of[k]; ++i)
            EXPECT(at[i] == sent_byte(k, 0, 0, i));
    return BRC_OK;
}

static brc_status check_trade(brc_context *context)
{
    const int mine = brc_ranks_mine(), n = brc_ranks_count();
    int64_t send[MOST], receive[MOST], bytes = 0;
    unsigned char *out = NULL, *in = NULL;
    for (int k = 0; k < n; ++k)
        bytes += send[k] = k == mine ? 10 : sent_bytes(mine, k);
    BRC_TRY(BRC_ALLOCATE(context, &out, bytes, "out"));
    for (int64_t k = 0, at = 0; k < n; at += send[k++])
        for (int64_t i = 0; i < send[k]; ++i)
            out[at + i] = sent_byte(mine, (int)k, 5, i);
    BRC_TRY(brc_ranks_trade(context, out, send, (void **)&in, receive));
    for (int64_t k = 0, at = 0; k < n; at += receive[k++]) {
        EXPECT(receive[k] == (k == mine ? 10 : sent_bytes((int)k, mine)));
        for (int64_t i = 0; i < receive[k]; ++i)
            EXPECT(in[at + i] == sent_byte((int)k, mine, 5, i));
    }
    brc_memory_free(out);
    brc_memory_free(in);
    return BRC_OK;
}

static brc_status check_reductions(brc_context *context)
{
    const int mine = brc_ranks_mine(), n = brc_ranks_count();
    int64_t sum[2] = {mine, 1}, least = 5 - mine, most = mine - 5, bits = (int64_t)1 << mine;
    BRC_TRY(brc_ranks_reduce(context, BRC_SUM, 2, sum));
    BRC_TRY(brc_ranks_reduce(context, BRC_LEAST, 1, &least));
    BRC_TRY(brc_ranks_reduce(context, BRC_MOST, 1, &most));
    BRC_TRY(brc_ranks_reduce(context, BRC_ANY_BIT, 1, &bits));
    EXPECT(sum[0] == n * (n - 1) / 2 && sum[1] == n);
    EXPECT(least == 6 - n && most == n - 6 && bits == ((int64_t)1 << n) - 1);
    const bool last = mine == n - 1;
    double low[4] = {-1.5 - mine, 1e-310 * (mine + 1), last ? -0.0 : 0.0, last ? 2.0 : (double)NAN};
    double high[4] = {-1.5 - mine, 1e300 * (mine + 1), last ? 0.0 : -0.0, last ? (double)NAN : 2.0};
    BRC_TRY(brc_ranks_least(context, 4, low));
    BRC_TRY(brc_ranks_most(context, 4, high));
    EXPECT(low[0] == -0.5 - n && low[1] == 1e-310 && low[2] == 0 && signbit(low[2]) && low[3] == 2);
    EXPECT(high[0] == -1.5 && high[1] == 1e300 * n && high[2] == 0 && !signbit(high[2]) && isnan(high[3]));
    char text[3000];
    memset(text, mine, sizeof text);
    BRC_TRY(brc_ranks_broadcast(context, n - 1, text, sizeof text));
    for (size_t i = 0; i < sizeof text; ++i)
        EXPECT(text[i] == n - 1);
    return brc_ranks_barrier(context);
}

/* Every part of a machine's memory is written by one of its ranks, and seen by all; what is laid is each one's own. */
static brc_status check_common_memory(brc_context *context)
{
    enum { N = 100000 };
    brc_common_memory all;
    const brc_ranks_place here = brc_ranks_here();
    BRC_TRY(brc_common_memory_begin(context, N * (int64_t)sizeof(int32_t), &all));
    EXPECT(all.part == here.local && all.parts == here.local_count);
    int32_t *const number = all.data;
    for (int32_t k = N * all.part / all.parts; k < N * (all.part + 1) / all.parts; ++k)
        number[k] += k + 1; /* from 0, once */
    BRC_TRY(brc_ranks_agree(context, BRC_OK));
    for (int32_t k = 0; k < N; ++k)
        EXPECT(number[k] == k + 1);
    void *const at = mmap(NULL, (size_t)all.bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    const bool laid = brc_common_memory_lay(&all, at);
    EXPECT(at != MAP_FAILED && laid == (here.count > 1)); /* a rank alone has a block */
    BRC_TRY(brc_ranks_barrier(context));
    if (laid) ((int32_t *)at)[here.local] = -1;
    BRC_TRY(brc_ranks_barrier(context));
    for (int32_t k = 0; k < N; ++k)
        EXPECT(number[k] == k + 1 && (!laid || ((int32_t *)at)[k] == (k == here.local ? -1 : k + 1)));
    brc_common_memory_free(&all);
    brc_common_memory_free(&all); /* of nothing is allowed */
    EXPECT(!laid || ((int32_t *)at)[N - 1] == N);
    EXPECT(munmap(at, N * sizeof(int32_t)) == 0);
    return BRC_OK;
}

/* The first ranks of machines among themselves. */
static brc_status check_firsts(brc_context *context, int machines)
{
    const brc_ranks_place whole = brc_ranks_here();
    int64_t sum = whole.mine;
    if (whole.local == 0) {
        brc_ranks_narrow();
        const brc_ranks_place place = brc_ranks_here();
        int64_t firsts[2] = {whole.mine, 1}, before = place.mine;
        EXPECT(place.count == machines && place.local == 0 && place.local_count == 1);
        BRC_TRY(brc_ranks_reduce(context, BRC_SUM, 2, firsts));
        BRC_TRY(brc_ranks_broadcast(context, machines - 1, &before, sizeof before));
        brc_ranks_widen();
        EXPECT(firsts[1] == machines && before == machines - 1);
        EXPECT(machines > 1 || firsts[0] == 0);
    }
    EXPECT(brc_ranks_mine() == whole.mine && brc_ranks_count() == whole.count);
    BRC_TRY(brc_ranks_reduce(context, BRC_SUM, 1, &sum));
    EXPECT(sum == (int64_t)whole.count * (whole.count - 1) / 2);
    return BRC_OK;
}

static brc_status check_place(brc_context *context, int machines)
{
    const brc_ranks_place place = brc_ranks_here();
    EXPECT(place.mine >= 0 && place.mine < place.count && place.node[0] && place.engine[0]);
    int64_t firsts = place.local == 0, local = place.local_count;
    BRC_TRY(brc_ranks_reduce(context, BRC_SUM, 1, &firsts));
    BRC_TRY(brc_ranks_reduce(context, BRC_MOST, 1, &local));
    EXPECT(firsts == machines && place.local < place.local_count && local == (place.count + machines - 1) / machines);
    EXPECT(place.far == (machines > 1));
    EXPECT(machines > 1 || (place.local == place.mine && place.local_count == place.count));
    if (place.mine == 0) printf("%d ranks of %s on %s: all well\n", place.count, place.engine, place.node);
    return BRC_OK;
}

static brc_status check(brc_context *context, int machines)
{
    BRC_TRY(check_exchanges(context));
    BRC_TRY(check_gathers(context));
    BRC_TRY(check_trade(context));
    BRC_TRY(check_reductions(context));
    BRC_TRY(check_common_memory(context));
    BRC_TRY(check_firsts(context, machines));
    return check_place(context, machines);
}

static volatile sig_atomic_t interrupted;

/* Until the seconds are over or someone was interrupted, which all learn; `fails`: rank, -2: all of them, -1: none. */
static brc_status loop(brc_context *context, double seconds, int fails)
{
    pair p;
    BRC_TRY(make_exchange(context, &p));
    const double start = brc_clock_s();
    int64_t over = 0;
    for (int round = 0; !over; ++round) {
        BRC_TRY(begin(context, &p, round));
        if (round == ROUNDS && (fails == brc_ranks_mine() || fails == -2)) {
            const brc_status status = BRC_FAIL(context, BRC_FILE_FAILED, "no room in round %d", round);
            brc_ranks_fail(context, status);
            return status;
        }
        BRC_TRY(finish(context, &p, round));
        over = (brc_clock_s() - start > seconds ? 1 : 0) | (interrupted ? 2 : 0);
        BRC_TRY(brc_ranks_reduce(context, BRC_ANY_BIT, 1, &over));
    }
    free_exchange(&p);
    return brc_ranks_agree(context, over & 2 ? BRC_FAIL(context, BRC_INTERRUPTED, "interrupted") : BRC_OK);
}

static brc_status run(brc_context *context, int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "check";
    const double number = argc > 2 ? strtod(argv[2], NULL) : 0;
    if (strcmp(what, "check") == 0) return check(context, number > 0 ? (int)number : 1);
    if (strcmp(what, "loop") == 0) {
        fprintf(stderr, "pid %d %d\n", (int)brc_ranks_mine(), (int)getpid());
        return loop(context, number, -1);
    }
    if (strcmp(what, "fail") == 0) return loop(context, 60, (int)number);
    if (strcmp(what, "fail-all") == 0) return loop(context, 60, -2);
    if (strcmp(what, "refuse") == 0)
        return brc_ranks_agree(
            context, brc_ranks_mine() >= (int)number ? BRC_FAIL(context, BRC_BAD_INPUT, "not with me") : BRC_OK);
    return BRC_FAIL(context, BRC_BAD_INPUT, "what is %s?", what);
}

static void on_signal(int number)
{
    (void)number;
    if (brc_ranks_signal_is_loss()) _exit(3);
    interrupted = 1;
}

int main(int argc, char **argv)
{
    bool speaks = true;
    brc_context *context = brc_context_create();
    signal(SIGINT, on_signal);
    signal(SIGTERM, on_signal);
    signal(SIGUSR2, on_signal);
    brc_status status = brc_ranks_start(context, &argc, &argv);
    if (status == BRC_OK) status = run(context, argc, argv);
    fflush(stdout);
    status = brc_ranks_end(context, status, &speaks);
    if (status != BRC_OK && speaks) fprintf(stderr, "%s\n", brc_context_message(context));
    brc_context_free(&context);
    brc_ranks_leave(brc_status_exit_code(status));
    return brc_status_exit_code(status);
}
