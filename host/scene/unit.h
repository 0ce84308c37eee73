/* Quantities as a user writes them: a number, a space or none, a unit ("72 GPa", "2500 kg/m^3", "0.1 rad/m", "90 %").
 *
 * A unit is a product and quotient of named units with integer powers: "kg/m^3", "N m", "N*m", "m s^-2", "1/s". Named:
 * m g s N Pa J W Hz rad with the SI prefixes (Q R Y Z E P T G M k h da d c m u n p f a z y r q, and the two
 * micro signs for u), and without prefix: deg, min, h, "%". Angles are a dimension of their own, so that rad/m is not
 * 1/m. Numbers are decimal (no hexadecimal, inf or nan); nothing may follow the unit. */
#ifndef BRC_SCENE_UNIT_H
#define BRC_SCENE_UNIT_H

#include <stdbool.h>
#include <stddef.h>

/* Exponents of m, kg, s, rad. */
typedef struct brc_dimension {
    int exponent[4];
} brc_dimension;

/* What a text turned out to be; the texts of the failures are in brc_quantity_problem. */
typedef enum brc_quantity_result {
    BRC_QUANTITY_OK,
    BRC_QUANTITY_EMPTY,
    BRC_QUANTITY_NO_NUMBER,    /* does not start with a decimal number */
    BRC_QUANTITY_OVERFLOW,     /* beyond the range of double precision, to either side */
    BRC_QUANTITY_UNKNOWN_UNIT, /* what follows the number is no unit */
    BRC_QUANTITY_BARE /* a number without unit that is not 0, where a dimension is due (brc_quantity_read) */,
    BRC_QUANTITY_WRONG_UNIT /* a unit of another dimension (brc_quantity_read) */
} brc_quantity_result;

/* Parse a unit: *factor is its size in SI, *dimension its exponents. "" and "-" are dimensionless. False: no unit. */
bool brc_unit_parse(const char *text, double *factor, brc_dimension *dimension);
bool brc_dimension_equal(brc_dimension a, brc_dimension b);

/* Parse "number unit" into SI. *bare: no unit was given. */
brc_quantity_result brc_quantity_parse(const char *text, double *value, brc_dimension *dimension, bool *bare);
/* Parse a quantity that must have the dimension of `unit` ("Pa"; "" for a pure number). 0 needs no unit. */
brc_quantity_result brc_quantity_read(const char *text, const char *unit, double *value);
/* What is wrong, to stand after the quoted text: "is not a number with a unit". Static storage. */
const char *brc_quantity_problem(brc_quantity_result result);

/* Shortest decimal text that reads back to the same double, '.' as decimal point in any locale. */
void brc_number_print(double value, char *out, size_t size);

#endif
