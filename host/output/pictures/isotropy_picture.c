#include "isotropy_picture.h"
#include "colour.h"
#include "paint.h"
#include "../../base/memory.h"
#include <math.h>
#include <string.h>

enum { SINGLE = 900, PANEL = 220, PANEL_HEAD = 32, PANEL_FOOT = 26, MONTAGE_HEAD = 44, MONTAGE_FOOT = 40 };

/* Where a histogram stands. */
typedef struct place {
    double x, y, reach; /* middle, and how far it may extend [px] */
} place;

static double along(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* [px] a density of 1: the farthest corner, or the sphere of even directions where that is larger, fits. */
static double zoom_of(const brc_isotropy *i, const brc_paint_view *view, double reach)
{
    double most = 1;
    for (int64_t b = 0; b < i->n_bins; ++b) {
        const double *n = i->direction + 3 * b;
        most = fmax(most, i->density[b] * hypot(along(n, view->right), along(n, view->up)));
    }
    return reach / most;
}

/* White at 1; full colour at a half and less, and at one and a half and more. The same for every picture. */
static void colour_of(const brc_isotropy *i, const int32_t *triangle, double rgb[3])
{
    const double mean = (i->density[triangle[0]] + i->density[triangle[1]] + i->density[triangle[2]]) / 3;
    brc_colour_diverging(mean - 0.5, rgb);
}

/* The corner that is not in the middle, where that is just one: among empty bins a full one is a spike without area.
 * NULL: not so. */
static const int32_t *spike_of(const brc_isotropy *i, const int32_t *triangle)
{
    const int32_t *full = NULL;
    for (int k = 0; k < 3; ++k) {
        if (i->density[triangle[k]] == 0) continue;
        if (full) return NULL;
        full = &triangle[k];
    }
    return full;
}

/* Faces that look towards the viewer, and spikes, the farthest first; `faces` has room for all triangles. */
static int64_t find_faces(const brc_isotropy *i, const brc_paint_view *view, brc_paint_face *faces)
{
    int64_t n = 0;
    for (int32_t t = 0; t < i->n_triangles; ++t) {
        double x[3][3], normal[3], depth = 0;
        for (int k = 0; k < 3; ++k) {
            const int64_t b = i->triangle[3 * (int64_t)t + k];
            for (int c = 0; c < 3; ++c)
                x[k][c] = i->density[b] * i->direction[3 * b + c];
            depth += along(x[k], view->toward) / 3;
        }
        for (int c = 0; c < 3; ++c) {
            const int p = (c + 1) % 3, q = (c + 2) % 3;
            normal[c] = (x[1][p] - x[0][p]) * (x[2][q] - x[0][q]) - (x[1][q] - x[0][q]) * (x[2][p] - x[0][p]);
        }
        if (spike_of(i, i->triangle + 3 * (int64_t)t))
            faces[n++] = (brc_paint_face){.depth = depth, .id = t, .shade = 1};
        else if (along(normal, view->toward) > 0)
            faces[n++] = (brc_paint_face){.depth = depth, .id = t, .shade = brc_paint_shade(view, normal)};
    }
    brc_paint_sort(n, faces);
    return n;
}

static void paint_histogram(brc_paint *paint, const brc_isotropy *i, const brc_paint_view *view, const place *at,
                            brc_paint_face *faces)
{
    const double zoom = zoom_of(i, view, at->reach);
    const int64_t n = find_faces(i, view, faces);
    for (int64_t f = 0; f < n; ++f) {
        const int32_t *triangle = i->triangle + 3 * (int64_t)faces[f].id;
        const int32_t *spike = spike_of(i, triangle);
        const double middle[2] = {at->x, at->y};
        double rgb[3], corner[3][2];
        colour_of(i, triangle, rgb);
        for (int k = 0; k < 3; ++k) {
            const double *d = i->direction + 3 * (int64_t)triangle[k], radius = zoom * i->density[triangle[k]];
            corner[k][0] = at->x + radius * along(d, view->right);
            corner[k][1] = at->y - radius * along(d, view->up);
        }
        if (spike) {
            brc_paint_line(paint, middle, corner[spike - triangle], 3, rgb);
            continue;
        }
        for (int k = 0; k < 3; ++k)
            brc_paint_corner(paint, corner[k][0], corner[k][1]);
        brc_paint_fill(paint, rgb, faces[f].shade, 0);
    }
}

/* The outline of the sphere of density 1. */
static void draw_scale(brc_paint *paint, const brc_isotropy *i, const brc_paint_view *view, const place *at)
{
    const double dashes[2] = {5, 4};
    cairo_set_source_rgb(paint->cairo, 0.1, 0.1, 0.1);
    cairo_set_line_width(paint->cairo, 1.2);
    cairo_set_dash(paint->cairo, dashes, 2, 0);
    cairo_new_path(paint->cairo);
    cairo_arc(paint->cairo, at->x, at->y, zoom_of(i, view, at->reach), 0, 2 * M_PI);
    cairo_stroke(paint->cairo);
    cairo_set_dash(paint->cairo, NULL, 0, 0);
}

static void write_legend(brc_paint *paint, double x, double y, double size)
{
    cairo_set_source_rgb(paint->cairo, 0.35, 0.35, 0.35);
    brc_paint_words(paint,
                    "radius: density of directions; dashed: outline of the sphere of even directions (1); blue below, "
                    "red above (full at "
                    "0.5 and 1.5)",
                    x, y, size, 0.5, false);
}

/* Room to sort the largest histogram's triangles. */
static brc_status make_room(brc_context *context, int n, const brc_isotropy_panel *panels, brc_paint_face **faces)
{
    int64_t most = 0;
    for (int k = 0; k < n; ++k)
        if (panels[k].isotropy->n_triangles > most) most = panels[k].isotropy->n_triangles;
    return BRC_ALLOCATE(context, faces, most, "faces of the picture");
}

brc_status brc_isotropy_picture(brc_context *context, const brc_isotropy *i, const char *path)
{
    brc_paint_face *faces;
    brc_paint paint;
    char words[160];
    const brc_isotropy_panel panel = {.isotropy = i};
    const brc_paint_view view = brc_paint_corner_view();
    const place at = {SINGLE / 2.0, 440, 340};
    const double corner[2] = {80, 800};
    BRC_TRY(make_room(context, 1, &panel, &faces));
    brc_paint_begin(context, SINGLE, SINGLE, &paint);
    paint_histogram(&paint, i, &view, &at, faces);
    brc_paint_top(&paint);
    draw_scale(&paint, i, &view, &at);
    brc_paint_axes(&paint, &view, corner, 42);
    snprintf(words, sizeof words, "Directions of %lld bonds", (long long)i->n_directions);
    brc_paint_words(&paint, words, 40, 48, 26, 0, true);
    snprintf(words, sizeof words, "fabric anisotropy %.4f (by chance %.4f), cubic order %.4f (by chance %.4f)",
             i->fabric_anisotropy, i->fabric_noise, i->cubic, i->cubic_noise);
    brc_paint_words(&paint, words, 170, 812, 15, 0, false);
    snprintf(words, sizeof words, "%d bins: off by %.3f rms (by chance %.3f), worst %.3f", (int)i->n_bins, i->rms_bin,
             i->noise, i->worst_bin);
    brc_paint_words(&paint, words, 170, 836, 15, 0, false);
    write_legend(&paint, SINGLE / 2.0, 880, 13);
    brc_memory_free(faces);
    return brc_paint_end(&paint, path);
}

static place place_of(int k, int columns)
{
    return (place){PANEL * (k % columns + 0.5),
                   MONTAGE_HEAD + PANEL_HEAD + PANEL / 2.0 + (PANEL_HEAD + PANEL + PANEL_FOOT) * (double)(k / columns),
                   0.46 * PANEL};
}

brc_status brc_isotropy_montage(brc_context *context, int n, const brc_isotropy_panel *panels, int columns,
                                const char *title, const char *path)
{
    brc_paint_face *faces;
    brc_paint paint;
    const brc_paint_view view = brc_paint_corner_view();
    const int rows = (n + columns - 1) / columns, width = PANEL * columns,
              height = MONTAGE_HEAD + (PANEL_HEAD + PANEL + PANEL_FOOT) * rows + MONTAGE_FOOT;
    BRC_TRY(make_room(context, n, panels, &faces));
    brc_paint_begin(context, width, height, &paint);
    for (int k = 0; k < n; ++k) {
        const place at = place_of(k, columns);
        paint_histogram(&paint, panels[k].isotropy, &view, &at, faces);
    }
    brc_paint_top(&paint);
    for (int k = 0; k < n; ++k) {
        const place at = place_of(k, columns);
        draw_scale(&paint, panels[k].isotropy, &view, &at);
        brc_paint_words(&paint, panels[k].title, at.x, at.y - PANEL / 2.0 - 7, 15, 0.5, true);
        brc_paint_words(&paint, panels[k].note, at.x, at.y + PANEL / 2.0 + 14, 13, 0.5, false);
    }
    brc_paint_words(&paint, title, width / 2.0, 30, 18, 0.5, true);
    write_legend(&paint, width / 2.0, height - 14, fmin(13, width / 75.0)); /* 135 letters */
    brc_memory_free(faces);
    return brc_paint_end(&paint, path);
}
