/* Which bonds a crack crosses. Their faces are opened in crack_faces.c, seeds are mirrored in crack_seeds.c. */
#include "cracks.h"

#include "../../host/base/log.h"
#include "../../host/base/memory.h"
#include "crack_faces.h"
#include "crack_patch.h"

#include <math.h>
#include <string.h>

/* Of the mean spacing: a branch through the rim is cut, an element in the plane is above it, whatever the rounding. */
#define SLACK 1e-9
/* Edges of a rectangle that point the same way to this sine span nothing. */
#define LEAST_SINE 1e-9

static double norm(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static bool finite3(const double a[3])
{
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

static brc_status check_disc(brc_context *context, const brc_crack *c)
{
    if (!(isfinite(c->radius) && c->radius > 0.0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "crack '%s': radius is %g m, must be finite and > 0", c->name,
                        c->radius);
    if (!finite3(c->normal) || !(norm(c->normal) > 0.0))
        return BRC_FAIL(context, BRC_BAD_INPUT, "crack '%s': the normal (%g, %g, %g) must be finite and not zero",
                        c->name, c->normal[0], c->normal[1], c->normal[2]);
    return BRC_OK;
}

static brc_status check_rectangle(brc_context *context, const brc_crack *c)
{
    const double *a = c->edge[0], *b = c->edge[1];
    const double area[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    if (finite3(a) && finite3(b) && finite3(area) && norm(area) > LEAST_SINE * norm(a) * norm(b)) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "crack '%s': the edges (%g, %g, %g) m and (%g, %g, %g) m span no area, must be finite, not zero "
                    "and not parallel",
                    c->name, a[0], a[1], a[2], b[0], b[1], b[2]);
}

brc_status brc_cracks_check(brc_context *context, int32_t n, const brc_crack *cracks)
{
    brc_status status = BRC_OK;
    for (int32_t k = 0; k < n; ++k) {
        const brc_crack *c = &cracks[k];
        brc_status one = BRC_OK;
        if (c->name[0] == '\0' || !memchr(c->name, '\0', sizeof c->name)) {
            status = BRC_FAIL(context, BRC_BAD_INPUT, "crack %d has %s; give it one of at most %zu letters", k + 1,
                              c->name[0] == '\0' ? "no name" : "too long a name", sizeof c->name - 1);
            continue;
        }
        for (int32_t l = 0; l < k; ++l)
            if (strncmp(cracks[l].name, c->name, sizeof c->name) == 0)
                one = BRC_FAIL(context, BRC_BAD_INPUT, "crack '%s': another crack has this name; rename one", c->name);
        if (!finite3(c->point))
            one = BRC_FAIL(context, BRC_BAD_INPUT, "crack '%s': the point (%g, %g, %g) m must be finite", c->name,
                           c->point[0], c->point[1], c->point[2]);
        if (c->kind != BRC_CRACK_DISC && c->kind != BRC_CRACK_RECTANGLE)
            one = BRC_FAIL(context, BRC_BAD_INPUT, "crack '%s': kind %d is unknown, must be a disc or a rectangle",
                           c->name, (int)c->kind);
        else if (one == BRC_OK)
            one = c->kind == BRC_CRACK_DISC ? check_disc(context, c) : check_rectangle(context, c);
        if (one != BRC_OK) status = one;
    }
    return status;
}

/* Does the segment from x to y cross the patch? */
static bool crosses(const brc_crack_patch *patch, const double x[3], const double y[3], double slack)
{
    const double a = brc_crack_patch_height(patch, x), b = brc_crack_patch_height(patch, y);
    if ((a >= -slack) == (b >= -slack)) return false;
    const double t = fmax(0.0, fmin(1.0, a / (a - b)));
    const double p[3] = {x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1]), x[2] + t * (y[2] - x[2])};
    return brc_crack_patch_covers(patch, p, slack);
}

static double mean_spacing(const brc_domain *d)
{
    double volume = 0.0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        volume += d->volume[e];
    return cbrt(volume / (double)d->n_elements);
}

/* Give every bond that the crack crosses and no earlier one did the wall. Both counts are of this crack. */
static void mark_bonds(const brc_crack_patch *patch, const brc_domain *d, double slack, int32_t crack_wall,
                       int32_t *wall, int64_t *n_crossed, int64_t *n_marked)
{
    *n_crossed = *n_marked = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
            const int64_t j = d->neighbour[h];
            if (j < e || !crosses(patch, d->position + 3 * e, d->position + 3 * j, slack)) continue;
            ++*n_crossed;
            if (wall[d->bond[h]] >= 0) continue;
            wall[d->bond[h]] = crack_wall;
            ++*n_marked;
        }
}

