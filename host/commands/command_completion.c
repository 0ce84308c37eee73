/* breccia completion: what a shell needs to complete commands, options and their words, from the tables of the
 * commands. */
#include "command.h"
#include "template.h"
#include <string.h>

/* "a|b|c" as words between blanks. */
static void print_words(const char *alternatives)
{
    for (const char *c = alternatives; *c; ++c)
        putchar(*c == '|' ? ' ' : *c);
}

static bool is_folder(const char *value)
{
    return strcmp(value, "DIR") == 0;
}
static bool is_file(const char *value)
{
    return strstr(value, "FILE") || strstr(value, "SCENE") || strstr(value, "STUDY");
}

/* Words or files that may stand for a value or an operand, as a shell command that fills COMPREPLY. */
static void print_reply(const char *value)
{
    if (strchr(value, '|')) {
        printf("COMPREPLY=($(compgen -W \"");
        print_words(value);
        printf("\" -- \"$word\"))");
    } else if (strcmp(value, "DEVICE") == 0) {
        printf("COMPREPLY=($(compgen -W \"auto cpu opencl:0 target:0\" -- \"$word\"))");
    } else if (is_folder(value)) {
        printf("COMPREPLY=($(compgen -d -- \"$word\"))");
    } else if (is_file(value)) {
        printf("COMPREPLY=($(compgen -f -- \"$word\"))");
    } else {
        printf("COMPREPLY=()");
    }
}

/* The scenes of `breccia new`, the cases of `breccia reproduce`, the commands for `breccia help`, else as a value. */
static void print_operand(const brc_command *command)
{
    if (strcmp(command->operands, "[COMMAND]") == 0) {
        printf("COMPREPLY=($(compgen -W \"$commands\" -- \"$word\"))");
    } else if (strcmp(command->operands, "[NAME]") == 0) {
        printf("COMPREPLY=($(compgen -W \"");
        for (int k = 0; k < brc_template_count; ++k)
            printf("%s%s", k ? " " : "", brc_templates[k].name);
        printf("\" -- \"$word\"))");
    } else if (strcmp(command->operands, "[CASE]") == 0) {
        printf("COMPREPLY=($(compgen -W \"$(breccia reproduce --list 2>/dev/null | cut -d' ' -f1)\" -- \"$word\"))");
    } else {
        print_reply(command->operands);
    }
}

/* `case` branches of the options that take a value, at the word before. */
static void print_values(const brc_command *command)
{
    for (int m = 0; m < command->n_options; ++m) {
        const brc_option *option = &command->options[m];
        if (!option->value) continue;
        printf("        %s:--%s", command->name, option->name);
        if (option->letter) printf("|%s:-%c", command->name, option->letter);
        printf(") ");
        print_reply(option->value);
        printf("; return;;\n");
    }
}

static void print_bash(void)
{
    printf("# bash completion of breccia; written by `breccia completion bash`\n_breccia()\n{\n    local "
           "word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}\n"
           "    local commands=\"");
    for (int k = 0; k < brc_command_count(); ++k)
        printf("%s%s", k ? " " : "", brc_command_at(k)->name);
    printf("\"\n    if [ \"$COMP_CWORD\" -eq 1 ]; then\n        COMPREPLY=($(compgen -W \"$commands --help --version\" "
           "-- \"$word\"))\n        return\n    fi\n    case $command:$before in\n");
    for (int k = 0; k < brc_command_count(); ++k)
        print_values(brc_command_at(k));
    printf("    esac\n    case $command:$word in\n");
    for (int k = 0; k < brc_command_count(); ++k) {
        const brc_command *command = brc_command_at(k);
        printf("        %s:-*) COMPREPLY=($(compgen -W \"", command->name);
        for (int m = 0; m < command->n_options; ++m)
            printf("--%s ", command->options[m].name);
        printf("--help\" -- \"$word\"));;\n        %s:*) ", command->name);
        print_operand(command);
        printf(";;\n");
    }
    printf("    esac\n}\ncomplete -o filenames -F _breccia breccia\n");
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    const char *shell = arguments->positional[0];
    const bool zsh = strcmp(shell, "zsh") == 0;
    if (!zsh && strcmp(shell, "bash") != 0)
        return BRC_FAIL(session->context, BRC_BAD_INPUT,
                        "breccia completion: no completion for '%s'; known are bash, zsh", shell);
    if (zsh) printf("#compdef breccia\nautoload -U +X bashcompinit && bashcompinit\n");
    print_bash();
    return BRC_OK;
}

const brc_command brc_command_completion = {.name = "completion",
                                            .operands = "bash|zsh",
                                            .least = 1,
                                            .most = 1,
                                            .summary =
                                                "a script that completes commands, options and files in bash or zsh",
                                            .details = "In ~/.bashrc or ~/.zshrc: source <(breccia completion bash), "
                                                       "or zsh. `cmake --install` puts it where bash looks.",
                                            .run = run};
