/* What each kind of shape is. */
#include "shape_type.h"

#include "../../host/base/log.h"
#include "solid_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Curved walls never get coarser than this: volume is exact at any number, but the outline should look round. */
enum { LEAST_PRISM_SIDES = 32, LEAST_SPHERE_PLANES = 256 };

static brc_status check_size(brc_context *context, const char *what, double value)
{
    if (isfinite(value) && value > 0.0) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "shape: %s is %g m, must be finite and > 0", what, value);
}

static brc_status check_axis(brc_context *context, const char *what, int axis)
{
    if (axis >= 0 && axis <= 2) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "shape: axis of the %s is %d, must be 0 (x), 1 (y) or 2 (z)", what, axis);
}

/* Index of a wall by name, added when new. */
static int32_t wall_of(brc_solid *solid, const char *part, const char *wall)
{
    char name[72];
    snprintf(name, sizeof name, "%s%s%s", part, part[0] ? "_" : "", wall);
    for (int32_t w = 0; w < solid->n_walls; ++w)
        if (strcmp(solid->wall_name[w], name) == 0) return w;
    strcpy(solid->wall_name[solid->n_walls], name);
    return solid->n_walls++;
}

/* Add a surface of the leaf, given in the part's own coordinates. */
static void add_surface(brc_solid *solid, const char *part, const char *wall, brc_surface surface)
{
    brc_leaf *leaf = &solid->leaf[solid->n_leaves];
    double point[3], axis[3];
    brc_leaf_from_part(leaf, surface.point, point);
    brc_leaf_turn(leaf, surface.axis, axis);
    memcpy(surface.point, point, sizeof point);
    memcpy(surface.axis, axis, sizeof axis);
    surface.leaf = solid->n_leaves;
    surface.wall = wall_of(solid, part, wall);
    solid->surface[solid->n_surfaces++] = surface;
    ++leaf->n_surfaces;
}

static void add_plane(brc_solid *solid, const char *part, const char *wall, const double point[3], int axis,
                      double sign)
{
    brc_surface plane = {.kind = BRC_SURFACE_PLANE, .point = {point[0], point[1], point[2]}};
    plane.axis[axis] = sign;
    add_surface(solid, part, wall, plane);
}

static const char *const side_name[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};

/* Cylinder, cone or frustum: two ends and the side. */
static void add_round(brc_solid *solid, const char *part, const brc_shape *s)
{
    const int axis = s->axis;
    const bool cone = s->kind == BRC_SHAPE_CONE && s->radius != s->radius2;
    const double radius2 = s->kind == BRC_SHAPE_CONE ? s->radius2 : s->radius;
    double end[3] = {s->origin[0], s->origin[1], s->origin[2]};
    end[axis] += s->length;
    if (s->radius > 0.0) add_plane(solid, part, side_name[2 * axis], s->origin, axis, -1.0);
    if (radius2 > 0.0) add_plane(solid, part, side_name[2 * axis + 1], end, axis, 1.0);
    brc_surface side = {.kind = cone ? BRC_SURFACE_CONE : BRC_SURFACE_CYLINDER,
                        .radius = s->radius,
                        .point = {s->origin[0], s->origin[1], s->origin[2]}};
    side.axis[axis] = 1.0;
    if (cone) {
        const double slope = (radius2 - s->radius) / s->length; /* of the radius along the axis */
        side.point[axis] -= s->radius / slope;
        side.axis[axis] = copysign(1.0, slope);
        side.cosine = 1.0 / sqrt(1.0 + slope * slope);
        side.sine = fabs(slope) * side.cosine;
    }
    add_surface(solid, part, "side", side);
}

/* One curved surface about the origin. */
static brc_surface round_surface(brc_surface_kind kind, const brc_shape *s)
{
    return (brc_surface){
        .kind = kind, .point = {s->origin[0], s->origin[1], s->origin[2]}, .radius = s->radius, .radius2 = s->radius2};
}

/* Of a direction, what is across the axis of the shape. */
static double across(const brc_shape *s, const double u[3])
{
    return sqrt(fmax(0.0, brc_dot3(u, u) - u[s->axis] * u[s->axis]));
}

/* Bounds of what is as wide as `widest` all around, and from low to high along its axis. */
static void round_bounds(const brc_shape *s, double widest, double from, double to, double low[3], double high[3])
{
    for (int c = 0; c < 3; ++c) {
        low[c] = c == s->axis ? from : -widest;
        high[c] = c == s->axis ? to : widest;
    }
}

/* ---- box ---- */

