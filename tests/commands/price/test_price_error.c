/* The error class does not know how fast the machine is: what is compared is decided by counts. */
#include "../support.h"
#include "../../../host/commands/price/price_error.h"
#include "../../../host/commands/price/price_work.h"
#include "../../../host/scene/scene_reader.h"
#include <stdio.h>
#include <string.h>

static const char *const block =
    "version: 1\nmaterials: {stone: {E: 20 GPa, nu: 0.2, density: 1000 kg/m^3}}\nmodel: dlsm\n"
    "bodies: [{name: block, shape: {box: {size: [1 m, 0.5 m, 0.5 m]}}, fill: {noisy_grid: {elements: 256, spread: 90 "
    "%, lloyd: 2}}}]\n"
    "stages:\n  - name: pull\n    solver: {static: {finite_strain: false}}\n    loads: [{face_displacement: {set: x-, "
    "x: 0, y: 0, z: 0}}, {face_displacement: {set: x+, x: 1 um, y: 0, z: 0}}]\n"
    "  - name: swing\n    solver: {dynamic: {steps: 40}}\n"
    "sensors: {energy: {energy: total}}\nmeasure: {energy: {peak: {of: energy}}}\noutput: {frames: none, picture: "
    "false}\n";

typedef struct tried {
    brc_context *context;
    brc_scene *scene;
    brc_setup setup;
    brc_trial trial;
} tried;

static const brc_device_request device = {.selector = "cpu", .precision = BRC_DOUBLE, .n_threads = 1};

static int begin(void **state)
{
    static tried t;
    t = (tried){.context = brc_context_create()};
    *state = &t;
    if (!t.context || brc_scene_read_text(t.context, "block", block, strlen(block), 0, NULL, &t.scene) != BRC_OK ||
        brc_setup_domains(t.context, t.scene, NULL, 1, &t.setup) != BRC_OK ||
        brc_setup_simulations(t.context, &device, &t.setup) != BRC_OK ||
        brc_trial_run(t.context, &t.setup, &device, false, &t.trial) != BRC_OK)
        return -1;
    brc_setup_free_simulations(&t.setup);
    return 0;
}

static int end(void **state)
{
    tried *t = *state;
    brc_trial_free(&t->trial);
    brc_setup_free(&t->setup);
    brc_scene_free(&t->scene);
    brc_context_free(&t->context);
    return 0;
}

static double error_found(tried *t)
{
    brc_price_error error;
    if (brc_price_error_find(t->context, t->scene, &t->setup, &device, &t->trial, &error) != BRC_OK)
        fail_msg("%s", brc_context_message(t->context));
    assert_int_equal(error.worst, 0);
    assert_false(error.out_of_time);
    const double found = error.error[0];
    brc_price_error_free(&error);
    return found;
}

/* A machine that is ten thousand times slower: the trial is cut, and every pace is other. */
static void a_slow_machine_finds_the_same_error(void **state)
{
    tried *t = *state;
    assert_false(isnan(t->trial.measures[0]));
    const double fast = error_found(t), measured = t->trial.measures[0];
    t->trial.measures[0] = NAN;
    for (int32_t k = 0; k < t->trial.n_stages; ++k) {
        brc_trial_stage *stage = &t->trial.stages[k];
        stage->cut = true;
        stage->done = 1;
        stage->pace_s *= 1e4, stage->warm_s *= 1e4, stage->whole_s *= 1e4, stage->enter_s *= 1e4;
    }
    const double slow = error_found(t);
    t->trial.measures[0] = measured;
    assert_true(fast > 0 && fast < 1);
    assert_true(slow == fast);
}

/* 40 steps of every bond, one solve of 40 iterations (multigrid), 5 for each element across with blocks, three sweeps
 * or tessellations of 200 a cell. */
static void work_is_counted(void **state)
{
    tried *t = *state;
    const double n_bonds = (double)brc_setup_n_bonds(&t->setup), n = (double)brc_setup_n_elements(&t->setup),
                 across = brc_setup_across(&t->setup);
    for (int32_t k = 0; k < t->scene->n_stages; ++k)
        t->scene->stages[k].preconditioner = BRC_PRECONDITIONER_MULTIGRID;
    assert_near(brc_price_work(t->scene, &t->setup, &t->trial), 40 * n_bonds + 40 * n_bonds + 3 * 200 * n,
                1e-6 * n_bonds);
    for (int32_t k = 0; k < t->scene->n_stages; ++k)
        t->scene->stages[k].preconditioner = BRC_PRECONDITIONER_BLOCKS;
    assert_near(brc_price_work(t->scene, &t->setup, &t->trial), 40 * n_bonds + 5 * across * n_bonds + 3 * 200 * n,
                1e-6 * n_bonds);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_slow_machine_finds_the_same_error),
                                       cmocka_unit_test(work_is_counted)};
    return cmocka_run_group_tests(tests, begin, end);
}
