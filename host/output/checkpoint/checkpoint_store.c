#include "checkpoint_store.h"
#include <math.h>
#include <stdio.h>

enum { PATH_ROOM = 160 };

static const char *path_of(char path[PATH_ROOM], const brc_state_store *store, const char *name)
{
    if (store->part < 0)
        snprintf(path, PATH_ROOM, "run/%s", name);
    else
        snprintf(path, PATH_ROOM, "parts/%d/%s", (int)store->part, name);
    return path;
}

static hid_t h5_type(brc_stored_type type)
{
    switch (type) {
    case BRC_STORED_FLOAT: return H5T_NATIVE_FLOAT;
    case BRC_STORED_INT32: return H5T_NATIVE_INT32;
    case BRC_STORED_INT64: return H5T_NATIVE_INT64;
    case BRC_STORED_BYTE: return H5T_NATIVE_CHAR;
    case BRC_STORED_DOUBLE:
    case BRC_STORED_SAMPLE: break;
    }
    return H5T_NATIVE_DOUBLE;
}

static brc_status put(brc_state_store *store, const char *name, brc_stored_type type, int64_t rows, int32_t columns,
                      void *data)
{
    brc_h5 *h5 = store->self;
    char path[PATH_ROOM];
    brc_h5_dataset(h5, path_of(path, store, name), h5_type(type), rows, columns > 1 ? columns : 0, data);
    return h5->status;
}

static brc_status count(brc_state_store *store, const char *name, int64_t *rows)
{
    const brc_h5_read *h5 = store->self;
    char path[PATH_ROOM];
    int64_t columns;
    return brc_h5_read_size(h5, path_of(path, store, name), rows, &columns);
}

/* No run writes such a state (guard.h): one would spread, or be lost in a branch that a comparison with it decides. */
static brc_status check_finite(const brc_h5_read *h5, const char *path, brc_stored_type type, int64_t rows,
                               int32_t columns, const void *data)
{
    const double *doubles = type == BRC_STORED_DOUBLE ? data : NULL;
    const float *floats = type == BRC_STORED_FLOAT ? data : NULL;
    for (int64_t i = 0; (doubles || floats) && i < rows * columns; ++i) {
        const double one = doubles ? doubles[i] : (double)floats[i];
        if (!isfinite(one))
            return BRC_FAIL(h5->context, BRC_BAD_INPUT,
                            "%s: %s is %g in row %lld, column %lld, where a state has finite numbers: the file was "
                            "changed by something else than breccia; "
                            "remove it to go on from the one before, or run without --resume",
                            h5->path, path, one, (long long)(i / columns), (long long)(i % columns));
    }
    return BRC_OK;
}

static brc_status get(brc_state_store *store, const char *name, brc_stored_type type, int64_t rows, int32_t columns,
                      void *data)
{
    const brc_h5_read *h5 = store->self;
    char path[PATH_ROOM];
    int64_t there, wide;
    BRC_TRY(brc_h5_read_size(h5, path_of(path, store, name), &there, &wide));
    if (there != rows || wide != (columns > 1 ? columns : 1))
        return BRC_FAIL(h5->context, BRC_BAD_INPUT,
                        "%s: %s has %lld x %lld numbers, %lld x %d are expected; it is a checkpoint of another run",
                        h5->path, path, (long long)there, (long long)wide, (long long)rows, (int)columns);
    BRC_TRY(brc_h5_read_rows(h5, path, h5_type(type), 0, rows, data));
    return check_finite(h5, path, type, rows, columns, data);
}

brc_state_store brc_checkpoint_store_write(brc_h5 *h5, int32_t n_parts)
{
    char path[PATH_ROOM];
    brc_h5_group(h5, "run");
    brc_h5_group(h5, "parts");
    for (int32_t k = 0; k < n_parts; ++k) {
        snprintf(path, sizeof path, "parts/%d", (int)k);
        brc_h5_group(h5, path);
    }
    return (brc_state_store){.self = h5, .for_file = true, .part = -1, .numbers = put};
}

brc_state_store brc_checkpoint_store_read(brc_h5_read *h5)
{
    return (brc_state_store){.self = h5, .loading = true, .part = -1, .numbers = get, .count = count};
}
