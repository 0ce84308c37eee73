/* What needs the whole scene: names that must exist, loads that contradict each other, and what follows from other
 * parts (a static load without a table grows from 0 to 1). */
#include "reader_internal.h"
#include "schema_internal.h"
#include "../../preprocess/domain/quality.h"
#include "../base/memory.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Contacts of an element in the packings of both papers (NAH19 section 3.1). */
#define USUAL_COORDINATION 6.2

static int by_address(const void *left, const void *right)
{
    const brc_place *a = left, *b = right;
    if (a->address != b->address) return a->address < b->address ? -1 : 1;
    return (a->entry != NULL) - (b->entry != NULL); /* a struct before its first field */
}

brc_mark brc_reader_place(const brc_reader *reader, const void *field, const void *item)
{
    const void *const wanted[2] = {field, item};
    for (int k = 0; k < 2; ++k) {
        int64_t low = 0, high = reader->n_places;
        while (low < high) { /* first place at the address */
            const int64_t middle = low + (high - low) / 2;
            if (reader->places[middle].address < wanted[k])
                low = middle + 1;
            else
                high = middle;
        }
        for (; low < reader->n_places && reader->places[low].address == wanted[k]; ++low)
            if ((reader->places[low].entry != NULL) == (k == 0)) return reader->places[low].mark;
    }
    return (brc_mark){0, 1, 1};
}

bool brc_reader_is_broken(const brc_reader *reader, const char *key)
{
    for (int i = 0; i < brc_schema()->n_entries; ++i)
        if (strcmp(brc_schema()->entries[i].key, key) == 0) return reader->broken[i];
    return false;
}

static void check_predicate(brc_reader *reader, const brc_predicate *where, bool of_elements)
{
    for (int k = 0; k < 3 && where->has_box; ++k) {
        if (where->box[1][k] >= where->box[0][k]) continue;
        COMPLAIN(reader, where->box[1], where, "to: lies before `from` in %c; expected the largest corner", "xyz"[k]);
        break;
    }
    if (where->has_normal && of_elements)
        COMPLAIN(reader, where->normal, where, "normal: elements have no outward normal; use it for faces");
}

/* The shape of one piece: sizes that contradict each other. */
static void check_leaf(brc_reader *reader, const brc_shape *shape)
{
    if (shape->kind == BRC_SHAPE_TORUS && shape->radius2 >= shape->radius && shape->radius > 0)
        COMPLAIN(reader, &shape->radius2, shape,
                 "tube: is not below the radius of the centre line, the ring would meet itself; expected less");
    if (shape->kind == BRC_SHAPE_CONE && shape->radius == 0 && shape->radius2 == 0)
        COMPLAIN(reader, &shape->radius, shape, "radius: both ends of the cone are tips; expected one radius above 0");
}

static void check_shape(brc_reader *reader, const brc_shape *shape)
{
    check_leaf(reader, shape);
    for (int p = 0; p < shape->n_parts; ++p) {
        check_leaf(reader, &shape->parts[p].shape);
        const bool first_cuts = p == 0 && shape->parts[p].role != BRC_PART_ADD;
        if (first_cuts)
            COMPLAIN(reader, &shape->parts[p].role, &shape->parts[p],
                     "role: the first part has nothing before it; expected add");
        if (shape->parts[p].role == BRC_PART_ADD && shape->parts[p].shape.kind == BRC_SHAPE_HALF_SPACE)
            COMPLAIN(reader, &shape->parts[p].role, &shape->parts[p],
                     "role: a half-space has no end; expected keep or remove");
    }
}

static void check_fill(brc_reader *reader, const brc_body *body)
{
    const brc_fill *fill = &body->fill;
    for (int r = 0; r < fill->n_radii; ++r) {
        const brc_radius *now = &fill->radii[r], *before = r ? now - 1 : NULL;
        const bool last = r == fill->n_radii - 1;
        if (before && !(now->radius > before->radius))
            COMPLAIN(reader, &now->radius, now, "radius: does not come after the one before; expected radii that grow");
        if ((r == 0 && now->fraction != 0) || (last && now->fraction != 1) ||
            (before && now->fraction < before->fraction))
            COMPLAIN(reader, &now->fraction, now,
                     "below: expected shares that grow from 0 at the first radius to 1 at the last");
    }
    if (fill->n_radii == 1)
        COMPLAIN(reader, &fill->radii->radius, fill->radii,
                 "radii: has one entry; expected two or more, or radius_spread: 0");
    if (body->beams > 0 && fill->kind == BRC_FILL_NOISY_GRID)
        COMPLAIN(
            reader, &body->beams, body,
            "beams: a noisy grid has no spheres; expected a fill with radii (packing, or points with a radius column)");
    if (body->beams > 0 && fill->cut)
        COMPLAIN(reader, &fill->cut, body,
                 "walls: a packing cut by its walls touches none of them; expected contact with beams");
    if (body->beams > 0 && fill->lloyd_sweeps > 0)
        COMPLAIN(reader, &fill->lloyd_sweeps, body, "lloyd: moves the seeds of cells; expected 0 with beams");
}

