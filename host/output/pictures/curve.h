/* curve.png: one sensor against another, through gnuplot. */
#ifndef BRC_OUTPUT_CURVE_H
#define BRC_OUTPUT_CURVE_H

#include "../sensors/history.h"
#include "../../../preprocess/domain/domain.h"

/* Draw scene.output.curve_y against curve_x: measured points, fitted slope at zero and, where the scene's measures give
 * one, the line of the target. Where a measure of slope (E, nu, K, G, slope) reads just these two sensors, its stage,
 * window, area and scale are used: the curve is then the measure's own. *made: false where gnuplot is not installed or
 * there is nothing to draw: a warning in the log, and the numbers are in histories.csv. BRC_FILE_FAILED,
 * BRC_NO_MEMORY. */
/* domain: the one that has the measure's area (brc_curve_area_set). */
brc_status brc_curve_write(brc_context *context, const brc_scene *scene, const brc_domain *domain,
                           const brc_history *history, const char *path, bool *made);
/* The set whose area the curve's measure divides by; "" : none. */
void brc_curve_area_set(const brc_scene *scene, char out[BRC_NAME]);

#endif
