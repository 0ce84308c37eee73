/* One leaf of a solid: its checks, its surfaces and walls, and how far it reaches in a direction. */
#include "../domain/pose.h"
#include "solid_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

static brc_status check_leaf(brc_context *context, const brc_shape *shape)
{
    for (int k = 0; k < 3; ++k)
        if (!isfinite(shape->origin[k]))
            return BRC_FAIL(context, BRC_BAD_INPUT, "shape: origin has the component %g, must be finite",
                            shape->origin[k]);
    switch (shape->kind) {
    case BRC_SHAPE_BOX:
        for (int k = 0; k < 3; ++k)
            BRC_TRY(check_size(context, "an edge length of the box", shape->size[k]));
        return BRC_OK;
    case BRC_SHAPE_CYLINDER:
        BRC_TRY(check_axis(context, "cylinder", shape->axis));
        BRC_TRY(check_size(context, "the length of the cylinder", shape->length));
        return check_size(context, "the radius of the cylinder", shape->radius);
    case BRC_SHAPE_SPHERE: return check_size(context, "the radius of the sphere", shape->radius);
    case BRC_SHAPE_CONE:
        BRC_TRY(check_axis(context, "cone", shape->axis));
        BRC_TRY(check_size(context, "the length of the cone", shape->length));
        if (shape->radius != 0.0) BRC_TRY(check_size(context, "the first radius of the cone", shape->radius));
        if (shape->radius2 != 0.0) BRC_TRY(check_size(context, "the second radius of the cone", shape->radius2));
        if (shape->radius == 0.0 && shape->radius2 == 0.0)
            return BRC_FAIL(context, BRC_BAD_INPUT, "shape: both radii of the cone are 0; give one of them");
        return BRC_OK;
    case BRC_SHAPE_TORUS:
        BRC_TRY(check_axis(context, "torus", shape->axis));
        BRC_TRY(check_size(context, "the radius of the torus' centre line", shape->radius));
        BRC_TRY(check_size(context, "the radius of the torus' tube", shape->radius2));
        if (shape->radius2 < shape->radius) return BRC_OK;
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "shape: the torus meets itself: its tube's radius %g m must be below the radius %g m of its centre line",
            shape->radius2, shape->radius);
    case BRC_SHAPE_HALF_SPACE:
        if (isfinite(brc_length3(shape->normal)) && brc_length3(shape->normal) > 0.0) return BRC_OK;
        return BRC_FAIL(context, BRC_BAD_INPUT, "shape: the normal of the half-space must be finite and not 0");
    case BRC_SHAPE_MESH:
        if (isfinite(shape->scale) && shape->scale > 0.0) return BRC_OK;
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "shape: the mesh's scale is %g m per unit of its file, must be finite and > 0; "
                        "use 1e-3 for millimetres",
                        shape->scale);
    case BRC_SHAPE_PARTS:
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "shape: a part cannot have parts itself; list them one after the other");
    }
    return BRC_FAIL(context, BRC_BAD_INPUT, "shape: kind %d is unknown", (int)shape->kind);
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

static void add_surfaces(brc_solid *solid, const char *part, const brc_shape *s)
{
    brc_surface round = {
        .point = {s->origin[0], s->origin[1], s->origin[2]}, .radius = s->radius, .radius2 = s->radius2};
    double far_corner[3];
    switch (s->kind) {
    case BRC_SHAPE_BOX:
        for (int k = 0; k < 3; ++k)
            far_corner[k] = s->origin[k] + s->size[k];
        for (int side = 0; side < 6; ++side)
            add_plane(solid, part, side_name[side], side % 2 ? far_corner : s->origin, side / 2, side % 2 ? 1.0 : -1.0);
        return;
    case BRC_SHAPE_CYLINDER:
    case BRC_SHAPE_CONE: add_round(solid, part, s); return;
    case BRC_SHAPE_SPHERE:
        round.kind = BRC_SURFACE_SPHERE;
        round.axis[2] = 1.0;
        add_surface(solid, part, "surface", round);
        return;
    case BRC_SHAPE_TORUS:
        round.kind = BRC_SURFACE_TORUS;
        round.axis[s->axis] = 1.0;
        add_surface(solid, part, "surface", round);
        return;
    case BRC_SHAPE_HALF_SPACE:
        round.kind = BRC_SURFACE_PLANE;
        for (int k = 0; k < 3; ++k)
            round.axis[k] = s->normal[k] / brc_length3(s->normal);
        add_surface(solid, part, "cut", round);
        return;
    case BRC_SHAPE_MESH:
        round.kind = BRC_SURFACE_MESH;
        add_surface(solid, part, "surface", round);
        return;
    case BRC_SHAPE_PARTS: return;
    }
}

static void place(brc_leaf *leaf, const brc_shape_part *part)
{
    brc_pose_matrix(part->rotation, leaf->frame);
    memcpy(leaf->pivot, part->shape.origin, sizeof leaf->pivot);
    memcpy(leaf->shift, part->translation, sizeof leaf->shift);
    leaf->posed = brc_length3(part->rotation) > 0.0 || brc_length3(part->translation) > 0.0;
}

