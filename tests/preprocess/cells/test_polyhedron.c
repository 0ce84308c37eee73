#include "../support.h"

#include "../../../preprocess/cells/polyhedron.h"

/* A box of edges 2, 3, 4 with its smallest corner at (-0.5, -1, -1): the seed lies off its centre. */
static const double corner[24] = {-0.5, -1, -1, 1.5, -1, -1, 1.5, 2, -1, -0.5, 2, -1,
                                  -0.5, -1, 3,  1.5, -1, 3,  1.5, 2, 3,  -0.5, 2, 3};
static const int32_t start[7] = {0, 4, 8, 12, 16, 20, 24};
static const int32_t face[24] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
static const int32_t other[6] = {-5, -6, -3, -4, -1, -2};
static const brc_polyhedron box = {8, 6, corner, start, face, other};

static void a_box_has_the_mass_of_the_textbook(void **state)
{
    (void)state;
    double volume, centroid[3], inertia[6];
    brc_polyhedron_mass(&box, &volume, centroid, inertia);
    assert_near(volume, 24.0, 1e-13);
    assert_near(centroid[0], 0.5, 1e-15);
    assert_near(centroid[1], 0.5, 1e-15);
    assert_near(centroid[2], 1.0, 1e-15);
    /* V (b^2 + c^2) / 12; no products about the centroid */
    assert_near(inertia[0], 24.0 * (9.0 + 16.0) / 12.0, 1e-12);
    assert_near(inertia[1], 24.0 * (4.0 + 16.0) / 12.0, 1e-12);
    assert_near(inertia[2], 24.0 * (4.0 + 9.0) / 12.0, 1e-12);
    for (int k = 3; k < 6; ++k)
        assert_near(inertia[k], 0.0, 1e-12);
}

static void off_diagonal_inertia_is_the_negative_product(void **state)
{
    (void)state;
    /* tetrahedron of the origin and the unit points: V = 1/6, integral of x y about the centroid
       = 1/120 - (1/6)(1/4)^2 = -1/480, so the off-diagonal terms are +1/480 */
    const double v[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const int32_t s[5] = {0, 3, 6, 9, 12}, f[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, o[4] = {-1, -2, -3, -4};
    const brc_polyhedron tetrahedron = {4, 4, v, s, f, o};
    double volume, centroid[3], inertia[6];
    brc_polyhedron_mass(&tetrahedron, &volume, centroid, inertia);
    assert_near(volume, 1.0 / 6.0, 1e-16);
    for (int k = 0; k < 3; ++k)
        assert_near(centroid[k], 0.25, 1e-16);
    for (int k = 3; k < 6; ++k)
        assert_near(inertia[k], 1.0 / 480.0, 1e-17);
    /* xx: 2 (1/60 - (1/6)/16) = 1/80 */
    for (int k = 0; k < 3; ++k)
        assert_near(inertia[k], 1.0 / 80.0, 1e-17);
}

static void a_face_is_put_onto_its_plane(void **state)
{
    (void)state;
    const double normal[3] = {0.0, 0.0, 1.0};
    double area, centroid[3];
    /* the top lies at 3; told that its plane is at 3 + 1e-9, the centroid moves there and the area stays */
    brc_polyhedron_face(&box, 1, normal, 3.0 + 1e-9, &area, centroid);
    assert_near(area, 6.0, 1e-14);
    assert_near(centroid[0], 0.5, 1e-15);
    assert_near(centroid[1], 0.5, 1e-15);
    assert_near(centroid[2], 3.0 + 1e-9, 1e-15);
}

static void a_face_without_area_has_a_centroid_among_its_corners(void **state)
{
    (void)state;
    const double v[9] = {0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.5, 0.0, 1.0}, normal[3] = {0.0, 0.0, 1.0};
    const int32_t s[2] = {0, 3}, f[3] = {0, 1, 2}, o[1] = {5};
    const brc_polyhedron flat = {3, 1, v, s, f, o};
    double area, centroid[3];
    brc_polyhedron_face(&flat, 0, normal, 1.0, &area, centroid);
    assert_near(area, 0.0, 0.0);
    assert_near(centroid[0], 0.5, 1e-15);
    assert_near(centroid[2], 1.0, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_has_the_mass_of_the_textbook),
        cmocka_unit_test(off_diagonal_inertia_is_the_negative_product),
        cmocka_unit_test(a_face_is_put_onto_its_plane),
        cmocka_unit_test(a_face_without_area_has_a_centroid_among_its_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
