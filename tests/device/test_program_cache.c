/* The cache of compiled programs, without a compiler: where it is, what it gives back, what goes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "../../host/base/memory.h"
#include "../../host/device/program_cache.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define HOME BRC_BUILD_DIR_PATH "/cache-test"

static int files_in(const char *folder, bool drop)
{
    DIR *const list = opendir(folder);
    int n = 0;
    for (struct dirent *d = list ? readdir(list) : NULL; d; d = readdir(list)) {
        char path[1000];
        if (d->d_name[0] == '.') continue;
        ++n;
        snprintf(path, sizeof path, "%s/%s", folder, d->d_name);
        if (drop) assert_int_equal(remove(path), 0);
    }
    if (list) closedir(list);
    return n;
}

static void assert_found(brc_context *context, const char *key, const char *expected)
{
    size_t bytes = 0;
    unsigned char *const found = brc_program_cache_find(context, key, &bytes);
    if (!expected)
        assert_null(found);
    else {
        assert_non_null(found);
        assert_int_equal(bytes, strlen(expected));
        assert_memory_equal(found, expected, bytes);
    }
    brc_memory_free(found);
}

static void keep(brc_context *context, const char *key, const char *binary)
{
    brc_program_cache_keep(context, key, (const unsigned char *)binary, strlen(binary));
}

static void the_folder_is_the_environments(void **unused)
{
    (void)unused;
    static const struct {
        const char *own, *cache, *home, *folder; /* NULL: nothing is kept */
    } cases[] = {{NULL, NULL, HOME, HOME "/.cache/breccia/opencl"},
                 {NULL, "relative", HOME, HOME "/.cache/breccia/opencl"},
                 {"", HOME "/xdg", HOME, HOME "/xdg/breccia/opencl"},
                 {HOME "/own", HOME "/xdg", HOME, HOME "/own"},
                 {"off", HOME "/xdg", HOME, NULL},
                 {NULL, NULL, NULL, NULL}};
    static const char *const folders[] = {HOME "/.cache/breccia/opencl", HOME "/xdg/breccia/opencl", HOME "/own"};
    brc_context *context = brc_context_create();
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        const char *const names[] = {"BRECCIA_OPENCL_CACHE", "XDG_CACHE_HOME", "HOME"}, *const values[] = {
                                                                                            cases[k].own,
                                                                                            cases[k].cache,
                                                                                            cases[k].home};
        for (int v = 0; v < 3; ++v)
            assert_int_equal(values[v] ? setenv(names[v], values[v], 1) : unsetenv(names[v]), 0);
        for (int f = 0; f < 3; ++f)
            files_in(folders[f], true);
        keep(context, "key", "program");
        for (int f = 0; f < 3; ++f)
            assert_int_equal(files_in(folders[f], false), cases[k].folder && strcmp(folders[f], cases[k].folder) == 0);
        assert_found(context, "key", cases[k].folder ? "program" : NULL);
        assert_found(context, "another key", NULL);
    }
    brc_context_free(&context);
}

static void a_later_program_replaces_an_earlier_one_and_a_folder_that_is_none_is_no_failure(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    assert_int_equal(setenv("BRECCIA_OPENCL_CACHE", HOME "/own", 1), 0);
    keep(context, "key", "program");
    keep(context, "key", "another program");
    assert_found(context, "key", "another program");
    assert_int_equal(setenv("BRECCIA_OPENCL_CACHE", "/dev/null/there", 1), 0);
    keep(context, "key", "program");
    assert_found(context, "key", NULL);
    assert_string_equal(brc_context_message(context), "");
    brc_context_free(&context);
}

static void what_was_not_used_for_longest_goes(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    char key[32];
    enum { MOST = 48 };
    assert_int_equal(setenv("BRECCIA_OPENCL_CACHE", HOME "/own", 1), 0);
    files_in(HOME "/own", true);
    for (int k = 0; k < MOST; ++k) {
        snprintf(key, sizeof key, "key %d", k);
        keep(context, key, key);
    }
    assert_found(context, "key 0", "key 0"); /* used now */
    keep(context, "one more", "program");
    assert_int_equal(files_in(HOME "/own", false), MOST);
    assert_found(context, "key 0", "key 0");
    assert_found(context, "key 1", NULL);
    assert_found(context, "one more", "program");
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_folder_is_the_environments),
        cmocka_unit_test(a_later_program_replaces_an_earlier_one_and_a_folder_that_is_none_is_no_failure),
        cmocka_unit_test(what_was_not_used_for_longest_goes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
