/* What must hold of a domain that fills a shape, checked from its arrays. */
#ifndef TESTS_SHAPE_CASE_H
#define TESTS_SHAPE_CASE_H

#include "../shapes.h"
#include "../support.h"

/* Tangent planes miss a curved wall by second order: the asked bound of 0.5 % at 10 000 cells, carried to n cells. */
static inline double curved_bound(int64_t n)
{
    return 0.005 * pow(1e4 / (double)n, 2.0 / 3.0);
}

static inline brc_build_request request_for(brc_shape shape, int64_t n)
{
    brc_build_request r = {.n_threads = 1, .shape = shape};
    r.fill = (brc_fill){.n_elements = n, .spread = 0.9, .seed = 3};
    return r;
}

static inline double smallest_face(const brc_domain *d)
{
    double least = HUGE_VAL;
    for (int64_t h = 0; h < d->n_half_edges; ++h) {
        const double *s = d->area_vector + 3 * h;
        least = fmin(least, sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]));
    }
    for (int64_t f = 0; f < d->n_free_faces; ++f) {
        const double *s = d->free_area_vector + 3 * f;
        least = fmin(least, sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]));
    }
    return least;
}

/* All that is promised of any domain of cells. Closure and the first moment live from rounding: 1e-12 is four orders
 * above it. */
static inline void check_domain(brc_context *context, const brc_domain *d, const char *name)
{
    if (brc_domain_check(context, d) != BRC_OK)
        fail_msg("%s: %s", name, brc_context_message(context)); /* each bond once, twins, closed cells, rows */
    if (!(test_worst_closure(d) < 1e-12)) fail_msg("%s: closure %g", name, test_worst_closure(d));
    if (!(test_worst_first_moment(d) < 1e-11)) fail_msg("%s: first moment %g", name, test_worst_first_moment(d));
    if (!(d->quality.twin_area_worst < 1e-11)) fail_msg("%s: twins %g", name, d->quality.twin_area_worst);
    if (!(smallest_face(d) > 0.0)) fail_msg("%s: a face without area", name);
    assert_int_equal(d->quality.n_seeds_lost, 0);
    assert_int_equal(d->quality.n_pieces, 1);
}

#endif
