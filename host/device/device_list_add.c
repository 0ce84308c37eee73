#include "../base/memory.h"
#include "device_internal.h"
#include "device_list.h"

brc_status brc_device_list_add(brc_context *context, brc_device_list *list, const brc_device_info *info)
{
    BRC_TRY(brc_memory_resize(context, (void **)&list->items, list->n + 1, sizeof *list->items, "device list"));
    list->items[list->n++] = *info;
    return BRC_OK;
}
