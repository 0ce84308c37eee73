/* Polygons stand in the order of the breaks, and of each of its two sides. Only which face each is of and, of cells,
 * which corners it has are kept; all else is found again as the file is written, block after block, so that a million
 * broken bonds take 50 MB and not 800. */
#include "crack_surface.h"
#include "../frames/deform.h"
#include "../frames/vtu.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POLYGON = 7, SIDES = 8, MOST_CORNERS = 256 };
/* Corners of a face lie in its plane to rounding; other corners of its cell are farther from it than this share of the
 * cell's size. */
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

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

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
    for (int c = 0; c < 3; ++c)
        e1[c] /= sqrt(length);
    for (int c = 0; c < 3; ++c)
        e2[c] = n[(c + 1) % 3] * e1[(c + 2) % 3] - n[(c + 2) % 3] * e1[(c + 1) % 3];
}

int brc_crack_surface_corners(const brc_domain *d, int64_t h, int room, int64_t *corner)
{
    const int64_t e = d->neighbour[d->twin[h]];
    const double *s = d->area_vector + 3 * h, *centre = d->face_centroid + 3 * h, area = sqrt(dot(s, s));
    if (!brc_domain_has(d, e)) return 0; /* this rank does not write it */
    const double n[3] = {s[0] / area, s[1] / area, s[2] / area};
    double e1[3], e2[3], size = 0;
    around found[MOST_CORNERS];
    int count = 0;
    find_frame(n, e1, e2);
    for (int pass = 0; pass < 2; ++pass)
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v) {
            const double r[3] = {d->vertex[3 * v] - centre[0], d->vertex[3 * v + 1] - centre[1],
                                 d->vertex[3 * v + 2] - centre[2]};
            if (pass == 0)
                size = fmax(size, sqrt(dot(r, r)));
            else if (fabs(dot(r, n)) <= in_plane * size && count < MOST_CORNERS && count < room)
                found[count++] = (around){atan2(dot(r, e2), dot(r, e1)), v};
        }
    if (count < 3) return 0;
    qsort(found, (size_t)count, sizeof *found, by_angle);
    for (int k = 0; k < count; ++k)
        corner[k] = found[k].corner;
    return count;
}

/* ---- the surface ---- */

/* A body as it stands. */
typedef struct part {
    const brc_simulation *simulation;
    const brc_domain *domain;
    const brc_break *breaks;                           /* [n] */
    int64_t n, first_break, first_element, first_bond; /* the last three: of the parts before */
    double *displacement, *orientation; /* [n_elements][3], [n_elements][4]; orientation of spheres only */
    uint8_t *whole;                     /* cells: brc_simulation_whole */
} part;

typedef struct surface {
    brc_context *context;
    int32_t n_parts;
    part *parts;
    int64_t n_points, n_polygons, corner_room;
    int64_t *face; /* [n_polygons] twice the number of the break over all parts, and its side */
    int64_t *end;  /* [n_polygons] points up to its last */
    bool has_cells;
    int32_t *corner; /* [n_points] of cells: corner, counted from the first of the element; NULL without cells */
} surface;

static void free_surface(surface *s)
{
    for (int32_t k = 0; k < s->n_parts; ++k) {
        brc_memory_free(s->parts[k].displacement);
        brc_memory_free(s->parts[k].orientation);
        brc_memory_free(s->parts[k].whole);
    }
    brc_memory_free(s->parts);
    brc_memory_free(s->face);
    brc_memory_free(s->end);
    brc_memory_free(s->corner);
}

static bool is_spheres(const part *p)
{
    return p->domain->element_kind == BRC_ELEMENT_SPHERE;
}

