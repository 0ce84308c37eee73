/* Parts are boxes of a coarse grid. Bonds inside of one bear nothing, so that few are looked at: those that join two,
 * and those of elements with prescribed components. */
#include "rigid_parts.h"
#include "../effects/fracture/breaking.h"
#include "../effects/loads/loads.h"
#include <lapacke.h>
#include <math.h>
#include <string.h>

/* As many boxes, about: three along each edge of a cube. With four an iteration saves no more than its longer sums and
 * the larger inverse take (bench/results/2026-11-27-campaign.md). */
enum { PARTS = 27, MOST_ALONG = 27 };
/* What motions that nothing holds meet, of the diagonal [-]: of rounding, 1e7 times as much comes back at
 * most, and elastic motions are far stiffer. */
static const double soft = 1e-7;

struct brc_rigid_parts {
    brc_simulation *s;
    int64_t n;
    brc_pass *passes, *collect, *spread, *solve;
    brc_buffer *start, *member;              /* elements by part */
    brc_buffer *aggregate, *arm, *free_bits; /* of rows: part, place from its centre [m], components that are free */
    brc_buffer *whole_force, *whole_torque;  /* [n] */
    brc_buffer *whole_move, *whole_turn;     /* [n] */
    brc_buffer *inverse;                     /* [n][n][36] */
    bool swells;                             /* no: they are rigid, and what swelling has is not there */
    brc_buffer *nothing;
};

BRC_COUNTED(each_row, w->layout->n_rows)
BRC_COUNTED(each_element, w->domain->n_elements)
BRC_COUNTED(each_pair, w->n_listed * w->n_listed)
#define WORDS "rigid parts"
#define AT(member) BRC_FIELD_AT(brc_rigid_parts, member)
static const brc_field_row rows[] = {
    BRC_FIELD(start, brc_each_listed_end, 1, INT, NULL, WORDS, "-"),
    BRC_FIELD(member, each_element, 1, INT, NULL, WORDS, "-"),
    BRC_FIELD(aggregate, each_row, 1, INT, NULL, WORDS, "-"),
    BRC_FIELD(arm, each_row, 3, COEFF, NULL, WORDS, "m"),
    BRC_FIELD(free_bits, each_row, 1, INT, NULL, WORDS, "-"),
    BRC_FIELD(whole_force, brc_each_listed, 3, STATE, NULL, WORDS, "N"),
    BRC_FIELD(whole_torque, brc_each_listed, 3, STATE, NULL, WORDS, "N m"),
    BRC_FIELD(whole_move, brc_each_listed, 3, STATE, NULL, WORDS, "m"),
    BRC_FIELD(whole_turn, brc_each_listed, 3, STATE, NULL, WORDS, "rad"),
    BRC_FIELD(inverse, each_pair, 36, STATE, NULL, WORDS, "m/N"),
};
BRC_FIELD_TABLE(brc_rigid_parts_fields, WORDS, BRC_LIFE_GROWS, NULL, rows);

/* Elements by part, on the host. */
typedef struct plan {
    const brc_simulation *s;
    int32_t n;
    int32_t *part;       /* [n_elements] -1: without bonds */
    int32_t *count;      /* [n] */
    double (*centre)[3]; /* [n] */
    uint8_t *free_bits;  /* [n_elements] */
    uint8_t *whole;      /* [n_half_edges] 0: broken; NULL: none is */
    int32_t *joint_of;   /* [n][n] of two parts, the first the lower: from 1 on; 0: no bond joins them */
    struct joint *joint; /* [n_joints] */
    int32_t n_joints;
    double *matrix; /* [6 n][6 n] above the diagonal */
} plan;

static void free_plan(plan *p)
{
    brc_memory_free(p->part);
    brc_memory_free(p->count);
    brc_memory_free(p->centre);
    brc_memory_free(p->free_bits);
    brc_memory_free(p->whole);
    brc_memory_free(p->joint_of);
    brc_memory_free(p->joint);
    brc_memory_free(p->matrix);
}

bool brc_rigid_parts_suit(const brc_simulation *s)
{
    return brc_solves_rotations(s->model) && s->model->statics->bond && !s->domain->here;
}