static brc_status box_check(brc_context *context, const brc_shape *s)
{
    for (int k = 0; k < 3; ++k)
        BRC_TRY(check_size(context, "an edge length of the box", s->size[k]));
    return BRC_OK;
}
static void box_words(const brc_shape *s, char *out, size_t room)
{
    snprintf(out, room, "box %.17g x %.17g x %.17g m", s->size[0], s->size[1], s->size[2]);
}
static void box_measure(const brc_shape *s, const brc_mesh *mesh, double *volume, double *area)
{
    (void)mesh;
    *volume = s->size[0] * s->size[1] * s->size[2];
    *area = 2.0 * (s->size[0] * s->size[1] + s->size[1] * s->size[2] + s->size[2] * s->size[0]);
}
static double box_width(const brc_shape *s, const brc_mesh *mesh)
{
    (void)mesh;
    return fmin(s->size[0], fmin(s->size[1], s->size[2]));
}
static void box_bounds(const brc_shape *s, double low[3], double high[3])
{
    for (int c = 0; c < 3; ++c)
        low[c] = 0, high[c] = s->size[c];
}
static void box_surfaces(struct brc_solid *solid, const char *part, const brc_shape *s)
{
    double far_corner[3];
    for (int k = 0; k < 3; ++k)
        far_corner[k] = s->origin[k] + s->size[k];
    for (int side = 0; side < 6; ++side)
        add_plane(solid, part, side_name[side], side % 2 ? far_corner : s->origin, side / 2, side % 2 ? 1.0 : -1.0);
}
static double box_support(const struct brc_leaf *leaf, const double u[3], double along)
{
    for (int k = 0; k < 3; ++k)
        along += fmax(0.0, u[k] * leaf->shape.size[k]);
    return along;
}

/* ---- cylinder ---- */

static brc_status cylinder_check(brc_context *context, const brc_shape *s)
{
    BRC_TRY(check_axis(context, "cylinder", s->axis));
    BRC_TRY(check_size(context, "the length of the cylinder", s->length));
    return check_size(context, "the radius of the cylinder", s->radius);
}
static void cylinder_words(const brc_shape *s, char *out, size_t room)
{
    snprintf(out, room, "cylinder along %c, length %.17g m, radius %.17g m", "xyz"[s->axis], s -> length, s -> radius);
}
static void cylinder_measure(const brc_shape *s, const brc_mesh *mesh, double *volume, double *area)
{
    (void)mesh;
    const double r = s->radius;
    *volume = PI * r * r * s->length;
    *area = 2.0 * PI * r * (r + s->length);
}
static double cylinder_width(const brc_shape *s, const brc_mesh *mesh)
{
    (void)mesh;
    return fmin(2.0 * s->radius, s->length);
}
static void cylinder_bounds(const brc_shape *s, double low[3], double high[3])
{
    round_bounds(s, s->radius, 0, s->length, low, high);
}
static double cylinder_planes(const brc_shape *s, double spacing)
{
    const double r = s->radius / spacing;
    return fmax(LEAST_PRISM_SIDES, ceil(2.0 * PI * r));
}
static double cylinder_support(const struct brc_leaf *leaf, const double u[3], double along)
{
    const brc_shape *s = &leaf->shape;
    return along + fmax(0.0, u[s->axis] * s->length) + s->radius * across(s, u);
}

/* ---- sphere ---- */

static brc_status sphere_check(brc_context *context, const brc_shape *s)
{
    return check_size(context, "the radius of the sphere", s->radius);
}
static void sphere_words(const brc_shape *s, char *out, size_t room)
{
    snprintf(out, room, "sphere, radius %.17g m", s->radius);
}
static void sphere_measure(const brc_shape *s, const brc_mesh *mesh, double *volume, double *area)
{
    (void)mesh;
    const double r = s->radius;
    *volume = 4.0 / 3.0 * PI * r * r * r;
    *area = 4.0 * PI * r * r;
}
static double sphere_width(const brc_shape *s, const brc_mesh *mesh)
{
    (void)mesh;
    return 2.0 * s->radius;
}
static void sphere_bounds(const brc_shape *s, double low[3], double high[3])
{
    round_bounds(s, s->radius, -s->radius, s->radius, low, high);
}
static double sphere_planes(const brc_shape *s, double spacing)
{
    const double r = s->radius / spacing;
    return fmax(LEAST_SPHERE_PLANES, ceil(4.0 * PI * r * r));
}
static void sphere_surfaces(struct brc_solid *solid, const char *part, const brc_shape *s)
{
    brc_surface round = round_surface(BRC_SURFACE_SPHERE, s);
    round.axis[2] = 1.0;
    add_surface(solid, part, "surface", round);
}
static double sphere_support(const struct brc_leaf *leaf, const double u[3], double along)
{
    return along + leaf->shape.radius * brc_length3(u);
}