static void check_crack(brc_reader *reader, const brc_body *body, int c)
{
    const brc_crack *crack = &body->cracks[c];
    const double *a = crack->edge[0], *b = crack->edge[1];
    double square = 0;
    for (int k = 0; k < 3; ++k) {
        const double area = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        square += area * area;
    }
    if (crack->kind == BRC_CRACK_RECTANGLE && !(square > 0))
        COMPLAIN(reader, crack->edge[1], crack, "other_edge: spans no area with `edge`; expected another direction");
    for (int other = 0; other < c; ++other)
        if (strcmp(body->cracks[other].name, crack->name) == 0) {
            COMPLAIN(reader, crack->name, crack, "name: another crack is called '%s' too; give each its own",
                     crack->name);
            return;
        }
}

static void check_body(brc_reader *reader, int b)
{
    const brc_scene *scene = reader->scene;
    const brc_body *body = &scene->bodies[b];
    const brc_shape *shape = &body->shape;
    const brc_fill *fill = &body->fill;
    const bool shaped =
        shape->size[0] > 0 || shape->radius > 0 || shape->radius2 > 0 || shape->file[0] || shape->n_parts > 0;
    const bool filled = fill->spread > 0 || fill->n_elements || fill->spacing > 0 || fill->cells[0] ||
                        fill->radius > 0 || fill->file[0];
    if (shaped && !filled)
        COMPLAIN(reader, NULL, body,
                 "the key 'fill' is missing in this body: a shape must be cut, as in "
                 "fill: {noisy_grid: {elements: 1000}}");
    if (body->domain_file[0] && filled)
        COMPLAIN(reader, body->domain_file, body, "domain: the file is cut already; leave out fill");
    const brc_mark given = brc_reader_place(reader, &body->material, NULL);
    const brc_mark start = {0, 1, 1};
    const int n_materials = scene->n_materials - reader->own_material;
    if (n_materials > 1 && memcmp(&given, &start, sizeof given) == 0)
        COMPLAIN(reader, NULL, body, "the key 'material' is missing in this body: the scene has %d materials, name one",
                 n_materials);
    for (int c = 0; c < b; ++c)
        if (strcmp(scene->bodies[c].name, body->name) == 0) {
            COMPLAIN(reader, body->name, body, "name: another body is called '%s' too; give each its own", body->name);
            break;
        }
    for (int r = 0; r < body->n_regions; ++r) {
        check_predicate(reader, &body->regions[r].where, true);
        if (body->regions[r].where.has_body)
            COMPLAIN(reader, body->regions[r].where.body_name, &body->regions[r],
                     "body: a region is a part of the body that it stands in; leave it out");
    }
    check_shape(reader, shape);
    check_fill(reader, body);
    for (int c = 0; c < body->n_cracks; ++c)
        check_crack(reader, body, c);
    double sum = 0;
    for (int p = 0; p < body->n_phases; ++p)
        sum += body->phases[p].fraction;
    if (sum > 1 + 1e-12)
        COMPLAIN(reader, &body->phases[body->n_phases - 1].fraction, &body->phases[body->n_phases - 1],
                 "fraction: those of all phases sum to %.6g; expected at most 1", sum);
}

