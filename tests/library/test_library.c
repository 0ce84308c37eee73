/* The public interface: scenes with their errors, runs with observers, stepping by hand, the state as arrays. */
#include "support.h"
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* What went wrong is shown. */
static void assert_status(const breccia_run *run, breccia_status got, breccia_status expected)
{
    if (got != expected) fail_msg("%s: %s", breccia_status_text(got), breccia_run_message(run));
}

static void errors_have_places_and_cures(void **state)
{
    (void)state;
    static const char text[] =
        "version: 1\nmaterials:\n  glass: {density: 1 kg/m^3, E: 1 furlong, nu: 0.2}\nbodys: []\n";
    const char *const set[] = {"nothing.at.all=1"};
    breccia_scene *scene = breccia_scene_text("bad.yaml", text, strlen(text), 0, NULL);
    int n;
    const breccia_problem *p = breccia_scene_problems(scene, &n);
    assert_int_equal(breccia_scene_status(scene), BRECCIA_BAD_INPUT);
    assert_true(n == 4 && p[0].line == 1 && strstr(p[0].message, "'bodies' is missing"));
    assert_true(!p[2].is_warning && p[2].line == 3 && p[2].column == 33);
    assert_string_equal(p[2].file, "bad.yaml");
    assert_true(strncmp(p[2].message, "E: ", 3) == 0 && strncmp(p[2].cure, "expected a quantity in Pa", 25) == 0);
    assert_true(p[3].line == 4 && strstr(p[3].message, "bodys"));
    assert_null(breccia_scene_yaml(scene));
    breccia_run *run = breccia_run_create(scene, NULL);
    assert_status(run, breccia_run_go(run), BRECCIA_BAD_INPUT);
    breccia_run_free(run);
    breccia_scene_free(scene);
    scene = breccia_scene_text("bad.yaml", "version: 1\n", 11, 1, set);
    p = breccia_scene_problems(scene, &n);
    bool seen = false;
    for (int k = 0; k < n; ++k)
        seen |= strcmp(p[k].set, set[0]) == 0 && p[k].line == 0 && p[k].message[0];
    assert_true(seen);
    breccia_scene_free(scene);
    scene = breccia_scene_load("nowhere.yaml", 0, NULL);
    assert_int_equal(breccia_scene_status(scene), BRECCIA_BAD_INPUT);
    p = breccia_scene_problems(scene, &n);
    assert_true(n == 1 && strstr(p[0].message, "nowhere.yaml"));
    breccia_scene_free(scene);
}

static void a_check_counts_and_prices(void **state)
{
    (void)state;
    breccia_scene *scene = make_scene();
    breccia_price price;
    assert_int_equal(breccia_scene_check(scene, NULL, false, &price), BRECCIA_OK);
    assert_true(price.n_elements == 216 && price.n_models == 1 && price.n_bonds > 3 * 216 &&
                price.device_bytes > 216 * 100 && isnan(price.seconds));
    assert_int_equal(breccia_scene_check(scene, &(breccia_options){.device = "cpu", .threads = 1}, true, &price),
                     BRECCIA_OK);
    assert_true(price.seconds > 0 && price.least_seconds <= price.seconds && price.seconds <= price.most_seconds &&
                price.disk_bytes > 0);
    assert_int_equal(breccia_scene_check(scene, &(breccia_options){.precision = "triple"}, false, &price),
                     BRECCIA_BAD_INPUT);
    assert_non_null(strstr(breccia_scene_message(scene), "triple"));
    breccia_scene_free(scene);
}

typedef struct watch {
    int64_t n, last;
    int stages;
    bool reads, steps_itself;
    int64_t end_at, stop_at;
    double largest;
    pthread_t thread;
} watch;

