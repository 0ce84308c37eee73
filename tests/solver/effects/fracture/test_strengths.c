/* Strengths of bonds: the distributions they are drawn from, what a draw depends on, interfaces, files. */
#include "../../../../host/base/log.h"
#include "../../../../host/base/memory.h"
#include "../../../../host/solver/effects/fracture/strengths.h"
#include "../../../../preprocess/domain/build.h"
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
// clang-format on
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- a row of elements, each bonded to the next ---- */

enum { MOST = 40001 };
typedef struct row {
    brc_context *context;
    brc_scene scene;
    brc_material material[3];
    brc_interface interface[4];
    brc_domain domain;
    int64_t row_start[MOST + 1];
    int32_t neighbour[2 * MOST], twin[2 * MOST], bond[2 * MOST], bond_half_edge[MOST], material_of[MOST], grain[MOST];
    double position[3 * MOST], area[6 * MOST];
    brc_strengths strengths;
} row;

/* n elements 2 m apart; the face of bond b has (1 + b % step) m^2. */
static row *new_row(int32_t n, int step)
{
    row *r = calloc(1, sizeof *r);
    int32_t h = 0;
    r->context = brc_context_create();
    brc_log_set_level(r->context, BRC_LOG_ERROR);
    for (int32_t e = 0; e < n; ++e) {
        r->row_start[e] = h;
        r->position[3 * e] = 2.0 * e;
        if (e > 0) {
            r->neighbour[h] = e - 1, r->bond[h] = e - 1, r->twin[h] = h - 1, r->twin[h - 1] = h;
            r->area[3 * h++] = -(1.0 + (e - 1) % step);
        }
        if (e < n - 1) {
            r->neighbour[h] = e + 1, r->bond[h] = e, r->bond_half_edge[e] = h;
            r->area[3 * h++] = 1.0 + e % step;
        }
    }
    r->row_start[n] = h;
    r->domain = (brc_domain){.element_kind = BRC_ELEMENT_CELL,
                             .n_elements = n,
                             .n_bonds = n - 1,
                             .n_half_edges = h,
                             .position = r->position,
                             .row_start = r->row_start,
                             .neighbour = r->neighbour,
                             .twin = r->twin,
                             .bond = r->bond,
                             .area_vector = r->area,
                             .bond_half_edge = r->bond_half_edge};
    r->scene.materials = r->material;
    r->scene.n_materials = 3;
    r->scene.interfaces = r->interface;
    r->scene.has_fracture = true;
    strcpy(r->scene.folder, ".");
    for (int m = 0; m < 3; ++m)
        snprintf(r->material[m].name, BRC_NAME, "%c", 'a' + m);
    r->material[0].tension = 5;
    return r;
}

static void make(row *r)
{
    brc_strengths_free(&r->strengths);
    if (brc_strengths_create(r->context, &r->scene, &r->domain, r->material_of, &r->strengths) != BRC_OK)
        fail_msg("%s", brc_context_message(r->context));
}

/* What is asked before anything is drawn; of fracture energies it says what the bonds have. */
static bool is_weighted(row *r)
{
    bool weighted, softens;
    brc_strengths_ask(&r->scene, &r->domain, r->material_of, &weighted, &softens);
    assert_true(softens == r->strengths.softens);
    return weighted;
}

static void free_row(row *r)
{
    brc_strengths_free(&r->strengths);
    brc_context_free(&r->context);
    free(r);
}

/* ---- distributions ---- */

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Kolmogorov's statistic of shares that should be uniform in (0, 1), times sqrt n. By chance it is above 1.95 once in
 * 1000. */
static double kolmogorov(double *share, int n)
{
    double worst = 0;
    qsort(share, (size_t)n, sizeof *share, ascending);
    for (int k = 0; k < n; ++k)
        worst = fmax(worst, fmax((k + 1.0) / n - share[k], share[k] - (double)k / n));
    return worst * sqrt(n);
}
static const double KOLMOGOROV_LEVEL = 1.95;

