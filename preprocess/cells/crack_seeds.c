/* A face of a Voronoi cell lies half way between two seeds. Where every seed near a plane has its mirror image behind
 * it, the faces between them lie in the plane, and no other face does. Along the sides of a rectangle seeds are
 * mirrored across these as well, so that faces end there: the cut reaches as far as the rectangle, not half a cell
 * further or less. */
#include "../domain/cracks.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "../domain/crack_patch.h"
#include "../point_grid.h"

#include <math.h>

/* Layers of a regular grid lie at whole and half spacings: both sides must agree whether one is in the zone, whatever
 * the rounding. */
#define ZONE_SLACK 1e-6
/* How far from the plane seeds are mirrored [spacings]: every seed that is nearest to some point of the plane must be.
 * In a noisy grid parallel to the plane, wherever the plane lies, one side has a seed within sqrt(6) = 2.45 spacings of
 * it (a packing has one nearer); images dropped for LEAST_GAP lie in the topmost half spacing of the zone. */
#define REACH (3.0 + ZONE_SLACK)
/* How far inside the rim, and how near to the plane, seeds are mirrored across the rim [spacings]: those that are
 * nearest to some point of it. */
#define RIM (1.5 + ZONE_SLACK)
#define RIM_HEIGHT (2.0 + ZONE_SLACK)
/* Solid goes on beyond the rim where there is a seed this near to an image [spacings]. */
#define SOLID 2.0
/* How far beyond a round rim seeds are mirrored across the plane [spacings]: more would lay a plane of faces ahead of
 * the crack and lead it there. Beyond straight sides as far as there are images across them. */
#define BEYOND (0.5 + ZONE_SLACK)
/* Seeds keep this distance to the plane and to the rim [spacings], and so twice that to their images. */
#define LEAST_HEIGHT 0.25
/* An image nearer than this to a seed that stays is not made [spacings]. */
#define LEAST_GAP 0.5

#define ACROSS_PLANE (-1)

typedef enum role { STAY, SOURCE, DROP } role;

/* One crack's work. */
typedef struct mirror {
    brc_crack_patch patch;
    double spacing;          /* [m] */
    int rim;                 /* side of a rectangle across which images are made; ACROSS_PLANE: across the plane */
    double side;             /* 1: images are made of the seeds above the plane, -1: below */
    int8_t *role;            /* [n] of enum role */
    brc_point_grid *others;  /* seeds that stay, near the zone */
    brc_point_grid *sources; /* seeds to be mirrored, in their final places */
    brc_point_grid *beyond;  /* seeds beyond the rim that make room for images */
} mirror;

static bool across_rim(const mirror *m)
{
    return m->rim != ACROSS_PLANE;
}

static double beyond_of(const mirror *m)
{
    return m->patch.kind == BRC_CRACK_DISC ? BEYOND : RIM;
}

static bool in_zone(const mirror *m, const double x[3], double *height)
{
    *height = brc_crack_patch_height(&m->patch, x);
    return fabs(*height) <= REACH * m->spacing && brc_crack_patch_covers(&m->patch, x, beyond_of(m) * m->spacing);
}

static void image_of(const mirror *m, const double x[3], double image[3])
{
    double outward[3];
    const double way =
        across_rim(m) ? brc_crack_patch_depth(&m->patch, m->rim, x, outward) : -brc_crack_patch_height(&m->patch, x);
    for (int k = 0; k < 3; ++k)
        image[k] = x[k] + 2.0 * way * (across_rim(m) ? outward[k] : m->patch.normal[k]);
}

/* How far inside the rim a seed lies [m] that is near to it; -HUGE_VAL of all others. */
static double rim_depth(const mirror *m, const double x[3], double outward[3])
{
    const double depth = brc_crack_patch_depth(&m->patch, m->rim, x, outward);
    if (fabs(brc_crack_patch_height(&m->patch, x)) > RIM_HEIGHT * m->spacing) return -HUGE_VAL;
    return fabs(depth) <= RIM * m->spacing ? depth : -HUGE_VAL;
}

/* Roles at the rim: what lies beyond it makes room for images of what lies inside. A rim beyond which there is no solid
 * stays as it is. */
