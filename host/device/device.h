/* Devices: buffers, kernels by name, launches in order, copies. Knows no physics.
 *
 * Three backends behind one table of functions: OpenMP host ("cpu", the reference), OpenCL ("opencl:N"), OpenMP target
 * ("target:N", a plug-in library built with clang where there is one). The kernels come from one source (kernels/):
 * the C builds hold one instance per {instruction set, precision, materials}, OpenCL compiles the one a run needs. */
#ifndef BRC_DEVICE_DEVICE_H
#define BRC_DEVICE_DEVICE_H

#include "../base/machine_memory.h"
#include "../base/status.h"
#include <stdint.h>

typedef enum brc_precision { BRC_DOUBLE, BRC_MIXED, BRC_SINGLE } brc_precision;
/* "double", "mixed", "single". */
const char *brc_precision_name(brc_precision precision);
/* Bytes of one number of the state (u, v, f: 8, 8, 4) and of one coefficient (everything else: 8, 4, 4). */
int brc_precision_state_bytes(brc_precision precision);
int brc_precision_coeff_bytes(brc_precision precision);

typedef enum brc_device_kind { BRC_DEVICE_CPU, BRC_DEVICE_OPENCL, BRC_DEVICE_TARGET } brc_device_kind;

/* What one device is. Strings are owned by the list. */
typedef struct brc_device_info {
    brc_device_kind kind;
    int index;         /* N of "opencl:N", "target:N"; 0 for the cpu */
    char selector[32]; /* "cpu", "opencl:0", ... */
    char name[128];    /* e.g. "Intel Xeon, 2 threads, avx512" */
    char driver[128];  /* platform and driver version */
    bool is_gpu;
    bool has_double;
    bool joins_roundings; /* of a product and a sum; an opened device: `exact` or not, for want of other kernels */
    int compute_units;    /* threads on the cpu */
    int64_t memory_bytes; /* 0: unknown */
    int64_t largest_buffer_bytes; /* 0: no limit beyond memory (PoCL: 2 GiB was seen) */
    bool usable;
    char why_not[256]; /* when not usable: the reason and the cure */
} brc_device_info;

typedef struct brc_device_list {
    int n;
    brc_device_info *items; /* [n] */
    int automatic;          /* index of the one that `auto` takes */
    char why[512];          /* one sentence: why that one */
} brc_device_list;

/* Look for devices. Never fails for a missing loader or driver: that is a line of the list. */
brc_status brc_device_list_create(brc_context *context, brc_device_list **out);
void brc_device_list_free(brc_device_list **list);

typedef struct brc_device brc_device;
typedef struct brc_buffer brc_buffer;

/* What is compiled or chosen for a run. */
typedef struct brc_device_request {
    const char *selector; /* "auto", "cpu", "opencl:N", "opencl:auto" (of several ranks each takes one in turn),
                             "target:N"; borrowed during the call */
    brc_precision precision;
    bool many_materials;       /* kernels gather material constants per element instead of taking them as scalars */
    int n_threads;             /* cpu: 0 = as OpenMP decides */
    const char *kernel_folder; /* NULL: embedded sources; else read them from there (OpenCL only) */
    int lanes;                 /* 0: the device's own choice; otherwise W, for tests */
    bool exact; /* round every product and every sum by itself (no fused multiply-add), so that all devices
                   give the same bits; slower: the cpu then uses its baseline instruction set */
} brc_device_request;

/* Open. BRC_BAD_INPUT for a selector that does not parse or names a device that is not there (the sentence lists the
 * ones that are), BRC_DEVICE_FAILED with device, options and the whole compiler log. */
brc_status brc_device_open(brc_context *context, const brc_device_request *request, brc_device **out);
void brc_device_close(brc_device **device);
const brc_device_info *brc_device_get_info(const brc_device *device);
brc_precision brc_device_get_precision(const brc_device *device);
bool brc_device_has_many_materials(const brc_device *device);
/* Whether it was asked to be (brc_device_request). */
bool brc_device_is_exact(const brc_device *device);
/* W: elements one work-item handles; C: elements a slice holds (a multiple of W). Storage uses C. */
int brc_device_lanes(const brc_device *device);
int brc_device_slice(const brc_device *device);
/* Bytes now held in buffers. */
int64_t brc_device_bytes(const brc_device *device);
/* What a run is made of, by name: kernels that were launched, with how often; buffers held now, those of one name
 * together, with their bytes. At most `most` of them go to out; returns how many there are. Names are borrowed until
 * the device closes, or the buffer is freed. */
typedef struct brc_device_item {
    const char *name;
    int64_t number; /* launches, or bytes */
} brc_device_item;
int brc_device_launched(const brc_device *device, int most, brc_device_item *out);
int brc_device_buffers(const brc_device *device, int most, brc_device_item *out);

/* What the host asked of the device so far. waits: times it stood still until all that was asked before was done:
 * reads, writes, brc_device_wait, buffers (which are cleared before they are given). */
typedef struct brc_device_counts {
    int64_t launches, waits, read_bytes, written_bytes, copied_bytes;
} brc_device_counts;
brc_device_counts brc_device_counted(const brc_device *device);

/* Zeroed buffer of `bytes` bytes (0 is allowed and gives a valid dummy). what: for sentences, copied.
 * BRC_DEVICE_FAILED: "device ... has no room for <what>: N bytes asked, M held, L allowed in one buffer". */
