/* Compiled once per {instruction set, precision, materials} with the definitions of portable.h, and once more as target
 * code for the plug-in. The table's name and the level come from the build (../CMakeLists.txt). */
#include "../kernel_instance.h"
#include "../../../kernels/kernels.h"
#include "kernel_list.h"

#define BRC_ENTRY(name) {#name, (void (*)(void))name},
static const brc_kernel_entry entries[] = {BRC_KERNEL_LIST(BRC_ENTRY)};

extern const brc_kernel_instance BRC_INSTANCE;
const brc_kernel_instance BRC_INSTANCE = {
    .level = BRC_LEVEL,
    .precision = BRC_PRECISION,
    .many_materials = BRC_MANY_MATERIALS,
    .lanes = BRC_LANES,
    .slice = BRC_SLICE,
    .first = &brc_first_item,
    .chosen = &brc_chosen,
    .n_chosen = &brc_n_chosen,
    .n = (int)(sizeof entries / sizeof entries[0]),
    .entries = entries,
};
