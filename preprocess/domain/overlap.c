/* The elements of one body near the other are entered into the boxes of a grid that they cover; an element of the other
 * asks those of its own box. Ranks that have a body between them enter their own cells: what is asked with, positions,
 * radii and corners of free faces, all have. */
#include "overlap.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"
#include "domain_rows.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

/* A position this deep inside a cell is inside, in spacings; bodies that touch share planes to rounding. */
#define DEEP 1e-6
/* Packed spheres of one body overlap by a thousandth; those of two bodies in contact may by a little more. */
#define NEAR 0.9
/* Cells reach into another body by less than the distance of positions from walls: then corners tell. Round walls that
 * touch reach into each other by the square of the cell size; so much [spacings] is no rounding of that kind. */
#define CORNER_DEEP 0.1

/* Elements of `body` by the boxes of a grid over `low` .. `high`, the region in which it may overlap with the other. */
typedef struct box_list {
    const brc_domain *body;
    double low[3], high[3], side;
    double reach; /* largest radius of the other body; 0 for cells [m] */
    int64_t dims[3];
    int64_t *start;   /* [boxes + 1] */
    int32_t *element; /* [start[boxes]] */
} box_list;

static bool is_sphere(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_SPHERE;
}

static double largest_radius(const brc_domain *d)
{
    double most = 0.0;
    for (int64_t e = 0; is_sphere(d) && e < d->n_elements; ++e)
        most = fmax(most, d->radius[e]);
    return most;
}

/* Where positions of the other body can lie that element e overlaps. */
static void extent(const box_list *list, int64_t e, double low[3], double high[3])
{
    const brc_domain *d = list->body;
    for (int c = 0; c < 3; ++c) {
        if (is_sphere(d)) {
            const double reach = NEAR * (d->radius[e] + list->reach);
            low[c] = d->position[3 * e + c] - reach;
            high[c] = d->position[3 * e + c] + reach;
            continue;
        }
        low[c] = HUGE_VAL;
        high[c] = -HUGE_VAL;
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v) {
            low[c] = fmin(low[c], d->vertex[3 * v + c]);
            high[c] = fmax(high[c], d->vertex[3 * v + c]);
        }
        low[c] -= NEAR * list->reach;
        high[c] += NEAR * list->reach;
    }
}

static int64_t box_along(const box_list *list, int axis, double x)
{
    const int64_t at = (int64_t)((x - list->low[axis]) / list->side);
    return at < 0 ? 0 : at >= list->dims[axis] ? list->dims[axis] - 1 : at;
}

/* Boxes that element e covers; false where it stays outside the region. */
static bool covers(const box_list *list, int64_t e, int64_t first[3], int64_t last[3])
{
    double low[3], high[3];
    extent(list, e, low, high);
    for (int c = 0; c < 3; ++c) {
        if (low[c] > list->high[c] || high[c] < list->low[c]) return false;
        first[c] = box_along(list, c, fmax(low[c], list->low[c]));
        last[c] = box_along(list, c, fmin(high[c], list->high[c]));
    }
    return true;
}

/* Call once to count (start), once to fill (element). */
static void enter_elements(box_list *list)
{
    int64_t first[3], last[3];
    for (int64_t e = list->body->n_elements - 1; e >= 0; --e) {
        if (!brc_domain_mine(list->body, e) || !covers(list, e, first, last)) continue;
        for (int64_t i = first[0]; i <= last[0]; ++i)
            for (int64_t j = first[1]; j <= last[1]; ++j)
                for (int64_t k = first[2]; k <= last[2]; ++k) {
                    int64_t *at = &list->start[(i * list->dims[1] + j) * list->dims[2] + k];
                    if (list->element)
                        list->element[--*at] = (int32_t)e;
                    else
                        ++*at;
                }
    }
}