/* Boxes with edges as equal as whole numbers of them allow; those without elements are no parts. */
static brc_status cut(plan *p)
{
    const brc_domain *d = p->s->domain;
    double edge[3], volume = 1;
    int32_t along[3], n_boxes = 1;
    for (int c = 0; c < 3; ++c) {
        edge[c] = fmax(d->bounds[1][c] - d->bounds[0][c], 1e-300);
        volume *= edge[c];
    }
    for (int c = 0; c < 3; ++c) {
        along[c] = (int32_t)fmin(fmax(round(edge[c] / cbrt(volume / PARTS)), 1), MOST_ALONG);
        n_boxes *= along[c];
    }
    BRC_TRY(BRC_ALLOCATE(p->s->context, &p->part, d->n_elements, WORDS));
    BRC_TRY(BRC_ALLOCATE(p->s->context, &p->count, n_boxes, WORDS));
    BRC_TRY(BRC_ALLOCATE(p->s->context, &p->centre, n_boxes, WORDS));
    BRC_LOCAL(p->s->context, n_boxes, int32_t, number, WORDS);
    for (int64_t e = 0; e < d->n_elements; ++e) {
        int32_t box = 0;
        for (int c = 2; c >= 0; --c) {
            const double at = (d->position[3 * e + c] - d->bounds[0][c]) / edge[c] * along[c];
            box = box * along[c] + (int32_t)fmin(fmax(at, 0), along[c] - 1);
        }
        p->part[e] = d->row_start[e + 1] > d->row_start[e] ? box : -1;
        if (p->part[e] >= 0) number[box] = 1;
    }
    for (int32_t k = 0; k < n_boxes; ++k)
        number[k] = number[k] ? p->n++ : -1;
    for (int64_t e = 0; e < d->n_elements; ++e) {
        if (p->part[e] < 0) continue;
        const int32_t k = p->part[e] = number[p->part[e]];
        for (int c = 0; c < 3; ++c)
            p->centre[k][c] += d->position[3 * e + c];
        p->count[k] += 1;
    }
    for (int32_t k = 0; k < p->n; ++k)
        for (int c = 0; c < 3; ++c)
            p->centre[k][c] /= p->count[k];
    return BRC_OK;
}

static void clear_prescribed(void *self, const brc_prescribed *one)
{
    plan *p = self;
    if (one->face < 0) p->free_bits[one->element] &= (uint8_t) ~(one->motion | one->rotation << 3);
}

/* A bond: unit vector and length of its branch, stiffness along and across it [N/m], of its ends' rotation across and
 * along it [N m]; its ends stretch by `stretch` and turn against each other by `turn` for each motion of two parts. */
typedef struct bond {
    double n[3], length, stiffness[4];
    double stretch[3][12], turn[3][12];
} bond;

/* What the motion of its part is at element e, which is the first (side 0) or second end. */
static void move_end(const plan *p, int64_t e, int side, bond *b)
{
    const int bits = p->free_bits[e];
    const double sign = side ? 1 : -1, half = b->length / 2;
    const double *centre = p->centre[p->part[e]], *x = p->s->domain->position + 3 * e;
    for (int r = 0; r < 3; ++r) {
        const int next = (r + 1) % 3, last = (r + 2) % 3;
        if (bits >> r & 1) {
            b->stretch[r][6 * side + r] += sign;
            b->stretch[r][6 * side + 3 + next] += sign * (x[last] - centre[last]);
            b->stretch[r][6 * side + 3 + last] -= sign * (x[next] - centre[next]);
        }
        if (bits >> (3 + r) & 1) {
            b->stretch[next][6 * side + 3 + r] += half * b->n[last];
            b->stretch[last][6 * side + 3 + r] -= half * b->n[next];
            b->turn[r][6 * side + 3 + r] += sign;
        }
    }
}

/* Energy of a bond: e.M e/2 + t.C t/2 with M = axial n n^T + shear (1 - n n^T), C likewise, e its stretch and t its
 * turn. */