/* Bonds of ten sizes, three seeds: shares 1 - exp(-f^m V / V_0). */
static void weibull_factors_have_their_distribution(void **state)
{
    (void)state;
    row *r = new_row(20001, 10);
    double *share = calloc(MOST, sizeof *share);
    for (int k = 0; k < 6; ++k) {
        const bool sized = k % 2;
        r->scene.fracture.seed = (uint64_t)(1 + k / 2);
        r->material[0].scatter = (brc_scatter){.kind = BRC_SCATTER_WEIBULL, .modulus = 8, .volume = sized ? 3 : 0};
        make(r);
        for (int64_t b = 0; b < r->domain.n_bonds; ++b) {
            const double f = r->strengths.factor[b], volume = (1.0 + (double)(b % 10)) * 2 / 3;
            share[b] = -expm1(-pow(f, 8) * (sized ? volume / 3 : 1));
            assert_true(r->strengths.tension[b] == 5 * f);
        }
        assert_true(is_weighted(r));
        assert_true(kolmogorov(share, (int)r->domain.n_bonds) < KOLMOGOROV_LEVEL);
    }
    free(share);
    free_row(r);
}

/* The weakest of 20 bonds is a bond of 20 times the volume: that of a strength of a bar of 20 of them is the same
 * law. */
static void the_weakest_of_many_follows_the_volume_of_all(void **state)
{
    (void)state;
    row *r = new_row(40001, 1);
    double *share = calloc(MOST, sizeof *share);
    const double modulus = 6, reference = 7, volume = 2.0 / 3;
    r->material[0].scatter = (brc_scatter){.kind = BRC_SCATTER_WEIBULL, .modulus = modulus, .volume = reference};
    make(r);
    for (int g = 0; g < 2000; ++g) {
        double weakest = INFINITY;
        for (int k = 0; k < 20; ++k)
            weakest = fmin(weakest, r->strengths.factor[20 * g + k]);
        share[g] = -expm1(-pow(weakest, modulus) * 20 * volume / reference);
    }
    assert_true(kolmogorov(share, 2000) < KOLMOGOROV_LEVEL);
    free(share);
    free_row(r);
}

/* The draw stays, the size scales it: (V_0 / V)^(1/m), to the rounding of pow. */
static void larger_bonds_are_weaker_by_the_power_of_their_volume(void **state)
{
    (void)state;
    row *same = new_row(101, 10), *sized = new_row(101, 10);
    same->material[0].scatter = (brc_scatter){.kind = BRC_SCATTER_WEIBULL, .modulus = 12};
    sized->material[0].scatter = (brc_scatter){.kind = BRC_SCATTER_WEIBULL, .modulus = 12, .volume = 0.25};
    make(same), make(sized);
    for (int b = 0; b < 100; ++b) {
        const double volume = (1 + b % 10) * 2.0 / 3;
        assert_true(fabs(brc_strengths_volume(&same->domain, b) / volume - 1) < 4e-16);
        assert_true(fabs(sized->strengths.factor[b] / same->strengths.factor[b] / pow(0.25 / volume, 1.0 / 12) - 1) <
                    1e-14);
    }
    free_row(same), free_row(sized);
}

static void factors_of_a_table_have_its_quantiles(void **state)
{
    (void)state;
    brc_quantile table[] = {
        {0, 0.5}, {0.25, 0.8}, {0.25, 0.9}, {0.75, 1.1}, {1, 3}}; /* with a gap: none between 0.8 and 0.9 */
    row *r = new_row(20001, 1);
    double *share = calloc(MOST, sizeof *share);
    r->material[0].scatter = (brc_scatter){.kind = BRC_SCATTER_TABLE, .n_quantiles = 5, .quantiles = table};
    make(r);
    for (int64_t b = 0; b < r->domain.n_bonds; ++b) {
        const double f = r->strengths.factor[b];
        assert_true((f >= 0.5 && f <= 0.8) || (f >= 0.9 && f <= 3));
        share[b] = f <= 0.8   ? (f - 0.5) / 0.3 * 0.25
                   : f <= 1.1 ? 0.25 + (f - 0.9) / 0.2 * 0.5
                              : 0.75 + (f - 1.1) / 1.9 * 0.25;
    }
    assert_true(kolmogorov(share, (int)r->domain.n_bonds) < KOLMOGOROV_LEVEL);
    free(share);
    free_row(r);
}

