#include "../support.h"

#include "../../../host/base/file.h"
#include "../../../host/base/memory.h"
#include "../../../host/base/random.h"
#include "../../../preprocess/domain/isotropy.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static brc_isotropy count(void *context, int64_t n, const double *direction, const double *weight, int level,
                          int threads)
{
    brc_isotropy i;
    if (brc_isotropy_count(context, n, direction, weight, level, threads, &i) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    return i;
}

static brc_isotropy measure(void *context, const brc_domain *domain, int level, brc_isotropy_weight weight)
{
    brc_isotropy i;
    if (brc_isotropy_measure(context, domain, level, weight, 1, &i) != BRC_OK)
        fail_msg("%s", brc_context_message(context));
    return i;
}

/* Even, independent directions: height and longitude uniform (Archimedes). */
static double *even_directions(void *context, uint64_t seed, int64_t n)
{
    double *d, r[4];
    assert_int_equal(BRC_ALLOCATE(context, &d, 3 * n, "test"), BRC_OK);
    for (int64_t k = 0; k < n; ++k) {
        brc_random_uniform4(seed, BRC_RANDOM_TEST, (uint64_t)k, 0, r);
        const double z = 2 * r[0] - 1, across = sqrt(1 - z * z), turn = 2 * M_PI * r[1];
        d[3 * k] = across * cos(turn);
        d[3 * k + 1] = across * sin(turn);
        d[3 * k + 2] = z;
    }
    return d;
}

/* Three directions, a third of the bonds each: F = I/3, nx^4 + ny^4 + nz^4 = 1, so cubic = 5/3 - 1, and six equal bins
 * (at level 2 their vertices lie on the axes). */
static void a_lattice_of_cubes_has_an_even_fabric_and_the_cubic_order_two_thirds(void **state)
{
    const brc_build_request r = test_box(1000, 0.0);
    brc_domain *d = test_build(*state, &r);
    brc_isotropy i = measure(*state, d, 2, BRC_ISOTROPY_AREA);
    for (int c = 0; c < 6; ++c)
        assert_near(i.fabric[c], c < 3 ? 1.0 / 3 : 0, 1e-13); /* rounding of 2700 sums */
    assert_near(i.fabric_anisotropy, 0, 1e-12);
    assert_near(i.cubic, 2.0 / 3, 1e-12);
    assert_int_equal(i.n_directions, 2700);
    int full = 0;
    for (int32_t b = 0; b < i.n_bins; ++b) {
        if (i.count[b] == 0) continue;
        ++full;
        const double *n = i.direction + 3 * b;
        assert_near(fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2]))), 1, 1e-15);
        assert_near(i.density[b], 4 * M_PI / (6 * i.solid_angle[b]), 1e-12 * i.density[b]);
    }
    assert_int_equal(full, 6);
    brc_isotropy_free(&i);
    brc_domain_free(&d);
}

static void parallel_planar_and_diagonal_directions_have_the_numbers_of_the_header(void **state)
{
    const double parallel[6] = {1, -2, 0.5, -2, 4, -1}, diagonal[12] = {1, 1, 1, -1, 1, 1, 1, -1, 1, 1, 1, -1};
    double planar[3 * 64];
    for (int k = 0; k < 64; ++k) {
        planar[3 * k] = cos(M_PI * k / 64);
        planar[3 * k + 1] = 0;
        planar[3 * k + 2] = sin(M_PI * k / 64);
    }
    brc_isotropy i = count(*state, 2, parallel, NULL, 3, 1);
    assert_near(i.fabric_anisotropy, 3, 1e-14);
    assert_near(i.fabric[5], -2 / 5.25, 1e-15);
    brc_isotropy_free(&i);
    i = count(*state, 64, planar, NULL, 3, 1);
    assert_near(i.fabric_anisotropy, 1.5, 1e-14);
    brc_isotropy_free(&i);
    i = count(*state, 4, diagonal, NULL, 3, 1);
    assert_near(i.fabric_anisotropy, 0, 1e-14);
    assert_near(i.cubic, -4.0 / 9, 1e-14);
    brc_isotropy_free(&i);
}

/* Density 2 |u| round an axis, u the height along it: u^2 is uniform, mean 1/2, and the rule of midpoints integrates it
 * exactly, as it does the even longitudes. So F = I/4 + a (x) a / 4 and anisotropy (1/2 - 1/4) / (1/3). A bin of level
 * 3 reaches 0.1 from its vertex, where the density has changed by 2 * 0.1 at most; its count is off by the points along
 * its rim, about 1 % of 160. */
