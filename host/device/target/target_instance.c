/* What a library of one kernel instance shows of it to the plug-in beside it (target_plugin.c, BRC_TARGET_APART). */
#include "../target_plugin.h"
#include "kernel_hash.h"

extern const brc_kernel_instance BRC_INSTANCE;

__attribute__((visibility("default"))) const brc_kernel_instance *brc_target_instance_get(uint64_t *kernels_hash);
const brc_kernel_instance *brc_target_instance_get(uint64_t *kernels_hash)
{
    *kernels_hash = BRC_KERNEL_TEXTS_HASH;
    return &BRC_INSTANCE;
}
