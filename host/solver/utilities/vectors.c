/* Algebra of vectors, and sums in fixed blocks (vector.cl). */
#include "../core/solver.h"

enum { SUM_BLOCK = 1024 }; /* SCAN_BLOCK of portable.h */

/* One that a model does not use stays NULL. */
struct brc_vector_kernels {
    brc_kernel *axpy, *xpay, *dot, *sum, *gather, *small_rotation, *turn_orientation, *precondition, *precondition6;
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
                  {&k->gather, "vector_gather", s->scene->has_fracture},
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
static brc_status add_partial(brc_simulation *s, int64_t n_blocks, double *out)
{
    double *blocks = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &blocks, n_blocks, "block sums"));
    const brc_status status = brc_download(s, brc_partial_of(s), brc_state_bytes(s), blocks, n_blocks);
    double sum = 0, lost = 0;
    for (int64_t b = 0; b < n_blocks; ++b) {
        const double next = sum + blocks[b];
        const double big = sum > 0 ? sum : -sum, add = blocks[b] > 0 ? blocks[b] : -blocks[b];
        lost += big >= add ? (sum - next) + blocks[b] : (blocks[b] - next) + sum;
        sum = next;
    }
    brc_memory_free(blocks);
    *out = sum + lost;
    return status;
}

brc_status brc_vector_sum(brc_simulation *s, brc_buffer *x, int64_t count, double *out)
{
    const int64_t n_blocks = (count + SUM_BLOCK - 1) / SUM_BLOCK;
    BRC_TRY(BRC_LAUNCH(s->vectors->sum, n_blocks, BRC_INT(n_blocks), BRC_INT(count), BRC_BUF(x),
                       BRC_BUF(brc_partial_of(s))));
    return add_partial(s, n_blocks, out);
}

brc_status brc_vector_axpy(brc_simulation *s, int64_t count, double a, brc_buffer *x, brc_buffer *y)
{
    return BRC_LAUNCH(s->vectors->axpy, count, BRC_INT(count), BRC_STATE(a), BRC_BUF(x), BRC_BUF(y));
}

brc_status brc_vector_gather(brc_simulation *s, int32_t n, brc_buffer *index, brc_buffer *x, brc_buffer *y)
{
    return BRC_LAUNCH(s->vectors->gather, n, BRC_INT(n), BRC_BUF(index), BRC_BUF(x), BRC_BUF(y));
}

brc_status brc_vector_small_rotation(brc_simulation *s, brc_buffer *theta, brc_buffer *orientation)
{
    const int32_t n = s->layout->n_rows;
    return BRC_LAUNCH(s->vectors->small_rotation, n, BRC_INT(n), BRC_BUF(theta), BRC_BUF(orientation));
}

brc_status brc_vector_dot(brc_simulation *s, brc_buffer *x, brc_buffer *y, int64_t count, double *out)
{
    const int64_t n_blocks = (count + SUM_BLOCK - 1) / SUM_BLOCK;
    BRC_TRY(BRC_LAUNCH(s->vectors->dot, n_blocks, BRC_INT(n_blocks), BRC_INT(count), BRC_BUF(x), BRC_BUF(y),
                       BRC_BUF(brc_partial_of(s))));
    return add_partial(s, n_blocks, out);
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
