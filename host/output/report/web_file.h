/* Files of web/ inside the program: scripts, styles, packed libraries and their licences. */
#ifndef BRC_OUTPUT_WEB_FILE_H
#define BRC_OUTPUT_WEB_FILE_H

#include <stddef.h>

typedef struct brc_web_file {
    const char *name; /* without folder: "page.js" */
    const unsigned char *bytes;
    size_t n;
} brc_web_file;

/* By name; a last one has the name NULL. Written by the build (web_files.cmake). */
extern const brc_web_file brc_web_files[];
/* That of a name; where there is none, the one behind the last, which is empty. */
const brc_web_file *brc_web_file_find(const char *name);

#endif
