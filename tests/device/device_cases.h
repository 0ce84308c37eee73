/* One test body over every backend: the claims device.h makes, on the devices of one kind. */
#ifndef BRC_TESTS_DEVICE_CASES_H
#define BRC_TESTS_DEVICE_CASES_H

#include "../../host/device/device.h"

/* Run all cases on every usable device of the kind; returns the exit code of the test: 77 (skipped, with a line saying
 * why) when there is none. */
int device_cases_run(brc_device_kind kind);

#endif
