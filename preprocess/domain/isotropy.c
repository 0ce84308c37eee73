/* Bins are found on all threads; sums run in fixed blocks of directions, added in order, so threads do not change a
 * bit. */
#include "isotropy.h"
#include "icosphere.h"
#include "../../host/base/memory.h"
#include <math.h>
#include <omp.h>
#include <string.h>

enum { BLOCK = 4096 };

/* Where directions come from: the bonds of a domain, or arrays. */
typedef struct source {
    int64_t n;
    const brc_domain *domain; /* NULL: arrays */
    brc_isotropy_weight kind;
    const int32_t
        *away; /* [n_elements] bonds to the nearest element at a wall, at most `layers`; NULL: all bonds count */
    int32_t layers;
    const double *direction, *weight;
} source;

/* Sums over one block. */
typedef struct moments {
    double weight, square, fabric[6], quartic; /* sums of w, w^2, w n (x) n, w (nx^4 + ny^4 + nz^4) */
} moments;

static double weight_of(const source *from, int64_t k)
{
    if (!from->domain) return from->weight ? from->weight[k] : 1;
    const int32_t h = from->domain->bond_half_edge[k];
    if (from->away && (from->away[from->domain->neighbour[h]] < from->layers ||
                       from->away[from->domain->neighbour[from->domain->twin[h]]] < from->layers))
        return 0;
    if (from->kind == BRC_ISOTROPY_BONDS) return 1;
    const double *s = from->domain->area_vector + 3 * (int64_t)h;
    return sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
}

static void direction_of(const source *from, int64_t k, double n[3])
{
    if (!from->domain) {
        memcpy(n, from->direction + 3 * k, 3 * sizeof *n);
        return;
    }
    const brc_domain *d = from->domain;
    const int32_t h = d->bond_half_edge[k];
    const double *i = d->position + 3 * (int64_t)d->neighbour[d->twin[h]],
                 *j = d->position + 3 * (int64_t)d->neighbour[h];
    for (int c = 0; c < 3; ++c)
        n[c] = j[c] - i[c];
}

/* To unit length, and to one of the two senses, so that a tie between bins does not depend on how a bond is stored.
 * False for what has no direction. */
static bool make_axis(double n[3])
{
    const double largest = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
    if (!(largest > 0) || !isfinite(n[0] + n[1] + n[2])) return false;
    for (int c = 0; c < 3; ++c)
        n[c] /= largest;
    const bool turn = n[0] < 0 || (n[0] == 0 && (n[1] < 0 || (n[1] == 0 && n[2] < 0)));
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int c = 0; c < 3; ++c)
        n[c] /= turn ? -length : length;
    return true;
}

/* Bins of one block's directions (-1: it has none) and the block's sums. */
static moments count_block(const source *from, const brc_icosphere *sphere, int64_t first, int64_t end, int32_t *bin)
{
    moments sum = {0};
    for (int64_t k = first; k < end; ++k) {
        double n[3];
        const double w = weight_of(from, k);
        direction_of(from, k, n);
        bin[k] = -1;
        if (!make_axis(n) || !(w >= 0) || !isfinite(w)) continue;
        bin[k] = brc_icosphere_nearest(sphere, n);
        const double square[3] = {n[0] * n[0], n[1] * n[1], n[2] * n[2]};
        sum.weight += w;
        sum.square += w * w;
        for (int c = 0; c < 3; ++c)
            sum.fabric[c] += w * square[c];
        sum.fabric[3] += w * n[1] * n[2];
        sum.fabric[4] += w * n[0] * n[2];
        sum.fabric[5] += w * n[0] * n[1];
        sum.quartic += w * (square[0] * square[0] + square[1] * square[1] + square[2] * square[2]);
    }
    return sum;
}

static void add_moments(moments *to, const moments *from)
{
    to->weight += from->weight;
    to->square += from->square;
    to->quartic += from->quartic;
    for (int c = 0; c < 6; ++c)
        to->fabric[c] += from->fabric[c];
}

/* The numbers, from the bins and the sums. Expectations for even directions: a bin and its opposite receive Binomial(n,
 * 2 p), p = solid angle / (4 pi), so density has the variance (1 - 2 p) / (2 n p), and its mean over the sphere is
 * (n_bins - 2) / (2 n). */
