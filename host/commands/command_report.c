/* breccia report: a folder of results as one page. */
#include "command.h"
#include "../output/report/report.h"

static const brc_option options[] = {
    BRC_OPTION_OUTPUT("the page to write (default: report.html inside the folder)"),
};

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    const char *folder = arguments->positional[0], *out = brc_arguments_value(arguments, "output");
    BRC_TRY(brc_report_write(session->context, folder, out));
    printf("%s%s\n", out ? out : folder, out ? "" : "/report.html");
    return BRC_OK;
}

const brc_command brc_command_report = {
    .name = "report",
    .operands = "DIR",
    .least = 1,
    .most = 1,
    .summary = "one HTML page of a run: measures, view in 3D over time, curves, cracks, cost",
    .details = "DIR is a folder of `breccia run`, `reproduce` or `bench`. The page needs no other file and no\n"
               "network; any browser of today shows it (WebGL, JavaScript).",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run};
