/* What strikers are: mass properties and convex pieces of their shapes (preprocess/convex.h), turned to where the scene
 * puts them, and their faces for pictures. */
#include "../../../../preprocess/domain/pose.h"
#include "strikers_internal.h"
#include <math.h>
#include <string.h>

/* Cells that stand for a shape that is not convex, for every flat face around a turn of curved ones. */
enum { PIECES_PER_FACET = 10 };

static brc_status no_mass(brc_simulation *s, const brc_striker *striker, double mass, double volume)
{
    return BRC_FAIL(s->context, BRC_BAD_INPUT,
                    "striker '%s': is free and has mass %.6g kg: its volume is %.6g m^3 and the density of material "
                    "'%s' %.6g kg/m^3; give it a mass",
                    striker->name, mass, volume, s->scene->materials[striker->material].name,
                    s->elastic[striker->material].density);
}

static void turn(const double m[3][3], const double x[3], double out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2];
}

/* The striker's pose, about the shape's origin and then moved; M I M^T. */
static void put_in_place(const brc_striker *striker, const brc_rigid *rigid, const double m[3][3],
                         brc_striker_body *out)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1},
                     entry[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    double arm[3], turned[3];
    for (int c = 0; c < 3; ++c)
        arm[c] = rigid->centre[c] - striker->shape.origin[c];
    turn(m, arm, turned);
    for (int c = 0; c < 3; ++c)
        out->centre[c] = striker->shape.origin[c] + turned[c] + striker->translation[c];
    for (int c = 0; c < 6; ++c) {
        out->inertia[c] = 0;
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                out->inertia[c] += m[row[c]][k] * rigid->inertia[entry[k][l]] * m[column[c]][l];
    }
    out->volume = rigid->volume;
}

static brc_status set_mass(brc_simulation *s, const brc_striker *striker, brc_striker_body *out)
{
    const bool is_free = striker->motion == BRC_STRIKER_FREE;
    out->mass = !is_free ? 0 : striker->mass > 0 ? striker->mass : out->volume * s->elastic[striker->material].density;
    if (is_free && (!(out->mass > 0) || !isfinite(out->mass))) return no_mass(s, striker, out->mass, out->volume);
    for (int c = 0; c < 6; ++c)
        out->inertia[c] *= out->mass / out->volume;
    return BRC_OK;
}

/* ---- pieces ---- */

/* The first `count` numbers of each of the lists of `all`, and room for those of `more`. */
static brc_status make_room(brc_context *context, brc_convex *all, const brc_convex *more)
{
    const char *what = "pieces of strikers";
    const int64_t n = all->n + more->n,
                  corners = (all->n ? all->corner_start[all->n] : 0) + more->corner_start[more->n];
    const int64_t faces_before = all->n ? all->face_start[all->n] : 0, faces = faces_before + more->face_start[more->n];
    const int64_t loops = (all->n ? all->loop_start[faces_before] : 0) + more->loop_start[more->face_start[more->n]];
    BRC_TRY(brc_memory_resize(context, (void **)&all->corner_start, n + 1, sizeof *all->corner_start, what));
    BRC_TRY(brc_memory_resize(context, (void **)&all->face_start, n + 1, sizeof *all->face_start, what));
    BRC_TRY(brc_memory_resize(context, (void **)&all->radius, n, sizeof *all->radius, what));
    BRC_TRY(brc_memory_resize(context, (void **)&all->corner, 3 * corners, sizeof *all->corner, what));
    BRC_TRY(brc_memory_resize(context, (void **)&all->plane, 4 * faces, sizeof *all->plane, what));
    BRC_TRY(brc_memory_resize(context, (void **)&all->loop_start, faces + 1, sizeof *all->loop_start, what));
    return brc_memory_resize(context, (void **)&all->loop, loops, sizeof *all->loop, what);
}

