/* Reading scenes: YAML through libyaml's node tree and the one schema table. */
#ifndef BRC_SCENE_READER_H
#define BRC_SCENE_READER_H

#include "scene.h"
#include <stdio.h>

/* Read a scene file. overrides: n strings "dotted.path=value", e.g. "bodies.0.fill.elements=1000",
 * "materials.glass.nu=0.3", applied to the node tree before checking (unknown path: an error). All errors are recorded
 * in one pass as "file:line:col: error: what was found, what is expected, the cure" and BRC_BAD_INPUT is returned. */
brc_status brc_scene_read(brc_context *context, const char *path, int n_overrides, const char *const *overrides,
                          brc_scene **out);
/* The same from memory; name: shown in messages and used as the folder for relative paths when it has one. */
brc_status brc_scene_read_text(brc_context *context, const char *name, const char *text, size_t bytes, int n_overrides,
                               const char *const *overrides, brc_scene **out);
/* The scene with all defaults, as YAML that reads back to an equal scene. *out freed by brc_memory_free. */
brc_status brc_scene_to_yaml(brc_context *context, const brc_scene *scene, char **out);
/* The pages of docs/reference/scene from the schema table: every key with type, unit, range, default, meaning. A page
 * has a name (`fill` is fill.md; `README`, page 0, holds contents and index) and shows an example: the text of a whole
 * scene, borrowed. */
int brc_scene_n_pages(void);
const char *brc_scene_page_name(int page);
brc_status brc_scene_write_page(brc_context *context, int page, const char *example, FILE *file);

#endif
