#include "support.h"
#include "../../host/base/version.h"
#include <stdio.h>
#include <string.h>

static void the_version_is_three_numbers(void **state)
{
    (void)state;
    int major, minor, patch;
    char rest;
    assert_int_equal(sscanf(brc_version(), "%d.%d.%d%c", &major, &minor, &patch, &rest), 3);
}

static void the_commit_is_a_hash_or_unknown(void **state)
{
    (void)state;
    const char *commit = brc_version_commit();
    if (strcmp(commit, "unknown") == 0) return;
    assert_int_equal(strspn(commit, "0123456789abcdef"), 40);
    assert_true(commit[40] == '\0' || strcmp(commit + 40, "-changed") == 0);
}

static void the_compiler_is_named_with_its_version(void **state)
{
    (void)state;
    assert_true(strpbrk(brc_version_compiler(), "123456789") != NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_version_is_three_numbers),
        cmocka_unit_test(the_commit_is_a_hash_or_unknown),
        cmocka_unit_test(the_compiler_is_named_with_its_version),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
