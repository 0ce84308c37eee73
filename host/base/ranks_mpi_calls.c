/* What ranks of MPI send one another: exchanges with neighbours, and calls of all. */
#include "log.h"
#include "memory.h"
#include "ranks_mpi_internal.h"
#include <limits.h>
#include <string.h>
#include <unistd.h>

enum {
    TAGS = 30000,   /* MPI promises 32767 */
    PIECE = 1 << 30 /* bytes of one message of a gather or broadcast */
};

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
        if (b->send_bytes > INT_MAX || b->receive_bytes > INT_MAX || b->rank == brc_mpi.here.mine)
            return BRC_FAIL(context, BRC_INTERNAL, "rank %d cannot exchange %lld and %lld bytes with rank %d",
                            brc_mpi.here.mine, (long long)b->send_bytes, (long long)b->receive_bytes, (int)b->rank);
        if (b->receive_bytes > 0)
            BRC_TRY(brc_mpi_check(context,
                                  MPI_Recv_init(b->receive, (int)b->receive_bytes, MPI_BYTE, b->rank, brc_mpi.tag,
                                                brc_mpi.all, &x->request[x->n]),
                                  "an exchange"));
        x->n += b->receive_bytes > 0;
    }
    for (int32_t k = 0; k < n; ++k) {
        const brc_neighbour *b = &neighbours[k];
        if (b->send_bytes == 0) continue;
        BRC_TRY(brc_mpi_check(
            context,
            MPI_Send_init(b->send, (int)b->send_bytes, MPI_BYTE, b->rank, brc_mpi.tag, brc_mpi.all, &x->request[x->n]),
            "an exchange"));
        ++x->n, ++x->messages;
        x->bytes += b->send_bytes;
    }
    return BRC_OK;
}

brc_status brc_exchange_create(brc_context *context, int32_t n, const brc_neighbour *neighbours, brc_exchange **out)
{
    *out = NULL;
    brc_mpi.tag = brc_mpi.tag % TAGS + 1;
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
    BRC_TRY(brc_mpi_enter(context));
    exchange->begun_s = brc_clock_s();
    brc_mpi.cost.messages += exchange->messages;
    brc_mpi.cost.bytes += exchange->bytes;
    return exchange->n > 0 ? brc_mpi_check(context, MPI_Startall(exchange->n, exchange->request), "an exchange")
                           : BRC_OK;
}

brc_status brc_exchange_poke(brc_context *context, brc_exchange *exchange)
{
    int done;
    return brc_mpi_check(context, MPI_Testall(exchange->n, exchange->request, &done, MPI_STATUSES_IGNORE),
                         "an exchange");
}

brc_status brc_exchange_finish(brc_context *context, brc_exchange *exchange)
{
    BRC_TRY(brc_mpi_enter(context));
    const double now = brc_clock_s(), left = exchange->begun_s + 1e-6 * brc_mpi.latency_us - now;
    ++brc_mpi.cost.exchanges;
    brc_mpi.cost.flight_s += now - exchange->begun_s;
    if (left > 0) usleep((unsigned)(1e6 * left));
    brc_mpi.cost.exchange_wait_s += brc_clock_s() - now;
    return brc_mpi_wait(context, exchange->n, exchange->request, "an exchange", &brc_mpi.cost.exchange_wait_s);
}

/* ---- of all ranks ---- */

