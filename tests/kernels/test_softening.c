/* The cohesive law of one face (softening.h). One lane, double. */
#include "one_lane.h"
#include "../../kernels/models/dlsm/sliding.h"

static const soft_face faces[] = {{3, 0.7, 0}, {3, 0.7, 1}};

/* Simpson's rule is exact for the linear law and good to 1e-10 for the exponential one in 1000 pieces. */
static void the_area_under_the_law_is_the_fracture_energy(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        const double end = soft_end(faces[k]);
        double sum = 0;
        for (int i = 0; i < 1000; ++i)
            for (int j = 0; j < 3; ++j) {
                const double w = (i + 0.5 * j) * end / 1000 * (1 - 1e-15);
                sum += (j == 1 ? 4 : 1) * soft_force(faces[k], w) * end / 6000;
            }
        assert_true(fabs(sum - 0.7) < 1e-9);
        assert_true(fabs(soft_force(faces[k], 0) - 3) < 1e-12 && soft_force(faces[k], end) == 0);
    }
}

/* A Taylor sum of ten terms at x / 32 <= 0.16 is good to 1e-14, its 32nd power to 1e-12. */
static void the_decay_is_the_exponential_function(void **state)
{
    (void)state;
    for (double x = 0; x <= 5; x += 0.01)
        assert_true(fabs(soft_decay(x) / exp(-x) - 1) < 1e-12);
}

static void slopes_are_those_of_the_force(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k)
        for (double w = 0.05; w < 0.4; w += 0.05) {
            const double h = 1e-5, slope = (soft_force(faces[k], w + h) - soft_force(faces[k], w - h)) / (2 * h);
            assert_true(fabs(slope - soft_slope(faces[k], w)) <
                        1e-6 * 30); /* h^2 times a third derivative of some ten */
        }
}

/* What no closing gives back, by Simpson's rule as above. */
static void spent_is_the_area_under_the_law_less_the_triangle(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k)
        for (int i = 1; i <= 20; ++i) {
            const double end = soft_end(faces[k]), w = i * end / 20;
            double sum = 0;
            for (int j = 0; j < 1000; ++j)
                for (int m = 0; m < 3; ++m)
                    sum += (m == 1 ? 4 : 1) * soft_force(faces[k], (j + 0.5 * m) * w / 1000 * (1 - 1e-15)) * w / 6000;
            assert_true(fabs(soft_spent(faces[k], w) - (i < 20 ? sum - 0.5 * soft_force(faces[k], w) * w : 0.7)) <
                        1e-9);
        }
}

/* Mohr-Coulomb on the face itself, and the plane of the stress that is nearer to it; what a face hands on beside a
 * plane sums to nothing over a zig-zag along it. */
static void faces_slide_by_mohr_coulomb(void **state)
{
    (void)state;
    const double phi = M_PI / 6, c = 2, p = 3, tau = c + p * tan(phi);
    const soft_vector n = {0, 1, 0}, traction = {tau, -p, 0};
    const failure_stress stress = {
        -p - 2 * tau * tan(phi), -p, -4, 0, 0, tau}; /* Mohr's circle touches the line at the face */
    const failure_principal principal = failure_principal_of(stress);
    const failure_state own = soft_slip(principal, traction, n, -2 * c * cos(phi), sin(phi)),
                        all = soft_slip(principal, traction, n, 2 * c * cos(phi), sin(phi));
    const soft_vector plane = soft_slip_plane(all, n);
    assert_true(fabs(own.ratio - 1) < 1e-12 && fabs(all.ratio - 1) < 1e-12);
    assert_true(fabs(plane.x) < 1e-7 && fabs(plane.y - 1) < 1e-12); /* from cosines */
    assert_true(fabs(soft_slide_start(traction, n, 0.3) - (tau - 0.3 * p)) < 1e-12);
    const lane_sym3 same = {stress.xx, stress.yy, stress.zz, stress.yz, stress.xz, stress.xy};
    const lane_vec3 across = {n.x, n.y, n.z}, up = {0.7, 1, 0.2}, down = {-0.7, 2, -0.2},
                    sum = lane_vec3_add(soft_passed(same, across, up), soft_passed(same, across, down));
    assert_true(lane_vec3_dot(sum, sum) < 1e-24);
}

