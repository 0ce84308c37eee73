/* One beam of model cbm: forces against the gradient of the energy, action and reaction, rigid motion, analytic beams.
 * One lane, double. */
#include "one_lane.h"
#include "../../kernels/models/cbm/cbm_beam.h"

static const cbm_stiffness STIFF = {3.0, 0.7, 0.4}; /* of a beam about as long as 1 */

typedef struct beam {
    lane_vec3 branch;
    double u[2][3];
    lane_quat q[2];
} beam;

static double uniform(int state, int which)
{
    return one_lane_uniform(3, state, which);
}

static lane_quat unit(double w, double x, double y, double z)
{
    const double length = sqrt(w * w + x * x + y * y + z * z);
    return (lane_quat){w / length, x / length, y / length, z / length};
}

/* A beam with sections turned by up to some 60 degrees, random signs of the quaternions. */
static beam random_beam(int state)
{
    beam b = {.branch = {1 + 0.5 * uniform(state, 0), uniform(state, 1), uniform(state, 2)}};
    for (int side = 0; side < 2; ++side) {
        for (int c = 0; c < 3; ++c)
            b.u[side][c] = 0.1 * uniform(state, 3 + 3 * side + c);
        const double sign = uniform(state, 20 + side) < 0 ? -1 : 1;
        b.q[side] = unit(sign, 0.3 * sign * uniform(state, 9 + 3 * side), 0.3 * sign * uniform(state, 10 + 3 * side),
                         0.3 * sign * uniform(state, 11 + 3 * side));
    }
    return b;
}

/* The beam as element `side` sees it. */
static cbm_shape seen_from(const beam *b, int side, double *inverse, int finite)
{
    const double sign = side == 0 ? 1 : -1;
    const lane_vec3 branch = lane_vec3_scale(sign, b->branch);
    const double *near = b->u[side], *far = b->u[1 - side];
    *inverse = 1 / sqrt(lane_vec3_dot(branch, branch));
    return cbm_beam_shape(branch, *inverse, (lane_vec3){far[0] - near[0], far[1] - near[1], far[2] - near[2]},
                          b->q[side], b->q[1 - side], finite);
}

static cbm_end end_of(const beam *b, int side, int finite)
{
    double inverse;
    const cbm_shape shape = seen_from(b, side, &inverse, finite);
    return cbm_beam_law(shape, inverse, STIFF, finite);
}

static double energy_by(beam b, int finite)
{
    double inverse;
    const cbm_shape shape = seen_from(&b, 0, &inverse, finite);
    return cbm_beam_energy(shape, inverse, STIFF, finite);
}
static double energy_of(beam b)
{
    return energy_by(b, 1);
}

/* Degree of freedom d (side, then 3 displacements and 3 rotations) moved by h. */
static beam moved(beam b, int d, double h)
{
    const int side = d / 6, c = d % 6;
    if (c < 3) {
        b.u[side][c] += h;
    } else {
        const double s = sin(h / 2);
        b.q[side] = quat_mul((lane_quat){cos(h / 2), c == 3 ? s : 0, c == 4 ? s : 0, c == 5 ? s : 0}, b.q[side]);
    }
    return b;
}

static void forces_and_torques_are_the_gradient_of_the_energy(void **state)
{
    (void)state;
    /* Central differences of fourth order with h = 1e-3: truncation about h^4 = 1e-12 of an energy of order 1, rounding
     * 1e-16 / h. */
    const double h = 1e-3;
    for (int k = 0; k < 200; ++k) {
        const beam b = random_beam(k);
        for (int d = 0; d < 12; ++d) {
            const double near = energy_of(moved(b, d, h)) - energy_of(moved(b, d, -h));
            const double far = energy_of(moved(b, d, 2 * h)) - energy_of(moved(b, d, -2 * h));
            const double slope = (8 * near - far) / (12 * h);
            const cbm_end end = end_of(&b, d / 6, 1);
            const double own[6] = {end.force.x, end.force.y, end.force.z, end.torque.x, end.torque.y, end.torque.z};
            assert_true(fabs(-slope - own[d % 6]) < 1e-9);
        }
    }
}

