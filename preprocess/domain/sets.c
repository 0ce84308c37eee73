/* Predicates are tried on every free face or element in order, so members come out ascending and unique. */
#include "sets.h"
#include "set_share.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double norm(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static int32_t find_wall(const brc_domain *domain, const char *name)
{
    for (int32_t w = 0; w < domain->n_walls; ++w)
        if (strcmp(domain->wall_name[w], name) == 0) return w;
    return -1;
}

static bool finite3(const double a[3])
{
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(a[2]);
}

static brc_status check_direction(brc_context *context, const char *what, const char *which, const double direction[3])
{
    if (finite3(direction) && norm(direction) > 0.0) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the %s (%g, %g, %g) must be finite and not zero", what, which,
                    direction[0], direction[1], direction[2]);
}

static brc_status check_point(brc_context *context, const char *what, const char *which, const double point[3])
{
    if (finite3(point)) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the %s (%g, %g, %g) m must be finite", what, which, point[0], point[1],
                    point[2]);
}

static brc_status check_radius(brc_context *context, const char *what, double radius)
{
    if (isfinite(radius) && radius > 0.0) return BRC_OK;
    return BRC_FAIL(context, BRC_BAD_INPUT, "%s: radius %g m must be finite and > 0", what, radius);
}

brc_status brc_predicate_check(brc_context *context, const brc_predicate *where, brc_set_kind kind,
                               const brc_domain *domain, const char *what)
{
    if (kind == BRC_SET_FACES && domain->element_kind == BRC_ELEMENT_SPHERE)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s: spheres have no faces; pick elements instead (`wall` then means those that touch it)",
                        what);
    if (where->has_wall && find_wall(domain, where->wall) < 0) {
        char known[256] = "";
        for (int32_t w = 0; w < domain->n_walls; ++w)
            if (strlen(known) + strlen(domain->wall_name[w]) + 3 < sizeof known) {
                if (w > 0) strcat(known, ", ");
                strcat(known, domain->wall_name[w]);
            }
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: wall '%.32s' is unknown, the walls of this shape are %s", what,
                        where->wall, known);
    }
    if (where->has_box) {
        BRC_TRY(check_point(context, what, "smallest corner of the box", where->box[0]));
        BRC_TRY(check_point(context, what, "largest corner of the box", where->box[1]));
        for (int k = 0; k < 3; ++k)
            if (where->box[0][k] > where->box[1][k])
                return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the box goes from %g m to %g m along %c; swap them", what,
                                where->box[0][k], where->box[1][k], "xyz"[k]);
    }
    if (where->has_sphere) {
        BRC_TRY(check_point(context, what, "centre of the sphere", where->sphere_centre));
        BRC_TRY(check_radius(context, what, where->sphere_radius));
    }
    if (where->has_cylinder) {
        BRC_TRY(check_point(context, what, "point of the cylinder", where->cylinder_point));
        BRC_TRY(check_direction(context, what, "axis of the cylinder", where->cylinder_axis));
        BRC_TRY(check_radius(context, what, where->cylinder_radius));
    }
    if (where->has_half_space) {
        BRC_TRY(check_point(context, what, "point of the half-space", where->half_space_point));
        BRC_TRY(check_direction(context, what, "normal of the half-space", where->half_space_normal));
    }
    if (where->has_normal) {
        if (kind == BRC_SET_ELEMENTS)
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: elements have no normal; use it on faces only", what);
        BRC_TRY(check_direction(context, what, "normal", where->normal));
        if (!(where->normal_angle >= 0.0))
            return BRC_FAIL(context, BRC_BAD_INPUT, "%s: the angle %g rad about the normal must be 0 or more", what,
                            where->normal_angle);
    }
    return BRC_OK;
}

static bool is_member(const brc_set *set, int64_t index)
{
    int64_t low = 0, high = set->n_members;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (set->members[middle] < index)
            low = middle + 1;
        else
            high = middle;
    }
    return low < set->n_members && set->members[low] == index;
}

static bool on_wall(const brc_domain *domain, brc_set_kind kind, int64_t index, const char *name)
{
    const int32_t wall = find_wall(domain, name);
    if (kind == BRC_SET_FACES) return domain->free_wall[index] == wall;
    if (domain->element_kind == BRC_ELEMENT_SPHERE) {
        const int32_t set = brc_domain_find_set(domain, name);
        return set >= 0 && is_member(&domain->sets[set], index);
    }
    for (int64_t f = domain->free_start[index]; f < domain->free_start[index + 1]; ++f)
        if (domain->free_wall[f] == wall) return true;
    return false;
}

