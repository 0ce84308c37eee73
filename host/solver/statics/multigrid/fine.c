#include "fine.h"
#include "multigrid.h"
#include "../../../../preprocess/domain/domain_rows.h"
#include "../../effects/fracture/breaking.h"
#include "../../effects/loads/loads.h"
#include <math.h>

#include <string.h>

/* Springs along and across bonds that have the elasticity of the solid: of a uniform strain E their energy is lambda
 * tr(E)^2 / 2 + mu E:E with axial - shear = 5 lambda and shear = 2 mu - 2 lambda. Across bonds it must stay positive,
 * so lambda counts up to `most` of mu. Below zero it does not count: where volume is soft the law is as stiff along a
 * wave as it is without, and springs across bonds that make up for soft ones along them lock. */
brc_bond_moduli brc_bond_moduli_of(const brc_elastic *m)
{
    static const double most = 0.4, frame = 0.2; /* of mu; measured (docs/notebook/performance.md), flat about here */
    const double lambda = fmax(fmin(m->lambda, most * m->mu), 0);
    return (brc_bond_moduli){2 * m->mu + 3 * lambda, 2 * m->mu - 2 * lambda, frame * m->mu};
}

/* Of a bond between two materials: a fifth of the mean beside four fifths of both in series, for a cell takes its
 * strain from all its neighbours, so that a stiff one holds a soft one more than a spring in series would. Measured
 * (docs/notebook/theory.md T6). */
static double modulus_between(double a, double b)
{
    const double series = brc_in_series(a, b); /* of equals their own, to the last bit */
    return series + 0.2 * ((a + b) / 2 - series);
}

/* Where the volume is so much stiffer, or softer, that steps of the law itself pay. */
static bool is_stiff(const brc_elastic *m)
{
    return m->lambda > 35 * m->mu; /* nu above 0.486 */
}
static bool is_soft(const brc_elastic *m)
{
    return m->lambda < -0.63 * m->mu; /* nu below -0.85 */
}

bool brc_multigrid_has_law_steps(const brc_simulation *s)
{
    bool any = false;
    for (int32_t m = 0; m < s->scene->n_materials; ++m)
        any |= is_stiff(&s->elastic[m]) || is_soft(&s->elastic[m]);
    return any && !s->model->turns;
}

/* What coarser levels add to lambda: below zero most of it, without which bending is too stiff (all of it might leave
 * them without stiffness, since motions of aggregates change volumes in steps); where the volume is stiff as much as
 * helps beside steps of the law. */
static double volume_modulus(const brc_elastic *m)
{
    static const double part = 0.9, most = 3; /* of lambda; of mu: measured */
    return is_stiff(m) ? most * m->mu : part * fmin(m->lambda, 0);
}

/* A bond: unit vector and length of its branch, stiffness along and across it [N/m], of its ends' rotation across and
 * along it [N m]. */
typedef struct bond {
    double n[3], length, axial, shear, bend, twist;
} bond;

double brc_fine_area(const brc_fine *f, int64_t h)
{
    const brc_domain *d = f->s->domain;
    double square = 0;
    if (f->area) return f->area[d->bond[h]];
    for (int c = 0; c < 3; ++c)
        square += d->area_vector[3 * h + c] * d->area_vector[3 * h + c];
    return sqrt(square);
}

/* From where they are. */
static brc_status bring_areas(brc_simulation *s, brc_fine *f)
{
    const brc_domain *d = s->domain;
    double *area;
    BRC_TRY(BRC_ALLOCATE(s->context, &area, d->n_bonds, "areas of faces"));
    for (int64_t b = 0; b < d->n_bonds; ++b) {
        const int64_t h = d->bond_half_edge[b];
        if (brc_domain_mine(d, d->neighbour[d->twin[h]])) area[b] = brc_fine_area(f, h);
    }
    f->area = area;
    return brc_domain_bonds(s->context, d, area);
}

static bond bond_of(const brc_fine *f, int64_t e, int64_t h)
{
    const brc_simulation *s = f->s;
    const brc_domain *d = s->domain;
    const int64_t j = d->neighbour[h];
    double square = 0;
    bond b;
    for (int c = 0; c < 3; ++c) {
        b.n[c] = d->position[3 * j + c] - d->position[3 * e + c];
        square += b.n[c] * b.n[c];
    }
    b.length = sqrt(square);
    for (int c = 0; c < 3; ++c)
        b.n[c] /= b.length;
    if (s->model->statics->bond) {
        double k[4];
        s->model->statics->bond(s, e, j, b.length, square, k);
        b.axial = k[0], b.shear = k[1], b.bend = k[2], b.twist = k[3];
        return b;
    }
    const brc_bond_moduli *own = &f->moduli[s->material_of_element[e]], *other = &f->moduli[s->material_of_element[j]];
    const double weight = brc_fine_area(f, h) / b.length;
    b.axial = weight * modulus_between(own->axial, other->axial);
    b.shear = weight * modulus_between(own->shear, other->shear);
    b.bend = b.twist = weight * square * modulus_between(own->frame, other->frame);
    return b;
}

