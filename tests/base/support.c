/* Shared by the tests of host/base. */
#include "support.h"
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static FILE *caught;
static int real_stderr = -1;

void test_catch_stderr(void)
{
    caught = tmpfile();
    assert_non_null(caught);
    fflush(stderr);
    real_stderr = dup(STDERR_FILENO);
    dup2(fileno(caught), STDERR_FILENO);
}

const char *test_caught_stderr(void)
{
    static char text[65536];
    fflush(stderr);
    dup2(real_stderr, STDERR_FILENO);
    close(real_stderr);
    rewind(caught);
    text[fread(text, 1, sizeof text - 1, caught)] = '\0';
    fclose(caught);
    return text;
}

const char *test_new_folder(void)
{
    static char path[64];
    snprintf(path, sizeof path, "base-test-XXXXXX");
    assert_non_null(mkdtemp(path));
    return path;
}
