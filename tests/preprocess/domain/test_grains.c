#include "../support.h"

#include "../../../host/base/memory.h"
#include "../../../preprocess/domain/grains.h"

/* A cube of cells with grains. */
static brc_domain *with_grains(brc_context *context, int64_t n_elements, const brc_grains *grains, int32_t n_regions,
                               int n_threads)
{
    const brc_build_request request = test_box(n_elements, 0.9);
    brc_domain *domain = test_build(context, &request);
    if (brc_grains_assign(context, grains, n_regions, n_threads, domain) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    return domain;
}

static void free_domain(brc_domain **domain)
{
    brc_memory_free((*domain)->grain);
    (*domain)->grain = NULL;
    brc_domain_free(domain);
}

static void there_are_as_many_grains_as_asked_each_with_elements(void **state)
{
    static const int64_t counts[] = {1, 2, 7, 50, 125};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k) {
        const brc_grains grains = {.n = counts[k], .seed = 3};
        brc_domain *d = with_grains(*state, 1000, &grains, 0, 1);
        int64_t elements[125] = {0};
        for (int64_t e = 0; e < d->n_elements; ++e) {
            assert_in_range(d->grain[e], 0, counts[k] - 1);
            elements[d->grain[e]]++;
            assert_int_equal(d->region[e], 0);
        }
        for (int64_t g = 0; g < counts[k]; ++g)
            assert_true(elements[g] > 0);
        free_domain(&d);
    }
}

/* Elements in clumps much smaller than a grain and much farther apart: whichever elements become centres, there is room
 * for one in each clump only, and the nearest centre is that of the own clump. */
static void an_element_belongs_to_the_grain_of_the_nearest_centre(void **state)
{
    enum { CLUMPS = 12, EACH = 10, N = CLUMPS * EACH };
    double position[3 * N], volume[N];
    int32_t region[N] = {0}, body[N] = {0};
    for (int e = 0; e < N; ++e) { /* clump c holds the elements c, c + CLUMPS, ... */
        const int c = e % CLUMPS, k = e / CLUMPS;
        position[3 * e] = 10.0 * (c % 3) + 0.05 * k;
        position[3 * e + 1] = 12.0 * (c / 3) - 0.07 * (k % 4);
        position[3 * e + 2] = 5.0 * (c % 2);
        volume[e] = 0.8; /* a grain has 8 m^3 */
    }
    brc_domain d = {.n_elements = N, .position = position, .volume = volume, .region = region, .body = body};
    const brc_grains grains = {.n = CLUMPS, .seed = 5};
    assert_int_equal(brc_grains_assign(*state, &grains, 0, 1, &d), BRC_OK);
    bool taken[CLUMPS] = {false};
    for (int e = 0; e < N; ++e)
        assert_int_equal(d.grain[e], d.grain[e % CLUMPS]);
    for (int c = 0; c < CLUMPS; ++c) {
        assert_in_range(d.grain[c], 0, CLUMPS - 1);
        assert_false(taken[d.grain[c]]);
        taken[d.grain[c]] = true;
    }
    brc_memory_free(d.grain);
}

static void shares_of_phases_hold_to_one_grain_and_regions_follow_those_of_the_scene(void **state)
{
    enum { GRAINS = 101, REGIONS = 2 };
    const double share[3] = {0.3, 0.0, 0.45};
    const brc_grains grains = {.n = GRAINS, .seed = 4, .n_phases = 3, .fraction = share};
    brc_domain *d = with_grains(*state, 2000, &grains, REGIONS, 1);
    int32_t region[GRAINS];
    for (int32_t g = 0; g < GRAINS; ++g)
        region[g] = -1;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        int32_t *of = &region[d->grain[e]];
        if (*of < 0) *of = d->region[e];
        assert_int_equal(d->region[e], *of); /* one phase a grain */
    }
    double count[4] = {0.0};
    for (int32_t g = 0; g < GRAINS; ++g) {
        assert_true(region[g] == 0 || (region[g] > REGIONS && region[g] <= REGIONS + 3));
        count[region[g] == 0 ? 3 : region[g] - REGIONS - 1] += 1.0;
    }
    for (int p = 0; p < 3; ++p)
        assert_near(count[p], share[p] * GRAINS, 1.0);
    assert_near(count[3], 0.25 * GRAINS, 1.0);
    assert_true(count[1] == 0.0);
    free_domain(&d);
}

static void shares_that_sum_to_one_leave_no_grain_without_a_phase(void **state)
{
    const double share[3] = {0.1, 0.2, 0.7}; /* sums to 1 - 1.1e-16 in doubles */
    const brc_grains grains = {.n = 33, .seed = 4, .n_phases = 3, .fraction = share};
    brc_domain *d = with_grains(*state, 1000, &grains, 0, 1);
    for (int64_t e = 0; e < d->n_elements; ++e)
        assert_in_range(d->region[e], 1, 3);
    free_domain(&d);
}

static void the_grains_do_not_depend_on_the_number_of_threads_but_on_the_seed(void **state)
{
    const double share[1] = {0.5};
    brc_grains grains = {.n = 60, .seed = 8, .n_phases = 1, .fraction = share};
    brc_domain *one = with_grains(*state, 3000, &grains, 0, 1), *three = with_grains(*state, 3000, &grains, 0, 3);
    const size_t bytes = (size_t)one->n_elements * sizeof *one->grain;
    assert_memory_equal(one->grain, three->grain, bytes);
    assert_memory_equal(one->region, three->region, bytes);
    free_domain(&three);
    int32_t *first = one->grain; /* equal bodies of one scene get grains of their own */
    one->grain = NULL;
    for (int64_t e = 0; e < one->n_elements; ++e)
        one->body[e] = 1;
    assert_int_equal(brc_grains_assign(*state, &grains, 0, 1, one), BRC_OK);
    assert_memory_not_equal(one->grain, first, bytes);
    grains.seed = 9;
    brc_domain *other = with_grains(*state, 3000, &grains, 0, 1);
    assert_memory_not_equal(first, other->grain, bytes);
    brc_memory_free(first);
    free_domain(&one);
    free_domain(&other);
}