static breccia_answer look(void *self, breccia_run *run, const breccia_moment *moment)
{
    watch *w = self;
    w->n += 1;
    w->last = moment->step;
    w->stages = moment->stage + 1;
    w->thread = pthread_self();
    if (w->reads) {
        breccia_array stress, velocity;
        double value[2];
        int64_t n_bonds, n_broken;
        assert_int_equal(breccia_run_array(run, "stress", 0, &stress), BRECCIA_OK);
        assert_int_equal(breccia_run_array(run, "velocity", 0, &velocity), BRECCIA_OK);
        assert_int_equal(breccia_run_read_sensors(run, value), BRECCIA_OK);
        assert_int_equal(breccia_run_bonds(run, &n_bonds, &n_broken), BRECCIA_OK);
        assert_true(value[1] == (double)n_broken);
        for (int64_t k = 0; k < 6 * stress.n_rows; ++k)
            w->largest = fmax(w->largest, fabs(((double *)stress.data)[k]));
    }
    if (w->steps_itself) {
        int64_t done;
        assert_int_equal(breccia_run_step(run, 1, &done), BRECCIA_BAD_INPUT);
        assert_int_equal(breccia_run_go(run), BRECCIA_BAD_INPUT);
        assert_int_equal(breccia_run_end(run), BRECCIA_BAD_INPUT);
    }
    return w->stop_at > 0 && moment->step == w->stop_at ? BRECCIA_STOP
           : w->end_at > 0 && moment->step == w->end_at ? BRECCIA_END_STAGE
                                                        : BRECCIA_GO_ON;
}

/* Run all into the folder. */
static void run_into(const char *folder, watch *w)
{
    breccia_scene *scene = make_scene();
    breccia_run *run = breccia_run_create(scene, &(breccia_options){.folder = folder, .device = "cpu"});
    if (w)
        assert_int_equal(breccia_run_observe(
                             run, &(breccia_observer){.self = w, .every_steps = 7, .stage_ends = true, .look = look}),
                         BRECCIA_OK);
    assert_status(run, breccia_run_go(run), BRECCIA_OK);
    breccia_report report;
    assert_int_equal(breccia_run_report(run, &report), BRECCIA_OK);
    assert_true(report.n_elements == 216 && report.steps == 150);
    assert_non_null(breccia_run_file(run, "summary.json"));
    assert_null(breccia_run_file(run, "picture.png"));
    breccia_run_free(run);
    breccia_scene_free(scene);
}

static void observers_and_hands_leave_no_trace(void **state)
{
    (void)state;
    char alone[FOLDER], observed[FOLDER], by_hand[FOLDER];
    make_folder(alone);
    make_folder(observed);
    make_folder(by_hand);
    run_into(alone, NULL);
    watch w = {.reads = true};
    run_into(observed, &w);
    assert_int_equal(w.n, (120 / 7 + 1) + 1 + (30 / 7 + 1) + 1); /* multiples of 7 with 0, and the ends */
    assert_true(w.last == 30 && w.stages == 2 && w.largest > 1e-4);
    assert_same_results(alone, observed);

    breccia_scene *scene = make_scene();
    breccia_run *run = breccia_run_create(scene, &(breccia_options){.folder = by_hand, .device = "cpu"});
    breccia_moment moment;
    int64_t done, all = 0;
    assert_int_equal(breccia_run_step(run, 0, &done), BRECCIA_OK);
    assert_int_equal(breccia_run_moment(run, &moment), BRECCIA_OK);
    assert_true(done == 0 && moment.stage == 0 && moment.step == 0 && moment.planned == 120);
    for (int64_t n = 11; breccia_run_step(run, n, &done) == BRECCIA_OK && done > 0; all += done) {
        assert_int_equal(breccia_run_moment(run, &moment), BRECCIA_OK);
        assert_true(moment.total_steps == all + done && (done == n || moment.total_steps == 150));
    }
    assert_int_equal(all, 150);
    assert_int_equal(breccia_run_end(run), BRECCIA_OK);
    assert_int_equal(breccia_run_parts(run), 0);
    breccia_run_free(run);
    breccia_scene_free(scene);
    assert_same_results(alone, by_hand);
    remove_folder(alone);
    remove_folder(observed);
    remove_folder(by_hand);
}