brc_status brc_buffer_create(brc_device *device, brc_buffer **out, int64_t bytes, const char *what);
void brc_buffer_free(brc_buffer **buffer);
/* The memory of `of` under another name, as scratch: numbers in it belong to no rows, and what was in `of` is lost. To
 * be freed before `of`; counts no bytes. BRC_NO_MEMORY. */
brc_status brc_buffer_create_scratch(brc_buffer *of, brc_buffer **out);
int64_t brc_buffer_bytes(const brc_buffer *buffer);
/* The memory itself, where the device is the cpu and works in the host's; NULL: it must be read. Kernels that were
 * launched may still write it (brc_device_wait). */
void *brc_buffer_host(const brc_buffer *buffer);
/* Blocking copies, ordered after all launches so far. */
brc_status brc_buffer_write(brc_buffer *buffer, int64_t offset, const void *data, int64_t bytes);
/* All of an array that was not written yet; what follows is 0. On the cpu it has the pages of memory that ranks have in
 * common, once a machine, where it belongs to no rows (shares.h). */
brc_status brc_buffer_write_common(brc_buffer *buffer, const brc_common_memory *memory);
brc_status brc_buffer_read(brc_buffer *buffer, int64_t offset, void *data, int64_t bytes);
/* The first bytes to the rank that writes files (../base/file.h) alone; nothing is written to `data` of others. */
brc_status brc_buffer_read_for_file(brc_buffer *buffer, void *data, int64_t bytes);
/* Not blocking: dst and src must not overlap. */
brc_status brc_buffer_copy(brc_buffer *dst, brc_buffer *src, int64_t bytes);
brc_status brc_buffer_fill_zero(brc_buffer *buffer);

/* One kernel argument. Scalars named real are converted to the run's precision: STATE to `state`, COEFF to `coeff`. */
typedef enum brc_arg_kind { BRC_ARG_BUFFER, BRC_ARG_INT, BRC_ARG_STATE, BRC_ARG_COEFF, BRC_ARG_DOUBLE } brc_arg_kind;
typedef struct brc_arg {
    brc_arg_kind kind;
    union {
        brc_buffer *buffer; /* NULL: a dummy buffer that the kernel must not touch */
        int32_t integer;
        double real;
    } value;
} brc_arg;
#define BRC_BUF(b) ((brc_arg){.kind = BRC_ARG_BUFFER, .value.buffer = (b)})
#define BRC_INT(i) ((brc_arg){.kind = BRC_ARG_INT, .value.integer = (int32_t)(i)})
#define BRC_STATE(x) ((brc_arg){.kind = BRC_ARG_STATE, .value.real = (x)})
#define BRC_COEFF(x) ((brc_arg){.kind = BRC_ARG_COEFF, .value.real = (x)})
#define BRC_DBL(x) ((brc_arg){.kind = BRC_ARG_DOUBLE, .value.real = (x)})

/* Uses of a parameter: a value, or an array by the markers of portable.h. */
typedef enum brc_use {
    BRC_USE_VALUE,
    BRC_USE_OWN,
    BRC_USE_GATHER,
    BRC_USE_PUT,
    BRC_USE_UPDATE,
    BRC_USE_FLAG,
    BRC_USE_SPREAD,
    BRC_USE_SCATTER
} brc_use;
static inline bool brc_use_writes(brc_use use)
{
    return use >= BRC_USE_PUT;
}

/* A kernel of the run's instance, found once by name; owned by the device. BRC_INTERNAL: no such kernel. */
typedef struct brc_kernel brc_kernel;
brc_status brc_kernel_find(brc_device *device, const char *name, brc_kernel **out);
const char *brc_kernel_name(const brc_kernel *kernel);
/* Its parameters, as the text in kernels/ has them: how many (0: they cannot be read), and name and kind of the
 * k-th. */
int brc_kernel_parameters(const brc_kernel *kernel);
brc_arg_kind brc_kernel_parameter(const brc_kernel *kernel, int k, char *name, size_t bytes);
/* How it uses its k-th parameter, by the marker in the text (portable.h). */
brc_use brc_kernel_use(const brc_kernel *kernel, int k);
/* Enqueue over `n_items` work-items (FOR_EACH_ITEM: one each; FOR_EACH_SLICE: n_items = slices * C / W). Launches run
 * in order; nothing waits. The number and kinds of arguments are checked against the kernel's own in debug builds. */
brc_status brc_kernel_launch(brc_kernel *kernel, int64_t n_items, int n_args, const brc_arg *args);
#define BRC_LAUNCH(kernel, n_items, ...)                                                                               \
    brc_kernel_launch((kernel), (n_items), (int)(sizeof((brc_arg[]){__VA_ARGS__}) / sizeof(brc_arg)),                  \
                      (brc_arg[]){__VA_ARGS__})
/* Launches over all groups or rows of elements, from here on: over these groups of W alone (n, ascending, borrowed
 * until the next call). NULL: over all. Only on the cpu of one rank; elsewhere, and of kernels without FOR_EACH_GROUP
 * and FOR_EACH_ROW (portable.h), launches stay whole. */
void brc_device_choose_groups(brc_device *device, int32_t n, const int32_t *groups);
/* Whether it can. */
bool brc_device_chooses_groups(const brc_device *device);
/* Wait for everything enqueued so far; reports device errors. */
brc_status brc_device_wait(brc_device *device);

#endif
