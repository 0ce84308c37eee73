/* Pictures by the painter's algorithm: faces that look towards the viewer, or spheres as discs with a highlight, the
 * farthest first. Words and the colour bar are drawn on top. */
#include "picture.h"
#include "colour.h"
#include "../frames/deform.h"
#include "label.h"
#include "paint.h"
#include "../frames/striker_file.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDTH = 1200, HEIGHT = 900 };
static const double AREA[4] = {60, 100, 960, 820}; /* where the sample goes: left, top, right, bottom [px] */

/* Corners (spheres: centres) of the deformed sample; picture coordinates come from here alone. */
typedef struct canvas {
    brc_context *context;
    const brc_picture *picture;
    brc_paint_view view;
    double centre[2]; /* of the sample, along right and up [m] */
    double zoom;      /* [px/m] */
    double scale;
    brc_picture_faces *surface; /* [n_parts] of parts of cells */
    /* what every part has, part after part, and then every striker, begins here; [n_parts + n_strikers + 1] */
    int64_t *first_point;  /* corners in the order of surface.corner, or centres of spheres */
    int64_t *first_face;   /* faces of the surface, or spheres, or faces of strikers */
    double *point;         /* [points of all][3] [m] */
    brc_paint_face *faces; /* [faces of all]: room, n_faces visible; id: among all */
    int64_t n_faces;
    double low, high; /* of the colour bar */
    bool diverging;
} canvas;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool is_sphere(const brc_picture_part *p)
{
    return p->domain->element_kind == BRC_ELEMENT_SPHERE;
}

static int64_t n_points_of(const canvas *c, int32_t part)
{
    const brc_picture_part *p = &c->picture->part[part];
    return is_sphere(p) ? p->domain->n_elements : c->surface[part].start[c->surface[part].n];
}

static int64_t n_faces_of(const canvas *c, int32_t part)
{
    const brc_picture_part *p = &c->picture->part[part];
    return is_sphere(p) ? p->domain->n_elements : c->surface[part].n;
}

/* The striker of what is painted, and its face there; NULL: an element's. */
static const brc_picture_striker *striker_of(const canvas *c, int64_t face, int64_t *own, int32_t *index)
{
    int32_t k = c->picture->n;
    if (face < c->first_face[k]) return NULL;
    while (face >= c->first_face[k + 1])
        ++k;
    *own = face - c->first_face[k];
    *index = k;
    return &c->picture->striker[k - c->picture->n];
}

/* The part of what is painted, and its number there. */
static const brc_picture_part *part_of(const canvas *c, int64_t face, int64_t *own, int32_t *index)
{
    int32_t k = 0;
    while (face >= c->first_face[k + 1])
        ++k;
    *own = face - c->first_face[k];
    *index = k;
    return &c->picture->part[k];
}

static double value_of(const canvas *c, int64_t face)
{
    int64_t own;
    int32_t k;
    const brc_picture_part *p = part_of(c, face, &own, &k);
    return p->value[is_sphere(p) ? own : c->surface[k].element[own]];
}

/* Corners or centres with the displacement times `scale`; at 0 those of the undeformed solid. */
static void move_points(canvas *c, int32_t part, double scale)
{
    const brc_picture_part *p = &c->picture->part[part];
    const brc_domain *d = p->domain;
    const brc_picture_faces *s = &c->surface[part];
    double gradient[3][3] = {{0}}, *point = c->point + 3 * c->first_point[part];
    for (int64_t k = 0; is_sphere(p) && k < 3 * d->n_elements; ++k)
        point[k] = d->position[k] + scale * p->displacement[k];
    for (int64_t f = 0, before = -1; f < s->n; ++f) {
        const int64_t e = s->element[f];
        if (e != before && scale != 0) brc_deform_gradient(d, p->whole, p->displacement, e, gradient);
        before = e;
        for (int64_t k = s->start[f]; k < s->start[f + 1]; ++k) {
            const double *x = d->vertex + 3 * (int64_t)s->corner[k];
            double u[3];
            brc_deform_point(d, p->displacement, e, (const double(*)[3])gradient, x, u);
            for (int i = 0; i < 3; ++i)
                point[3 * k + i] = scale != 0 ? x[i] + scale * u[i] : x[i];
        }
    }
}

