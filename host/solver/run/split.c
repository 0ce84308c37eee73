/* Which bodies share a model, and the scene of each such part. Handing out what the stages ask is in split_share.c. */
#include "split.h"
#include "../models/model.h"
#include "../../base/memory.h"
#include <stdio.h>
#include <string.h>

bool brc_split_same_model(const brc_model *a, const brc_model *b)
{
    return a->kind == b->kind && a->compaction == b->compaction && a->small_rotations == b->small_rotations &&
           a->beta == b->beta && a->tau == b->tau && a->area_weights == b->area_weights &&
           a->rotation_stiffness == b->rotation_stiffness && a->couple_modulus == b->couple_modulus &&
           a->beam_poisson == b->beam_poisson && a->keep_isolated == b->keep_isolated && a->polish == b->polish;
}

/* Part of every body [n_bodies]; returns the number of parts. */
static int32_t number_parts(const brc_scene *scene, int32_t *part)
{
    int32_t n = 0;
    for (int32_t b = 0; b < scene->n_bodies; ++b) {
        part[b] = -1;
        for (int32_t c = 0; c < b && part[b] < 0; ++c)
            if (brc_split_same_model(brc_body_model(scene, b), brc_body_model(scene, c))) part[b] = part[c];
        if (part[b] < 0) part[b] = n++;
    }
    return n;
}

static void name_part(brc_split *split, int32_t k)
{
    const brc_model_kind kind = split->part[k].scene->model.kind;
    int before = 0;
    for (int32_t other = 0; other < k; ++other)
        before += split->part[other].scene->model.kind == kind;
    const int n = snprintf(split->part[k].name, BRC_NAME, "%s", brc_model_name(kind));
    if (before > 0) snprintf(split->part[k].name + n, BRC_NAME - (size_t)n, "-%d", before + 1);
}

/* A scene that borrows all but its bodies, and the lists that brc_split_share fills. */
static brc_status make_scene(brc_context *context, const brc_scene *whole, const brc_scene_part *part, brc_scene **out)
{
    BRC_TRY(BRC_ALLOCATE(context, out, 1, "scene of a model"));
    brc_scene *scene = *out;
    *scene = *whole;
    scene->bodies = NULL;
    scene->sets = NULL;
    scene->stages = NULL;
    scene->sensors = NULL;
    scene->n_sensors = scene->n_measures = 0;
    scene->n_bodies = part->n_bodies;
    scene->model = *brc_body_model(whole, part->body[0]);
    BRC_TRY(BRC_ALLOCATE(context, &scene->bodies, part->n_bodies, "bodies of a model"));
    for (int32_t b = 0; b < part->n_bodies; ++b)
        scene->bodies[b] = whole->bodies[part->body[b]];
    BRC_TRY(BRC_ALLOCATE(context, &scene->sets, whole->n_sets, "sets of a model"));
    for (int32_t s = 0; s < whole->n_sets; ++s) { /* bodies by their numbers in the part */
        scene->sets[s] = whole->sets[s];
        scene->sets[s].where.body = -1;
        for (int32_t b = 0; b < part->n_bodies; ++b)
            if (part->body[b] == whole->sets[s].where.body) scene->sets[s].where.body = b;
    }
    BRC_TRY(BRC_ALLOCATE(context, &scene->sensors, whole->n_sensors, "sensors of a model"));
    BRC_TRY(BRC_ALLOCATE(context, &scene->stages, whole->n_stages, "stages of a model"));
    for (int32_t s = 0; s < whole->n_stages; ++s) {
        brc_stage *stage = &scene->stages[s];
        *stage = whole->stages[s];
        stage->n_loads = stage->n_initials = 0;
        stage->loads = NULL;
        stage->initials = NULL;
        BRC_TRY(BRC_ALLOCATE(context, &stage->loads, whole->stages[s].n_loads, "loads of a model"));
        BRC_TRY(BRC_ALLOCATE(context, &stage->initials, whole->stages[s].n_initials, "initial fields of a model"));
    }
    return BRC_OK;
}