static brc_status take_part(surface *s, const brc_assembly *assembly, int32_t k, int64_t first_break)
{
    brc_simulation *simulation = assembly->part[k];
    part *p = &s->parts[k];
    p->simulation = simulation;
    p->domain = brc_simulation_domain(simulation);
    p->first_break = first_break;
    p->first_element = brc_assembly_first_element(assembly, k);
    p->first_bond = brc_assembly_first_bond(assembly, k);
    BRC_TRY(brc_simulation_breaks(simulation, &p->n, &p->breaks));
    BRC_TRY(BRC_ALLOCATE(s->context, &p->displacement, 3 * p->domain->n_elements, "crack surface"));
    BRC_TRY(brc_simulation_displacement(simulation, p->displacement));
    if (!is_spheres(p)) return brc_simulation_whole(simulation, &p->whole);
    BRC_TRY(BRC_ALLOCATE(s->context, &p->orientation, 4 * p->domain->n_elements, "crack surface"));
    return brc_simulation_orientation(simulation, p->orientation, NULL);
}

static int64_t half_edge_of(const part *p, const brc_break *b, int side)
{
    const int64_t h = p->domain->bond_half_edge[b->bond];
    return side == 0 ? h : p->domain->twin[h];
}

static int64_t owner_of(const part *p, const brc_break *b, int side)
{
    if (is_spheres(p)) return side == 0 ? b->element_i : b->element_j;
    return p->domain->neighbour[p->domain->twin[half_edge_of(p, b, side)]];
}

/* Corners of a side of a break, kept where it is of a cell; a face without three of them is left out. */
static brc_status add_polygon(surface *s, const part *p, int64_t b, int side)
{
    const brc_break *at = &p->breaks[b];
    int64_t corner[MOST_CORNERS] = {0}, first = 0;
    int n = SIDES;
    if (!is_spheres(p)) {
        first = p->domain->vertex_start[owner_of(p, at, side)];
        n = brc_crack_surface_corners(p->domain, half_edge_of(p, at, side), MOST_CORNERS, corner);
    }
    if (n == 0) return BRC_OK;
    if (s->has_cells && s->n_points + n > s->corner_room) {
        s->corner_room += s->corner_room / 2 + 4 * MOST_CORNERS;
        BRC_TRY(brc_memory_resize(s->context, (void **)&s->corner, s->corner_room, sizeof *s->corner, "crack surface"));
    }
    for (int k = 0; k < n && s->has_cells; ++k)
        s->corner[s->n_points + k] = (int32_t)(corner[k] - first);
    s->n_points += n;
    s->face[s->n_polygons] = 2 * (p->first_break + b) + side;
    s->end[s->n_polygons++] = s->n_points;
    return BRC_OK;
}

static brc_status take_surface(surface *s, const brc_assembly *assembly)
{
    int64_t n_breaks = 0;
    BRC_TRY(BRC_ALLOCATE(s->context, &s->parts, assembly->n, "crack surface"));
    s->n_parts = assembly->n;
    for (int32_t k = 0; k < s->n_parts; ++k) {
        BRC_TRY(take_part(s, assembly, k, n_breaks));
        n_breaks += s->parts[k].n;
        s->has_cells |= !is_spheres(&s->parts[k]);
    }
    BRC_TRY(BRC_ALLOCATE(s->context, &s->face, 2 * n_breaks, "crack surface"));
    BRC_TRY(BRC_ALLOCATE(s->context, &s->end, 2 * n_breaks, "crack surface"));
    for (int32_t k = 0; k < s->n_parts; ++k)
        for (int64_t b = 0; b < s->parts[k].n; ++b)
            for (int side = 0; side < 2; ++side)
                BRC_TRY(add_polygon(s, &s->parts[k], b, side));
    return BRC_OK;
}

/* Body, break and side of a polygon. */
static const brc_break *find(const surface *s, int64_t polygon, const part **out, int *side)
{
    const int64_t b = s->face[polygon] / 2;
    const part *p = &s->parts[s->n_parts - 1];
    while (p->first_break > b)
        --p;
    *out = p;
    *side = (int)(s->face[polygon] % 2);
    return &p->breaks[b - p->first_break];
}

/* ---- what is found again: points ---- */