/* Put `more` behind `all`, turned about the origins. */
static brc_status append(brc_context *context, brc_convex *all, const brc_convex *more, const double m[3][3])
{
    BRC_TRY(make_room(context, all, more));
    if (all->n == 0) all->corner_start[0] = all->face_start[0] = all->loop_start[0] = 0;
    const int32_t corners = all->corner_start[all->n], faces = all->face_start[all->n], loops = all->loop_start[faces];
    for (int32_t p = 0; p < more->n; ++p) {
        all->corner_start[all->n + p + 1] = corners + more->corner_start[p + 1];
        all->face_start[all->n + p + 1] = faces + more->face_start[p + 1];
        all->radius[all->n + p] = more->radius[p];
    }
    for (int64_t k = 0; k < more->corner_start[more->n]; ++k)
        turn(m, more->corner + 3 * k, all->corner + 3 * (corners + k));
    for (int64_t f = 0; f < more->face_start[more->n]; ++f) {
        turn(m, more->plane + 4 * f, all->plane + 4 * (faces + f));
        all->plane[4 * (faces + f) + 3] = more->plane[4 * f + 3];
        all->loop_start[faces + f + 1] = loops + more->loop_start[f + 1];
    }
    memcpy(all->loop + loops, more->loop, (size_t)more->loop_start[more->face_start[more->n]] * sizeof *all->loop);
    all->n += more->n;
    return BRC_OK;
}

static brc_status add_pieces(brc_simulation *s, int32_t striker, brc_piece_kind kind, const brc_convex *more,
                             const double m[3][3])
{
    brc_strikers *t = s->strikers;
    const int32_t n = t->convex.n + more->n;
    BRC_TRY(
        brc_memory_resize(s->context, (void **)&t->piece_striker, n, sizeof *t->piece_striker, "pieces of strikers"));
    BRC_TRY(brc_memory_resize(s->context, (void **)&t->piece_kind, n, sizeof *t->piece_kind, "pieces of strikers"));
    BRC_TRY(brc_memory_resize(s->context, (void **)&t->piece_radius, n, sizeof *t->piece_radius, "pieces of strikers"));
    for (int32_t p = t->convex.n; p < n; ++p) {
        t->piece_striker[p] = striker;
        t->piece_kind[p] = kind;
        t->piece_radius[p] = kind == BRC_PIECE_SPHERE ? s->scene->strikers[striker].shape.radius : 0;
    }
    return append(s->context, &t->convex, more, m);
}

/* ---- faces for pictures ---- */

static brc_status make_surface(brc_simulation *s, const brc_convex *pieces, const double m[3][3],
                               brc_striker_surface *out)
{
    const int32_t n_corners = pieces->corner_start[pieces->n], n_faces = pieces->face_start[pieces->n];
    BRC_TRY(BRC_ALLOCATE(s->context, &out->corner, 3 * (int64_t)n_corners, "faces of a striker"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->loop_start, n_faces + 1, "faces of a striker"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->loop, pieces->loop_start[n_faces], "faces of a striker"));
    out->n_corners = n_corners;
    out->n_faces = n_faces;
    for (int64_t k = 0; k < n_corners; ++k)
        turn(m, pieces->corner + 3 * k, out->corner + 3 * k);
    for (int32_t p = 0; p < pieces->n; ++p)
        for (int32_t f = pieces->face_start[p]; f < pieces->face_start[p + 1]; ++f) {
            out->loop_start[f + 1] = pieces->loop_start[f + 1];
            for (int32_t k = pieces->loop_start[f]; k < pieces->loop_start[f + 1]; ++k)
                out->loop[k] = pieces->corner_start[p] + pieces->loop[k];
        }
    return BRC_OK;
}

/* A square around the place on the plane that is nearest to the middle of the bodies, as wide as three of their
 * diagonals. */
