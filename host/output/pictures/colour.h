/* Colours that show values: equal steps of a value look equally far apart, and lightness alone carries the order. */
#ifndef BRC_OUTPUT_COLOUR_H
#define BRC_OUTPUT_COLOUR_H

/* t in 0..1 (clamped; NAN gives grey) to sRGB 0..1. Sequential: dark violet over green to light yellow. */
void brc_colour_sequential(double t, double rgb[3]);
/* Diverging: blue, near white at 1/2, red; for fields with a zero in their middle. */
void brc_colour_diverging(double t, double rgb[3]);

#endif
