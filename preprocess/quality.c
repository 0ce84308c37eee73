/* Worst cases are maxima, so the order in which threads find them does not matter; sums run over elements in order. */
#include "quality.h"

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
    const double det = d[0] * (d[1] * d[2] - a[3] * a[3]) - a[5] * (a[5] * d[2] - a[3] * a[4]) +
                       a[4] * (a[5] * a[3] - d[1] * a[4]);
    const double r = fmax(-1.0, fmin(1.0, det / (2.0 * p * p * p)));
    /* the three roots are mean + 2 p cos(acos(r) / 3 + 2 pi k / 3); k = 1 is the smallest */
    return mean + 2.0 * p * cos(acos(r) / 3.0 + 2.0943951023931953);
}

/* Smallest eigenvalue of A / (2 V), A = sum (L/S) s (x) s over the bonds of e; *shortest: its shortest branch. */
static double support(const brc_domain *domain, int64_t e, double *shortest)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
    double a[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    const double *x = domain->position + 3 * e;
    for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h) {
        const double *s = domain->area_vector + 3 * h, *y = domain->position + 3 * (int64_t)domain->neighbour[h];
        const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
        const double length = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        const double area = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        *shortest = fmin(*shortest, length);
        for (int m = 0; m < 6; ++m) a[m] += length / area * s[row[m]] * s[column[m]];
    }
    for (int m = 0; m < 6; ++m) a[m] /= 2.0 * domain->volume[e];
    return smallest_eigenvalue(a);
}

void brc_quality_measure(brc_domain *domain, int n_threads)
{
    brc_quality *q = &domain->quality;
    double volume = 0.0, lost = 0.0, worst = 0.0, least = HUGE_VAL, shortest = HUGE_VAL;
    memset(q->coordination_histogram, 0, sizeof q->coordination_histogram);
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        const int64_t k = domain->row_start[e + 1] - domain->row_start[e];
        q->coordination_histogram[k < HISTOGRAM_BINS ? k : HISTOGRAM_BINS - 1]++;
        /* compensated: a plain sum of a million equal volumes is off by 1e-11 */
        const double sum = volume + domain->volume[e];
        lost += volume >= domain->volume[e] ? (volume - sum) + domain->volume[e] : (domain->volume[e] - sum) + volume;
        volume = sum;
    }
    volume += lost;
#pragma omp parallel for schedule(static) num_threads(n_threads) reduction(max : worst) reduction(min : least, shortest)
    for (int64_t e = 0; e < domain->n_elements; ++e) {
        worst = fmax(worst, brc_domain_closure(domain, e));
        least = fmin(least, support(domain, e, &shortest));
    }
    q->volume_cells = volume;
    q->volume_error = volume / q->volume_shape - 1.0;
    q->smallest_distance = domain->n_bonds > 0 ? shortest : 0.0;
    q->mean_spacing = cbrt(volume / (double)domain->n_elements);
    q->closure_worst = worst;
    q->support_smallest = least;
    q->coordination_mean = 2.0 * (double)domain->n_bonds / (double)domain->n_elements;
}

void brc_quality_print(FILE *file, const brc_quality *q)
{
    int64_t most = 1;
    int first = HISTOGRAM_BINS, last = 0;
    for (int k = 0; k < HISTOGRAM_BINS; ++k) {
        if (q->coordination_histogram[k] == 0) continue;
        if (k < first) first = k;
        last = k;
        if (q->coordination_histogram[k] > most) most = q->coordination_histogram[k];
    }
    fprintf(file, "seeds            asked for %lld, dropped as too near %lld, lost %lld\n",
            (long long)q->n_seeds_requested, (long long)q->n_seeds_duplicate, (long long)q->n_seeds_lost);
    fprintf(file, "volume           %.9g m^3, shape %.9g m^3, relative error %.2g\n", q->volume_cells, q->volume_shape,
            q->volume_error);
    fprintf(file, "spacing          mean %.6g m, smallest distance %.3g of it\n", q->mean_spacing,
            q->mean_spacing > 0.0 ? q->smallest_distance / q->mean_spacing : 0.0);
    fprintf(file, "tiny faces       %lld below %.2g of the mean area dropped (%.2g of all face area)\n",
            (long long)q->n_tiny_faces_dropped, q->tiny_face_threshold, q->tiny_face_area_fraction);
    fprintf(file, "closure          worst %.2g, twin areas differ by at most %.2g of the mean area\n", q->closure_worst,
            q->twin_area_worst);
    fprintf(file, "support          smallest eigenvalue of A/(2V) %.3g\n", q->support_smallest);
    fprintf(file, "bonds            %.3f per element\n", q->coordination_mean);
    for (int k = first; k <= last; ++k) {
        const int64_t n = q->coordination_histogram[k];
        const int bar = (int)(50 * n / most);
        fprintf(file, "  %3d%s %10lld %.*s\n", k, k == HISTOGRAM_BINS - 1 ? "+" : " ", (long long)n, bar,
                "##################################################");
    }
}
