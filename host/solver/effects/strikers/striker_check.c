/* What is wrong, or looks wrong, with strikers before a run begins: they stand in a body, are quicker than sound, or
 * come near nothing. */
#include "strikers_internal.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../../base/ranks.h"
#include "../../core/sym3.h"
#include <math.h>
#include <string.h>

/* Shares of the mean spacing: a striker this deep in a body is refused, since it would start with the energy of an
 * explosion; one that is less deep by this much is warned of, and below that is the rounding of places. Spheres of a
 * packing stand out of its walls by about a hundredth of their radius. */
static const double refused_depth = 0.05, warned_depth = 1e-6, warned_depth_of_spheres = 0.02;

void brc_deepen(brc_overlap *deepest, double depth, int64_t element, const double x[3])
{
    if (!(depth > deepest->depth)) return;
    deepest->depth = depth;
    deepest->element = element;
    memcpy(deepest->place, x, sizeof deepest->place);
}

/* How deep x is in a piece of a striker: the least distance to its planes; below 0 outside. */
static double depth_in_piece(const brc_strikers *t, int32_t piece, const double x[3])
{
    const double *centre = t->body[t->piece_striker[piece]].centre,
                 r[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]};
    const double reach = t->convex.radius[piece];
    double depth = HUGE_VAL;
    if (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] > reach * reach) return -HUGE_VAL;
    for (int32_t f = t->convex.face_start[piece]; f < t->convex.face_start[piece + 1] && depth > 0; ++f) {
        const double *p = t->convex.plane + 4 * (int64_t)f;
        depth = fmin(depth, p[3] - p[0] * r[0] - p[1] * r[1] - p[2] * r[2]);
    }
    return depth;
}

/* Distance of r from the segment a b. */
static double from_segment(const double a[3], const double b[3], const double r[3])
{
    double along = 0, square = 0, rest = 0;
    for (int c = 0; c < 3; ++c) {
        along += (b[c] - a[c]) * (r[c] - a[c]);
        square += (b[c] - a[c]) * (b[c] - a[c]);
    }
    const double share = square > 0 ? fmin(fmax(along / square, 0), 1) : 0;
    for (int c = 0; c < 3; ++c)
        rest += pow(a[c] + share * (b[c] - a[c]) - r[c], 2);
    return sqrt(rest);
}

double brc_convex_face_distance(const brc_convex *v, int32_t p, int32_t f, const double r[3])
{
    const double *corner = v->corner + 3 * (int64_t)v->corner_start[p], *plane = v->plane + 4 * (int64_t)f;
    const double height = plane[0] * r[0] + plane[1] * r[1] + plane[2] * r[2] - plane[3];
    const int32_t first = v->loop_start[f], n = v->loop_start[f + 1] - first;
    double least = HUGE_VAL;
    bool over =
        true; /* above or below the polygon itself, not beyond one of its sides; without corners: a whole plane */
    for (int32_t k = 0; k < n; ++k) {
        const double *a = corner + 3 * (int64_t)v->loop[first + k],
                     *b = corner + 3 * (int64_t)v->loop[first + (k + 1) % n];
        double side = 0;
        for (int c = 0; c < 3; ++c) {
            const int i = (c + 1) % 3, j = (c + 2) % 3;
            side += plane[c] * ((b[i] - a[i]) * (r[j] - a[j]) - (b[j] - a[j]) * (r[i] - a[i]));
        }
        over = over && side >= 0;
        least = fmin(least, from_segment(a, b, r));
    }
    return over ? fabs(height) : least;
}

/* Distance of x, which is outside, from a piece: the least to its faces. */
static double away_from_piece(const brc_strikers *t, int32_t piece, const double x[3])
{
    const double *centre = t->body[t->piece_striker[piece]].centre,
                 r[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]};
    double least = HUGE_VAL;
    for (int32_t f = t->convex.face_start[piece]; f < t->convex.face_start[piece + 1]; ++f)
        least = fmin(least, brc_convex_face_distance(&t->convex, piece, f, r));
    return least;
}

