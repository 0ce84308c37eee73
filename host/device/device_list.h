/* Devices of this machine as a list: printing it, as `breccia devices` shows it, and dealing it out to ranks. */
#ifndef BRC_DEVICE_LIST_H
#define BRC_DEVICE_LIST_H

#include "device.h"
#include <stdio.h>

/* Two lines a device (a third for the reason why one cannot be used), '*' before the one `auto` takes, and last the
 * sentence why it does. */
void brc_device_list_print(const brc_device_list *list, FILE *file);
/* Index in the list of the device `auto` takes for a precision, and the sentence why. */
int brc_device_list_choose(const brc_device_list *list, brc_precision precision, char *why, size_t bytes);
/* Index of the OpenCL device that rank number `local` of a machine takes: GPUs that have the precision in turn; where
 * there is none, the other usable drivers. -1: there is no OpenCL device. */
int brc_device_list_deal(const brc_device_list *list, brc_precision precision, int32_t local);
/* All ranks, with the device of each: rank 0 logs who computes where: rank, node, device. Nothing on one rank. */
brc_status brc_device_log_places(brc_context *context, const brc_device *device);

#endif
