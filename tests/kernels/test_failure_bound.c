/* The bound that spares elements their stresses: above the ratio itself, sublinear, and tight where it matters. One
 * lane, double. */
#include "one_lane.h"
#include "../../kernels/effects/fracture/failure.h"
#include "../../kernels/effects/fracture/failure_bound.h"
#include <stdbool.h>

enum { STATES = 5000, KINDS = 4 };

static double uniform(int state, int which)
{
    return one_lane_uniform(6, state, which);
}

/* General, nearly uniaxial, nearly a pressure, and of two equal values. */
static lane_sym3 random_stress(int state)
{
    const double size = 1e6 * pow(10, 3 * uniform(state, 8));
    const double a[3] = {uniform(state, 0), uniform(state, 1), uniform(state, 2)};
    const double shift = state % 4 == 2 ? 2 * uniform(state, 9) : 0, little = state % 4 == 0 ? 1 : 1e-3,
                 dyad = state % 2 ? uniform(state, 10) : 0;
    return (lane_sym3){size * (shift + dyad * a[0] * a[0] + little * uniform(state, 3)),
                       size * (shift + dyad * a[1] * a[1] + little * uniform(state, 4)),
                       size * (shift + dyad * a[2] * a[2] + little * uniform(state, 5)),
                       size * (dyad * a[1] * a[2] + little * uniform(state, 6)),
                       size * (dyad * a[0] * a[2] + little * uniform(state, 7)),
                       size * (dyad * a[0] * a[1] + little * uniform(state, 11))};
}

static const struct {
    failure_limits limit;
    failure_shear shear;
} kind[KINDS] = {
    {{50e6, 0, 0}, {0, 0, 0}},
    {{50e6, 400e6, 0}, {0, 0, 0}},
    {{80e6, 0, 60e6}, {0, 0.5, 0.5}},
    {{0, 300e6, 40e6}, {1, 0.2, 0.4}},
};

static failure_scale scale_of(int k)
{
    const failure_limits l = kind[k].limit;
    return (failure_scale){l.tension > 0 ? 1 / l.tension : 0, l.compression > 0 ? 1 / l.compression : 0,
                           l.shear > 0 ? 1 / l.shear : 0, kind[k].shear.drucker_prager, kind[k].shear.slope};
}

static double ratio_of(lane_sym3 s, int k)
{
    return failure_of(failure_principal_of((failure_stress){s.xx, s.yy, s.zz, s.yz, s.xz, s.xy}), kind[k].limit,
                      kind[k].shear)
        .ratio;
}

/* To some roundings of the tensor's own size; the host leaves 1e-3. */
static double size_of(lane_sym3 s, int k)
{
    return 10 * (fabs(s.xx) + fabs(s.yy) + fabs(s.zz) + fabs(s.yz) + fabs(s.xz) + fabs(s.xy)) *
           (scale_of(k).tension + scale_of(k).compression + scale_of(k).shear);
}

static void no_ratio_is_above_its_bound(void **state)
{
    (void)state;
    for (int k = 0; k < KINDS; ++k)
        for (int i = 0; i < STATES; ++i) {
            const lane_sym3 s = random_stress(i);
            assert_true(failure_bound(s, scale_of(k)) >= ratio_of(s, k) - 1e-15 * size_of(s, k));
        }
}

/* What fracture_check relies on: the ratio of a mean of six is below the mean of their bounds. */
static void the_mean_of_bounds_bounds_the_mean(void **state)
{
    (void)state;
    for (int k = 0; k < KINDS; ++k)
        for (int i = 0; i + 6 < STATES; ++i) {
            lane_sym3 mean = {0, 0, 0, 0, 0, 0};
            double bound = 0, volume = 0, size = 0;
            for (int m = 0; m < 6; ++m) {
                const double v = 1.5 + uniform(i + m, 12);
                const lane_sym3 s = random_stress(i + m);
                mean = lane_sym3_add(mean, (lane_sym3){v * s.xx, v * s.yy, v * s.zz, v * s.yz, v * s.xz, v * s.xy});
                bound += v * failure_bound(s, scale_of(k));
                size += v * size_of(s, k);
                volume += v;
            }
            mean = (lane_sym3){mean.xx / volume, mean.yy / volume, mean.zz / volume,
                               mean.yz / volume, mean.xz / volume, mean.xy / volume};
            assert_true(bound / volume >= ratio_of(mean, k) - 1e-15 * size / volume);
        }
}

static void it_is_exact_in_uniaxial_tension_and_close_in_shear(void **state)
{
    (void)state;
    const failure_scale scale = scale_of(0);
    assert_true(fabs(failure_bound((lane_sym3){25e6, 0, 0, 0, 0, 0}, scale) - 0.5) < 1e-15);
    assert_true(fabs(failure_bound((lane_sym3){0, 10e6, 10e6, 10e6, 0, 0}, scale) - 0.4) <
                1e-15); /* pull of 20 MPa between y and z */
    const double shear = failure_bound((lane_sym3){0, 0, 0, 0, 50e6, 0}, scale);
    assert_true(shear >= 1 && shear < 1.027); /* 16/9 / sqrt 3 */
    assert_true(failure_bound((lane_sym3){0, 0, 0, 0, 0, 0}, scale) == 0);
    assert_true(failure_bound((lane_sym3){-1e6, -1e6, -1e6, 0, 0, 0}, scale) == 0);
}