static void a_distribution_round_an_axis_has_its_fabric_and_its_densities(void **state)
{
    enum { HEIGHTS = 320, TURNS = 320 };
    const double a[3] = {0.6, 0, 0.8}, b[3] = {0, 1, 0}, c[3] = {-0.8, 0, 0.6};
    double *d;
    assert_int_equal(BRC_ALLOCATE(*state, &d, 3 * HEIGHTS * TURNS, "test"), BRC_OK);
    for (int h = 0, k = 0; h < HEIGHTS; ++h)
        for (int t = 0; t < TURNS; ++t, ++k) {
            const double u = sqrt((h + 0.5) / HEIGHTS), across = sqrt(1 - u * u),
                         turn = 2 * M_PI * (t + 0.618 * h) / TURNS;
            for (int x = 0; x < 3; ++x)
                d[3 * k + x] = u * a[x] + across * (cos(turn) * b[x] + sin(turn) * c[x]);
        }
    brc_isotropy i = count(*state, HEIGHTS * TURNS, d, NULL, 3, 2);
    for (int x = 0; x < 6; ++x) {
        static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
        assert_near(i.fabric[x], 0.25 * (x < 3) + 0.25 * a[row[x]] * a[column[x]], 1e-12);
    }
    assert_near(i.fabric_anisotropy, 0.75, 1e-11);
    for (int32_t v = 0; v < i.n_bins; ++v) {
        const double *n = i.direction + 3 * v;
        assert_near(i.density[v], 2 * fabs(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]), 0.25);
    }
    brc_isotropy_free(&i);
    brc_memory_free(d);
}

/* rms^2 is Pearson's chi^2 over n with (n_bins - 2) / 2 degrees of freedom m, of variance 2 m (1 / n more at most per
 * bin): five standard deviations either side. Fabric and cubic order: five times the root mean square of theirs. */
static void even_random_directions_give_the_noise_and_no_order(void **state)
{
    const int64_t n = 100000;
    double *d = even_directions(*state, 1, n);
    for (int level = 1; level <= 4; ++level) {
        brc_isotropy i = count(*state, n, d, NULL, level, 2);
        const double m = (i.n_bins - 2) / 2.0;
        assert_near(i.noise, sqrt(m / (double)n), 1e-15);
        assert_near(i.rms_bin * i.rms_bin * (double)n, m, 5 * sqrt(2 * m) * 1.01);
        assert_true(i.fabric_anisotropy < 5 * i.fabric_noise && i.fabric_anisotropy > 0);
        assert_true(fabs(i.cubic) < 5 * i.cubic_noise);
        brc_isotropy_free(&i);
    }
    brc_memory_free(d);
}

/* The expectations are exact for few directions and for uneven weights: means over many draws agree with them within
 * five of their own standard errors. */
static void the_noise_is_the_exact_expectation(void **state)
{
    enum { DRAWS = 4000, N = 23 };
    double *d = even_directions(*state, 2, DRAWS * N), weight[N], sum[3] = {0}, square[3] = {0};
    for (int k = 0; k < N; ++k)
        weight[k] = k % 5; /* some 0 */
    for (int k = 0; k < DRAWS; ++k) {
        brc_isotropy i = count(*state, N, d + 3 * N * k, weight, 0, 1);
        assert_near(i.n_effective, 43.0 * 43 / 125, 1e-12); /* 0 1 2 3 4 four times, and 0 1 2: sums 43 and 125 */
        const double ratio[3] = {i.rms_bin / i.noise, i.fabric_anisotropy / i.fabric_noise, i.cubic / i.cubic_noise};
        for (int q = 0; q < 3; ++q) {
            sum[q] += ratio[q] * ratio[q] / DRAWS;
            square[q] += pow(ratio[q], 4) / DRAWS;
        }
        brc_isotropy_free(&i);
    }
    for (int q = 0; q < 3; ++q)
        assert_near(sum[q], 1, 5 * sqrt((square[q] - sum[q] * sum[q]) / DRAWS));
    brc_memory_free(d);
}

static void same_bytes(const brc_isotropy *a, const brc_isotropy *b)
{
    assert_memory_equal(a->count, b->count, (size_t)a->n_bins * sizeof *a->count);
    assert_memory_equal(a->density, b->density, (size_t)a->n_bins * sizeof *a->density);
    assert_memory_equal(a->fabric, b->fabric, sizeof a->fabric);
    assert_true(a->rms_bin == b->rms_bin && a->cubic == b->cubic && a->fabric_anisotropy == b->fabric_anisotropy);
}

