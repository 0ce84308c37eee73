#include "../support.h"
#include "../../../host/base/file.h"
#include "../../../host/base/log.h"
#include "../../../host/commands/reproduce/operators.h"
#include "../../../preprocess/domain/build.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char scene[] = "version: 1\ntitle: Cube\nmaterials:\n  m: {E: 1 GPa, nu: 0.2, density: 1000 kg/m^3}\n"
                            "bodies:\n  - name: cube\n    shape: {box: {size: [1 m, 1 m, 1 m]}}\n"
                            "    fill: {noisy_grid: {elements: 1000, spread: 70 %, seed: 11}}\n"
                            "stages:\n  - name: none\n    solver: {dynamic: {steps: 1}}\n";

typedef struct made {
    brc_session session;
    brc_case_run run;
    brc_case what;
    brc_outcome outcome;
    brc_campaign campaign;
} made;

static made *make(int n_seeds)
{
    static made m; /* large */
    memset(&m, 0, sizeof m);
    m.session.context = brc_context_create();
    brc_log_set_level(m.session.context, BRC_LOG_ERROR);
    m.run = (brc_case_run){.name = "a", .n_seeds = n_seeds, .n_labels = 1, .labels = {{"sample", "cube"}}};
    m.what = (brc_case){.name = "made", .n_runs = 1, .runs = &m.run};
    m.outcome.run = &m.run;
    m.campaign = (brc_campaign){
        .session = &m.session, .what = &m.what, .folder = "made-isotropy", .outcomes = &m.outcome, .n_threads = 1};
    assert_int_equal(brc_operator_isotropy.obtain(&m.campaign, &m.outcome, "scene.yaml", scene, sizeof scene - 1, NULL),
                     BRC_OK);
    m.outcome.done = true;
    return &m;
}

static brc_isotropy measure(brc_context *context, uint64_t seed, brc_isotropy_weight weight)
{
    brc_domain *domain;
    brc_isotropy isotropy;
    const brc_build_request request = {
        .shape = {.kind = BRC_SHAPE_BOX, .size = {1, 1, 1}},
        .fill = {.kind = BRC_FILL_NOISY_GRID, .n_elements = 1000, .spread = 0.7, .seed = seed},
        .n_threads = 1};
    assert_int_equal(brc_domain_build(context, &request, &domain), BRC_OK);
    assert_int_equal(brc_isotropy_measure(context, domain, 3, weight, 1, &isotropy), BRC_OK);
    brc_domain_free(&domain);
    return isotropy;
}

/* Two samples with the seeds 11 and 12: mean, and the standard deviation of two numbers |a - b| / sqrt 2. */
static void values_are_means_over_samples_with_their_scatter(void **state)
{
    (void)state;
    made *m = make(2);
    for (int w = 0; w < 2; ++w) {
        brc_isotropy a = measure(m->session.context, 11, (brc_isotropy_weight)w),
                     b = measure(m->session.context, 12, (brc_isotropy_weight)w);
        const brc_case_value *cubic = brc_outcome_find(&m->outcome, w ? "cubic_area" : "cubic"),
                             *rms = brc_outcome_find(&m->outcome, w ? "rms_bin_area" : "rms_bin"),
                             *excess = brc_outcome_find(&m->outcome, w ? "excess_area" : "excess");
        assert_near(cubic->value, (a.cubic + b.cubic) / 2, 1e-15);
        assert_near(cubic->scatter, fabs(a.cubic - b.cubic) / sqrt(2), 1e-8); /* from squares: half the digits */
        assert_near(rms->reference, (a.noise + b.noise) / 2, 1e-15);
        assert_near(excess->value * excess->value,
                    (a.rms_bin * a.rms_bin + b.rms_bin * b.rms_bin - a.noise * a.noise - b.noise * b.noise) / 2, 1e-12);
        assert_true(m->outcome.isotropy[w].cubic == a.cubic); /* the first is kept */
        double product = 0;                                   /* of the two samples' deviations */
        for (int32_t bin = 0; bin < a.n_bins; ++bin)
            product += a.solid_angle[bin] / (4 * M_PI) * (a.density[bin] - 1) * (b.density[bin] - 1);
        assert_near(brc_outcome_find(&m->outcome, w ? "common_area" : "common")->value, sqrt(product), 1e-9);
        assert_non_null(brc_outcome_find(&m->outcome, w ? "common_area_inside" : "common_inside"));
        brc_isotropy_free(&a);
        brc_isotropy_free(&b);
    }
    brc_isotropy_forget(&m->outcome);
    brc_context_free(&m->session.context);
}

static void one_sample_has_no_scatter_and_figures_are_drawn(void **state)
{
    (void)state;
    made *m = make(1);
    assert_true(isnan(brc_outcome_find(&m->outcome, "cubic")->scatter));
    assert_int_equal(brc_file_make_folder(m->session.context, "made-isotropy"), BRC_OK);
    assert_int_equal(brc_operator_isotropy.figure(&m->campaign), BRC_OK);
    assert_true(brc_file_exists("made-isotropy/made.png"));
    assert_true(brc_file_exists("made-isotropy/made-area.png"));
    assert_true(brc_file_exists("made-isotropy/made-inside.png"));
    assert_true(brc_file_exists("made-isotropy/made-area-inside.png"));
    assert_int_equal(system("rm -r made-isotropy"), 0);
    brc_isotropy_forget(&m->outcome);
    brc_context_free(&m->session.context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_means_over_samples_with_their_scatter),
        cmocka_unit_test(one_sample_has_no_scatter_and_figures_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
