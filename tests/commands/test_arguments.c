#include "support.h"
#include "../../host/commands/command.h"
#include <string.h>

typedef struct parsed {
    brc_context *context;
    brc_arguments arguments;
    brc_status status;
} parsed;

static parsed parse(const brc_command *command, int n, const char *const *words)
{
    static brc_arguments arguments; /* large */
    parsed p = {.context = brc_context_create()};
    p.status = brc_arguments_parse(p.context, command, n, words, &arguments);
    p.arguments = arguments;
    return p;
}
#define PARSE(command, ...)                                                                                            \
    parse((command), (int)(sizeof((const char *[]){__VA_ARGS__}) / sizeof(char *)), (const char *[]){__VA_ARGS__})

static void refused(const brc_command *command, int n, const char *const *words, const char *sentence)
{
    parsed p = parse(command, n, words);
    assert_int_equal(p.status, BRC_BAD_INPUT);
    if (!strstr(brc_context_message(p.context), sentence))
        fail_msg("'%s' not in '%s'", sentence, brc_context_message(p.context));
    brc_context_free(&p.context);
}
#define REFUSED(sentence, command, ...)                                                                                \
    refused((command), (int)(sizeof((const char *[]){__VA_ARGS__}) / sizeof(char *)), (const char *[]){__VA_ARGS__},   \
            (sentence))

static void long_and_short_options_mean_the_same(void **state)
{
    (void)state;
    const parsed tried[] = {
        PARSE(&brc_command_run, "scene.yaml", "--output", "dir"), PARSE(&brc_command_run, "-o", "dir", "scene.yaml"),
        PARSE(&brc_command_run, "--output=dir", "scene.yaml"), PARSE(&brc_command_run, "-odir", "scene.yaml")};
    for (size_t k = 0; k < sizeof tried / sizeof *tried; ++k) {
        parsed p = tried[k];
        assert_int_equal(p.status, BRC_OK);
        assert_string_equal(brc_arguments_value(&p.arguments, "output"), "dir");
        assert_int_equal(p.arguments.n_positional, 1);
        assert_string_equal(p.arguments.positional[0], "scene.yaml");
        brc_context_free(&p.context);
    }
}

static void repeated_overrides_keep_their_order(void **state)
{
    (void)state;
    parsed p = PARSE(&brc_command_run, "s", "--set", "a=1", "-s", "b=2", "--set=c=3");
    int n;
    const char *const *values = brc_arguments_values(&p.arguments, "set", &n);
    assert_int_equal(n, 3);
    assert_string_equal(values[0], "a=1");
    assert_string_equal(values[1], "b=2");
    assert_string_equal(values[2], "c=3");
    brc_context_free(&p.context);
}

static void an_unknown_option_is_answered_with_the_nearest(void **state)
{
    (void)state;
    REFUSED("did you mean '--precision'?", &brc_command_run, "s", "--precison", "mixed");
    REFUSED("no option '--restart'", &brc_command_run, "s", "--restart");
}

static void wrong_numbers_of_values_and_operands_are_refused(void **state)
{
    (void)state;
    REFUSED("--output needs a value DIR", &brc_command_run, "s", "-o");
    REFUSED("--output is given twice", &brc_command_run, "s", "-o", "a", "-o", "b");
    REFUSED("--list takes no value", &brc_command_reproduce, "--list=x");
    REFUSED("unexpected 'b'", &brc_command_run, "a", "b");
    REFUSED("SCENE is missing", &brc_command_run, "-o", "a");
}

static void all_that_is_wrong_is_told_in_one_pass(void **state)
{
    (void)state;
    const char *const wrong[] = {"--restart", "-o", "a", "-o", "b", "--list", "--set"};
    const char *const told[] = {"no option '--restart'", "--output is given twice", "no option '--list'",
                                "--set needs a value", "SCENE is missing"};
    for (size_t k = 0; k < sizeof told / sizeof *told; ++k)
        refused(&brc_command_run, (int)(sizeof wrong / sizeof *wrong), wrong, told[k]);
    parsed p = PARSE(&brc_command_run, "s", "--restart", "7", "t"); /* 7 may be its value */
    assert_null(strstr(brc_context_message(p.context), "unexpected '7'"));
    assert_non_null(strstr(brc_context_message(p.context), "unexpected 't'"));
    brc_context_free(&p.context);
}

static void help_is_asked_for_anywhere(void **state)
{
    (void)state;
    parsed p = PARSE(&brc_command_run, "s", "-h", "--nonsense");
    assert_int_equal(p.status, BRC_OK);
    assert_true(p.arguments.help);
    brc_context_free(&p.context);
}

static void numbers_out_of_range_and_with_trailing_text_are_refused(void **state)
{
    (void)state;
    const char *const wrong[] = {"-1", "5000", "2x", "", "1e3", "99999999999999999999"};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        parsed p = PARSE(&brc_command_run, "s", "--threads", wrong[k]);
        assert_int_equal(p.status, BRC_OK);
        int64_t value;
        assert_int_equal(brc_arguments_integer(p.context, &p.arguments, "threads", 0, 4096, 0, &value), BRC_BAD_INPUT);
        brc_context_free(&p.context);
    }
    parsed p = PARSE(&brc_command_run, "s", "--threads", "2");
    int64_t value;
    assert_int_equal(brc_arguments_integer(p.context, &p.arguments, "threads", 0, 4096, 0, &value), BRC_OK);
    assert_int_equal(value, 2);
    brc_context_free(&p.context);
}

static void lists_are_split_at_commas_and_empty_pieces_refused(void **state)
{
    (void)state;
    const char *pieces[3];
    char good[] = "1e4,1e5,1e6", empty[] = "a,,b", many[] = "a,b,c,d", last[] = "a,";
    assert_int_equal(brc_text_split(good, 3, pieces), 3);
    assert_string_equal(pieces[2], "1e6");
    assert_int_equal(brc_text_split(empty, 3, pieces), -1);
    assert_int_equal(brc_text_split(many, 3, pieces), -1);
    assert_int_equal(brc_text_split(last, 3, pieces), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_and_short_options_mean_the_same),
        cmocka_unit_test(repeated_overrides_keep_their_order),
        cmocka_unit_test(an_unknown_option_is_answered_with_the_nearest),
        cmocka_unit_test(wrong_numbers_of_values_and_operands_are_refused),
        cmocka_unit_test(all_that_is_wrong_is_told_in_one_pass),
        cmocka_unit_test(help_is_asked_for_anywhere),
        cmocka_unit_test(numbers_out_of_range_and_with_trailing_text_are_refused),
        cmocka_unit_test(lists_are_split_at_commas_and_empty_pieces_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
