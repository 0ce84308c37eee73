/* Algebra of vectors, and sums in fixed blocks (vector.cl). */
#include "../../device/shares.h"
#include "../core/solver.h"

enum { SUM_BLOCK = 1024, MOST_LATER = 16 }; /* SCAN_BLOCK of portable.h */

/* One that a model does not use stays NULL. */
struct brc_vector_kernels {
    brc_kernel *axpy, *xpay, *dot, *sum, *sum_listed, *small_rotation, *turn_orientation, *precondition, *precondition6;
    /* sums that are not read yet: the end of each one's blocks in brc_partial_of, one behind the other */
    int n_later;
    int64_t end[MOST_LATER];
    double *out[MOST_LATER];
};

brc_status brc_vector_kernels_find(brc_simulation *s)
{
    BRC_TRY(BRC_ALLOCATE(s->context, &s->vectors, 1, "kernels of vectors"));
    struct brc_vector_kernels *k = s->vectors;
    const bool rotations = brc_solves_rotations(s->model), turns = s->model->turns;
    const struct {
        brc_kernel **slot;
        const char *name;
        bool wanted;
    } wanted[] = {{&k->axpy, "vector_axpy", true},
                  {&k->xpay, "vector_xpay", true},
                  {&k->dot, "vector_dot", true},
                  {&k->sum, "vector_sum", true},
                  {&k->sum_listed, "vector_sum_listed", s->scene->has_fracture},
                  {&k->precondition, "block_precondition", true},
                  {&k->precondition6, "block6_precondition", rotations},
                  {&k->turn_orientation, "turn_orientation", rotations},
                  {&k->small_rotation, "small_rotation", turns}};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; ++i)
        if (wanted[i].wanted) BRC_TRY(brc_kernel_find(s->device, wanted[i].name, wanted[i].slot));
    return BRC_OK;
}

void brc_vector_kernels_free(brc_simulation *s)
{
    brc_memory_free(s->vectors);
    s->vectors = NULL;
}

/* Add the block sums with Neumaier's compensation, so that the host's part adds no error of its own. */
static double add_blocks(const double *blocks, int64_t n_blocks)
{
    double sum = 0, lost = 0;
    for (int64_t b = 0; b < n_blocks; ++b) {
        const double next = sum + blocks[b];
        const double big = sum > 0 ? sum : -sum, add = blocks[b] > 0 ? blocks[b] : -blocks[b];
        lost += big >= add ? (sum - next) + blocks[b] : (blocks[b] - next) + sum;
        sum = next;
    }
    return sum + lost;
}

brc_status brc_vector_sums(brc_simulation *s)
{
    struct brc_vector_kernels *k = s->vectors;
    const int n = k->n_later;
    if (n == 0) return BRC_OK;
    k->n_later = 0;
    BRC_LOCAL(s->context, k->end[n - 1], double, blocks, "block sums");
    BRC_TRY(brc_download(s, brc_partial_of(s), brc_state_bytes(s), blocks, k->end[n - 1]));
    for (int i = 0; i < n; ++i) {
        const int64_t first = i ? k->end[i - 1] : 0;
        *k->out[i] = add_blocks(blocks + first, k->end[i] - first);
    }
    return BRC_OK;
}

void brc_vector_sums_forget(brc_simulation *s)
{
    s->vectors->n_later = 0;
}

/* Room for the blocks of one more sum; *at: where they begin. */
static brc_status add_later(brc_simulation *s, int64_t n_blocks, double *out, int64_t *at)
{
    struct brc_vector_kernels *k = s->vectors;
    const int64_t room = brc_buffer_bytes(brc_partial_of(s)) / brc_state_bytes(s);
    if (k->n_later == MOST_LATER || (k->n_later && k->end[k->n_later - 1] + n_blocks > room))
        BRC_TRY(brc_vector_sums(s));
    *at = k->n_later ? k->end[k->n_later - 1] : 0;
    k->out[k->n_later] = out;
    k->end[k->n_later++] = *at + n_blocks;
    return BRC_OK;
}

/* Of blocks that ranks share the first one stands for the first row. */
static brc_status now_if_shared(brc_simulation *s)
{
    return brc_device_is_shared(s->device) ? brc_vector_sums(s) : BRC_OK;
}