static brc_status fail_uncut(brc_context *context, const brc_crack *crack, const brc_crack_patch *patch,
                             const brc_domain *d, double spacing, int64_t n_crossed)
{
    if (n_crossed > 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "crack '%s': earlier cracks cut all %lld bonds it crosses; remove or move it", crack->name,
                        (long long)n_crossed);
    double least = HUGE_VAL;
    for (int64_t e = 0; e < d->n_elements; ++e)
        least = fmin(least, brc_crack_patch_distance(patch, d->position + 3 * e));
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "crack '%s' cuts no bond: the nearest element is %.3g m away from it, elements are about %.3g m "
                    "wide; move it, make it "
                    "larger or use smaller elements",
                    crack->name, least, spacing);
}

static brc_status name_walls(brc_context *context, int32_t n, const brc_crack *cracks, brc_domain *d)
{
    if (d->element_kind == BRC_ELEMENT_SPHERE) return BRC_OK;
    BRC_TRY(brc_memory_resize(context, (void **)&d->wall_name, (int64_t)d->n_walls + n, sizeof *d->wall_name,
                              "wall names"));
    for (int32_t k = 0; k < n; ++k)
        BRC_TRY(brc_domain_add_wall(context, d, cracks[k].name));
    return BRC_OK;
}

static brc_status check_against(brc_context *context, int32_t n, const brc_crack *cracks, const brc_domain *d)
{
    if (d->element_kind == BRC_ELEMENT_CELL && d->n_sets > 0)
        return BRC_FAIL(context, BRC_INTERNAL,
                        "cracks are cut after sets of faces were built; their indices would be wrong");
    brc_status status = BRC_OK;
    for (int32_t k = 0; k < n; ++k)
        for (int32_t w = 0; w < d->n_walls; ++w)
            if (strcmp(d->wall_name[w], cracks[k].name) == 0)
                status = BRC_FAIL(context, BRC_BAD_INPUT,
                                  "crack '%s': the shape has a wall of this name; rename the crack", cracks[k].name);
    return status;
}

static int64_t count_alone(const brc_domain *d)
{
    int64_t n = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        n += d->row_start[e] == d->row_start[e + 1];
    return n;
}

brc_status brc_cracks_cut(brc_context *context, int32_t n, const brc_crack *cracks, brc_domain *domain, int64_t *n_cut)
{
    *n_cut = 0;
    BRC_TRY(brc_cracks_check(context, n, cracks));
    if (n == 0) return BRC_OK;
    BRC_TRY(check_against(context, n, cracks, domain));
    const double spacing = mean_spacing(domain);
    const int64_t n_before = domain->n_bonds, alone_before = count_alone(domain);
    int32_t *wall = NULL;
    BRC_TRY(BRC_ALLOCATE(context, &wall, domain->n_bonds, "walls of cut bonds"));
    memset(wall, -1, (size_t)domain->n_bonds * sizeof *wall);
    brc_status status = BRC_OK;
    for (int32_t k = 0; k < n; ++k) {
        brc_crack_patch patch;
        int64_t n_crossed, n_marked;
        brc_crack_patch_make(&cracks[k], &patch);
        mark_bonds(&patch, domain, SLACK * spacing, domain->n_walls + k, wall, &n_crossed, &n_marked);
        if (n_marked == 0) status = fail_uncut(context, &cracks[k], &patch, domain, spacing, n_crossed);
    }
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, brc_crack_faces_open(context, wall, domain));
    BRC_TRY_OR(cleanup, name_walls(context, n, cracks, domain));
    *n_cut = n_before - domain->n_bonds;
    const int64_t alone = count_alone(domain) - alone_before;
    if (alone > 0)
        brc_log(context, BRC_LOG_WARNING, "cracks leave %lld elements without any bond: they are cut off on all sides",
                (long long)alone);
cleanup:
    brc_memory_free(wall);
    return status;
}
