/* All C instances in this program; the table is generated (CMakeLists.txt of this folder). */
#ifndef BRC_KERNEL_INSTANCES_H
#define BRC_KERNEL_INSTANCES_H

#include "kernel_instance.h"

extern const brc_kernel_instance *const brc_kernel_instances[];
extern const int brc_kernel_instance_count;

#endif