/* ---- what a draw depends on ---- */

static void a_draw_depends_on_seed_and_ids_alone(void **state)
{
    (void)state;
    row *large = new_row(1000, 3), *small = new_row(1000, 3), *other = new_row(1000, 3);
    const brc_scatter scatter = {.kind = BRC_SCATTER_WEIBULL, .modulus = 10};
    large->material[0].scatter = small->material[0].scatter = other->material[0].scatter = scatter;
    other->scene.fracture.seed = 1;
    /* The same bonds listed from the end: other numbers of bonds, the same elements. */
    for (int32_t b = 0; b < 999; ++b) {
        const int32_t h = large->bond_half_edge[998 - b];
        small->bond_half_edge[b] = h;
        small->bond[h] = small->bond[small->twin[h]] = b;
    }
    make(large), make(small), make(other);
    int equal = 0;
    for (int b = 0; b < 999; ++b) {
        assert_true(large->strengths.factor[b] == small->strengths.factor[998 - b]);
        equal += large->strengths.factor[b] == other->strengths.factor[b];
        if (b > 0) assert_true(large->strengths.factor[b] != large->strengths.factor[b - 1]);
    }
    assert_int_equal(equal, 0);
    free_row(large), free_row(small), free_row(other);
}

/* ---- sides and interfaces ---- */

static void without_scatter_and_interfaces_all_factors_are_1(void **state)
{
    (void)state;
    row *r = new_row(5, 1);
    r->material[1].tension = 3, r->material[1].fracture_energy = 7;
    r->material_of[2] = r->material_of[3] = 1; /* a a b b a */
    make(r);
    static const double tension[4] = {5, 3, 3, 3}, energy[4] = {0, 7, 7, 7};
    for (int b = 0; b < 4; ++b)
        assert_true(r->strengths.factor[b] == 1 && r->strengths.tension[b] == tension[b] &&
                    r->strengths.energy[b] == energy[b]);
    assert_true(!is_weighted(r) && r->strengths.softens);
    free_row(r);
}

/* Materials a a b b b c, grains 0 0 0 1 1 2: bonds aa, ab, bb over a grain boundary, bb, bc over one. */
static void interfaces_are_found_by_grain_and_material_and_the_last_one_wins(void **state)
{
    (void)state;
    row *r = new_row(6, 1);
    static const int32_t material[6] = {0, 0, 1, 1, 1, 2}, grain[6] = {0, 0, 0, 1, 1, 2};
    memcpy(r->material_of, material, sizeof material);
    memcpy(r->grain, grain, sizeof grain);
    r->domain.grain = r->grain;
    r->material[1].tension = 4, r->material[1].fracture_energy = 10;
    r->material[2].tension = 2, r->material[2].fracture_energy = 6;
    r->interface[0] = (brc_interface){.kind = BRC_INTERFACE_GRAINS, .factor = 0.5};
    r->interface[1] = (brc_interface){.kind = BRC_INTERFACE_MATERIALS, .material = {1, 0}, .tension = 1};
    r->interface[2] =
        (brc_interface){.kind = BRC_INTERFACE_MATERIALS, .material = {1, 2}, .tension = 8, .fracture_energy = 9};
    r->scene.n_interfaces = 3;
    make(r);
    static const double tension[5] = {5, 1, 2, 4, 8}, factor[5] = {1, 0.25, 0.5, 1, 4}, energy[5] = {0, 10, 5, 10, 9};
    for (int b = 0; b < 5; ++b)
        assert_true(r->strengths.tension[b] == tension[b] && r->strengths.factor[b] == factor[b] &&
                    r->strengths.energy[b] == energy[b]);
    assert_true(is_weighted(r));
    r->interface[3] =
        (brc_interface){.kind = BRC_INTERFACE_GRAINS, .fracture_energy = 3}; /* its factor left out is 1 */
    r->scene.n_interfaces = 4;
    make(r);
    assert_true(r->strengths.tension[2] == 4 && r->strengths.energy[2] == 3 && r->strengths.tension[4] == 2 &&
                r->strengths.energy[4] == 3);
    free_row(r);
}

