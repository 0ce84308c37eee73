#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/packing/bond_balance.h"
#include "../../../preprocess/packing/bond_search.h"
#include "../../../preprocess/packing/packing.h"

#include <stdlib.h>
#include <string.h>

enum { SPHERES = 2000 };
/* Two bonds' worth of what one bond adds to the sums, sqrt(14) mean lengths each (bond_balance.c): what whole bonds can
 * be asked for, in mean lengths. */
static const double LEFT = 8;

/* A packed cube and its bonds. */
typedef struct sample {
    brc_solid *solid;
    brc_packing packing;
    int32_t (*pair)[2];
    int64_t n_pairs;
    double growth, walls[BRC_BALANCE_PARTS];
} sample;

static void require(brc_context *context, brc_status status)
{
    if (status != BRC_OK) fail_msg("%s", brc_context_message(context));
}

static sample pack(brc_context *context, uint64_t seed, double coordination)
{
    const brc_shape cube = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}};
    const brc_fill fill = {.kind = BRC_FILL_PACKING,
                           .n_elements = SPHERES,
                           .seed = seed,
                           .radius_spread = 0.125,
                           .coordination = 6.2,
                           .tolerance = 0.02};
    sample s = {.n_pairs = (int64_t)(coordination * SPHERES / 2)};
    require(context, brc_solid_create(context, &cube, 1, &s.solid));
    require(context, brc_packing_make(context, s.solid, &fill, 1, &s.packing));
    brc_balance_of_walls(s.solid, s.packing.position, s.packing.radius, SPHERES, 1, s.walls);
    return s;
}

static void balance(brc_context *context, sample *s, int n_threads)
{
    require(context, brc_bond_balance(context, s->packing.position, s->packing.radius, SPHERES, s->n_pairs, s->walls,
                                      n_threads, &s->pair, &s->growth));
}

static void drop(sample *s)
{
    brc_memory_free(s->pair);
    brc_packing_free(&s->packing);
    brc_solid_free(&s->solid);
}

/* Sums over bonds of length times n_a^power and n_a n_b, over the mean length. */
typedef struct sums {
    double second[3], fourth[3], mixed[3];
} sums;

static sums sum_up(const sample *s)
{
    sums out = {{0}, {0}, {0}};
    double length = 0;
    for (int64_t b = 0; b < s->n_pairs; ++b) {
        const double *x = s->packing.position + 3 * (int64_t)s->pair[b][0],
                     *y = s->packing.position + 3 * (int64_t)s->pair[b][1];
        const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]}, l = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        length += l;
        for (int c = 0; c < 3; ++c) {
            out.second[c] += r[c] * r[c] / l;
            out.fourth[c] += pow(r[c] / l, 4) * l;
            out.mixed[c] += r[(c + 1) % 3] * r[(c + 2) % 3] / l;
        }
    }
    for (int c = 0; c < 3; ++c) {
        out.second[c] *= (double)s->n_pairs / length;
        out.fourth[c] *= (double)s->n_pairs / length;
        out.mixed[c] *= (double)s->n_pairs / length;
    }
    return out;
}

/* How far the three axes are apart, and the largest mixed sum. */
static void unevenness(const sample *s, double out[3])
{
    const sums of = sum_up(s);
    memset(out, 0, 3 * sizeof *out);
    for (int c = 0; c < 3; ++c) {
        out[0] = fmax(out[0], fabs(of.second[c] - of.second[(c + 1) % 3]));
        out[1] = fmax(out[1], fabs(of.fourth[c] - of.fourth[(c + 1) % 3]));
        out[2] = fmax(out[2], fabs(of.mixed[c]));
    }
}

/* Eight nodes of Gauss and Legendre along z and sixteen even angles integrate the products, of degree 8 at most,
 * exactly. */
