/* Scenes made from the schema table itself: a small valid scene that contains one chosen entry, with one chosen
 * fault. */
#ifndef BRC_TEST_SCENE_SAMPLE_H
#define BRC_TEST_SCENE_SAMPLE_H

#include "../../host/scene/schema.h"

#define SAMPLE_DEEPEST 24

/* From an entry of the top down to the one that is meant. */
typedef struct sample_path {
    const brc_entry *chain[SAMPLE_DEEPEST];
    int depth;
} sample_path;

typedef enum sample_fault {
    SAMPLE_VALID,     /* the sample of the entry */
    SAMPLE_VALUE,     /* another text in its place */
    SAMPLE_DUPLICATE, /* the key twice */
    SAMPLE_MISSING,   /* without the key */
    SAMPLE_UNKNOWN    /* an unknown key before it */
} sample_fault;

typedef struct sample_scene {
    char text[16384];
    int length;
    int line, column; /* of the fault: the value, the second or the unknown key, the map without the key */
} sample_scene;

/* Make a scene. value: for SAMPLE_VALUE. */
void sample_make(const sample_path *path, sample_fault fault, const char *value, sample_scene *out);
/* "bodies.shape.box.size", into `out`, which is returned. */
const char *sample_path_text(const sample_path *path, char *out, size_t size);
/* Call `visit` for every entry that can be reached. */
void sample_visit(void (*visit)(const sample_path *path, void *data), void *data);

#endif
