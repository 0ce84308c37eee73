/* One rank: nobody to send to. */
#include "memory.h"
#include "ranks.h"
#include <string.h>
#include <unistd.h>

brc_status brc_ranks_start(brc_context *context, int *argc, char ***argv)
{
    (void)context, (void)argc, (void)argv;
    return BRC_OK;
}

brc_status brc_ranks_end(brc_context *context, brc_status status, bool *speaks)
{
    (void)context;
    *speaks = true;
    return status;
}

void brc_ranks_leave(int exit_code)
{
    (void)exit_code;
}

bool brc_ranks_signal_is_loss(void)
{
    return false;
}

brc_ranks_place brc_ranks_here(void)
{
    static char name[256];
    if (!name[0] && gethostname(name, sizeof name - 1)) name[0] = '-';
    return (brc_ranks_place){.count = 1, .local_count = 1, .node = name, .engine = "one rank"};
}

void brc_ranks_narrow(void)
{
}

void brc_ranks_widen(void)
{
}

void brc_ranks_fail(brc_context *context, brc_status status)
{
    (void)context, (void)status;
}

brc_status brc_ranks_agree(brc_context *context, brc_status status)
{
    (void)context;
    return status;
}

struct brc_exchange {
    int32_t n;
};

brc_status brc_exchange_create(brc_context *context, int32_t n, const brc_neighbour *neighbours, brc_exchange **out)
{
    *out = NULL;
    if (n > 0)
        return BRC_FAIL(context, BRC_INTERNAL, "an exchange with rank %d, of one rank alone", (int)neighbours[0].rank);
    return BRC_ALLOCATE(context, out, 1, "exchange");
}

void brc_exchange_free(brc_exchange **exchange)
{
    if (!exchange) return;
    brc_memory_free(*exchange);
    *exchange = NULL;
}

brc_status brc_exchange_begin(brc_context *context, brc_exchange *exchange)
{
    (void)context, (void)exchange;
    return BRC_OK;
}

brc_status brc_exchange_poke(brc_context *context, brc_exchange *exchange)
{
    (void)context, (void)exchange;
    return BRC_OK;
}

brc_status brc_exchange_finish(brc_context *context, brc_exchange *exchange)
{
    (void)context, (void)exchange;
    return BRC_OK;
}

brc_status brc_ranks_gather_all(brc_context *context, const void *mine, int64_t size, const int64_t *n_of, void *all)
{
    (void)context;
    if (mine != all && n_of[0] > 0) memcpy(all, mine, (size_t)(size * n_of[0]));
    return BRC_OK;
}

brc_status brc_ranks_gather_first(brc_context *context, const void *mine, const int64_t *bytes_of, void *all)
{
    return brc_ranks_gather_all(context, mine, 1, bytes_of, all);
}

brc_status brc_ranks_broadcast(brc_context *context, int32_t from, void *data, int64_t bytes)
{
    (void)context, (void)from, (void)data, (void)bytes;
    return BRC_OK;
}

brc_status brc_ranks_trade(brc_context *context, const void *send, const int64_t *send_bytes, void **received,
                           int64_t *receive_bytes)
{
    BRC_TRY(brc_memory_allocate(context, received, send_bytes[0], 1, "what ranks send"));
    receive_bytes[0] = send_bytes[0];
    if (send_bytes[0] > 0) memcpy(*received, send, (size_t)send_bytes[0]);
    return BRC_OK;
}

brc_status brc_ranks_reduce(brc_context *context, brc_reduction reduction, int64_t n, int64_t *values)
{
    (void)context, (void)reduction, (void)n, (void)values;
    return BRC_OK;
}

brc_status brc_ranks_barrier(brc_context *context)
{
    (void)context;
    return BRC_OK;
}

brc_ranks_cost brc_ranks_cost_so_far(void)
{
    return (brc_ranks_cost){0};
}
