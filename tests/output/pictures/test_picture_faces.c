/* What a picture shows of cells, whole, broken and cut open. */
#include "../support.h"
#include "../../../host/base/memory.h"
#include "../../../host/output/pictures/picture_faces.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static brc_domain *domain; /* 2 x 1 x 1 m */

static int begin(void **state)
{
    test_begin(state);
    domain = test_domain(400);
    return 0;
}

static int end(void **state)
{
    brc_domain_free(&domain);
    return test_end(state);
}

/* Area vector of a face, outward [m^2]. */
static void area_of(const brc_picture_faces *f, int64_t face, double out[3])
{
    const double *o = domain->vertex + 3 * (int64_t)f->corner[f->start[face]];
    memset(out, 0, 3 * sizeof *out);
    for (int64_t k = f->start[face]; k + 1 < f->start[face + 1]; ++k) {
        const double *a = domain->vertex + 3 * (int64_t)f->corner[k],
                     *b = domain->vertex + 3 * (int64_t)f->corner[k + 1];
        for (int c = 0; c < 3; ++c) {
            const int i = (c + 1) % 3, j = (c + 2) % 3;
            out[c] += 0.5 * ((a[i] - o[i]) * (b[j] - o[j]) - (a[j] - o[j]) * (b[i] - o[i]));
        }
    }
}

static void a_whole_solid_shows_its_free_faces(void **state)
{
    (void)state;
    brc_picture_faces f;
    assert_int_equal(brc_picture_faces_make(test_context, domain, NULL, NULL, &f), BRC_OK);
    assert_int_equal(f.n, domain->n_free_faces);
    for (int64_t k = 0; k < f.n; ++k) {
        double area[3];
        area_of(&f, k, area);
        assert_int_equal(f.element[k], domain->free_element[k]);
        for (int c = 0; c < 3; ++c)
            assert_true(fabs(area[c] - domain->free_area_vector[3 * k + c]) <
                        1e-12); /* rounding of corners a metre away */
    }
    brc_picture_faces_free(&f);
}

/* Shown faces close the part that is left: their area vectors sum to nothing, and those of the section to the 1 m^2
 * that it covers. Cells are closed to rounding, and corners within 1e-7 of the size count as of a face's plane: 400
 * cells of 0.17 m times 1e-8 bound the sum. */
static void a_cut_is_closed_by_its_section(void **state)
{
    (void)state;
    const brc_picture_cut cut = {{0.9, 0, 0}, {1, 0, 0}};
    brc_picture_faces f;
    double all[3] = {0}, section = 0;
    int64_t left = 0;
    assert_int_equal(brc_picture_faces_make(test_context, domain, NULL, &cut, &f), BRC_OK);
    for (int64_t k = 0; k < f.n; ++k) {
        double area[3], middle = 0;
        area_of(&f, k, area);
        assert_true(domain->position[3 * (int64_t)f.element[k]] <= 0.9);
        for (int64_t i = f.start[k]; i < f.start[k + 1]; ++i)
            middle = fmax(middle, domain->vertex[3 * (int64_t)f.corner[i]]);
        for (int c = 0; c < 3; ++c)
            all[c] += area[c];
        if (area[0] > 0 || middle > 0.5) section += area[0]; /* walls y and z have none */
    }
    for (int c = 0; c < 3; ++c)
        assert_true(fabs(all[c]) < 1e-6);
    assert_true(fabs(section - 1) < 1e-6);
    for (int64_t e = 0; e < domain->n_elements; ++e)
        left += !brc_picture_hides(&cut, domain->position + 3 * e);
    assert_true(left > 0 && left < domain->n_elements);
    brc_picture_faces_free(&f);
}

static void a_broken_bond_shows_both_sides(void **state)
{
    (void)state;
    const int32_t h = domain->bond_half_edge[17], t = domain->twin[h];
    uint8_t *whole = malloc((size_t)domain->n_half_edges);
    brc_picture_faces f;
    double sum[3] = {0};
    int64_t more = 0;
    memset(whole, 1, (size_t)domain->n_half_edges);
    whole[h] = whole[t] = 0;
    assert_int_equal(brc_picture_faces_make(test_context, domain, whole, NULL, &f), BRC_OK);
    assert_int_equal(f.n, domain->n_free_faces + 2);
    for (int64_t k = 0; k < f.n; ++k) {
        double area[3], own = 0;
        area_of(&f, k, area);
        for (int c = 0; c < 3; ++c)
            own += fabs(fabs(area[c]) - fabs(domain->area_vector[3 * (int64_t)h + c]));
        for (int c = 0; c < 3; ++c)
            sum[c] += area[c];
        more += own < 1e-9; /* corners to 1e-7 of the size, as above, squared by the face */
    }
    assert_int_equal(more, 2);
    for (int c = 0; c < 3; ++c)
        assert_true(fabs(sum[c]) < 1e-9); /* equal and opposite */
    brc_picture_faces_free(&f);
    free(whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_whole_solid_shows_its_free_faces),
        cmocka_unit_test(a_cut_is_closed_by_its_section),
        cmocka_unit_test(a_broken_bond_shows_both_sides),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
