/* Every triangle of a halved icosahedron is acute, so the directions nearest to a vertex all lie in the triangles round
 * it: descending to the triangle that holds a direction and comparing its three corners finds the nearest vertex. */
#include "icosphere.h"
#include "../../host/base/memory.h"
#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* a x b . c */
static double triple(const double a[3], const double b[3], const double c[3])
{
    return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] + (a[0] * b[1] - a[1] * b[0]) * c[2];
}

static void scale_to_unit(double a[3])
{
    const double length = sqrt(dot(a, a));
    for (int c = 0; c < 3; ++c)
        a[c] /= length;
}

static void make_icosahedron(brc_icosphere *s)
{
    const double golden = (1 + sqrt(5.0)) / 2;
    for (int v = 0; v < 12; ++v) { /* (0, +-1, +-golden) and its cyclic shifts */
        const int axis = v / 4;
        double *to = s->vertex + 3 * v;
        to[axis] = 0;
        to[(axis + 1) % 3] = v & 1 ? -1 : 1;
        to[(axis + 2) % 3] = v & 2 ? -golden : golden;
        scale_to_unit(to);
    }
    int32_t *t = s->tree;
    for (int32_t a = 0; a < 12; ++a)
        for (int32_t b = a + 1; b < 12; ++b)
            for (int32_t c = b + 1; c < 12; ++c) {
                const double *p = s->vertex + 3 * a, *q = s->vertex + 3 * b, *r = s->vertex + 3 * c;
                if (dot(p, q) < 0.4 || dot(q, r) < 0.4 || dot(r, p) < 0.4) continue; /* neighbours have 1 / sqrt(5) */
                const bool outward = triple(p, q, r) > 0;
                *t++ = a;
                *t++ = outward ? b : c;
                *t++ = outward ? c : b;
            }
}

/* The vertices in the middle of edges, found by their ends: open addressing in a table at least twice too large. */
typedef struct edges {
    int64_t *key; /* [room] ends + 1, 0: free */
    int32_t *middle;
    uint64_t room; /* a power of two */
} edges;

static int32_t middle_of(brc_icosphere *s, edges *table, int32_t a, int32_t b)
{
    const int64_t key = (a < b ? (int64_t)a << 32 | b : (int64_t)b << 32 | a) + 1;
    uint64_t at = ((uint64_t)key * 0x9e3779b97f4a7c15u) >> 20;
    while (table->key[at &= table->room - 1] != 0 && table->key[at] != key)
        ++at;
    if (table->key[at] == 0) {
        double *to = s->vertex + 3 * (int64_t)s->n_vertices;
        for (int c = 0; c < 3; ++c)
            to[c] = s->vertex[3 * (int64_t)a + c] + s->vertex[3 * (int64_t)b + c];
        scale_to_unit(to);
        table->key[at] = key;
        table->middle[at] = s->n_vertices++;
    }
    return table->middle[at];
}

static brc_status halve(brc_context *context, brc_icosphere *s, const int32_t *from, int32_t n, int32_t *to)
{
    edges table = {.room = 64};
    brc_status status = BRC_OK;
    while (table.room < 3 * (uint64_t)n)
        table.room *= 2;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &table.key, table.room, "edges of an icosphere"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &table.middle, table.room, "edges of an icosphere"));
    for (int32_t k = 0; k < n; ++k, from += 3) {
        const int32_t a = from[0], b = from[1], c = from[2];
        const int32_t ab = middle_of(s, &table, a, b), bc = middle_of(s, &table, b, c), ca = middle_of(s, &table, c, a);
        const int32_t children[12] = {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
        memcpy(to, children, sizeof children);
        to += 12;
    }
cleanup:
    brc_memory_free(table.key);
    brc_memory_free(table.middle);
    return status;
}

/* Solid angle of the triangle of three directions of any length (Van Oosterom and Strackee 1983, the spherical excess
 * without angles); differences first, so that small triangles keep all digits. */