static void arrays_are_the_memory_of_the_device(void **state)
{
    (void)state;
    breccia_scene *scene = make_scene();
    breccia_run *run = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
    breccia_array v, u, reference, position, again;
    const char *names[16];
    assert_int_equal(breccia_run_array(run, "velocity", 0, &v), BRECCIA_BAD_INPUT);
    assert_int_equal(breccia_run_step(run, 10, NULL), BRECCIA_OK);
    const int n = breccia_run_array_names(run, 0, 16, names);
    assert_true(n == 9 && strcmp(names[0], "displacement") == 0);
    assert_int_equal(breccia_run_array(run, "velocity", 0, &v), BRECCIA_OK);
    assert_int_equal(breccia_run_array(run, "displacement", 0, &u), BRECCIA_OK);
    assert_int_equal(breccia_run_array(run, "reference", 0, &reference), BRECCIA_OK);
    assert_int_equal(breccia_run_array(run, "position", 0, &position), BRECCIA_OK);
    assert_true(v.is_live && u.is_live && !position.is_live && v.precision == 8 && v.width == 3 && v.n_rows >= 216 &&
                position.n_rows == 216);
    int64_t elements = 0;
    for (int64_t r = 0; r < u.n_rows; ++r) {
        const int32_t e = u.element[r];
        if (e < 0) continue;
        ++elements;
        for (int c = 0; c < 3; ++c)
            assert_true(((double *)position.data)[3 * e + c] ==
                        ((double *)u.data)[3 * r + c] + ((double *)reference.data)[3 * e + c]);
    }
    assert_int_equal(elements, 216);
    double *const live = u.data, before = live[0];
    assert_int_equal(breccia_run_step(run, 10, NULL), BRECCIA_OK);
    assert_true(live[0] != before); /* the same memory, ten steps later */
    assert_int_equal(breccia_run_array(run, "displacement", 0, &again), BRECCIA_OK);
    assert_ptr_equal(again.data, live);
    assert_int_equal(breccia_run_array(run, "voltage", 0, &v), BRECCIA_BAD_INPUT);
    assert_non_null(strstr(breccia_run_message(run), "voltage"));
    breccia_run_free(run);
    breccia_scene_free(scene);
}

static void observers_end_stages_and_runs(void **state)
{
    (void)state;
    char folder[FOLDER];
    make_folder(folder);
    breccia_scene *scene = make_scene();
    watch w = {.end_at = 21};
    breccia_run *run = breccia_run_create(scene, &(breccia_options){.folder = folder, .device = "cpu"});
    breccia_run_observe(run, &(breccia_observer){.self = &w, .every_steps = 7, .look = look});
    assert_status(run, breccia_run_go(run), BRECCIA_OK);
    breccia_report report;
    assert_int_equal(breccia_run_report(run, &report), BRECCIA_OK);
    assert_int_equal(report.steps, 21 + 21);
    assert_status(run, breccia_run_go(run), BRECCIA_BAD_INPUT);
    breccia_run_free(run);

    w = (watch){.stop_at = 14};
    run = breccia_run_create(scene, &(breccia_options){.folder = folder, .device = "cpu"});
    breccia_run_observe(run, &(breccia_observer){.self = &w, .every_steps = 7, .look = look});
    assert_status(run, breccia_run_go(run), BRECCIA_INTERRUPTED);
    breccia_run_report(run, &report);
    assert_int_equal(report.steps, 40); /* the end of the batch */
    size_t bytes;
    char *summary = read_file(folder, "summary.json", &bytes);
    assert_non_null(strstr(summary, "\"interrupted\""));
    free(summary);
    breccia_run_free(run);

    run = breccia_run_create(scene, &(breccia_options){.folder = folder, .device = "cpu", .resume = true});
    assert_status(run, breccia_run_go(run), BRECCIA_OK);
    breccia_run_report(run, &report);
    assert_int_equal(report.steps, 150);
    breccia_run_free(run);
    breccia_scene_free(scene);
    remove_folder(folder);
}

typedef struct ear {
    int n_told, n_lines;
    int64_t last;
    bool stop;
} ear;

static breccia_answer told(void *self, const breccia_moment *moment)
{
    ear *e = self;
    e->n_told += 1;
    assert_true(moment->total_steps >= e->last && moment->planned > 0 && moment->stage_name[0]);
    e->last = moment->total_steps;
    return e->stop ? BRECCIA_STOP : BRECCIA_GO_ON;
}

static void line(void *self, int level, const char *text)
{
    ear *e = self;
    e->n_lines += level == 2 && text[0];
}

