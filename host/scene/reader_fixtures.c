/* Platens, jaws and rollers: where their strikers stand follows from the shape of the body that they press. */
#include "../../preprocess/shapes/shape_type.h"
#include "reader_internal.h"
#include "schema_internal.h"
#include "../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Flat faces around a turn of a roller: the strikers' own default. */
#define FACETS 48
/* Of the body's extents: how thick tools are along the axis, and how far platens stand out. */
#define THICKNESS 0.2
#define OVERHANG 0.1

/* One of the three, being expanded. */
typedef struct fixture {
    const brc_fixture *as;
    const char *name, *tool; /* "platens", "platen" */
    const brc_body *body;
    double bounds[2][3];     /* of the posed body, smallest and largest corner [m] */
    double gap;              /* [m] */
    int axis, along, across; /* of the load; of the span or the jaws' width; the third */
} fixture;

static const struct {
    const char *name, *tool;
    size_t offset;
} FIXTURE[3] = {{"platens", "platen", offsetof(brc_scene, platens)},
                {"jaws", "jaw", offsetof(brc_scene, jaws)},
                {"rollers", "roller", offsetof(brc_scene, rollers)}};

static const brc_fixture *fixture_of(const brc_scene *scene, int k)
{
    return (const brc_fixture *)(const void *)((const char *)scene + FIXTURE[k].offset);
}

/* Places are not in order yet: looked for one by one. */
static brc_mark place_of(const brc_reader *reader, const brc_fixture *of, const void *field)
{
    brc_mark mark = {0, 1, 1};
    for (int64_t k = 0; k < reader->n_places; ++k) {
        if (reader->places[k].address == &of->given) mark = reader->places[k].mark;
        if (reader->places[k].address == field && reader->places[k].entry) return reader->places[k].mark;
    }
    return mark;
}
#define REFUSE(reader, f, field, ...)                                                                                  \
    brc_problems_add((reader)->problems, place_of((reader), (f)->as, (field)), __VA_ARGS__)

/* Mean size of the elements that a fill makes of the bounds, from above [m]; 0: not known. */
static double size_of_elements(const brc_fill *fill, double bounds[2][3])
{
    const double e[3] = {bounds[1][0] - bounds[0][0], bounds[1][1] - bounds[0][1], bounds[1][2] - bounds[0][2]};
    if (fill->spacing > 0) return fill->spacing;
    if (fill->cells[0] > 0)
        return fmax(e[0] / (double)fill->cells[0], fmax(e[1] / (double)fill->cells[1], e[2] / (double)fill->cells[2]));
    if (fill->radius > 0) return 2 * fill->radius;
    return fill->n_elements > 0 ? cbrt(e[0] * e[1] * e[2] / (double)fill->n_elements) : 0;
}

/* How far the corners of cells stand out of a round wall of radius R, which has as many flat faces as hold its volume:
 * h^2 / (12 R) around a cylinder, twice that on a sphere. */
static double stand_out(const brc_body *body, double bounds[2][3], int axis)
{
    const brc_shape_kind kind = body->shape.kind;
    const bool ends = (kind == BRC_SHAPE_CYLINDER || kind == BRC_SHAPE_CONE) && body->shape.axis == axis;
    const int curved = brc_shape_type_of(kind)->curved;
    if (body->beams > 0 || curved == 0 || ends) return 0;
    const double size = size_of_elements(&body->fill, bounds), radius = 0.5 * (bounds[1][axis] - bounds[0][axis]);
    return curved * size * size / (12 * radius);
}

/* Bounds of a single shape; false: they are not known here. */
static bool bounds_of_leaf(const brc_shape *shape, double bounds[2][3])
{
    const brc_shape_type *type = brc_shape_type_of(shape->kind);
    double low[3], high[3];
    if (!type->bounds) return false;
    type->bounds(shape, low, high);
    for (int c = 0; c < 3; ++c) {
        bounds[0][c] = shape->origin[c] + low[c];
        bounds[1][c] = shape->origin[c] + high[c];
    }
    return true;
}

static bool is_turned(const double rotation[3])
{
    return rotation[0] != 0 || rotation[1] != 0 || rotation[2] != 0;
}

