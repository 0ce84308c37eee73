/* Launches over some groups of elements. */
#include "device_internal.h"

void brc_device_choose_groups(brc_device *device, int32_t n, const int32_t *groups)
{
    const bool can = brc_device_chooses_groups(device);
    device->n_chosen = can ? n : 0;
    device->chosen = can ? groups : NULL;
}

bool brc_device_chooses_groups(const brc_device *device)
{
    return device->backend == &brc_backend_cpu && !device->shares;
}
