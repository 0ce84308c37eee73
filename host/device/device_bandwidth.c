#include "device_bandwidth.h"
#include "device_internal.h"

/* The best of this many: other programs only ever slow a run down. */
enum { RUNS = 7 };

brc_status brc_device_copy_bandwidth(brc_device *device, int64_t bytes, double (*clock)(void), double *bytes_per_s)
{
    brc_status status = BRC_OK;
    brc_buffer *from = NULL, *to = NULL;
    brc_kernel *copy = NULL;
    const int64_t n = bytes / brc_precision_state_bytes(device->precision);
    *bytes_per_s = 0;
    if (n < 1 || n > INT32_MAX)
        return BRC_FAIL(device->context, BRC_BAD_INPUT, "copy bandwidth over %lld bytes: expected 8 bytes to 8 GB",
                        (long long)bytes);
    BRC_TRY_OR(cleanup, brc_kernel_find(device, "vector_copy", &copy));
    BRC_TRY_OR(cleanup, brc_buffer_create(device, &from, bytes, "the copied array of the bandwidth measurement"));
    BRC_TRY_OR(cleanup, brc_buffer_create(device, &to, bytes, "the copy of the bandwidth measurement"));
    for (int run = 0; run < RUNS; ++run) {
        BRC_TRY_OR(cleanup, brc_device_wait(device));
        const double start = clock();
        BRC_TRY_OR(cleanup, BRC_LAUNCH(copy, n, BRC_INT(n), BRC_BUF(from), BRC_BUF(to)));
        BRC_TRY_OR(cleanup, brc_device_wait(device));
        const double seconds = clock() - start;
        const double rate = 2.0 * (double)(n * brc_precision_state_bytes(device->precision)) / seconds;
        if (seconds > 0 && rate > *bytes_per_s) *bytes_per_s = rate;
    }
cleanup:
    brc_buffer_free(&from);
    brc_buffer_free(&to);
    return status;
}
