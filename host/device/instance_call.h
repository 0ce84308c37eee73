/* Calling a kernel of a C instance (cpu, target) by its function pointer, with the arguments of a launch. */
#ifndef BRC_INSTANCE_CALL_H
#define BRC_INSTANCE_CALL_H

#include "device_internal.h"
#include "kernel_instance.h"

/* Find kernel->name in the instance and fill kernel->function; BRC_INTERNAL when it is not there. */
brc_status brc_instance_find(brc_kernel *kernel, const brc_kernel_instance *instance);
void brc_instance_forget(brc_kernel *kernel);
/* Call through libffi; the call interface is prepared at the first launch and kept. */
brc_status brc_instance_call(brc_kernel *kernel, int n_args, const brc_arg *args);

#endif