brc_status brc_ranks_gather_all(brc_context *context, const void *mine, int64_t size, const int64_t *n_of, void *all)
{
    int *n = NULL, *first = NULL;
    int64_t sum = 0;
    MPI_Datatype item = MPI_DATATYPE_NULL;
    MPI_Request request;
    brc_status status = brc_mpi_enter(context);
    if (status != BRC_OK) return status;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &n, brc_mpi.here.count, "what ranks send"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &first, brc_mpi.here.count, "what ranks send"));
    for (int k = 0; k < brc_mpi.here.count; sum += n_of[k++]) {
        if (sum + n_of[k] > INT_MAX || size > INT_MAX) {
            status = BRC_FAIL(context, BRC_INTERNAL, "more than %d items are gathered", INT_MAX);
            goto cleanup;
        }
        n[k] = (int)n_of[k];
        first[k] = (int)sum;
    }
    MPI_Type_contiguous((int)size, MPI_BYTE, &item);
    MPI_Type_commit(&item);
    const bool in_place = mine == (char *)all + size * first[brc_mpi.here.mine];
    status = brc_mpi_complete(context,
                              MPI_Iallgatherv(in_place ? MPI_IN_PLACE : mine, n[brc_mpi.here.mine], item, all, n, first,
                                              item, brc_mpi.all, &request),
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
        *code = sends ? MPI_Isend(data + at, some, MPI_BYTE, rank, 0, brc_mpi.all, &request[n])
                      : MPI_Irecv(data + at, some, MPI_BYTE, rank, 0, brc_mpi.all, &request[n]);
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
    for (int k = 0; k < brc_mpi.here.count; ++k)
        room += pieces_of(send_bytes[k]) + pieces_of(receive_bytes[k]);
    BRC_TRY(BRC_ALLOCATE(context, &request, room, "requests of ranks"));
    for (int k = 0; k < brc_mpi.here.count; to += receive_bytes[k++])
        if (k != brc_mpi.here.mine) n += begin_pieces(false, k, to, receive_bytes[k], request + n, &code);
    to = receive;
    for (int k = 0; k < brc_mpi.here.mine; ++k)
        to += receive_bytes[k];
    for (int k = 0; k < brc_mpi.here.count; from += send_bytes[k++])
        if (k != brc_mpi.here.mine)
            n += begin_pieces(true, k, from, send_bytes[k], request + n, &code);
        else if (receive_bytes[k] > 0)
            memmove(to, from, (size_t)receive_bytes[k]);
    brc_status status = brc_mpi_check(context, code, "sending");
    ++brc_mpi.cost.calls;
    if (status == BRC_OK) status = brc_mpi_wait(context, (int)n, request, "sending", &brc_mpi.cost.call_wait_s);
    brc_memory_free(request);
    return status;
}

brc_status brc_ranks_gather_first(brc_context *context, const void *mine, const int64_t *bytes_of, void *all)
{
    int64_t *send = NULL, *none = NULL;
    brc_status status = brc_mpi_enter(context);
    if (status != BRC_OK) return status;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &send, brc_mpi.here.count, "what ranks send"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &none, brc_mpi.here.count, "what ranks send"));
    send[0] = bytes_of[brc_mpi.here.mine];
    status = move_all(context, mine, send, all, brc_mpi.here.mine == 0 ? bytes_of : none);
cleanup:
    brc_memory_free(send);
    brc_memory_free(none);
    return status;
}

brc_status brc_ranks_broadcast(brc_context *context, int32_t from, void *data, int64_t bytes)
{
    MPI_Request request;
    BRC_TRY(brc_mpi_enter(context));
    if (brc_mpi.here.count == 1) return BRC_OK;
    for (int64_t at = 0; at < bytes; at += PIECE) {
        const int some = (int)(bytes - at < PIECE ? bytes - at : PIECE);
        BRC_TRY(brc_mpi_complete(context, MPI_Ibcast((char *)data + at, some, MPI_BYTE, from, brc_mpi.all, &request),
                                 &request, "a broadcast"));
    }
    return BRC_OK;
}

brc_status brc_ranks_trade(brc_context *context, const void *send, const int64_t *send_bytes, void **received,
                           int64_t *receive_bytes)
{
    MPI_Request request;
    int64_t sum = 0;
    *received = NULL;
    BRC_TRY(brc_mpi_enter(context));
    BRC_TRY(brc_mpi_complete(
        context, MPI_Ialltoall(send_bytes, 1, MPI_INT64_T, receive_bytes, 1, MPI_INT64_T, brc_mpi.all, &request),
        &request, "a trade"));
    for (int k = 0; k < brc_mpi.here.count; ++k)
        sum += receive_bytes[k];
    BRC_TRY(brc_memory_allocate(context, received, sum, 1, "what ranks send"));
    return move_all(context, send, send_bytes, *received, receive_bytes);
}

brc_status brc_ranks_reduce(brc_context *context, brc_reduction reduction, int64_t n, int64_t *values)
{
    const MPI_Op of[] = {[BRC_SUM] = MPI_SUM, [BRC_LEAST] = MPI_MIN, [BRC_MOST] = MPI_MAX, [BRC_ANY_BIT] = MPI_BOR};
    MPI_Request request;
    BRC_TRY(brc_mpi_enter(context));
    if (brc_mpi.here.count == 1) return BRC_OK;
    return brc_mpi_complete(
        context, MPI_Iallreduce(MPI_IN_PLACE, values, (int)n, MPI_INT64_T, of[reduction], brc_mpi.all, &request),
        &request, "a reduction");
}

brc_status brc_ranks_barrier(brc_context *context)
{
    MPI_Request request;
    BRC_TRY(brc_mpi_enter(context));
    if (brc_mpi.here.count == 1) return BRC_OK;
    return brc_mpi_complete(context, MPI_Ibarrier(brc_mpi.all, &request), &request, "a barrier");
}
