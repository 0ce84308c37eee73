#include "paint.h"
#include "../../base/file.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

brc_paint_view brc_paint_corner_view(void)
{
    const double azimuth = -62 * M_PI / 180, elevation = 24 * M_PI / 180;
    brc_paint_view v = {.toward = {cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)},
                        .right = {-sin(azimuth), cos(azimuth), 0}};
    for (int c = 0; c < 3; ++c)
        v.up[c] = v.toward[(c + 1) % 3] * v.right[(c + 2) % 3] - v.toward[(c + 2) % 3] * v.right[(c + 1) % 3];
    return v;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Right and up of a view whose `toward` is known, of any length. */
static void complete(brc_paint_view *v)
{
    const double length = sqrt(dot(v->toward, v->toward));
    for (int c = 0; c < 3; ++c)
        v->toward[c] /= length;
    const bool along_z = fabs(v->toward[2]) > 0.999;
    const double upward[3] = {0, along_z, !along_z}, high = dot(upward, v->toward);
    double norm = 0;
    for (int c = 0; c < 3; ++c)
        v->up[c] = upward[c] - high * v->toward[c];
    norm = sqrt(dot(v->up, v->up));
    for (int c = 0; c < 3; ++c)
        v->up[c] /= norm;
    for (int c = 0; c < 3; ++c)
        v->right[c] = v->up[(c + 1) % 3] * v->toward[(c + 2) % 3] - v->up[(c + 2) % 3] * v->toward[(c + 1) % 3];
}

brc_paint_view brc_paint_side_view(const char *side)
{
    const bool minus = side[0] == '-';
    const char axis = side[minus];
    brc_paint_view v = {.toward = {0}};
    if (axis < 'x' || axis > 'z' || side[minus + 1]) return brc_paint_corner_view();
    v.toward[axis - 'x'] = minus ? -1 : 1;
    complete(&v);
    return v;
}

brc_paint_view brc_paint_view_between(const double from[3], const double towards[3])
{
    brc_paint_view v = {.toward = {from[0] - towards[0], from[1] - towards[1], from[2] - towards[2]}};
    complete(&v);
    return v;
}

float brc_paint_shade(const brc_paint_view *view, const double n[3])
{
    static const double lamp[3] = {-0.06, 0.43, 0.90}; /* along right, up, toward */
    const double light =
        (dot(n, view->right) * lamp[0] + dot(n, view->up) * lamp[1] + dot(n, view->toward) * lamp[2]) / sqrt(dot(n, n));
    return (float)(0.78 + 0.22 * fmax(light, 0));
}

static int compare_faces(const void *a, const void *b)
{
    const brc_paint_face *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return p->id < q->id ? -1 : p->id > q->id;
}

void brc_paint_sort(int64_t n, brc_paint_face *faces)
{
    qsort(faces, (size_t)n, sizeof *faces, compare_faces);
}

void brc_paint_begin(brc_context *context, int width, int height, brc_paint *paint)
{
    *paint = (brc_paint){.context = context, .width = width, .height = height, .drawn = CAIRO_STATUS_SUCCESS};
    paint->large =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, BRC_PAINT_OVERSAMPLE * width, BRC_PAINT_OVERSAMPLE * height);
    paint->small = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    paint->cairo = cairo_create(paint->large);
    cairo_set_source_rgb(paint->cairo, 1, 1, 1);
    cairo_paint(paint->cairo);
    cairo_set_antialias(paint->cairo, CAIRO_ANTIALIAS_NONE);
    cairo_set_line_join(paint->cairo, CAIRO_LINE_JOIN_BEVEL);
}

void brc_paint_corner(brc_paint *paint, double x, double y)
{
    cairo_line_to(paint->cairo, BRC_PAINT_OVERSAMPLE * x, BRC_PAINT_OVERSAMPLE * y);
}

void brc_paint_fill(brc_paint *paint, const double rgb[3], double shade, double line)
{
    cairo_close_path(paint->cairo);
    cairo_set_source_rgb(paint->cairo, shade * rgb[0], shade * rgb[1], shade * rgb[2]);
    cairo_fill_preserve(paint->cairo);
    const double edge = shade * (1 - line);
    cairo_set_source_rgb(paint->cairo, edge * rgb[0], edge * rgb[1], edge * rgb[2]);
    cairo_set_line_width(paint->cairo, line > 0 ? 2 : 1);
    cairo_stroke(paint->cairo);
}

void brc_paint_line(brc_paint *paint, const double from[2], const double to[2], double width, const double rgb[3])
{
    cairo_move_to(paint->cairo, BRC_PAINT_OVERSAMPLE * from[0], BRC_PAINT_OVERSAMPLE * from[1]);
    cairo_line_to(paint->cairo, BRC_PAINT_OVERSAMPLE * to[0], BRC_PAINT_OVERSAMPLE * to[1]);
    cairo_set_source_rgb(paint->cairo, rgb[0], rgb[1], rgb[2]);
    cairo_set_line_width(paint->cairo, BRC_PAINT_OVERSAMPLE * width);
    cairo_stroke(paint->cairo);
}

