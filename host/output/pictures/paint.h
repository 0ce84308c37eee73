/* What pictures share: shaded polygons without seams, words, and a PNG written aside. Polygons are painted first,
 * without anti-aliasing at BRC_PAINT_OVERSAMPLE times the size, each with an edge of its own colour, and the whole is
 * averaged down: neighbours leave no seams, and slanted edges are smooth. Words and lines are drawn on top, in pixels
 * of the picture. */
#ifndef BRC_OUTPUT_PAINT_H
#define BRC_OUTPUT_PAINT_H

#include "../../base/status.h"
#include <cairo.h>
#include <stdint.h>

#define BRC_PAINT_OVERSAMPLE 3

/* A viewer without perspective: unit vectors to the right, up, and towards the viewer. */
typedef struct brc_paint_view {
    double right[3], up[3], toward[3];
} brc_paint_view;

/* From above the corner between x and -y: x runs right, y into the depth, z up. */
brc_paint_view brc_paint_corner_view(void);
/* From a side: "x", "-x", "y", "-y", "z", "-z"; of anything else the corner view. z is up; seen along z, y is. */
brc_paint_view brc_paint_side_view(const char *side);
/* The direction from one point to another one, which differs; up as above. */
brc_paint_view brc_paint_view_between(const double from[3], const double towards[3]);
/* Light of a face, 0.78 .. 1: a lamp over the viewer's left shoulder. normal: outward, any length above 0. */
float brc_paint_shade(const brc_paint_view *view, const double normal[3]);

/* A face to be painted. */
typedef struct brc_paint_face {
    double depth; /* of its middle, towards the viewer [m] */
    int32_t id;   /* the painter's own */
    float shade;
} brc_paint_face;

/* The farthest first. */
void brc_paint_sort(int64_t n, brc_paint_face *faces);

typedef struct brc_paint {
    brc_context *context;           /* borrowed */
    int width, height;              /* [px] */
    cairo_t *cairo;                 /* what is drawn on now; owned */
    cairo_surface_t *large, *small; /* owned */
    cairo_status_t drawn;           /* the first failure */
} brc_paint;

/* A white picture, ready for polygons. brc_paint_end must follow. */
void brc_paint_begin(brc_context *context, int width, int height, brc_paint *paint);
/* The next corner of a polygon [px of the picture], and its end: filled with shade * rgb, the edge darker by `line`
 * (0..1, 0: not). */
void brc_paint_corner(brc_paint *paint, double x, double y);
void brc_paint_fill(brc_paint *paint, const double rgb[3], double shade, double line);
/* A line among the polygons [px of the picture]. */
void brc_paint_line(brc_paint *paint, const double from[2], const double to[2], double width, const double rgb[3]);
/* Polygons are done; from here paint->cairo draws words and lines. */
void brc_paint_top(brc_paint *paint);
/* align: 0 left, 0.5 centred, 1 right of x. In the current colour. */
void brc_paint_words(brc_paint *paint, const char *words, double x, double y, double size, double align, bool bold);
/* Where the labels of the arrows go [px]: beyond their tips, none on another one. */
void brc_paint_axis_labels(const brc_paint_view *view, const double origin[2], double length, double label[3][2]);
/* Arrows x, y, z of this length [px] from `origin`; one that points at the viewer is a dot. */
void brc_paint_axes(brc_paint *paint, const brc_paint_view *view, const double origin[2], double length);
/* Write the PNG and free. BRC_FILE_FAILED: cannot be drawn or written. */
brc_status brc_paint_end(brc_paint *paint, const char *path);

#endif
