/* Reading parameter lists from the embedded kernel texts, and pasting the texts together. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "../../host/base/memory.h"
#include "../../host/device/kernel_signature.h"
#include "../../host/device/program_source.h"
#include "../../kernels/kernel_list.h"
#include <stdio.h>
#include <string.h>

static void a_parameter_list_is_read_letter_by_letter(void **unused)
{
    (void)unused;
    char kinds[2][BRC_KERNEL_MOST_ARGS + 1];
    brc_kernel_signature("vector_axpy", kinds);
    assert_string_equal(kinds[0], "isbb");
    assert_string_equal(kinds[1], "");
    brc_kernel_signature("vector_gather", kinds);
    assert_string_equal(kinds[0], "ibbb");
    brc_kernel_signature("vector_ax", kinds); /* the beginning of a name is another name */
    assert_string_equal(kinds[0], "");
}

static void every_kernel_of_the_list_can_be_checked(void **unused)
{
    (void)unused;
#define NAME(name) #name,
    static const char *const names[] = {BRC_KERNEL_LIST(NAME)};
    int unreadable = 0;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        char kinds[2][BRC_KERNEL_MOST_ARGS + 1];
        brc_kernel_signature(names[k], kinds);
        if (kinds[0][0]) continue;
        printf("the parameters of kernel %s cannot be read from its text: spell them out\n", names[k]);
        ++unreadable;
    }
    assert_int_equal(unreadable, 0);
}

static void the_pasted_text_holds_each_file_once_and_no_include(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    char *embedded = NULL, *read = NULL;
    assert_int_equal(brc_program_source(context, NULL, &embedded), BRC_OK);
    assert_null(strstr(embedded, "#include \"")); /* the C reading includes a system header */
    assert_ptr_equal(strstr(embedded, "#define BRC_KERNELS_HASH 0x"), embedded);
    const char *const first = strstr(embedded, "#line 1 \"portable.h\"");
    assert_non_null(first);
    assert_null(strstr(first + 1, "#line 1 \"portable.h\""));
    /* the files on disk give the same text, hash included: nothing was changed by embedding */
    assert_int_equal(brc_program_source(context, BRC_SOURCE_DIR_PATH "/kernels", &read), BRC_OK);
    assert_string_equal(embedded, read);
    brc_memory_free(embedded);
    brc_memory_free(read);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_parameter_list_is_read_letter_by_letter),
        cmocka_unit_test(every_kernel_of_the_list_can_be_checked),
        cmocka_unit_test(the_pasted_text_holds_each_file_once_and_no_include),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