/* The scatter of the weaker side, on top of the interface. */
static void interfaces_scatter_as_their_weaker_side(void **state)
{
    (void)state;
    row *r = new_row(6, 1), *plain = new_row(6, 1);
    static const int32_t material[6] = {0, 0, 1, 1, 0, 0};
    for (int k = 0; k < 2; ++k) {
        row *at = k ? plain : r;
        memcpy(at->material_of, material, sizeof material);
        at->material[1].tension = 4;
        at->material[1].scatter = (brc_scatter){.kind = BRC_SCATTER_WEIBULL, .modulus = 5};
    }
    r->interface[0] = (brc_interface){.kind = BRC_INTERFACE_MATERIALS, .material = {0, 1}, .factor = 0.5};
    r->scene.n_interfaces = 1;
    make(r), make(plain);
    for (int b = 0; b < 5; ++b) {
        const double mixed = b == 1 || b == 3, scatters = b >= 1 && b <= 3;
        assert_true((plain->strengths.factor[b] != 1) == (scatters != 0));
        assert_true(r->strengths.factor[b] == (mixed != 0 ? 0.5 : 1) * plain->strengths.factor[b]);
    }
    free_row(r), free_row(plain);
}

static void an_interface_of_given_tension_needs_one_to_compare_with(void **state)
{
    (void)state;
    row *r = new_row(3, 1);
    r->scene.model.kind = BRC_MODEL_CBM;
    r->material[0] = (brc_material){.name = "a", .beam_strength = 9};
    r->interface[0] = (brc_interface){.kind = BRC_INTERFACE_MATERIALS, .tension = 1};
    r->scene.n_interfaces = 1;
    assert_int_equal(brc_strengths_create(r->context, &r->scene, &r->domain, r->material_of, &r->strengths),
                     BRC_BAD_INPUT);
    assert_non_null(
        strstr(brc_context_message(r->context),
               "interfaces, number 1: a tension of 1 Pa is compared with that of its materials, and 'a' has none"));
    r->interface[0] = (brc_interface){.kind = BRC_INTERFACE_MATERIALS, .factor = 0.5};
    make(r);
    assert_true(r->strengths.factor[1] == 0.5);
    free_row(r);
}

/* ---- files ---- */

static brc_status read_file(row *r, const char *text)
{
    FILE *file = fopen("factors.csv", "w");
    fputs(text, file);
    fclose(file);
    brc_strengths_free(&r->strengths);
    brc_context_clear(r->context);
    r->material[0].scatter = (brc_scatter){.kind = BRC_SCATTER_FILE, .file = "factors.csv"};
    const brc_status status = brc_strengths_create(r->context, &r->scene, &r->domain, r->material_of, &r->strengths);
    remove("factors.csv");
    return status;
}

static void factors_come_from_files_by_element_ids(void **state)
{
    (void)state;
    row *r = new_row(4, 1);
    assert_int_equal(read_file(r, "# measured\nfactor;Element_I;element_j\n0.5;1;0\n2.25;2;3\n"), BRC_OK);
    assert_true(r->strengths.factor[0] == 0.5 && r->strengths.factor[1] == 1 && r->strengths.factor[2] == 2.25);
    assert_true(r->strengths.tension[2] == 5 * 2.25);
    free_row(r);
}