static void add_bond(plan *p, int64_t e, int64_t other, bond *b)
{
    const int32_t first = 6 * p->part[e], second = 6 * p->part[other], n = 6 * p->n;
    const double *k = b->stiffness;
    double along[12] = {0}, about[12] = {0};
    const bool inside = first == second;
    memset(b->stretch, 0, sizeof b->stretch);
    memset(b->turn, 0, sizeof b->turn);
    move_end(p, e, 0, b);
    move_end(p, other, 1, b);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 12; ++c) {
            along[c] += b->n[r] * b->stretch[r][c];
            about[c] += b->n[r] * b->turn[r][c];
        }
    for (int c = 0; c < 12; ++c)
        for (int q = c; q < 12; ++q) {
            double stretch = 0, turn = 0;
            for (int r = 0; r < 3; ++r) {
                stretch += b->stretch[r][c] * b->stretch[r][q];
                turn += b->turn[r][c] * b->turn[r][q];
            }
            const double value = k[1] * stretch + (k[0] - k[1]) * along[c] * along[q] + k[2] * turn +
                                 (k[3] - k[2]) * about[c] * about[q];
            const int32_t row = c < 6 ? first + c : second + c - 6, column = q < 6 ? first + q : second + q - 6;
            const bool twice = inside && c < 6 && q >= 6 && row == column; /* stands for (q, c) too */
            p->matrix[(int64_t)(row < column ? row : column) * n + (row < column ? column : row)] +=
                twice ? 2 * value : value;
        }
}

/* What all bonds between two parts that move as wholes resist: d.A d/2 + d.B w + w.C w/2 of how far the second moves,
 * at the first one's centre, and turns against the first. */
typedef struct joint {
    int32_t part[2];
    double a[3][3], b[3][3], c[3][3];
} joint;

/* out = m [r]x, where [r]x w = r x w. */
static void times_cross(const double m[3][3], const double r[3], double out[3][3])
{
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c)
            out[i][c] = m[i][(c + 1) % 3] * r[(c + 2) % 3] - m[i][(c + 2) % 3] * r[(c + 1) % 3];
}

/* A bond acts at its middle, r from the centre: there d - [r]x w. */
static void add_to_joint(joint *j, const bond *b, const double r[3])
{
    const double *k = b->stiffness;
    double moved[3][3], turned[3][3], half[3][3], whole[3][3];
    for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) {
            const double nn = b->n[p] * b->n[q], rest = (p == q) - nn;
            moved[p][q] = k[0] * nn + k[1] * rest;
            turned[p][q] = k[3] * nn + k[2] * rest;
        }
    times_cross(moved, r, half);
    double across[3][3];
    for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
            across[p][q] = half[q][p];
    times_cross(across, r, whole);
    for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) {
            j->a[p][q] += moved[p][q];
            j->b[p][q] -= half[p][q];
            j->c[p][q] += turned[p][q] + whole[p][q];
        }
}

/* Onto the matrix: the first part's motion is (-1, 0; 0, -1) of its own, the second's (1, -[r]x; 0, 1), r from its
 * centre to the first one's. */
static void add_joint(plan *p, const joint *j)
{
    const int32_t n = 6 * p->n;
    double k[6][6], way[2][6][6] = {0};
    for (int c = 0; c < 3; ++c) {
        const int next = (c + 1) % 3, last = (c + 2) % 3;
        const double r = p->centre[j->part[0]][c] - p->centre[j->part[1]][c];
        way[0][c][c] = way[0][c + 3][c + 3] = -1;
        way[1][c][c] = way[1][c + 3][c + 3] = 1;
        way[1][next][3 + last] += r; /* -(r x w) */
        way[1][last][3 + next] -= r;
    }
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            k[a][b] = j->a[a][b];
            k[a][b + 3] = k[b + 3][a] = j->b[a][b];
            k[a + 3][b + 3] = j->c[a][b];
        }
    for (int first = 0; first < 2; ++first)
        for (int second = first; second < 2; ++second)
            for (int a = 0; a < 6; ++a)
                for (int b = first == second ? a : 0; b < 6; ++b) {
                    double sum = 0;
                    for (int i = 0; i < 6; ++i)
                        for (int c = 0; c < 6; ++c)
                            sum += way[first][i][a] * k[i][c] * way[second][c][b];
                    p->matrix[(int64_t)(6 * j->part[first] + a) * n + 6 * j->part[second] + b] += sum;
                }
}

static brc_status joint_between(plan *p, int32_t first, int32_t second, joint **out)
{
    int32_t *number = p->joint_of + (int64_t)first * p->n + second;
    if (*number == 0) {
        BRC_TRY(brc_memory_resize(p->s->context, (void **)&p->joint, p->n_joints + 1, sizeof *p->joint, WORDS));
        p->joint[p->n_joints] = (joint){.part = {first, second}};
        *number = ++p->n_joints;
    }
    *out = p->joint + *number - 1;
    return BRC_OK;
}

