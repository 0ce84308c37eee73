/* The cases of tests/validation as texts inside the program; made at build time (case_files.cmake). */
#ifndef BRC_COMMANDS_CASE_FILES_H
#define BRC_COMMANDS_CASE_FILES_H

#include <stddef.h>

typedef struct brc_case_file {
    const char *path; /* below tests/validation: "agh19-table3/case.yaml" */
    const char *text;
    size_t bytes;
} brc_case_file;

extern const brc_case_file brc_case_files[];
extern const int brc_case_file_count;

#endif
