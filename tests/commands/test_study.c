/* Studies: the file, the values of runs, and the laws they are held against. */
#include "support.h"
#include "../../host/commands/study.h"
#include "../../host/base/memory.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static brc_status read_text(brc_context *context, const char *text, brc_study **out)
{
    char path[] = "study-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0 && write(file, text, strlen(text)) == (ssize_t)strlen(text));
    close(file);
    const brc_status status = brc_study_read(context, path, out);
    unlink(path);
    return status;
}

static void the_last_key_changes_fastest(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_study *study;
    char value[64];
    assert_int_equal(read_text(context,
                               "scene: a.yaml\nvary:\n  - {key: x, values: [1 mm, 2 mm]}\n  - {key: seed, from: 3, to: "
                               "5}\nfit: [{power: m, by: x}]\n",
                               &study),
                     BRC_OK);
    assert_true(study->n_runs == 6 && study->n_fits == 1 && study->fits[0].law == BRC_STUDY_POWER);
    assert_string_equal(study->scene, "a.yaml");
    static const char *const expected[6][2] = {{"1 mm", "3"}, {"1 mm", "4"}, {"1 mm", "5"},
                                               {"2 mm", "3"}, {"2 mm", "4"}, {"2 mm", "5"}};
    for (int run = 0; run < 6; ++run)
        for (int k = 0; k < 2; ++k)
            assert_string_equal(brc_study_value(study, run, k, value, sizeof value), expected[run][k]);
    brc_study_free(&study);
    brc_context_free(&context);
}

static void draws_have_their_distribution_and_their_seed(void **state)
{
    (void)state;
    enum { N = 4000 };
    brc_context *context = brc_context_create();
    brc_study *study, *other;
    char value[64], again[64];
    double sum[2] = {0}, square[2] = {0};
    static const char text[] = "scene: a.yaml\nvary: [{key: x, uniform: [2, 4], unit: GPa}, {key: y, normal: [10, "
                               "2]}]\ndraws: 4000\nseed: %d\n";
    char seven[160], eight[160];
    snprintf(seven, sizeof seven, text, 7);
    snprintf(eight, sizeof eight, text, 8);
    assert_int_equal(read_text(context, seven, &study), BRC_OK);
    assert_int_equal(read_text(context, eight, &other), BRC_OK);
    for (int run = 0; run < N; ++run)
        for (int k = 0; k < 2; ++k) {
            char *end;
            const double x = strtod(brc_study_value(study, run, k, value, sizeof value), &end);
            assert_string_equal(end, k ? "" : " GPa");
            assert_true(k || (x > 2 && x < 4));
            assert_string_equal(brc_study_value(study, run, k, again, sizeof again), value);
            assert_string_not_equal(brc_study_value(other, run, k, again, sizeof again), value);
            sum[k] += x / N;
            square[k] += x * x / N;
        }
    assert_true(fabs(sum[0] - 3) < 0.04 && fabs(sum[1] - 10) < 0.13); /* four standard errors */
    assert_true(fabs(sqrt(square[0] - sum[0] * sum[0]) - 2 / sqrt(12)) < 0.02 &&
                fabs(sqrt(square[1] - sum[1] * sum[1]) - 2) < 0.09);
    brc_study_free(&study);
    brc_study_free(&other);
    brc_context_free(&context);
}

static void keys_together_change_in_step(void **state)
{
    (void)state;
    brc_context *context = brc_context_create();
    brc_study *study;
    char value[64];
    static const char *const text = "scene: a.yaml\ntogether: true\nvary:\n  - {key: x, values: [1 mm, 2 mm, 4 mm]}\n  "
                                    "- {key: seed, from: 7, to: 9}\n"
                                    "  - {key: E, uniform: [1, 2], unit: GPa}\ndraws: 2\n";
    assert_int_equal(read_text(context, text, &study), BRC_OK);
    assert_int_equal(study->n_runs, 6);
    static const char *const expected[6][2] = {{"1 mm", "7"}, {"1 mm", "7"}, {"2 mm", "8"},
                                               {"2 mm", "8"}, {"4 mm", "9"}, {"4 mm", "9"}};
    for (int run = 0; run < 6; ++run)
        for (int k = 0; k < 2; ++k)
            assert_string_equal(brc_study_value(study, run, k, value, sizeof value), expected[run][k]);
    brc_study_free(&study);
    brc_context_free(&context);
}