bool brc_predicate_holds(const brc_predicate *where, brc_set_kind kind, const brc_domain *domain, int64_t index)
{
    const double *x = (kind == BRC_SET_FACES ? domain->free_centroid : domain->position) + 3 * index;
    const double slack = BRC_SET_SLACK * domain->quality.mean_spacing;
    if (where->has_body && domain->body[kind == BRC_SET_FACES ? domain->free_element[index] : index] != where->body)
        return false;
    if (where->has_wall && !on_wall(domain, kind, index, where->wall)) return false;
    if (where->has_box)
        for (int k = 0; k < 3; ++k)
            if (x[k] < where->box[0][k] - slack || x[k] > where->box[1][k] + slack) return false;
    if (where->has_sphere) {
        const double r[3] = {x[0] - where->sphere_centre[0], x[1] - where->sphere_centre[1],
                             x[2] - where->sphere_centre[2]};
        if (norm(r) > where->sphere_radius + slack) return false;
    }
    if (where->has_cylinder) {
        const double *a = where->cylinder_axis, *p = where->cylinder_point;
        const double r[3] = {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
        const double away[3] = {a[1] * r[2] - a[2] * r[1], a[2] * r[0] - a[0] * r[2], a[0] * r[1] - a[1] * r[0]};
        if (norm(away) / norm(a) > where->cylinder_radius + slack) return false;
    }
    if (where->has_half_space) {
        const double *n = where->half_space_normal, *p = where->half_space_point;
        const double height = n[0] * (x[0] - p[0]) + n[1] * (x[1] - p[1]) + n[2] * (x[2] - p[2]);
        if (height / norm(n) < -slack) return false;
    }
    if (where->has_normal) {
        const double *n = where->normal, *s = domain->free_area_vector + 3 * index;
        const double c[3] = {s[1] * n[2] - s[2] * n[1], s[2] * n[0] - s[0] * n[2], s[0] * n[1] - s[1] * n[0]};
        /* atan2 keeps its digits at small angles, where acos has none */
        if (atan2(norm(c), s[0] * n[0] + s[1] * n[1] + s[2] * n[2]) > where->normal_angle + 1e-9) return false;
    }
    return true;
}

brc_status brc_sets_append(brc_context *context, brc_domain *domain, const char *name, brc_set_kind kind,
                           int64_t n_members, brc_set **out)
{
    if (name[0] == '\0') return BRC_FAIL(context, BRC_BAD_INPUT, "a set has an empty name; name it");
    if (brc_domain_find_set(domain, name) >= 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "set '%s': the name is already taken (walls have a set each); rename it", name);
    brc_set *set = &domain->sets[domain->n_sets];
    BRC_TRY(BRC_ALLOCATE(context, &set->name, (int64_t)strlen(name) + 1, "set name"));
    strcpy(set->name, name);
    set->kind = kind;
    domain->n_sets++; /* from here on brc_domain_free knows it */
    BRC_TRY(BRC_ALLOCATE(context, &set->members, n_members, "set members"));
    set->n_members = n_members;
    *out = set;
    return BRC_OK;
}

brc_status brc_sets_add_empty(brc_context *context, brc_domain *domain, const char *name, brc_set_kind kind)
{
    brc_set *set;
    BRC_TRY(
        brc_memory_resize(context, (void **)&domain->sets, (int64_t)domain->n_sets + 1, sizeof *domain->sets, "sets"));
    return brc_sets_append(context, domain, name, kind, 0, &set);
}

static brc_status refuse_empty(brc_context *context, const brc_set_request *request, const brc_domain *domain,
                               const char *what, int64_t n)
{
    const double spacing = domain->quality.mean_spacing;
    const bool cuts = request->kind == BRC_SET_FACES && brc_predicate_cuts(&request->where);
    double x[2][3], area[3], centroid[3];
    int64_t n_cut = 0;
    for (int64_t f = 0; cuts && f < n; ++f)
        n_cut += brc_predicate_share(&request->where, domain, f, area, centroid) > 0;
    if (n_cut > 0)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%s is empty: it reaches into %lld of the %lld free faces, and the middle of none of them is "
                        "inside, as a set asks for; widen the region, or fill the body with cells "
                        "smaller than %g m",
                        what, (long long)n_cut, (long long)n, spacing);
    for (int k = 0; k < 6; ++k)
        x[k / 3][k % 3] = fabs(domain->bounds[k / 3][k % 3]) > BRC_SET_SLACK * spacing
                              ? domain->bounds[k / 3][k % 3]
                              : 0; /* no rounding of a wall at 0 */
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "%s is empty: none of the %lld %s fits; the body reaches from (%g, %g, %g) to (%g, %g, %g) m "
                    "with elements of about %g m; widen the region",
                    what, (long long)n, request->kind == BRC_SET_FACES ? "free faces" : "elements", x[0][0], x[0][1],
                    x[0][2], x[1][0], x[1][1], x[1][2], spacing);
}

