#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/domain/cracks.h"
#include "../../../preprocess/domain/sets.h"

#include <string.h>

/* A domain as it is when cracks are cut: before its sets are built. */
static brc_domain *unfinished(brc_context *context, const brc_build_request *request)
{
    brc_domain *domain = test_build(context, request);
    for (int32_t s = 0; s < domain->n_sets; ++s) {
        brc_memory_free(domain->sets[s].name);
        brc_memory_free(domain->sets[s].members);
    }
    brc_memory_free(domain->sets);
    domain->sets = NULL;
    domain->n_sets = 0;
    return domain;
}

static int64_t cut(brc_context *context, int32_t n, const brc_crack *cracks, brc_domain *domain)
{
    int64_t n_cut = 0;
    if (brc_cracks_cut(context, n, cracks, domain, &n_cut) != BRC_OK) fail_msg("%s", brc_context_message(context));
    return n_cut;
}

/* A rectangle far larger than the cube of 1 m, through its middle, normal to z. */
static const brc_crack middle = {.name = "middle",
                                 .kind = BRC_CRACK_RECTANGLE,
                                 .point = {-0.5, -0.5, 0.5},
                                 .edge = {{2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}}};

static brc_crack penny(double x, double y, double z, double radius)
{
    return (brc_crack){
        .name = "penny", .kind = BRC_CRACK_DISC, .point = {x, y, z}, .normal = {0.0, 0.0, 3.0}, .radius = radius};
}

/* Number of pieces that bonds hold together. */
static int64_t count_pieces(const brc_domain *d)
{
    int64_t *piece = NULL, n = 0;
    assert_int_equal(BRC_ALLOCATE(NULL, &piece, d->n_elements, "pieces"), BRC_OK);
    for (int64_t e = 0; e < d->n_elements; ++e)
        piece[e] = e;
    for (bool changed = true; changed;) {
        changed = false;
        for (int64_t e = 0; e < d->n_elements; ++e)
            for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h)
                if (piece[d->neighbour[h]] < piece[e]) {
                    piece[e] = piece[d->neighbour[h]];
                    changed = true;
                }
    }
    for (int64_t e = 0; e < d->n_elements; ++e)
        n += piece[e] == e;
    brc_memory_free(piece);
    return n;
}

/* Bodies whose cells have many and few corners, flat and curved walls, and lie near and far. */
enum { N_BODIES = 5 };
static brc_build_request body(int k)
{
    brc_build_request r[N_BODIES] = {test_box(1000, 0.9), test_box(1000, 0.0), test_sphere(1000, 0.9),
                                     test_box(1000, 0.9), test_cylinder(1000, 0.9)};
    r[2].shape.origin[0] = r[2].shape.origin[1] = r[2].shape.origin[2] = 0.5;
    r[2].fill.lloyd_sweeps = 2;
    r[3].rotation[0] = 0.3;
    r[3].translation[1] = 1e3;
    r[4].shape.origin[1] = r[4].shape.origin[2] = 0.5;
    return r[k];
}

static brc_crack through_body(int k)
{
    brc_crack crack = middle;
    if (k != 3) return crack;
    crack.point[1] += 1e3;
    crack.edge[0][2] = 0.4;
    return crack;
}

static void a_crack_through_the_middle_leaves_two_pieces_and_every_promise_holds(void **state)
{
    for (int k = 0; k < N_BODIES; ++k) {
        const brc_build_request r = body(k);
        const brc_crack crack = through_body(k);
        brc_domain *d = unfinished(*state, &r);
        const int64_t n_bonds = d->n_bonds, n_free = d->n_free_faces, n_walls = d->n_walls;
        const double closure = test_worst_closure(d);
        assert_int_equal(count_pieces(d), 1);
        const int64_t n_cut = cut(*state, 1, &crack, d);
        assert_true(n_cut > 0);
        assert_int_equal(count_pieces(d), 2);
        assert_int_equal(d->n_bonds, n_bonds - n_cut);
        assert_int_equal(d->n_free_faces, n_free + 2 * n_cut);
        assert_int_equal(d->n_walls, n_walls + 1);
        assert_string_equal(d->wall_name[n_walls], "middle");
        if (brc_domain_check(*state, d) != BRC_OK) fail_msg("%s", brc_context_message(*state));
        /* the same area vectors are summed in another order: a few dozen roundings of a cell's surface */
        assert_near(test_worst_closure(d), closure, 1e-14);
        brc_domain_free(&d);
    }
}

