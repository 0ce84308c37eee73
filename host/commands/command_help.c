/* breccia help, and the manual page: the tables of the commands in words. */
#include "command.h"
#include "../base/version.h"

static const brc_option options[] = {{"man", 'm', NULL, false, "the manual page of the program, for man(1)"}};

/* Text for troff: lines must not begin with a dot or an apostrophe, backslashes and hyphens are their own. */
static void print_roff(FILE *file, const char *text)
{
    bool begins = true;
    for (const char *c = text; *c; ++c) {
        if (begins && (*c == '.' || *c == '\'')) fputs("\\&", file);
        if (*c == '\\')
            fputs("\\e", file);
        else if (*c == '-')
            fputs("\\-", file);
        else
            fputc(*c, file);
        begins = *c == '\n';
    }
}

static void print_manual(FILE *file)
{
    fprintf(file,
            ".TH BRECCIA 1 \"\" \"breccia %s\" \"User Commands\"\n.SH NAME\nbreccia \\- fracture of brittle solids by "
            "discrete elements\n"
            ".SH SYNOPSIS\n.B breccia\n.I COMMAND\n[OPERANDS] [OPTIONS]\n.SH DESCRIPTION\nBrittle solids of Voronoi "
            "cells or of spheres joined by beams, on the CPU and through "
            "OpenCL.\nA scene is a YAML file; \\fBbreccia schema\\fR and docs/reference/scene/README.md tell its "
            "keys.\n.SH COMMANDS\n",
            brc_version());
    for (int k = 0; k < brc_command_count(); ++k) {
        const brc_command *command = brc_command_at(k);
        fprintf(file, ".SS \"breccia %s %s\"\n", command->name, command->operands);
        print_roff(file, command->summary);
        fputs(".\n", file);
        if (command->details[0]) {
            fputs(".PP\n", file);
            print_roff(file, command->details);
            fputs("\n", file);
        }
        for (int m = 0; m < command->n_options; ++m) {
            const brc_option *option = &command->options[m];
            fputs(".TP\n", file);
            if (option->letter) fprintf(file, "\\fB\\-%c\\fR, ", option->letter);
            fputs("\\fB\\-\\-", file);
            print_roff(file, option->name);
            fprintf(file, "\\fR%s%s%s\n", option->value ? " \\fI" : "", option->value ? option->value : "",
                    option->value ? "\\fR" : "");
            print_roff(file, option->meaning);
            fputs(option->repeats ? " (may be repeated)\n" : "\n", file);
        }
    }
    fputs(".SH EXIT STATUS\n0 done, 1 the physics was stopped or a bound missed, 2 wrong input, 3 device or file "
          "trouble.\n",
          file);
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    if (brc_arguments_value(arguments, "man")) {
        print_manual(stdout);
    } else if (arguments->n_positional == 0) {
        brc_command_print_list(stdout);
    } else {
        const brc_command *command = brc_command_find(session->context, arguments->positional[0]);
        if (!command) return BRC_BAD_INPUT;
        brc_command_print_help(command, stdout);
    }
    return BRC_OK;
}

const brc_command brc_command_help = {.name = "help",
                                      .operands = "[COMMAND]",
                                      .most = 1,
                                      .summary = "this list, or the options of a command",
                                      .details = "",
                                      .options = options,
                                      .n_options = sizeof options / sizeof *options,
                                      .run = run};
