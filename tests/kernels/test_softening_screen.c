/* What lanes rule out before the stress of a bond is looked at (softening_screen.cl), against that look itself
 * (softening_onset.cl). One lane, double. */
#include "one_lane.h"
#pragma GCC diagnostic ignored "-Wunused-parameter" /* kernels have those of all their passes, of any lanes */
#pragma GCC diagnostic ignored "-Wunused-variable"
#include "../../kernels/kernels.h"

/* Two cells with the stresses and gradients of these, and a bond between them with any force. */
typedef struct bond {
    double gradient[18], stress[18], s[3], force[3], ratio;
} bond;

static failure_stress looked_at(const bond *b)
{
    const soft_vector s = {b->s[0], b->s[1], b->s[2]}, force = {b->force[0], b->force[1], b->force[2]};
    return soft_stress(soft_mean_stress(b->gradient, b->stress, 0, 1), soft_scale(1 / SQRT(soft_dot(s, s)), force),
                       soft_unit(soft_turned(b->gradient, 0, 1, s)));
}

static lane_mat3 of(const double *p)
{
    return (lane_mat3){p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8]};
}

static int ruled_in(const bond *b, double limit, double shear, double reach)
{
    const lane_mat3 h = of(b->gradient), g = of(b->gradient + 9);
    const lane_sym3 stress =
        lane_sym3_add(soft_present_stress(h, of(b->stress)), soft_present_stress(g, of(b->stress + 9)));
    const dlsm_pull pull = {
        .force = {b->force[0], b->force[1], b->force[2]}, .area = {b->s[0], b->s[1], b->s[2]}, .ratio = b->ratio};
    return soft_near(lane_mat3_add(h, g), stress, pull, (soft_bounds){limit, shear, reach});
}

/* Stresses of some MPa with pushes of up to twenty times as much, strains to a tenth, bonds of a millimetre. Nothing
 * that the look lets through is ruled out, and nothing is ruled in that stays below 0.99 of every limit: margins are
 * 0.1 and 0.2 %, and the largest principal value is exact in both. */
static void lanes_rule_out_what_the_look_does(void **state)
{
    (void)state;
    int in = 0, out = 0;
    for (int k = 0; k < 200000; ++k) {
        bond b;
        const double push = 1e7 * (1 + one_lane_uniform(7, k, 42)), size = 0.1 * fabs(one_lane_uniform(7, k, 43)),
                     limit = 8e6;
        for (int c = 0; c < 18; ++c) {
            b.gradient[c] = size * one_lane_uniform(7, k, c);
            b.stress[c] = 5e6 * one_lane_uniform(7, k, 18 + c) - (c % 9 == 4 ? push : 0);
        }
        for (int c = 0; c < 3; ++c) {
            b.s[c] = 1e-6 * one_lane_uniform(7, k, 36 + c);
            b.force[c] = 8 * one_lane_uniform(7, k, 39 + c);
        }
        b.ratio = 1e3;
        const failure_stress whole = looked_at(&b);
        const double first = failure_principal_of(whole).first;
        const int near = ruled_in(&b, limit, 0, 0);
        assert_true(near || !soft_possible(whole, 0, limit, 0, 0));
        assert_true(!near || first > 0.99 * limit);
        assert_true(ruled_in(&b, limit, 2e7, 1.4143 * 1.5) || !soft_possible(whole, 0, limit, 4e7, 0.5));
        assert_true(ruled_in(&b, limit, soft_half_of(-4e7), 1.4143 * 1.5) ||
                    !soft_possible(whole, 0, limit, -4e7, 0.5));
        in += near, out += !near;
    }
    assert_true(in > 20000 && out > 20000); /* both sides were tried */
    const bond missing = {.ratio = 0};      /* without a face, and with no limit: never */
    assert_false(ruled_in(&missing, CELLS_NEVER, 0, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lanes_rule_out_what_the_look_does)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
