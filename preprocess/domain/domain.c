/* Life and health of a domain: freeing it, finding a set, and checking every property its header promises. */
#include "domain.h"

#include "../../host/base/memory.h"

#include <math.h>
#include <string.h>

/* Names and members: what wall_name and sets point to. */
static brc_status each_inner_block(brc_domain *d, brc_domain_visit visit, void *self)
{
    for (int32_t w = 0; d->wall_name && w < d->n_walls; ++w)
        BRC_TRY(visit(self, (void **)&d->wall_name[w]));
    for (int32_t s = 0; d->sets && s < d->n_sets; ++s) {
        BRC_TRY(visit(self, (void **)&d->sets[s].name));
        BRC_TRY(visit(self, (void **)&d->sets[s].members));
    }
    return BRC_OK;
}

brc_status brc_domain_each_block(brc_domain *d, bool down, brc_domain_visit visit, void *self)
{
    void **const block[] = {(void **)&d->position,
                            (void **)&d->volume,
                            (void **)&d->centroid,
                            (void **)&d->inertia,
                            (void **)&d->region,
                            (void **)&d->body,
                            (void **)&d->grain,
                            (void **)&d->radius,
                            (void **)&d->row_start,
                            (void **)&d->neighbour,
                            (void **)&d->twin,
                            (void **)&d->bond,
                            (void **)&d->area_vector,
                            (void **)&d->face_centroid,
                            (void **)&d->bond_half_edge,
                            (void **)&d->free_start,
                            (void **)&d->free_element,
                            (void **)&d->free_area_vector,
                            (void **)&d->free_centroid,
                            (void **)&d->free_wall,
                            (void **)&d->vertex_start,
                            (void **)&d->vertex,
                            (void **)&d->free_polygon_start,
                            (void **)&d->free_polygon,
                            (void **)&d->here,
                            (void **)&d->home,
                            (void **)&d->free_corner,
                            (void **)&d->provenance,
                            (void **)&d->pages.path,
                            (void **)&d->pages.range,
                            (void **)&d->wall_name,
                            (void **)&d->sets};
    if (!down) BRC_TRY(each_inner_block(d, visit, self));
    for (size_t k = 0; k < sizeof block / sizeof *block; ++k)
        BRC_TRY(visit(self, block[k]));
    return down ? each_inner_block(d, visit, self) : BRC_OK;
}

static brc_status free_block(void *self, void **block)
{
    (void)self;
    brc_memory_free(*block);
    return BRC_OK;
}

void brc_domain_free(brc_domain **domain)
{
    if (!domain || !*domain) return;
    (void)brc_domain_each_block(*domain, false, free_block, NULL);
    brc_machine_memory_free(&(*domain)->elsewhere);
    brc_memory_free(*domain);
    *domain = NULL;
}

typedef struct taking {
    brc_context *context;
    const brc_domain *domain;
} taking;

static brc_status take_block(void *self, void **block)
{
    const taking *t = self;
    const int64_t k = brc_file_pages_find(&t->domain->pages, &t->domain->elsewhere, *block);
    void *own = NULL;
    if (k < 0) return BRC_OK;
    const int64_t bytes = t->domain->pages.range[k].bytes;
    BRC_TRY(brc_memory_allocate(t->context, &own, bytes, 1, "domain of a file"));
    memcpy(own, *block, (size_t)bytes);
    *block = own;
    return BRC_OK;
}

brc_status brc_domain_take_pages(brc_context *context, brc_domain *domain)
{
    taking t = {context, domain};
    if (domain->pages.n == 0) return BRC_OK;
    BRC_TRY(brc_domain_each_block(domain, true, take_block, &t));
    domain->pages.n = 0;
    return BRC_OK;
}

brc_status brc_domain_add_wall(brc_context *context, brc_domain *domain, const char *name)
{
    char **to = &domain->wall_name[domain->n_walls];
    BRC_TRY(BRC_ALLOCATE(context, to, (int64_t)strlen(name) + 1, "wall name"));
    strcpy(*to, name);
    domain->n_walls++;
    return BRC_OK;
}

int32_t brc_domain_find_set(const brc_domain *domain, const char *name)
{
    for (int32_t s = 0; s < domain->n_sets; ++s)
        if (strcmp(domain->sets[s].name, name) == 0) return s;
    return -1;
}

