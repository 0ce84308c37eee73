/* A program that writes, on any number of ranks, files of which it knows the numbers: rank k owns rows as a draw of
 * their ids decides, the last rank none where there are several. `output FOLDER ROWS` writes FOLDER/rows.h5, text.csv
 * and whole.txt, and reads the rows again. `output places SELECTOR` opens a device and says who computes where. */
#include "../../host/base/file.h"
#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../../host/base/random.h"
#include "../../host/base/ranks.h"
#include "../../host/device/device_list.h"
#include "../../host/output/append.h"
#include "../../host/output/h5_pack.h"
#include "../../host/output/rank_rows.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 3, BEFORE = 7 }; /* rows of another part before ours */

static int owner_of(int64_t id)
{
    double draw[4];
    const int n = brc_ranks_count() > 1 ? brc_ranks_count() - 1 : 1;
    brc_random_uniform4(1, BRC_RANDOM_TEST, (uint64_t)id / 10, 0, draw);
    return (int)(draw[0] * n);
}

static double number_of(int64_t id, int column)
{
    return (double)(id % 1000) * 0.25 + column;
}

static brc_status write_h5(brc_context *context, const char *path, const brc_rank_rows *rows, const double *own)
{
    brc_h5 h5;
    double before[BEFORE * COLUMNS] = {0};
    BRC_TRY(brc_h5_create(context, path, &h5));
    brc_h5_group(&h5, "group");
    brc_h5_packed(&h5, "group/packed", H5T_NATIVE_DOUBLE, rows->all, COLUMNS);
    brc_h5_packed(&h5, "group/second", H5T_NATIVE_DOUBLE, BEFORE + rows->all, COLUMNS);
    brc_h5_dataset(&h5, "group/plain", H5T_NATIVE_DOUBLE, rows->all, COLUMNS, NULL);
    brc_h5_attribute_number(&h5, "group", "number", 24);
    brc_h5_pack_rows(&h5, "group/second", H5T_NATIVE_DOUBLE, 0, BEFORE, before, 1);
    BRC_TRY(brc_rank_rows_write(&h5, "group/packed", H5T_NATIVE_DOUBLE, COLUMNS, true, rows, 0, own, 1));
    BRC_TRY(brc_rank_rows_write(&h5, "group/second", H5T_NATIVE_DOUBLE, COLUMNS, true, rows, BEFORE, own, 1));
    BRC_TRY(brc_rank_rows_write(&h5, "group/plain", H5T_NATIVE_DOUBLE, COLUMNS, false, rows, 0, own, 1));
    return brc_h5_commit_sealed(&h5);
}

static brc_status read_h5(brc_context *context, const char *path, const brc_rank_rows *rows, const double *own)
{
    const char *const names[] = {"group/packed", "group/second", "group/plain"};
    brc_h5_read h5;
    double *again = NULL;
    brc_status status = BRC_OK;
    BRC_TRY(brc_h5_read_open(context, path, &h5));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &again, COLUMNS * rows->n, "rows"));
    for (int k = 0; k < 3; ++k) {
        BRC_TRY_OR(cleanup,
                   brc_rank_rows_read(&h5, names[k], H5T_NATIVE_DOUBLE, COLUMNS, rows, k == 1 ? BEFORE : 0, again));
        if (memcmp(own, again, (size_t)(COLUMNS * rows->n) * sizeof *own) != 0)
            status = BRC_FAIL(context, BRC_INTERNAL, "%s: other numbers come back", names[k]);
    }
cleanup:
    brc_memory_free(again);
    brc_h5_read_close(&h5);
    return status;
}

static brc_status write_texts(brc_context *context, const char *table, const char *whole)
{
    brc_append *file;
    brc_text text = {.context = context};
    BRC_TRY(brc_file_write_whole(context, whole, "whole\n", 6));
    BRC_TRY(brc_append_create(context, table, "a,b\n", &file));
    brc_text_add(&text, "%d,%d\n", 1, 2);
    brc_status status = brc_append_add(context, file, &text);
    if (status == BRC_OK && brc_append_bytes(file) != 8) status = BRC_FAIL(context, BRC_INTERNAL, "bytes are missing");
    if (status == BRC_OK) status = brc_append_finish(context, file);
    brc_append_free(&file);
    brc_text_free(&text);
    return status;
}

static brc_status run(brc_context *context, const char *folder, int64_t all)
{
    char path[3][512];
    const char *const names[3] = {"rows.h5", "text.csv", "whole.txt"};
    brc_rank_rows rows = {.all = all};
    int32_t *id = NULL;
    double *own = NULL;
    brc_status status = BRC_OK;
    for (int k = 0; k < 3; ++k)
        snprintf(path[k], sizeof path[k], "%s/%s", folder, names[k]);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &id, all, "ids"));
    for (int64_t k = 0; k < all; ++k)
        if (owner_of(k) == brc_ranks_mine()) id[rows.n++] = (int32_t)k;
    rows.id = id;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &own, COLUMNS * rows.n, "rows"));
    for (int64_t k = 0; k < rows.n; ++k)
        for (int c = 0; c < COLUMNS; ++c)
            own[COLUMNS * k + c] = number_of(id[k], c);
    BRC_TRY_OR(cleanup, brc_file_make_folder(context, folder));
    BRC_TRY_OR(cleanup, write_h5(context, path[0], &rows, own));
    BRC_TRY_OR(cleanup, write_texts(context, path[1], path[2]));
    BRC_TRY_OR(cleanup, brc_ranks_barrier(context));
    status = read_h5(context, path[0], &rows, own);
cleanup:
    brc_memory_free(id);
    brc_memory_free(own);
    return status;
}

static brc_status show_places(brc_context *context, const char *selector)
{
    brc_device *device;
    const brc_device_request request = {.selector = selector, .precision = BRC_DOUBLE, .n_threads = 1};
    BRC_TRY(brc_device_open(context, &request, &device));
    const brc_status status = brc_device_log_places(context, device);
    brc_device_close(&device);
    return status;
}

int main(int argc, char **argv)
{
    bool speaks = true;
    brc_context *context = brc_context_create();
    signal(SIGXFSZ, SIG_IGN);
    brc_status status = brc_ranks_start(context, &argc, &argv);
    if (status == BRC_OK && argc == 3 && strcmp(argv[1], "places") == 0)
        status = show_places(context, argv[2]);
    else if (status == BRC_OK)
        status = argc == 3 ? run(context, argv[1], strtoll(argv[2], NULL, 10))
                           : BRC_FAIL(context, BRC_BAD_INPUT, "usage: output FOLDER ROWS");
    status = brc_ranks_end(context, status, &speaks);
    if (status != BRC_OK && speaks) fprintf(stderr, "%s\n", brc_context_message(context));
    brc_context_free(&context);
    brc_ranks_leave(brc_status_exit_code(status));
    return brc_status_exit_code(status);
}
