/* picture.png by the painter's algorithm: free faces that look towards the viewer, the farthest first. They are painted
 * without anti-aliasing at three times the size, each with an edge of its own colour, and the whole is averaged down:
 * neighbours leave no seams, and slanted edges are smooth. Words and the colour bar are drawn on top. */
#include "picture.h"
#include "colour.h"
#include "deform.h"
#include "label.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1200, HEIGHT = 900, OVERSAMPLE = 3 };
static const double AREA[4] = {60, 100, 960, 820}; /* where the sample goes: left, top, right, bottom [px] */

/* Viewer above the corner between x and -y: x runs right, y into the depth, z up. */
typedef struct view {
    double right[3], up[3], toward[3];
    double centre[2]; /* of the sample, along right and up [m] */
    double zoom;      /* [px/m] */
} view;

typedef struct face {
    double depth; /* of its middle, towards the viewer [m] */
    int32_t id;
    float shade;
} face;

/* Corners of the deformed sample; picture coordinates come from here alone. */
typedef struct canvas {
    brc_context *context;
    const brc_picture *picture;
    view view;
    double scale;
    double *point; /* [n corners of free faces][3] [m], in the order of domain.free_polygon */
    face *faces;   /* [n_free_faces] room, n_faces visible */
    int64_t n_faces;
    double low, high; /* of the colour bar */
    bool diverging;
} canvas;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double brc_picture_automatic_scale(const brc_domain *d, const double *displacement)
{
    double mean[3] = {0}, most = 0, diagonal = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        for (int c = 0; c < 3; ++c)
            mean[c] += displacement[3 * e + c] / (double)d->n_elements;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += pow(displacement[3 * e + c] - mean[c], 2);
        most = fmax(most, sqrt(square));
    }
    for (int c = 0; c < 3; ++c)
        diagonal += pow(d->bounds[1][c] - d->bounds[0][c], 2);
    const double wanted = 0.04 * sqrt(diagonal) / most;
    if (!isfinite(wanted) || wanted < 2) return 1;
    const double decade = pow(10, floor(log10(wanted)));
    return decade * (wanted / decade < 2 ? 1 : wanted / decade < 5 ? 2 : 5);
}

static void set_view(view *v)
{
    const double azimuth = -62 * M_PI / 180, elevation = 24 * M_PI / 180;
    const double toward[3] = {cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)};
    const double right[3] = {-sin(azimuth), cos(azimuth), 0};
    const double up[3] = {toward[1] * right[2] - toward[2] * right[1], toward[2] * right[0] - toward[0] * right[2],
                          toward[0] * right[1] - toward[1] * right[0]};
    memcpy(v->toward, toward, sizeof toward);
    memcpy(v->right, right, sizeof right);
    memcpy(v->up, up, sizeof up);
}

static void move_points(canvas *c)
{
    const brc_domain *d = c->picture->domain;
    double gradient[3][3] = {{0}};
    for (int64_t f = 0, before = -1; f < d->n_free_faces; ++f) {
        const int64_t e = d->free_element[f];
        if (e != before) brc_deform_gradient(d, c->picture->displacement, e, gradient);
        before = e;
        for (int64_t k = d->free_polygon_start[f]; k < d->free_polygon_start[f + 1]; ++k) {
            const double *x = d->vertex + 3 * (int64_t)d->free_polygon[k];
            double u[3];
            brc_deform_point(d, c->picture->displacement, e, (const double(*)[3])gradient, x, u);
            for (int i = 0; i < 3; ++i)
                c->point[3 * k + i] = x[i] + c->scale * u[i];
        }
    }
}

/* Fit the sample into AREA. */
static void fit_view(canvas *c)
{
    const brc_domain *d = c->picture->domain;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int64_t k = 0; k < d->free_polygon_start[d->n_free_faces]; ++k) {
        const double at[2] = {dot(c->point + 3 * k, c->view.right), dot(c->point + 3 * k, c->view.up)};
        if (!isfinite(at[0]) || !isfinite(at[1])) continue;
        for (int i = 0; i < 2; ++i) {
            low[i] = fmin(low[i], at[i]);
            high[i] = fmax(high[i], at[i]);
        }
    }
    for (int i = 0; i < 2; ++i)
        c->view.centre[i] = (low[i] + high[i]) / 2;
    c->view.zoom = fmin((AREA[2] - AREA[0]) / (high[0] - low[0]), (AREA[3] - AREA[1]) / (high[1] - low[1]));
}