static void files_that_name_no_bond_are_refused_where_they_do(void **state)
{
    (void)state;
    static const struct {
        const char *text, *sentence;
    } bad[] = {
        {"element_i,element_j,factor\n0,2,1\n", "factors.csv:2:1: no bond joins elements 0 and 2"},
        {"element_i,element_j,factor\n0,1,1\n1,4,1\n",
         "factors.csv:3:3: element_j is 4, expected the id of an element, 0 to 3"},
        {"element_i,element_j,factor\n0.5,1,1\n", "factors.csv:2:1: element_i is 0.5, expected the id of an element"},
        {"element_i,element_j,factor\n0,1,-1\n", "factors.csv:2:5: factor is -1, must be > 0"},
        {"element_i,element_j,factor\n0,1,1\n1,0,2\n",
         "factors.csv:3:1: a second factor for the bond of elements 1 and 0"},
        {"element_i,element_j\n0,1\n",
         "factors.csv:1:1: no column 'factor', expected a row of names: element_i, element_j and factor"},
        {"element_i,element_j,factor\n0,1,x\n", "factors.csv:2:5:"},
    };
    row *r = new_row(4, 1);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        assert_int_equal(read_file(r, bad[k].text), BRC_BAD_INPUT);
        if (!strstr(brc_context_message(r->context), bad[k].sentence)) fail_msg("%s", brc_context_message(r->context));
        assert_null(r->strengths.factor);
    }
    strcpy(r->material[0].scatter.file, "nowhere.csv");
    assert_int_equal(brc_strengths_create(r->context, &r->scene, &r->domain, r->material_of, &r->strengths),
                     BRC_BAD_INPUT);
    assert_non_null(strstr(brc_context_message(r->context), "nowhere.csv"));
    free_row(r);
}

/* ---- volumes of real samples ---- */

/* The pyramids over all faces fill the cells, those over free faces are the rest; the parts of spheres fill the solid.
 * Sums of 1e4 terms. */
static void volumes_of_bonds_fill_the_solid(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_log_set_level(context, BRC_LOG_ERROR);
    for (int spheres = 0; spheres < 2; ++spheres) {
        brc_build_request request = {.shape = {.kind = BRC_SHAPE_BOX, .size = {1, 2, 3}}};
        request.fill =
            spheres
                ? (brc_fill){.kind = BRC_FILL_PACKING, .n_elements = 500, .radius_spread = 0.125, .coordination = 6.2}
                : (brc_fill){.kind = BRC_FILL_NOISY_GRID, .n_elements = 500, .spread = 0.9};
        request.beams = spheres ? 8 : 0;
        brc_domain *d = NULL;
        if (brc_domain_build(context, &request, &d) != BRC_OK) fail_msg("%s", brc_context_message(context));
        double sum = 0;
        for (int64_t b = 0; b < d->n_bonds; ++b)
            sum += brc_strengths_volume(d, b);
        for (int64_t e = 0; e < d->n_elements; ++e)
            if (spheres && d->row_start[e + 1] == d->row_start[e]) sum += d->volume[e];
        for (int64_t f = 0; f < d->n_free_faces; ++f)
            for (int c = 0; c < 3; ++c)
                sum += d->free_area_vector[3 * f + c] *
                       (d->free_centroid[3 * f + c] - d->position[3 * d->free_element[f] + c]) / 3;
        assert_true(fabs(sum / 6 - 1) < 1e-9);
        brc_domain_free(&d);
    }
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weibull_factors_have_their_distribution),
        cmocka_unit_test(the_weakest_of_many_follows_the_volume_of_all),
        cmocka_unit_test(larger_bonds_are_weaker_by_the_power_of_their_volume),
        cmocka_unit_test(factors_of_a_table_have_its_quantiles),
        cmocka_unit_test(a_draw_depends_on_seed_and_ids_alone),
        cmocka_unit_test(without_scatter_and_interfaces_all_factors_are_1),
        cmocka_unit_test(interfaces_are_found_by_grain_and_material_and_the_last_one_wins),
        cmocka_unit_test(interfaces_scatter_as_their_weaker_side),
        cmocka_unit_test(an_interface_of_given_tension_needs_one_to_compare_with),
        cmocka_unit_test(factors_come_from_files_by_element_ids),
        cmocka_unit_test(files_that_name_no_bond_are_refused_where_they_do),
        cmocka_unit_test(volumes_of_bonds_fill_the_solid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