static void the_two_ends_balance_in_force_and_moment(void **state)
{
    (void)state;
    for (int k = 0; k < 200; ++k) {
        const beam b = random_beam(k);
        const cbm_end one = end_of(&b, 0, 1), two = end_of(&b, 1, 1);
        const lane_vec3 f = lane_vec3_add(one.force, two.force);
        const lane_vec3 now = {b.branch.x + b.u[1][0] - b.u[0][0], b.branch.y + b.u[1][1] - b.u[0][1],
                               b.branch.z + b.u[1][2] - b.u[0][2]};
        const lane_vec3 t = lane_vec3_add(lane_vec3_add(one.torque, two.torque), lane_vec3_cross(now, two.force));
        /* some ten roundings of numbers of order 1 to 10 */
        assert_true(lane_vec3_dot(f, f) < 1e-28 && lane_vec3_dot(t, t) < 1e-28);
    }
}

static void rigid_motion_costs_nothing(void **state)
{
    (void)state;
    for (int k = 0; k < 50; ++k) {
        beam b = random_beam(k);
        b.q[1] = b.q[0] = b.q[0].w < 0 ? (lane_quat){-b.q[0].w, -b.q[0].x, -b.q[0].y, -b.q[0].z} : b.q[0];
        const lane_vec3 turned = quat_rotate_minus_identity(b.q[0], b.branch, 1);
        b.u[1][0] = b.u[0][0] + turned.x, b.u[1][1] = b.u[0][1] + turned.y, b.u[1][2] = b.u[0][2] + turned.z;
        const cbm_end end = end_of(&b, 0, 1);
        /* rounding of the turned branch, about 5e-16, times stiffnesses of order 10 */
        assert_true(lane_vec3_dot(end.force, end.force) < 1e-28 && lane_vec3_dot(end.torque, end.torque) < 1e-28);
    }
}

static void the_linear_law_is_the_slope_of_the_full_one_at_rest(void **state)
{
    (void)state;
    const double h = 1e-6; /* the laws differ by h relative */
    beam b = {.branch = {0.6, -0.3, 0.8}};
    for (int d = 0; d < 12; ++d) {
        b.q[0] = b.q[1] = (lane_quat){1, 0, 0, 0};
        const beam full = moved(b, d, h);
        beam small = full;
        if (d % 6 >= 3) small.q[d / 6].w = 1; /* (1, theta / 2) */
        for (int side = 0; side < 2; ++side) {
            const cbm_end f = end_of(&full, side, 1), l = end_of(&small, side, 0);
            const lane_vec3 df = lane_vec3_sub(f.force, l.force), dt = lane_vec3_sub(f.torque, l.torque);
            assert_true(sqrt(lane_vec3_dot(df, df)) < 100 * h * h && sqrt(lane_vec3_dot(dt, dt)) < 100 * h * h);
        }
    }
}

/* Of a linear law the energy is half the work of what the ends are moved and turned by, however far (Clapeyron); of
 * numbers of order 10 some ten roundings. */
static void the_linear_energy_is_half_the_work_of_the_ends(void **state)
{
    (void)state;
    for (int k = 0; k < 200; ++k) {
        beam b = random_beam(k);
        double work = 0;
        for (int side = 0; side < 2; ++side)
            b.q[side].w = 1; /* (1, theta / 2) */
        for (int side = 0; side < 2; ++side) {
            const cbm_end end = end_of(&b, side, 0);
            work -= end.force.x * b.u[side][0] + end.force.y * b.u[side][1] + end.force.z * b.u[side][2] +
                    2 * (end.torque.x * b.q[side].x + end.torque.y * b.q[side].y + end.torque.z * b.q[side].z);
        }
        assert_true(fabs(energy_by(b, 0) - 0.5 * work) < 1e-14);
    }
}