static void what_is_wrong_is_told_with_its_place(void **state)
{
    (void)state;
    static const struct {
        const char *text, *told;
    } wrong[] = {
        {"scene: a.yaml\nvary: [{key: x}]\n", ":2:8: error: found a map, expected a map with `key` and one of"},
        {"scene: a.yaml\nvary: [{key: x, uniform: [1, 2]}]\n", "`draws` with keys"},
        {"scene: a.yaml\nvary: [{key: x, values: [1]}]\ndraws: 3\n", "`draws` with keys"},
        {"vary: [{key: x, values: [1]}]\n", "`scene: FILE`"},
        {"scene: a.yaml\ntogether: true\nvary: [{key: x, values: [1, 2]}, {key: y, values: [1, 2, 3]}]\n",
         "as many values in each key"},
        {"scene: a.yaml\nvary: [{key: x, from: 5, to: 2}]\n", "`to` of at least `from`"},
        {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nfit: [{power: m, by: y}]\n",
         "by: found 'y', expected a key of `vary`"},
        {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nfit: [{size_effect: m}]\n", "{size_effect: MEASURE, by: KEY}"},
        {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nfit: [{fragments: schuhmann, above: 0.1}]\n",
         ":3:7: error: found a map, expected {weibull: MEASURE}"},
        {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nfit: [{fragments: pareto}]\n", ":3:19: error: "},
        {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nfit: [{fragments: power, above: 0.1, below: 0.05}]\n",
         "`above` that is less than `below`"},
        {"scene: a.yaml\nvary: [{key: x, values: [1]}]\nseeds: 1\n", ":3:1: error: unknown key 'seeds'"}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        brc_context *context = brc_context_create();
        brc_study *study;
        assert_int_equal(read_text(context, wrong[k].text, &study), BRC_BAD_INPUT);
        assert_null(study);
        if (!strstr(brc_context_message(context), wrong[k].told))
            fail_msg("%s instead of %s", brc_context_message(context), wrong[k].told);
        brc_context_free(&context);
    }
}

/* A parameter of what was found; the test fails where it is missing. */
static double parameter(const brc_study_found *found, const char *name, bool error)
{
    for (int k = 0; k < found->n_parameters; ++k)
        if (strcmp(found->parameter[k].name, name) == 0)
            return error ? found->parameter[k].error : found->parameter[k].value;
    fail_msg("no parameter %s", name);
    return NAN;
}

/* The same numbers on every machine: a linear congruence, its upper bits, never 0 or 1. */
static double draw(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
}

/* Quantiles of a Weibull law of modulus 8 and scale 50: its own parameters come back, to what so many quantiles
 * leave. */
static void weibulls_law_is_found(void **state)
{
    (void)state;
    enum { N = 4001 };
    static double x[N];
    for (int i = 0; i < N; ++i)
        x[i] = 50 * pow(-log(1 - (i + 0.5) / N), 1.0 / 8);
    const brc_study_found found = brc_study_fit_weibull(N, x);
    assert_true(fabs(parameter(&found, "modulus", false) / 8 - 1) < 2e-3 &&
                fabs(parameter(&found, "scale", false) / 50 - 1) < 2e-4);
    const double equal[3] = {1, 1, 1}, negative[2] = {-1, 1};
    assert_true(brc_study_fit_weibull(3, equal).n_parameters == 0 &&
                brc_study_fit_weibull(2, negative).n_parameters == 0 && brc_study_fit_weibull(1, x).n_parameters == 0);
}

/* 4000 samples of 20 from modulus 8 and scale 50. The mean of the modulus is too high by 1.32 / 18, the unbiased one
 * is not: four standard errors of means of 4000 are 1.3 %, of the scale 0.2 % beside its own bias of 0.2 %. The
 * scatter over the samples is known to 4.5 % (four standard errors), and the errors that are told are those of many
 * values: at 20 the modulus scatters some 10 % more, and the scale 6 % more, as its error is told with a modulus that
 * is 7 % too high. */
static void weibulls_modulus_is_not_biased(void **state)
{
    (void)state;
    enum { N = 20, SAMPLES = 4000 };
    uint64_t random = 1;
    double x[N], plain = 0, unbiased = 0, scale = 0, modulus_square = 0, scale_square = 0, modulus_error = 0,
                 scale_error = 0;
    for (int sample = 0; sample < SAMPLES; ++sample) {
        for (int i = 0; i < N; ++i)
            x[i] = 50 * pow(-log(draw(&random)), 1.0 / 8);
        const brc_study_found found = brc_study_fit_weibull(N, x);
        const double m = parameter(&found, "modulus", false), s = parameter(&found, "scale", false);
        plain += m / SAMPLES;
        unbiased += parameter(&found, "unbiased_modulus", false) / SAMPLES;
        scale += s / SAMPLES;
        modulus_square += m * m / SAMPLES;
        scale_square += s * s / SAMPLES;
        modulus_error += parameter(&found, "modulus", true) / SAMPLES;
        scale_error += parameter(&found, "scale", true) / SAMPLES;
    }
    const double modulus_scatter = sqrt(modulus_square - plain * plain),
                 scale_scatter = sqrt(scale_square - scale * scale);
    assert_true(fabs(plain / 8 - 1.0733) < 0.013 && fabs(unbiased / 8 - 1) < 0.013 && fabs(scale / 50 - 1) < 4e-3);
    assert_true(modulus_scatter / modulus_error > 1 && modulus_scatter / modulus_error < 1.2 &&
                fabs(scale_scatter / scale_error - 1.06) < 0.045);
}

static void a_power_law_is_found_with_its_error(void **state)
{
    (void)state;
    double x[4] = {1, 2, 4, 8}, y[4];
    for (int i = 0; i < 4; ++i)
        y[i] = 3 * pow(x[i], -0.25);
    brc_study_found found = brc_study_fit_power(4, x, y);
    assert_true(fabs(parameter(&found, "factor", false) - 3) < 1e-12 &&
                fabs(parameter(&found, "exponent", false) + 0.25) < 1e-12 &&
                parameter(&found, "exponent", true) < 1e-12);
    /* residuals of one point off by d among four at equal distances h: b moves by 0.3 d / h, the sum of squares is
     * 0.3 d^2 */
    y[3] *= exp(0.1);
    found = brc_study_fit_power(4, x, y);
    assert_true(fabs(parameter(&found, "exponent", false) + 0.25 - 0.03 / log(2)) < 1e-12 &&
                fabs(parameter(&found, "exponent", true) - sqrt(0.003 / 2 / (5 * log(2) * log(2)))) < 1e-12);
    found = brc_study_fit_power(2, x, y);
    assert_true(found.n_parameters == 2 && isnan(parameter(&found, "exponent", true)));
    x[1] = x[2] = x[3] = 1;
    assert_true(brc_study_fit_power(4, x, y).n_parameters == 0);
    assert_true(fabs(brc_study_student(30) / 2.0423 - 1) < 2e-3 && brc_study_student(1) == 12.706 &&
                isnan(brc_study_student(0)));
}

/* Its own parameters come back from Bazant's law; nothing from a constant and from x^(-1/2), its two ends. With
 * scatter the fit is right within four of the errors that it tells, and tells errors of the size that 400 samples
 * scatter by (16 values each; four standard errors are 14 %, and the law bends within the scatter of 2 %: 25 %). */
static void bazants_size_effect_is_found(void **state)
{
    (void)state;
    enum { N = 16, SAMPLES = 400 };
    double x[N], y[N], mean = 0, square = 0, told = 0;
    uint64_t random = 1;
    for (int i = 0; i < N; ++i)
        x[i] = 0.01 * pow(2, i % 4 * 1.5), y[i] = 5e6 / sqrt(1 + x[i] / 0.04);
    const brc_study_found exact = brc_study_fit_size_effect(N, x, y);
    /* of a minimum: the root of rounding */
    assert_true(fabs(parameter(&exact, "strength", false) / 5e6 - 1) < 1e-6 &&
                fabs(parameter(&exact, "size", false) / 0.04 - 1) < 1e-5);
    for (int sample = 0; sample < SAMPLES; ++sample) {
        double noisy[N];
        for (int i = 0; i < N; ++i)
            noisy[i] = y[i] * exp(0.02 * sqrt(-2 * log(draw(&random))) * cos(2 * acos(-1) * draw(&random)));
        const brc_study_found found = brc_study_fit_size_effect(N, x, noisy);
        const double size = log(parameter(&found, "size", false) / 0.04),
                     error = parameter(&found, "size", true) / parameter(&found, "size", false);
        mean += size / SAMPLES;
        square += size * size / SAMPLES;
        told += error / SAMPLES;
    }
    assert_true(fabs(mean) < 4 * told / sqrt(SAMPLES) + 0.01 && fabs(sqrt(square - mean * mean) / told - 1) < 0.25);
    double even[N], steep[N];
    for (int i = 0; i < N; ++i)
        even[i] = 5e6, steep[i] = 5e6 / sqrt(x[i]);
    assert_true(brc_study_fit_size_effect(N, x, even).n_parameters == 0 &&
                brc_study_fit_size_effect(N, x, steep).n_parameters == 0 &&
                brc_study_fit_size_effect(2, x, y).n_parameters == 0);
}

/* ---- fragments ---- */

static brc_study_pieces pieces_of(brc_context *context, int n)
{
    brc_study_pieces pieces = {.n = n, .n_runs = 1};
    assert_int_equal(brc_memory_allocate(context, (void **)&pieces.share, n, sizeof *pieces.share, "fragments"),
                     BRC_OK);
    assert_int_equal(brc_memory_allocate(context, (void **)&pieces.elements, n, sizeof *pieces.elements, "fragments"),
                     BRC_OK);
    return pieces;
}

/* 6000 shares: below 1e-4 dust of another law, above it n(m) ~ m^-5/3. The cut is found near where the law begins,
 * the exponent within four of its standard errors, with a given cut, with a found one, and where nothing is larger
 * than 0.01. */
static void the_power_law_of_fragments_is_found(void **state)
{
    (void)state;
    enum { N = 6000, DUST = 2000 };
    static const double CUT = 1e-4, TAU = 5.0 / 3;
    brc_context *context = brc_context_create();
    brc_study_pieces pieces = pieces_of(context, N);
    brc_study_fit fit = {.law = BRC_STUDY_FRAGMENTS_POWER, .elements = 3, .above = CUT};
    brc_study_found found;
    uint64_t random = 3;
    for (int i = 0; i < N; ++i) {
        const double u = draw(&random);
        pieces.share[i] = i < DUST ? CUT * sqrt(u) : CUT * pow(u, -1 / (TAU - 1));
        pieces.elements[i] = 3;
    }
    assert_int_equal(brc_study_pieces_sort(context, &pieces), BRC_OK);
    assert_int_equal(brc_study_fit_fragments(context, &pieces, &fit, &found), BRC_OK);
    assert_true(found.n == N - DUST && fabs(parameter(&found, "exponent", true) - (TAU - 1) / sqrt(N - DUST)) < 1e-3);
    assert_true(fabs(parameter(&found, "exponent", false) - TAU) < 4 * parameter(&found, "exponent", true));
    fit.above = 0;
    assert_int_equal(brc_study_fit_fragments(context, &pieces, &fit, &found), BRC_OK);
    assert_true(parameter(&found, "lower_cut", false) > 0.8 * CUT && parameter(&found, "lower_cut", false) < 4 * CUT);
    /* 1 % */
    assert_true(fabs(parameter(&found, "exponent", false) - TAU) < 4 * parameter(&found, "exponent", true) &&
                parameter(&found, "distance", false) < 1.63 / sqrt(found.n));
    fit.above = CUT;
    fit.below = 0.01;
    assert_int_equal(brc_study_fit_fragments(context, &pieces, &fit, &found), BRC_OK);
    assert_true(found.n < N - DUST &&
                fabs(parameter(&found, "exponent", false) - TAU) < 4 * parameter(&found, "exponent", true));
    fit.elements = 4;
    assert_int_equal(brc_study_fit_fragments(context, &pieces, &fit, &found), BRC_OK);
    assert_int_equal(found.n_parameters, 0);
    brc_study_pieces_free(&pieces);
    brc_context_free(&context);
}

/* Mass below the size x. */
static double passing(brc_study_law law, double x)
{
    if (law == BRC_STUDY_SCHUHMANN) return pow(x / 0.4, 0.7);
    return law == BRC_STUDY_ROSIN_RAMMLER ? 1 - exp(-pow(x / 0.1, 0.9)) : 1 - exp(-x / 0.3 - pow(x / 0.15, 2));
}

/* Pieces of RUNS runs whose mass up to each size is that of a law, to one piece at most: sizes 0.1 % apart, as many
 * of each as its mass asks for. At the largest sieves one piece is 0.2 % of the mass, at the smallest 1e-6:
 * parameters come back within 1 %. */
static void laws_of_passing_mass_are_found(void **state)
{
    (void)state;
    enum { RUNS = 25, ROOM = 1000000 };
    static const double SMALLEST = 0.0299, MOST = 0.98;
    brc_context *context = brc_context_create();
    for (int law = BRC_STUDY_SCHUHMANN; law <= BRC_STUDY_GILVARRY; ++law) {
        brc_study_pieces pieces = pieces_of(context, ROOM);
        const brc_study_fit fit = {.law = (brc_study_law)law, .elements = 3};
        brc_study_found found;
        double sum = 0;
        pieces.n = 0;
        pieces.n_runs = RUNS;
        pieces.element = 0.03 * 0.03 * 0.03 / 3; /* the first sieve is 0.03 */
        for (double x = SMALLEST; passing(fit.law, x) < MOST; x *= 1.001)
            for (; sum < RUNS * passing(fit.law, x) && pieces.n < ROOM; ++pieces.n) {
                pieces.share[pieces.n] = x * x * x;
                sum += x * x * x;
            }
        assert_int_equal(brc_study_fit_fragments(context, &pieces, &fit, &found), BRC_OK);
        if (law == BRC_STUDY_GILVARRY) {
            assert_true(fabs(parameter(&found, "edge", false) / 0.3 - 1) < 0.01 &&
                        fabs(parameter(&found, "face", false) / 0.15 - 1) < 0.01);
            /* of the mass at the largest sieve less than a tenth of what faces give */
            assert_true(parameter(&found, "volume", false) > 0.4);
        } else {
            const bool schuhmann = law == BRC_STUDY_SCHUHMANN;
            assert_true(fabs(parameter(&found, "exponent", false) / (schuhmann ? 0.7 : 0.9) - 1) < 0.01 &&
                        fabs(parameter(&found, "size", false) / (schuhmann ? 0.4 : 0.1) - 1) < 0.01);
        }
        brc_study_pieces_free(&pieces);
    }
    brc_context_free(&context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_key_changes_fastest),
        cmocka_unit_test(draws_have_their_distribution_and_their_seed),
        cmocka_unit_test(keys_together_change_in_step),
        cmocka_unit_test(what_is_wrong_is_told_with_its_place),
        cmocka_unit_test(weibulls_law_is_found),
        cmocka_unit_test(weibulls_modulus_is_not_biased),
        cmocka_unit_test(a_power_law_is_found_with_its_error),
        cmocka_unit_test(bazants_size_effect_is_found),
        cmocka_unit_test(the_power_law_of_fragments_is_found),
        cmocka_unit_test(laws_of_passing_mass_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