/* How deep x is in a cell: likewise, over shared and free faces. */
static double depth_in_cell(const brc_domain *d, int64_t e, const double x[3])
{
    double depth = HUGE_VAL;
    for (int k = 0; k < 2; ++k) {
        const int64_t *start = k == 0 ? d->row_start : d->free_start;
        const double *area = k == 0 ? d->area_vector : d->free_area_vector,
                     *centroid = k == 0 ? d->face_centroid : d->free_centroid;
        for (int64_t f = start[e]; f < start[e + 1]; ++f) {
            double height = 0, square = 0;
            for (int c = 0; c < 3; ++c) {
                height += area[3 * f + c] * (centroid[3 * f + c] - x[c]);
                square += area[3 * f + c] * area[3 * f + c];
            }
            depth = fmin(depth, height / sqrt(square));
        }
    }
    return depth;
}

/* Elements in a piece: their corners, or spheres by their middles, which may stand outside by the radius. */
static void find_elements(const brc_domain *d, const brc_strikers *t, int32_t piece, brc_overlap *deepest)
{
    const bool spheres = d->element_kind == BRC_ELEMENT_SPHERE, round = t->piece_kind[piece] == BRC_PIECE_SPHERE;
    const double *centre = t->body[t->piece_striker[piece]].centre, reach = t->convex.radius[piece];
    for (int64_t e = 0; e < d->n_elements; ++e) {
        const double *x = d->position + 3 * e, out = spheres ? d->radius[e] : 0;
        if (!brc_domain_mine(d, e)) continue;
        const double away = hypot(hypot(x[0] - centre[0], x[1] - centre[1]), x[2] - centre[2]);
        if (spheres) {
            if (away - out > reach) continue;
            const double inside = round ? 0 : depth_in_piece(t, piece, x);
            brc_deepen(deepest,
                       out + (round        ? t->piece_radius[piece] - away
                              : inside > 0 ? inside
                                           : -away_from_piece(t, piece, x)),
                       e, x);
            continue;
        }
        for (int64_t v = d->vertex_start[e]; v < d->vertex_start[e + 1]; ++v)
            brc_deepen(deepest, depth_in_piece(t, piece, d->vertex + 3 * v), e, d->vertex + 3 * v);
    }
}

/* Corners of a piece in cells: x lies in the cell of the nearest position, if in any. Returns which corner is the
 * deepest, if it is deeper than what was found before. */
static int64_t find_corners(const brc_domain *d, const brc_strikers *t, int32_t piece, brc_overlap *deepest)
{
    int64_t at = INT64_MAX;
    const double *centre = t->body[t->piece_striker[piece]].centre;
    for (int32_t k = t->convex.corner_start[piece]; k <= t->convex.corner_start[piece + 1]; ++k) {
        const bool last = k == t->convex.corner_start[piece + 1]; /* its middle */
        if (last && t->piece_kind[piece] == BRC_PIECE_PLANE) break;
        double x[3], least = HUGE_VAL;
        int64_t nearest = -1;
        bool near = true;
        for (int c = 0; c < 3; ++c) {
            x[c] = centre[c] + (last ? 0 : t->convex.corner[3 * (int64_t)k + c]);
            near = near && x[c] > d->bounds[0][c] && x[c] < d->bounds[1][c];
        }
        for (int64_t e = 0; near && e < d->n_elements; ++e) {
            double square = 0;
            for (int c = 0; c < 3; ++c)
                square += (d->position[3 * e + c] - x[c]) * (d->position[3 * e + c] - x[c]);
            if (square >= least) continue;
            least = square;
            nearest = e;
        }
        const double depth = nearest >= 0 && brc_domain_mine(d, nearest) ? depth_in_cell(d, nearest, x) : 0;
        if (depth > deepest->depth) at = k;
        brc_deepen(deepest, depth, nearest, x);
    }
    return at;
}