static void interfaces_are_the_bonds_between_grains(void **state)
{
    const brc_grains grains = {.n = 30, .seed = 2};
    brc_domain *d = with_grains(*state, 1000, &grains, 0, 1);
    int64_t across = 0, within = 0;
    for (int64_t h = 0; h < d->n_half_edges; ++h) {
        const int32_t i = d->neighbour[h], j = d->neighbour[d->twin[h]];
        if (d->grain[i] == d->grain[j])
            ++within;
        else
            ++across;
    }
    assert_true(across > 0 && within > 0);
    assert_int_equal(2 * brc_grains_count_interfaces(d), across);
    free_domain(&d);
    const brc_grains none = {.n = 0}, single = {.n = 1};
    d = with_grains(*state, 1000, &none, 0, 1);
    assert_null(d->grain);
    assert_int_equal(brc_grains_count_interfaces(d), 0);
    free_domain(&d);
    d = with_grains(*state, 1000, &single, 0, 1);
    assert_int_equal(brc_grains_count_interfaces(d), 0);
    free_domain(&d);
}

/* A random division into grains of one mean volume: Poisson points would scatter volumes by 42 % (three-dimensional
 * Poisson-Voronoi cells); centres that keep a distance must scatter less, or the distance does nothing. */
static void grains_by_size_have_that_size_and_are_more_even_than_poisson_cells(void **state)
{
    const brc_grains grains = {.size = 0.125, .seed = 6};
    brc_domain *d = with_grains(*state, 20000, &grains, 0, 2);
    double volume[512] = {0.0}, square = 0.0;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        assert_in_range(d->grain[e], 0, 511);
        volume[d->grain[e]] += d->volume[e];
    }
    for (int g = 0; g < 512; ++g) {
        assert_true(volume[g] > 0.0);
        square += pow(volume[g] * 512.0 - 1.0, 2.0) / 512.0;
    }
    assert_true(sqrt(square) < 0.42);
    print_message("standard deviation of grain volumes: %.3f of the mean\n", sqrt(square));
    free_domain(&d);
}

static void the_grain_size_of_spheres_counts_the_pores(void **state)
{
    enum { N = 512 };
    double position[3 * N], volume[N];
    int32_t region[N] = {0}, body[N] = {0};
    for (int e = 0; e < N; ++e) {
        const int index[3] = {e % 8, e / 8 % 8, e / 64};
        for (int k = 0; k < 3; ++k)
            position[3 * e + k] = index[k] + 0.5;
        volume[e] = 0.5236;
    }
    brc_domain d = {.element_kind = BRC_ELEMENT_SPHERE,
                    .n_elements = N,
                    .position = position,
                    .volume = volume,
                    .region = region,
                    .body = body,
                    .quality = {.volume_shape = 512.0}};
    const brc_grains grains = {.size = 4.0};
    assert_int_equal(brc_grains_assign(*state, &grains, 0, 1, &d), BRC_OK);
    int32_t most = 0;
    for (int e = 0; e < N; ++e)
        most = d.grain[e] > most ? d.grain[e] : most;
    assert_int_equal(most + 1, 8);
    brc_memory_free(d.grain);
}

static void wrong_requests_are_refused_with_the_cure(void **state)
{
    const brc_build_request request = test_box(1000, 0.9);
    brc_domain *d = test_build(*state, &request);
    const double too_much[2] = {0.6, 0.5}, negative[1] = {-0.1};
    const struct {
        brc_grains grains;
        const char *part;
    } wrong[] = {
        {{.n = 126},
         "126 grains of 0.199 m are finer than two of the 1000 elements (0.1 m) across; ask for at most 125 grains "
         "(0.2 m) "},
        {{.size = 0.15}, "finer than two of the 1000 elements"},
        {{.n = -1}, "must be finite and 0 or more"},
        {{.n = 10, .size = 0.5}, "must be one of them"},
        {{.n = 10, .n_phases = 2, .fraction = too_much}, "sum to 1.1, must be at most 1"},
        {{.n = 10, .n_phases = 1, .fraction = negative}, "share of phase 1 is -0.1, must be 0 to 1"},
        {{.n = 10, .n_phases = 1}, "1 phases without shares"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        brc_context_clear(*state);
        assert_int_equal(brc_grains_assign(*state, &wrong[k].grains, 0, 1, d), BRC_BAD_INPUT);
        test_says(*state, wrong[k].part);
        assert_null(d->grain);
    }
    brc_domain_free(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(there_are_as_many_grains_as_asked_each_with_elements, test_begin, test_end),
        cmocka_unit_test_setup_teardown(an_element_belongs_to_the_grain_of_the_nearest_centre, test_begin, test_end),
        cmocka_unit_test_setup_teardown(shares_of_phases_hold_to_one_grain_and_regions_follow_those_of_the_scene,
                                        test_begin, test_end),
        cmocka_unit_test_setup_teardown(shares_that_sum_to_one_leave_no_grain_without_a_phase, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_grains_do_not_depend_on_the_number_of_threads_but_on_the_seed, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(interfaces_are_the_bonds_between_grains, test_begin, test_end),
        cmocka_unit_test_setup_teardown(grains_by_size_have_that_size_and_are_more_even_than_poisson_cells, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(the_grain_size_of_spheres_counts_the_pores, test_begin, test_end),
        cmocka_unit_test_setup_teardown(wrong_requests_are_refused_with_the_cure, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
