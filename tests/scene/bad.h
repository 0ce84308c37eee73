/* Reading texts in tests: a small valid scene to spoil, and what must be said of a spoilt one. */
#ifndef BRC_TEST_SCENE_BAD_H
#define BRC_TEST_SCENE_BAD_H

#include "../../host/scene/scene_reader.h"

/* Lines 1 to 8 of every scene here; stages follow from line 9. */
#define HEAD                                                                                                           \
    "version: 1\n"                                                                                                     \
    "materials:\n"                                                                                                     \
    "  glass: {E: 72 GPa, nu: 0.23, density: 2500 kg/m^3}\n"                                                           \
    "bodies:\n"                                                                                                        \
    "  - name: cube\n"                                                                                                 \
    "    shape: {box: {size: [1 m, 1 m, 1 m]}}\n"                                                                      \
    "    fill: {noisy_grid: {elements: 100}}\n"                                                                        \
    "sets: {core: {elements: {wall: x-}}, lid: {faces: z+}}\n"
#define STAGES "stages: [{name: pull, solver: static}]\n"

/* The scene of a text that must be good. Free with brc_scene_free. */
brc_scene *good_scene(const char *text);
/* The same with one override. */
brc_scene *good_scene_with(const char *text, const char *override);
/* The text must be refused with an error at "line:column" that contains `sentence`. */
void bad_scene(const char *text, const char *place, const char *sentence);
/* The same for texts with zeros or of many bytes. */
void bad_bytes(const char *text, size_t bytes, const char *place, const char *sentence);
/* The text must be good and the override refused with a sentence. */
void bad_override(const char *text, const char *override, const char *sentence);
/* Read a text, which must be good; the warnings of its reading into out [room], which is returned. */
const char *warnings_of(const char *text, char *out, size_t room);
/* The text must be good, and one of its warnings at "line:column" contains `sentence`. */
void warned_scene(const char *text, const char *place, const char *sentence);
/* How many errors a text has. */
int count_errors(const char *text);

#endif