/* All ranks: the deepest that one of them has found; of equal ones the first by `order`. */
static brc_status deepest_of_all(const brc_simulation *s, int64_t order, brc_overlap *deepest)
{
    typedef struct found {
        brc_overlap overlap;
        int64_t order;
    } found;
    const int32_t count = brc_ranks_count();
    const found own = {*deepest, order};
    if (!s->domain->here) return BRC_OK;
    BRC_LOCAL(s->context, count, found, all, "overlaps of ranks");
    BRC_LOCAL(s->context, count, int64_t, ones, "overlaps of ranks");
    for (int32_t k = 0; k < count; ++k)
        ones[k] = 1;
    BRC_TRY(brc_ranks_gather_all(s->context, &own, sizeof own, ones, all));
    int32_t best = 0;
    for (int32_t k = 1; k < count; ++k)
        if (all[k].overlap.depth > all[best].overlap.depth ||
            (all[k].overlap.depth == all[best].overlap.depth && all[k].order < all[best].order))
            best = k;
    *deepest = all[best].overlap;
    return BRC_OK;
}

BRC_READ(double, brc_striker_refused_depth, refused_depth * s->domain->quality.mean_spacing)
double brc_striker_warned_depth(const brc_simulation *s)
{
    return (s->domain->element_kind == BRC_ELEMENT_SPHERE ? warned_depth_of_spheres : warned_depth) *
           s->domain->quality.mean_spacing;
}

brc_status brc_striker_stands_in(brc_simulation *s, int32_t i, const brc_overlap *found)
{
    const brc_striker *striker = s->scene->strikers + i;
    const double *x = found->place;
    if (!(found->depth > brc_striker_warned_depth(s))) return BRC_OK;
    const int32_t owner = s->domain->body[found->element];
    const char *body = s->scene->bodies[owner < s->scene->n_bodies ? owner : 0].name;
    if (found->depth > brc_striker_refused_depth(s))
        return BRC_FAIL(s->context, BRC_BAD_INPUT,
                        "striker '%s' stands %s%.4g m deep in body '%s' as the scene starts, %s (%.6g, %.6g, %.6g) m "
                        "(spacing %.4g m): move one of them away%s",
                        striker->name, found->first ? "at least " : "", found->depth, body,
                        found->first ? "at" : "deepest at", x[0], x[1], x[2], s->domain->quality.mean_spacing,
                        striker->is_plane ? ", or turn the normal, which points out of the wall" : "");
    if (!s->strikers->warned[i])
        brc_log(s->context, BRC_LOG_WARNING,
                "striker '%s' stands %.4g m deep in body '%s' as the scene starts, at (%.6g, %.6g, %.6g) m: they begin "
                "pressed together",
                striker->name, found->depth, body, x[0], x[1], x[2]);
    s->strikers->warned[i] = true;
    return BRC_OK;
}

static brc_status check_overlap(brc_simulation *s, int32_t i)
{
    const brc_strikers *t = s->strikers;
    const brc_domain *d = s->domain;
    const bool spheres = d->element_kind == BRC_ELEMENT_SPHERE;
    brc_overlap deepest = {0};
    for (int32_t p = 0; p < t->convex.n; ++p) {
        if (t->piece_striker[p] != i) continue;
        find_elements(d, t, p, &deepest);
        BRC_TRY(deepest_of_all(s, deepest.element, &deepest));
        if (spheres) continue;
        const int64_t corner = find_corners(d, t, p, &deepest);
        BRC_TRY(deepest_of_all(s, corner, &deepest));
    }
    return brc_striker_stands_in(s, i, &deepest);
}

/* ---- speeds and ways ---- */

/* The largest value of its table; 1 without. */
static double largest_factor(const brc_striker *striker)
{
    double factor = striker->table.n > 0 ? 0 : 1;
    for (int32_t k = 0; k < striker->table.n; ++k)
        factor = fmax(factor, fabs(striker->table.value[k]));
    return factor;
}

