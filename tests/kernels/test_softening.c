/* The cohesive law of one face (kernels/softening.h). One lane, double. */
#include "one_lane.h"
#include "../../kernels/softening.h"

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
    for (double x = 0; x <= 5; x += 0.01) assert_true(fabs(soft_decay(x) / exp(-x) - 1) < 1e-12);
}

static void slopes_are_those_of_the_force(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k)
        for (double w = 0.05; w < 0.4; w += 0.05) {
            const double h = 1e-5, slope = (soft_force(faces[k], w + h) - soft_force(faces[k], w - h)) / (2 * h);
            assert_true(fabs(slope - soft_slope(faces[k], w)) < 1e-6 * 30); /* h^2 times a third derivative of some ten */
        }
}

/* First opening, unloading to the origin and reloading: cells and cohesion pull alike, to rounding of the load. */
static void openings_balance(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k)
        for (double stiffness = 20; stiffness < 1e4; stiffness *= 3)
            for (double widest = 0; widest < 0.4; widest += 0.1)
                for (double drive = 0.5; drive < 2 * stiffness; drive *= 1.5) {
                    const double w = soft_opening(faces[k], widest, drive, stiffness);
                    const double force = w > widest || widest == 0 ? soft_force(faces[k], w) : soft_force(faces[k], widest) * w / widest;
                    if (w == 0) assert_true(drive <= 3);
                    else assert_true(fabs(stiffness * w + force - drive) < 1e-9 * (drive + 3));
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
static soft_vector draw_vector(uint64_t *state) { return (soft_vector){draw(state), draw(state), draw(state)}; }

/* Ten openings, of faces all around a cell: 2 V psi = V (lambda tr^2 + 2 mu E:E), E the strain of all, is at most the sum over faces of opening . k opening. */
static void stiffness_of_a_cell_is_from_above(void **state)
{
    (void)state;
    uint64_t seed = 1;
    const double lambda[] = {-0.6, 0, 1, 9, 49}; /* nu -0.75 to 0.49 with mu 1 */
    for (int trial = 0; trial < 2000; ++trial) {
        soft_vector pull[10], opening[10];
        double reach = 0, bound = 0, h[3][3] = {{0}};
        const double l = lambda[trial % 5];
        for (int f = 0; f < 10; ++f) {
            pull[f] = draw_vector(&seed), opening[f] = draw_vector(&seed);
            reach += sqrt(soft_dot(pull[f], pull[f]));
            const double w[3] = {opening[f].x, opening[f].y, opening[f].z}, a[3] = {pull[f].x, pull[f].y, pull[f].z};
            for (int i = 0; i < 9; ++i) h[i / 3][i % 3] += w[i / 3] * a[i % 3];
        }
        for (int f = 0; f < 10; ++f) {
            const soft_tensor k = soft_add_cell((soft_tensor){0, 0, 0, 0, 0, 0}, pull[f], reach, 0.5, l + 2, 1);
            bound += soft_dot(opening[f], soft_tensor_times(k, opening[f]));
        }
        double trace = h[0][0] + h[1][1] + h[2][2], square = 0;
        for (int i = 0; i < 9; ++i) square += 0.25 * pow(h[i / 3][i % 3] + h[i % 3][i / 3], 2);
        assert_true(0.5 * (l * trace * trace + 2 * square) <= bound * (1 + 1e-12));
        assert_true(bound >= 0);
    }
}

/* Along the opening cells and cohesion pull alike, to the rounding of the load; begun again from where it came to, also across it; and no face is shut
 * further than shut. The direction gains on its axes' stiffnesses, which are at most 1 : 40 here, by a factor at every turn: 200 of them. */
static void openings_balance_in_every_direction(void **state)
{
    (void)state;
    uint64_t seed = 7;
    int n_across = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const soft_face f = faces[trial % 2];
        const soft_vector normal = draw_vector(&seed), drive = soft_scale(20, draw_vector(&seed));
        soft_tensor k = {15, 15, 15, 0, 0, 0};
        for (int side = 0; side < 2; ++side) k = soft_add_cell(k, draw_vector(&seed), 4, 1, 5, 1);
        soft_vector w = soft_balance(f, 0, drive, k, 0, normal);
        for (int turn = 0; turn < 200; ++turn) {
            const double size = sqrt(soft_dot(w, w));
            if (!(size > 0)) break;
            const soft_vector left = soft_add(drive, -1, soft_tensor_times(k, w));
            assert_true(fabs(soft_dot(left, w) / size - soft_force(f, size)) < 1e-9 * 40);
            assert_true(soft_dot(w, normal) >= -1e-12 * size);
            w = soft_balance(f, 0, drive, k, soft_force(f, size) / size, normal);
        }
        const double size = sqrt(soft_dot(w, w));
        if (!(size > 0) || !(soft_dot(w, normal) > 1e-9)) continue;
        const soft_vector left = soft_add(soft_add(drive, -1, soft_tensor_times(k, w)), -soft_force(f, size) / size, w);
        assert_true(sqrt(soft_dot(left, left)) < 1e-9 * 40);
        ++n_across;
    }
    assert_true(n_across > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_area_under_the_law_is_the_fracture_energy), cmocka_unit_test(the_decay_is_the_exponential_function),
        cmocka_unit_test(slopes_are_those_of_the_force),                 cmocka_unit_test(openings_balance),
        cmocka_unit_test(unloading_gives_back_the_secant_energy),        cmocka_unit_test(energy_follows_the_direction_of_the_opening),
        cmocka_unit_test(stiffness_of_a_cell_is_from_above),             cmocka_unit_test(openings_balance_in_every_direction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