/* Mean of BRC_PAINT_OVERSAMPLE x BRC_PAINT_OVERSAMPLE pixels. */
static void shrink(brc_paint *paint)
{
    cairo_surface_flush(paint->large);
    const unsigned char *from = cairo_image_surface_get_data(paint->large);
    unsigned char *to = cairo_image_surface_get_data(paint->small);
    const int from_row = cairo_image_surface_get_stride(paint->large),
              to_row = cairo_image_surface_get_stride(paint->small);
    for (int y = 0; y < paint->height; ++y)
        for (int x = 0; x < paint->width; ++x)
            for (int byte = 0; byte < 4; ++byte) {
                int sum = 0;
                for (int j = 0; j < BRC_PAINT_OVERSAMPLE; ++j)
                    for (int i = 0; i < BRC_PAINT_OVERSAMPLE; ++i)
                        sum +=
                            from[(BRC_PAINT_OVERSAMPLE * y + j) * from_row + 4 * (BRC_PAINT_OVERSAMPLE * x + i) + byte];
                to[y * to_row + 4 * x + byte] = (unsigned char)(sum / (BRC_PAINT_OVERSAMPLE * BRC_PAINT_OVERSAMPLE));
            }
    cairo_surface_mark_dirty(paint->small);
}

static void finish_layer(brc_paint *paint)
{
    if (paint->drawn == CAIRO_STATUS_SUCCESS && brc_file_writes()) paint->drawn = cairo_status(paint->cairo);
    cairo_destroy(paint->cairo);
    paint->cairo = NULL;
}

void brc_paint_top(brc_paint *paint)
{
    finish_layer(paint);
    if (paint->drawn == CAIRO_STATUS_SUCCESS) shrink(paint);
    paint->cairo = cairo_create(paint->small);
}

void brc_paint_words(brc_paint *paint, const char *words, double x, double y, double size, double align, bool bold)
{
    cairo_text_extents_t extents;
    cairo_select_font_face(paint->cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(paint->cairo, size);
    cairo_text_extents(paint->cairo, words, &extents);
    cairo_move_to(paint->cairo, x - align * extents.x_advance, y);
    cairo_show_text(paint->cairo, words);
}

static void draw_arrow(cairo_t *cairo, const double from[2], const double to[2])
{
    const double angle = atan2(to[1] - from[1], to[0] - from[0]);
    cairo_move_to(cairo, from[0], from[1]);
    cairo_line_to(cairo, to[0], to[1]);
    cairo_stroke(cairo);
    cairo_move_to(cairo, to[0] + 6 * cos(angle), to[1] + 6 * sin(angle));
    cairo_line_to(cairo, to[0] + 5 * cos(angle + 2.3), to[1] + 5 * sin(angle + 2.3));
    cairo_line_to(cairo, to[0] + 5 * cos(angle - 2.3), to[1] + 5 * sin(angle - 2.3));
    cairo_close_path(cairo);
    cairo_fill(cairo);
}

static void draw_dot(cairo_t *cairo, const double at[2])
{
    cairo_arc(cairo, at[0], at[1], 5, 0, 2 * M_PI);
    cairo_fill(cairo);
}

/* An arrow shorter than this part of its length is a dot; labels are so far from each other, and from their tips
 * [px]. */
static const double DOT = 0.12, APART = 18, BEYOND = 22;

void brc_paint_axis_labels(const brc_paint_view *view, const double origin[2], double length, double label[3][2])
{
    for (int a = 0; a < 3; ++a) {
        const double across = view->right[a], up = view->up[a], part = hypot(across, up);
        const bool is_dot = part < DOT;
        label[a][0] = origin[0] + (is_dot ? -APART : (length * part + BEYOND) * across / part);
        label[a][1] = origin[1] - (is_dot ? -APART : (length * part + BEYOND) * up / part);
        for (int before = 0; before < a; ++before) {
            if (hypot(label[a][0] - label[before][0], label[a][1] - label[before][1]) >= APART) continue;
            label[a][fabs(up) >= fabs(across) ? 0 : 1] += APART;
            before = -1; /* those that it was clear of, too */
        }
    }
}

void brc_paint_axes(brc_paint *paint, const brc_paint_view *view, const double origin[2], double length)
{
    double label[3][2];
    brc_paint_axis_labels(view, origin, length, label);
    cairo_set_line_width(paint->cairo, 2);
    for (int a = 0; a < 3; ++a) {
        const double tip[2] = {origin[0] + length * view->right[a], origin[1] - length * view->up[a]};
        const char name[2] = {(char)('x' + a), '\0'};
        if (hypot(view->right[a], view->up[a]) < DOT)
            draw_dot(paint->cairo, origin);
        else
            draw_arrow(paint->cairo, origin, tip);
        brc_paint_words(paint, name, label[a][0], label[a][1] + 5, 17, 0.5, false);
    }
}

brc_status brc_paint_end(brc_paint *paint, const char *path)
{
    char *aside = NULL;
    brc_status status = BRC_OK;
    finish_layer(paint);
    BRC_TRY_OR(cleanup, brc_file_aside(paint->context, path, &aside));
    if (paint->drawn == CAIRO_STATUS_SUCCESS) paint->drawn = cairo_surface_write_to_png(paint->small, aside);
    if (paint->drawn != CAIRO_STATUS_SUCCESS) {
        status = BRC_FAIL(paint->context, BRC_FILE_FAILED, "%s: cannot write the picture: %s", path,
                          cairo_status_to_string(paint->drawn));
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_file_commit(paint->context, aside, path));
cleanup:
    if (status != BRC_OK) brc_file_discard(aside);
    brc_memory_free(aside);
    cairo_surface_destroy(paint->large);
    cairo_surface_destroy(paint->small);
    return status;
}