/* ---- cone, frustum ---- */

static brc_status cone_check(brc_context *context, const brc_shape *s)
{
    BRC_TRY(check_axis(context, "cone", s->axis));
    BRC_TRY(check_size(context, "the length of the cone", s->length));
    if (s->radius != 0.0) BRC_TRY(check_size(context, "the first radius of the cone", s->radius));
    if (s->radius2 != 0.0) BRC_TRY(check_size(context, "the second radius of the cone", s->radius2));
    if (s->radius == 0.0 && s->radius2 == 0.0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "shape: both radii of the cone are 0; give one of them");
    return BRC_OK;
}
static void cone_words(const brc_shape *s, char *out, size_t room)
{
    snprintf(out, room, "cone along %c, length %.17g m, radii %.17g and %.17g m", "xyz"[s->axis], s -> length,
             s -> radius, s -> radius2);
}
static void cone_measure(const brc_shape *s, const brc_mesh *mesh, double *volume, double *area)
{
    (void)mesh;
    const double r = s->radius, q = s->radius2, slant = hypot(s->length, r - q);
    *volume = PI / 3.0 * s->length * (r * r + r * q + q * q);
    *area = PI * (r * r + q * q + (r + q) * slant);
}
static double cone_width(const brc_shape *s, const brc_mesh *mesh)
{
    (void)mesh;
    return fmin(2.0 * fmax(s->radius, s->radius2), s->length);
}
static void cone_bounds(const brc_shape *s, double low[3], double high[3])
{
    round_bounds(s, fmax(s->radius, s->radius2), 0, s->length, low, high);
}
static double cone_planes(const brc_shape *s, double spacing)
{
    const double r = fmax(s->radius, s->radius2) / spacing;
    /* dozens of planes through one point, or nearly, are too much for Voro++ */
    return fmin(s->radius, s->radius2) < spacing ? 0.0 : fmax(LEAST_PRISM_SIDES, ceil(2.0 * PI * r));
}
static double cone_support(const struct brc_leaf *leaf, const double u[3], double along)
{
    const brc_shape *s = &leaf->shape;
    const double out = across(s, u);
    return along + fmax(s->radius * out, u[s->axis] * s->length + s->radius2 * out);
}

/* ---- torus ---- */

static brc_status torus_check(brc_context *context, const brc_shape *s)
{
    BRC_TRY(check_axis(context, "torus", s->axis));
    BRC_TRY(check_size(context, "the radius of the torus' centre line", s->radius));
    BRC_TRY(check_size(context, "the radius of the torus' tube", s->radius2));
    if (s->radius2 < s->radius) return BRC_OK;
    return BRC_FAIL(
        context, BRC_BAD_INPUT,
        "shape: the torus meets itself: its tube's radius %g m must be below the radius %g m of its centre line",
        s->radius2, s->radius);
}
static void torus_words(const brc_shape *s, char *out, size_t room)
{
    snprintf(out, room, "torus about %c, radii %.17g and %.17g m", "xyz"[s->axis], s -> radius, s -> radius2);
}
static void torus_measure(const brc_shape *s, const brc_mesh *mesh, double *volume, double *area)
{
    (void)mesh;
    const double r = s->radius, q = s->radius2;
    *volume = 2.0 * PI * PI * r * q * q;
    *area = 4.0 * PI * PI * r * q;
}
static double torus_width(const brc_shape *s, const brc_mesh *mesh)
{
    (void)mesh;
    return 2.0 * s->radius2;
}
static void torus_bounds(const brc_shape *s, double low[3], double high[3])
{
    round_bounds(s, s->radius + s->radius2, -s->radius2, s->radius2, low, high);
}
static void torus_surfaces(struct brc_solid *solid, const char *part, const brc_shape *s)
{
    brc_surface round = round_surface(BRC_SURFACE_TORUS, s);
    round.axis[s->axis] = 1.0;
    add_surface(solid, part, "surface", round);
}
static double torus_support(const struct brc_leaf *leaf, const double u[3], double along)
{
    const brc_shape *s = &leaf->shape;
    return along + s->radius * across(s, u) + s->radius2 * brc_length3(u);
}

/* ---- half-space ---- */