brc_status brc_leaf_create(brc_context *context, brc_solid *solid, const brc_shape_part *part, int n_threads)
{
    BRC_TRY(check_leaf(context, &part->shape));
    for (int k = 0; k < 3; ++k)
        if (!isfinite(part->translation[k]) || !isfinite(part->rotation[k]))
            return BRC_FAIL(context, BRC_BAD_INPUT, "shape: translation and rotation of a part must be finite");
    brc_leaf *leaf = &solid->leaf[solid->n_leaves];
    leaf->role = part->role;
    leaf->shape = part->shape;
    leaf->first = solid->n_surfaces;
    place(leaf, part);
    if (part->shape.kind == BRC_SHAPE_MESH)
        BRC_TRY(brc_mesh_read_stl(context, part->shape.file, part->shape.scale, part->shape.origin, n_threads,
                                  &leaf->mesh));
    add_surfaces(solid, part->name, &part->shape);
    for (int k = 0; k < 3; ++k)
        for (int sign = 0; sign < 2; ++sign) {
            double direction[3] = {0.0, 0.0, 0.0};
            direction[k] = sign ? 1.0 : -1.0;
            leaf->bounds[sign][k] = direction[k] * brc_leaf_support(leaf, direction) + 0.0; /* no negative zero */
        }
    ++solid->n_leaves;
    return BRC_OK;
}

void brc_leaf_to_part(const brc_leaf *leaf, const double x[3], double out[3])
{
    double y[3];
    memcpy(out, x, sizeof y);
    if (!leaf->posed) return;
    for (int k = 0; k < 3; ++k)
        y[k] = x[k] - leaf->pivot[k] - leaf->shift[k];
    for (int k = 0; k < 3; ++k)
        out[k] = leaf->pivot[k] + leaf->frame[0][k] * y[0] + leaf->frame[1][k] * y[1] + leaf->frame[2][k] * y[2];
}

void brc_leaf_turn(const brc_leaf *leaf, const double direction[3], double out[3])
{
    for (int k = 0; k < 3; ++k)
        out[k] = brc_dot3(leaf->frame[k], direction);
}

void brc_leaf_from_part(const brc_leaf *leaf, const double x[3], double out[3])
{
    const double y[3] = {x[0] - leaf->pivot[0], x[1] - leaf->pivot[1], x[2] - leaf->pivot[2]};
    memcpy(out, x, sizeof y);
    if (!leaf->posed) return;
    brc_leaf_turn(leaf, y, out);
    for (int k = 0; k < 3; ++k)
        out[k] += leaf->pivot[k] + leaf->shift[k];
}

/* direction: unit or one axis, in the shape's frame. A box is exact; a mesh is taken as its box of bounds. */
double brc_leaf_support(const brc_leaf *leaf, const double direction[3])
{
    const brc_shape *s = &leaf->shape;
    double u[3], centre[3], mesh_bounds[2][3];
    for (int k = 0; k < 3; ++k)
        u[k] = leaf->frame[0][k] * direction[0] + leaf->frame[1][k] * direction[1] + leaf->frame[2][k] * direction[2];
    brc_leaf_from_part(leaf, s->origin, centre);
    double along = brc_dot3(direction, centre);
    const double across = s->kind == BRC_SHAPE_BOX || s->kind == BRC_SHAPE_HALF_SPACE || s->kind == BRC_SHAPE_MESH
                              ? 0.0
                              : sqrt(fmax(0.0, brc_dot3(u, u) - u[s->axis] * u[s->axis]));
    switch (s->kind) {
    case BRC_SHAPE_BOX:
        for (int k = 0; k < 3; ++k)
            along += fmax(0.0, u[k] * s->size[k]);
        return along;
    case BRC_SHAPE_SPHERE: return along + s->radius * brc_length3(u);
    case BRC_SHAPE_CYLINDER: return along + fmax(0.0, u[s->axis] * s->length) + s->radius * across;
    case BRC_SHAPE_CONE: return along + fmax(s->radius * across, u[s->axis] * s->length + s->radius2 * across);
    case BRC_SHAPE_TORUS: return along + s->radius * across + s->radius2 * brc_length3(u);
    case BRC_SHAPE_HALF_SPACE: {
        const double length = brc_length3(s->normal);
        for (int k = 0; k < 3; ++k)
            if (fabs(u[k] - s->normal[k] / length) > 1e-12) return HUGE_VAL;
        return along;
    }
    case BRC_SHAPE_MESH:
        brc_mesh_bounds(leaf->mesh, mesh_bounds);
        for (int k = 0; k < 3; ++k)
            along += u[k] * (u[k] > 0.0 ? mesh_bounds[1][k] : mesh_bounds[0][k]) - u[k] * s->origin[k];
        return along;
    case BRC_SHAPE_PARTS: break;
    }
    return HUGE_VAL;
}

bool brc_leaf_inside(const brc_solid *solid, const brc_leaf *leaf, const double x[3])
{
    for (int k = 0; k < 3; ++k)
        if (!(x[k] >= leaf->bounds[0][k] && x[k] <= leaf->bounds[1][k])) return false;
    if (leaf->mesh) {
        double y[3];
        brc_leaf_to_part(leaf, x, y);
        return brc_mesh_inside(leaf->mesh, y);
    }
    for (int32_t s = leaf->first; s < leaf->first + leaf->n_surfaces; ++s)
        if (brc_surface_height(solid, &solid->surface[s], x, NULL) > 0.0) return false;
    return true;
}
