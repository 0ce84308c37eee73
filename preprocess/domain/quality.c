/* Worst cases are maxima, so the order in which threads find them does not matter; sums run over elements in order;
 * spreads come from counts of integers. */
#include "quality.h"

#include "../../host/base/memory.h"
#include "../../host/base/ranks.h"

#include <math.h>
#include <string.h>

enum { HISTOGRAM_BINS = (int)(sizeof((brc_quality *)0)->coordination_histogram / sizeof(int64_t)) };

/* Smallest eigenvalue of the symmetric matrix xx yy zz yz xz xy, by the trigonometric solution of its cubic. */
static double smallest_eigenvalue(const double a[6])
{
    const double mean = (a[0] + a[1] + a[2]) / 3.0;
    const double d[3] = {a[0] - mean, a[1] - mean, a[2] - mean};
    const double off = a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
    const double p = sqrt((d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + 2.0 * off) / 6.0);
    if (!(p > 0.0)) return mean;
    const double det =
        d[0] * (d[1] * d[2] - a[3] * a[3]) - a[5] * (a[5] * d[2] - a[3] * a[4]) + a[4] * (a[5] * a[3] - d[1] * a[4]);
    const double r = fmax(-1.0, fmin(1.0, det / (2.0 * p * p * p)));
    /* the three roots are mean + 2 p cos(acos(r) / 3 + 2 pi k / 3); k = 1 is the smallest */
    return mean + 2.0 * p * cos(acos(r) / 3.0 + 2.0943951023931953);
}

static double branch_length(const brc_domain *domain, int64_t e, int64_t h)
{
    const double *x = domain->position + 3 * e, *y = domain->position + 3 * (int64_t)domain->neighbour[h];
    const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
    return sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
}

static double shortest_branch(const brc_domain *domain, int64_t e)
{
    double shortest = HUGE_VAL;
    for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h)
        shortest = fmin(shortest, branch_length(domain, e, h));
    return shortest;
}

/* Smallest eigenvalue of A / (2 V), A = sum (L/S) s (x) s over the bonds of cell e. */
static double support(const brc_domain *domain, int64_t e)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    double a[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h) {
        const double *s = domain->area_vector + 3 * h, length = branch_length(domain, e, h);
        const double area = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        for (int m = 0; m < 6; ++m)
            a[m] += length / area * s[row[m]] * s[column[m]];
    }
    for (int m = 0; m < 6; ++m)
        a[m] /= 2.0 * domain->volume[e];
    return smallest_eigenvalue(a);
}

/* The values 0 <= value(k) of a spread, k = 0 .. n - 1; as floats, whose bits sort like the numbers. */
typedef float (*value_of)(const brc_domain *domain, int64_t k);

static float volume_value(const brc_domain *domain, int64_t e)
{
    return (float)brc_domain_own_volume(domain, e);
}

static float faces_value(const brc_domain *domain, int64_t e)
{
    return (float)(domain->row_start[e + 1] - domain->row_start[e] + domain->free_start[e + 1] - domain->free_start[e]);
}

/* Of the bond's own half-edge, whose twin names the element it starts from. */
static float branch_value(const brc_domain *domain, int64_t b)
{
    const int64_t h = domain->bond_half_edge[b];
    return (float)branch_length(domain, domain->neighbour[domain->twin[h]], h);
}

enum { N_RANKS = 5, RADIX_BITS = 11, RADIX_PASSES = 3 };

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Least, 5 %, median, 95 % and most of n values, exactly and without memory: three passes settle 11 bits of each after
 * another. */