static void harmonics_have_the_mean_square_one_and_are_orthogonal(void **state)
{
    static const double node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static const double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    double mean[BRC_BALANCE_PARTS] = {0}, product[BRC_BALANCE_PARTS][BRC_BALANCE_PARTS] = {{0}};
    (void)state;
    for (int k = 0; k < 8; ++k)
        for (int m = 0; m < 16; ++m) {
            const double z = k < 4 ? node[k] : -node[k - 4], w = weight[k % 4] / 32, across = sqrt(1 - z * z),
                         angle = 0.3 + m * 3.14159265358979324 / 8;
            const double n[3] = {across * cos(angle), across * sin(angle), z};
            double part[BRC_BALANCE_PARTS];
            brc_balance_harmonics(n, part);
            for (int a = 0; a < BRC_BALANCE_PARTS; ++a) {
                mean[a] += w * part[a];
                for (int b = 0; b < BRC_BALANCE_PARTS; ++b)
                    product[a][b] += w * part[a] * part[b];
            }
        }
    for (int a = 0; a < BRC_BALANCE_PARTS; ++a) {
        assert_true(fabs(mean[a]) < 1e-12);
        for (int b = 0; b < BRC_BALANCE_PARTS; ++b)
            assert_true(fabs(product[a][b] - (a == b)) < 1e-12);
    }
}

/* In the sums of this test the rest of 8 mean lengths weighs 2 / sqrt(15) = 0.52 (x^2 - y^2), 0.26 (x y) and, of x^4 -
 * y^4 = 6/7 (2/sqrt(15)) Y - 1/7 (4 / (3 sqrt(5))) Y', 0.45. */
static void balanced_bonds_are_alike_along_all_axes_and_nearest_pairs_are_not(void **state)
{
    static const double coordination[3] = {6, 8, 11};
    double plain = 0;
    for (int k = 0; k < 3; ++k) {
        sample s = pack(*state, 1 + (uint64_t)k, coordination[k]);
        double left[3];
        balance(*state, &s, 1);
        unevenness(&s, left);
        assert_true(left[0] < 0.52 * LEFT);
        assert_true(left[1] < 0.45 * LEFT);
        assert_true(left[2] < 0.26 * LEFT);
        brc_memory_free(s.pair);
        require(*state, brc_bond_search(*state, s.packing.position, s.packing.radius, SPHERES, s.n_pairs, 1, &s.pair,
                                        &s.growth));
        unevenness(&s, left);
        plain = fmax(plain, left[0]);
        drop(&s);
    }
    assert_true(plain > 2 * 0.52 * LEFT);
}

static int compare(const void *left, const void *right)
{
    return memcmp(left, right, 2 * sizeof(int32_t));
}

/* As many as wanted, each once, and but for few the nearest: what is not among them lies near the longest. t stays
 * below 0.4 of the range that 12 / sqrt(2000) = 27 % more pairs span. */
static void only_bonds_near_the_longest_are_others(void **state)
{
    sample s = pack(*state, 4, 8);
    int32_t(*nearest)[2];
    double growth, reach;
    balance(*state, &s, 1);
    qsort(s.pair, (size_t)s.n_pairs, sizeof *s.pair, compare);
    for (int64_t b = 0; b < s.n_pairs; ++b) {
        assert_true(s.pair[b][0] >= 0 && s.pair[b][0] < s.pair[b][1] && s.pair[b][1] < SPHERES);
        assert_true(b == 0 || compare(s.pair[b - 1], s.pair[b]) != 0);
    }
    require(*state, brc_bond_search(*state, s.packing.position, s.packing.radius, SPHERES,
                                    s.n_pairs + (int64_t)(0.27 * (double)s.n_pairs), 1, &nearest, &reach));
    brc_memory_free(nearest);
    require(*state,
            brc_bond_search(*state, s.packing.position, s.packing.radius, SPHERES, s.n_pairs, 1, &nearest, &growth));
    int64_t others = 0;
    for (int64_t b = 0; b < s.n_pairs; ++b) {
        if (bsearch(nearest[b], s.pair, (size_t)s.n_pairs, sizeof *s.pair, compare)) continue;
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += pow(s.packing.position[3 * (int64_t)nearest[b][0] + c] -
                              s.packing.position[3 * (int64_t)nearest[b][1] + c],
                          2);
        const double ratio = sqrt(square) / (s.packing.radius[nearest[b][0]] + s.packing.radius[nearest[b][1]]);
        assert_true(ratio > growth - 2 * 0.4 * (reach - growth));
        ++others;
    }
    assert_true(others > 0 && others < s.n_pairs / 10);
    assert_true(s.growth < growth + 2 * 0.4 * (reach - growth));
    brc_memory_free(nearest);
    drop(&s);
}

