/* The schema: one table that drives reading, checking, writing, docs/reference/scene/README.md and the tests of the
 * scene format.
 *
 * A section describes one struct; its entries describe the keys. Reading follows the order of the table, not that of
 * the text, so an entry may rely on those before it (materials before bodies, sensors before measures). */
#ifndef BRC_SCENE_SCHEMA_H
#define BRC_SCENE_SCHEMA_H

#include "scene.h"

typedef enum brc_type {
    BRC_TYPE_QUANTITY,  /* double in SI; `unit` gives the dimension, "" a pure number */
    BRC_TYPE_VECTOR,    /* `length` quantities of one dimension */
    BRC_TYPE_DIRECTION, /* 3 pure numbers, not all zero; kept as a unit vector */
    BRC_TYPE_INTEGER,   /* int32_t or int64_t/uint64_t by `size` */
    BRC_TYPE_INTEGERS,  /* `length` int64_t */
    BRC_TYPE_BOOL,      /* true, false */
    BRC_TYPE_STRING,    /* any text; char[size] */
    BRC_TYPE_NAME,      /* a name: letters, digits, _ + -; char[size] */
    BRC_TYPE_WORD,      /* one of `choices`, kept as text; char[size] */
    BRC_TYPE_CHOICE,    /* one of `choices`, kept as its index; int32_t or enum */
    BRC_TYPE_MATERIAL,  /* name of a material, kept as its index; int32_t */
    BRC_TYPE_TABLE,     /* list of [time, factor]; brc_table */
    BRC_TYPE_STRUCT,    /* a map of `section`, in place; or a one-of */
    BRC_TYPE_LIST,      /* list of `section`: pointer at `offset`, int32_t count at `count_offset` */
    BRC_TYPE_NAMED      /* map from name to `section`, whose struct begins with char name[BRC_NAME]; kept as a list */
} brc_type;

/* What a name must be the name of; checked when the whole scene is read. */
typedef enum brc_reference {
    BRC_REFERS_NOTHING,
    BRC_REFERS_FACES,    /* a wall, a set of faces, a body of cells: all its free faces */
    BRC_REFERS_ELEMENTS, /* a set of elements, a body */
    BRC_REFERS_SET,      /* either */
    BRC_REFERS_WALL,     /* a wall of a body's shape */
    BRC_REFERS_SENSOR,
    BRC_REFERS_STAGE,
    BRC_REFERS_STRIKER,
    BRC_REFERS_BODY
} brc_reference;

/* Units that depend on the scene. */
#define BRC_UNIT_STAGE_TIME "@stage-time"     /* s in a dynamic stage, the fraction 0..1 of a static one */
#define BRC_UNIT_MEASURE "@measure"           /* that of the measure's value */
#define BRC_UNIT_MEASURE_TIME "@measure-time" /* as the stage's time, of the stage the measure looks at */

typedef struct brc_range {
    double low, high; /* SI; infinite: none */
    bool low_open, high_open;
} brc_range;

typedef struct brc_section brc_section;

typedef struct brc_entry {
    const char *key;
    brc_type type;
    const char *unit;
    brc_range range; /* of every number in the entry; all zero: none */
    bool required;
    bool another;      /* another way to give a field that has a key already: read, never written */
    double factor;     /* quantities: what is kept over what is written; 0: 1 */
    const char *given; /* the default, as a user would write it (a scalar, or "{}" for a map of defaults);
                        * NULL and not required: left out means zero, empty, absent */
    const char *word;  /* a word allowed in place of the number, e.g. "auto"; it stands for word_value */
    double word_value;
    const char *const *choices; /* NULL-terminated */
    brc_reference refers;       /* names */
    const brc_section *section;
    size_t offset, size; /* of the field in its struct */
    size_t count_offset; /* lists */
    int spare;           /* lists and maps of names: room for items that the reader adds itself */
    bool has_flag;       /* a bool at has_offset becomes true when the key is there */
    size_t has_offset;
    int length;         /* of vectors */
    int value;          /* variants of a one-of: what its kind field becomes */
    const char *why;    /* the reason for the range, one sentence */
    const char *sample; /* a valid value for documents and tests; NULL: `given` or the section's own samples */
    const char *meaning;
} brc_entry;

/* How many of some keys must be there. */
typedef enum brc_group_rule {
    BRC_GROUP_NONE,
    BRC_GROUP_EXACTLY_ONE,
    BRC_GROUP_AT_LEAST_ONE,
    BRC_GROUP_AT_MOST_ONE
} brc_group_rule;

typedef struct brc_group {
    brc_group_rule rule;
    const char *keys[8]; /* NULL-terminated */
} brc_group;

struct brc_section {
    const char *title; /* as in "unknown key in a material" and in the headings of docs/reference/scene/README.md */
    const char *meaning;
    const brc_entry *entries;
    int n_entries;
    size_t size;   /* of the struct; list items */
    bool one_of;   /* exactly one entry, named by the key; its `value` goes to the kind field */
    bool has_kind; /* one-of: an enum at kind_offset */
    size_t kind_offset;
    const char *short_key;   /* a scalar in place of the map is the value of this key (one-of: of this variant) */
    const char *sample_name; /* of a named item */
    brc_group groups[4];
};

/* The top of the schema: the struct brc_scene. */
const brc_section *brc_schema(void);
/* The entry of a key, NULL when unknown. */
const brc_entry *brc_section_find(const brc_section *section, const char *key);
/* "> 0", "in [0, 1)", "" when everything is allowed. Written into `out`, which is returned. */
const char *brc_range_text(const brc_entry *entry, char *out, size_t size);
/* Does the entry state a range? */
bool brc_entry_has_range(const brc_entry *entry);
bool brc_range_contains(const brc_entry *entry, double value);
/* May `true` stand for a map of defaults, and `false` for the key being left out? So it is for keys whose absence
 * switches something off and whose map may be empty. */
bool brc_entry_is_switch(const brc_entry *entry);

#endif