/* First opening, unloading to the origin and reloading: cells and cohesion pull alike, to rounding of the load. */
static void openings_balance(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k)
        for (double stiffness = 20; stiffness < 1e4; stiffness *= 3)
            for (double widest = 0; widest < 0.4; widest += 0.1)
                for (double drive = 0.5; drive < 2 * stiffness; drive *= 1.5) {
                    const double w = soft_opening(faces[k], widest, drive, stiffness, LANE_ALL);
                    const double force =
                        w > widest || widest == 0 ? soft_force(faces[k], w) : soft_force(faces[k], widest) * w / widest;
                    if (w == 0)
                        assert_true(drive <= 3);
                    else
                        assert_true(fabs(stiffness * w + force - drive) < 1e-9 * (drive + 3));
                }
}

/* Half the product of force and opening comes back, and nothing at the end. */
static void unloading_gives_back_the_secant_energy(void **state)
{
    (void)state;
    const double end = soft_end(faces[0]), w = 0.25 * end;
    assert_true(fabs(soft_held(faces[0], w, w) - 0.5 * w * 0.75 * 3) < 1e-12);
    assert_true(fabs(soft_held(faces[0], w, 0.5 * w) - 0.25 * soft_held(faces[0], w, w)) < 1e-12);
    assert_true(soft_held(faces[0], end, end) == 0 && soft_held(faces[0], 0, 0) == 0);
}

static void energy_follows_the_direction_of_the_opening(void **state)
{
    (void)state;
    assert_true(soft_tilt(0.9, 0.95, 0.5) == 1);
    assert_true(fabs(soft_tilt(0.9, 0.6, 0.5) - 0.6 / 0.9) < 1e-15);
    assert_true(fabs(soft_tilt(0.9, -0.2, 0.5) - 0.5 / 0.9) < 1e-15);
}

/* ---- in three dimensions ---- */

static coeff draw(uint64_t *state) /* -1 to 1 */
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (coeff)(*state >> 11) / 4503599627370496.0 - 1;
}
static lane_vec3 draw_vector(uint64_t *state)
{
    return (lane_vec3){draw(state), draw(state), draw(state)};
}

/* Ten openings, of faces all around a cell: 2 V psi = V (lambda tr^2 + 2 mu E:E), E the strain of all, is at most the
 * sum over faces of opening . k opening. */
static void stiffness_of_a_cell_is_from_above(void **state)
{
    (void)state;
    uint64_t seed = 1;
    const double lambda[] = {-0.6, 0, 1, 9, 49}; /* nu -0.75 to 0.49 with mu 1 */
    for (int trial = 0; trial < 2000; ++trial) {
        lane_vec3 pull[10], opening[10];
        double reach = 0, bound = 0, h[3][3] = {{0}};
        const double l = lambda[trial % 5];
        for (int f = 0; f < 10; ++f) {
            pull[f] = draw_vector(&seed), opening[f] = draw_vector(&seed);
            reach += sqrt(lane_vec3_dot(pull[f], pull[f]));
            const double w[3] = {opening[f].x, opening[f].y, opening[f].z}, a[3] = {pull[f].x, pull[f].y, pull[f].z};
            for (int i = 0; i < 9; ++i)
                h[i / 3][i % 3] += w[i / 3] * a[i % 3];
        }
        for (int f = 0; f < 10; ++f) {
            const lane_sym3 k = soft_cell_stiffness(pull[f], reach, 0.5, l + 2, 1);
            bound += lane_vec3_dot(opening[f], lane_sym3_mul_vec(k, opening[f]));
        }
        double trace = h[0][0] + h[1][1] + h[2][2], square = 0;
        for (int i = 0; i < 9; ++i)
            square += 0.25 * pow(h[i / 3][i % 3] + h[i % 3][i / 3], 2);
        assert_true(0.5 * (l * trace * trace + 2 * square) <= bound * (1 + 1e-12));
        assert_true(bound >= 0);
    }
}

/* Along the opening cells and cohesion pull alike, to the rounding of the load; begun again from where it came to, also
 * across it; and no face is shut further than shut. The direction gains on its axes' stiffnesses, which are at most 1 :
 * 40 here, by a factor at every turn: 200 of them. */