static brc_status half_space_check(brc_context *context, const brc_shape *s)
{
    if (isfinite(brc_length3(s->normal)) && brc_length3(s->normal) > 0.0) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "shape: the normal of the half-space must be finite and not 0");
}
static void half_space_words(const brc_shape *s, char *out, size_t room)
{
    snprintf(out, room, "half-space, normal (%.17g, %.17g, %.17g)", s->normal[0], s->normal[1], s->normal[2]);
}
static void half_space_surfaces(struct brc_solid *solid, const char *part, const brc_shape *s)
{
    brc_surface round = round_surface(BRC_SURFACE_PLANE, s);
    for (int k = 0; k < 3; ++k)
        round.axis[k] = s->normal[k] / brc_length3(s->normal);
    add_surface(solid, part, "cut", round);
}
static double half_space_support(const struct brc_leaf *leaf, const double u[3], double along)
{
    const double *normal = leaf->shape.normal, length = brc_length3(normal);
    for (int k = 0; k < 3; ++k)
        if (fabs(u[k] - normal[k] / length) > 1e-12) return HUGE_VAL;
    return along;
}

/* ---- mesh ---- */

static brc_status mesh_check(brc_context *context, const brc_shape *s)
{
    if (isfinite(s->scale) && s->scale > 0.0) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "shape: the mesh's scale is %g m per unit of its file, must be finite and > 0; "
                    "use 1e-3 for millimetres",
                    s->scale);
}
static void mesh_words(const brc_shape *s, char *out, size_t room)
{
    snprintf(out, room, "mesh %s, %.17g m per unit", s->file, s->scale);
}
static void mesh_measure(const brc_shape *s, const brc_mesh *mesh, double *volume, double *area)
{
    (void)s;
    *volume = brc_mesh_volume(mesh);
    *area = brc_mesh_area(mesh);
}
static double mesh_width(const brc_shape *s, const brc_mesh *mesh)
{
    double b[2][3];
    (void)s;
    brc_mesh_bounds(mesh, b);
    return fmin(b[1][0] - b[0][0], fmin(b[1][1] - b[0][1], b[1][2] - b[0][2]));
}
static void mesh_surfaces(struct brc_solid *solid, const char *part, const brc_shape *s)
{
    add_surface(solid, part, "surface", round_surface(BRC_SURFACE_MESH, s));
}
/* A mesh is taken as its box of bounds. */
static double mesh_support(const struct brc_leaf *leaf, const double u[3], double along)
{
    double b[2][3];
    brc_mesh_bounds(leaf->mesh, b);
    for (int k = 0; k < 3; ++k)
        along += u[k] * (u[k] > 0.0 ? b[1][k] : b[0][k]) - u[k] * leaf->shape.origin[k];
    return along;
}

/* ---- parts ---- */

static brc_status parts_check(brc_context *context, const brc_shape *s)
{
    (void)s;
    return BRC_FAIL(context, BRC_BAD_INPUT, "shape: a part cannot have parts itself; list them one after the other");
}

const brc_shape_type *brc_shape_type_of(brc_shape_kind kind)
{
    static const brc_shape_type all[] = {
        [BRC_SHAPE_BOX] = {box_check, box_words, box_measure, box_width, box_bounds, NULL, box_surfaces, box_support,
                           NULL, 0},
        [BRC_SHAPE_CYLINDER] = {cylinder_check, cylinder_words, cylinder_measure, cylinder_width, cylinder_bounds,
                                cylinder_planes, add_round, cylinder_support, "side", 1},
        [BRC_SHAPE_SPHERE] = {sphere_check, sphere_words, sphere_measure, sphere_width, sphere_bounds, sphere_planes,
                              sphere_surfaces, sphere_support, "surface", 2},
        [BRC_SHAPE_CONE] = {cone_check, cone_words, cone_measure, cone_width, cone_bounds, cone_planes, add_round,
                            cone_support, NULL, 1},
        [BRC_SHAPE_TORUS] = {torus_check, torus_words, torus_measure, torus_width, torus_bounds, NULL, torus_surfaces,
                             torus_support, "surface", 2},
        [BRC_SHAPE_HALF_SPACE] = {half_space_check, half_space_words, NULL, NULL, NULL, NULL, half_space_surfaces,
                                  half_space_support, NULL, 0},
        [BRC_SHAPE_MESH] = {mesh_check, mesh_words, mesh_measure, mesh_width, NULL, NULL, mesh_surfaces, mesh_support,
                            "surface", 1},
        [BRC_SHAPE_PARTS] = {.check = parts_check}};
    return kind >= 0 && kind < (brc_shape_kind)(sizeof all / sizeof *all) ? &all[kind] : NULL;
}