static brc_status make_boxes(brc_context *context, box_list *list)
{
    for (list->side = list->body->quality.mean_spacing;; list->side *= 1.2) {
        double boxes = 1.0;
        for (int c = 0; c < 3; ++c) {
            const double along = floor((list->high[c] - list->low[c]) / list->side) + 1.0;
            list->dims[c] = (int64_t)fmin(along, 1e9);
            boxes *= along;
        }
        if (boxes <= 2.0 * (double)list->body->n_elements + 64.0) break;
    }
    const int64_t boxes = list->dims[0] * list->dims[1] * list->dims[2];
    BRC_TRY(BRC_ALLOCATE(context, &list->start, boxes + 1, "boxes of a body"));
    enter_elements(list);
    for (int64_t b = 0; b < boxes; ++b)
        list->start[b + 1] += list->start[b]; /* ends, which filling turns into beginnings */
    BRC_TRY(BRC_ALLOCATE(context, &list->element, list->start[boxes], "boxes of a body"));
    enter_elements(list);
    return BRC_OK;
}

static bool below_faces(const double *x, const double *centroid, const double *area, int64_t n, double margin)
{
    for (int64_t k = 0; k < n; ++k) {
        const double *c = centroid + 3 * k, *s = area + 3 * k;
        const double height = (x[0] - c[0]) * s[0] + (x[1] - c[1]) * s[1] + (x[2] - c[2]) * s[2];
        if (height > -margin * sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2])) return false;
    }
    return true;
}

/* Is x inside cell b, `deep` below its free faces and `margin` below the others? */
static bool in_cell(const double *x, const brc_domain *body, int64_t b, double deep, double margin)
{
    const int64_t h = body->row_start[b], f = body->free_start[b];
    return below_faces(x, body->free_centroid + 3 * f, body->free_area_vector + 3 * f, body->free_start[b + 1] - f,
                       deep) &&
           below_faces(x, body->face_centroid + 3 * h, body->area_vector + 3 * h, body->row_start[b + 1] - h, margin);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Square of the distance of x from free face f, a convex polygon. */
static double square_to_face(const double *x, const brc_domain *body, int64_t f)
{
    const int32_t *corner = body->free_polygon + body->free_polygon_start[f];
    const int64_t n = body->free_polygon_start[f + 1] - body->free_polygon_start[f];
    const double *normal = body->free_area_vector + 3 * f, area = sqrt(dot(normal, normal));
    double least = HUGE_VAL;
    bool above = true; /* of the face itself, not beside it */
    for (int64_t k = 0; k < n; ++k) {
        const double *a = body->vertex + 3 * (int64_t)corner[k], *b = body->vertex + 3 * (int64_t)corner[(k + 1) % n];
        const double edge[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, r[3] = {x[0] - a[0], x[1] - a[1], x[2] - a[2]};
        const double outward[3] = {edge[1] * normal[2] - edge[2] * normal[1], edge[2] * normal[0] - edge[0] * normal[2],
                                   edge[0] * normal[1] - edge[1] * normal[0]};
        const double along = dot(edge, edge) > 0.0 ? fmin(fmax(dot(r, edge) / dot(edge, edge), 0.0), 1.0) : 0.0;
        double square = 0.0;
        for (int c = 0; c < 3; ++c)
            square += (r[c] - along * edge[c]) * (r[c] - along * edge[c]);
        least = fmin(least, square);
        above = above && dot(r, outward) <= 0.0;
    }
    if (!above || !(area > 0.0)) return least;
    const double *c = body->free_centroid + 3 * f, r[3] = {x[0] - c[0], x[1] - c[1], x[2] - c[2]},
                 height = dot(r, normal) / area;
    return height * height;
}

/* Does a sphere reach through a free face of cell b? Its middle may be outside. */
static bool reaches_in(const double *x, double radius, const brc_domain *body, int64_t b)
{
    for (int64_t f = body->free_start[b]; f < body->free_start[b + 1]; ++f)
        if (square_to_face(x, body, f) < NEAR * radius * NEAR * radius) return true;
    return false;
}

/* Does element e of `other` stand in element b of the list's body? */
static bool stands_in(const brc_domain *other, int64_t e, const brc_domain *body, int64_t b)
{
    const double *x = other->position + 3 * e, *y = body->position + 3 * b, margin = DEEP * body->quality.mean_spacing;
    const double radius = is_sphere(other) ? other->radius[e] : 0.0;
    if (!is_sphere(body))
        return in_cell(x, body, b, margin, margin) || (radius > 0.0 && reaches_in(x, radius, body, b));
    const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]}, near = NEAR * (radius + body->radius[b]);
    return dot(r, r) < near * near;
}