/* Bounds of a shape; of parts those of what is added, where nothing is cut off by a plane or kept of it. */
static bool bounds_of(const brc_shape *shape, double bounds[2][3])
{
    if (shape->kind != BRC_SHAPE_PARTS) return bounds_of_leaf(shape, bounds);
    for (int p = 0; p < shape->n_parts; ++p) {
        const brc_shape_part *part = &shape->parts[p];
        double own[2][3];
        if (part->role == BRC_PART_REMOVE && part->shape.kind != BRC_SHAPE_HALF_SPACE) continue;
        if (part->role != BRC_PART_ADD || is_turned(part->rotation) || !bounds_of_leaf(&part->shape, own)) return false;
        for (int c = 0; c < 3; ++c) {
            bounds[0][c] =
                p == 0 ? own[0][c] + part->translation[c] : fmin(bounds[0][c], own[0][c] + part->translation[c]);
            bounds[1][c] =
                p == 0 ? own[1][c] + part->translation[c] : fmax(bounds[1][c], own[1][c] + part->translation[c]);
        }
    }
    return shape->n_parts > 0;
}

/* The body, its bounds and the directions; false: refused. */
static bool find_body(brc_reader *reader, fixture *f)
{
    const brc_scene *scene = reader->scene;
    for (int b = 0; b < scene->n_bodies; ++b)
        if (f->as->body[0] == '\0' || strcmp(scene->bodies[b].name, f->as->body) == 0) f->body = &scene->bodies[b];
    if (f->as->body[0] == '\0' && scene->n_bodies > 1) {
        REFUSE(reader, f, &f->as->given,
               "%s: the scene has %d bodies; expected the one that is pressed, as in body: %s", f->name,
               scene->n_bodies, scene->bodies[0].name);
        return false;
    }
    if (!f->body) return false; /* the name is refused with all others */
    if (f->body->domain_file[0] || is_turned(f->body->rotation) || !bounds_of(&f->body->shape, f->bounds)) {
        REFUSE(reader, f, &f->as->given,
               "%s: the bounds of body '%s' are not known here, as it comes from a file, is turned, or is cut by "
               "planes; place strikers of your own (docs/notebook/strikers.md)",
               f->name, f->body->name);
        return false;
    }
    for (int c = 0; c < 6; ++c)
        f->bounds[c / 3][c % 3] += f->body->translation[c % 3];
    return true;
}

static double extent(const fixture *f, int c)
{
    return f->bounds[1][c] - f->bounds[0][c];
}

/* The span runs where the body is longer, jaws lie along the axis of a cylinder, else where the body is shorter. */
static void find_directions(fixture *f)
{
    const int a = f->axis = f->as->axis, other[2] = {a == 0 ? 1 : 0, a == 2 ? 1 : 2};
    const bool round = f->body->shape.kind == BRC_SHAPE_CYLINDER && f->body->shape.axis != a;
    int along = extent(f, other[1]) > extent(f, other[0]) ? other[1] : other[0];
    if (strcmp(f->tool, "jaw") == 0 && round) along = 3 - a - f->body->shape.axis;
    if (strcmp(f->tool, "roller") == 0 && f->as->along > 0) along = f->as->along - 1;
    f->along = along;
    f->across = 3 - a - along;
    f->gap = f->as->gap > 0 ? f->as->gap : stand_out(f->body, f->bounds, a);
}

static int32_t tool_material(brc_reader *reader, const fixture *f)
{
    brc_scene *scene = reader->scene;
    if (f->as->has_material) return f->as->material;
    for (int m = 0; m < scene->n_materials; ++m)
        if (strcmp(scene->materials[m].name, "steel") == 0) return m;
    scene->materials[scene->n_materials] =
        (brc_material){.name = "steel", .young = 210e9, .poisson = 0.3, .density = 7850};
    reader->own_material = true;
    return scene->n_materials++;
}

