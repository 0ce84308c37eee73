/* Host doubles by element id <-> device rows. */
#include "../../device/shares.h"
#include "core_internal.h"
#include <math.h>

static brc_status upload(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count, int bytes_each)
{
    if (count == 0) return BRC_OK;
    if (bytes_each == 8) return brc_buffer_write(buffer, 0, values, count * 8);
    BRC_LOCAL(s->context, count, float, narrow, "narrowed values");
    for (int64_t i = 0; i < count; ++i)
        if (values[i] != 0 || signbit(values[i])) narrow[i] = (float)values[i]; /* pages of zeros take no memory */
    return brc_buffer_write(buffer, 0, narrow, count * 4);
}

brc_status brc_upload_coeff(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count)
{
    return upload(s, buffer, values, count, brc_coeff_bytes(s));
}

brc_status brc_upload_state(brc_simulation *s, brc_buffer *buffer, const double *values, int64_t count)
{
    return upload(s, buffer, values, count, brc_state_bytes(s));
}

brc_status brc_download(brc_simulation *s, brc_buffer *buffer, int bytes_each, double *values, int64_t count)
{
    if (count == 0) return BRC_OK;
    if (bytes_each == 8) return brc_buffer_read(buffer, 0, values, count * 8);
    BRC_LOCAL(s->context, count, float, narrow, "narrow values");
    BRC_TRY(brc_buffer_read(buffer, 0, narrow, count * 4));
    for (int64_t i = 0; i < count; ++i)
        values[i] = narrow[i];
    return BRC_OK;
}

brc_status brc_state_to_rows(brc_simulation *s, brc_buffer *buffer, const double *values, int width, double fill)
{
    const brc_layout *layout = s->layout;
    BRC_LOCAL(s->context, (int64_t)layout->n_rows * width, double, rows, "rows");
    for (int32_t r = 0; r < layout->n_rows; ++r) {
        const int64_t e = layout->element_of_row[r];
        for (int c = 0; c < width; ++c)
            rows[(int64_t)r * width + c] = e < 0 ? fill : values[e * width + c];
    }
    return brc_upload_state(s, buffer, rows, (int64_t)layout->n_rows * width);
}

static brc_status from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width, int bytes_each)
{
    const brc_layout *layout = s->layout;
    BRC_LOCAL(s->context, (int64_t)layout->n_rows * width, double, rows, "rows");
    BRC_TRY(brc_download(s, buffer, bytes_each, rows, (int64_t)layout->n_rows * width));
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        for (int c = 0; c < width; ++c)
            values[e * width + c] = rows[(int64_t)layout->row_of_element[e] * width + c];
    return BRC_OK;
}

brc_status brc_state_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width)
{
    return from_rows(s, buffer, values, width, brc_state_bytes(s));
}

brc_status brc_coeff_from_rows(brc_simulation *s, brc_buffer *buffer, double *values, int width)
{
    return from_rows(s, buffer, values, width, brc_coeff_bytes(s));
}

/* Room for LANE_SPARE numbers of portable.h: gathers read whole vectors. */
enum { SPARE = 8 };

brc_status brc_largest_coeff(brc_simulation *s, brc_buffer *buffer, double *out)
{
    *out = 0;
    BRC_LOCAL(s->context, s->domain->n_elements, double, value, "numbers of elements");
    BRC_TRY(brc_coeff_from_rows(s, buffer, value, 1));
    for (int64_t e = 0; e < s->domain->n_elements; ++e)
        *out = fmax(*out, value[e]);
    return BRC_OK;
}

static brc_status new_array(brc_simulation *s, brc_buffer **out, int64_t count, int bytes, const char *what)
{
    const int32_t n_rows = s->layout->n_rows;
    BRC_TRY(brc_buffer_create(s->device, out, (count + SPARE) * bytes, what));
    if (count > 0 && count % n_rows == 0) brc_buffer_is_of(*out, BRC_OF_ROWS, count / n_rows * bytes, bytes);
    return BRC_OK;
}

brc_status brc_new_state(brc_simulation *s, brc_buffer **out, int64_t count, const char *what)
{
    return new_array(s, out, count, brc_state_bytes(s), what);
}

brc_status brc_new_coeff(brc_simulation *s, brc_buffer **out, int64_t count, const char *what)
{
    return new_array(s, out, count, brc_coeff_bytes(s), what);
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

BRC_READ(bool, brc_pass_may_do_more, !brc_device_is_shared(s->device))