/* Area vector (twice the area) and middle of a deformed polygon; false where it is not finite. */
static bool measure_face(const canvas *c, int64_t f, double normal[3], double middle[3])
{
    const int64_t first = c->picture->domain->free_polygon_start[f],
                  end = c->picture->domain->free_polygon_start[f + 1];
    memset(normal, 0, 3 * sizeof *normal);
    memset(middle, 0, 3 * sizeof *middle);
    for (int64_t k = first; k < end; ++k) {
        const double *a = c->point + 3 * k, *b = c->point + 3 * (k + 1 < end ? k + 1 : first);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            normal[i] += (a[j] - c->point[3 * first + j]) * (b[l] - c->point[3 * first + l]) -
                         (a[l] - c->point[3 * first + l]) * (b[j] - c->point[3 * first + j]);
            middle[i] += a[i] / (double)(end - first);
        }
    }
    return isfinite(dot(normal, normal)) && isfinite(dot(middle, middle)) && dot(normal, normal) > 0;
}

static int compare_faces(const void *a, const void *b)
{
    const face *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return p->id < q->id ? -1 : p->id > q->id;
}

/* Visible faces, the farthest first, with the light of two lamps. */
static void sort_faces(canvas *c)
{
    static const double lamp[3] = {0.25, -0.60, 0.76}; /* over the viewer's left shoulder */
    for (int64_t f = 0; f < c->picture->domain->n_free_faces; ++f) {
        double normal[3], middle[3];
        if (!measure_face(c, f, normal, middle) || dot(normal, c->view.toward) <= 0) continue;
        const double light = fmax(dot(normal, lamp) / sqrt(dot(normal, normal)), 0);
        c->faces[c->n_faces++] =
            (face){.depth = dot(middle, c->view.toward), .id = (int32_t)f, .shade = (float)(0.78 + 0.22 * light)};
    }
    qsort(c->faces, (size_t)c->n_faces, sizeof *c->faces, compare_faces);
}

static void find_range(canvas *c)
{
    c->low = INFINITY;
    c->high = -INFINITY;
    for (int64_t k = 0; k < c->n_faces; ++k) {
        const double value = c->picture->value[c->picture->domain->free_element[c->faces[k].id]];
        if (!isfinite(value)) continue;
        c->low = fmin(c->low, value);
        c->high = fmax(c->high, value);
    }
    if (!(c->low <= c->high)) c->low = c->high = 0;
    const double largest = fmax(fabs(c->low), fabs(c->high)), middle = (c->low + c->high) / 2;
    if (c->high - c->low < 1e-4 * largest || largest == 0) { /* a uniform field: one colour, not its rounding */
        c->low = middle - (largest > 0 ? 0.05 * largest : 1);
        c->high = middle + (largest > 0 ? 0.05 * largest : 1);
    } else if (c->low < -0.1 * c->high && c->high > -0.1 * c->low) {
        c->diverging = true;
        c->low = -largest;
        c->high = largest;
    }
}

static void colour_of(const canvas *c, double value, double rgb[3])
{
    const double t = (value - c->low) / (c->high - c->low);
    if (c->diverging)
        brc_colour_diverging(t, rgb);
    else
        brc_colour_sequential(t, rgb);
}

static void trace(const canvas *c, cairo_t *cairo, int64_t f)
{
    const brc_domain *d = c->picture->domain;
    for (int64_t k = d->free_polygon_start[f]; k < d->free_polygon_start[f + 1]; ++k) {
        const double x =
            (AREA[0] + AREA[2]) / 2 + c->view.zoom * (dot(c->point + 3 * k, c->view.right) - c->view.centre[0]);
        const double y =
            (AREA[1] + AREA[3]) / 2 - c->view.zoom * (dot(c->point + 3 * k, c->view.up) - c->view.centre[1]);
        cairo_line_to(cairo, OVERSAMPLE * x, OVERSAMPLE * y);
    }
    cairo_close_path(cairo);
}