/* Blocks of the bond on the diagonal of its own end, added, and between its ends: with M = axial n n^T + shear (1 - n
 * n^T), R = [L n]x and C the stiffness of the frames, the energy is e.M e/2 + (theta_j - theta_i).C (theta_j -
 * theta_i)/2, e = u_j - u_i + R (theta_i + theta_j)/2. */
static void add_bond(const bond *b, brc_block own, brc_block other)
{
    const double couple = 0.5 * b->shear * b->length, lever = couple * 0.5 * b->length;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            const double nn = b->n[r] * b->n[c], rest = (r == c) - nn, m = b->axial * nn + b->shear * rest,
                         frames = b->bend * rest + b->twist * nn;
            own[6 * r + c] += m;
            other[6 * r + c] = -m;
            own[6 * (r + 3) + c + 3] += lever * rest + frames;
            other[6 * (r + 3) + c + 3] = lever * rest - frames;
        }
        other[6 * r + r + 3] = other[6 * (r + 3) + r] = 0;
        const int next = (r + 1) % 3, last = (r + 2) % 3; /* minus [n]x has n[last] at (r, next) */
        own[6 * r + next + 3] += couple * b->n[last];
        own[6 * r + last + 3] -= couple * b->n[next];
        own[6 * (next + 3) + r] += couple * b->n[last];
        own[6 * (last + 3) + r] -= couple * b->n[next];
        other[6 * r + next + 3] = couple * b->n[last];
        other[6 * r + last + 3] = -couple * b->n[next];
        other[6 * (r + 3) + next] = couple * b->n[last];
        other[6 * (r + 3) + last] = -couple * b->n[next];
    }
}

int32_t brc_fine_ground(const brc_fine *f, int64_t e)
{
    for (int32_t low = 0, high = f->n_ground - 1; low <= high;) {
        const int32_t middle = (low + high) / 2;
        if (f->ground_element[middle] == e) return middle;
        if (f->ground_element[middle] < e)
            low = middle + 1;
        else
            high = middle - 1;
    }
    return -1;
}

static int32_t fine_row(const void *of, int64_t e, int32_t *column, double *blocks)
{
    const brc_fine *f = of;
    brc_block *block = (brc_block *)blocks;
    const brc_domain *d = f->s->domain;
    int32_t n = 1;
    column[0] = (int32_t)e;
    if (block) memset(block[0], 0, sizeof *block);
    for (int64_t h = d->row_start[e]; h < d->row_start[e + 1]; ++h) {
        if (f->whole && !f->whole[h]) continue;
        column[n] = d->neighbour[h];
        if (block) {
            const bond b = bond_of(f, e, h);
            add_bond(&b, block[0], block[n]);
        }
        ++n;
    }
    if (!block) return n;
    for (int c = 0; c < 6; ++c)
        block[0][7 * c] *= 1 + f->soft;
    const int32_t held = brc_fine_ground(f, e);
    for (int c = 0; held >= 0 && c < 36; ++c)
        block[0][c] += f->ground[held][c];
    return n;
}

/* A held face is half a bond to a place that does not move, in its held components: J^T Pi M Pi J, J = (1, -[d]x) with
 * d from the element to the face. */
static void add_face(const brc_fine *f, int64_t face, int bits, brc_block out)
{
    const brc_domain *d = f->s->domain;
    const int64_t e = d->free_element[face];
    const brc_bond_moduli *k = &f->moduli[f->s->material_of_element[e]];
    double n[3], arm[3], surface = 0, reach = 0, j[3][6] = {{0}}, m[3][3];
    for (int c = 0; c < 3; ++c) {
        n[c] = d->free_area_vector[3 * face + c];
        arm[c] = d->free_centroid[3 * face + c] - d->position[3 * e + c];
        surface += n[c] * n[c];
        reach += arm[c] * arm[c];
    }
    for (int r = 0; r < 3; ++r) {
        const int next = (r + 1) % 3, last = (r + 2) % 3;
        j[r][r] = 1;
        j[r][3 + next] = arm[last];
        j[r][3 + last] = -arm[next];
        for (int c = 0; c < 3; ++c) {
            const double nn = n[r] * n[c] / surface;
            m[r][c] =
                bits >> r & bits >> c & 1 ? sqrt(surface / reach) * (k->axial * nn + k->shear * ((r == c) - nn)) : 0;
        }
    }
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    out[6 * a + b] += j[r][a] * m[r][c] * j[c][b];
}

/* Elements with held faces, and where each is among them. */
typedef struct ground_list {
    brc_fine *f;
    int32_t *at; /* [n_elements] */
} ground_list;

static void mark_ground(void *self, const brc_prescribed *one)
{
    if (one->face >= 0) ((ground_list *)self)->at[one->element] = 1;
}
static void add_ground(void *self, const brc_prescribed *one)
{
    const ground_list *g = self;
    if (one->face < 0) return;
    add_face(g->f, one->face, one->motion, g->f->ground[g->at[one->element]]);
    for (int c = 0; c < 3; ++c)
        if (one->motion >> c & 1)
            g->f->ground_area[g->at[one->element]][c] += g->f->s->domain->free_area_vector[3 * (int64_t)one->face + c];
}

