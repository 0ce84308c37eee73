/* One test body over the devices other than the cpu: the same physics as there. */
#ifndef BRC_TESTS_SOLVER_BACKEND_CASES_H
#define BRC_TESTS_SOLVER_BACKEND_CASES_H

#include "../support.h"

/* Displacements of a shaken cube after 30 steps [3 n]; caller frees. */
double *backend_shaken(const char *device, const char *model, brc_precision precision, bool exact, int64_t *n);
/* Run all cases on one device, "opencl:0"; returns the exit code of the test: a skip with the reason where it is not
 * usable. */
int backend_cases_run(const char *device);

#endif
