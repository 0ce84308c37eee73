#include "../support.h"
#include "../../../host/output/sensors/history.h"
#include <math.h>

static void samples_survive_the_growth_of_the_table(void **state)
{
    (void)state;
    brc_history *h;
    assert_int_equal(brc_history_create(test_context, 2, &h), BRC_OK);
    for (int k = 0; k < 2000; ++k) {
        const double value[2] = {k, -k};
        assert_int_equal(brc_history_add(test_context, h, k / 1000, k, 0.5 * k, 2.0 * k, value), BRC_OK);
    }
    assert_int_equal(h->n_samples, 2000);
    for (int k = 0; k < 2000; ++k) {
        assert_int_equal(h->stage[k], k / 1000);
        assert_int_equal(h->step[k], k);
        assert_true(h->stage_time[k] == 0.5 * k && h->time[k] == 2.0 * k);
        assert_true(h->value[2 * k] == k && h->value[2 * k + 1] == -k);
    }
    brc_history_free(&h);
    assert_null(h);
}

static void missing_values_do_not_count_in_the_range(void **state)
{
    (void)state;
    brc_history *h;
    double last, smallest, largest;
    assert_int_equal(brc_history_create(test_context, 1, &h), BRC_OK);
    brc_history_range(h, 0, &last, &smallest, &largest);
    assert_true(isnan(last) && isnan(smallest) && isnan(largest));
    const double value[] = {NAN, 3, -2, NAN};
    for (int k = 0; k < 4; ++k)
        brc_history_add(test_context, h, 0, k, k, k, &value[k]);
    brc_history_range(h, 0, &last, &smallest, &largest);
    assert_true(isnan(last));
    assert_true(smallest == -2 && largest == 3);
    brc_history_free(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_survive_the_growth_of_the_table),
        cmocka_unit_test(missing_values_do_not_count_in_the_range),
    };
    return cmocka_run_group_tests(tests, test_begin, test_end);
}
