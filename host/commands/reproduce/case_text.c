/* Files of a case: of a folder, or those that the program brings. */
#include "case_files.h"
#include "case_node.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <string.h>

#define CASE_BYTES_MOST ((size_t)1 << 20)

brc_status brc_case_text(brc_context *context, const char *folder, const char *name, const char *file, char **out,
                         size_t *bytes)
{
    char path[512];
    if (folder) {
        snprintf(path, sizeof path, "%s/%s/%s", folder, name, file);
        return brc_file_read_whole(context, path, CASE_BYTES_MOST, out, bytes);
    }
    snprintf(path, sizeof path, "%s/%s", name, file);
    for (int f = 0; f < brc_case_file_count; ++f)
        if (strcmp(brc_case_files[f].path, path) == 0) {
            *bytes = brc_case_files[f].bytes;
            BRC_TRY(BRC_ALLOCATE(context, out, *bytes + 1, "text of a case"));
            memcpy(*out, brc_case_files[f].text, *bytes);
            return BRC_OK;
        }
    return BRC_FAIL(context, BRC_BAD_INPUT, "case '%s' has no file %s; `breccia reproduce --list` names the cases",
                    name, file);
}
