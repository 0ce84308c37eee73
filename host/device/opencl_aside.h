/* Doing what a foreign driver may not survive in a child process. */
#ifndef BRC_OPENCL_ASIDE_H
#define BRC_OPENCL_ASIDE_H

#include "device_internal.h"

enum { BRC_OPENCL_LIST_SECONDS = 20 };

/* Describe the OpenCL devices of this process into rows[most]; returns how many. */
typedef int brc_opencl_lister(brc_device_info *rows, int most);

/* Run `lister` in a child and hand over its rows; *n of them. Where the child crashes, ends or takes longer than
 * `seconds`, *n is -1 and `why` says what happened. Never fails and never waits longer. */
void brc_opencl_aside(brc_opencl_lister *lister, double seconds, brc_device_info *rows, int most, int *n, char *why,
                      size_t bytes);

#endif