static void observers_cannot_step_what_they_look_at(void **state)
{
    (void)state;
    breccia_scene *scene = make_scene();
    for (int by_hand = 0; by_hand < 2; ++by_hand) {
        watch w = {.steps_itself = true};
        breccia_run *run = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
        breccia_run_observe(run, &(breccia_observer){.self = &w, .every_steps = 50, .look = look});
        if (by_hand)
            assert_int_equal(breccia_run_step(run, 60, NULL), BRECCIA_OK);
        else
            assert_status(run, breccia_run_go(run), BRECCIA_OK);
        assert_true(w.n >= 2);
        breccia_run_free(run);
    }
    breccia_scene_free(scene);
}

static void a_run_that_is_interrupted_before_it_begins_does_not(void **state)
{
    (void)state;
    breccia_scene *scene = make_scene();
    breccia_run *run = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
    breccia_run_interrupt(run);
    assert_status(run, breccia_run_go(run), BRECCIA_INTERRUPTED);
    breccia_run_free(run);
    breccia_scene_free(scene);
}

static void progress_and_log_reach_the_caller(void **state)
{
    (void)state;
    breccia_scene *scene = make_scene();
    for (int stop = 0; stop < 2; ++stop) {
        ear e = {.stop = stop};
        breccia_run *run = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
        assert_int_equal(breccia_run_progress(run, 0, told, &e), BRECCIA_OK);
        assert_int_equal(breccia_run_log(run, 2, line, &e), BRECCIA_OK);
        assert_status(run, breccia_run_go(run), stop ? BRECCIA_INTERRUPTED : BRECCIA_OK);
        if (stop)
            assert_int_equal(e.n_told, 1);
        else
            assert_true(e.n_told >= 4 && e.last == 150); /* samples end batches at 40, 80, 120 and at the end */
        if (!stop) assert_true(e.n_lines > 0);           /* how quick the fracture was */
        breccia_run_free(run);
    }
    breccia_scene_free(scene);
}

static void a_run_by_hand_can_be_left(void **state)
{
    (void)state;
    char folder[FOLDER];
    make_folder(folder);
    breccia_scene *scene = make_scene();
    watch w = {0};
    int64_t done;
    breccia_run *run = breccia_run_create(scene, &(breccia_options){.folder = folder, .device = "cpu"});
    breccia_run_observe(run, &(breccia_observer){.self = &w, .every_steps = 5, .look = look});
    assert_int_equal(breccia_run_step(run, 23, &done), BRECCIA_OK);
    assert_true(done == 23 && w.n == 5 && w.last == 20 && !pthread_equal(w.thread, pthread_self()));
    assert_int_equal(breccia_run_end(run), BRECCIA_INTERRUPTED);
    assert_int_equal(breccia_run_step(run, 1, &done), BRECCIA_BAD_INPUT);
    breccia_report report;
    breccia_run_report(run, &report);
    assert_int_equal(report.steps, 23);
    breccia_run_free(run);
    run = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
    assert_int_equal(breccia_run_step(run, 130, &done), BRECCIA_OK); /* over the end of the first stage */
    breccia_moment moment;
    assert_int_equal(breccia_run_moment(run, &moment), BRECCIA_OK);
    assert_true(done == 130 && moment.stage == 1 && moment.step == 10 && moment.total_steps == 130);
    assert_status(run, breccia_run_go(run), BRECCIA_OK); /* what is left */
    breccia_run_free(run);
    run = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
    assert_int_equal(breccia_run_step(run, 150, &done), BRECCIA_OK); /* to the last step, before its stage is closed */
    assert_status(run, breccia_run_end(run), BRECCIA_OK);
    breccia_run_free(run);
    run = breccia_run_create(scene, &(breccia_options){.device = "cpu"});
    assert_int_equal(breccia_run_step(run, 5, &done), BRECCIA_OK);
    breccia_run_free(run); /* in the midst of it */
    breccia_scene_free(scene);
    remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_have_places_and_cures),
        cmocka_unit_test(a_check_counts_and_prices),
        cmocka_unit_test(observers_and_hands_leave_no_trace),
        cmocka_unit_test(arrays_are_the_memory_of_the_device),
        cmocka_unit_test(observers_end_stages_and_runs),
        cmocka_unit_test(progress_and_log_reach_the_caller),
        cmocka_unit_test(a_run_by_hand_can_be_left),
        cmocka_unit_test(observers_cannot_step_what_they_look_at),
        cmocka_unit_test(a_run_that_is_interrupted_before_it_begins_does_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