double brc_domain_closure(const brc_domain *domain, int64_t e)
{
    if (domain->element_kind == BRC_ELEMENT_SPHERE) return 0.0;
    double sum[3] = {0.0, 0.0, 0.0}, total = 0.0;
    const double *s[2] = {domain->area_vector + 3 * domain->row_start[e],
                          domain->free_area_vector + 3 * domain->free_start[e]};
    const int64_t n[2] = {domain->row_start[e + 1] - domain->row_start[e],
                          domain->free_start[e + 1] - domain->free_start[e]};
    for (int part = 0; part < 2; ++part)
        for (const double *v = s[part]; v < s[part] + 3 * n[part]; v += 3) {
            total += sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            for (int k = 0; k < 3; ++k)
                sum[k] += v[k];
        }
    return total > 0.0 ? sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / total : 0.0;
}

/* Closure of a cell is rounding plus what dropped faces leave open: their number times the threshold. */
#define CLOSURE_ROUNDING 1e-9
#define SPHERE_ROUNDING 1e-12

static bool all_finite(const double *a, int64_t n)
{
    for (int64_t k = 0; k < n; ++k)
        if (!isfinite(a[k])) return false;
    return true;
}

/* start[0] = 0, never falling, start[n] = end. */
static bool proper_rows(const int64_t *start, int64_t n, int64_t end)
{
    if (start[0] != 0 || start[n] != end) return false;
    for (int64_t k = 0; k < n; ++k)
        if (start[k] > start[k + 1]) return false;
    return true;
}

static bool in_range(const int32_t *a, int64_t n, int64_t end)
{
    for (int64_t k = 0; k < n; ++k)
        if (a[k] < 0 || a[k] >= end) return false;
    return true;
}

#define CHECK(condition, ...)                                                                                          \
    do {                                                                                                               \
        if (!(condition)) status = BRC_FAIL(context, BRC_BAD_INPUT, "domain: " __VA_ARGS__);                           \
    } while (0)

static bool spheres(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_SPHERE;
}

/* Counts and row starts: what everything else is indexed by. */
static brc_status check_rows(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    CHECK(d->element_kind == BRC_ELEMENT_CELL || d->element_kind == BRC_ELEMENT_SPHERE,
          "elements of the unknown kind %d", (int)d->element_kind);
    CHECK(d->n_elements >= 1 && d->n_elements <= INT32_MAX, "%lld elements, must be 1 to 2^31 - 1",
          (long long)d->n_elements);
    CHECK(d->n_bonds >= 0 && d->n_half_edges == 2 * d->n_bonds && d->n_half_edges <= INT32_MAX,
          "%lld half-edges for %lld bonds, must be twice as many and below 2^31", (long long)d->n_half_edges,
          (long long)d->n_bonds);
    CHECK(d->n_free_faces >= 0 && d->n_free_faces <= INT32_MAX, "%lld free faces", (long long)d->n_free_faces);
    if (status != BRC_OK) return status;
    CHECK(proper_rows(d->row_start, d->n_elements, d->n_half_edges), "rows of half-edges are not ascending to %lld",
          (long long)d->n_half_edges);
    if (spheres(d)) {
        CHECK(!d->free_start && !d->vertex_start && !d->area_vector && d->n_free_faces == 0, "spheres with faces");
        CHECK(d->radius, "spheres without radii");
        return status;
    }
    CHECK(!d->radius, "cells with radii");
    CHECK(proper_rows(d->free_start, d->n_elements, d->n_free_faces), "rows of free faces are not ascending to %lld",
          (long long)d->n_free_faces);
    CHECK(proper_rows(d->vertex_start, d->n_elements, d->vertex_start[d->n_elements]) &&
              d->vertex_start[d->n_elements] <= INT32_MAX,
          "rows of cell corners are not ascending");
    CHECK(proper_rows(d->free_polygon_start, d->n_free_faces, d->free_polygon_start[d->n_free_faces]),
          "rows of free polygons are not ascending");
    return status;
}

