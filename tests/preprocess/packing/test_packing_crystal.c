#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"
#include "../../../preprocess/packing/soft_spheres.h"

#include <string.h>

enum { EDGE = 10 };

typedef struct lattice {
    int n_basis;
    double basis[4][3]; /* of the cubic cell */
    double cell;        /* edge of the cubic cell over the diameter */
} lattice;

static const lattice FCC = {4, {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}, 1.4142135623730951};
static const lattice BCC = {2, {{0, 0, 0}, {0.5, 0.5, 0.5}}, 1.1547005383792515};
static const lattice SC = {1, {{0, 0, 0}}, 1.0};

static brc_solid *room(brc_context *context)
{
    const brc_shape box = {.kind = BRC_SHAPE_BOX, .origin = {-40, -40, -40}, .size = {80, 80, 80}};
    brc_solid *solid;
    assert_int_equal(brc_solid_create(context, &box, 1, &solid), BRC_OK);
    return solid;
}

/* Share of ordered spheres of unit diameter at the places x [n][3]. */
static double share_of(brc_context *context, int64_t n, double (*x)[3])
{
    brc_solid *solid = room(context);
    brc_pack *pack;
    assert_int_equal(brc_pack_create(context, solid, n, 2, &pack), BRC_OK);
    for (int64_t i = 0; i < n; ++i)
        brc_pack_put(pack, i, x[i], 0.5);
    brc_pack_set_radii(pack, 0.5, 0.5);
    double share;
    assert_int_equal(brc_pack_crystal(pack, &share), BRC_OK);
    brc_pack_free(&pack);
    brc_solid_free(&solid);
    return share;
}

/* A turn about no special axis. */
static void turn(double x[3])
{
    const double axis[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0}, c = cos(1.1), s = sin(1.1);
    const double along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
    const double cross[3] = {axis[1] * x[2] - axis[2] * x[1], axis[2] * x[0] - axis[0] * x[2],
                             axis[0] * x[1] - axis[1] * x[0]};
    for (int k = 0; k < 3; ++k)
        x[k] = c * x[k] + s * cross[k] + (1.0 - c) * along * axis[k];
}

static double lattice_share(brc_context *context, const lattice *l, bool turned)
{
    static double x[4 * EDGE * EDGE * EDGE][3];
    int64_t n = 0;
    for (int k = 0; k < EDGE * EDGE * EDGE; ++k)
        for (int b = 0; b < l->n_basis; ++b) {
            const int cell[3] = {k % EDGE, k / EDGE % EDGE, k / EDGE / EDGE};
            for (int c = 0; c < 3; ++c)
                x[n][c] = l->cell * (cell[c] + l->basis[b][c] - 0.5 * EDGE);
            if (turned) turn(x[n]);
            ++n;
        }
    return share_of(context, n, x);
}

/* Cells not at the faces hold spheres whose neighbours all have all their neighbours: at least those are ordered. */
static void dense_crystals_are_ordered_however_they_lie(void **state)
{
    const double inner = pow((EDGE - 4.0) / EDGE, 3.0);
    for (int turned = 0; turned < 2; ++turned) {
        assert_true(lattice_share(*state, &FCC, turned) > inner);
        assert_true(lattice_share(*state, &BCC, turned) > inner);
    }
    assert_near(lattice_share(*state, &FCC, true), lattice_share(*state, &FCC, false), 1e-15);
}

/* Six neighbours cannot give seven connections. */
static void a_simple_cubic_lattice_has_too_few_neighbours(void **state)
{
    assert_near(lattice_share(*state, &SC, false), 0.0, 0.0);
}

/* Points without any order. Half of them have fewer than seven neighbours, and a product above 0.7 of two vectors of 13
 * parts is rare. */
static void points_at_random_are_not_ordered(void **state)
{
    enum { POINTS = 8000 };
    static double x[POINTS][3];
    for (int i = 0; i < POINTS; ++i) {
        double u[4];
        brc_random_uniform4(5, BRC_RANDOM_TEST, (uint64_t)i, 0, u);
        for (int c = 0; c < 3; ++c)
            x[i][c] = 20.0 * u[c];
    }
    assert_true(share_of(*state, POINTS, x) < 0.01);
}

/* A crystal shaken by 0.09 of a diameter (root mean square, each way) keeps some spheres and loses others: the
 * harmonics of another frame must come to the same verdict on each. Products closer than rounding (1e-6) to the limit
 * are less than one in a thousand spheres. */
static void the_verdict_does_not_depend_on_the_frame(void **state)
{
    enum { CELLS = 12, POINTS = 4 * CELLS * CELLS * CELLS };
    static double x[POINTS][3];
    int64_t n = 0;
    for (int k = 0; k < CELLS * CELLS * CELLS; ++k)
        for (int b = 0; b < 4; ++b, ++n) {
            double u[4];
            brc_random_uniform4(6, BRC_RANDOM_TEST, (uint64_t)n, 0, u);
            const int cell[3] = {k % CELLS, k / CELLS % CELLS, k / CELLS / CELLS};
            for (int c = 0; c < 3; ++c)
                x[n][c] = 1.5 * (cell[c] + FCC.basis[b][c] - 0.5 * CELLS) + 0.3 * (u[c] - 0.5);
        }
    const double share = share_of(*state, POINTS, x);
    assert_true(share > 0.02 && share < 0.98);
    for (int64_t i = 0; i < POINTS; ++i)
        turn(x[i]);
    assert_near(share_of(*state, POINTS, x), share, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(dense_crystals_are_ordered_however_they_lie, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_simple_cubic_lattice_has_too_few_neighbours, test_begin, test_end),
        cmocka_unit_test_setup_teardown(points_at_random_are_not_ordered, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_verdict_does_not_depend_on_the_frame, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
