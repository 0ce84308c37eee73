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

/* A new folder below this one with a scene.yaml of this text: its name, in static storage; NULL: it could not be made. One at a time. */
const char *test_scene_folder(const char *text);
/* Removed with all that is in it; 0 as of cmocka's teardowns. */
int test_remove_folder(void);

#endif
