#include "opencl_profile.h"
#include "../base/log.h"
#include "../base/memory.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_KERNELS = 512, EVENTS_BETWEEN_DRAINS = 1024 };

typedef struct profile_row {
    char kernel[64];
    int64_t launches, items;
    double seconds;
} profile_row;

struct brc_opencl_profile {
    const char *path; /* of the environment */
    profile_row rows[MOST_KERNELS];
    int n_rows;
    cl_event events[EVENTS_BETWEEN_DRAINS];
    int row_of[EVENTS_BETWEEN_DRAINS];
    int n_events;
};

brc_status brc_opencl_profile_create(brc_context *context, brc_opencl_profile **out)
{
    const char *const path = getenv("BRECCIA_OPENCL_PROFILE");
    *out = NULL;
    if (!path || !path[0]) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "profile of the kernels"));
    (*out)->path = path;
    return BRC_OK;
}

/* Seconds of all events so far go to their rows. */
static void drain(brc_opencl_profile *profile)
{
    for (int e = 0; e < profile->n_events; ++e) {
        cl_ulong begin = 0, end = 0; /* [ns] */
        const cl_event event = profile->events[e];
        if (clWaitForEvents(1, &event) == CL_SUCCESS &&
            clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof begin, &begin, NULL) == CL_SUCCESS &&
            clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL) == CL_SUCCESS &&
            end > begin)
            profile->rows[profile->row_of[e]].seconds += 1e-9 * (double)(end - begin);
        (void)clReleaseEvent(event);
    }
    profile->n_events = 0;
}

cl_event *brc_opencl_profile_event(brc_opencl_profile *profile)
{
    if (!profile) return NULL;
    if (profile->n_events == EVENTS_BETWEEN_DRAINS) drain(profile);
    return &profile->events[profile->n_events];
}

void brc_opencl_profile_add(brc_opencl_profile *profile, const char *kernel, int64_t n_items)
{
    if (!profile) return;
    int row = 0;
    while (row < profile->n_rows && strcmp(profile->rows[row].kernel, kernel) != 0)
        ++row;
    if (row == MOST_KERNELS) --row; /* there are fewer kernels than that */
    if (row == profile->n_rows)
        snprintf(profile->rows[profile->n_rows++].kernel, sizeof profile->rows[0].kernel, "%s", kernel);
    ++profile->rows[row].launches;
    profile->rows[row].items += n_items;
    profile->row_of[profile->n_events++] = row;
}

static int compare_rows(const void *left, const void *right)
{
    const profile_row *const a = left, *const b = right;
    return a->seconds != b->seconds ? (a->seconds < b->seconds ? 1 : -1) : strcmp(a->kernel, b->kernel);
}

void brc_opencl_profile_close(brc_opencl_profile **handle, brc_device *device)
{
    brc_opencl_profile *const profile = *handle;
    if (!profile) return;
    drain(profile);
    qsort(profile->rows, (size_t)profile->n_rows, sizeof profile->rows[0], compare_rows);
    FILE *const file = fopen(profile->path, "a");
    bool written = file != NULL;
    if (file) {
        if (fseek(file, 0, SEEK_END) == 0 && ftell(file) == 0)
            fprintf(file, "kernel,precision,launches,work_items,seconds\n");
        for (int r = 0; r < profile->n_rows; ++r)
            fprintf(file, "%s,%s,%lld,%lld,%.9g\n", profile->rows[r].kernel, brc_precision_name(device->precision),
                    (long long)profile->rows[r].launches, (long long)profile->rows[r].items, profile->rows[r].seconds);
        written = fclose(file) == 0;
    }
    if (!written)
        brc_log(device->context, BRC_LOG_WARNING, "the profile of BRECCIA_OPENCL_PROFILE is not written to %s: %s",
                profile->path, strerror(errno));
    brc_memory_free(profile);
    *handle = NULL;
}
