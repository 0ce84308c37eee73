/* The inside of a device: shared by the files of this folder, nobody else. device.c checks, counts and names; a backend
 * does the work through its table of functions. */
#ifndef BRC_DEVICE_INTERNAL_H
#define BRC_DEVICE_INTERNAL_H

#include "kernel_signature.h"
#include "shares.h"

enum { BRC_REASON_BYTES = 256 };

/* A backend. Functions returning bool give false for "no room", with the reason in `reason` (may stay ""). */
typedef struct brc_backend {
    /* Set up device->inside, lanes and slice, and complete device->info. A failed open leaves nothing to close. */
    brc_status (*open)(brc_device *device, const brc_device_request *request);
    void (*close)(brc_device *device);
    /* Zeroed memory; bytes > 0. */
    bool (*allocate)(brc_device *device, int64_t bytes, void **memory, char reason[BRC_REASON_BYTES]);
    void (*release)(brc_device *device, void *memory, int64_t bytes);
    brc_status (*write)(brc_device *device, void *memory, int64_t offset, const void *data, int64_t bytes);
    brc_status (*read)(brc_device *device, void *memory, int64_t offset, void *data, int64_t bytes);
    brc_status (*copy)(brc_device *device, void *to, void *from, int64_t bytes);
    brc_status (*zero)(brc_device *device, void *memory, int64_t bytes);
    /* Fill kernel->function (and kernel->inside); BRC_INTERNAL with a sentence when there is no such kernel. */
    brc_status (*find)(brc_kernel *kernel);
    void (*forget)(brc_kernel *kernel);
    /* Items [first, n_items) of an n_items that is the first argument. */
    brc_status (*launch)(brc_kernel *kernel, int64_t first, int64_t n_items, int n_args, const brc_arg *args);
    brc_status (*wait)(brc_device *device);
} brc_backend;

extern const brc_backend brc_backend_cpu, brc_backend_opencl, brc_backend_target;

struct brc_device {
    brc_context *context; /* borrowed */
    const brc_backend *backend;
    brc_device_info info;
    brc_precision precision;
    bool many_materials, exact;
    int lanes;                 /* W */
    int slice;                 /* C */
    int64_t bytes;             /* held in buffers */
    brc_device_counts counts;  /* but for launches, which kernels count */
    void *dummy;               /* memory of 64 bytes for arguments that are NULL; not counted */
    int32_t n_chosen;          /* groups that launches go over */
    const int32_t *chosen;     /* [n_chosen]; NULL: all */
    brc_kernel *kernels;       /* found so far, a list */
    brc_buffer *buffers;       /* held now, a list, the youngest first */
    struct brc_shares *shares; /* of several ranks; NULL: there is one (shares.h) */
    void *inside;              /* the backend's own */
};

struct brc_buffer {
    brc_device *device;     /* borrowed */
    void *memory;           /* the backend's handle */
    int64_t bytes;          /* as asked for */
    int64_t held;           /* as allocated: at least one line */
    brc_array_of of;        /* how it lies (shares.h) */
    int64_t each;           /* bytes of one of those */
    int64_t number;         /* bytes of a number; 0: not known */
    int64_t numbers, block; /* BRC_OF_BLOCKS: of so many numbers, and of each block */
    int where;              /* where its rows are right (shares_internal.h) */
    bool filled;            /* rows of all were brought together since pages were given back */
    int64_t given_back;     /* launches until then */
    int64_t set;            /* number of the set (shares_internal.h) whose rows came since it was written; 0: none */
    bool marked;            /* flags are set at rows of other ranks that these do not know of */
    bool is_scratch;        /* memory of another one, not in the device's list */
    char what[64];
    brc_buffer *older, *younger; /* of the device's list */
};

struct brc_kernel {
    brc_device *device; /* borrowed */
    brc_kernel *next;
    char name[64];
    int64_t launches;
    brc_kernel_signature signature;
    void (*function)(void); /* C builds */
    void *inside;           /* the backend's own */
};

/* "opencl:0 (NVIDIA H100, 555.42)": the device in sentences. */
void brc_device_describe(const brc_device_info *info, char *text, size_t bytes);

/* One argument as the kernel sees it: an int, a number of the run's precision, or the buffer's memory. */
typedef struct brc_packed_arg {
    union {
        int32_t integer;
        float single;
        double dbl;
        void *memory;
    } value;
    size_t bytes;
    char type; /* 'i', 'f', 'd' or 'p' */
} brc_packed_arg;
brc_packed_arg brc_arg_pack(const brc_device *device, const brc_arg *arg);

/* The list with some kinds only, a set of bits 1 << brc_device_kind: looking for OpenCL devices starts every driver. */
brc_status brc_device_list_look(brc_context *context, unsigned kinds, brc_device_list **out);
/* Parts of the list, one per backend: append what there is. */
brc_status brc_device_list_add(brc_context *context, brc_device_list *list, const brc_device_info *info);
brc_status brc_device_cpu_list(brc_context *context, brc_device_list *list);
brc_status brc_device_opencl_list(brc_context *context, brc_device_list *list);
brc_status brc_device_target_list(brc_context *context, brc_device_list *list);

#endif