static void openings_balance_in_every_direction(void **state)
{
    (void)state;
    uint64_t seed = 7;
    int n_across = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const soft_face f = faces[trial % 2];
        const lane_vec3 some = draw_vector(&seed), normal = lane_vec3_scale(1 / sqrt(lane_vec3_dot(some, some)), some),
                        shut = {0, 0, 0}, drive = lane_vec3_scale(20, draw_vector(&seed));
        lane_sym3 k = {15, 15, 15, 0, 0, 0};
        for (int side = 0; side < 2; ++side)
            k = lane_sym3_add(k, soft_cell_stiffness(draw_vector(&seed), 4, 1, 5, 1));
        lane_vec3 w = soft_balance(f, 0, drive, k, 0, normal, shut, 0, shut, 0);
        for (int turn = 0; turn < 200; ++turn) {
            const double size = sqrt(lane_vec3_dot(w, w));
            if (!(size > 0)) break;
            const lane_vec3 left = lane_vec3_more(drive, -1, lane_sym3_mul_vec(k, w));
            assert_true(fabs(lane_vec3_dot(left, w) / size - soft_force(f, size)) < 1e-9 * 40);
            assert_true(lane_vec3_dot(w, normal) >= -1e-12 * size);
            w = soft_balance(f, 0, drive, k, soft_force(f, size) / size, normal, w, 0, shut, 0);
        }
        const double size = sqrt(lane_vec3_dot(w, w));
        if (!(size > 0) || !(lane_vec3_dot(w, normal) > 1e-9)) continue;
        const lane_vec3 left =
            lane_vec3_more(lane_vec3_more(drive, -1, lane_sym3_mul_vec(k, w)), -soft_force(f, size) / size, w);
        assert_true(sqrt(lane_vec3_dot(left, left)) < 1e-9 * 40);
        ++n_across;
    }
    assert_true(n_across > 100);
}

/* The force on the area: the stress along the crack, by its definition with eigenvectors (Jacobi rotations, failure.h),
 * without its pulls. */
static void a_crack_carries_the_pushes_along_it(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int trial = 0; trial < 1000; ++trial) {
        const lane_vec3 some = draw_vector(&seed), e = lane_vec3_scale(1 / sqrt(lane_vec3_dot(some, some)), some),
                        area = draw_vector(&seed);
        const lane_vec3 p = draw_vector(&seed), q = draw_vector(&seed);
        const failure_stress m =
            trial % 4 ? (failure_stress){p.x, p.y, p.z, q.x, q.y, q.z} : (failure_stress){p.x, p.x, p.x, 0, 0, 0};
        double s[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}, along[3][3] = {{0}},
               project[3][3], expected[3] = {0};
        const double axis[3] = {e.x, e.y, e.z}, on[3] = {area.x, area.y, area.z};
        for (int i = 0; i < 9; ++i)
            project[i / 3][i % 3] = (i / 3 == i % 3) - axis[i / 3] * axis[i % 3];
        for (int i = 0; i < 81; ++i)
            along[i / 27][i / 9 % 3] += project[i / 27][i / 3 % 3] * s[i / 3 % 3][i % 3] * project[i % 3][i / 9 % 3];
        const failure_principal value = failure_principal_of(
            (failure_stress){along[0][0], along[1][1], along[2][2], along[1][2], along[0][2], along[0][1]});
        /* one value is 0, of the axis; a third axis is across the other two */
        const failure_axis first = value.first_axis, third = value.third_axis;
        const double a[3] = {first.x, first.y, first.z}, c[3] = {third.x, third.y, third.z};
        const double b[3] = {c[1] * a[2] - c[2] * a[1], c[2] * a[0] - c[0] * a[2], c[0] * a[1] - c[1] * a[0]};
        const double second = along[0][0] + along[1][1] + along[2][2] - value.first - value.third;
        for (int i = 0; i < 9; ++i)
            expected[i / 3] +=
                on[i % 3] * (fmin(value.first, 0) * a[i / 3] * a[i % 3] + fmin(second, 0) * b[i / 3] * b[i % 3] +
                             fmin(value.third, 0) * c[i / 3] * c[i % 3]);
        const lane_vec3 got = soft_carried((lane_sym3){m.xx, m.yy, m.zz, m.yz, m.xz, m.xy}, e, area);
        assert_true(fabs(got.x - expected[0]) + fabs(got.y - expected[1]) + fabs(got.z - expected[2]) < 1e-12);
        assert_true(fabs(lane_vec3_dot(got, e)) < 1e-14);
    }
}