static void conclude(brc_isotropy *out, const moments *sum)
{
    const double mean = sum->weight / (2 * M_PI); /* per solid angle: every direction is counted twice */
    double squares = 0, deviation = 0;
    for (int32_t b = 0; b < out->n_bins; ++b) {
        out->density[b] = out->count[b] / out->solid_angle[b] / mean;
        const double off = out->density[b] - 1;
        out->worst_bin = fmax(out->worst_bin, fabs(off));
        squares += out->solid_angle[b] / (4 * M_PI) * off * off;
    }
    for (int c = 0; c < 6; ++c) {
        out->fabric[c] = sum->fabric[c] / sum->weight;
        const double off = out->fabric[c] - (c < 3 ? 1.0 / 3 : 0);
        deviation += (c < 3 ? 1 : 2) * off * off;
    }
    out->n_effective = sum->weight * sum->weight / sum->square;
    out->fabric_anisotropy = sqrt(1.5 * deviation) * 3;
    out->fabric_noise = 3 / sqrt(out->n_effective);
    out->cubic = sum->quartic / sum->weight * (5.0 / 3) - 1;
    out->cubic_noise = 4 / (3 * sqrt(21 * out->n_effective));
    const double expected = (out->n_bins - 2) / (2 * out->n_effective);
    out->rms_bin = sqrt(squares);
    out->noise = sqrt(expected);
    out->excess = sqrt(fmax(squares - expected, 0));
}

/* The result's arrays from the sphere's, which it takes over. */
static brc_status take_sphere(brc_context *context, brc_icosphere *sphere, brc_isotropy *out)
{
    out->n_bins = sphere->n_vertices;
    out->n_triangles = sphere->n_triangles;
    BRC_TRY(BRC_ALLOCATE(context, &out->count, out->n_bins, "bins of directions"));
    BRC_TRY(BRC_ALLOCATE(context, &out->density, out->n_bins, "bins of directions"));
    BRC_TRY(BRC_ALLOCATE(context, &out->triangle, 3 * (int64_t)out->n_triangles, "triangles of the histogram"));
    memcpy(out->triangle, sphere->triangle, 3 * (size_t)out->n_triangles * sizeof *out->triangle);
    out->direction = sphere->vertex;
    out->solid_angle = sphere->solid_angle;
    sphere->vertex = NULL;
    sphere->solid_angle = NULL;
    return BRC_OK;
}

static brc_status measure(brc_context *context, const source *from, int level, int n_threads, brc_isotropy *out)
{
    brc_status status = BRC_OK;
    brc_icosphere sphere = {0};
    int32_t *bin = NULL;
    moments *blocks = NULL, sum = {0};
    const int64_t n_blocks = (from->n + BLOCK - 1) / BLOCK;
    const int threads = n_threads > 0 ? n_threads : omp_get_max_threads();
    BRC_TRY_OR(cleanup, brc_icosphere_make(context, level, &sphere));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &bin, from->n, "bins of the bonds"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &blocks, n_blocks, "sums over directions"));
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t b = 0; b < n_blocks; ++b)
        blocks[b] = count_block(from, &sphere, b * BLOCK, b + 1 < n_blocks ? (b + 1) * BLOCK : from->n, bin);
    for (int64_t b = 0; b < n_blocks; ++b)
        add_moments(&sum, &blocks[b]);
    BRC_TRY_OR(cleanup, take_sphere(context, &sphere, out));
    for (int64_t k = 0; k < from->n; ++k) {
        if (bin[k] < 0) {
            status = BRC_FAIL(context, BRC_BAD_INPUT,
                              "direction %lld has length 0, is not finite, or has a weight that is not a number >= 0",
                              (long long)k);
            goto cleanup;
        }
        const double w = weight_of(from, k);
        if (w == 0) continue;
        ++out->n_directions;
        out->count[bin[k]] += w;
        out->count[sphere.opposite[bin[k]]] += w;
    }
    if (!(sum.weight > 0)) {
        status = from->away ? BRC_FAIL(context, BRC_BAD_INPUT,
                                       "none of %lld bonds is %d layer(s) or more away from the walls; ask for fewer "
                                       "layers or build more elements",
                                       (long long)from->n, (int)from->layers)
                            : BRC_FAIL(context, BRC_BAD_INPUT,
                                       "%lld directions whose weights sum to 0; nothing can be said about them",
                                       (long long)from->n);
        goto cleanup;
    }
    conclude(out, &sum);
cleanup:
    brc_icosphere_free(&sphere);
    brc_memory_free(bin);
    brc_memory_free(blocks);
    if (status != BRC_OK) brc_isotropy_free(out);
    return status;
}

