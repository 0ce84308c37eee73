/* Shared by the tests of host/commands: cmocka, numbers within a tolerance, the program run as a user runs it. */
#ifndef BRC_TEST_COMMANDS_SUPPORT_H
#define BRC_TEST_COMMANDS_SUPPORT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include "../../host/base/status.h"

#define assert_near(value, expected, tolerance) assert_true(fabs((value) - (expected)) <= (tolerance))

/* Run the program with a shell-quoted argument line; returns its exit code. stdout and stderr are kept as text in
 * static storage until the next run. */
int test_program(const char *arguments);
const char *test_program_stdout(void);
const char *test_program_stderr(void);

/* A new folder below this one with a scene.yaml of this text, test_folder() until it is removed; 0: it is there, as of
 * cmocka's setups. One at a time. */
int test_make_folder(const char *scene);
const char *test_folder(void);
/* A teardown: the folder with all that is in it. */
int test_remove_folder(void **state);
/* For tests of the commands' own functions: setup and teardown of a context that logs errors alone, and of an empty
 * folder; fails the test with what the context says. */
extern brc_context *test_context;
int test_begin(void **state);
int test_end(void **state);
void test_done(brc_status status);
/* The text of a file of the folder, in static storage until the next is asked for; fails the test where there is
 * none. */
const char *test_text_of(const char *name);
/* The number behind the first `mark` in a text; fails the test where there is none. */
double test_number_behind(const char *text, const char *mark);

#endif
