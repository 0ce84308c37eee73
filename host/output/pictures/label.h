/* Numbers for people: round steps and units with prefixes. */
#ifndef BRC_OUTPUT_LABEL_H
#define BRC_OUTPUT_LABEL_H

/* Round step (1, 2 or 5 times a power of ten) that divides `range` > 0 into about `parts` parts. */
double brc_label_step(double range, int parts);
/* A unit that suits values up to `largest`: writes e.g. "MPa" and returns what values are multiplied with (1e-6). Units
 * without prefixes ("-", "rad", compound ones) are kept and give 1. UTF-8. */
double brc_label_unit(const char *unit, double largest, char out[32]);
/* `value` with as many digits as `step` needs. */
void brc_label_number(double value, double step, char out[32]);

#endif
