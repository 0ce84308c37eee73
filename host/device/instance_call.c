#include "instance_call.h"
#include "../base/memory.h"
#include <ffi.h>
#include <string.h>

/* A prepared call: libffi's description of one list of argument types. */
typedef struct prepared_call {
    int n_args;
    char types[BRC_KERNEL_MOST_ARGS]; /* letters of brc_packed_arg.type */
    ffi_type *ffi_types[BRC_KERNEL_MOST_ARGS];
    ffi_cif cif;
} prepared_call;

brc_status brc_instance_find(brc_kernel *kernel, const brc_kernel_instance *instance)
{
    for (int k = 0; k < instance->n; ++k)
        if (strcmp(instance->entries[k].name, kernel->name) == 0) {
            kernel->function = instance->entries[k].function;
            return BRC_OK;
        }
    return BRC_FAIL(kernel->device->context, BRC_INTERNAL, "there is no kernel '%s' among the %d of device %s",
                    kernel->name, instance->n, kernel->device->info.selector);
}

void brc_instance_forget(brc_kernel *kernel)
{
    brc_memory_free(kernel->inside);
    kernel->inside = NULL;
}

static ffi_type *ffi_type_of(char type)
{
    switch (type) {
    case 'i': return &ffi_type_sint32;
    case 'f': return &ffi_type_float;
    case 'd': return &ffi_type_double;
    default: return &ffi_type_pointer;
    }
}

static brc_status prepare(brc_kernel *kernel, int n_args, const brc_packed_arg *packed)
{
    prepared_call *call = kernel->inside;
    if (!call) BRC_TRY(BRC_ALLOCATE(kernel->device->context, &call, 1, kernel->name));
    kernel->inside = call;
    call->n_args = n_args;
    for (int a = 0; a < n_args; ++a) {
        call->types[a] = packed[a].type;
        call->ffi_types[a] = ffi_type_of(packed[a].type);
    }
    if (ffi_prep_cif(&call->cif, FFI_DEFAULT_ABI, (unsigned)n_args, &ffi_type_void, call->ffi_types) == FFI_OK)
        return BRC_OK;
    call->n_args = -1;
    return BRC_FAIL(kernel->device->context, BRC_INTERNAL, "kernel %s: libffi refuses its %d arguments", kernel->name,
                    n_args);
}

brc_status brc_instance_call(brc_kernel *kernel, int n_args, const brc_arg *args)
{
    brc_packed_arg packed[BRC_KERNEL_MOST_ARGS];
    void *values[BRC_KERNEL_MOST_ARGS];
    prepared_call *const call = kernel->inside;
    bool fits = call && call->n_args == n_args;
    for (int a = 0; a < n_args; ++a) {
        packed[a] = brc_arg_pack(kernel->device, &args[a]);
        values[a] = &packed[a].value;
        fits = fits && call->types[a] == packed[a].type;
    }
    if (!fits) BRC_TRY(prepare(kernel, n_args, packed));
    ffi_call(&((prepared_call *)kernel->inside)->cif, kernel->function, NULL, values);
    return BRC_OK;
}
