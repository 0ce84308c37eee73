/* Compiled OpenCL programs kept from run to run, by what they were made of: file "<digest of the key>.bin" in the
 * folder of BRECCIA_OPENCL_CACHE, else of XDG_CACHE_HOME or HOME/.cache, there breccia/opencl; BRECCIA_OPENCL_CACHE=off
 * keeps none. */
#ifndef BRC_PROGRAM_CACHE_H
#define BRC_PROGRAM_CACHE_H

#include "../base/status.h"
#include <stddef.h>

/* key: everything the program depends on, as text. The binary stored under it, freed with brc_memory_free; NULL: there
 * is none, or what is there is not whole or of another key. Never fails: a cache that cannot be read is none. */
unsigned char *brc_program_cache_find(brc_context *context, const char *key, size_t *bytes);
/* Store, written aside and renamed, so that a reader meets a whole file or none. What has not been used for longest
 * goes beyond some number of programs. A folder that cannot be written to is a line of the debug log. */
void brc_program_cache_keep(brc_context *context, const char *key, const unsigned char *binary, size_t bytes);

#endif
