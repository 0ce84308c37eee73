/* Numbers for people: round steps and units with prefixes. */
#ifndef BRC_OUTPUT_LABEL_H
#define BRC_OUTPUT_LABEL_H

/* Round step (1, 2 or 5 times a power of ten) that divides `range` > 0 into about `parts` parts. */
double brc_label_step(double range, int parts);
/* A unit that suits values up to `largest`: writes e.g. "MPa" and returns what values are multiplied with (1e-6). Units
 * without prefixes ("-", "rad", most compound ones) are kept and give 1. UTF-8. */
double brc_label_unit(const char *unit, double largest, char out[32]);
/* A number of so many digits with its unit: "8.0624 MPa", "0.25". */
void brc_label_value(double value, const char *unit, int digits, char out[64]);
/* How far a value is off its target: "+0.78 %"; where `error` is the difference of the two and no share, as of
 * Poisson's ratio: "+0.0019". */
void brc_label_error(double value, double target, double error, char out[32]);
/* `value` with as many digits as `step` needs. */
void brc_label_number(double value, double step, char out[32]);

#endif