static void one_and_two_threads_give_equal_bytes(void **state)
{
    sample s = pack(*state, 5, 10);
    double walls[BRC_BALANCE_PARTS];
    balance(*state, &s, 1);
    int32_t(*first)[2] = s.pair;
    const double growth = s.growth;
    brc_balance_of_walls(s.solid, s.packing.position, s.packing.radius, SPHERES, 2, walls);
    assert_memory_equal(walls, s.walls, sizeof walls);
    balance(*state, &s, 2);
    assert_memory_equal(first, s.pair, (size_t)s.n_pairs * sizeof *first);
    assert_true(growth == s.growth);
    brc_memory_free(first);
    drop(&s);
}

/* Of a cube nothing of degree 2 is left, and of degree 4 what six normals along the axes have: (35 - 30 + 3) 3 / 8 / 3
 * + 2 (3/8 3) / 3 = 1.75 of the harmonic about z; walls have equal numbers of spheres within some per cent. A plate has
 * a degree 2 about its normal: nearly sqrt(5). */
static void walls_that_cancel_are_left_out(void **state)
{
    const brc_shape plate = {.kind = BRC_SHAPE_BOX, .size = {40, 40, 2}};
    sample s = pack(*state, 6, 8);
    brc_solid *solid;
    double walls[BRC_BALANCE_PARTS], position[3 * 400], radius[400];
    for (int c = 0; c < 5; ++c)
        assert_true(s.walls[c] == 0);
    assert_true(fabs(s.walls[5] - 1.75) < 0.1);
    for (int e = 0; e < 400; ++e) {
        radius[e] = 1;
        position[3 * e] = 1 + 2.0 * (e % 20);
        position[3 * e + 1] = 1 + 2.0 * (e / 20);
        position[3 * e + 2] = 1;
    }
    require(*state, brc_solid_create(*state, &plate, 1, &solid));
    brc_balance_of_walls(solid, position, radius, 400, 1, walls);
    assert_true(walls[4] > 0.8 * sqrt(5.0));
    brc_solid_free(&solid);
    drop(&s);
}

/* Two of three neighbours in a lattice: all pairs are as long as the longest bond; and fifty spheres have too few: both
 * get their nearest pairs. */
static void lattices_and_few_spheres_get_their_nearest_pairs(void **state)
{
    enum { EDGE = 12, N = EDGE * EDGE * EDGE };
    static double position[3 * N], radius[N];
    static const int64_t count[2] = {N, 50}, bonds[2] = {2 * EDGE * EDGE * (EDGE - 1), 100};
    for (int e = 0; e < N; ++e) {
        const int at[3] = {e % EDGE, e / EDGE % EDGE, e / (EDGE * EDGE)};
        radius[e] = 0.5;
        for (int c = 0; c < 3; ++c)
            position[3 * e + c] = at[c];
    }
    for (int k = 0; k < 2; ++k) {
        int32_t(*balanced)[2], (*nearest)[2];
        double growth[2];
        require(*state, brc_bond_balance(*state, position, radius, count[k], bonds[k], NULL, 1, &balanced, &growth[0]));
        require(*state, brc_bond_search(*state, position, radius, count[k], bonds[k], 1, &nearest, &growth[1]));
        assert_memory_equal(balanced, nearest, (size_t)bonds[k] * sizeof *nearest);
        assert_true(growth[0] == growth[1]);
        brc_memory_free(balanced);
        brc_memory_free(nearest);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(harmonics_have_the_mean_square_one_and_are_orthogonal, test_begin, test_end),
        cmocka_unit_test_setup_teardown(balanced_bonds_are_alike_along_all_axes_and_nearest_pairs_are_not, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(only_bonds_near_the_longest_are_others, test_begin, test_end),
        cmocka_unit_test_setup_teardown(one_and_two_threads_give_equal_bytes, test_begin, test_end),
        cmocka_unit_test_setup_teardown(walls_that_cancel_are_left_out, test_begin, test_end),
        cmocka_unit_test_setup_teardown(lattices_and_few_spheres_get_their_nearest_pairs, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
