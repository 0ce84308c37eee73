/* The pieces of the table and the few words it is written in; for the schema_*.c files and the reader. */
#ifndef BRC_SCENE_SCHEMA_INTERNAL_H
#define BRC_SCENE_SCHEMA_INTERNAL_H

#include "schema.h"
#include <math.h>
#include <stddef.h>

#define FIELD(type, field) .offset = offsetof(type, field), .size = sizeof(((type *)0)->field)
#define COUNTED(type, field, n) .offset = offsetof(type, field), .count_offset = offsetof(type, n)
#define FLAG(type, field) .has_flag = true, .has_offset = offsetof(type, field)
#define ENTRIES(array) .entries = (array), .n_entries = (int)(sizeof(array) / sizeof((array)[0]))
#define CHOICES(...)                                                                                                   \
    .choices = (const char *const[])                                                                                   \
    {                                                                                                                  \
        __VA_ARGS__, NULL                                                                                              \
    }

/* What platens, jaws and rollers of a scene add at most. */
enum { BRC_FIXTURE_STRIKERS = 7, BRC_FIXTURE_SENSORS = 8 };

/* Ranges, in SI. */
#define POSITIVE .range = {0, INFINITY, true, true}
#define NOT_NEGATIVE .range = {0, INFINITY, false, true}
#define WITHIN(low, high) .range = {(low), (high), false, false}
#define STRICTLY_WITHIN(low, high) .range = {(low), (high), true, true}
#define ABOVE_UP_TO(low, high) .range = {(low), (high), true, false}

/* The pose of a body or a part: the fields translation and rotation of `type`. */
#define POSE_ENTRIES(type)                                                                                             \
    {"translation",                                                                                                    \
     BRC_TYPE_VECTOR,                                                                                                  \
     "m",                                                                                                              \
     FIELD(type, translation),                                                                                         \
     .length = 3,                                                                                                      \
     .sample = "[0, 1 m, 0]",                                                                                          \
     .meaning = "applied after the rotation"},                                                                         \
    {                                                                                                                  \
        "rotation", BRC_TYPE_VECTOR, "rad", FIELD(type, rotation),                                                     \
            .length = 3, .sample = "[0, 0, 30 deg]",                                                                   \
            .meaning = "rotation vector (axis times angle) about the shape's origin"                                   \
    }

extern const brc_section brc_schema_material;
extern const brc_section brc_schema_model;
extern const brc_section brc_schema_shape;
extern const brc_section brc_schema_fill;
extern const brc_section brc_schema_grains;
extern const brc_section brc_schema_crack;
extern const brc_section brc_schema_limit;
extern const brc_section brc_schema_body;
extern const brc_section brc_schema_set;
extern const brc_section brc_schema_predicate;
extern const brc_section brc_schema_stage;
extern const brc_section brc_schema_load;
extern const brc_section brc_schema_initial;
extern const brc_section brc_schema_sensor;
extern const brc_section brc_schema_measure;
extern const brc_section brc_schema_output;
extern const brc_section brc_schema_strength;
extern const brc_section brc_schema_fracture;
extern const brc_section brc_schema_interactions;
extern const brc_section brc_schema_contact;
extern const brc_section brc_schema_striker;
extern const brc_section brc_schema_platens;
extern const brc_section brc_schema_jaws;
extern const brc_section brc_schema_rollers;

/* A key that several models have. */
#define BRC_SMALL_ROTATIONS                                                                                            \
    {                                                                                                                  \
        "small_rotations", BRC_TYPE_BOOL, FIELD(brc_model, small_rotations),                                           \
            .given = "false",                                                                                          \
            .meaning =                                                                                                 \
                "true: the law linearised about the reference: a body that turns grows and strains; for comparison"    \
    }

#endif