/* Along the face alone; within what is held not at all; beyond it without giving energy; and, between cells that are as
 * stiff in every direction, to the balance of what is left and the cohesion, to rounding; but no further than to where
 * their cells put the sides, and back to even where these put them the other way. */
static void sides_turn_until_they_pull_evenly(void **state)
{
    (void)state;
    const lane_vec3 normal = {0, 0.3, 0.4}, uneven = {2, -1, 0.5}, before = {0.02, 0, 0}, none = {0, 0, 0};
    const lane_vec3 along = soft_beside(uneven, normal), far = lane_vec3_scale(1e3, along);
    const double size = sqrt(lane_vec3_dot(along, along));
    const lane_sym3 cells = {40, 55, 70, 3, -5, 8}, alike = {50, 50, 50, 0, 0, 0};
    for (int k = 0; k < 2; ++k) {
        for (double widest = 0; widest < 0.3; widest += 0.07)
            for (double held = 0; held < 1.2 * size; held += 0.1 * size) {
                const lane_vec3 turn = soft_side(faces[k], widest, uneven, cells, none, far, held, normal, LANE_ALL);
                assert_true(fabs(lane_vec3_dot(turn, normal)) < 1e-14);
                assert_true(lane_vec3_dot(turn, along) >= 0);
                if (held > size) assert_true(lane_vec3_dot(turn, turn) == 0);
            }
        const double drawn = soft_force(faces[k], 0.1) / 0.1;
        const lane_vec3 turn = soft_side(faces[k], 0.1, uneven, alike, before, far, 0, normal, LANE_ALL);
        const lane_vec3 left =
            lane_vec3_more(lane_vec3_more(along, -50, turn), -drawn, lane_vec3_more(before, 1, turn));
        assert_true(lane_vec3_dot(left, left) < 1e-20);
        const lane_vec3 free = soft_side(faces[k], 0.1, uneven, alike, none, far, 0, normal, LANE_ALL);
        const double reach = sqrt(lane_vec3_dot(free, free));
        for (double share = -0.5; share < 2; share += 0.25) {
            const lane_vec3 lacks = lane_vec3_scale(share, free);
            const lane_vec3 to = soft_side(faces[k], 0.1, uneven, alike, none, lacks, 0, normal, LANE_ALL);
            assert_true(fabs(lane_vec3_dot(to, free) / reach - fmin(fmax(share, 0), 1) * reach) < 1e-15);
        }
        const lane_vec3 back = lane_vec3_scale(-0.1, free), home = lane_vec3_scale(-5, free);
        const lane_vec3 returns = soft_side(faces[k], 0.1, uneven, alike, back, home, 0, normal, LANE_ALL);
        assert_true(lane_vec3_dot(lane_vec3_add(returns, back), lane_vec3_add(returns, back)) < 1e-30);
        /* a face that has hardly opened stays, whatever the products of its secant would be */
        const lane_vec3 begins = soft_side(faces[k], 1e-300, uneven, alike, none, far, 0, normal, LANE_ALL);
        assert_true(lane_vec3_dot(begins, begins) == 0);
        /* a face that is shut opens at its edge once the unevenness is above what the cohesion starts with */
        const lane_vec3 weak = lane_vec3_scale(0.99 * 3 / size, along), strong = lane_vec3_scale(1.5 * 3 / size, along);
        const lane_vec3 shut = soft_side(faces[k], 0, weak, alike, none, far, 0, normal, LANE_ALL),
                        opens = soft_side(faces[k], 0, strong, alike, none, far, 0, normal, LANE_ALL);
        const double v = sqrt(lane_vec3_dot(opens, opens));
        assert_true(lane_vec3_dot(shut, shut) == 0);
        assert_true(v > 0 && fabs(50 * v + soft_force(faces[k], v) - 4.5) < 1e-9);
    }
}

/* A face that is pressed shut along its axis sticks below mu times the push and slides above it until its shear is mu
 * times the push. */
