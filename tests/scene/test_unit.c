/* Quantities: what a user writes becomes the nearest double in SI, and nothing else gets through. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../../host/scene/unit.h"

/* Exactly: powers of ten must round once, so that "5 um" is the literal 5e-6. */
static void reads_as(const char *text, const char *unit, double expected)
{
    double value = NAN;
    const brc_quantity_result result = brc_quantity_read(text, unit, &value);
    if (result != BRC_QUANTITY_OK || value != expected)
        fail_msg("'%s' in '%s': result %d (%s), value %.17g, expected %.17g", text, unit, (int)result,
                 brc_quantity_problem(result), value, expected);
}

static void fails_as(const char *text, const char *unit, brc_quantity_result expected)
{
    double value;
    const brc_quantity_result result = brc_quantity_read(text, unit, &value);
    if (result != expected) fail_msg("'%s' in '%s': result %d, expected %d", text, unit, (int)result, (int)expected);
}

static void quantities_become_si(void **state)
{
    (void)state;
    reads_as("72 GPa", "Pa", 72e9);
    reads_as("72GPa", "Pa", 72e9);
    reads_as("10 mm", "m", 10e-3);
    reads_as("5 us", "s", 5e-6);
    reads_as("0.2 um", "m", 0.2e-6);
    reads_as("54.068 nJ", "J", 54.068e-9);
    reads_as("2500 kg/m^3", "kg/m^3", 2500);
    reads_as("2.5 g/cm^3", "kg/m^3", 2500);
    reads_as("1 MN/m^2", "Pa", 1e6);
    reads_as("-9.81 m/s^2", "m/s^2", -9.81);
    reads_as("-9.81 m s^-2", "m/s^2", -9.81);
    reads_as("3 1/s", "1/s", 3);
    reads_as("3 Hz", "1/s", 3);
    reads_as("1 kN*m", "J", 1000);
    reads_as("1e-4 rad/m", "rad/m", 1e-4);
    reads_as("2 h", "s", 7200);
    reads_as("180 deg", "rad", 180 * (M_PI / 180));
    reads_as("90 %", "", 0.9);
    reads_as("90%", "", 0.9);
    reads_as("1 m/m", "", 1);
    reads_as("1.5e3 mm", "m", 1.5);
    reads_as("+.5 m", "m", 0.5);
    reads_as("5. m", "m", 5);
    reads_as("3 \xc2\xb5m", "m", 3e-6);
    reads_as("3 \xce\xbcm", "m", 3e-6);
}

static void every_prefix_has_its_power(void **state)
{
    (void)state;
    static const char *const prefix[] = {"Q", "R", "Y", "Z", "E", "P", "T", "G", "M", "k", "h", "da", "",
                                         "d", "c", "m", "u", "n", "p", "f", "a", "z", "y", "r", "q"};
    static const int power[] = {30, 27, 24, 21, 18, 15,  12,  9,   6,   3,   2,   1,  0,
                                -1, -2, -3, -6, -9, -12, -15, -18, -21, -24, -27, -30};
    for (size_t i = 0; i < sizeof power / sizeof power[0]; ++i) {
        char text[32], expected[32];
        snprintf(text, sizeof text, "7.3 %sPa", prefix[i]);
        snprintf(expected, sizeof expected, "7.3e%d", power[i]);
        reads_as(text, "Pa", strtod(expected, NULL));
    }
}

static void zero_needs_no_unit(void **state)
{
    (void)state;
    reads_as("0", "Pa", 0);
    reads_as("0.0", "kg/m^3", 0);
    reads_as("-0e7", "s", 0);
}

static void a_bare_number_is_refused_where_a_unit_is_due(void **state)
{
    (void)state;
    fails_as("3", "Pa", BRC_QUANTITY_BARE);
    fails_as("1e-9", "m", BRC_QUANTITY_BARE);
}

static void another_dimension_is_refused(void **state)
{
    (void)state;
    fails_as("3 m", "Pa", BRC_QUANTITY_WRONG_UNIT);
    fails_as("3 m", "", BRC_QUANTITY_WRONG_UNIT);
    fails_as("3 1/m", "rad/m", BRC_QUANTITY_WRONG_UNIT); /* angles are a dimension */
    fails_as("0 m", "s", BRC_QUANTITY_WRONG_UNIT);
    fails_as("3 %", "m", BRC_QUANTITY_WRONG_UNIT);
}