/* Every free face has a polygon that goes round counter-clockwise and encloses the area vector. Corners of the two
 * cells of a face were computed apart, to 1e-14 of a cell of 0.1 m (or 1e-16 of the distance from the origin): areas to
 * a few 1e-16 m^2 (1e-14 m^2 at 1 km, with room for the corners of slanted neighbours: tenfold). */
static void polygons_of_cut_faces_enclose_their_area(void **state)
{
    for (int k = 0; k < N_BODIES; ++k) {
        const brc_build_request r = body(k);
        const brc_crack crack = through_body(k);
        brc_domain *d = unfinished(*state, &r);
        cut(*state, 1, &crack, d);
        for (int64_t f = 0; f < d->n_free_faces; ++f) {
            const int64_t start = d->free_polygon_start[f], n = d->free_polygon_start[f + 1] - start;
            assert_true(n >= 3);
            double sum[3] = {0.0, 0.0, 0.0};
            const double *o = d->vertex + 3 * (int64_t)d->free_polygon[start];
            for (int64_t p = 1; p + 1 < n; ++p) {
                const double *a = d->vertex + 3 * (int64_t)d->free_polygon[start + p];
                const double *b = d->vertex + 3 * (int64_t)d->free_polygon[start + p + 1];
                for (int c = 0; c < 3; ++c) {
                    const int i = (c + 1) % 3, j = (c + 2) % 3;
                    sum[c] += 0.5 * ((a[i] - o[i]) * (b[j] - o[j]) - (a[j] - o[j]) * (b[i] - o[i]));
                }
            }
            for (int c = 0; c < 3; ++c)
                assert_near(sum[c], d->free_area_vector[3 * f + c], k == 3 ? 1e-12 : 1e-14);
        }
        brc_domain_free(&d);
    }
}

/* The two faces of a bond lie in the same place, look exactly opposite ways, and belong to the bond's elements. */
static void both_sides_of_a_cut_are_exactly_opposite(void **state)
{
    const brc_build_request r = test_box(1000, 0.9);
    brc_domain *d = unfinished(*state, &r);
    const int64_t n_cut = cut(*state, 1, &middle, d);
    int64_t n = 0;
    for (int64_t f = 0; f < d->n_free_faces; ++f) {
        if (strcmp(d->wall_name[d->free_wall[f]], "middle") != 0) continue;
        int64_t opposite = 0;
        for (int64_t g = 0; g < d->n_free_faces; ++g)
            if (memcmp(d->free_centroid + 3 * f, d->free_centroid + 3 * g, 3 * sizeof(double)) == 0) {
                bool minus = g != f;
                for (int c = 0; c < 3; ++c)
                    minus = minus && d->free_area_vector[3 * f + c] == -d->free_area_vector[3 * g + c];
                opposite += minus;
            }
        assert_int_equal(opposite, 1);
        const double above = d->position[3 * (int64_t)d->free_element[f] + 2] - 0.5;
        assert_true(above * d->free_area_vector[3 * f + 2] < 0.0); /* outward: down for an element above the crack */
        ++n;
    }
    assert_int_equal(n, 2 * n_cut);
    brc_domain_free(&d);
}

/* However rough, the surface that divides the cube has the projected area of its section: by the closure of the upper
 * piece, whose only other faces along z are those of z+, 1 m^2. Some hundred summands of 1e-2 m^2, each closed to 1e-14
 * of them. */
static void the_projected_area_of_a_full_cut_is_that_of_the_section(void **state)
{
    const brc_build_request r = test_box(1000, 0.9);
    brc_domain *d = unfinished(*state, &r);
    cut(*state, 1, &middle, d);
    double side[2] = {0.0, 0.0}, area = 0.0;
    for (int64_t f = 0; f < d->n_free_faces; ++f) {
        if (strcmp(d->wall_name[d->free_wall[f]], "middle") != 0) continue;
        const int above = d->position[3 * (int64_t)d->free_element[f] + 2] > 0.5;
        const double *s = d->free_area_vector + 3 * f;
        side[above] += s[2];
        area += 0.5 * sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    }
    print_message("a crack along the cells has %.3f times the area of its section\n", area);
    assert_near(side[0], 1.0, 1e-12);
    assert_near(side[1], -1.0, 1e-12);
    brc_domain_free(&d);
}

