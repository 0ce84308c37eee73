/* What lanes rule out before the stress of a bond is looked at (softening_screen.cl), against that look itself
 * (softening_onset.cl). One lane, double. */
#include "one_lane.h"
#pragma GCC diagnostic ignored "-Wunused-parameter" /* kernels have those of all their passes, of any lanes */
#pragma GCC diagnostic ignored "-Wunused-variable"
#include "../../kernels/kernels.h"

static const double modulus = 3e7, ell = -0.1, beta = 0.7, one_plus_tau = 1.4;

/* Two cells with the stresses, gradients and fluxes of these, and a bond between them with any force. */
typedef struct bond {
    double gradient[18], stress[18], flux[18], s[3], force[3], ratio;
} bond;

/* What the look has of it but for the force, which stands in the bond. */
static soft_whole seen(const bond *b)
{
    const lane_vec3 s = {b->s[0], b->s[1], b->s[2]};
    const soft_cell own =
                        soft_cell_of(0, s, s, b->flux, NULL, b->gradient, b->stress, modulus, ell, beta, one_plus_tau),
                    beside =
                        soft_cell_of(1, s, s, b->flux, NULL, b->gradient, b->stress, modulus, ell, beta, one_plus_tau);
#define ROW(l) 0
    const lane_int none = LANE_MAKE(lane_int, ROW);
#undef ROW
    const soft_faces face = {none, none, none, s, b->ratio};
    const lane_vec3 uneven = soft_uneven(own.pulls, beside.pulls), apart = soft_sides_apart(face, own, beside),
                    normal = soft_turned(s, own.along_area, beside.along_area);
    return (soft_whole){.force = {b->force[0], b->force[1], b->force[2]},
                        .uneven = {uneven.x, uneven.y, uneven.z},
                        .apart = {apart.x, apart.y, apart.z},
                        .normal = soft_unit((soft_vector){normal.x, normal.y, normal.z}),
                        .mean = soft_first(soft_mean_stress(own, beside))};
}
static failure_stress looked_at(const bond *b)
{
    const soft_vector s = {b->s[0], b->s[1], b->s[2]};
    const soft_whole w = seen(b);
    return soft_stress(w.mean, soft_scale(1 / SQRT(soft_dot(s, s)), w.force), w.normal);
}

static lane_mat3 of(const double *p)
{
    return (lane_mat3){p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8]};
}

/* shear: 0 where no plane slides; slope: sin phi. */
static int ruled_in(const bond *b, double limit, double shear, double slope, double steepest)
{
    const lane_mat3 h = of(b->gradient), g = of(b->gradient + 9);
    const lane_sym3 stress =
        lane_sym3_add(soft_present_stress(h, of(b->stress)), soft_present_stress(g, of(b->stress + 9)));
    const dlsm_pull pull = {
        .force = {b->force[0], b->force[1], b->force[2]}, .area = {b->s[0], b->s[1], b->s[2]}, .ratio = b->ratio};
    return soft_near(lane_mat3_add(h, g), stress, pull, (soft_bounds){limit, shear, shear > 0, slope, steepest});
}

/* The edge of the face, of a material with these constants: as the look has it, and whether lanes rule it in. */
static double edge_of(const bond *b)
{
    const soft_whole w = seen(b);
    return soft_edge(w.uneven, w.apart, w.force, w.normal, (soft_vector){b->s[0], b->s[1], b->s[2]}, b->ratio);
}
static int edge_ruled_in(const bond *b, double limit)
{
    const dlsm_pull pull = {
        .force = {b->force[0], b->force[1], b->force[2]}, .area = {b->s[0], b->s[1], b->s[2]}, .ratio = b->ratio};
    return soft_near_edge(of(b->gradient), of(b->gradient + 9), of(b->flux), of(b->flux + 9), pull, limit, modulus, ell,
                          beta, one_plus_tau);
}

/* Stresses of some MPa with pushes of up to twenty times as much, strains to a tenth, bonds of a millimetre that carry
 * much or next to nothing. Nothing that may open is ruled out, by its stress or drawn along any axis; nothing is ruled
 * in that stays below 0.99 of what a bond is drawn open at: margins are 0.1 and 0.2 %. Nor does a bond open that the
 * traction rules out, or is an edge above the limit that is ruled out. */
static void lanes_rule_out_what_the_look_does(void **state)
{
    (void)state;
    int in = 0, out = 0, leaning = 0, edges = 0, no_edges = 0, spared = 0;
    for (int k = 0; k < 200000; ++k) {
        bond b;
        const double push = 1e7 * (1 + one_lane_uniform(7, k, 42)), size = 0.1 * fabs(one_lane_uniform(7, k, 43)),
                     limit = k % 2 ? 8e6 : 2e6;
        for (int c = 0; c < 18; ++c) {
            b.gradient[c] = size * one_lane_uniform(7, k, c);
            b.stress[c] = 5e6 * one_lane_uniform(7, k, 18 + c) - (c % 9 == 4 ? push : 0);
            b.flux[c] = 5e6 * one_lane_uniform(7, k, 44 + c);
        }
        for (int c = 0; c < 3; ++c) {
            b.s[c] = 1e-6 * one_lane_uniform(7, k, 36 + c);
            b.force[c] = (k % 2 ? 8 : 0.5) * one_lane_uniform(7, k, 39 + c);
        }
        b.ratio = 1e3;
        const failure_stress whole = looked_at(&b);
        const failure_principal largest = failure_principal_of(whole);
        const double first = largest.first;
        const soft_vector n = seen(&b).normal;
        const double across =
            fabs(n.x * largest.first_axis.x + n.y * largest.first_axis.y + n.z * largest.first_axis.z);
        const int near = ruled_in(&b, limit, 0, 0, 0), stands = ruled_in(&b, limit, 0, 0, 0.5);
        const double most = limit / SOFT_DRAWN_LEAST, drawn = soft_pull_at_most(largest, n);
        assert_true(near || !stands);
        assert_true(stands || !((first > most || drawn > most) && across >= 0.5));
        leaning += near && !stands;
        assert_true(edge_ruled_in(&b, limit) || edge_of(&b) < limit);
        if (edge_ruled_in(&b, limit))
            edges += 1;
        else
            no_edges += 1;
        assert_true(near || !(first > most || drawn > most));
        assert_true(!near || first > 0.99 * limit);
        spared += !near && soft_possible(whole, 0, limit, 0, 0);
        in += near, out += !near;
    }
    assert_true(in > 20000 && out > 20000 && leaning > 2000 && edges > 2000 && no_edges > 2000); /* all were tried */
    assert_true(spared > 1000);
    const bond missing = {.ratio = 0}; /* without a face, and with no limit: never */
    assert_false(ruled_in(&missing, CELLS_NEVER, 0, 0, 0.5) || edge_ruled_in(&missing, CELLS_NEVER));
}