static void a_single_beam_is_that_of_euler_and_bernoulli(void **state)
{
    (void)state;
    /* Along x, length 2: E S / l, 12 E I / l^3, 6 E I / l^2, 4 and 2 E I / l, G J / l with E I = bend / 2. Linear law:
     * exact to rounding. */
    beam b = {.branch = {2, 0, 0}, .q = {{1, 0, 0, 0}, {1, 0, 0, 0}}};
    const double ei = STIFF.bend / 2, l = 2;
    b.u[1][0] = 1e-3;
    assert_true(fabs(end_of(&b, 0, 0).force.x - STIFF.axial / l * 1e-3) < 1e-18);
    b.u[1][0] = 0, b.u[1][1] = 1e-3;
    assert_true(fabs(end_of(&b, 0, 0).force.y - 12 * ei / (l * l * l) * 1e-3) < 1e-18);
    assert_true(fabs(end_of(&b, 0, 0).torque.z - 6 * ei / (l * l) * 1e-3) < 1e-18);
    b.u[1][1] = 0, b.q[0].z = 0.5e-3;
    assert_true(fabs(end_of(&b, 0, 0).torque.z + 4 * ei / l * 1e-3) < 1e-18);
    assert_true(fabs(end_of(&b, 1, 0).torque.z + 2 * ei / l * 1e-3) < 1e-18);
    b.q[0].z = 0, b.q[1].x = 0.5e-3;
    assert_true(fabs(end_of(&b, 0, 0).torque.x - STIFF.twist / l * 1e-3) < 1e-18);
}

static void a_missing_neighbour_does_nothing(void **state)
{
    (void)state;
    const lane_quat q = unit(1, 0.2, -0.3, 0.4);
    const cbm_shape shape = cbm_beam_shape((lane_vec3){1, 0, 0}, 0, (lane_vec3){0, 0, 0}, q, q, 1);
    const cbm_end end = cbm_beam_law(shape, 0, STIFF, 1);
    assert_true(end.force.x == 0 && end.force.y == 0 && end.force.z == 0 && end.torque.x == 0 && end.torque.y == 0 &&
                end.torque.z == 0);
    assert_true(cbm_beam_energy(shape, 0, STIFF, 1) == 0 && cbm_beam_energy(shape, 0, STIFF, 0) == 0);
}

/* Fitted near no stretch, by root and quotient beyond: a few roundings off the exact one at either side of the limit,
 * for the smallest stretch too. */
static void the_shortening_keeps_its_digits_at_any_stretch(void **state)
{
    (void)state;
    double most = 0;
    for (int k = -400; k <= 300; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double x = sign * (k < 0 ? pow(10, k / 25.) : 0.9 * pow(2, -k / 20.)); /* dense about 2^-7 */
            const long double square = 1 + (long double)x, exact = x / (sqrtl(square) + square);
            most = fmax(most, fabs((double)((cbm_shortened(x) - exact) / exact)));
        }
    assert_true(most < 4 * 0x1p-53);
    const double limit = 0x1p-7; /* the two sides of the limit join within their roundings */
    assert_true(fabs(cbm_shortened(limit) - cbm_shortened(limit * (1 - 0x1p-53))) < 8 * 0x1p-53 * limit);
    assert_true(cbm_shortened(0) == 0);
    assert_true(isnan(cbm_shortened(NAN)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_and_torques_are_the_gradient_of_the_energy),
        cmocka_unit_test(the_two_ends_balance_in_force_and_moment),
        cmocka_unit_test(rigid_motion_costs_nothing),
        cmocka_unit_test(the_linear_law_is_the_slope_of_the_full_one_at_rest),
        cmocka_unit_test(the_linear_energy_is_half_the_work_of_the_ends),
        cmocka_unit_test(a_single_beam_is_that_of_euler_and_bernoulli),
        cmocka_unit_test(a_missing_neighbour_does_nothing),
        cmocka_unit_test(the_shortening_keeps_its_digits_at_any_stretch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