static void check_limits(brc_reader *reader)
{
    int32_t n;
    const brc_quality_number *known = brc_quality_numbers(&n);
    for (int32_t l = 0; l < reader->scene->n_limits; ++l) {
        const brc_quality_limit *limit = &reader->scene->limits[l];
        const char *names[64], *nearest = NULL;
        bool found = false;
        for (int32_t k = 0; k < n && k < 64; ++k) {
            names[k] = known[k].name;
            found |= strcmp(known[k].name, limit->number) == 0;
        }
        if (found) continue;
        nearest = brc_problems_nearest(reader->problems, limit->number, n < 64 ? n : 64, names);
        COMPLAIN(reader, NULL, limit, "quality: there is no number '%s'%s%s%s; docs/reference/domain.md lists them",
                 limit->number, nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    }
}

static void check_bodies(brc_reader *reader, const brc_wall_names *walls)
{
    const brc_scene *scene = reader->scene;
    for (int b = 0; b < scene->n_bodies; ++b)
        check_body(reader, b);
    for (int s = 0; s < scene->n_sets; ++s) {
        const brc_set_request *set = &scene->sets[s];
        check_predicate(reader, &set->where, set->kind == BRC_SET_ELEMENTS);
        if (brc_wall_names_has(walls, set->name))
            COMPLAIN(reader, NULL, set,
                     "the set '%s' has the name of a wall; walls are sets already, choose another name", set->name);
    }
}

/* What follows from other keys. */
static void complete(brc_scene *scene)
{
    for (int b = -1; b < scene->n_bodies; ++b) {
        brc_model *model = b < 0 ? &scene->model : &scene->bodies[b].model;
        if (brc_model_traits_of(model->kind)->deforms && !model->compaction) model->beta = 0;
    }
    for (int b = 0; b < scene->n_bodies; ++b) {
        brc_fill *fill = &scene->bodies[b].fill;
        const bool packed = fill->kind == BRC_FILL_PACKING && (fill->n_elements > 0 || fill->radius > 0);
        if (packed && fill->coordination == 0 && fill->volume_fraction == 0) fill->coordination = USUAL_COORDINATION;
        if (fill->n_radii > 0) fill->radius_spread = 0; /* the table stands in place of its default */
    }
}

/* Static stages find displacements before rotations, as forces of the published law do not depend on these to first
 * order; with a couple modulus they do. */
static void check_couples(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    for (int b = -1; b < scene->n_bodies; ++b) {
        const brc_model *model = b < 0 ? &scene->model : &scene->bodies[b].model;
        if ((b >= 0 && !scene->bodies[b].has_model) || !(model->couple_modulus > 0)) continue;
        for (int k = 0; k < scene->n_stages; ++k)
            if (scene->stages[k].solver != BRC_SOLVER_DYNAMIC)
                COMPLAIN(reader, &model->couple_modulus, model,
                         "couple_modulus: ties forces to the rotations of elements, which static stages and modes do "
                         "not know ('%s' is one); leave it out, or use "
                         "dynamic stages only",
                         scene->stages[k].name);
    }
}

bool brc_load_is_motion(const brc_load *load)
{
    return load->kind <= BRC_LOAD_ELEMENT_VELOCITY;
}

static bool moves_elements(const brc_load *load)
{
    return load->kind == BRC_LOAD_ELEMENT_DISPLACEMENT || load->kind == BRC_LOAD_ELEMENT_VELOCITY;
}

/* Two loads on one set that both say how the same component moves, or one that pushes where the other one moves.
 * Sets that overlap under different names are found when the domain is there. */
static void check_pair(brc_reader *reader, const brc_load *before, const brc_load *load)
{
    if (strcmp(before->set, load->set) != 0 || load->set[0] == '\0') return;
    for (int k = 0; k < 3; ++k) {
        if (brc_load_is_motion(before) && brc_load_is_motion(load) && moves_elements(before) == moves_elements(load) &&
            before->component[k] && load->component[k]) {
            COMPLAIN(reader, load->set, load,
                     "set: the %c component of '%s' is prescribed by an earlier load of this "
                     "stage too; keep one",
                     "xyz"[k], load -> set);
            return;
        }
        const brc_load *push = brc_load_is_motion(before) ? load : before,
                       *move = brc_load_is_motion(before) ? before : load;
        if (push->kind == BRC_LOAD_TRACTION && brc_load_is_motion(move) && !moves_elements(move) &&
            move->component[k] && push->value[k] != 0) {
            COMPLAIN(reader, load->set, load,
                     "set: a traction along %c has no effect where the %c component of '%s' is "
                     "prescribed; keep one",
                     "xyz"[k], "xyz"[k], load -> set);
            return;
        }
    }
}

/* t = 0..1 -> 0..1: the whole load grows with the increments. */
static brc_status give_ramp(brc_reader *reader, brc_table *table)
{
    BRC_TRY(BRC_ALLOCATE(reader->context, &table->time, 2, "table"));
    BRC_TRY(BRC_ALLOCATE(reader->context, &table->value, 2, "table"));
    table->n = 2;
    table->time[1] = table->value[1] = 1;
    return BRC_OK;
}

static brc_status check_stage(brc_reader *reader, brc_stage *stage)
{
    for (int l = 0; l < stage->n_loads; ++l) {
        brc_load *load = &stage->loads[l];
        if (load->radial && (load->value[0] != 0 || load->value[1] != 0 || load->value[2] != 0))
            COMPLAIN(reader, NULL, load,
                     "element_force: radial forces take no x, y, z; give those in a load of their own");
        if (load->kind == BRC_LOAD_TRACTION) load->component[0] = load->component[1] = load->component[2] = true;
        const bool velocity = load->kind == BRC_LOAD_FACE_VELOCITY || load->kind == BRC_LOAD_ELEMENT_VELOCITY;
        if (stage->solver != BRC_SOLVER_DYNAMIC && velocity)
            COMPLAIN(reader, NULL, load, "a %s stage has no velocities; prescribe a displacement",
                     stage->solver == BRC_SOLVER_STATIC ? "static" : "modes");
        if (stage->solver == BRC_SOLVER_STATIC && !load->table.time) BRC_TRY(give_ramp(reader, &load->table));
        for (int other = 0; other < l; ++other)
            check_pair(reader, &stage->loads[other], load);
    }
    return BRC_OK;
}

static brc_status check_stages(brc_reader *reader)
{
    brc_scene *scene = reader->scene;
    for (int k = 0; k < scene->n_stages; ++k) {
        brc_stage *stage = &scene->stages[k];
        BRC_TRY(check_stage(reader, stage));
        for (int other = 0; other < k; ++other) {
            if (stage->name[0] == '\0' || strcmp(scene->stages[other].name, stage->name) != 0) continue;
            COMPLAIN(reader, stage->name, stage, "name: another stage is called '%s' too; give each its own",
                     stage->name);
            break;
        }
    }
    return BRC_OK;
}

static brc_status check_names(brc_reader *reader, brc_wall_names **walls)
{
    BRC_TRY(brc_wall_names_find(reader, walls));
    brc_names_find_bodies(reader);
    BRC_TRY(brc_names_check(reader, *walls));
    if (!brc_reader_is_broken(reader, "bodies")) check_bodies(reader, *walls);
    return BRC_OK;
}

static brc_status check_rest(brc_reader *reader)
{
    check_limits(reader);
    check_couples(reader);
    brc_reader_check_fracture(reader);
    for (int k = 0; k < reader->scene->n_strikers; ++k)
        if (!reader->scene->strikers[k].is_plane) check_shape(reader, &reader->scene->strikers[k].shape);
    brc_reader_check_contact(reader);
    BRC_TRY(check_stages(reader));
    brc_reader_check_models(reader);
    brc_reader_check_sensors(reader);
    brc_reader_check_output(reader);
    return BRC_OK;
}

/* What is only seen to be wrong once the domain is built knows its place. */
static void keep_places(brc_reader *reader)
{
    brc_scene *scene = reader->scene;
    for (int32_t k = 0; k < scene->n_bodies; ++k)
        brc_problems_place(reader->problems, brc_reader_place(reader, &scene->bodies[k].fill, &scene->bodies[k]),
                           scene->bodies[k].place);
    for (int32_t k = 0; k < scene->n_sets; ++k)
        brc_problems_place(reader->problems, brc_reader_place(reader, scene->sets[k].name, &scene->sets[k]),
                           scene->sets[k].place);
    for (int32_t k = 0; k < scene->n_sensors; ++k)
        brc_problems_place(reader->problems, brc_reader_place(reader, scene->sensors[k].set, &scene->sensors[k]),
                           scene->sensors[k].place);
}

brc_status brc_reader_check(brc_reader *reader)
{
    if (reader->n_places > 0) qsort(reader->places, (size_t)reader->n_places, sizeof *reader->places, by_address);
    complete(reader->scene);
    keep_places(reader);
    brc_wall_names *walls = NULL;
    brc_status status = check_names(reader, &walls);
    if (status == BRC_OK) status = check_rest(reader);
    if (status == BRC_OK)
        status = brc_names_add_body_sets(reader, walls); /* sets move, so that their places are gone */
    brc_wall_names_free(walls);
    if (status == BRC_OK) status = brc_reader_finish_fixtures(reader);
    return status;
}
