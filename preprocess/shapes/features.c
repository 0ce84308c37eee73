/* Whether the solid ends at a surface is seen from points drawn in the part's box and moved to the surface. */
#include "features.h"

#include "../../host/base/log.h"
#include "../../host/base/random.h"
#include "shape_type.h"
#include "solid_internal.h"

#include <math.h>
#include <stdio.h>

enum { SAMPLES = 2048, MOST_WARNINGS = 8, NAME_ROOM = 64 };

/* The least width of a part [m]; HUGE_VAL: it has none. */
static double width_of(const brc_leaf *leaf)
{
    const brc_shape_type *type = brc_shape_type_of(leaf->shape.kind);
    return type->width ? type->width(&leaf->shape, leaf->mesh) : HUGE_VAL;
}

/* The box around the points drawn of a surface at which the solid ends; grows. */
typedef struct extent {
    double low[3], high[3];
    bool any;
} extent;

static double size_of(const extent *e)
{
    const double diagonal[3] = {e->high[0] - e->low[0], e->high[1] - e->low[1], e->high[2] - e->low[2]};
    return brc_length3(diagonal);
}

static void sample(const brc_solid *solid, int32_t s, extent *e)
{
    const brc_surface *surface = &solid->surface[s];
    const brc_leaf *leaf = &solid->leaf[surface->leaf];
    double low[3], high[3];
    for (int d = 0; d < 3; ++d) {
        low[d] = fmax(leaf->bounds[0][d], solid->bounds[0][d]); /* a half-space has no end */
        high[d] = fmin(leaf->bounds[1][d], solid->bounds[1][d]);
    }
    for (int k = 0; k < SAMPLES; ++k) {
        double u[4], x[3], normal[3], side[2][3];
        brc_random_uniform4(0, BRC_RANDOM_FEATURE, (uint64_t)s, (uint64_t)k, u);
        for (int d = 0; d < 3; ++d)
            x[d] = low[d] + u[d] * (high[d] - low[d]);
        const double height = brc_surface_height(solid, surface, x, normal);
        for (int d = 0; d < 3; ++d) {
            x[d] -= height * normal[d];
            side[0][d] = x[d] - solid->tiny * normal[d];
            side[1][d] = x[d] + solid->tiny * normal[d];
        }
        if (brc_solid_member(solid, side[0]) == brc_solid_member(solid, side[1])) continue;
        if (leaf->n_surfaces > 1 && !brc_leaf_inside(solid, leaf, side[0])) continue; /* beyond the part's own ends */
        for (int d = 0; d < 3; ++d) {
            e->low[d] = e->any ? fmin(e->low[d], x[d]) : x[d];
            e->high[d] = e->any ? fmax(e->high[d], x[d]) : x[d];
        }
        e->any = true;
    }
}

static int warn_of_part(brc_context *context, const brc_solid *solid, int32_t k, double spacing, bool spheres)
{
    const brc_leaf *leaf = &solid->leaf[k];
    const double width = width_of(leaf);
    extent e = {.any = false};
    char name[NAME_ROOM] = "";
    if (leaf->role == BRC_PART_KEEP || !(width < spacing)) return 0;
    for (int32_t s = leaf->first; s < leaf->first + leaf->n_surfaces && !e.any; ++s)
        sample(solid, s, &e);
    if (!e.any) return 0;
    if (solid->parts[k].name[0]) snprintf(name, sizeof name, " ('%s')", solid->parts[k].name);
    brc_log(context, BRC_LOG_WARNING,
            "shape: part %d%s is %.3g m thick, less than one of the %s of %.3g m: it vanishes or is met badly; ask for "
            "more elements (half its thickness wide are %.2g of them), or "
            "leave the part out",
            k + 1, name, width, spheres ? "spheres" : "cells", spacing,
            brc_solid_volume(solid, NULL) / pow(0.5 * width, 3.0));
    return 1;
}

void brc_features_warn(brc_context *context, const brc_solid *solid, double spacing, const brc_domain *domain)
{
    const bool spheres = domain->element_kind == BRC_ELEMENT_SPHERE;
    int n = 0;
    for (int32_t k = 0; k < solid->n_leaves && solid->n_leaves > 1 && n < MOST_WARNINGS; ++k)
        n += warn_of_part(context, solid, k, spacing, spheres);
    if (spheres) return;
    for (int32_t w = 0; w < solid->n_walls && n < MOST_WARNINGS; ++w) {
        extent e = {.any = false};
        bool met = false, thin = false;
        for (int64_t f = 0; f < domain->n_free_faces && !met; ++f)
            met = domain->free_wall[f] == w;
        for (int32_t s = 0; s < solid->n_surfaces && !met && !thin; ++s) {
            if (solid->surface[s].wall != w) continue;
            thin = solid->n_leaves > 1 && width_of(&solid->leaf[solid->surface[s].leaf]) < spacing; /* told already */
            sample(solid, s, &e);
        }
        if (met || thin || !e.any) continue;
        brc_log(context, BRC_LOG_WARNING,
                "shape: no cell has a face on the wall '%s', which is %.3g m across: cells of %.3g m are too coarse "
                "for it; ask for more elements",
                solid->wall_name[w], size_of(&e), spacing);
        ++n;
    }
}
