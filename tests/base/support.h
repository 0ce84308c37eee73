/* Shared by the tests of host/base: a fresh folder, and stderr caught as text. */
#ifndef BRC_TEST_BASE_SUPPORT_H
#define BRC_TEST_BASE_SUPPORT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include "../../host/base/status.h"

/* Redirect stderr into a temporary file; the end gives the text caught (static storage) and restores stderr. */
void test_catch_stderr(void);
const char *test_caught_stderr(void);
/* A new empty folder under the current one, its path in static storage. */
const char *test_new_folder(void);

#endif
