/* Host doubles by element id <-> device rows, and sums in fixed blocks. */
#include "../run/simulation_internal.h"

enum { SUM_BLOCK = 1024 }; /* as in kernels/vector.cl */

static brc_status upload(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count, int bytes_each)
{
    if (count == 0) return BRC_OK;
    if (bytes_each == 8) return brc_buffer_write(buffer, 0, values, count * 8);
    float *narrow = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &narrow, count, "narrowed values"));
    for (int64_t i = 0; i < count; ++i)
        narrow[i] = (float)values[i];
    const brc_status status = brc_buffer_write(buffer, 0, narrow, count * 4);
    brc_memory_free(narrow);
    return status;
}

brc_status brc_upload_coeff(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count)
{
    return upload(s, buffer, values, count, brc_precision_coeff_bytes(brc_device_get_precision(s->device)));
}

brc_status brc_upload_state(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count)
{
    return upload(s, buffer, values, count, brc_precision_state_bytes(brc_device_get_precision(s->device)));
}

brc_status brc_download(brc_simulation *s, brc_buffer *buffer, int bytes_each, double *values, int64_t count)
{
    if (count == 0) return BRC_OK;
    if (bytes_each == 8) return brc_buffer_read(buffer, 0, values, count * 8);
    float *narrow = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &narrow, count, "narrow values"));
    const brc_status status = brc_buffer_read(buffer, 0, narrow, count * 4);
    if (status == BRC_OK)
        for (int64_t i = 0; i < count; ++i)
            values[i] = narrow[i];
    brc_memory_free(narrow);
    return status;
}

brc_status brc_state_to_rows(brc_simulation *s, brc_buffer *buffer, const double *values, int width, double fill)
{
    const brc_layout *layout = s->layout;
    double *rows = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &rows, (int64_t)layout->n_rows * width, "rows"));
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int64_t e = layout->element_of_row[r];
        for (int c = 0; c < width; ++c)
            rows[(int64_t)r * width + c] = e < 0 ? fill : values[e * width + c];
    }
    const brc_status status = brc_upload_state(s, buffer, rows, (int64_t)layout->n_rows * width);
    brc_memory_free(rows);
    return status;
}

static brc_status from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width, int bytes_each)
{
    const brc_layout *layout = s->layout;
    double *rows = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &rows, (int64_t)layout->n_rows * width, "rows"));
    const brc_status status = brc_download(s, buffer, bytes_each, rows, (int64_t)layout->n_rows * width);
    if (status == BRC_OK)
        for (int64_t e = 0; e < s->domain->n_elements; ++e)
            for (int c = 0; c < width; ++c)
                values[e * width + c] = rows[(int64_t)layout->row_of_element[e] * width + c];
    brc_memory_free(rows);
    return status;
}

brc_status brc_state_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width)
{
    return from_rows(s, buffer, values, width, brc_precision_state_bytes(brc_device_get_precision(s->device)));
}

brc_status brc_coeff_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width)
{
    return from_rows(s, buffer, values, width, brc_precision_coeff_bytes(brc_device_get_precision(s->device)));
}

/* Room for LANE_SPARE numbers of kernels/portable.h: gathers read whole vectors. */
enum { SPARE = 8 };

brc_status brc_new_state(brc_simulation *s, brc_buffer **out, int64_t count, const char *what)
{
    return brc_buffer_create(s->device, out,
                             (count + SPARE) * brc_precision_state_bytes(brc_device_get_precision(s->device)), what);
}

brc_status brc_new_coeff(brc_simulation *s, brc_buffer **out, int64_t count, const char *what)
{
    return brc_buffer_create(s->device, out,
                             (count + SPARE) * brc_precision_coeff_bytes(brc_device_get_precision(s->device)), what);
}

brc_status brc_upload_int(brc_buffer *buffer, const int32_t *values, int64_t count)
{
    return count ? brc_buffer_write(buffer, 0, values, count * 4) : BRC_OK;
}

brc_status brc_new_int(brc_simulation *s, brc_buffer **out, const int32_t *values, int64_t count, const char *what)
{
    BRC_TRY(brc_buffer_create(s->device, out, count * 4, what));
    return brc_upload_int(*out, values, count);
}

/* Add the block sums with Neumaier's compensation, so that the host's part adds no error of its own. */
static brc_status add_partial(brc_simulation *s, int64_t n_blocks, double *out)
{
    double *blocks = NULL;
    BRC_TRY(BRC_ALLOCATE(s->context, &blocks, n_blocks, "block sums"));
    const brc_status status =
        brc_download(s, s->partial, brc_precision_state_bytes(brc_device_get_precision(s->device)), blocks, n_blocks);
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
    BRC_TRY(BRC_LAUNCH(s->kernel.sum, n_blocks, BRC_INT(n_blocks), BRC_INT(count), BRC_BUF(x), BRC_BUF(s->partial)));
    return add_partial(s, n_blocks, out);
}

brc_status brc_vector_axpy(brc_simulation *s, int64_t count, double a, brc_buffer *x, brc_buffer *y)
{
    return BRC_LAUNCH(s->kernel.axpy, count, BRC_INT(count), BRC_STATE(a), BRC_BUF(x), BRC_BUF(y));
}

brc_status brc_vector_gather(brc_simulation *s, int32_t n, brc_buffer *index, brc_buffer *x, brc_buffer *y)
{
    return BRC_LAUNCH(s->kernel.gather, n, BRC_INT(n), BRC_BUF(index), BRC_BUF(x), BRC_BUF(y));
}

brc_status brc_vector_small_rotation(brc_simulation *s, brc_buffer *theta, brc_buffer *orientation)
{
    const int32_t n = s->layout->n_rows;
    return BRC_LAUNCH(s->kernel.small_rotation, n, BRC_INT(n), BRC_BUF(theta), BRC_BUF(orientation));
}

brc_status brc_vector_dot(brc_simulation *s, brc_buffer *x, brc_buffer *y, int64_t count, double *out)
{
    const int64_t n_blocks = (count + SUM_BLOCK - 1) / SUM_BLOCK;
    BRC_TRY(BRC_LAUNCH(s->kernel.dot, n_blocks, BRC_INT(n_blocks), BRC_INT(count), BRC_BUF(x), BRC_BUF(y),
                       BRC_BUF(s->partial)));
    return add_partial(s, n_blocks, out);
}
