/* Passes: parameters of kernels found by name (host/solver/core/passes.h). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "../../../host/solver/core/passes.h"
#include <string.h>

/* damp_mass(n, factor, mass, velocity, lost): v <- factor v, and what that takes. */
typedef struct body {
    brc_buffer *mass, *velocity, *other, *lost;
    double factor;
    int32_t count;
} body;
static const brc_value_row body_values[] = {{"mass", BRC_VALUE_BUFFER, offsetof(body, mass)},
                                            {"velocity", BRC_VALUE_BUFFER, offsetof(body, velocity)},
                                            {"lost", BRC_VALUE_BUFFER, offsetof(body, lost)},
                                            {"factor", BRC_VALUE_REAL, offsetof(body, factor)}};

typedef struct fixture {
    brc_context *context;
    brc_device *device;
    brc_pass *passes;
    body of;
    brc_scope scope;
} fixture;

enum { ROWS = 16 }; /* whole groups on every device */

static brc_buffer *numbers(fixture *f, int n, double value)
{
    double room[3 * ROWS];
    brc_buffer *buffer = NULL;
    for (int k = 0; k < n; ++k)
        room[k] = value;
    assert_int_equal(brc_buffer_create(f->device, &buffer, 8 * n, "numbers"), BRC_OK);
    assert_int_equal(brc_buffer_write(buffer, 0, room, 8 * n), BRC_OK);
    return buffer;
}

static int set_up(void **state)
{
    static fixture f;
    f = (fixture){.context = brc_context_create()};
    const brc_device_request request = {.selector = "cpu", .precision = BRC_DOUBLE};
    assert_int_equal(brc_device_open(f.context, &request, &f.device), BRC_OK);
    f.of = (body){.mass = numbers(&f, ROWS, 3),
                  .velocity = numbers(&f, 3 * ROWS, 2),
                  .other = numbers(&f, 3 * ROWS, 10),
                  .lost = numbers(&f, ROWS, 0),
                  .factor = 0.5};
    f.scope = (brc_scope){.owner = "body", .base = &f.of, BRC_VALUES(body_values)};
    *state = &f;
    return 0;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    brc_passes_free(&f->passes);
    brc_buffer_free(&f->of.mass);
    brc_buffer_free(&f->of.velocity);
    brc_buffer_free(&f->of.other);
    brc_buffer_free(&f->of.lost);
    brc_device_close(&f->device);
    brc_context_free(&f->context);
    return 0;
}

static double first(brc_buffer *buffer)
{
    double x = 0;
    assert_int_equal(brc_buffer_read(buffer, 0, &x, sizeof x), BRC_OK);
    return x;
}

static brc_status make(fixture *f, const brc_scope *scope, const char *open, brc_pass **out)
{
    return brc_pass_make(f->context, f->device, scope, "damp_mass", open, &f->passes, out);
}

static void refused(fixture *f, brc_status status, const char *words, const char *more)
{
    assert_int_equal(status, BRC_INTERNAL);
    assert_non_null(strstr(brc_context_message(f->context), words));
    assert_non_null(strstr(brc_context_message(f->context), more));
}

static void a_launch_reads_what_stands_under_the_names(void **state)
{
    fixture *f = *state;
    brc_pass *pass = NULL;
    assert_int_equal(make(f, &f->scope, NULL, &pass), BRC_OK);
    refused(f, brc_pass_run(pass, ROWS - 1), "kernel damp_mass", "15 rows are not whole groups of");
    assert_int_equal(brc_pass_run(pass, ROWS), BRC_OK);
    assert_true(first(f->of.velocity) == 1); /* halves are exact */
    assert_true(first(f->of.lost) == 0.5 * 3 * (3 * 2 * 2 - 3 * 1 * 1));
    f->of.factor = 0.25; /* the value of the time of the launch, and the array: it may have been made anew */
    brc_buffer *before = f->of.velocity;
    f->of.velocity = f->of.other;
    assert_int_equal(brc_pass_run(pass, ROWS), BRC_OK);
    assert_true(first(f->of.other) == 2.5);
    assert_true(first(before) == 1);
    f->of.velocity = before;
}

static void a_name_that_nothing_provides_fails_when_the_pass_is_made(void **state)
{
    fixture *f = *state;
    brc_pass *pass = NULL;
    f->scope.n_values = 3; /* without factor */
    refused(f, make(f, &f->scope, NULL, &pass), "kernel damp_mass", "'factor'");
    assert_non_null(strstr(brc_context_message(f->context), "asked: body"));
    assert_null(pass);
    refused(f, make(f, &f->scope, "factor drift", &pass), "kernel damp_mass", "factor drift");
    assert_int_equal(make(f, &f->scope, "factor", &pass), BRC_OK);
}

static void a_number_for_an_array_and_an_int_for_a_number_are_refused(void **state)
{
    fixture *f = *state;
    brc_pass *pass = NULL;
    const brc_value_row number[] = {{"mass", BRC_VALUE_REAL, offsetof(body, factor)}},
                        count[] = {{"factor", BRC_VALUE_INT, offsetof(body, count)}};
    brc_scope view = {.owner = "view", .base = &f->of, BRC_VALUES(number), .outer = &f->scope};
    refused(f, make(f, &view, NULL, &pass), "'mass' is an array", "is a number");
    view.values = count;
    refused(f, make(f, &view, NULL, &pass), "'factor' is a number", "is an int");
}

