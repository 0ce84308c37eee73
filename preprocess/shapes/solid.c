/* A solid as a list of leaves: made, described and asked whether a point is inside. */
#include "shape_type.h"
#include "solid_internal.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <string.h>

/* A step off a surface, of the shape's size: far above rounding, far below any feature. */
#define TINY_STEP 1e-7
enum { MOST_SURFACES_OF_A_LEAF = 6, MOST_PARTS = 10000 };
/* Single shapes are one part. */
static brc_status make_leaves(brc_context *context, brc_solid *solid, int n_threads)
{
    const brc_shape *shape = &solid->shape;
    const bool composed = shape->kind == BRC_SHAPE_PARTS;
    const int64_t n = composed ? shape->n_parts : 1;
    if (n < 1 || n > MOST_PARTS)
        return BRC_FAIL(context, BRC_BAD_INPUT, "shape: %lld parts, must be 1 to %d", (long long)n, (int)MOST_PARTS);
    BRC_TRY(BRC_ALLOCATE(context, &solid->parts, n, "parts of the shape"));
    BRC_TRY(BRC_ALLOCATE(context, &solid->leaf, n, "parts of the shape"));
    BRC_TRY(BRC_ALLOCATE(context, &solid->surface, MOST_SURFACES_OF_A_LEAF * n, "surfaces of the shape"));
    BRC_TRY(BRC_ALLOCATE(context, &solid->wall_name, MOST_SURFACES_OF_A_LEAF * n, "walls of the shape"));
    if (composed)
        memcpy(solid->parts, shape->parts, (size_t)n * sizeof *solid->parts);
    else
        solid->parts[0].shape = *shape;
    if (composed) solid->shape.parts = solid->parts;
    if (solid->parts[0].role != BRC_PART_ADD)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "shape: the first part must be added, there is nothing yet to cut from");
    for (int64_t p = 0; p < n; ++p) {
        const brc_shape_part *part = &solid->parts[p];
        if ((int)part->role < BRC_PART_ADD || part->role > BRC_PART_KEEP)
            return BRC_FAIL(context, BRC_BAD_INPUT, "shape: part %lld has the unknown role %d", (long long)p + 1,
                            (int)part->role);
        if (part->shape.kind == BRC_SHAPE_HALF_SPACE && part->role == BRC_PART_ADD)
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "shape: a half-space has no end and can only be removed or kept, as a part");
        BRC_TRY(brc_leaf_create(context, solid, part, n_threads));
    }
    return BRC_OK;
}

/* Does every leaf added from `first` on, but for `self`, lie below the plane? */
static bool added_lie_below(const brc_solid *solid, int32_t first, int32_t self, const double normal[3], double limit)
{
    for (int32_t k = first; k < solid->n_leaves; ++k)
        if (k != self && solid->leaf[k].role == BRC_PART_ADD && brc_leaf_support(&solid->leaf[k], normal) > limit)
            return false;
    return true;
}

/* Find the planes that have the whole solid on one side: there cells are cut by the plane itself. Two walls in one
 * plane are told apart by feet only, so neither counts. */
static void find_hull(brc_solid *solid)
{
    for (int32_t s = 0; s < solid->n_surfaces; ++s) {
        brc_surface *plane = &solid->surface[s];
        if (plane->kind != BRC_SURFACE_PLANE) continue;
        const brc_leaf *leaf = &solid->leaf[plane->leaf];
        const bool cut = leaf->role == BRC_PART_REMOVE;
        if (cut && leaf->n_surfaces != 1) continue;
        double normal[3];
        for (int d = 0; d < 3; ++d)
            normal[d] = cut ? -plane->axis[d] : plane->axis[d];
        const double limit = brc_dot3(normal, plane->point) + 1e-3 * solid->tiny;
        const int32_t first = leaf->role == BRC_PART_ADD ? 0 : plane->leaf;
        if (added_lie_below(solid, first, plane->leaf, normal, limit)) plane->hull = cut ? -1.0 : 1.0;
    }
    for (int32_t s = 0; s < solid->n_surfaces; ++s)
        for (int32_t t = 0; t < s; ++t) {
            brc_surface *a = &solid->surface[s], *b = &solid->surface[t];
            if (a->kind != BRC_SURFACE_PLANE || b->kind != BRC_SURFACE_PLANE || a->wall == b->wall) continue;
            const double gap[3] = {a->point[0] - b->point[0], a->point[1] - b->point[1], a->point[2] - b->point[2]};
            if (fabs(brc_dot3(a->axis, b->axis)) < 1.0 - 1e-14 || fabs(brc_dot3(gap, a->axis)) > solid->tiny) continue;
            a->hull = b->hull = 0.0;
        }
}

static bool find_convex(const brc_solid *solid)
{
    for (int32_t k = 0; k < solid->n_leaves; ++k) {
        const brc_leaf *leaf = &solid->leaf[k];
        if (leaf->role == BRC_PART_ADD && k > 0) return false;
        if (leaf->role == BRC_PART_REMOVE && leaf->shape.kind != BRC_SHAPE_HALF_SPACE) return false;
        if (leaf->shape.kind == BRC_SHAPE_TORUS || (leaf->mesh && !brc_mesh_is_convex(leaf->mesh))) return false;
    }
    return true;
}

