/* The elements of one body near the other are entered into the boxes of a grid that they cover; an element of the other asks those of its own box. */
#include "overlap.h"

#include "../host/base/memory.h"

#include <math.h>
#include <omp.h>

/* A position this deep inside a cell is inside, in spacings; bodies that touch share planes to rounding. */
#define DEEP 1e-6
/* Packed spheres of one body overlap by a thousandth; those of two bodies in contact may by a little more. */
#define NEAR 0.9

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
    for (int64_t e = 0; is_sphere(d) && e < d->n_elements; ++e) most = fmax(most, d->radius[e]);
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
        if (!covers(list, e, first, last)) continue;
        for (int64_t i = first[0]; i <= last[0]; ++i)
            for (int64_t j = first[1]; j <= last[1]; ++j)
                for (int64_t k = first[2]; k <= last[2]; ++k) {
                    int64_t *at = &list->start[(i * list->dims[1] + j) * list->dims[2] + k];
                    if (list->element) list->element[--*at] = (int32_t)e;
                    else ++*at;
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
    for (int64_t b = 0; b < boxes; ++b) list->start[b + 1] += list->start[b]; /* ends, which filling turns into beginnings */
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

/* Does element e of `other` stand in element b of the list's body? */
static bool stands_in(const brc_domain *other, int64_t e, const brc_domain *body, int64_t b)
{
    const double *x = other->position + 3 * e, *y = body->position + 3 * b;
    if (is_sphere(body)) {
        const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]}, near = NEAR * (other->radius[e] + body->radius[b]);
        return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < near * near;
    }
    const double margin = DEEP * body->quality.mean_spacing;
    const int64_t h = body->row_start[b], f = body->free_start[b];
    return below_faces(x, body->free_centroid + 3 * f, body->free_area_vector + 3 * f, body->free_start[b + 1] - f, margin) &&
           below_faces(x, body->face_centroid + 3 * h, body->area_vector + 3 * h, body->row_start[b + 1] - h, margin);
}

static bool element_overlaps(const box_list *list, const brc_domain *other, int64_t e)
{
    const double *x = other->position + 3 * e;
    int64_t box = 0;
    for (int c = 0; c < 3; ++c) {
        if (x[c] < list->low[c] || x[c] > list->high[c]) return false;
        box = box * list->dims[c] + box_along(list, c, x[c]);
    }
    for (int64_t k = list->start[box]; k < list->start[box + 1]; ++k)
        if (stands_in(other, e, list->body, list->element[k])) return true;
    return false;
}

/* Elements of `other` that stand in `body`: how many, and the first. */
static brc_status count_inside(brc_context *context, const brc_domain *other, const brc_domain *body, int64_t *count, int64_t *first)
{
    box_list list = {.body = body, .reach = largest_radius(other)};
    int64_t n = 0, least = INT64_MAX;
    brc_status status = BRC_OK;
    *count = 0;
    for (int c = 0; c < 3; ++c) {
        list.low[c] = fmax(other->bounds[0][c], body->bounds[0][c] - list.reach);
        list.high[c] = fmin(other->bounds[1][c], body->bounds[1][c] + list.reach);
        if (!(list.low[c] < list.high[c])) return BRC_OK;
    }
    BRC_TRY_OR(cleanup, make_boxes(context, &list));
#pragma omp parallel for schedule(dynamic, 256) num_threads(omp_get_max_threads()) reduction(+ : n) reduction(min : least)
    for (int64_t e = 0; e < other->n_elements; ++e)
        if (element_overlaps(&list, other, e)) {
            ++n;
            if (e < least) least = e;
        }
    *count = n;
    *first = least;
cleanup:
    brc_memory_free(list.start);
    brc_memory_free(list.element);
    return status;
}

brc_status brc_overlap_check(brc_context *context, int32_t n, const brc_domain *const *bodies)
{
    brc_status status = BRC_OK;
    for (int32_t a = 0; a < n; ++a)
        for (int32_t b = a + 1; b < n; ++b) {
            int64_t count[2], first[2];
            for (int side = 0; side < 2; ++side)
                BRC_TRY(count_inside(context, bodies[side ? b : a], bodies[side ? a : b], &count[side], &first[side]));
            if (count[0] + count[1] == 0) continue;
            const int side = count[0] > 0 ? 0 : 1;
            const double *x = bodies[side ? b : a]->position + 3 * first[side];
            status = BRC_FAIL(context, BRC_BAD_INPUT,
                              "bodies %d and %d overlap: %lld elements of body %d and %lld of body %d stand in the other one, the first at "
                              "(%g, %g, %g) m; move them apart with `pose`, or make one body of several `parts`",
                              a, b, (long long)count[0], a, (long long)count[1], b, x[0], x[1], x[2]);
        }
    return status;
}