static void nothing_may_follow(void **state)
{
    (void)state;
    static const char *const bad[] = {"3 GPa x", "3 GPa,", "3 G",     "3 Pa^", "3 Pa^0",      "3 Pa^12", "3 Pa//m",
                                      "3 /m",    "3 Pa/",  "3 Pa /",  "3 1",   "3 1/",        "3 -",     "3 \t m",
                                      "3 PA",    "3 kkg",  "3 mdeg",  "3 k%",  "3 lightyear", "3 m/s/",  "3 3",
                                      "3e",      "1.2.3",  "3 m^--2", "3 m2",  "3 (m)",       "3,5 m"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        fails_as(bad[i], "Pa", BRC_QUANTITY_UNKNOWN_UNIT);
}

static void what_is_no_decimal_number_is_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"nan", "inf", "-inf", "Infinity", "GPa", ".", "-", "e5", "+", "--3", "(3)", " 3"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        fails_as(bad[i], "", BRC_QUANTITY_NO_NUMBER);
    fails_as("", "", BRC_QUANTITY_EMPTY);
    fails_as("0x10", "", BRC_QUANTITY_UNKNOWN_UNIT); /* a zero, and then something */
    fails_as("0x1p3", "", BRC_QUANTITY_UNKNOWN_UNIT);
}

static void what_no_double_holds_is_refused(void **state)
{
    (void)state;
    fails_as("1e999", "", BRC_QUANTITY_OVERFLOW);
    fails_as("-1e999", "", BRC_QUANTITY_OVERFLOW);
    fails_as("1e300 QPa", "Pa", BRC_QUANTITY_OVERFLOW);
    fails_as("1e-999", "", BRC_QUANTITY_OVERFLOW);
    fails_as("1e99999999999999999999", "", BRC_QUANTITY_OVERFLOW);
    fails_as("1 Qm^9*Qm^9", "", BRC_QUANTITY_UNKNOWN_UNIT);
}

/* A locale of its own: the machine may have none with a decimal comma. localedef belongs to the C library
 * (libc-bin). */
static void use_a_decimal_comma(void)
{
    FILE *const source = fopen("comma.src", "w");
    assert_non_null(source);
    fprintf(source, "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \"\"\ngrouping -1\nEND LC_NUMERIC\n");
    assert_int_equal(fclose(source), 0);
    /* -c: go on though the other categories are missing, which are warnings and exit code 1 */
    assert_true(system("localedef -c -i comma.src ./comma_locale >/dev/null 2>&1") >= 0);
    setenv("LOCPATH", ".", 1);
    assert_non_null(setlocale(LC_NUMERIC, "comma_locale"));
    unsetenv("LOCPATH");
    assert_string_equal(localeconv()->decimal_point, ",");
}

static void a_locale_with_a_decimal_comma_changes_nothing(void **state)
{
    (void)state;
    char text[40];
    use_a_decimal_comma();
    reads_as("1.5 m", "m", 1.5);
    brc_number_print(1.5, text, sizeof text);
    assert_string_equal(text, "1.5");
    setlocale(LC_ALL, "C");
}

static void printed_numbers_read_back(void **state)
{
    (void)state;
    static const double numbers[] = {0.1, 1.0 / 3, 2e-7, 5e-324, 1.7976931348623157e308, -72e9, 0, 123456789.125};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        char text[40];
        brc_number_print(numbers[i], text, sizeof text);
        assert_true(strtod(text, NULL) == numbers[i]);
    }
    char text[40];
    brc_number_print(2e-7, text, sizeof text);
    assert_string_equal(text, "2e-07"); /* the shortest that does */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantities_become_si),
        cmocka_unit_test(every_prefix_has_its_power),
        cmocka_unit_test(zero_needs_no_unit),
        cmocka_unit_test(a_bare_number_is_refused_where_a_unit_is_due),
        cmocka_unit_test(another_dimension_is_refused),
        cmocka_unit_test(nothing_may_follow),
        cmocka_unit_test(what_is_no_decimal_number_is_refused),
        cmocka_unit_test(what_no_double_holds_is_refused),
        cmocka_unit_test(a_locale_with_a_decimal_comma_changes_nothing),
        cmocka_unit_test(printed_numbers_read_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
