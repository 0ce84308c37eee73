/* The histogram of bond directions as the papers draw it: a surface whose radius is the density, red where it is above
 * the mean, blue below, around a circle that is the outline of the sphere of even directions (density 1). */
#ifndef BRC_OUTPUT_ISOTROPY_PICTURE_H
#define BRC_OUTPUT_ISOTROPY_PICTURE_H

#include "../../../preprocess/domain/isotropy.h"

/* PNG, 900 x 900, with the numbers below. BRC_FILE_FAILED: cannot be written; BRC_NO_MEMORY. */
brc_status brc_isotropy_picture(brc_context *context, const brc_isotropy *isotropy, const char *path);

/* One histogram of several. All borrowed for the call. */
typedef struct brc_isotropy_panel {
    const brc_isotropy *isotropy;
    char title[64], note[64]; /* above and below it */
} brc_isotropy_panel;

/* Several side by side, `columns` in a row, each as large as its place allows. `title`: above all. */
brc_status brc_isotropy_montage(brc_context *context, int n, const brc_isotropy_panel *panels, int columns,
                                const char *title, const char *path);

#endif