static void neither_threads_nor_the_sense_of_a_direction_change_a_bit(void **state)
{
    const int64_t n = 30011;
    double *d = even_directions(*state, 3, n), *w;
    assert_int_equal(BRC_ALLOCATE(*state, &w, n, "test"), BRC_OK);
    for (int64_t k = 0; k < n; ++k)
        w[k] = 1 + sin((double)k);
    d[0] = 2; /* ties at level 0 */
    d[1] = d[2] = 0;
    brc_isotropy one = count(*state, n, d, w, 0, 1), three = count(*state, n, d, w, 0, 3);
    for (int64_t k = 0; k < 3 * n; ++k)
        d[k] = -d[k];
    brc_isotropy turned = count(*state, n, d, w, 0, 2);
    same_bytes(&one, &three);
    same_bytes(&one, &turned);
    brc_isotropy_free(&one);
    brc_isotropy_free(&three);
    brc_isotropy_free(&turned);
    brc_memory_free(d);
    brc_memory_free(w);
}

/* Sums over all half-edges, each face twice; means are the same. 1e-12: rounding of 15000 terms. */
static void the_bonds_of_a_domain_are_counted_once_or_with_their_area(void **state)
{
    const brc_build_request r = test_box(1000, 0.9);
    brc_domain *d = test_build(*state, &r);
    for (int area = 0; area < 2; ++area) {
        brc_isotropy i = measure(*state, d, 3, area ? BRC_ISOTROPY_AREA : BRC_ISOTROPY_BONDS);
        double xx = 0, yz = 0, total = 0, quartic = 0, counted = 0;
        for (int64_t h = 0; h < d->n_half_edges; ++h) {
            const double *s = d->area_vector + 3 * h, S = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]),
                         w = area ? S : 1;
            total += w;
            xx += w * s[0] * s[0] / (S * S);
            yz += w * s[1] * s[2] / (S * S);
            quartic += w * (pow(s[0] / S, 4) + pow(s[1] / S, 4) + pow(s[2] / S, 4));
        }
        for (int32_t b = 0; b < i.n_bins; ++b)
            counted += i.count[b];
        assert_near(i.fabric[0], xx / total, 1e-12);
        assert_near(i.fabric[3], yz / total, 1e-12);
        assert_near(i.cubic, quartic / total * 5 / 3 - 1, 1e-12);
        assert_near(counted, total, 1e-12 * total);
        assert_true(area ? i.n_effective < (double)d->n_bonds : i.n_effective == (double)d->n_bonds);
        brc_isotropy_free(&i);
    }
    brc_domain_free(&d);
}

/* Cubes, 8 a side: l layers less leave (8 - 2 l)^3 cells with 3 n^2 (n - 1) bonds among them. */
static void layers_at_the_walls_are_left_out(void **state)
{
    const brc_build_request r = test_box(512, 0.0);
    brc_domain *d = test_build(*state, &r);
    brc_isotropy i;
    for (int layers = 0; layers < 4; ++layers) {
        const int n = 8 - 2 * layers;
        assert_int_equal(brc_isotropy_measure_inside(*state, d, layers, 2, BRC_ISOTROPY_AREA, 1, &i), BRC_OK);
        assert_int_equal(i.n_directions, 3 * n * n * (n - 1));
        assert_near(i.n_effective, 3.0 * n * n * (n - 1), 1e-9);
        brc_isotropy_free(&i);
    }
    assert_int_equal(brc_isotropy_measure_inside(*state, d, 4, 2, BRC_ISOTROPY_BONDS, 1, &i), BRC_BAD_INPUT);
    test_says(*state, "fewer layers");
    assert_int_equal(brc_isotropy_measure_inside(*state, d, -1, 2, BRC_ISOTROPY_BONDS, 1, &i), BRC_BAD_INPUT);
    brc_domain_free(&d);
}

/* A chain of five spheres whose ends touch walls: four bonds, two of them between the three inner ones, none with two
 * layers less. */