static void assign_rim_roles(mirror *m, const double *position, int64_t n)
{
    double outward[3];
    for (int64_t e = 0; e < n; ++e) {
        const double depth = rim_depth(m, position + 3 * e, outward);
        m->role[e] = depth == -HUGE_VAL ? STAY : depth >= -ZONE_SLACK * m->spacing ? SOURCE : DROP;
        if (m->role[e] == DROP) brc_point_grid_add(m->beyond, position + 3 * e);
    }
    for (int64_t e = 0; e < n; ++e) {
        double image[3];
        if (m->role[e] == SOURCE) {
            image_of(m, position + 3 * e, image);
            if (!brc_point_grid_crowded(m->beyond, image, SOLID * m->spacing)) m->role[e] = STAY;
        }
        if (m->role[e] == STAY) brc_point_grid_add(m->others, position + 3 * e);
        if (m->role[e] == SOURCE && rim_depth(m, position + 3 * e, outward) >= LEAST_HEIGHT * m->spacing)
            brc_point_grid_add(m->sources, position + 3 * e);
    }
}

/* The side with more seeds: where the body is thin on one side, the thick one still has a seed for every place
 * beyond. */
static void choose_side(mirror *m, const double *position, int64_t n)
{
    int64_t above = 0, below = 0;
    for (int64_t e = 0; e < n; ++e) {
        double height;
        if (!in_zone(m, position + 3 * e, &height)) continue;
        if (height > 0.0)
            ++above;
        else
            ++below;
    }
    m->side = above > below ? 1.0 : -1.0;
}

static void assign_roles(mirror *m, const double *position, int64_t n)
{
    for (int64_t e = 0; e < n; ++e) {
        const double *x = position + 3 * e;
        double height;
        m->role[e] = STAY;
        if (in_zone(m, x, &height)) {
            const bool source = m->side > 0.0 ? height > 0.0 : height <= 0.0;
            m->role[e] = source ? SOURCE : DROP;
            if (source && fabs(height) >= LEAST_HEIGHT * m->spacing) brc_point_grid_add(m->sources, x);
        } else if (fabs(height) <= (REACH + LEAST_GAP) * m->spacing &&
                   brc_crack_patch_covers(&m->patch, x, (beyond_of(m) + LEAST_GAP) * m->spacing)) {
            brc_point_grid_add(m->others, x);
        }
    }
}

/* Push sources that are too near to the mirror away from it; one that would come to lie on another seed is dropped. */
static void push_sources(mirror *m, double *position, int64_t n)
{
    const double least = LEAST_HEIGHT * m->spacing;
    for (int64_t e = 0; e < n; ++e) {
        if (m->role[e] != SOURCE) continue;
        double *x = position + 3 * e, outward[3];
        const double height = brc_crack_patch_height(&m->patch, x);
        const double depth = across_rim(m) ? brc_crack_patch_depth(&m->patch, m->rim, x, outward) : m->side * height;
        if (depth >= least) continue;
        for (int k = 0; k < 3; ++k)
            x[k] += (least - depth) * (across_rim(m) ? -outward[k] : m->side * m->patch.normal[k]);
        if (brc_point_grid_crowded(m->sources, x, least) || brc_point_grid_crowded(m->others, x, least))
            m->role[e] = DROP;
        else
            brc_point_grid_add(m->sources, x);
    }
}

/* Append the images of all sources, then close the gaps of the dropped seeds. */
static brc_status make_images(brc_context *context, const mirror *m, double *position, int64_t *n, int64_t room)
{
    const int64_t n_before = *n;
    int64_t kept = 0, images = 0;
    for (int64_t e = 0; e < n_before; ++e) {
        double image[3];
        if (m->role[e] != SOURCE) continue;
        image_of(m, position + 3 * e, image);
        images += !brc_point_grid_crowded(m->others, image, LEAST_GAP * m->spacing);
    }
    for (int64_t e = 0; e < n_before; ++e)
        kept += m->role[e] != DROP;
    if (kept + images > room)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "flat cracks: mirrored seeds need room for %lld elements, there is room for %lld: cracks are "
                        "too near to each other or to "
                        "walls for cells of %.3g m; use smaller cells, or cracks that are not flat",
                        (long long)(kept + images), (long long)room, m->spacing);
    double *fresh = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &fresh, 3 * images, "mirrored seeds"));
    images = kept = 0;
    for (int64_t e = 0; e < n_before; ++e) {
        if (m->role[e] == SOURCE) {
            double image[3];
            image_of(m, position + 3 * e, image);
            if (!brc_point_grid_crowded(m->others, image, LEAST_GAP * m->spacing)) {
                for (int k = 0; k < 3; ++k)
                    fresh[3 * images + k] = image[k];
                ++images;
            }
        }
        if (m->role[e] == DROP) continue;
        for (int k = 0; k < 3; ++k)
            position[3 * kept + k] = position[3 * e + k];
        ++kept;
    }
    for (int64_t k = 0; k < 3 * images; ++k)
        position[3 * kept + k] = fresh[k];
    *n = kept + images;
    brc_memory_free(fresh);
    return BRC_OK;
}

