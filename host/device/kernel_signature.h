/* The embedded kernel sources, and what they say about a kernel's parameters. */
#ifndef BRC_KERNEL_SIGNATURE_H
#define BRC_KERNEL_SIGNATURE_H

#include "device_internal.h"

/* One file of kernels/, embedded at build time (kernel_sources.cmake). */
typedef struct brc_kernel_file {
    const char *name;
    const char *text;
} brc_kernel_file;
extern const brc_kernel_file brc_kernel_files[];
extern const int brc_kernel_file_count;

/* One letter per kind of argument, in the order of brc_arg_kind. */
#define BRC_KERNEL_LETTERS "biscd"

/* Read the parameter list(s) of `KERNEL void name(...)` from the embedded sources: one string of letters per
 * definition, at most two (one per branch of BRC_MANY_MATERIALS). "" when the text is not of that form (a parameter
 * that hides in a macro, say): launches of that kernel are then not checked. Returns the first list's text, behind its
 * bracket; NULL where there is none. */
const char *brc_kernel_signature(const char *name, char kinds[2][BRC_KERNEL_MOST_ARGS + 1]);
/* The name of the k-th parameter of such a text. */
void brc_kernel_parameter_name(const char *parameters, int k, char *name, size_t bytes);

#endif
