/* The two cells of a face were computed apart, so they agree to rounding only. A face is therefore taken from the side
 * of the smaller element and copied to the other; its area vector points along the branch exactly. */
#include "halfedge.h"

#include "../../host/base/memory.h"
#include "cells_ranks.h"

#include <math.h>
#include <string.h>

/* A face that only one side has comes from a corner degenerate to Voro++'s tolerance; larger ones mean lost
 * geometry. */
#define ONE_SIDED_LIMIT 1e-6

/* Index of `value` in the ascending run a[low .. high), -1 when absent. */
static int64_t find(const int32_t *a, int64_t low, int64_t high, int32_t value)
{
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (a[middle] == value) return middle;
        if (a[middle] < value)
            low = middle + 1;
        else
            high = middle;
    }
    return -1;
}

/* start[e + 1] = start[e] + count[e]; returns the total. */
static int64_t prefix_sum(const int32_t *count, int64_t n, int64_t *start)
{
    start[0] = 0;
    for (int64_t e = 0; e < n; ++e)
        start[e + 1] = start[e] + count[e];
    return start[n];
}

static int64_t run_end(const brc_cells *cells, int64_t r)
{
    const int64_t end = (r + 1) * BRC_RUN_LENGTH;
    return end < cells->n_elements ? end : cells->n_elements;
}

/* Numbers of which a rank may have some alone. */
static brc_status allocate_places(brc_context *context, const brc_domain *domain, int64_t n, double **out,
                                  const char *what)
{
    return domain->here ? brc_memory_allocate_sparse(context, (void **)out, n, sizeof **out, what)
                        : BRC_ALLOCATE(context, out, n, what);
}

/* Move shared faces of all runs into the domain's (still uncompressed) rows. */
static void gather_faces(brc_cells *cells, int n_threads, brc_domain *domain, double *area)
{
#pragma omp parallel for schedule(dynamic, 1) num_threads(n_threads)
    for (int64_t r = 0; r < cells->n_runs; ++r) {
        brc_cell_run *run = &cells->run[r];
        const int64_t h = domain->row_start[r * BRC_RUN_LENGTH];
        const size_t n = (size_t)run->n_faces;
        if (n == 0) continue;
        memcpy(domain->neighbour + h, run->neighbour, n * sizeof(int32_t));
        memcpy(area + h, run->area, n * sizeof(double));
        if (run->centroid) memcpy(domain->face_centroid + 3 * h, run->centroid, 3 * n * sizeof(double));
        brc_cell_run_free_faces(run);
    }
}

static void find_twins(int n_threads, brc_domain *domain)
{
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t e = 0; e < domain->n_elements; ++e)
        for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h) {
            const int32_t j = domain->neighbour[h];
            domain->twin[h] =
                (int32_t)find(domain->neighbour, domain->row_start[j], domain->row_start[j + 1], (int32_t)e);
        }
}

/* Judge every face from its smaller side (one-sided ones from the side that has it) and remove the dropped ones from
 * the rows. limit: smallest area kept [m^2]. */
static brc_status drop_faces(brc_context *context, double limit, double mean, brc_domain *domain, double *area)
{
    brc_quality *quality = &domain->quality;
    int32_t *place = NULL; /* new place + 1 of each half-edge, 0: dropped */
    double dropped_area = 0.0, total_area = 0.0, difference = 0.0, one_sided = 0.0;
    int64_t n_dropped = 0;
    BRC_TRY(BRC_ALLOCATE(context, &place, domain->n_half_edges, "faces kept"));
    for (int64_t e = 0; e < domain->n_elements; ++e)
        for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h) {
            const int32_t twin = domain->twin[h];
            if (twin >= 0 && domain->neighbour[h] < e) {
                place[h] = place[twin];
                continue;
            }
            total_area += area[h];
            if (twin < 0)
                one_sided = fmax(one_sided, area[h]);
            else
                difference = fmax(difference, fabs(area[h] - area[twin]));
            place[h] = twin >= 0 && area[h] >= limit;
            if (place[h]) continue;
            ++n_dropped;
            dropped_area += area[h];
        }
    quality->n_tiny_faces_dropped = n_dropped;
    quality->tiny_face_area_fraction = total_area > 0.0 ? dropped_area / total_area : 0.0;
    quality->twin_area_worst = mean > 0.0 ? difference / mean : 0.0;
    if (n_dropped > 0) {
        int64_t to = 0;
        for (int64_t e = 0, h = 0; e < domain->n_elements; ++e) {
            const int64_t end = domain->row_start[e + 1];
            for (; h < end; ++h) {
                if (!place[h]) continue;
                domain->neighbour[to] = domain->neighbour[h];
                domain->twin[to] = domain->twin[h];
                area[to] = area[h];
                if (brc_domain_has(domain, e))
                    memmove(domain->face_centroid + 3 * to, domain->face_centroid + 3 * h, 3 * sizeof(double));
                place[h] = (int32_t)(to++ + 1);
            }
            domain->row_start[e + 1] = to;
        }
        domain->n_half_edges = to;
        for (int64_t h = 0; h < to; ++h)
            domain->twin[h] = place[domain->twin[h]] - 1;
    }
    brc_memory_free(place);
    if (one_sided > ONE_SIDED_LIMIT * mean)
        return BRC_FAIL(
            context, BRC_BAD_INPUT,
            "a face of %.3g of the mean area is seen from one of its cells only: the seeds are too irregular "
            "for Voro++; use another seed or a larger minimal distance",
            one_sided / mean);
    return BRC_OK;
}

