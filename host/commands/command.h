/* What a command of the program is: its name, its options as a table, and the function that does it. */
#ifndef BRC_COMMANDS_COMMAND_H
#define BRC_COMMANDS_COMMAND_H

#include "../solver/simulation.h"
#include <stdio.h>

/* What every command is given. */
typedef struct brc_session {
    brc_context *context;
    /* Called with a simulation before it runs and with NULL after it, so that a signal can reach it; may be NULL. */
    void (*running)(brc_simulation *simulation);
} brc_session;

typedef struct brc_option {
    const char *name;  /* without its dashes */
    char letter;       /* short form, 0: none */
    const char *value; /* what stands for the value in the help, "a|b|c" where it is one of these words; NULL: a flag */
    bool repeats;      /* may be given more than once */
    const char *meaning; /* one line */
} brc_option;

#define BRC_OPTIONS_MOST 16
#define BRC_OPTION_REPEATS 256 /* most repetitions of one option */

/* Parsed command line; every text is borrowed from argv. */
typedef struct brc_arguments {
    int n_positional;
    const char *positional[4];
    int count[BRC_OPTIONS_MOST]; /* times given, by index of the option */
    const char *value[BRC_OPTIONS_MOST][BRC_OPTION_REPEATS];
    bool help;
    const struct brc_command *command;
} brc_arguments;

typedef struct brc_command {
    const char *name;
    const char *operands; /* "SCENE", "[CASE]", "a|b" where it is one of these words, "" */
    int least, most;      /* operands */
    const char *summary;  /* one line of the list */
    const char *details;  /* more lines of its own help, or "" */
    const brc_option *options;
    int n_options;
    bool ranks; /* may be started on several ranks (ranks.h) */
    brc_status (*run)(const brc_session *session, const brc_arguments *arguments);
} brc_command;

/* The commands of the program. */
extern const brc_command brc_command_new, brc_command_check, brc_command_build, brc_command_run, brc_command_study,
    brc_command_devices, brc_command_bench, brc_command_reproduce, brc_command_report, brc_command_export,
    brc_command_calibrate, brc_command_schema, brc_command_completion, brc_command_help;

/* Parse what follows the command's name. BRC_BAD_INPUT: unknown option (with the nearest one), missing or surplus
 * values and operands, an option given twice. --help and -h end the parsing. */
brc_status brc_arguments_parse(brc_context *context, const brc_command *command, int argc, const char *const *argv,
                               brc_arguments *out);
/* The (last) value of an option, NULL when it was not given; a flag gives "". The name must be in the table. */
const char *brc_arguments_value(const brc_arguments *arguments, const char *name);
/* All values of an option; *n is how often it was given. */
const char *const *brc_arguments_values(const brc_arguments *arguments, const char *name, int *n);
/* A whole number of an option within [low, high]; `otherwise` when it was not given. BRC_BAD_INPUT with the option's
 * name. */
brc_status brc_arguments_integer(brc_context *context, const brc_arguments *arguments, const char *name, int64_t low,
                                 int64_t high, int64_t otherwise, int64_t *out);
/* --precision: double when it was not given. */
brc_status brc_arguments_precision(brc_context *context, const brc_arguments *arguments, brc_precision *out);
brc_status brc_precision_parse(brc_context *context, const char *text, brc_precision *out);
/* Split "a,b,c" in place of `text` (a copy of the caller) into at most `most` pieces; returns their number, -1 if there
 * are more or one is empty. */
int brc_text_split(char *text, int most, const char **pieces);

/* Help of the program and of one command. */
void brc_command_print_list(FILE *file);
void brc_command_print_help(const brc_command *command, FILE *file);
/* All commands, in the order of their list. */
int brc_command_count(void);
const brc_command *brc_command_at(int index);
/* The command of this name; NULL with a sentence naming the nearest when there is none. */
const brc_command *brc_command_find(brc_context *context, const char *name);

/* Options that several commands share, for their tables. */
#define BRC_OPTION_DEVICE                                                                                              \
    {                                                                                                                  \
        "device", 'd', "DEVICE", false, "auto, cpu, opencl:N, opencl:auto or target:N (default auto)"                  \
    }
#define BRC_OPTION_PRECISION                                                                                           \
    {                                                                                                                  \
        "precision", 'p', "double|mixed|single", false, "numbers of the device (default double)"                       \
    }
#define BRC_OPTION_THREADS                                                                                             \
    {                                                                                                                  \
        "threads", 't', "N", false, "threads of the cpu device and of building (default: all)"                         \
    }
#define BRC_OPTION_EXACT                                                                                               \
    {                                                                                                                  \
        "exact", 'x', NULL, false, "round every product and sum by itself: equal bits on every device, slower"         \
    }
#define BRC_OPTION_SET                                                                                                 \
    {                                                                                                                  \
        "set", 's', "KEY=VALUE", true, "replace a value of the scene, e.g. materials.glass.nu=0.3"                     \
    }
#define BRC_OPTION_OUTPUT(meaning)                                                                                     \
    {                                                                                                                  \
        "output", 'o', "DIR", false, (meaning)                                                                         \
    }

#endif