static void shut_faces_slide_by_coulomb(void **state)
{
    (void)state;
    const soft_face ended = {3, 0.7, 0};
    const double widest = soft_end(ended), mu = 0.3;
    const lane_vec3 axis = {0, 0, 1}, before = {0.02, 0.01, 0}, none = {0, 0, 0}, carried = {0.4, 0, 0};
    const lane_sym3 k = {30, 30, 30, 0, 0, 0};
    for (double shear = 0; shear < 4; shear += 0.1) {
        const lane_vec3 drive = lane_vec3_more((lane_vec3){shear, 0, -5}, 1, lane_sym3_mul_vec(k, before));
        const lane_vec3 now = soft_balance(ended, widest, drive, k, 0, axis, before, mu, none, 0);
        const lane_vec3 left = lane_vec3_more(drive, -1, lane_sym3_mul_vec(k, now));
        assert_true(fabs(now.z) < 1e-15);
        if (shear < mu * 5 * 0.999) assert_true(now.x == before.x && now.y == before.y);
        if (shear > mu * 5 * 1.001)
            assert_true(fabs(left.x - mu * 5) < 1e-12 && fabs(left.y) < 1e-12 && now.x > before.x);
    }
    const lane_vec3 free = soft_balance(ended, widest, (lane_vec3){1, 0, 3}, k, 0, axis, before, mu, none,
                                        0); /* pulled apart: nothing holds */
    assert_true(fabs(free.x - 1.0 / 30) < 1e-12 && fabs(free.z - 0.1) < 1e-12);
    /* held open: it opens along the axis alone until its shear is above what holds it */
    const lane_vec3 drive = lane_vec3_more((lane_vec3){0.4, 0, 3}, 1, lane_sym3_mul_vec(k, before));
    const lane_vec3 held = soft_balance(ended, widest, drive, k, 0, axis, before, 0, none, 0.5),
                    slid = soft_balance(ended, widest, drive, k, 0, axis, before, 0, none, 0.1);
    assert_true(fabs(held.x - before.x) < 1e-12 && fabs(held.y - before.y) < 1e-12 && fabs(held.z - 0.1) < 1e-12);
    assert_true(fabs(slid.x - before.x - 0.3 / 30) < 1e-12 && fabs(slid.y - before.y) < 1e-12 &&
                fabs(slid.z - 0.1) < 1e-12);
    /* carried: nothing slides while the shear lies between nothing and it; beyond it, or against it, only by what is
     * more */
    for (double shear = -0.6; shear < 1; shear += 0.1) {
        const lane_vec3 on = lane_vec3_more((lane_vec3){shear, 0, 3}, 1, lane_sym3_mul_vec(k, before)),
                        w = soft_balance(ended, widest, on, k, 0, axis, before, 0, carried, 0);
        const double more = shear > 0.4 ? shear - 0.4 : shear < 0 ? shear : 0;
        assert_true(fabs(w.x - before.x - more / 30) < 1e-12 && fabs(w.z - 0.1) < 1e-12);
        assert_true((w.x - before.x) * (shear - more) > -1e-15);
    }
    const lane_vec3 tilted = {0.6, 0, 0.8}, into = soft_outside((lane_vec3){-0.1, 0.02, 0.01}, tilted),
                    out = {0.1, 0, 0};
    assert_true(fabs(lane_vec3_dot(into, tilted)) < 1e-15 && into.y == 0.02 && soft_outside(out, tilted).x == 0.1);
    assert_true(!soft_is_clear((lane_vec3){0, 0, 0.09}, axis, 0.1) &&
                soft_is_clear((lane_vec3){0, 0, 0.1}, axis, 0.1) && soft_is_clear((lane_vec3){1, 0, 0}, axis, 0.1));
    assert_true(soft_is_clear(none, axis, 0)); /* without closure */
    assert_true(soft_keeps(0.1, 0) == 1 && fabs(soft_keeps(0.1, 0.4) - 0.75) < 1e-15 && soft_keeps(0.5, 0.4) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_area_under_the_law_is_the_fracture_energy),
        cmocka_unit_test(the_decay_is_the_exponential_function),
        cmocka_unit_test(slopes_are_those_of_the_force),
        cmocka_unit_test(openings_balance),
        cmocka_unit_test(unloading_gives_back_the_secant_energy),
        cmocka_unit_test(energy_follows_the_direction_of_the_opening),
        cmocka_unit_test(stiffness_of_a_cell_is_from_above),
        cmocka_unit_test(openings_balance_in_every_direction),
        cmocka_unit_test(a_crack_carries_the_pushes_along_it),
        cmocka_unit_test(shut_faces_slide_by_coulomb),
        cmocka_unit_test(sides_turn_until_they_pull_evenly),
        cmocka_unit_test(spent_is_the_area_under_the_law_less_the_triangle),
        cmocka_unit_test(faces_slide_by_mohr_coulomb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