static void find_spread(const brc_domain *domain, value_of value, int64_t n, int n_threads, double out[N_RANKS])
{
    static const double share[N_RANKS] = {0.0, 0.05, 0.5, 0.95, 1.0};
    int64_t rank[N_RANKS]; /* among the values with the bits settled so far */
    uint32_t settled[N_RANKS] = {0};
    for (int r = 0; r < N_RANKS; ++r) {
        rank[r] = (int64_t)(share[r] * (double)(n - 1));
        out[r] = 0.0;
    }
    if (n < 1) return;
    for (int pass = 0; pass < RADIX_PASSES; ++pass) {
        const int shift = RADIX_BITS * (RADIX_PASSES - 1 - pass);
        const uint32_t mask = (1u << RADIX_BITS) - 1;
        int64_t count[N_RANKS][1 << RADIX_BITS] = {{0}};
#pragma omp parallel num_threads(n_threads)
        {
            int64_t own[N_RANKS][1 << RADIX_BITS] = {{0}};
#pragma omp for schedule(static)
            for (int64_t k = 0; k < n; ++k) {
                const uint32_t bits = bits_of(value(domain, k));
                const uint64_t above = (uint64_t)bits >> (shift + RADIX_BITS); /* at most 33 places: a 64-bit shift */
                for (int r = 0; r < N_RANKS; ++r)
                    if (above == settled[r]) own[r][(bits >> shift) & mask]++;
            }
#pragma omp critical(brc_quality_spread)
            for (int r = 0; r < N_RANKS; ++r)
                for (uint32_t digit = 0; digit <= mask; ++digit)
                    count[r][digit] += own[r][digit];
        }
        for (int r = 0; r < N_RANKS; ++r) {
            uint32_t digit = 0;
            while (rank[r] >= count[r][digit])
                rank[r] -= count[r][digit++];
            settled[r] = settled[r] << RADIX_BITS | digit;
        }
    }
    for (int r = 0; r < N_RANKS; ++r) {
        float found;
        memcpy(&found, &settled[r], sizeof found);
        out[r] = (double)found;
    }
}

static int32_t root_of(int32_t *parent, int32_t e)
{
    while (parent[e] != e) {
        parent[e] = parent[parent[e]];
        e = parent[e];
    }
    return e;
}

/* Parts joined by bonds, by union and find. */
static int64_t count_pieces(const brc_domain *domain)
{
    int32_t *parent;
    if (BRC_ALLOCATE(NULL, &parent, domain->n_elements, "pieces") != BRC_OK) return -1;
    int64_t n = domain->n_elements;
    for (int64_t e = 0; e < n; ++e)
        parent[e] = (int32_t)e;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1] && domain->neighbour[h] < e; ++h) {
            const int32_t a = root_of(parent, (int32_t)e), b = root_of(parent, domain->neighbour[h]);
            if (a == b) continue;
            parent[a < b ? b : a] = a < b ? a : b;
            --n;
        }
    brc_memory_free(parent);
    return n;
}

/* Compensated: a plain sum of a million equal volumes is off by 1e-11. */
static double sum_volumes(const brc_domain *domain)
{
    double volume = 0.0, lost = 0.0;
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const double own = brc_domain_own_volume(domain, e), sum = volume + own;
        lost += volume >= own ? (volume - sum) + own : (own - sum) + volume;
        volume = sum;
    }
    return volume + lost;
}

static void measure_bonds(brc_domain *domain, int n_threads)
{
    brc_quality *q = &domain->quality;
    double shortest = HUGE_VAL;
    memset(q->coordination_histogram, 0, sizeof q->coordination_histogram);
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const int64_t k = domain->row_start[e + 1] - domain->row_start[e];
        q->coordination_histogram[k < HISTOGRAM_BINS ? k : HISTOGRAM_BINS - 1]++;
    }
#pragma omp parallel for schedule(static) num_threads(n_threads) reduction(min : shortest)
    for (int64_t e = 0; e < domain->n_elements; ++e)
        shortest = fmin(shortest, shortest_branch(domain, e));
    q->smallest_distance = domain->n_bonds > 0 ? shortest : 0.0;
    q->coordination_mean = 2.0 * (double)domain->n_bonds / (double)domain->n_elements;
    q->n_elements_without_bond = q->coordination_histogram[0];
    q->n_pieces = count_pieces(domain);
    find_spread(domain, branch_value, domain->n_bonds, n_threads, q->branch_spread);
    for (int r = 0; r < N_RANKS; ++r)
        q->branch_spread[r] /= q->mean_spacing;
}

