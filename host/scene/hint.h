/* What a newcomer who writes a wrong word may have meant: words of the field that are other keys here, keys that stand
 * elsewhere, units and numbers that are nearly right. */
#ifndef BRC_SCENE_HINT_H
#define BRC_SCENE_HINT_H

#include "problem.h"
#include "schema.h"

#define BRC_HINT 320 /* longest hint, with its NUL */

/* For an unknown key of a section: "; did you mean 'density'?", or "; it is a key of strength: write strength:
 * {fracture_energy: ...}", or "". Written into `out`, which is returned. */
const char *brc_hint_key(const brc_problems *problems, const brc_section *section, const char *key, char out[BRC_HINT]);
/* For a text that is no quantity in `unit`: "; did you mean '2650 kg/m^3'?", "; decimals have a point", or "". */
const char *brc_hint_quantity(const char *text, const char *unit, char out[BRC_HINT]);
/* For a value out of range: "; did you mean 60 %?" where a share was given in percent; or "". */
const char *brc_hint_range(const brc_entry *entry, const char *text, double value, char out[BRC_HINT]);
/* How the map of a section is written: "; as in noisy_grid: {elements: 1000}", or "". */
const char *brc_hint_map(const brc_section *section, const char *key, char out[BRC_HINT]);
/* How a list or a map of names is written: "; write each item as `- name: ...`", "; write a name for each in place of
 * '-', as in sensors: {probe: ...}". */
const char *brc_hint_list(const brc_entry *entry, char out[BRC_HINT]);

#endif
