/* Round steps and prefixes. */
#include "label.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

double brc_label_step(double range, int parts)
{
    const double rough = range / parts;
    const double decade = pow(10, floor(log10(rough)));
    const double part = rough / decade;
    return decade * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

/* Kilograms and square metres, whose prefixes do not go by thousands of the unit; 0: another unit. */
static double odd_unit(const char *unit, double largest, char out[32])
{
    static const struct {
        const char *unit, *name;
        double from, factor; /* the largest of a unit that is not above the value */
    } odd[] = {
        {"kg", "kg", 1, 1},     {"kg", "g", 1e-3, 1e3},     {"kg", "mg", 1e-6, 1e6},        {"kg", "\xc2\xb5g", 0, 1e9},
        {"m^2", "m^2", 0.1, 1}, {"m^2", "mm^2", 1e-8, 1e6}, {"m^2", "\xc2\xb5m^2", 0, 1e12}};
    for (size_t k = 0; k < sizeof odd / sizeof odd[0]; ++k)
        if (strcmp(unit, odd[k].unit) == 0 && largest >= odd[k].from * (1 - 1e-9)) {
            snprintf(out, 32, "%s", odd[k].name);
            return odd[k].factor;
        }
    return 0;
}

double brc_label_unit(const char *unit, double largest, char out[32])
{
    static const char *const prefixed[] = {"Pa", "N", "N m", "m", "J", "Hz", "m/s", "s"};
    static const char *const prefix[] = {"p", "n", "\xc2\xb5", "m", "", "k", "M", "G", "T"};
    const double odd = largest > 0 && isfinite(largest) ? odd_unit(unit, largest, out) : 0;
    if (odd > 0) return odd;
    snprintf(out, 32, "%s", unit);
    bool known = false;
    for (size_t k = 0; k < sizeof prefixed / sizeof prefixed[0]; ++k)
        known |= strcmp(unit, prefixed[k]) == 0;
    if (!known || !(largest > 0) || !isfinite(largest)) return 1;
    int power = (int)floor(log10(largest * (1 + 1e-9)) / 3);
    power = power < -4 ? -4 : power > 4 ? 4 : power;
    if ((unit[0] == 'm' || unit[0] == 's') && power > 0) power = 0; /* nobody says megametre */
    snprintf(out, 32, "%s%s", prefix[power + 4], unit);
    return pow(10, -3 * power);
}

void brc_label_value(double value, const char *unit, int digits, char out[64])
{
    char prefixed[32];
    const double factor = brc_label_unit(unit, fabs(value), prefixed);
    const bool has_unit = unit[0] && strcmp(unit, "-") != 0;
    snprintf(out, 64, "%.*g%s%s", digits, factor * value, has_unit ? " " : "", has_unit ? prefixed : "");
}

void brc_label_error(double value, double target, double error, char out[32])
{
    const double share = value / target - 1, difference = value - target;
    if (target != 0 && fabs(error - share) <= fabs(error - difference))
        snprintf(out, 32, "%+.3g %%", 100 * error);
    else
        snprintf(out, 32, "%+.3g", error);
}

void brc_label_number(double value, double step, char out[32])
{
    if (fabs(value) < 1e-9 * fabs(step)) value = 0;
    const double most = fmax(fabs(value), fabs(step));
    if (most >= 1e5 || (most < 1e-3 && most > 0)) {
        int digits = (int)(floor(log10(most)) - floor(log10(fabs(step)) + 1e-9));
        digits = digits < 0 ? 0 : digits > 9 ? 9 : digits;
        snprintf(out, 32, "%.*e", digits, value);
        return;
    }
    int decimals = (int)-floor(log10(fabs(step)) + 1e-9);
    decimals = decimals < 0 ? 0 : decimals > 12 ? 12 : decimals;
    snprintf(out, 32, "%.*f", decimals, value);
}