/* Twins, bonds and sorted rows. Stops at the first broken half-edge: a broken file has millions. */
static brc_status check_half_edges(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    CHECK(in_range(d->neighbour, d->n_half_edges, d->n_elements), "a neighbour is out of range");
    CHECK(in_range(d->twin, d->n_half_edges, d->n_half_edges), "a twin is out of range");
    CHECK(in_range(d->bond, d->n_half_edges, d->n_bonds), "a bond of a half-edge is out of range");
    CHECK(in_range(d->bond_half_edge, d->n_bonds, d->n_half_edges), "a half-edge of a bond is out of range");
    if (status != BRC_OK) return status;
    int64_t b = 0;
    for (int64_t e = 0; e < d->n_elements && status == BRC_OK; ++e)
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1] && status == BRC_OK; ++h) {
            const int64_t t = d->twin[h], j = d->neighbour[h];
            CHECK(j != e, "half-edge %lld joins element %lld to itself", (long long)h, (long long)e);
            CHECK(h == d->row_start[e] || d->neighbour[h - 1] < j, "row of element %lld is not sorted by neighbour",
                  (long long)e);
            CHECK(d->twin[t] == h && d->neighbour[t] == e && t >= d->row_start[j] && t < d->row_start[j + 1],
                  "half-edge %lld and its twin %lld do not point at each other", (long long)h, (long long)t);
            CHECK(d->bond[h] == d->bond[t], "half-edge %lld and its twin belong to different bonds", (long long)h);
            if (j > e) {
                CHECK(d->bond_half_edge[b] == h && d->bond[h] == b, "bond %lld is not in order", (long long)b);
                ++b;
            }
        }
    return status;
}

/* Both sides of a face are one and the same. */
static brc_status check_faces(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    for (int64_t h = 0; h < d->n_half_edges && !spheres(d) && status == BRC_OK; ++h) {
        const int64_t t = d->twin[h];
        if (t < 0 || t >= d->n_half_edges) break; /* said before */
        const double *s = d->area_vector + 3 * h, *o = d->area_vector + 3 * t;
        CHECK(s[0] == -o[0] && s[1] == -o[1] && s[2] == -o[2], "area vectors of bond %d are not opposite", d->bond[h]);
        CHECK(memcmp(d->face_centroid + 3 * h, d->face_centroid + 3 * t, 3 * sizeof(double)) == 0,
              "the face of bond %d has two centroids", d->bond[h]);
        CHECK(s[0] != 0.0 || s[1] != 0.0 || s[2] != 0.0, "bond %d has no area", d->bond[h]);
    }
    return status;
}

static brc_status check_free_faces(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    if (spheres(d)) return BRC_OK;
    CHECK(in_range(d->free_wall, d->n_free_faces, d->n_walls), "the wall of a free face is out of range");
    for (int64_t e = 0; e < d->n_elements && status == BRC_OK; ++e)
        for (int64_t f = d->free_start[e]; f < d->free_start[e + 1] && status == BRC_OK; ++f) {
            CHECK(d->free_element[f] == e, "free face %lld belongs to element %d, its row to %lld", (long long)f,
                  d->free_element[f], (long long)e);
            for (int64_t p = d->free_polygon_start[f]; p < d->free_polygon_start[f + 1] && status == BRC_OK; ++p)
                CHECK(d->free_polygon[p] >= d->vertex_start[e] && d->free_polygon[p] < d->vertex_start[e + 1],
                      "free face %lld has a corner that is not its element's", (long long)f);
        }
    return status;
}

/* Finite numbers, positive volumes. */
static brc_status check_geometry(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    CHECK(all_finite(d->position, 3 * d->n_elements), "a position is not finite");
    CHECK(all_finite(d->centroid, 3 * d->n_elements), "a centroid is not finite");
    CHECK(all_finite(d->inertia, 6 * d->n_elements), "an inertia tensor is not finite");
    for (int64_t e = 0; e < d->n_elements && status == BRC_OK; ++e)
        CHECK(d->volume[e] > 0.0 && isfinite(d->volume[e]), "element %lld has the volume %g m^3", (long long)e,
              d->volume[e]);
    return status;
}