/* u + (R - 1) r */
static void turn(const double q[4], const double r[3], double u[3])
{
    double t[3];
    for (int c = 0; c < 3; ++c)
        t[c] = 2 * (q[1 + (c + 1) % 3] * r[(c + 2) % 3] - q[1 + (c + 2) % 3] * r[(c + 1) % 3]);
    for (int c = 0; c < 3; ++c)
        u[c] += q[0] * t[c] + q[1 + (c + 1) % 3] * t[(c + 2) % 3] - q[1 + (c + 2) % 3] * t[(c + 1) % 3];
}

/* Corner k of the octagon of a broken beam. */
static void octagon_point(const part *p, const brc_break *b, int k, double x[3])
{
    const double radius = 0.5 * (brc_simulation_beam_radius(p->simulation, b->element_i) +
                                 brc_simulation_beam_radius(p->simulation, b->element_j));
    const double c1 = radius * cos(2 * M_PI * k / SIDES), c2 = radius * sin(2 * M_PI * k / SIDES);
    double e1[3], e2[3];
    find_frame(b->normal, e1, e2);
    for (int c = 0; c < 3; ++c)
        x[c] = b->position[c] + c1 * e1[c] + c2 * e2[c];
}

static void sphere_displacement(const part *p, int64_t e, const double x[3], double u[3])
{
    double r[3];
    for (int c = 0; c < 3; ++c) {
        r[c] = x[c] - p->domain->position[3 * e + c];
        u[c] = p->displacement[3 * e + c];
    }
    turn(p->orientation + 4 * e, r, u);
}

