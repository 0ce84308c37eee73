/* Polygons are collected in memory, bond after bond in the order of the breaks, then written. */
#include "crack_surface.h"
#include "deform.h"
#include "vtu.h"
#include "../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POLYGON = 7, SIDES = 8, MOST_CORNERS = 256 };
/* Corners of a face lie in its plane to rounding; other corners of its cell are farther from it than this share of the cell's size. */
static const double in_plane = 1e-7;

/* ---- corners of a face ---- */

typedef struct around {
    double angle;
    int64_t corner;
} around;

static int by_angle(const void *a, const void *b)
{
    const around *x = a, *y = b;
    if (x->angle != y->angle) return x->angle < y->angle ? -1 : 1;
    return (x->corner > y->corner) - (x->corner < y->corner);
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Two unit vectors across the unit vector n. */
static void find_frame(const double n[3], double e1[3], double e2[3])
{
    int least = 0;
    for (int c = 1; c < 3; ++c)
        if (fabs(n[c]) < fabs(n[least])) least = c;
    double length = 0;
    for (int c = 0; c < 3; ++c) {
        e1[c] = (c == least) - n[least] * n[c];
        length += e1[c] * e1[c];
    }
    for (int c = 0; c < 3; ++c) e1[c] /= sqrt(length);
    for (int c = 0; c < 3; ++c) e2[c] = n[(c + 1) % 3] * e1[(c + 2) % 3] - n[(c + 2) % 3] * e1[(c + 1) % 3];
}

int brc_crack_surface_corners(const brc_domain *d, int64_t h, int room, int64_t *corner)
{
    const int64_t e = d->neighbour[d->twin[h]];
    const double *s = d->area_vector + 3 * h, *centre = d->face_centroid + 3 * h, area = sqrt(dot(s, s));
    const double n[3] = {s[0] / area, s[1] / area, s[2] / area};
    double e1[3], e2[3], size = 0;
    around found[MOST_CORNERS];
    int count = 0;
    find_frame(n, e1, e2);
    for (int pass = 0; pass < 2; ++pass)
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v) {
            const double r[3] = {d->vertex[3 * v] - centre[0], d->vertex[3 * v + 1] - centre[1], d->vertex[3 * v + 2] - centre[2]};
            if (pass == 0) size = fmax(size, sqrt(dot(r, r)));
            else if (fabs(dot(r, n)) <= in_plane * size && count < MOST_CORNERS && count < room)
                found[count++] = (around){atan2(dot(r, e2), dot(r, e1)), v};
        }
    if (count < 3) return 0;
    qsort(found, (size_t)count, sizeof *found, by_angle);
    for (int k = 0; k < count; ++k) corner[k] = found[k].corner;
    return count;
}

/* ---- the surface ---- */

/* Growing arrays of the file. */
typedef struct surface {
    brc_context *context;
    int64_t n_points, n_polygons, point_room, polygon_room;
    float *point, *moved;    /* [n_points][3] */
    int64_t *id, *end;       /* [n_points], [n_polygons] */
    uint8_t *type;           /* [n_polygons] */
    int64_t *count[6];       /* [n_polygons] side, stage, mode, bond, element_i, element_j */
    double *number[5];       /* [n_polygons] time, load, energy, stress, area */
} surface;
static const char *const COUNT_NAME[6] = {"side", "stage", "mode", "bond", "element_i", "element_j"};
static const char *const NUMBER_NAME[5] = {"time", "load", "energy", "stress", "area"};

static void free_surface(surface *s)
{
    brc_memory_free(s->point);
    brc_memory_free(s->moved);
    brc_memory_free(s->id);
    brc_memory_free(s->end);
    brc_memory_free(s->type);
    for (int k = 0; k < 6; ++k) brc_memory_free(s->count[k]);
    for (int k = 0; k < 5; ++k) brc_memory_free(s->number[k]);
}

