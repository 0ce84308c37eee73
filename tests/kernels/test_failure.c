/* Principal values and directions, and limits on them. One lane, double. */
#include "one_lane.h"
#include "../../kernels/effects/fracture/failure.h"
#include <float.h>

enum { STATES = 2000 };

static double uniform(int state, int which)
{
    return one_lane_uniform(5, state, which);
}

/* Every kind of tensor: general, of one or two values, nearly so, of rank one, of very different sizes. */
static failure_stress random_stress(int state)
{
    const double size = pow(10, 12 * uniform(state, 8));
    failure_stress s = {size * uniform(state, 0), size * uniform(state, 1), size * uniform(state, 2),
                        size * uniform(state, 3), size * uniform(state, 4), size * uniform(state, 5)};
    const double small = state % 3 == 0 ? 0 : 1e-9;
    const double a[3] = {uniform(state, 0), uniform(state, 1), uniform(state, 2)};
    switch (state % 5) {
    case 1: /* nearly a pressure */
        s = (failure_stress){size, size * (1 + small), size, small * s.yz, small * s.xz, small * s.xy};
        break;
    case 2: /* a a^T: one value |a|^2, twice zero */
        s = (failure_stress){size * a[0] * a[0], size * a[1] * a[1], size * a[2] * a[2],
                             size * a[1] * a[2], size * a[0] * a[2], size * a[0] * a[1]};
        break;
    case 3: /* diagonal */ s.yz = s.xz = s.xy = 0; break;
    default: break;
    }
    return s;
}

static double norm(failure_stress s)
{
    return sqrt(s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + 2 * (s.yz * s.yz + s.xz * s.xz + s.xy * s.xy));
}

static failure_axis multiply(failure_stress s, failure_axis v)
{
    return (failure_axis){s.xx * v.x + s.xy * v.y + s.xz * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
                          s.xz * v.x + s.yz * v.y + s.zz * v.z};
}