/* P^T K P. */
static brc_status add_bonds(plan *p)
{
    const brc_domain *d = p->s->domain;
    BRC_TRY(BRC_ALLOCATE(p->s->context, &p->matrix, 36 * (int64_t)p->n * p->n, WORDS));
    BRC_TRY(BRC_ALLOCATE(p->s->context, &p->joint_of, (int64_t)p->n * p->n, WORDS));
    for (int64_t i = 0; i < d->n_bonds; ++i) {
        const int64_t h = d->bond_half_edge[i];
        int64_t e = d->neighbour[d->twin[h]], other = d->neighbour[h];
        const bool free = p->free_bits[e] == 63 && p->free_bits[other] == 63;
        double square = 0, middle[3];
        bond b;
        if ((free && p->part[e] == p->part[other]) || (p->whole && !p->whole[h])) continue;
        if (p->part[e] > p->part[other]) {
            const int64_t swapped = e;
            e = other, other = swapped;
        }
        for (int c = 0; c < 3; ++c) {
            b.n[c] = d->position[3 * other + c] - d->position[3 * e + c];
            square += b.n[c] * b.n[c];
            middle[c] = d->position[3 * e + c] + b.n[c] / 2 - p->centre[p->part[e]][c];
        }
        b.length = sqrt(square);
        for (int c = 0; c < 3; ++c)
            b.n[c] /= b.length;
        p->s->model->statics->bond(p->s, e, other, b.length, square, b.stiffness);
        if (free) {
            joint *j;
            BRC_TRY(joint_between(p, p->part[e], p->part[other], &j));
            add_to_joint(j, &b, middle);
        } else {
            add_bond(p, e, other, &b);
        }
    }
    for (int32_t i = 0; i < p->n_joints; ++i)
        add_joint(p, &p->joint[i]);
    return BRC_OK;
}

/* The matrix becomes its inverse, whole. */
static brc_status invert(plan *p, bool *done)
{
    const int32_t n = 6 * p->n;
    BRC_LOCAL(p->s->context, n, double, scale, WORDS);
    for (int32_t r = 0; r < n; ++r)
        scale[r] = p->matrix[(int64_t)r * (n + 1)] > 0 ? 1 / sqrt(p->matrix[(int64_t)r * (n + 1)]) : 0;
    for (int64_t r = 0; r < n; ++r)
        for (int64_t c = r; c < n; ++c)
            p->matrix[r * n + c] = r == c ? 1 + soft : p->matrix[r * n + c] * scale[r] * scale[c];
    *done = LAPACKE_dpotrf(LAPACK_ROW_MAJOR, 'U', n, p->matrix, n) == 0 &&
            LAPACKE_dpotri(LAPACK_ROW_MAJOR, 'U', n, p->matrix, n) == 0;
    for (int64_t r = 0; r < n; ++r)
        for (int64_t c = r; c < n; ++c)
            p->matrix[c * n + r] = p->matrix[r * n + c] *= scale[r] * scale[c];
    return BRC_OK;
}

static brc_status upload(brc_rigid_parts *parts, const plan *p)
{
    brc_simulation *s = parts->s;
    const brc_layout *layout = s->layout;
    const int64_t n = s->domain->n_elements, n_rows = layout->n_rows;
    const brc_wants wants = brc_wants_listed(&s->wants, p->n);
    BRC_LOCAL(s->context, p->n + 2, int32_t, start, WORDS);
    BRC_LOCAL(s->context, n, int32_t, member, WORDS);
    BRC_LOCAL(s->context, n_rows, int32_t, aggregate, WORDS);
    BRC_LOCAL(s->context, n_rows, int32_t, bits, WORDS);
    BRC_LOCAL(s->context, 3 * n_rows, double, arm, WORDS);
    for (int32_t k = 0; k < p->n; ++k)
        start[k + 2] = start[k + 1] + p->count[k];
    for (int64_t r = 0; r < n_rows; ++r)
        aggregate[r] = -1;
    for (int64_t e = 0; e < n; ++e) {
        const int32_t k = p->part[e], r = layout->row_of_element[e];
        if (k < 0) continue;
        member[start[k + 1]++] = r;
        aggregate[r] = k;
        bits[r] = p->free_bits[e];
        for (int c = 0; c < 3; ++c)
            arm[3 * (int64_t)r + c] = s->domain->position[3 * e + c] - p->centre[k][c];
    }
    BRC_TRY(brc_fields_create(s->device, &brc_rigid_parts_fields, &wants, parts));
    BRC_TRY(brc_upload_int(parts->start, start, p->n + 1));
    BRC_TRY(brc_upload_int(parts->member, member, n));
    BRC_TRY(brc_upload_int(parts->aggregate, aggregate, n_rows));
    BRC_TRY(brc_upload_int(parts->free_bits, bits, n_rows));
    BRC_TRY(brc_upload_coeff(s, parts->arm, arm, 3 * n_rows));
    return brc_upload_state(s, parts->inverse, p->matrix, 36 * (int64_t)p->n * p->n);
}