static void paint_faces(const canvas *c, cairo_t *cairo)
{
    const brc_domain *d = c->picture->domain;
    /* Lines between cells only where cells are large enough to carry them. */
    const double cell = d->quality.mean_spacing > 0 ? d->quality.mean_spacing * c->view.zoom : 0;
    const double line = cell > 7 ? fmin(0.22, 0.02 * (cell - 7)) : 0;
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_NONE);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_BEVEL);
    for (int64_t k = 0; k < c->n_faces; ++k) {
        const int64_t f = c->faces[k].id;
        const double shade = c->faces[k].shade;
        double rgb[3];
        colour_of(c, c->picture->value[d->free_element[f]], rgb);
        trace(c, cairo, f);
        cairo_set_source_rgb(cairo, shade * rgb[0], shade * rgb[1], shade * rgb[2]);
        cairo_fill_preserve(cairo);
        const double edge = shade * (1 - line);
        cairo_set_source_rgb(cairo, edge * rgb[0], edge * rgb[1], edge * rgb[2]);
        cairo_set_line_width(cairo, line > 0 ? 2 : 1);
        cairo_stroke(cairo);
    }
}

/* Mean of OVERSAMPLE x OVERSAMPLE pixels. */
static void shrink(cairo_surface_t *large, cairo_surface_t *small)
{
    cairo_surface_flush(large);
    const unsigned char *from = cairo_image_surface_get_data(large);
    unsigned char *to = cairo_image_surface_get_data(small);
    const int from_row = cairo_image_surface_get_stride(large), to_row = cairo_image_surface_get_stride(small);
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            for (int byte = 0; byte < 4; ++byte) {
                int sum = 0;
                for (int j = 0; j < OVERSAMPLE; ++j)
                    for (int i = 0; i < OVERSAMPLE; ++i)
                        sum += from[(OVERSAMPLE * y + j) * from_row + 4 * (OVERSAMPLE * x + i) + byte];
                to[y * to_row + 4 * x + byte] = (unsigned char)(sum / (OVERSAMPLE * OVERSAMPLE));
            }
    cairo_surface_mark_dirty(small);
}

/* align: 0 left, 0.5 centred, 1 right of x. */
static void write_words(cairo_t *cairo, const char *words, double x, double y, double size, double align, bool bold)
{
    cairo_text_extents_t extents;
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, size);
    cairo_text_extents(cairo, words, &extents);
    cairo_move_to(cairo, x - align * extents.x_advance, y);
    cairo_show_text(cairo, words);
}

