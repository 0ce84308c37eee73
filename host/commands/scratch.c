#include "scratch.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

brc_status brc_scratch_create(brc_context *context, char folder[BRC_SCRATCH])
{
    const char *place = getenv("TMPDIR");
    snprintf(folder, BRC_SCRATCH, "%s/breccia-XXXXXX", place && place[0] ? place : "/tmp");
    return mkdtemp(folder)
               ? BRC_OK
               : BRC_FAIL(context, BRC_FILE_FAILED,
                          "%s: no folder can be made for a trial; set TMPDIR to one that can be written", folder);
}

/* Bytes of the files in a folder and the folders in it; removed where asked. */
static int64_t folder_bytes(brc_context *context, const char *folder, bool remove_it)
{
    int64_t bytes = 0;
    DIR *directory = opendir(folder);
    for (const struct dirent *entry = directory ? readdir(directory) : NULL; entry; entry = readdir(directory)) {
        char *path;
        struct stat info;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        if (brc_file_join(context, folder, entry->d_name, &path) != BRC_OK) break;
        if (lstat(path, &info) == 0) {
            bytes += S_ISDIR(info.st_mode) ? folder_bytes(context, path, remove_it) : info.st_size;
            if (remove_it && !S_ISDIR(info.st_mode)) unlink(path);
        }
        brc_memory_free(path);
    }
    if (directory) closedir(directory);
    if (remove_it) rmdir(folder);
    return bytes;
}

int64_t brc_scratch_bytes(brc_context *context, const char *folder, const char *name)
{
    char *path;
    struct stat info;
    if (!name) return folder_bytes(context, folder, false);
    if (brc_file_join(context, folder, name, &path) != BRC_OK) return 0;
    const int64_t bytes = stat(path, &info) == 0 ? info.st_size : 0;
    brc_memory_free(path);
    return bytes;
}

void brc_scratch_remove(brc_context *context, const char *folder)
{
    folder_bytes(context, folder, true);
}