/* Mohr and Coulomb's sum, at any pressure: of any plane, and of the face alone. The bound is from above, by 2e-5 of
 * 2 (J2/3)^(1/2) at most for either outer value, and 0.2 % of the limit: so pressure rules nothing in. */
static void lanes_rule_out_what_cannot_slide(void **state)
{
    (void)state;
    const double slope = 0.5, limit = 4e7, none = 1e12;
    int in = 0, out = 0, faces = 0, pressed = 0;
    for (int k = 0; k < 200000; ++k) {
        bond b = {.ratio = 1e3};
        const double pressure = k % 2 ? 0 : 2e8 * (1 + one_lane_uniform(9, k, 42)),
                     size = 2e7 * (1 + one_lane_uniform(9, k, 43));
        for (int c = 0; c < 18; ++c)
            b.stress[c] = size * one_lane_uniform(9, k, 18 + c) - (c % 9 % 4 == 0 ? pressure : 0);
        for (int c = 0; c < 3; ++c)
            b.s[c] = 1e-6 * one_lane_uniform(9, k, 36 + c);
        for (int c = 0; c < 3; ++c)
            b.force[c] = 10 * one_lane_uniform(9, k, 39 + c) - pressure * b.s[c];
        const failure_stress whole = looked_at(&b);
        const failure_principal p = failure_principal_of(whole);
        const soft_vector s = {b.s[0], b.s[1], b.s[2]}, n = seen(&b).normal,
                          traction =
                              soft_scale(1 / SQRT(soft_dot(s, s)), (soft_vector){b.force[0], b.force[1], b.force[2]});
        const double sum = limit * soft_slip(p, traction, n, limit, slope).ratio,
                     face = limit * soft_slip(p, traction, n, -limit, slope).ratio;
        const double a = p.first - p.second, c = p.second - p.third, d = p.first - p.third,
                     root = 2 * sqrt((a * a + c * c + d * d) / 18); /* J2 is a sixth of the squares */
        const int near = ruled_in(&b, none, limit, slope, 0.5);
        assert_true(near || !(sum > limit || face > limit));
        assert_true(near || !soft_possible(whole, 0, none, -limit, slope) || sum < limit);
        assert_true(soft_possible(whole, 0, none, limit, slope) || !(sum > limit || face > limit));
        assert_true(!near || sum > 0.998 * limit - 5e-5 * root);
        in += near, out += !near, faces += face > limit, pressed += pressure > 1e8 && !near;
    }
    assert_true(in > 10000 && out > 20000 && faces > 1000 && pressed > 20000); /* all were tried */
}

/* A cell looks at its bonds before its own stress is at a limit, not far below, whatever the pressure around. */
static void cells_look_before_they_slide(void **state)
{
    (void)state;
    const double slope = 0.5, weakest = 4e7, screen = 0.7;
    const int n_open[] = {0}, row_start[] = {0, 1};
    const coeff least[] = {1e12};
    int looks = 0, rests = 0;
    for (int k = 0; k < 20000; ++k) {
        const double pressure = 5e7 * (1 + one_lane_uniform(10, k, 9)), size = 2e7 * (1 + one_lane_uniform(10, k, 10));
        double s[9], norm = 0;
        for (int r = 0; r < 3; ++r)
            for (int c = r; c < 3; ++c)
                s[3 * r + c] = s[3 * c + r] = size * one_lane_uniform(10, k, 3 * r + c) - (r == c ? pressure : 0);
        for (int c = 0; c < 9; ++c)
            norm += s[c] * s[c];
        const lane_mat3 zero = {0, 0, 0, 0, 0, 0, 0, 0, 0};
        const soft_members found =
            soft_looking(members_of_group(0, row_start), zero, of(s), soft_present_stress(zero, of(s)), 1, screen, 1,
                         slope, weakest, n_open, least);
        const failure_principal p = failure_principal_of((failure_stress){s[0], s[4], s[8], s[5], s[2], s[1]});
        const double sum = (1 + slope) * p.first - (1 - slope) * p.third,
                     part = sqrt(2 + 2 * slope * slope) * sqrt(norm);
        assert_true(found.looking || sum + (1 / screen - 1) * part < weakest);
        assert_true(!found.looking || sum + 1.001 * (1 / screen - 1) * part > 0.999 * weakest);
        looks += found.looking, rests += !found.looking;
    }
    assert_true(looks > 2000 && rests > 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lanes_rule_out_what_the_look_does),
                                       cmocka_unit_test(lanes_rule_out_what_cannot_slide),
                                       cmocka_unit_test(cells_look_before_they_slide)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