static brc_status mirror_once(brc_context *context, const brc_crack *crack, int rim, double spacing, double *position,
                              int64_t *n, int64_t room)
{
    mirror m = {.spacing = spacing, .rim = rim};
    brc_crack_patch_make(crack, &m.patch);
    double bounds[2][3];
    for (int k = 0; k < 3; ++k) {
        bounds[0][k] = HUGE_VAL;
        bounds[1][k] = -HUGE_VAL;
    }
    for (int64_t e = 0; e < *n; ++e)
        for (int k = 0; k < 3; ++k) {
            bounds[0][k] = fmin(bounds[0][k], position[3 * e + k]);
            bounds[1][k] = fmax(bounds[1][k], position[3 * e + k]);
        }
    brc_status status = BRC_ALLOCATE(context, &m.role, *n, "roles of seeds at a crack");
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, brc_point_grid_create(context, bounds, spacing, *n, &m.others));
    BRC_TRY_OR(cleanup, brc_point_grid_create(context, bounds, spacing, *n, &m.sources));
    BRC_TRY_OR(cleanup, brc_point_grid_create(context, bounds, spacing, *n, &m.beyond));
    if (across_rim(&m)) {
        assign_rim_roles(&m, position, *n);
    } else {
        choose_side(&m, position, *n);
        assign_roles(&m, position, *n);
    }
    push_sources(&m, position, *n);
    status = make_images(context, &m, position, n, room);
cleanup:
    brc_memory_free(m.role);
    brc_point_grid_free(&m.others);
    brc_point_grid_free(&m.sources);
    brc_point_grid_free(&m.beyond);
    return status;
}

/* Does a seed lie in the zones of both cracks? */
static bool zones_meet(const brc_crack *a, const brc_crack *b, double spacing, const double *position, int64_t n)
{
    mirror first = {.spacing = spacing}, second = {.spacing = spacing};
    double height;
    brc_crack_patch_make(a, &first.patch);
    brc_crack_patch_make(b, &second.patch);
    for (int64_t e = 0; e < n; ++e)
        if (in_zone(&first, position + 3 * e, &height) && in_zone(&second, position + 3 * e, &height)) return true;
    return false;
}

/* The later crack moves what the earlier one has mirrored. */
static void warn_of_neighbours(brc_context *context, int32_t c, const brc_crack *cracks, double spacing,
                               const double *position, int64_t n)
{
    for (int32_t k = 0; k < c; ++k)
        if (cracks[k].flat && zones_meet(&cracks[k], &cracks[c], spacing, position, n))
            brc_log(context, BRC_LOG_WARNING,
                    "cracks '%s' and '%s' come nearer to each other than six cells (%.3g m): there only the faces of "
                    "'%s' lie in its plane; use smaller cells, "
                    "or flat: false for one of them",
                    cracks[k].name, cracks[c].name, 6.0 * spacing, cracks[c].name);
}

brc_status brc_cracks_mirror_seeds(brc_context *context, int32_t n_cracks, const brc_crack *cracks, double spacing,
                                   double *position, int64_t *n, int64_t room)
{
    BRC_TRY(brc_cracks_check(context, n_cracks, cracks));
    for (int32_t c = 0; c<n_cracks && * n> 0; ++c)
        if (cracks[c].flat) {
            warn_of_neighbours(context, c, cracks, spacing, position, *n);
            for (int side = 0; cracks[c].kind == BRC_CRACK_RECTANGLE && side < 4; ++side)
                BRC_TRY(mirror_once(context, &cracks[c], side, spacing, position, n, room));
            BRC_TRY(mirror_once(context, &cracks[c], ACROSS_PLANE, spacing, position, n, room));
        }
    return BRC_OK;
}
