/* breccia new: a commented scene to begin with. */
#include "command.h"
#include "template.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <string.h>

static const brc_option options[] = {{"output", 'o', "FILE", false, "where it goes (default: NAME.yaml)"}};

/* The first line of a template without "# " and its last dot. */
static void print_title(const brc_template *template)
{
    const char *begin = template->text + strspn(template->text, "# ");
    const size_t length = strcspn(begin, "\n");
    printf("%.*s\n", (int)(length > 0 && begin[length - 1] == '.' ? length - 1 : length), begin);
}

static void print_templates(void)
{
    for (int k = 0; k < brc_template_count; ++k) {
        printf("  %-14s ", brc_templates[k].name);
        print_title(&brc_templates[k]);
    }
    printf("\nbreccia new NAME writes one of them as NAME.yaml. Each has a tutorial of its name in "
           "docs/guide/tutorials.\n");
}

static brc_status write_template(brc_context *context, const brc_template *template, const char *path)
{
    if (brc_file_exists(path))
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "breccia new: %s is there already and stays as it is; choose another file with -o FILE, or remove it",
            path);
    BRC_TRY(brc_file_write_whole(context, path, template->text, template->bytes));
    printf("%s: ", path);
    print_title(template);
    if (brc_template_is_study(template))
        printf("next: breccia study %s -o %s\n", path, template->name);
    else
        printf("next: breccia check %s; breccia run %s -o %s\n", path, path, template->name);
    return BRC_OK;
}

static brc_status run(const brc_session *session, const brc_arguments *arguments)
{
    brc_context *context = session->context;
    const char *output = brc_arguments_value(arguments, "output");
    if (arguments->n_positional == 0) {
        if (output)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "breccia new: --output without a name of a scene; `breccia new` lists them");
        print_templates();
        return BRC_OK;
    }
    const brc_template *template = brc_template_find(context, arguments->positional[0]);
    if (!template) return BRC_BAD_INPUT;
    if (output) return write_template(context, template, output);
    const size_t room = strlen(template->name) + sizeof ".yaml";
    char *path = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &path, room, "name of a file"));
    snprintf(path, room, "%s.yaml", template->name);
    const brc_status status = write_template(context, template, path);
    brc_memory_free(path);
    return status;
}

const brc_command brc_command_new = {
    .name = "new",
    .operands = "[NAME]",
    .most = 1,
    .summary = "write a commented scene to begin with; without a name: list them",
    .details =
        "The scenes are those of the tutorials (docs/guide/tutorials). A file that is there is never overwritten.",
    .options = options,
    .n_options = sizeof options / sizeof *options,
    .run = run};