/* Four cubes along each edge, centres at 0.125, 0.375, 0.625, 0.875: countable by hand. */
static void cracks_in_cubes_cut_what_a_hand_count_gives(void **state)
{
    brc_build_request r = test_box(64, 0.0);
    const double inner = 0.125 * sqrt(2.0), outer = 0.125 * sqrt(10.0);
    const struct {
        brc_crack crack;
        int64_t n_cut;
    } cases[] = {
        {penny(0.5, 0.5, 0.5, 0.2), 4},
        {penny(0.5, 0.5, 0.5, inner), 4}, /* the rim belongs to the crack */
        {penny(0.5, 0.5, 0.5, outer * (1.0 - 1e-6)), 4},
        {penny(0.5, 0.5, 0.5, outer), 12},
        {penny(0.5, 0.5, 0.5, 9.0), 16},
        {penny(0.125, 0.125, 0.5, 0.1), 1},
        {penny(0.5, 0.5, 0.55, 0.2), 4},  /* anywhere along the branch */
        {penny(0.5, 0.5, 0.375, 0.2), 4}, /* through centres: those count as above */
        {{.name = "c", .kind = BRC_CRACK_RECTANGLE, .point = {0, 0, 0.5}, .edge = {{0.5, 0, 0}, {0, 0.5, 0}}}, 4},
        {{.name = "c", .kind = BRC_CRACK_RECTANGLE, .point = {0.125, 0.125, 0.5}, .edge = {{0.25, 0, 0}, {0, 0.5, 0}}},
         6},
        {{.name = "c",
          .kind = BRC_CRACK_RECTANGLE,
          .point = {0.125, 0.125, 0.5},
          .edge = {{0.25, 0, 0}, {0.5, 0.5, 0}}},
         6},
        {{.name = "c", .kind = BRC_CRACK_RECTANGLE, .point = {0, 0.5, 0}, .edge = {{1, 0, 0}, {0, 0, 1}}}, 16},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        brc_domain *d = unfinished(*state, &r);
        assert_int_equal(cut(*state, 1, &cases[k].crack, d), cases[k].n_cut);
        assert_int_equal(brc_domain_check(*state, d), BRC_OK);
        for (int64_t f = d->n_free_faces - 1; f >= 0; --f)
            assert_int_equal(d->free_polygon_start[f + 1] - d->free_polygon_start[f], 4);
        brc_domain_free(&d);
    }
}

/* Against the definition, by another formula: the branch crosses a disc where the point of the branch at equal
 * distances from both faces of the plane lies within the radius. */
static void a_tilted_penny_cuts_the_branches_that_cross_it_and_no_others(void **state)
{
    const brc_build_request r = test_box(2000, 0.9);
    brc_crack crack = penny(0.45, 0.5, 0.55, 0.3);
    crack.normal[0] = 1.0;
    crack.normal[1] = -0.5;
    brc_domain *whole = unfinished(*state, &r), *d = unfinished(*state, &r);
    const int64_t n_cut = cut(*state, 1, &crack, d);
    int64_t expected = 0;
    for (int64_t e = 0; e < whole->n_elements; ++e)
        for (int64_t h = whole->row_start[e]; h < whole->row_start[e + 1]; ++h) {
            const double *x = whole->position + 3 * e, *y = whole->position + 3 * (int64_t)whole->neighbour[h];
            double a = 0.0, b = 0.0, square = 0.0;
            for (int c = 0; c < 3; ++c) {
                a += (x[c] - crack.point[c]) * crack.normal[c];
                b += (y[c] - crack.point[c]) * crack.normal[c];
            }
            if (a * b > 0.0) continue;
            for (int c = 0; c < 3; ++c)
                square += pow((fabs(b) * x[c] + fabs(a) * y[c]) / (fabs(a) + fabs(b)) - crack.point[c], 2.0);
            const bool crosses = square < crack.radius * crack.radius;
            expected += crosses;
            bool bonded = false;
            for (int64_t g = d->row_start[e]; g < d->row_start[e + 1]; ++g)
                bonded = bonded || d->neighbour[g] == whole->neighbour[h];
            assert_true(bonded == !crosses);
        }
    assert_int_equal(2 * n_cut, expected);
    brc_domain_free(&whole);
    brc_domain_free(&d);
}

static void a_bond_that_crosses_two_cracks_belongs_to_the_first(void **state)
{
    const brc_build_request r = test_box(64, 0.0);
    brc_crack cracks[2] = {penny(0.5, 0.5, 0.5, 0.2), middle};
    brc_domain *d = unfinished(*state, &r);
    assert_int_equal(cut(*state, 2, cracks, d), 16);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    int64_t count[8] = {0};
    for (int64_t f = 0; f < d->n_free_faces; ++f)
        count[d->free_wall[f]]++;
    assert_int_equal(count[6], 2 * 4);
    assert_int_equal(count[7], 2 * 12);
    brc_domain_free(&d);

    brc_crack across = middle; /* crosses the middle one: elements at the line where they meet have faces of both */
    strcpy(across.name, "across");
    across.edge[1][1] = 0.0;
    across.edge[1][2] = 2.0;
    across.point[1] = 0.5;
    across.point[2] = -0.5;
    cracks[0] = across;
    const brc_build_request noisy = test_box(1000, 0.9);
    d = unfinished(*state, &noisy);
    cut(*state, 2, cracks, d);
    assert_int_equal(count_pieces(d), 4);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    for (int64_t f = 1; f < d->n_free_faces; ++f)
        if (d->free_element[f] == d->free_element[f - 1]) assert_true(d->free_wall[f] >= d->free_wall[f - 1]);
    brc_domain_free(&d);
}

