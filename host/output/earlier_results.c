/* Removing files by name: what is not listed stays. */
#include "earlier_results.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* "NNNNNN.vtkhdf", "NNNNNN.cracks.vtu", "NNNNNN.strikers.vtu", "NNNNNN.png", or what a killed run left of one; numbers
 * from `first` on. */
static bool is_frame(const char *name, int64_t first)
{
    static const char *const suffix[] = {".vtkhdf",       ".vtkhdf.part",       ".cracks.vtu", ".cracks.vtu.part",
                                         ".strikers.vtu", ".strikers.vtu.part", ".png",        ".png.part"};
    const size_t digits = strspn(name, "0123456789");
    for (size_t k = 0; digits >= 6 && k < sizeof suffix / sizeof suffix[0]; ++k)
        if (strcmp(name + digits, suffix[k]) == 0) return strtoll(name, NULL, 10) >= first;
    return false;
}

brc_status brc_earlier_remove_file(brc_context *context, const char *path)
{
    if (!brc_file_writes() || unlink(path) == 0 || errno == ENOENT) return BRC_OK;
    return BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot remove the result of an earlier run: %s", path,
                    strerror(errno));
}

brc_status brc_earlier_remove_numbered(brc_context *context, const char *folder, int64_t first)
{
    brc_status status = BRC_OK;
    DIR *directory = opendir(folder);
    if (!directory) return errno == ENOENT ? BRC_OK : brc_earlier_remove_file(context, folder);
    for (const struct dirent *entry = readdir(directory); entry && status == BRC_OK; entry = readdir(directory)) {
        if (!is_frame(entry->d_name, first)) continue;
        char *path;
        status = brc_file_join(context, folder, entry->d_name, &path);
        if (status == BRC_OK) status = brc_earlier_remove_file(context, path);
        brc_memory_free(path);
    }
    closedir(directory);
    return status;
}
