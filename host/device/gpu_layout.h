/* How work lies on a GPU (docs/notebook/devices.md): one element a work-item, and these. */
#ifndef BRC_DEVICE_GPU_LAYOUT_H
#define BRC_DEVICE_GPU_LAYOUT_H

/* Work-items a group, in double and in the other precisions, which bound what kernels have of registers and of local
 * memory and share what they gather (bench/results/2026-11-27-nvidia-h200); elements a slice of the storage. */
enum { BRC_GPU_GROUP_DOUBLE = 128, BRC_GPU_GROUP = 256, BRC_GPU_SLICE = 32 };
/* Work-items that do a block of numbers together: CREW of kernels/core/portable.h. */
enum { BRC_GPU_CREW = 32 };

#endif