/* The box of x; -1: outside the region. */
static int64_t box_of(const box_list *list, const double *x)
{
    int64_t box = 0;
    for (int c = 0; c < 3; ++c) {
        if (x[c] < list->low[c] || x[c] > list->high[c]) return -1;
        box = box * list->dims[c] + box_along(list, c, x[c]);
    }
    return box;
}

/* The first corner of a free face of cell e of `other`, in free_polygon, that lies deep inside the list's body;
 * INT64_MAX: none. */
static int64_t deep_corner(const box_list *list, const brc_domain *other, int64_t e)
{
    const double deep = CORNER_DEEP * list->body->quality.mean_spacing;
    for (int64_t p = other->free_polygon_start[other->free_start[e]];
         p < other->free_polygon_start[other->free_start[e + 1]]; ++p) {
        const double *x = brc_domain_free_corner(other, p);
        const int64_t box = box_of(list, x);
        for (int64_t k = box < 0 ? 0 : list->start[box]; box >= 0 && k < list->start[box + 1]; ++k)
            if (in_cell(x, list->body, list->element[k], deep, 0.0)) return p;
    }
    return INT64_MAX;
}

static bool reaches_deep(const box_list *list, const brc_domain *other, int64_t e)
{
    return deep_corner(list, other, e) < INT64_MAX;
}

static bool element_overlaps(const box_list *list, const brc_domain *other, int64_t e)
{
    const int64_t box = box_of(list, other->position + 3 * e);
    if (box < 0) return false;
    for (int64_t k = list->start[box]; k < list->start[box + 1]; ++k)
        if (stands_in(other, e, list->body, list->element[k])) return true;
    return false;
}

/* How many elements of `other` some rank says so of, and the first of them. */
static brc_status count_elements(brc_context *context, const box_list *list, const brc_domain *other,
                                 bool (*says)(const box_list *, const brc_domain *, int64_t), int64_t *n,
                                 int64_t *first)
{
    enum { BITS = 64 };
    const int64_t n_words = (other->n_elements + BITS - 1) / BITS;
    BRC_LOCAL(context, n_words, int64_t, word, "elements that overlap");
#pragma omp parallel for schedule(dynamic, 4) num_threads(omp_get_max_threads())
    for (int64_t w = 0; w < n_words; ++w)
        for (int64_t e = w * BITS; e < (w + 1) * BITS && e < other->n_elements; ++e)
            if (says(list, other, e)) word[w] |= (int64_t)(UINT64_C(1) << e % BITS);
    if (list->body->here) BRC_TRY(brc_ranks_reduce(context, BRC_ANY_BIT, n_words, word));
    *n = 0;
    for (int64_t e = other->n_elements - 1; e >= 0; --e)
        if ((uint64_t)word[e / BITS] >> e % BITS & 1) {
            ++*n;
            *first = e;
        }
    return BRC_OK;
}

/* How far `other` stands in `body`. */
typedef struct finding {
    int64_t n, first;  /* elements whose positions do, and the first of them */
    int64_t n_corners; /* cells of which a corner of a free face does; looked at where no position does */
    double corner[3];  /* of the first of them [m] */
} finding;

