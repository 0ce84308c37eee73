/* breccia export: results of a run in other formats. */
#include "command.h"
#include "../output/frames/export.h"

static const brc_option options[] = {
    {"format", 'f', "vtu|vtkhdf|csv", false, "needed"},
    BRC_OPTION_OUTPUT("where to write (default: export inside the folder of the run)"),
};

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    const char *format = brc_arguments_value(arguments, "format");
    if (!format)
        return BRC_FAIL(session->context, BRC_BAD_INPUT,
                        "breccia export: say the format with --format vtu, vtkhdf or csv");
    const char *folder = arguments->positional[0], *out = brc_arguments_value(arguments, "output");
    int64_t n_files;
    BRC_TRY(brc_export(session->context, folder, format, out, &n_files));
    printf("%lld files in %s%s\n", (long long)n_files, out ? out : folder, out ? "" : "/export");
    return BRC_OK;
}

const brc_command brc_command_export = {.name = "export",
                                        .operands = "DIR",
                                        .least = 1,
                                        .most = 1,
                                        .summary = "write the frames and histories of a run as VTU, VTKHDF or CSV",
                                        .details = "",
                                        .options = options,
                                        .n_options = sizeof options / sizeof *options,
                                        .run = run};
