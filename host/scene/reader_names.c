/* Names of sets: walls, bodies and the scene's own sets. What refers to a name is checked here, and bodies that are
 * named as sets become sets. */
#include "../../preprocess/shapes/shape_type.h"
#include "reader_internal.h"
#include "schema_internal.h"
#include "../base/memory.h"
#include <stdio.h>
#include <string.h>

/* What the set of a wall holds: the faces of cells, the spheres that touch it, or, of bodies of both kinds, each in its
 * own. */
enum { OF_FACES = 1, OF_ELEMENTS = 2 };
typedef struct wall_name {
    char name[BRC_NAME + 16];
    int holds;
} wall_name;

/* The walls of all bodies, each name once. */
struct brc_wall_names {
    wall_name *wall; /* [n] owned */
    int n, held;
    int holds; /* of what is added now */
};
typedef struct brc_wall_names wall_names;

static brc_status add_wall(brc_reader *reader, const char *prefix, const char *wall, const char *suffix,
                           wall_names *out)
{
    wall_name added = {.holds = out->holds};
    snprintf(added.name, sizeof added.name, "%s%s%s%s", prefix, prefix[0] ? "_" : "", wall, suffix);
    for (int w = 0; w < out->n; ++w)
        if (strcmp(out->wall[w].name, added.name) == 0) {
            out->wall[w].holds |= added.holds;
            return BRC_OK;
        }
    if (out->n == out->held) {
        out->held = out->held ? 2 * out->held : 16;
        BRC_TRY(
            brc_memory_resize(reader->context, (void **)&out->wall, out->held, sizeof *out->wall, "names of walls"));
    }
    out->wall[out->n++] = added;
    return BRC_OK;
}