/* Number the bonds and give both half-edges of a bond the same face. */
static brc_status pair_faces(brc_context *context, int n_threads, const double *area, brc_domain *domain)
{
    domain->n_bonds = domain->n_half_edges / 2;
    BRC_TRY(BRC_ALLOCATE(context, &domain->bond, domain->n_half_edges, "bonds of half-edges"));
    BRC_TRY(BRC_ALLOCATE(context, &domain->bond_half_edge, domain->n_bonds, "half-edges of bonds"));
    BRC_TRY(allocate_places(context, domain, 3 * domain->n_half_edges, &domain->area_vector, "area vectors"));
    int32_t b = 0;
    for (int64_t e = 0; e < domain->n_elements; ++e)
        for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h)
            if (domain->neighbour[h] > e) {
                domain->bond_half_edge[b] = (int32_t)h;
                domain->bond[h] = domain->bond[domain->twin[h]] = b++;
            }
#pragma omp parallel for schedule(static) num_threads(n_threads)
    for (int64_t e = 0; e < domain->n_elements; ++e)
        for (int64_t h = domain->row_start[e]; h < domain->row_start[e + 1]; ++h) {
            const int64_t j = domain->neighbour[h];
            const bool mine = brc_domain_has(domain, e), other = brc_domain_has(domain, j);
            if (j < e || (!mine && !other)) continue;
            const double *x = domain->position + 3 * e, *y = domain->position + 3 * j;
            const double r[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
            const double inv_q = area[h] / sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
            const int64_t t = domain->twin[h]; /* no other iteration touches the twin */
            for (int d = 0; d < 3; ++d) {
                if (mine) domain->area_vector[3 * h + d] = inv_q * r[d];
                if (other) domain->area_vector[3 * t + d] = -inv_q * r[d];
                if (mine && other) domain->face_centroid[3 * t + d] = domain->face_centroid[3 * h + d];
            }
        }
    return domain->here ? brc_cells_bring_centroids(context, domain) : BRC_OK;
}

static bool free_face_kept(const brc_cell_run *run, int64_t f, double limit)
{
    const double *s = run->free_geometry + 6 * f;
    return sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) >= limit;
}

/* Count the kept free faces of every element, and the corners of their polygons. */
static void count_free(brc_cells *cells, double limit, int32_t *n_kept, int32_t *n_polygon)
{
    for (int64_t r = 0; r < cells->n_runs; ++r) {
        const brc_cell_run *run = &cells->run[r];
        int64_t f = 0;
        for (int64_t e = r * BRC_RUN_LENGTH; e < run_end(cells, r); ++e)
            for (const int64_t end = f + cells->n_free[e]; f < end; ++f)
                if (free_face_kept(run, f, limit)) {
                    ++n_kept[e];
                    n_polygon[e] += run->free_corners[f];
                }
    }
}

/* Copy the free faces and corners of a run to their places. */
static void copy_run(const brc_cells *cells, int64_t r, double limit, const int64_t *polygon_start, brc_domain *domain)
{
    const brc_cell_run *run = &cells->run[r];
    const int64_t first = r * BRC_RUN_LENGTH;
    if (run->vertex)
        memcpy(domain->vertex + 3 * domain->vertex_start[first], run->vertex,
               3 * (size_t)run->n_vertices * sizeof(double));
    int64_t f = 0, p = 0, to = domain->free_start[first], polygon = polygon_start[first];
    for (int64_t e = first; e < run_end(cells, r); ++e)
        for (const int64_t end = f + cells->n_free[e]; f < end; p += run->free_corners[f++]) {
            if (!free_face_kept(run, f, limit)) continue;
            domain->free_element[to] = (int32_t)e;
            domain->free_wall[to] = run->free_wall[f];
            memcpy(domain->free_area_vector + 3 * to, run->free_geometry + 6 * f, 3 * sizeof(double));
            memcpy(domain->free_centroid + 3 * to, run->free_geometry + 6 * f + 3, 3 * sizeof(double));
            domain->free_polygon_start[to++] = polygon;
            for (int32_t k = 0; k < run->free_corners[f]; ++k)
                domain->free_polygon[polygon++] = (int32_t)(domain->vertex_start[e] + run->polygon[p + k]);
        }
}