static brc_status collect_ground(brc_simulation *s, brc_fine *f)
{
    const int32_t n = brc_loads_n_held_faces(s);
    ground_list g = {.f = f};
    brc_status status = BRC_OK;
    if (n == 0) return BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &g.at, s->domain->n_elements, "held elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &f->ground_element, n, "held elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &f->ground, n, "held elements"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(s->context, &f->ground_area, n, "held elements"));
    brc_loads_each_prescribed(s, mark_ground, &g);
    for (int64_t e = 0; e < s->domain->n_elements; ++e) {
        if (!g.at[e]) continue;
        f->ground_element[f->n_ground] = (int32_t)e;
        g.at[e] = f->n_ground++;
    }
    brc_loads_each_prescribed(s, add_ground, &g);
cleanup:
    brc_memory_free(g.at);
    return status;
}

/* Components of elements that no load prescribes. */
static void clear_prescribed(void *self, const brc_prescribed *one)
{
    brc_fine *f = self;
    if (one->face < 0) f->nodes.free_bits[one->element] &= (uint8_t) ~(one->motion | one->rotation << 3);
}
static void find_free(brc_simulation *s, brc_fine *f)
{
    memset(f->nodes.free_bits, 63, (size_t)f->nodes.n);
    brc_loads_each_prescribed(s, clear_prescribed, f);
}

/* Mean volume of each body's elements, as a length. */
static brc_status find_spacing(brc_simulation *s, brc_fine *f)
{
    const brc_domain *d = s->domain;
    int32_t n_bodies = 1;
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (d->body[e] >= n_bodies) n_bodies = d->body[e] + 1;
    BRC_TRY(BRC_ALLOCATE(s->context, &f->spacing, n_bodies, "levels"));
    BRC_LOCAL(s->context, n_bodies, int64_t, count, "levels");
    for (int64_t e = 0; e < d->n_elements; ++e) {
        f->spacing[d->body[e]] += d->volume[e];
        count[d->body[e]] += 1;
    }
    for (int32_t b = 0; b < n_bodies; ++b)
        if (count[b] > 0) f->spacing[b] = cbrt(f->spacing[b] / (double)count[b]);
    return BRC_OK;
}

brc_status brc_fine_create(brc_simulation *s, int64_t moment, brc_fine *f)
{
    const brc_domain *d = s->domain;
    *f = (brc_fine){.s = s};
    BRC_TRY(BRC_ALLOCATE(s->context, &f->moduli, s->scene->n_materials, "levels"));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->volume_modulus, s->scene->n_materials, "levels"));
    for (int32_t m = 0; m < s->scene->n_materials; ++m)
        f->moduli[m] = brc_bond_moduli_of(&s->elastic[m]);
    f->coarse_unknowns = 6;
    for (int32_t m = 0; m < s->scene->n_materials && !s->model->turns; ++m) {
        const brc_elastic *k = &s->elastic[m];
        f->volume_modulus[m] = volume_modulus(k);
        f->volumes |= f->volume_modulus[m] != 0;
        f->stiff_volume |= is_stiff(k);
        if (is_soft(k)) f->coarse_unknowns = 7;
    }
    if (d->here) BRC_TRY(bring_areas(s, f));
    if (s->fracture) BRC_TRY(brc_fracture_whole_at(s, moment, &f->whole));
    /* what a rigid motion of a piece meets: enough for the rounding of its sums, and so little that no bending is near
     * it */
    f->soft = s->model->statics->soft > 0                         ? s->model->statics->soft
              : brc_device_get_precision(s->device) == BRC_SINGLE ? 1e-5
                                                                  : 1e-10;
    f->nodes = (brc_nodes){.n = d->n_elements, .unknowns = 6};
    BRC_TRY(BRC_ALLOCATE(s->context, &f->nodes.place, d->n_elements, "levels"));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->nodes.body, d->n_elements, "levels"));
    BRC_TRY(BRC_ALLOCATE(s->context, &f->nodes.free_bits, d->n_elements, "levels"));
    memcpy(f->nodes.place, d->position, (size_t)d->n_elements * sizeof *f->nodes.place);
    for (int64_t e = 0; e < d->n_elements; ++e)
        f->nodes.body[e] = d->body[e];
    find_free(s, f);
    BRC_TRY(collect_ground(s, f));
    BRC_TRY(find_spacing(s, f));
    f->rows = (brc_rows){.n = d->n_elements, .unknowns = 6, .of = f, .row = fine_row};
    for (int64_t e = 0; e < d->n_elements; ++e)
        if (d->row_start[e + 1] - d->row_start[e] >= f->rows.most)
            f->rows.most = (int32_t)(d->row_start[e + 1] - d->row_start[e]) + 1;
    return BRC_OK;
}

void brc_fine_free(brc_fine *f)
{
    void *all[] = {f->moduli,         f->volume_modulus, f->whole,       f->area,
                   f->ground_element, f->ground,         f->ground_area, f->spacing};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
        brc_memory_free(all[i]);
    brc_nodes_free(&f->nodes);
    *f = (brc_fine){0};
}