/* Fit the sample into AREA. */
static void fit_view(canvas *c)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int32_t part = 0; part < c->picture->n; ++part) {
        const brc_picture_part *p = &c->picture->part[part];
        for (int64_t k = c->first_point[part]; k < c->first_point[part + 1]; ++k) {
            if (is_sphere(p) &&
                brc_picture_hides(c->picture->cut, p->domain->position + 3 * (k - c->first_point[part])))
                continue;
            const double radius = is_sphere(p) ? p->domain->radius[k - c->first_point[part]] : 0;
            const double at[2] = {dot(c->point + 3 * k, c->view.right), dot(c->point + 3 * k, c->view.up)};
            if (!isfinite(at[0]) || !isfinite(at[1])) continue;
            for (int i = 0; i < 2; ++i) {
                low[i] = fmin(low[i], at[i] - radius);
                high[i] = fmax(high[i], at[i] + radius);
            }
        }
    }
    const double spare[2] = {0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1])};
    const double least[2] = {low[0] - spare[0], low[1] - spare[1]}, most[2] = {high[0] + spare[0], high[1] + spare[1]};
    for (int32_t k = 0; k < c->picture->n_strikers;
         ++k) { /* strikers have what room they need, up to half of the sample's around it */
        const int32_t at = c->picture->n + k;
        for (int64_t p = c->first_point[at]; !c->picture->striker[k].is_plane && p < c->first_point[at + 1]; ++p) {
            const double place[2] = {dot(c->point + 3 * p, c->view.right), dot(c->point + 3 * p, c->view.up)};
            for (int i = 0; i < 2 && isfinite(place[0]) && isfinite(place[1]); ++i) {
                low[i] = fmin(low[i], fmax(place[i], least[i]));
                high[i] = fmax(high[i], fmin(place[i], most[i]));
            }
        }
    }
    for (int i = 0; i < 2; ++i)
        c->centre[i] = (low[i] + high[i]) / 2;
    c->zoom = fmin((AREA[2] - AREA[0]) / (high[0] - low[0]), (AREA[3] - AREA[1]) / (high[1] - low[1]));
}