static brc_status build_free_faces(brc_context *context, brc_cells *cells, double limit, int n_threads,
                                   brc_domain *domain)
{
    const int64_t n = domain->n_elements;
    int32_t *n_kept = NULL, *n_polygon = NULL;
    int64_t *polygon_start = NULL;
    brc_status status = BRC_ALLOCATE(context, &n_kept, n, "free faces kept");
    if (status != BRC_OK) goto cleanup;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &n_polygon, n, "corners of free faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &polygon_start, n + 1, "polygons of free faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->free_start, n + 1, "rows of free faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->vertex_start, n + 1, "rows of corners"));
    count_free(cells, limit, n_kept, n_polygon);
    domain->n_free_faces = prefix_sum(n_kept, n, domain->free_start);
    const int64_t n_corners = prefix_sum(n_polygon, n, polygon_start);
    const int64_t n_vertices = prefix_sum(cells->n_corners, n, domain->vertex_start);
    for (int64_t r = 0; r < cells->n_runs; ++r)
        domain->quality.n_tiny_faces_dropped += cells->run[r].n_free;
    domain->quality.n_tiny_faces_dropped -= domain->n_free_faces;
    if (n_vertices > INT32_MAX) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%lld cell corners, must be below 2^31; use fewer elements",
                          (long long)n_vertices);
        goto cleanup;
    }
    const int64_t m = domain->n_free_faces;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->free_element, m, "elements of free faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->free_wall, m, "walls of free faces"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->free_area_vector, 3 * m, "free area vectors"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->free_centroid, 3 * m, "free face centroids"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->free_polygon_start, m + 1, "free polygons"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->free_polygon, n_corners, "corners of free polygons"));
    BRC_TRY_OR(cleanup, allocate_places(context, domain, 3 * n_vertices, &domain->vertex, "cell corners"));
    domain->free_polygon_start[m] = n_corners;
#pragma omp parallel for schedule(dynamic, 1) num_threads(n_threads)
    for (int64_t r = 0; r < cells->n_runs; ++r) {
        copy_run(cells, r, limit, polygon_start, domain);
        brc_cell_run_free(&cells->run[r]);
    }
    brc_memory_trim();
cleanup:
    brc_memory_free(n_kept);
    brc_memory_free(n_polygon);
    brc_memory_free(polygon_start);
    return status;
}

static double mean_area(const brc_domain *domain, const double *area)
{
    double sum = 0.0;
    for (int64_t h = 0; h < domain->n_half_edges; ++h)
        sum += area[h];
    return domain->n_half_edges > 0 ? sum / (double)domain->n_half_edges : 0.0;
}

brc_status brc_half_edges_build(brc_context *context, brc_cells *cells, double tiny_face_threshold, int n_threads,
                                brc_domain *domain)
{
    double *area = NULL;
    brc_status status = BRC_ALLOCATE(context, &domain->row_start, domain->n_elements + 1, "rows of half-edges");
    if (status != BRC_OK) goto cleanup;
    if (cells->together == BRC_APART) BRC_TRY_OR(cleanup, brc_cells_mark_apart(context, domain));
    domain->n_half_edges = prefix_sum(cells->n_faces, domain->n_elements, domain->row_start);
    if (domain->n_half_edges > INT32_MAX - 1) {
        status = BRC_FAIL(context, BRC_BAD_INPUT, "%lld half-edges, must be below 2^31; use fewer elements",
                          (long long)domain->n_half_edges);
        goto cleanup;
    }
    const int64_t n = domain->n_half_edges;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &area, n, "face areas"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->neighbour, n, "neighbours"));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(context, &domain->twin, n, "twins"));
    BRC_TRY_OR(cleanup, allocate_places(context, domain, 3 * n, &domain->face_centroid, "face centroids"));
    gather_faces(cells, n_threads, domain, area);
    brc_memory_trim();
    find_twins(n_threads, domain);
    const double mean = mean_area(domain, area), limit = tiny_face_threshold * mean;
    domain->quality.tiny_face_threshold = tiny_face_threshold;
    BRC_TRY_OR(cleanup, drop_faces(context, limit, mean, domain, area));
    BRC_TRY_OR(cleanup, build_free_faces(context, cells, limit, n_threads, domain));
    BRC_TRY_OR(cleanup, pair_faces(context, n_threads, area, domain));
    domain->volume = cells->volume;
    domain->centroid = cells->centroid;
    domain->inertia = cells->inertia;
    cells->volume = cells->centroid = cells->inertia = NULL;
cleanup:
    brc_memory_free(area);
    return status;
}
