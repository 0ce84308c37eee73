/* One compilation of the kernels as C: what instance/kernels_instance.c exports for each {instruction set, precision,
 * materials}. Also included by the target plug-in, so nothing but plain C types. */
#ifndef BRC_KERNEL_INSTANCE_H
#define BRC_KERNEL_INSTANCE_H

typedef struct brc_kernel_entry {
    const char *name;
    void (*function)(void);
} brc_kernel_entry;

typedef struct brc_kernel_instance {
    const char *level;  /* "v2", "v3", "v4", "generic", "target" */
    int precision;      /* as brc_precision */
    int many_materials; /* 0 or 1 */
    int lanes;          /* W */
    int slice;          /* C */
    int *first;         /* item that launches begin with: 0 but while a rank does its own (shares.h) */
    int **chosen;       /* groups that FOR_EACH_GROUP and FOR_EACH_ROW go over ... */
    int *n_chosen;      /* ... and how many; NULL: all */
    int n;
    const brc_kernel_entry *entries; /* [n] */
} brc_kernel_instance;

#endif