/* The largest speed that the scene gives a striker's centre and surface [m/s]. */
static double speed_of(const brc_simulation *s, int32_t i)
{
    const brc_striker *striker = s->scene->strikers + i;
    double factor = 1, reach = 0;
    if (striker->motion == BRC_STRIKER_FIXED) return 0;
    if (striker->motion == BRC_STRIKER_DRIVEN) factor = largest_factor(striker);
    for (int32_t p = 0; p < s->strikers->convex.n; ++p)
        if (s->strikers->piece_striker[p] == i && !striker->is_plane)
            reach = fmax(reach, s->strikers->convex.radius[p]);
    return factor * (brc_norm3(striker->velocity) + reach * brc_norm3(striker->spin));
}

/* The largest speed of a field of velocities in the box around the bodies, which it has in a corner [m/s]. */
static double speed_of_field(const brc_initial *field, const double bounds[2][3])
{
    double most = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double v[3];
        for (int i = 0; i < 3; ++i) {
            v[i] = field->value[i];
            for (int j = 0; j < 3; ++j)
                v[i] += field->gradient[i][j] * (bounds[corner >> j & 1][j] - field->origin[j]);
        }
        most = fmax(most, brc_norm3(v));
    }
    return most;
}

/* The largest speed that initial fields and loads give elements [m/s]; spins count over the bodies' diagonal. */
static double speed_of_bodies(const brc_simulation *s)
{
    const double(*b)[3] = s->domain->bounds,
          diagonal = hypot(hypot(b[1][0] - b[0][0], b[1][1] - b[0][1]), b[1][2] - b[0][2]);
    double most = 0;
    for (int32_t k = 0; k < s->scene->n_stages; ++k) {
        const brc_stage *stage = s->scene->stages + k;
        for (int32_t f = 0; f < stage->n_initials; ++f) {
            const brc_initial *field = stage->initials + f;
            if (field->kind == BRC_INITIAL_VELOCITY || field->kind == BRC_INITIAL_RANDOM)
                most = fmax(most, speed_of_field(field, b));
            if (field->kind == BRC_INITIAL_SPIN) most = fmax(most, brc_norm3(field->value) * diagonal);
        }
        for (int32_t l = 0; l < stage->n_loads; ++l)
            if (stage->loads[l].kind == BRC_LOAD_FACE_VELOCITY || stage->loads[l].kind == BRC_LOAD_ELEMENT_VELOCITY)
                most = fmax(most, brc_norm3(stage->loads[l].value));
    }
    return most;
}

/* The slowest pressure wave of the bodies' materials [m/s]. */
static double slowest_wave(const brc_simulation *s, const char **name)
{
    double slowest = HUGE_VAL;
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        const int32_t m = s->material_of_element[e];
        const double speed = sqrt((s->elastic[m].lambda + 2 * s->elastic[m].mu) / s->elastic[m].density);
        if (!(speed < slowest)) continue;
        slowest = speed;
        *name = s->scene->materials[m].name;
    }
    return slowest;
}

static void check_speed(const brc_simulation *s, int32_t i, double bodies)
{
    const char *material = "";
    const double wave = slowest_wave(s, &material), speed = speed_of(s, i);
    if (speed + bodies > wave)
        brc_log(s->context, BRC_LOG_WARNING,
                "striker '%s' and the bodies meet with up to %.4g m/s, faster than the pressure wave of '%s', %.4g "
                "m/s: what is hit cannot give way; elastic laws "
                "do not hold for shock waves",
                s->scene->strikers[i].name, speed + bodies, material, wave);
}

/* How fast parts of the bodies are thrown at each other: the largest difference between velocities of sets, of what has
 * none too [m/s]. A field without a set moves all alike. */
