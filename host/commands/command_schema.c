/* breccia schema: the scene format for editors. */
#include "command.h"
#include "json_schema.h"

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    (void)arguments;
    return brc_json_schema_write(session->context, stdout);
}

const brc_command brc_command_schema = {
    .name = "schema",
    .operands = "",
    .summary = "the scene format as a JSON Schema (draft 2020-12), for editors that complete and check scenes",
    .details = "As docs/reference/scene/README.md from the table that scenes are read with. The first line of a scene\n"
               "    # yaml-language-server: $schema=scene.schema.json\n"
               "makes the YAML language server of VS Code, Vim, Emacs and others use the file.",
    .run = run};
