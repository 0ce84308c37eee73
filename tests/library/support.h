/* What the tests of the library share: a block of cells that breaks in a burst, 120 and 30 steps. */
#ifndef BRC_TESTS_LIBRARY_SUPPORT_H
#define BRC_TESTS_LIBRARY_SUPPORT_H

#include "../../host/include/breccia.h"
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on

#define FOLDER 256

breccia_scene *make_scene(void);
/* A new empty folder, and its end. */
void make_folder(char folder[FOLDER]);
void remove_folder(const char *folder);
/* A whole file of a folder; freed by the caller. */
char *read_file(const char *folder, const char *name, size_t *bytes);
/* Histories, cracks, fragments and frames of two runs have the same bytes. */
void assert_same_results(const char *a, const char *b);

#endif