static void inner_scopes_override_names_and_launches_give_their_owners(void **state)
{
    fixture *f = *state;
    brc_pass *pass = NULL;
    static const brc_value_row of_item[] = {{"factor", BRC_VALUE_REAL, offsetof(body, factor)}},
                               of_request[] = {{"velocity", BRC_VALUE_BUFFER, offsetof(body, other)}};
    const brc_scope request = {
        .owner = "request", .kind = BRC_SCOPE_REQUEST, BRC_VALUES(of_request), .outer = &f->scope};
    const brc_scope item = {.owner = "item", .kind = BRC_SCOPE_ITEM, BRC_VALUES(of_item), .outer = &request};
    assert_int_equal(make(f, &item, NULL, &pass), BRC_OK);
    const body load = {.factor = 0.25}, evaluation = {.other = f->of.other};
    assert_int_equal(brc_pass_run_on(pass, ROWS, &evaluation, &load, NULL), BRC_OK);
    assert_true(first(f->of.other) == 2.5 && first(f->of.velocity) == 2);
    refused(f, brc_pass_run_on(pass, ROWS, &evaluation, NULL, NULL), "kernel damp_mass",
            "its item, for its parameter 'factor'");
    refused(f, brc_pass_run_on(pass, ROWS, NULL, &load, NULL), "kernel damp_mass",
            "a request, for its parameter 'velocity'");
}

static void a_launch_gives_exactly_the_open_names(void **state)
{
    fixture *f = *state;
    brc_pass *pass = NULL;
    assert_int_equal(make(f, &f->scope, "factor", &pass), BRC_OK);
    assert_int_equal(BRC_RUN(pass, ROWS, {"factor", BRC_STATE(0.25)}), BRC_OK);
    assert_true(first(f->of.velocity) == 0.5);
    refused(f, brc_pass_run(pass, ROWS), "kernel damp_mass", "'factor'");
    refused(f, BRC_RUN(pass, ROWS, {"factor", BRC_STATE(1)}, {"kick", BRC_STATE(1)}), "kernel damp_mass",
            "gives 2 values, 1 are open");
}

/* A pass whose launches would give everything. */
static brc_pass *open_pass(fixture *f, const char *kernel, const char *names)
{
    brc_pass *pass = NULL;
    assert_int_equal(brc_pass_make(f->context, f->device, NULL, kernel, names, &f->passes, &pass), BRC_OK);
    return pass;
}

#define ITEMS "row_start neighbour ahead "
#define FLUX                                                                                                           \
    ITEMS "area offset ratio displacement gradient stress inv_shape inv_volume boundary held_moment face_loads "       \
          "k_one ell_one beta one_plus_tau material modulus ell_of finite flux bond_part"
#define BONDS "lambda_one mu_one young_one rotation_factor couple lame_of "

static void rings_follow_from_what_is_gathered(void **state)
{
    fixture *f = *state;
    int ring[4];
    static const char gradient[] = ITEMS "area displacement inv_shape gradient",
                      stress[] = ITEMS "area offset gradient inv_volume boundary held_gradient face_loads lambda_one "
                                       "mu_one material finite stress",
                      force[] = ITEMS "area ratio displacement flux bond_part k_one one_plus_tau modulus force";
    const brc_pass *const dlsm[] = {open_pass(f, "dlsm_gradient", gradient), open_pass(f, "dlsm_stress", stress),
                                    open_pass(f, "dlsm_flux_pass", FLUX), open_pass(f, "dlsm_force", force)};
    assert_int_equal(brc_passes_rings(4, dlsm, "area inv_shape", ring), BRC_OK);
    for (int k = 0; k < 4; ++k)
        assert_int_equal(ring[k], k);
    assert_int_equal(brc_passes_rings(4, dlsm, "displacement", ring), BRC_OK); /* moved: one ring more */
    for (int k = 0; k < 4; ++k)
        assert_int_equal(ring[k], k + 1);
    assert_int_equal(brc_passes_rings(4, dlsm, "gravity", ring), BRC_OK);
    assert_int_equal(ring[0], -1);
    const brc_pass *const listed[] = {
        open_pass(f, "dlsm_gradient_listed", BRC_LISTED " " ITEMS "area displacement inv_shape gradient"),
        open_pass(f, "dlsm_flux_pass_listed", BRC_LISTED " " FLUX)};
    assert_int_equal(brc_passes_rings(2, listed, "area inv_shape", ring), BRC_OK);
    assert_int_equal(ring[0], 0);
    assert_int_equal(ring[1], 1);
    const brc_pass *const published[] = {
        open_pass(f, "published_breaking_strain",
                  ITEMS "branch area area_weights displacement orientation inv_shape spanned finite strain"),
        open_pass(f, "published_force_pass",
                  ITEMS "branch area displacement orientation strain " BONDS "finite force torque")};
    assert_int_equal(brc_passes_rings(2, published, "area inv_shape spanned", ring), BRC_OK);
    assert_int_equal(ring[0], 0);
    assert_int_equal(ring[1], 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_launch_reads_what_stands_under_the_names, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_name_that_nothing_provides_fails_when_the_pass_is_made, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_number_for_an_array_and_an_int_for_a_number_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(inner_scopes_override_names_and_launches_give_their_owners, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_launch_gives_exactly_the_open_names, set_up, tear_down),
        cmocka_unit_test_setup_teardown(rings_follow_from_what_is_gathered, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
