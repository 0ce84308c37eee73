/* What the files of the reader share: one reading in progress. */
#ifndef BRC_SCENE_READER_INTERNAL_H
#define BRC_SCENE_READER_INTERNAL_H

#include "node.h"
#include "schema.h"

/* Lists of a scene (loads, sets, sensors ...) are not longer than this; tables may be. */
#define BRC_LIST_MOST 4096

/* Where a field was given. entry NULL: a whole struct, as an item of a list. */
typedef struct brc_place {
    const void *address;
    const brc_entry *entry;
    brc_mark mark;
} brc_place;

typedef struct brc_reader {
    brc_context *context;
    brc_problems *problems;
    brc_scene *scene;
    const brc_stage *stage; /* being read, for units of time */
    int64_t n_places, n_places_held;
    brc_place *places;
    bool own_material; /* the last material is the reader's own, not the scene's */
    bool broken[32];   /* by entry of the top section: something in it was wrong */
} brc_reader;

/* reader_values.c: read one value (anything but structs and lists) into its field. Problems are added; the status is
 * BRC_OK unless memory ran out. */
brc_status brc_reader_value(brc_reader *reader, const brc_entry *entry, const brc_node *node, void *field);
/* Is this text a name (letters, digits, _ + -, at most BRC_NAME - 1 bytes)? Adds a problem if not, which names the key
 * whose value it is; node NULL: it is a key itself, "key". */
bool brc_reader_name(brc_reader *reader, const char *key, const brc_node *node, const char *text, brc_mark mark);
/* "a quantity in Pa such as 72 GPa". Written into `out`, which is returned. */
const char *brc_entry_expects(const brc_entry *entry, const char *unit, char *out, size_t size);
/* The unit of an entry in its struct: resolves the "@..." units. stage may be NULL where `struct_` is no load. */
const char *brc_entry_unit(const brc_entry *entry, const brc_scene *scene, const brc_stage *stage, const void *measure);

/* Remember where a field (or, entry NULL, a struct) was given. */
brc_status brc_reader_remember(brc_reader *reader, const void *address, const brc_entry *entry, brc_mark mark);

/* reader_check.c: where a field was given (a flag: its key; a kind: the variant); where its struct `item` begins when
 * it was left out. For checks, which follow when all is read. */
brc_mark brc_reader_place(const brc_reader *reader, const void *field, const void *item);
/* Was there a problem in this top-level key? What refers to it is then not judged. */
bool brc_reader_is_broken(const brc_reader *reader, const char *key);
#define COMPLAIN(reader, field, item, ...)                                                                             \
    brc_problems_add((reader)->problems, brc_reader_place((reader), (field), (item)), __VA_ARGS__)
#define WARN(reader, field, item, ...)                                                                                 \
    brc_problems_warn((reader)->problems, brc_reader_place((reader), (field), (item)), __VA_ARGS__)
/* scene_reader.c: fill in the defaults of a section's keys, as of an empty map. */
brc_status brc_reader_defaults(brc_reader *reader, const brc_section *section, brc_mark mark, void *base);
/* reader_fixtures.c: strikers, sensors and contact of platens, jaws and rollers. Before the measures are read, whose
 * units depend on sensors; the lists have room (brc_entry.spare). */
brc_status brc_reader_expand_fixtures(brc_reader *reader);
/* Their laws of contact, measures and curve. After all checks, as it moves lists of the scene. */
brc_status brc_reader_finish_fixtures(brc_reader *reader);
/* reader_names.c: the walls of all bodies. Freed by brc_wall_names_free, which accepts NULL. */
typedef struct brc_wall_names brc_wall_names;
brc_status brc_wall_names_find(brc_reader *reader, brc_wall_names **names);
void brc_wall_names_free(brc_wall_names *names);
bool brc_wall_names_has(const brc_wall_names *names, const char *name);
/* What refers to walls, sets, bodies, sensors, stages and strikers must name one that there is. */
brc_status brc_names_check(brc_reader *reader, const brc_wall_names *walls);
/* Is it a wall of cells, or a set of all of it, that goes all the way round, so that its area vectors sum to zero? */
bool brc_names_is_closed(const brc_scene *scene, const char *name);
/* Numbers of the bodies that sets name, and warnings about sets that are named as bodies. */
void brc_names_find_bodies(brc_reader *reader);
/* A set of elements for each body that is named as one, and one of its faces where it is named as that, unless a wall
 * or a set has the name. Last of all, as it moves the scene's sets. */
brc_status brc_names_add_body_sets(brc_reader *reader, const brc_wall_names *walls);
/* reader_check_fracture.c: what breaks, and what scenes that break cannot have. */
void brc_reader_check_fracture(brc_reader *reader);
/* reader_check_contact.c: contact and stages, strikers, sensors of contact. */
void brc_reader_check_contact(brc_reader *reader);
/* reader_check_models.c: what stages ask of models. */
void brc_reader_check_models(brc_reader *reader);
/* reader_check_output.c: views of pictures. */
void brc_reader_check_output(brc_reader *reader);
/* Does a load prescribe a motion of faces or elements? */
bool brc_load_is_motion(const brc_load *load);
/* reader_check_sensors.c: sensors and measures against the rest of the scene. */
void brc_reader_check_sensors(brc_reader *reader);
/* reader_check.c: fill in what follows from other parts, and check what needs the whole scene. */
brc_status brc_reader_check(brc_reader *reader);

#endif
