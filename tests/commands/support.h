/* Shared by the tests of host/commands: cmocka, numbers within a tolerance, the program run as a user runs it. */
#ifndef BRC_TEST_COMMANDS_SUPPORT_H
#define BRC_TEST_COMMANDS_SUPPORT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>

#define assert_near(value, expected, tolerance) assert_true(fabs((value) - (expected)) <= (tolerance))

/* Run the program with a shell-quoted argument line; returns its exit code. stdout and stderr are kept as text in
 * static storage until the next run. */
int test_program(const char *arguments);
const char *test_program_stdout(void);
const char *test_program_stderr(void);

#endif
