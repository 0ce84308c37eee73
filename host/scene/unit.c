/* Units and quantities. One table of names, one of prefixes; a strict reader of products, quotients and powers. */
#include "unit.h"
#include <ctype.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sizes are factor * 10^ten: powers of ten are kept apart so that "5 um" is the double nearest to 5e-6. */
typedef struct named_unit {
    const char *name;
    double factor;
    int ten; /* in SI: a gram is 10^-3 kg */
    int exponent[4];
    bool prefixes;
} named_unit;

static const named_unit UNITS[] = {
    /* without prefix first: "min" is a minute and "h" an hour */
    {"%", 1, -2, {0, 0, 0, 0}, false},   {"deg", M_PI / 180, 0, {0, 0, 0, 1}, false},
    {"min", 60, 0, {0, 0, 1, 0}, false}, {"h", 3600, 0, {0, 0, 1, 0}, false},
    {"m", 1, 0, {1, 0, 0, 0}, true},     {"g", 1, -3, {0, 1, 0, 0}, true},
    {"s", 1, 0, {0, 0, 1, 0}, true},     {"rad", 1, 0, {0, 0, 0, 1}, true},
    {"N", 1, 0, {1, 1, -2, 0}, true},    {"Pa", 1, 0, {-1, 1, -2, 0}, true},
    {"J", 1, 0, {2, 1, -2, 0}, true},    {"W", 1, 0, {2, 1, -3, 0}, true},
    {"Hz", 1, 0, {0, 0, -1, 0}, true},
};

static const struct {
    const char *name;
    int ten;
} PREFIXES[] = {
    {"da", 1},  {"Q", 30},  {"R", 27},        {"Y", 24},        {"Z", 21},  {"E", 18},  {"P", 15},
    {"T", 12},  {"G", 9},   {"M", 6},         {"k", 3},         {"h", 2},   {"d", -1},  {"c", -2},
    {"m", -3},  {"u", -6},  {"\xc2\xb5", -6}, {"\xce\xbc", -6}, {"n", -9},  {"p", -12}, {"f", -15},
    {"a", -18}, {"z", -21}, {"y", -24},       {"r", -27},       {"q", -30},
};

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* One name with or without prefix, `length` bytes long. */
static bool find_unit(const char *name, size_t length, const named_unit **unit, int *prefix)
{
    for (size_t i = 0; i < COUNT(UNITS); ++i) {
        if (strlen(UNITS[i].name) != length || memcmp(UNITS[i].name, name, length) != 0) continue;
        *unit = &UNITS[i];
        *prefix = 0;
        return true;
    }
    for (size_t p = 0; p < COUNT(PREFIXES); ++p) {
        const size_t skip = strlen(PREFIXES[p].name);
        if (skip >= length || memcmp(PREFIXES[p].name, name, skip) != 0) continue;
        for (size_t i = 0; i < COUNT(UNITS); ++i) {
            if (!UNITS[i].prefixes || strlen(UNITS[i].name) != length - skip) continue;
            if (memcmp(UNITS[i].name, name + skip, length - skip) != 0) continue;
            *unit = &UNITS[i];
            *prefix = PREFIXES[p].ten;
            return true;
        }
    }
    return false;
}

static bool is_name_byte(char c)
{
    return isalpha((unsigned char)c) || c == '%' || (unsigned char)c >= 0x80;
}

/* "^3", "^-2": one digit, not 0; no power: 1. Advances *text. */
static bool parse_power(const char **text, int *power)
{
    *power = 1;
    if (**text != '^') return true;
    ++*text;
    const int sign = **text == '-' ? -1 : 1;
    if (**text == '-') ++*text;
    if (**text < '1' || **text > '9') return false;
    *power = sign * (**text - '0');
    ++*text;
    return !isdigit((unsigned char)**text);
}

/* The unit is *factor * 10^*ten of its SI unit. */
static bool parse_unit(const char *text, double *factor, int *ten, brc_dimension *dimension)
{
    *factor = 1;
    *ten = 0;
    *dimension = (brc_dimension){{0, 0, 0, 0}};
    if (text[0] == '\0' || strcmp(text, "-") == 0) return true;
    int side = 1; /* -1 after a '/' */
    bool first = true;
    for (;;) {
        int power = 1;
        if (first && text[0] == '1' && text[1] == '/') { /* "1/s" */
            ++text;
        } else {
            size_t length = 0;
            while (is_name_byte(text[length]))
                ++length;
            const named_unit *unit = NULL;
            int prefix = 0;
            if (length == 0 || !find_unit(text, length, &unit, &prefix)) return false;
            text += length;
            if (!parse_power(&text, &power)) return false;
            power *= side;
            *factor *= pow(unit->factor, power);
            *ten += power * (unit->ten + prefix);
            for (int k = 0; k < 4; ++k) {
                dimension->exponent[k] += power * unit->exponent[k];
                if (abs(dimension->exponent[k]) > 99) return false;
            }
        }
        first = false;
        if (*text == '\0') break;
        /* The next factor: "/x", "*x", " x"; blanks around the sign are fine. */
        const char *next = text;
        while (*next == ' ')
            ++next;
        if (*next == '/' || *next == '*') {
            side = *next == '/' ? -1 : 1;
            ++next;
            while (*next == ' ')
                ++next;
        } else {
            if (next == text) return false;
            side = 1;
        }
        text = next;
    }
    return isfinite(*factor) && *factor > 0 && abs(*ten) <= 300;
}