void brc_quality_measure(brc_domain *domain, int n_threads)
{
    brc_quality *q = &domain->quality;
    const bool spheres = domain->element_kind == BRC_ELEMENT_SPHERE;
    const double volume = sum_volumes(domain), n = (double)domain->n_elements;
    q->volume_cells = volume;
    q->volume_error = spheres ? 0.0 : volume / q->volume_shape - 1.0;
    q->volume_fraction = spheres && q->volume_shape > 0.0 ? volume / q->volume_shape : 0.0;
    q->mean_spacing = cbrt((spheres && q->volume_shape > 0.0 ? q->volume_shape : volume) / n);
    measure_bonds(domain, n_threads);
    find_spread(domain, volume_value, domain->n_elements, n_threads, q->volume_spread);
    for (int r = 0; r < N_RANKS; ++r)
        q->volume_spread[r] *= n / volume;
    q->closure_worst = q->support_smallest = 0.0;
    if (spheres) return;
    double worst = 0.0, least = HUGE_VAL;
#pragma omp parallel for schedule(static) num_threads(n_threads) reduction(max : worst) reduction(min : least)
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        if (!brc_domain_has(domain, e)) continue;
        worst = fmax(worst, brc_domain_closure(domain, e));
        least = fmin(least, support(domain, e));
    }
    q->closure_worst = worst;
    q->support_smallest = least;
    find_spread(domain, faces_value, domain->n_elements, n_threads, q->faces_spread);
}

brc_status brc_quality_agree(brc_context *context, brc_domain *domain)
{
    if (!domain->here) return BRC_OK;
    BRC_TRY(brc_ranks_most(context, 1, &domain->quality.closure_worst));
    return brc_ranks_least(context, 1, &domain->quality.support_smallest);
}

static void print_spread(FILE *file, const char *what, const double spread[N_RANKS], const char *of)
{
    fprintf(file, "%-16s %.3g | %.3g | %.3g | %.3g | %.3g%s (least, 5 %%, median, 95 %%, most)\n", what, spread[0],
            spread[1], spread[2], spread[3], spread[4], of);
}

static void print_histogram(FILE *file, const brc_quality *q)
{
    int64_t most = 1;
    int first = HISTOGRAM_BINS, last = 0;
    for (int k = 0; k < HISTOGRAM_BINS; ++k) {
        if (q->coordination_histogram[k] == 0) continue;
        if (k < first) first = k;
        last = k;
        if (q->coordination_histogram[k] > most) most = q->coordination_histogram[k];
    }
    for (int k = first; k <= last; ++k) {
        const int64_t n = q->coordination_histogram[k];
        const int bar = (int)(50 * n / most);
        fprintf(file, "  %3d%s %10lld %.*s\n", k, k == HISTOGRAM_BINS - 1 ? "+" : " ", (long long)n, bar,
                "##################################################");
    }
}

void brc_quality_print(FILE *file, const brc_domain *domain)
{
    const brc_quality *q = &domain->quality;
    const bool spheres = domain->element_kind == BRC_ELEMENT_SPHERE;
    fprintf(file, "seeds            asked for %lld, dropped as too near %lld, lost %lld\n",
            (long long)q->n_seeds_requested, (long long)q->n_seeds_duplicate, (long long)q->n_seeds_lost);
    if (spheres)
        fprintf(file, "volume           spheres %.9g m^3 in a shape of %.9g m^3: fraction %.4f\n", q->volume_cells,
                q->volume_shape, q->volume_fraction);
    else
        fprintf(file, "volume           %.9g m^3, shape %.9g m^3, relative error %.2g\n", q->volume_cells,
                q->volume_shape, q->volume_error);
    print_spread(file, spheres ? "sphere volumes" : "cell volumes", q->volume_spread, " of the mean");
    if (!spheres) print_spread(file, "faces of a cell", q->faces_spread, "");
    fprintf(file, "spacing          mean %.6g m, smallest distance %.3g of it\n", q->mean_spacing,
            q->mean_spacing > 0.0 ? q->smallest_distance / q->mean_spacing : 0.0);
    print_spread(file, "branches", q->branch_spread, " of the spacing");
    if (spheres) {
        fprintf(file, "growth           bonds reach to %.4f times the sum of the radii\n", q->growth);
    } else {
        fprintf(file, "tiny faces       %lld below %.2g of the mean area dropped (%.2g of all face area)\n",
                (long long)q->n_tiny_faces_dropped, q->tiny_face_threshold, q->tiny_face_area_fraction);
        fprintf(file, "closure          worst %.2g, twin areas differ by at most %.2g of the mean area\n",
                q->closure_worst, q->twin_area_worst);
        fprintf(file, "support          smallest eigenvalue of A/(2V) %.3g\n", q->support_smallest);
    }
    if (q->n_pieces >= 0)
        fprintf(file, "pieces           %lld; elements without bonds %lld\n", (long long)q->n_pieces,
                (long long)q->n_elements_without_bond);
    fprintf(file, "bonds            %.3f per element\n", q->coordination_mean);
    print_histogram(file, q);
}