static void spheres_at_a_wall_are_those_of_its_set(void **state)
{
    double position[15] = {0};
    int64_t rows[6] = {0, 1, 3, 5, 7, 8};
    int32_t neighbour[8] = {1, 0, 2, 1, 3, 2, 4, 3}, twin[8] = {1, 0, 3, 2, 5, 4, 7, 6},
            bond_half_edge[4] = {0, 2, 4, 6};
    int32_t low[1] = {0}, high[1] = {4};
    char low_name[] = "x-", high_name[] = "x+", *names[2] = {low_name, high_name};
    brc_set sets[2] = {{low_name, BRC_SET_ELEMENTS, 1, low}, {high_name, BRC_SET_ELEMENTS, 1, high}};
    brc_isotropy i;
    for (int e = 0; e < 5; ++e)
        position[3 * e] = e;
    const brc_domain d = {.element_kind = BRC_ELEMENT_SPHERE,
                          .n_elements = 5,
                          .n_bonds = 4,
                          .n_half_edges = 8,
                          .position = position,
                          .row_start = rows,
                          .neighbour = neighbour,
                          .twin = twin,
                          .bond_half_edge = bond_half_edge,
                          .n_walls = 2,
                          .wall_name = names,
                          .n_sets = 2,
                          .sets = sets};
    assert_int_equal(brc_isotropy_measure_inside(*state, &d, 1, 1, BRC_ISOTROPY_BONDS, 1, &i), BRC_OK);
    assert_int_equal(i.n_directions, 2);
    brc_isotropy_free(&i);
    assert_int_equal(brc_isotropy_measure_inside(*state, &d, 2, 1, BRC_ISOTROPY_BONDS, 1, &i), BRC_BAD_INPUT);
}

/* Volume inside the surface [m^3]: sum of a . (b x c) / 6. */
static double volume_of(const brc_isotropy *i)
{
    double volume = 0;
    for (int32_t t = 0; t < i->n_triangles; ++t) {
        double x[3][3];
        for (int k = 0; k < 3; ++k)
            for (int c = 0; c < 3; ++c)
                x[k][c] = i->density[i->triangle[3 * t + k]] * i->direction[3 * i->triangle[3 * t + k] + c];
        for (int c = 0; c < 3; ++c)
            volume += x[0][c] * (x[1][(c + 1) % 3] * x[2][(c + 2) % 3] - x[1][(c + 2) % 3] * x[2][(c + 1) % 3]) / 6;
    }
    return volume;
}

static void an_stl_file_holds_the_closed_surface(void **state)
{
    const char *path = "test_isotropy_surface.stl";
    double *d = even_directions(*state, 4, 5000);
    brc_isotropy i = count(*state, 5000, d, NULL, 2, 1);
    assert_int_equal(brc_isotropy_write_surface(*state, &i, path), BRC_OK);
    char *data;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(*state, path, 1 << 20, &data, &bytes), BRC_OK);
    uint32_t n;
    memcpy(&n, data + 80, sizeof n);
    assert_int_equal(n, i.n_triangles);
    assert_int_equal(bytes, 84 + 50 * n);
    double volume = 0;
    for (uint32_t t = 0; t < n; ++t) {
        float f[12];
        memcpy(f, data + 84 + 50 * t, sizeof f);
        const float *a = f + 3, *b = f + 6, *c = f + 9;
        double outward = 0;
        for (int k = 0; k < 3; ++k) {
            const int p = (k + 1) % 3, q = (k + 2) % 3;
            volume += a[k] * ((double)b[p] * c[q] - (double)b[q] * c[p]) / 6;
            outward +=
                f[k] * (((double)b[p] - a[p]) * ((double)c[q] - a[q]) - ((double)b[q] - a[q]) * ((double)c[p] - a[p]));
        }
        assert_true(outward > 0);
    }
    assert_near(volume, volume_of(&i), 1e-5); /* of about 4: single precision */
    unlink(path);
    brc_memory_free(data);
    brc_isotropy_free(&i);
    brc_memory_free(d);
}

static void a_vtp_file_holds_points_triangles_and_densities(void **state)
{
    const char *path = "test_isotropy_surface.vtp";
    double *d = even_directions(*state, 5, 500);
    brc_isotropy i = count(*state, 500, d, NULL, 1, 1);
    assert_int_equal(brc_isotropy_write_surface(*state, &i, path), BRC_OK);
    char *data, *at;
    size_t bytes;
    assert_int_equal(brc_file_read_whole(*state, path, 1 << 20, &data, &bytes), BRC_OK);
    assert_non_null(strstr(data, "<VTKFile type=\"PolyData\""));
    assert_non_null(strstr(data, "NumberOfPoints=\"42\""));
    assert_non_null(strstr(data, "NumberOfPolys=\"80\""));
    at = strstr(data, "Name=\"density\"");
    assert_non_null(at);
    at = strchr(at, '>') + 1;
    for (int32_t b = 0; b < i.n_bins; ++b)
        assert_true(strtod(at, &at) == i.density[b]);
    at = strchr(strstr(data, "Name=\"Points\""), '>') + 1;
    for (int32_t b = 0; b < i.n_bins; ++b)
        for (int c = 0; c < 3; ++c)
            assert_true(strtod(at, &at) == i.density[b] * i.direction[3 * b + c]);
    at = strchr(strstr(data, "Name=\"connectivity\""), '>') + 1;
    for (int32_t k = 0; k < 3 * i.n_triangles; ++k)
        assert_int_equal(strtol(at, &at, 10), i.triangle[k]);
    unlink(path);
    brc_memory_free(data);
    brc_isotropy_free(&i);
    brc_memory_free(d);
}