/* Area vector (twice the area) and middle of a deformed polygon; false where it is not finite. */
static bool measure_face(const canvas *c, int32_t part, int64_t f, double normal[3], double middle[3])
{
    const brc_picture_faces *s = &c->surface[part];
    const int64_t first = c->first_point[part] + s->start[f], end = c->first_point[part] + s->start[f + 1];
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

static void add_visible(canvas *c, int32_t part)
{
    const brc_picture_part *p = &c->picture->part[part];
    for (int64_t e = 0; is_sphere(p) && e < p->domain->n_elements; ++e) {
        if (brc_picture_hides(c->picture->cut, p->domain->position + 3 * e)) continue;
        const double depth = dot(c->point + 3 * (c->first_point[part] + e), c->view.toward);
        if (isfinite(depth))
            c->faces[c->n_faces++] =
                (brc_paint_face){.depth = depth, .id = (int32_t)(c->first_face[part] + e), .shade = 1};
    }
    for (int64_t f = 0; f < c->surface[part].n; ++f) {
        double normal[3], middle[3];
        if (!measure_face(c, part, f, normal, middle) || dot(normal, c->view.toward) <= 0) continue;
        c->faces[c->n_faces++] = (brc_paint_face){.depth = dot(middle, c->view.toward),
                                                  .id = (int32_t)(c->first_face[part] + f),
                                                  .shade = brc_paint_shade(&c->view, normal)};
    }
}

/* Corner k of a face of a striker. */
static const double *striker_corner(const canvas *c, const brc_picture_striker *striker, int32_t index, int64_t face,
                                    int32_t k)
{
    const brc_striker_surface *s = &striker->body->surface;
    return c->point + 3 * (c->first_point[index] + s->loop[s->loop_start[face] + k]);
}

static void move_striker(canvas *c, int32_t index, double scale)
{
    const brc_picture_striker *striker = &c->picture->striker[index - c->picture->n];
    const brc_striker_surface *s = &striker->body->surface;
    double *point = c->point + 3 * c->first_point[index];
    for (int32_t k = 0; k < s->n_corners; ++k) {
        double u[3];
        brc_striker_corner_moved(s, &striker->now, k, u);
        for (int i = 0; i < 3; ++i)
            point[3 * k + i] = striker->body->centre[i] + s->corner[3 * k + i] + scale * u[i];
    }
}

static void add_visible_striker(canvas *c, int32_t index)
{
    const brc_picture_striker *striker = &c->picture->striker[index - c->picture->n];
    const brc_striker_surface *s = &striker->body->surface;
    for (int64_t f = 0; f < s->n_faces; ++f) {
        const int32_t n = s->loop_start[f + 1] - s->loop_start[f];
        double normal[3] = {0}, middle[3] = {0};
        for (int32_t k = 0; k < n; ++k) {
            const double *o = striker_corner(c, striker, index, f, 0), *a = striker_corner(c, striker, index, f, k),
                         *b = striker_corner(c, striker, index, f, (k + 1) % n);
            for (int i = 0; i < 3; ++i) {
                const int j = (i + 1) % 3, l = (i + 2) % 3;
                normal[i] += (a[j] - o[j]) * (b[l] - o[l]) - (a[l] - o[l]) * (b[j] - o[j]);
                middle[i] += a[i] / n;
            }
        }
        if (!isfinite(dot(normal, normal)) || !isfinite(dot(middle, middle)) || !(dot(normal, c->view.toward) > 0))
            continue;
        c->faces[c->n_faces++] = (brc_paint_face){.depth = striker->is_plane ? -INFINITY : dot(middle, c->view.toward),
                                                  .id = (int32_t)(c->first_face[index] + f),
                                                  .shade = brc_paint_shade(&c->view, normal)};
    }
}

/* Visible faces, the farthest first. */
static void sort_faces(canvas *c)
{
    for (int32_t k = 0; k < c->picture->n; ++k)
        add_visible(c, k);
    for (int32_t k = 0; k < c->picture->n_strikers; ++k)
        add_visible_striker(c, c->picture->n + k);
    brc_paint_sort(c->n_faces, c->faces);
}

static void find_range(canvas *c)
{
    if (c->picture->range[0] < c->picture->range[1]) {
        c->low = c->picture->range[0];
        c->high = c->picture->range[1];
        return;
    }
    c->low = INFINITY;
    c->high = -INFINITY;
    for (int64_t k = 0; k < c->n_faces; ++k) {
        if (c->faces[k].id >= c->first_face[c->picture->n]) continue; /* a striker's */
        const double value = value_of(c, c->faces[k].id);
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

static double across(const canvas *c, const double *point)
{
    return (AREA[0] + AREA[2]) / 2 + c->zoom * (dot(point, c->view.right) - c->centre[0]);
}

static double down(const canvas *c, const double *point)
{
    return (AREA[1] + AREA[3]) / 2 - c->zoom * (dot(point, c->view.up) - c->centre[1]);
}

/* Discs inside each other, lighter towards the lamp over the viewer's left shoulder; a sphere of few pixels is one. */
static void paint_sphere(const canvas *c, brc_paint *paint, const double *x, double size, const double rgb[3])
{
    enum { CORNERS = 20, RINGS = 3 };
    static const struct {
        double size, shift, shade;
    } ring[RINGS] = {{1.0, 0.0, 0.78}, {0.8, 0.12, 0.9}, {0.45, 0.25, 1.0}};
    const double radius = c->zoom * size;
    for (int r = 0; r < (radius < 2 ? 1 : RINGS); ++r) {
        for (int i = 0; i < CORNERS; ++i) {
            const double angle = 2 * M_PI * i / CORNERS;
            brc_paint_corner(paint, across(c, x) + radius * (ring[r].size * cos(angle) - 0.5 * ring[r].shift),
                             down(c, x) + radius * (ring[r].size * sin(angle) - ring[r].shift));
        }
        brc_paint_fill(paint, rgb, ring[r].shade, 0);
    }
}

/* Darkness of the lines between cells: only where cells are large enough to carry them. */
static double line_of(const canvas *c, const brc_domain *d)
{
    const double cell = d->quality.mean_spacing > 0 ? d->quality.mean_spacing * c->zoom : 0;
    return cell > 7 ? fmin(0.22, 0.02 * (cell - 7)) : 0;
}

static void paint_striker(const canvas *c, brc_paint *paint, const brc_picture_striker *striker, int32_t index,
                          int64_t face, double shade)
{
    static const double grey[3] = {0.74, 0.76, 0.79}, ground[3] = {0.93, 0.94, 0.95};
    const int32_t *start = striker->body->surface.loop_start;
    for (int32_t i = 0; i < start[face + 1] - start[face]; ++i) {
        const double *x = striker_corner(c, striker, index, face, i);
        brc_paint_corner(paint, across(c, x), down(c, x));
    }
    brc_paint_fill(paint, striker->is_plane ? ground : grey, shade, 0);
}

static void paint_faces(const canvas *c, brc_paint *paint)
{
    for (int64_t k = 0; k < c->n_faces; ++k) {
        int64_t own;
        int32_t part;
        double rgb[3];
        const brc_picture_striker *striker = striker_of(c, c->faces[k].id, &own, &part);
        if (striker) {
            paint_striker(c, paint, striker, part, own, c->faces[k].shade);
            continue;
        }
        const brc_picture_part *p = part_of(c, c->faces[k].id, &own, &part);
        const double *point = c->point + 3 * c->first_point[part];
        colour_of(c, value_of(c, c->faces[k].id), rgb);
        if (is_sphere(p)) {
            paint_sphere(c, paint, point + 3 * own, p->domain->radius[own], rgb);
            continue;
        }
        for (int64_t i = c->surface[part].start[own]; i < c->surface[part].start[own + 1]; ++i)
            brc_paint_corner(paint, across(c, point + 3 * i), down(c, point + 3 * i));
        brc_paint_fill(paint, rgb, c->faces[k].shade, line_of(c, p->domain));
    }
}

static void draw_bar(const canvas *c, brc_paint *paint)
{
    cairo_t *cairo = paint->cairo;
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
        brc_paint_words(paint, number, left + width + 12, y + 5, 16, 0, false);
    }
    if (strcmp(unit, "-") == 0)
        snprintf(words, sizeof words, "%s", c->picture->name);
    else
        snprintf(words, sizeof words, "%s [%s]", c->picture->name, unit);
    brc_paint_words(paint, words, WIDTH - 30, top - 24, 17, 1, false);
}

static void draw_axes(const canvas *c, brc_paint *paint)
{
    cairo_t *cairo = paint->cairo;
    const double origin[2] = {90, 830};
    brc_paint_axes(paint, &c->view, origin, 52);
    /* A bar of round length: without perspective it holds everywhere, for lengths across the view. */
    const double length = brc_label_step(150 / c->zoom, 1), px = length * c->zoom;
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
    brc_paint_words(paint, words, left + px + 14, y + 6, 17, 0, false);
}

/* "8000 cells, 500 spheres" */
static void count_words(const brc_picture *picture, char words[80])
{
    int64_t n_cells = 0, n_spheres = 0;
    words[0] = '\0';
    for (int32_t k = 0; k < picture->n; ++k)
        *(is_sphere(&picture->part[k]) ? &n_spheres : &n_cells) += picture->part[k].domain->n_elements;
    const int n = n_cells > 0 ? snprintf(words, 80, "%lld cells", (long long)n_cells) : 0;
    if (n_spheres > 0) snprintf(words + n, 80 - (size_t)n, "%s%lld spheres", n > 0 ? ", " : "", (long long)n_spheres);
}

static void draw_words(const canvas *c, brc_paint *paint)
{
    cairo_t *cairo = paint->cairo;
    char what[80], words[128];
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
    brc_paint_words(paint, c->picture->title, 40, 48, 26, 0, true);
    count_words(c->picture, what);
    if (c->scale == 1)
        snprintf(words, sizeof words, "%s, true displacement", what);
    else
        snprintf(words, sizeof words, "%s, displacement \xc3\x97 %g", what, c->scale);
    cairo_set_source_rgb(cairo, 0.35, 0.35, 0.35);
    brc_paint_words(paint, words, 40, 78, 17, 0, false);
    cairo_set_source_rgb(cairo, 0.15, 0.15, 0.15);
    if (c->n_faces > 0) {
        draw_bar(c, paint);
        draw_axes(c, paint);
    } else {
        brc_paint_words(paint, "no face has a finite place", WIDTH / 2.0, HEIGHT / 2.0, 20, 0.5, false);
    }
}

static brc_status render(const canvas *c, const char *path)
{
    brc_paint paint;
    brc_paint_begin(c->context, WIDTH, HEIGHT, &paint);
    paint_faces(c, &paint);
    brc_paint_top(&paint);
    draw_words(c, &paint);
    return brc_paint_end(&paint, path);
}

static void move_all(canvas *c, double scale)
{
    for (int32_t k = 0; k < c->picture->n; ++k)
        move_points(c, k, scale);
    for (int32_t k = 0; k < c->picture->n_strikers; ++k)
        move_striker(c, c->picture->n + k, scale);
}

brc_status brc_picture_draw(brc_context *context, const brc_picture *picture, const char *path)
{
    canvas c = {.context = context,
                .picture = picture,
                .scale = picture->scale,
                .view = picture->view ? *picture->view : brc_paint_corner_view()};
    const int32_t all = picture->n + picture->n_strikers;
    brc_status status = BRC_OK;
    if (!(c.scale > 0)) c.scale = picture->steady ? 1 : brc_picture_automatic_scale(picture->n, picture->part);
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c.surface, picture->n, "parts of the picture"));
    for (int32_t k = 0; k < picture->n; ++k)
        if (!is_sphere(&picture->part[k]))
            BRC_TRY_OR(cleanup, brc_picture_faces_make(context, picture->part[k].domain, picture->part[k].whole,
                                                       picture->cut, &c.surface[k]));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c.first_point, all + 1, "parts of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c.first_face, all + 1, "parts of the picture"));
    for (int32_t k = 0; k < picture->n; ++k) {
        c.first_point[k + 1] = c.first_point[k] + n_points_of(&c, k);
        c.first_face[k + 1] = c.first_face[k] + n_faces_of(&c, k);
    }
    for (int32_t k = picture->n; k < all; ++k) {
        const brc_striker_surface *surface = &picture->striker[k - picture->n].body->surface;
        c.first_point[k + 1] = c.first_point[k] + surface->n_corners;
        c.first_face[k + 1] = c.first_face[k] + surface->n_faces;
    }
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c.point, 3 * c.first_point[all], "corners of the picture"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &c.faces, c.first_face[all], "faces of the picture"));
    move_all(&c, picture->steady ? 0 : c.scale);
    fit_view(&c);
    if (picture->steady) move_all(&c, c.scale);
    sort_faces(&c);
    find_range(&c);
    status = render(&c, path);
cleanup:
    for (int32_t k = 0; c.surface && k < picture->n; ++k)
        brc_picture_faces_free(&c.surface[k]);
    brc_memory_free(c.surface);
    brc_memory_free(c.first_point);
    brc_memory_free(c.first_face);
    brc_memory_free(c.point);
    brc_memory_free(c.faces);
    return status;
}