static double excess(const double a[3], const double b[3], const double c[3])
{
    double ab[3], ac[3];
    for (int k = 0; k < 3; ++k) {
        ab[k] = b[k] - a[k];
        ac[k] = c[k] - a[k];
    }
    const double la = sqrt(dot(a, a)), lb = sqrt(dot(b, b)), lc = sqrt(dot(c, c));
    return 2 * atan2(triple(ab, ac, a), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/* Each triangle gives its three corners what lies nearest to them: two small triangles each, between the corner, the
 * middles of its two edges, and the pole of the triangle's plane, which is as far from all three. */
static void measure_solid_angles(brc_icosphere *s)
{
    for (int32_t t = 0; t < s->n_triangles; ++t) {
        const double *corner[3];
        double middle[3][3], ab[3], ac[3];
        for (int k = 0; k < 3; ++k)
            corner[k] = s->vertex + 3 * (int64_t)s->triangle[3 * (int64_t)t + k];
        for (int k = 0; k < 3; ++k) {
            ab[k] = corner[1][k] - corner[0][k];
            ac[k] = corner[2][k] - corner[0][k];
            for (int e = 0; e < 3; ++e)
                middle[e][k] = (corner[e][k] + corner[(e + 1) % 3][k]) / 2;
        }
        double pole[3] = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
        scale_to_unit(pole);
        for (int k = 0; k < 3; ++k)
            s->solid_angle[s->triangle[3 * (int64_t)t + k]] +=
                excess(corner[k], middle[k], pole) + excess(corner[k], pole, middle[(k + 2) % 3]);
    }
}

brc_status brc_icosphere_make(brc_context *context, int level, brc_icosphere *out)
{
    memset(out, 0, sizeof *out);
    if (level < 0 || level > BRC_ICOSPHERE_LEVEL_MOST)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "level %d of the bins of directions; expected 0 (12 bins) to %d (%d bins)", level,
                        BRC_ICOSPHERE_LEVEL_MOST, 10 * (1 << 2 * BRC_ICOSPHERE_LEVEL_MOST) + 2);
    brc_status status = BRC_OK;
    const int32_t finest = 1 << 2 * level, n = 10 * finest + 2;
    out->level = level;
    out->n_triangles = 20 * finest;
    BRC_TRY_OR(failed, BRC_ALLOCATE(context, &out->vertex, 3 * n, "vertices of an icosphere"));
    BRC_TRY_OR(failed, BRC_ALLOCATE(context, &out->opposite, n, "vertices of an icosphere"));
    BRC_TRY_OR(failed, BRC_ALLOCATE(context, &out->solid_angle, n, "solid angles of an icosphere"));
    BRC_TRY_OR(failed, BRC_ALLOCATE(context, &out->tree, 20 * (4 * (int64_t)finest - 1), "triangles of an icosphere"));
    make_icosahedron(out);
    out->n_vertices = 12;
    out->triangle = out->tree;
    for (int32_t l = 0, n_level = 20; l < level; ++l, n_level *= 4) {
        int32_t *next = out->triangle + 3 * (int64_t)n_level;
        BRC_TRY_OR(failed, halve(context, out, out->triangle, n_level, next));
        out->triangle = next;
    }
    measure_solid_angles(out);
    for (int32_t v = 0; v < n; ++v) {
        const double *at = out->vertex + 3 * (int64_t)v, away[3] = {-at[0], -at[1], -at[2]};
        out->opposite[v] = brc_icosphere_nearest(out, away);
    }
    return BRC_OK;
failed:
    brc_icosphere_free(out);
    return status;
}

void brc_icosphere_free(brc_icosphere *sphere)
{
    brc_memory_free(sphere->vertex);
    brc_memory_free(sphere->opposite);
    brc_memory_free(sphere->solid_angle);
    brc_memory_free(sphere->tree);
    memset(sphere, 0, sizeof *sphere);
}

/* Which of the four children holds the direction: a corner's is cut off by the plane through two middles and the centre
 * of the sphere. A direction on the border is in both; so are the vertices nearest to it. */
static int child_of(const double *vertex, const int32_t middle[3], const double direction[3])
{
    const double *ab = vertex + 3 * (int64_t)middle[0], *bc = vertex + 3 * (int64_t)middle[1],
                 *ca = vertex + 3 * (int64_t)middle[2];
    if (triple(ca, ab, direction) < 0) return 0;
    if (triple(ab, bc, direction) < 0) return 1;
    if (triple(bc, ca, direction) < 0) return 2;
    return 3;
}

int32_t brc_icosphere_nearest(const brc_icosphere *s, const double direction[3])
{
    const int32_t *tree = s->tree;
    int32_t t = 0;
    double most = -HUGE_VAL;
    for (int32_t k = 0; k < 20; ++k) { /* the faces of an icosahedron are the regions nearest to their middles */
        const double *a = s->vertex + 3 * (int64_t)tree[3 * k], *b = s->vertex + 3 * (int64_t)tree[3 * k + 1],
                     *c = s->vertex + 3 * (int64_t)tree[3 * k + 2];
        const double sum[3] = {a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]};
        const double product = dot(sum, direction);
        if (product > most) {
            most = product;
            t = k;
        }
    }
    for (int32_t l = 0, n_level = 20; l < s->level; ++l, n_level *= 4) {
        const int32_t *next = tree + 3 * (int64_t)n_level;
        t = 4 * t + child_of(s->vertex, next + 3 * (4 * (int64_t)t + 3), direction);
        tree = next;
    }
    int32_t nearest = -1;
    most = -HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        const int32_t v = tree[3 * (int64_t)t + k];
        const double product = dot(s->vertex + 3 * (int64_t)v, direction);
        if (product > most || (product == most && v < nearest)) {
            most = product;
            nearest = v;
        }
    }
    return nearest;
}
