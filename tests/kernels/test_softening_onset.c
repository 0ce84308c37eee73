/* What draws a face open as a piece of a wider crack (softening_onset.cl), against sums over the principal parts of
 * made-up stresses. One lane, double. */
#include "one_lane.h"
#pragma GCC diagnostic ignored "-Wunused-parameter" /* kernels have those of all their passes, of any lanes */
#pragma GCC diagnostic ignored "-Wunused-variable"
#include "../../kernels/kernels.h"

/* A frame of three unit vectors, its rows. */
typedef struct frame {
    double a[3][3];
} frame;
static frame frame_of(int k)
{
    frame f;
    double *u = f.a[0], *v = f.a[1], *w = f.a[2], size = 0, along = 0, rest = 0;
    for (int c = 0; c < 3; ++c)
        u[c] = one_lane_uniform(11, k, c), size += u[c] * u[c];
    for (int c = 0; c < 3; ++c)
        u[c] /= sqrt(size), v[c] = one_lane_uniform(11, k, 3 + c), along += u[c] * v[c];
    for (int c = 0; c < 3; ++c)
        v[c] -= along * u[c], rest += v[c] * v[c];
    for (int c = 0; c < 3; ++c)
        v[c] /= sqrt(rest);
    for (int c = 0; c < 3; ++c)
        w[c] = u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
    return f;
}
static failure_stress stress_of(const frame *f, const double *value)
{
    double s[3][3] = {{0}};
    for (int k = 0; k < 3; ++k)
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                s[r][c] += value[k] * f->a[k][r] * f->a[k][c];
    return (failure_stress){s[0][0], s[1][1], s[2][2], s[1][2], s[0][2], s[0][1]};
}
static double along(const double *f, soft_vector a)
{
    return f[0] * a.x + f[1] * a.y + f[2] * a.z;
}

/* Any stress, any normal, any axis: the pull is that of the pulling parts alone, 0 more than 45 degrees off; along the
 * stress's own axis it is the largest principal value, and never above what the look lets through; pushes lay on the
 * plane what they do. Rounding: principal values and axes by rotations, 1e-11 of the largest value. */
static void a_pull_is_that_of_the_pulling_parts_over_the_projection(void **state)
{
    (void)state;
    int steep = 0, more = 0;
    for (int k = 0; k < 100000; ++k) {
        const frame f = frame_of(k), g = frame_of(200000 + k);
        double value[3], most = 0, pull = 0, pushed = 0;
        for (int c = 0; c < 3; ++c)
            value[c] = 8e6 * one_lane_uniform(12, k, c), most = fmax(most, fabs(value[c]));
        if (k % 3 == 0) value[1] *= -20, most = fmax(most, fabs(value[1]));
        const failure_principal at = failure_principal_of(stress_of(&f, value));
        const soft_vector n = {g.a[0][0], g.a[0][1], g.a[0][2]};
        const double lean = 0.9 * (k % 7) / 3.0;
        const soft_vector axis =
            soft_unit((soft_vector){n.x + lean * g.a[1][0], n.y + lean * g.a[1][1], n.z + lean * g.a[1][2]});
        const double cosine = soft_dot(n, axis);
        for (int c = 0; c < 3; ++c) {
            const double x = along(f.a[c], axis);
            pull += fmax(value[c], 0) * along(f.a[c], n) * x;
            pushed += pow(fmin(value[c], 0) * x, 2);
        }
        const double drawn = soft_pull_along(at, n, axis), largest = fmax(fmax(value[0], value[1]), value[2]);
        assert_true(drawn == soft_pull_along(at, n, soft_scale(-1, axis))); /* axes have no side */
        if (cosine < sqrt(0.5)) {
            assert_true(drawn == 0);
            steep += 1;
        } else {
            assert_true(fabs(drawn - pull / cosine) <= 1e-11 * most);
            assert_true(largest <= 0 || drawn * SOFT_DRAWN_LEAST <= largest * (1 + 1e-6));
            assert_true(drawn <= soft_pull_at_most(at, n) + 1e-11 * most);
            more += drawn > 1.1 * largest;
        }
        assert_true(fabs(soft_pushed(at, axis) - pushed) <= 1e-11 * most * most);
        const soft_vector own = {at.first_axis.x, at.first_axis.y, at.first_axis.z};
        if (fabs(soft_dot(own, n)) > 0.7072 && largest > 0)
            assert_true(fabs(soft_pull_along(at, n, own) - largest) <= 1e-11 * most);
    }
    assert_true(steep > 10000 && more > 1000); /* all were tried */
}

/* A cell among three others, of stresses that differ by as much as the largest: the axis is that of the mean of two
 * cells and of all neighbours together, unless the cells bear less than half of the limit, or are pushed along another
 * plane. */
static void a_face_is_drawn_along_the_axis_of_the_cells_around(void **state)
{
    (void)state;
    enum { N = 5 };
    const int row_start[] = {0, 4}, neighbour[] = {1, 2, 3, 0}; /* the last slot has no face */
    const double gradient[9 * N] = {0};
    int around = 0, local = 0;
    for (int k = 0; k < 20000; ++k) {
        const frame f = frame_of(k);
        const double value[] = {8e6, 2e6 * one_lane_uniform(13, k, 0), k % 2 ? -4e7 : -1e5};
        const failure_stress mean = stress_of(&f, value);
        double stress[9 * N];
        failure_stress sum = mean;
        for (int j = 0; j < N; ++j) {
            const frame g = frame_of(400000 + N * k + j);
            const double uneven[] = {9e6, 3e6, -6e6};
            const failure_stress more = stress_of(&g, uneven);
            double *p = stress + 9 * j;
            p[0] = mean.xx + more.xx, p[4] = mean.yy + more.yy, p[8] = mean.zz + more.zz;
            p[1] = p[3] = mean.xy + more.xy, p[2] = p[6] = mean.xz + more.xz, p[5] = p[7] = mean.yz + more.yz;
            if (j == 0 || j == 4) continue;
            sum.xx += p[0], sum.yy += p[4], sum.zz += p[8], sum.xy += p[1], sum.xz += p[2], sum.yz += p[5];
        }
        const soft_vector n = soft_unit(
            (soft_vector){f.a[0][0] + 0.3 * f.a[1][0], f.a[0][1] + 0.3 * f.a[1][1], f.a[0][2] + 0.3 * f.a[1][2]});
        const failure_stress wide = soft_add_around(mean, 0, row_start, neighbour, gradient, stress);
        assert_true(fabs(wide.xx - sum.xx) + fabs(wide.yz - sum.yz) + fabs(wide.xy - sum.xy) < 1e-6);
        const failure_principal at = failure_principal_of(mean), whole = failure_principal_of(sum);
        const soft_vector axis = {whole.first_axis.x, whole.first_axis.y, whole.first_axis.z};
        const int is_pushed = soft_pushed(at, axis) > 0.01 * 64e12;
        const double drawn = soft_drawn(wide, at, n, 8e6);
        assert_true(is_pushed ? drawn == 0 : fabs(drawn - soft_pull_along(at, n, axis)) < 1e-5);
        around += drawn > 0, local += is_pushed;
        assert_true(!soft_bridges(mean, 8e6) && soft_bridges(mean, 1.7e7));
    }
    assert_true(around > 2000 && local > 5000); /* both were tried */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pull_is_that_of_the_pulling_parts_over_the_projection),
        cmocka_unit_test(a_face_is_drawn_along_the_axis_of_the_cells_around),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