/* Finite faces and corners, closed cells. */
static brc_status check_cells(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    if (spheres(d)) return BRC_OK;
    CHECK(all_finite(d->area_vector, 3 * d->n_half_edges), "an area vector is not finite");
    CHECK(all_finite(d->face_centroid, 3 * d->n_half_edges), "a face centroid is not finite");
    CHECK(all_finite(d->free_area_vector, 3 * d->n_free_faces), "a free area vector is not finite");
    CHECK(all_finite(d->free_centroid, 3 * d->n_free_faces), "a free face centroid is not finite");
    CHECK(all_finite(d->vertex, 3 * d->vertex_start[d->n_elements]), "a cell corner is not finite");
    for (int64_t e = 0; e < d->n_elements && status == BRC_OK; ++e) {
        const double open = brc_domain_closure(d, e);
        CHECK(open <= CLOSURE_ROUNDING + 10.0 * d->quality.tiny_face_threshold,
              "the faces of element %lld leave %.3g of its surface open", (long long)e, open);
    }
    return status;
}

/* Inertia and centroid follow from volume, radius and position, volumes but for a factor of the body; bonds have a
 * length. */
static brc_status check_spheres(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    double per_own = 1; /* volume that a sphere stands for over its own, of the body */
    for (int64_t e = 0; e < d->n_elements && spheres(d) && status == BRC_OK; ++e) {
        const double r = d->radius[e], *x = d->position + 3 * e;
        if (e == 0 || (d->body && d->body[e] != d->body[e - 1])) per_own = d->volume[e] / brc_sphere_volume(r);
        const double volume = per_own * brc_sphere_volume(r);
        CHECK(r > 0.0 && isfinite(r), "sphere %lld has the radius %g m", (long long)e, r);
        CHECK(fabs(d->volume[e] - volume) <= SPHERE_ROUNDING * volume,
              "the volume of sphere %lld is not that of its radius", (long long)e);
        for (int k = 0; k < 6; ++k)
            CHECK(fabs(d->inertia[6 * e + k] - (k < 3 ? 0.4 * volume * r * r : 0.0)) <=
                      SPHERE_ROUNDING * volume * r * r,
                  "the inertia of sphere %lld is not that of its radius", (long long)e);
        CHECK(memcmp(x, d->centroid + 3 * e, 3 * sizeof *x) == 0, "the centroid of sphere %lld is not its position",
              (long long)e);
        for (int64_t h = d->row_start[e]; h < d->row_start[e + 1] && status == BRC_OK; ++h) {
            const int32_t j = d->neighbour[h];
            if (j < 0 || j >= d->n_elements) break; /* said before */
            CHECK(memcmp(x, d->position + 3 * (int64_t)j, 3 * sizeof *x) != 0, "bond %d has no length", d->bond[h]);
        }
    }
    return status;
}

static brc_status check_sets(brc_context *context, const brc_domain *d)
{
    brc_status status = BRC_OK;
    for (int32_t s = 0; s < d->n_sets; ++s) {
        const brc_set *set = &d->sets[s];
        const int64_t end = set->kind == BRC_SET_FACES ? d->n_free_faces : d->n_elements;
        CHECK(brc_domain_find_set(d, set->name) == s, "two sets have the name '%s'", set->name);
        CHECK(in_range(set->members, set->n_members, end), "set '%s' has a member out of range", set->name);
        for (int64_t k = 1; k < set->n_members; ++k)
            if (set->members[k - 1] >= set->members[k]) {
                CHECK(false, "members of set '%s' are not ascending", set->name);
                break;
            }
    }
    return status;
}

brc_status brc_domain_check(brc_context *context, const brc_domain *domain)
{
    BRC_TRY(check_rows(context, domain));
    brc_status status = BRC_OK;
    brc_status (*const check[])(brc_context *, const brc_domain *) = {
        check_half_edges, check_faces, check_free_faces, check_geometry, check_cells, check_spheres, check_sets};
    CHECK(in_range(domain->region, domain->n_elements, INT32_MAX), "a region is negative");
    CHECK(in_range(domain->body, domain->n_elements, INT32_MAX), "a body is negative");
    if (domain->grain) CHECK(in_range(domain->grain, domain->n_elements, INT32_MAX), "a grain is negative");
    for (size_t k = 0; k < sizeof check / sizeof *check; ++k) {
        const brc_status one = check[k](context, domain);
        if (one != BRC_OK) status = one;
    }
    return status;
}
