#include "ensemble.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <errno.h>
#include <malloc.h>
#include <string.h>

#define FILE_BYTES_MOST ((size_t)1 << 30)

typedef struct first_failure {
    brc_context *context;
    brc_status status;
} first_failure;

static void fail(first_failure *first, brc_status status, const char *message)
{
#pragma omp critical(brc_ensemble)
    if (first->status == BRC_OK) first->status = BRC_FAIL(first->context, status, "%s", message);
}

static bool failed(first_failure *first)
{
    brc_status status;
#pragma omp critical(brc_ensemble)
    status = first->status;
    return status != BRC_OK;
}

/* Every run frees what the next one asks for again: kept, it does not come anew and zeroed from the system, which takes
 * a sixth of a campaign. */
static void keep_memory(void)
{
#ifdef __GLIBC__
    enum { MOST_KEPT = 1 << 30, LEAST_ALONE = 32 << 20 };
    (void)mallopt(M_TRIM_THRESHOLD, MOST_KEPT);
    (void)mallopt(M_MMAP_THRESHOLD, LEAST_ALONE);
#endif
}

brc_status brc_ensemble_each(brc_context *context, int n_threads, int64_t n_tasks, brc_ensemble_task run, void *self)
{
    first_failure first = {.context = context, .status = BRC_OK};
    const int together = n_tasks < n_threads ? (int)n_tasks : n_threads;
    if (n_tasks < 1) return BRC_OK;
    keep_memory();
#pragma omp parallel num_threads(together)
    {
        brc_context *own = brc_context_create();
        brc_device *device = NULL;
        if (!own) {
            fail(&first, BRC_NO_MEMORY, "no memory for the threads of a campaign");
        } else {
            brc_log_set_level(own, BRC_LOG_ERROR);
            const brc_status status =
                brc_device_open(own, &(brc_device_request){.selector = "cpu", .n_threads = 1}, &device);
            if (status != BRC_OK) fail(&first, status, brc_context_message(own));
        }
#pragma omp for schedule(dynamic, 1)
        for (int64_t task = 0; task < n_tasks; ++task) {
            if (failed(&first)) continue;
            const brc_status status = run(self, own, device, task);
            if (status != BRC_OK) fail(&first, status, brc_context_message(own));
        }
        brc_device_close(&device);
        brc_context_free(&own);
    }
    return first.status;
}

/* Whole lines of an earlier campaign; a torn last line is cut off the file. */
static brc_status read_file(brc_context *context, const char *path, const char *header, brc_ensemble_line take,
                            void *self)
{
    char *text = NULL;
    size_t bytes;
    brc_status status = BRC_OK;
    BRC_TRY(brc_file_read_whole(context, path, FILE_BYTES_MOST, &text, &bytes));
    if (strncmp(text, header, strlen(header)) != 0)
        BRC_TRY_OR(cleanup,
                   BRC_FAIL(context, BRC_BAD_INPUT,
                            "%s: not a file of `breccia calibrate` of this version; choose another folder", path));
    char *line = text + strlen(header);
    for (long long number = 2; *line; ++number) {
        char *end = strchr(line, '\n');
        if (!end) break;
        *end = '\0';
        const bool good = take(self, line, &status);
        *end = '\n';
        if (!good)
            BRC_TRY_OR(cleanup, BRC_FAIL(context, BRC_BAD_INPUT,
                                         "%s:%lld: not a result; remove the line to have it run again", path, number));
        BRC_TRY_OR(cleanup, status);
        line = end + 1;
    }
    if (*line) status = brc_file_write_whole(context, path, text, (size_t)(line - text));
cleanup:
    brc_memory_free(text);
    return status;
}

static brc_status no_file(brc_context *context, const char *path)
{
    return BRC_FAIL(context, BRC_FILE_FAILED, "%s cannot be written: %s", path, strerror(errno));
}

brc_status brc_ensemble_open(brc_context *context, const char *folder, const char *name, const char *header,
                             bool resume, brc_ensemble_line take, void *self, brc_ensemble_file *out)
{
    *out = (brc_ensemble_file){0};
    BRC_TRY(brc_file_make_folder(context, folder));
    BRC_TRY(brc_file_join(context, folder, name, &out->path));
    const bool there = brc_file_exists(out->path);
    if (there && !resume)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s is there already; --resume goes on with it, or choose another folder", out->path);
    if (there) BRC_TRY(read_file(context, out->path, header, take, self));
    out->file = fopen(out->path, "a");
    if (!out->file || (!there && fputs(header, out->file) < 0)) return no_file(context, out->path);
    return BRC_OK;
}

brc_status brc_ensemble_keep(brc_context *context, brc_ensemble_file *file, const char *line)
{
    if (fputs(line, file->file) < 0 || fflush(file->file) != 0) return no_file(context, file->path);
    ++file->n_done;
    if (file->progress) brc_progress_update(file->progress, file->n_done);
    return BRC_OK;
}

brc_status brc_ensemble_close(brc_context *context, brc_ensemble_file *file)
{
    brc_status status = BRC_OK;
    brc_progress_finish(&file->progress);
    if (file->file && fclose(file->file) != 0) status = no_file(context, file->path);
    file->file = NULL;
    brc_memory_free(file->path);
    file->path = NULL;
    return status;
}