static void the_printed_lines_hold_the_numbers(void **state)
{
    const double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    brc_isotropy i = count(*state, 3, axes, NULL, 1, 1);
    FILE *file = tmpfile();
    assert_non_null(file);
    brc_isotropy_print(file, &i);
    char text[1024] = "";
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    const char *const parts[] = {"3 bonds in 42 bins", "xx 0.33333", "cubic order 0.6667", "worst bin"};
    for (size_t k = 0; k < sizeof parts / sizeof *parts; ++k)
        if (!strstr(text, parts[k])) fail_msg("'%s' is missing in\n%s", parts[k], text);
    brc_isotropy_free(&i);
}

static void what_cannot_be_counted_is_refused(void **state)
{
    const double d[6] = {1, 0, 0, 0, 0, 0}, none[1] = {0}, negative[1] = {-1};
    brc_isotropy i;
    brc_domain domain = {.element_kind = BRC_ELEMENT_SPHERE, .n_elements = 1};
    assert_int_equal(brc_isotropy_measure(*state, &domain, 3, BRC_ISOTROPY_BONDS, 1, &i), BRC_BAD_INPUT);
    test_says(*state, "no bond");
    domain.n_bonds = 1;
    assert_int_equal(brc_isotropy_measure(*state, &domain, 3, BRC_ISOTROPY_AREA, 1, &i), BRC_BAD_INPUT);
    test_says(*state, "no faces");
    assert_int_equal(brc_isotropy_count(*state, 2, d, NULL, 3, 1, &i), BRC_BAD_INPUT);
    test_says(*state, "direction 1 has length 0");
    assert_int_equal(brc_isotropy_count(*state, 1, d, negative, 3, 1, &i), BRC_BAD_INPUT);
    assert_int_equal(brc_isotropy_count(*state, 1, d, none, 3, 1, &i), BRC_BAD_INPUT);
    test_says(*state, "sum to 0");
    assert_int_equal(brc_isotropy_count(*state, 1, d, NULL, 7, 1, &i), BRC_BAD_INPUT);
    test_says(*state, "level 7");
    assert_int_equal(brc_isotropy_count(*state, 0, d, NULL, 3, 1, &i), BRC_BAD_INPUT);
    i = count(*state, 1, d, NULL, 0, 1);
    assert_int_equal(brc_isotropy_write_surface(*state, &i, "no/such/folder/a.stl"), BRC_FILE_FAILED);
    test_says(*state, "no/such/folder/a.stl");
    brc_isotropy_free(&i);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_lattice_of_cubes_has_an_even_fabric_and_the_cubic_order_two_thirds,
                                        test_begin, test_end),
        cmocka_unit_test_setup_teardown(parallel_planar_and_diagonal_directions_have_the_numbers_of_the_header,
                                        test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_distribution_round_an_axis_has_its_fabric_and_its_densities, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(even_random_directions_give_the_noise_and_no_order, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_noise_is_the_exact_expectation, test_begin, test_end),
        cmocka_unit_test_setup_teardown(neither_threads_nor_the_sense_of_a_direction_change_a_bit, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(the_bonds_of_a_domain_are_counted_once_or_with_their_area, test_begin,
                                        test_end),
        cmocka_unit_test_setup_teardown(layers_at_the_walls_are_left_out, test_begin, test_end),
        cmocka_unit_test_setup_teardown(spheres_at_a_wall_are_those_of_its_set, test_begin, test_end),
        cmocka_unit_test_setup_teardown(an_stl_file_holds_the_closed_surface, test_begin, test_end),
        cmocka_unit_test_setup_teardown(a_vtp_file_holds_points_triangles_and_densities, test_begin, test_end),
        cmocka_unit_test_setup_teardown(the_printed_lines_hold_the_numbers, test_begin, test_end),
        cmocka_unit_test_setup_teardown(what_cannot_be_counted_is_refused, test_begin, test_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