static brc_status find_in_boxes(brc_context *context, const box_list *list, const brc_domain *other, finding *out)
{
    int64_t first = 0, corner = INT64_MAX;
    BRC_TRY(count_elements(context, list, other, element_overlaps, &out->n, &out->first));
    if (out->n > 0 || is_sphere(list->body) || is_sphere(other)) return BRC_OK;
    BRC_TRY(count_elements(context, list, other, reaches_deep, &out->n_corners, &first));
    if (out->n_corners == 0) return BRC_OK;
    corner = deep_corner(list, other, first);
    if (list->body->here) BRC_TRY(brc_ranks_reduce(context, BRC_LEAST, 1, &corner));
    memcpy(out->corner, brc_domain_free_corner(other, corner), sizeof out->corner);
    return BRC_OK;
}

static brc_status find_inside(brc_context *context, const brc_domain *other, const brc_domain *body, finding *out)
{
    box_list list = {.body = body, .reach = largest_radius(other)};
    *out = (finding){.n = 0};
    for (int c = 0; c < 3; ++c) {
        list.low[c] = fmax(other->bounds[0][c], body->bounds[0][c] - list.reach);
        list.high[c] = fmin(other->bounds[1][c], body->bounds[1][c] + list.reach);
        if (!(list.low[c] < list.high[c])) return BRC_OK;
    }
    brc_status status = make_boxes(context, &list);
    if (status == BRC_OK) status = find_in_boxes(context, &list, other, out);
    brc_memory_free(list.start);
    brc_memory_free(list.element);
    return status;
}

const char *brc_overlap_name(const char *const *name, int32_t body, char words[BRC_OVERLAP_NAME])
{
    if (name)
        snprintf(words, BRC_OVERLAP_NAME, "'%s'", name[body]);
    else
        snprintf(words, BRC_OVERLAP_NAME, "%d", body);
    return words;
}

/* found[0]: of body a in b, found[1]: of b in a. */
static brc_status fail_overlap(brc_context *context, const char *a, const char *b, const brc_domain *const both[2],
                               const finding found[2])
{
    const int side = found[0].n + found[1].n > 0 ? found[0].n == 0 : found[0].n_corners == 0;
    if (found[0].n + found[1].n > 0) {
        const double *x = both[side]->position + 3 * found[side].first;
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "bodies %s and %s overlap: %lld elements of body %s and %lld of body %s stand in the other "
                        "one, the first at "
                        "(%g, %g, %g) m; move them apart with `pose`, or make one body of several `parts`",
                        a, b, (long long)found[0].n, a, (long long)found[1].n, b, x[0], x[1], x[2]);
    }
    const double *x = found[side].corner;
    return BRC_FAIL(context, BRC_BAD_INPUT,
                    "bodies %s and %s overlap by less than a cell: corners of %lld cells of body %s and of %lld of "
                    "body %s lie in the other one, the "
                    "first at (%g, %g, %g) m; move them apart with `pose`, or make one body of several `parts`",
                    a, b, (long long)found[0].n_corners, a, (long long)found[1].n_corners, b, x[0], x[1], x[2]);
}

brc_status brc_overlap_check(brc_context *context, int32_t n, const brc_domain *const *bodies, const char *const *name)
{
    brc_status status = BRC_OK;
    for (int32_t a = 0; a < n; ++a)
        for (int32_t b = a + 1; b < n; ++b) {
            const brc_domain *const both[2] = {bodies[a], bodies[b]};
            char words[2][BRC_OVERLAP_NAME];
            finding found[2];
            for (int side = 0; side < 2; ++side)
                BRC_TRY(find_inside(context, both[side], both[1 - side], &found[side]));
            if (found[0].n + found[1].n + found[0].n_corners + found[1].n_corners == 0) continue;
            status = fail_overlap(context, brc_overlap_name(name, a, words[0]), brc_overlap_name(name, b, words[1]),
                                  both, found);
        }
    return status;
}
