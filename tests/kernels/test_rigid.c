/* Rigid bodies that turn: against exact solutions of Euler's equations. Double, one body; and eight side by side, as
 * cells do. */
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on
#include <math.h>
#define BRC_PRECISION 0
#define BRC_LANES 8
#define BRC_SLICE 8
#define BRC_MANY_MATERIALS 0
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpsabi"
#include "../../kernels/effects/contact/convex_overlap.h"
#include "../../kernels/core/rigid.h"
#include "../../kernels/effects/contact/contact_place.cl"
#include "../../kernels/effects/contact/contact_rigid.cl"

static const squat UPRIGHT = {1, 0, 0, 0};

static double length(svec3 a)
{
    return sqrt(svec3_dot(a, a));
}
static double apart(svec3 a, svec3 b)
{
    return length(svec3_add(a, svec3_scale(-1, b)));
}
/* Largest difference of what two rotations do to the axes. */
static double differ(squat a, squat b)
{
    const svec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double most = 0;
    for (int k = 0; k < 3; ++k)
        most = fmax(most, apart(rigid_rotate(a, axis[k]), rigid_rotate(b, axis[k])));
    return most;
}
static squat turn_about(svec3 axis, double angle)
{
    const double s = sin(angle / 2) / length(axis);
    return (squat){cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

/* R I R^T by columns. */
static ssym3 turned_by(squat q, const double moment[3])
{
    const svec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    ssym3 i = {0, 0, 0, 0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const svec3 r = rigid_rotate(q, axis[k]);
        i.xx += moment[k] * r.x * r.x, i.yy += moment[k] * r.y * r.y, i.zz += moment[k] * r.z * r.z;
        i.yz += moment[k] * r.y * r.z, i.xz += moment[k] * r.x * r.z, i.xy += moment[k] * r.x * r.y;
    }
    return i;
}

/* Three different moments, axes askew. Each step rounds the energy a few times by 1e-16: at most 1e5 * 20 * 1.1e-16 =
 * 2e-10 if all pointed one way; a second-order scheme without the invariant would be off by (h w)^2 = 4e-4. */
static void a_top_without_torque_keeps_its_energy_over_1e5_steps(void **state)
{
    (void)state;
    const ssym3 own = turned_by(turn_about((svec3){1, 2, 0.5}, 0.7), (double[3]){1, 2, 2.7});
    const svec3 l = {0.3, 2.1, 0.4};
    squat q = UPRIGHT;
    const double before = 0.5 * svec3_dot(l, rigid_spin(q, own, l));
    double off = 0, turned = 0;
    for (int k = 0; k < 100000; ++k) {
        q = rigid_drift(q, own, l, 0.02);
        off = fmax(off, fabs(0.5 * svec3_dot(l, rigid_spin(q, own, l)) - before));
        turned = fmax(turned, differ(q, UPRIGHT));
    }
    assert_true(off < 2e-10 * before);
    assert_true(turned > 1); /* or this would show little */
    assert_true(fabs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-15);
}

/* I1 = I2: q(t) = exp(l t / 2 I1) exp(e3 (w3 - l3 / I1) t / 2), e3 the axis of the body. */
static squat symmetric_top(double i1, double i3, svec3 l, double t)
{
    const svec3 axis = {0, 0, 1};
    return squat_mul(turn_about(l, length(l) / i1 * t), turn_about(axis, (l.z / i3 - l.z / i1) * t));
}

static double symmetric_error(double h, int steps)
{
    const ssym3 own = {1, 1, 1.8, 0, 0, 0};
    const svec3 l = {0.5, 0.2, 1.1};
    squat q = UPRIGHT;
    for (int k = 0; k < steps; ++k)
        q = rigid_drift(q, own, l, h);
    return differ(q, symmetric_top(1, 1.8, l, h * steps));
}

/* Second order: halving the step divides the error by 4, up to terms of (h w)^2 = 4e-3 of it. */
static void a_symmetric_top_follows_its_exact_path_to_second_order(void **state)
{
    (void)state;
    const double coarse = symmetric_error(0.05, 200), fine = symmetric_error(0.025, 400);
    assert_true(coarse > 1e-5 && coarse < 0.05 * 0.05 * 10); /* (h w)^2 times the angle */
    assert_true(fabs(coarse / fine - 4) < 0.05);
}

/* sn, cn, dn of parameter m by the descending Landen transformation (arithmetic-geometric mean). */
static void elliptic(double u, double m, double *sn, double *cn, double *dn)
{
    double a[12], c[12], phi;
    int n = 0;
    double b = sqrt(1 - m);
    a[0] = 1, c[0] = sqrt(m);
    while (fabs(c[n]) > 1e-16 && n < 11) {
        a[n + 1] = 0.5 * (a[n] + b);
        c[n + 1] = 0.5 * (a[n] - b);
        b = sqrt(a[n] * b);
        ++n;
    }
    phi = ldexp(a[n] * u, n);
    for (int k = n; k > 0; --k)
        phi = 0.5 * (phi + asin(c[k] / a[k] * sin(phi)));
    *sn = sin(phi), *cn = cos(phi), *dn = sqrt(1 - m * *sn * *sn);
}

/* Moments I1 < I2 < I3, spin at first in the plane of axes 1 and 3, momentum above that of the middle axis: w1 = a cn,
 * w2 = b sn, w3 = c dn (Landau and Lifshitz, Mechanics, section 37). */
static double asymmetric_error(double h, int steps)
{
    const double i1 = 1, i2 = 2, i3 = 2.7, w1 = 0.4, w3 = 0.9;
    const ssym3 own = {i1, i2, i3, 0, 0, 0};
    const svec3 l = {i1 * w1, 0, i3 * w3};
    const double twice = i1 * w1 * w1 + i3 * w3 * w3, square = svec3_dot(l, l);
    assert_true(square > twice * i2);
    const double rate = sqrt((i3 - i2) * (square - twice * i1) / (i1 * i2 * i3)),
                 m = (i2 - i1) * (twice * i3 - square) / ((i3 - i2) * (square - twice * i1));
    const double second = sqrt((twice * i3 - square) / (i2 * (i3 - i2)));
    double sn, cn, dn;
    squat q = UPRIGHT;
    for (int k = 0; k < steps; ++k)
        q = rigid_drift(q, own, l, h);
    elliptic(rate * h * steps, m, &sn, &cn, &dn);
    const svec3 w = rigid_rotate(rigid_back(q), rigid_spin(q, own, l));
    return apart(w, (svec3){w1 * cn, second * sn, w3 * dn});
}

static void an_asymmetric_top_follows_jacobis_functions_to_second_order(void **state)
{
    (void)state;
    const double coarse = asymmetric_error(0.05, 400), fine = asymmetric_error(0.025, 800);
    assert_true(coarse > 1e-6 && coarse < 0.05 * 0.05 * 20);
    assert_true(fabs(coarse / fine - 4) < 0.05);
}

/* 1000 products of quaternions, a rounding each. */
static void a_ball_turns_exactly(void **state)
{
    (void)state;
    const ssym3 own = {0.4, 0.4, 0.4, 0, 0, 0};
    const svec3 l = {0.1, -0.2, 0.3};
    squat q = UPRIGHT;
    for (int k = 0; k < 1000; ++k)
        q = rigid_drift(q, own, l, 0.1);
    assert_true(differ(q, turn_about(l, length(l) / 0.4 * 100)) < 1000 * 4e-16);
}

/* Moments of a grain of 1e-21 kg m^2 have no cube in single precision, and hardly a square: the solution is scaled. */
static void moments_are_solved_at_any_size(void **state)
{
    (void)state;
    const ssym3 own = {1e-110, 2e-110, 2.7e-110, 0.3e-110, -0.2e-110, 0.4e-110};
    const svec3 w = rigid_solve(own, (svec3){1e-110, -3e-110, 2e-110});
    const svec3 back = {own.xx * w.x + own.xy * w.y + own.xz * w.z, own.xy * w.x + own.yy * w.y + own.yz * w.z,
                        own.xz * w.x + own.yz * w.y + own.zz * w.z};
    assert_true(apart(back, (svec3){1e-110, -3e-110, 2e-110}) < 1e-124);
}

/* Kicked and turned by the kernel of cells: each as it would be alone, to the last bit, whatever turns beside it; what
 * is not rigid keeps what it has. */
static void cells_side_by_side_turn_as_each_does_alone(void **state)
{
    (void)state;
    enum { N = 24 };
    int rigid[N];
    double inertia[6 * N], torque[3 * N], reach[N], momentum[3 * N], turned[4 * N], way[N], momentum_before[3 * N],
        turned_before[4 * N];
    const double kick = 0.01, drift = 0.02, extra = 4e-5;
    for (int e = 0; e < N; ++e) {
        const squat q = turn_about((svec3){1, e % 5, -0.5}, 0.3 * e);
        const ssym3 own = turned_by(q, (double[3]){1, 1 + 0.1 * (e % 7), 2});
        const double at[4] = {q.w, q.x, q.y, q.z}, moment[6] = {own.xx, own.yy, own.zz, own.yz, own.xz, own.xy};
        rigid[e] = e < 16 && e % 3 != 1; /* the last eight have none */
        reach[e] = 0.1;
        way[e] = 0;
        for (int k = 0; k < 3; ++k)
            momentum[3 * e + k] = momentum_before[3 * e + k] = e % 4 == 0 ? 0 : pow(10, -(e % 4)) * (k + 1 - 0.2 * e),
                             torque[3 * e + k] = 0.3 * k - 0.1;
        for (int k = 0; k < 4; ++k)
            turned[4 * e + k] = turned_before[4 * e + k] = at[k];
        for (int k = 0; k < 6; ++k)
            inertia[6 * e + k] = e == 1 ? 0 : moment[k]; /* a row without an element has none */
    }
    contact_turn(N / 8, kick, drift, extra, rigid, inertia, torque, reach, momentum, turned, way);
    for (int e = 0; e < N; ++e) {
        const svec3 t = svec3_load(torque, 3 * (size_t)e),
                    l = svec3_add_scaled(svec3_load(momentum_before, 3 * (size_t)e), kick, t);
        const squat was = squat_load(turned_before, e);
        const squat q =
            rigid[e] ? rigid_drift(was, ssym3_load(inertia, e), svec3_add_scaled(l, extra / drift, t), drift) : was;
        const svec3 kept = rigid[e] ? l : svec3_load(momentum_before, 3 * (size_t)e);
        assert_memory_equal(momentum + 3 * e, &kept, sizeof kept);
        assert_memory_equal(turned + 4 * e, &q, sizeof q);
        /* how far a point of a cell of radius 0.1 can have come: the chord; of three axes one makes at least sqrt(2/3)
         * of the largest, none makes more. 1e-15: roundings */
        const double seen = 0.1 * differ(q, was);
        assert_true(rigid[e] ? way[e] > seen - 1e-15 && way[e] < sqrt(1.5) * (1 + 2e-6) * seen + 1e-15 : way[e] == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_top_without_torque_keeps_its_energy_over_1e5_steps),
        cmocka_unit_test(a_symmetric_top_follows_its_exact_path_to_second_order),
        cmocka_unit_test(an_asymmetric_top_follows_jacobis_functions_to_second_order),
        cmocka_unit_test(a_ball_turns_exactly),
        cmocka_unit_test(moments_are_solved_at_any_size),
        cmocka_unit_test(cells_side_by_side_turn_as_each_does_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