static double speed_between_bodies(const brc_simulation *s)
{
    double most = 0;
    for (int32_t k = 0; k < s->scene->n_stages; ++k) {
        const brc_stage *stage = s->scene->stages + k;
        for (int32_t f = 0; f < stage->n_initials; ++f) {
            const brc_initial *one = stage->initials + f;
            if (one->kind != BRC_INITIAL_VELOCITY || !one->set[0]) continue;
            most = fmax(most, brc_norm3(one->value));
            for (int32_t g = 0; g < f; ++g) {
                const brc_initial *other = stage->initials + g;
                const double apart[3] = {one->value[0] - other->value[0], one->value[1] - other->value[1],
                                         one->value[2] - other->value[2]};
                if (other->kind == BRC_INITIAL_VELOCITY && other->set[0]) most = fmax(most, brc_norm3(apart));
            }
        }
    }
    return most;
}

void brc_contact_check_speed(const brc_simulation *s)
{
    const char *material = "";
    if (s->scene->n_bodies < 2) return;
    const double wave = slowest_wave(s, &material), speed = speed_between_bodies(s);
    if (speed > wave)
        brc_log(s->context, BRC_LOG_WARNING,
                "bodies meet with up to %.4g m/s, faster than the pressure wave of '%s', %.4g m/s: what is hit cannot "
                "give way; elastic laws do not hold for shock waves",
                speed, material, wave);
}

/* A velocity that the rail of a free striker does not let it have. */
static void check_rail(const brc_simulation *s, int32_t i)
{
    static const char axis[] = "xyz";
    const brc_striker *striker = s->scene->strikers + i;
    if (striker->motion != BRC_STRIKER_FREE) return;
    for (int c = 0; c < 3; ++c)
        if (striker->held[c] && striker->velocity[c] != 0)
            brc_log(s->context, BRC_LOG_WARNING,
                    "striker '%s': its velocity of %.4g m/s along %c is left out, as `hold` lets it not move along %c",
                    striker->name, striker->velocity[c], axis[c], axis[c]);
    if (striker->held_rotation && brc_norm3(striker->spin) > 0)
        brc_log(s->context, BRC_LOG_WARNING,
                "striker '%s': its spin of %.4g rad/s is left out, as `hold` lets it not turn", striker->name,
                brc_norm3(striker->spin));
}

/* Extent of striker i along its thinnest face's normal [m]; HUGE_VAL of planes, and of shapes of so many faces that
 * they are round. */
static double thickness_of(const brc_simulation *s, int32_t i)
{
    static const double most = 1e7; /* pairs of a face and a corner: a shape of more has thousands of faces */
    const brc_convex *v = &s->strikers->convex;
    int32_t first = v->n, end = 0; /* its pieces */
    double least = HUGE_VAL;
    for (int32_t p = 0; p < v->n; ++p)
        if (s->strikers->piece_striker[p] == i) first = p < first ? p : first, end = p + 1;
    const int32_t corner = v->corner_start[first], corners = v->corner_start[end], face = v->face_start[first],
                  faces = v->face_start[end];
    if (s->scene->strikers[i].is_plane || (double)(corners - corner) * (faces - face) > most) return HUGE_VAL;
    for (int32_t f = face; f < faces; ++f) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int32_t k = corner; k < corners; ++k) {
            const double *n = v->plane + 4 * (int64_t)f, *x = v->corner + 3 * (int64_t)k,
                         height = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
            low = fmin(low, height);
            high = fmax(high, height);
        }
        least = fmin(least, high - low);
    }
    return least;
}

/* A blow at speed v makes a pressure of density wave v in what is hit, and the penalty of a cell of size h bears it
 * when it is sunk in by h v / wave; a few times that on the way. What is sunk in from both sides of a striker at once
 * is pushed by neither. */
static void check_thickness(const brc_simulation *s, int32_t i, double bodies)
{
    const char *material = "";
    const double thick = thickness_of(s, i),
                 sunk = s->domain->quality.mean_spacing * (speed_of(s, i) + bodies) / slowest_wave(s, &material);
    if (thick < 3 * sunk)
        brc_log(s->context, BRC_LOG_WARNING,
                "striker '%s' is %.3g m thick where it is thinnest, and surfaces that meet with up to %.4g m/s sink "
                "into each other by some %.3g m: what sinks in through all of it is not held; "
                "make it thicker than %.3g m, or the cells smaller",
                s->scene->strikers[i].name, thick, speed_of(s, i) + bodies, sunk, 3 * sunk);
}

