/* Shared by the tests of devices, and one test body over every backend: the claims device.h makes. */
#ifndef BRC_TESTS_DEVICE_CASES_H
#define BRC_TESTS_DEVICE_CASES_H

#include "../../host/device/device.h"

/* Open and close; the status, and the sentence left in the context. */
brc_status device_cases_open(brc_context *context, const brc_device_request *request);
/* The test fails when the context's sentence lacks `expected`. */
void device_cases_says(brc_context *context, const char *expected);
/* The first usable device of a kind; false, and why not, when there is none. */
bool device_cases_find(brc_device_kind kind, brc_device_info *info, char *why, size_t bytes);
/* Run all cases on every usable device of the kind; returns the exit code of the test: a skip when there is none. */
int device_cases_run(brc_device_kind kind);

#endif