/* Distance of every element from those at a wall, in bonds, as far as `layers`. Cells are at a wall with a free face,
 * spheres as members of a wall's set. */
static void find_layers(const brc_domain *d, int32_t layers, int32_t *away)
{
    for (int64_t e = 0; e < d->n_elements; ++e)
        away[e] = d->element_kind == BRC_ELEMENT_CELL && d->free_start[e] < d->free_start[e + 1] ? 0 : layers;
    for (int32_t w = 0; d->element_kind == BRC_ELEMENT_SPHERE && w < d->n_walls; ++w) {
        const int32_t set = brc_domain_find_set(d, d->wall_name[w]);
        for (int64_t m = 0; set >= 0 && m < d->sets[set].n_members; ++m)
            away[d->sets[set].members[m]] = 0;
    }
    for (int32_t layer = 0; layer + 1 < layers; ++layer)
        for (int64_t e = 0; e < d->n_elements; ++e)
            for (int64_t h = d->row_start[e]; away[e] == layer && h < d->row_start[e + 1]; ++h)
                if (away[d->neighbour[h]] > layer + 1) away[d->neighbour[h]] = layer + 1;
}

brc_status brc_isotropy_measure(brc_context *context, const brc_domain *domain, int level, brc_isotropy_weight weight,
                                int n_threads, brc_isotropy *out)
{
    return brc_isotropy_measure_inside(context, domain, 0, level, weight, n_threads, out);
}

brc_status brc_isotropy_measure_inside(brc_context *context, const brc_domain *domain, int layers, int level,
                                       brc_isotropy_weight weight, int n_threads, brc_isotropy *out)
{
    int32_t *away = NULL;
    memset(out, 0, sizeof *out);
    if (domain->n_bonds < 1)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "the domain has %lld element(s) and no bond, so there are no directions to count",
                        (long long)domain->n_elements);
    if (weight == BRC_ISOTROPY_AREA && domain->element_kind != BRC_ELEMENT_CELL)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "spheres have no faces to weight directions with; count every bond once");
    if (layers < 0)
        return BRC_FAIL(context, BRC_BAD_INPUT, "%d layers away from the walls; expected 0 (all bonds) or more",
                        layers);
    if (layers > 0) {
        BRC_TRY(BRC_ALLOCATE(context, &away, domain->n_elements, "distances from the walls"));
        find_layers(domain, layers, away);
    }
    const source from = {.n = domain->n_bonds, .domain = domain, .kind = weight, .away = away, .layers = layers};
    const brc_status status = measure(context, &from, level, n_threads, out);
    brc_memory_free(away);
    return status;
}

brc_status brc_isotropy_count(brc_context *context, int64_t n, const double *direction, const double *weight, int level,
                              int n_threads, brc_isotropy *out)
{
    memset(out, 0, sizeof *out);
    if (n < 1) return BRC_FAIL(context, BRC_BAD_INPUT, "%lld directions to count; expected 1 or more", (long long)n);
    const source from = {.n = n, .direction = direction, .weight = weight};
    return measure(context, &from, level, n_threads, out);
}

void brc_isotropy_free(brc_isotropy *isotropy)
{
    brc_memory_free(isotropy->direction);
    brc_memory_free(isotropy->solid_angle);
    brc_memory_free(isotropy->count);
    brc_memory_free(isotropy->density);
    brc_memory_free(isotropy->triangle);
    memset(isotropy, 0, sizeof *isotropy);
}

void brc_isotropy_print(FILE *file, const brc_isotropy *i)
{
    fprintf(file, "directions       %lld bonds in %d bins\n", (long long)i->n_directions, (int)i->n_bins);
    fprintf(file, "fabric           xx %.5f yy %.5f zz %.5f yz %.5f xz %.5f xy %.5f (even: 0.33333 and 0)\n",
            i->fabric[0], i->fabric[1], i->fabric[2], i->fabric[3], i->fabric[4], i->fabric[5]);
    fprintf(file, "anisotropy       %.4f of the fabric (by chance %.4f), cubic order %.4f (by chance %.4f)\n",
            i->fabric_anisotropy, i->fabric_noise, i->cubic, i->cubic_noise);
    fprintf(file, "bins             density off by %.3f rms (by chance %.3f, beyond it %.3f), worst bin %.3f\n",
            i->rms_bin, i->noise, i->excess, i->worst_bin);
}