brc_status brc_vector_sum_later(brc_simulation *s, brc_buffer *x, int64_t count, double *out)
{
    const int64_t n_blocks = (count + SUM_BLOCK - 1) / SUM_BLOCK;
    int64_t at;
    BRC_TRY(add_later(s, n_blocks, out, &at));
    BRC_TRY(BRC_LAUNCH(s->vectors->sum, n_blocks, BRC_INT(n_blocks), BRC_INT(count), BRC_INT(at), BRC_BUF(x),
                       BRC_BUF(brc_partial_of(s))));
    return now_if_shared(s);
}

brc_status brc_vector_sum_listed_later(brc_simulation *s, brc_buffer *list, int32_t n, brc_buffer *x, double *out)
{
    const int64_t n_blocks = (n + SUM_BLOCK - 1) / SUM_BLOCK;
    int64_t at;
    BRC_TRY(add_later(s, n_blocks, out, &at));
    BRC_TRY(BRC_LAUNCH(s->vectors->sum_listed, n_blocks, BRC_INT(n_blocks), BRC_INT(n), BRC_INT(at), BRC_BUF(list),
                       BRC_BUF(x), BRC_BUF(brc_partial_of(s))));
    return now_if_shared(s);
}

brc_status brc_vector_sum(brc_simulation *s, brc_buffer *x, int64_t count, double *out)
{
    BRC_TRY(brc_vector_sum_later(s, x, count, out));
    return brc_vector_sums(s);
}

brc_status brc_vector_axpy(brc_simulation *s, int64_t count, double a, brc_buffer *x, brc_buffer *y)
{
    return BRC_LAUNCH(s->vectors->axpy, count, BRC_INT(count), BRC_STATE(a), BRC_BUF(x), BRC_BUF(y));
}

brc_status brc_vector_small_rotation(brc_simulation *s, brc_buffer *theta, brc_buffer *orientation)
{
    const int32_t n = s->layout->n_rows;
    return BRC_LAUNCH(s->vectors->small_rotation, n, BRC_INT(n), BRC_BUF(theta), BRC_BUF(orientation));
}

brc_status brc_vector_dot(brc_simulation *s, brc_buffer *x, brc_buffer *y, int64_t count, double *out)
{
    const int64_t n_blocks = (count + SUM_BLOCK - 1) / SUM_BLOCK;
    int64_t at;
    BRC_TRY(brc_vector_sums(s));
    BRC_TRY(add_later(s, n_blocks, out, &at));
    BRC_TRY(BRC_LAUNCH(s->vectors->dot, n_blocks, BRC_INT(n_blocks), BRC_INT(count), BRC_BUF(x), BRC_BUF(y),
                       BRC_BUF(brc_partial_of(s))));
    return brc_vector_sums(s);
}

brc_status brc_vector_xpay(brc_simulation *s, int64_t count, brc_buffer *x, double a, brc_buffer *y)
{
    return BRC_LAUNCH(s->vectors->xpay, count, BRC_INT(count), BRC_STATE(a), BRC_BUF(x), BRC_BUF(y));
}

brc_status brc_vector_turn(brc_simulation *s, brc_buffer *theta, brc_buffer *orientation)
{
    const int32_t n = s->layout->n_rows;
    return BRC_LAUNCH(s->vectors->turn_orientation, n, BRC_INT(n), BRC_BUF(theta), BRC_BUF(orientation));
}

brc_status brc_vector_blocks(brc_simulation *s, brc_buffer *blocks, brc_buffer *x, brc_buffer *y)
{
    const int32_t n = s->layout->n_rows;
    return BRC_LAUNCH(s->vectors->precondition, n, BRC_INT(n), BRC_BUF(blocks), BRC_BUF(x), BRC_BUF(y));
}

brc_status brc_vector_blocks6(brc_simulation *s, brc_buffer *blocks, brc_buffer *x, brc_buffer *x_turn, brc_buffer *y,
                              brc_buffer *y_turn)
{
    const int32_t n = s->layout->n_rows;
    return BRC_LAUNCH(s->vectors->precondition6, n, BRC_INT(n), BRC_BUF(blocks), BRC_BUF(x), BRC_BUF(x_turn),
                      BRC_BUF(y), BRC_BUF(y_turn));
}
