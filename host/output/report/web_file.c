#include "web_file.h"
#include <string.h>

const brc_web_file *brc_web_file_find(const char *name)
{
    const brc_web_file *file = brc_web_files;
    while (file->name && strcmp(file->name, name) != 0)
        ++file;
    return file;
}
