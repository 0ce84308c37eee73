/* A million random pairs against GJK of libccd: do they share a point? Every twentieth is first brought to where it
 * just touches, and then 1e-2 to 1e-9 deeper or away. The two may differ where drawing in the faces of one body by BAND
 * makes it miss the other and pushing them out makes it meet it; nowhere else. */
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on
#include "convex_case.h"

#include "../skip.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef BRC_HAVE_CCD
#include <ccd/ccd.h>

enum { PAIRS = 1000000, BODIES = 2000 };
/* Sizes are near 1. The oracle takes squares of distances below 1e-10 for zero (CCD_EPS). */
#define BAND 1e-5

typedef struct placed {
    const convex_case *body;
    convex_pose pose;
} placed;

static void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out)
{
    const placed *p = object;
    const convex_vec d = convex_turn(convex_transpose(p->pose.map),
                                     (convex_vec){ccdVec3X(direction), ccdVec3Y(direction), ccdVec3Z(direction)});
    const double *best = p->body->corner;
    double most = -HUGE_VAL;
    for (int k = 0; k < p->body->n_corners; ++k) {
        const double *x = p->body->corner + 3 * k, along = x[0] * d.x + x[1] * d.y + x[2] * d.z;
        if (along > most) {
            most = along;
            best = x;
        }
    }
    const convex_vec x = convex_add(p->pose.origin, convex_turn(p->pose.map, (convex_vec){best[0], best[1], best[2]}));
    ccdVec3Set(out, x.x, x.y, x.z);
}

static double shared(const placed *a, const placed *b, double swell)
{
    const convex_map scale = {swell, 0, 0, 0, swell, 0, 0, 0, swell};
    const convex_pose pose = {b->pose.origin, convex_product(b->pose.map, scale)};
    return convex_overlap_of(convex_case_shape(a->body), a->pose, convex_case_shape(b->body), pose).volume;
}

/* b between where it meets a and far away along its way from a, then deeper by `step` or, negative, away. */
static void touch(const placed *a, placed *b, double step)
{
    const convex_vec way = b->pose.origin;
    const double length = convex_length(way);
    double low = 0, high = (a->body->radius + b->body->radius) * 2 / length;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        b->pose.origin = convex_scale(middle, way);
        if (shared(a, b, 1) > 0)
            low = middle;
        else
            high = middle;
    }
    b->pose.origin = convex_scale(low - step / length, way);
}

static void verdict_is_that_of_libccd(void **state)
{
    (void)state;
    convex_case *body = malloc(BODIES * sizeof *body);
    assert_non_null(body);
    uint64_t random = 11;
    for (int k = 0; k < BODIES; ++k)
        convex_case_random(body + k, k % CONVEX_KINDS, 5 + k % 17, &random);
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = support;
    ccd.max_iterations = 500;
    int touching = 0, band = 0, wrong = 0, failed = 0;
    for (int n = 0; n < PAIRS; ++n) {
        placed a = {body + n % BODIES, {{0, 0, 0}, convex_case_map(0.1, &random)}};
        placed b = {body + (n / BODIES * 7 + n * 13 + 5) % BODIES, {{0, 0, 0}, convex_case_map(0.1, &random)}};
        const double spread = 0.6 * (cbrt(a.body->radius) + cbrt(b.body->radius)); /* about half of the pairs meet */
        b.pose.origin = (convex_vec){spread * convex_case_number(&random), spread * convex_case_number(&random),
                                     spread * convex_case_number(&random)};
        if (n % 20 == 0) touch(&a, &b, (n / 20 % 2 ? 1 : -1) * pow(10, -2 - n / 40 % 8));
        const convex_overlap o =
            convex_overlap_of(convex_case_shape(a.body), a.pose, convex_case_shape(b.body), b.pose);
        failed += o.failed != 0 || !(o.volume >= 0);
        touching += o.volume > 0;
        if ((o.volume > 0) == (ccdGJKIntersect(&a, &b, &ccd) != 0)) continue;
        static const double thickness[CONVEX_KINDS] = {
            1, 1, 0.1, 0.01}; /* the nearest faces are about half as far from the origin */
        const double swell = 2 * BAND / thickness[(b.body - body) % CONVEX_KINDS];
        if (shared(&a, &b, 1 - swell) > 0 || !(shared(&a, &b, 1 + swell) > 0))
            ++wrong;
        else
            ++band;
    }
    printf("%d pairs, %d share volume; %d differ within the band of %g, %d beyond it\n", (int)PAIRS, touching, band,
           BAND, wrong);
    assert_int_equal(failed, 0);
    assert_int_equal(wrong, 0);
    assert_true(touching > PAIRS / 4 && touching < 3 * PAIRS / 4);
    free(body);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(verdict_is_that_of_libccd),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
#else
int main(void)
{
    return test_skip("libccd is not installed (Debian package libccd-dev)");
}
#endif
