/* One leaf of a solid: its pose, and how far it reaches in a direction. */
#include "../domain/pose.h"
#include "shape_type.h"
#include "solid_internal.h"

#include <math.h>
#include <string.h>

static brc_status check_leaf(brc_context *context, const brc_shape *shape)
{
    for (int k = 0; k < 3; ++k)
        if (!isfinite(shape->origin[k]))
            return BRC_FAIL(context, BRC_BAD_INPUT, "shape: origin has the component %g, must be finite",
                            shape->origin[k]);
    const brc_shape_type *type = brc_shape_type_of(shape->kind);
    if (!type) return BRC_FAIL(context, BRC_BAD_INPUT, "shape: kind %d is unknown", (int)shape->kind);
    return type->check(context, shape);
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
    brc_shape_type_of(part->shape.kind)->surfaces(solid, part->name, &part->shape);
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
    double u[3], centre[3];
    for (int k = 0; k < 3; ++k)
        u[k] = leaf->frame[0][k] * direction[0] + leaf->frame[1][k] * direction[1] + leaf->frame[2][k] * direction[2];
    brc_leaf_from_part(leaf, s->origin, centre);
    return brc_shape_type_of(s->kind)->support(leaf, u, brc_dot3(direction, centre));
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