static brc_status build_one(brc_context *context, const brc_set_request *request, brc_domain *domain)
{
    char name[sizeof request->name + 1] = "", what[96];
    memcpy(name, request->name, sizeof request->name);
    snprintf(what, sizeof what, "set '%s'", name);
    if (request->kind != BRC_SET_FACES && request->kind != BRC_SET_ELEMENTS)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%s: kind %d is unknown", what, (int)request->kind);
    BRC_TRY(brc_predicate_check(context, &request->where, request->kind, domain, what));
    const int64_t n = request->kind == BRC_SET_FACES ? domain->n_free_faces : domain->n_elements;
    int64_t count = 0;
    for (int64_t k = 0; k < n; ++k)
        count += brc_predicate_holds(&request->where, request->kind, domain, k);
    if (count == 0) return refuse_empty(context, request, domain, what, n);
    brc_set *set;
    BRC_TRY(brc_sets_append(context, domain, name, request->kind, count, &set));
    count = 0;
    for (int64_t k = 0; k < n; ++k)
        if (brc_predicate_holds(&request->where, request->kind, domain, k)) set->members[count++] = (int32_t)k;
    return BRC_OK;
}

/* The free faces of wall w. */
static brc_status build_wall(brc_context *context, int32_t w, brc_domain *domain)
{
    int64_t count = 0;
    for (int64_t f = 0; f < domain->n_free_faces; ++f)
        count += domain->free_wall[f] == w;
    brc_set *set;
    BRC_TRY(brc_sets_append(context, domain, domain->wall_name[w], BRC_SET_FACES, count, &set));
    count = 0;
    for (int64_t f = 0; f < domain->n_free_faces; ++f)
        if (domain->free_wall[f] == w) set->members[count++] = (int32_t)f;
    return BRC_OK;
}

/* Hand the set of this name over to the domain, which has room and no set of that name. */
static void keep(brc_set *old, int32_t n_old, const char *name, brc_domain *domain)
{
    for (int32_t s = 0; s < n_old; ++s)
        if (old[s].name && strcmp(old[s].name, name) == 0) {
            domain->sets[domain->n_sets++] = old[s];
            old[s].name = NULL;
            old[s].members = NULL;
        }
}

/* Which spheres touch a wall was seen when they were packed: those sets are kept. */
static void keep_walls(brc_set *old, int32_t n_old, brc_domain *domain)
{
    char layer[BRC_LAYER_NAME];
    for (int32_t w = 0; w < domain->n_walls; ++w)
        keep(old, n_old, domain->wall_name[w], domain);
    for (int32_t w = 0; w < domain->n_walls; ++w) {
        brc_sets_layer_name(domain->wall_name[w], layer);
        keep(old, n_old, layer, domain);
    }
}

void brc_sets_layer_name(const char *wall, char out[BRC_LAYER_NAME])
{
    snprintf(out, BRC_LAYER_NAME, "%.57s_layer", wall);
}

brc_status brc_sets_build(brc_context *context, int32_t n, const brc_set_request *requests, brc_domain *domain)
{
    brc_set *fresh, *old = domain->sets;
    const int32_t n_old = domain->n_sets;
    BRC_TRY(BRC_ALLOCATE(context, &fresh, (int64_t)domain->n_walls + n + n_old, "sets"));
    domain->sets = fresh;
    domain->n_sets = 0;
    brc_status status = BRC_OK;
    if (domain->element_kind == BRC_ELEMENT_SPHERE)
        keep_walls(old, n_old, domain);
    else
        for (int32_t w = 0; w < domain->n_walls; ++w)
            BRC_TRY_OR(cleanup, build_wall(context, w, domain));
    for (int32_t s = 0; s < n; ++s) { /* all wrong sets in one pass */
        brc_context_set_place(context, requests[s].place);
        const brc_status one = build_one(context, &requests[s], domain);
        brc_context_set_place(context, NULL);
        if (one != BRC_OK) status = one;
    }
    if (status != BRC_OK) goto cleanup;
    for (int32_t s = 0; s < n_old; ++s)
        if (old[s].name && brc_domain_find_set(domain, old[s].name) < 0) keep(old, n_old, old[s].name, domain);
cleanup:
    for (int32_t s = 0; s < n_old; ++s) {
        brc_memory_free(old[s].name);
        brc_memory_free(old[s].members);
    }
    brc_memory_free(old);
    return status;
}