static void the_sides_of_a_crack_are_a_set_that_normals_divide(void **state)
{
    const brc_build_request r = test_box(1000, 0.9);
    brc_domain *d = unfinished(*state, &r);
    const int64_t n_cut = cut(*state, 1, &middle, d);
    brc_set_request upper = {.name = "upper side", .kind = BRC_SET_FACES};
    upper.where = (brc_predicate){
        .has_wall = true, .wall = "middle", .has_normal = true, .normal = {0.0, 0.0, -1.0}, .normal_angle = 1.57};
    assert_int_equal(brc_sets_build(*state, 1, &upper, d), BRC_OK);
    assert_int_equal(d->sets[brc_domain_find_set(d, "middle")].n_members, 2 * n_cut);
    const brc_set *set = &d->sets[brc_domain_find_set(d, "upper side")];
    assert_int_equal(set->n_members, n_cut);
    for (int64_t k = 0; k < n_cut; ++k)
        assert_true(d->position[3 * (int64_t)d->free_element[set->members[k]] + 2] > 0.5);
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    int64_t more = 0;
    assert_int_equal(brc_cracks_cut(*state, 1, &middle, d, &more), BRC_INTERNAL);
    test_says(*state, "after sets of faces were built");
    brc_domain_free(&d);
}

static void cracks_that_make_no_sense_are_refused_with_the_cure(void **state)
{
    brc_crack one = penny(0.5, 0.5, 0.5, 0.2), two[2] = {one, one};
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_OK);
    assert_int_equal(brc_cracks_check(*state, 2, two), BRC_BAD_INPUT);
    test_says(*state, "crack 'penny': another crack has this name; rename one");
    one.radius = 0.0;
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_BAD_INPUT);
    test_says(*state, "crack 'penny': radius is 0 m, must be finite and > 0");
    one.radius = NAN;
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_BAD_INPUT);
    one = penny(0.5, HUGE_VAL, 0.5, 0.2);
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_BAD_INPUT);
    test_says(*state, "the point (0.5, inf, 0.5) m must be finite");
    one = penny(0.5, 0.5, 0.5, 0.2);
    one.normal[2] = 0.0;
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_BAD_INPUT);
    test_says(*state, "the normal (0, 0, 0) must be finite and not zero");
    one = middle;
    one.edge[1][0] = 4.0;
    one.edge[1][1] = 0.0;
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_BAD_INPUT);
    test_says(*state, "crack 'middle': the edges (2, 0, 0) m and (4, 0, 0) m span no area");
    one = middle;
    one.name[0] = '\0';
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_BAD_INPUT);
    test_says(*state, "crack 1 has no name");
    one.kind = (brc_crack_kind)7;
    one.name[0] = 'a';
    assert_int_equal(brc_cracks_check(*state, 1, &one), BRC_BAD_INPUT);
    test_says(*state, "kind 7 is unknown");
}