static brc_status make_room(surface *s)
{
    const char *what = "crack surface";
    if (s->n_points + MOST_CORNERS > s->point_room) {
        s->point_room = 2 * s->point_room + 16 * MOST_CORNERS;
        BRC_TRY(brc_memory_resize(s->context, (void **)&s->point, 3 * s->point_room, sizeof *s->point, what));
        BRC_TRY(brc_memory_resize(s->context, (void **)&s->moved, 3 * s->point_room, sizeof *s->moved, what));
        BRC_TRY(brc_memory_resize(s->context, (void **)&s->id, s->point_room, sizeof *s->id, what));
    }
    if (s->n_polygons < s->polygon_room) return BRC_OK;
    s->polygon_room = 2 * s->polygon_room + 1024;
    BRC_TRY(brc_memory_resize(s->context, (void **)&s->end, s->polygon_room, sizeof *s->end, what));
    BRC_TRY(brc_memory_resize(s->context, (void **)&s->type, s->polygon_room, sizeof *s->type, what));
    for (int k = 0; k < 6; ++k) BRC_TRY(brc_memory_resize(s->context, (void **)&s->count[k], s->polygon_room, sizeof *s->count[k], what));
    for (int k = 0; k < 5; ++k) BRC_TRY(brc_memory_resize(s->context, (void **)&s->number[k], s->polygon_room, sizeof *s->number[k], what));
    return BRC_OK;
}

static void add_point(surface *s, const double x[3], const double u[3])
{
    for (int c = 0; c < 3; ++c) {
        s->point[3 * s->n_points + c] = (float)x[c];
        s->moved[3 * s->n_points + c] = (float)u[c];
    }
    s->id[s->n_points] = s->n_points;
    ++s->n_points;
}

static void end_polygon(surface *s, const brc_break *b, int side, int64_t first_element, int64_t first_bond)
{
    const int64_t count[6] = {side, b->stage, b->mode, first_bond + b->bond, first_element + b->element_i, first_element + b->element_j};
    const double number[5] = {b->time, b->load, b->energy, b->stress, b->area};
    const int64_t k = s->n_polygons++;
    s->end[k] = s->n_points;
    s->type[k] = POLYGON;
    for (int c = 0; c < 6; ++c) s->count[c][k] = count[c];
    for (int c = 0; c < 5; ++c) s->number[c][k] = number[c];
}

/* State of one part. */
typedef struct state {
    brc_simulation *simulation;
    const brc_domain *domain;
    double *displacement, *orientation; /* [n][3], [n][4]; orientation of spheres only */
    uint8_t *whole;
} state;

static void add_face(surface *s, const state *at, int64_t h)
{
    const int64_t e = at->domain->neighbour[at->domain->twin[h]];
    int64_t corner[MOST_CORNERS];
    double gradient[3][3], u[3];
    const int n = brc_crack_surface_corners(at->domain, h, MOST_CORNERS, corner);
    brc_deform_gradient(at->domain, at->whole, at->displacement, e, gradient);
    for (int k = 0; k < n; ++k) {
        const double *x = at->domain->vertex + 3 * corner[k];
        brc_deform_point(at->domain, at->displacement, e, (const double(*)[3])gradient, x, u);
        add_point(s, x, u);
    }
}

/* u + (R - 1) r */
static void turn(const double q[4], const double r[3], double u[3])
{
    double t[3];
    for (int c = 0; c < 3; ++c) t[c] = 2 * (q[1 + (c + 1) % 3] * r[(c + 2) % 3] - q[1 + (c + 2) % 3] * r[(c + 1) % 3]);
    for (int c = 0; c < 3; ++c) u[c] += q[0] * t[c] + q[1 + (c + 1) % 3] * t[(c + 2) % 3] - q[1 + (c + 2) % 3] * t[(c + 1) % 3];
}

static void add_octagon(surface *s, const state *at, const brc_break *b, int64_t e)
{
    const double radius = 0.5 * (brc_simulation_beam_radius(at->simulation, b->element_i) + brc_simulation_beam_radius(at->simulation, b->element_j));
    double e1[3], e2[3];
    find_frame(b->normal, e1, e2);
    for (int k = 0; k < SIDES; ++k) {
        const double c1 = radius * cos(2 * M_PI * k / SIDES), c2 = radius * sin(2 * M_PI * k / SIDES);
        double x[3], r[3], u[3];
        for (int c = 0; c < 3; ++c) {
            x[c] = b->position[c] + c1 * e1[c] + c2 * e2[c];
            r[c] = x[c] - at->domain->position[3 * e + c];
            u[c] = at->displacement[3 * e + c];
        }
        turn(at->orientation + 4 * e, r, u);
        add_point(s, x, u);
    }
}