/* value * 10^ten; dividing by an exact power of ten rounds once, multiplying by 1e-6 would round twice. */
static double scale_ten(double value, int ten)
{
    return ten >= 0 ? value * pow(10, ten) : value / pow(10, -ten);
}

bool brc_unit_parse(const char *text, double *factor, brc_dimension *dimension)
{
    int ten;
    if (!parse_unit(text, factor, &ten, dimension)) return false;
    *factor = scale_ten(*factor, ten);
    return isfinite(*factor) && *factor > 0;
}

bool brc_dimension_equal(brc_dimension a, brc_dimension b)
{
    return memcmp(a.exponent, b.exponent, sizeof a.exponent) == 0;
}

/* Length of the decimal number at the start of the text, 0 when there is none. */
static size_t number_length(const char *text, bool *has_nonzero_digit)
{
    size_t at = 0, digits = 0;
    *has_nonzero_digit = false;
    if (text[at] == '+' || text[at] == '-') ++at;
    for (bool point = false; isdigit((unsigned char)text[at]) || (text[at] == '.' && !point); ++at) {
        if (text[at] == '.') {
            point = true;
        } else {
            ++digits;
            if (text[at] != '0') *has_nonzero_digit = true;
        }
    }
    if (digits == 0) return 0;
    if (text[at] == 'e' || text[at] == 'E') {
        size_t exponent = at + 1;
        if (text[exponent] == '+' || text[exponent] == '-') ++exponent;
        if (isdigit((unsigned char)text[exponent])) {
            while (isdigit((unsigned char)text[exponent]))
                ++exponent;
            at = exponent;
        }
    }
    return at;
}

/* The number in text[0..length) times 10^ten, rounded once: the exponent is moved in the text, so that "0.2 um" is the
 * double nearest to 2e-7. False for a text that strtod reads otherwise. */
static bool read_decimal(const char *text, size_t length, int ten, double *value)
{
    char moved[512];
    size_t mantissa = 0;
    while (mantissa < length && text[mantissa] != 'e' && text[mantissa] != 'E')
        ++mantissa;
    long exponent = mantissa < length ? strtol(text + mantissa + 1, NULL, 10) : 0;
    exponent = exponent > 100000 ? 100000 : exponent < -100000 ? -100000 : exponent; /* beyond any double anyway */
    if (mantissa > sizeof moved - 32) return false;
    snprintf(moved, sizeof moved, "%.*se%ld", (int)mantissa, text, exponent + ten);
    locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0); /* a program around us may use a decimal comma */
    char *end = NULL;
    *value = plain ? strtod_l(moved, &end, plain) : strtod(moved, &end);
    if (plain) freelocale(plain);
    return *end == '\0';
}

brc_quantity_result brc_quantity_parse(const char *text, double *value, brc_dimension *dimension, bool *bare)
{
    *value = 0;
    *dimension = (brc_dimension){{0, 0, 0, 0}};
    *bare = true;
    if (text[0] == '\0') return BRC_QUANTITY_EMPTY;
    bool nonzero = false;
    const size_t length = number_length(text, &nonzero);
    if (length == 0) return BRC_QUANTITY_NO_NUMBER;

    double factor = 1;
    int ten = 0;
    const char *unit = text + length;
    while (*unit == ' ')
        ++unit;
    if (*unit != '\0') {
        *bare = false;
        if (strcmp(unit, "-") == 0 || !parse_unit(unit, &factor, &ten, dimension)) return BRC_QUANTITY_UNKNOWN_UNIT;
    }
    double number;
    if (!read_decimal(text, length, factor == 1 ? ten : 0, &number)) return BRC_QUANTITY_NO_NUMBER;
    *value = factor == 1 ? number : scale_ten(number * factor, ten);
    if (!isfinite(*value) || (nonzero && *value == 0)) return BRC_QUANTITY_OVERFLOW;
    return BRC_QUANTITY_OK;
}

brc_quantity_result brc_quantity_read(const char *text, const char *unit, double *value)
{
    brc_dimension found, due;
    double factor;
    bool bare;
    const brc_quantity_result result = brc_quantity_parse(text, value, &found, &bare);
    if (result != BRC_QUANTITY_OK) return result;
    if (!brc_unit_parse(unit, &factor, &due)) return BRC_QUANTITY_WRONG_UNIT;
    if (brc_dimension_equal(found, due)) return BRC_QUANTITY_OK;
    if (bare) return *value == 0 ? BRC_QUANTITY_OK : BRC_QUANTITY_BARE;
    return BRC_QUANTITY_WRONG_UNIT;
}

const char *brc_quantity_problem(brc_quantity_result result)
{
    switch (result) {
    case BRC_QUANTITY_OK: return "is fine";
    case BRC_QUANTITY_EMPTY: return "is empty";
    case BRC_QUANTITY_NO_NUMBER: return "is not a decimal number";
    case BRC_QUANTITY_OVERFLOW: return "is beyond the range of double precision";
    case BRC_QUANTITY_UNKNOWN_UNIT: return "has an unknown unit or something after it";
    case BRC_QUANTITY_BARE: return "has no unit";
    case BRC_QUANTITY_WRONG_UNIT: return "has a unit of another kind";
    }
    return "is not understood";
}

void brc_number_print(double value, char *out, size_t size)
{
    locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    locale_t before = plain ? uselocale(plain) : (locale_t)0;
    for (int digits = 6; digits <= 17; ++digits) {
        snprintf(out, size, "%.*g", digits, value);
        if (strtod(out, NULL) == value) break;
    }
    if (plain) {
        uselocale(before);
        freelocale(plain);
    }
}