/* A tool that moves the way of `way` along the axis, with this share of the speed; 0: it stays. */
static brc_status add_striker(brc_reader *reader, const fixture *f, const char *which, int way, double share,
                              brc_striker **out)
{
    brc_scene *scene = reader->scene;
    if (!scene->strikers) BRC_TRY(BRC_ALLOCATE(reader->context, &scene->strikers, BRC_FIXTURE_STRIKERS, "strikers"));
    brc_striker *striker = *out = &scene->strikers[scene->n_strikers];
    *striker = (brc_striker){.facets = FACETS, .material = tool_material(reader, f), .mass = f->as->mass};
    snprintf(striker->name, sizeof striker->name, "%s_%s", f->tool, which);
    for (int k = 0; k < scene->n_strikers; ++k)
        if (strcmp(scene->strikers[k].name, striker->name) == 0)
            REFUSE(reader, f, &f->as->given,
                   "%s: they make a striker '%s', and the scene has one of this name; give that another name", f->name,
                   striker->name);
    ++scene->n_strikers;
    if (way == 0) return BRC_OK;
    striker->pushed = f->as->force > 0;
    striker->motion = striker->pushed ? BRC_STRIKER_FREE : BRC_STRIKER_DRIVEN;
    striker->velocity[f->axis] = striker->pushed ? 0 : way * share * f->as->speed;
    striker->force[f->axis] = way * f->as->force;
    striker->held_rotation = striker->pushed; /* a free one is led along the axis */
    for (int c = 0; c < 3; ++c)
        striker->held[c] = striker->pushed && c != f->axis;
    if (!(f->as->ramp > 0)) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(reader->context, &striker->table.time, 2, "table"));
    BRC_TRY(BRC_ALLOCATE(reader->context, &striker->table.value, 2, "table"));
    striker->table.n = 2;
    striker->table.time[1] = f->as->ramp;
    striker->table.value[1] = 1;
    return BRC_OK;
}

/* The tool on a side (0 low, 1 high). */
static brc_status add_side(brc_reader *reader, const fixture *f, int side, brc_striker **out)
{
    const bool both = f->as->moves == BRC_FIXTURE_BOTH,
               moves = both || (f->as->moves == BRC_FIXTURE_HIGH) == (side == 1);
    return add_striker(reader, f, side ? "high" : "low", !moves ? 0 : side ? -1 : 1, both ? 0.5 : 1, out);
}

static brc_status add_platens(brc_reader *reader, const fixture *f)
{
    const double thick = THICKNESS * extent(f, f->axis),
                 out = OVERHANG * fmax(extent(f, f->along), extent(f, f->across));
    for (int side = 0; side < 2; ++side) {
        brc_striker *striker;
        BRC_TRY(add_side(reader, f, side, &striker));
        brc_shape *box = &striker->shape;
        box->kind = BRC_SHAPE_BOX;
        for (int c = 0; c < 3; ++c) {
            box->origin[c] = f->bounds[0][c] - out;
            box->size[c] = extent(f, c) + 2 * out;
        }
        box->origin[f->axis] = side ? f->bounds[1][f->axis] + f->gap : f->bounds[0][f->axis] - f->gap - thick;
        box->size[f->axis] = thick;
    }
    return BRC_OK;
}

/* A block less a cylinder. */
static brc_status add_jaws(brc_reader *reader, const fixture *f)
{
    const double width = f->as->width > 0 ? f->as->width : 0.5 * extent(f, f->along),
                 thick = THICKNESS * extent(f, f->axis), radius = f->as->radius;
    const double middle = 0.5 * (f->bounds[0][f->along] + f->bounds[1][f->along]),
                 out = OVERHANG * extent(f, f->across);
    if (2 * radius < extent(f, f->along) * (1 - 1e-9)) {
        REFUSE(reader, f, &f->as->radius,
               "radius: the hollow of %.4g m is narrower than the body, which is %.4g m across; expected a radius of "
               "%.4g m or more",
               radius, extent(f, f->along), 0.5 * extent(f, f->along));
        return BRC_OK;
    }
    if (!(width < 2 * radius)) {
        REFUSE(reader, f, &f->as->width,
               "width: jaws %.4g m wide reach round their hollow of radius %.4g m; expected less than its diameter",
               width, radius);
        return BRC_OK;
    }
    const double cell = cbrt(width * thick * (extent(f, f->across) + 2 * out) / (10 * FACETS)),
                 stands_out = cell * cell / (24 * radius); /* the hollow is filled with convex cells */
    const double sag = radius - sqrt(radius * radius - 0.25 * width * width);
    for (int side = 0; side < 2; ++side) {
        brc_striker *striker;
        BRC_TRY(add_side(reader, f, side, &striker));
        striker->shape.kind = BRC_SHAPE_PARTS;
        BRC_TRY(BRC_ALLOCATE(reader->context, &striker->shape.parts, 2, "parts of a jaw"));
        striker->shape.n_parts = 2;
        brc_shape *block = &striker->shape.parts[0].shape, *hollow = &striker->shape.parts[1].shape;
        const double sign = side ? 1 : -1,
                     apex = f->bounds[side][f->axis] + sign * (f->as->gap > 0 ? f->gap : f->gap + stands_out);
        block->kind = BRC_SHAPE_BOX;
        block->origin[f->across] = f->bounds[0][f->across] - out;
        block->size[f->across] = extent(f, f->across) + 2 * out;
        block->origin[f->along] = middle - 0.5 * width;
        block->size[f->along] = width;
        block->origin[f->axis] = side ? apex - sag : apex - thick;
        block->size[f->axis] = thick + sag;
        striker->shape.parts[1].role = BRC_PART_REMOVE;
        *hollow = (brc_shape){
            .kind = BRC_SHAPE_CYLINDER, .axis = f->across, .radius = radius, .length = extent(f, f->across) + 4 * out};
        hollow->origin[f->across] = f->bounds[0][f->across] - 2 * out;
        hollow->origin[f->along] = middle;
        hollow->origin[f->axis] = apex - sign * radius;
    }
    return BRC_OK;
}