static void cracks_that_cut_nothing_are_refused_with_the_distance(void **state)
{
    const brc_build_request r = test_box(64, 0.0);
    brc_domain *d = unfinished(*state, &r);
    int64_t n_cut = 0;
    const struct {
        brc_crack crack;
        const char *part;
    } cases[] = {
        {penny(0.5, 0.5, 0.5, 0.1),
         "crack 'penny' cuts no bond: the nearest element is 0.147 m away from it, elements are about 0.25 m wide"},
        {penny(0.375, 0.375, 4.875, 0.1), "nearest element is 4 m away"},
        {{.name = "a", .kind = BRC_CRACK_RECTANGLE, .point = {2.0, 0.0, 0.125}, .edge = {{1, 0, 0}, {0, 1, 0}}},
         "nearest element is 1.12 m"},
        {{.name = "a", .kind = BRC_CRACK_RECTANGLE, .point = {4.875, 5.875, 0.125}, .edge = {{1, 0, 0}, {1, 1, 0}}},
         "nearest element is 6.4 m"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        brc_context_clear(*state);
        assert_int_equal(brc_cracks_cut(*state, 1, &cases[k].crack, d, &n_cut), BRC_BAD_INPUT);
        test_says(*state, cases[k].part);
    }
    brc_crack wall = middle, both[2] = {middle, middle};
    strcpy(wall.name, "z+");
    assert_int_equal(brc_cracks_cut(*state, 1, &wall, d, &n_cut), BRC_BAD_INPUT);
    test_says(*state, "crack 'z+': the shape has a wall of this name; rename the crack");
    strcpy(both[1].name, "again");
    assert_int_equal(brc_cracks_cut(*state, 2, both, d, &n_cut), BRC_BAD_INPUT);
    test_says(*state, "crack 'again': earlier cracks cut all 16 bonds it crosses");
    assert_int_equal(n_cut, 0);
    assert_int_equal(d->n_bonds, 144); /* refused: untouched */
    assert_int_equal(brc_domain_check(*state, d), BRC_OK);
    brc_domain_free(&d);
}

/* A row of spheres, each joined to its next two: 0-1, 0-2, 1-2, 1-3, 2-3, 2-4, 3-4. A crack between 2 and 3 cuts 1-3,
 * 2-3 and 2-4. */
static void spheres_lose_bonds_and_nothing_else(void **state)
{
    double position[15], volume[5], radius[5];
    int64_t row_start[6] = {0, 2, 5, 9, 12, 14};
    int32_t neighbour[14] = {1, 2, 0, 2, 3, 0, 1, 3, 4, 1, 2, 4, 2, 3};
    int32_t twin[14] = {2, 5, 0, 6, 9, 1, 3, 10, 12, 4, 7, 13, 8, 11};
    int32_t bond[14] = {0, 1, 0, 2, 3, 1, 2, 4, 5, 3, 4, 6, 5, 6}, bond_half_edge[7] = {0, 1, 3, 4, 7, 8, 11};
    for (int e = 0; e < 5; ++e) {
        position[3 * e] = e;
        position[3 * e + 1] = position[3 * e + 2] = 0.0;
        volume[e] = 1.0;
        radius[e] = 0.5;
    }
    brc_domain d = {.element_kind = BRC_ELEMENT_SPHERE,
                    .n_elements = 5,
                    .n_bonds = 7,
                    .n_half_edges = 14,
                    .position = position,
                    .volume = volume,
                    .radius = radius,
                    .row_start = row_start,
                    .neighbour = neighbour,
                    .twin = twin,
                    .bond = bond,
                    .bond_half_edge = bond_half_edge};
    const brc_crack crack = {
        .name = "c", .kind = BRC_CRACK_DISC, .point = {2.5, 0.0, 0.0}, .normal = {1.0, 0.0, 0.0}, .radius = 0.1};
    assert_int_equal(cut(*state, 1, &crack, &d), 3);
    const int64_t rows[6] = {0, 2, 4, 6, 7, 8};
    const int32_t neighbours[8] = {1, 2, 0, 2, 0, 1, 4, 3}, twins[8] = {2, 4, 0, 5, 1, 3, 7, 6},
                  bonds[8] = {0, 1, 0, 2, 1, 2, 3, 3};
    const int32_t firsts[4] = {0, 1, 3, 6};
    assert_int_equal(d.n_bonds, 4);
    assert_int_equal(d.n_half_edges, 8);
    assert_memory_equal(d.row_start, rows, sizeof rows);
    assert_memory_equal(d.neighbour, neighbours, sizeof neighbours);
    assert_memory_equal(d.twin, twins, sizeof twins);
    assert_memory_equal(d.bond, bonds, sizeof bonds);
    assert_memory_equal(d.bond_half_edge, firsts, sizeof firsts);
    assert_int_equal(d.n_walls, 0);
    assert_int_equal(d.n_free_faces, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_crack_through_the_middle_leaves_two_pieces_and_every_promise_holds,
                                        test_begin, test_end),
        cmocka_unit_test_setup_teardown(polygons_of_cut_faces_enclose_their_area, test_begin, test_end),
        cmocka_unit_test_setup_teardown(both_sides_of_a_cut_are_exactly_opposite, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_projected_area_of_a_full_cut_is_that_of_the_section, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cracks_in_cubes_cut_what_a_hand_count_gives, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_tilted_penny_cuts_the_branches_that_cross_it_and_no_others, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(a_bond_that_crosses_two_cracks_belongs_to_the_first, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_sides_of_a_crack_are_a_set_that_normals_divide, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cracks_that_make_no_sense_are_refused_with_the_cure, test_begin, test_end),
        cmocka_unit_test_setup_teardown(cracks_that_cut_nothing_are_refused_with_the_distance, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_lose_bonds_and_nothing_else, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
