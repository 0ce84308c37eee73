/* Figures drawn by gnuplot from a script with its data inside. */
#ifndef BRC_OUTPUT_GNUPLOT_H
#define BRC_OUTPUT_GNUPLOT_H

#include "../text.h"

/* Terminal, output file (`picture`: where gnuplot writes, with any letters), grid and border. */
void brc_gnuplot_begin(brc_text *script, int width, int height, const char *picture);
/* Draw the script, whose picture is `aside` (brc_file_aside of path), and put it at `path`. *made: false, with a
 * warning that names the file of the `numbers`, where gnuplot is not installed or could not draw. BRC_FILE_FAILED,
 * BRC_NO_MEMORY. */
brc_status brc_gnuplot_draw(brc_context *context, brc_text *script, const char *aside, const char *path,
                            const char *numbers, bool *made);

/* A figure at folder/name, width times height points. draw adds what follows brc_gnuplot_begin; numbers and *made as
 * above. */
typedef struct brc_gnuplot_figure {
    const char *folder, *name, *numbers;
    int width, height;
    void (*draw)(const void *self, brc_text *script);
    const void *self;
} brc_gnuplot_figure;
brc_status brc_gnuplot_make(brc_context *context, const brc_gnuplot_figure *figure, bool *made);

#endif