static brc_status add_rollers(brc_reader *reader, const fixture *f)
{
    static const char *const WHICH[3] = {"left", "right", "load"};
    const int high = f->as->moves == BRC_FIXTURE_HIGH;
    const double middle = 0.5 * (f->bounds[0][f->along] + f->bounds[1][f->along]),
                 out = OVERHANG * extent(f, f->across);
    /* flat faces that hold the cylinder's volume have corners outside of it */
    const double corner = f->as->radius * sqrt(2 * M_PI / FACETS / sin(2 * M_PI / FACETS));
    if (f->along == f->axis) {
        REFUSE(reader, f, &f->as->along,
               "along: the span runs across the load, which is along %c; expected another direction", 'x' + f->axis);
        return BRC_OK;
    }
    if (!(f->as->span < extent(f, f->along)))
        REFUSE(reader, f, &f->as->span,
               "span: %.4g m is no less than the body's length, %.4g m along %c, so that supports are not below it; "
               "expected less",
               f->as->span, extent(f, f->along), 'x' + f->along);
    if (!(f->as->span > 2 * f->as->radius))
        REFUSE(reader, f, &f->as->span,
               "span: supports of radius %.4g m meet within %.4g m; expected a longer span or thinner rollers",
               f->as->radius, f->as->span);
    for (int k = 0; k < 3; ++k) {
        brc_striker *striker;
        const int side = k == 2 ? high : !high;
        BRC_TRY(add_striker(reader, f, WHICH[k], k != 2 ? 0 : high ? -1 : 1, 1, &striker));
        striker->shape = (brc_shape){.kind = BRC_SHAPE_CYLINDER,
                                     .axis = f->across,
                                     .radius = f->as->radius,
                                     .length = extent(f, f->across) + 2 * out};
        striker->shape.origin[f->across] = f->bounds[0][f->across] - out;
        striker->shape.origin[f->along] = middle + (k == 2 ? 0 : k == 0 ? -0.5 : 0.5) * f->as->span;
        striker->shape.origin[f->axis] = f->bounds[side][f->axis] + (side ? 1 : -1) * (f->gap + corner * (1 + 1e-9));
    }
    return BRC_OK;
}

/* A sensor of a tool, positive in compression, unless the scene has one of the name. */
static brc_status add_sensor(brc_reader *reader, const fixture *f, const char *what, const char *striker,
                             const char *against, const char *term)
{
    brc_scene *scene = reader->scene;
    if (!scene->sensors) BRC_TRY(BRC_ALLOCATE(reader->context, &scene->sensors, BRC_FIXTURE_SENSORS, "sensors"));
    brc_sensor sensor = {.kind = BRC_SENSOR_STRIKER, .component = f->as->axis, .sign = BRC_SIGN_COMPRESSION};
    snprintf(sensor.name, sizeof sensor.name, "%s_%s", f->name, what);
    snprintf(sensor.set, sizeof sensor.set, "%s_%s", f->tool, striker);
    if (against) snprintf(sensor.set2, sizeof sensor.set2, "%s_%s", f->tool, against);
    snprintf(sensor.term, sizeof sensor.term, "%s", term);
    for (int k = 0; k < scene->n_sensors; ++k)
        if (strcmp(scene->sensors[k].name, sensor.name) == 0) return BRC_OK;
    scene->sensors[scene->n_sensors++] = sensor;
    return BRC_OK;
}