static void free_scene(brc_scene *scene)
{
    for (int32_t s = 0; scene->stages && s < scene->n_stages; ++s) {
        brc_memory_free(scene->stages[s].loads);
        brc_memory_free(scene->stages[s].initials);
    }
    brc_memory_free(scene->stages);
    brc_memory_free(scene->sensors);
    brc_memory_free(scene->bodies);
    brc_memory_free(scene->sets);
    brc_memory_free(scene);
}

void brc_split_free(brc_split **split)
{
    if (!split || !*split) return;
    for (int32_t k = 0; (*split)->part && k < (*split)->n; ++k) {
        brc_scene_part *part = &(*split)->part[k];
        if (part->scene && part->scene != (*split)->scene) free_scene(part->scene);
        brc_memory_free(part->body);
        brc_memory_free(part->sensor);
    }
    brc_memory_free((*split)->part);
    brc_memory_free(*split);
    *split = NULL;
}

static bool uses(const brc_scene_part *part, int32_t material)
{
    for (int32_t b = 0; b < part->n_bodies; ++b)
        if (brc_body_uses(&part->scene->bodies[b], material)) return true;
    return false;
}

/* Polishing writes into the material: what one part found must not become another's. */
static brc_status check_polish(brc_context *context, const brc_split *split)
{
    for (int32_t k = 0; k < split->n; ++k)
        for (int32_t other = 0; other < k; ++other)
            for (int32_t m = 0; m < split->scene->n_materials; ++m) {
                const brc_scene_part *a = &split->part[other], *b = &split->part[k];
                if (brc_bond_model_of(a->scene->model.kind)->element != BRC_ELEMENT_SPHERE ||
                    brc_bond_model_of(b->scene->model.kind)->element != BRC_ELEMENT_SPHERE || !uses(a, m) ||
                    !uses(b, m))
                    continue;
                if (!a->scene->model.polish && !b->scene->model.polish) continue;
                return BRC_FAIL(context, BRC_BAD_INPUT,
                                "polish: bodies '%s' and '%s' have models of beams that differ and share the material "
                                "'%s'; give each its own",
                                a->scene->bodies[0].name, b->scene->bodies[0].name, split->scene->materials[m].name);
            }
    return BRC_OK;
}

brc_status brc_split_create(brc_context *context, brc_scene *scene, brc_split **out)
{
    brc_split *split = NULL;
    int32_t *part_of = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    if (scene->n_bodies < 1) return BRC_FAIL(context, BRC_BAD_INPUT, "the scene has no bodies");
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &part_of, scene->n_bodies, "parts of a scene"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &split, 1, "parts of a scene"));
    split->scene = scene;
    split->n = number_parts(scene, part_of);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &split->part, split->n, "parts of a scene"));
    for (int32_t k = 0; k < split->n; ++k) {
        brc_scene_part *part = &split->part[k];
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &part->body, scene->n_bodies, "parts of a scene"));
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &part->sensor, scene->n_sensors, "parts of a scene"));
        for (int32_t b = 0; b < scene->n_bodies; ++b)
            if (part_of[b] == k) part->body[part->n_bodies++] = b;
        if (split->n == 1) {
            scene->model = *brc_body_model(scene, 0);
            part->scene = scene;
            for (int32_t i = 0; i < scene->n_sensors; ++i)
                part->sensor[i] = i;
        } else {
            BRC_TRY_OR(cleanup, make_scene(context, scene, part, &part->scene));
        }
        name_part(split, k);
    }
    status = check_polish(context, split);
cleanup:
    brc_memory_free(part_of);
    if (status != BRC_OK) brc_split_free(&split);
    *out = split;
    return status;
}

const char *brc_split_bodies(const brc_split *split, int32_t part, char *words, size_t room)
{
    size_t at = 0;
    words[0] = '\0';
    for (int32_t b = 0; b < split->part[part].n_bodies && at + 1 < room; ++b) {
        const int n = snprintf(words + at, room - at, "%s'%s'", b ? ", " : "",
                               split->scene->bodies[split->part[part].body[b]].name);
        at += n < 0 ? 0 : (size_t)n;
    }
    return words;
}
