/* The list of commands and their help. */
#include "command.h"
#include "../base/version.h"
#include "../scene/problem.h"
#include <string.h>

static const brc_command *const commands[] = {
    &brc_command_new,     &brc_command_check,  &brc_command_build,      &brc_command_run,       &brc_command_study,
    &brc_command_devices, &brc_command_bench,  &brc_command_reproduce,  &brc_command_calibrate, &brc_command_report,
    &brc_command_export,  &brc_command_schema, &brc_command_completion, &brc_command_help};
enum { OPERANDS = 20 }; /* column of the list */
#define N_COMMANDS ((int)(sizeof commands / sizeof *commands))

int brc_command_count(void)
{
    return N_COMMANDS;
}
const brc_command *brc_command_at(int index)
{
    return commands[index];
}

const brc_command *brc_command_find(brc_context *context, const char *name)
{
    const char *names[N_COMMANDS];
    for (int k = 0; k < N_COMMANDS; ++k) {
        names[k] = commands[k]->name;
        if (strcmp(names[k], name) == 0) return commands[k];
    }
    const char *nearest = brc_nearest_word(name, N_COMMANDS, names);
    BRC_FAIL(context, BRC_BAD_INPUT, "breccia: no command '%s'%s%s%s; `breccia --help` lists them", name,
             nearest ? ", did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    return NULL;
}

void brc_command_print_list(FILE *file)
{
    fprintf(file,
            "breccia %s: brittle solids of Voronoi cells or spheres joined by beams, on the CPU and through "
            "OpenCL\n\nusage: breccia COMMAND ...\n\n",
            brc_version());
    for (int k = 0; k < N_COMMANDS; ++k) {
        const bool wide = strlen(commands[k]->operands) > OPERANDS;
        fprintf(file, "  %-10s %-*s %s%*s%s\n", commands[k]->name, OPERANDS, commands[k]->operands, wide ? "\n" : "",
                wide ? OPERANDS + 14 : 0, "", commands[k]->summary);
    }
    fprintf(
        file,
        "\nbreccia help COMMAND tells its options; breccia --version (-V) the version.\n"
        "Exit codes: 0 done, 1 the physics was stopped or a bound missed, 2 wrong input, 3 device or file trouble.\n");
}

void brc_command_print_help(const brc_command *command, FILE *file)
{
    fprintf(file, "usage: breccia %s %s%s[OPTIONS]\n%s.\n", command->name, command->operands,
            command->operands[0] ? " " : "", command->summary);
    if (command->details[0]) fprintf(file, "%s\n", command->details);
    fprintf(file, "\n");
    for (int k = 0; k < command->n_options; ++k) {
        const brc_option *option = &command->options[k];
        char left[64];
        snprintf(left, sizeof left, "%c%c%s--%s%s%s", option->letter ? '-' : ' ', option->letter ? option->letter : ' ',
                 option->letter ? ", " : "  ", option->name, option->value ? " " : "",
                 option->value ? option->value : "");
        fprintf(file, "  %-28s %s%s\n", left, option->meaning, option->repeats ? " (may be repeated)" : "");
    }
    fprintf(file, "  %-28s %s\n", "-h, --help", "this text");
}