static brc_status add_sensors(brc_reader *reader, const fixture *f)
{
    if (strcmp(f->tool, "roller") == 0) {
        BRC_TRY(add_sensor(reader, f, "force", "load", NULL, "force"));
        return add_sensor(reader, f, "displacement", "load", NULL, "displacement");
    }
    BRC_TRY(add_sensor(reader, f, "force", "high", NULL, "force"));
    BRC_TRY(add_sensor(reader, f, "reaction", "low", NULL, "force"));
    return add_sensor(reader, f, "displacement", "high", "low", "displacement");
}

brc_status brc_reader_expand_fixtures(brc_reader *reader)
{
    brc_scene *scene = reader->scene;
    for (int k = 0; k < 3; ++k) {
        fixture f = {.as = fixture_of(scene, k), .name = FIXTURE[k].name, .tool = FIXTURE[k].tool};
        if (!f.as->given) continue;
        if (!scene->has_contact) {
            scene->has_contact = true;
            BRC_TRY(brc_reader_defaults(reader, &brc_schema_contact, place_of(reader, f.as, &f.as->given), scene));
        }
        BRC_TRY(add_sensors(reader, &f)); /* others may name them, whatever is wrong here */
        if (f.as->mass > 0 && !(f.as->force > 0))
            REFUSE(reader, &f, &f.as->mass,
                   "mass: tools that move with a prescribed speed need none; leave it out, or press them by `force` in "
                   "place of `speed`");
        if (brc_problems_count(reader->problems) > 0 || !find_body(reader, &f)) continue;
        find_directions(&f);
        BRC_TRY(k == 0 ? add_platens(reader, &f) : k == 1 ? add_jaws(reader, &f) : add_rollers(reader, &f));
    }
    return BRC_OK;
}

/* Friction of the tools with every material of the body, in place of what contact says. */
static brc_status add_friction(brc_reader *reader, const brc_fixture *as, int32_t tool)
{
    brc_scene *scene = reader->scene;
    const brc_body *body = NULL;
    for (int b = 0; b < scene->n_bodies; ++b)
        if (as->body[0] == '\0' || strcmp(scene->bodies[b].name, as->body) == 0) body = &scene->bodies[b];
    if (!as->has_friction || !body) return BRC_OK;
    BRC_TRY(brc_memory_resize(reader->context, (void **)&scene->contact.pairs,
                              (int64_t)scene->contact.n_pairs + scene->n_materials, sizeof *scene->contact.pairs,
                              "laws of contact"));
    for (int32_t m = 0; m < scene->n_materials; ++m) {
        if (!brc_body_uses(body, m)) continue;
        brc_contact_law *law = &scene->contact.pairs[scene->contact.n_pairs++];
        *law = scene->contact.law;
        law->friction = as->friction;
        law->material[0] = tool;
        law->material[1] = m;
    }
    return BRC_OK;
}

/* The largest force, unless the scene has a measure of the name; and the curve of force over displacement, where there
 * is none. */
static brc_status add_measure(brc_reader *reader, const char *name)
{
    brc_scene *scene = reader->scene;
    brc_measure measure = {.kind = BRC_MEASURE_PEAK, .scale = 1};
    snprintf(measure.name, sizeof measure.name, "%s_peak_force", name);
    snprintf(measure.y, sizeof measure.y, "%s_force", name);
    if (scene->output.curve_x[0] == '\0') {
        snprintf(scene->output.curve_x, sizeof scene->output.curve_x, "%s_displacement", name);
        snprintf(scene->output.curve_y, sizeof scene->output.curve_y, "%s_force", name);
    }
    for (int k = 0; k < scene->n_measures; ++k)
        if (strcmp(scene->measures[k].name, measure.name) == 0) return BRC_OK;
    BRC_TRY(brc_memory_resize(reader->context, (void **)&scene->measures, (int64_t)scene->n_measures + 1,
                              sizeof *scene->measures, "measures"));
    scene->measures[scene->n_measures++] = measure;
    return BRC_OK;
}

brc_status brc_reader_finish_fixtures(brc_reader *reader)
{
    brc_scene *scene = reader->scene;
    for (int k = 0; k < 3; ++k) {
        const brc_fixture *as = fixture_of(scene, k);
        char first[BRC_NAME];
        snprintf(first, sizeof first, "%s_%s", FIXTURE[k].tool, k == 2 ? "load" : "high");
        for (int s = 0; s < scene->n_strikers && as->given; ++s)
            if (strcmp(scene->strikers[s].name, first) == 0)
                BRC_TRY(add_friction(reader, as, scene->strikers[s].material));
        if (as->given) BRC_TRY(add_measure(reader, FIXTURE[k].name));
    }
    return BRC_OK;
}