static brc_status add_leaf_walls(brc_reader *reader, const brc_shape *shape, const char *prefix, const char *suffix,
                                 wall_names *out)
{
    static const char *const SIDES[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    const bool round = shape->kind == BRC_SHAPE_CYLINDER || shape->kind == BRC_SHAPE_CONE;
    const bool ends = shape->kind == BRC_SHAPE_BOX || round;
    for (int w = 0; w < 6 && ends; ++w) {
        if (round && w / 2 != shape->axis) continue;
        const bool tip = shape->kind == BRC_SHAPE_CONE && (w % 2 ? shape->radius2 : shape->radius) == 0;
        if (!tip) BRC_TRY(add_wall(reader, prefix, SIDES[w], suffix, out));
    }
    if (shape->kind == BRC_SHAPE_BOX) return BRC_OK;
    const char *rest = round ? "side" : shape->kind == BRC_SHAPE_HALF_SPACE ? "cut" : "surface";
    return add_wall(reader, prefix, rest, suffix, out);
}

brc_status brc_wall_names_find(brc_reader *reader, wall_names **names)
{
    BRC_TRY(BRC_ALLOCATE(reader->context, names, 1, "names of walls"));
    wall_names *out = *names;
    const brc_scene *scene = reader->scene;
    for (int b = 0; b < scene->n_bodies; ++b) {
        const brc_body *body = &scene->bodies[b];
        out->holds = body->beams > 0 ? OF_ELEMENTS : OF_FACES;
        if (body->domain_file[0]) { /* the file may have any of them */
            const brc_shape box = {.kind = BRC_SHAPE_BOX}, round = {.kind = BRC_SHAPE_CYLINDER},
                            sphere = {.kind = BRC_SHAPE_SPHERE};
            BRC_TRY(add_leaf_walls(reader, &box, "", "", out));
            BRC_TRY(add_leaf_walls(reader, &round, "", "", out));
            BRC_TRY(add_leaf_walls(reader, &sphere, "", "", out));
            continue;
        }
        const char *const suffixes[2] = {"", "_layer"};
        for (int s = 0; s < (body->beams > 0 ? 2 : 1); ++s) {
            if (body->shape.kind != BRC_SHAPE_PARTS)
                BRC_TRY(add_leaf_walls(reader, &body->shape, "", suffixes[s], out));
            for (int p = 0; p < body->shape.n_parts; ++p)
                BRC_TRY(
                    add_leaf_walls(reader, &body->shape.parts[p].shape, body->shape.parts[p].name, suffixes[s], out));
        }
        for (int c = 0; c < body->n_cracks && !(body->beams > 0); ++c)
            BRC_TRY(add_wall(reader, "", body->cracks[c].name, "", out));
    }
    return BRC_OK;
}

void brc_wall_names_free(wall_names *names)
{
    if (names) brc_memory_free(names->wall);
    brc_memory_free(names);
}

bool brc_wall_names_has(const wall_names *names, const char *name)
{
    for (int w = 0; w < names->n; ++w)
        if (strcmp(names->wall[w].name, name) == 0) return true;
    return false;
}

/* Does a set of the scene or a wall have the name, and so a body of this name no set? */
static bool is_taken(const brc_scene *scene, const wall_names *names, const char *name)
{
    for (int s = 0; s < scene->n_sets; ++s)
        if (strcmp(scene->sets[s].name, name) == 0) return true;
    return brc_wall_names_has(names, name);
}

/* Do the area vectors of a wall of cells sum to zero: the side of a cylinder, the surface of a sphere, a ring or a
 * mesh, the two sides of a crack? Of parts that others cut nothing is known. */
static bool is_closed_wall(const brc_body *body, const char *wall)
{
    if (body->domain_file[0] || body->beams > 0) return false;
    for (int c = 0; c < body->n_cracks; ++c)
        if (strcmp(body->cracks[c].name, wall) == 0) return true;
    const char *closed = brc_shape_type_of(body->shape.kind)->closed_wall;
    return closed && strcmp(wall, closed) == 0;
}

bool brc_names_is_closed(const brc_scene *scene, const char *name)
{
    const char *wall = name;
    for (int s = 0; s < scene->n_sets; ++s) {
        const brc_predicate *p = &scene->sets[s].where;
        if (strcmp(scene->sets[s].name, name) != 0) continue;
        if (!p->has_wall || p->has_body || p->has_box || p->has_sphere || p->has_cylinder || p->has_half_space ||
            p->has_normal)
            return false;
        wall = p->wall;
    }
    bool any = false;
    for (int b = 0; b < scene->n_bodies; ++b)
        any |= is_closed_wall(&scene->bodies[b], wall);
    for (int b = 0; b < scene->n_bodies; ++b) { /* a wall of this name that is open, or may be */
        const brc_body *body = &scene->bodies[b];
        any &= !body->domain_file[0] && !(body->beams > 0) &&
               !(body->shape.kind == BRC_SHAPE_CONE && strcmp(wall, "side") == 0);
    }
    return any;
}

/* Sets and walls inside a domain file are not known here: nothing is refused then. */
static bool any_domain_file(const brc_scene *scene)
{
    for (int b = 0; b < scene->n_bodies; ++b)
        if (scene->bodies[b].domain_file[0]) return true;
    return false;
}

/* All names that would be right, for the guess; returns their number. */
static int known_names(const brc_scene *scene, const wall_names *walls, brc_reference refers, const char **out)
{
    int n = 0;
    const int wanted = refers == BRC_REFERS_WALL || refers == BRC_REFERS_SET ? OF_FACES | OF_ELEMENTS
                       : refers == BRC_REFERS_FACES                          ? OF_FACES
                       : refers == BRC_REFERS_ELEMENTS                       ? OF_ELEMENTS
                                                                             : 0;
    for (int w = 0; w < walls->n; ++w)
        if (walls->wall[w].holds & wanted) out[n++] = walls->wall[w].name;
    for (int i = 0; i < scene->n_sets && refers != BRC_REFERS_WALL; ++i)
        if (refers == BRC_REFERS_SET || (refers == BRC_REFERS_FACES && scene->sets[i].kind == BRC_SET_FACES) ||
            (refers == BRC_REFERS_ELEMENTS && scene->sets[i].kind == BRC_SET_ELEMENTS))
            out[n++] = scene->sets[i].name;
    const bool of_elements = refers == BRC_REFERS_SET || refers == BRC_REFERS_ELEMENTS;
    for (int b = 0; b < scene->n_bodies; ++b) {
        const bool of_set =
            of_elements || (refers == BRC_REFERS_FACES && !(scene->bodies[b].beams > 0)); /* spheres have no faces */
        if (refers == BRC_REFERS_BODY || (of_set && !is_taken(scene, walls, scene->bodies[b].name)))
            out[n++] = scene->bodies[b].name;
    }
    for (int i = 0; i < scene->n_sensors && refers == BRC_REFERS_SENSOR; ++i)
        out[n++] = scene->sensors[i].name;
    for (int i = 0; i < scene->n_stages && refers == BRC_REFERS_STAGE; ++i)
        out[n++] = scene->stages[i].name;
    for (int i = 0; i < scene->n_strikers && refers == BRC_REFERS_STRIKER; ++i)
        out[n++] = scene->strikers[i].name;
    return n;
}

static bool is_known(const brc_scene *scene, const wall_names *walls, brc_reference refers, const char *name,
                     const char **words, int *n)
{
    *n = known_names(scene, walls, refers, words);
    for (int i = 0; i < *n; ++i)
        if (strcmp(words[i], name) == 0) return true;
    return false;
}

/* "; known: x-, x+, lid": each once, those that there is room for. */
static const char *list_names(int n, const char *const *words, char *out, size_t room)
{
    size_t at = 0;
    out[0] = '\0';
    for (int i = 0; i < n; ++i) {
        bool said = false;
        for (int k = 0; k < i && !said; ++k)
            said = strcmp(words[k], words[i]) == 0;
        const size_t needed = strlen(words[i]) + (at ? sizeof ", " : sizeof "; known: ");
        if (at + needed > room) break;
        if (said) continue;
        at += (size_t)snprintf(out + at, room - at, "%s%s", at ? ", " : "; known: ", words[i]);
    }
    return out;
}

static bool is_body_of_spheres(const brc_scene *scene, const char *name)
{
    for (int b = 0; b < scene->n_bodies; ++b)
        if (strcmp(scene->bodies[b].name, name) == 0) return scene->bodies[b].beams > 0;
    return false;
}

static void check_reference(brc_reader *reader, const wall_names *walls, const brc_place *place, const char **words)
{
    static const char *const WHAT[] = {"",
                                       "wall, body or set of faces",
                                       "body or set of elements",
                                       "wall, body or set",
                                       "wall",
                                       "sensor",
                                       "stage",
                                       "striker",
                                       "body"};
    const brc_scene *scene = reader->scene;
    const brc_reference refers = place->entry->refers;
    const char *name = place->address;
    int n;
    if (name[0] == '\0' || is_known(scene, walls, refers, name, words, &n)) return;
    const bool about_sets = refers == BRC_REFERS_FACES || refers == BRC_REFERS_ELEMENTS || refers == BRC_REFERS_SET ||
                            refers == BRC_REFERS_WALL;
    if (refers == BRC_REFERS_BODY && brc_reader_is_broken(reader, "bodies")) return;
    if (about_sets &&
        (any_domain_file(scene) || brc_reader_is_broken(reader, "bodies") || brc_reader_is_broken(reader, "sets")))
        return;
    if (refers == BRC_REFERS_SENSOR && brc_reader_is_broken(reader, "sensors")) return;
    if (refers == BRC_REFERS_STAGE && brc_reader_is_broken(reader, "stages")) return;
    if (refers == BRC_REFERS_STRIKER && brc_reader_is_broken(reader, "strikers")) return;
    const char *near = brc_problems_nearest(reader->problems, name, n, words);
    char known[256], hint[400];
    static const char *const CURE[] = {"",
                                       "; define it under sets, as in `sets: {NAME: {faces: {wall: x+}}}`",
                                       "; define it under sets, as in `sets: {NAME: {elements: {wall: x+}}}`",
                                       "; define it under sets, as in `sets: {NAME: {elements: {wall: x+}}}`",
                                       "",
                                       "; define it under sensors",
                                       "; name one of the stages",
                                       "; define it under strikers",
                                       "; name one of the bodies"};
    if (brc_problems_count(reader->problems) >= BRC_PROBLEMS_MOST)
        hint[0] = '\0'; /* it is not told */
    else if (near)
        snprintf(hint, sizeof hint, "; did you mean '%s'?%s", near, list_names(n, words, known, sizeof known));
    else
        snprintf(hint, sizeof hint, "%s%s", list_names(n, words, known, sizeof known), CURE[refers]);
    int n_sets;
    const char *kind = refers == BRC_REFERS_ELEMENTS && is_known(scene, walls, BRC_REFERS_SET, name, words, &n_sets)
                           ? " (that name is a set of faces)"
                       : refers == BRC_REFERS_FACES && is_body_of_spheres(scene, name)
                           ? " (that body is of spheres, which have no faces: load its elements)"
                       : refers == BRC_REFERS_FACES && is_known(scene, walls, BRC_REFERS_ELEMENTS, name, words, &n_sets)
                           ? " (that name is a set of elements)"
                           : "";
    brc_problems_add(reader->problems, place->mark, "%s: there is no %s '%s'%s%s", place->entry->key, WHAT[refers],
                     name, kind, hint);
}

brc_status brc_names_check(brc_reader *reader, const wall_names *walls)
{
    const brc_scene *scene = reader->scene;
    const char **words = NULL;
    BRC_TRY(BRC_ALLOCATE(
        reader->context, &words,
        walls->n + scene->n_sets + scene->n_sensors + scene->n_stages + scene->n_strikers + scene->n_bodies, "names"));
    for (int64_t i = 0; i < reader->n_places; ++i)
        if (reader->places[i].entry && reader->places[i].entry->refers)
            check_reference(reader, walls, &reader->places[i], words);
    brc_memory_free(words);
    return BRC_OK;
}

/* A set that is named as a body and is no other than it. */
static bool is_that_body(const brc_set_request *set)
{
    const brc_predicate *p = &set->where;
    return set->kind == BRC_SET_ELEMENTS && p->has_body && strcmp(p->body_name, set->name) == 0 &&
           !(p->has_wall || p->has_box || p->has_sphere || p->has_cylinder || p->has_half_space || p->has_normal);
}

void brc_names_find_bodies(brc_reader *reader)
{
    brc_scene *scene = reader->scene;
    for (int s = 0; s < scene->n_sets; ++s) {
        brc_set_request *set = &scene->sets[s];
        set->where.body = -1;
        for (int b = 0; b < scene->n_bodies; ++b) {
            if (set->where.has_body && strcmp(scene->bodies[b].name, set->where.body_name) == 0) set->where.body = b;
            if (strcmp(scene->bodies[b].name, set->name) == 0 && !is_that_body(set))
                WARN(reader, NULL, set,
                     "the set '%s' has the name of a body, whose elements are a set already; this one stands for it: "
                     "leave it out to name the body, or choose another name",
                     set->name);
        }
    }
}

/* Is the body named where a set of elements may be? */
static bool is_named(const brc_reader *reader, const char *name)
{
    for (int64_t i = 0; i < reader->n_places; ++i) {
        const brc_entry *entry = reader->places[i].entry;
        const bool of_set = entry && (entry->refers == BRC_REFERS_ELEMENTS || entry->refers == BRC_REFERS_SET);
        if (of_set && strcmp(reader->places[i].address, name) == 0) return true;
    }
    return false;
}

/* A body that loads of faces name stands for all of its free ones: that name becomes `faces`. False: nowhere. */
static bool rename_faces(brc_scene *scene, const char *body, const char *faces)
{
    bool any = false;
    for (int32_t k = 0; k < scene->n_stages; ++k)
        for (int32_t l = 0; l < scene->stages[k].n_loads; ++l) {
            brc_load *load = &scene->stages[k].loads[l];
            const bool of_faces = load->kind == BRC_LOAD_FACE_DISPLACEMENT || load->kind == BRC_LOAD_FACE_VELOCITY ||
                                  load->kind == BRC_LOAD_TRACTION || load->kind == BRC_LOAD_PRESSURE;
            if (!of_faces || strcmp(load->set, body) != 0) continue;
            strcpy(load->set, faces);
            any = true;
        }
    return any;
}

static void add_body_set(brc_scene *scene, int32_t body, brc_set_kind kind, const char *name)
{
    brc_set_request *set = &scene->sets[scene->n_sets++];
    *set = (brc_set_request){.kind = kind, .where = {.has_body = true, .body = body}};
    strcpy(set->name, name);
    strcpy(set->where.body_name, scene->bodies[body].name);
}

brc_status brc_names_add_body_sets(brc_reader *reader, const wall_names *walls)
{
    brc_scene *scene = reader->scene;
    const int32_t n = scene->n_sets;
    BRC_TRY(brc_memory_resize(reader->context, (void **)&scene->sets, (int64_t)n + 2 * scene->n_bodies,
                              sizeof *scene->sets, "sets"));
    for (int b = 0; b < scene->n_bodies; ++b) {
        const char *name = scene->bodies[b].name;
        char faces[BRC_NAME] = "";
        if (is_taken(scene, walls, name)) continue;
        if (is_named(reader, name)) add_body_set(scene, b, BRC_SET_ELEMENTS, name);
        for (int k = 0; faces[0] == '\0' || is_taken(scene, walls, faces); ++k)
            snprintf(faces, sizeof faces, k == 0 ? "%.40s_faces" : "%.40s_faces_%d", name, k);
        if (rename_faces(scene, name, faces)) add_body_set(scene, b, BRC_SET_FACES, faces);
    }
    return BRC_OK;
}
