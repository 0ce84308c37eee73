/* What a plug-in library offers, libbreccia_target (clang's, whose device is the host once more) or
 * libbreccia_target_nvptx (gcc's, for NVIDIA cards): plain C types only, since clang's OpenMP runtime and the program's
 * own (mostly gcc's) must not meet. target/target_plugin.c defines it, device_target.c calls it. */
#ifndef BRC_TARGET_PLUGIN_H
#define BRC_TARGET_PLUGIN_H

#include "kernel_instance.h"
#include <stddef.h>
#include <stdint.h>

/* Raised with every change of this struct or of kernel_instance.h. */
#define BRC_TARGET_PLUGIN_VERSION 3

typedef struct brc_target_plugin {
    int version;
    uint64_t kernels_hash; /* of the kernel texts it was built from: those of the program, or it is refused */
    const char *compiler;
    const char *architecture; /* of its target code */
    int falls_back;           /* not 0: without a device its regions run on the host, as device 0 */
    /* The kernels of a precision (as brc_precision), for many materials or one; NULL: there are none, with the reason
     * in why [bytes]. */
    const brc_kernel_instance *(*instance)(int precision, int many_materials, char *why, size_t bytes);
    int (*devices)(void);
    /* Device memory, not cleared; NULL when there is none. */
    void *(*allocate)(int device, size_t bytes);
    void (*release)(int device, void *memory);
    /* 0, or not: it failed. */
    int (*write)(int device, void *memory, size_t offset, const void *data, size_t bytes);
    int (*read)(int device, const void *memory, size_t offset, void *data, size_t bytes);
    int (*copy)(int device, void *to, const void *from, size_t bytes);
    int (*zero)(int device, void *memory, size_t bytes);
    /* Target regions that the calling thread enters from now on run there. */
    void (*select)(int device);
    /* 1 when a target region really left the host, 0 when it fell back to it. */
    int (*runs_on_device)(int device);
} brc_target_plugin;

/* The library's only symbol. */
#define BRC_TARGET_PLUGIN_SYMBOL "brc_target_plugin_get"
typedef const brc_target_plugin *(*brc_target_plugin_getter)(void);

/* That of a library of one instance beside it (target/target_instance.c); kernels_hash: of the kernel texts it was
 * built from. */
#define BRC_TARGET_INSTANCE_SYMBOL "brc_target_instance_get"
typedef const brc_kernel_instance *(*brc_target_instance_getter)(uint64_t *kernels_hash);

#endif