static double dot(failure_axis a, failure_axis b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* What defines them, to rounding: a Jacobi sweep makes a few operations on numbers up to |s|, at most some ten
 * sweeps. */
static void principal_values_and_axes_satisfy_their_definition_for_every_kind_of_tensor(void **state)
{
    (void)state;
    const double rounding = 100 * DBL_EPSILON;
    for (int k = 0; k < STATES; ++k) {
        const failure_stress s = random_stress(k);
        const failure_principal p = failure_principal_of(s);
        const double value[3] = {p.first, p.second, p.third};
        const failure_axis axis[3] = {p.first_axis, p.second_axis, p.third_axis};
        assert_true(p.first >= p.second && p.second >= p.third);
        for (int i = 0; i < 3; ++i) {
            const failure_axis image = multiply(s, axis[i]);
            assert_true(fabs(image.x - value[i] * axis[i].x) <= rounding * norm(s));
            assert_true(fabs(image.y - value[i] * axis[i].y) <= rounding * norm(s));
            assert_true(fabs(image.z - value[i] * axis[i].z) <= rounding * norm(s));
            for (int j = 0; j < 3; ++j)
                assert_true(fabs(dot(axis[i], axis[j]) - (i == j)) <= rounding);
        }
    }
}

static void a_pressure_and_no_stress_have_axes_too(void **state)
{
    (void)state;
    const failure_principal none = failure_principal_of((failure_stress){0, 0, 0, 0, 0, 0});
    const failure_principal same = failure_principal_of((failure_stress){-7, -7, -7, 0, 0, 0});
    assert_true(none.first == 0 && none.third == 0 && same.first == -7 && same.third == -7);
    assert_true(none.first_axis.x == 1 && same.first_axis.x == 1 && same.third_axis.z == 1);
}

/* Pure shear xy of 3: principal values 3, 0, -3 along (1, 1, 0), z, (1, -1, 0). */
static void pure_shear_pulls_at_45_degrees(void **state)
{
    (void)state;
    const failure_principal p = failure_principal_of((failure_stress){0, 0, 0, 0, 0, 3});
    assert_true(fabs(p.first - 3) < 1e-15 && fabs(p.second) < 1e-15 && fabs(p.third + 3) < 1e-15);
    assert_true(fabs(p.first_axis.x - p.first_axis.y) < 1e-15 && fabs(fabs(p.first_axis.x) - sqrt(0.5)) < 1e-15);
}

static void the_larger_of_tension_and_compression_decides(void **state)
{
    (void)state;
    const failure_shear none = {0, 0, 0};
    const failure_principal p = failure_principal_of((failure_stress){4, 0, -30, 0, 0, 0});
    failure_state f = failure_of(p, (failure_limits){5, 50, 0}, none);
    assert_int_equal(f.mode, FAILURE_TENSION);
    assert_true(f.ratio == 0.8 && f.stress == 4 && fabs(f.normal.x) == 1);
    f = failure_of(p, (failure_limits){5, 25, 0}, none);
    assert_int_equal(f.mode, FAILURE_COMPRESSION);
    assert_true(f.ratio == 1.2 && f.stress == -30 && fabs(f.normal.z) == 1);
    f = failure_of(p, (failure_limits){0, 0, 0}, none);
    assert_true(f.mode == 0 && f.ratio == 0);
}

/* c 10, phi 30 deg: uniaxial compression fails at 2 c cos phi / (1 - sin phi) on a plane whose normal is 60 deg from
 * the axis. */
static const double COHESION = 10;
static failure_shear mohr(void)
{
    return (failure_shear){0, 0.5, 0.5};
}
static failure_limits mohr_limits(void)
{
    return (failure_limits){0, 0, 2 * COHESION * cos(M_PI / 6)};
}

static void mohr_coulomb_slides_on_its_plane(void **state)
{
    (void)state;
    const double strength = 2 * COHESION * cos(M_PI / 6) / (1 - 0.5);
    const failure_state f =
        failure_of(failure_principal_of((failure_stress){-strength, 0, -1e-9, 0, 0, 0}), mohr_limits(), mohr());
    assert_int_equal(f.mode, FAILURE_SHEAR);
    assert_true(fabs(f.ratio - 1) < 1e-9);
    assert_true(fabs(fabs(f.normal.x) - cos(M_PI / 3)) < 1e-12 && fabs(fabs(f.other.x) - cos(M_PI / 3)) < 1e-12);
    /* a bond along that normal is the best there is, one along the load is not */
    assert_true(fabs(failure_alignment(f, f.other, 1) - 1) < 1e-12);
    assert_true(failure_alignment(f, (failure_axis){3, 0, 0}, 1.0 / 3) < 0.51);
}

/* The cone touches the pyramid where two principal values are equal and larger than the third (compression). */
static void drucker_prager_meets_mohr_coulomb_in_triaxial_compression(void **state)
{
    (void)state;
    const double sine = 0.5, cosine = cos(M_PI / 6), k = 6 * COHESION * cosine / (sqrt(3) * (3 - sine));
    const failure_shear cone = {1, 2 * sine / (sqrt(3) * (3 - sine)), sine};
    for (int i = 0; i < 50; ++i) {
        const double confined = -40 * (uniform(i, 0) + 1);
        const double axial =
            confined - (2 * COHESION * cosine - 2 * sine * confined) / (1 - sine); /* where Mohr-Coulomb fails */
        const failure_principal p = failure_principal_of((failure_stress){confined, axial, confined, 0, 0, 0});
        assert_true(fabs(failure_of(p, mohr_limits(), mohr()).ratio - 1) < 1e-12);
        assert_true(fabs(failure_of(p, (failure_limits){0, 0, k}, cone).ratio - 1) < 1e-12);
    }
}

/* The quick test may send an element on that does not fail, but never keep one back that does. */
static void the_quick_test_overlooks_no_failure(void **state)
{
    (void)state;
    int failed = 0, kept = 0;
    for (int k = 0; k < STATES; ++k) {
        failure_stress s = random_stress(k);
        const double size = (1 + 0.6 * uniform(k, 12)) / norm(s); /* |s| around 1 */
        s = (failure_stress){size * s.xx, size * s.yy, size * s.zz, size * s.yz, size * s.xz, size * s.xy};
        const failure_limits limits[] = {{0.7, 0, 0}, {0, 0.9, 0}, {0.8, 2, 0}, {0, 0, 1.1}, {0.9, 0, 1.3}};
        for (int l = 0; l < 5; ++l)
            for (int drucker = 0; drucker < 2; ++drucker) {
                const failure_shear shear = {drucker, drucker ? 0.2 : 0.4, 0.4};
                const int fails = failure_of(failure_principal_of(s), limits[l], shear).ratio >= 1,
                          possible = failure_possible(s, limits[l], shear);
                assert_true(possible || !fails);
                failed += fails;
                kept += !possible;
            }
    }
    assert_true(failed > STATES && kept > STATES);                       /* both happen */
    const failure_stress pressed = {-100, -100.5, -99.5, 0.1, 0.1, 0.1}; /* pressure alone fails by no shear */
    assert_false(failure_possible(pressed, (failure_limits){0, 0, 1.1}, (failure_shear){0, 0.4, 0.4}));
    assert_false(failure_possible(pressed, (failure_limits){0, 0, 1.1}, (failure_shear){1, 0.2, 0.4}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(principal_values_and_axes_satisfy_their_definition_for_every_kind_of_tensor),
        cmocka_unit_test(a_pressure_and_no_stress_have_axes_too),
        cmocka_unit_test(pure_shear_pulls_at_45_degrees),
        cmocka_unit_test(the_larger_of_tension_and_compression_decides),
        cmocka_unit_test(mohr_coulomb_slides_on_its_plane),
        cmocka_unit_test(drucker_prager_meets_mohr_coulomb_in_triaxial_compression),
        cmocka_unit_test(the_quick_test_overlooks_no_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
