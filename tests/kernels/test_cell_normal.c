/* The room of a bond of dlsm below its limit: it spares no bond whose half of the stress is above the limit, and spares
 * those that are clearly below. One lane, double. */
#include "one_lane.h"
#include "../../kernels/models/dlsm/cell_normal.h"
#include <stdbool.h>

enum { STATES = 20000 };

static const double lambda = 2e10, mu = 3e10;

static double uniform(int state, int which)
{
    return one_lane_uniform(6, state, which);
}

/* A half of a bond: H of some size turned by any angle, P of another gradient of that size, the jump of a third, as
 * misfits of cells may be. */
typedef struct half_bond {
    lane_mat3 gradient, stress;
    lane_vec3 branch, jump;
    double strain; /* size of the gradients [-] */
} half_bond;

static lane_mat3 random_matrix(int state, int from, double size)
{
    double x[9];
    for (int k = 0; k < 9; ++k)
        x[k] = size * uniform(state, from + k);
    return (lane_mat3){x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8]};
}

/* R (1 + stretch) - 1, R a turn about z. */
static lane_mat3 turned(lane_mat3 stretch, double angle)
{
    const double c = cos(angle), s = sin(angle), versed = -2 * sin(0.5 * angle) * sin(0.5 * angle);
    const lane_mat3 turn = {c, -s, 0, s, c, 0, 0, 0, 1}, change = {versed, -s, 0, s, versed, 0, 0, 0, 0};
    return lane_mat3_add(lane_mat3_mul(turn, stretch), change);
}

static half_bond random_half(int state)
{
    half_bond b;
    b.strain = pow(10, -4 + 3.3 * fabs(uniform(state, 60))); /* up to a fifth */
    const double angle = state % 3 ? M_PI * uniform(state, 61) : 0;
    const lane_mat3 own = random_matrix(state, 0, b.strain),
                    other = lane_mat3_add(own, random_matrix(state, 9, 0.5 * b.strain)),
                    third = lane_mat3_add(own, random_matrix(state, 18, 0.5 * b.strain));
    const lane_mat3 g = turned(other, angle);
    b.gradient = turned(own, angle);
    b.stress = push_forward(g, svk_stress(green_strain(g, 1), lambda, mu), 1);
    b.branch = (lane_vec3){1e-3 * uniform(state, 30), 1e-3 * uniform(state, 31), 1e-3 * uniform(state, 32)};
    b.jump = lane_mat3_mul_vec(turned(third, angle), b.branch);
    return b;
}

static double half_stress(const half_bond *b)
{
    const double inverse = cell_inverse_square(b->branch);
    return cell_half_stress(b->gradient, b->stress, lambda + 2 * mu, b->branch,
                            cell_bond_strain(b->branch, b->jump, inverse, 1), inverse, 1);
}
static double linear_half_stress(const half_bond *b)
{
    const double inverse = cell_inverse_square(b->branch);
    return cell_half_stress(b->gradient, b->stress, lambda + 2 * mu, b->branch,
                            cell_bond_strain(b->branch, b->jump, inverse, 0), inverse, 0);
}

/* By the linearised law: what a turn w x adds to gradient and jump changes nothing but the last digits of it, times
 * lambda + 2 mu; and where nothing turns, so that strains are all there is, the full law is off by their square, some
 * ten products of entries below 1.5 strains each. */
static void small_turns_change_no_linear_stress(void **state)
{
    (void)state;
    for (int k = 0; k < STATES; ++k) {
        half_bond b = random_half(3 * k); /* not turned */
        b.stress = push_forward(b.gradient, svk_stress(green_strain(b.gradient, 0), lambda, mu), 0);
        const double before = linear_half_stress(&b);
        half_bond full = b;
        full.stress = push_forward(b.gradient, svk_stress(green_strain(b.gradient, 1), lambda, mu), 1);
        assert_true(fabs(half_stress(&full) - before) < 100 * (lambda + 2 * mu) * b.strain * b.strain);
        const lane_vec3 w = {uniform(k, 70), uniform(k, 71), uniform(k, 72)};
        const lane_mat3 turn = {0, -w.z, w.y, w.z, 0, -w.x, -w.y, w.x, 0};
        b.gradient = lane_mat3_add(b.gradient, turn);
        b.jump = lane_vec3_add(b.jump, lane_mat3_mul_vec(turn, b.branch));
        assert_true(fabs(linear_half_stress(&b) - before) < 1e-14 * (lambda + 2 * mu));
    }
}

static double room(const half_bond *b, double limit)
{
    return cell_room(cell_side_of(b->gradient, b->stress, lambda + 2 * mu), b->branch, b->jump, limit);
}

/* Limits from a hair to a factor of ten below the half's stress. */
static void no_half_above_its_limit_has_room(void **state)
{
    (void)state;
    int n = 0;
    for (int k = 0; k < STATES; ++k) {
        const half_bond b = random_half(k);
        const double tau = half_stress(&b);
        if (!(tau > 0)) continue;
        ++n;
        assert_true(room(&b, tau * (1 - 1e-6)) < 0);
        assert_true(room(&b, tau * (0.55 + 0.45 * uniform(k, 62))) < 0);
    }
    assert_true(n > STATES / 4);
}

/* What is lost: 1e-3 of the limit, which rounding may take, and the pull times 1/stretch - 1, twice (the bound's and
 * the stress' own), where the stretch of gradients of entries up to e is within 1 +- (3 e + 4.5 e^2) (Frobenius' norm),
 * and the pull below 3 (3 lambda + 2 mu) times that. */
static void halves_clearly_below_their_limit_have_room(void **state)
{
    (void)state;
    int n = 0;
    for (int k = 0; k < STATES; ++k) {
        const half_bond b = random_half(k);
        const double e = 1.5 * b.strain, norm = 3 * e + 4.5 * e * e;
        if (norm > 0.2) continue;
        ++n;
        const double lost = 2 * (1 / sqrt(1 - 2 * norm) - 1) * 3 * (3 * lambda + 2 * mu) * norm, tau = half_stress(&b);
        assert_true(room(&b, (fmax(tau, 0) + lost) / 0.998 + 1) > 0);
    }
    assert_true(n > STATES / 2);
}

/* Nothing is looked at for padding: a missing bond, whose branch is none and whose limit is never reached. */
static void missing_bonds_have_no_room_to_lose(void **state)
{
    (void)state;
    half_bond b = random_half(1);
    b.branch = b.jump = (lane_vec3){0, 0, 0};
    assert_true(room(&b, 1e30) >= 0);
}

/* A cell pressed flat: what its bonds hold cannot be told from its stretch, so they are looked at wherever it pulls at
 * all. */
static void cells_pressed_flat_are_looked_at(void **state)
{
    (void)state;
    half_bond b = {.gradient = {-0.999, 0, 0, 0, 0, 0, 0, 0, 0},
                   .stress = {1e9, 0, 0, 0, 1e9, 0, 0, 0, 1e9},
                   .branch = {0, 1e-3, 0}};
    assert_true(room(&b, 1e12) < 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_half_above_its_limit_has_room),
        cmocka_unit_test(halves_clearly_below_their_limit_have_room),
        cmocka_unit_test(missing_bonds_have_no_room_to_lose),
        cmocka_unit_test(cells_pressed_flat_are_looked_at),
        cmocka_unit_test(small_turns_change_no_linear_stress),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