static brc_status add_part(surface *s, const brc_assembly *assembly, int32_t part)
{
    state at = {.simulation = assembly->part[part], .domain = brc_simulation_domain(assembly->part[part])};
    const brc_domain *d = at.domain;
    const bool spheres = d->element_kind == BRC_ELEMENT_SPHERE;
    const int64_t first_element = brc_assembly_first_element(assembly, part), first_bond = brc_assembly_first_bond(assembly, part);
    const brc_break *list;
    int64_t n;
    brc_status status = BRC_OK;
    BRC_TRY(brc_simulation_breaks(at.simulation, &n, &list));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &at.displacement, 3 * d->n_elements, "crack surface"));
    BRC_TRY_OR(cleanup, brc_simulation_displacement(at.simulation, at.displacement));
    if (spheres) {
        BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &at.orientation, 4 * d->n_elements, "crack surface"));
        BRC_TRY_OR(cleanup, brc_simulation_orientation(at.simulation, at.orientation, NULL));
    } else {
        BRC_TRY_OR(cleanup, brc_simulation_whole(at.simulation, &at.whole));
    }
    for (int64_t k = 0; k < n; ++k)
        for (int side = 0; side < 2; ++side) {
            const int64_t h = d->bond_half_edge[list[k].bond], before = s->n_points;
            BRC_TRY_OR(cleanup, make_room(s));
            if (spheres) add_octagon(s, &at, &list[k], side == 0 ? list[k].element_i : list[k].element_j);
            else add_face(s, &at, side == 0 ? h : d->twin[h]);
            if (s->n_points > before) end_polygon(s, &list[k], side, first_element, first_bond);
        }
cleanup:
    brc_memory_free(at.displacement);
    brc_memory_free(at.orientation);
    brc_memory_free(at.whole);
    return status;
}

static brc_status write_surface(const surface *s, double time, const char *path)
{
    const int64_t n = s->n_polygons;
    brc_vtu_array list[24];
    int m = 0;
    list[m++] = (brc_vtu_array){BRC_VTU_FIELD_DATA, "TimeValue", BRC_VTU_FLOAT64, 1, 1, brc_vtu_from_memory, &time, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_POINTS, "Points", BRC_VTU_FLOAT32, 3, s->n_points, brc_vtu_from_memory, s->point, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_CELLS, "connectivity", BRC_VTU_INT64, 1, s->n_points, brc_vtu_from_memory, s->id, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_CELLS, "offsets", BRC_VTU_INT64, 1, n, brc_vtu_from_memory, s->end, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_CELLS, "types", BRC_VTU_UINT8, 1, n, brc_vtu_from_memory, s->type, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_POINT_DATA, "displacement", BRC_VTU_FLOAT32, 3, s->n_points, brc_vtu_from_memory, s->moved, 0};
    for (int k = 0; k < 6; ++k) list[m++] = (brc_vtu_array){BRC_VTU_CELL_DATA, COUNT_NAME[k], BRC_VTU_INT64, 1, n, brc_vtu_from_memory, s->count[k], 0};
    for (int k = 0; k < 5; ++k) list[m++] = (brc_vtu_array){BRC_VTU_CELL_DATA, NUMBER_NAME[k], BRC_VTU_FLOAT64, 1, n, brc_vtu_from_memory, s->number[k], 0};
    return brc_vtu_write(s->context, path, s->n_points, n, m, list);
}

brc_status brc_crack_surface_write(brc_context *context, const brc_assembly *assembly, const char *path)
{
    surface s = {.context = context};
    brc_status status = BRC_OK;
    for (int32_t k = 0; k < assembly->n && status == BRC_OK; ++k) status = add_part(&s, assembly, k);
    if (status == BRC_OK) status = write_surface(&s, brc_simulation_total_time(assembly->part[0]), path);
    free_surface(&s);
    return status;
}
