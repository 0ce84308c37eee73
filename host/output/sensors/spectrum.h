/* The frequency of a recorded vibration. */
#ifndef BRC_OUTPUT_SPECTRUM_H
#define BRC_OUTPUT_SPECTRUM_H

#include "../../base/status.h"
#include <stdint.h>

/* Frequency of the largest peak of the Hann-windowed spectrum of n samples `interval` seconds apart [Hz]. The window's
 * own mean is removed first, so that an offset shows nothing. The peak of the FFT is refined on the continuous spectrum
 * of the windowed record: the result does not depend on bins. Over ten and more periods of one frequency it is right to
 * 1e-4 (the mirror image at the negative frequency moves it, by the fifth power of the number of periods or so less and
 * less); damping does not move it to first order. *out is NAN where there is no peak above one period in the record.
 * BRC_NO_MEMORY. */
brc_status brc_spectrum_peak(brc_context *context, int64_t n, const double *signal, double interval, double *out);

#endif