static brc_status make_square(brc_simulation *s, const brc_striker *striker, brc_striker_surface *out)
{
    static const double side[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const double *n = striker->normal, (*bounds)[3] = s->domain->bounds;
    double across[2][3], foot[3], height = 0, diagonal = 0;
    for (int c = 0; c < 3; ++c) {
        foot[c] = 0.5 * (bounds[0][c] + bounds[1][c]) - striker->point[c];
        height += foot[c] * n[c];
        diagonal += (bounds[1][c] - bounds[0][c]) * (bounds[1][c] - bounds[0][c]);
    }
    const int least = fabs(n[0]) <= fabs(n[1]) && fabs(n[0]) <= fabs(n[2]) ? 0 : fabs(n[1]) <= fabs(n[2]) ? 1 : 2;
    const double length = sqrt(1 - n[least] * n[least]);
    for (int c = 0; c < 3; ++c)
        across[0][c] = ((c == least) - n[least] * n[c]) / length;
    for (int c = 0; c < 3; ++c)
        across[1][c] = n[(c + 1) % 3] * across[0][(c + 2) % 3] - n[(c + 2) % 3] * across[0][(c + 1) % 3];
    BRC_TRY(BRC_ALLOCATE(s->context, &out->corner, 12, "faces of a striker"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->loop_start, 2, "faces of a striker"));
    BRC_TRY(BRC_ALLOCATE(s->context, &out->loop, 4, "faces of a striker"));
    out->n_corners = out->loop_start[1] = 4;
    out->n_faces = 1;
    for (int k = 0; k < 4; ++k) {
        out->loop[k] = k;
        for (int c = 0; c < 3; ++c)
            out->corner[3 * k + c] = foot[c] - height * n[c] +
                                     1.5 * sqrt(diagonal) * (side[k][0] * across[0][c] + side[k][1] * across[1][c]);
    }
    return BRC_OK;
}

/* ---- all of one ---- */

static brc_status make_plane(brc_simulation *s, int32_t i)
{
    static const double straight[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const brc_striker *striker = s->scene->strikers + i;
    int32_t corner_start[2] = {0, 0}, face_start[2] = {0, 1}, loop_start[2] = {0, 0}, none = 0;
    double plane[4] = {striker->normal[0], striker->normal[1], striker->normal[2], 0}, radius = HUGE_VAL,
           nowhere[3] = {0};
    const brc_convex piece = {.n = 1,
                              .corner_start = corner_start,
                              .corner = nowhere,
                              .face_start = face_start,
                              .plane = plane,
                              .loop_start = loop_start,
                              .loop = &none,
                              .radius = &radius};
    memcpy(s->strikers->body[i].centre, striker->point, sizeof striker->point);
    BRC_TRY(add_pieces(s, i, BRC_PIECE_PLANE, &piece, straight));
    return make_square(s, striker, &s->strikers->body[i].surface);
}

static brc_status make_solid(brc_simulation *s, int32_t i)
{
    const brc_striker *striker = s->scene->strikers + i;
    brc_striker_body *body = &s->strikers->body[i];
    BRC_ENDS_WITH(brc_convex_free) brc_convex pieces = {0};
    brc_rigid rigid;
    double m[3][3];
    brc_pose_matrix(striker->rotation, m);
    const double(*turned)[3] = (const double(*)[3])m;
    const brc_status made = brc_convex_of_shape(s->context, &striker->shape, striker->facets,
                                                PIECES_PER_FACET * striker->facets, 0, &pieces, &rigid);
    if (made != BRC_OK)
        return BRC_FAIL(s->context, made,
                        "striker '%s': its shape cannot be made (one that is not convex is filled with %d cells; more "
                        "facets: more cells)",
                        striker->name, PIECES_PER_FACET * (int)striker->facets);
    put_in_place(striker, &rigid, turned, body);
    BRC_TRY(set_mass(s, striker, body));
    BRC_TRY(add_pieces(s, i, striker->shape.kind == BRC_SHAPE_SPHERE ? BRC_PIECE_SPHERE : BRC_PIECE_CONVEX, &pieces,
                       turned));
    return make_surface(s, &pieces, turned, &body->surface);
}

brc_status brc_striker_body_make(brc_simulation *s, int32_t i)
{
    return s->scene->strikers[i].is_plane ? make_plane(s, i) : make_solid(s, i);
}

void brc_striker_body_free(brc_striker_body *body)
{
    brc_memory_free(body->surface.corner);
    brc_memory_free(body->surface.loop_start);
    brc_memory_free(body->surface.loop);
}