static void measure_single(brc_solid *solid)
{
    const brc_shape *s = &solid->shape;
    memcpy(solid->bounds, solid->leaf[0].bounds, sizeof solid->bounds);
    const brc_shape_type *type = brc_shape_type_of(s->kind);
    if (type->measure) type->measure(s, solid->leaf[0].mesh, &solid->volume, &solid->area);
}

brc_status brc_solid_create(brc_context *context, const brc_shape *shape, int n_threads, brc_solid **out)
{
    *out = NULL;
    brc_solid *solid = NULL;
    double diagonal[3];
    brc_status status = BRC_ALLOCATE(context, &solid, 1, "shape");
    if (status != BRC_OK) goto cleanup;
    solid->shape = *shape;
    BRC_TRY_OR(cleanup, make_leaves(context, solid, n_threads));
    for (int d = 0; d < 3; ++d) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int32_t k = 0; k < solid->n_leaves; ++k) {
            if (solid->leaf[k].role != BRC_PART_ADD) continue;
            low = fmin(low, solid->leaf[k].bounds[0][d]);
            high = fmax(high, solid->leaf[k].bounds[1][d]);
        }
        solid->bounds[0][d] = low;
        solid->bounds[1][d] = high;
        diagonal[d] = high - low;
    }
    solid->tiny = TINY_STEP * brc_length3(diagonal);
    find_hull(solid);
    solid->convex = find_convex(solid);
    if (shape->kind == BRC_SHAPE_PARTS)
        BRC_TRY_OR(cleanup, brc_solid_measure(context, solid, n_threads));
    else
        measure_single(solid);
    BRC_TRY_OR(cleanup, brc_solid_find_edges(context, solid));
    *out = solid;
    solid = NULL;
cleanup:
    brc_solid_free(&solid);
    return status;
}

void brc_solid_free(brc_solid **solid)
{
    if (!solid || !*solid) return;
    for (int32_t k = 0; (*solid)->leaf && k < (*solid)->n_leaves; ++k)
        if ((*solid)->leaf[k].mesh) brc_mesh_free(&(*solid)->leaf[k].mesh);
    brc_memory_free((*solid)->parts);
    brc_memory_free((*solid)->leaf);
    brc_memory_free((*solid)->surface);
    brc_memory_free((*solid)->wall_name);
    brc_memory_free((*solid)->edge);
    brc_memory_free(*solid);
    *solid = NULL;
}

const brc_shape *brc_solid_shape(const brc_solid *solid)
{
    return &solid->shape;
}

void brc_solid_bounds(const brc_solid *solid, double bounds[2][3])
{
    memcpy(bounds, solid->bounds, sizeof solid->bounds);
}

double brc_solid_volume(const brc_solid *solid, double *error)
{
    if (error) *error = solid->volume_error;
    return solid->volume;
}

double brc_solid_surface(const brc_solid *solid)
{
    return solid->area;
}

int32_t brc_solid_n_walls(const brc_solid *solid)
{
    return solid->n_walls;
}

const char *brc_solid_wall_name(const brc_solid *solid, int32_t wall)
{
    return solid->wall_name[wall];
}

bool brc_solid_is_convex(const brc_solid *solid)
{
    return solid->convex;
}

int32_t brc_solid_n_hull_planes(const brc_solid *solid)
{
    int32_t n = 0;
    for (int32_t s = 0; s < solid->n_surfaces; ++s)
        n += solid->surface[s].hull != 0.0;
    return n;
}

void brc_solid_hull_plane(const brc_solid *solid, int32_t plane, double normal[3], double *offset, int32_t *wall)
{
    int32_t s = 0;
    while (solid->surface[s].hull == 0.0 || plane-- > 0)
        ++s;
    const brc_surface *surface = &solid->surface[s];
    for (int d = 0; d < 3; ++d)
        normal[d] = surface->hull * surface->axis[d];
    *offset = brc_dot3(normal, surface->point);
    *wall = surface->wall;
}

bool brc_solid_member(const brc_solid *solid, const double x[3])
{
    bool in = false;
    for (int32_t k = 0; k < solid->n_leaves; ++k) {
        const brc_leaf *leaf = &solid->leaf[k];
        if (in == (leaf->role == BRC_PART_ADD)) continue; /* this part cannot change the answer */
        if (leaf->role == BRC_PART_ADD)
            in = brc_leaf_inside(solid, leaf, x);
        else if (leaf->role == BRC_PART_REMOVE)
            in = !brc_leaf_inside(solid, leaf, x);
        else
            in = brc_leaf_inside(solid, leaf, x);
    }
    return in;
}

bool brc_solid_inside(const brc_solid *solid, const double x[3], double margin)
{
    if (!brc_solid_member(solid, x)) return false;
    if (!(margin > 0.0)) return true;
    if (solid->n_leaves == 1 && solid->leaf[0].mesh) return brc_solid_distance(solid, x, margin) >= margin;
    for (int32_t s = 0; s < solid->n_surfaces; ++s) /* mostly no surface is near, and then the boundary is not either */
        if (fabs(brc_surface_height(solid, &solid->surface[s], x, NULL)) < margin)
            return brc_solid_depth(solid, x) >= margin;
    return true;
}