static brc_status make_passes(brc_rigid_parts *parts)
{
    brc_simulation *s = parts->s;
    const brc_scope run = brc_scope_of_run(s);
    static const brc_value_row values[] = {{"swells", BRC_VALUE_BOOL, AT(swells)},
                                           {"virial", BRC_VALUE_BUFFER, AT(nothing)},
                                           {"swell", BRC_VALUE_BUFFER, AT(nothing)},
                                           {"whole_virial", BRC_VALUE_BUFFER, AT(nothing)},
                                           {"whole_swell", BRC_VALUE_BUFFER, AT(nothing)}};
    const brc_scope own = {
        .owner = WORDS, .base = parts, .tables = {&brc_rigid_parts_fields}, BRC_VALUES(values), .outer = &run};
    BRC_TRY(brc_pass_make(s->context, s->device, &own, "multigrid_collect", "force torque", &parts->passes,
                          &parts->collect));
    BRC_TRY(brc_pass_make(s->context, s->device, &own, "multigrid_coarsest", "force torque move turn", &parts->passes,
                          &parts->solve));
    return brc_pass_make(s->context, s->device, &own, "multigrid_spread", "move turn", &parts->passes, &parts->spread);
}

brc_status brc_rigid_parts_create(brc_simulation *s, brc_rigid_parts **out)
{
    BRC_ENDS_WITH(brc_rigid_parts_free) brc_rigid_parts *parts = NULL;
    BRC_ENDS_WITH(free_plan) plan p = {.s = s};
    bool done;
    *out = NULL;
    BRC_TRY(cut(&p));
    BRC_TRY(BRC_ALLOCATE(s->context, &p.free_bits, s->domain->n_elements, WORDS));
    memset(p.free_bits, 63, (size_t)s->domain->n_elements);
    brc_loads_each_prescribed(s, clear_prescribed, &p);
    if (s->fracture) BRC_TRY(brc_fracture_whole(s, &p.whole));
    BRC_TRY(add_bonds(&p));
    BRC_TRY(invert(&p, &done));
    if (!done) return BRC_OK;
    BRC_TRY(BRC_ALLOCATE(s->context, &parts, 1, WORDS));
    parts->s = s;
    parts->n = p.n;
    BRC_TRY(upload(parts, &p));
    BRC_TRY(make_passes(parts));
    *out = parts;
    parts = NULL;
    return BRC_OK;
}

void brc_rigid_parts_free(brc_rigid_parts **parts)
{
    if (!*parts) return;
    brc_passes_free(&(*parts)->passes);
    brc_fields_free(&brc_rigid_parts_fields, *parts);
    brc_memory_free(*parts);
    *parts = NULL;
}

brc_status brc_rigid_parts_add(brc_rigid_parts *p, brc_unknowns r, brc_unknowns z)
{
    BRC_TRY(BRC_RUN(p->collect, p->n, {"force", BRC_BUF(r.move)}, {"torque", BRC_BUF(r.turn)}));
    BRC_TRY(BRC_RUN(p->solve, p->n, {"force", BRC_BUF(p->whole_force)}, {"torque", BRC_BUF(p->whole_torque)},
                    {"move", BRC_BUF(p->whole_move)}, {"turn", BRC_BUF(p->whole_turn)}));
    return BRC_RUN(p->spread, p->s->layout->n_rows, {"move", BRC_BUF(z.move)}, {"turn", BRC_BUF(z.turn)});
}
