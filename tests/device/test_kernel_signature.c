/* Reading parameter lists from the embedded kernel texts, and pasting the texts together. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "../../host/base/memory.h"
#include "../../host/device/kernel_signature.h"
#include "../../host/device/program_source.h"
#include "kernel_list.h"
#include <stdio.h>
#include <string.h>

static void a_parameter_list_is_read_letter_by_letter(void **unused)
{
    (void)unused;
    brc_kernel_signature of;
    brc_kernel_signature_read("vector_axpy", &of);
    assert_string_equal(of.kinds, "isbb");
    assert_int_equal(of.use[1], BRC_USE_VALUE);
    assert_int_equal(of.use[2], BRC_USE_OWN);
    assert_int_equal(of.use[3], BRC_USE_UPDATE);
    brc_kernel_signature_read("contact_pieces", &of);
    assert_string_equal(of.kinds, "isssbbbbb");
    assert_int_equal(of.use[7], BRC_USE_GATHER);
    assert_int_equal(of.use[8], BRC_USE_PUT);
    brc_kernel_signature_read("vector_ax", &of); /* the beginning of a name is another name */
    assert_int_equal(of.n, 0);
}

static void every_kernel_of_the_list_can_be_checked(void **unused)
{
    (void)unused;
#define NAME(name) #name,
    static const char *const names[] = {BRC_KERNEL_LIST(NAME)};
    int unreadable = 0;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; ++k) {
        brc_kernel_signature of;
        brc_kernel_signature_read(names[k], &of);
        if (of.n) continue;
        printf("the parameters of kernel %s cannot be read from its text: spell them out\n", names[k]);
        ++unreadable;
    }
    assert_int_equal(unreadable, 0);
}

static void a_pass_has_one_list_and_a_name_for_each_of_its_readings(void **unused)
{
    (void)unused;
    brc_kernel_signature whole, listed;
    brc_kernel_signature_read("dlsm_gradient", &whole);
    brc_kernel_signature_read("dlsm_gradient_listed", &listed);
    assert_string_equal(whole.kinds, "ibbbbbbb");
    assert_string_equal(listed.kinds, "iibbbbbbbb");
    assert_int_equal(strncmp(listed.name[1], "n,", 2), 0);
    assert_int_equal(strncmp(listed.name[2], "list", 4), 0);
    for (int k = 1; k < whole.n; ++k) {
        assert_ptr_equal(whole.name[k], listed.name[k + 2]);
        assert_int_equal(whole.use[k], listed.use[k + 2]);
    }
    brc_kernel_signature_read("dlsm_gradient_list", &listed);
    assert_int_equal(listed.n, 0);
}

/* The tokens that a marker stands for, in portable.h. */
static void markers_are_const_where_they_do_not_write(void **unused)
{
    (void)unused;
    static const char *const markers[] = {
        [BRC_USE_OWN] = "OWN",         [BRC_USE_GATHER] = "GATHER", [BRC_USE_PUT] = "PUT",
        [BRC_USE_UPDATE] = "UPDATE",   [BRC_USE_FLAG] = "FLAG",     [BRC_USE_SPREAD] = "SPREAD",
        [BRC_USE_SCATTER] = "SCATTER",
    };
    const char *const text = brc_kernel_text("core/portable.h");
    for (int use = BRC_USE_OWN; use <= BRC_USE_SCATTER; ++use) {
        char define[96];
        const bool writes = brc_use_writes((brc_use)use);
        assert_int_equal(writes, use >= BRC_USE_PUT);
        snprintf(define, sizeof define, "\n#define %s(type) GLOBAL %stype *restrict\n", markers[use],
                 writes ? "" : "const ");
        assert_non_null(strstr(text, define));
    }
}

static void the_pasted_text_holds_each_file_once_and_no_include(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    char *embedded = NULL, *read = NULL;
    assert_int_equal(brc_program_source(context, NULL, NULL, &embedded), BRC_OK);
    assert_null(strstr(embedded, "#include \"")); /* the C reading includes a system header */
    assert_ptr_equal(strstr(embedded, "#define BRC_KERNELS_HASH 0x"), embedded);
    const char *const first = strstr(embedded, "#line 1 \"core/portable.h\"");
    assert_non_null(first);
    assert_null(strstr(first + 1, "#line 1 \"core/portable.h\""));
    const char *const passes =
        strstr(embedded, "#line 1 \"models/dlsm/dlsm_passes.cl\""); /* but passes, which are read twice */
    assert_non_null(passes);
    assert_non_null(strstr(passes + 1, "#line 1 \"models/dlsm/dlsm_passes.cl\""));
    /* the files on disk give the same text, hash included: nothing was changed by embedding */
    assert_int_equal(brc_program_source(context, BRC_SOURCE_DIR_PATH "/kernels", NULL, &read), BRC_OK);
    assert_string_equal(embedded, read);
    brc_memory_free(embedded);
    brc_memory_free(read);
    brc_context_free(&context);
}

static int count_of(const char *text, const char *what)
{
    int n = 0;
    for (; (text = strstr(text, what)); text += strlen(what))
        ++n;
    return n;
}

#define NAME(name) #name,
static void a_part_of_the_text_holds_its_kernels_and_the_lines_of_the_others_are_empty(void **unused)
{
    (void)unused;
    brc_context *context = brc_context_create();
    static const char *const all[] = {BRC_KERNEL_LIST(NAME)};
    static const char *const few[] = {"dlsm_force_listed", "advance"};
    const brc_program_part whole = {sizeof all / sizeof *all, all}, part = {2, few};
    char *text = NULL, *same = NULL, *less = NULL;
    assert_int_equal(brc_program_source(context, NULL, NULL, &text), BRC_OK);
    assert_int_equal(brc_program_source(context, NULL, &whole, &same), BRC_OK);
    assert_string_equal(text, same);
    assert_int_equal(brc_program_source(context, NULL, &part, &less), BRC_OK);
    assert_int_equal(count_of(text, "\nKERNEL void"), whole.n);
    assert_int_equal(count_of(less, "\nKERNEL void"), 2);
    assert_int_equal(count_of(less, "\n"), count_of(text, "\n"));
    /* the pass in its second reading alone */
    const char *const pass = strstr(less, "KERNEL void PASS(dlsm_force)(");
    assert_non_null(pass);
    assert_true(pass > strstr(less, "#define PASS(name) name##_listed"));
    assert_non_null(strstr(less, "KERNEL void advance("));
    brc_memory_free(text);
    brc_memory_free(same);
    brc_memory_free(less);
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_parameter_list_is_read_letter_by_letter),
        cmocka_unit_test(every_kernel_of_the_list_can_be_checked),
        cmocka_unit_test(a_pass_has_one_list_and_a_name_for_each_of_its_readings),
        cmocka_unit_test(markers_are_const_where_they_do_not_write),
        cmocka_unit_test(the_pasted_text_holds_each_file_once_and_no_include),
        cmocka_unit_test(a_part_of_the_text_holds_its_kernels_and_the_lines_of_the_others_are_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
