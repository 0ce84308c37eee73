/* The embedded kernel sources, and what they say about a kernel's parameters. */
#ifndef BRC_KERNEL_SIGNATURE_H
#define BRC_KERNEL_SIGNATURE_H

#include "device.h"
#include "shares.h"

/* One file of kernels/, embedded at build time (kernel_sources.cmake). */
typedef struct brc_kernel_file {
    const char *name;
    const char *text;
} brc_kernel_file;
extern const brc_kernel_file brc_kernel_files[];
extern const int brc_kernel_file_count;
/* The text of one of them; NULL where it is not embedded. */
const char *brc_kernel_text(const char *file);

enum { BRC_KERNEL_MOST_ARGS = 64 };
/* One letter per kind of argument, in the order of brc_arg_kind. */
#define BRC_KERNEL_LETTERS "biscd"

typedef struct brc_kernel_signature {
    int n;              /* parameters; 0: the text is not of the form of portable.md */
    brc_array_of items; /* what its items are: all groups, rows, numbers or blocks of them; else BRC_OF_NOTHING */
    int list;           /* which parameter is OWN(int) list, of rows; 0: none */
    bool crews;         /* its items are blocks that a GPU gives to a crew each (portable.h): n_crews, n_crew_parts */
    char kinds[BRC_KERNEL_MOST_ARGS + 1];   /* a letter each */
    brc_use use[BRC_KERNEL_MOST_ARGS];      /* by their markers */
    const char *name[BRC_KERNEL_MOST_ARGS]; /* in the text: ends where a word does */
} brc_kernel_signature;

/* Read the parameters of `KERNEL void name(...)`, or of a pass `KERNEL void PASS(name)(PASS_ITEMS, ...)` under either
 * of its names (kernels.h), from the embedded sources. A parameter that is not one of int, state, coeff, double or an
 * array behind a marker, or a second kernel of the name, gives n = 0: launches of that kernel are then not checked. */
void brc_kernel_signature_read(const char *name, brc_kernel_signature *out);

#endif
