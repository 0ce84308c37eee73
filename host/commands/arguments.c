/* Command lines: parsing against a table of options. */
#include "command.h"
#include "../scene/problem.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static int find_option(const brc_command *command, const char *name, size_t length)
{
    for (int k = 0; k < command->n_options; ++k)
        if (strlen(command->options[k].name) == length && memcmp(command->options[k].name, name, length) == 0) return k;
    return -1;
}

static int find_letter(const brc_command *command, char letter)
{
    for (int k = 0; k < command->n_options; ++k)
        if (command->options[k].letter == letter) return k;
    return -1;
}

static brc_status unknown_option(brc_context *context, const brc_command *command, const char *found)
{
    const char *names[BRC_OPTIONS_MOST + 1];
    int n = 0;
    for (; n < command->n_options; ++n)
        names[n] = command->options[n].name;
    names[n++] = "help";
    char word[64];
    snprintf(word, sizeof word, "%s", found + strspn(found, "-"));
    word[strcspn(word, "=")] = '\0';
    const char *nearest = brc_nearest_word(word, n, names);
    return BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: no option '%s'%s%s%s; `breccia %s --help` lists them",
                    command->name, found, nearest ? ", did you mean '--" : "", nearest ? nearest : "",
                    nearest ? "'?" : "", command->name);
}

/* Take one option at argv[*k]; *k moves on when its value is the next word, or may be that of an option there is not.
 */
static brc_status take_option(brc_context *context, const brc_command *command, int argc, const char *const *argv,
                              int *k, brc_arguments *out)
{
    const char *word = argv[*k];
    const char *value = NULL;
    int index;
    if (word[1] == '-') {
        const char *equals = strchr(word, '=');
        index = find_option(command, word + 2, equals ? (size_t)(equals - word) - 2 : strlen(word) - 2);
        if (equals) value = equals + 1;
    } else {
        index = find_letter(command, word[1]);
        if (word[2]) value = word + 2;
    }
    if (index < 0) {
        if (!value && *k + 1 < argc && argv[*k + 1][0] != '-' && out->n_positional == command->most) ++*k;
        return unknown_option(context, command, word);
    }
    const brc_option *option = &command->options[index];
    if (!option->value && value)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: --%s takes no value, found '%s'", command->name,
                        option->name, value);
    if (option->value && !value) {
        if (*k + 1 >= argc)
            return BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: --%s needs a value %s after it", command->name,
                            option->name, option->value);
        value = argv[++*k];
    }
    if (out->count[index] > 0 && !option->repeats)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: --%s is given twice; leave one", command->name,
                        option->name);
    if (out->count[index] == BRC_OPTION_REPEATS)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: --%s is given more than %d times", command->name,
                        option->name, BRC_OPTION_REPEATS);
    out->value[index][out->count[index]++] = value ? value : "";
    return BRC_OK;
}

brc_status brc_arguments_parse(brc_context *context, const brc_command *command, int argc, const char *const *argv,
                               brc_arguments *out)
{
    memset(out, 0, sizeof *out);
    out->command = command;
    bool options_end = false;
    brc_status first = BRC_OK, status;
    for (int k = 0; k < argc; ++k) {
        const char *word = argv[k];
        if (!options_end && (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0)) {
            out->help = true;
            return BRC_OK;
        }
        status = BRC_OK;
        if (!options_end && strcmp(word, "--") == 0)
            options_end = true;
        else if (!options_end && word[0] == '-' && word[1])
            status = take_option(context, command, argc, argv, &k, out);
        else if (out->n_positional == command->most)
            status = BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: unexpected '%s'; usage: breccia %s %s [OPTIONS]",
                              command->name, word, command->name, command->operands);
        else
            out->positional[out->n_positional++] = word;
        if (first == BRC_OK) first = status;
    }
    status = BRC_OK;
    if (out->n_positional < command->least)
        status = BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: %s is missing; usage: breccia %s %s [OPTIONS]",
                          command->name, command->operands, command->name, command->operands);
    return first == BRC_OK ? status : first;
}

const char *const *brc_arguments_values(const brc_arguments *arguments, const char *name, int *n)
{
    const int index = find_option(arguments->command, name, strlen(name));
    *n = index < 0 ? 0 : arguments->count[index];
    return index < 0 ? NULL : arguments->value[index];
}

const char *brc_arguments_value(const brc_arguments *arguments, const char *name)
{
    int n;
    const char *const *values = brc_arguments_values(arguments, name, &n);
    return n > 0 ? values[n - 1] : NULL;
}

brc_status brc_arguments_integer(brc_context *context, const brc_arguments *arguments, const char *name, int64_t low,
                                 int64_t high, int64_t otherwise, int64_t *out)
{
    *out = otherwise;
    const char *text = brc_arguments_value(arguments, name);
    if (!text) return BRC_OK;
    char *end;
    errno = 0;
    const long long value = strtoll(text, &end, 10);
    if (end == text || *end || errno == ERANGE || value < low || value > high)
        return BRC_FAIL(context, BRC_BAD_INPUT, "breccia %s: --%s is '%s', expected a whole number from %lld to %lld",
                        arguments->command->name, name, text, (long long)low, (long long)high);
    *out = value;
    return BRC_OK;
}

brc_status brc_precision_parse(brc_context *context, const char *text, brc_precision *out)
{
    for (int p = BRC_DOUBLE; p <= BRC_SINGLE; ++p)
        if (strcmp(text, brc_precision_name((brc_precision)p)) == 0) {
            *out = (brc_precision)p;
            return BRC_OK;
        }
    return BRC_FAIL(context, BRC_BAD_INPUT, "precision '%s' is unknown, expected double, mixed or single", text);
}

brc_status brc_arguments_precision(brc_context *context, const brc_arguments *arguments, brc_precision *out)
{
    const char *text = brc_arguments_value(arguments, "precision");
    return brc_precision_parse(context, text ? text : "double", out);
}

int brc_text_split(char *text, int most, const char **pieces)
{
    int n = 0;
    for (char *piece = text;;) {
        char *comma = strchr(piece, ',');
        if (comma) *comma = '\0';
        if (!*piece || n == most) return -1;
        pieces[n++] = piece;
        if (!comma) return n;
        piece = comma + 1;
    }
}
