/* Printing the list of devices, as `breccia devices` shows it. */
#ifndef BRC_DEVICE_LIST_H
#define BRC_DEVICE_LIST_H

#include "device.h"
#include <stdio.h>

/* Two lines a device (a third for the reason why one cannot be used), '*' before the one `auto` takes, and last the
 * sentence why it does. */
void brc_device_list_print(const brc_device_list *list, FILE *file);

#endif