/* How far the box around a striker, or a plane, is from the box around all bodies [m]. */
static double gap_of(const brc_simulation *s, int32_t i)
{
    const brc_striker_body *body = &s->strikers->body[i];
    const double(*b)[3] = s->domain->bounds;
    double low[3], high[3], square = 0;
    if (s->scene->strikers[i].is_plane) {
        const double *n = s->scene->strikers[i].normal;
        double height = 0;
        for (int c = 0; c < 3; ++c)
            height += n[c] * ((n[c] > 0 ? b[0][c] : b[1][c]) - body->centre[c]);
        return fmax(height, 0);
    }
    for (int c = 0; c < 3; ++c) {
        low[c] = HUGE_VAL;
        high[c] = -HUGE_VAL;
        for (int32_t k = 0; k < body->surface.n_corners; ++k) {
            low[c] = fmin(low[c], body->centre[c] + body->surface.corner[3 * (int64_t)k + c]);
            high[c] = fmax(high[c], body->centre[c] + body->surface.corner[3 * (int64_t)k + c]);
        }
        square += pow(fmax(fmax(b[0][c] - high[c], low[c] - b[1][c]), 0), 2);
    }
    return sqrt(square);
}

/* Seconds of all dynamic stages; HUGE_VAL where some are counted in steps. */
static double duration_of(const brc_scene *scene)
{
    double sum = 0;
    for (int32_t k = 0; k < scene->n_stages; ++k) {
        if (scene->stages[k].solver != BRC_SOLVER_DYNAMIC) continue;
        if (scene->stages[k].steps > 0) return HUGE_VAL;
        sum += scene->stages[k].duration;
    }
    return sum;
}

/* Only where nothing flies by itself: fragments of a body that bursts go anywhere. */
static void check_reach(const brc_simulation *s, int32_t i, double bodies)
{
    const brc_striker *striker = s->scene->strikers + i;
    const double time = duration_of(s->scene), gap = gap_of(s, i);
    const double pull =
        (s->scene->has_gravity ? brc_norm3(s->scene->gravity) : 0) +
        (striker->pushed ? largest_factor(striker) * brc_norm3(striker->force) / s->strikers->body[i].mass : 0);
    const double way = (speed_of(s, i) + bodies) * time + 0.5 * pull * time * time;
    if (s->scene->has_fracture || !isfinite(time) || !(gap > 1.5 * way)) return;
    brc_log(s->context, BRC_LOG_WARNING,
            "striker '%s' is %.4g m away from all bodies; as far as the scene tells they come %.4g m nearer in its "
            "%.4g s and will not meet",
            s->scene->strikers[i].name, gap, way, time);
}

/* Strikers never meet each other: a free ball above a wall that is a striker too falls through it. */
static void tell_of_others(const brc_simulation *s)
{
    for (int32_t i = 0; s->strikers->n > 1 && i < s->strikers->n; ++i) {
        if (s->scene->strikers[i].motion != BRC_STRIKER_FREE) continue;
        brc_log(s->context, BRC_LOG_INFO,
                "striker '%s' meets the bodies only and passes through other strikers, such as '%s'",
                s->scene->strikers[i].name, s->scene->strikers[i == 0].name);
        return;
    }
}

brc_status brc_strikers_check(brc_simulation *s)
{
    const double bodies = speed_of_bodies(s);
    brc_status status = BRC_OK;
    for (int32_t i = 0; i < s->strikers->n; ++i) { /* all in one pass */
        const brc_status one = check_overlap(s, i);
        if (one != BRC_OK) status = one;
        check_speed(s, i, bodies);
        check_rail(s, i);
        check_thickness(s, i, bodies);
        check_reach(s, i, bodies);
    }
    tell_of_others(s);
    return status;
}