static void draw_bar(const canvas *c, cairo_t *cairo)
{
    const double left = 1020, top = 170, width = 30, height = 560;
    char unit[32], words[160];
    for (int k = 0; k < (int)height; ++k) {
        double rgb[3];
        colour_of(c, c->high + (c->low - c->high) * (k + 0.5) / height, rgb);
        cairo_set_source_rgb(cairo, rgb[0], rgb[1], rgb[2]);
        cairo_rectangle(cairo, left, top + k, width, 1);
        cairo_fill(cairo);
    }
    cairo_set_source_rgb(cairo, 0.15, 0.15, 0.15);
    cairo_set_line_width(cairo, 1);
    cairo_rectangle(cairo, left - 0.5, top - 0.5, width + 1, height + 1);
    cairo_stroke(cairo);
    const double factor = brc_label_unit(c->picture->unit, fmax(fabs(c->low), fabs(c->high)), unit);
    const double low = factor * c->low, high = factor * c->high, step = brc_label_step(high - low, 6);
    for (double k = ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) {
        const double y = top + height * (high - k * step) / (high - low);
        char number[32];
        brc_label_number(k * step, step, number);
        cairo_move_to(cairo, left + width, y);
        cairo_line_to(cairo, left + width + 6, y);
        cairo_stroke(cairo);
        write_words(cairo, number, left + width + 12, y + 5, 16, 0, false);
    }
    if (strcmp(unit, "-") == 0)
        snprintf(words, sizeof words, "%s", c->picture->name);
    else
        snprintf(words, sizeof words, "%s [%s]", c->picture->name, unit);
    write_words(cairo, words, WIDTH - 30, top - 24, 17, 1, false);
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

static void draw_axes(const canvas *c, cairo_t *cairo)
{
    const double origin[2] = {90, 830};
    cairo_set_line_width(cairo, 2);
    for (int a = 0; a < 3; ++a) {
        const double tip[2] = {origin[0] + 52 * c->view.right[a], origin[1] - 52 * c->view.up[a]};
        const char name[2] = {(char)('x' + a), '\0'};
        draw_arrow(cairo, origin, tip);
        write_words(cairo, name, origin[0] + 74 * c->view.right[a], origin[1] - 74 * c->view.up[a] + 5, 17, 0.5, false);
    }
    /* A bar of round length: without perspective it holds everywhere, for lengths across the view. */
    const double length = brc_label_step(150 / c->view.zoom, 1), px = length * c->view.zoom;
    char unit[32], number[32], words[64];
    const double factor = brc_label_unit("m", length, unit);
    brc_label_number(factor * length, factor * length, number);
    snprintf(words, sizeof words, "%s %s", number, unit);
    const double left = 480 - px / 2, y = 862;
    cairo_move_to(cairo, left, y - 6);
    cairo_line_to(cairo, left, y + 6);
    cairo_move_to(cairo, left, y);
    cairo_line_to(cairo, left + px, y);
    cairo_move_to(cairo, left + px, y - 6);
    cairo_line_to(cairo, left + px, y + 6);
    cairo_stroke(cairo);
    write_words(cairo, words, left + px + 14, y + 6, 17, 0, false);
}

static void draw_words(const canvas *c, cairo_t *cairo)
{
    char words[96];
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
    write_words(cairo, c->picture->title, 40, 48, 26, 0, true);
    if (c->scale == 1)
        snprintf(words, sizeof words, "%lld cells, true displacement", (long long)c->picture->domain->n_elements);
    else
        snprintf(words, sizeof words, "%lld cells, displacement \xc3\x97 %g", (long long)c->picture->domain->n_elements,
                 c->scale);
    cairo_set_source_rgb(cairo, 0.35, 0.35, 0.35);
    write_words(cairo, words, 40, 78, 17, 0, false);
    cairo_set_source_rgb(cairo, 0.15, 0.15, 0.15);
    if (c->n_faces > 0) {
        draw_bar(c, cairo);
        draw_axes(c, cairo);
    } else {
        write_words(cairo, "no face has a finite place", WIDTH / 2.0, HEIGHT / 2.0, 20, 0.5, false);
    }
}

static brc_status render(const canvas *c, const char *path)
{
    char *aside = NULL;
    brc_status status = BRC_OK;
    cairo_surface_t *large = cairo_image_surface_create(CAIRO_FORMAT_RGB24, OVERSAMPLE * WIDTH, OVERSAMPLE * HEIGHT);
    cairo_surface_t *small = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    cairo_t *cairo = cairo_create(large);
    paint_faces(c, cairo);
    cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    if (drawn == CAIRO_STATUS_SUCCESS) shrink(large, small);
    cairo = cairo_create(small);
    draw_words(c, cairo);
    if (drawn == CAIRO_STATUS_SUCCESS) drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    BRC_TRY_OR(cleanup, brc_file_aside(c->context, path, &aside));
    if (drawn == CAIRO_STATUS_SUCCESS) drawn = cairo_surface_write_to_png(small, aside);
    if (drawn != CAIRO_STATUS_SUCCESS) {
        status = BRC_FAIL(c->context, BRC_FILE_FAILED, "%s: cannot write the picture: %s", path,
                          cairo_status_to_string(drawn));
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_file_commit(c->context, aside, path));
cleanup:
    if (status != BRC_OK) brc_file_discard(aside);
    brc_memory_free(aside);
    cairo_surface_destroy(large);
    cairo_surface_destroy(small);
    return status;
}

brc_status brc_picture_draw(brc_context *context, const brc_picture *picture, const char *path)
{
    const brc_domain *d = picture->domain;
    canvas c = {.context = context, .picture = picture, .scale = picture->scale};
    brc_status status = BRC_OK;
    if (!(c.scale > 0)) c.scale = brc_picture_automatic_scale(d, picture->displacement);
    const int64_t n_points = d->free_polygon_start[d->n_free_faces];
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c.point, 3 * n_points, "corners of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c.faces, d->n_free_faces, "faces of the picture"));
    set_view(&c.view);
    move_points(&c);
    fit_view(&c);
    sort_faces(&c);
    find_range(&c);
    status = render(&c, path);
cleanup:
    brc_memory_free(c.point);
    brc_memory_free(c.faces);
    return status;
}