/* Polygon that a point is a corner of. */
static int64_t polygon_of(const surface *s, int64_t point)
{
    int64_t low = 0, high = s->n_polygons - 1;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (s->end[middle] > point)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* Places of points, or their displacements, from point `first` on. */
static void fill_points(const surface *s, int64_t first, int64_t n, bool displacements, float *out)
{
    const int64_t last = first + n;
    for (int64_t at = first, polygon = n > 0 ? polygon_of(s, first) : 0; at < last; ++polygon) {
        const part *p;
        int side;
        const brc_break *b = find(s, polygon, &p, &side);
        const int64_t e = owner_of(p, b, side), begin = polygon > 0 ? s->end[polygon - 1] : 0;
        double gradient[3][3];
        if (displacements && !is_spheres(p)) brc_deform_gradient(p->domain, p->whole, p->displacement, e, gradient);
        for (; at < last && at < s->end[polygon]; ++at, out += 3) {
            double x[3], u[3];
            if (is_spheres(p))
                octagon_point(p, b, (int)(at - begin), x);
            else
                memcpy(x, p->domain->vertex + 3 * (p->domain->vertex_start[e] + s->corner[at]), sizeof x);
            if (displacements && is_spheres(p))
                sphere_displacement(p, e, x, u);
            else if (displacements)
                brc_deform_point(p->domain, p->displacement, e, (const double(*)[3])gradient, x, u);
            for (int c = 0; c < 3; ++c)
                out[c] = (float)(displacements ? u : x)[c];
        }
    }
}

/* ---- arrays of the file ---- */

static brc_status read_points(const brc_vtu_array *a, int64_t first, int64_t n, void *block)
{
    fill_points(a->source, first, n, false, block);
    return BRC_OK;
}

static brc_status read_displacements(const brc_vtu_array *a, int64_t first, int64_t n, void *block)
{
    fill_points(a->source, first, n, true, block);
    return BRC_OK;
}

static brc_status read_points_in_turn(const brc_vtu_array *a, int64_t first, int64_t n, void *block)
{
    int64_t *point = block;
    (void)a;
    for (int64_t k = 0; k < n; ++k)
        point[k] = first + k;
    return BRC_OK;
}

static brc_status read_types(const brc_vtu_array *a, int64_t first, int64_t n, void *block)
{
    (void)a, (void)first;
    memset(block, POLYGON, (size_t)n);
    return BRC_OK;
}

/* Numbers of polygons; exactly one of the two. */
typedef struct column {
    const char *name;
    int64_t (*count)(const part *p, const brc_break *b, int side);
    double (*number)(const brc_break *b);
} column;
static int64_t side_of(const part *p, const brc_break *b, int side)
{
    return (void)p, (void)b, side;
}
static int64_t stage_of(const part *p, const brc_break *b, int side)
{
    return (void)p, (void)side, b->stage;
}
static int64_t mode_of(const part *p, const brc_break *b, int side)
{
    return (void)p, (void)side, b->mode;
}
static int64_t bond_of(const part *p, const brc_break *b, int side)
{
    return (void)side, p->first_bond + b->bond;
}
static int64_t i_of(const part *p, const brc_break *b, int side)
{
    return (void)side, p->first_element + b->element_i;
}
static int64_t j_of(const part *p, const brc_break *b, int side)
{
    return (void)side, p->first_element + b->element_j;
}
static double time_of(const brc_break *b)
{
    return b->time;
}
static double load_of(const brc_break *b)
{
    return b->load;
}
static double energy_of(const brc_break *b)
{
    return b->energy;
}
static double stress_of(const brc_break *b)
{
    return b->stress;
}
static double area_of(const brc_break *b)
{
    return b->area;
}
static const column COLUMNS[] = {{"side", side_of, NULL},     {"stage", stage_of, NULL}, {"mode", mode_of, NULL},
                                 {"bond", bond_of, NULL},     {"element_i", i_of, NULL}, {"element_j", j_of, NULL},
                                 {"time", NULL, time_of},     {"load", NULL, load_of},   {"energy", NULL, energy_of},
                                 {"stress", NULL, stress_of}, {"area", NULL, area_of}};
enum { N_COLUMNS = sizeof COLUMNS / sizeof *COLUMNS };

/* skip: number of the column. */
static brc_status read_column(const brc_vtu_array *a, int64_t first, int64_t n, void *block)
{
    const column *c = &COLUMNS[a->skip];
    int64_t *count = block;
    double *number = block;
    for (int64_t k = 0; k < n; ++k) {
        const part *p;
        int side;
        const brc_break *b = find(a->source, first + k, &p, &side);
        if (c->count)
            count[k] = c->count(p, b, side);
        else
            number[k] = c->number(b);
    }
    return BRC_OK;
}

static brc_status write_surface(const surface *s, double time, const char *path)
{
    const int64_t n = s->n_polygons;
    brc_vtu_array list[6 + N_COLUMNS];
    int m = 0;
    list[m++] = (brc_vtu_array){BRC_VTU_FIELD_DATA, "TimeValue", BRC_VTU_FLOAT64, 1, 1, brc_vtu_from_memory, &time, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_POINTS, "Points", BRC_VTU_FLOAT32, 3, s->n_points, read_points, s, 0};
    list[m++] =
        (brc_vtu_array){BRC_VTU_CELLS, "connectivity", BRC_VTU_INT64, 1, s->n_points, read_points_in_turn, s, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_CELLS, "offsets", BRC_VTU_INT64, 1, n, brc_vtu_from_memory, s->end, 0};
    list[m++] = (brc_vtu_array){BRC_VTU_CELLS, "types", BRC_VTU_UINT8, 1, n, read_types, s, 0};
    list[m++] =
        (brc_vtu_array){BRC_VTU_POINT_DATA, "displacement", BRC_VTU_FLOAT32, 3, s->n_points, read_displacements, s, 0};
    for (int k = 0; k < N_COLUMNS; ++k)
        list[m++] = (brc_vtu_array){BRC_VTU_CELL_DATA,
                                    COLUMNS[k].name,
                                    COLUMNS[k].count ? BRC_VTU_INT64 : BRC_VTU_FLOAT64,
                                    1,
                                    n,
                                    read_column,
                                    s,
                                    k};
    return brc_vtu_write(s->context, path, s->n_points, n, m, list);
}

brc_status brc_crack_surface_write(brc_context *context, const brc_assembly *assembly, const char *path)
{
    surface s = {.context = context};
    brc_status status = take_surface(&s, assembly);
    if (status == BRC_OK) status = write_surface(&s, brc_simulation_total_time(assembly->part[0]), path);
    free_surface(&s);
    return status;
}
