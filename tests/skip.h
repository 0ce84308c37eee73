/* Skips that ctest shows. A test program runs all it holds or skips as a whole: a skip inside a passing one would not
 * be seen. So what needs a driver or a tool is a program of its own, and its main returns this. */
#ifndef BRC_TESTS_SKIP_H
#define BRC_TESTS_SKIP_H

#include <stdio.h>
#include <stdlib.h>

/* The exit code of a program that cannot run here: 77, which ctest shows as skipped; 1, a failure, where BRC_NO_SKIPS
 * is set (.ci/run), since everything that quickstart installs must be there. */
static inline int test_skip(const char *why)
{
    const char *const none = getenv("BRC_NO_SKIPS");
    const int refused = none && none[0];
    printf("SKIPPED%s: %s\n", refused ? ", but BRC_NO_SKIPS is set" : "", why);
    return refused ? 1 : 77;
}

#endif