/* Outer principal values from above, within 2e-5 of 2 sqrt(J2/3). Rounding: 1e-12 of the tensor's own size; and where
 * two values are nearly equal, c is off by some 1e-15 of the size over the deviator, y by the root of that. */
static void outer_values_are_bounded_closely(void **state)
{
    (void)state;
    for (int i = 0; i < STATES; ++i) {
        lane_sym3 s = random_stress(i);
        if (i % 3 == 0) s = (lane_sym3){s.xx, s.xx, s.zz, 0, 0, 0}; /* two are equal */
        const failure_principal p = failure_principal_of((failure_stress){s.xx, s.yy, s.zz, s.yz, s.xz, s.xy});
        const failure_outer of = failure_outer_of(s);
        const double a = p.first - p.second, b = p.second - p.third, c = p.first - p.third,
                     root = 2 * sqrt((a * a + b * b + c * c) / 18), most = fmax(fabs(p.first), fabs(p.third)),
                     size = 1e-12 * most + sqrt(1e-15 * most * root);
        assert_true(of.first >= p.first - size && of.first <= p.first + 2e-5 * root + size);
        assert_true(of.third >= -p.third - size && of.third <= -p.third + 2e-5 * root + size);
    }
    const failure_outer none = failure_outer_of((lane_sym3){0, 0, 0, 0, 0, 0});
    assert_true(none.first == 0 && none.third == 0);
}

/* What fracture_spared relies on: lambda is above s1, and x.A x between a1 cos^2 and a1 cos^2 + slack, with a1 of the
 * principal values. Entries of A are of up to 16 sizes, of which sums of some 20 products keep 1e-13; a1 is a
 * difference of values that are right to 1e-15 of the size, times another of up to 4. Most states have values far
 * enough apart. */
static void the_share_of_a_direction_lies_between_its_bounds(void **state)
{
    (void)state;
    int known = 0;
    for (int i = 0; i < STATES; ++i) {
        const lane_sym3 s = random_stress(i);
        const failure_stress sigma = {s.xx, s.yy, s.zz, s.yz, s.xz, s.xy};
        const failure_principal p = failure_principal_of(sigma);
        const failure_leading lead = failure_leading_of(sigma);
        const double size =
            fmax(fmax(fmax(fabs(s.xx), fabs(s.yy)), fmax(fabs(s.zz), fabs(s.yz))), fmax(fabs(s.xz), fabs(s.xy)));
        if (!lead.known) continue;
        known += 1;
        assert_true(lead.first >= p.first - 1e-13 * size && lead.slack >= 0);
        const double a1 = (lead.first - p.second) * (lead.first - p.third) / (size * size);
        for (int k = 0; k < 8; ++k) {
            const failure_axis n = p.first_axis;
            failure_axis x = {uniform(i, 20 + 3 * k), uniform(i, 21 + 3 * k), uniform(i, 22 + 3 * k)};
            if (k < 2) x = failure_mix(1, n, k ? 1e-3 : 1e-6, x); /* along the axis, nearly */
            const double square = x.x * x.x + x.y * x.y + x.z * x.z, product = x.x * n.x + x.y * n.y + x.z * n.z;
            const double own = a1 * product * product / square, share = failure_leading_share(lead, x, 1 / square);
            assert_true(share >= own - 1e-12 && share <= own + lead.slack + 1e-12);
        }
    }
    assert_true(known > STATES / 2);
}

/* Two equal largest values have no axis: the slack is all there is. One value alone at the top leaves none but that for
 * rounding. */
static void of_equal_largest_values_no_direction_is_told_from_another(void **state)
{
    (void)state;
    assert_false(failure_leading_of((failure_stress){0, 0, 0, 0, 0, 0}).known);
    assert_false(failure_leading_of((failure_stress){3e6, 3e6, 3e6, 0, 0, 0}).known);
    const failure_leading two = failure_leading_of((failure_stress){3e6, 3e6, 1e6, 0, 0, 0});
    assert_true(!two.known || failure_leading_share(two, (failure_axis){1, 0, 0}, 1) <= two.slack);
    const failure_leading one = failure_leading_of((failure_stress){3e6, 1e6, 1e6, 0, 0, 0});
    assert_true(one.known && fabs(one.first - 3e6) < 1e-8 && one.slack < 1e-11);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_ratio_is_above_its_bound),
        cmocka_unit_test(the_mean_of_bounds_bounds_the_mean),
        cmocka_unit_test(it_is_exact_in_uniaxial_tension_and_close_in_shear),
        cmocka_unit_test(outer_values_are_bounded_closely),
        cmocka_unit_test(the_share_of_a_direction_lies_between_its_bounds),
        cmocka_unit_test(of_equal_largest_values_no_direction_is_told_from_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
